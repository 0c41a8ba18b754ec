//! The command `reference render`.

use std::path::Path;
use std::time::Instant;

use cases::files;
use cases::film::exr::{Depth, Part, rgb};
use cases::film::{self, Image, Quantiser};
use cases::problem::did_you_mean;
use cases::{Course, Effect, Effects, Scene, effects};
use pages::figures::figure;
use pages::say;

use super::args::{Bits, Precision, RenderArgs};
use super::find::{self, Found};
use super::output::Talk;
use super::progress::Bar;
use super::stats::{LeftOut, Report, Row};
use super::stop::{Stop, too_many_rays};
use crate::expect::students_picture;
use crate::numbers::real::Real;
use crate::rules::Rules;
use crate::rules::misconceptions::{self, Misconception};
use crate::trace::forecast::forecast;
use crate::trace::render::{self, Options, Stats};
use crate::watch::work::Amounts;
use crate::world::World;

/// Runs the command.
pub(super) fn run(args: &RenderArgs, talk: Talk) -> Result<(), Stop> {
    let out = args
        .output
        .as_ref()
        .or(args.out.as_ref())
        .ok_or_else(|| Stop::Usage("OUT is missing".to_owned()))?;
    let form = Format::of(out, args.bits)?;
    files::check(out)?;
    let mut clock = Clock(Instant::now());
    let Found { mut scene, allowed, course } = find::found(&args.scene, &args.course)?;
    let rules = args.formulas.rules(&Rules::of(&course));
    adjust(&mut scene, args, allowed, &course);
    scene.effects = selected(&scene, &args.effects)?;
    if let Some(threshold) = args.threshold {
        cut(&mut scene, threshold, allowed.has(Effect::AdaptiveDepth) || args.effects != "auto")?;
    }
    let reasons = effects::reasons(&scene, &course);
    if args.effects != "auto" {
        let requested = scene.effects;
        effects::simulate_only(&mut scene, requested);
    }
    if !args.mistakes.is_empty() {
        let rules = mistaken(&Rules::of(&course), &args.mistakes)?;
        let image = students_picture(&scene, &rules);
        return files::write(out, &form.bytes(&image, rules.quantiser)?).map_err(Stop::from);
    }
    let load_s = clock.lap();
    // This thread is one of the pool, so that `--threads 1` starts no other.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(args.threads.map_or(0, usize::from));
    let pool = pool.use_current_thread().build();
    let pool = pool.map_err(Stop::machine("cannot start threads"))?;
    let samples = args.samples;
    let fineness = Fineness {
        samples,
        adaptive: args.adaptive,
        light_cutoff: args.light_cutoff,
        counts: args.stats.is_some(),
        max_rays: args.max_rays,
    };
    let (picture, prepare_s) = pool.install(|| match args.precision {
        Precision::F32 => picture::<f32>(&scene, &rules, fineness, talk),
        Precision::F64 => picture::<f64>(&scene, &rules, fineness, talk),
    });
    let (image, stats, work) =
        picture.ok_or_else(|| too_many_rays("the picture", args.max_rays.unwrap_or(u64::MAX)))?;
    let render_s = clock.lap() - prepare_s;
    files::write(out, &form.bytes(&image, rules.quantiser)?)?;
    let write_s = clock.lap();
    if talk >= Talk::Verbose && !files::is_stream(out) {
        say::err(&format!("wrote {}", out.display()));
    }
    let (Some(stats_form), Some(work)) = (args.stats, work) else { return Ok(()) };
    let report = Report {
        width: image.width(),
        height: image.height(),
        precision: if matches!(args.precision, Precision::F32) { "f32" } else { "f64" },
        samples,
        adaptive: args.adaptive,
        threads: pool.current_num_threads(),
        effects: scene.effects,
        rays: stats.rays,
        work,
        by_effect: Row::all(reasons, scene.effects, &stats.rays, &work),
        left_out: LeftOut::of(&scene, &rules, &stats),
        load_s,
        prepare_s,
        render_s,
        write_s,
    };
    report.say(stats_form, files::is_stdout(out))
}

/// Returns the rules of a course with known mistakes, in the plain style of a student.
fn mistaken(course: &Rules, ids: &[String]) -> Result<Rules, Stop> {
    let known = misconceptions::of(course);
    let mut rules = *course;
    let mut made: Vec<&Misconception> = vec![];
    for id in ids {
        let Some(wrong) = known.iter().find(|one| one.id == id) else {
            let meant = did_you_mean(id, known.iter().map(|one| one.id));
            let help = meant.map_or(
                "the mistakes are listed in mistakes.answers.json beside the stages".to_owned(),
                |meant| format!("did you mean `{meant}`?"),
            );
            return Err(Stop::Usage(format!("there is no mistake `{id}`\nhelp: {help}")));
        };
        if let Some(other) = made.iter().find(|one| one.field == wrong.field) {
            return Err(Stop::Usage(format!(
                "`{}` and `{id}` are mistakes of the same decision, which a program takes once",
                other.id
            )));
        }
        (wrong.apply)(&mut rules);
        made.push(wrong);
    }
    Ok(rules.plain())
}

/// Changes the size and the depth of a scene. A greater depth may call for effects that the depth
/// of the file does not.
fn adjust(scene: &mut Scene, args: &RenderArgs, allowed: Effects, course: &Course) {
    if let Some((width, height)) = args.size {
        (scene.render.width, scene.render.height) = (width, height);
    }
    if let Some(max_depth) = args.max_depth {
        let before = effects::called_for(scene, course);
        scene.render.max_depth = max_depth;
        let new = effects::called_for(scene, course).intersection(allowed).difference(before);
        scene.effects = scene.effects.union(new);
    }
}

/// Sets the weight at which paths end; 0 switches adaptive depth off.
fn cut(scene: &mut Scene, threshold: f64, may_adapt: bool) -> Result<(), Stop> {
    scene.render.threshold = threshold;
    if threshold > 0.0 && !may_adapt {
        return Err(Stop::Usage(
            "the case's stage does not allow adaptive_depth\n\
                help: name the effects with --effects, such as --effects all"
                .to_owned(),
        ));
    }
    let effects = scene.effects;
    scene.effects = if threshold > 0.0 {
        effects.with(Effect::AdaptiveDepth)
    } else {
        effects.without(Effect::AdaptiveDepth)
    };
    Ok(())
}

/// Returns the effects that `--effects` requests.
fn selected(scene: &Scene, requested: &str) -> Result<Effects, Stop> {
    let effect = |name: &str| {
        Effect::from_name(name.trim()).ok_or_else(|| {
            let known: Vec<_> = Effect::ALL.iter().map(|effect| effect.name()).collect();
            Stop::Usage(format!(
                "there is no effect `{name}`\nhelp: the effects are {}; or auto, all, none",
                known.join(", ")
            ))
        })
    };
    match requested {
        "auto" => Ok(scene.effects),
        "all" => Ok(Effects::all()),
        "none" => Ok(Effects::NONE),
        list => list.split(',').map(effect).collect(),
    }
}

/// A picture, its figures, and the work if it was counted.
type Picture = (Image, Stats, Option<Amounts>);

/// The settings of a render besides the scene.
#[derive(Clone, Copy, Debug)]
struct Fineness {
    samples: u32,
    adaptive: bool,
    light_cutoff: f64,
    /// Whether the work is counted.
    counts: bool,
    /// The greatest number of rays.
    max_rays: Option<u64>,
}

/// The number of rays for each eye ray beyond which a warning is printed.
const MANY_RAYS: f64 = 100.0;

/// Warns of a tree of rays that explodes.
fn warn<T: Real>(world: &World<T>, rules: &Rules, options: &Options) {
    let Some(expected) = forecast(world, rules, options) else { return };
    if expected.per_eye_ray > MANY_RAYS {
        say::err(&format!(
            "warning: the picture is expected to take {}{} rays, {} for each eye ray\n\
                help: --max-depth or --threshold limits them, and --max-rays N ends the render \
                beyond N rays",
            if options.adaptive { "up to " } else { "" },
            figure(expected.rays),
            figure(expected.per_eye_ray),
        ));
    }
}

/// Returns the picture, and the seconds that it took to build the world. The picture is `None` if
/// it takes more rays than allowed.
fn picture<T: Real>(
    scene: &Scene,
    rules: &Rules,
    fineness: Fineness,
    talk: Talk,
) -> (Option<Picture>, f64) {
    let Fineness { samples, adaptive, light_cutoff, counts, max_rays } = fineness;
    let start = Instant::now();
    let world = World::<T>::new(scene);
    let prepare_s = start.elapsed().as_secs_f64();
    let n_pixels = u64::from(scene.render.width) * u64::from(scene.render.height);
    let options = Options { samples, adaptive, light_cutoff, ..Options::of(&world) };
    if talk >= Talk::Normal {
        warn(&world, rules, &options);
    }
    let n_rays = if adaptive { 1 } else { u64::from(samples) * u64::from(samples) };
    let bar = Bar::rendering(n_pixels, n_rays, talk);
    let progress = |n| bar.add(n);
    let picture = if counts || max_rays.is_some() {
        let most = max_rays.unwrap_or(u64::MAX);
        let picture = render::count_within(&world, rules, &options, most, progress);
        picture.map(|(image, stats, work)| (image, stats, Some(work)))
    } else {
        let (image, stats) = render::render_by(&world, rules, &options, progress);
        Some((image, stats, None))
    };
    (picture, prepare_s)
}

/// A clock that measures laps.
struct Clock(Instant);

impl Clock {
    fn lap(&mut self) -> f64 {
        let seconds = self.0.elapsed().as_secs_f64();
        self.0 = Instant::now();
        seconds
    }
}

/// The file format of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Film(film::Kind),
    Exr,
}

impl Format {
    /// Returns the format by the extension of the name. A stream has no extension, and gets a PNG.
    fn of(out: &Path, bits: Bits) -> Result<Self, Stop> {
        let deep = |kind| {
            if kind == film::Kind::Png && bits == Bits::Sixteen {
                film::Kind::DeepPng
            } else {
                kind
            }
        };
        if out.extension().is_some_and(|end| end.eq_ignore_ascii_case("exr")) {
            return Ok(Self::Exr);
        }
        let stream = || files::is_stream(out).then_some(film::Kind::Png);
        film::Kind::of(out).or_else(stream).map(deep).map(Self::Film).ok_or_else(|| {
            Stop::Usage(format!(
                "{}: the name must end in .png, .pfm or .exr, or be `-`",
                out.display()
            ))
        })
    }

    fn bytes(self, image: &Image, quantiser: Quantiser) -> Result<Vec<u8>, Stop> {
        let bytes = match self {
            Self::Film(kind) => film::encode_by(quantiser, kind, image),
            Self::Exr => {
                let part = Part {
                    name: "colour".to_owned(),
                    planes: rgb("", image, Depth::Float).into(),
                    attached: Vec::new(),
                };
                film::exr::encode((image.width(), image.height()), &[part], "")
            }
        };
        bytes.map_err(Stop::machine("cannot encode the picture"))
    }
}
