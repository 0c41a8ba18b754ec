//! Programs in shell that answer as submissions might.

use std::os::unix::fs::PermissionsExt;

use cases::glam::DVec3;
use cases::probe::{Answer, Ask, Question};
use cases::scene::{Camera, Render, Scene};
use cases::{Effects, film};

use super::*;

/// A program whose text is a shell script; it lives as long as the folder.
fn program(script: &str) -> (Program, tempfile::TempDir) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("program");
    std::fs::write(&path, format!("#!/bin/sh\n{script}")).unwrap();
    std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o755)).unwrap();
    (Program::new("/bin/sh", vec![path.into_os_string()], "/usr/bin:/bin"), folder)
}

fn candidate(program: &Program) -> Candidate<'_> {
    Candidate { program, allowance: Allowance::default() }
}

fn questions() -> Vec<Question> {
    let ask = |n: u32| Ask::Indices { inside: n.is_multiple_of(2), index: 1.5 };
    (0..5).map(|n| Question { id: format!("q{n}"), ask: ask(n) }).collect()
}

/// Answers each line, after `special` has had a look at the id in $id.
fn answering(special: &str) -> String {
    format!(
        "while read -r line; do id=${{line#*:\\\"}}; id=${{id%%\\\"*}}; {special}
         echo \"{{\\\"id\\\":\\\"$id\\\",\\\"value\\\":1}}\"; done"
    )
}

/// Probes with the script; which questions got an answer, and which one ended the program.
fn check_probe(script: &str, answered: &[&str], ended: &[&str]) -> Probed {
    let (program, _folder) = program(script);
    let probed = probe(&candidate(&program), &questions()).unwrap();
    assert_eq!(probed.got.keys().collect::<Vec<_>>(), answered, "{script}\n{probed:?}");
    assert_eq!(probed.ended.keys().collect::<Vec<_>>(), ended, "{script}\n{probed:?}");
    probed
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
    assert_eq!(probed.ended["q1"].outcome, Outcome::Signalled(libc::SIGSEGV));
    check_probe(&answering("case $id in q1|q2) exit 0;; esac;"), &["q0", "q3", "q4"], &["q1", "q2"]);
    check_probe(&answering("case $id in q0) exit 3;; esac;"), &["q1", "q2", "q3", "q4"], &["q0"]);
}

#[test]
fn answers_not_sent_off_before_a_death_are_asked_for_again() {
    let buffered = format!("out=$({}); echo \"$out\"", answering("[ $id = q2 ] && kill -KILL $$;"));
    check_probe(&buffered, &["q0", "q1", "q3", "q4"], &["q2"]);
}

#[test]
fn what_a_program_leaves_out_is_missing_and_asked_once() {
    let probed = check_probe(&answering("[ $id = q1 ] && continue;"), &["q0", "q2", "q3", "q4"], &["q1"]);
    assert_eq!(probed.ended["q1"].outcome, Outcome::Exited(0));
    check_probe("cat > /dev/null", &[], &["q0", "q1", "q2", "q3", "q4"]);
}

#[test]
fn stray_text_and_strange_answers_are_told() {
    let probed =
        check_probe(&answering("echo hello; echo '{\"id\":\"x\",\"value\":1}';"), &["q0", "q1", "q2", "q3", "q4"], &[]);
    assert_eq!(probed.remarks.len(), 2, "{:?}", probed.remarks);
    let twice = check_probe(
        &answering("echo \"{\\\"id\\\":\\\"q0\\\",\\\"value\\\":1}\";"),
        &["q0", "q1", "q2", "q3", "q4"],
        &[],
    );
    assert_eq!(twice.got["q0"], Got::Twice);
}

fn scene() -> Scene {
    let camera = Camera { eye: DVec3::ZERO, right: DVec3::X, up: DVec3::Y, forward: -DVec3::Z, fov_y_deg: 60.0 };
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

/// Has the script make a picture, with `good.png` and `small.png` in $pictures.
fn shot(script: &str) -> Shot {
    let pictures = tempfile::tempdir().unwrap();
    let grey = |width| film::Image::from_fn(width, 3, |_, _| DVec3::splat(0.2));
    film::write(&pictures.path().join("good.png"), &grey(4)).unwrap();
    film::write(&pictures.path().join("small.png"), &grey(3)).unwrap();
    let (program, _folder) = program(&format!("pictures={}\n{script}", pictures.path().display()));
    shoot(&candidate(&program), &scene()).unwrap()
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
