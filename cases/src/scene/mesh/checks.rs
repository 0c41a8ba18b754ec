//! Checks the vectors of a mesh.

use glam::DVec3;

use super::fault::Fault;
use crate::scene::raw::numbers::{MAX_NUMBER, unit};

/// Returns the position. A coordinate that is not finite or beyond [`MAX_NUMBER`] is a fault.
pub(super) fn checked_position(position: DVec3) -> Result<DVec3, Fault> {
    if position.is_finite() && position.abs().max_element() <= MAX_NUMBER {
        return Ok(position);
    }
    let what =
        format!("this vertex has a coordinate that is not a number of at most {MAX_NUMBER:e}");
    Err(Fault::of_file(what, "correct the coordinate, or scale the mesh"))
}

/// Returns the unit vector along a normal of any length above 0. Any other normal is a fault.
pub(super) fn checked_normal(normal: DVec3) -> Result<DVec3, Fault> {
    let direction = if normal.is_finite() { unit(normal) } else { None };
    let help = "correct the normal, or leave all normals out with `smooth = false`";
    direction.ok_or_else(|| Fault::of_file("this normal has no direction", help))
}
