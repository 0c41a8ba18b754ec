//! Runs programs to their end and measures their time. The only unsafe code here is the call that
//! returns the time.
#![allow(unsafe_code)]

use std::ffi::OsStr;
use std::fs::File;
use std::io;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

/// The time and the output of a program.
#[derive(Clone, Debug)]
pub struct Spent {
    /// Wall time, in seconds.
    pub wall_s: f64,
    /// User and system time of the program and of the children that it waited for, in seconds.
    pub cpu_s: f64,
    /// The output, both streams in one.
    pub said: String,
}

/// Runs a program to its end. Its output goes to a file in `folder`, so that nobody has to read a
/// pipe meanwhile.
///
/// # Errors
/// Returns an error if the program cannot be run, or if it fails, with the end of its output.
pub fn run(command: &mut Command, folder: &Path) -> Result<Spent, String> {
    run_to(command, folder, &[0])
}

/// Runs a program like [`run`], but accepts each of the exit codes in `codes`, or any exit code if
/// `codes` is empty.
///
/// # Errors
/// Returns the same errors as [`run`]. Any other exit code is a failure.
pub fn run_to(command: &mut Command, folder: &Path, codes: &[i32]) -> Result<Spent, String> {
    let name = command.get_program().to_string_lossy().into_owned();
    let wrong = |why: io::Error| format!("{name}: {why}");
    let log = folder.join("said.txt");
    let file = File::create(&log).map_err(wrong)?;
    command
        .stdout(file.try_clone().map_err(wrong)?)
        .stderr(file)
        .stdin(std::process::Stdio::null());
    let begun = Instant::now();
    let child = command.spawn().map_err(wrong)?;
    let (status, cpu_s) = wait(child.id()).map_err(wrong)?;
    let wall_s = begun.elapsed().as_secs_f64();
    let said = String::from_utf8_lossy(&std::fs::read(&log).map_err(wrong)?).into_owned();
    if !libc::WIFEXITED(status) || !(codes.is_empty() || codes.contains(&libc::WEXITSTATUS(status)))
    {
        let arguments: Vec<_> = command.get_args().map(OsStr::to_string_lossy).collect();
        let end: Vec<&str> = said.lines().rev().take(12).collect();
        let end: Vec<&str> = end.into_iter().rev().collect();
        return Err(format!("{name} {} fails:\n{}", arguments.join(" "), end.join("\n")));
    }
    Ok(Spent { wall_s, cpu_s, said })
}

/// Waits for the child, and returns its status and its CPU seconds.
fn wait(pid: u32) -> io::Result<(i32, f64)> {
    let mut status = 0;
    // SAFETY: rusage is plain data, for which zeros are valid.
    let mut usage: libc::rusage = unsafe { std::mem::zeroed() };
    loop {
        // SAFETY: both places live through the call; the child is ours, and nobody else waits for
        // it.
        if unsafe { libc::wait4(pid.cast_signed(), &mut status, 0, &mut usage) } >= 0 {
            return Ok((status, seconds(usage.ru_utime) + seconds(usage.ru_stime)));
        }
        let why = io::Error::last_os_error();
        if why.kind() != io::ErrorKind::Interrupted {
            return Err(why);
        }
    }
}

fn seconds(time: libc::timeval) -> f64 {
    time.tv_sec as f64 + time.tv_usec as f64 * 1e-6
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_and_output_are_returned() {
        let folder = tempfile::tempdir().expect("a folder");
        let shell = |script: &str| run(Command::new("sh").args(["-c", script]), folder.path());
        let spent = shell("echo out; echo err >&2; sleep 0.05").expect("it succeeds");
        assert_eq!(spent.said, "out\nerr\n");
        assert!(spent.wall_s >= 0.05 && spent.cpu_s < spent.wall_s, "{spent:?}");
        let why = shell("echo too bad; exit 3").expect_err("it fails");
        assert!(why.contains("too bad"), "{why}");
        for (codes, is_ok) in [(&[0, 1][..], true), (&[0, 2], false), (&[], true)] {
            assert_eq!(
                run_to(&mut Command::new("false"), folder.path(), codes).is_ok(),
                is_ok,
                "{codes:?}"
            );
        }
        assert!(run(&mut Command::new("no such program"), folder.path()).is_err());
    }
}
