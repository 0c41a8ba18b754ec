//! Splits sources of any usual language into tokens, without names, comments and white space.

/// A token: a word of a language or a sign as it is, and one value for each of the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Token {
    /// A name. Names are what a copy changes first.
    Name,
    /// A number, by its hash.
    Number(u64),
    /// A text in quotes.
    Text,
    /// Any other character.
    Sign(char),
}

/// Returns the tokens of `source`.
///
/// Comments are those that begin with `//` or `/*`, and lines that begin with `#`: comments in
/// Python, and directives in C, which nearly all programs share.
pub(super) fn tokens(source: &str) -> Vec<Token> {
    let mut rest = source;
    let mut tokens = vec![];
    let mut is_line_start = true;
    while let Some(first) = rest.chars().next() {
        let length = match first {
            _ if rest.starts_with("//") || (first == '#' && is_line_start) => line(rest),
            _ if rest.starts_with("/*") => rest.find("*/").map_or(rest.len(), |end| end + 2),
            _ if first.is_whitespace() => first.len_utf8(),
            '"' => {
                tokens.push(Token::Text);
                quoted(rest)
            }
            _ if first.is_ascii_digit() => {
                let length = while_in(rest, |c| c.is_alphanumeric() || c == '_' || c == '.');
                tokens.push(Token::Number(hash(&rest[..length])));
                length
            }
            _ if first.is_alphabetic() || first == '_' => {
                tokens.push(Token::Name);
                while_in(rest, |c| c.is_alphanumeric() || c == '_')
            }
            _ => {
                tokens.push(Token::Sign(first));
                first.len_utf8()
            }
        };
        is_line_start = first == '\n' || (is_line_start && first.is_whitespace());
        rest = &rest[length..];
    }
    tokens
}

fn line(rest: &str) -> usize {
    rest.find('\n').unwrap_or(rest.len())
}

/// Returns the length of a text in quotes, at most to the end of `rest`.
fn quoted(rest: &str) -> usize {
    let mut is_escaped = false;
    for (at, c) in rest.char_indices().skip(1) {
        match c {
            '"' if !is_escaped => return at + 1,
            c => is_escaped = c == '\\' && !is_escaped,
        }
    }
    rest.len()
}

fn while_in(rest: &str, is_in: impl Fn(char) -> bool) -> usize {
    rest.find(|c| !is_in(c)).unwrap_or(rest.len())
}

/// Returns a hash of the bytes of `text` that is the same on every machine.
fn hash(text: &str) -> u64 {
    text.bytes().fold(START, |hash, byte| mix(hash, byte.into()))
}

/// The first value and the factor of the hash FNV-1a. No one gains by making two sequences collide.
pub(super) const START: u64 = 0xcbf2_9ce4_8422_2325;
const FACTOR: u64 = 0x0100_0000_01b3;

pub(super) fn mix(hash: u64, value: u64) -> u64 {
    (hash ^ value).wrapping_mul(FACTOR)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_comments_and_white_space_do_not_count() {
        let expected = tokens("let x=2.5*f(y);");
        assert_eq!(expected.len(), 10);
        for other in [
            "let  radius = 2.5 * g ( b ) ;\n",
            "// a comment\nlet x /* two\nlines */ = 2.5*f(y);",
            "#include <stdio.h>\n  # a comment\nlet x=2.5*f(y);",
        ] {
            assert_eq!(tokens(other), expected, "{other}");
        }
        assert_ne!(tokens("let x=2.4*f(y);"), expected, "numbers count");
        assert_ne!(tokens("let x=2.5/f(y);"), expected, "signs count");
    }

    #[test]
    fn no_text_is_too_odd() {
        assert_eq!(tokens("\"a \\\" b\" c"), [Token::Text, Token::Name]);
        for odd in ["", "\"", "\"\\", "/*", "//", "#", "é\u{301}\u{1F600}", "'a", "0x1F.e"] {
            assert!(tokens(odd).len() < 5, "{odd}");
        }
    }
}
