//! Moving boxes for listed pairs: the first test of each, as in the hierarchies.
//!
//! ```text
//! once a step   the f32 box of each vertex, edge and face at the start and at the end      64 bytes, one cache line
//! each pair     one comparison of sixteen numbers:
//!
//!   second      start: lower x y z, −upper x y z, –, –     end: lower x y z, −upper x y z, –, –
//!   first       start: upper x y z, −lower x y z, ∞, ∞     end: upper x y z, −lower x y z, ∞, ∞
//!               apart if the second is above the first in one of the six at the start, and in the same at the end
//! ```
//!
//! Other tests gather the rows of four vertices; this one reads two cache lines for each pair, without a branch. A dropped pair
//! is certainly apart: see [boxes](selvedge_core::boxes::moving) and their [mapping](selvedge_core::boxes::mapping).

use crate::broad_phase::mapping_within;
use crate::mesh::Topology;
use crate::simd::Level;
use crate::step::Motions;
use selvedge_core::PairKind;
use selvedge_core::batch::{Compares, Loop, in_lanes};
use selvedge_core::boxes::moving::MovingBox;

/// A moving box as one row of sixteen numbers: lower and negated upper corner at the start, and at the end.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
struct Row([f32; 16]);

impl Row {
    /// Makes the row of the second primitive of a pair.
    fn second(moving: &MovingBox<f32>) -> Self {
        let [a, b, c] = moving.start.lower;
        let [d, e, f] = moving.start.upper;
        let [g, h, i] = moving.end.lower;
        let [j, k, l] = moving.end.upper;
        let none = 0.0;
        Self([a, b, c, -d, -e, -f, none, none, g, h, i, -j, -k, -l, none, none])
    }

    /// Makes the row of the first primitive of a pair: the limits that the second must exceed.
    fn first(moving: &MovingBox<f32>) -> Self {
        let [a, b, c] = moving.start.lower;
        let [d, e, f] = moving.start.upper;
        let [g, h, i] = moving.end.lower;
        let [j, k, l] = moving.end.upper;
        let none = f32::INFINITY;
        Self([d, e, f, -a, -b, -c, none, none, j, k, l, -g, -h, -i, none, none])
    }
}

/// The moving boxes of a mesh's primitives in one step.
#[derive(Debug, Default)]
pub(super) struct PrimitiveBoxes {
    vertex_boxes: Vec<MovingBox<f32>>,
    /// The boxes of first primitives, for VF and EE pairs.
    firsts: [Vec<Row>; 2],
    seconds: [Vec<Row>; 2],
}

impl PrimitiveBoxes {
    /// Makes the boxes of a step. Pairs whose boxes are apart are farther apart than `separation`.
    pub(super) fn fit(&mut self, topology: &Topology, motions: &dyn Motions, separation: f64) {
        let mapping = mapping_within(motions, separation);
        let moving = (0..motions.len()).map(|vertex| motions.motion(vertex));
        self.vertex_boxes.clear();
        self.vertex_boxes
            .extend(moving.map(|motion| mapping.vertex(motion.start.into(), motion.end.into())));
        let boxes = &self.vertex_boxes;
        let of = |vertex: u32| &boxes[vertex as usize];
        let [vertices, first_edges] = &mut self.firsts;
        let [faces, second_edges] = &mut self.seconds;
        for rows in [&mut *vertices, first_edges, faces, second_edges] {
            rows.clear();
        }
        vertices.extend(boxes.iter().map(Row::first));
        for &[a, b] in topology.edges() {
            let moving = of(a).merged(of(b));
            first_edges.push(Row::first(&moving));
            second_edges.push(Row::second(&moving));
        }
        let triangles = topology.triangles().iter();
        faces.extend(triangles.map(|&[a, b, c]| Row::second(&of(a).merged(of(b)).merged(of(c)))));
    }

    /// Returns the pairs of the mesh that are not certainly apart, in the same order; `near` holds them.
    pub(super) fn select_near<'a>(
        &self,
        level: Level,
        kind: PairKind,
        pairs: &[[u32; 2]],
        near: &'a mut Vec<[u32; 2]>,
    ) -> &'a [[u32; 2]] {
        near.clear();
        near.resize(pairs.len(), [0; 2]);
        let select = SelectNear {
            firsts: &self.firsts[kind as usize],
            seconds: &self.seconds[kind as usize],
            pairs,
            near,
        };
        let count = in_lanes(level, select);
        &near[..count]
    }
}

/// A kernel that moves near pairs to the front of `near`, which is as long as `pairs`, and returns their number.
struct SelectNear<'a> {
    firsts: &'a [Row],
    seconds: &'a [Row],
    pairs: &'a [[u32; 2]],
    near: &'a mut [[u32; 2]],
}

impl Loop for SelectNear<'_> {
    type Output = usize;

    #[inline(always)]
    fn run(self, lanes: impl Compares) -> usize {
        let mut kept = 0;
        for &pair in self.pairs {
            let [first, second] = pair;
            let (limit, second) = (&self.firsts[first as usize], &self.seconds[second as usize]);
            let above = lanes.above(&second.0, &limit.0);
            self.near[kept] = pair;
            kept += usize::from(above & above >> 8 & 0x3F == 0);
        }
        kept
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::glam::DVec3;
    use crate::simd::available_levels;
    use crate::step::Step;

    /// Tests a triangle and a vertex of a second one, at both ends of the step.
    fn is_near(start: DVec3, end: DVec3, separation: f64) -> bool {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let far = [DVec3::splat(50.0), DVec3::splat(51.0)];
        let topology = Topology::new(6, vec![[0, 1, 2], [3, 4, 5]]).unwrap();
        let frame = |vertex: DVec3| [&corners[..], &[vertex], &far].concat();
        let mut boxes = PrimitiveBoxes::default();
        let (start, end) = (frame(start), frame(end));
        boxes.fit(&topology, &Step::checked(&start, &end, 6).unwrap(), separation);
        let mut answers = available_levels().into_iter().map(|(_, level)| {
            let mut near = Vec::new();
            let near = boxes.select_near(level, PairKind::VertexFace, &[[3, 0]], &mut near);
            !near.is_empty()
        });
        let answer = answers.next().unwrap();
        assert!(answers.all(|other| other == answer));
        answer
    }

    #[test]
    fn a_pair_is_dropped_only_if_one_axis_keeps_its_order() {
        let at = DVec3::new;
        for (start, end, near) in [
            (at(0.2, 0.2, 1.0), at(0.2, 0.2, 0.5), false),
            (at(0.2, 0.2, -1.0), at(0.2, 0.2, -0.5), false),
            (at(0.2, 0.2, 1.0), at(0.2, 0.2, 0.0), true),
            (at(0.2, 0.2, 1.0), at(0.2, 0.2, -1.0), true),
            // The boxes are apart along one axis at the start, along another at the end.
            (at(0.2, 0.2, 1.0), at(-1.0, 0.2, 0.0), true),
            (at(-1.0, 0.2, 1.0), at(-1.0, 0.2, -1.0), false),
            (at(0.2, 1.5, 1.0), at(0.2, 1.1, -1.0), false),
        ] {
            assert_eq!(is_near(start, end, 0.0), near, "{start} {end}");
        }
    }

    #[test]
    fn a_pair_within_the_separation_is_near() {
        let (start, end) = (DVec3::new(0.2, 0.2, 1.0), DVec3::new(0.2, 0.2, 0.5));
        assert!(!is_near(start, end, 0.49));
        assert!(is_near(start, end, 0.51));
    }

    #[test]
    fn pairs_are_kept_in_their_order() {
        let topology = Topology::new(4, vec![[0, 1, 2], [1, 3, 2]]).unwrap();
        let frame = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::ONE];
        let mut boxes = PrimitiveBoxes::default();
        boxes.fit(&topology, &Step::checked(&frame, &frame, 4).unwrap(), 0.0);
        let mut near = Vec::new();
        let pairs = [[3, 1], [0, 1], [3, 0], [1, 0], [2, 1]];
        let level = crate::simd::best_level();
        let near = boxes.select_near(level, PairKind::VertexFace, &pairs, &mut near);
        // Vertex 3 is above the first triangle's box.
        assert_eq!(near, [[3, 1], [0, 1], [1, 0], [2, 1]]);
    }
}
