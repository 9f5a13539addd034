//! Candidates that keep apart until candidates are looked for again, and so need no attention until then.
//!
//! Among them are neighbours: pairs of cloth whose boxes are near each other at rest already. On a fine mesh they are nearly all pairs
//! within the thickness, and nothing has to push them apart: the cloth between them does. So they have a smaller thickness, and
//! candidates of theirs are looked for within less. Certificates hold them apart like any other pair.

use super::closest::Closest;
use super::settings::MARGIN;
use selvedge::PairKind;
use selvedge::Topology;
use selvedge::verification::MovingBroadPhase;
use selvedge_core::glam::{DVec3, Vec3A};
use selvedge_core::separation::clearance::{Clearance, are_boxes_within, nearness};
use selvedge_core::separation::largest_coordinate;
use selvedge_core::verification::lanes::Lanes;
use std::sync::Arc;

/// Whether so many pairs of cloth, vertices below `cloth_vertices`, are nearer to each other than `distance` at rest that looking them
/// up costs less than it saves: more than there are edges.
pub(super) fn are_many(topology: &Arc<Topology>, rest: &[DVec3], cloth_vertices: usize, distance: f64) -> bool {
    let mut broad_phase = MovingBroadPhase::new(Arc::clone(topology));
    let is_cloth = |vertex: usize| vertex < cloth_vertices;
    let accepted = broad_phase.set_separation(distance);
    debug_assert!(accepted.is_ok(), "scenes give a positive thickness");
    broad_phase.set_wanted((0..rest.len()).map(is_cloth).collect());
    let (mut vertex_face, mut edge_edge) = (Vec::new(), Vec::new());
    if broad_phase.update(rest, rest).is_ok() {
        broad_phase.candidates(&mut vertex_face, &mut edge_edge);
    }
    let near = |kind: PairKind, pair: [u32; 2]| {
        let vertices = topology.vertices_of(kind, pair).map(|v| v as usize);
        vertices.iter().all(|&vertex| is_cloth(vertex)) && Closest::of(kind, vertices.map(|v| rest[v])).distance() < distance
    };
    let vertex_face = vertex_face.iter().map(|&pair| (PairKind::VertexFace, pair));
    let edge_edge = edge_edge.iter().map(|&pair| (PairKind::EdgeEdge, pair));
    let all = vertex_face.chain(edge_edge);
    let found = all.filter(|&(kind, pair)| near(kind, pair));
    let enough = topology.edges().len() + 1;
    found.take(enough).count() == enough
}

/// Whether the boxes of a pair come within `distance` of each other at rest: then it is one of neighbours.
pub(super) fn are_neighbours(kind: PairKind, rest: [DVec3; 4], distance: f64) -> bool {
    let [a, b, c, d] = rest;
    let (low, high, other_low, other_high) = match kind {
        PairKind::VertexFace => (a, a, b.min(c).min(d), b.max(c).max(d)),
        PairKind::EdgeEdge => (a.min(b), a.max(b), c.min(d), c.max(d)),
    };
    (low - other_high).max(other_low - high).cmple(DVec3::splat(distance)).all()
}

/// Which candidates are left out, because they keep apart on the whole motion: what is asked of every vertex, rounded to `f32`.
///
/// Boxes along three axes leave many pairs that are farther apart than their reach: nearly all pairs of triangles side by side. What
/// they keep though their vertices stray, by half of what is looked for beyond the thickness, is their
/// [clearance](selvedge_core::separation::clearance); [more](MARGIN) is asked for along a direction that
/// is no axis: what comes that near is pushed apart before it is within the thickness. With less, cloth that is folded tightly was seen to
/// slip more.
#[derive(Debug)]
pub(super) struct Sieve {
    ways: Vec<Way>,
    /// Where vertices are at rest, NaN for bodies, which have no neighbours; empty if there are no neighbours at all.
    rest: Vec<Vec3A>,
    distances: Distances,
    /// What neighbours are to keep, and what the other pairs.
    clearances: [Clearance; 2],
    /// How near boxes of neighbours are at rest, rounded down; less than any if there are none.
    at_rest: f32,
}

/// Which pairs are to be candidates: all in metres.
#[derive(Clone, Copy, Debug)]
pub(super) struct Distances {
    /// Those that come within this, and
    pub(super) thickness: f64,
    /// this beyond it: twice as far as each vertex may stray along an axis.
    pub(super) beyond: f64,
    pub(super) neighbours: Option<Neighbours>,
}

/// Pairs of cloth whose boxes are near each other at rest.
#[derive(Clone, Copy, Debug)]
pub(super) struct Neighbours {
    /// How near, in metres.
    pub(super) at_rest: f64,
    /// In metres.
    pub(super) thickness: f64,
}

/// Never on two cache lines.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
struct Way {
    start: Vec3A,
    end: Vec3A,
}

impl Sieve {
    /// Neighbours are pairs among vertices below `cloth_vertices`.
    pub(super) fn new(rest: &[DVec3], cloth_vertices: usize, distances: Distances) -> Self {
        let unknown = Way {
            start: Vec3A::ZERO,
            end: Vec3A::ZERO,
        };
        let at_rest = |(vertex, rest): (usize, &DVec3)| {
            if vertex < cloth_vertices {
                rest.as_vec3a()
            } else {
                Vec3A::NAN
            }
        };
        let near = |near: Neighbours| nearness(near.at_rest, largest_coordinate(rest));
        Self {
            ways: vec![unknown; rest.len()],
            rest: match distances.neighbours {
                Some(_) => rest.iter().enumerate().map(at_rest).collect(),
                None => Vec::new(),
            },
            distances,
            clearances: [Clearance::UNKNOWN; 2],
            at_rest: distances.neighbours.map_or(f32::NEG_INFINITY, near),
        }
    }

    /// From here on all is asked about this motion, which is the last one but for vertices that are in `only`, if there are any.
    pub(super) fn set_motion(&mut self, [start, end]: [&[DVec3]; 2], only: Option<&[bool]>) {
        let largest = largest_coordinate(start).larger(largest_coordinate(end));
        let Distances {
            thickness,
            beyond,
            neighbours,
        } = self.distances;
        let of_neighbours = neighbours.map_or(thickness, |near| near.thickness);
        self.clearances = [of_neighbours, thickness].map(|own| Clearance::new(own, beyond, largest, MARGIN as f32));
        for (vertex, way) in self.ways.iter_mut().enumerate() {
            if only.is_none_or(|only| only[vertex]) {
                (way.start, way.end) = (start[vertex].as_vec3a(), end[vertex].as_vec3a());
            }
        }
    }

    /// Whether a pair certainly keeps what is asked for along an axis or the direction between its middles, both at the start and at the
    /// end and with the same order: then it does on straight ways in between as well.
    #[inline(always)]
    pub(super) fn keep_apart(&self, kind: PairKind, vertices: [u32; 4]) -> bool {
        // Written out: `map` would not be inlined here.
        let way = |corner: usize| &self.ways[vertices[corner] as usize];
        let (a, b, c, d) = (way(0), way(1), way(2), way(3));
        let are_neighbours = !self.rest.is_empty() && {
            let rest = |corner: usize| self.rest[vertices[corner] as usize];
            are_boxes_within(kind, [rest(0), rest(1), rest(2), rest(3)], self.at_rest)
        };
        let clearance = &self.clearances[usize::from(!are_neighbours)];
        clearance.is_kept(kind, [a.start, b.start, c.start, d.start], [a.end, b.end, c.end, d.end])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sleeve::sleeve;
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

    fn first(kind: PairKind, corner: usize) -> bool {
        corner < if kind == PairKind::EdgeEdge { 2 } else { 1 }
    }

    fn kind(is_edge: bool) -> PairKind {
        if is_edge { PairKind::EdgeEdge } else { PairKind::VertexFace }
    }

    const ALL: [u32; 4] = [0, 1, 2, 3];

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4000))]

        /// Though its vertices stray towards each other, as far as they may.
        #[test]
        fn only_what_keeps_its_thickness_is_left_out(
            start in prop::array::uniform4(point()),
            moves in prop::array::uniform4(point()),
            at_rest in 0.0..1.0_f64,
            thickness in 0.0..0.3_f64,
            beyond in 0.0..0.5_f64,
            share in 0.0..1.0_f64,
            is_edge in any::<bool>(),
        ) {
            let kind = kind(is_edge);
            let rest = start.map(|point| point * 0.7);
            let end = [0, 1, 2, 3].map(|k| start[k] + moves[k] * 0.5);
            let neighbours = Neighbours { at_rest, thickness: thickness * share };
            let left_out = |cloth, neighbours| {
                let mut sieve = Sieve::new(&rest, cloth, Distances { thickness, beyond, neighbours });
                sieve.set_motion([&start, &end], None);
                sieve.keep_apart(kind, ALL)
            };
            let middle = |is_first| -> DVec3 {
                let own = (0..4).filter(|&k| first(kind, k) == is_first);
                let count = own.clone().count() as f64;
                own.map(|k| (start[k] + end[k]) / count).sum()
            };
            let towards_first = (middle(true) - middle(false)).signum() * (0.5 * beyond);
            let strayed = |k: usize| if first(kind, k) { -towards_first } else { towards_first };
            let least = (0..=20).map(|step| {
                let t = f64::from(step) / 20.0;
                let at = [0, 1, 2, 3].map(|k| start[k].lerp(end[k], t) + strayed(k));
                Closest::of(kind, at).distance()
            });
            let least = least.fold(f64::INFINITY, f64::min) * (1.0 + 1e-9);
            prop_assert!(!left_out(4, None) || least > thickness);
            if left_out(4, Some(neighbours)) {
                prop_assert!(least > neighbours.thickness);
                prop_assert!(are_neighbours(kind, rest, at_rest) || least > thickness);
            }
            // A pair with a body is none of neighbours.
            let with_body = left_out(if is_edge { 2 } else { 1 }, Some(neighbours));
            prop_assert!(!with_body || least > thickness);
        }

        #[test]
        fn what_keeps_more_than_is_asked_along_an_axis_is_left_out(
            start in prop::array::uniform4(point()),
            thickness in 0.0..0.5_f64,
            share in 0.0..1.0_f64,
            is_edge in any::<bool>(),
        ) {
            let kind = kind(is_edge);
            let far = |by: f64| [0, 1, 2, 3].map(|k| start[k] + DVec3::X * if first(kind, k) { by } else { 0.0 });
            let neighbours = Neighbours { at_rest: 3.0, thickness: thickness * share };
            let distances = Distances { thickness, beyond: 0.1, neighbours: Some(neighbours) };
            let mut sieve = Sieve::new(&start, 4, distances);
            let asked = 2.0 + neighbours.thickness + 0.1;
            sieve.set_motion([&far(asked + 1e-4), &far(asked + 1.0)], None);
            prop_assert!(sieve.keep_apart(kind, ALL));
        }

        /// Two triangles side by side, in any position: boxes along the axes may overlap, but the sets keep nearly a height apart.
        #[test]
        fn pairs_of_triangles_side_by_side_are_left_out(
            turn in prop::array::uniform4(-1.0..1.0_f64),
            bend in -0.5..0.5_f64,
            is_edge in any::<bool>(),
        ) {
            let turn = selvedge_core::glam::DQuat::from_array(turn);
            prop_assume!(turn.length() > 0.1);
            let height = 0.75_f64.sqrt();
            let [left, right] = [DVec3::new(-0.5, 0.0, 0.0), DVec3::new(0.5, 0.0, 0.0)];
            let below = DVec3::new(0.0, -height, 0.0);
            let above = DVec3::new(0.0, height * bend.cos(), height * bend.sin());
            let points = if is_edge {
                // Two sides of the strip's hexagon.
                [above, above + DVec3::X, left, right]
            } else {
                [above, left, right, below]
            };
            let points = points.map(|point| turn.normalize() * point);
            let distances = Distances { thickness: 0.16, beyond: 0.05, neighbours: None };
            let mut sieve = Sieve::new(&points, 4, distances);
            sieve.set_motion([&points, &points], None);
            prop_assert!(sieve.keep_apart(kind(is_edge), ALL));
        }
    }
}
