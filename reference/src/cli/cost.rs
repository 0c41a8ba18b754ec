//! `reference cost`: the clock, the user and the files around a measurement.

use std::path::Path;
use std::time::Instant;

use cases::Scene;
use cases::files::{self, is_stdout, is_stream};
use pages::say;

use super::args::CostArgs;
use super::find::{self, Found};
use super::interrupt::Interrupt;
use super::output::{Talk, print_text};
use super::progress::Bar;
use super::stop::Stop;
use super::{cost_page, cost_store};
use crate::cost::bench::Bench;
use crate::cost::forms::Forms;
use crate::cost::functions;
use crate::cost::functions_report::FunctionsReport;
use crate::cost::measure::{self, Measured, Outside};
use crate::cost::plot::{self, Place};
use crate::cost::report::{Machine, Report};
use crate::cost::sweep::{Axes, Sweep};
use crate::rules::Rules;

/// Carries out the command.
pub(super) fn run(args: &CostArgs, talk: Talk) -> Result<(), Stop> {
    let outputs = outputs(args)?;
    args.page.as_deref().map_or(Ok(()), page_fits)?;
    let session = Session::start(args.threads, talk)?;
    if let Some(path) = &args.page {
        return cost_page::run(args, path, &session);
    }
    match &args.scene {
        _ if args.store => cost_store::run(args, &session),
        None => {
            let report = of_functions(args, &session)?;
            write(&report, &outputs, talk)?;
            session.end(report.rounds, args.rounds)
        }
        Some(named) => {
            let report = of_scene(named, args, &session)?;
            write(&report, &outputs, talk)?;
            session.end(report.rounds, args.rounds)
        }
    }
}

/// Measures the scene that `named` names.
pub(super) fn of_scene(named: &str, args: &CostArgs, session: &Session) -> Result<Report, Stop> {
    let Found { mut scene, course, .. } = find::found(named, &args.course)?;
    let rules = Rules::of(&course);
    if let Some((width, height)) = args.size {
        (scene.render.width, scene.render.height) = (width, height);
    }
    let sweep = Sweep::of(&scene, &args.narrowed(Axes::of(&scene)));
    let measured = session.sweep(&scene, &rules, &sweep, usize::from(args.rounds))?;
    Ok(Report::new(named, &scene, &rules, session.machine(), &sweep, &measured, usize::from(args.rounds)))
}

/// Measures one function at a time.
pub(super) fn of_functions(args: &CostArgs, session: &Session) -> Result<FunctionsReport, Stop> {
    let (mut candidates, n_rounds) = (functions::candidates(), usize::from(args.rounds));
    candidates.retain(|candidate| args.asks_for(candidate));
    let mut run = session.run(Bar::steps(functions::work(&candidates, n_rounds), session.talk));
    let measured = functions::measure(&candidates, args.draws, n_rounds, &mut run).ok_or_else(nothing)?;
    Ok(FunctionsReport::new(session.machine(), &measured, args.draws))
}

fn nothing() -> Stop {
    Stop::Interrupted("interrupted before the first round was done: nothing to report".to_owned())
}

/// A form of a report.
#[derive(Clone, Copy, Debug)]
enum Output {
    Json,
    Csv,
    Svg,
    Html,
}

impl Output {
    fn bytes(self, report: &impl Forms) -> Result<Vec<u8>, Stop> {
        match self {
            Self::Json => serde_json::to_vec_pretty(report).map_err(|why| Stop::Machine(why.to_string())),
            Self::Csv => report.csv().map_err(|why| Stop::Machine(why.to_string())),
            Self::Svg => Ok(plot::stack(&report.plots(), Place::File).into_bytes()),
            Self::Html => Ok(report.page().into_bytes()),
        }
    }
}

/// What is asked for, and where it goes; two on one stream would be neither.
fn outputs(args: &CostArgs) -> Result<Vec<(Output, &Path)>, Stop> {
    let all =
        [(Output::Json, &args.json), (Output::Csv, &args.csv), (Output::Svg, &args.svg), (Output::Html, &args.html)];
    let asked: Vec<(Output, &Path)> =
        all.into_iter().filter_map(|(what, path)| Some((what, path.as_deref()?))).collect();
    if asked.iter().filter(|(_, path)| is_stdout(path)).count() > 1 {
        return Err(Stop::Usage("only one of --json, --csv, --svg and --html can go to the output stream".to_owned()));
    }
    // A measurement takes minutes: a name that cannot be written is an error before.
    asked.iter().try_for_each(|(_, path)| files::check(path))?;
    Ok(asked)
}

/// The page has pictures beside it, so that it cannot be a stream.
fn page_fits(path: &Path) -> Result<(), Stop> {
    if is_stream(path) {
        let text = format!("{}: the page has pictures beside it: name a file", path.display());
        return Err(Stop::Usage(text));
    }
    Ok(files::check(path)?)
}

fn write(report: &impl Forms, outputs: &[(Output, &Path)], talk: Talk) -> Result<(), Stop> {
    for (what, path) in outputs {
        put(path, &what.bytes(report)?, talk)?;
    }
    if outputs.iter().any(|(_, path)| is_stdout(path)) {
        return Ok(());
    }
    print_text(&report.text())
}

/// Writes a file whole, or to a stream, and says so where that is wanted.
pub(super) fn put(path: &Path, bytes: &[u8], talk: Talk) -> Result<(), Stop> {
    files::write(path, bytes)?;
    if talk >= Talk::Verbose && !is_stream(path) {
        say::err(&format!("wrote {}", path.display()));
    }
    Ok(())
}

/// What tells the time.
#[derive(Clone, Copy, Debug)]
enum Clock {
    /// That of this program on its processor: what others take there does not count.
    Processor,
    /// Since that moment: of several threads the processor's time would be the sum.
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

/// One or more measurements that the user may stop.
pub(super) struct Session {
    clock: Clock,
    interrupt: Interrupt,
    pool: rayon::ThreadPool,
    pub(super) talk: Talk,
}

impl Session {
    /// Prepares measurements with that many threads, which Ctrl-C ends from now on.
    fn start(threads: u16, talk: Talk) -> Result<Self, Stop> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(usize::from(threads)).build();
        let pool = pool.map_err(|why| Stop::Machine(format!("cannot start threads: {why}")))?;
        let interrupt = Interrupt::catch()?;
        let clock = if threads == 1 { Clock::Processor } else { Clock::Wall(Instant::now()) };
        Ok(Self { clock, interrupt, pool, talk })
    }

    fn run(&self, bar: Bar) -> Run<'_> {
        Run { session: self, bar }
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
        self.pool.install(|| measure::measure(&mut bench, sweep, n_rounds, &mut run)).ok_or_else(nothing)
    }

    /// On what it is measured.
    pub(super) fn machine(&self) -> Machine {
        Machine {
            processor: processor(),
            threads: self.pool.current_num_threads(),
            clock: self.clock.name(),
            is_optimised: !cfg!(debug_assertions),
        }
    }

    /// How the command ends, after that many of the rounds.
    pub(super) fn end(&self, rounds: usize, wanted: u16) -> Result<(), Stop> {
        if self.interrupt.is_set() {
            return Err(Stop::Interrupted(format!("interrupted after {rounds} of {wanted} rounds")));
        }
        Ok(())
    }
}

/// A measurement while it runs.
struct Run<'s> {
    session: &'s Session,
    bar: Bar,
}

impl Outside for Run<'_> {
    fn now_s(&mut self) -> f64 {
        self.session.clock.now_s()
    }

    fn goes_on(&mut self) -> bool {
        !self.session.interrupt.is_set()
    }

    fn done(&mut self, work: u64) {
        self.bar.add(work);
    }
}

/// The processor's model, where the system says it.
fn processor() -> String {
    let text = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let line = text.lines().find(|line| line.starts_with("model name"));
    let name = line.and_then(|line| line.split_once(": ")).map(|(_, name)| name.trim().to_owned());
    name.unwrap_or_else(|| "unknown processor".to_owned())
}
