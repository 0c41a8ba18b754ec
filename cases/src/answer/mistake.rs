//! The known mistakes, as far as the judge needs them: what to say to a student who makes one.

use serde::{Deserialize, Serialize};

/// A known way to get a rule wrong, one of the list stored as `mistakes.answers.json` beside the stages.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "authoring", derive(schemars::JsonSchema))]
pub struct Mistake {
    /// Such as `mirror_backwards`; the name of its pictures and answers.
    pub id: String,
    /// The rule it breaks.
    pub rule: u8,
    /// What the program does, for the student, in one sentence.
    pub says: String,
    /// The student's function to look at, as `file.rs function`.
    pub look_at: String,
}

/// The text to store for them: a JSON list, a mistake a line.
///
/// # Errors
/// What the encoder says.
pub fn mistakes_to_string(mistakes: &[Mistake]) -> Result<String, serde_json::Error> {
    lines(mistakes)
}

/// The mistakes that `text` holds.
///
/// # Errors
/// What is missing or of the wrong kind, with line and column.
pub fn mistakes_from_str(text: &str) -> Result<Vec<Mistake>, serde_json::Error> {
    serde_json::from_str(text)
}

/// A JSON list, an item a line.
pub(super) fn lines<T: Serialize>(items: &[T]) -> Result<String, serde_json::Error> {
    let lines = items.iter().map(serde_json::to_string).collect::<Result<Vec<_>, _>>()?;
    Ok(format!("[\n{}\n]\n", lines.join(",\n")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mistakes_come_back() {
        let says = "the \"mirror\" is turned".to_owned();
        let one = Mistake { id: "a_b".to_owned(), rule: 7, says, look_at: "reflection.rs reflect".to_owned() };
        let text = mistakes_to_string(&[one.clone(), one.clone()]).unwrap();
        assert_eq!(mistakes_from_str(&text).unwrap(), [one.clone(), one]);
        assert!(mistakes_from_str("[{}]").is_err());
    }
}
