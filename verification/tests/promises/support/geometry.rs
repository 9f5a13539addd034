//! What is promised of a contact's geometry, checked against what four points do without rounding.

use super::rationals::rational;
use super::{Point, dot, point};
use proptest::prelude::*;
use rug::Rational;
use selvedge_core::PairKind;
use selvedge_core::separation::geometry::Geometry;
use selvedge_verification::oracle::within_at_rest;

/// What four points do.
pub(crate) struct Truth<'a> {
    pub(crate) kind: PairKind,
    /// When the geometry was asked for.
    pub(crate) time: f64,
    /// Where they are at a time.
    pub(crate) at: &'a dyn Fn(f64) -> [Point; 4],
    /// At `time`.
    pub(crate) velocities: [Point; 4],
    /// The largest coordinate, of which 96u is allowed to a point.
    pub(crate) largest: Rational,
    /// The largest difference, of which 256u is allowed to the speed.
    pub(crate) of_speed: Rational,
    /// By how much the points of the two sides may be off beside that, and by how much the sides' velocities together.
    pub(crate) position_errors: [f64; 2],
    pub(crate) velocity_errors: f64,
}

impl Truth<'_> {
    /// Everything that is promised. Whether there is a normal.
    pub(crate) fn is_promised(&self, found: &Geometry) -> Result<bool, TestCaseError> {
        let unit = rational(f64::EPSILON / 2.0);
        let underflow = rational(f64::MIN_POSITIVE) * 512_u32;
        let first = match self.kind {
            PairKind::VertexFace => 1,
            PairKind::EdgeEdge => 2,
        };

        let at = (self.at)(self.time);
        for (side, corners) in [0..first, first..4].into_iter().enumerate() {
            let weights = &found.weights[corners.clone()];
            prop_assert!(weights.iter().all(|weight| (0.0..=1.0).contains(weight)), "{:?}", weights);
            let sum: Rational = weights.iter().map(|&weight| rational(weight)).sum();
            prop_assert!((sum - 1_u32).abs() <= Rational::from(&unit * 4), "{:?}", weights);
            let mut way = point(found.points[side].to_array());
            for corner in corners {
                for axis in 0..3 {
                    way[axis] -= rational(found.weights[corner]) * &at[corner][axis];
                }
            }
            let bound = Rational::from(&self.largest * &unit) * 96_u32 + &underflow + rational(self.position_errors[side]);
            prop_assert!(dot(&way, &way) <= Rational::from(&bound * &bound), "a point of side {}", side);
        }

        let [from, to] = found.distance;
        let within = |distance: f64| within_at_rest(self.kind, &at, distance);
        prop_assert!(from <= 0.0 || !within(from.next_down()), "nearer than {}", from);
        prop_assert!(to.is_infinite() || within(to), "farther than {}", to);

        let Some(normal) = found.normal else {
            prop_assert!(found.speed == 0.0 && from == 0.0);
            return Ok(false);
        };
        let exact_normal = point(normal.to_array());
        let squared = dot(&exact_normal, &exact_normal);
        let [least, most] = [-16, 16].map(|share| Rational::from(&unit * share) + 1_u32);
        prop_assert!(squared >= least.square() && squared <= most.square(), "of length one");
        prop_assert!((0.0..=self.time).contains(&found.separated_at));
        // The speed of the points with these weights along this normal.
        let mut speed = Rational::new();
        for (corner, velocity) in self.velocities.iter().enumerate() {
            let sign = if corner < first { 1 } else { -1 };
            for axis in 0..3 {
                // Of differences, as weights add up to one but for rounding.
                let way = Rational::from(&velocity[axis] - &self.velocities[0][axis]);
                speed += way * rational(found.weights[corner]) * &exact_normal[axis] * sign;
            }
        }
        let bound = Rational::from(&self.of_speed * &unit) * 256_u32 + underflow + rational(self.velocity_errors);
        prop_assert!((speed - rational(found.speed)).abs() <= bound, "the speed");
        let then = (self.at)(found.separated_at);
        let heights = then.each_ref().map(|there| dot(&exact_normal, there));
        let lowest = heights[..first].iter().min();
        prop_assert!(lowest > heights[first..].iter().max(), "apart along the normal");
        Ok(true)
    }
}
