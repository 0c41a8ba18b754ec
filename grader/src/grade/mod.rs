//! Grades one submission, from its folder to its record.

mod answers;
mod bounds;
mod credit;
mod diagnosis;
mod error;
mod perform;
mod pictures;
mod plan;
mod progress;
mod thrift;
mod verdicts;
mod words;
mod write_up;

use std::path::{Path, PathBuf};

pub use crate::graded::{Front, Graded, Pictures};
pub use error::GradeError;
pub use progress::{Progress, Silent};
pub use write_up::VERSION;

use plan::Plan;

use crate::build::{BuildError, Built, Workshop, build};
use crate::exam::Exam;
use crate::exercise::{self, Allowance, Candidate};
use crate::record::{Build, Finding, FindingKind, SCHEMA, Submission, Verdict};
use crate::submission::{self, SubmissionError};
use crate::tracer::Tracer;
use crate::workers::guarded;

/// The parts that all gradings share. They are made once and used from any number of threads.
#[derive(Debug)]
pub struct Bench {
    /// The questions and answers.
    pub exam: Exam,
    /// The workspace, template and compiler that build submissions.
    pub workshop: Workshop,
    /// The limits of the programs.
    pub allowance: Allowance,
    /// The tracer that confirms diagnoses, or `None` for diagnoses without it.
    pub tracer: Option<Tracer>,
}

impl Bench {
    /// Reads the stages and answers in the folder `stages`, and finds the workspace around them.
    ///
    /// # Errors
    /// Returns everything that is wrong with the cases, or an error if there is no workspace.
    pub fn open(stages: &Path) -> Result<Self, GradeError> {
        let (exam, workshop) = (Exam::load(stages)?, Workshop::open(stages)?);
        Ok(Self { exam, workshop, allowance: Allowance::default(), tracer: None })
    }

    /// Returns a line on the selected part of the exam, such as `` 12 checks in 3 stages match
    /// `sphere` ``. It is `None` if each word names one whole stage.
    ///
    /// # Errors
    /// Returns a message with the possible choices if a word selects nothing.
    pub fn selected(
        &self,
        stages: &[String],
        checks: &[String],
    ) -> Result<Option<String>, GradeError> {
        let plan = plan::Plan::new(&self.exam, stages, checks).map_err(GradeError::Usage)?;
        Ok(plan.summary(stages, checks))
    }

    /// Returns the program of `built` with its limits.
    fn candidate<'a>(&self, built: &'a Built) -> Candidate<'a> {
        Candidate {
            program: &built.program,
            allowance: self.allowance,
            layers: self.workshop.layers,
        }
    }

    /// Returns a hash of everything except the submission that a score depends on: cases, answers,
    /// grader, limits, compiler.
    ///
    /// # Errors
    /// Returns an error if no compiler is found.
    pub fn epoch(&self) -> Result<String, GradeError> {
        let compiler = &self.workshop.toolchain()?.version;
        let text = format!("{} {VERSION} {SCHEMA} {:?} {compiler}", self.exam.hash, self.allowance);
        Ok(blake3::hash(text.as_bytes()).to_hex().to_string())
    }
}

/// The submission to grade, and the part of the exam to grade it on.
#[derive(Clone, Debug)]
pub struct Options {
    /// The folder or archive of the submission.
    pub submission: PathBuf,
    /// The name of the submission in the record.
    pub name: String,
    /// Ids of the stages to grade, or beginnings of ids such as `02`. An empty list selects all.
    pub stages: Vec<String>,
    /// Ids of the checks to grade, or beginnings of ids such as `01_ray_casting/sphere`. An empty
    /// list selects all.
    pub cases: Vec<String>,
    /// The number of programs that run at once, at least 1.
    pub jobs: usize,
}

impl Options {
    /// Returns options that select the whole exam for the submission at `path`, on all cores.
    pub fn new(path: impl Into<PathBuf>) -> Self {
        let submission = path.into();
        let name = submission.display().to_string();
        let jobs = std::thread::available_parallelism().map_or(1, usize::from);
        Self { submission, name, stages: vec![], cases: vec![], jobs }
    }
}

/// Grades one submission: reads it, builds it, runs all selected checks, judges and scores them.
///
/// Every submission gets a record, whatever it does. After an interrupt the record lists the checks
/// that were not run.
///
/// # Errors
/// Returns an error if nothing is selected, if answers are missing or stale, if the submission
/// cannot be read, or if the machine fails before any case ran.
pub fn grade(
    bench: &Bench,
    options: &Options,
    progress: &dyn Progress,
) -> Result<Graded, GradeError> {
    let plan = trusted(bench, planned(bench, options)?)?;
    let epoch = bench.epoch()?;
    let (digest, prepared) = prepare(bench, options, progress)?;
    let template = prepared.as_ref().ok().and_then(|(built, _)| built.template);
    let (mut answers, build) = match prepared {
        Ok((built, ignored)) => {
            let mut answers =
                perform::exercise(&plan, &bench.candidate(&built), options.jobs, progress);
            write_up::name_functions(&mut answers, template);
            (answers, accepted(&built, ignored))
        }
        Err(build) => (perform::nothing(&plan, build.finding.as_ref()), build),
    };
    // A diagnosis is only a hint, so a panic of the grader in it must not cost a check.
    let explanation = guarded(|| {
        diagnosis::diagnose((&bench.exam, bench.tracer.as_ref()), &plan, &mut answers, template)
    })
    .unwrap_or_default();
    let (stages, pictures) = write_up::stages(&plan, answers, &bench.exam);
    let submission = Submission { path: options.name.clone(), digest };
    let mut record = write_up::record(epoch, submission, build, stages, explanation);
    record.sandbox = bench.workshop.layers.to_string();
    Ok(Graded { record, pictures })
}

/// Checks that everything that `options` selects has trusted answers.
///
/// # Errors
/// Returns an error if nothing is selected, or if answers are missing or stale.
pub fn check_answers(bench: &Bench, options: &Options) -> Result<(), GradeError> {
    trusted(bench, planned(bench, options)?).map(drop)
}

fn planned<'a>(bench: &'a Bench, options: &Options) -> Result<Plan<'a>, GradeError> {
    Plan::new(&bench.exam, &options.stages, &options.cases).map_err(GradeError::Usage)
}

/// Returns `plan` if all of its checks have trusted answers.
fn trusted<'a>(bench: &Bench, plan: Plan<'a>) -> Result<Plan<'a>, GradeError> {
    let ids = plan.stages.iter().flat_map(plan::Part::ids);
    bench.exam.trust(ids).map_err(|untrusted| GradeError::Untrusted {
        blame: untrusted.blame(),
        message: untrusted.to_string(),
    })?;
    Ok(plan)
}

/// A program with the remarks on files that were left aside, or the record of a failed build.
type Prepared = Result<(Built, Vec<String>), Build>;

/// Reads and builds the submission. Returns its digest, which is empty if it was refused, and the
/// program.
fn prepare(
    bench: &Bench,
    options: &Options,
    progress: &dyn Progress,
) -> Result<(String, Prepared), GradeError> {
    let submission = match submission::read(&options.submission, &bench.workshop.template) {
        Ok(submission) => submission,
        Err(SubmissionError::Refused(why)) => {
            let finding = Finding::new(FindingKind::Submission, why);
            return Ok((String::new(), Err(rejected(Verdict::Fail, finding, vec![]))));
        }
        Err(why) => return Err(why.into()),
    };
    let ignored = submission.ignored.clone();
    let prepared = match build(&submission, &bench.workshop, &|what| progress.phase(what)) {
        Ok(built) => Ok((built, ignored)),
        Err(BuildError::Rejected(why)) => {
            let finding = Finding::new(FindingKind::Build, why + &unused(&submission));
            Err(rejected(Verdict::Fail, finding, ignored))
        }
        Err(BuildError::Ours(why)) => return Err(why.into()),
        Err(BuildError::Interrupted) => {
            let finding =
                Finding::new(FindingKind::Internal, "the grader was interrupted while building");
            Err(rejected(Verdict::NotRun, finding, ignored))
        }
    };
    Ok((submission.digest, prepared))
}

/// Returns a paragraph on sources and manifests of the submission that are not used, or an empty
/// string.
///
/// Unused files may be the cause of a compiler error.
fn unused(submission: &submission::Submission) -> String {
    let submission::Kind::Rust(rust) = &submission.kind else { return String::new() };
    if rust.unused.is_empty() {
        return String::new();
    }
    let files = rust.unused.iter().map(|says| format!("\n  {says}")).collect::<String>();
    format!("\n\nThese files of yours are not used, which may be the reason:{files}")
}

fn accepted(built: &Built, ignored: Vec<String>) -> Build {
    let (warnings, time_s) = (built.warnings.clone(), built.time.as_secs_f64());
    Build { verdict: Verdict::Pass, finding: None, warnings, ignored, time_s }
}

fn rejected(verdict: Verdict, finding: Finding, ignored: Vec<String>) -> Build {
    Build { verdict, finding: Some(finding), warnings: vec![], ignored, time_s: 0.0 }
}

/// Judges pictures that already exist as `folder/STAGE/CASE.png`. Unit checks are left out.
///
/// # Errors
/// Returns an error if nothing is selected, or if answers are missing or stale.
pub fn images(bench: &Bench, folder: &Path, options: &Options) -> Result<Graded, GradeError> {
    let plan = trusted(bench, planned(bench, options)?.pictures_only())?;
    let mut answers = perform::review(&plan, folder);
    let explanation =
        diagnosis::diagnose((&bench.exam, bench.tracer.as_ref()), &plan, &mut answers, None);
    let (stages, pictures) = write_up::stages(&plan, answers, &bench.exam);
    let submission = Submission { path: options.name.clone(), digest: String::new() };
    let build = Build {
        verdict: Verdict::Pass,
        finding: None,
        warnings: vec![],
        ignored: vec![],
        time_s: 0.0,
    };
    let record = write_up::record(bench.epoch()?, submission, build, stages, explanation);
    Ok(Graded { record, pictures })
}

/// Returns the ray tree behind the pixel (`x`, `y`) of the image case `case`, as the submission
/// prints it. The inner error is a message to the student on why there is none.
///
/// # Errors
/// Returns an error if the case, the pixel or the submission does not exist, or if the machine
/// fails.
pub fn explain(
    bench: &Bench,
    path: &Path,
    case: &str,
    [x, y]: [u32; 2],
    progress: &dyn Progress,
) -> Result<Result<String, String>, GradeError> {
    let mut cases = bench.exam.stages.iter().flat_map(|questions| &questions.stage.cases);
    let case = cases.find(|one| one.id == case).ok_or_else(|| {
        GradeError::Usage(format!(
            "there is no image case `{case}`; ids look like `02_shadows/two_lamps`"
        ))
    })?;
    let (width, height) = (case.scene.render.width, case.scene.render.height);
    if x >= width || y >= height {
        return Err(GradeError::Usage(format!(
            "pixel ({x}, {y}) does not lie in a picture of {width}×{height}"
        )));
    }
    match prepare(bench, &Options::new(path), progress)?.1 {
        Ok((built, _)) => Ok(exercise::explain(&bench.candidate(&built), &case.scene, x, y)),
        Err(Build { finding: Some(finding), .. }) if finding.kind == FindingKind::Submission => {
            Err(GradeError::Refused(finding.message))
        }
        Err(build) => Ok(Err(build.finding.map_or(String::new(), |finding| finding.message))),
    }
}

#[cfg(test)]
mod tests;
