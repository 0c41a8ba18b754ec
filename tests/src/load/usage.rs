//! Processor time and memory of processes and of the machine, from /proc.

use std::path::Path;
use std::time::Duration;

/// Returns the time that all processors of the machine have worked since it was started. On a
/// machine that does nothing else, the difference of two calls is the cost of what ran meanwhile,
/// whoever has waited for which process.
///
/// # Errors
/// Fails if the system does not say.
pub fn of_machine() -> Result<Duration, String> {
    let text = read(Path::new("/proc/stat"))?;
    let line = text.lines().next().unwrap_or_default();
    let fields: Vec<u64> = line.split_whitespace().filter_map(|word| word.parse().ok()).collect();
    // user, nice, system; then idle and waiting, which are no work
    let ticks = fields.get(..3).ok_or("/proc/stat has another form")?.iter().sum::<u64>();
    Ok(seconds(ticks))
}

/// Returns the processor time of the process `pid`, without that of its children. `None` if it has
/// ended.
pub fn of_process(pid: u32) -> Option<Duration> {
    let text = std::fs::read_to_string(format!("/proc/{pid}/stat")).ok()?;
    // The name in parentheses may hold anything.
    let fields: Vec<&str> = text.rsplit_once(')')?.1.split_whitespace().collect();
    let ticks = |at: usize| fields.get(at)?.parse::<u64>().ok();
    Some(seconds(ticks(11)? + ticks(12)?))
}

/// Returns the largest resident size of the process so far, in bytes. `None` if it has ended.
pub fn peak(pid: u32) -> Option<u64> {
    let text = std::fs::read_to_string(format!("/proc/{pid}/status")).ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    Some(line.trim().strip_suffix(" kB")?.trim().parse::<u64>().ok()? << 10)
}

fn seconds(ticks: u64) -> Duration {
    // 100 on every Linux that is in use.
    Duration::from_millis(ticks * 10)
}

fn read(path: &Path) -> Result<String, String> {
    std::fs::read_to_string(path).map_err(|why| format!("{}: {why}", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn this_process_and_the_machine_have_worked() {
        assert!(of_machine().unwrap() > Duration::ZERO);
        assert!(of_process(std::process::id()).is_some());
        assert!(peak(std::process::id()).unwrap() > 1 << 20);
        assert_eq!((of_process(u32::MAX), peak(u32::MAX)), (None, None));
    }
}
