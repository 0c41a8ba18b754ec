//! `reference cost`: the clock, the user and the files around a measurement.

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use cases::film;
use signal_hook::consts::{SIGINT, SIGTERM};

use super::args::CostArgs;
use super::progress::Bar;
use super::{Stop, Talk, find, print};
use crate::cost::bench::Bench;
use crate::cost::measure::{self, Outside};
use crate::cost::plot::{self, Place};
use crate::cost::report::{Machine, Report};
use crate::cost::sweep::{Axes, Sweep};
use crate::cost::{csv, page, table};
use crate::rules::Rules;

/// Carries out the command.
pub(super) fn run(args: &CostArgs, talk: Talk) -> Result<(), Stop> {
    let outputs = outputs(args)?;
    let rules = Rules::of(&find::course(&args.scene, &args.course)?);
    let mut scene = find::scene(&args.scene)?;
    if let Some((width, height)) = args.size {
        (scene.render.width, scene.render.height) = (width, height);
    }
    let sweep = Sweep::of(&scene, &args.narrowed(Axes::of(&scene)));
    let n_rounds = usize::from(args.rounds);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(usize::from(args.threads)).build();
    let pool = pool.map_err(|why| Stop::Machine(format!("cannot start threads: {why}")))?;
    let clock = if args.threads == 1 { Clock::Processor } else { Clock::Wall(Instant::now()) };
    let mut session = Session::start(clock, measure::work(&sweep, n_rounds), talk)?;
    if talk >= Talk::Verbose {
        anstream::eprintln!("measuring {} settings in {n_rounds} rounds", sweep.subjects.len());
    }
    let mut bench = Bench::new(&scene, &rules);
    let measured = pool.install(|| measure::measure(&mut bench, &sweep, n_rounds, &mut session));
    let is_stopped = session.is_stopped();
    drop(session);
    let Some(measured) = measured else {
        return Err(Stop::Interrupted("interrupted before the first round was done: nothing to report".to_owned()));
    };
    let machine = Machine {
        processor: processor(),
        threads: usize::from(args.threads),
        clock: clock.name(),
        is_optimised: !cfg!(debug_assertions),
    };
    let report = Report::new(&args.scene, &scene, &rules, machine, &sweep, &measured, n_rounds);
    for (what, path) in &outputs {
        put(path, &what.bytes(&report)?, talk)?;
    }
    if outputs.iter().all(|(_, path)| !is_stream(path)) {
        anstream::print!("{}", table::text(&report));
    }
    if is_stopped {
        Err(Stop::Interrupted(format!("interrupted after {} of {n_rounds} rounds", report.rounds)))
    } else {
        Ok(())
    }
}

/// A form of the report.
#[derive(Clone, Copy, Debug)]
enum Output {
    Json,
    Csv,
    Svg,
    Html,
}

impl Output {
    fn bytes(self, report: &Report) -> Result<Vec<u8>, Stop> {
        match self {
            Self::Json => serde_json::to_vec_pretty(report).map_err(|why| Stop::Machine(why.to_string())),
            Self::Csv => csv::csv(report).map_err(|why| Stop::Machine(why.to_string())),
            Self::Svg => Ok(plot::svg(&page::plots(report)[0], Place::File).into_bytes()),
            Self::Html => Ok(page::page(report).into_bytes()),
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
    Ok(asked)
}

fn is_stream(path: &Path) -> bool {
    path == Path::new("-")
}

fn put(path: &Path, bytes: &[u8], talk: Talk) -> Result<(), Stop> {
    if is_stream(path) {
        return print(bytes);
    }
    film::replace(path, bytes).map_err(|why| Stop::Machine(format!("cannot write {}: {why}", path.display())))?;
    if talk >= Talk::Verbose {
        anstream::eprintln!("wrote {}", path.display());
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

/// A measurement while it runs.
struct Session {
    clock: Clock,
    stop: Arc<AtomicBool>,
    bar: Bar,
}

impl Session {
    /// From now on the first Ctrl-C (or SIGTERM) asks the measurement to end, and a second one ends the program.
    fn start(clock: Clock, work: u64, talk: Talk) -> Result<Self, Stop> {
        let stop = Arc::new(AtomicBool::new(false));
        for signal in [SIGINT, SIGTERM] {
            signal_hook::flag::register_conditional_default(signal, Arc::clone(&stop))
                .and_then(|_| signal_hook::flag::register(signal, Arc::clone(&stop)))
                .map_err(|why| Stop::Machine(format!("cannot wait for Ctrl-C: {why}")))?;
        }
        Ok(Self { clock, stop, bar: Bar::pictures(work, talk) })
    }

    fn is_stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}

impl Outside for Session {
    fn now_s(&mut self) -> f64 {
        self.clock.now_s()
    }

    fn goes_on(&mut self) -> bool {
        !self.is_stopped()
    }

    fn done(&mut self, work: u64) {
        self.bar.add(work);
    }
}

/// The processor's model, where the system says it.
fn processor() -> String {
    let text = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let line = text.lines().find(|line| line.starts_with("model name"));
    line.and_then(|line| line.split_once(": "))
        .map_or_else(|| "unknown processor".to_owned(), |(_, name)| name.to_owned())
}
