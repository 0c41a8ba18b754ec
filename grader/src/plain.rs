//! Text of others, made harmless to show: nothing in it can move a cursor, turn the reading direction or hide itself.

/// `text` with every character that does not show as itself written as its code, such as `\u{202e}`. Line breaks and
/// tabs stay; what leaves the page to a terminal or a browser still has to be quoted for it.
pub fn shown(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        if is_hidden(c) && c != '\n' && c != '\t' { out.extend(c.escape_unicode()) } else { out.push(c) }
    }
    out
}

/// Like [`shown`], in one line, of bytes that need not be UTF-8, and cut after 100 characters: for names in messages.
pub fn name(bytes: &[u8]) -> String {
    let text = String::from_utf8_lossy(bytes);
    let short: String = text.chars().take(100).collect();
    let cut = if short.len() < text.len() { "…" } else { "" };
    shown(&short).replace(['\n', '\t'], " ") + cut
}

/// Whether `c` is a control character, a mark of reading direction, or takes no room.
pub fn is_hidden(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{ad}' | '\u{61c}' | '\u{180e}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}')
        || matches!(c, '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{fff9}'..='\u{fffb}' | '\u{e0000}'..='\u{e007f}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_would_not_show_is_spelt_out() {
        assert_eq!(shown("a\u{1b}[2Jb\n\tc"), "a\\u{1b}[2Jb\n\tc");
        assert_eq!(shown("src/\u{202e}sr.niam"), "src/\\u{202e}sr.niam");
        assert_eq!(shown("Zoë 光 ²"), "Zoë 光 ²");
    }

    #[test]
    fn names_are_one_short_line() {
        assert_eq!(name(b"a\nb\xff"), "a b\u{fffd}");
        assert_eq!(name("é".repeat(300).as_bytes()), "é".repeat(100) + "…");
    }
}
