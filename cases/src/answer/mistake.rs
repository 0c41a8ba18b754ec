//! The known mistakes as the judge needs them: the text for a student who makes one.

use serde::{Deserialize, Serialize};

use super::Digest;

/// A known way to get a rule wrong, an item of the list `mistakes.answers.json` beside the stages.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "authoring", derive(schemars::JsonSchema))]
pub struct Mistake {
    /// Identifier, for example `mirror_backwards`; also the name of its pictures and answers.
    pub id: String,
    /// The rule that the mistake breaks.
    pub rule: u8,
    /// One sentence for the student that says what the program does.
    pub says: String,
    /// The student's function to look at, as `file.rs function`.
    pub look_at: String,
    /// The decision that the mistake takes wrongly, for example `mirror_weight`. A program makes at
    /// most one mistake of each decision, so two of them exclude each other.
    pub field: String,
}

/// The list in its stored form.
#[derive(Deserialize)]
struct Stored {
    made_from: Digest,
    mistakes: Vec<Mistake>,
}

/// Returns the text to store for the list: a JSON object with one mistake per line.
///
/// # Errors
/// An error of the JSON encoder.
pub fn mistakes_to_string(
    made_from: &Digest,
    mistakes: &[Mistake],
) -> Result<String, serde_json::Error> {
    Ok(format!("{{\"made_from\":\"{made_from}\",\"mistakes\":{}}}\n", lines(mistakes)?.trim_end()))
}

/// Parses a stored list. Returns the digest that it was made from, and the mistakes. Lists of an
/// older format have no digest; their digest is the default one, which makes them stale.
///
/// # Errors
/// A part that is missing or of the wrong kind, with line and column.
pub fn mistakes_from_str(text: &str) -> Result<(Digest, Vec<Mistake>), serde_json::Error> {
    if text.trim_start().starts_with('[') {
        return Ok((Digest::default(), serde_json::from_str(text)?));
    }
    let Stored { made_from, mistakes } = serde_json::from_str(text)?;
    Ok((made_from, mistakes))
}

/// Returns a JSON list with one item per line.
pub(super) fn lines<T: Serialize>(items: &[T]) -> Result<String, serde_json::Error> {
    let lines = items.iter().map(serde_json::to_string).collect::<Result<Vec<_>, _>>()?;
    Ok(format!("[\n{}\n]\n", lines.join(",\n")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Course;

    #[test]
    fn mistakes_come_back() {
        let says = "the \"mirror\" is turned".to_owned();
        let one = Mistake {
            id: "a_b".to_owned(),
            rule: 7,
            says,
            look_at: "reflection.rs reflect".to_owned(),
            field: "mirror".to_owned(),
        };
        let made_from = Digest::of_mistakes(&Course::default());
        let text = mistakes_to_string(&made_from, &[one.clone(), one.clone()]).unwrap();
        assert_eq!(mistakes_from_str(&text).unwrap(), (made_from, vec![one.clone(), one]));
        assert_eq!(text.lines().count(), 4);
        assert_eq!(mistakes_from_str("[]").unwrap(), (Digest::default(), vec![]));
        for broken in ["[{}]", "{}", "{\"mistakes\":[]}"] {
            assert!(mistakes_from_str(broken).is_err(), "{broken}");
        }
    }
}
