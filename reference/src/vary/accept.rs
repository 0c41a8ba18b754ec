//! The conditions for a varied case: it must be as telling and as fair as its original.

use std::fmt;

use cases::film::Image;
use cases::stage::Case;
use cases::{Light, Scene};
use glam::DVec3;

use crate::expect::variations::{Precision, Variation};
use crate::expect::{Set, picture};
use crate::rules::misconceptions::{self, Misconception};
use crate::rules::{Epsilon, Rules};

/// Difference of light above which two pixels count as different: two 8-bit levels.
const DIFFERENT: f64 = 2.0 / 255.0;
/// Smallest share of pixels that must change before a mistake counts as visible. Below it, a wrong
/// picture could still pass the judge.
const SEEN: f64 = 0.005;
/// Fraction of the original's share of pixels that a varied case must keep, for the stage's effect
/// and for visible mistakes.
const KEPT: f64 = 0.5;
/// Share of contested pixels from which on a case is refused.
const CONTESTED: f64 = 0.03;

/// The thoroughness with which a draw is checked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Care {
    /// With a handful of pictures: two correct programs instead of all legal variations.
    Quick,
    /// With the pictures of all legal variations as well, about fifty.
    Whole,
}

/// The measured shares of an accepted draw.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Measured {
    /// The share of pixels that show what the stage adds.
    pub(super) effect: f64,
    /// The share of contested pixels; `None` with [`Care::Quick`].
    pub(super) contested: Option<f64>,
}

/// The features that a case shows, as shares of its pixels.
#[derive(Clone, Debug)]
pub(super) struct Shows {
    /// The index of the stage.
    stage: usize,
    /// Pixels that change without the effects that the stage adds. In the first stage, pixels that
    /// differ from the background.
    pub(super) effect: f64,
    /// For each rule that the case names and whose breaking is visible: the mistakes with their
    /// shares of changed pixels, in descending order.
    broken: Vec<(u8, Vec<(&'static Misconception, f64)>)>,
    /// Materials and lights that the picture does not show, such as a red ball behind another. A
    /// case may be about what it hides, so that a varied case must hide it too.
    hidden: Vec<Hidden>,
}

/// A material or light that no pixel shows, by its index in the scene's list.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Hidden {
    /// The material's own light.
    Material(usize),
    /// The light that arrives directly from this source.
    Light(usize),
}

/// Number of refused draws after which the bounds are reported as too wide.
pub const MOST_DRAWS: u32 = 50;

/// The reason why a draw is refused.
#[derive(Clone, Debug, PartialEq)]
pub enum Refusal {
    /// The draw is not a valid case; the first problem.
    Invalid(String),
    /// The draw calls for other effects than its original.
    Effects,
    /// The effect of the stage shows on too few pixels: their share, and the share that is
    /// required.
    Effect(f64, f64),
    /// Breaking this rule would not be visible.
    Rule(u8),
    /// The picture shows something that the original hides: its name, and the share of pixels.
    Bared(String, f64),
    /// A correct program differs on too many pixels: its freedom, and the share of pixels.
    Unfair(&'static str, f64),
    /// Correct tracers disagree on too large a share of the pixels.
    Contested(f64),
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Invalid(why) => write!(f, "it is not a valid case: {why}"),
            Self::Effects => write!(f, "it calls for other effects than its original"),
            Self::Effect(share, wanted) => {
                let (share, wanted) = (100.0 * share, 100.0 * wanted);
                write!(
                    f,
                    "what the stage adds shows on {share:.1} % of the pixels; at least \
                        {wanted:.1} % are required"
                )
            }
            Self::Rule(rule) => write!(f, "breaking rule {rule} would not be visible"),
            Self::Bared(what, share) => {
                write!(
                    f,
                    "{what}, which must stay hidden, shows on {:.2} % of the pixels",
                    100.0 * share
                )
            }
            Self::Unfair(who, share) => {
                write!(
                    f,
                    "{who} changes {:.2} % of the pixels; at most {:.1} % are allowed",
                    100.0 * share,
                    100.0 * SEEN
                )
            }
            Self::Contested(share) => write!(
                f,
                "correct tracers disagree on {:.1} % of the pixels; less than {:.0} % is allowed",
                100.0 * share,
                100.0 * CONTESTED
            ),
        }
    }
}

impl Refusal {
    /// Returns whether both refusals have the same kind and, for [`Refusal::Rule`], the same rule.
    /// The messages count like refusals together.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Rule(one), Self::Rule(other)) => one == other,
            _ => std::mem::discriminant(self) == std::mem::discriminant(other),
        }
    }
}

impl Shows {
    /// Returns the features that `case` of the stage with index `n` shows by the rules of `set`.
    /// The case is rendered a few dozen times.
    pub(super) fn of(set: &Set, n: usize, case: &Case) -> Self {
        let (rules, right) = (&set.rules, picture(&case.scene, &set.rules, case.scene.effects));
        let of_rule = |rule: u8| {
            let wrong = misconceptions::of(rules).into_iter().filter(|wrong| wrong.rule == rule);
            let mut seen: Vec<_> = wrong
                .map(|wrong| (wrong, broken(case, wrong, rules, &right)))
                .filter(|(_, share)| *share > SEEN)
                .collect();
            seen.sort_by(|a, b| b.1.total_cmp(&a.1));
            (rule, seen)
        };
        let broken = case
            .rules
            .iter()
            .map(|rule| of_rule(*rule))
            .filter(|(_, seen)| !seen.is_empty())
            .collect();
        let materials = (0..case.scene.materials.len()).map(Hidden::Material);
        let all = materials.chain((0..case.scene.lights.len()).map(Hidden::Light));
        let hidden = all.filter(|hidden| hidden.bared(&case.scene, rules, &right) == 0.0).collect();
        Self { stage: n, effect: differing(&right, &set.without(n, case)), broken, hidden }
    }

    /// Returns the measured shares of `varied` if it is as telling and as fair as `original`, the
    /// case from which `self` was made.
    ///
    /// # Errors
    /// The first condition that does not hold.
    pub(super) fn kept_by(
        &self,
        set: &Set,
        original: &Case,
        varied: &Case,
        care: Care,
    ) -> Result<Measured, Refusal> {
        let rules = &set.rules;
        if varied.scene.effects != original.scene.effects {
            return Err(Refusal::Effects);
        }
        let right = picture(&varied.scene, rules, varied.scene.effects);
        let effect = differing(&right, &set.without(self.stage, varied));
        if effect < KEPT * self.effect {
            return Err(Refusal::Effect(effect, KEPT * self.effect));
        }
        for hidden in &self.hidden {
            let share = hidden.bared(&varied.scene, rules, &right);
            if share > 0.0 {
                return Err(Refusal::Bared(hidden.name(&varied.scene), share));
            }
        }
        for (rule, ways) in &self.broken {
            let is_seen = |(wrong, share): &(&Misconception, f64)| {
                broken(varied, wrong, rules, &right) > (KEPT * share).clamp(SEEN, 2.0 * SEEN)
            };
            if !ways.iter().any(is_seen) {
                return Err(Refusal::Rule(*rule));
            }
        }
        fair(varied, rules, &right)?;
        let contested =
            (care == Care::Whole).then(|| set.envelope(varied, right).contested_share());
        match contested {
            Some(share) if share >= CONTESTED => Err(Refusal::Contested(share)),
            _ => Ok(Measured { effect, contested }),
        }
    }
}

impl Hidden {
    /// Returns the share of pixels that show it.
    fn bared(self, scene: &Scene, rules: &Rules, right: &Image) -> f64 {
        let mut scene = scene.clone();
        match self {
            Self::Material(at) => {
                let material = &mut scene.materials[at];
                (material.ke, material.ka, material.kd, material.ks) =
                    (DVec3::ZERO, DVec3::ZERO, DVec3::ZERO, DVec3::ZERO);
            }
            Self::Light(at) => match &mut scene.lights[at] {
                Light::Point { colour, .. } | Light::Directional { colour, .. } => {
                    *colour = DVec3::ZERO
                }
            },
        }
        let effects = scene.effects;
        differing(right, &picture(&scene, rules, effects))
    }

    fn name(self, scene: &Scene) -> String {
        match self {
            Self::Material(at) => format!("material `{}`", scene.materials[at].name),
            Self::Light(at) => format!("lights[{at}]"),
        }
    }
}

/// Returns the share of pixels that change if a program makes the mistake.
fn broken(case: &Case, wrong: &Misconception, rules: &Rules, right: &Image) -> f64 {
    differing(right, &picture(&case.scene, &wrong.in_student_style(rules), case.scene.effects))
}

/// Checks that correct programs of another precision or another epsilon change no more than a share
/// [`SEEN`] of the pixels.
///
/// # Errors
/// The first program that changes more.
fn fair(case: &Case, rules: &Rules, right: &Image) -> Result<(), Refusal> {
    let coarse = Rules { epsilon: Epsilon::Fixed(1e-3), ..rules.plain() };
    let single = Variation {
        name: "single precision".to_owned(),
        precision: Precision::F32,
        rules: rules.plain(),
    };
    for (who, actual) in [
        ("single precision", single.picture(&case.scene, case.scene.effects)),
        ("an epsilon of 1e-3", picture(&case.scene, &coarse, case.scene.effects)),
    ] {
        let share = differing(right, &actual);
        if share > SEEN {
            return Err(Refusal::Unfair(who, share));
        }
    }
    Ok(())
}

/// Returns the share of pixels that differ in a channel of the displayed picture, where light is
/// clamped to 0 to 1.
fn differing(one: &Image, other: &Image) -> f64 {
    let shown = |light: &DVec3| light.clamp(DVec3::ZERO, DVec3::ONE);
    let differ = |(a, b): &(&DVec3, &DVec3)| (shown(a) - shown(b)).abs().max_element() > DIFFERENT;
    one.pixels().iter().zip(other.pixels()).filter(differ).count() as f64
        / one.pixels().len() as f64
}
