//! The contract that reference, template and grader share.
//!
//! | module | holds |
//! |---|---|
//! | [`scene`] | the resolved [`Scene`]: plain data without defaults; its JSON form |
//! | [`effects`] | the effects that a scene calls for, and why |
//! | [`files`] | file names; reading and writing whole files |
//! | [`film`] | [`film::Image`], the one quantiser, image files |
//! | [`ray`] | [`Ray`], [`SurfaceHit`], [`Hit`] and the interval in which a hit counts |
//! | [`probe`] | the questions and answers of the unit checks |
//! | [`program`] | `main` of a submission written in Rust |
//! | [`ray_tree`] | the tree of rays behind a pixel, as text |
//!
//! The feature `authoring`, which a student's build leaves off, adds the reading of case files,
//! stages, checks and answers, [`course`], the choices of a course, and [`front`], the cost of
//! accuracy.
//!
//! Conventions: world space is right-handed; colours are linear RGB; pixel (0, 0) is the top left
//! one; a normal is a unit vector and points outwards; a matrix named `target_from_source` takes
//! source coordinates to target coordinates. Rules are cited as `[rule 7]`: see
//! `docs/shading-model.md`.

pub use glam;

#[cfg(feature = "authoring")]
pub mod answer;
#[cfg(feature = "authoring")]
pub mod course;
pub mod effects;
pub mod files;
pub mod film;
#[cfg(feature = "authoring")]
pub mod front;
pub mod maths;
pub mod probe;
#[cfg(feature = "authoring")]
pub mod problem;
pub mod program;
pub mod ray;
pub mod ray_tree;
pub mod scene;
#[cfg(feature = "authoring")]
pub mod schema;
#[cfg(feature = "authoring")]
pub mod stage;

#[cfg(feature = "authoring")]
pub use course::Course;
pub use effects::{Effect, Effects};
pub use ray::{Hit, RAY_EPSILON, Ray, SurfaceHit};
pub use scene::{Camera, Light, Material, Mesh, Object, Scene, Shape};
