//! The rows in which C reads the results of a detector.

use crate::input::{OutList, Plain, unknown};
use crate::status::Failure;
use selvedge::core::narrowing::rounded_down;
use selvedge::{Contact, ContactGeometry, Geometry, Intersection, PairKind, Scalar, Topology, Truncation};

/// The primitives of a pair.
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

/// The bounding boxes that generate candidates.
#[repr(u32)]
#[derive(Clone, Copy)]
pub enum Boxes {
    /// The boxes at the start and at the end of the step. Two primitives are apart if an axis orders both pairs of boxes alike.
    /// This gives fewer pairs in less time.
    Moving = 0,
    /// The boxes that primitives sweep; they overlap. Other libraries call these pairs candidates.
    Swept = 1,
}

/// The numbers of a vertex and a face, of two edges, or of two vertices (the ends of an edge).
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PairRow {
    /// The vertex, or the first edge.
    pub first: u32,
    /// The face, or the second edge.
    pub second: u32,
}

impl From<[u32; 2]> for PairRow {
    fn from([first, second]: [u32; 2]) -> Self {
        Self { first, second }
    }
}

impl OutList<PairRow> {
    pub(crate) fn set_pairs(self, pairs: &[[u32; 2]]) {
        // Two numbers have the same layout as fields and as an array.
        self.set_parts(pairs.as_ptr().cast(), pairs.len());
    }
}

/// A pair that may touch during the step.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactRow {
    /// The time in [0, 1] of the step, not after the exact time. A detector for float gives a float, widened without rounding.
    pub time: f64,
    /// A selvedge_kind.
    pub kind: u32,
    /// The vertex and the face, or the two edges. Faces have the numbers of the triangles, edges those of
    /// selvedge_detector_edges.
    pub pair: PairRow,
    /// The vertex and the face's three, or the ends of the first edge and of the second.
    pub vertices: [u32; 4],
}

impl Plain for ContactRow {}

impl ContactRow {
    pub(crate) fn new<S: Scalar>(contact: &Contact<S>, topology: &Topology) -> Self {
        Self {
            time: contact.time.to_f64(),
            kind: Kind::from(contact.kind) as u32,
            pair: contact.pair.into(),
            vertices: topology.vertices_of(contact.kind, contact.pair),
        }
    }

    pub(crate) fn kind(&self) -> Result<PairKind, Failure> {
        match self.kind {
            number if number == Kind::VertexFace as u32 => Ok(PairKind::VertexFace),
            number if number == Kind::EdgeEdge as u32 => Ok(PairKind::EdgeEdge),
            number => Err(unknown("selvedge_kind", number)),
        }
    }

    /// Converts the row. The detector checks that the mesh has such a pair and that the time is valid.
    pub(crate) fn contact<S: Scalar>(&self) -> Result<Contact<S>, Failure> {
        Ok(Contact {
            kind: self.kind()?,
            pair: [self.pair.first, self.pair.second],
            time: rounded_down(self.time),
        })
    }
}

/// The geometry of two primitives at the time of a contact, or at rest. Lengths are in the unit of the positions. All values are
/// computed in double, for float as well.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GeometryRow {
    /// A selvedge_kind.
    pub kind: u32,
    /// The vertex and the face, or the two edges.
    pub pair: PairRow,
    /// The vertex and the face's three, or the ends of the first edge and of the second.
    pub vertices: [u32; 4],
    /// True if there is a normal. There is none if the two cannot be shown to have been apart: they touch at the start of the
    /// step or earlier in it; or, at rest, they touch.
    pub has_normal: bool,
    /// Barycentric weights of the four vertices, in [0, 1]. The weights of each side add up to one.
    pub weights: [f64; 4],
    /// The closest points of the first and of the second side; they have these weights.
    pub points: [[f64; 3]; 2],
    /// The direction from the second side to the first, of length one; zeros if there is no normal.
    pub normal: [f64; 3],
    /// A time at which the sides were certainly apart along the normal: that of the contact, or slightly earlier; 0 without a
    /// normal.
    pub separated_at: f64,
    /// A lower and an upper bound of the distance of the two sides at that time.
    pub distance: [f64; 2],
    /// The speed at which the first point moves away from the second along the normal, in lengths per step. It is negative if
    /// they approach each other, and zero without a normal.
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

/// The counts of a step that was truncated vertex by vertex.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TruncationRow {
    /// The number of vertices that do not go their whole way.
    pub held_back: usize,
    /// The number of pairs in contact at the start. Their vertices rest. If it is 0, the step is certainly free of contact.
    pub in_contact: usize,
    /// The number of searches for contacts.
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

/// The primitives that intersect.
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

/// Two primitives of a mesh at rest that share a point, but no vertex.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct IntersectionRow {
    /// A selvedge_intersection_kind.
    pub kind: u32,
    /// The edge and the face, the vertex and the face, or the two edges.
    pub pair: PairRow,
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

#[derive(Default)]
pub(crate) struct CandidatePairs {
    pub(crate) vertex_face: Vec<[u32; 2]>,
    pub(crate) edge_edge: Vec<[u32; 2]>,
}

/// The lists to which C holds pointers.
#[derive(Default)]
pub(crate) struct DetectorAnswers {
    pub(crate) contacts: Vec<ContactRow>,
    pub(crate) candidates: CandidatePairs,
    /// New candidates, kept apart so that a cancelled search keeps the list that C reads.
    pub(crate) found_candidates: CandidatePairs,
    pub(crate) found_at_rest: Vec<Intersection>,
    pub(crate) intersections: Vec<IntersectionRow>,
    /// The geometries of contacts or near pairs, before C sees them.
    pub(crate) found_geometries: Vec<ContactGeometry>,
    pub(crate) contact_geometries: Vec<GeometryRow>,
    pub(crate) near: Vec<GeometryRow>,
}

impl DetectorAnswers {
    pub(crate) fn show_contacts<S: Scalar>(&mut self, contacts: &[Contact<S>], topology: &Topology) -> &[ContactRow] {
        self.contacts.clear();
        let rows = contacts.iter().map(|contact| ContactRow::new(contact, topology));
        self.contacts.extend(rows);
        &self.contacts
    }

    pub(crate) fn show_candidates(&mut self) -> &CandidatePairs {
        std::mem::swap(&mut self.candidates, &mut self.found_candidates);
        &self.candidates
    }

    pub(crate) fn show_contact_geometries(&mut self) -> &[GeometryRow] {
        show_geometries(&self.found_geometries, &mut self.contact_geometries)
    }

    pub(crate) fn show_near(&mut self) -> &[GeometryRow] {
        show_geometries(&self.found_geometries, &mut self.near)
    }

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
