//! Searches of a world: the nearest hit of a ray, whether a ray is occluded, and all that a ray
//! crosses. [rule 2] [rule 5] [rule 6]

use std::ops::Deref;

use arrayvec::ArrayVec;

use crate::bvh::Visit;
use crate::numbers::real::Real;
use crate::rays::ray::Ray;
use crate::rules::{Nearest, RuleSource};
use crate::shapes::ShapeHit;
use crate::watch::work::{ObjectVisits, Tally, Work};
use crate::world::{Hit, World};

/// The greatest number of crossings that are stored without an allocation.
const FEW: usize = 8;

/// The crossings of a ray with surfaces, as (t, index of the object) in ascending order of t. At
/// one t they are in the scene's order.
#[derive(Clone, Debug)]
pub struct Crossings<T> {
    few: ArrayVec<(T, usize), FEW>,
    /// All crossings, where there are more than [`FEW`].
    many: Vec<(T, usize)>,
}

impl<T: Real> World<T> {
    /// Returns the nearest hit in the ray's interval, in world space; `None` for a miss. At one t
    /// the earlier object wins. [rule 2]
    ///
    /// ```
    /// use cases::{Course, scene};
    /// use reference::{numbers::vec3::Vec3, rays::ray::Ray, rules::Lecture, world::World};
    /// let text = r#"
    ///     render = { size = [8, 6] }
    ///     scene.camera = { eye = [0, 0, 4], look_at = [0, 0, 0], up = [0, 1, 0], fov_y_deg = 40 }
    ///     scene.materials = { red = { kd = [1, 0, 0] } }
    ///     scene.objects = [{ sphere = { radius = 1 }, material = "red" }]"#;
    /// let scene = scene::parse("ball.toml", text, "".as_ref(), &Course::default()).unwrap();
    /// let ray = Ray::all_of(Vec3::new(0.0, 0.0, 4.0), -Vec3::axis(2));
    /// let hit = World::<f64>::new(&scene).nearest(Lecture, &ray, &mut ()).unwrap();
    /// assert_eq!((hit.t, hit.point.z), (3.0, 1.0)); // the unit sphere, seen from z = 4
    /// ```
    pub fn nearest<R: RuleSource>(
        &self,
        rules: R,
        ray: &Ray<T>,
        tally: &mut impl Tally,
    ) -> Option<Hit<T>> {
        let found = self.first(rules, ray, tally)?;
        Some(self.hit(rules, ray, found, true, tally))
    }

    /// Returns the index of the object of the nearest hit, and the hit on its shape, without point
    /// and normals; `None` for a miss.
    #[inline(always)]
    pub fn first<R: RuleSource>(
        &self,
        rules: R,
        ray: &Ray<T>,
        tally: &mut impl Tally,
    ) -> Option<(usize, ShapeHit<T>)> {
        match self.has_frames {
            true => self.first_of::<R, _, true>(rules, ray, tally),
            false => self.first_of::<R, _, false>(rules, ray, tally),
        }
    }

    #[inline(always)]
    fn first_of<R: RuleSource, Y: Tally, const FRAMES: bool>(
        &self,
        rules: R,
        ray: &Ray<T>,
        tally: &mut Y,
    ) -> Option<(usize, ShapeHit<T>)> {
        // Two variables, of which one is used: the walk through a tree needs its own in memory. A
        // shared one would lie in memory for the search of the list as well.
        let (mut of_tree, mut of_list) = (None, None);
        if self.tree.is_some() {
            self.each_of_tree(
                ray,
                tally,
                ByCall(FirstHit::<_, _, FRAMES> { world: self, rules, ray, best: &mut of_tree }),
            );
            return of_tree;
        }
        self.each_of_list::<_, false>(
            ray,
            tally,
            FirstHit::<_, _, FRAMES> { world: self, rules, ray, best: &mut of_list },
        );
        of_list
    }

    /// Returns whether anything lies in the ray's interval; the first hit found ends the search.
    /// [rule 5]
    #[inline(always)]
    pub fn occluded<R: RuleSource>(&self, rules: R, ray: &Ray<T>, tally: &mut impl Tally) -> bool {
        match self.has_frames {
            true => self.occluded_by::<R, _, true>(rules, ray, tally),
            false => self.occluded_by::<R, _, false>(rules, ray, tally),
        }
    }

    #[inline(always)]
    fn occluded_by<R: RuleSource, Y: Tally, const FRAMES: bool>(
        &self,
        rules: R,
        ray: &Ray<T>,
        tally: &mut Y,
    ) -> bool {
        let (mut by_tree, mut by_list) = (false, false);
        if self.tree.is_some() {
            self.each_of_tree(
                ray,
                tally,
                ByCall(AnyHit::<_, _, FRAMES> { world: self, rules, ray, found: &mut by_tree }),
            );
            return by_tree;
        }
        self.each_of_list::<_, true>(
            ray,
            tally,
            AnyHit::<_, _, FRAMES> { world: self, rules, ray, found: &mut by_list },
        );
        by_list
    }

    /// Returns whether the ray crosses no object for which `blocks` is true. [rule 6]
    ///
    /// If so, `all`, which must be empty before, holds every crossing with a surface.
    #[inline(always)]
    pub fn crossings<R: RuleSource>(
        &self,
        rules: R,
        ray: &Ray<T>,
        blocks: impl Fn(usize) -> bool,
        all: &mut Crossings<T>,
        tally: &mut impl Tally,
    ) -> bool {
        let mut is_blocked = false;
        if self.has_frames {
            let visitor = AllCrossings::<_, _, _, true> {
                world: self,
                rules,
                ray,
                blocks,
                all,
                is_blocked: &mut is_blocked,
            };
            self.each(ray, tally, visitor);
        } else {
            let visitor = AllCrossings::<_, _, _, false> {
                world: self,
                rules,
                ray,
                blocks,
                all,
                is_blocked: &mut is_blocked,
            };
            self.each(ray, tally, visitor);
        }
        all.sort();
        !is_blocked
    }

    /// Calls `visitor` for every object that the ray may hit before the limit. The visitor returns
    /// −∞ to end the search.
    #[inline(always)]
    fn each<Y: Tally>(&self, ray: &Ray<T>, tally: &mut Y, visitor: impl Visit<T, Y>) {
        match self.tree.is_some() {
            true => self.each_of_tree(ray, tally, ByCall(visitor)),
            false => self.each_of_list::<_, true>(ray, tally, visitor),
        }
    }

    /// Calls `visitor` for every object of a world without a tree. The search ends early only if it
    /// `ENDS`.
    #[inline(always)]
    fn each_of_list<Y: Tally, const ENDS: bool>(
        &self,
        ray: &Ray<T>,
        tally: &mut Y,
        mut visitor: impl Visit<T, Y>,
    ) {
        let mut limit = ray.t_max;
        for i in 0..self.objects.len() as u32 {
            tally.did(Work::Object);
            limit = visitor.visit(tally, i, limit);
            if ENDS && limit == -T::INFINITY {
                return;
            }
        }
    }

    /// Calls `visitor` for every object that the ray may hit in a world with a tree.
    #[inline]
    fn each_of_tree<Y: Tally>(&self, ray: &Ray<T>, tally: &mut Y, mut visitor: impl Visit<T, Y>) {
        let Some((inside, tree)) = &self.tree else { return };
        let mut limit = ray.t_max;
        for i in &self.endless {
            tally.did(Work::Object);
            limit = visitor.visit(tally, *i, limit);
            if limit == -T::INFINITY {
                return;
            }
        }
        let rest = Ray { t_max: limit, ..*ray };
        tree.walk(&rest, &mut ObjectVisits(tally), |of: &mut ObjectVisits<'_, Y>, n, limit| {
            visitor.visit(of.0, inside[n as usize], limit)
        });
    }
}

/// Forwards to the visitor through a real call. Inlined, the visitor would be compiled into every
/// copy of the tree walk (portable, AVX2, AVX-512) and triple its code size.
struct ByCall<V>(V);

impl<T, Y, V: Visit<T, Y>> Visit<T, Y> for ByCall<V> {
    #[inline(never)]
    fn visit(&mut self, tally: &mut Y, primitive: u32, limit: T) -> T {
        self.0.visit(tally, primitive, limit)
    }
}

/// A visitor that finds the nearest hit.
struct FirstHit<'a, T, R, const FRAMES: bool> {
    world: &'a World<T>,
    rules: R,
    ray: &'a Ray<T>,
    best: &'a mut Option<(usize, ShapeHit<T>)>,
}

impl<T: Real, R: RuleSource, Y: Tally, const FRAMES: bool> Visit<T, Y>
    for FirstHit<'_, T, R, FRAMES>
{
    #[inline(always)]
    fn visit(&mut self, tally: &mut Y, i: u32, limit: T) -> T {
        let (nearest, i, mut limit) = (self.rules.get().nearest, i as usize, limit);
        let best = &mut *self.best;
        let note = |hit: ShapeHit<T>| {
            let wins = match &*best {
                None => true,
                Some((j, best)) => match nearest {
                    Nearest::LeastT => hit.t < best.t || (hit.t == best.t && i < *j),
                    Nearest::FirstListed => i < *j,
                    Nearest::LastListed => i > *j,
                },
            };
            if wins {
                limit = if nearest == Nearest::LeastT { hit.t } else { limit };
                *best = Some((i, hit));
            }
        };
        self.world.objects[i].intersect::<R, FRAMES>(
            self.rules,
            self.ray,
            &self.world.meshes,
            tally,
            note,
        );
        limit
    }
}

/// A visitor that finds out whether there is a hit.
struct AnyHit<'a, T, R, const FRAMES: bool> {
    world: &'a World<T>,
    rules: R,
    ray: &'a Ray<T>,
    found: &'a mut bool,
}

impl<T: Real, R: RuleSource, Y: Tally, const FRAMES: bool> Visit<T, Y>
    for AnyHit<'_, T, R, FRAMES>
{
    #[inline(always)]
    fn visit(&mut self, tally: &mut Y, i: u32, limit: T) -> T {
        let object = &self.world.objects[i as usize];
        *self.found = *self.found
            || object.is_hit::<R, FRAMES>(self.rules, self.ray, &self.world.meshes, tally);
        if *self.found { -T::INFINITY } else { limit }
    }
}

/// A visitor that finds all crossings, unless something blocks the ray.
struct AllCrossings<'a, T, R, B, const FRAMES: bool> {
    world: &'a World<T>,
    rules: R,
    ray: &'a Ray<T>,
    blocks: B,
    all: &'a mut Crossings<T>,
    is_blocked: &'a mut bool,
}

impl<T: Real, R: RuleSource, Y: Tally, B: Fn(usize) -> bool, const FRAMES: bool> Visit<T, Y>
    for AllCrossings<'_, T, R, B, FRAMES>
{
    #[inline(always)]
    fn visit(&mut self, tally: &mut Y, i: u32, limit: T) -> T {
        let (world, i) = (self.world, i as usize);
        let object = &world.objects[i];
        if *self.is_blocked {
            return -T::INFINITY;
        }
        if (self.blocks)(i) {
            *self.is_blocked =
                object.is_hit::<R, FRAMES>(self.rules, self.ray, &world.meshes, tally);
            return if *self.is_blocked { -T::INFINITY } else { limit };
        }
        let all = &mut *self.all;
        object.crossings::<R, _, FRAMES>(self.rules, self.ray, &world.meshes, tally, |tally, t| {
            tally.did(Work::TintedCrossing);
            all.push((t, i));
        });
        limit
    }
}

impl<T: Real> Crossings<T> {
    /// Returns an empty list of crossings.
    pub fn none() -> Self {
        Self { few: ArrayVec::new(), many: Vec::new() }
    }

    fn push(&mut self, crossing: (T, usize)) {
        if self.many.is_empty() {
            if self.few.try_push(crossing).is_ok() {
                return;
            }
            self.many.extend(self.few.drain(..));
        }
        self.many.push(crossing);
    }

    fn sort(&mut self) {
        let all = if self.many.is_empty() { &mut *self.few } else { &mut *self.many };
        if all.len() > 1 {
            all.sort_by(|(t, i), (u, j)| t.f64().total_cmp(&u.f64()).then(i.cmp(j)));
        }
    }
}

impl<T> Deref for Crossings<T> {
    type Target = [(T, usize)];

    fn deref(&self) -> &[(T, usize)] {
        if self.many.is_empty() { &self.few } else { &self.many }
    }
}
