//! Pairs that are not to be looked at, whatever they do: by groups, by patches, one by one, or as the caller decides.

use super::error::StepError;
use crate::PairKind;
use crate::mesh::Topology;
use std::fmt;
use std::sync::Arc;

/// What a vertex belongs to, and what it collides with, one bit for each group, as game engines have it: two vertices collide if each is in
/// a group that the other's filter has.
///
/// ```
/// use selvedge::Groups;
/// let (cloth, body, ghost) = (Groups::new(0b01, 0b11), Groups::new(0b10, 0b01), Groups::new(0b10, 0));
/// assert!(cloth.collide(cloth) && cloth.collide(body) && !body.collide(body) && !cloth.collide(ghost));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Groups {
    /// The groups that it is in.
    pub memberships: u32,
    /// The groups that it collides with.
    pub filter: u32,
}

impl Groups {
    /// In all groups, colliding with all.
    pub const ALL: Self = Self::new(u32::MAX, u32::MAX);

    /// In some groups, colliding with some.
    #[must_use]
    pub const fn new(memberships: u32, filter: u32) -> Self {
        Self { memberships, filter }
    }

    /// Whether each is in a group that the other collides with.
    #[must_use]
    pub const fn collide(self, other: Self) -> bool {
        self.memberships & other.filter != 0 && other.memberships & self.filter != 0
    }

    /// Colliding with whatever one of the two does.
    const fn either(self, other: Self) -> Self {
        Self::new(self.memberships | other.memberships, self.filter | other.filter)
    }
}

impl Default for Groups {
    fn default() -> Self {
        Self::ALL
    }
}

/// Which pairs of a mesh are looked at; at first all. What it excludes is never a candidate and never a contact.
///
/// Vertices collide or do not: by [groups](Self::with_groups), [patches](Self::with_patches) and
/// [pairs](Self::without_vertex_pairs), each of which may only exclude. A pair of primitives is excluded if none of the vertices of one collides
/// with any of the other's (ipc-toolkit's rule), or if the caller's [own rule](Self::with_rule) says so. What is excluded by groups or patches as
/// a whole costs nothing: the traversal does not go there.
///
/// Meshes that never move need no filter: see [`set_moving`](crate::CollisionDetector::set_moving).
///
/// ```
/// use selvedge::{CollisionDetector, CollisionFilter, Groups, Topology, glam::DVec3};
///
/// // A sheet of two triangles that folds onto itself, and a third that falls on both.
/// let topology = Topology::new(7, vec![[0, 1, 2], [1, 3, 2], [4, 5, 6]])?;
/// let start = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.1], [0.1, 0.1, 1.0], [0.9, 0.1, 1.1], [0.1, 0.9, 1.2]];
/// let mut end = start;
/// end[3] = [0.1, 0.1, -0.1];
/// end[4..].iter_mut().for_each(|vertex| vertex[2] -= 2.0);
///
/// let mut detector = CollisionDetector::<f64>::new(topology);
/// let mut contacts = Vec::new();
/// detector.contacts(&start, &end, &mut contacts)?;
/// let all = contacts.len();
/// // The third triangle is a ghost: only what the sheet does to itself is left.
/// let groups = [Groups::ALL; 4].into_iter().chain([Groups::new(1, 0); 3]).collect();
/// detector.set_collision_filter(CollisionFilter::new().with_groups(groups))?;
/// detector.contacts(&start, &end, &mut contacts)?;
/// let own = contacts.len();
/// // Only different components: what it does to the other.
/// let components = CollisionFilter::between_components(detector.topology());
/// detector.set_collision_filter(components)?;
/// detector.contacts(&start, &end, &mut contacts)?;
/// assert!(own + contacts.len() == all && !contacts.is_empty());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Default)]
pub struct CollisionFilter {
    groups: Option<Vec<Groups>>,
    patches: Option<Vec<u32>>,
    /// In ascending order, the smaller number first.
    excluded: Vec<[u32; 2]>,
    rule: Option<Arc<Rule>>,
}

/// Of a kind of pair, its two primitives and its four vertices.
type Rule = dyn Fn(PairKind, [u32; 2], [u32; 4]) -> bool + Send + Sync;

impl fmt::Debug for CollisionFilter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("CollisionFilter")
            .field("groups", &self.groups)
            .field("patches", &self.patches)
            .field("excluded", &self.excluded)
            .field("has_rule", &self.rule.is_some())
            .finish()
    }
}

impl CollisionFilter {
    /// Excludes nothing.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// With groups for each vertex of the mesh.
    #[must_use]
    pub fn with_groups(mut self, groups: Vec<Groups>) -> Self {
        self.groups = Some(groups);
        self
    }

    /// With a patch for each vertex of the mesh: vertices of one patch do not collide.
    #[must_use]
    pub fn with_patches(mut self, patches: Vec<u32>) -> Self {
        self.patches = Some(patches);
        self
    }

    /// Each connected component is a patch: no self-collision of any.
    #[must_use]
    pub fn between_components(topology: &Topology) -> Self {
        Self::new().with_patches(topology.components())
    }

    /// These vertices do not collide with each other, in either order.
    #[must_use]
    pub fn without_vertex_pairs(mut self, pairs: impl IntoIterator<Item = [u32; 2]>) -> Self {
        self.excluded.extend(pairs.into_iter().map(|[a, b]| [a.min(b), a.max(b)]));
        self.excluded.sort_unstable();
        self.excluded.dedup();
        self
    }

    /// Only pairs for which `rule` is true. It is told the kind, the two primitives and their four vertices as the mesh numbers them, on any thread,
    /// and only of candidates. It must answer the same each time; whether it does is not looked at.
    #[must_use]
    pub fn with_rule(mut self, rule: impl Fn(PairKind, [u32; 2], [u32; 4]) -> bool + Send + Sync + 'static) -> Self {
        self.rule = Some(Arc::new(rule));
        self
    }

    /// Whether a pair of primitives is looked at. Vertices that the filter does not know collide with all.
    #[must_use]
    pub fn allows(&self, kind: PairKind, pair: [u32; 2], vertices: [u32; 4]) -> bool {
        let [a, b, c, d] = vertices;
        let collide = match kind {
            PairKind::VertexFace => [b, c, d].iter().any(|&other| self.collide(a, other)),
            PairKind::EdgeEdge => [c, d].iter().any(|&other| self.collide(a, other) || self.collide(b, other)),
        };
        collide && self.rule.as_ref().is_none_or(|rule| rule(kind, pair, vertices))
    }

    fn collide(&self, a: u32, b: u32) -> bool {
        let [ours, theirs] = [a, b].map(|vertex| Members::of(self, vertex));
        ours.may_collide(theirs) && self.excluded.binary_search(&[a.min(b), a.max(b)]).is_err()
    }

    pub(crate) const fn excludes_nothing(&self) -> bool {
        self.groups.is_none() && self.patches.is_none() && self.excluded.is_empty() && self.rule.is_none()
    }

    /// A list must have an entry for each vertex, and a vertex must exist.
    pub(crate) fn check(&self, vertices: usize) -> Result<(), StepError> {
        let lengths = [self.groups.as_ref().map(Vec::len), self.patches.as_ref().map(Vec::len)];
        if let Some(found) = lengths.into_iter().flatten().find(|&found| found != vertices) {
            return Err(StepError::WrongCount {
                found,
                expected: vertices,
            });
        }
        match self.excluded.iter().flatten().find(|&&vertex| vertex as usize >= vertices) {
            Some(&vertex) => Err(StepError::NoSuchVertex { vertex, count: vertices }),
            None => Ok(()),
        }
    }
}

/// The groups and the patch of some vertices together: what decides whether any of them may collide with any of others.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Members {
    groups: Groups,
    /// `None` if they are of several.
    patch: Option<u32>,
}

impl Members {
    pub(crate) fn of(filter: &CollisionFilter, vertex: u32) -> Self {
        let vertex = vertex as usize;
        let groups = filter.groups.as_ref().and_then(|groups| groups.get(vertex));
        let patch = filter.patches.as_ref().and_then(|patches| patches.get(vertex));
        Self {
            groups: groups.copied().unwrap_or_default(),
            patch: patch.copied(),
        }
    }

    /// Those of a mesh as a whole.
    pub(crate) const fn of_mesh(groups: Groups) -> Self {
        Self { groups, patch: None }
    }

    pub(crate) fn joined(self, other: Self) -> Self {
        Self {
            groups: self.groups.either(other.groups),
            patch: self.patch.filter(|_| self.patch == other.patch),
        }
    }

    /// False only if no vertex of these collides with one of the others.
    #[inline]
    pub(crate) fn may_collide(self, other: Self) -> bool {
        let are_one_patch = self.patch.is_some() && self.patch == other.patch;
        !are_one_patch && self.groups.collide(other.groups)
    }
}
