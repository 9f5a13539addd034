use super::along_nine_directions;
use crate::motion::Motion;
use crate::scalar::Scalar;

/// A swept 18-DOP: bounds along x, y, z and the six diagonals x±y, x±z, y±z (Hutter, Fuhrmann 2007, who keep one for
/// every vertex, edge and triangle and refit them each step).
///
/// Bounds along the diagonals are rounded, and [`overlaps`](Self::overlaps) is exact all the same: see
/// [why sums may round](super#why-sums-may-round). There, along the axes too, bounds must be a gap of
/// [`Rounding::SUM_GAP`](crate::lanes::Rounding::SUM_GAP) apart, which anything but dust absorbs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dop18<S> {
    lower: [S; 9],
    upper: [S; 9],
}

impl<S: Scalar> Dop18<S> {
    /// The bounds of one moving point. Unbounded if a coordinate is NaN or infinite.
    #[inline]
    #[must_use]
    pub fn swept(motion: &Motion<S>) -> Self {
        let [start, end] = motion.ends();
        if !start.iter().chain(&end).all(|coordinate| coordinate.is_finite()) {
            return Self {
                lower: [-S::INFINITY; 9],
                upper: [S::INFINITY; 9],
            };
        }
        let (start, end) = (along_nine_directions(start), along_nine_directions(end));
        let mut dop = Self {
            lower: start,
            upper: start,
        };
        for direction in 0..9 {
            dop.lower[direction] = start[direction].smaller(end[direction]);
            dop.upper[direction] = start[direction].larger(end[direction]);
        }
        dop
    }

    /// The bounds of both together: an edge's from its vertices', a face's from its edges'.
    #[inline]
    #[must_use]
    pub fn merged(&self, other: &Self) -> Self {
        let mut merged = *self;
        for direction in 0..9 {
            merged.lower[direction] = other.lower[direction].smaller(merged.lower[direction]);
            merged.upper[direction] = other.upper[direction].larger(merged.upper[direction]);
        }
        merged
    }

    /// False only if the two sets are certainly apart throughout the step.
    #[inline]
    #[must_use]
    pub fn overlaps(&self, other: &Self) -> bool {
        let mut apart = false;
        for direction in 0..9 {
            // Coordinates as if they were sums: see "compilers" in the documentation of `boxes`.
            let own = self.upper[direction] + S::SUM_GAP;
            let others = other.upper[direction] + S::SUM_GAP;
            apart |= self.lower[direction] > others;
            apart |= other.lower[direction] > own;
        }
        !apart
    }
}
