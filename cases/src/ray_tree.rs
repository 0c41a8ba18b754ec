//! The tree of rays behind a pixel, recorded while the pixel is traced, and its text.
//!
//! The template's `trace` opens a node with [`enter`], fills it with [`hit`], closes it with
//! [`leave`]. Outside of [`record`], these functions do nothing. The text shows six digits after
//! the point: enough to compare by eye, and few enough that rounding seldom shows.

use std::cell::RefCell;
use std::fmt;

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::ray::Ray;

/// The kind of a ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RayKind {
    /// A ray from the eye through a pixel. [rule 1]
    Eye,
    /// A reflected ray, along R. [rule 7]
    Reflected,
    /// A refracted ray, along T. [rule 8]
    Refracted,
}

/// A ray, its hit, and the rays that it spawned.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RayNode {
    /// The kind of the ray.
    pub kind: RayKind,
    /// Depth; 0 for the eye ray.
    pub depth: u32,
    /// The origin.
    pub origin: DVec3,
    /// The direction.
    pub direction: DVec3,
    /// The hit; `None` is the background.
    pub met: Option<Met>,
    /// The colour that the ray returned, spawned rays included.
    pub colour: DVec3,
    /// The spawned rays, in the order in which they were cast.
    pub children: Vec<RayNode>,
}

/// The hit of a recorded ray.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Met {
    /// The object's name.
    pub object: String,
    /// Parameter along the ray.
    pub t: f64,
    /// The point of the hit.
    pub point: DVec3,
    /// Normal used for shading, turned against the ray. [rule 11]
    pub normal: DVec3,
    /// Whether the ray was inside the object.
    pub inside: bool,
    /// Emission and direct light at the point. [rule 3]
    pub direct: DVec3,
}

thread_local! {
    static OPEN: RefCell<Option<Vec<RayNode>>> = const { RefCell::new(None) };
}

/// Runs `trace` and returns the tree of its rays, or `None` if it opened no node.
pub fn record(trace: impl FnOnce()) -> Option<RayNode> {
    let root = RayNode {
        kind: RayKind::Eye,
        depth: 0,
        origin: DVec3::ZERO,
        direction: DVec3::ZERO,
        met: None,
        colour: DVec3::ZERO,
        children: vec![],
    };
    OPEN.set(Some(vec![root]));
    trace();
    OPEN.take()
        .and_then(|open| open.into_iter().next())
        .and_then(|root| root.children.into_iter().next())
}

/// Opens a node for a ray that is about to be traced; [`leave`] closes it.
pub fn enter(kind: RayKind, depth: u32, ray: &Ray) {
    with_open(|open| {
        open.push(RayNode {
            kind,
            depth,
            origin: ray.origin,
            direction: ray.direction,
            met: None,
            colour: DVec3::ZERO,
            children: vec![],
        });
    });
}

/// Records the hit of the open node's ray. `met` is called only within [`record`].
pub fn hit(met: impl FnOnce() -> Met) {
    with_open(|open| {
        if let Some(node) = open.last_mut() {
            node.met = Some(met());
        }
    });
}

/// Closes the open node with the colour that its ray returned, and returns that colour.
pub fn leave(colour: DVec3) -> DVec3 {
    with_open(|open| {
        if open.len() > 1
            && let (Some(mut node), Some(parent)) = (open.pop(), open.last_mut())
        {
            node.colour = colour;
            parent.children.push(node);
        }
    });
    colour
}

fn with_open(change: impl FnOnce(&mut Vec<RayNode>)) {
    OPEN.with_borrow_mut(|open| {
        if let Some(open) = open {
            change(open);
        }
    });
}

impl fmt::Display for RayNode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.write(f, 0)
    }
}

impl RayNode {
    fn write(&self, f: &mut fmt::Formatter<'_>, indent: usize) -> fmt::Result {
        let pad = "  ".repeat(indent);
        let kind = match self.kind {
            RayKind::Eye => "eye",
            RayKind::Reflected => "reflected",
            RayKind::Refracted => "refracted",
        };
        writeln!(f, "{pad}{kind} ray, depth {}", self.depth)?;
        writeln!(f, "{pad}  origin {} direction {}", triple(self.origin), triple(self.direction))?;
        match &self.met {
            None => writeln!(f, "{pad}  hits nothing")?,
            Some(met) => {
                let side = if met.inside { "inside" } else { "outside" };
                writeln!(f, "{pad}  hits {} from {side} at t {}", met.object, digits(met.t))?;
                writeln!(f, "{pad}  point {} normal {}", triple(met.point), triple(met.normal))?;
                writeln!(f, "{pad}  direct light {}", triple(met.direct))?;
            }
        }
        writeln!(f, "{pad}  colour {}", triple(self.colour))?;
        self.children.iter().try_for_each(|child| child.write(f, indent + 1))
    }
}

fn triple(v: DVec3) -> String {
    format!("({}, {}, {})", digits(v.x), digits(v.y), digits(v.z))
}

/// Formats a number with six digits after the point, without trailing zeros or a minus before zero.
fn digits(x: f64) -> String {
    let text = format!("{x:.6}");
    let text =
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ray(y: f64) -> Ray {
        Ray::new(DVec3::new(0.0, y, 0.0), DVec3::NEG_Y)
    }

    fn met() -> Met {
        Met {
            object: "floor".to_owned(),
            t: 2.0 / 3.0,
            point: DVec3::ZERO,
            normal: DVec3::Y,
            inside: false,
            direct: DVec3::splat(0.25),
        }
    }

    #[test]
    fn children_are_kept_in_the_order_in_which_they_were_cast() {
        let tree = record(|| {
            enter(RayKind::Eye, 0, &ray(1.0));
            hit(met);
            for (kind, red) in [(RayKind::Reflected, 0.5), (RayKind::Refracted, -0.0)] {
                enter(kind, 1, &ray(0.0));
                leave(DVec3::new(red, 0.0, 1e-9));
            }
            assert_eq!(leave(DVec3::ONE), DVec3::ONE);
        });
        let expected = "\
eye ray, depth 0
  origin (0, 1, 0) direction (0, -1, 0)
  hits floor from outside at t 0.666667
  point (0, 0, 0) normal (0, 1, 0)
  direct light (0.25, 0.25, 0.25)
  colour (1, 1, 1)
  reflected ray, depth 1
    origin (0, 0, 0) direction (0, -1, 0)
    hits nothing
    colour (0.5, 0, 0)
  refracted ray, depth 1
    origin (0, 0, 0) direction (0, -1, 0)
    hits nothing
    colour (0, 0, 0)
";
        assert_eq!(tree.unwrap().to_string(), expected);
    }

    #[test]
    fn nothing_is_recorded_outside_of_record() {
        enter(RayKind::Eye, 0, &ray(1.0));
        hit(|| panic!("nothing is recorded"));
        assert_eq!(leave(DVec3::X), DVec3::X);
        assert_eq!(record(|| ()), None);
    }
}
