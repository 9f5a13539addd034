//! Drops candidates that keep apart until the next search.
//!
//! Boxes along three axes leave many pairs that are farther apart than their reach, such as most pairs of triangles side by side.
//! The distance that a pair keeps while its vertices stray is its [clearance](selvedge_core::separation::clearance).

use super::interest::{CLASSES, Class, Interest, Reach};
use crate::buffer::append_selected;
use crate::mesh::Topology;
use crate::simd::{Level, best_level};
use selvedge_core::Motion;
use selvedge_core::PairKind;
use selvedge_core::batch::{VertexRow, largest_strays_from_rows};
use selvedge_core::glam::{DVec3, Vec3};
use selvedge_core::separation::clearance::Clearance;

/// Tests the clearance of pairs that boxes leave, in `f32`.
#[derive(Debug)]
pub(super) struct Sieve {
    level: Level,
    rows: Vec<VertexRow<f32>>,
    /// The clearance that pairs of each class have to keep.
    clearances: [Clearance; CLASSES],
}

/// A pair that the sieve leaves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct SievedPair {
    pub(super) pair: [u32; 2],
    /// The length by which its vertices may stray.
    pub(super) stray: f32,
}

/// The number of pairs that are tested at a time: their vertices and strays are some kilobytes.
const AT_ONCE: usize = 128;

impl Sieve {
    pub(super) fn new(vertices: usize) -> Self {
        Self {
            level: best_level(),
            rows: vec![VertexRow::new(Motion::resting(Vec3::ZERO)); vertices],
            clearances: [Clearance::UNKNOWN; CLASSES],
        }
    }

    /// Sets the motion. If there is an `only`, other vertices keep the last motion. `largest` is the largest coordinate of the
    /// vertices of pairs.
    ///
    /// Returns a gap between boxes: [`leave`](Self::leave) certainly drops a pair of the first class whose boxes keep that gap
    /// along one axis throughout the motion.
    pub(super) fn set_motion(&mut self, reach: &Reach, [start, end]: [&[DVec3]; 2], largest: f64, only: Option<&[bool]>) -> f64 {
        let clearance = |class: Class| Clearance::new(class.distance, largest, class.margin);
        self.clearances = reach.classes.map(clearance);
        for (vertex, row) in self.rows.iter_mut().enumerate() {
            if only.is_none_or(|only| only[vertex]) {
                *row = VertexRow::new(Motion::new(start[vertex].as_vec3(), end[vertex].as_vec3()));
            }
        }
        self.clearances[0].certain_gap(reach.beyond, largest)
    }

    /// Appends to `left` the pairs that do not certainly keep the clearance of their class while their vertices stray by `enough`
    /// ([`Reach::beyond`]).
    pub(super) fn leave(
        &self,
        topology: &Topology,
        interest: &impl Interest,
        enough: f32,
        (kind, pairs): (PairKind, &[[u32; 2]]),
        left: &mut Vec<SievedPair>,
    ) {
        let (mut vertices, mut classes, mut strays) = ([[0; 4]; AT_ONCE], [0; AT_ONCE], [0.0; AT_ONCE]);
        for pairs in pairs.chunks(AT_ONCE) {
            for ((pair, vertices), class) in pairs.iter().zip(&mut vertices).zip(&mut classes) {
                *vertices = topology.vertices_of(kind, *pair);
                *class = interest.class(kind, *vertices) as u8;
            }
            let of_pairs = &vertices[..pairs.len()];
            largest_strays_from_rows(
                self.level,
                kind,
                &self.clearances,
                &self.rows,
                of_pairs,
                &classes,
                &mut strays,
            );
            append_selected(left, pairs, |place, &pair| {
                let stray = strays[place];
                // A NaN keeps nothing apart.
                let keeps_apart = stray >= enough;
                (!keeps_apart, SievedPair { pair, stray })
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::interest::OfClass;
    use super::*;
    use proptest::prelude::*;
    use selvedge_core::separation::closest::ClosestPoints;
    use selvedge_core::separation::largest_coordinate;

    fn point() -> impl Strategy<Value = DVec3> {
        prop::array::uniform3(-1.0..1.0_f64).prop_map(DVec3::from)
    }

    fn first(kind: PairKind, corner: usize) -> bool {
        corner < if kind == PairKind::EdgeEdge { 2 } else { 1 }
    }

    fn kind(is_edge: bool) -> PairKind {
        if is_edge { PairKind::EdgeEdge } else { PairKind::VertexFace }
    }

    fn reach(distances: [f64; CLASSES], margin: f32, beyond: f64) -> Reach {
        Reach {
            classes: distances.map(|distance| Class { distance, margin }),
            beyond,
            spare: 0.0,
            farthest: 1,
            upkeep: 0.0,
            is_graded: false,
        }
    }

    /// Returns whether a pair of all four vertices is dropped, in each class.
    fn left_out(kind: PairKind, reach: &Reach, motion: [&[DVec3]; 2]) -> [bool; CLASSES] {
        let mut sieve = Sieve::new(4);
        let largest = motion.map(largest_coordinate);
        sieve.set_motion(reach, motion, largest[0].max(largest[1]), None);
        let (triangles, edges, pair): (Vec<_>, &[_], _) = match kind {
            PairKind::VertexFace => (vec![[1, 2, 3]], &[], [0, 0]),
            PairKind::EdgeEdge => (vec![], &[[0, 1], [2, 3]], [0, 1]),
        };
        let topology = Topology::with_loose_features(4, triangles, edges, &[]).unwrap();
        [0, 1, 2].map(|class| {
            let mut left = Vec::new();
            let enough = reach.beyond as f32;
            sieve.leave(&topology, &OfClass(class), enough, (kind, &[pair]), &mut left);
            left.is_empty()
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4000))]

        /// The vertices stray towards each other, as far as they may.
        #[test]
        fn only_what_keeps_the_distance_of_its_class_is_left_out(
            start in prop::array::uniform4(point()),
            moves in prop::array::uniform4(point()),
            distance in 0.0..0.3_f64,
            beyond in 0.0..0.5_f64,
            share in 0.0..1.0_f64,
            is_edge in any::<bool>(),
        ) {
            let kind = kind(is_edge);
            let end = [0, 1, 2, 3].map(|k| start[k] + moves[k] * 0.5);
            let distances = [distance * share, distance, distance * 0.5];
            let left_out = left_out(kind, &reach(distances, 0.5, beyond), [&start, &end]);
            let middle = |is_first| -> DVec3 {
                let of_side = (0..4).filter(|&k| first(kind, k) == is_first);
                let count = of_side.clone().count() as f64;
                of_side.map(|k| (start[k] + end[k]) / count).sum()
            };
            let towards_first = (middle(true) - middle(false)).signum() * (0.5 * beyond);
            let strayed = |k: usize| if first(kind, k) { -towards_first } else { towards_first };
            let least = (0..=20).map(|step| {
                let t = f64::from(step) / 20.0;
                let at = [0, 1, 2, 3].map(|k| start[k].lerp(end[k], t) + strayed(k));
                ClosestPoints::from_points(kind, at).distance()
            });
            let least = least.fold(f64::INFINITY, f64::min) * (1.0 + 1e-9);
            for class in 0..CLASSES {
                prop_assert!(!left_out[class] || least > distances[class]);
            }
        }

        #[test]
        fn what_keeps_more_than_is_asked_along_an_axis_is_left_out(
            start in prop::array::uniform4(point()),
            distance in 0.0..0.5_f64,
            share in 0.0..1.0_f64,
            is_edge in any::<bool>(),
        ) {
            let kind = kind(is_edge);
            let far = |by: f64| [0, 1, 2, 3].map(|k| start[k] + DVec3::X * if first(kind, k) { by } else { 0.0 });
            let smaller = distance * share;
            let asked = 2.0 + smaller + 0.1;
            let reach = reach([smaller, distance, distance], 0.5, 0.1);
            prop_assert!(left_out(kind, &reach, [&far(asked + 1e-4), &far(asked + 1.0)])[0]);
        }

        /// Boxes may then leave the pair out as well.
        #[test]
        fn what_has_the_certain_gap_between_its_boxes_is_left_out(
            start in prop::array::uniform4(point()),
            moves in prop::array::uniform4(point()),
            distance in 0.0..0.5_f64,
            beyond in 1e-6..0.5_f64,
            axis in 0..3_usize,
            is_edge in any::<bool>(),
        ) {
            let kind = kind(is_edge);
            let end = [0, 1, 2, 3].map(|k| start[k] + moves[k]);
            // The second set is put ahead of the first one at both ends.
            let ahead = |points: [DVec3; 4], gap: f64| {
                let of_set = |is_first| (0..4).filter(move |&k| first(kind, k) == is_first).map(|k| points[k][axis]);
                let by = of_set(true).fold(f64::MIN, f64::max) + gap - of_set(false).fold(f64::MAX, f64::min);
                [0, 1, 2, 3].map(|k| points[k] + DVec3::AXES[axis] * if first(kind, k) { 0.0 } else { by })
            };
            let reach = reach([distance, 1.0, 1.0], 0.5, beyond);
            // No coordinate is larger than this.
            let gap = Sieve::new(4).set_motion(&reach, [&[DVec3::splat(8.0); 4]; 2], 8.0, None);
            let gap = gap * (1.0 + 1e-14) + 1e-14;
            prop_assert!(gap < (distance + beyond) * 1.0001 + 1e-4);
            prop_assert!(left_out(kind, &reach, [&ahead(start, gap), &ahead(end, gap)])[0]);
        }

        /// Boxes of two triangles side by side may overlap in any position, but the sets are nearly a height apart.
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
                // These are two sides of the strip's hexagon.
                [above, above + DVec3::X, left, right]
            } else {
                [above, left, right, below]
            };
            let points = points.map(|point| turn.normalize() * point);
            // This is a margin as in cloth simulation.
            let reach = reach([0.16; CLASSES], 2.0 / 3.0, 0.05);
            prop_assert!(left_out(kind(is_edge), &reach, [&points, &points])[1]);
        }
    }
}
