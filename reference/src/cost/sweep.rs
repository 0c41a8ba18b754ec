//! The settings that are measured.

use cases::{Effect, Effects, Scene};

use super::setting::{Formula, Setting};
use crate::expect::variations::Precision;

/// The values that each axis takes.
#[derive(Clone, Debug, PartialEq)]
pub struct Axes {
    /// The precisions.
    pub precisions: Vec<Precision>,
    /// The sets of formulas.
    pub formulas: Vec<Formula>,
    /// The values of N, for N × N rays a pixel.
    pub samples: Vec<u32>,
    /// The value of N for the truth, at least the greatest of `samples`.
    pub truth_samples: u32,
    /// The greatest depths of recursion. [rule 13]
    pub depths: Vec<u32>,
    /// The weights below which paths end; 0 for never. [rule 13]
    pub thresholds: Vec<f64>,
    /// The light below which a light source is skipped at a point; 0 for never.
    pub light_cutoffs: Vec<f64>,
    /// Whether another depth or cut-off than the scene's own may be advised.
    pub varies_depth: bool,
    /// Whether all axes are crossed.
    pub full: bool,
    /// Whether effects are measured too: each one switched off alone, and all switched on.
    pub effects: bool,
}

impl Axes {
    /// Returns the axes that make sense for `scene`. If it calls for neither reflection nor
    /// refraction, depth and threshold keep their own values, because they would change nothing.
    /// Without attenuation, no light source is weak at some points only, so that none is skipped.
    pub fn of(scene: &Scene) -> Self {
        let own = Setting::of(scene);
        let (depths, thresholds) = if spawns(scene.effects) {
            (depths(own.max_depth), thresholds(own.threshold))
        } else {
            (vec![own.max_depth], vec![own.threshold])
        };
        let is_attenuated = scene.effects.has(Effect::Attenuation);
        let light_cutoffs = if is_attenuated { light_cutoffs() } else { vec![own.light_cutoff] };
        let samples = vec![1, 2, 4];
        Self {
            precisions: vec![Precision::F32, Precision::F64],
            formulas: Formula::ALL.to_vec(),
            truth_samples: finer(&samples),
            samples,
            depths,
            thresholds,
            light_cutoffs,
            varies_depth: false,
            full: false,
            effects: true,
        }
    }
}

/// Returns the N of a truth that is finer than all `samples`, so that none of them is compared with
/// itself. It is twice the greatest, or 2 for an empty slice.
pub fn finer(samples: &[u32]) -> u32 {
    2 * samples.iter().copied().max().unwrap_or(1)
}

fn spawns(effects: Effects) -> bool {
    effects.has(Effect::Reflection) || effects.has(Effect::Refraction)
}

/// Returns the depths to measure, sorted: all up to `own` (above 8 only powers of two), and up to
/// three greater ones. These are the next two, and twice `own`, but at least 2 and at most 4
/// deeper.
fn depths(own: u32) -> Vec<u32> {
    let below = (0..own).filter(|depth| *depth <= 8 || depth.is_power_of_two());
    let beyond = own.saturating_add(own.clamp(2, 4));
    sorted(below.chain([own, own.saturating_add(1), own.saturating_add(2), beyond]), |a, b| {
        a.cmp(b)
    })
}

fn thresholds(own: f64) -> Vec<f64> {
    sorted([0.0, own, 1e-3, 1.0 / 256.0, 1.0 / 64.0, 1.0 / 16.0], f64::total_cmp)
}

fn light_cutoffs() -> Vec<f64> {
    vec![0.0, 1e-3, 1.0 / 256.0, 1.0 / 64.0]
}

fn sorted<T: PartialEq>(
    values: impl IntoIterator<Item = T>,
    by: impl Fn(&T, &T) -> std::cmp::Ordering,
) -> Vec<T> {
    let mut values: Vec<T> = values.into_iter().collect();
    values.sort_by(by);
    values.dedup();
    values
}

/// The purpose of a measured setting.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum About {
    /// Shows the cost of accuracy.
    Accuracy,
    /// Shows the cost of this effect, which is left out.
    Without(Effect),
    /// Simulates all effects. The effects that the scene does not call for change no pixel, but
    /// cost time.
    Everything,
    /// Shows what trees save: every object and triangle is tested by every ray.
    WithoutTrees,
}

/// The greatest number of objects and triangles for which a picture without trees is measured. With
/// more, it would take longer than all other pictures together.
const MOST_PRIMITIVES: usize = 1000;

/// Returns the number of objects and triangles of a scene, each mesh counted once.
fn n_primitives(scene: &Scene) -> usize {
    scene.objects.len() + scene.meshes.iter().map(|mesh| mesh.triangles.len()).sum::<usize>()
}

/// The settings to measure, and the setting that they are compared with.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep {
    /// The scene's own setting.
    pub own: Setting,
    /// The scene's own setting with the most samples. The errors of sampling are against it.
    pub truth: Setting,
    /// The scene's own setting at the greatest depth without cut-offs. The errors of depth are
    /// against it.
    pub deepest: Setting,
    /// Whether another depth or cut-off than the scene's own may be advised.
    pub varies_depth: bool,
    /// The settings, each with its purpose. The settings of [`About::Accuracy`] come first, without
    /// repetition.
    pub subjects: Vec<(Setting, About)>,
}

impl Sweep {
    /// Returns the settings around the scene's own.
    ///
    /// Precision × formula are crossed in full, in kernels that are compiled alike. Each other axis
    /// varies alone; each grid of more than one ray is also cast adaptively. If `axes.full` is set,
    /// samples, depths and thresholds are crossed with precision × formula as well.
    pub fn of(scene: &Scene, axes: &Axes) -> Self {
        let own = Setting::of(scene);
        let max_depth = axes.depths.iter().copied().fold(own.max_depth, u32::max);
        let deepest = Setting { max_depth, threshold: 0.0, light_cutoff: 0.0, ..own };
        let truth = Setting { samples: axes.truth_samples, ..own };
        let mut settings = vec![own];
        let mut add = |setting: Setting| {
            if !settings.contains(&setting) {
                settings.push(setting);
            }
        };
        let (grids, depths, thresholds) = if axes.full {
            (axes.samples.clone(), axes.depths.clone(), axes.thresholds.clone())
        } else {
            (vec![own.samples], vec![own.max_depth], vec![own.threshold])
        };
        let mut numbers = pairs(&axes.precisions, &axes.formulas);
        // The exact setting comes before the settings that are compared with it.
        numbers.sort_by_key(|one| *one != (Precision::F64, Formula::Robust));
        let alike = Setting { alike: true, ..own };
        if !axes.full && numbers == [(Precision::F64, Formula::Robust)] {
            numbers.clear(); // nothing to compare
        } else {
            add(alike);
        }
        for samples in &grids {
            for (max_depth, threshold) in pairs(&depths, &thresholds) {
                for (precision, formula) in numbers.iter().copied() {
                    let samples = *samples;
                    add(Setting { precision, formula, samples, max_depth, threshold, ..alike });
                }
            }
        }
        axes.samples.iter().for_each(|samples| add(Setting { samples: *samples, ..own }));
        for samples in axes.samples.iter().filter(|samples| **samples > 1) {
            add(Setting { samples: *samples, adaptive: true, ..own });
        }
        axes.depths.iter().for_each(|max_depth| add(Setting { max_depth: *max_depth, ..own }));
        axes.thresholds.iter().for_each(|threshold| add(Setting { threshold: *threshold, ..own }));
        for light_cutoff in &axes.light_cutoffs {
            add(Setting { light_cutoff: *light_cutoff, ..own });
        }
        add(deepest);
        add(truth);
        let accuracy = settings.into_iter().map(|setting| (setting, About::Accuracy));
        let mut effects = if axes.effects { switches(own) } else { Vec::new() };
        if axes.effects && n_primitives(scene) <= MOST_PRIMITIVES {
            effects.push((Setting { trees: false, ..own }, About::WithoutTrees));
        }
        let subjects = accuracy.chain(effects).collect();
        Self { own, truth, deepest, varies_depth: axes.varies_depth, subjects }
    }

    /// Returns a sweep of `subjects`, of which `own` is the first. Their errors are against `own`.
    pub fn against(own: Setting, subjects: Vec<(Setting, About)>) -> Self {
        Self { own, truth: own, deepest: own, varies_depth: false, subjects }
    }

    /// Returns the scene's own setting, and that without each of its effects.
    pub fn of_effects(scene: &Scene) -> Self {
        let own = Setting::of(scene);
        let subjects = std::iter::once((own, About::Accuracy)).chain(without_each(own)).collect();
        Self::against(own, subjects)
    }
}

/// Returns the scene's own setting without each effect that it simulates, and with all effects.
fn switches(own: Setting) -> Vec<(Setting, About)> {
    let everything = Setting { effects: Effects::all().without(Effect::AdaptiveDepth), ..own };
    without_each(own).chain([(everything, About::Everything)]).collect()
}

/// Returns the scene's own setting without each effect that it simulates.
/// [`Effect::AdaptiveDepth`] is switched off by a threshold of 0.
fn without_each(own: Setting) -> impl Iterator<Item = (Setting, About)> {
    let without = move |effect| {
        let threshold = if effect == Effect::AdaptiveDepth { 0.0 } else { own.threshold };
        (Setting { threshold, effects: own.effects.without(effect), ..own }, About::Without(effect))
    };
    own.simulated().iter().map(without)
}

fn pairs<A: Copy, B: Copy>(one: &[A], other: &[B]) -> Vec<(A, B)> {
    one.iter().flat_map(|a| other.iter().map(move |b| (*a, *b))).collect()
}
