//! Pictures, rendered as tiles in parallel. The number of threads does not change a byte.

use cases::film::Image;
use serde::Serialize;

use crate::numbers::real::Real;
use crate::rules::{Formula, Lecture, LecturePlain, LectureStable, RuleSource, Rules};
use crate::trace::kernel::Kernel;
pub use crate::trace::options::Options;
use crate::trace::simulated::{EffectSource, EyeAlone, WithShadows};
use crate::trace::{adaptive, tiles};
use crate::watch::metered::{Metered, RayBudget};
use crate::watch::work::Amounts;
use crate::watch::{Book, Counts, Ledger, Notes};
use crate::world::World;

/// The rays that a picture took, and the light that it left out.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Stats {
    /// Numbers of rays by kind.
    pub rays: Counts,
    /// Greatest weight of rays that a pixel left out for depth or threshold, channel by channel.
    /// [`crate::trace::cutoff`] bounds their light. [rule 13]
    pub left_out: [f64; 3],
    /// Greatest light that a pixel skipped as too weak, channel by channel.
    pub faint_light: [f64; 3],
}

impl Stats {
    fn of(notes: &Notes) -> Self {
        Self {
            rays: notes.rays,
            left_out: notes.left_out.to_array(),
            faint_light: notes.faint_light.to_array(),
        }
    }
}

/// Renders like [`render`] by rules and effects known only at run time, with a kernel compiled for
/// them. The picture is the same, bit for bit.
///
/// Only the rules of the lecture have such kernels: one for each set of formulas, and for the
/// reference's own formulas one for each of the few sets of effects for which it pays. A kernel
/// that spawns no rays is a loop, not a recursion. Spawned rays cost so much that the branches for
/// other effects are too cheap to measure (docs/decisions/006).
pub fn render_by<T: Real>(
    world: &World<T>,
    rules: &Rules,
    options: &Options,
    progress: impl Fn(u64) + Sync,
) -> (Image, Stats) {
    let Options { effects, light_cutoff, .. } = *options;
    if rules.lecture_by() != Some(Formula::Robust) {
        return render_alike(world, rules, options, progress);
    }
    let (image, notes) = if let Some(effects) = EyeAlone::new(effects, light_cutoff) {
        render_under::<T, _, _, Notes>(world, Lecture, effects, options, progress)
    } else if let Some(effects) = WithShadows::new(effects, light_cutoff) {
        render_under::<T, _, _, Notes>(world, Lecture, effects, options, progress)
    } else {
        return render(world, Lecture, options, progress);
    };
    (image, Stats::of(&notes))
}

/// Renders like [`render_by`], with a kernel that differs from that of other formulas only in the
/// formulas: it can simulate all effects, and searches for one ray at a time. The picture is the
/// same.
pub fn render_alike<T: Real>(
    world: &World<T>,
    rules: &Rules,
    options: &Options,
    progress: impl Fn(u64) + Sync,
) -> (Image, Stats) {
    let options = Options { packets: false, ..*options };
    match rules.lecture_by() {
        Some(Formula::Plain) => render(world, LecturePlain, &options, progress),
        Some(Formula::Stable) => render(world, LectureStable, &options, progress),
        Some(Formula::Robust) => render(world, Lecture, &options, progress),
        None => render(world, rules, &options, progress),
    }
}

/// Renders like [`render_by`] and also counts the work that rays cause. The picture is the same,
/// but takes a little longer.
pub fn count_by<T: Real>(
    world: &World<T>,
    rules: &Rules,
    options: &Options,
    progress: impl Fn(u64) + Sync,
) -> (Image, Stats, Amounts) {
    counted(world, rules, options, None, progress)
}

/// Renders like [`count_by`] within a number of rays of all kinds.
///
/// Returns `None` if the picture takes more than `most` rays. That is found out soon after this
/// many rays were traced. It does not depend on the number of threads.
pub fn count_within<T: Real>(
    world: &World<T>,
    rules: &Rules,
    options: &Options,
    most: u64,
    progress: impl Fn(u64) + Sync,
) -> Option<(Image, Stats, Amounts)> {
    let budget = RayBudget::new(most);
    let picture = counted(world, rules, options, Some(&budget), progress);
    (!budget.is_exceeded()).then_some(picture)
}

fn counted<T: Real>(
    world: &World<T>,
    rules: &Rules,
    options: &Options,
    budget: Option<&RayBudget>,
    progress: impl Fn(u64) + Sync,
) -> (Image, Stats, Amounts) {
    let (fresh, effects) = (Metered::new(Ledger::default(), budget), options.any());
    let (image, book) = if rules.lecture_by() == Some(Formula::Robust) {
        render_in(world, Lecture, effects, options, fresh, progress)
    } else {
        render_in(world, rules, effects, options, fresh, progress)
    };
    let Ledger { notes, work } = book.settled();
    (image, Stats::of(&notes), work)
}

/// Returns the picture and its figures, rendered by the kernel that can simulate all effects.
///
/// It runs in the current `rayon` pool, and calls `progress` with the number of pixels of each
/// finished tile. The tiles and the order of every sum are fixed, so that the number of threads
/// changes nothing.
///
/// ```
/// use reference::{rules::Lecture, trace::render, world::World};
///
/// let text = "render = { size = [2, 1], max_depth = 0 }
///     scene.camera = { eye = [0, 0, 2], look_at = [0, 0, 0], up = [0, 1, 0], fov_y_deg = 20 }
///     scene.materials = { glow = { ke = [0.25, 0.5, 1] } }
///     scene.objects = [{ sphere = {}, material = \"glow\" }]";
/// let scene = cases::scene::parse("glow.toml", text, "".as_ref(), &Default::default()).unwrap();
/// let world = World::<f64>::new(&scene);
/// let (image, stats) = render::render(&world, Lecture, &render::Options::of(&world), |_| {});
/// assert_eq!(image.pixel(0, 0).to_array(), [0.25, 0.5, 1.0]); // the ball emits ke
/// assert_eq!(stats.rays.total(), 2);
/// ```
pub fn render<T: Real, R: RuleSource>(
    world: &World<T>,
    rules: R,
    options: &Options,
    progress: impl Fn(u64) + Sync,
) -> (Image, Stats) {
    let (image, notes) =
        render_under::<T, R, _, Notes>(world, rules, options.any(), options, progress);
    (image, Stats::of(&notes))
}

/// Returns the picture by a kernel that simulates `effects`, and the book of its rays.
pub fn render_under<T: Real, R: RuleSource, E: EffectSource, B: Book>(
    world: &World<T>,
    rules: R,
    effects: E,
    options: &Options,
    progress: impl Fn(u64) + Sync,
) -> (Image, B) {
    render_in(world, rules, effects, options, B::default(), progress)
}

/// Returns the picture, and the book of its rays. Each tile has its own copy of `fresh`, an empty
/// book.
fn render_in<T: Real, R: RuleSource, E: EffectSource, B: Book>(
    world: &World<T>,
    rules: R,
    effects: E,
    options: &Options,
    fresh: B,
    progress: impl Fn(u64) + Sync,
) -> (Image, B) {
    let kernel = Kernel::by(world, rules, effects);
    if !options.adaptive || options.samples == 1 {
        return tiles::render_grid(&kernel, options, fresh, progress);
    }
    let one_ray = Options { samples: 1, ..*options };
    let (coarse, book) = tiles::render_grid(&kernel, &one_ray, fresh, |_| {});
    adaptive::refined(&kernel, options, &coarse, (fresh, book), progress)
}
