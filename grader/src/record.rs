//! The grade record: the versioned truth behind every report. Reports decide nothing; they only
//! show what stands here.

use cases::answer::Mistake;
use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde::{Deserialize, Serialize};

use crate::plain;

/// The version of this record's form.
pub const SCHEMA: u32 = 3;

/// All there is to say about one submission.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Record {
    /// [`SCHEMA`].
    pub schema: u32,
    /// Version of the grader.
    pub grader: String,
    /// Hash of everything else that a score depends on: cases, answers, limits, grader, toolchain.
    pub epoch: String,
    /// Whether the user stopped the grader before everything was run. The score is then not final.
    pub interrupted: bool,
    /// What was graded.
    pub submission: Submission,
    /// The layers of protection that were in force, such as `timeouts+rlimits`.
    pub sandbox: String,
    /// What happened before any case ran: the build, and what of the submission was left aside.
    pub build: Build,
    /// The sum over the stages.
    pub score: Score,
    /// The known mistakes that explain what is wrong, the one that explains most first. Mostly one
    /// or none.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub diagnoses: Vec<Diagnosis>,
    /// Stages in order.
    pub stages: Vec<StageRecord>,
}

impl Record {
    /// Returns the record as JSON for people and programs, ended by a line break.
    ///
    /// Text of a submission in it is harmless to print ([`plain::json`]); its value is unchanged.
    pub fn to_json(&self) -> String {
        let text = serde_json::to_string_pretty(self)
            .expect("a record has string keys and no part that fails");
        plain::json(&text) + "\n"
    }
}

/// Returns the JSON Schema (2020-12) of a record of version [`SCHEMA`].
pub fn schema() -> serde_json::Value {
    let mut schema =
        SchemaSettings::draft2020_12().into_generator().into_root_schema_for::<Record>();
    schema.insert("title".to_owned(), "A grade record".into());
    schema.insert("$id".to_owned(), format!("grade-record.{SCHEMA}.schema.json").into());
    schema.ensure_object()["properties"]["schema"]["const"] = SCHEMA.into();
    schema.to_value()
}

/// A known mistake that explains some of what is wrong.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Diagnosis {
    /// The mistake; several where what was asked does not tell them apart.
    pub mistakes: Vec<Mistake>,
    /// Ids of the cases and checks that it explains.
    pub explains: Vec<String>,
}

/// What was graded.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Submission {
    /// As it was given.
    pub path: String,
    /// Hash of the files that count.
    pub digest: String,
}

/// How the program came about.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Build {
    /// Pass, Fail, or Ours.
    pub verdict: Verdict,
    /// What went wrong, if anything did.
    pub finding: Option<Finding>,
    /// The compiler's warnings, as it wrote them; cut at a limit.
    pub warnings: Vec<String>,
    /// What of the submission was left aside, and why: a `build.rs`, a changed manifest, an unknown
    /// file.
    pub ignored: Vec<String>,
    /// Seconds; 0 where a stored build was taken.
    pub time_s: f64,
}

/// Thousandths of a point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Score {
    /// What was earned.
    pub earned: u64,
    /// What could have been.
    pub possible: u64,
}

/// One stage of the assignment.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct StageRecord {
    /// Such as `02_shadows`.
    pub id: String,
    /// One line for people.
    pub title: String,
    /// Thousandths of a point.
    pub earned: u64,
    /// Thousandths of a point.
    pub possible: u64,
    /// Image cases first, then unit checks.
    pub checks: Vec<CheckRecord>,
    /// What is worth saying but costs nothing, such as text on standard output that is no answer.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub remarks: Vec<String>,
}

/// One image case or unit check.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CheckRecord {
    /// Such as `02_shadows/two_balls`.
    pub id: String,
    /// What kind it is.
    pub kind: CheckKind,
    /// What it tests, for people.
    pub about: String,
    /// The rules of light it tests.
    pub rules: Vec<u8>,
    /// What it comes to.
    pub verdict: Verdict,
    /// Thousandths of a point.
    pub earned: u64,
    /// Thousandths of a point.
    pub possible: u64,
    /// What was found wrong, if anything was; also remarks on a pass.
    pub finding: Option<Finding>,
    /// Wall time of the program, in seconds; unit checks of a stage share one process and its time.
    pub time_s: f64,
    /// CPU time of the program, in seconds; missing where nothing was run.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub cpu_s: Option<f64>,
    /// Largest resident size of the program.
    pub peak_bytes: u64,
}

/// The kinds of check.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CheckKind {
    /// A picture.
    Image,
    /// A question to a function.
    Unit,
}

/// What a finding means.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// All points.
    Pass,
    /// Some points.
    Partial,
    /// The program was asked and is wrong, or failed.
    Fail,
    /// The program could not be asked; the finding says because of what.
    NotRun,
    /// The grader or the machine failed; costs nothing.
    Ours,
}

impl Finding {
    /// A finding of words alone.
    pub fn new(kind: FindingKind, message: impl Into<String>) -> Self {
        Self {
            kind,
            message: message.into(),
            wrong_pixels: None,
            wrong_contested: None,
            largest_cluster: None,
            share: None,
            worst: None,
            asked: None,
            expected: None,
            actual: None,
            diagnosis: None,
            stderr: None,
        }
    }
}

/// What was found, in plain words and in numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Finding {
    /// Which kind of thing it is.
    pub kind: FindingKind,
    /// What happened, in a sentence or a few, for the student.
    pub message: String,
    /// Pixels out of tolerance, for a picture.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub wrong_pixels: Option<u64>,
    /// Those of them on which right tracers differ too.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub wrong_contested: Option<u64>,
    /// Most of the wrong pixels that lie side by side, corners included.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub largest_cluster: Option<u64>,
    /// The part of its points that a picture earns that is not right, in thousandths.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub share: Option<u32>,
    /// The pixel farthest out: column from the left, row from the top.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub worst: Option<[u32; 2]>,
    /// What was asked, for a unit check: the question as the program got it.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub asked: Option<serde_json::Value>,
    /// The right answer of a unit check, as lines of text.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub expected: Option<String>,
    /// The program's answer, as lines of text.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub actual: Option<String>,
    /// Id of the known mistake that explains it; it stands among the record's diagnoses.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub diagnosis: Option<String>,
    /// What the program wrote on its error stream last; cut at a limit.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub stderr: Option<String>,
}

/// The kinds of finding.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "snake_case")]
pub enum FindingKind {
    /// A right answer was due and another came.
    Wrong,
    /// The picture is anti-aliased: several rays a pixel where one was due.
    Antialiased,
    /// All pixels that differ are such on which right tracers differ: it counts as right, and a
    /// person should look at it.
    Contested,
    /// The program ended with a signal, a panic, or a code other than 0.
    Crash,
    /// It ran longer than it may, by the clock or by CPU time.
    Timeout,
    /// It took more memory than it may.
    Memory,
    /// It wrote more than it may.
    Output,
    /// What it wrote cannot be read.
    Unreadable,
    /// Its picture has another size.
    Size,
    /// It wrote nothing where a picture or an answer was due.
    Missing,
    /// A function that is needed is still to be written.
    Todo,
    /// The build failed.
    Build,
    /// The folder or archive is no submission.
    Submission,
    /// All is right, but something is worth saying.
    Remark,
    /// The grader or the machine failed.
    Internal,
}
