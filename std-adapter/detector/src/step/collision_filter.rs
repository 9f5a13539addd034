//! Pairs that never collide: by groups, by patches, one by one, or by a rule of the caller.

use super::error::StepError;
use crate::mesh::Topology;
use selvedge_core::PairKind;
use std::fmt;
use std::sync::Arc;

/// The groups of a vertex and the groups that it collides with, one bit for each group, as in game engines. Two vertices collide
/// if each is in a group of the other's filter.
///
/// ```
/// use selvedge::Groups;
/// let (cloth, body, ghost) = (Groups::new(0b01, 0b11), Groups::new(0b10, 0b01), Groups::new(0b10, 0));
/// assert!(cloth.collide(cloth) && cloth.collide(body) && !body.collide(body) && !cloth.collide(ghost));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Groups {
    /// The groups of the vertex.
    pub memberships: u32,
    /// The groups that the vertex collides with.
    pub filter: u32,
}

impl Groups {
    /// Groups with all memberships that collide with all.
    pub const ALL: Self = Self::new(u32::MAX, u32::MAX);

    /// Makes groups from memberships and a filter.
    #[must_use]
    pub const fn new(memberships: u32, filter: u32) -> Self {
        Self { memberships, filter }
    }

    /// Returns whether each is in a group that the other collides with.
    #[must_use]
    pub const fn collide(self, other: Self) -> bool {
        self.memberships & other.filter != 0 && other.memberships & self.filter != 0
    }

    /// Returns groups that collide with everything that one of the two collides with.
    const fn either(self, other: Self) -> Self {
        Self::new(self.memberships | other.memberships, self.filter | other.filter)
    }
}

impl Default for Groups {
    fn default() -> Self {
        Self::ALL
    }
}

/// Excludes pairs of a mesh. An excluded pair is never a candidate and never a contact.
///
/// [Groups](Self::with_groups), [patches](Self::with_patches) and [pairs](Self::without_vertex_pairs) say which vertices do not
/// collide. A pair of primitives is excluded if no vertex of one collides with a vertex of the other (the rule of ipc-toolkit).
/// The caller's [own rule](Self::with_rule) can exclude it, too. Groups and patches also exclude whole parts of the mesh at once,
/// which saves their traversal.
///
/// Meshes that never move need no filter: see [`set_moving`](crate::CollisionDetector::set_moving).
///
/// ```
/// use selvedge::{CollisionDetector, CollisionFilter, Groups, Topology, glam::DVec3};
///
/// // A sheet of two triangles that folds onto itself, and a third that falls on both.
/// let topology = Topology::new(7, vec![[0, 1, 2], [1, 3, 2], [4, 5, 6]])?;
/// let below = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.1]];
/// let above = [[0.1, 0.1, 1.0], [0.9, 0.1, 1.1], [0.1, 0.9, 1.2]];
/// let start = [&below[..], &above].concat();
/// let mut end = start.clone();
/// end[3] = [0.1, 0.1, -0.1];
/// end[4..].iter_mut().for_each(|vertex| vertex[2] -= 2.0);
///
/// let mut detector = CollisionDetector::<f64>::new(topology);
/// let mut contacts = Vec::new();
/// detector.contacts(&start, &end, &mut contacts)?;
/// let all = contacts.len();
/// // The third triangle is a ghost: only contacts of the sheet with itself remain.
/// let groups = [Groups::ALL; 4].into_iter().chain([Groups::new(1, 0); 3]).collect();
/// detector.set_collision_filter(CollisionFilter::new().with_groups(groups))?;
/// detector.contacts(&start, &end, &mut contacts)?;
/// let own = contacts.len();
/// // Only pairs of different components.
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
    /// The excluded pairs of vertices, ascending, the smaller number first.
    excluded: Vec<[u32; 2]>,
    rule: Option<Arc<Rule>>,
}

/// A rule on a kind of pair, its two primitives and its four vertices.
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
    /// Makes a filter that excludes nothing.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds groups, one entry for each vertex of the mesh.
    #[must_use]
    pub fn with_groups(mut self, groups: Vec<Groups>) -> Self {
        self.groups = Some(groups);
        self
    }

    /// Adds a patch for each vertex of the mesh. Vertices of one patch do not collide.
    #[must_use]
    pub fn with_patches(mut self, patches: Vec<u32>) -> Self {
        self.patches = Some(patches);
        self
    }

    /// Makes a filter in which each connected component is a patch, so that no component collides with itself.
    #[must_use]
    pub fn between_components(topology: &Topology) -> Self {
        Self::new().with_patches(topology.components())
    }

    /// Excludes these pairs of vertices, in either order.
    #[must_use]
    pub fn without_vertex_pairs(mut self, pairs: impl IntoIterator<Item = [u32; 2]>) -> Self {
        self.excluded.extend(pairs.into_iter().map(|[a, b]| [a.min(b), a.max(b)]));
        self.excluded.sort_unstable();
        self.excluded.dedup();
        self
    }

    /// Excludes pairs for which `rule` is false. The rule gets the kind, the two primitives and their four vertices, as the mesh
    /// numbers them.
    ///
    /// The rule runs on any thread, and only for candidates. It must always return the same for the same pair; this is not
    /// checked.
    #[must_use]
    pub fn with_rule(mut self, rule: impl Fn(PairKind, [u32; 2], [u32; 4]) -> bool + Send + Sync + 'static) -> Self {
        self.rule = Some(Arc::new(rule));
        self
    }

    /// Returns whether a pair of primitives may collide. Vertices without an entry collide with all.
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
        let [ours, theirs] = [a, b].map(|vertex| Members::of_vertex(self, vertex));
        ours.may_collide(theirs) && self.excluded.binary_search(&[a.min(b), a.max(b)]).is_err()
    }

    pub(crate) const fn excludes_nothing(&self) -> bool {
        self.groups.is_none() && self.patches.is_none() && self.excluded.is_empty() && self.rule.is_none()
    }

    /// Checks that lists have an entry for each vertex, and that all vertices exist.
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

/// The groups and the patch of some vertices together. They decide whether any of the vertices may collide with others.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Members {
    groups: Groups,
    /// The common patch; `None` for vertices of several patches.
    patch: Option<u32>,
}

impl Members {
    pub(crate) fn of_vertex(filter: &CollisionFilter, vertex: u32) -> Self {
        let vertex = vertex as usize;
        let groups = filter.groups.as_ref().and_then(|groups| groups.get(vertex));
        let patch = filter.patches.as_ref().and_then(|patches| patches.get(vertex));
        Self {
            groups: groups.copied().unwrap_or_default(),
            patch: patch.copied(),
        }
    }

    /// Takes the groups of a mesh as a whole.
    pub(crate) const fn of_mesh(groups: Groups) -> Self {
        Self { groups, patch: None }
    }

    pub(crate) fn joined(self, other: Self) -> Self {
        Self {
            groups: self.groups.either(other.groups),
            patch: self.patch.filter(|_| self.patch == other.patch),
        }
    }

    /// Returns false only if no vertex of these collides with one of the others.
    #[inline]
    pub(crate) fn may_collide(self, other: Self) -> bool {
        let are_one_patch = self.patch.is_some() && self.patch == other.patch;
        !are_one_patch && self.groups.collide(other.groups)
    }
}
