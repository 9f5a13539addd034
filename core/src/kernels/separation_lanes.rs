//! A separation that may be zero, in lanes.

use crate::lanes::{Lanes, Rounding};

/// The separation that pairs must exceed, the same in each lane. Zero means that they must not touch.
///
/// The number of an `Option` that is `None` is undefined. The compiler may multiply it before the test for `Some`, and then
/// multiplies whatever the stack holds. The product is thrown away, but with a subnormal number it takes more than a hundred
/// cycles, which doubled the time of the filter. Here the number is always defined. `no-std-check/check.sh` searches the compiled
/// code for operations on undefined numbers.
#[derive(Clone, Copy, Debug)]
pub struct SeparationLanes<L> {
    is_positive: bool,
    length: L,
}

impl<L: Lanes> SeparationLanes<L> {
    /// Makes a separation of zero.
    #[inline(always)]
    #[must_use]
    pub fn zero(like: L) -> Self {
        Self {
            is_positive: false,
            length: like.splat(L::Scalar::ZERO),
        }
    }

    /// Makes a separation of `length`. It must be finite; if it is not positive, the separation is zero.
    #[inline(always)]
    #[must_use]
    pub fn new(length: L::Scalar, like: L) -> Self
    where
        L::Scalar: PartialOrd,
    {
        Self {
            is_positive: length > L::Scalar::ZERO,
            length: like.splat(length),
        }
    }

    /// Returns whether it is positive.
    #[inline(always)]
    #[must_use]
    pub const fn is_positive(&self) -> bool {
        self.is_positive
    }

    /// Returns the separation.
    #[inline(always)]
    #[must_use]
    pub const fn length(&self) -> L {
        self.length
    }

    /// Returns the product with a factor that is computed only if the separation is positive; otherwise zero, in each lane.
    #[inline(always)]
    #[must_use]
    pub fn times(&self, factor: impl FnOnce() -> L) -> Self {
        let Self { is_positive, length } = *self;
        let length = if is_positive { length * factor() } else { length };
        Self { is_positive, length }
    }
}
