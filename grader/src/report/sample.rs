//! A submission for the tests of the reports. It has a finding of each kind, with hostile text
//! wherever a student can put text.

use cases::answer::{ImageAnswer, Mistake};
use cases::film::Image;
use cases::front::FrontPoint;
use cases::glam::DVec3;

use crate::graded::{Front, Graded, Pictures};
use crate::record::*;

/// Hostile text that runs a script if it is not escaped, hides what follows, and turns the reading
/// direction.
pub(crate) const HOSTILE: &str = "</script><script>document.title='owned'</script><img src=x \
    onerror=alert(1)>\" ' `\u{202e}\u{1b}[2J\u{0}&lt;{{ 7*7 }}";

pub(crate) fn graded(name: &str) -> Graded {
    let ball = pictures(true, |_| DVec3::ZERO);
    let shifted =
        pictures(true, |i| DVec3::splat(f64::from(u8::from((60..70).contains(&i))) * 0.3));
    let not_a_number = pictures(true, |i| DVec3::splat(if i == 7 { f64::NAN } else { 0.0 }));
    let contested = pictures(true, |_| DVec3::ZERO);
    let named = [
        ("ball", ball),
        ("shifted", shifted),
        ("not_a_number", not_a_number),
        ("contested", contested),
        ("crashed", pictures(false, |_| DVec3::ZERO)),
    ];
    let pictures = named.map(|(name, both)| (format!("01_ray_casting/{name}"), both)).into();
    Graded { record: record(name), pictures }
}

/// Returns both pictures of a ball before a slope. The actual one is off by `extra` of each column.
pub(crate) fn pictures(has_actual: bool, extra: impl Fn(u32) -> DVec3) -> Pictures {
    let colour = |i: u32, j: u32| {
        let (x, y) = (f64::from(i) / 80.0 - 1.0, f64::from(j) / 80.0 - 0.75);
        let inside = 0.3 - x * x - y * y;
        let lit = if inside > 0.0 { inside.sqrt() * 1.6 } else { 0.05 + 0.1 * y };
        DVec3::new(lit, lit * 0.6, 0.3 + 0.2 * x)
    };
    let expected = Image::from_fn(160, 120, colour);
    let actual = has_actual.then(|| Image::from_fn(160, 120, |i, j| colour(i, j) + extra(i)));
    let mut answer = ImageAnswer::exact(expected, 2.0, 96);
    answer.hi[160 * 5 + 3] = [212; 3]; // contested
    answer.weight[..160].fill(0);
    let point = |setting: &str, time_s, rmse_levels| FrontPoint {
        setting: setting.to_owned(),
        time_s,
        rmse_levels,
    };
    let points = vec![
        point("f32 <plain>", 0.002, 0.5),
        point("f64", 0.004, 0.0),
        point("f64, depth 9", 0.05, 0.0),
    ];
    Pictures {
        answer,
        actual,
        front: Some(Front { machine: "two <cores>".to_owned(), is_old: true, points }),
    }
}

pub(crate) fn record(name: &str) -> Record {
    let checks = vec![
        check("ball", CheckKind::Image, Verdict::Pass, None),
        check(
            "shifted",
            CheckKind::Image,
            Verdict::Fail,
            Some(Finding {
                wrong_pixels: Some(1200),
                wrong_contested: Some(7),
                largest_cluster: Some(1100),
                worst: Some([61, 60]),
                diagnosis: Some("one".to_owned()),
                ..finding(FindingKind::Wrong)
            }),
        ),
        check(
            "not_a_number",
            CheckKind::Image,
            Verdict::Partial,
            Some(Finding {
                wrong_pixels: Some(120),
                share: Some(375),
                ..finding(FindingKind::Wrong)
            }),
        ),
        check(
            "contested",
            CheckKind::Image,
            Verdict::Pass,
            Some(Finding { wrong_pixels: Some(1), ..finding(FindingKind::Contested) }),
        ),
        check("crashed", CheckKind::Image, Verdict::Fail, Some(finding(FindingKind::Crash))),
        check("sphere/tangent", CheckKind::Unit, Verdict::Pass, None),
        check("sphere/inside", CheckKind::Unit, Verdict::Fail, Some(wrong_answer())),
        check("shade/dark", CheckKind::Unit, Verdict::NotRun, Some(finding(FindingKind::Todo))),
    ];
    let (earned, possible) =
        checks.iter().fold((0, 0), |(e, p), one| (e + one.earned, p + one.possible));
    Record {
        schema: SCHEMA,
        grader: "0.1.0".to_owned(),
        epoch: "epoch-1".to_owned(),
        interrupted: false,
        submission: Submission { path: name.to_owned(), digest: "d1935e57".to_owned() },
        sandbox: "timeouts+rlimits".to_owned(),
        build: Build {
            verdict: Verdict::Pass,
            finding: None,
            warnings: vec![format!("warning: unused variable `{HOSTILE}`")],
            ignored: vec![format!("{HOSTILE}.rs: no file of the template")],
            time_s: 2.5,
        },
        score: Score { earned, possible },
        diagnoses: vec![diagnosis()],
        unexplained: Some(unexplained()),
        stages: vec![StageRecord {
            id: "01_ray_casting".to_owned(),
            title: "Ray casting".to_owned(),
            earned,
            possible,
            checks,
            remarks: vec![],
        }],
    }
}

/// Returns a diagnosis that explains two of the wrong checks.
fn diagnosis() -> Diagnosis {
    let mistake = |id: &str, rule| Mistake {
        id: id.to_owned(),
        rule,
        says: format!("the {id} is <wrong>"),
        look_at: "sphere.rs intersect_sphere".to_owned(),
        field: "sphere_roots".to_owned(),
    };
    let explained = |name: &str, pixels, region| Explained {
        id: format!("01_ray_casting/{name}"),
        pixels,
        region,
    };
    Diagnosis {
        mistakes: vec![mistake("one", 3), mistake("other", 14)],
        confidence: Confidence::Surely,
        explains: vec![
            explained("shifted", 1100, Some([60, 0, 69, 119])),
            explained("sphere/inside", 0, None),
        ],
    }
}

/// Returns what the diagnosis leaves unexplained: a part of one picture.
fn unexplained() -> Unexplained {
    let check = "01_ray_casting/not_a_number".to_owned();
    Unexplained {
        checks: vec![check.clone()],
        pixels: 120,
        worst: Some(WorstPixel { check, cluster: 120, pixel: [7, 0] }),
    }
}

fn check(name: &str, kind: CheckKind, verdict: Verdict, finding: Option<Finding>) -> CheckRecord {
    let earned = match verdict {
        Verdict::Pass => 2000,
        Verdict::Partial => 750,
        _ => 0,
    };
    CheckRecord {
        id: format!("01_ray_casting/{name}"),
        kind,
        about: "A ball before a slope.\nWrong: the ball lies beside where it should.".to_owned(),
        rules: vec![3, 14],
        verdict,
        earned,
        possible: 2000,
        credit: (name == "not_a_number")
            .then(|| Credit { points: 250, mistakes: vec!["one".to_owned()] }),
        finding,
        time_s: 0.04,
        cpu_s: None,
        peak_bytes: 12_000_000,
    }
}

pub(crate) fn finding(kind: FindingKind) -> Finding {
    let stderr = Some(format!("panic: {HOSTILE}\nat src/sphere.rs:12"));
    Finding { stderr, ..Finding::new(kind, format!("The finding: {HOSTILE}")) }
}

fn wrong_answer() -> Finding {
    Finding {
        message: "The hit lies behind the ray's origin.".to_owned(),
        asked: Some(serde_json::json!({ "fn": "sphere", "radius": 0.5, "hostile": HOSTILE })),
        expected: Some("hit\n  t       0.5\n  normal  0 0 1\n".to_owned()),
        actual: Some(format!("hit\n  t       -0.5\n  normal  0 0 1\n{HOSTILE}\n")),
        diagnosis: Some("one".to_owned()),
        stderr: None,
        ..finding(FindingKind::Wrong)
    }
}
