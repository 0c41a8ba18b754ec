//! What the reference's own functions say to a question, in either precision and by any rules.

use glam::{DAffine3, DMat3, DVec3};

use super::question::{Line, Question};
use crate::optics;
use crate::ray::Ray;
use crate::real::Real;
use crate::rules::RuleSource;
use crate::shapes::{Cuboid, Plane, Round, Shear, Solid, Sphere, Square, Triangle};
use crate::vec3::Vec3;
use crate::world::Frame;

/// The numbers of an answer that is no miss, in the scalar `S`.
#[derive(Clone, Debug, PartialEq)]
pub struct Found<S> {
    /// Along the line as given.
    pub t: Option<S>,
    /// The unit normal, or the direction that was asked for. A plane and a square have theirs from
    /// the question.
    pub vector: Option<[S; 3]>,
    /// (α, β, γ) on a triangle.
    pub weights: Option<[S; 3]>,
}

impl<S> Found<S> {
    /// A meeting at `t` alone.
    pub fn at(t: S) -> Self {
        Self { t: Some(t), vector: None, weights: None }
    }

    /// A direction alone.
    pub fn direction(vector: [S; 3]) -> Self {
        Self { t: None, vector: Some(vector), weights: None }
    }

    /// A meeting at `t` with the normal there.
    pub fn hit(t: S, normal: [S; 3]) -> Self {
        Self { t: Some(t), vector: Some(normal), weights: None }
    }
}

/// An answer; a miss is `None`.
pub type Reply = Option<Found<f64>>;

/// A question with its matrix, if it has one, made ready once, as a scene does it for all rays.
#[derive(Clone, Debug)]
pub struct Prepared<T> {
    question: Question,
    frame: Option<Frame<T>>,
}

impl<T: Real> Prepared<T> {
    /// The question made ready for the precision `T`.
    pub fn new(question: &Question) -> Self {
        let frame = match *question {
            Question::TransformedSphere { rows, translation, .. } => Some(frame(rows, translation)),
            Question::Normal { rows, .. } => Some(frame(rows, [0.0; 3])),
            _ => None,
        };
        Self { question: *question, frame }
    }
}

/// The answer of the function that the question is for, computed in the precision `T`. Numbers of
/// the question that `T` does not have are rounded.
pub fn evaluate<T: Real, R: RuleSource>(rules: R, question: &Question) -> Reply {
    answer(rules, &Prepared::<T>::new(question))
}

/// The same of a question made ready.
#[inline]
pub fn answer<T: Real, R: RuleSource>(rules: R, prepared: &Prepared<T>) -> Reply {
    let frame = prepared.frame.as_ref();
    match prepared.question {
        Question::Sphere { line, center, radius } => solid(
            rules,
            &line,
            Solid::<T>::Sphere(Sphere { center: v(center), radius: T::of(radius) }),
        ),
        Question::Plane { line, normal, k } => {
            bare(rules, &line, Solid::<T>::Plane(Plane { normal: v(normal), k: T::of(k) }))
        }
        Question::Square { line } => bare(rules, &line, Solid::<T>::Square(Square)),
        Question::Cuboid { line, min, max } => {
            solid(rules, &line, Solid::<T>::Cuboid(Cuboid { min: v(min), max: v(max) }))
        }
        Question::Round { line, radii, ends, is_capped } => {
            let [[bottom_radius, top_radius], [z_min, z_max]] =
                [radii, ends].map(|pair| pair.map(T::of));
            solid(
                rules,
                &line,
                Solid::Round(Round { bottom_radius, top_radius, z_min, z_max, is_capped }),
            )
        }
        Question::Triangle { line, corners } => {
            triangle(rules, &line, Triangle { corners: corners.map(v::<T>) })
        }
        Question::TransformedSphere { line, .. } => transformed_sphere(rules, &line, frame?),
        Question::Reflect { direction, normal } => {
            Some(Found::direction(out(optics::reflect(rules, v::<T>(direction), v(normal)))))
        }
        Question::Refract { direction, normal, eta_i, eta_t } => {
            optics::refract(rules, v::<T>(direction), v(normal), T::of(eta_i), T::of(eta_t))
                .map(|t| Found::direction(out(t)))
        }
        Question::Normal { normal, .. } => {
            let moved = frame?.normal_to_world(rules, v(normal));
            let is_one = moved.dot(moved).is_finite(); // a matrix without inverse leaves none
            is_one.then(|| Found::direction(out(moved)))
        }
    }
}

fn ray<T: Real>(line: &Line) -> Ray<T> {
    Ray::all_of(v(line.origin), v(line.direction))
}

fn solid<T: Real, R: RuleSource>(rules: R, line: &Line, solid: Solid<T>) -> Reply {
    let ray = ray(line);
    let met = solid.meet(rules, &ray)?;
    Some(Found::hit(met.t.f64(), out(solid.normal_where(rules, &ray, &met))))
}

/// A meeting whose normal is known beforehand.
fn bare<T: Real, R: RuleSource>(rules: R, line: &Line, solid: Solid<T>) -> Reply {
    solid.meet(rules, &ray(line)).map(|met| Found::at(met.t.f64()))
}

fn triangle<T: Real, R: RuleSource>(rules: R, line: &Line, triangle: Triangle<T>) -> Reply {
    if !triangle.has_area() {
        return None;
    }
    let ray = ray(line);
    let met = triangle.meet(rules, &ray, &Shear::of(&ray), 0)?;
    Some(Found {
        weights: Some(out(met.weights)),
        ..Found::hit(met.t.f64(), out(triangle.normal(rules)))
    })
}

fn transformed_sphere<T: Real, R: RuleSource>(rules: R, line: &Line, frame: &Frame<T>) -> Reply {
    let sphere = Solid::Sphere(Sphere { center: Vec3::ZERO, radius: T::HALF });
    let moved = Frame::ray_to_object(rules, &frame.object_from_world, &ray(line));
    let met = sphere.meet(rules, &moved)?;
    let normal = frame.normal_to_world(rules, sphere.normal_where(rules, &moved, &met));
    Some(Found::hit(met.t.f64(), out(normal)))
}

/// The frame as a scene brings it: the inverse is worked out in double precision, then both are
/// rounded.
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
