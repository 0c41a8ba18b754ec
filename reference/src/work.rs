//! Work that rays make, piece by piece, and who is told of it.

use serde::Serialize;

use crate::bvh;

/// A piece of work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Work {
    /// A node of the tree over objects is visited.
    ObjectNode,
    /// An object is asked where a ray meets it.
    Object,
    /// A node of the tree over a mesh's triangles is visited: once for rays that are searched for
    /// together.
    MeshNode,
    /// A triangle of a mesh is asked where a ray meets it: once for rays that are searched for
    /// together.
    Triangle,
    /// A ray is moved into the space of an object with a matrix. [rule 20]
    MovedRay,
    /// The normals of a triangle's corners are mixed. [rule 18]
    SmoothNormal,
    /// A highlight is raised to its exponent. [rule 3]
    Power,
    /// Light is weakened by the way it has come. [rule 4]
    Attenuation,
    /// A shadow ray goes on through a surface, tinted. [rule 6]
    TintedCrossing,
    /// A path ends for its weight. [rule 13]
    FaintPath,
    /// The light of a lamp is too weak at a point to be followed.
    FaintLight,
}

/// Is told of work; `()` counts nothing.
pub trait Tally {
    /// That piece is done.
    #[inline(always)]
    fn did(&mut self, _work: Work) {}
}

impl Tally for () {}

/// How often each piece of work was done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[allow(missing_docs, reason = "as in `Work`")]
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
}

impl Amounts {
    /// The sums.
    #[must_use]
    pub fn plus(mut self, other: Self) -> Self {
        for work in Work::ALL {
            *self.at(work) += other.of(work);
        }
        self
    }

    /// How often that piece was done.
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
    /// Every piece there is.
    pub const ALL: [Self; 11] = [
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
    ];

    /// What to call so many of them.
    pub fn name(self) -> &'static str {
        match self {
            Self::ObjectNode => "nodes of the tree of objects",
            Self::Object => "objects asked",
            Self::MeshNode => "nodes of the trees of meshes",
            Self::Triangle => "triangles asked",
            Self::MovedRay => "rays moved into object space",
            Self::SmoothNormal => "normals interpolated",
            Self::Power => "highlights raised to a power",
            Self::Attenuation => "attenuations worked out",
            Self::TintedCrossing => "surfaces crossed by shadow rays",
            Self::FaintPath => "paths ended for their weight",
            Self::FaintLight => "lights too weak to be followed",
        }
    }
}

/// The tally of the tree over objects.
#[derive(Debug)]
pub struct OfObjects<'a, Y>(pub &'a mut Y);

/// The tally of the tree over a mesh's triangles.
#[derive(Debug)]
pub struct OfTriangles<'a, Y>(pub &'a mut Y);

impl<Y: Tally> bvh::Tally for OfObjects<'_, Y> {
    #[inline(always)]
    fn node(&mut self) {
        self.0.did(Work::ObjectNode);
    }

    #[inline(always)]
    fn thing(&mut self) {
        self.0.did(Work::Object);
    }
}

impl<Y: Tally> bvh::Tally for OfTriangles<'_, Y> {
    #[inline(always)]
    fn node(&mut self) {
        self.0.did(Work::MeshNode);
    }

    #[inline(always)]
    fn thing(&mut self) {
        self.0.did(Work::Triangle);
    }
}
