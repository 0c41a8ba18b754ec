//! Searches of a world for packets of eye rays.

use arrayvec::ArrayVec;

use super::World;
use crate::numbers::real::Real;
use crate::rays::ray::Ray;
use crate::rules::Lecture;
use crate::shapes::ShapeHit;
use crate::watch::work::{Tally, TriangleVisits, Work};
use crate::world::object::ObjectShape;
use crate::world::packet::MOST;

impl<T: Real> World<T> {
    /// Returns whether [`World::first_of_packet`] can be faster than one search per ray: only where
    /// every ray is tested against a mesh.
    pub fn gains_by_packets(&self) -> bool {
        self.tree.is_none()
            && self.objects.iter().any(|object| matches!(object.shape, ObjectShape::Mesh(_)))
    }

    /// Returns what [`World::first`] returns for each of at most [`MOST`] rays, by the rules of the
    /// lecture.
    ///
    /// This pays for rays that leave one point in nearly one direction. Within a mesh, `tally`
    /// counts a visit of the whole packet once.
    ///
    /// # Panics
    /// Panics for more than [`MOST`] rays.
    pub fn first_of_packet<Y: Tally>(
        &self,
        rays: &[Ray<T>],
        tally: &mut Y,
    ) -> ArrayVec<Option<(usize, ShapeHit<T>)>, MOST> {
        if !self.gains_by_packets() {
            return rays.iter().map(|ray| self.first(Lecture, ray, tally)).collect();
        }
        let mut first: ArrayVec<Option<(usize, ShapeHit<T>)>, MOST> =
            rays.iter().map(|_| None).collect();
        for (i, object) in self.objects.iter().enumerate() {
            rays.iter().for_each(|_| tally.did(Work::Object));
            // objects are visited in order: at one t the earlier one wins
            let mut found = |lane: usize, hit: ShapeHit<T>| {
                if first[lane].is_none_or(|(_, best)| hit.t < best.t) {
                    first[lane] = Some((i, hit));
                }
            };
            let ObjectShape::Mesh(mesh) = &object.shape else {
                for (lane, ray) in rays.iter().enumerate() {
                    object.intersect::<_, true>(Lecture, ray, &self.meshes, tally, |hit| {
                        found(lane, hit)
                    });
                }
                continue;
            };
            let mesh = &self.meshes[*mesh];
            if object.frame.is_none() {
                mesh.intersect_packet(rays, &mut TriangleVisits(tally), found);
                continue;
            }
            let moved = |ray: &Ray<T>| object.ray_in_frame(Lecture, ray, tally).unwrap_or(*ray);
            let moved: ArrayVec<Ray<T>, MOST> = rays.iter().map(moved).collect();
            mesh.intersect_packet(&moved, &mut TriangleVisits(tally), found);
        }
        first
    }
}
