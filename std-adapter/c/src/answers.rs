//! What a detector has found, as C sees it.

use crate::detector::Finder;
use selvedge::{Contact, Intersection, PairKind, Scalar, Topology};

/// Which primitives a pair is made of.
#[repr(u32)]
#[derive(Clone, Copy)]
pub enum Kind {
    /// A vertex and a face.
    VertexFace = 0,
    /// Two edges.
    EdgeEdge = 1,
}

/// Which boxes tell candidates.
#[repr(u32)]
#[derive(Clone, Copy)]
pub enum Boxes {
    /// Those at the start and at the end of the step, that are not in one order along an axis at both. Fewer pairs, in less time.
    Moving = 0,
    /// Those that primitives sweep, that overlap: what other systems call candidates.
    Swept = 1,
}

/// A vertex and a face, two edges, or the two vertices of an edge, by their numbers.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Pair {
    /// The vertex, or the first edge.
    pub first: u32,
    /// The face, or the second edge.
    pub second: u32,
}

impl From<[u32; 2]> for Pair {
    fn from([first, second]: [u32; 2]) -> Self {
        Self { first, second }
    }
}

/// A pair for which contact during the step is not excluded.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactRow {
    /// When, in [0, 1] of the step: not after the exact time. Of a detector for float it is a float, widened without rounding.
    pub time: f64,
    /// A selvedge_kind.
    pub kind: u32,
    /// The vertex and the face, or the two edges. Faces are numbered as the triangles, edges as by selvedge_detector_edges.
    pub pair: Pair,
    /// The vertex and the face's three, or the ends of the first edge and of the second.
    pub vertices: [u32; 4],
}

impl ContactRow {
    pub(crate) fn new<S: Scalar>(contact: &Contact<S>, topology: &Topology) -> Self {
        let kind = match contact.kind {
            PairKind::VertexFace => Kind::VertexFace,
            PairKind::EdgeEdge => Kind::EdgeEdge,
        };
        Self {
            time: contact.time.to_f64(),
            kind: kind as u32,
            pair: contact.pair.into(),
            vertices: topology.vertices_of(contact.kind, contact.pair),
        }
    }
}

/// Which primitives intersect.
#[repr(u32)]
#[derive(Clone, Copy)]
pub enum IntersectionKind {
    /// An edge passes through a face, or touches it.
    EdgeFace = 0,
    /// A vertex touches a face of a neighbour, folded flat onto it.
    VertexFace = 1,
    /// Two edges of neighbours touch, folded flat onto each other.
    EdgeEdge = 2,
}

/// Two primitives of a mesh at rest that have a point in common, and no vertex.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct IntersectionRow {
    /// A selvedge_intersection_kind.
    pub kind: u32,
    /// The edge and the face, the vertex and the face, or the two edges.
    pub pair: Pair,
}

impl From<&Intersection> for IntersectionRow {
    fn from(intersection: &Intersection) -> Self {
        let (kind, pair) = match *intersection {
            Intersection::EdgeFace { edge, face } => (IntersectionKind::EdgeFace, [edge, face]),
            Intersection::VertexFace { vertex, face } => (IntersectionKind::VertexFace, [vertex, face]),
            Intersection::EdgeEdge { edges } => (IntersectionKind::EdgeEdge, edges),
        };
        Self {
            kind: kind as u32,
            pair: pair.into(),
        }
    }
}

/// Of vertices and faces, and of edges.
#[derive(Default)]
pub(crate) struct CandidatePairs {
    pub(crate) vertex_face: Vec<[u32; 2]>,
    pub(crate) edge_edge: Vec<[u32; 2]>,
}

/// The lists that pointers given to C show.
#[derive(Default)]
pub(crate) struct Answers {
    pub(crate) contacts: Vec<ContactRow>,
    pub(crate) candidates: CandidatePairs,
    /// Where candidates go first: a question that is cut short leaves those that are shown.
    pub(crate) found_candidates: CandidatePairs,
    pub(crate) found_at_rest: Vec<Intersection>,
    pub(crate) intersections: Vec<IntersectionRow>,
}

impl Answers {
    /// Takes over what the detector has found.
    pub(crate) fn show_contacts<S: Scalar>(&mut self, finder: &Finder<S>) -> &[ContactRow] {
        let topology = finder.detector.topology();
        self.contacts.clear();
        let rows = finder.contacts.iter().map(|contact| ContactRow::new(contact, topology));
        self.contacts.extend(rows);
        &self.contacts
    }

    /// Takes over the candidates that the detector has found.
    pub(crate) fn show_candidates(&mut self) -> &CandidatePairs {
        std::mem::swap(&mut self.candidates, &mut self.found_candidates);
        &self.candidates
    }

    /// Takes over what the detector has found at rest.
    pub(crate) fn show_intersections(&mut self) -> &[IntersectionRow] {
        self.intersections.clear();
        self.intersections
            .extend(self.found_at_rest.iter().map(IntersectionRow::from));
        &self.intersections
    }
}
