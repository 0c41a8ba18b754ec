//! Runs the measurements of `reference cost` with a clock, a bar and Ctrl-C.

use std::path::Path;
use std::time::Instant;

use cases::Scene;
use cases::files::{self, is_stream};
use pages::say;

use super::args::CostArgs;
use super::find::{self, Found};
use super::interrupt::Interrupt;
use super::output::Talk;
use super::progress::Bar;
use super::stop::Stop;
use crate::cost::bench::Bench;
use crate::cost::functions_report::FunctionsReport;
use crate::cost::measure::{self, Measured, Outside};
use crate::cost::report::{Machine, Report};
use crate::cost::setting::Setting;
use crate::cost::starts::{self, StartRow, Way};
use crate::cost::sweep::{Axes, Sweep};
use crate::cost::threads::{self, ThreadRow};
use crate::cost::{facts, functions};
use crate::expect::variations::Precision;
use crate::rules::{RuleSource, Rules};

/// Measures the scene that `named` names.
pub(super) fn of_scene(named: &str, args: &CostArgs, session: &Session) -> Result<Report, Stop> {
    let Found { mut scene, course, .. } = find::found(named, &args.course)?;
    let rules = Rules::of(&course);
    if let Some((width, height)) = args.size {
        (scene.render.width, scene.render.height) = (width, height);
    }
    let sweep = Sweep::of(&scene, &args.narrowed(Axes::of(&scene)));
    let n_rounds = usize::from(args.rounds);
    let measured = session.sweep(&scene, &rules, &sweep, n_rounds)?;
    let machine = session.machine();
    let mut report = Report::new(named, &scene, &rules, machine, &sweep, &measured, n_rounds);
    if !args.no_effects && n_rounds > 1 && !report.is_cut_short {
        let epsilon = [(&rules).epsilon::<f64>()];
        let ways = starts::ways(&rules, &report.own, &[Precision::F64], &epsilon);
        let starts = session.starts(&scene, &ways, n_rounds)?;
        let threads = session.threads(&scene, &rules, n_rounds)?;
        report.facts = facts::of(&report, &starts, &threads);
    }
    Ok(report)
}

/// Measures one function at a time.
pub(super) fn of_functions(args: &CostArgs, session: &Session) -> Result<FunctionsReport, Stop> {
    let (mut candidates, n_rounds) = (functions::candidates(), usize::from(args.rounds));
    candidates.retain(|candidate| args.wants(candidate));
    let mut run = session.run(Bar::steps(functions::work(&candidates, n_rounds), session.talk));
    let measured =
        functions::measure(&candidates, args.draws, n_rounds, &mut run).ok_or_else(nothing)?;
    Ok(FunctionsReport::new(session.machine(), &measured, args.draws))
}

fn nothing() -> Stop {
    Stop::Interrupted("interrupted before the first round was done: nothing to report".to_owned())
}

/// Writes a file as a whole, or to a stream. A verbose command reports the file.
pub(super) fn put(path: &Path, bytes: &[u8], talk: Talk) -> Result<(), Stop> {
    files::write(path, bytes)?;
    if talk >= Talk::Verbose && !is_stream(path) {
        say::err(&format!("wrote {}", path.display()));
    }
    Ok(())
}

/// Returns the digest of the code and cases in the workspace `root`, if it has the sources.
pub(super) fn measured_on(root: &Path) -> Result<Option<String>, Stop> {
    files::sources_digest(root).map_err(Stop::machine("cannot read the sources"))
}

/// The clock of a measurement.
#[derive(Clone, Copy, Debug)]
enum Clock {
    /// The processor time of this process, which excludes other programs.
    Processor,
    /// The time since that moment. With several threads it replaces processor time, which would be
    /// their sum.
    Wall(Instant),
}

impl Clock {
    fn name(self) -> &'static str {
        match self {
            Self::Processor => "processor time",
            Self::Wall(_) => "wall clock",
        }
    }

    fn now_s(self) -> f64 {
        match self {
            Self::Processor => {
                let now = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
                now.tv_sec as f64 + 1e-9 * now.tv_nsec as f64
            }
            Self::Wall(start) => start.elapsed().as_secs_f64(),
        }
    }
}

/// One or more measurements, which the user may interrupt.
pub(super) struct Session {
    clock: Clock,
    interrupt: Interrupt,
    pool: rayon::ThreadPool,
    pub(super) talk: Talk,
}

impl Session {
    /// Prepares measurements with this number of threads. From now on Ctrl-C ends them.
    pub(super) fn start(threads: u16, talk: Talk) -> Result<Self, Stop> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(usize::from(threads)).build();
        let pool = pool.map_err(Stop::machine("cannot start threads"))?;
        let interrupt = Interrupt::catch()?;
        let clock = if threads == 1 { Clock::Processor } else { Clock::Wall(Instant::now()) };
        Ok(Self { clock, interrupt, pool, talk })
    }

    fn run(&self, bar: Bar) -> Run<'_> {
        Run { clock: self.clock, interrupt: &self.interrupt, bar }
    }

    /// Measures a sweep.
    pub(super) fn sweep(
        &self,
        scene: &Scene,
        rules: &Rules,
        sweep: &Sweep,
        n_rounds: usize,
    ) -> Result<Vec<Measured>, Stop> {
        if self.talk >= Talk::Verbose {
            say::err(&format!("measuring {} settings in {n_rounds} rounds", sweep.subjects.len()));
        }
        let mut run = self.run(Bar::pictures(measure::work(sweep, n_rounds), self.talk));
        let mut bench = Bench::new(scene, rules);
        self.pool
            .install(|| measure::measure(&mut bench, sweep, n_rounds, &mut run))
            .ok_or_else(nothing)
    }

    /// Measures ways in which new rays leave surfaces.
    pub(super) fn starts(
        &self,
        scene: &Scene,
        ways: &[Way],
        n_rounds: usize,
    ) -> Result<Vec<StartRow>, Stop> {
        let bar = Bar::pictures(starts::work(ways.len(), n_rounds), self.talk);
        let mut run = self.run(bar);
        self.pool.install(|| starts::measure(scene, ways, n_rounds, &mut run)).ok_or_else(nothing)
    }

    /// Measures a scene on one thread and on several, by the wall clock.
    pub(super) fn threads(
        &self,
        scene: &Scene,
        rules: &Rules,
        n_rounds: usize,
    ) -> Result<Vec<ThreadRow>, Stop> {
        let available = std::thread::available_parallelism().map_or(1, usize::from);
        let pool = |threads: usize| rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let pools: Vec<_> = threads::numbers(available)
            .into_iter()
            .map(pool)
            .collect::<Result<_, _>>()
            .map_err(Stop::machine("cannot start threads"))?;
        let bar = Bar::pictures((pools.len() * n_rounds) as u64, self.talk);
        let clock = Clock::Wall(Instant::now());
        let mut run = Run { clock, interrupt: &self.interrupt, bar };
        let mut bench = Bench::new(scene, rules);
        threads::measure(&mut bench, &Setting::of(scene), &pools, n_rounds, &mut run)
            .ok_or_else(nothing)
    }

    /// Returns the processor, the number of threads and the clock of the measurements.
    pub(super) fn machine(&self) -> Machine {
        Machine {
            processor: processor(),
            threads: self.pool.current_num_threads(),
            clock: self.clock.name(),
            is_optimised: !cfg!(debug_assertions),
        }
    }

    /// Ends a command after `rounds` of the `wanted` rounds. Returns [`Stop::Interrupted`] if the
    /// user has interrupted it.
    pub(super) fn end(&self, rounds: usize, wanted: u16) -> Result<(), Stop> {
        if self.interrupt.is_set() {
            return Err(Stop::Interrupted(format!(
                "interrupted after {rounds} of {wanted} rounds"
            )));
        }
        Ok(())
    }
}

/// A measurement while it runs.
struct Run<'s> {
    clock: Clock,
    interrupt: &'s Interrupt,
    bar: Bar,
}

impl Outside for Run<'_> {
    fn now_s(&mut self) -> f64 {
        self.clock.now_s()
    }

    fn goes_on(&mut self) -> bool {
        !self.interrupt.is_set()
    }

    fn done(&mut self, work: u64) {
        self.bar.add(work);
    }
}

/// Returns the model of the processor, or `unknown processor` if the system does not report it.
fn processor() -> String {
    let text = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let line = text.lines().find(|line| line.starts_with("model name"));
    let name = line.and_then(|line| line.split_once(": ")).map(|(_, name)| name.trim().to_owned());
    name.unwrap_or_else(|| "unknown processor".to_owned())
}
