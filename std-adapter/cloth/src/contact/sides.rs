//! The area of the surface on either side of each contour. The smaller side is the one that has gone through (global intersection
//! analysis, Baraff, Witkin and Kass 2003, "Untangling cloth").
//!
//! A contour that meets the border of another surface ends inside its own surface, and does not cut it in two (Wicke, Lanker and
//! Gross 2006, "Untangling cloth with boundaries"). So this module does not flood regions. A point belongs to the side of a
//! contour that is nearest to it along edges that are not cut.

use super::crossing::share_to_plane;
use selvedge::{Adjacency, Components, Intersection, Topology};
use selvedge_core::glam::DVec3;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Ends of cut edges distinguish the sides: each is a node, and the nodes of one side are connected.
#[derive(Debug)]
pub(super) struct Sides {
    vertex_edges: Adjacency<u32>,
    /// A third of the area of each vertex's triangles at the start of untangling.
    areas: Vec<f64>,
    /// The node of each edge's first end, which the node of its second end follows; [`NONE`] if the edge is not cut.
    nodes: Vec<u32>,
    sides: Components,
    /// The area of each side, at its first node.
    sums: Vec<f64>,
    /// The distance of each vertex from the nearest side, and a node of that side.
    nearest: Vec<(f64, u32)>,
    /// Vertices from which the search continues, the nearest first: distances are not negative, so they have the order of their
    /// bits.
    queue: BinaryHeap<Reverse<(u64, u32)>>,
}

const NONE: u32 = u32::MAX;

impl Sides {
    pub(super) fn new(topology: &Topology, positions: &[DVec3]) -> Self {
        let mut areas = vec![0.0; topology.vertex_count()];
        for triangle in topology.triangles() {
            let [a, b, c] = triangle.map(|vertex| positions[vertex as usize]);
            let third = (b - a).cross(c - a).length() / 6.0;
            triangle.iter().for_each(|&vertex| areas[vertex as usize] += third);
        }
        let edges = topology.edges().iter().zip(0..);
        let ends = || edges.clone().flat_map(|(ends, edge)| ends.map(|vertex| (vertex, edge)));
        Self {
            vertex_edges: Adjacency::new(topology.vertex_count(), ends),
            areas,
            nodes: Vec::new(),
            sides: Components::default(),
            sums: Vec::new(),
            nearest: Vec::new(),
            queue: BinaryHeap::new(),
        }
    }

    /// Finds the sides of all contours in a state.
    pub(super) fn find(&mut self, topology: &Topology, intersections: &[Intersection], positions: &[DVec3]) {
        self.nodes.clear();
        self.nodes.resize(topology.edges().len(), NONE);
        self.nearest.clear();
        self.nearest.resize(positions.len(), (f64::INFINITY, NONE));
        let mut count = 0;
        for intersection in intersections {
            if let Intersection::EdgeFace { edge, face } = *intersection {
                self.cut(topology, [edge, face], positions, &mut count);
            }
        }
        self.sides = Components::new(count as usize);
        self.join_along_contours(topology);
        self.spread(topology, positions);
        self.sums.clear();
        self.sums.resize(count as usize, 0.0);
        for vertex in 0..positions.len() {
            let (_, node) = self.nearest[vertex];
            if node != NONE {
                self.sums[self.sides.first(node) as usize] += self.areas[vertex];
            }
        }
    }

    /// Returns how much smaller the side of a cut edge's first end is than that of its second, as a share of both: from −1 to 1.
    pub(super) fn excess(&mut self, edge: u32) -> f64 {
        let node = self.nodes[edge as usize];
        let [first, second] = [node, node + 1].map(|node| self.sides.first(node) as usize);
        let [first, second] = [self.sums[first], self.sums[second]];
        let share = (second - first) / (first + second);
        if share.is_finite() { share } else { 0.0 }
    }

    /// Cuts the edge at the face: its ends are on two sides. `count` is the number of nodes so far.
    fn cut(&mut self, topology: &Topology, [edge, face]: [u32; 2], positions: &[DVec3], count: &mut u32) {
        if self.nodes[edge as usize] == NONE {
            self.nodes[edge as usize] = *count;
            *count += 2;
        }
        let node = self.nodes[edge as usize];
        let ends = topology.edges()[edge as usize];
        let points = ends.map(|vertex| positions[vertex as usize]);
        let face = topology.triangles()[face as usize].map(|vertex| positions[vertex as usize]);
        let length = points[0].distance(points[1]);
        let share = share_to_plane(points, face);
        self.reach(ends[0], share * length, node);
        self.reach(ends[1], (1.0 - share) * length, node + 1);
    }

    /// Joins sides along contours. A contour passes from one cut edge to another of the same triangle. Their common end is on one
    /// of its sides, their others on the other.
    fn join_along_contours(&mut self, topology: &Topology) {
        for edges in topology.triangle_edges() {
            for [one, other] in [[0, 1], [1, 2], [2, 0]].map(|pair| pair.map(|k| edges[k])) {
                let node = |edge: u32| self.nodes.get(edge as usize).copied().filter(|&node| node != NONE);
                let (Some(first), Some(second)) = (node(one), node(other)) else {
                    continue;
                };
                let [ends, others] = [one, other].map(|edge| topology.edges()[edge as usize]);
                for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                    if ends[i as usize] == others[j as usize] {
                        self.sides.join(first + i, second + j);
                        self.sides.join(first + 1 - i, second + 1 - j);
                    }
                }
            }
        }
    }

    /// Spreads the sides to all vertices within reach (Dijkstra 1959).
    fn spread(&mut self, topology: &Topology, positions: &[DVec3]) {
        while let Some(Reverse((distance, vertex))) = self.queue.pop() {
            let (nearest, node) = self.nearest[vertex as usize];
            if distance != nearest.to_bits() {
                continue;
            }
            for k in 0..self.vertex_edges.of(vertex as usize).len() {
                let edge = self.vertex_edges.of(vertex as usize)[k] as usize;
                if self.nodes[edge] == NONE {
                    let [a, b] = topology.edges()[edge];
                    let length = positions[a as usize].distance(positions[b as usize]);
                    self.reach(if a == vertex { b } else { a }, nearest + length, node);
                }
            }
        }
    }

    fn reach(&mut self, vertex: u32, distance: f64, node: u32) {
        let nearest = &mut self.nearest[vertex as usize];
        if distance < nearest.0 {
            *nearest = (distance, node);
            self.queue.push(Reverse((distance.to_bits(), vertex)));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::sheet;
    use selvedge::{CollisionDetector, Mesh};

    /// A sheet of 1 m, and another one that stands upright in it at `x`, from y = −1 m to `until`.
    fn crossed(x: f64, until: f64) -> (Topology, Vec<DVec3>, Vec<Intersection>) {
        let mut mesh = sheet(DVec3::ZERO, [DVec3::X, DVec3::Y], [11, 11]);
        let standing = [DVec3::Y * (until + 1.0), DVec3::Z];
        let Mesh { positions, triangles } = sheet(DVec3::new(x, -1.0, -0.513), standing, [7, 7]);
        let first = mesh.positions.len() as u32;
        mesh.triangles
            .extend(triangles.iter().map(|t| t.map(|vertex| first + vertex)));
        mesh.positions.extend(positions);
        let topology = mesh.topology().unwrap();
        let mut found = Vec::new();
        let mut detector = CollisionDetector::<f64>::new(mesh.topology().unwrap());
        detector.intersections(&mesh.positions, &mut found).unwrap();
        (topology, mesh.positions, found)
    }

    /// Returns how much smaller the side at lower x is, for each cut edge of the lying sheet.
    fn excess(x: f64, until: f64) -> Vec<f64> {
        let (topology, positions, found) = crossed(x, until);
        let mut sides = Sides::new(&topology, &positions);
        sides.find(&topology, &found, &positions);
        let edges = found.iter().filter_map(|own| match own {
            Intersection::EdgeFace { edge, .. } => Some(*edge),
            _ => None,
        });
        let lying = edges.filter(|&edge| topology.edges()[edge as usize][1] < 144);
        lying
            .map(|edge| {
                let [a, b] = topology.edges()[edge as usize].map(|vertex| positions[vertex as usize].x);
                sides.excess(edge) * (b - a).signum()
            })
            .collect()
    }

    #[test]
    fn the_smaller_side_of_a_contour_is_known_whether_it_cuts_the_surface_in_two_or_ends_within() {
        for until in [2.0, 0.77] {
            let near = excess(0.23, until);
            assert!(near.len() > 5 && near.iter().all(|&excess| excess > 0.1), "{until}: {near:?}");
            let far = excess(0.83, until);
            assert!(far.iter().all(|&excess| excess < -0.1), "{until}: {far:?}");
        }
        // A strip of 0.23 m of 1 m² is on one side; vertices share the area of the triangles between.
        let [first, ..] = excess(0.23, 2.0)[..] else {
            panic!("it is cut")
        };
        assert!((first - (0.77 - 0.23)).abs() < 0.1, "{first}");
    }
}
