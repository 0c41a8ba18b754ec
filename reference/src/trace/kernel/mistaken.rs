//! What known mistakes change in the kernel. By the rules of the lecture, each of these functions
//! returns what it is given.

use arrayvec::ArrayVec;
use cases::Effect;
use cases::ray_tree::RayKind;

use super::{Kernel, ShadingPoint};
use crate::light::material::Material;
use crate::light::optics;
use crate::numbers::real::Real;
use crate::numbers::vec3::Vec3;
use crate::rays::ray::{HitPoint, Ray};
use crate::rules::{
    Background, Cut, LightSum, Mixing, Outside, RuleSource, ShadowReach, Tint, Viewer,
};
use crate::trace::simulated::EffectSource;
use crate::watch::work::Tally;
use crate::world::Hit;
use crate::world::search::Crossings;

impl<T: Real, R: RuleSource, E: EffectSource> Kernel<'_, T, R, E> {
    /// Returns whether `effect` is simulated.
    #[inline(always)]
    pub(super) fn simulates(&self, effect: Effect) -> bool {
        self.effects.has(effect) || self.rules.get().unlisted == Some(effect)
    }

    /// Returns the light of a ray of this kind that hits nothing. [rule 2]
    #[inline(always)]
    pub(super) fn background(&self, kind: RayKind) -> Vec3<T> {
        match self.rules.get().background {
            Background::Scene => self.world.background,
            Background::BlackForSpawned if kind == RayKind::Eye => self.world.background,
            Background::Black | Background::BlackForSpawned => Vec3::ZERO,
        }
    }

    /// Returns `light`, cut at 1 if the rules cut light of this kind.
    #[inline(always)]
    pub(super) fn cut(&self, kind: Cut, light: Vec3<T>) -> Vec3<T> {
        if self.rules.get().cut == kind { light.least(Vec3::ONE) } else { light }
    }

    /// Returns what remains of a surface's `own` light beside that of a ray spawned with `weight`.
    /// `less` and `none` are the choices by which it is multiplied by 1 − weight, and by 0.
    #[inline(always)]
    pub(super) fn own_light(
        &self,
        own: Vec3<T>,
        less: Mixing,
        none: Mixing,
        weight: Vec3<T>,
    ) -> Vec3<T> {
        match self.rules.get().mixing {
            mixing if mixing == less => own * (Vec3::ONE - weight),
            mixing if mixing == none => Vec3::ZERO,
            _ => own,
        }
    }

    /// Returns (η_i, η_t) at a hit on an object of this material. [rule 9]
    #[inline(always)]
    pub(super) fn indices(
        &self,
        hit: &Hit<T>,
        material: &Material<T>,
        is_inside: bool,
        tally: &mut impl Tally,
    ) -> (T, T) {
        let (eta_i, eta_t) = optics::indices(self.rules, is_inside, material.index);
        if self.rules.get().outside == Outside::Air || !self.simulates(Effect::Refraction) {
            return (eta_i, eta_t);
        }
        match self.index_around(hit, tally) {
            Some(around) if is_inside => (eta_i, around),
            Some(around) => (around, eta_t),
            None => (eta_i, eta_t),
        }
    }

    /// Returns the index of the innermost transparent object around the one that is hit, or `None`
    /// for air. A ray in any direction crosses a surface around it an odd number of times.
    fn index_around(&self, hit: &Hit<T>, tally: &mut impl Tally) -> Option<T> {
        let any = Vec3::new(T::of(0.36), T::of(0.48), T::of(0.8));
        let crossings = self.all_crossings(&Ray::all_of(hit.point, any), tally);
        let n_crossings = |i: usize| crossings.iter().filter(|(_, other)| *other == i).count();
        let material = |i: usize| &self.world.materials[self.world.objects[i].material];
        let is_around = |i: usize| {
            i != hit.object
                && material(i).kt != Vec3::ZERO
                && self.world.objects[i].has_inside()
                && n_crossings(i) % 2 == 1
        };
        let around = crossings.iter().map(|(_, i)| *i).find(|i| is_around(*i));
        around.map(|i| material(i).index)
    }

    /// Returns every crossing of the ray, with opaque objects too, in order of t.
    fn all_crossings(&self, ray: &Ray<T>, tally: &mut impl Tally) -> Crossings<T> {
        let mut crossings = Crossings::none();
        self.world.crossings(self.rules, ray, |_| false, &mut crossings, tally);
        crossings
    }

    /// Returns V at a point. [rule 3]
    #[inline(always)]
    pub(super) fn viewer_from(&self, at: &ShadingPoint<T>) -> Vec3<T> {
        match self.rules.get().viewer {
            Viewer::AgainstRay | Viewer::Reversed => at.to_viewer,
            Viewer::Camera => (Vec3::of(self.world.camera.eye) - at.hit_point.point).normalised(),
            Viewer::Origin => (-at.hit_point.point).normalised(),
        }
    }

    /// Returns the indices of the lights that are summed: the first one, and one more than the
    /// last. [rule 3]
    #[inline(always)]
    pub(super) fn summed(&self) -> [usize; 2] {
        let n_lights = self.world.lights.len();
        match self.rules.get().light_sum {
            LightSum::All | LightSum::Mean => [0, n_lights],
            LightSum::First => [0, n_lights.min(1)],
            LightSum::Last => [n_lights.saturating_sub(1), n_lights],
        }
    }

    /// Returns the colour of a surface with the emission `ke` whose lights add up to `sum`, ke
    /// included. [rule 3]
    #[inline(always)]
    pub(super) fn mean_of_lights(&self, sum: Vec3<T>, ke: Vec3<T>) -> Vec3<T> {
        if self.rules.get().light_sum != LightSum::Mean || self.world.lights.is_empty() {
            return sum;
        }
        ke + (sum - ke) * (T::ONE / T::of(self.world.lights.len() as f64))
    }

    /// Returns S_j of a shadow ray by a reach that depends on the surfaces that it crosses, for a
    /// light in the direction `to_light` at the distance `r`. [rule 5]
    pub(super) fn shadow_by_surfaces(
        &self,
        hit_point: &HitPoint<T>,
        to_light: Vec3<T>,
        r: T,
        tally: &mut impl Tally,
    ) -> Vec3<T> {
        let ray = Ray::to_light(self.rules, hit_point, to_light, T::INFINITY);
        let is_tinted = self.simulates(Effect::TintedShadows);
        let (mut share, mut end, mut n) = (Vec3::ONE, r, 0);
        for (t, i) in self.all_crossings(&ray, tally).iter() {
            if *t >= end {
                break;
            }
            let material = &self.world.materials[self.world.objects[*i].material];
            share = if is_tinted { share * material.kt } else { Vec3::ZERO };
            n += 1;
            end = match self.rules.get().shadow_reach {
                ShadowReach::FirstHitOnly => T::INFINITY,
                ShadowReach::Restarts => *t + r,
                _ => end,
            };
        }
        if n == 0 { Vec3::ONE } else { share }
    }

    /// Returns the product or sum of what these crossings leave of a light, by the mistakes that
    /// are no choice among the crossings. [rule 6]
    pub(super) fn mistaken_tint(&self, crossings: &Crossings<T>) -> Vec3<T> {
        let kt = |i: usize| self.world.materials[self.world.objects[i].material].kt;
        match self.rules.get().tint {
            Tint::Complement => {
                crossings.iter().fold(Vec3::ONE, |light, (_, i)| light * (Vec3::ONE - kt(*i)))
            }
            Tint::Subtracted => {
                let rest =
                    crossings.iter().fold(Vec3::ONE, |light, (_, i)| light - (Vec3::ONE - kt(*i)));
                rest.greatest(Vec3::ZERO)
            }
            Tint::ByLength => self.tint_by_length(crossings),
            _ => crossings.last().map_or(Vec3::ONE, |(_, i)| kt(*i)),
        }
    }

    /// Returns the product of kt to the power of the length between the two crossings of each pair.
    fn tint_by_length(&self, crossings: &Crossings<T>) -> Vec3<T> {
        let mut light = Vec3::ONE;
        let mut open: ArrayVec<(T, usize), 16> = ArrayVec::new();
        for (t, i) in crossings.iter() {
            let material = &self.world.materials[self.world.objects[*i].material];
            match open.iter().position(|(_, other)| other == i) {
                Some(at) => {
                    let (begin, _) = open.remove(at);
                    light = light * material.kt.map(|k| k.pow(*t - begin));
                }
                None => drop(open.try_push((*t, *i))),
            }
        }
        light
    }
}
