//! Converts results to arrays. Columns are built without the interpreter lock and passed to numpy without a copy.

use numpy::{Element, IntoPyArray, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{IntoPyDict, PyDict, PyModule};
use selvedge::{Contact, ContactGeometry, Intersection, PairKind, Scalar, Topology};
use selvedge_cloth::effects::Release;
use selvedge_cloth::{ContactCounts, ContactSeconds, Crossing, EdgeStretch, ProximityPair, TornEdge, Untangled};

/// Returns a class of `selvedge/_answers.py`.
pub(crate) fn class<'py>(py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
    static MODULE: PyOnceLock<Py<PyModule>> = PyOnceLock::new();
    let module = MODULE.get_or_try_init(py, || py.import("selvedge._answers").map(Bound::unbind))?;
    module.bind(py).getattr(name)
}

/// Returns the number of `selvedge.Kind`.
const fn number(kind: PairKind) -> u8 {
    match kind {
        PairKind::VertexFace => 0,
        PairKind::EdgeEdge => 1,
    }
}

pub(crate) fn kind_of(number: u8) -> Option<PairKind> {
    PairKind::ALL.into_iter().find(|&kind| self::number(kind) == number)
}

/// Makes an array of one dimension.
pub(crate) fn column<'py, T: Element>(py: Python<'py>, values: Vec<T>) -> Bound<'py, PyAny> {
    values.into_pyarray(py).into_any()
}

/// Makes an array of shape (n, N).
pub(crate) fn rows<'py, T: Element, const N: usize>(py: Python<'py>, values: Vec<[T; N]>) -> PyResult<Bound<'py, PyAny>> {
    let count = values.len();
    Ok(values.into_flattened().into_pyarray(py).reshape([count, N])?.into_any())
}

/// The columns of contacts, with their geometry on request.
pub(crate) struct Columns<S> {
    kind: Vec<u8>,
    pair: Vec<[u32; 2]>,
    time: Vec<S>,
    vertices: Vec<[u32; 4]>,
    geometry: Option<GeometryColumns>,
}

struct GeometryColumns {
    points: Vec<[[f64; 3]; 2]>,
    weights: Vec<[f64; 4]>,
    normals: Vec<[f64; 3]>,
    distances: Vec<[f64; 2]>,
    speeds: Vec<f64>,
    separated_at: Vec<f64>,
}

impl<S: Scalar + Element> Columns<S> {
    pub(crate) fn of(contacts: &[Contact<S>], topology: &Topology, geometries: Option<&[ContactGeometry]>) -> Self {
        let vertices = |contact: &Contact<S>| topology.vertices_of(contact.kind, contact.pair);
        Self {
            kind: contacts.iter().map(|contact| number(contact.kind)).collect(),
            pair: contacts.iter().map(|contact| contact.pair).collect(),
            time: contacts.iter().map(|contact| contact.time).collect(),
            vertices: contacts.iter().map(vertices).collect(),
            geometry: geometries.map(GeometryColumns::of),
        }
    }

    /// Makes the columns of near pairs of a mesh at rest.
    pub(crate) fn at_rest(near: &[ContactGeometry]) -> Self {
        Self {
            kind: near.iter().map(|pair| number(pair.kind)).collect(),
            pair: near.iter().map(|pair| pair.pair).collect(),
            time: vec![S::ZERO; near.len()],
            vertices: near.iter().map(|pair| pair.vertices).collect(),
            geometry: Some(GeometryColumns::of(near)),
        }
    }

    pub(crate) fn show<'py>(self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let count = self.kind.len();
        let (kind, pair) = (column(py, self.kind), rows(py, self.pair)?);
        let (time, vertices) = (column(py, self.time), rows(py, self.vertices)?);
        let Some(geometry) = self.geometry else {
            return class(py, "ContactTimes")?.call1((kind, pair, time, vertices));
        };
        let points = geometry.points.into_flattened().into_flattened();
        let points = points.into_pyarray(py).reshape([count, 2, 3])?;
        class(py, "Contacts")?.call1((
            kind,
            pair,
            time,
            vertices,
            points,
            rows(py, geometry.weights)?,
            rows(py, geometry.normals)?,
            rows(py, geometry.distances)?,
            column(py, geometry.speeds),
            column(py, geometry.separated_at),
        ))
    }
}

impl GeometryColumns {
    fn of(geometries: &[ContactGeometry]) -> Self {
        let all = || geometries.iter().map(|found| &found.geometry);
        Self {
            points: all().map(|found| found.points.map(|point| point.to_array())).collect(),
            weights: all().map(|found| found.weights).collect(),
            normals: all()
                .map(|found| found.normal.map_or([f64::NAN; 3], |normal| normal.to_array()))
                .collect(),
            distances: all().map(|found| found.distance).collect(),
            speeds: all().map(|found| found.speed).collect(),
            separated_at: all().map(|found| found.separated_at).collect(),
        }
    }
}

pub(crate) fn show_contact<'py, S: Scalar>(
    py: Python<'py>,
    contact: &Contact<S>,
    topology: &Topology,
) -> PyResult<Bound<'py, PyAny>> {
    let kind = class(py, "Kind")?.call1((number(contact.kind),))?;
    let [a, b] = contact.pair;
    let [p, q, r, s] = topology.vertices_of(contact.kind, contact.pair);
    class(py, "Contact")?.call1((kind, (a, b), contact.time.to_f64(), (p, q, r, s)))
}

/// Converts the intersections of a mesh, with their pairs of faces and their points.
pub(crate) fn show_intersections<'py>(
    py: Python<'py>,
    found: &[Intersection],
    face_pairs: Vec<[u32; 2]>,
    points: Vec<[f64; 3]>,
) -> PyResult<Bound<'py, PyAny>> {
    let (kinds, pairs): (Vec<u8>, Vec<[u32; 2]>) = found
        .iter()
        .map(|intersection| match *intersection {
            Intersection::EdgeFace { edge, face } => (0, [edge, face]),
            Intersection::VertexFace { vertex, face } => (1, [vertex, face]),
            Intersection::EdgeEdge { edges } => (2, edges),
        })
        .unzip();
    class(py, "Intersections")?.call1((column(py, kinds), rows(py, pairs)?, rows(py, face_pairs)?, rows(py, points)?))
}

/// Converts the near pairs of a simulation.
pub(crate) fn show_near_pairs<'py>(py: Python<'py>, pairs: &[ProximityPair]) -> PyResult<Bound<'py, PyAny>> {
    class(py, "NearPairs")?.call1((
        rows(py, pairs.iter().map(|pair| pair.vertices).collect())?,
        rows(py, pairs.iter().map(|pair| pair.weights).collect())?,
        rows(py, pairs.iter().map(|pair| pair.normal.to_array()).collect())?,
        column(py, pairs.iter().map(|pair| pair.thickness).collect()),
    ))
}

/// Converts the crossings of a tangled state.
pub(crate) fn show_crossings<'py>(py: Python<'py>, crossings: &[Crossing]) -> PyResult<Bound<'py, PyAny>> {
    let body = |crossing: &Crossing| crossing.body.map_or(-1, |body| body as i64);
    class(py, "Crossings")?.call1((
        rows(py, crossings.iter().map(|crossing| crossing.edge).collect())?,
        rows(py, crossings.iter().map(|crossing| crossing.face).collect())?,
        rows(py, crossings.iter().map(|crossing| crossing.point.to_array()).collect())?,
        column(py, crossings.iter().map(body).collect()),
    ))
}

/// Converts the result of untangling; None without one.
pub(crate) fn show_untangled<'py>(py: Python<'py>, untangled: Option<&Untangled>) -> PyResult<Option<Bound<'py, PyAny>>> {
    let Some(&untangled) = untangled else {
        return Ok(None);
    };
    let Untangled {
        crossings,
        left,
        steps,
        stretch: EdgeStretch { percentile_99, largest },
        farthest,
        seconds,
        ..
    } = untangled;
    let stretch = (percentile_99, largest);
    class(py, "Untangled")?
        .call1((crossings, left, steps, stretch, farthest, seconds))
        .map(Some)
}

/// Converts the torn edges of cloth.
pub(crate) fn show_torn_edges<'py>(py: Python<'py>, torn: &[TornEdge]) -> PyResult<Vec<Bound<'py, PyAny>>> {
    let class = class(py, "TornEdge")?;
    let show = |edge: &TornEdge| class.call1((edge.cloth, (edge.vertices[0], edge.vertices[1]), edge.time, edge.load));
    torn.iter().map(show).collect()
}

/// Converts the vertices that attachments have released.
pub(crate) fn show_released<'py>(py: Python<'py>, released: &[Release]) -> PyResult<Vec<Bound<'py, PyAny>>> {
    let class = class(py, "Release")?;
    let show = |release: &Release| class.call1((release.group, release.vertex, release.time));
    released.iter().map(show).collect()
}

/// Converts the counts of contact; None without one.
pub(crate) fn show_contact_counts<'py>(py: Python<'py>, counts: Option<&ContactCounts>) -> PyResult<Option<Bound<'py, PyDict>>> {
    let Some(&counts) = counts else {
        return Ok(None);
    };
    let ContactCounts {
        candidates,
        looked_at,
        pushed,
        violated,
        zone_rounds,
        held,
        cuts,
    } = counts;
    let named = [
        ("candidates", candidates),
        ("looked_at", looked_at),
        ("pushed", pushed),
        ("violated", violated),
        ("zone_rounds", zone_rounds),
        ("held", held),
        ("cuts", cuts),
    ];
    named.into_py_dict(py).map(Some)
}

/// Converts the times of contact; None without one.
pub(crate) fn show_contact_seconds<'py>(
    py: Python<'py>,
    seconds: Option<&ContactSeconds>,
) -> PyResult<Option<Bound<'py, PyDict>>> {
    let Some(&seconds) = seconds else {
        return Ok(None);
    };
    let ContactSeconds {
        candidates,
        constraints,
        certificates,
        repairs,
    } = seconds;
    let named = [
        ("candidates", candidates),
        ("constraints", constraints),
        ("certificates", certificates),
        ("repairs", repairs),
    ];
    named.into_py_dict(py).map(Some)
}
