//! Tests with shell scripts that answer as submissions might.

use std::os::unix::fs::PermissionsExt;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use cases::glam::DVec3;
use cases::probe::{Answer, Ask, Question};
use cases::scene::{Camera, Render, Scene};
use cases::{Effects, film};

use super::*;
use crate::build::Program;
use crate::sandbox::{Clock, Layers, Limits, Outcome};
use crate::workers::side_by_side;

/// Returns a shell script as a program, and the folder that holds it.
fn program(script: &str) -> (Program, tempfile::TempDir) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("program");
    std::fs::write(&path, format!("#!/bin/sh\n{script}")).unwrap();
    std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o755)).unwrap();
    (Program::new("/bin/sh", vec![path.into_os_string()], "/usr/bin:/bin"), folder)
}

fn candidate(program: &Program) -> Candidate<'_> {
    Candidate { program, allowance: Allowance::default(), layers: Layers::default() }
}

fn questions() -> Vec<Question> {
    let ask = |n: u32| Ask::Indices { inside: n.is_multiple_of(2), index: 1.5 };
    (0..5).map(|n| Question { id: format!("q{n}"), ask: ask(n) }).collect()
}

/// Returns a script that answers each line, after it runs `special` with the id in $id.
fn answering(special: &str) -> String {
    format!(
        "while read -r line; do id=${{line#*:\\\"}}; id=${{id%%\\\"*}}; {special}
         echo \"{{\\\"id\\\":\\\"$id\\\",\\\"value\\\":1}}\"; done"
    )
}

/// Checks which questions the script answers, and which ones end it.
fn check_probe(script: &str, answered: &[&str], ended: &[&str]) -> Probed {
    let (program, _folder) = program(script);
    let probed = probe(&candidate(&program), &questions(), &mut Start::default());
    assert_eq!(probed.got.keys().collect::<Vec<_>>(), answered, "{script}\n{probed:?}");
    assert_eq!(probed.ended.keys().collect::<Vec<_>>(), ended, "{script}\n{probed:?}");
    probed
}

/// Each question ends its process after a wait that is shorter than the limit of one process.
#[test]
fn idle_time_is_limited_over_all_questions_of_a_stage() {
    let (program, _folder) =
        program("sleep 0.4; read -r line && { echo $line | cut -c 8-9 >&2; exit 1; }");
    let limits = Limits { idle: Duration::from_millis(500), ..Allowance::default().picture };
    let short = Limits { idle: Duration::from_millis(80), ..limits };
    let probed = |picture| {
        let candidate = Candidate {
            allowance: Allowance { picture, questions: limits, whole: Allowance::WHOLE },
            ..candidate(&program)
        };
        probe(&candidate, &questions(), &mut Start::default())
    };
    assert!(probed(limits).not_run.is_empty());
    let probed = probed(short);
    assert!(!probed.ended.is_empty() && !probed.not_run.is_empty(), "{probed:?}");
    assert!(
        probed.not_run.values().all(|why| why.starts_with("not run: the program was idle")),
        "{probed:?}"
    );
}

#[test]
fn all_questions_are_answered() {
    let probed = check_probe(&answering(""), &["q0", "q1", "q2", "q3", "q4"], &[]);
    assert_eq!(probed.got["q3"], Got::Answer(Answer::Value(1.0)));
    assert!(probed.remarks.is_empty() && probed.peak_bytes > 0);
}

#[test]
fn a_question_that_kills_costs_only_itself() {
    let kill = "case $id in q1|q4) kill -SEGV $$;; esac;";
    let probed = check_probe(&answering(kill), &["q0", "q2", "q3"], &["q1", "q4"]);
    assert_eq!(probed.ended["q1"].finished.outcome, Outcome::Signalled(libc::SIGSEGV));
    check_probe(
        &answering("case $id in q1|q2) exit 0;; esac;"),
        &["q0", "q3", "q4"],
        &["q1", "q2"],
    );
    check_probe(&answering("case $id in q0) exit 3;; esac;"), &["q1", "q2", "q3", "q4"], &["q0"]);
}

#[test]
fn answers_lost_in_a_buffer_are_requested_again() {
    let buffered = format!("out=$({}); echo \"$out\"", answering("[ $id = q2 ] && kill -KILL $$;"));
    check_probe(&buffered, &["q0", "q1", "q3", "q4"], &["q2"]);
}

#[test]
fn an_omitted_answer_is_missing_and_its_question_is_sent_once() {
    let probed =
        check_probe(&answering("[ $id = q1 ] && continue;"), &["q0", "q2", "q3", "q4"], &["q1"]);
    assert_eq!(probed.ended["q1"].finished.outcome, Outcome::Exited(0));
    check_probe("cat > /dev/null", &[], &["q0", "q1", "q2", "q3", "q4"]);
}

#[test]
fn stray_text_and_strange_answers_are_reported() {
    let probed = check_probe(
        &answering("echo hello; echo '{\"id\":\"x\",\"value\":1}';"),
        &["q0", "q1", "q2", "q3", "q4"],
        &[],
    );
    assert_eq!(probed.remarks.len(), 2, "{:?}", probed.remarks);
    let twice = check_probe(
        &answering("echo \"{\\\"id\\\":\\\"q0\\\",\\\"value\\\":1}\";"),
        &["q0", "q1", "q2", "q3", "q4"],
        &[],
    );
    assert_eq!(twice.got["q0"], Got::Twice);
}

fn scene() -> Scene {
    let camera = Camera {
        eye: DVec3::ZERO,
        right: DVec3::X,
        up: DVec3::Y,
        forward: -DVec3::Z,
        fov_y_deg: 60.0,
    };
    Scene {
        render: Render { width: 4, height: 3, max_depth: 0, threshold: 0.0 },
        effects: Effects::NONE,
        camera,
        background: DVec3::ZERO,
        lights: vec![],
        materials: vec![],
        meshes: vec![],
        objects: vec![],
    }
}

/// Runs the script to make a picture, with `good.png` and `small.png` in $pictures.
fn shot(script: &str) -> Rendered {
    shot_within(script, Allowance::default().picture)
}

fn shot_within(script: &str, limits: Limits) -> Rendered {
    let pictures = tempfile::tempdir().unwrap();
    let grey = |width| film::Image::from_fn(width, 3, |_, _| DVec3::splat(0.2));
    film::write(&pictures.path().join("good.png"), &grey(4)).unwrap();
    film::write(&pictures.path().join("small.png"), &grey(3)).unwrap();
    let (program, _folder) = program(&format!("pictures={}\n{script}", pictures.path().display()));
    render_case(&candidate(&program), &scene(), limits)
}

#[test]
fn a_good_picture_counts_whatever_the_exit_code() {
    let done = shot("[ $1 = render ] && [ -s $2 ] && cp $pictures/good.png $3; rm $2; exit 1");
    assert_eq!(done.finished.outcome, Outcome::Exited(1));
    assert_eq!(done.picture.unwrap().width(), 4);
}

#[test]
fn what_is_no_picture_of_the_right_size_says_why() {
    assert!(matches!(shot("exit 0").picture, Err(NoPicture::Missing)));
    assert!(matches!(shot("cp $pictures/small.png $3").picture, Err(NoPicture::Size(_))));
    let table = [
        ("printf 'BMxxxx' > $3", "a BMP"),
        ("ln -s $pictures/good.png $3", "is a link"),
        ("ln $pictures/good.png $3", "hard link"),
        ("mkfifo $3", "is no regular file"),
        ("mkdir $3", "is no regular file"),
        ("ln -s /dev/zero $3", "is a link"),
        (": > $3", "the file is empty"),
        ("head -c 40 $pictures/good.png > $3", "cannot be decoded"),
    ];
    for (script, part) in table {
        match shot(script).picture {
            Err(NoPicture::Unreadable(why)) => assert!(why.contains(part), "{script}: {why}"),
            other => panic!("{script}: {other:?}"),
        }
    }
}

/// Returns a script that uses this number of hundredths of a second of CPU time, however long that
/// takes, and then draws.
fn spending(hundredths: &str) -> String {
    format!(
        "out=$3; want={hundredths}; while read -r line < /proc/$$/stat; do set -- ${{line##*) }}; \
         [ $((${{12}} + ${{13}})) -ge $want ] && break; done; cp $pictures/good.png $out"
    )
}

fn seconds(cpu: u64) -> Limits {
    Allowance::new(Duration::from_secs(cpu), Allowance::MEMORY).picture
}

/// Runs `work` while `n` threads keep the processors busy.
fn under_load<R>(n: usize, work: impl FnOnce() -> R) -> R {
    let is_over = AtomicBool::new(false);
    std::thread::scope(|scope| {
        for _ in 0..n {
            scope.spawn(|| {
                while !is_over.load(Ordering::Relaxed) {
                    std::hint::spin_loop()
                }
            });
        }
        let done = work();
        is_over.store(true, Ordering::Relaxed);
        done
    })
}

#[test]
fn identical_programs_come_out_alike_on_a_busy_machine() {
    let n = 4 * std::thread::available_parallelism().map_or(1, usize::from);
    let copies =
        under_load(n, || side_by_side(3, &[(); 6], |()| shot_within(&spending("40"), seconds(1))));
    for copy in copies {
        let copy = copy.unwrap();
        assert!(copy.picture.is_ok(), "{:?}", copy.finished);
        assert!(copy.finished.cpu < seconds(1).cpu, "{:?}", copy.finished);
    }
}

#[test]
fn a_time_out_near_the_limit_is_confirmed_alone_where_others_run() {
    let home = tempfile::tempdir().unwrap();
    let at = |name: &str| home.path().join(name).display().to_string();
    let neighbour =
        || shot_within(&format!("touch {}; {}", at("runs"), spending("150")), seconds(10));
    // The first run takes more than the limit, but less than twice as much.
    let slow_once = format!(
        "[ -e {0} ] && {{ want=10; }} || want=130; touch {0}; {1}",
        at("slow"),
        spending("$want")
    );
    std::thread::scope(|scope| {
        scope.spawn(neighbour);
        while !home.path().join("runs").exists() {
            std::thread::yield_now();
        }
        let shot = shot_within(&slow_once, seconds(1));
        assert!(shot.picture.is_ok(), "the second run counts: {:?}", shot.finished);
    });
    let shot = shot_within(&spending("130"), seconds(1));
    assert_eq!(shot.finished.outcome, Outcome::TimedOut(Clock::Cpu), "{:?}", shot.finished);
}

#[test]
fn a_few_processes_show_that_a_program_answers_nothing() {
    let home = tempfile::tempdir().unwrap();
    let log = home.path().join("log");
    let count = || std::fs::read_to_string(&log).unwrap().lines().count();
    let note = format!("echo started >> {}", log.display());
    let probed =
        check_probe(&format!("{note}; echo no configuration >&2; exit 1"), &[], &["q0", "q4"]);
    assert_eq!(
        (count(), probed.skipped.len()),
        (4, 3),
        "all questions, the first and the last one, none: {probed:?}"
    );
    // A program that dies silently at the first question, and without a question, answers the
    // others.
    let at_q0 = answering("n=1; case $id in q0) exit 1;; esac;");
    let silent = format!("{note}; n=0; {at_q0}; [ $n = 1 ] || exit 1");
    let probed = check_probe(&silent, &["q1", "q2", "q3", "q4"], &["q0"]);
    assert!(probed.skipped.is_empty(), "{probed:?}");
    // A program that fails at every question but survives an empty input is not broken.
    let picky = format!("{note}; read -r line || exit 0; echo no answers >&2; exit 1");
    let probed = check_probe(&picky, &[], &["q0", "q1", "q3", "q4"]);
    assert!(probed.skipped.is_empty(), "{probed:?}");
}

/// Sends 50 questions to each of two functions, in turn, to a program that answers unless `script`
/// ends it.
///
/// The functions are `indices` (i0 to i49) and `reflect` (r0 to r49). Returns the number of
/// processes that were started, and the results.
fn probe_two_functions(script: &str) -> (usize, Probed) {
    let home = tempfile::tempdir().unwrap();
    let log = home.path().join("log");
    let (program, _folder) =
        program(&format!("echo started >> {}\n{}", log.display(), answering(script)));
    let indices =
        |n: u32| Question { id: format!("i{n}"), ask: Ask::Indices { inside: n == 0, index: 1.5 } };
    let reflect = |n: u32| {
        let ask = Ask::Reflect { direction: -DVec3::Z, normal: DVec3::new(f64::from(n), 0.0, 1.0) };
        Question { id: format!("r{n}"), ask }
    };
    let questions: Vec<Question> = (0..50).flat_map(|n| [indices(n), reflect(n)]).collect();
    let probed = probe(&candidate(&program), &questions, &mut Start::default());
    (std::fs::read_to_string(&log).unwrap().lines().count(), probed)
}

#[test]
fn a_function_that_fails_at_all_questions_costs_a_few_processes_and_nothing_else() {
    let answered =
        |probed: &Probed, letter| probed.got.keys().filter(|id| id.starts_with(letter)).count();
    let (n_starts, probed) =
        probe_two_functions("case $id in r*) echo no reflection >&2; exit 1;; esac;");
    assert_eq!(
        (answered(&probed, 'i'), probed.ended.len(), probed.left_out.len()),
        (50, 4, 46),
        "{probed:?}"
    );
    assert!(n_starts <= 6, "{n_starts} processes");
    let left_out = &probed.left_out["r30"];
    assert_eq!((left_out.n_failures, left_out.n), (4, 46));
    let (_, probed) = probe_two_functions("case $id in r*) exit 1;; esac;");
    assert_eq!(
        (answered(&probed, 'i'), probed.ended.len(), probed.left_out.len()),
        (50, 9, 41),
        "{probed:?}"
    );
}

/// No question is answered, and the last question to `reflect` ends its process with code 0.
#[test]
fn an_end_without_an_answer_shows_that_a_function_does_not_fail_at_all_questions() {
    let (_, probed) = probe_two_functions(
        "case $id in i*) echo no >&2; exit 1;; r49) exit 0;; esac; echo none >&2; exit 1;",
    );
    let left_out = |letter| probed.left_out.keys().filter(|id| id.starts_with(letter)).count();
    assert_eq!((left_out('i'), left_out('r'), probed.ended.len()), (46, 0, 54), "{probed:?}");
}

#[test]
fn a_function_that_fails_at_some_questions_loses_those_alone() {
    for (script, lost) in [
        ("case $id in r?) echo no reflection >&2; exit 1;; esac;", 10),
        ("case $id in r[0-3]*) exit 1;; esac;", 34),
        ("case $id in r*) echo no reflection $id >&2; exit 1;; esac;", 50),
    ] {
        let (_, probed) = probe_two_functions(script);
        assert_eq!(
            (probed.got.len(), probed.ended.len()),
            (100 - lost, lost),
            "{script}: {probed:?}"
        );
        assert!(probed.left_out.is_empty(), "{script}: {probed:?}");
    }
}
