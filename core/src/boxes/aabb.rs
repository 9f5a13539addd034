use crate::motion::Motion;
use crate::scalar::Scalar;

/// An axis-aligned box. Touching boxes overlap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb<S> {
    /// Smallest coordinates.
    pub lower: [S; 3],
    /// Largest coordinates.
    pub upper: [S; 3],
}

impl<S: Scalar> Aabb<S> {
    /// Nothing: [`merged`](Self::merged) with another box gives that box. It overlaps nothing finite.
    #[must_use]
    pub fn empty() -> Self {
        Self {
            lower: [S::INFINITY; 3],
            upper: [-S::INFINITY; 3],
        }
    }

    /// All of space.
    #[must_use]
    pub fn everything() -> Self {
        Self {
            lower: [-S::INFINITY; 3],
            upper: [S::INFINITY; 3],
        }
    }

    /// The smallest box that holds all of `motions` throughout the step, exactly: linear motion stays between its
    /// ends. All of space if a coordinate is NaN or infinite, so that nothing is culled by it.
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

    /// The smallest box that holds both.
    #[inline]
    #[must_use]
    pub fn merged(&self, other: &Self) -> Self {
        let mut both = *self;
        both.merge(other);
        both
    }

    /// Becomes the smallest box that holds both.
    #[inline]
    pub fn merge(&mut self, other: &Self) {
        for axis in 0..3 {
            self.lower[axis] = other.lower[axis].smaller(self.lower[axis]);
            self.upper[axis] = other.upper[axis].larger(self.upper[axis]);
        }
    }

    /// Whether the closed boxes share a point. Exact.
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

    /// Whether along each axis the gap between the boxes, rounded, is at most `distance`; not where a coordinate of a gap is NaN.
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
