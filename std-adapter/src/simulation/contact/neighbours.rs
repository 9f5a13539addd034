//! Neighbours: pairs of cloth whose boxes are near each other at rest already.
//!
//! On a fine mesh they are nearly all pairs within the thickness, and nothing has to push them apart: the cloth between them
//! does. So they have a smaller thickness, and candidates of theirs are looked for within less. Certificates hold them apart like
//! any other pair.

use super::closest::Closest;
use super::pass::largest;
use crate::PairKind;
use crate::broad_phase::moving::MovingBroadPhase;
use crate::mesh::Topology;
use selvedge_core::glam::{DVec3, Vec3A};
use std::sync::Arc;

/// Whether so many pairs of cloth, vertices below `cloth_vertices`, are nearer to each other than `distance` at rest that looking them
/// up costs less than it saves: more than there are edges.
pub(super) fn are_many(
    topology: &Arc<Topology>,
    rest: &[DVec3],
    cloth_vertices: usize,
    distance: f64,
) -> bool {
    let mut broad_phase = MovingBroadPhase::<f64>::new(Arc::clone(topology));
    let is_cloth = |vertex: usize| vertex < cloth_vertices;
    let accepted = broad_phase.set_separation(distance);
    debug_assert!(accepted.is_ok(), "scenes give a positive thickness");
    broad_phase.set_wanted((0..rest.len()).map(is_cloth).collect());
    let (mut vertex_face, mut edge_edge) = (Vec::new(), Vec::new());
    if broad_phase.update(rest, rest).is_ok() {
        broad_phase.candidates(&mut vertex_face, &mut edge_edge);
    }
    let near = |kind: PairKind, pair: [u32; 2]| {
        let vertices = kind.vertices(pair, topology).map(|v| v as usize);
        vertices.iter().all(|&vertex| is_cloth(vertex))
            && Closest::of(kind, vertices.map(|v| rest[v])).distance() < distance
    };
    let vertex_face = vertex_face.iter().map(|&pair| (PairKind::VertexFace, pair));
    let edge_edge = edge_edge.iter().map(|&pair| (PairKind::EdgeEdge, pair));
    let all = vertex_face.chain(edge_edge);
    let found = all.filter(|&(kind, pair)| near(kind, pair));
    let enough = topology.edges().len() + 1;
    found.take(enough).count() == enough
}

/// By how much the first set of a pair is ahead of the second along each axis, and by how much it is behind.
macro_rules! gaps {
    ($kind:expr, $a:expr, $b:expr, $c:expr, $d:expr) => {{
        let (low, high, other_low, other_high) = match $kind {
            PairKind::VertexFace => ($a, $a, $b.min($c).min($d), $b.max($c).max($d)),
            PairKind::EdgeEdge => ($a.min($b), $a.max($b), $c.min($d), $c.max($d)),
        };
        [low - other_high, other_low - high]
    }};
}

/// Whether the boxes of a pair come within `distance` of each other at rest: then it is one of neighbours.
pub(super) fn are_neighbours(kind: PairKind, rest: [DVec3; 4], distance: f64) -> bool {
    let [a, b, c, d] = rest;
    let [ahead, behind] = gaps!(kind, a, b, c, d);
    ahead.max(behind).cmple(DVec3::splat(distance)).all()
}

/// Which candidates are left out because they are neighbours and not within their reach: what is asked of every vertex, rounded to
/// `f32`, on one cache line.
///
/// **Rounding** (any direction: ε = 2u = 2⁻²³ of `f32` an operation). A coordinate of at most B is rounded by εB at most, and the
/// difference of two, at most 2B, by 2εB more: together 4εB. [`ROUNDING`] has twice that, for the rounding of what is compared with;
/// each comparison errs to the side on which the pair stays a candidate. Underflow adds less than the smallest normal number, far below
/// any distance that a scene may give.
#[derive(Debug)]
pub(super) struct Neighbours {
    ways: Vec<Way>,
    /// How near boxes are at rest, rounded down.
    at_rest: f32,
    reach: f64,
    /// The same, rounded up.
    beyond_reach: f32,
}

/// 8ε of [`Neighbours`].
const ROUNDING: f64 = 8.0 * f32::EPSILON as f64;

#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct Way {
    start: Vec3A,
    end: Vec3A,
    /// NaN for bodies, which have no neighbours.
    rest: Vec3A,
}

impl Neighbours {
    /// Pairs of cloth, vertices below `cloth_vertices`, whose boxes are within `at_rest` at `rest`. They are to be candidates if they
    /// come within `reach`.
    pub(super) fn new(rest: &[DVec3], cloth_vertices: usize, at_rest: f64, reach: f64) -> Self {
        let way = |(vertex, rest): (usize, &DVec3)| Way {
            start: Vec3A::ZERO,
            end: Vec3A::ZERO,
            rest: if vertex < cloth_vertices {
                rest.as_vec3a()
            } else {
                Vec3A::NAN
            },
        };
        Self {
            ways: rest.iter().enumerate().map(way).collect(),
            at_rest: (at_rest * (1.0 - ROUNDING) - largest(rest) * ROUNDING) as f32,
            reach,
            beyond_reach: f32::INFINITY,
        }
    }

    /// From here on all is asked about this motion.
    pub(super) fn set_motion(&mut self, [start, end]: [&[DVec3]; 2]) {
        let largest = largest(start).max(largest(end));
        self.beyond_reach = (self.reach * (1.0 + ROUNDING) + largest * ROUNDING) as f32;
        for ((way, start), end) in self.ways.iter_mut().zip(start).zip(end) {
            (way.start, way.end) = (start.as_vec3a(), end.as_vec3a());
        }
    }

    /// Whether a pair certainly is one of neighbours that keep their order, and more than their reach, along an axis, both at the start
    /// and at the end: then they do on straight ways in between as well.
    #[inline(always)]
    pub(super) fn keep_apart(&self, kind: PairKind, vertices: [u32; 4]) -> bool {
        // Written out: `map` would not be inlined here.
        let way = |corner: usize| &self.ways[vertices[corner] as usize];
        let (a, b, c, d) = (way(0), way(1), way(2), way(3));
        let [ahead, behind] = gaps!(kind, a.start, b.start, c.start, d.start);
        let [ahead_later, behind_later] = gaps!(kind, a.end, b.end, c.end, d.end);
        let [ahead_at_rest, behind_at_rest] = gaps!(kind, a.rest, b.rest, c.rest, d.rest);
        let kept = ahead.min(ahead_later).max(behind.min(behind_later));
        let at_rest = ahead_at_rest.max(behind_at_rest);
        let is_apart = kept.cmpgt(Vec3A::splat(self.beyond_reach)).any();
        is_apart & at_rest.cmple(Vec3A::splat(self.at_rest)).all()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::sleeve;
    use proptest::prelude::*;

    #[test]
    fn neighbours_are_many_only_on_a_fine_mesh() {
        let mesh = sleeve(1).unwrap();
        let topology = Arc::new(mesh.topology().unwrap());
        let count = mesh.positions.len();
        let many = |distance| are_many(&topology, &mesh.positions, count, distance);
        assert!(!many(0.006) && many(0.05));
    }

    fn point() -> impl Strategy<Value = DVec3> {
        prop::array::uniform3(-1.0..1.0_f64).prop_map(DVec3::from)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn only_neighbours_are_left_out_and_only_while_they_are_not_within_their_reach(
            start in prop::array::uniform4(point()),
            moves in prop::array::uniform4(point()),
            at_rest in 0.0..1.0_f64,
            reach in 0.0..0.2_f64,
            is_edge in any::<bool>(),
        ) {
            let kind = if is_edge { PairKind::EdgeEdge } else { PairKind::VertexFace };
            let rest = start.map(|point| point * 0.7);
            let end = [0, 1, 2, 3].map(|k| start[k] + moves[k] * 0.5);
            let vertices = [0, 1, 2, 3];
            let left_out = |cloth| {
                let mut neighbours = Neighbours::new(&rest, cloth, at_rest, reach);
                neighbours.set_motion([&start, &end]);
                neighbours.keep_apart(kind, vertices)
            };
            let near = are_neighbours(kind, rest, at_rest);
            if left_out(4) {
                prop_assert!(near);
                for step in 0..=20 {
                    let t = f64::from(step) / 20.0;
                    let at = [0, 1, 2, 3].map(|k| start[k].lerp(end[k], t));
                    prop_assert!(Closest::of(kind, at).distance() > reach * (1.0 - 1e-9));
                }
            }
            // Whoever is apart by a little more than rounding is left out: with the same boxes, farther than the reach.
            let far = |by: f64| [0, 1, 2, 3].map(|k| start[k] + DVec3::X * if first(kind, k) { by } else { 0.0 });
            let mut neighbours = Neighbours::new(&rest, 4, at_rest + 1e-5, reach);
            neighbours.set_motion([&far(2.0 + reach + 1e-5), &far(3.0 + reach)]);
            prop_assert!(!near || neighbours.keep_apart(kind, vertices));
            // A pair with a body has no smaller reach.
            let with_body = left_out(if is_edge { 2 } else { 1 });
            prop_assert!(!with_body);
        }
    }

    fn first(kind: PairKind, corner: usize) -> bool {
        corner < if kind == PairKind::EdgeEdge { 2 } else { 1 }
    }
}
