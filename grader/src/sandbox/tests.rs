//! Small programs that behave in every way a submission might.

use std::path::Path;

use super::*;

pub(super) const SMALL: Limits = Limits {
    cpu: Duration::from_secs(60),
    idle: Duration::from_secs(60),
    wall: Duration::from_secs(120),
    memory: 200 << 20,
    file_size: 1 << 20,
    folder_size: 8 << 20,
    output: 1 << 20,
    processes: 40,
};

/// Returns the call of a line of shell that starts in `folder`.
pub(super) fn line(script: &str, folder: &Path, limits: Limits) -> Call {
    Call {
        program: "/bin/sh".into(),
        args: vec!["-c".into(), script.into()],
        folder: folder.to_owned(),
        in_memory: false,
        environment: vec![("PATH".into(), "/usr/bin:/bin".into())],
        stdin: vec![],
        limits,
        layers: Layers::default(),
        access: vec![],
        needed: 1 << 16,
    }
}

/// Runs a line of shell in a fresh folder, under these layers.
fn under(layers: Layers, script: &str, stdin: &[u8], limits: Limits) -> (Finished, Folder) {
    let folder = Folder::new().unwrap();
    let call = Call { layers, stdin: stdin.to_vec(), ..line(script, folder.path(), limits) };
    (run(&call, Turn::Shared).0, folder)
}

/// Runs a line of shell in a fresh folder.
fn shell(script: &str, stdin: &[u8], limits: Limits) -> (Finished, Folder) {
    under(available().layers, script, stdin, limits)
}

/// Checks how the script ends, without layers and with all that there are.
fn check(script: &str, limits: Limits, expected: &Outcome) {
    for layers in [Layers::default(), available().layers] {
        let (finished, _folder) = under(layers, script, b"", limits);
        let said = finished.stderr_text();
        assert_eq!(&finished.outcome, expected, "{layers}: {script}\n{said:?}");
    }
}

#[test]
fn ends_by_itself() {
    check("exit 0", SMALL, &Outcome::Exited(0));
    check("exit 75", SMALL, &Outcome::Exited(75));
    check("kill -SEGV $$", SMALL, &Outcome::Signalled(libc::SIGSEGV));
}

#[test]
fn time_is_limited_by_three_clocks() {
    let wall = Limits { wall: Duration::from_millis(300), ..SMALL };
    check("sleep 100", wall, &Outcome::TimedOut(Clock::Wall));
    let idle = Limits { idle: Duration::from_millis(300), ..SMALL };
    check("sleep 100", idle, &Outcome::TimedOut(Clock::Idle));
    check("kill -STOP $$", idle, &Outcome::TimedOut(Clock::Idle));
    let cpu = Limits { cpu: Duration::from_secs(1), ..SMALL };
    check("while :; do :; done", cpu, &Outcome::TimedOut(Clock::Cpu));
}

#[test]
fn cpu_time_counts_for_all_processes_together() {
    let cpu = Limits { cpu: Duration::from_secs(2), ..SMALL };
    let loops = "for i in 1 2 3 4; do (while :; do :; done) & done; wait";
    check(loops, cpu, &Outcome::TimedOut(Clock::Cpu));
    // Neither the process that computes nor the one that waits for it is idle.
    let idle = Limits { idle: Duration::from_millis(300), ..SMALL };
    let count = "(i=0; while [ $i -lt 300000 ]; do i=$((i+1)); done); exit 5";
    check(count, idle, &Outcome::Exited(5));
}

#[test]
fn many_small_files_are_too_much_for_the_folder() {
    let script = "for i in $(seq 40); do head -c 1000000 /dev/zero > f$i; done; sleep 30";
    check(script, SMALL, &Outcome::TooMuchOutput(Stream::Files));
}

#[test]
fn floods_are_cut_and_distinguished() {
    check("yes", SMALL, &Outcome::TooMuchOutput(Stream::Stdout));
    check("yes >&2", SMALL, &Outcome::TooMuchOutput(Stream::Stderr));
    check("exec dd if=/dev/zero of=big bs=65536", SMALL, &Outcome::TooMuchOutput(Stream::File));
    let (finished, _folder) = shell("yes", b"", SMALL);
    assert_eq!(finished.stdout.len() as u64, SMALL.output);
}

#[test]
fn memory_is_limited_for_one_process_and_for_a_group() {
    let hoard = |mib: usize| {
        format!(
            "dd if=/dev/zero bs={mib}M count=1 2>/dev/null | (sleep 0; tail -c {mib}M) | sleep 30"
        )
    };
    check(&hoard(300), SMALL, &Outcome::OutOfMemory);
    let several = "for i in 1 2 3 4; do (x=$(head -c 60000000 /dev/zero | tr '\\0' a); sleep 30; \
        :) & done; wait";
    check(several, SMALL, &Outcome::OutOfMemory);
    check(
        "echo 'memory allocation of 99 bytes failed' >&2; kill -ABRT $$",
        SMALL,
        &Outcome::OutOfMemory,
    );
}

#[test]
fn too_many_processes_are_ended() {
    check("for i in $(seq 100); do sleep 30 & done; wait", SMALL, &Outcome::TooManyProcesses);
}

#[test]
fn a_program_that_is_not_there_could_not_start() {
    let folder = Folder::new().unwrap();
    let call = Call { program: folder.path().join("nothing"), ..line("", folder.path(), SMALL) };
    assert!(matches!(run(&call, Turn::Shared).0.outcome, Outcome::NoProgram(_)));
}

#[test]
fn streams_cannot_lock_each_other() {
    let text = vec![b'x'; 500_000];
    let (finished, _folder) = shell("cat; cat /dev/zero | head -c 300000 >&2", &text, SMALL);
    assert_eq!(finished.outcome, Outcome::Exited(0));
    assert_eq!(finished.stdout, text);
    let (finished, _folder) = shell("exec <&-; echo done", &text, SMALL);
    assert_eq!((finished.outcome, finished.stdout), (Outcome::Exited(0), b"done\n".to_vec()));
}

#[test]
fn children_left_behind_are_killed_and_counted() {
    let (finished, folder) =
        shell("(while :; do date > alive; sleep 0.01; done) & sleep 0.2; exit 3", b"", SMALL);
    assert_eq!(finished.outcome, Outcome::Exited(3));
    assert!(finished.left_behind >= 1);
    let alive = folder.path().join("alive");
    std::fs::remove_file(&alive).unwrap();
    std::thread::sleep(Duration::from_millis(200));
    assert!(!alive.exists(), "a child went on writing");
}

/// A process that leaves its group and session, and whose parent has ended, is still one of the
/// program.
#[test]
fn no_process_escapes_into_a_session_of_its_own() {
    let script = "setsid sh -c 'while :; do date > alive; sleep 0.01; done' & \
        until [ -e alive ]; do sleep 0.01; done; exit 3";
    for layers in [Layers::default(), available().layers] {
        let (finished, folder) = under(layers, script, b"", SMALL);
        assert_eq!(finished.outcome, Outcome::Exited(3), "{layers}: {:?}", finished.stderr_text());
        assert!(finished.left_behind >= 1, "{layers}");
        let alive = folder.path().join("alive");
        std::fs::remove_file(&alive).unwrap();
        std::thread::sleep(Duration::from_millis(200));
        assert!(!alive.exists(), "{layers}: a process went on writing");
    }
}

/// A launcher that cannot set up a layer starts nothing.
#[test]
fn a_layer_that_cannot_be_set_up_is_not_left_out() {
    let folder = Folder::new().unwrap();
    let gone = folder.path().join("gone");
    let call = line("echo ran > /dev/null", &gone, SMALL);
    let (finished, _) = run(&Call { layers: available().layers, ..call }, Turn::Shared);
    assert!(!matches!(finished.outcome, Outcome::Exited(_)), "{:?}", finished.outcome);
}

#[test]
fn environment_and_folder_are_those_given() {
    let (finished, folder) = shell("env; pwd", b"", SMALL);
    let text = String::from_utf8(finished.stdout).unwrap();
    let names: Vec<&str> =
        text.lines().filter_map(|line| line.split_once('=')).map(|(name, _)| name).collect();
    assert!(
        names.iter().all(|name| ["PATH", "PWD", "OLDPWD", "SHLVL", "_"].contains(name)),
        "{names:?}"
    );
    assert!(text.ends_with(&format!("{}\n", folder.path().canonicalize().unwrap().display())));
}

#[test]
fn time_and_memory_are_measured() {
    let (finished, _folder) =
        shell("x=$(head -c 20000000 /dev/zero | tr '\\0' a); sleep 0.3", b"", SMALL);
    assert_eq!(finished.outcome, Outcome::Exited(0));
    assert!(finished.wall >= Duration::from_millis(300) && finished.cpu > Duration::ZERO);
    assert!(finished.peak_bytes > 20_000_000, "{} bytes", finished.peak_bytes);
}

/// Runs a line of shell in a folder in memory, which begins with the file `input`.
fn in_memory(script: &str) -> (Finished, Work, Folder) {
    let folder = Folder::new().unwrap();
    std::fs::write(folder.path().join("input"), "given").unwrap();
    let call = line(script, folder.path(), SMALL);
    let call = Call { in_memory: true, layers: available().layers, ..call };
    let (finished, work) = run(&call, Turn::Shared);
    (finished, work, folder)
}

#[test]
fn a_folder_in_memory_leads_to_what_the_program_wrote() {
    let (finished, work, folder) = in_memory("cat input > output; pwd; mkdir -p a/b; exit 4");
    assert_eq!(finished.outcome, Outcome::Exited(4), "{:?}", finished.stderr_text());
    assert_eq!(std::fs::read_to_string(work.path().join("output")).unwrap(), "given");
    let shown = format!("{}\n", folder.path().canonicalize().unwrap().display());
    assert_eq!(String::from_utf8(finished.stdout).unwrap(), shown);
    assert_eq!(finished.least, Room::ALL, "no other program can fill it");
    if available().layers.namespaces {
        let on_disk: Vec<_> = std::fs::read_dir(folder.path()).unwrap().flatten().collect();
        assert_eq!(on_disk.len(), 1, "nothing is written to the disk: {on_disk:?}");
    }
}

#[test]
fn a_folder_in_memory_has_a_size() {
    let many = "for i in $(seq 40); do head -c 1000000 /dev/zero > f$i; done; exit 3";
    for script in [many, "for i in $(seq 40); do head -c 1000000 /dev/zero > f$i; done; sleep 30"] {
        let (finished, work, _folder) = in_memory(script);
        let expected = Outcome::TooMuchOutput(Stream::Files);
        assert_eq!(finished.outcome, expected, "{script}: {:?}", finished.stderr_text());
        if available().layers.namespaces {
            assert!(room::taken(work.path()).bytes <= SMALL.folder_size + (1 << 20), "{script}");
        }
    }
}
