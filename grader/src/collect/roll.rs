//! The roll of a class: a row for each student, with the points and what they became by lateness.
//! Stored beside the table, so that the platforms' files can be filled later.

use serde::{Deserialize, Serialize};

/// The version of the stored form.
pub const SCHEMA: u32 = 1;

/// The students of a class with their points, and what a person has to decide.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Roll {
    /// The version, [`SCHEMA`].
    pub schema: u32,
    /// The deadline on the clock of the course; `None` without a policy.
    pub deadline: Option<String>,
    /// A row for each student, in the order of the roster.
    pub members: Vec<Member>,
    /// What a person has to decide.
    pub decisions: Vec<Decision>,
    /// Hand-ins of students that do not count, because another one does.
    pub not_counted: Vec<NotCounted>,
}

/// A student of the class. All points are in thousandths.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Member {
    /// The id of the student.
    pub id: String,
    /// The name.
    pub name: String,
    /// The e-mail address.
    pub email: String,
    /// The platform's id or login.
    pub account: String,
    /// The section.
    pub section: String,
    /// The group.
    pub group: String,
    /// What is known about the hand-in.
    pub standing: Standing,
    /// The id of the submission that counts.
    pub submission: Option<String>,
    /// The points that it earned.
    pub earned: Option<u64>,
    /// The points that it could earn.
    pub possible: Option<u64>,
    /// The moment of the hand-in, on the clock of the course.
    pub handed_in: Option<String>,
    /// Seconds after the student's deadline; `None` if that is not known or if there is no policy.
    pub late_s: Option<u64>,
    /// The deduction; `None` if there is no policy, or no total yet.
    pub deduction: Option<u64>,
    /// The points after the deduction; `None` if a person has to decide first.
    pub total: Option<u64>,
}

/// What is known about the hand-in of a student.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Standing {
    /// One hand-in counts, and has a record.
    Graded,
    /// The grader or the machine failed at the hand-in.
    NotGraded,
    /// A person has to decide which hand-in counts.
    Undecided,
    /// Nothing was handed in.
    #[default]
    Nothing,
}

impl Standing {
    /// Returns the words of reports.
    pub fn words(self) -> &'static str {
        match self {
            Self::Graded => "graded",
            Self::NotGraded => "not graded",
            Self::Undecided => "to be decided",
            Self::Nothing => "nothing handed in",
        }
    }
}

/// A question for a person.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Decision {
    /// The hand-ins in question, by the names of their files.
    pub hand_ins: Vec<String>,
    /// The ids of the students in question.
    pub students: Vec<String>,
    /// The question.
    pub why: String,
}

/// A hand-in that does not count, because another one does.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct NotCounted {
    /// The name of its file.
    pub hand_in: String,
    /// The ids of its students.
    pub students: Vec<String>,
    /// The reason.
    pub why: String,
}
