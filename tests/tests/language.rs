//! The language of the house: the width of lines, and the words of comments and documents.

use std::path::Path;

use tests::{name, tracked, workspace};

const MOST_COLUMNS: usize = 100;

/// Words of a private dialect, each with the word of the field.
const BANNED: &[(&[&str], &str)] = &[
    (&["meet", "meets", "met", "meeting", "meetings"], "intersect, hit"),
    (&["ask", "asks", "asked", "asking"], "call, test, request"),
    (&["tell", "tells", "told"], "report, show"),
    (&["whom"], "which"),
    (&["things"], "primitives, objects"),
    (&["anew"], "again"),
    (&["in the place of"], "instead of"),
    (&["what came of"], "the result of"),
    (&["comes to"], "is"),
];

/// Words that refer to a sentence before. A doc comment has none.
const OPENINGS: &[&str] = &[
    "It", "Its", "They", "Their", "Those", "That", "Such", "As", "The same", "Likewise", "Also",
    "And", "But",
];

/// Files with lines of JSON or TOML that must stay whole.
const WHOLE_LINES: &[&str] = &[
    "grader/src/build/diagnostics.rs",
    "reference/tests/suite/cli.rs",
    "reference/tests/suite/course.rs",
    "reference/tests/suite/misconceptions.rs",
    "reference/tests/suite/paper.rs",
    "reference/tests/suite/vary.rs",
    "tests/src/performance/renderers.rs",
    "tests/tests/languages.rs",
];

/// Pages that a command writes.
const GENERATED: &[&str] = &[
    "docs/accuracy.md",
    "docs/cli.md",
    "docs/course.md",
    "docs/judging.md",
    "docs/performance.md",
    "docs/scene-format.md",
];

/// Returns the names and texts of the tracked files that end in `.ending`, without submissions and
/// the inputs of tests.
fn texts(ending: &str) -> Vec<(String, String)> {
    let is_ours = |path: &String| {
        // Submissions are not ours, and the tests of readers have files that are no text at all.
        let is_input = path.starts_with("cases/tests/") && ending != "rs";
        !path.starts_with("tests/submissions/")
            && !is_input
            && Path::new(path).extension().is_some_and(|found| found == ending)
    };
    let text = |path: String| {
        let text = std::fs::read_to_string(workspace().join(&path)).expect("a text");
        (name(Path::new(&path)), text)
    };
    tracked().into_iter().filter(is_ours).map(text).collect()
}

/// Returns the text of a comment line with the slashes before it.
fn comment(line: &str) -> Option<(&str, &str)> {
    let line = line.trim_start();
    let marker = ["///", "//!", "//"].into_iter().find(|marker| line.starts_with(marker))?;
    Some((marker, line[marker.len()..].trim_start()))
}

/// Returns `text` without its code spans.
fn prose(text: &str) -> String {
    text.split('`').step_by(2).collect::<Vec<_>>().join(" ")
}

/// Returns the first banned words in `text`, with what to write instead.
fn banned(text: &str) -> Option<(&'static str, &'static str)> {
    let letters = |c: char| if c.is_alphanumeric() || "-_".contains(c) { c } else { ' ' };
    let text: String = prose(text).to_lowercase().chars().map(letters).collect();
    let text = format!(" {} ", text.split_whitespace().collect::<Vec<_>>().join(" "));
    BANNED.iter().find_map(|(words, instead)| {
        let word = words.iter().find(|word| text.contains(&format!(" {word} ")))?;
        Some((*word, *instead))
    })
}

/// Returns the word that opens `text` and refers to a sentence before.
fn opening(text: &str) -> Option<&'static str> {
    OPENINGS.iter().copied().find(|word| {
        let rest = text.strip_prefix(word);
        rest.is_some_and(|rest| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '-'))
    })
}

/// The keys of cases and mutants whose values are sentences.
const SENTENCES: &[&str] = &["about", "does", "says", "title"];

/// Adds the sentences below `value`.
fn sentences(value: &toml::Value, found: &mut Vec<String>) {
    match value {
        toml::Value::Array(list) => list.iter().for_each(|value| sentences(value, found)),
        toml::Value::Table(table) => {
            for (key, value) in table {
                match value.as_str() {
                    Some(text) if SENTENCES.contains(&&**key) => found.push(text.to_owned()),
                    _ => sentences(value, found),
                }
            }
        }
        _ => {}
    }
}

/// Fails with all of `found`.
#[track_caller]
fn expect_none(found: &[String]) {
    assert!(found.is_empty(), "\n{}", found.join("\n"));
}

#[test]
fn lines_have_at_most_100_columns() {
    let mut long = Vec::new();
    for (file, text) in texts("rs").into_iter().filter(|(file, _)| !WHOLE_LINES.contains(&&**file))
    {
        let is_row = |line: &str| comment(line).is_some_and(|(_, text)| text.starts_with('|'));
        for (n, line) in text.lines().enumerate().filter(|(_, line)| !is_row(line)) {
            if line.chars().count() > MOST_COLUMNS {
                long.push(format!("{file}:{}: more than {MOST_COLUMNS} columns", n + 1));
            }
        }
    }
    expect_none(&long);
}

#[test]
fn paragraphs_of_documents_have_at_most_100_columns() {
    let is_whole = |line: &str| line.starts_with(['|', '<', ' ']) || line.contains("](");
    let mut long = Vec::new();
    for (file, text) in texts("md").into_iter().filter(|(file, _)| !GENERATED.contains(&&**file)) {
        let mut is_code = false;
        for (n, line) in text.lines().enumerate() {
            is_code ^= line.starts_with("```");
            if !is_code && !is_whole(line) && line.chars().count() > MOST_COLUMNS {
                long.push(format!("{file}:{}: more than {MOST_COLUMNS} columns", n + 1));
            }
        }
    }
    expect_none(&long);
}

#[test]
fn comments_use_the_words_of_the_field() {
    let mut found = Vec::new();
    for (file, text) in texts("rs") {
        let mut is_code = false;
        for (n, line) in text.lines().enumerate() {
            let Some((_, text)) = comment(line) else { continue };
            is_code ^= text.starts_with("```");
            if let Some((word, instead)) = banned(text).filter(|_| !is_code) {
                found.push(format!("{file}:{}: `{word}`; write {instead}", n + 1));
            }
        }
    }
    expect_none(&found);
}

#[test]
fn documents_use_the_words_of_the_field() {
    let mut found = Vec::new();
    for (file, text) in texts("md") {
        let mut is_code = false;
        for (n, line) in text.lines().enumerate() {
            is_code ^= line.starts_with("```");
            if let Some((word, instead)) = banned(line).filter(|_| !is_code) {
                found.push(format!("{file}:{}: `{word}`; write {instead}", n + 1));
            }
        }
    }
    expect_none(&found);
}

#[test]
fn doc_comments_open_with_a_subject_or_a_verb() {
    let mut found = Vec::new();
    for (file, text) in texts("rs") {
        let mut is_first = true;
        for (n, line) in text.lines().enumerate() {
            let doc = comment(line).filter(|(marker, _)| *marker != "//");
            if let Some((_, text)) = doc
                && is_first
                && let Some(word) = opening(text)
            {
                found.push(format!("{file}:{}: a doc comment opens with `{word}`", n + 1));
            }
            is_first = doc.is_none();
        }
    }
    expect_none(&found);
}

#[test]
fn words_and_openings_are_found() {
    assert_eq!(comment("    /// A ray."), Some(("///", "A ray.")));
    assert_eq!(comment("let a = 1; // one"), None);
    assert_eq!(banned("Where the ray MEETS it."), Some(("meets", "intersect, hit")));
    assert_eq!(banned("used in the  place of it"), Some(("in the place of", "instead of")));
    assert_eq!(banned("`meet` and a geometry of methods, an ask-fn, a/not_told"), None);
    assert_eq!(opening("As before."), Some("As"));
    assert_eq!(opening("The same over boxes."), Some("The same"));
    assert_eq!(opening("Asserts that it holds."), None);
    assert_eq!(opening("It's"), Some("It"));
}

#[test]
fn sentences_of_cases_use_the_words_of_the_field() {
    let mut wrong = Vec::new();
    for (file, text) in texts("toml") {
        let table: toml::Table = text.parse().unwrap_or_else(|why| panic!("{file}: {why}"));
        let mut found = Vec::new();
        sentences(&toml::Value::Table(table), &mut found);
        for text in found {
            if let Some((word, instead)) = banned(&text) {
                wrong.push(format!("{file}: `{word}`: write {instead}: {text}"));
            }
            let has_lines = text.trim_end().contains('\n');
            if has_lines && text.lines().any(|line| line.chars().count() > MOST_COLUMNS) {
                wrong.push(format!("{file}: more than {MOST_COLUMNS} columns: {text}"));
            }
        }
    }
    expect_none(&wrong);
}
