//! The pairs of one kind within a mesh, or between two meshes.

use super::hierarchies::Hierarchies;
use super::pairs::Sink;
use super::traversal::{BlockPair, Common, Scratch, Trees};
use super::tree::Tree;
use crate::step::CollisionFilter;
use selvedge_core::PairKind;

/// Two sets of primitives, of one mesh or of two: vertices of the first and faces of the second, or edges of both.
///
/// The boxes of two meshes must be comparable: made by one [mapping](selvedge_core::boxes::mapping), or by several about one
/// origin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pairing<'a> {
    pub(crate) kind: PairKind,
    pub(crate) meshes: [&'a Hierarchies; 2],
    is_within: bool,
}

impl<'a> Pairing<'a> {
    #[inline(always)]
    const fn within(kind: PairKind, mesh: &'a Hierarchies) -> Self {
        Self {
            kind,
            meshes: [mesh; 2],
            is_within: true,
        }
    }

    /// Returns both kinds of pairs of a mesh with itself.
    pub(crate) fn all_within(mesh: &'a Hierarchies) -> [Self; 2] {
        PairKind::ALL.map(|kind| Self::within(kind, mesh))
    }

    /// Returns the pairs of two meshes: vertices of the first and faces of the second, the other way round, and edges of both.
    pub(crate) fn all_between(first: &'a Hierarchies, second: &'a Hierarchies) -> [Self; 3] {
        let between = |kind, meshes| Self {
            kind,
            meshes,
            is_within: false,
        };
        [
            between(PairKind::VertexFace, [first, second]),
            between(PairKind::VertexFace, [second, first]),
            between(PairKind::EdgeEdge, [first, second]),
        ]
    }

    /// Appends the tasks of a search for pairs. Returns the number of box tests.
    pub(crate) fn find_tasks(&self, stack: &mut Vec<BlockPair>, tasks: &mut Vec<BlockPair>) -> u64 {
        let level = self.meshes[0].level();
        match self.kind {
            PairKind::VertexFace => self.vertex_face().tasks(level, TASK_LEVEL, stack, tasks),
            PairKind::EdgeEdge => self.edge_edge().tasks(level, TASK_LEVEL, stack, tasks),
        }
    }

    /// Gives `sink` the candidates of some tasks that the mesh's filter allows, by their positions. Returns the number of box
    /// tests, or `None` if the sink stops the traversal.
    pub(crate) fn visit(&self, tasks: &[BlockPair], scratch: &mut Scratch, sink: &mut dyn Sink) -> Option<u64> {
        let [mesh, _] = self.meshes;
        let Some(filter) = mesh.filter.as_ref().filter(|_| self.is_within) else {
            return self.visit_all(tasks, scratch, sink);
        };
        let mut allowed = Allowed {
            hierarchies: mesh,
            filter,
            kind: self.kind,
            pairs: std::mem::take(&mut scratch.allowed),
            sink,
        };
        let tests = self.visit_all(tasks, scratch, &mut allowed);
        scratch.allowed = allowed.pairs;
        tests
    }

    fn visit_all(&self, tasks: &[BlockPair], scratch: &mut Scratch, sink: &mut dyn Sink) -> Option<u64> {
        let level = self.meshes[0].level();
        match self.kind {
            PairKind::VertexFace => self.vertex_face().pairs(level, tasks, scratch, sink),
            PairKind::EdgeEdge => self.edge_edge().pairs(level, tasks, scratch, sink),
        }
    }

    fn vertex_face(&self) -> Trees<'a, 1, 3> {
        let [first, second] = self.meshes;
        self.trees(&first.vertices, &second.faces, Common::Mesh)
    }

    fn edge_edge(&self) -> Trees<'a, 2, 2> {
        let [first, second] = self.meshes;
        self.trees(&first.edges, &second.edges, Common::Tree)
    }

    fn trees<const N: usize, const M: usize>(&self, first: &'a Tree<N>, second: &'a Tree<M>, within: Common) -> Trees<'a, N, M> {
        Trees {
            first,
            second,
            common: if self.is_within { within } else { Common::Nothing },
            are_filtered: self.is_within && self.meshes[0].filter.is_some(),
            of_neighbours: self.meshes[0].of_neighbours().filter(|_| self.is_within),
        }
    }

    /// Returns the rows of a pair's four vertices, given the first row of each of two meshes.
    #[inline(always)]
    pub(crate) fn rows_of(&self, [first, second]: [u32; 2], first_rows: [u32; 2]) -> [u32; 4] {
        let [mesh, other] = self.meshes;
        let [here, there] = first_rows;
        match self.kind {
            PairKind::VertexFace => {
                let [a, b, c] = other.face_corners(second);
                [here + first, there + a, there + b, there + c]
            }
            PairKind::EdgeEdge => {
                let ([a, b], [c, d]) = (mesh.edge_ends()[first as usize], other.edge_ends()[second as usize]);
                [here + a, here + b, there + c, there + d]
            }
        }
    }

    /// Returns a pair of two meshes as each mesh numbers its primitives.
    pub(crate) fn in_meshes(&self, [first, second]: [u32; 2]) -> [u32; 2] {
        let [mesh, other] = self.meshes;
        let (first, second) = (first as usize, second as usize);
        match self.kind {
            PairKind::VertexFace => [mesh.vertices.primitives[first], other.faces.primitives[second]],
            PairKind::EdgeEdge => [mesh.edges.primitives[first], other.edges.primitives[second]],
        }
    }
}

/// A sink that passes on the allowed pairs.
struct Allowed<'a> {
    hierarchies: &'a Hierarchies,
    filter: &'a CollisionFilter,
    kind: PairKind,
    pairs: Vec<[u32; 2]>,
    sink: &'a mut dyn Sink,
}

impl Sink for Allowed<'_> {
    fn take(&mut self, pairs: &[[u32; 2]]) -> bool {
        let Self {
            hierarchies,
            filter,
            kind,
            pairs: allowed,
            sink,
        } = self;
        allowed.clear();
        allowed.extend(pairs.iter().filter(|&&pair| {
            let pair = hierarchies.in_mesh(*kind, pair);
            filter.allows(*kind, pair, hierarchies.topology().vertices_of(*kind, pair))
        }));
        sink.take(allowed)
    }
}

/// The faces and edges of one mesh without a common vertex. Faces come first, since they are fewer: each is compared with sixteen
/// edges at once.
#[derive(Clone, Copy)]
pub(crate) struct FacesAndEdges<'a>(pub(crate) &'a Hierarchies);

impl FacesAndEdges<'_> {
    fn trees(&self) -> Trees<'_, 3, 2> {
        Trees {
            first: &self.0.faces,
            second: &self.0.edges,
            common: Common::Mesh,
            are_filtered: self.0.filter.is_some(),
            of_neighbours: None,
        }
    }

    /// Appends the tasks of a search for pairs. Returns the number of box tests.
    pub(crate) fn find_tasks(&self, stack: &mut Vec<BlockPair>, tasks: &mut Vec<BlockPair>) -> u64 {
        self.trees().tasks(self.0.level(), TASK_LEVEL, stack, tasks)
    }

    /// Gives `sink` the pairs of some tasks, by their positions. Returns the number of box tests, or `None` if the sink stops the
    /// traversal.
    pub(crate) fn visit(&self, tasks: &[BlockPair], scratch: &mut Scratch, sink: &mut dyn Sink) -> Option<u64> {
        self.trees().pairs(self.0.level(), tasks, scratch, sink)
    }
}

/// The level of the blocks of tasks, which have 256 primitives each.
const TASK_LEVEL: usize = 1;
