//! Resolves shapes as they are written. Meshes need more, and are resolved in `resolve`.

use std::ops::Range;

use super::model::Shape;
use super::raw::numbers::unit;
use super::raw::objects::{RawBox, RawCone, RawCylinder, RawObject, RawPlane};
use super::raw::read::Notes;

/// Returns the shape of `raw`, or `None` if it is a mesh or a group, if there is no shape, or after
/// noting a problem.
pub(crate) fn shape(raw: &RawObject, notes: &mut Notes) -> Option<Shape> {
    if let Some(sphere) = &raw.sphere {
        return Some(Shape::Sphere { center: sphere.center.get(), radius: sphere.radius.get() });
    }
    if raw.square.is_some() {
        return Some(Shape::Square {});
    }
    None.or_else(|| raw.r#box.as_ref().and_then(|raw| cuboid(raw, notes)))
        .or_else(|| raw.plane.as_ref().and_then(plane))
        .or_else(|| raw.cylinder.as_ref().and_then(|raw| cylinder(raw, notes)))
        .or_else(|| raw.cone.as_ref().and_then(|raw| cone(raw, notes)))
}

fn cuboid(raw: &RawBox, notes: &mut Notes) -> Option<Shape> {
    let (min, max) = (raw.min.get(), raw.max.get());
    if !min.cmplt(max).all() {
        notes.add(
            raw.max.span.clone(),
            "this box is empty",
            "`max` must be above `min` on every axis",
        );
        return None;
    }
    Some(Shape::Box { min, max })
}

/// Returns a plane with N as a unit vector, and with k divided by the length of N. [rule 15]
fn plane(raw: &RawPlane) -> Option<Shape> {
    let normal = raw.normal.get();
    let length = normal.length();
    Some(Shape::Plane { normal: unit(normal)?, k: raw.k.get() / length })
}

fn cylinder(raw: &RawCylinder, notes: &mut Notes) -> Option<Shape> {
    let (z_min, z_max) = (raw.z_min.get(), raw.z_max.get());
    rises(z_min, z_max, &raw.z_max.span, notes)?;
    Some(Shape::Cylinder { radius: raw.radius.get(), z_min, z_max, capped: raw.capped })
}

fn cone(raw: &RawCone, notes: &mut Notes) -> Option<Shape> {
    let (z_min, z_max) = (raw.z_min.get(), raw.z_max.get());
    let (bottom_radius, top_radius) = (raw.bottom_radius.get(), raw.top_radius.get());
    let rises = rises(z_min, z_max, &raw.z_max.span, notes);
    if bottom_radius == top_radius {
        let problem = notes.add(
            raw.top_radius.span.clone(),
            "this cone has the same radius at both ends",
            "that is a cylinder",
        );
        problem.help("use `cylinder`");
        return None;
    }
    rises?;
    Some(Shape::Cone { bottom_radius, top_radius, z_min, z_max, capped: raw.capped })
}

fn rises(z_min: f64, z_max: f64, span: &Range<usize>, notes: &mut Notes) -> Option<()> {
    if z_min < z_max {
        return Some(());
    }
    notes.add(
        span.clone(),
        "the upper end lies below the lower one",
        "`z_max` must be above `z_min`",
    );
    None
}
