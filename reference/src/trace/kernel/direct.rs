//! The light that reaches a point directly from the light sources: shading and shadow rays.
//! [rule 3] [rule 5] [rule 6]

use cases::Effect;

use super::{Kernel, Leaves, ShadingPoint};
use crate::light::lights::Light;
use crate::light::shade;
use crate::numbers::real::Real;
use crate::numbers::vec3::Vec3;
use crate::rays::ray::{HitPoint, Ray};
use crate::rules::{Ambient, LightOrder, RuleSource, ShadowReach, Tint};
use crate::trace::simulated::EffectSource;
use crate::watch::Watch;
use crate::watch::work::{Tally, Work};
use crate::world::clear::Alone;
use crate::world::search::Crossings;

/// The lights at a point whose terms may vanish in the sum.
#[derive(Clone, Copy, Debug)]
struct Vanished<T> {
    /// The sum with the greatest value that each of their terms can have.
    greatest: Vec3<T>,
    n_lights: u32,
}

impl<T: Real> Vanished<T> {
    /// Returns these lights and one more, with the attenuation `weakened`, of which the surface
    /// reflects at most `most`, except for rounding.
    ///
    /// A factor of 2 covers the rounding, and the least trusted number that of numbers near 0.
    #[cold]
    fn and(self, weakened: T, most: Vec3<T>) -> Self {
        let term = if weakened == T::ZERO {
            Vec3::ZERO
        } else {
            most * T::TWO + Vec3::new(T::SAFE[0], T::SAFE[0], T::SAFE[0])
        };
        Self { greatest: self.greatest + term, n_lights: self.n_lights + 1 }
    }
}

impl<T: Real, R: RuleSource, E: EffectSource> Kernel<'_, T, R, E> {
    /// Returns ke and the light of every light source at a point. `weight` is the weight of the
    /// path in the pixel. [rule 3]
    ///
    /// **Lights that vanish.** The term of a light whose attenuation is below half an ulp of 1 may
    /// vanish in the rounded sum. Its least value is 0, its greatest is known without a shadow ray.
    /// The sum is therefore computed with both, by the same additions. A rounded addition is
    /// monotonic, so the true sum lies between the two. Where they are equal, the true sum is that
    /// number too, and the shadow rays of such lights are not needed. Elsewhere the sum starts over
    /// with all shadow rays.
    pub fn shade(&self, at: &ShadingPoint<T>, weight: Vec3<T>, watch: &mut impl Watch) -> Vec3<T> {
        let may_vanish = self.world.may_vanish
            && self.is_proven
            && self.simulates(Effect::Shadows)
            && self.effects.light_cutoff() == 0.0
            && shade::is_bounded(self.rules);
        if may_vanish && let Some(sum) = self.sum_with_vanishing_lights(at, weight, watch) {
            return sum;
        }
        self.sum_of_lights::<false>(at, weight, watch).0
    }

    /// Returns ke and the sum of all lights at a point, or `None` if a light that may vanish does
    /// not. Never inlined, because most scenes have no such light.
    #[inline(never)]
    fn sum_with_vanishing_lights(
        &self,
        at: &ShadingPoint<T>,
        weight: Vec3<T>,
        watch: &mut impl Watch,
    ) -> Option<Vec3<T>> {
        let (least, vanished) = self.sum_of_lights::<true>(at, weight, watch);
        let Some(Vanished { greatest, n_lights }) = vanished else { return Some(least) };
        if greatest != least {
            return None;
        }
        (0..n_lights).for_each(|_| watch.did(Work::VanishingLight));
        Some(least)
    }

    /// Returns ke and the sum of all lights at a point. If `MAY_VANISH`, lights whose term may
    /// vanish count as 0 and are reported.
    #[inline(always)]
    fn sum_of_lights<const MAY_VANISH: bool>(
        &self,
        at: &ShadingPoint<T>,
        weight: Vec3<T>,
        watch: &mut impl Watch,
    ) -> (Vec3<T>, Option<Vanished<T>>) {
        let material = &self.world.materials[at.material];
        let n_lights = self.world.lights.len();
        let lights = self.world.reflected[at.material];
        let mut colour = shade::emission(self.rules, material, n_lights);
        let mut vanished: Option<Vanished<T>> = None;
        let add = |colour: &mut Vec3<T>, vanished: &mut Option<Vanished<T>>, term: Vec3<T>| {
            *colour += term;
            if MAY_VANISH && let Some(vanished) = vanished {
                vanished.greatest += term;
            }
        };
        let [first, end] = self.summed();
        for n in first..end {
            let j = if self.rules.get().style.lights == LightOrder::Reversed {
                n_lights - 1 - n
            } else {
                n
            };
            let light = &self.world.lights[j];
            let ambient = shade::ambient(self.rules, material, light, j, at.is_inside);
            let ambient_rule = self.rules.get().ambient;
            if matches!(ambient_rule, Ambient::Shadowed | Ambient::Weakened | Ambient::InShadow) {
                for term in self.shadowed(at, light, ambient, watch) {
                    colour += term;
                }
                continue;
            }
            add(&mut colour, &mut vanished, ambient);
            // A red lamp on a blue surface adds nothing, so it needs no shadow ray.
            if shade::is_bounded(self.rules) && !lights.has(j) {
                continue;
            }
            let Some((to_light, r)) = light.direction_from(self.rules, at.hit_point.point) else {
                continue;
            };
            if !shade::is_lit(self.rules, material, at.normal, to_light) {
                continue;
            }
            let weakened = light.attenuation(self.rules, r, watch);
            let most = || light.colour * weakened * (material.kd + material.ks);
            if self.is_faint_light(most, weight, watch) {
                continue;
            }
            let is_candidate = MAY_VANISH && weakened < T::HALF * T::ULP;
            if is_candidate && most().max_element() < T::ULP {
                let so_far = vanished.unwrap_or(Vanished { greatest: colour, n_lights: 0 });
                vanished = Some(so_far.and(weakened, most()));
                continue;
            }
            let weakened =
                if self.rules.get().attenuates_twice { weakened * weakened } else { weakened };
            let reaching = self.reaching(at, to_light, r, watch) * weakened;
            if reaching == Vec3::ZERO && shade::is_bounded(self.rules) {
                continue;
            }
            let arriving = self.arriving(light, reaching);
            let term = shade::light_term(
                self.rules,
                material,
                arriving,
                at.normal,
                self.viewer_from(at),
                to_light,
                watch,
            );
            add(&mut colour, &mut vanished, term);
        }
        let ke = shade::emission(self.rules, material, n_lights);
        (self.mean_of_lights(colour, ke), vanished)
    }

    /// Returns S_j A_j I_j, given S_j A_j. [rule 3]
    #[inline(always)]
    fn arriving(&self, light: &Light<T>, reaching: Vec3<T>) -> Vec3<T> {
        if self.rules.get().coloured_lights { reaching * light.colour } else { reaching }
    }

    /// Returns the ambient and the direct term of a light for rules by which shadow or distance
    /// darkens both.
    fn shadowed(
        &self,
        at: &ShadingPoint<T>,
        light: &Light<T>,
        ambient: Vec3<T>,
        watch: &mut impl Watch,
    ) -> [Vec3<T>; 2] {
        let material = &self.world.materials[at.material];
        let Some((to_light, r)) = light.direction_from(self.rules, at.hit_point.point) else {
            return [Vec3::ZERO; 2];
        };
        let (shadow, weakened) =
            (self.reaching(at, to_light, r, watch), light.attenuation(self.rules, r, watch));
        let reaching = shadow * weakened;
        let arriving = self.arriving(light, reaching);
        let direct = shade::light_term(
            self.rules,
            material,
            arriving,
            at.normal,
            self.viewer_from(at),
            to_light,
            watch,
        );
        match self.rules.get().ambient {
            Ambient::Weakened => [ambient * weakened, direct],
            Ambient::InShadow => [ambient * shadow, direct],
            _ => [ambient * reaching, direct],
        }
    }

    /// Returns whether a light can be skipped, because the most that it adds, `most`, is below the
    /// cutoff. A skipped light is reported to the watch.
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

    /// Returns S_j at a hit, for a light in the direction `to_light` at the distance `r`. It is 1
    /// without a shadow ray where the ray could only miss.
    #[inline(always)]
    fn reaching<W: Watch>(
        &self,
        at: &ShadingPoint<T>,
        to_light: Vec3<T>,
        r: T,
        watch: &mut W,
    ) -> Vec3<T> {
        if self.simulates(Effect::Shadows) && self.world.alone != Alone::No {
            let along = to_light.dot(at.hit_point.n_geom);
            let leaves = Leaves { outside: (along > T::ZERO) != at.is_inside, along };
            if self.misses_surely::<W>(leaves) {
                watch.did(Work::SureMiss);
                return Vec3::ONE;
            }
        }
        if !self.rules.get().own_shadows
            && let Some(first) = self.world.lights.first()
            && let Some((to_first, r)) = first.direction_from(self.rules, at.hit_point.point)
        {
            return self.shadow(&at.hit_point, to_first, r, watch);
        }
        self.shadow(&at.hit_point, to_light, r, watch)
    }

    /// Returns S_j at a point of a surface, for a light in the direction `to_light` at the distance
    /// `r`. [rule 5] [rule 6]
    pub fn shadow(
        &self,
        hit_point: &HitPoint<T>,
        to_light: Vec3<T>,
        r: T,
        watch: &mut impl Watch,
    ) -> Vec3<T> {
        if !self.simulates(Effect::Shadows) || !self.rules.get().casts_shadows {
            return Vec3::ONE;
        }
        watch.shadow_ray();
        let reach = match self.rules.get().shadow_reach {
            ShadowReach::Light => r,
            ShadowReach::Unbounded => T::INFINITY,
            ShadowReach::One => r.least(T::ONE),
            ShadowReach::FirstHitOnly | ShadowReach::Restarts => {
                return self.shadow_by_surfaces(hit_point, to_light, r, watch);
            }
        };
        let ray = Ray::to_light(self.rules, hit_point, to_light, reach);
        if self.simulates(Effect::TintedShadows) && self.rules.get().tint != Tint::Opaque {
            if !self.is_proven || self.world.glass.may_be_on(&ray) {
                return self.tint(&ray, watch);
            }
            watch.did(Work::UntintedRay);
        }
        if self.world.occluded(self.rules, &ray, watch) { Vec3::ZERO } else { Vec3::ONE }
    }

    /// Returns the product of kt over all crossings of the ray, in order of t. [rule 6]
    fn tint(&self, ray: &Ray<T>, tally: &mut impl Tally) -> Vec3<T> {
        let tint = self.rules.get().tint;
        let kt = |object: usize| self.world.materials[self.world.objects[object].material].kt;
        let blocks = |object| tint != Tint::FirstCrossing && kt(object) == Vec3::ZERO;
        let mut crossings = Crossings::none();
        if !self.world.crossings(self.rules, ray, blocks, &mut crossings, tally) {
            return Vec3::ZERO;
        }
        if matches!(tint, Tint::LastCrossing | Tint::Complement | Tint::Subtracted | Tint::ByLength)
        {
            return self.mistaken_tint(&crossings);
        }
        let counts = |n: usize| match tint {
            Tint::PerObject => crossings[..n].iter().all(|before| before.1 != crossings[n].1),
            Tint::FirstCrossing => n == 0,
            Tint::Clear => false,
            _ => true,
        };
        (0..crossings.len())
            .filter(|n| counts(*n))
            .fold(Vec3::ONE, |light, n| light * kt(crossings[n].1))
    }
}
