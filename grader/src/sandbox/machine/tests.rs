//! Failures on made-up machines, and on this one.

use super::super::tests::{SMALL, line};
use super::super::{Folder, Turn, run};
use super::*;

/// Returns a machine that has enough of everything.
fn well() -> Machine {
    Machine {
        place: "/scratch".into(),
        least: Room::ALL,
        taken: Room { bytes: 4096, files: 1 },
        fits: Ok(()),
        can_open: Ok(()),
        can_start: Ok(()),
        memory: Some(4 << 30),
        n_killed: 0,
        lowered: vec![],
    }
}

/// Returns a run that ended with `outcome` and used nothing.
fn ended(outcome: Outcome) -> Finished {
    Finished::without_run(outcome)
}

const NEEDED: u64 = 100_000;

/// Checks the cause of the outcome on the machine.
///
/// `part` is a part of the message, `""` if the machine is not to blame, or `disk` if the program
/// filled the disk.
fn check(machine: &Machine, outcome: Outcome, part: &str) {
    let found = match machine.cause(&ended(outcome.clone()), &SMALL, NEEDED) {
        None => String::new(),
        Some(Cause::FilledDisk) => "disk".to_owned(),
        Some(Cause::Machine(shortage)) => shortage.to_string(),
    };
    assert_eq!(found.is_empty(), part.is_empty(), "{outcome:?} on {machine:?}: {found}");
    assert!(found.contains(part), "{outcome:?} on {machine:?}: {found}");
}

const CRASH: Outcome = Outcome::Exited(1);
const KILLED: Outcome = Outcome::Signalled(libc::SIGKILL);

#[test]
fn a_machine_that_has_enough_is_not_to_blame() {
    for outcome in
        [CRASH, KILLED, Outcome::Exited(0), Outcome::OutOfMemory, Outcome::TimedOut(Clock::Cpu)]
    {
        check(&well(), outcome, "");
    }
}

#[test]
fn a_full_disk_is_the_machines_unless_the_program_filled_it() {
    let no_space = || Err("No space left on device".to_owned());
    check(
        &Machine { fits: no_space(), ..well() },
        CRASH,
        "no room for 100000 bytes (No space left",
    );
    check(&Machine { fits: no_space(), ..well() }, Outcome::Exited(0), "no room");
    let much = Room { bytes: SMALL.folder_size + 1, files: 1 };
    check(&Machine { fits: no_space(), taken: much, ..well() }, CRASH, "disk");
    check(&Machine { taken: much, ..well() }, CRASH, "");
    // The disk was full while the program ran, and is not full any more.
    let least = |bytes| Machine { least: Room { bytes, files: 10 }, ..well() };
    check(&least(NEEDED - 4097), CRASH, "99999 were left");
    check(&least(NEEDED - 4096), CRASH, "");
    let no_names = Machine { least: Room { bytes: u64::MAX, files: 0 }, ..well() };
    check(&no_names, CRASH, "no more files");
}

#[test]
fn exhausted_descriptors_processes_and_memory_are_the_machines() {
    check(
        &Machine { can_open: Err("Too many open files".to_owned()), ..well() },
        CRASH,
        "ulimit -n",
    );
    check(
        &Machine { can_start: Err("Resource temporarily".to_owned()), ..well() },
        CRASH,
        "ulimit -u",
    );
    let little = Machine { memory: Some(100 << 20), ..well() };
    check(&little, Outcome::OutOfMemory, "100 MiB of memory left, less than the 200 MiB");
    check(&little, CRASH, "");
    let killed = Machine { n_killed: 1, ..well() };
    check(&killed, KILLED, "the system killed");
    check(&killed, CRASH, "");
    let greedy = Finished { peak_bytes: SMALL.memory + 1, ..ended(Outcome::OutOfMemory) };
    assert_eq!(little.cause(&greedy, &SMALL, NEEDED), None, "it took more than it may");
}

#[test]
fn a_limit_of_our_own_is_not_the_programs() {
    let lowered = |resource, allowed, is_enough| Machine {
        lowered: vec![Granted { resource, wanted: 1 << 40, allowed, is_enough, hard: allowed }],
        ..well()
    };
    let (out_of_time, full_file) =
        (Outcome::TimedOut(Clock::Cpu), Outcome::TooMuchOutput(Stream::File));
    check(&lowered(Resource::Descriptors, 20, false), CRASH, "20 open files");
    check(&lowered(Resource::Descriptors, 200, true), CRASH, "");
    check(&lowered(Resource::AddressSpace, 1 << 20, false), CRASH, "address space");
    check(&lowered(Resource::AddressSpace, 1 << 30, true), Outcome::OutOfMemory, "address space");
    check(&lowered(Resource::AddressSpace, 1 << 30, true), CRASH, "");
    check(&lowered(Resource::FileSize, 1 << 10, false), full_file.clone(), "KiB in a file");
    check(&lowered(Resource::FileSize, 1 << 10, false), CRASH, "");
    check(&lowered(Resource::Cpu, 5, false), out_of_time.clone(), "5 s of CPU time");
    check(&lowered(Resource::Descriptors, 200, true), full_file, "");
    let used_up = Finished { cpu: SMALL.cpu, ..ended(out_of_time) };
    assert_eq!(
        lowered(Resource::Cpu, 5, true).cause(&used_up, &SMALL, NEEDED),
        None,
        "its own time was over"
    );
}

#[test]
fn this_machine_has_enough_for_a_small_program() {
    let folder = Folder::new().unwrap();
    let call = line("echo x > file; exit 3", folder.path(), SMALL);
    let (finished, _) = run(&call, Turn::Shared);
    assert_eq!(blame(&call, finished.clone()).outcome, Outcome::Exited(3));
    let too_much = Call { needed: 1 << 55, ..call };
    let blamed = blame(&too_much, finished).outcome;
    assert!(matches!(&blamed, Outcome::Machine(Shortage::Room { .. })), "{blamed:?}");
}

#[test]
fn what_the_machine_has_left_can_be_read() {
    can_open().unwrap();
    can_start().unwrap();
    assert!(memory_left().unwrap() > 1 << 20);
}
