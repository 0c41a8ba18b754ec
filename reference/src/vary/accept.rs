//! What must hold for a varied case: it is as telling and as fair as the one it was made from.

use std::fmt;

use cases::film::Image;
use cases::stage::Case;
use cases::{Light, Scene};
use glam::DVec3;

use crate::expect::{Set, picture};
use crate::misconceptions::{self, Misconception};
use crate::rules::{Epsilon, Rules};
use crate::variations::{Precision, Variation};

/// Light that is farther off than this differs: two 8-bit levels.
const DIFFERENT: f64 = 2.0 / 255.0;
/// A picture of which no more of the pixels differ might still be called right.
const SEEN: f64 = 0.005;
/// What the varied case must keep of the share of pixels that show its stage's effect.
const KEPT: f64 = 0.5;
/// Right tracers may disagree on this share of the pixels.
const CONTESTED: f64 = 0.03;

/// How closely a draw is looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Care {
    /// By a handful of pictures: two right programs in the place of all that are legal.
    Quick,
    /// Also by the pictures of all legal variations, some fifty.
    Whole,
}

/// What a draw that will do was measured at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Measured {
    /// The share of pixels that show what the stage adds.
    pub(super) effect: f64,
    /// The share of contested pixels, where it was asked for.
    pub(super) contested: Option<f64>,
}

/// What a case shows, as shares of its pixels.
#[derive(Clone, Debug)]
pub(super) struct Shows {
    /// The index of its stage.
    stage: usize,
    /// Pixels that differ where what the stage adds is left out; in the first stage, from the bare
    /// background.
    pub(super) effect: f64,
    /// For each rule that it names and can show broken: how, the most striking way first.
    broken: Vec<(u8, Vec<(&'static Misconception, f64)>)>,
    /// What the picture does not show, such as a red ball behind another: a case that hides
    /// something is about that.
    hidden: Vec<Hidden>,
}

/// What no pixel shows, by its place in the scene's list.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Hidden {
    /// The material's own light.
    Material(usize),
    /// What comes from the light directly.
    Light(usize),
}

/// Why a draw will not do.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Refusal {
    /// It is no case: the first problem.
    Invalid(String),
    /// It calls for other effects.
    Effects,
    /// What the stage adds shows on too few pixels: this share, where that is wanted.
    Effect(f64, f64),
    /// The rule could be broken and nobody would see it.
    Rule(u8),
    /// What the original hides is in the picture: this, on that share of the pixels.
    Bared(String, f64),
    /// A right program differs on too many pixels: what it does, and on what share.
    Unfair(&'static str, f64),
    /// Right tracers disagree on too large a share of the pixels.
    Contested(f64),
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Invalid(why) => write!(f, "it is no case: {why}"),
            Self::Effects => write!(f, "it calls for other effects than the case it is made from"),
            Self::Effect(share, wanted) => {
                let (share, wanted) = (100.0 * share, 100.0 * wanted);
                write!(
                    f,
                    "what the stage adds shows on {share:.1} % of the pixels, {wanted:.1} % are \
                        wanted"
                )
            }
            Self::Rule(rule) => write!(f, "rule {rule} could be broken and nobody would see it"),
            Self::Bared(what, share) => {
                write!(
                    f,
                    "{what}, which must not be seen, is, on {:.2} % of the pixels",
                    100.0 * share
                )
            }
            Self::Unfair(who, share) => {
                write!(
                    f,
                    "{who} is off on {:.2} % of the pixels, at most {:.1} % are fair",
                    100.0 * share,
                    100.0 * SEEN
                )
            }
            Self::Contested(share) => write!(
                f,
                "right tracers disagree on {:.1} % of the pixels, less than {:.0} % are wanted",
                100.0 * share,
                100.0 * CONTESTED
            ),
        }
    }
}

impl Refusal {
    /// Refusals of one kind count together.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Rule(one), Self::Rule(other)) => one == other,
            _ => std::mem::discriminant(self) == std::mem::discriminant(other),
        }
    }
}

impl Shows {
    /// What `case` of the stage with index `n` shows, rendered a few dozen times by the rules of
    /// `set`.
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

    /// What `varied` is measured at, where it is as telling and as fair as `original`, whose shows
    /// these are.
    ///
    /// # Errors
    /// What does not hold.
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
    /// The share of pixels that show it.
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

/// The pixels that differ where the program makes the mistake.
fn broken(case: &Case, wrong: &Misconception, rules: &Rules, right: &Image) -> f64 {
    differing(right, &picture(&case.scene, &wrong.in_student_style(rules), case.scene.effects))
}

/// Right programs of another precision or another epsilon differ on no more pixels than none would
/// see.
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

/// The share of pixels that differ in a channel, as far as a picture shows it.
fn differing(one: &Image, other: &Image) -> f64 {
    let shown = |light: &DVec3| light.clamp(DVec3::ZERO, DVec3::ONE);
    let differ = |(a, b): &(&DVec3, &DVec3)| (shown(a) - shown(b)).abs().max_element() > DIFFERENT;
    one.pixels().iter().zip(other.pixels()).filter(differ).count() as f64
        / one.pixels().len() as f64
}
