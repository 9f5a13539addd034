//! Where meshes at rest pass through themselves: a list, and a mesh with the place in red.

use super::{number, tables};
use ::csv::Writer;
use selvedge::glam::DVec3;
use selvedge::{Intersection, Topology};
use serde_json::{Value, json};
use std::io::{self, Write};

/// What was found in one mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Tangle {
    /// What the mesh is called: its file.
    pub name: String,
    /// Its vertices.
    pub vertices: usize,
    /// Its triangles; loose edges and points are none.
    pub triangles: usize,
    /// Whether it is free of intersections.
    pub is_free: bool,
    /// What meets, and the vertices of both; `None` if nobody asked.
    pub intersections: Option<Vec<(Intersection, Vec<u32>)>>,
    /// How long it took to look.
    pub seconds: f64,
}

/// As other programs name them.
const KINDS: [&str; 3] = ["edge-face", "vertex-face", "edge-edge"];

fn kind(intersection: &Intersection) -> usize {
    match intersection {
        Intersection::EdgeFace { .. } => 0,
        Intersection::VertexFace { .. } => 1,
        Intersection::EdgeEdge { .. } => 2,
    }
}

impl Tangle {
    /// Of a mesh of that name, of which all was asked.
    #[must_use]
    pub fn new(name: String, topology: &Topology, intersections: &[Intersection], seconds: f64) -> Self {
        let with_corners = |own: &Intersection| (*own, corners(topology, own));
        Self {
            intersections: Some(intersections.iter().map(with_corners).collect()),
            ..Self::of_any(name, topology, !intersections.is_empty(), seconds)
        }
    }

    /// Of a mesh of that name, of which it is known alone whether there is any.
    #[must_use]
    pub fn of_any(name: String, topology: &Topology, is_tangled: bool, seconds: f64) -> Self {
        // These are faces as well, after the triangles.
        let statistics = topology.statistics();
        let loose = statistics.loose_edges + statistics.points;
        Self {
            name,
            vertices: topology.vertex_count(),
            triangles: topology.triangles().len() - loose,
            is_free: !is_tangled,
            intersections: None,
            seconds,
        }
    }

    /// How many of each kind, in the order of `KINDS`.
    fn counts(&self) -> [Option<usize>; 3] {
        let list = self.intersections.as_ref();
        let count = |wanted| list.map(|list| list.iter().filter(|(own, _)| kind(own) == wanted).count());
        [0, 1, 2].map(count)
    }
}

fn corners(topology: &Topology, intersection: &Intersection) -> Vec<u32> {
    let edge = |edge: u32| topology.edges()[edge as usize];
    let face = |face: u32| topology.triangles()[face as usize];
    match *intersection {
        Intersection::EdgeFace {
            edge: first,
            face: second,
        } => [&edge(first)[..], &face(second)].concat(),
        Intersection::VertexFace { vertex, face: second } => [&[vertex][..], &face(second)].concat(),
        Intersection::EdgeEdge { edges } => edges.map(edge).concat(),
    }
}

/// A mesh a line, and how many have intersections.
#[must_use]
pub fn tangles(found: &[Tangle]) -> String {
    let rows = found.iter().map(|tangle| {
        let [edge_face, vertex_face, edge_edge] = match tangle.counts() {
            counts if tangle.intersections.is_some() => counts.map(|count| number::grouped(count.unwrap_or(0))),
            _ if tangle.is_free => [(); 3].map(|()| "0".to_owned()),
            _ => [(); 3].map(|()| "?".to_owned()),
        };
        let triangles = number::grouped(tangle.triangles);
        let time = number::time(tangle.seconds);
        [tangle.name.clone(), triangles, edge_face, vertex_face, edge_edge, time]
    });
    let header = ["mesh", "triangles", KINDS[0], KINDS[1], KINDS[2], "time"];
    let tangled = found.iter().filter(|tangle| !tangle.is_free).count();
    let verdict = match (tangled, found.len()) {
        (0, 1) => "free of intersections".to_owned(),
        (0, all) => format!("all {all} meshes are free of intersections"),
        (1, 1) => "intersects itself".to_owned(),
        (tangled, all) => format!("{tangled} of {all} meshes intersect themselves"),
    };
    format!("{}\n{verdict}\n", tables::table(header, rows))
}

/// One document: `selvedge check --json`. Null is what was not asked.
#[must_use]
pub fn tangles_json(found: &[Tangle]) -> Value {
    let meshes = found.iter().map(|tangle| {
        let [edge_face, vertex_face, edge_edge] = tangle.counts();
        json!({
            "mesh": tangle.name,
            "vertices": tangle.vertices,
            "triangles": tangle.triangles,
            "edge_face": edge_face,
            "vertex_face": vertex_face,
            "edge_edge": edge_edge,
            "is_free": tangle.is_free,
            "seconds": tangle.seconds,
        })
    });
    json!({
        "meshes": meshes.collect::<Vec<_>>(),
        "are_free": found.iter().all(|tangle| tangle.is_free),
    })
}

/// Every intersection as `mesh,kind,i0,i1,i2,i3,i4`: the vertices of the edge and then of the face; of the vertex and the face, or of two
/// edges, with i4 empty. They count from 0 as in the mesh's file.
///
/// # Errors
/// Those of `out`.
pub fn intersections_csv(found: &[Tangle], out: impl Write) -> io::Result<()> {
    let mut writer = Writer::from_writer(out);
    writer.write_record(["mesh", "kind", "i0", "i1", "i2", "i3", "i4"])?;
    for tangle in found {
        for (intersection, corners) in tangle.intersections.iter().flatten() {
            let corner = |k: usize| corners.get(k).map_or_else(String::new, u32::to_string);
            let kind = KINDS[kind(intersection)].to_owned();
            let record = [tangle.name.clone(), kind].into_iter().chain((0..5).map(corner));
            writer.write_record(record)?;
        }
    }
    writer.flush()
}

/// The same as one document.
#[must_use]
pub fn intersections_json(found: &[Tangle]) -> Value {
    let of_mesh = |tangle: &Tangle| {
        let list = tangle.intersections.iter().flatten();
        let list = list.map(|(own, corners)| json!({ "kind": KINDS[kind(own)], "vertices": corners }));
        json!({ "mesh": tangle.name, "intersections": list.collect::<Vec<_>>() })
    };
    json!({ "meshes": found.iter().map(of_mesh).collect::<Vec<_>>() })
}

const RED: [u8; 3] = [214, 39, 40];
const GREY: [u8; 3] = [200, 200, 200];

/// The mesh as binary PLY, in red what meets: faces, triangles of edges and vertices that meet something, and the vertices of all these.
///
/// # Errors
/// Those of `out`.
pub fn tangle_ply(
    positions: &[DVec3],
    topology: &Topology,
    intersections: &[Intersection],
    mut out: impl Write,
) -> io::Result<()> {
    let triangles = is_tangled(topology, intersections);
    let mut vertices = vec![GREY; positions.len()];
    for (corners, _) in topology
        .triangles()
        .iter()
        .zip(&triangles)
        .filter(|(_, is_tangled)| **is_tangled)
    {
        corners.iter().for_each(|&vertex| vertices[vertex as usize] = RED);
    }
    let colour = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    write!(
        out,
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\n\
         property double x\nproperty double y\nproperty double z\n{colour}\
         element face {}\nproperty list uchar uint vertex_indices\n{colour}end_header\n",
        vertices.len(),
        triangles.len(),
    )?;
    for (position, colour) in positions.iter().zip(vertices) {
        for coordinate in position.to_array() {
            out.write_all(&coordinate.to_le_bytes())?;
        }
        out.write_all(&colour)?;
    }
    for (corners, is_tangled) in topology.triangles().iter().zip(triangles) {
        out.write_all(&[3])?;
        for vertex in corners {
            out.write_all(&vertex.to_le_bytes())?;
        }
        out.write_all(if is_tangled { &RED } else { &GREY })?;
    }
    Ok(())
}

/// Of each triangle whether it, an edge or a vertex of it meets something.
fn is_tangled(topology: &Topology, intersections: &[Intersection]) -> Vec<bool> {
    let mut edges = vec![false; topology.edges().len()];
    let mut faces = vec![false; topology.triangles().len()];
    let mut vertices = vec![false; topology.vertex_count()];
    for intersection in intersections {
        match *intersection {
            Intersection::EdgeFace { edge, face } => {
                edges[edge as usize] = true;
                faces[face as usize] = true;
            }
            Intersection::VertexFace { vertex, face } => {
                vertices[vertex as usize] = true;
                faces[face as usize] = true;
            }
            Intersection::EdgeEdge { edges: both } => both.iter().for_each(|&edge| edges[edge as usize] = true),
        }
    }
    let triangles = topology.triangles().iter().zip(topology.triangle_edges());
    for (is_tangled, (corners, own)) in faces.iter_mut().zip(triangles) {
        *is_tangled |= own.iter().any(|&edge| edge != Topology::NO_EDGE && edges[edge as usize]);
        *is_tangled |= corners.iter().any(|&vertex| vertices[vertex as usize]);
    }
    faces
}
