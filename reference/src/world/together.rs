//! What rays from the eye meet of a world, searched for together.

use arrayvec::ArrayVec;

use super::World;
use crate::object::Form;
use crate::packet::MOST;
use crate::ray::Ray;
use crate::real::Real;
use crate::rules::Lecture;
use crate::shapes::Meeting;
use crate::work::{OfTriangles, Tally, Work};

impl<T: Real> World<T> {
    /// Whether [`World::first_together`] has anything to gain: where a mesh is asked by every ray.
    pub fn gains_together(&self) -> bool {
        self.tree.is_none()
            && self.objects.iter().any(|object| matches!(object.shape, Form::Mesh(_)))
    }

    /// What [`World::first`] gives for each of some rays, [`MOST`] at most, by the rules of the
    /// lecture. It pays for rays that leave one point in nearly one direction. Of a mesh `tally` is
    /// told what all of them visit together.
    pub fn first_together<Y: Tally>(
        &self,
        rays: &[Ray<T>],
        tally: &mut Y,
    ) -> ArrayVec<Option<(usize, Meeting<T>)>, MOST> {
        if !self.gains_together() {
            return rays.iter().map(|ray| self.first(Lecture, ray, tally)).collect();
        }
        let mut first: ArrayVec<Option<(usize, Meeting<T>)>, MOST> =
            rays.iter().map(|_| None).collect();
        for (i, object) in self.objects.iter().enumerate() {
            rays.iter().for_each(|_| tally.did(Work::Object));
            // objects come in order: at one t the earlier wins
            let mut found = |lane: usize, met: Meeting<T>| {
                if first[lane].is_none_or(|(_, best)| met.t < best.t) {
                    first[lane] = Some((i, met));
                }
            };
            let Form::Mesh(mesh) = &object.shape else {
                for (lane, ray) in rays.iter().enumerate() {
                    object
                        .meet::<_, true>(Lecture, ray, &self.meshes, tally, |met| found(lane, met));
                }
                continue;
            };
            let mesh = &self.meshes[*mesh];
            if object.frame.is_none() {
                mesh.meet_together(rays, &mut OfTriangles(tally), found);
                continue;
            }
            let moved = |ray: &Ray<T>| object.ray_in_frame(Lecture, ray, tally).unwrap_or(*ray);
            let moved: ArrayVec<Ray<T>, MOST> = rays.iter().map(moved).collect();
            mesh.meet_together(&moved, &mut OfTriangles(tally), found);
        }
        first
    }
}
