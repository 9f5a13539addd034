//! Reports where surfaces pass through each other, in meshes at rest and in scenes at their start. Writes a list, and a mesh with
//! the place in red.

use super::number::{counted, grouped, three_figures, time};
use super::tables;
use ::csv::Writer;
use selvedge::glam::DVec3;
use selvedge::{Intersection, Topology};
use selvedge_cloth::{Crossing, Simulation, Tangled, Untangled};
use selvedge_files::mesh::{Findings, MeshNotes};
use serde_json::{Value, json};
use std::collections::HashSet;
use std::io::{self, Write};

/// The check of one mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshCheck {
    /// The name of the mesh's file.
    pub name: String,
    /// The number of vertices.
    pub vertices: usize,
    /// The number of triangles, without loose edges and points.
    pub triangles: usize,
    /// True if it is free of intersections: the file was read whole, and its mesh has none.
    pub is_free: bool,
    /// True if the mesh has intersections.
    pub is_tangled: bool,
    /// The intersections with the vertices of both features; `None` if the check ended at the first one.
    pub intersections: Option<Vec<(Intersection, Vec<u32>)>>,
    /// The duration of the check.
    pub seconds: f64,
    /// Further facts about the file and its mesh.
    pub file: FileReport,
}

/// A report about a file that was checked.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FileReport {
    /// The parts that were not read.
    pub notes: MeshNotes,
    /// Properties of the mesh that hinder a simulation.
    pub findings: Findings,
}

/// The names of the kinds of intersections, as in lists.
const KINDS: [&str; 3] = ["edge-face", "vertex-face", "edge-edge"];

fn kind(intersection: &Intersection) -> usize {
    match intersection {
        Intersection::EdgeFace { .. } => 0,
        Intersection::VertexFace { .. } => 1,
        Intersection::EdgeEdge { .. } => 2,
    }
}

impl MeshCheck {
    /// Makes a check with these intersections, all of the mesh's.
    pub fn from_intersections(name: String, topology: &Topology, intersections: &[Intersection], seconds: f64) -> Self {
        let with_corners = |found: &Intersection| (*found, corners(topology, found));
        Self {
            intersections: Some(intersections.iter().map(with_corners).collect()),
            ..Self::from_verdict(name, topology, intersections.is_empty(), seconds)
        }
    }

    /// Makes a check that shows only whether the mesh is free of intersections.
    pub fn from_verdict(name: String, topology: &Topology, is_free: bool, seconds: f64) -> Self {
        // The topology counts loose edges and points as faces, after the triangles.
        let statistics = topology.statistics();
        let loose = statistics.loose_edges + statistics.points;
        Self {
            name,
            vertices: topology.vertex_count(),
            triangles: topology.triangles().len() - loose,
            is_free,
            is_tangled: !is_free,
            intersections: None,
            seconds,
            file: FileReport::default(),
        }
    }

    /// Adds the facts about the file. A mesh is not free if something with an area was not read.
    pub fn with_file(self, file: FileReport) -> Self {
        Self {
            is_free: self.is_free && file.notes.is_complete(),
            file,
            ..self
        }
    }

    /// Returns whether the mesh has no intersection as far as its file was read, which is not all of it.
    pub fn is_undecided(&self) -> bool {
        !self.is_free && !self.is_tangled
    }

    /// Returns the number of each kind, in the order of `KINDS`.
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

/// Returns a table with a row for each mesh, and the verdict on all of them.
pub fn mesh_checks(checks: &[MeshCheck]) -> String {
    let rows = checks.iter().map(|check| {
        let unknown = if check.is_tangled { "?" } else { "0" };
        let [edge_face, vertex_face, edge_edge] = check.counts().map(|count| count.map_or_else(|| unknown.to_owned(), grouped));
        [
            check.name.clone(),
            grouped(check.triangles),
            edge_face,
            vertex_face,
            edge_edge,
            time(check.seconds),
        ]
    });
    let header = ["mesh", "triangles", KINDS[0], KINDS[1], KINDS[2], "time"];
    let undecided = checks.iter().filter(|check| check.is_undecided()).count();
    let tangled = checks.iter().filter(|check| check.is_tangled).count();
    let verdict = match (tangled, undecided, checks.len()) {
        (0, 0, 1) => "free of intersections".to_owned(),
        (0, 0, all) => format!("all {all} meshes are free of intersections"),
        (1, _, 1) => "intersects itself".to_owned(),
        (0, _, 1) => "no intersections in what was read, but not all of it was read".to_owned(),
        (0, undecided, all) => {
            format!("no intersections in what was read, but {undecided} of {all} meshes were not read whole")
        }
        (tangled, 0, all) => format!("{tangled} of {all} meshes intersect themselves"),
        (tangled, undecided, all) => {
            format!("{tangled} of {all} meshes intersect themselves, {undecided} were not read whole")
        }
    };
    let reports: String = checks.iter().flat_map(report_lines).map(|line| line + "\n").collect();
    format!("{}\n{reports}{verdict}\n", tables::table(header, rows))
}

/// Writes facts about a mesh besides its intersections, one line each.
fn report_lines(check: &MeshCheck) -> impl Iterator<Item = String> {
    let FileReport { notes, findings } = &check.file;
    let missing = notes
        .missing()
        .map(|missing| format!("{}: not all of it was read: {missing}", check.name));
    let overlapping = notes.overlapping_polygons.first().map(|face| {
        let count = notes.overlapping_polygons.len();
        let faces = if count == 1 {
            "1 face has".to_owned()
        } else {
            format!("{} faces have", grouped(count))
        };
        format!(
            "{}: {faces} no triangulation without overlap (the first is face {face})",
            check.name
        )
    });
    let findings = Some(findings.to_string()).filter(|findings| !findings.is_empty());
    let findings = findings.map(|findings| format!("{}: {findings}", check.name));
    [missing, overlapping, findings].into_iter().flatten()
}

/// Returns the report about one file as part of a document. Lists hold the first ten.
fn file_json(file: &FileReport) -> Value {
    let FileReport { notes, findings } = file;
    let left_out = notes.left_out.iter();
    let left_out: Vec<Value> = left_out
        .map(|part| json!({ "what": part.to_string(), "count": part.count, "line": part.line, "may_have_area": part.may_have_area }))
        .collect();
    fn listed<T: Clone + Into<Value>>(list: &[T]) -> Value {
        let first: Vec<Value> = list.iter().take(10).cloned().map(Into::into).collect();
        json!({ "count": list.len(), "first": first })
    }
    json!({
        "left_out": left_out,
        "polygons": notes.polygons_triangulated,
        "overlapping_polygons": listed(&notes.overlapping_polygons),
        "welded_vertices": notes.welded_vertices,
        "collapsed_triangles": notes.collapsed_triangles,
        "coincident_vertices": listed(&findings.coincident_vertices),
        "duplicate_triangles": findings.duplicate_triangles,
        "flat_triangles": listed(&findings.flat_triangles),
        "thin_triangles": listed(&findings.thin_triangles),
        "unused_vertices": findings.unused_vertices,
        "non_manifold_edges": findings.non_manifold_edges,
        "inconsistent_edges": listed(&findings.inconsistent_edges),
        "size": findings.size.to_array(),
    })
}

/// Returns the document of `selvedge check --json`. Counts are null if the check ended at the first intersection.
pub fn mesh_checks_json(checks: &[MeshCheck]) -> Value {
    let meshes = checks.iter().map(|check| {
        let [edge_face, vertex_face, edge_edge] = check.counts();
        json!({
            "mesh": check.name,
            "vertices": check.vertices,
            "triangles": check.triangles,
            "edge_face": edge_face,
            "vertex_face": vertex_face,
            "edge_edge": edge_edge,
            "is_free": check.is_free,
            "is_complete": check.file.notes.is_complete(),
            "seconds": check.seconds,
            "file": file_json(&check.file),
        })
    });
    json!({
        "meshes": meshes.collect::<Vec<_>>(),
        "are_free": checks.iter().all(|check| check.is_free),
    })
}

/// Writes every intersection as `mesh,kind,i0,i1,i2,i3,i4`: the vertices of the edge, then of the face. For a vertex and a face,
/// or two edges, i4 is empty. Vertices count from 0 as in the mesh's file.
///
/// # Errors
/// Returns the errors of `out`.
pub fn intersections_csv(checks: &[MeshCheck], out: impl Write) -> io::Result<()> {
    let mut writer = Writer::from_writer(out);
    writer.write_record(["mesh", "kind", "i0", "i1", "i2", "i3", "i4"])?;
    for check in checks {
        for (intersection, corners) in check.intersections.iter().flatten() {
            let corner = |k: usize| corners.get(k).map_or_else(String::new, u32::to_string);
            let kind = KINDS[kind(intersection)].to_owned();
            let record = [check.name.clone(), kind].into_iter().chain((0..5).map(corner));
            writer.write_record(record)?;
        }
    }
    writer.flush()
}

/// Returns every intersection of every mesh as one document.
pub fn intersections_json(checks: &[MeshCheck]) -> Value {
    let of_mesh = |check: &MeshCheck| {
        let list = check.intersections.iter().flatten();
        let list = list.map(|(own, corners)| json!({ "kind": KINDS[kind(own)], "vertices": corners }));
        json!({ "mesh": check.name, "intersections": list.collect::<Vec<_>>() })
    };
    json!({ "meshes": checks.iter().map(of_mesh).collect::<Vec<_>>() })
}

const RED: [u8; 3] = [214, 39, 40];
const GREY: [u8; 3] = [200, 200, 200];

/// Writes a mesh as binary PLY, with `red` triangles and their vertices in red.
///
/// # Errors
/// Returns the errors of `out`.
pub fn coloured_ply(positions: &[DVec3], triangles: &[[u32; 3]], red: &[bool], mut out: impl Write) -> io::Result<()> {
    let mut vertices = vec![GREY; positions.len()];
    for (corners, _) in triangles.iter().zip(red).filter(|(_, is_red)| **is_red) {
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
    for (corners, is_red) in triangles.iter().zip(red) {
        out.write_all(&[3])?;
        for vertex in corners {
            out.write_all(&vertex.to_le_bytes())?;
        }
        out.write_all(if *is_red { &RED } else { &GREY })?;
    }
    Ok(())
}

/// Returns for each triangle whether it, an edge or a vertex of it meets something.
pub fn intersecting_triangles(topology: &Topology, intersections: &[Intersection]) -> Vec<bool> {
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
    for (is_red, (corners, own)) in faces.iter_mut().zip(triangles) {
        *is_red |= own.iter().any(|&edge| edge != Topology::NO_EDGE && edges[edge as usize]);
        *is_red |= corners.iter().any(|&vertex| vertices[vertex as usize]);
    }
    faces
}

/// Returns for each triangle of a scene's mesh whether an edge of it passes through a face at the start, or an edge through it.
pub fn crossing_triangles(tangled: &Tangled) -> Vec<bool> {
    let sorted = |mut face: [u32; 3]| {
        face.sort_unstable();
        face
    };
    let faces: HashSet<[u32; 3]> = tangled.crossings.iter().map(|crossing| sorted(crossing.face)).collect();
    let edges: HashSet<[u32; 2]> = { tangled.crossings.iter() }
        .map(|crossing| [crossing.edge[0].min(crossing.edge[1]), crossing.edge[0].max(crossing.edge[1])])
        .collect();
    let meets = |&triangle: &[u32; 3]| {
        let [a, b, c] = sorted(triangle);
        faces.contains(&[a, b, c]) || [[a, b], [a, c], [b, c]].iter().any(|edge| edges.contains(edge))
    };
    tangled.mesh.triangles.iter().map(meets).collect()
}

/// Returns the document of `selvedge simulate --json` for a scene that starts tangled. Vertices have their
/// [numbers in files](Tangled::numbers_in_files).
pub fn tangled_start_json(scene: &str, tangled: &Tangled) -> Value {
    let crossing = |crossing: Crossing| {
        json!({
            "edge": crossing.edge,
            "face": crossing.face,
            "point": crossing.point.to_array(),
            "body": crossing.body.and_then(|body| tangled.body_names.get(body)),
        })
    };
    json!({
        "scene": scene,
        "tangled_start": {
            "message": tangled.to_string(),
            "crossings": tangled.crossings_in_files().map(crossing).collect::<Vec<_>>(),
            "untangled": tangled.untangled.as_ref().map(untangled_json),
        },
    })
}

/// Returns the result of untangling. Lengths are in metres, stretch is relative to lengths in the scene.
pub(super) fn untangled_json(untangled: &Untangled) -> Value {
    json!({
        "crossings": untangled.crossings,
        "left": untangled.left,
        "steps": untangled.steps,
        "end": untangled.end.to_string(),
        "edge_stretch": {"percentile_99": untangled.stretch.percentile_99, "largest": untangled.stretch.largest},
        "farthest": untangled.farthest,
        "seconds": untangled.seconds,
    })
}

/// Writes sentences about a tangled start: how it was untangled, and which tangles remain. There are none if the start was free.
pub fn start_sentences(simulation: &Simulation) -> Vec<String> {
    let left = simulation.crossings().len();
    let left = (left > 0).then(|| format!("Edges still pass through faces at {}.", counted(left as u64, "place")));
    simulation
        .untangled()
        .map(untangled_sentence)
        .into_iter()
        .chain(left)
        .collect()
}

fn untangled_sentence(untangled: &Untangled) -> String {
    format!(
        "Untangled before the first step: edges met faces at {}, and were pulled apart in {} and {}, by {} mm at most; 99 % of the edges are \
         then at most {:.3} times as long as in the scene, the longest {:.3}.",
        counted(untangled.crossings as u64, "place"),
        counted(u64::from(untangled.steps), "step"),
        time(untangled.seconds),
        three_figures(1e3 * untangled.farthest),
        untangled.stretch.percentile_99,
        untangled.stretch.largest,
    )
}
