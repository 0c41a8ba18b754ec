//! The grade record: the versioned result behind every report. Reports decide nothing; they only
//! show what the record holds.

use cases::answer::Mistake;
use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde::{Deserialize, Serialize};

use crate::plain;

/// The version of the record's schema.
pub const SCHEMA: u32 = 5;

/// The result of grading one submission.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Record {
    /// The version of the schema, [`SCHEMA`].
    pub schema: u32,
    /// The version of the grader.
    pub grader: String,
    /// A hash of everything but the submission that a score depends on: cases, answers, limits,
    /// grader, toolchain.
    pub epoch: String,
    /// Whether the user stopped the grader before everything was run. The score is then not final.
    pub interrupted: bool,
    /// The submission that was graded.
    pub submission: Submission,
    /// The layers of protection that were in force, such as `timeouts+rlimits`.
    pub sandbox: String,
    /// The build, and the parts of the submission that were left aside.
    pub build: Build,
    /// The sum of the scores of the stages.
    pub score: Score,
    /// The known mistakes that explain what is wrong: first those that the program makes in whole
    /// pictures, then the others, the one that explains most first.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub diagnoses: Vec<Diagnosis>,
    /// The wrong pictures and answers that the diagnoses leave unexplained; missing if there are
    /// none.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub unexplained: Option<Unexplained>,
    /// The stages, in order.
    pub stages: Vec<StageRecord>,
}

impl Record {
    /// Returns the record as indented JSON, with a line break at the end.
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
    /// The mistake; several if no case and no check of the run distinguishes them.
    pub mistakes: Vec<Mistake>,
    /// How well the evidence supports the mistake.
    pub confidence: Confidence,
    /// The cases and checks that the mistake explains, wholly or in part.
    pub explains: Vec<Explained>,
}

/// How well the evidence supports a diagnosis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Confidence {
    /// Much evidence speaks for the mistake, and little against it.
    Surely,
    /// The mistake rests on a single case, on little evidence, or on contradictory evidence.
    Perhaps,
}

/// A case or check that a mistake explains.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Explained {
    /// The id of the case or check.
    pub id: String,
    /// The number of wrong pixels that the mistake explains; 0 for a unit check.
    pub pixels: u64,
    /// The bounds of the largest region of these pixels: left column, top row, right column and
    /// bottom row, all included. Missing for a unit check, and for a mistake of whole pictures.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub region: Option<[u32; 4]>,
}

/// The wrong pictures and answers that no diagnosis explains.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Unexplained {
    /// Ids of the checks with a wrong answer, and of the cases whose unexplained pixels alone would
    /// make them fail.
    pub checks: Vec<String>,
    /// The number of unexplained pixels in these cases.
    pub pixels: u64,
    /// The worst unexplained pixel of all cases; missing if only unit checks are unexplained.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub worst: Option<WorstPixel>,
}

/// A pixel to look at.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct WorstPixel {
    /// The id of the case with the largest cluster of unexplained pixels.
    pub check: String,
    /// The number of pixels in this cluster.
    pub cluster: u64,
    /// The pixel of the cluster with the greatest error: column from the left, row from the top.
    pub pixel: [u32; 2],
}

/// The submission that was graded.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Submission {
    /// The path as it was given; in a batch, the name of the submission.
    pub path: String,
    /// A hash of the files that count; empty if the submission cannot be read.
    pub digest: String,
}

/// The result of the build.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Build {
    /// Pass, Fail, or NotRun after an interrupt.
    pub verdict: Verdict,
    /// The fault, if there is one.
    pub finding: Option<Finding>,
    /// The compiler's warnings, as it wrote them; cut at a limit.
    pub warnings: Vec<String>,
    /// The parts of the submission that were left aside, with reasons: a `build.rs`, a changed
    /// manifest, an unknown file.
    pub ignored: Vec<String>,
    /// Wall time of the build, in seconds; 0 if a stored build was used.
    pub time_s: f64,
}

/// Points, in thousandths.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Score {
    /// The points that were earned.
    pub earned: u64,
    /// The points that could have been earned.
    pub possible: u64,
}

/// One stage of the assignment.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct StageRecord {
    /// The id, such as `02_shadows`.
    pub id: String,
    /// The title, one line for people.
    pub title: String,
    /// Points earned, in thousandths.
    pub earned: u64,
    /// Points that could have been earned, in thousandths.
    pub possible: u64,
    /// The checks: image cases first, then unit checks.
    pub checks: Vec<CheckRecord>,
    /// Remarks that cost no points, such as one about text on standard output that is no answer.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub remarks: Vec<String>,
}

/// One image case or unit check.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CheckRecord {
    /// The id, such as `02_shadows/two_balls`.
    pub id: String,
    /// The kind of the check.
    pub kind: CheckKind,
    /// A description of what the check tests, for people.
    pub about: String,
    /// The rules of light that the check tests.
    pub rules: Vec<u8>,
    /// The verdict on the check.
    pub verdict: Verdict,
    /// Points earned, in thousandths.
    pub earned: u64,
    /// Points that could have been earned, in thousandths.
    pub possible: u64,
    /// The part of the earned points that is given for what known mistakes explain; missing if that
    /// is nothing.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub credit: Option<Credit>,
    /// The reason for the verdict, if the check does not pass; also a remark on a pass.
    pub finding: Option<Finding>,
    /// Wall time of the program, in seconds; unit checks of a stage share one process and its time.
    pub time_s: f64,
    /// CPU time of the program, in seconds; missing if nothing was run.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub cpu_s: Option<f64>,
    /// Largest resident size of the program, in bytes.
    pub peak_bytes: u64,
}

/// Points for what known mistakes explain that are paid for in another stage.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Credit {
    /// The points, in thousandths. They are among the earned points of the check.
    pub points: u64,
    /// Ids of the mistakes, as the list of known mistakes has them.
    pub mistakes: Vec<String>,
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

/// The verdict on a check or a build.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// All points.
    Pass,
    /// Some points.
    Partial,
    /// The program ran and was wrong, or failed.
    Fail,
    /// The check could not be run; the finding says why.
    NotRun,
    /// The grader or the machine failed; the check costs nothing.
    Ours,
}

impl Finding {
    /// Returns a finding that has a message and no numbers.
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

/// The reason for a verdict, in words and in numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Finding {
    /// The kind of the finding.
    pub kind: FindingKind,
    /// A message for the student, of one or a few sentences.
    pub message: String,
    /// Number of pixels out of tolerance, for a picture.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub wrong_pixels: Option<u64>,
    /// Number of the wrong pixels on which correct tracers differ too.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub wrong_contested: Option<u64>,
    /// Number of pixels in the largest cluster: wrong pixels that touch by a side or a corner.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub largest_cluster: Option<u64>,
    /// The share of its points that a wrong picture earns, in thousandths.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub share: Option<u32>,
    /// The pixel farthest out of tolerance: column from the left, row from the top.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub worst: Option<[u32; 2]>,
    /// The question of a unit check, as the program got it.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub asked: Option<serde_json::Value>,
    /// The correct answer to a unit check, as lines of text.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub expected: Option<String>,
    /// The program's answer, as lines of text.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub actual: Option<String>,
    /// Id of the known mistake that explains the finding; the record's diagnoses contain it.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub diagnosis: Option<String>,
    /// The end of what the program wrote to standard error, cut at a limit.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub stderr: Option<String>,
}

/// The kinds of finding.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "snake_case")]
pub enum FindingKind {
    /// The answer or picture is not the correct one.
    Wrong,
    /// The picture is anti-aliased: it has several rays per pixel instead of one.
    Antialiased,
    /// Correct tracers differ on every wrong pixel too. The picture counts as right, and a person
    /// should look at it.
    Contested,
    /// Two runs of the program gave different pictures. The worse one counts.
    Nondeterministic,
    /// The program could not be started, started too many processes, or ended with a signal, a
    /// panic or a code other than 0.
    Crash,
    /// The program exceeded a limit on CPU, idle or wall time, or was not run again because it had
    /// done so before.
    Timeout,
    /// The program exceeded its limit on memory.
    Memory,
    /// The program wrote more than it may.
    Output,
    /// The output of the program cannot be read.
    Unreadable,
    /// The picture has the wrong size.
    Size,
    /// The program did not write the picture or the answer.
    Missing,
    /// A function that is needed is still to be written.
    Todo,
    /// The build failed.
    Build,
    /// The folder or archive is no submission.
    Submission,
    /// Everything is right, but there is a remark.
    Remark,
    /// The grader or the machine failed.
    Internal,
}
