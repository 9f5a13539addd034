//! What a detector has found, as C sees it.

use crate::detector::Finder;
use crate::input::unknown;
use crate::status::Failure;
use selvedge::core::narrowing::rounded_down;
use selvedge::{Contact, ContactGeometry, Geometry, Intersection, PairKind, Scalar, Topology, Truncation};

/// Which primitives a pair is made of.
#[repr(u32)]
#[derive(Clone, Copy)]
pub enum Kind {
    /// A vertex and a face.
    VertexFace = 0,
    /// Two edges.
    EdgeEdge = 1,
}

impl From<PairKind> for Kind {
    fn from(kind: PairKind) -> Self {
        match kind {
            PairKind::VertexFace => Self::VertexFace,
            PairKind::EdgeEdge => Self::EdgeEdge,
        }
    }
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

/// A vertex and a face, two edges, or two vertices, as those of an edge, by their numbers.
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
        Self {
            time: contact.time.to_f64(),
            kind: Kind::from(contact.kind) as u32,
            pair: contact.pair.into(),
            vertices: topology.vertices_of(contact.kind, contact.pair),
        }
    }

    /// What primitives they are.
    pub(crate) fn kind(&self) -> Result<PairKind, Failure> {
        match self.kind {
            number if number == Kind::VertexFace as u32 => Ok(PairKind::VertexFace),
            number if number == Kind::EdgeEdge as u32 => Ok(PairKind::EdgeEdge),
            number => Err(unknown("selvedge_kind", number)),
        }
    }

    /// As the detector knows it, which looks whether the mesh has such a pair, and the step such a time.
    pub(crate) fn contact<S: Scalar>(&self) -> Result<Contact<S>, Failure> {
        Ok(Contact {
            kind: self.kind()?,
            pair: [self.pair.first, self.pair.second],
            time: rounded_down(self.time),
        })
    }
}

/// Two primitives and how they lie to each other at some time: at that of a contact, or at rest. Lengths are in the unit of the
/// positions; all is computed in double, for float too.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GeometryRow {
    /// A selvedge_kind.
    pub kind: u32,
    /// The vertex and the face, or the two edges.
    pub pair: Pair,
    /// The vertex and the face's three, or the ends of the first edge and of the second.
    pub vertices: [u32; 4],
    /// Whether there is a normal. There is none where the two cannot be shown to have been apart: where they touch when the step
    /// begins, or have done so before; at rest, where they touch.
    pub has_normal: bool,
    /// Of the four vertices, in [0, 1]: barycentric. Those of each side add up to one.
    pub weights: [f64; 4],
    /// The points of the first and of the second side that have these weights: the closest.
    pub points: [[f64; 3]; 2],
    /// From the second side to the first, of length one; zeros if there is none.
    pub normal: [f64; 3],
    /// When the sides were certainly apart along the normal: at the time of contact, or a little before. 0 without a normal.
    pub separated_at: f64,
    /// The distance of the two sides at that time is certainly not less than the first, not more than the second.
    pub distance: [f64; 2],
    /// How fast the first point moves away from the second along the normal, in lengths a step: less than zero if they come
    /// nearer, zero without a normal.
    pub speed: f64,
}

impl From<&ContactGeometry> for GeometryRow {
    fn from(found: &ContactGeometry) -> Self {
        Self::new(found.kind, found.pair, found.vertices, &found.geometry)
    }
}

impl GeometryRow {
    pub(crate) fn new(kind: PairKind, pair: [u32; 2], vertices: [u32; 4], geometry: &Geometry) -> Self {
        Self {
            kind: Kind::from(kind) as u32,
            pair: pair.into(),
            vertices,
            has_normal: geometry.normal.is_some(),
            weights: geometry.weights,
            points: geometry.points.map(Into::into),
            normal: geometry.normal.map_or([0.0; 3], Into::into),
            separated_at: geometry.separated_at,
            distance: geometry.distance,
            speed: geometry.speed,
        }
    }
}

/// What came of a step of which each vertex goes as far as it may.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TruncationRow {
    /// Vertices that go less than the whole of their way.
    pub held_back: usize,
    /// Pairs that are in contact at the start already. Their vertices rest. Where there are none, the step is certainly free of
    /// contact.
    pub in_contact: usize,
    /// How often contacts were looked for.
    pub rounds: usize,
}

impl From<Truncation> for TruncationRow {
    fn from(truncation: Truncation) -> Self {
        Self {
            held_back: truncation.held_back,
            in_contact: truncation.in_contact,
            rounds: truncation.rounds,
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
    /// Of contacts or of what is near, before it is shown.
    pub(crate) found_geometries: Vec<ContactGeometry>,
    pub(crate) contact_geometries: Vec<GeometryRow>,
    pub(crate) near: Vec<GeometryRow>,
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

    /// Takes over the geometries that the detector has found, of contacts.
    pub(crate) fn show_contact_geometries(&mut self) -> &[GeometryRow] {
        show_geometries(&self.found_geometries, &mut self.contact_geometries)
    }

    /// Takes over the geometries that the detector has found, of what is near.
    pub(crate) fn show_near(&mut self) -> &[GeometryRow] {
        show_geometries(&self.found_geometries, &mut self.near)
    }

    /// Takes over what the detector has found at rest.
    pub(crate) fn show_intersections(&mut self) -> &[IntersectionRow] {
        self.intersections.clear();
        self.intersections
            .extend(self.found_at_rest.iter().map(IntersectionRow::from));
        &self.intersections
    }
}

fn show_geometries<'a>(found: &[ContactGeometry], shown: &'a mut Vec<GeometryRow>) -> &'a [GeometryRow] {
    shown.clear();
    shown.extend(found.iter().map(GeometryRow::from));
    shown
}
