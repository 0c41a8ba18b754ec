//! The results of a run of the benchmark.

use std::fs;

use serde::Serialize;

use super::effects;
use super::{pictures, search, small};

/// All measurements; a section that was left out is `None`.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// The version of this format.
    pub schema: u32,
    /// The machine on which the benchmark ran.
    pub machine: Machine,
    /// The code and cases that were measured, as `cases::files::sources_digest` gives them.
    pub measured_on: Option<String>,
    /// The number of rounds.
    pub n_rounds: usize,
    /// Rendering of whole scenes.
    pub pictures: Option<Vec<pictures::Row>>,
    /// Ray queries in meshes, and building their trees.
    pub search: Option<Vec<search::Row>>,
    /// Whole commands, from start to end.
    pub small: Option<Vec<small::Row>>,
    /// Costs of effects that are not called for.
    pub effects: Option<Vec<effects::UncalledRow>>,
}

/// The machine of a measurement.
#[derive(Clone, Debug, Serialize)]
pub struct Machine {
    /// The model of the processor, as the system names it.
    pub processor: String,
    /// The number of threads that run at once.
    pub n_threads: usize,
    /// The memory in GiB.
    pub memory_gib: f64,
    /// The operating system.
    pub system: String,
    /// The mean number of runnable programs in the minute before. More than a few tenths disturb
    /// the measurement.
    pub load: f64,
    /// The vector extensions of the processor that renderers use.
    pub vectors: Vec<&'static str>,
}

impl Machine {
    /// Returns this machine, as Linux describes it. A text that is missing is `unknown`, a number
    /// NaN.
    pub fn this() -> Self {
        let read = |path: &str| fs::read_to_string(path).unwrap_or_default();
        let (processor, memory, system) =
            (read("/proc/cpuinfo"), read("/proc/meminfo"), read("/etc/os-release"));
        let known = |value: Option<String>| value.unwrap_or_else(|| "unknown".to_owned());
        let flags = field(&processor, "flags").unwrap_or_default();
        let has = |flag: &str| flags.split_whitespace().any(|one| one == flag);
        let kib = field(&memory, "MemTotal")
            .and_then(|kib| kib.split_whitespace().next()?.parse::<f64>().ok());
        Self {
            processor: known(field(&processor, "model name")),
            n_threads: std::thread::available_parallelism().map_or(1, usize::from),
            memory_gib: kib.map_or(f64::NAN, |kib| kib / f64::from(1 << 20)),
            system: known(
                field(&system, "PRETTY_NAME").map(|name| name.trim_matches('"').to_owned()),
            ),
            load: read("/proc/loadavg")
                .split(' ')
                .next()
                .and_then(|load| load.parse().ok())
                .unwrap_or(f64::NAN),
            vectors: [("avx2", "AVX2"), ("avx512f", "AVX-512")]
                .into_iter()
                .filter(|(f, _)| has(f))
                .map(|(_, n)| n)
                .collect(),
        }
    }
}

/// Returns the value of the first line `key: value` or `key=value`.
fn field(text: &str, key: &str) -> Option<String> {
    let value = |line: &str| {
        line.strip_prefix(key)?.trim_start().strip_prefix([':', '=']).map(|v| v.trim().to_owned())
    };
    text.lines().find_map(value)
}

#[cfg(test)]
mod tests {
    use super::field;

    #[test]
    fn the_system_is_read_as_it_describes_itself() {
        let text = "model\t\t: 17\nmodel name\t: Some 9000\nPRETTY_NAME=\"Some Linux\"\n";
        assert_eq!(field(text, "model name").as_deref(), Some("Some 9000"));
        assert_eq!(field(text, "PRETTY_NAME").as_deref(), Some("\"Some Linux\""));
        assert_eq!(field(text, "flags"), None);
    }
}
