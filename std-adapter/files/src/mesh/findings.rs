//! Properties of meshes that hinder a simulation, besides intersections.

use robust::{Coord, orient2d};
use selvedge::{Topology, TopologyStatistics, first_coincident};
use selvedge_core::glam::DVec3;
use std::fmt;

/// Properties of a mesh that often come from its export, and hinder a simulation. Intersections are not among them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Findings {
    /// Used vertices in the same place as an earlier used one, each with that one. An exporter has split the seam; welding merges
    /// them.
    pub coincident_vertices: Vec<[u32; 2]>,
    /// Triangles with the same vertices as an earlier one.
    pub duplicate_triangles: usize,
    /// Triangles whose corners lie exactly on one line, or that name a vertex twice.
    pub flat_triangles: Vec<u32>,
    /// Other triangles whose height is less than [`THIN`] times their longest side.
    pub thin_triangles: Vec<u32>,
    /// The number of vertices that belong to no triangle, loose edge or point.
    pub unused_vertices: usize,
    /// The number of edges with three triangles or more.
    pub non_manifold_edges: usize,
    /// Edges whose two triangles run along them in the same direction, so that one faces the wrong way.
    pub inconsistent_edges: Vec<[u32; 2]>,
    /// The sides of the bounding box, in the file's unit.
    pub size: DVec3,
}

/// The largest height of a thin triangle over its longest side.
pub const THIN: f64 = 1e-6;

impl Findings {
    /// The size from which on a mesh looks as if it were not in metres.
    pub const LARGE: f64 = 50.0;

    /// Examines a mesh, in a time that grows with its size alone.
    #[must_use]
    pub fn of(positions: &[DVec3], topology: &Topology) -> Self {
        let TopologyStatistics {
            duplicate_triangles,
            isolated_vertices,
            non_manifold_edges,
            ..
        } = topology.statistics();
        let mut is_used = vec![false; positions.len()];
        let named = topology.triangles().iter().flatten();
        named.for_each(|&vertex| is_used[vertex as usize] = true);
        let first = first_coincident(positions, 0.0);
        let coincident = (0_u32..).zip(&first).filter(|&(vertex, &first)| vertex != first);
        let coincident = coincident.filter(|&(vertex, &first)| is_used[vertex as usize] && is_used[first as usize]);
        let mut findings = Self {
            coincident_vertices: coincident.map(|(vertex, &first)| [vertex, first]).collect(),
            duplicate_triangles,
            unused_vertices: isolated_vertices,
            non_manifold_edges,
            inconsistent_edges: inconsistent_edges(topology),
            size: size(positions),
            ..Self::default()
        };
        for (triangle, corners) in (0_u32..).zip(topology.proper_triangles()) {
            let corners = corners.map(|vertex| positions[vertex as usize]);
            if is_flat(corners) {
                findings.flat_triangles.push(triangle);
            } else if is_thin(corners) {
                findings.thin_triangles.push(triangle);
            }
        }
        findings
    }

    /// Returns counts with their names and remedies, without those that are 0.
    fn counts(&self) -> impl Iterator<Item = (usize, [&'static str; 2], &'static str)> {
        [
            (
                self.coincident_vertices.len(),
                ["vertex in the same place as another", "vertices in the same place as others"],
                "weld merges them",
            ),
            (self.duplicate_triangles, ["duplicate triangle", "duplicate triangles"], ""),
            (
                self.flat_triangles.len(),
                ["triangle without area", "triangles without area"],
                "",
            ),
            (self.thin_triangles.len(), ["very thin triangle", "very thin triangles"], ""),
            (self.unused_vertices, ["unused vertex", "unused vertices"], ""),
            (
                self.non_manifold_edges,
                ["edge of three triangles or more", "edges of three triangles or more"],
                "",
            ),
            (
                self.inconsistent_edges.len(),
                [
                    "edge between triangles that face opposite ways",
                    "edges between triangles that face opposite ways",
                ],
                "",
            ),
        ]
        .into_iter()
        .filter(|&(count, ..)| count > 0)
    }

    /// Returns whether the mesh is so large that its unit is more likely millimetres or centimetres than metres.
    #[must_use]
    pub fn is_large(&self) -> bool {
        self.size.max_element() > Self::LARGE
    }
}

impl fmt::Display for Findings {
    /// Writes one line, empty without findings: `2 vertices in the same place as others (weld merges them), 1 unused vertex`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut comma = "";
        for (count, [singular, plural], remedy) in self.counts() {
            write!(f, "{comma}{count} {}", if count == 1 { singular } else { plural })?;
            if !remedy.is_empty() {
                write!(f, " ({remedy})")?;
            }
            comma = ", ";
        }
        if self.is_large() {
            let largest = self.size.max_element();
            // Not with three hundred digits.
            let largest = if largest < 1e7 {
                format!("{largest:.0}")
            } else {
                format!("{largest:.1e}")
            };
            write!(f, "{comma}{largest} long: is its unit millimetres or centimetres?")?;
        }
        Ok(())
    }
}

fn size(positions: &[DVec3]) -> DVec3 {
    let low = positions.iter().copied().reduce(DVec3::min);
    let high = positions.iter().copied().reduce(DVec3::max);
    low.zip(high).map_or(DVec3::ZERO, |(low, high)| high - low)
}

/// Returns whether three points lie on one line, as they do if their projections do in all three coordinate planes. It is exact
/// except for underflow.
fn is_flat([a, b, c]: [DVec3; 3]) -> bool {
    (0..3).all(|axis| {
        let project = |point: DVec3| Coord {
            x: point[(axis + 1) % 3],
            y: point[(axis + 2) % 3],
        };
        orient2d(project(a), project(b), project(c)) == 0.0
    })
}

fn is_thin([a, b, c]: [DVec3; 3]) -> bool {
    let sides = [b - a, c - b, a - c];
    let longest = sides.into_iter().map(DVec3::length_squared).fold(0.0, f64::max);
    // Twice the area is the longest side times its height.
    sides[0].cross(sides[1]).length() < THIN * longest
}

fn inconsistent_edges(topology: &Topology) -> Vec<[u32; 2]> {
    // The numbers of triangles along each edge from its first to its second vertex, and back.
    let mut ways = vec![[0_u8; 2]; topology.edges().len()];
    for (corners, edges) in topology.proper_triangles().iter().zip(topology.triangle_edges()) {
        for (k, &edge) in edges.iter().enumerate() {
            // A triangle that names a vertex twice has no edge there.
            let Some(&[first, _]) = topology.edges().get(edge as usize) else {
                continue;
            };
            let way = &mut ways[edge as usize][usize::from(corners[k] != first)];
            *way = way.saturating_add(1);
        }
    }
    let wrong = topology
        .edges()
        .iter()
        .zip(ways)
        .filter(|(_, ways)| matches!(ways, [2, 0] | [0, 2]));
    wrong.map(|(&edge, _)| edge).collect()
}

#[cfg(test)]
mod tests {
    use super::super::{FileFormat, read_bytes};
    use super::*;

    fn findings(text: &str) -> Findings {
        let mesh = read_bytes(text.as_bytes(), FileFormat::Obj).unwrap().mesh;
        Findings::of(&mesh.positions, &mesh.topology().unwrap())
    }

    #[test]
    fn each_finding_is_counted_and_named() {
        let clean = findings("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
        assert_eq!(clean.to_string(), "");
        // The file has a split seam, a reversed triangle, one on a line, a sliver, a duplicate, and an unused vertex far away.
        let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 1 0\nv -0 0 0\nf 1 2 3\nf 6 4 5\nf 1 2 4\n\
                    v 3 3 3\nv 4 4 4\nv 5 5 5\nf 7 8 9\nv 6 0 0\nv 7 0 0\nv 6.5 1e-9 0\nf 10 11 12\nf 12 10 11\nv 90 0 0\n";
        let all = findings(text);
        assert_eq!(all.coincident_vertices, [[4, 2], [5, 0]]);
        assert_eq!((all.flat_triangles, all.thin_triangles), (vec![3], vec![4, 5]));
        assert_eq!(all.inconsistent_edges, [[0, 1], [9, 10], [9, 11], [10, 11]]);
        assert_eq!(
            findings(text).to_string(),
            "2 vertices in the same place as others (weld merges them), 1 duplicate triangle, 1 triangle without area, 2 very thin triangles, \
             1 unused vertex, 4 edges between triangles that face opposite ways, 90 long: is its unit millimetres or centimetres?"
        );
        let huge = findings("v 0 0 0\nv 1e300 0 0\nv 0 1e300 0\nf 1 2 3\n");
        assert_eq!(huge.to_string(), "1.0e300 long: is its unit millimetres or centimetres?");
    }
}
