//! `reference cost`: the clock, the user and the files around a measurement.

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use cases::{Scene, film};
use pages::say;
use signal_hook::consts::{SIGINT, SIGTERM};

use super::args::CostArgs;
use super::find::{self, Found};
use super::progress::Bar;
use super::{Stop, Talk, cost_page, cost_store, print, print_text};
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
    let session = Session::start(args.threads, talk)?;
    if let Some(path) = &args.page {
        has_folder(path)?;
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
    if asked.iter().filter(|(_, path)| is_stream(path)).count() > 1 {
        return Err(Stop::Usage("only one of --json, --csv, --svg and --html can go to the output stream".to_owned()));
    }
    asked.iter().filter(|(_, path)| !is_stream(path)).try_for_each(|(_, path)| has_folder(path))?;
    Ok(asked)
}

fn is_stream(path: &Path) -> bool {
    path == Path::new("-")
}

/// A measurement takes minutes: that there is nowhere to write is said before.
fn has_folder(path: &Path) -> Result<(), Stop> {
    match path.parent() {
        _ if path.is_dir() => Err(Stop::Machine(format!("cannot write {}: it is a folder", path.display()))),
        Some(folder) if folder != Path::new("") && !folder.is_dir() => {
            Err(Stop::Machine(format!("cannot write {}: there is no folder `{}`", path.display(), folder.display())))
        }
        _ => Ok(()),
    }
}

fn write(report: &impl Forms, outputs: &[(Output, &Path)], talk: Talk) -> Result<(), Stop> {
    for (what, path) in outputs {
        put(path, &what.bytes(report)?, talk)?;
    }
    if outputs.iter().all(|(_, path)| !is_stream(path)) {
        print_text(&report.text())?;
    }
    Ok(())
}

/// Writes a file whole, or to the output stream.
pub(super) fn put(path: &Path, bytes: &[u8], talk: Talk) -> Result<(), Stop> {
    if is_stream(path) {
        return print(bytes);
    }
    film::replace(path, bytes).map_err(|why| Stop::Machine(format!("cannot write {}: {why}", path.display())))?;
    if talk >= Talk::Verbose {
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
    stop: Arc<AtomicBool>,
    pool: rayon::ThreadPool,
    pub(super) talk: Talk,
}

impl Session {
    /// From now on the first Ctrl-C (or SIGTERM) asks the measurement to end, and a second one ends the program.
    fn start(threads: u16, talk: Talk) -> Result<Self, Stop> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(usize::from(threads)).build();
        let pool = pool.map_err(|why| Stop::Machine(format!("cannot start threads: {why}")))?;
        let stop = Arc::new(AtomicBool::new(false));
        for signal in [SIGINT, SIGTERM] {
            signal_hook::flag::register_conditional_default(signal, Arc::clone(&stop))
                .and_then(|_| signal_hook::flag::register(signal, Arc::clone(&stop)))
                .map_err(|why| Stop::Machine(format!("cannot wait for Ctrl-C: {why}")))?;
        }
        let clock = if threads == 1 { Clock::Processor } else { Clock::Wall(Instant::now()) };
        Ok(Self { clock, stop, pool, talk })
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
        if self.stop.load(Ordering::Relaxed) {
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
        !self.session.stop.load(Ordering::Relaxed)
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
