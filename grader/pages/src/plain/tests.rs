//! Tests of the guards with a table of attacks, every character, and arbitrary text.

use proptest::prelude::*;

use super::*;

#[test]
fn what_would_not_show_becomes_its_code() {
    let table = [
        ("a\u{1b}[2Jb\n\tc", "a\\u{1b}[2Jb\n\tc"),
        ("src/\u{202e}sr.niam", "src/\\u{202e}sr.niam"),
        ("\u{9b}2J\u{7f}\r", "\\u{9b}2J\\u{7f}\\u{d}"),
        ("\u{fffe}\u{ffff}\u{fdd0}\u{1fffe}", "\\u{fffe}\\u{ffff}\\u{fdd0}\\u{1fffe}"),
        ("\u{115f}\u{1160}\u{3164}\u{ffa0}", "\\u{115f}\\u{1160}\\u{3164}\\u{ffa0}"),
        ("\u{e000}\u{e0100}\u{fe0f}\u{2800}", "\\u{e000}\\u{e0100}\\u{fe0f}\\u{2800}"),
        ("Zoë e\u{301} 光 ² 😀\u{a0}‖N‖₊", "Zoë e\u{301} 光 ² 😀\u{a0}‖N‖₊"),
    ];
    for (text, expected) in table {
        assert_eq!(shown(text), expected);
    }
}

#[test]
fn commands_to_a_log_become_text() {
    let table = [
        ("::error file=a::b", "\\u{3a}:error file=a::b"),
        (" \t\u{a0}::stop-commands::x", " \t\u{a0}\\u{3a}:stop-commands::x"),
        ("a\n::set-env name=x::y", "a\n\\u{3a}:set-env name=x::y"),
        ("\u{200b}::debug::x", "\\u{200b}::debug::x"),
        ("a\r::debug::x", "a\\u{d}::debug::x"),
        ("std::vec::Vec, then ##[error]x", "std::vec::Vec, then \\u{23}#[error]x"),
        ("###[error]##vso[task.setvariable]", "#\\u{23}#[error]\\u{23}#vso[task.setvariable]"),
        ("##teamcity[x] ## [a] #[test] ##x", "\\u{23}#teamcity[x] ## [a] #[test] ##x"),
        (":::a", "\\u{3a}::a"),
        (": :a", ": :a"),
    ];
    for (text, expected) in table {
        assert_eq!(shown(text), expected);
    }
}

#[test]
fn colours_stay_where_they_are_ours() {
    assert_eq!(printable("\u{1b}[1;31mred\u{1b}[0m\n"), "\u{1b}[1;31mred\u{1b}[0m\n");
    assert_eq!(printable("\u{1b}[31m ::error::x"), "\u{1b}[31m \\u{3a}:error::x");
    assert_eq!(printable("\u{1b}[2J\u{1b}]8;;x\u{1b}["), "\\u{1b}[2J\\u{1b}]8;;x\\u{1b}[");
}

#[test]
fn names_are_one_short_line() {
    assert_eq!(name(b"a\nb\xff"), "a b\u{fffd}");
    assert_eq!(name("é".repeat(300).as_bytes()), "é".repeat(100) + "…");
    assert_eq!(name(b"\n::error::x"), " \\u{3a}:error::x");
}

#[test]
fn no_cell_is_a_formula() {
    for text in ["=1+1", "+1", "-1", "@SUM(A1)", "\t=1", "\r=1", "\n=1"] {
        assert_eq!(csv_cell(text), format!("'{text}"), "{text:?}");
    }
    for text in ["", "ann", "1-1", "'=1", " =1", "a\n=1"] {
        assert_eq!(csv_cell(text), text);
    }
}

#[test]
fn json_keeps_its_value() {
    let text = "{\"a\\\\##[error]\": \"\u{202e}\u{9b}\u{10ffff}::x\"}\n";
    let guarded = json(text);
    assert_eq!(guarded, "{\"a\\\\\\u0023#[error]\": \"\\u202e\\u009b\\udbff\\udfff::x\"}\n");
    assert_eq!(
        serde_json::from_str::<serde_json::Value>(&guarded).unwrap(),
        serde_json::from_str::<serde_json::Value>(text).unwrap()
    );
}

/// Returns whether XML 1.0 allows the character.
fn is_xml(c: char) -> bool {
    matches!(c, '\t' | '\n' | '\r' | '\u{20}'..='\u{d7ff}')
        || matches!(c, '\u{e000}'..='\u{fffd}' | '\u{10000}'..)
}

#[test]
fn every_character_comes_out_as_one_that_shows() {
    for c in '\0'..=char::MAX {
        let text = shown(&c.to_string());
        assert!(
            text.chars().all(|c| is_xml(c) && (!is_hidden(c) || matches!(c, '\n' | '\t'))),
            "{:x}",
            u32::from(c)
        );
        assert_eq!(shown(&text), text, "{:x}", u32::from(c));
    }
    assert!(!is_xml('\u{fffe}') && !is_xml('\u{b}'), "the check finds nothing");
}

/// Returns whether one of the log readers obeys a line of `text`. The readers compare by the rules
/// of a language, which drop invisible characters, and accept every kind of line break.
fn is_obeyed(text: &str) -> bool {
    text.split(['\n', '\r', '\u{b}', '\u{c}', '\u{85}', '\u{2028}', '\u{2029}']).any(|line| {
        let seen: String = line.chars().filter(|c| !is_hidden(*c) || *c == '\t').collect();
        seen.trim_start().starts_with("::")
            || ["##[", "##vso[", "##teamcity["].iter().any(|word| seen.contains(word))
    })
}

/// Returns a strategy for text made of the pieces that attacks use.
fn attack() -> impl Strategy<Value = String> {
    let pieces = [
        "::", ":", "##", "#", "[", "]", "vso", "teamcity", "error", " ", "\n", "\t", "\r",
        "\u{a0}", "\u{200b}",
    ];
    let more =
        ["\u{1b}[31m", "\u{1b}", "\u{fe0f}", "\u{85}", "x", "\\u{3a}", "\u{2028}", "e\u{301}"];
    let all: Vec<&str> = pieces.into_iter().chain(more).collect();
    proptest::collection::vec(proptest::sample::select(all), 0..12).prop_map(|parts| parts.concat())
}

proptest! {
    #[test]
    fn no_guarded_text_is_obeyed(
        text in prop_oneof![attack(), any::<String>()], other in attack(),
    ) {
        for guarded in [shown(&text), name(text.as_bytes()), printable(&format!("{text}{other}"))] {
            prop_assert!(!is_obeyed(&guarded), "{guarded:?}");
        }
        let twice = shown(&shown(&text));
        prop_assert_eq!(twice, shown(&text));
        let line = name(text.as_bytes());
        prop_assert!(!line.contains(['\n', '\t']), "{:?}", line);
    }

    #[test]
    fn json_of_any_text_is_harmless_and_the_same(text in prop_oneof![attack(), any::<String>()]) {
        let value = serde_json::json!({ &text: [&text, 1.5] });
        for written in [value.to_string(), serde_json::to_string_pretty(&value).unwrap()] {
            let guarded = json(&written);
            prop_assert!(!is_obeyed(&guarded), "{guarded}");
            prop_assert_eq!(&serde_json::from_str::<serde_json::Value>(&guarded).unwrap(), &value);
        }
    }
}

#[test]
fn the_check_knows_what_is_obeyed() {
    for text in [
        "::error::x",
        "  ::x::y",
        "a\n\t::x::",
        "a ##[error]b",
        "a\r::x::",
        "\u{200b}::x::",
        "#\u{200b}#[x]",
    ] {
        assert!(is_obeyed(text), "{text:?}");
    }
}
