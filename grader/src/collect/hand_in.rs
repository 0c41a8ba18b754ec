//! A hand-in as a platform exports it, and what the export says about its students.

use super::moment::Moment;

/// A hand-in: a file or folder of an export.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct HandIn {
    /// The name of the file or folder.
    pub name: String,
    /// The students of the hand-in, as the export names them. Empty if the export names none.
    pub claims: Vec<Claim>,
    /// The moment of the hand-in, if the export has it.
    pub handed_in: Option<Moment>,
    /// The mark of the platform on its lateness.
    pub mark: Mark,
    /// The student's name for the file, without the number of the attempt and without its ending.
    pub stem: String,
    /// The number of the attempt, from 0, in the files of one stem.
    pub attempt: u32,
    /// Whether it is a folder or an archive, and not a single file.
    pub is_whole: bool,
}

/// A mark of a platform on the lateness of a hand-in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// The platform marks no hand-ins.
    None,
    /// The platform marks late hand-ins, and not this one.
    InTime,
    /// The platform marks this hand-in as late.
    Late,
}

/// What an export says about one student of a hand-in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Claim {
    /// The ids that the institution and the mail system give, and the name, as Gradescope has them.
    Person {
        /// The id; empty if there is none.
        id: String,
        /// The e-mail address; empty if there is none.
        email: String,
        /// The full name.
        name: String,
    },
    /// The platform's own number, and a name.
    Numbered {
        /// The number.
        account: String,
        /// The name.
        name: String,
        /// Whether the name has lost its spaces and may begin with the last name, as Canvas
        /// writes it.
        is_squeezed: bool,
    },
    /// The platform's login.
    Account(String),
    /// The name of a file, which can be an id, a login, an e-mail address, a name or a group.
    Any(String),
}

impl Claim {
    /// Returns the text for people.
    pub fn shown(&self) -> String {
        match self {
            Self::Person { id, email, name } => {
                let parts = [name, id, email].into_iter().filter(|part| !part.is_empty());
                parts.map(String::as_str).collect::<Vec<_>>().join(", ")
            }
            Self::Numbered { account, name, .. } => format!("{name}, {account}"),
            Self::Account(text) | Self::Any(text) => text.clone(),
        }
    }
}
