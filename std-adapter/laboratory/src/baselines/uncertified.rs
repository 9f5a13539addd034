//! The certified time of impact without its error bounds. **Not certified: it misses contacts.** A baseline.
//!
//! Core's own source runs on numbers whose unit roundoff is said to be zero: every bar that a computed value must exceed to prove
//! something is zero (but for η, which covers underflow), and a direction is never set upright where its error would tilt it; nothing
//! else differs. So the difference in time, in misses and in
//! times that are too late is what certification costs, and what it is for. `selvedge accuracy` shows it.

use selvedge_core::elementary::advance::time_of_impact_of_points;
use selvedge_core::elementary::{Impact, Limits};
use selvedge_core::verification::lanes::{Lanes, Rounding};
use selvedge_core::verification::of_kind;
use selvedge_core::verification::points::PairPoints;
use selvedge_core::verification::vector::Vector;
use selvedge_core::{PrimitivePair, Scalar};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// From when on the pair is found within the separation, as computed. **May be too late, or miss a contact.**
///
/// ```
/// use selvedge_core::elementary::Limits;
/// use selvedge_core::{glam::DVec3, Motion, PrimitivePair};
/// use selvedge_laboratory::baselines::uncertified;
/// let pair = PrimitivePair::vertex_face(
///     Motion::new(DVec3::new(0.2, 0.2, 1.0), DVec3::new(0.2, 0.2, -1.0)),
///     [DVec3::ZERO, DVec3::X, DVec3::Y].map(Motion::resting),
/// );
/// let time = uncertified::time_of_impact(&pair, &Limits::default()).time().unwrap();
/// assert!((time - 0.5).abs() < 1e-9);
/// ```
#[inline]
pub fn time_of_impact<S: Scalar>(pair: &PrimitivePair<S>, limits: &Limits<S>) -> Impact<S> {
    let points = PairPoints::from(pair);
    let unbounded = |v: Vector<S>| Vector::new(Unbounded(v.x), Unbounded(v.y), Unbounded(v.z));
    let points = PairPoints {
        start: points.start.map(unbounded),
        end: points.end.map(unbounded),
    };
    let limits = Limits {
        tolerance: Unbounded(limits.tolerance),
        separation: Unbounded(limits.separation),
    };
    match of_kind!(pair.kind, P => time_of_impact_of_points::<P, _>(&points, &limits).0) {
        Impact::Never => Impact::Never,
        Impact::Possible { time, reason } => Impact::Possible { time: time.0, reason },
    }
}

/// A number that is said never to be rounded.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
struct Unbounded<S>(S);

macro_rules! operation {
    ($trait:ident, $method:ident) => {
        impl<S: Scalar> $trait for Unbounded<S> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self($trait::$method(self.0, other.0))
            }
        }
    };
}

operation!(Add, add);
operation!(Sub, sub);
operation!(Mul, mul);
operation!(Div, div);

impl<S: Scalar> Neg for Unbounded<S> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl<S: Scalar> Rounding for Unbounded<S> {
    const UNIT_ROUNDOFF: Self = Self(S::ZERO);
    const UNDERFLOW: Self = Self(S::UNDERFLOW);
    const LARGEST_EDGE: Self = Self(S::LARGEST_EDGE);
    const LARGEST_EXTENT: Self = Self(S::LARGEST_EXTENT);
    const EXTENT_UNDERFLOW: Self = Self(S::EXTENT_UNDERFLOW);
    const SAFE_SQUARE: Self = Self(S::SAFE_SQUARE);
    const LENGTH_UNDERFLOW: Self = Self(S::LENGTH_UNDERFLOW);
    const ZERO: Self = Self(S::ZERO);
    const ONE: Self = Self(S::ONE);
    const HALF: Self = Self(S::HALF);
    const INFINITY: Self = Self(S::INFINITY);

    #[inline(always)]
    fn small(count: u8) -> Self {
        Self(S::small(count))
    }
}

impl<S: Scalar> Lanes for Unbounded<S> {
    type Scalar = Self;
    type Mask = bool;

    #[inline(always)]
    fn splat(self, value: Self) -> Self {
        value
    }

    #[inline(always)]
    fn any(mask: bool) -> bool {
        mask
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.abs())
    }

    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        Self(self.0.larger(other.0))
    }

    #[inline(always)]
    fn smaller(self, other: Self) -> Self {
        Self(self.0.smaller(other.0))
    }

    #[inline(always)]
    fn greater(self, other: Self) -> bool {
        self.0.greater(other.0)
    }

    #[inline(always)]
    fn at_most(self, other: Self) -> bool {
        self.0.at_most(other.0)
    }

    #[inline(always)]
    fn select(mask: bool, if_true: Self, if_false: Self) -> Self {
        if mask { if_true } else { if_false }
    }

    #[inline(always)]
    fn may_leave(open: bool) -> bool {
        !open
    }
}
