//! Searches of a world: the nearest hit of a ray, whether a ray is occluded, and all that a ray
//! crosses. [rule 2] [rule 5] [rule 6]

use std::ops::Deref;

use arrayvec::ArrayVec;

use crate::bvh::Visit;
use crate::numbers::real::Real;
use crate::rays::ray::Ray;
use crate::rules::{Nearest, RuleSource, Searched};
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
        self.search(FirstHit { rules }, ray, tally)
    }

    /// Returns whether anything lies in the ray's interval; the first hit found ends the search.
    /// [rule 5]
    #[inline(always)]
    pub fn occluded<R: RuleSource>(&self, rules: R, ray: &Ray<T>, tally: &mut impl Tally) -> bool {
        self.search(AnyHit { rules }, ray, tally)
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
        let is_blocked = self.search(AllCrossings { rules, blocks, all: &mut *all }, ray, tally);
        all.sort();
        !is_blocked
    }

    /// Returns what `query` finds along the ray.
    #[inline(always)]
    fn search<Q: Query<T>, Y: Tally>(&self, query: Q, ray: &Ray<T>, tally: &mut Y) -> Q::Found {
        match self.has_frames {
            true => self.search_with::<Q, Y, true>(query, ray, tally),
            false => self.search_with::<Q, Y, false>(query, ray, tally),
        }
    }

    #[inline(always)]
    fn search_with<Q: Query<T>, Y: Tally, const FRAMES: bool>(
        &self,
        query: Q,
        ray: &Ray<T>,
        tally: &mut Y,
    ) -> Q::Found {
        // Two variables, of which one is used: the walk through a tree needs its own in memory. A
        // shared one would lie in memory for the search of the list as well.
        let (mut of_tree, mut of_list) = (Q::Found::default(), Q::Found::default());
        if self.tree.is_some() {
            let found = &mut of_tree;
            let visitor = Visitor::<_, _, _, FRAMES> { world: self, query, ray, found };
            self.each_of_tree(ray, tally, ByCall(visitor));
            return of_tree;
        }
        let found = &mut of_list;
        let mut visitor = Visitor::<_, _, _, FRAMES> { world: self, query, ray, found };
        let mut limit = ray.t_max;
        for i in 0..self.objects.len() as u32 {
            tally.did(Work::Object);
            limit = visitor.visit(tally, i, limit);
            if Q::ENDS && limit == -T::INFINITY {
                break;
            }
        }
        of_list
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

/// A search of the objects of a world along one ray.
trait Query<T: Real> {
    /// The result of the search. Before the first object it has its default value.
    type Found: Default;
    /// Whether the search of a list can end before the last object.
    const ENDS: bool;

    /// Searches the object with the index `i`. Returns the new limit: only a hit before it can
    /// still count, and −∞ ends the search. `FRAMES` says whether objects may have a space of their
    /// own.
    fn visit<Y: Tally, const FRAMES: bool>(
        &mut self,
        world: &World<T>,
        ray: &Ray<T>,
        found: &mut Self::Found,
        tally: &mut Y,
        i: usize,
        limit: T,
    ) -> T;
}

/// The visitor of the objects for a query.
struct Visitor<'a, T, Q, F, const FRAMES: bool> {
    world: &'a World<T>,
    query: Q,
    ray: &'a Ray<T>,
    found: &'a mut F,
}

impl<T: Real, Y: Tally, Q: Query<T>, const FRAMES: bool> Visit<T, Y>
    for Visitor<'_, T, Q, Q::Found, FRAMES>
{
    #[inline(always)]
    fn visit(&mut self, tally: &mut Y, i: u32, limit: T) -> T {
        let Self { world, query, ray, found } = self;
        query.visit::<Y, FRAMES>(world, ray, found, tally, i as usize, limit)
    }
}

/// The search for the nearest hit.
struct FirstHit<R> {
    rules: R,
}

impl<T: Real, R: RuleSource> Query<T> for FirstHit<R> {
    type Found = Option<(usize, ShapeHit<T>)>;
    const ENDS: bool = false;

    #[inline(always)]
    fn visit<Y: Tally, const FRAMES: bool>(
        &mut self,
        world: &World<T>,
        ray: &Ray<T>,
        best: &mut Self::Found,
        tally: &mut Y,
        i: usize,
        mut limit: T,
    ) -> T {
        let nearest = self.rules.get().nearest;
        let is_searched = match self.rules.get().searched {
            Searched::All => true,
            Searched::NotFirst => i > 0,
            Searched::NotLast => i + 1 < world.objects.len(),
        };
        if !is_searched {
            return limit;
        }
        let note = |hit: ShapeHit<T>| {
            let wins = match &*best {
                None => true,
                Some((j, best)) => match nearest {
                    Nearest::LeastT => hit.t < best.t || (hit.t == best.t && i < *j),
                    Nearest::FirstListed => i < *j,
                    Nearest::LastListed => i > *j,
                    Nearest::Farthest => hit.t > best.t,
                    Nearest::LastOfEqual => hit.t < best.t || (hit.t == best.t && i > *j),
                },
            };
            if wins {
                limit = if nearest == Nearest::LeastT { hit.t } else { limit };
                *best = Some((i, hit));
            }
        };
        world.objects[i].intersect::<R, FRAMES>(self.rules, ray, &world.meshes, tally, note);
        limit
    }
}

/// The search for any hit.
struct AnyHit<R> {
    rules: R,
}

impl<T: Real, R: RuleSource> Query<T> for AnyHit<R> {
    type Found = bool;
    const ENDS: bool = true;

    #[inline(always)]
    fn visit<Y: Tally, const FRAMES: bool>(
        &mut self,
        world: &World<T>,
        ray: &Ray<T>,
        is_hit: &mut bool,
        tally: &mut Y,
        i: usize,
        limit: T,
    ) -> T {
        let object = &world.objects[i];
        *is_hit = *is_hit || object.is_hit::<R, FRAMES>(self.rules, ray, &world.meshes, tally);
        if *is_hit { -T::INFINITY } else { limit }
    }
}

/// The search for all crossings, which ends where something blocks the ray.
struct AllCrossings<'a, T, R, B> {
    rules: R,
    blocks: B,
    all: &'a mut Crossings<T>,
}

impl<T: Real, R: RuleSource, B: Fn(usize) -> bool> Query<T> for AllCrossings<'_, T, R, B> {
    /// Whether something blocks the ray.
    type Found = bool;
    const ENDS: bool = true;

    #[inline(always)]
    fn visit<Y: Tally, const FRAMES: bool>(
        &mut self,
        world: &World<T>,
        ray: &Ray<T>,
        is_blocked: &mut bool,
        tally: &mut Y,
        i: usize,
        limit: T,
    ) -> T {
        let object = &world.objects[i];
        if *is_blocked {
            return -T::INFINITY;
        }
        if (self.blocks)(i) {
            *is_blocked = object.is_hit::<R, FRAMES>(self.rules, ray, &world.meshes, tally);
            return if *is_blocked { -T::INFINITY } else { limit };
        }
        let all = &mut *self.all;
        object.crossings::<R, _, FRAMES>(self.rules, ray, &world.meshes, tally, |tally, t| {
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
