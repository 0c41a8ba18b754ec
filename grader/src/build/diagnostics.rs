//! Parses the JSON messages of rustc.

use serde::Deserialize;

use crate::plain;

/// Largest number of characters that are kept of one message.
const MAX_MESSAGE: usize = 8 << 10;
/// Largest size in bytes of the text of all errors, unless the first error alone is larger.
const MAX_ERRORS: usize = 16 << 10;
/// Largest number of warnings that are kept.
const MAX_WARNINGS: usize = 30;
/// Largest size in bytes of the text of all warnings.
const MAX_WARNINGS_TEXT: usize = 16 << 10;

/// The messages as rustc renders them for a terminal without colour.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Diagnostics {
    pub(super) errors: Vec<String>,
    pub(super) warnings: Vec<String>,
}

#[derive(Deserialize)]
struct Message {
    level: String,
    message: String,
    rendered: Option<String>,
}

/// Reads one message per line. Lines that are no messages are left out, and so are the closing
/// counts.
pub(super) fn parse(stderr: &[u8]) -> Diagnostics {
    let mut said = Diagnostics::default();
    for line in stderr.split(|byte| *byte == b'\n') {
        let Ok(message) = serde_json::from_slice::<Message>(line) else { continue };
        let text = plain::shown(&start(message.rendered.unwrap_or(message.message).trim_end()));
        match message.level.as_str() {
            _ if is_count(&text) => {}
            "warning" if said.has_room_for(&text) => said.warnings.push(text),
            level if level.starts_with("error") => said.errors.push(text),
            _ => {}
        }
    }
    said
}

/// Returns the beginning of a message, which may quote a whole file.
fn start(message: &str) -> String {
    let start: String = message.chars().take(MAX_MESSAGE).collect();
    if start.len() < message.len() { start + " […]" } else { start }
}

fn is_count(text: &str) -> bool {
    text.starts_with("error: aborting due to")
        || text.ends_with("warning emitted")
        || text.ends_with("warnings emitted")
}

impl Diagnostics {
    fn has_room_for(&self, warning: &str) -> bool {
        let bytes: usize = self.warnings.iter().map(String::len).sum();
        self.warnings.len() < MAX_WARNINGS && bytes + warning.len() <= MAX_WARNINGS_TEXT
    }

    /// Returns the errors one below the other, cut at a limit, with the number of the rest.
    pub(super) fn errors_text(&self) -> String {
        let mut text = String::new();
        for (n, error) in self.errors.iter().enumerate() {
            if n > 0 && text.len() + error.len() > MAX_ERRORS {
                text += &format!("and {} more errors\n", self.errors.len() - n);
                break;
            }
            text += error;
            text += "\n\n";
        }
        text.trim_end().to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tells_errors_warnings_and_counts_apart() {
        let lines = r#"{"level":"warning","message":"w","rendered":"warning: unused\n"}
{"level":"error","message":"e","rendered":"error[E0308]: mismatched\n --> src/sphere.rs:1:2\n"}
no json
{"level":"error","message":"x","rendered":"error: aborting due to 1 previous error; 1 warning emitted\n\n"}"#;
        let said = parse(lines.as_bytes());
        assert_eq!(said.warnings, ["warning: unused"]);
        assert_eq!(said.errors_text(), "error[E0308]: mismatched\n --> src/sphere.rs:1:2");
    }

    #[test]
    fn a_flood_of_errors_is_cut_with_its_number() {
        let error = "e".repeat(1000);
        let said = Diagnostics { errors: vec![error; 100], warnings: vec![] };
        assert!(said.errors_text().len() < MAX_ERRORS + 2000);
        assert!(said.errors_text().ends_with("and 84 more errors"), "{}", said.errors_text());
        let huge = format!(r#"{{"level":"error","message":"{}"}}"#, "e".repeat(1 << 20));
        assert!(parse(huge.as_bytes()).errors_text().len() < MAX_ERRORS, "one message is cut too");
    }
}
