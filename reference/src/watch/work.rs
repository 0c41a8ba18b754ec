//! Kinds of work that rays cause, and counters of it.

use serde::Serialize;

use crate::bvh;

/// A kind of work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Work {
    /// A node of the tree over objects is visited.
    ObjectNode,
    /// An object is tested for intersection with a ray.
    Object,
    /// A node of the tree over a mesh's triangles is visited. A visit of a whole packet counts
    /// once.
    MeshNode,
    /// A triangle of a mesh is tested for intersection. A test of a whole packet counts once.
    Triangle,
    /// A ray is transformed into the space of an object. [rule 20]
    MovedRay,
    /// The normals of a triangle's vertices are interpolated. [rule 18]
    SmoothNormal,
    /// A highlight is raised to its exponent. [rule 3]
    Power,
    /// Light is attenuated by distance. [rule 4]
    Attenuation,
    /// A shadow ray continues through a transparent surface, tinted. [rule 6]
    TintedCrossing,
    /// A path ends because of its weight. [rule 13]
    FaintPath,
    /// A light is skipped because it is too weak at a point.
    FaintLight,
    /// A light is skipped because its term vanishes in the rounded sum of the others.
    VanishingLight,
    /// A shadow ray ends at the first hit, since no transparent object can lie on it.
    UntintedRay,
    /// A shadow ray or a spawned ray is not cast because it can only miss.
    SureMiss,
}

/// A counter of work; `()` counts nothing.
pub trait Tally {
    /// Counts one unit of work.
    #[inline(always)]
    fn did(&mut self, _work: Work) {}
}

impl Tally for () {}

/// Counts of work, by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[allow(missing_docs, reason = "one for each kind of `Work`")]
pub struct Amounts {
    pub object_nodes: u64,
    pub objects: u64,
    pub mesh_nodes: u64,
    pub triangles: u64,
    pub moved_rays: u64,
    pub smooth_normals: u64,
    pub powers: u64,
    pub attenuations: u64,
    pub tinted_crossings: u64,
    pub faint_paths: u64,
    pub faint_lights: u64,
    pub vanishing_lights: u64,
    pub untinted_rays: u64,
    pub sure_misses: u64,
}

impl Amounts {
    /// Returns the sums of both counts.
    #[must_use]
    pub fn plus(mut self, other: Self) -> Self {
        for work in Work::ALL {
            *self.at(work) += other.of(work);
        }
        self
    }

    /// Returns the count of `work`.
    pub fn of(mut self, work: Work) -> u64 {
        *self.at(work)
    }

    #[inline(always)]
    fn at(&mut self, work: Work) -> &mut u64 {
        match work {
            Work::ObjectNode => &mut self.object_nodes,
            Work::Object => &mut self.objects,
            Work::MeshNode => &mut self.mesh_nodes,
            Work::Triangle => &mut self.triangles,
            Work::MovedRay => &mut self.moved_rays,
            Work::SmoothNormal => &mut self.smooth_normals,
            Work::Power => &mut self.powers,
            Work::Attenuation => &mut self.attenuations,
            Work::TintedCrossing => &mut self.tinted_crossings,
            Work::FaintPath => &mut self.faint_paths,
            Work::FaintLight => &mut self.faint_lights,
            Work::VanishingLight => &mut self.vanishing_lights,
            Work::UntintedRay => &mut self.untinted_rays,
            Work::SureMiss => &mut self.sure_misses,
        }
    }
}

impl Tally for Amounts {
    #[inline(always)]
    fn did(&mut self, work: Work) {
        *self.at(work) += 1;
    }
}

impl Work {
    /// Every kind of work.
    pub const ALL: [Self; 14] = [
        Self::ObjectNode,
        Self::Object,
        Self::MeshNode,
        Self::Triangle,
        Self::MovedRay,
        Self::SmoothNormal,
        Self::Power,
        Self::Attenuation,
        Self::TintedCrossing,
        Self::FaintPath,
        Self::FaintLight,
        Self::VanishingLight,
        Self::UntintedRay,
        Self::SureMiss,
    ];

    /// Returns the name of several units of the work, such as `objects tested`.
    pub fn name(self) -> &'static str {
        match self {
            Self::ObjectNode => "nodes of the tree of objects",
            Self::Object => "objects tested",
            Self::MeshNode => "nodes of the trees of meshes",
            Self::Triangle => "triangles tested",
            Self::MovedRay => "rays transformed into object space",
            Self::SmoothNormal => "normals interpolated",
            Self::Power => "highlights raised to a power",
            Self::Attenuation => "attenuations computed",
            Self::TintedCrossing => "surfaces crossed by shadow rays",
            Self::FaintPath => "paths ended for their weight",
            Self::FaintLight => "lights too weak to be followed",
            Self::VanishingLight => "lights that vanish in the sum of the others",
            Self::UntintedRay => "shadow rays away from all transparent objects",
            Self::SureMiss => "rays not cast because they can only miss",
        }
    }
}

/// Counts the visits of the tree over objects as work.
#[derive(Debug)]
pub struct ObjectVisits<'a, Y>(pub &'a mut Y);

/// Counts the visits of the tree over a mesh's triangles as work.
#[derive(Debug)]
pub struct TriangleVisits<'a, Y>(pub &'a mut Y);

impl<Y: Tally> bvh::VisitCounter for ObjectVisits<'_, Y> {
    #[inline(always)]
    fn node(&mut self) {
        self.0.did(Work::ObjectNode);
    }

    #[inline(always)]
    fn primitive(&mut self) {
        self.0.did(Work::Object);
    }
}

impl<Y: Tally> bvh::VisitCounter for TriangleVisits<'_, Y> {
    #[inline(always)]
    fn node(&mut self) {
        self.0.did(Work::MeshNode);
    }

    #[inline(always)]
    fn primitive(&mut self) {
        self.0.did(Work::Triangle);
    }
}
