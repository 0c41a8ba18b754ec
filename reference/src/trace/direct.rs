//! The light that reaches a point straight from the lamps: shading and shadow rays. [rule 3]
//! [rule 5] [rule 6]

use cases::Effect;

use super::{Kernel, Seen};
use crate::lights::Light;
use crate::ray::{Ray, Spot};
use crate::real::Real;
use crate::rules::{Ambient, LightOrder, RuleSource, ShadowReach, Tint};
use crate::search::Crossings;
use crate::shade;
use crate::simulated::EffectSource;
use crate::vec3::Vec3;
use crate::watch::Watch;
use crate::work::{Tally, Work};

impl<T: Real, R: RuleSource, E: EffectSource> Kernel<'_, T, R, E> {
    /// ke and the light of every lamp at a point, which counts for `weight` in the pixel. [rule 3]
    pub fn shade(&self, seen: &Seen<T>, weight: Vec3<T>, watch: &mut impl Watch) -> Vec3<T> {
        let material = &self.world.materials[seen.material];
        let n_lights = self.world.lights.len();
        let is_dull = shade::is_dull(self.rules, material);
        let mut colour = shade::emission(self.rules, material, n_lights);
        for n in 0..n_lights {
            let j = if self.rules.get().style.lights == LightOrder::Reversed {
                n_lights - 1 - n
            } else {
                n
            };
            let light = &self.world.lights[j];
            let ambient = shade::ambient(self.rules, material, light, j, seen.is_inside);
            if self.rules.get().ambient == Ambient::Shadowed {
                for term in self.shadowed(seen, light, ambient, watch) {
                    colour += term;
                }
                continue;
            }
            colour += ambient;
            if is_dull || (shade::is_bounded(self.rules) && light.colour == Vec3::ZERO) {
                continue;
            }
            let Some((to_light, r)) = light.seen_from(self.rules, seen.spot.point) else {
                continue;
            };
            if !shade::is_lit(self.rules, material, seen.normal, to_light) {
                continue;
            }
            let weakened = light.attenuation(self.rules, r, watch);
            if self.is_faint_light(
                || light.colour * weakened * (material.kd + material.ks),
                weight,
                watch,
            ) {
                continue;
            }
            let reaching = self.shadow(&seen.spot, to_light, r, watch) * weakened;
            if reaching == Vec3::ZERO && shade::is_bounded(self.rules) {
                continue;
            }
            let arriving = reaching * light.colour;
            colour += shade::light_term(
                self.rules,
                material,
                arriving,
                seen.normal,
                seen.to_viewer,
                to_light,
                watch,
            );
        }
        colour
    }

    /// The ambient and the direct term of a light where shadows take both.
    fn shadowed(
        &self,
        seen: &Seen<T>,
        light: &Light<T>,
        ambient: Vec3<T>,
        watch: &mut impl Watch,
    ) -> [Vec3<T>; 2] {
        let material = &self.world.materials[seen.material];
        let Some((to_light, r)) = light.seen_from(self.rules, seen.spot.point) else {
            return [Vec3::ZERO; 2];
        };
        let reaching =
            self.shadow(&seen.spot, to_light, r, watch) * light.attenuation(self.rules, r, watch);
        let arriving = reaching * light.colour;
        let direct = shade::light_term(
            self.rules,
            material,
            arriving,
            seen.normal,
            seen.to_viewer,
            to_light,
            watch,
        );
        [ambient * reaching, direct]
    }

    /// Whether a lamp whose light comes to `most` at most need not be followed.
    #[inline(always)]
    fn is_faint_light(
        &self,
        most: impl Fn() -> Vec3<T>,
        weight: Vec3<T>,
        watch: &mut impl Watch,
    ) -> bool {
        let cutoff = T::of(self.effects.light_cutoff());
        if cutoff > T::ZERO && most().max_element() < cutoff {
            watch.did(Work::FaintLight);
            watch.faint_light(|| weight * most());
            return true;
        }
        false
    }

    /// S_j at a point of a surface, for a light in direction `to_light` at distance `r`. [rule 5]
    /// [rule 6]
    pub fn shadow(
        &self,
        spot: &Spot<T>,
        to_light: Vec3<T>,
        r: T,
        watch: &mut impl Watch,
    ) -> Vec3<T> {
        if !self.effects.has(Effect::Shadows) || !self.rules.get().casts_shadows {
            return Vec3::ONE;
        }
        watch.shadow_ray();
        let reach =
            if self.rules.get().shadow_reach == ShadowReach::Unbounded { T::INFINITY } else { r };
        let ray = Ray::to_light(self.rules, spot, to_light, reach);
        if self.effects.has(Effect::TintedShadows) && self.rules.get().tint != Tint::Opaque {
            return self.tint(&ray, watch);
        }
        if self.world.occluded(self.rules, &ray, watch) { Vec3::ZERO } else { Vec3::ONE }
    }

    /// The product of kt over all crossings of the ray, in order of t. [rule 6]
    fn tint(&self, ray: &Ray<T>, tally: &mut impl Tally) -> Vec3<T> {
        let tint = self.rules.get().tint;
        let kt = |object: usize| self.world.materials[self.world.objects[object].material].kt;
        let blocks = |object| tint != Tint::FirstCrossing && kt(object) == Vec3::ZERO;
        let mut crossings = Crossings::none();
        if !self.world.crossings(self.rules, ray, blocks, &mut crossings, tally) {
            return Vec3::ZERO;
        }
        let counts = |n: usize| match tint {
            Tint::PerObject => crossings[..n].iter().all(|before| before.1 != crossings[n].1),
            Tint::FirstCrossing => n == 0,
            Tint::Clear => false,
            Tint::PerCrossing | Tint::Opaque => true,
        };
        (0..crossings.len())
            .filter(|n| counts(*n))
            .fold(Vec3::ONE, |light, n| light * kt(crossings[n].1))
    }
}
