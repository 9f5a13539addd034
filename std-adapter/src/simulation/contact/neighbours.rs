//! Neighbours: pairs of cloth that are near each other at rest already.
//!
//! On a fine mesh they are nearly all pairs within the thickness, and nothing has to push them apart: the cloth between them
//! does. So they have a smaller thickness, and candidates of theirs are looked for within less. Certificates hold them apart like
//! any other pair.

use super::closest::Closest;
use crate::PairKind;
use crate::broad_phase::moving::MovingBroadPhase;
use crate::mesh::Topology;
use selvedge_core::glam::DVec3;
use std::sync::Arc;

/// For each vertex the faces near it, for each edge those near it that have larger numbers: in ascending order.
#[derive(Debug)]
pub(super) struct Neighbours {
    vertex_face: Lists,
    edge_edge: Lists,
}

#[derive(Debug)]
struct Lists {
    starts: Vec<u32>,
    others: Vec<u32>,
}

impl Neighbours {
    /// All pairs of cloth, vertices below `cloth_vertices`, whose distance at `rest` is less than `distance`.
    pub(super) fn new(
        topology: &Arc<Topology>,
        rest: &[DVec3],
        cloth_vertices: usize,
        distance: f64,
    ) -> Self {
        let mut broad_phase = MovingBroadPhase::<f64>::new(Arc::clone(topology));
        let is_cloth = |vertex: usize| vertex < cloth_vertices;
        let accepted = broad_phase.set_separation(distance);
        debug_assert!(accepted.is_ok(), "scenes give a positive thickness");
        broad_phase.set_wanted((0..rest.len()).map(is_cloth).collect());
        let (mut vertex_face, mut edge_edge) = (Vec::new(), Vec::new());
        if broad_phase.update(rest, rest).is_ok() {
            broad_phase.candidates(&mut vertex_face, &mut edge_edge);
        }
        let keep = |kind: PairKind, pairs: &mut Vec<[u32; 2]>| {
            pairs.retain(|&pair| {
                let vertices = kind.vertices(pair, topology).map(|v| v as usize);
                vertices.iter().all(|&vertex| is_cloth(vertex))
                    && Closest::of(kind, vertices.map(|v| rest[v])).distance() < distance
            });
            pairs.sort_unstable();
        };
        keep(PairKind::VertexFace, &mut vertex_face);
        keep(PairKind::EdgeEdge, &mut edge_edge);
        Self {
            vertex_face: Lists::new(&vertex_face, topology.vertex_count()),
            edge_edge: Lists::new(&edge_edge, topology.edges().len()),
        }
    }

    /// How many pairs there are.
    pub(super) fn count(&self) -> usize {
        self.vertex_face.others.len() + self.edge_edge.others.len()
    }

    /// Whether a pair is one of them. Edges in ascending order.
    #[inline(always)]
    pub(super) fn contain(&self, kind: PairKind, [first, second]: [u32; 2]) -> bool {
        let lists = match kind {
            PairKind::VertexFace => &self.vertex_face,
            PairKind::EdgeEdge => &self.edge_edge,
        };
        lists.of(first).contains(&second)
    }
}

impl Lists {
    /// From pairs in ascending order whose first numbers are below `count`.
    fn new(pairs: &[[u32; 2]], count: usize) -> Self {
        let begin = |first| pairs.partition_point(|pair| (pair[0] as usize) < first) as u32;
        Self {
            starts: (0..=count).map(begin).collect(),
            others: pairs.iter().map(|pair| pair[1]).collect(),
        }
    }

    #[inline(always)]
    fn of(&self, first: u32) -> &[u32] {
        let range = self.starts[first as usize] as usize..self.starts[first as usize + 1] as usize;
        &self.others[range]
    }
}

/// Whether two sets of points keep their order, and more than `distance`, along an axis, both at `start` and at `end`: then they do
/// on straight ways in between as well. But for the rounding of a difference.
#[inline(always)]
pub(super) fn keep_apart(
    kind: PairKind,
    vertices: [u32; 4],
    [start, end]: [&[DVec3]; 2],
    distance: f64,
) -> bool {
    let gaps = |positions: &[DVec3]| {
        let [a, b, c, d] = vertices.map(|v| positions[v as usize]);
        let (low, high, other_low, other_high) = match kind {
            PairKind::VertexFace => (a, a, b.min(c).min(d), b.max(c).max(d)),
            PairKind::EdgeEdge => (a.min(b), a.max(b), c.min(d), c.max(d)),
        };
        [low - other_high, other_low - high]
    };
    let ([above, below], [above_later, below_later]) = (gaps(start), gaps(end));
    let distance = DVec3::splat(distance);
    above.min(above_later).cmpgt(distance).any() || below.min(below_later).cmpgt(distance).any()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::sleeve;
    use proptest::prelude::*;

    #[test]
    fn exactly_the_pairs_within_the_distance_are_neighbours() {
        let mesh = sleeve(1).unwrap();
        let topology = Arc::new(mesh.topology().unwrap());
        let count = mesh.positions.len();
        let distance = 0.02;
        let neighbours = Neighbours::new(&topology, &mesh.positions, count, distance);
        let mut found = 0;
        for kind in [PairKind::VertexFace, PairKind::EdgeEdge] {
            let (firsts, seconds) = match kind {
                PairKind::VertexFace => (count, topology.triangles().len()),
                PairKind::EdgeEdge => (topology.edges().len(), topology.edges().len()),
            };
            for first in (0..firsts as u32).step_by(7) {
                let from = if kind == PairKind::EdgeEdge {
                    first + 1
                } else {
                    0
                };
                for second in from..seconds as u32 {
                    let vertices = kind.vertices([first, second], &topology);
                    let [a, b, c, d] = vertices;
                    let shared = match kind {
                        PairKind::VertexFace => [b, c, d].contains(&a),
                        PairKind::EdgeEdge => [c, d].contains(&a) || [c, d].contains(&b),
                    };
                    let points = vertices.map(|v| mesh.positions[v as usize]);
                    let near = !shared && Closest::of(kind, points).distance() < distance;
                    assert_eq!(
                        neighbours.contain(kind, [first, second]),
                        near,
                        "{kind} {first} {second}"
                    );
                    found += usize::from(near);
                }
            }
        }
        assert!(found > 100, "{found}");
    }

    fn point() -> impl Strategy<Value = DVec3> {
        prop::array::uniform3(-1.0..1.0_f64).prop_map(DVec3::from)
    }

    proptest! {
        #[test]
        fn what_keeps_apart_along_an_axis_is_nowhere_nearer(
            start in prop::array::uniform4(point()),
            moves in prop::array::uniform4(point()),
            distance in 0.0..0.2_f64,
            is_edge in any::<bool>(),
        ) {
            let kind = if is_edge { PairKind::EdgeEdge } else { PairKind::VertexFace };
            let end = [0, 1, 2, 3].map(|k| start[k] + moves[k] * 0.5);
            if keep_apart(kind, [0, 1, 2, 3], [&start, &end], distance) {
                for step in 0..=20 {
                    let t = f64::from(step) / 20.0;
                    let at = [0, 1, 2, 3].map(|k| start[k].lerp(end[k], t));
                    prop_assert!(Closest::of(kind, at).distance() > distance * (1.0 - 1e-9));
                }
            }
        }
    }
}
