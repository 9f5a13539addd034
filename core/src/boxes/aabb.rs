use crate::motion::Motion;
use crate::scalar::Scalar;

/// An axis-aligned box. Touching boxes overlap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb<S> {
    /// The smallest coordinates.
    pub lower: [S; 3],
    /// The largest coordinates.
    pub upper: [S; 3],
}

impl<S: Scalar> Aabb<S> {
    /// Returns the box of no points: it overlaps nothing finite. [`merged`](Self::merged) with another box, it gives that box.
    #[must_use]
    pub fn empty() -> Self {
        Self {
            lower: [S::INFINITY; 3],
            upper: [-S::INFINITY; 3],
        }
    }

    /// Returns the box of all space.
    #[must_use]
    pub fn everything() -> Self {
        Self {
            lower: [-S::INFINITY; 3],
            upper: [S::INFINITY; 3],
        }
    }

    /// Returns the smallest box that holds all of `motions` throughout the step. It is exact, since linear motion stays between
    /// its ends. The result is all of space if a coordinate is NaN or infinite, so that it culls nothing.
    ///
    /// ```
    /// use selvedge_core::{boxes::Aabb, Motion};
    /// let swept = Aabb::<f64>::swept(&[([0.0, 0.0, 0.0], [1.0, -1.0, 0.0]).into()]);
    /// assert_eq!((swept.lower, swept.upper), ([0.0, -1.0, 0.0], [1.0, 0.0, 0.0]));
    /// ```
    #[inline]
    #[must_use]
    pub fn swept(motions: &[Motion<S>]) -> Self {
        let mut swept = Self::empty();
        let mut finite = true;
        for motion in motions {
            for position in motion.ends() {
                for axis in 0..3 {
                    finite &= position[axis].is_finite();
                    swept.lower[axis] = position[axis].smaller(swept.lower[axis]);
                    swept.upper[axis] = position[axis].larger(swept.upper[axis]);
                }
            }
        }
        if finite { swept } else { Self::everything() }
    }

    /// Returns the smallest box that holds both.
    #[inline]
    #[must_use]
    pub fn merged(&self, other: &Self) -> Self {
        let mut both = *self;
        both.merge(other);
        both
    }

    /// Grows to the smallest box that holds both.
    #[inline]
    pub fn merge(&mut self, other: &Self) {
        for axis in 0..3 {
            self.lower[axis] = other.lower[axis].smaller(self.lower[axis]);
            self.upper[axis] = other.upper[axis].larger(self.upper[axis]);
        }
    }

    /// Returns whether the closed boxes share a point. This is exact.
    #[inline]
    #[must_use]
    pub fn overlaps(&self, other: &Self) -> bool {
        let mut apart = false;
        for axis in 0..3 {
            apart |= self.lower[axis] > other.upper[axis];
            apart |= other.lower[axis] > self.upper[axis];
        }
        !apart
    }

    /// Returns whether the gap between the boxes, rounded, is at most `distance` along each axis. It is false if a gap is NaN.
    #[inline]
    #[must_use]
    pub fn is_within(&self, other: &Self, distance: S) -> bool {
        let mut within = true;
        for axis in 0..3 {
            within &= self.lower[axis] - other.upper[axis] <= distance;
            within &= other.lower[axis] - self.upper[axis] <= distance;
        }
        within
    }
}
