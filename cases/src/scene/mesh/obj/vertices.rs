//! The vertices of a Wavefront file: pairs of a position and a normal.

use std::collections::HashMap;

use glam::DVec3;

use super::statements::{Corner, INDICES, NONE, Obj};
use crate::scene::mesh::checks::{checked_normal, checked_position};
use crate::scene::mesh::fault::Fault;

/// The vertices of a mesh: one for every pair of position and normal that a corner has.
pub(super) struct Vertices<'a> {
    obj: &'a Obj<'a>,
    is_smooth: bool,
    /// Latest normal of each position, and the number of the vertex with it.
    latest: Vec<(u32, u32)>,
    /// Numbers of the vertices whose positions have several normals.
    others: HashMap<(u32, u32), u32>,
    pub positions: Vec<DVec3>,
    /// Empty if no corner has a normal.
    pub normals: Vec<DVec3>,
}

impl<'a> Vertices<'a> {
    const UNSEEN: u32 = u32::MAX;

    pub(super) fn new(obj: &'a Obj<'a>, is_smooth: bool) -> Self {
        let latest = vec![(NONE, Self::UNSEEN); obj.positions.len()];
        Self { obj, is_smooth, latest, others: HashMap::new(), positions: vec![], normals: vec![] }
    }

    /// Returns the number of the vertex at a corner, which is added if it is new.
    pub(super) fn number(&mut self, corner: Corner) -> Result<u32, Fault> {
        let Corner { position, normal } = corner;
        let n_positions = self.latest.len();
        let Some(latest) = self.latest.get_mut(position as usize) else {
            let what = format!(
                "there is no vertex {}: the file has {n_positions}",
                u64::from(position) + 1
            );
            return Err(Fault::of_file(what, INDICES));
        };
        if latest.1 != Self::UNSEEN {
            if latest.0 == normal {
                return Ok(latest.1);
            }
            self.others.insert((position, latest.0), latest.1);
            if let Some(known) = self.others.get(&(position, normal)) {
                *latest = (normal, *known);
                return Ok(*known);
            }
        }
        let number = self.positions.len() as u32;
        *latest = (normal, number);
        let vertex = checked_position(self.obj.positions[position as usize])
            .map_err(|fault| Fault { place: self.obj.statement(b"v", position), ..fault })?;
        self.positions.push(vertex);
        if self.is_smooth {
            self.normals.push(self.obj.unit_normal(normal)?);
        }
        Ok(number)
    }
}

impl Obj<'_> {
    fn unit_normal(&self, normal: u32) -> Result<DVec3, Fault> {
        let help = "give every corner a normal, or leave all normals out with `smooth = false`";
        if normal == NONE {
            return Err(Fault::of_file("this corner has no normal, and others have one", help));
        }
        let Some(vector) = self.normals.get(normal as usize) else {
            let n_normals = self.normals.len();
            let what =
                format!("there is no normal {}: the file has {n_normals}", u64::from(normal) + 1);
            return Err(Fault::of_file(what, help));
        };
        checked_normal(*vector)
            .map_err(|fault| Fault { place: self.statement(b"vn", normal), ..fault })
    }
}
