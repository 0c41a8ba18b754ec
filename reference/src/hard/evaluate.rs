//! Answers questions with the reference's own functions, in either precision and by any rules.

use glam::{DAffine3, DMat3, DVec3};

use super::question::{Form, Line, Question};
use crate::light::optics;
use crate::numbers::real::Real;
use crate::numbers::vec3::Vec3;
use crate::rays::ray::Ray;
use crate::rules::RuleSource;
use crate::shapes::{Cuboid, Plane, Round, Shear, Solid, Sphere, Square, Triangle};
use crate::world::Frame;

/// The numbers of an answer that is not a miss, in the scalar `S`.
#[derive(Clone, Debug, PartialEq)]
pub struct Found<S> {
    /// The ray parameter of the hit, in units of the direction as given.
    pub t: Option<S>,
    /// The unit normal at the hit, or the direction that is the answer. `None` for a plane and a
    /// square, whose normal does not depend on the hit.
    pub vector: Option<[S; 3]>,
    /// The weights (α, β, γ) of a hit on a triangle.
    pub weights: Option<[S; 3]>,
}

impl<S> Found<S> {
    /// Returns a hit at `t` without a normal.
    pub fn at(t: S) -> Self {
        Self { t: Some(t), vector: None, weights: None }
    }

    /// Returns a direction without a hit.
    pub fn direction(vector: [S; 3]) -> Self {
        Self { t: None, vector: Some(vector), weights: None }
    }

    /// Returns a hit at `t` with the normal there.
    pub fn hit(t: S, normal: [S; 3]) -> Self {
        Self { t: Some(t), vector: Some(normal), weights: None }
    }
}

/// An answer of the reference. A miss is `None`.
pub type Reply = Option<Found<f64>>;

/// A question whose matrix, if it has one, is inverted beforehand, as a scene does once for all
/// rays.
#[derive(Clone, Debug)]
pub struct Prepared<T> {
    question: Question,
    frame: Option<Frame<T>>,
}

impl<T: Real> Prepared<T> {
    /// Prepares a question for the precision `T`.
    pub fn new(question: &Question) -> Self {
        let frame = match *question {
            Question::Transformed { rows, translation, .. } => Some(frame(rows, translation)),
            Question::Normal { rows, .. } => Some(frame(rows, [0.0; 3])),
            _ => None,
        };
        Self { question: *question, frame }
    }
}

/// Returns the answer to a question, computed in the precision `T`. Numbers that `T` cannot
/// represent are rounded first.
pub fn evaluate<T: Real, R: RuleSource>(rules: R, question: &Question) -> Reply {
    answer(rules, &Prepared::<T>::new(question))
}

/// Returns the answer to a prepared question. A triangle without area is a miss, and so is a normal
/// that a singular matrix transforms.
#[inline]
pub fn answer<T: Real, R: RuleSource>(rules: R, prepared: &Prepared<T>) -> Reply {
    let frame = prepared.frame.as_ref();
    match prepared.question {
        Question::Plane { .. } | Question::Square { .. } => {
            let (line, form) = Form::of(prepared.question);
            bare(rules, &line, form_of::<T>(form))
        }
        Question::Sphere { .. } | Question::Cuboid { .. } | Question::Round { .. } => {
            let (line, form) = Form::of(prepared.question);
            solid(rules, &line, form_of::<T>(form))
        }
        Question::Triangle { line, corners } => {
            triangle(rules, &line, Triangle { corners: corners.map(v::<T>) })
        }
        Question::Transformed { line, form, .. } => {
            let (t, normal) = form_of(form).hit_under(rules, frame?, &ray(&line))?;
            Some(Found::hit(t.f64(), out(normal)))
        }
        Question::Reflect { direction, normal } => {
            Some(Found::direction(out(optics::reflect(rules, v::<T>(direction), v(normal)))))
        }
        Question::Refract { direction, normal, eta_i, eta_t } => {
            optics::refract(rules, v::<T>(direction), v(normal), T::of(eta_i), T::of(eta_t))
                .map(|t| Found::direction(out(t)))
        }
        Question::Normal { normal, .. } => {
            let moved = frame?.normal_to_world(rules, v(normal));
            let is_one = moved.dot(moved).is_finite(); // not finite for a singular matrix
            is_one.then(|| Found::direction(out(moved)))
        }
    }
}

fn ray<T: Real>(line: &Line) -> Ray<T> {
    Ray::all_of(v(line.origin), v(line.direction))
}

fn solid<T: Real, R: RuleSource>(rules: R, line: &Line, solid: Solid<T>) -> Reply {
    let ray = ray(line);
    let hit = solid.intersect(rules, &ray)?;
    Some(Found::hit(hit.t.f64(), out(solid.normal_at_hit(rules, &ray, &hit))))
}

/// Returns the hit of a shape whose normal does not depend on the hit.
fn bare<T: Real, R: RuleSource>(rules: R, line: &Line, solid: Solid<T>) -> Reply {
    solid.intersect(rules, &ray(line)).map(|hit| Found::at(hit.t.f64()))
}

fn triangle<T: Real, R: RuleSource>(rules: R, line: &Line, triangle: Triangle<T>) -> Reply {
    if !triangle.has_area() {
        return None;
    }
    let ray = ray(line);
    let hit = triangle.intersect(rules, &ray, &Shear::of(&ray), 0)?;
    Some(Found {
        weights: Some(out(hit.weights)),
        ..Found::hit(hit.t.f64(), out(triangle.normal(rules)))
    })
}

fn form_of<T: Real>(form: Form) -> Solid<T> {
    match form {
        Form::Sphere { center, radius } => {
            Solid::Sphere(Sphere { center: v(center), radius: T::of(radius) })
        }
        Form::Plane { normal, k } => Solid::Plane(Plane { normal: v(normal), k: T::of(k) }),
        Form::Square => Solid::Square(Square),
        Form::Cuboid { min, max } => Solid::Cuboid(Cuboid { min: v(min), max: v(max) }),
        Form::Round { radii, ends, is_capped } => {
            let [[bottom_radius, top_radius], [z_min, z_max]] =
                [radii, ends].map(|pair| pair.map(T::of));
            Solid::Round(Round { bottom_radius, top_radius, z_min, z_max, is_capped })
        }
    }
}

/// Returns the frame as a scene has it: the inverse is computed in double precision, then both
/// matrices are rounded to `T`.
fn frame<T: Real>(rows: [[f64; 3]; 3], translation: [f64; 3]) -> Frame<T> {
    let matrix = DMat3::from_cols_array_2d(&rows).transpose();
    let world_from_object =
        DAffine3 { matrix3: matrix, translation: DVec3::from_array(translation) };
    Frame::of(&world_from_object, &world_from_object.inverse())
}

fn v<T: Real>(v: [f64; 3]) -> Vec3<T> {
    Vec3::of(DVec3::from_array(v))
}

fn out<T: Real>(v: Vec3<T>) -> [f64; 3] {
    v.f64().to_array()
}
