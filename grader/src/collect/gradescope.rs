//! Reads `submission_metadata.yml` of Gradescope's export: who handed in each folder, and when.
//!
//! The file is YAML that Ruby writes in one fixed form. Most of it is results and history, with
//! students' output in it, which no grade here depends on. This reader takes the few lines that it
//! needs by their indentation and their keys, skips the rest, and refuses any other form of these
//! lines:
//!
//! ```text
//! ---
//! submission_12345:
//!   :submitters:
//!   - :name: Ann Lee
//!     :sid: '0017'
//!     :email: ann@example.org
//!   :created_at: 2026-10-05 21:58:03.640434000 Z
//!   :results: …
//! ```

use std::collections::BTreeMap;
use std::ops::Range;

use cases::problem::Problems;

use super::hand_in::Claim;
use super::moment::{Clock, Moment};
use super::notes::{Notes, utf8};

/// What the metadata says about one hand-in.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Submission {
    /// The students, each of them a [`Claim::Person`].
    pub submitters: Vec<Claim>,
    /// The moment of the hand-in.
    pub created_at: Option<Moment>,
}

/// The name of the file.
pub const FILE: &str = "submission_metadata.yml";

/// Reads the metadata, which messages call `name`. Returns what it says by the name of the folder.
///
/// # Errors
/// All problems of the lines that are needed.
pub fn parse(name: &str, bytes: &[u8]) -> Result<BTreeMap<String, Submission>, Problems> {
    let (source, _) = utf8(name, bytes)?;
    let mut reader = Reader {
        found: BTreeMap::new(),
        current: None,
        section: Section::Other,
        notes: Notes::new(&source),
    };
    let mut at = 0;
    for line in source.text.split_inclusive('\n') {
        reader.line(line.trim_end_matches(['\n', '\r']), at);
        at += line.len();
    }
    let without: Vec<String> = reader
        .found
        .iter()
        // A part that could not be read is reported already.
        .filter(|_| reader.notes.is_empty())
        .filter(|(_, one)| one.created_at.is_none() || one.submitters.is_empty())
        .map(|(key, _)| key.clone())
        .collect();
    for key in without {
        let at = source.text.find(&format!("{key}:")).unwrap_or(0);
        let message = format!("`{key}` lacks `:submitters:` or `:created_at:`");
        reader.notes.add(at..at + key.len(), message, "download the export again");
    }
    reader.notes.finish(reader.found)
}

/// The part of a submission that a line belongs to.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Section {
    Submitters,
    Other,
}

struct Reader {
    found: BTreeMap<String, Submission>,
    current: Option<String>,
    section: Section,
    notes: Notes,
}

/// The indentation of the keys of a submission.
const INDENT: usize = 2;

impl Reader {
    /// Reads a line that begins at the byte `at` of the file.
    fn line(&mut self, line: &str, at: usize) {
        let content = line.trim_start_matches(' ');
        let indent = line.len() - content.len();
        let at = at + indent;
        let span = at..at + content.len();
        match indent {
            _ if content.is_empty() => {}
            0 if matches!(content, "---" | "--- {}" | "...") => {}
            0 => self.submission(content, span),
            INDENT if !content.starts_with("- ") => self.key(content, span),
            _ if self.section == Section::Submitters => self.submitter(content, at),
            _ => {}
        }
    }

    fn submission(&mut self, content: &str, span: Range<usize>) {
        self.section = Section::Other;
        self.current = None;
        let key = content.strip_suffix(':').filter(|key| {
            !key.is_empty() && key.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
        });
        let Some(key) = key else {
            let help = "a line without indentation names a folder: `submission_12345:`";
            self.notes.add(span, "this is no metadata of Gradescope", help);
            return;
        };
        if self.found.insert(key.to_owned(), Submission::default()).is_some() {
            self.notes.add(span, format!("`{key}` occurs twice"), "download the export again");
        }
        self.current = Some(key.to_owned());
    }

    fn key(&mut self, content: &str, span: Range<usize>) {
        self.section = Section::Other;
        let Some(one) = self.current.as_ref().and_then(|key| self.found.get_mut(key)) else {
            return;
        };
        if let Some(rest) = content.strip_prefix(":submitters:") {
            self.section = Section::Submitters;
            if !matches!(rest.trim(), "" | "[]") {
                let help = "the submitters follow, one to a line with `- `";
                self.notes.add(span, "the list of submitters has another form", help);
            }
        } else if let Some(rest) = content.strip_prefix(":created_at:") {
            one.created_at = Clock::parse(rest.trim()).map(|clock| clock.moment);
            if one.created_at.is_none() {
                let help = "such as `2026-10-05 21:58:03 Z`";
                self.notes.add(span, "this is no moment", help);
            }
        }
    }

    fn submitter(&mut self, content: &str, at: usize) {
        let Some(one) = self.current.as_ref().and_then(|key| self.found.get_mut(key)) else {
            return;
        };
        let field = content.strip_prefix("- ").unwrap_or(content);
        if content.starts_with("- ") {
            let (id, email, name) = (String::new(), String::new(), String::new());
            one.submitters.push(Claim::Person { id, email, name });
        }
        let start = at + content.len() - field.len();
        let split = field.strip_prefix(':').and_then(|rest| rest.split_once(':'));
        let (Some((key, value)), Some(Claim::Person { id, email, name })) =
            (split, one.submitters.last_mut())
        else {
            let help = "each line is a key and a value: `:email: ann@example.org`";
            self.notes.add(start..at + content.len(), "this is no line of a submitter", help);
            return;
        };
        let into = match key {
            "name" => name,
            "sid" => id,
            "email" => email,
            _ => return,
        };
        match scalar(value.trim()) {
            Some(text) => *into = text.trim().to_owned(),
            None => {
                let help = "write it in one line, plain or in quotes";
                self.notes.add(start..at + content.len(), "this value cannot be read", help);
            }
        }
    }
}

/// Returns the value of a plain or quoted scalar in one line; `None` for any other form.
fn scalar(text: &str) -> Option<String> {
    match text.chars().next() {
        None => Some(String::new()),
        Some('\'') => {
            let inner = text.strip_prefix('\'')?.strip_suffix('\'')?;
            let plain = inner.replace("''", "\u{0}");
            (!plain.contains('\'')).then(|| plain.replace('\u{0}', "'"))
        }
        Some('"') => double_quoted(text.strip_prefix('"')?),
        Some('&' | '*' | '!' | '|' | '>' | '[' | '{' | '%' | '@' | '`') => None,
        Some(_) if matches!(text, "~" | "null") => Some(String::new()),
        Some(_) => Some(text.split(" #").next().unwrap_or_default().to_owned()),
    }
}

/// Returns the text up to the closing quote, which has to be the last character.
fn double_quoted(text: &str) -> Option<String> {
    let mut out = String::new();
    let mut rest = text.chars();
    loop {
        match rest.next()? {
            '"' => return rest.as_str().is_empty().then_some(out),
            '\\' => {
                let escape = rest.next()?;
                out.push(match escape {
                    'n' => '\n',
                    't' => '\t',
                    'r' => '\r',
                    'e' => '\u{1b}',
                    '0' => '\0',
                    'a' => '\u{7}',
                    'b' => '\u{8}',
                    'v' => '\u{b}',
                    'f' => '\u{c}',
                    'N' => '\u{85}',
                    '_' => '\u{a0}',
                    'L' => '\u{2028}',
                    'P' => '\u{2029}',
                    'x' | 'u' | 'U' => {
                        let n_digits = match escape {
                            'x' => 2,
                            'u' => 4,
                            _ => 8,
                        };
                        let (digits, behind) = rest.as_str().split_at_checked(n_digits)?;
                        rest = behind.chars();
                        char::from_u32(u32::from_str_radix(digits, 16).ok()?)?
                    }
                    '"' | '\\' | '/' | ' ' => escape,
                    _ => return None,
                });
            }
            c => out.push(c),
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const GOOD: &str = "---
submission_11:
  :submitters:
  - :name: Ann Lee
    :sid: '0017'
    :email: ann@example.org
  - :name: \"Zo\\u00eb: O'Hara\"
    :sid:
    :email: zoe@example.org # a comment
  :created_at: 2020-09-20 03:29:23.640434000 Z
  :score: 10.0
  :results:
    tests:
    - name: x
      output: |
        submission_99:
          :submitters:

        :created_at: never
  :history:
  - :id: 10
    :created_at: 2020-09-19 03:29:23.640434000 Z
submission_12:
  :created_at: 2020-09-20 03:29:24 Z
  :submitters:
    - :name: 'Bo ''B'' Day'
      :sid: 18
";

    fn person(id: &str, email: &str, name: &str) -> Claim {
        Claim::Person { id: id.to_owned(), email: email.to_owned(), name: name.to_owned() }
    }

    #[test]
    fn submitters_and_times_are_found_among_results() {
        let found = parse(FILE, GOOD.as_bytes()).unwrap_or_else(|why| panic!("{why}"));
        assert_eq!(found.keys().collect::<Vec<_>>(), ["submission_11", "submission_12"]);
        let first = &found["submission_11"];
        assert_eq!(
            first.submitters,
            [
                person("0017", "ann@example.org", "Ann Lee"),
                person("", "zoe@example.org", "Zoë: O'Hara"),
            ]
        );
        assert_eq!(first.created_at, Some(Moment { unix_s: 1_600_572_563 }));
        assert_eq!(found["submission_12"].submitters, [person("18", "", "Bo 'B' Day")]);
        assert_eq!(parse(FILE, b"--- {}\n"), Ok(BTreeMap::new()));
    }

    #[test]
    fn other_forms_are_refused_with_their_places() {
        for (old, new, place, words) in [
            ("2020-09-20 03:29:24 Z", "yesterday", (24, 3), "no moment"),
            ("'0017'", "*1", (5, 5), "cannot be read"),
            ("'0017'", "\"0017", (5, 5), "cannot be read"),
            ("submission_12:", "submission_11:", (23, 1), "occurs twice"),
            ("submission_12:", "{a: b}", (23, 1), "no metadata of Gradescope"),
            ("    - :name: 'Bo ''B'' Day'\n      :sid: 18\n", "", (23, 1), "lacks"),
            ("    :email: ann@example.org", "    Lee", (6, 5), "no line of a submitter"),
        ] {
            let text = GOOD.replace(old, new);
            assert_ne!(text, GOOD, "{old}");
            let problems = parse(FILE, text.as_bytes()).expect_err(old);
            let found = problems.iter().find(|one| one.message.contains(words));
            let found = found.unwrap_or_else(|| panic!("{old}: {problems}"));
            assert_eq!(found.line_column(), Some(place), "{problems}");
        }
    }

    #[test]
    fn scalars_are_read_as_ruby_writes_them() {
        for (text, expected) in [
            ("a b", Some("a b")),
            ("'a'", Some("a")),
            ("'it''s'", Some("it's")),
            ("''", Some("")),
            ("\"a\\\"b\\x41\\u00e9\"", Some("a\"bAé")),
            ("~", Some("")),
            ("'", None),
            ("'a'b'", None),
            ("\"a\" b", None),
            ("\"\\ud800\"", None),
            ("\"\\q\"", None),
            ("\"\\u00", None),
            ("|", None),
            ("[a]", None),
        ] {
            assert_eq!(scalar(text).as_deref(), expected, "{text}");
        }
    }

    proptest! {
        #[test]
        fn any_text_is_read_or_refused(
            text in "(submission_1:|  |- |:submitters:|:name:|:created_at:|\n|\"|'|é|x){0,40}",
        ) {
            let _ = parse(FILE, text.as_bytes());
        }
    }
}
