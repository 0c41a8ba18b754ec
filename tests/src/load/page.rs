//! Writes the page `docs/load.md`.

use std::time::Duration;

use super::Load;

/// The bar on the share of the grader itself.
const GRADER_AT_MOST: f64 = 0.10;
/// The bars on how many times less processor time a submission takes than by the scripts.
const FRESH_AT_LEAST: f64 = 50.0;
const WARM_AT_LEAST: f64 = 5.0;
/// The memory of the largest class may exceed that of the smallest by this factor.
const MEMORY_AT_MOST: f64 = 1.5;

/// Returns the page in Markdown.
pub fn page(load: &Load) -> String {
    [head(load), shares(load), beside_scripts(load), memory(load)].concat()
}

fn head(load: &Load) -> String {
    format!(
        "# What grading costs a machine\n\n\
         This page is written by `cargo run --release -p tests --bin load -- --out \
         docs/load.md`, which\nneeds an idle machine, ImageMagick, and some ten minutes. It was \
         measured on {}.\n\n\
         Processor time is that of the whole machine, so that no process is left out. Each of \
         the {}\nsubmissions is an edited copy of the solution, which is compiled, run on all {} \
         image cases twice\nand on all unit checks, and graded under all layers of \
         protection.\n\n",
        load.machine, load.n_graded, load.n_cases
    )
}

fn shares(load: &Load) -> String {
    let cost = &load.graded;
    let share = |part: Duration| part.as_secs_f64() / cost.all.as_secs_f64();
    let row = |what: &str, part: Duration| {
        format!("| {what} | {} | {:.1} % |\n", seconds(part), 100.0 * share(part))
    };
    let is_reached = share(cost.grader) <= GRADER_AT_MOST;
    format!(
        "## One submission of a batch\n\n| part | processor time | share |\n|---|---:|---:|\n\
         {}{}{}{}\n\
         The grader itself should take at most {:.0} % of the time: {}.\n\n",
        row("compiler, linker, starts of programs", cost.compilers()),
        row("the student's program", cost.programs),
        row("the grader: reading, comparing, diagnosing, reports", cost.grader),
        row("all", cost.all),
        100.0 * GRADER_AT_MOST,
        reached(is_reached)
    )
}

fn beside_scripts(load: &Load) -> String {
    let all = load.graded.all.as_secs_f64();
    let times = |cost: &super::script::Cost| cost.all().as_secs_f64() / all;
    let row = |what: &str, cost: &super::script::Cost, least: f64| {
        format!(
            "| {what} | {} | {} | {} | {:.1} | {least:.0} | {} |\n",
            seconds(cost.build),
            seconds(cost.pictures),
            seconds(cost.all()),
            times(cost),
            reached(times(cost) >= least)
        )
    };
    format!(
        "## Beside the script of a course\n\n\
         The script clones the repository, runs `cargo build --release`, renders each case once, \
         and\ncompares the pictures with `compare -metric RMSE` of ImageMagick. It checks no \
         function, protects\nnothing and names no mistake.\n\n\
         | script | clone and build | pictures | all | times this grader | bar | |\n\
         |---|---:|---:|---:|---:|---:|---|\n{}{}\n",
        row("a target folder for each submission", &load.fresh, FRESH_AT_LEAST),
        row("a shared, warm target folder", &load.warm, WARM_AT_LEAST),
    )
}

fn memory(load: &Load) -> String {
    let rows: String = load
        .memory
        .iter()
        .map(|(n, bytes)| format!("| {n} | {:.0} MiB |\n", *bytes as f64 / f64::from(1 << 20)))
        .collect();
    let ends = load.memory.first().zip(load.memory.last());
    let is_flat =
        ends.is_some_and(|(first, last)| last.1 as f64 <= first.1 as f64 * MEMORY_AT_MOST);
    format!(
        "## Memory of the grader\n\nThe peak for a class of small scripts on the exam of flat \
         colours, `tests/exam`.\n\n| submissions | peak |\n|---:|---:|\n{rows}\nThe largest class \
         should take at most {MEMORY_AT_MOST} times the memory of the smallest: {}.\n",
        reached(is_flat)
    )
}

fn reached(is_reached: bool) -> &'static str {
    if is_reached { "reached" } else { "**not reached**" }
}

fn seconds(time: Duration) -> String {
    format!("{:.2} s", time.as_secs_f64())
}

#[cfg(test)]
mod tests {
    use super::super::{batch, script};
    use super::*;

    #[test]
    fn the_page_says_which_bars_are_reached() {
        let ms = Duration::from_millis;
        let load = Load {
            machine: "a machine".to_owned(),
            n_graded: 20,
            n_cases: 60,
            graded: batch::Cost { all: ms(1000), grader: ms(90), programs: ms(400) },
            fresh: script::Cost { build: ms(49_000), pictures: ms(2000) },
            warm: script::Cost { build: ms(2000), pictures: ms(2000) },
            memory: vec![(10, 100 << 20), (500, 120 << 20)],
        };
        let text = page(&load);
        for line in [
            "| compiler, linker, starts of programs | 0.51 s | 51.0 % |",
            "at most 10 % of the time: reached",
            "| 49.00 s | 2.00 s | 51.00 s | 51.0 | 50 | reached |",
            "| 2.00 s | 2.00 s | 4.00 s | 4.0 | 5 | **not reached** |",
            "| 500 | 120 MiB |",
            "of the smallest: reached",
        ] {
            assert!(text.contains(line), "no {line:?} in\n{text}");
        }
    }
}
