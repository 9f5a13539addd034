//! Checks the promises about a contact's geometry against the motion of four points without rounding.

use super::{Point, dot, point};
use proptest::prelude::*;
use rug::Rational;
use selvedge_core::PairKind;
use selvedge_core::separation::geometry::Geometry;
use selvedge_verification::generator::points_of_first;
use selvedge_verification::oracle::rational;
use selvedge_verification::oracle::within_at_rest;

/// The exact motion of four points.
pub(crate) struct Truth<'a> {
    pub(crate) kind: PairKind,
    pub(crate) time: f64,
    /// Returns the positions at a time.
    pub(crate) at: &'a dyn Fn(f64) -> [Point; 4],
    pub(crate) velocities: [Point; 4],
    /// The largest coordinate. The error of a point may be 96u of it.
    pub(crate) largest: Rational,
    /// The largest difference. The error of the speed may be 256u of it.
    pub(crate) of_speed: Rational,
    /// Further errors of the points of the two sides, and of the difference of the sides' velocities.
    pub(crate) position_errors: [f64; 2],
    pub(crate) velocity_errors: f64,
}

impl Truth<'_> {
    /// Checks everything that is promised. Returns whether there is a normal.
    pub(crate) fn is_promised(&self, found: &Geometry) -> Result<bool, TestCaseError> {
        let unit = rational(f64::EPSILON / 2.0);
        let underflow = rational(f64::MIN_POSITIVE) * 512_u32;
        let first = points_of_first(self.kind);

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
                // Uses differences, since weights add up to one only up to rounding.
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
