//! Vertices with very many edges, such as the middle of a fan.
//!
//! All edges at a hub are near each other, and so are all its faces. No two of them are a pair, since they share the hub. Without
//! further knowledge a traversal compares each with each, which takes a time that is quadratic in their number. So the edges, or
//! faces, of one hub are put together in the order of a tree. A block whose primitives all have one hub then needs no comparison
//! with another block of that hub.
//!
//! Only whole groups of [`GROUP`] primitives are put together, so that the other primitives keep blocks of their own. Fewer than
//! `GROUP` primitives of each hub are left among the others. Each of these is compared with all blocks of its hub, so a traversal
//! stays linear in their number.

use super::order::{Centre, LEAF, order};

/// Marks a primitive without a hub.
pub(super) const NO_HUB: u32 = u32::MAX;

/// The number of primitives in a block of the second level.
const GROUP: usize = LEAF * LEAF;

/// The number of triangles from which on a vertex is a hub. With fewer, comparing each with each takes no more box tests than a
/// usual mesh takes for an edge.
const VALENCE: u32 = GROUP as u32;

#[derive(Debug, Default)]
pub(super) struct Hubs {
    /// True for hubs; empty if no vertex is one.
    is_hub: Vec<bool>,
}

impl Hubs {
    pub(super) fn new(vertex_count: usize, triangles: &[[u32; 3]]) -> Self {
        let mut valences = vec![0_u32; vertex_count];
        for &vertex in triangles.iter().flatten() {
            valences[vertex as usize] += 1;
        }
        let is_hub = |&valence: &u32| valence >= VALENCE;
        let any = valences.iter().any(is_hub);
        Self {
            is_hub: if any {
                valences.iter().map(is_hub).collect()
            } else {
                Vec::new()
            },
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.is_hub.is_empty()
    }

    /// Returns the hub of a primitive with these vertices: the one with the smallest number, or [`NO_HUB`].
    pub(super) fn of_primitive(&self, vertices: &[u32]) -> u32 {
        let hubs = vertices.iter().copied().filter(|&vertex| self.is_hub[vertex as usize]);
        hubs.min().unwrap_or(NO_HUB)
    }
}

/// Puts primitives in [order], those of each hub together. Each has at most one hub.
pub(super) fn order_by_hub(centres: &mut Vec<Centre>, hub: impl Fn(u32) -> u32) {
    let mut by_hub = std::mem::take(centres);
    by_hub.sort_by_key(|centre| hub(centre.item));
    let mut others = Vec::new();
    for same in by_hub.chunk_by_mut(|a, b| hub(a.item) == hub(b.item)) {
        let grouped = match hub(same[0].item) {
            NO_HUB => 0,
            _ => same.len() / GROUP * GROUP,
        };
        order(same);
        centres.extend_from_slice(&same[..grouped]);
        others.extend_from_slice(&same[grouped..]);
    }
    order(&mut others);
    centres.append(&mut others);
}

#[cfg(test)]
mod tests {
    use crate::mesh::Topology;
    use crate::{CollisionDetector, StepStatistics};

    /// Returns a cone of so many triangles with its tip as the hub, and its rim.
    fn fan(count: u32) -> (Topology, Vec<[f64; 3]>) {
        let triangles = (0..count).map(|k| [0, k + 1, (k + 1) % count + 1]).collect();
        let rim = (0..count).map(|k| {
            let angle = f64::from(k) / f64::from(count) * std::f64::consts::TAU;
            // The coordinates are `f32` numbers, whose boxes are exact.
            [angle.cos(), angle.sin(), 0.25].map(|x| f64::from(x as f32))
        });
        let positions = std::iter::once([0.0; 3]).chain(rim).collect();
        (Topology::new(count as usize + 1, triangles).unwrap(), positions)
    }

    /// Returns the statistics of a step in which the cone turns a little, and the box tests.
    fn step(count: u32) -> (StepStatistics, u64) {
        let (topology, start) = fan(count);
        let end: Vec<_> = start.iter().map(|&[x, y, z]| [x - 1e-7 * y, y + 1e-7 * x, z]).collect();
        let mut detector = CollisionDetector::<f64>::new(topology.clone());
        detector.contacts(&start, &end, &mut Vec::new()).unwrap();
        let mut broad_phase = crate::broad_phase::MovingBroadPhase::new(topology);
        broad_phase.update(&start, &end).unwrap();
        broad_phase.candidates(&mut Vec::new(), &mut Vec::new());
        (*detector.statistics(), broad_phase.statistics().box_tests)
    }

    #[test]
    fn a_fan_takes_box_tests_in_proportion_to_its_triangles() {
        let [(_, few), (_, many)] = [4_000, 32_000].map(step);
        assert!(many < 12 * few, "{few} and {many}");
        assert!(many < 100 * 32_000, "{many}");
    }

    #[test]
    fn hubs_change_no_candidate() {
        // Two cones share their rim: edges and faces of two hubs are near each other, and are pairs.
        let count = 600;
        let (_, cone) = fan(count);
        let other = count + 1;
        let rim = |k: u32| k % count + 1;
        let sides = (0..count).flat_map(|k| [[0, rim(k), rim(k + 1)], [other, rim(k), rim(k + 1)]]);
        let positions: Vec<_> = cone.into_iter().chain([[0.0, 0.0, 0.0625]]).collect();
        let topology = Topology::new(count as usize + 2, sides.collect()).unwrap();
        let mut detector = CollisionDetector::<f64>::new(topology.clone());
        let (mut vertex_face, mut edge_edge) = (Vec::new(), Vec::new());
        let swept = crate::CandidateBoxes::Swept;
        detector
            .candidates(&positions, &positions, swept, &mut vertex_face, &mut edge_edge)
            .unwrap();
        vertex_face.sort_unstable();
        edge_edge.sort_unstable();
        assert_eq!(
            [&vertex_face, &edge_edge],
            [&near_faces(&topology, &positions), &near_edges(&topology, &positions)]
        );
        assert!(edge_edge.len() > 100_000 && !vertex_face.is_empty());
    }

    fn are_near(points: &[[f64; 3]], others: &[[f64; 3]]) -> bool {
        let bound = |points: &[[f64; 3]], axis: usize, pick: fn(f64, f64) -> f64| {
            points.iter().map(|point| point[axis]).reduce(pick).unwrap()
        };
        (0..3).all(|axis| {
            let (low, high) = (bound(points, axis, f64::min), bound(points, axis, f64::max));
            let (other_low, other_high) = (bound(others, axis, f64::min), bound(others, axis, f64::max));
            low <= other_high && other_low <= high
        })
    }

    fn near_faces(topology: &Topology, positions: &[[f64; 3]]) -> Vec<[u32; 2]> {
        let mut near = Vec::new();
        for vertex in 0..positions.len() as u32 {
            for (face, corners) in (0..).zip(topology.triangles()) {
                let points = corners.map(|corner| positions[corner as usize]);
                if !corners.contains(&vertex) && are_near(&[positions[vertex as usize]], &points) {
                    near.push([vertex, face]);
                }
            }
        }
        near
    }

    fn near_edges(topology: &Topology, positions: &[[f64; 3]]) -> Vec<[u32; 2]> {
        let edges = topology.edges();
        let points = |ends: &[u32; 2]| ends.map(|end| positions[end as usize]);
        let mut near = Vec::new();
        for (first, ends) in (0..).zip(edges) {
            for (second, others) in (0..).zip(edges).skip(first as usize + 1) {
                if !ends.iter().any(|end| others.contains(end)) && are_near(&points(ends), &points(others)) {
                    near.push([first, second]);
                }
            }
        }
        near
    }
}
