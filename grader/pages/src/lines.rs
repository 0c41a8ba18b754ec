//! Lines of text fitted to a width.

use terminal_size::{Width, terminal_size_of};
use textwrap::{Options, WordSplitter};

/// The columns of an output that is not a terminal.
const UNKNOWN: usize = 100;
/// The least width. In a narrower one, text would have more breaks than words.
const LEAST: usize = 40;

/// Returns the width of the terminal on the output stream in columns, at least 40, or 100 if the
/// stream is not a terminal.
pub fn columns() -> usize {
    terminal_size_of(std::io::stdout())
        .map_or(UNKNOWN, |(Width(columns), _)| usize::from(columns).max(LEAST))
}

/// Returns `text` with every line that is wider than `columns` broken between words.
///
/// Continuation lines are indented four columns deeper than the first line. A word that is wider
/// than a line is broken as well. Escape codes for colour take no columns; a tab becomes four
/// spaces.
pub fn folded(text: &str, columns: usize) -> String {
    let mut out = String::with_capacity(text.len());
    for line in text.split_inclusive('\n') {
        let (line, end) = line.strip_suffix('\n').map_or((line, ""), |line| (line, "\n"));
        fold(line, columns, &mut out);
        out.push_str(end);
    }
    out
}

fn fold(line: &str, columns: usize, out: &mut String) {
    let line = line.replace('\t', "    ");
    if textwrap::core::display_width(&line) <= columns {
        out.push_str(&line);
        return;
    }
    let words = line.trim_start_matches(' ');
    // A deep indent would leave no room for words.
    let indent = " ".repeat((line.len() - words.len()).min(columns / 2));
    let deeper = format!("{indent}    ");
    let options = Options::new(columns).word_splitter(WordSplitter::NoHyphenation);
    let options = options.initial_indent(&indent).subsequent_indent(&deeper);
    out.push_str(&textwrap::fill(words, options));
}

/// Returns `word` in the plural unless `n` is 1, with the number before it.
pub fn count(n: usize, word: &str) -> String {
    if n == 1 { format!("1 {word}") } else { format!("{n} {word}s") }
}

/// Returns names for a message, such as `` `a`, `b` and 5 more ``: at most `most` names, then the
/// number of the others.
pub fn some<'a>(names: impl IntoIterator<Item = &'a str>, most: usize) -> String {
    let names: Vec<String> = names.into_iter().map(|name| format!("`{name}`")).collect();
    match names.len() {
        0 => "none".to_owned(),
        1 => names.concat(),
        n if n <= most => format!("{} and {}", names[..n - 1].join(", "), names[n - 1]),
        n => format!("{} and {} more", names[..most].join(", "), n - most),
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn long_lines_are_broken_between_words_and_indented() {
        let table = [
            ("short\n\n  too\n", "short\n\n  too\n"),
            (
                "  one two three four five six seven\n",
                "  one two three four\n      five six seven\n",
            ),
            ("aaaaaaaaaaaaaaaaaaaaaaaaaaaaaa", "aaaaaaaaaaaaaaaa\n    aaaaaaaaaaaaaa"),
            ("\u{1b}[31mone two three four\u{1b}[0m", "\u{1b}[31mone two three four\u{1b}[0m"),
            ("光光光光光光光光光光光", "光光光光光光光光\n    光光光"),
            ("a --html b --html c --html", "a --html b --html c\n    --html"),
        ];
        for (text, expected) in table {
            assert_eq!(folded(text, 20), expected, "{text:?}");
        }
    }

    proptest! {
        #[test]
        fn no_line_is_wider_and_no_letter_is_lost(
            text in "[ a-z:#\\[\n\u{1b}m光é-]{0,200}",
            columns in 40..120usize,
        ) {
            let out = folded(&text, columns);
            let is_wide = |line: &str| textwrap::core::display_width(line) > columns;
            prop_assert!(!out.lines().any(is_wide), "{out}");
            let letters = |text: &str| -> String {
                text.chars().filter(|c| !c.is_whitespace()).collect()
            };
            prop_assert_eq!(letters(&out), letters(&text));
        }
    }

    #[test]
    fn lists_are_short() {
        let table = [(&[][..], "none"), (&["a"], "`a`"), (&["a", "b"], "`a` and `b`")];
        for (names, text) in table {
            assert_eq!(some(names.iter().copied(), 3), text);
        }
        assert_eq!(some(["a", "b", "c"], 3), "`a`, `b` and `c`");
        assert_eq!(some(["a", "b", "c", "d", "e"], 3), "`a`, `b`, `c` and 2 more");
        assert_eq!(
            (count(1, "check"), count(0, "check")),
            ("1 check".to_owned(), "0 checks".to_owned())
        );
    }
}
