//! The content of `cases/stages`, resolved: stages, their image cases and their unit checks.

mod allows;
mod args;
pub(crate) mod ask;
mod bounds;
mod checks;
mod folder;
mod load;
mod named;
pub(crate) mod raw;

pub use allows::allowed_at;
pub use bounds::Bounds;
pub use folder::is_case;
pub use load::{load_all, load_case, load_scene, parse_case};

use serde::Serialize;

use crate::effects::Effects;
use crate::probe::Ask;
use crate::scene::Scene;

/// A stage of the assignment, `stages/NN_name`.
#[derive(Clone, Debug)]
pub struct Stage {
    /// The folder's name, such as `02_shadows`; stages are graded in the order of their names.
    pub id: String,
    /// One line for people.
    pub title: String,
    /// A description of the stage, in a few sentences.
    pub about: String,
    /// The effects that its cases may show, as `stage.toml` lists them. A case requests the effects
    /// that its scene calls for, as far as the stage allows them or the course always simulates
    /// them.
    pub allows: Effects,
    /// The picture that earns nothing in its cases: that of a tracer without this stage.
    pub base: Base,
    /// Ids of the stages that a student needs first.
    pub needs: Vec<String>,
    /// Points for all unit checks together, in thousandths.
    pub unit_points: u64,
    /// The thousandths of a case's points up to which counts as right what a known mistake explains
    /// whose rule another stage teaches.
    pub explained_share: u32,
    /// Image cases, ordered by id.
    pub cases: Vec<Case>,
    /// Unit checks, in file order.
    pub checks: Vec<Check>,
}

impl Stage {
    /// Returns the ids of all image cases and unit checks, in order.
    pub fn ids(&self) -> impl Iterator<Item = &str> {
        let checks = self.checks.iter().map(|check| check.id.as_str());
        self.cases.iter().map(|case| case.id.as_str()).chain(checks)
    }
}

/// The picture of a case by a tracer that lacks everything that the stage of the case adds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Base {
    /// The background alone, because before the first stage there is no tracer.
    Background,
    /// The scene without these effects, which the stage is the first to allow.
    Without(Effects),
}

/// An image case, `stages/NN_name/CASE.toml`.
#[derive(Clone, Debug)]
pub struct Case {
    /// Identifier, such as `02_shadows/two_balls`: the file's path below `stages`, without its
    /// ending.
    pub id: String,
    /// One line for people.
    pub title: String,
    /// A description of the test, and of how a wrong picture looks.
    pub about: String,
    /// The rules of light that it tests.
    pub rules: Vec<u8>,
    /// Points in thousandths.
    pub points: u64,
    /// The scene to render. Its effects are limited to those that the stage or the course allows.
    pub scene: Scene,
    /// Bounds within which its numbers may be moved to make another case like it; `None` if the
    /// file gives none.
    pub bounds: Option<Bounds>,
}

/// A unit check: one question to one function, from `stages/NN_name/checks/FILE.toml`.
#[derive(Clone, Debug)]
pub struct Check {
    /// Identifier, such as `01_ray_casting/sphere/tangent`: stage, file, and the name in the file.
    pub id: String,
    /// A description of the test.
    pub about: String,
    /// The rules of light that it tests.
    pub rules: Vec<u8>,
    /// The question.
    pub ask: Ask,
    /// The answer that the author computed by hand, if it holds for the course.
    pub paper: Option<crate::probe::Answer>,
}
