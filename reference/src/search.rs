//! What a ray meets of a world: the nearest hit, whether anything is in the way, all that it
//! crosses. [rule 2] [rule 5] [rule 6]

use std::ops::Deref;

use arrayvec::ArrayVec;

use crate::bvh::Visit;
use crate::ray::Ray;
use crate::real::Real;
use crate::rules::{Nearest, RuleSource};
use crate::shapes::Meeting;
use crate::work::{OfObjects, Tally, Work};
use crate::world::{Hit, World};

/// So many crossings take no memory of their own.
const FEW: usize = 8;

/// Crossings of a ray with surfaces, as (t, object) in order of t, at one t in the scene's order.
#[derive(Clone, Debug)]
pub struct Crossings<T> {
    few: ArrayVec<(T, usize), FEW>,
    /// All of them, where they are more.
    many: Vec<(T, usize)>,
}

impl<T: Real> World<T> {
    /// The nearest hit in the ray's interval; at one t the earlier object wins. [rule 2]
    pub fn nearest<R: RuleSource>(
        &self,
        rules: R,
        ray: &Ray<T>,
        tally: &mut impl Tally,
    ) -> Option<Hit<T>> {
        let found = self.first(rules, ray, tally)?;
        Some(self.hit(rules, ray, found, true, tally))
    }

    /// The object of the nearest hit, and where; without the normals.
    #[inline(always)]
    pub fn first<R: RuleSource>(
        &self,
        rules: R,
        ray: &Ray<T>,
        tally: &mut impl Tally,
    ) -> Option<(usize, Meeting<T>)> {
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
    ) -> Option<(usize, Meeting<T>)> {
        // one for each way: the one that a walk through a tree is told of lies in memory
        let (mut of_tree, mut of_list) = (None, None);
        if self.tree.is_some() {
            self.each_of_tree(
                ray,
                tally,
                ByCall(First::<_, _, FRAMES> { world: self, rules, ray, best: &mut of_tree }),
            );
            return of_tree;
        }
        self.each_of_list::<_, false>(
            ray,
            tally,
            First::<_, _, FRAMES> { world: self, rules, ray, best: &mut of_list },
        );
        of_list
    }

    /// Whether anything lies in the ray's interval; the first thing found ends the search. [rule 5]
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
                ByCall(Any::<_, _, FRAMES> { world: self, rules, ray, found: &mut by_tree }),
            );
            return by_tree;
        }
        self.each_of_list::<_, true>(
            ray,
            tally,
            Any::<_, _, FRAMES> { world: self, rules, ray, found: &mut by_list },
        );
        by_list
    }

    /// Whether the ray crosses no object that `blocks`; then `all`, which holds none before, holds
    /// every crossing with a surface. [rule 6]
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
            let visitor = All::<_, _, _, true> {
                world: self,
                rules,
                ray,
                blocks,
                all,
                is_blocked: &mut is_blocked,
            };
            self.each(ray, tally, visitor);
        } else {
            let visitor = All::<_, _, _, false> {
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

    /// Has `visitor` visit every object that the ray may meet before the limit; it returns −∞ to
    /// end the search.
    #[inline(always)]
    fn each<Y: Tally>(&self, ray: &Ray<T>, tally: &mut Y, visitor: impl Visit<T, Y>) {
        match self.tree.is_some() {
            true => self.each_of_tree(ray, tally, ByCall(visitor)),
            false => self.each_of_list::<_, true>(ray, tally, visitor),
        }
    }

    /// The same where there is no tree, and the search ends early only if it `ENDS`.
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

    /// The same where there is a tree.
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
        tree.walk(&rest, &mut OfObjects(tally), |of: &mut OfObjects<'_, Y>, n, limit| {
            visitor.visit(of.0, inside[n as usize], limit)
        });
    }
}

/// Calls the visitor, in the place of being made of it: the walk through a tree stands in the
/// program for each set of instructions.
struct ByCall<V>(V);

impl<T, Y, V: Visit<T, Y>> Visit<T, Y> for ByCall<V> {
    #[inline(never)]
    fn visit(&mut self, tally: &mut Y, thing: u32, limit: T) -> T {
        self.0.visit(tally, thing, limit)
    }
}

/// Finds the nearest.
struct First<'a, T, R, const FRAMES: bool> {
    world: &'a World<T>,
    rules: R,
    ray: &'a Ray<T>,
    best: &'a mut Option<(usize, Meeting<T>)>,
}

impl<T: Real, R: RuleSource, Y: Tally, const FRAMES: bool> Visit<T, Y> for First<'_, T, R, FRAMES> {
    #[inline(always)]
    fn visit(&mut self, tally: &mut Y, i: u32, limit: T) -> T {
        let (nearest, i, mut limit) = (self.rules.get().nearest, i as usize, limit);
        let best = &mut *self.best;
        let note = |met: Meeting<T>| {
            let wins = match &*best {
                None => true,
                Some((j, best)) => match nearest {
                    Nearest::LeastT => met.t < best.t || (met.t == best.t && i < *j),
                    Nearest::FirstListed => i < *j,
                    Nearest::LastListed => i > *j,
                },
            };
            if wins {
                limit = if nearest == Nearest::LeastT { met.t } else { limit };
                *best = Some((i, met));
            }
        };
        self.world.objects[i].meet::<R, FRAMES>(
            self.rules,
            self.ray,
            &self.world.meshes,
            tally,
            note,
        );
        limit
    }
}

/// Finds whether anything is met.
struct Any<'a, T, R, const FRAMES: bool> {
    world: &'a World<T>,
    rules: R,
    ray: &'a Ray<T>,
    found: &'a mut bool,
}

impl<T: Real, R: RuleSource, Y: Tally, const FRAMES: bool> Visit<T, Y> for Any<'_, T, R, FRAMES> {
    #[inline(always)]
    fn visit(&mut self, tally: &mut Y, i: u32, limit: T) -> T {
        let object = &self.world.objects[i as usize];
        *self.found = *self.found
            || object.is_met::<R, FRAMES>(self.rules, self.ray, &self.world.meshes, tally);
        if *self.found { -T::INFINITY } else { limit }
    }
}

/// Finds all crossings, unless something blocks the ray.
struct All<'a, T, R, B, const FRAMES: bool> {
    world: &'a World<T>,
    rules: R,
    ray: &'a Ray<T>,
    blocks: B,
    all: &'a mut Crossings<T>,
    is_blocked: &'a mut bool,
}

impl<T: Real, R: RuleSource, Y: Tally, B: Fn(usize) -> bool, const FRAMES: bool> Visit<T, Y>
    for All<'_, T, R, B, FRAMES>
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
                object.is_met::<R, FRAMES>(self.rules, self.ray, &world.meshes, tally);
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
    /// None.
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
