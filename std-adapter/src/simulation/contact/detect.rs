//! Which primitive pairs may come close in a step: the only place that knows how candidates are found.
//!
//! Each vertex has a box that holds its path, and some room around it. Triangles whose boxes overlap are found by the
//! [broad phase](crate::broad_phase), distributed to primitive pairs by representative features
//! ([`distribution`](selvedge_core::distribution)), and those whose own boxes overlap are candidates. So a pair that is none keeps
//! apart by twice the room, less twice what its vertices' paths stray from their boxes without it.

use super::pair::Pair;
use crate::PairKind;
use crate::broad_phase::{BroadPhase, SweptBox};
use crate::mesh::{Topology, TopologyError};
use crate::parallel;
use crate::pipeline::FeatureAssignment;
use crate::pipeline::swept::map_boxes;
use crate::simulation::plan::{FREE, Frame};
use selvedge_core::boxes::Aabb;
use selvedge_core::distribution::distribute;

/// What is to be kept apart.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wanted {
    pub(super) cloth: bool,
    pub(super) bodies: bool,
}

/// How many pairs each stage passed on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Counts {
    pub(super) triangle_pairs: u64,
    pub(super) primitive_pairs: u64,
    pub(super) candidates: u64,
}

/// Finds candidates, with buffers that it keeps.
#[derive(Debug)]
pub(super) struct Detector {
    topology: Topology,
    assignment: FeatureAssignment,
    wanted: Wanted,
    /// Of each vertex: whose motion it follows.
    carriers: Vec<Frame>,
    /// Of each triangle: the body that it belongs to, [`FREE`] for cloth.
    bodies: Vec<Frame>,
    broad_phase: BroadPhase,
    triangle_pairs: Vec<[u32; 2]>,
    faces: Vec<Aabb<f64>>,
    edges: Vec<Aabb<f64>>,
    swept: Vec<SweptBox>,
}

impl Detector {
    /// `triangles`: the cloth's, then the bodies'; `carriers` of each vertex; vertices from `cloth_vertices` on are bodies'.
    pub(super) fn new(
        triangles: &[[u32; 3]],
        carriers: &[Frame],
        cloth_vertices: usize,
        wanted: Wanted,
    ) -> Result<Self, TopologyError> {
        let topology = Topology::new(carriers.len(), triangles.to_vec())?;
        let body = |triangle: &[u32; 3]| match triangle[0] as usize {
            vertex if vertex < cloth_vertices => FREE,
            vertex => carriers[vertex],
        };
        Ok(Self {
            assignment: FeatureAssignment::representative(&topology),
            bodies: triangles.iter().map(body).collect(),
            topology,
            wanted,
            carriers: carriers.to_vec(),
            broad_phase: BroadPhase::new(),
            triangle_pairs: Vec::new(),
            faces: Vec::new(),
            edges: Vec::new(),
            swept: Vec::new(),
        })
    }

    /// Replaces `pairs` by the candidates for vertices that stay in `boxes`, in ascending order of their keys.
    pub(super) fn candidates(&mut self, boxes: &[Aabb<f64>], pairs: &mut Vec<Pair>) -> Counts {
        let vertex = |v: u32| boxes[v as usize];
        parallel::fill(&mut self.faces, self.topology.triangles(), |&[a, b, c]| {
            vertex(a).merged(&vertex(b)).merged(&vertex(c))
        });
        parallel::fill(&mut self.edges, self.topology.edges(), |&[a, b]| {
            vertex(a).merged(&vertex(b))
        });
        map_boxes(&mut self.swept, &self.faces);
        self.broad_phase.update(&self.swept);
        self.broad_phase
            .candidate_triangle_pairs(&mut self.triangle_pairs);
        let mut counts = Counts::default();
        pairs.clear();
        let triangles = self.assignment.triangles();
        for &[a, b] in &self.triangle_pairs {
            let body = match (self.bodies[a as usize], self.bodies[b as usize]) {
                (FREE, FREE) if self.wanted.cloth => FREE,
                (FREE, body) | (body, FREE) if body != FREE && self.wanted.bodies => body,
                _ => continue,
            };
            counts.triangle_pairs += 1;
            let found = distribute(&triangles[a as usize], &triangles[b as usize]);
            // 28 bits hold the triangles of any mesh that fits into memory several times over.
            let key = |slot: usize| u64::from(a) << 36 | u64::from(b) << 8 | slot as u64;
            counts.primitive_pairs += (found.vertex_face.len() + found.edge_edge.len()) as u64;
            for (slot, &[v, face]) in found.vertex_face.iter().enumerate() {
                if boxes[v as usize].overlaps(&self.faces[face as usize]) {
                    self.push(pairs, key(slot), PairKind::VertexFace, [v, face], body);
                }
            }
            for (slot, &[e, f]) in found.edge_edge.iter().enumerate() {
                if self.edges[e as usize].overlaps(&self.edges[f as usize]) {
                    self.push(pairs, key(8 + slot), PairKind::EdgeEdge, [e, f], body);
                }
            }
        }
        counts.candidates = pairs.len() as u64;
        counts
    }

    /// Adds a pair, unless all of it follows one motion, which never changes it.
    #[inline(always)]
    fn push(&self, pairs: &mut Vec<Pair>, key: u64, kind: PairKind, pair: [u32; 2], body: Frame) {
        let vertices = kind.vertices(pair, &self.topology);
        let [a, b, c, d] = vertices.map(|v| self.carriers[v as usize]);
        if a == FREE || a != b || a != c || a != d {
            pairs.push(Pair::new(key, kind, vertices, body));
        }
    }
}
