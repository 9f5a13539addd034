//! The directions in which contours, the curves along which surfaces pass through each other, shrink until there are none.
//!
//! Two things pull, and neither uses the history of the state:
//!
//! **The length of contours** (Volino and Magnenat-Thalmann 2006, "Resolving surface collisions through intersection contour
//! minimization"). A contour consists of segments, each in a triangle T and a face F that pass through each other. Each segment
//! ends where an edge meets a face. Let an edge of T with the direction e (of length one) meet F, whose normal is n, at p, and
//! let r be the direction of the segment from there into T. Let the part of T at p move by x, and the part of F by y. Then p
//! moves by x − (n·(x − y) / n·e)·e, and the segment becomes longer by −r times that:
//!
//! ```text
//! dL = −(r − (r·e / n·e)·n)·x − (r·e / n·e)·n·y
//! ```
//!
//! The negative gradient of this length is the way out. With x = −y = d/2 it is the paper's equation r − 2(r·e / n·e)·n, apart
//! from a factor of a half. Both triangles at the edge have a segment from p.
//!
//! **The side that has gone through** moves along the normal. Where contours are parallel, as where a pleat lies in the next one,
//! their length does not change. A part that has gone through a closed body is inside it, and moves outwards. For cloth it is the
//! [smaller side](super::sides) of the contour. The edge moves to where its other end is, by ±n times the difference of the two
//! sides.

use super::crossing::share_to_plane;
use super::sides::Sides;
use selvedge::{Adjacency, Intersection, Topology};
use selvedge_core::glam::DVec3;

/// The data on the surfaces, whose memory is used again.
#[derive(Debug)]
pub(super) struct Contours {
    edge_triangles: Adjacency<u32>,
    sides: Sides,
}

impl Contours {
    pub(super) fn new(topology: &Topology, positions: &[DVec3]) -> Self {
        let all = topology.triangle_edges().iter().zip(0..);
        let edges = || all.clone().flat_map(|(edges, triangle)| edges.map(|edge| (edge, triangle)));
        let with_edge = || edges().filter(|&(edge, _)| edge != Topology::NO_EDGE);
        Self {
            edge_triangles: Adjacency::new(topology.edges().len(), with_edge),
            sides: Sides::new(topology, positions),
        }
    }

    /// Replaces `directions` by the direction in which each vertex should move; it has no unit, and is longer than one where the
    /// pull is strong. `outward` returns the sign of the normals that point outwards, 1 or −1, for a vertex of a closed body, and
    /// 0 for others.
    pub(super) fn find_directions(
        &mut self,
        topology: &Topology,
        intersections: &[Intersection],
        positions: &[DVec3],
        outward: impl Fn(u32) -> f64,
        directions: &mut [DVec3],
    ) {
        self.sides.find(topology, intersections, positions);
        directions.fill(DVec3::ZERO);
        let at = |vertex: u32| positions[vertex as usize];
        for intersection in intersections {
            // Neighbours that touch make no contour: contact pushes them apart.
            let Intersection::EdgeFace { edge, face } = *intersection else {
                continue;
            };
            let (ends, corners) = (topology.edges()[edge as usize], topology.triangles()[face as usize]);
            let (segment, triangle) = (ends.map(at), corners.map(at));
            let n = normal(triangle);
            let e = (segment[1] - segment[0]).normalize_or_zero();
            let slope = n.dot(e);
            if slope == 0.0 {
                continue;
            }
            let mut pulls = [DVec3::ZERO; 2];
            let mut normals = DVec3::ZERO;
            for &own in self.edge_triangles.of(edge as usize) {
                let own = topology.triangles()[own as usize];
                let Some(apex) = own.into_iter().find(|vertex| !ends.contains(vertex)) else {
                    continue;
                };
                normals += normal(own.map(at));
                let inward = (at(apex) - segment[0]).reject_from_normalized(e);
                let r = e.cross(inward).cross(n).normalize_or_zero();
                let r = if r.dot(inward) < 0.0 { -r } else { r };
                let along_normal = n * (r.dot(e) / slope);
                pulls[0] += r - along_normal;
                pulls[1] += along_normal;
            }
            match [outward(ends[0]), outward(corners[0])] {
                [0.0, 0.0] => {
                    let push = n * (slope.signum() * self.sides.excess(edge));
                    pulls[0] += push;
                    pulls[1] -= push;
                }
                [sign, 0.0] => pulls[1] += normals.normalize_or_zero() * sign,
                [_, sign] => pulls[0] += n * sign,
            }
            let share = share_to_plane(segment, triangle);
            for (vertex, weight) in ends.into_iter().zip([1.0 - share, share]) {
                directions[vertex as usize] += pulls[0] * weight;
            }
            for (vertex, weight) in corners.into_iter().zip(weights(segment[0].lerp(segment[1], share), triangle)) {
                directions[vertex as usize] += pulls[1] * weight;
            }
        }
    }
}

fn normal([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a).normalize_or_zero()
}

/// The weights of the corners of a triangle in one of its points.
fn weights(point: DVec3, [a, b, c]: [DVec3; 3]) -> [f64; 3] {
    let normal = (b - a).cross(c - a);
    let part = |from: DVec3, to: DVec3| normal.dot((from - point).cross(to - point)) / normal.length_squared();
    let parts = [part(b, c), part(c, a), part(a, b)];
    // A triangle without area has no such weights.
    parts.map(|part| if part.is_finite() { part.clamp(0.0, 1.0) } else { 1.0 / 3.0 })
}

#[cfg(test)]
mod tests {
    use super::*;
    use selvedge::{CollisionDetector, Mesh};

    /// Two square sheets that pass through each other; both have borders.
    fn crossed() -> Mesh {
        let mut mesh = crate::world::sheet(DVec3::new(0.1, 0.07, 0.21), [DVec3::X, DVec3::Y], [3, 3]);
        let other = crate::world::sheet(
            DVec3::new(0.4, 0.3, -0.2),
            [DVec3::new(0.2, 0.1, 0.9), DVec3::new(-0.3, 0.8, 0.2)],
            [2, 3],
        );
        let first = mesh.positions.len() as u32;
        mesh.triangles
            .extend(other.triangles.iter().map(|t| t.map(|vertex| first + vertex)));
        mesh.positions.extend(other.positions);
        mesh
    }

    fn intersections(topology: &Topology, positions: &[DVec3]) -> Vec<Intersection> {
        let mut found = Vec::new();
        let topology = Topology::new(positions.len(), topology.triangles().to_vec()).unwrap();
        CollisionDetector::<f64>::new(topology)
            .intersections(positions, &mut found)
            .unwrap();
        found
    }

    /// The length of all contours. It is a sum over pairs of triangles that pass through each other. Each adds the distance of
    /// the two points at which an edge of one meets the other.
    fn length(topology: &Topology, positions: &[DVec3]) -> f64 {
        let mut ends = std::collections::BTreeMap::<[u32; 2], Vec<DVec3>>::new();
        for own in intersections(topology, positions) {
            let Intersection::EdgeFace { edge, face } = own else {
                continue;
            };
            let segment = topology.edges()[edge as usize].map(|vertex| positions[vertex as usize]);
            let corners = topology.triangles()[face as usize].map(|vertex| positions[vertex as usize]);
            let point = segment[0].lerp(segment[1], share_to_plane(segment, corners));
            for (edges, triangle) in topology.triangle_edges().iter().zip(0..) {
                if edges.contains(&edge) {
                    ends.entry([face.min(triangle), face.max(triangle)]).or_default().push(point);
                }
            }
        }
        ends.values().map(|ends| ends[0].distance(ends[1])).sum()
    }

    #[test]
    fn directions_are_the_negative_gradient_of_the_contours_length() {
        let mesh = crossed();
        let topology = mesh.topology().unwrap();
        let found = intersections(&topology, &mesh.positions);
        assert!(found.len() > 8 && length(&topology, &mesh.positions) > 0.5);
        let mut contours = Contours::new(&topology, &mesh.positions);
        let mut directions = vec![DVec3::ZERO; mesh.positions.len()];
        // The bodies count as open here: no side pushes.
        let mut along = |positions: &[DVec3]| {
            contours.find_directions(&topology, &found, positions, |_| f64::MIN_POSITIVE, &mut directions);
            directions.clone()
        };
        let directions = along(&mesh.positions);
        let step = 1e-6;
        for vertex in 0..mesh.positions.len() {
            for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
                let at = |by: f64| {
                    let mut positions = mesh.positions.clone();
                    positions[vertex] += axis * by;
                    length(&topology, &positions)
                };
                let slope = (at(step) - at(-step)) / (2.0 * step);
                assert!(
                    (slope + directions[vertex].dot(axis)).abs() < 1e-6,
                    "{vertex}: {slope}, {}",
                    directions[vertex]
                );
            }
        }
    }
}
