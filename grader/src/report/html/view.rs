//! Turns the record into the values that the template shows: harmless texts, and numbers in words.
//! Nothing is decided here.

use cases::answer::Mistake;
use pages::diff;
use serde::Serialize;

use super::{front, picture};
use crate::graded::{Graded, Pictures};
use crate::plain::shown;
use crate::record::{
    Build, CheckKind, CheckRecord, Diagnosis, Finding, FindingKind, Record, Score, StageRecord,
    Verdict,
};
use crate::report::{mistakes, words};

#[derive(Serialize)]
pub(super) struct Submission {
    name: String,
    digest: String,
    epoch: String,
    /// True if the user stopped the grader before everything was run.
    is_interrupted: bool,
    grader: String,
    sandbox: String,
    score: Points,
    build: BuildView,
    diagnoses: Vec<DiagnosisView>,
    /// What known mistakes earn, in words.
    credits: Vec<String>,
    /// What no mistake explains, in words.
    unexplained: Option<String>,
    stages: Vec<Stage>,
}

#[derive(Serialize)]
struct Points {
    earned: String,
    possible: String,
    /// The earned points in thousandths, for a bar.
    earned_n: u64,
    possible_n: u64,
}

#[derive(Serialize)]
struct BuildView {
    verdict: &'static str,
    words: &'static str,
    seconds: String,
    finding: Option<FindingView>,
    warnings: Vec<String>,
    ignored: Vec<String>,
}

/// The most likely mistakes of the program.
#[derive(Serialize)]
struct DiagnosisView {
    /// The mistakes that the checks do not distinguish.
    mistakes: Vec<MistakeView>,
    /// The words before the first of them.
    lead: &'static str,
    /// The number of failed checks that the mistakes explain, in words.
    extent: String,
    /// Ids of the cases and checks that the mistakes explain, each with the pixels in words.
    explains: Vec<[String; 2]>,
}

#[derive(Serialize)]
struct MistakeView {
    id: String,
    says: String,
    rule: u8,
    place: Option<String>,
    /// The title and the text of the rule.
    title: &'static str,
    text: &'static str,
}

#[derive(Serialize)]
struct Stage {
    id: String,
    title: String,
    score: Points,
    cases: Vec<Check>,
    /// The unit checks that are not right.
    unit_failed: Vec<Check>,
    unit_passed: Vec<Check>,
    n_cases_right: usize,
    n_cases_partly: usize,
    /// Remarks on the program that answered the unit checks.
    remarks: Vec<String>,
}

#[derive(Serialize)]
struct Check {
    id: String,
    /// The id without its stage.
    name: String,
    about: String,
    rules: Vec<u8>,
    verdict: &'static str,
    words: &'static str,
    is_right: bool,
    /// True if the check counts as right, but a person should look at it.
    is_flagged: bool,
    score: Points,
    seconds: String,
    megabytes: Option<String>,
    finding: Option<FindingView>,
    pictures: Option<PicturesView>,
    front: Option<front::FrontView>,
}

#[derive(Serialize)]
struct FindingView {
    kind: &'static str,
    message: String,
    /// The id, the words before, and the sentence of the mistake that explains most of the finding.
    mistake: Option<[String; 3]>,
    wrong_pixels: Option<u64>,
    wrong_contested: Option<u64>,
    largest_cluster: Option<u64>,
    /// The share of the points that is earned, in percent.
    share: Option<String>,
    worst: Option<[u32; 2]>,
    asked: Option<String>,
    diff: Vec<diff::Line>,
    stderr: Option<String>,
}

#[derive(Serialize)]
struct PicturesView {
    width: u32,
    height: u32,
    levels: String,
    gain: u8,
    out_pixels: u32,
    cluster: u32,
    /// The share of the pixels on which correct tracers differ, in percent; `None` if there are
    /// none.
    contested: Option<String>,
    expected: String,
    actual: Option<Actual>,
}

#[derive(Serialize)]
struct Actual {
    picture: String,
    difference: String,
    marks: String,
    weight: Option<String>,
    allowed: Option<picture::Allowed>,
}

pub(super) fn submission(graded: &Graded) -> Submission {
    let record = &graded.record;
    Submission {
        name: shown(&record.submission.path),
        digest: shown(&record.submission.digest),
        epoch: shown(&record.epoch),
        is_interrupted: record.interrupted,
        grader: shown(&record.grader),
        sandbox: shown(&record.sandbox),
        score: points(record.score),
        build: build(&record.build),
        diagnoses: record.diagnoses.iter().map(|one| diagnosis(record, one)).collect(),
        credits: mistakes::credits(record),
        unexplained: record.unexplained.as_ref().map(|rest| mistakes::rest(record, rest)),
        stages: record.stages.iter().map(|one| stage(one, graded)).collect(),
    }
}

fn diagnosis(record: &Record, diagnosis: &Diagnosis) -> DiagnosisView {
    let mistake = |one: &Mistake| MistakeView {
        id: shown(&one.id),
        says: shown(&one.says),
        rule: one.rule,
        place: mistakes::place(one),
        title: mistakes::rule(one.rule).map_or("", |rule| rule.title),
        text: mistakes::rule(one.rule).map_or("", |rule| rule.text),
    };
    DiagnosisView {
        mistakes: diagnosis.mistakes.iter().map(mistake).collect(),
        lead: mistakes::lead(diagnosis.confidence),
        extent: mistakes::extent(record, diagnosis),
        explains: diagnosis
            .explains
            .iter()
            .map(|one| [shown(&one.id), mistakes::part(one)])
            .collect(),
    }
}

fn points(score: Score) -> Points {
    let Score { earned, possible } = score;
    Points {
        earned: words::points(earned),
        possible: words::points(possible),
        earned_n: earned,
        possible_n: possible,
    }
}

fn build(build: &Build) -> BuildView {
    BuildView {
        verdict: class(build.verdict),
        words: if build.verdict == Verdict::Pass {
            "worked"
        } else {
            words::verdict(build.verdict)
        },
        seconds: words::seconds(build.time_s),
        finding: build.finding.as_ref().map(|one| finding(None, one)),
        warnings: build.warnings.iter().map(|text| shown(text)).collect(),
        ignored: build.ignored.iter().map(|text| shown(text)).collect(),
    }
}

fn stage(stage: &StageRecord, graded: &Graded) -> Stage {
    let record = &graded.record;
    let of_kind = |kind: CheckKind| stage.checks.iter().filter(move |one| one.kind == kind);
    let cases: Vec<Check> = of_kind(CheckKind::Image)
        .map(|one| check(record, one, graded.pictures.get(&one.id)))
        .collect();
    let (unit_passed, unit_failed) =
        of_kind(CheckKind::Unit).map(|one| check(record, one, None)).partition(|one| one.is_right);
    Stage {
        id: shown(&stage.id),
        title: shown(&stage.title),
        score: points(Score { earned: stage.earned, possible: stage.possible }),
        n_cases_right: cases.iter().filter(|one| one.is_right).count(),
        n_cases_partly: of_kind(CheckKind::Image)
            .filter(|one| one.verdict == Verdict::Partial)
            .count(),
        remarks: stage.remarks.iter().map(|text| shown(text)).collect(),
        cases,
        unit_failed,
        unit_passed,
    }
}

fn check(record: &Record, check: &CheckRecord, pictures: Option<&Pictures>) -> Check {
    Check {
        id: shown(&check.id),
        name: shown(check.id.split_once('/').map_or(&*check.id, |(_, name)| name)),
        about: shown(check.about.trim()),
        rules: check.rules.clone(),
        verdict: class(check.verdict),
        words: words::verdict(check.verdict),
        is_right: check.verdict == Verdict::Pass,
        is_flagged: check
            .finding
            .as_ref()
            .is_some_and(|finding| finding.kind == FindingKind::Contested),
        score: points(Score { earned: check.earned, possible: check.possible }),
        seconds: words::seconds(check.time_s),
        megabytes: (check.peak_bytes > 0)
            .then(|| format!("{:.0} MB", check.peak_bytes as f64 / 1e6)),
        finding: check.finding.as_ref().map(|one| finding(Some(record), one)),
        pictures: pictures.map(|pictures| both(pictures, check.finding.is_some())),
        front: pictures.and_then(|pictures| front::view(pictures, check.time_s)),
    }
}

fn finding(record: Option<&Record>, finding: &Finding) -> FindingView {
    let text = |text: &Option<String>| text.as_deref().unwrap_or_default().to_owned();
    let is_compared = finding.expected.is_some() || finding.actual.is_some();
    let asked = finding.asked.as_ref().map(|asked| format!("{asked:#}"));
    FindingView {
        kind: words::finding(finding.kind),
        message: shown(finding.message.trim()),
        mistake: record.zip(finding.diagnosis.as_deref()).and_then(|(record, id)| {
            let (lead, says) = mistakes::says(record, id)?;
            Some([shown(id), lead.to_owned(), shown(says)])
        }),
        wrong_pixels: finding.wrong_pixels,
        wrong_contested: finding.wrong_contested,
        largest_cluster: finding.largest_cluster,
        share: finding
            .share
            .map(|thousandths| format!("{}.{}", thousandths / 10, thousandths % 10)),
        worst: finding.worst,
        asked: asked.map(|asked| shown(&asked)),
        diff: if is_compared {
            diff::lines(&text(&finding.expected), &text(&finding.actual))
        } else {
            Vec::new()
        },
        stderr: finding.stderr.as_deref().map(shown).filter(|text| !text.trim().is_empty()),
    }
}

/// Returns both pictures. If `is_explained`, the allowed levels of each pixel are included.
fn both(pictures: &Pictures, is_explained: bool) -> PicturesView {
    let Pictures { answer, actual, .. } = pictures;
    let expected = &answer.expected;
    let same_size = |one: &&cases::film::Image| {
        (one.width(), one.height()) == (expected.width(), expected.height())
    };
    let actual = actual.as_ref().filter(same_size).map(|actual| Actual {
        picture: picture::colours(actual),
        difference: picture::difference(expected, actual),
        marks: picture::marks(answer, actual),
        weight: picture::weight(answer),
        allowed: is_explained.then(|| picture::allowed(answer)),
    });
    let contested = answer.contested_share();
    PicturesView {
        width: expected.width(),
        height: expected.height(),
        levels: answer.limits.slack.to_string(),
        gain: picture::GAIN,
        out_pixels: answer.limits.count,
        cluster: answer.limits.cluster,
        contested: (contested > 0.0).then(|| format!("{:.2}", contested * 100.0)),
        expected: picture::colours(expected),
        actual,
    }
}

/// Returns the CSS class for a verdict.
fn class(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Pass => "pass",
        Verdict::Partial => "partial",
        Verdict::Fail => "fail",
        Verdict::NotRun => "not-run",
        Verdict::Ours => "ours",
    }
}
