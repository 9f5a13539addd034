//! A segment and a box.

use super::geometry::Point;
use rug::Rational;

/// Returns whether the closed segment meets the closed box, by the part of the segment within each slab, in exact arithmetic.
pub fn segment_meets_box(ends: &[Point<Rational>; 2], [lower, upper]: &[Point<Rational>; 2]) -> bool {
    let (mut enter, mut leave) = (Rational::from(0), Rational::from(1));
    for axis in 0..3 {
        let start = &ends[0][axis];
        let along = Rational::from(&ends[1][axis] - start);
        if along.is_zero() {
            if *start < lower[axis] || *start > upper[axis] {
                return false;
            }
            continue;
        }
        let mut times = [&lower[axis], &upper[axis]].map(|bound| Rational::from(bound - start) / &along);
        times.sort();
        let [first, last] = times;
        enter = enter.max(first);
        leave = leave.min(last);
    }
    enter <= leave
}
