//! The certified time of impact without its error bounds, as a baseline. **Not certified: it misses contacts.**
//!
//! Core's own source runs on numbers whose unit roundoff is declared to be zero. Every threshold that a computed value must
//! exceed to prove something is then zero, except for η, which covers underflow. A direction is never corrected where its error
//! would tilt it. Nothing else differs. The difference in time, in misses and in late times is what certification costs and what
//! it prevents; `selvedge accuracy` shows it.

use selvedge_core::elementary::advance::time_of_impact_of_points;
use selvedge_core::elementary::{Impact, Limits};
use selvedge_core::verification::lanes::{Lanes, Rounding};
use selvedge_core::verification::of_kind;
use selvedge_core::verification::points::PairPoints;
use selvedge_core::verification::vector::Vector;
use selvedge_core::{PrimitivePair, Scalar};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Returns the time from which the pair is within the separation, as computed. **It may be too late, or miss a contact.**
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

/// A number that is declared free of rounding.
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

macro_rules! constants {
    ($($name:ident),+) => {
        $(const $name: Self = Self(S::$name);)+
    };
}

impl<S: Scalar> Rounding for Unbounded<S> {
    const UNIT_ROUNDOFF: Self = Self(S::ZERO);
    constants!(
        UNDERFLOW,
        LARGEST_EDGE,
        LARGEST_EXTENT,
        EXTENT_UNDERFLOW,
        SAFE_SQUARE,
        LENGTH_UNDERFLOW
    );
    constants!(ZERO, ONE, HALF, INFINITY);

    #[inline(always)]
    fn small(count: u8) -> Self {
        Self(S::small(count))
    }
}

macro_rules! forward {
    ($(fn $name:ident(self $(, $other:ident)?) -> $result:ty => $wrap:expr;)+) => {
        $(
            #[inline(always)]
            fn $name(self $(, $other: Self)?) -> $result {
                $wrap(self.0.$name($($other.0)?))
            }
        )+
    };
}

impl<S: Scalar> Lanes for Unbounded<S> {
    type Scalar = Self;
    type Mask = bool;

    forward! {
        fn sqrt(self) -> Self => Self;
        fn abs(self) -> Self => Self;
        fn larger(self, other) -> Self => Self;
        fn smaller(self, other) -> Self => Self;
        fn greater(self, other) -> bool => bool::from;
        fn at_most(self, other) -> bool => bool::from;
    }

    #[inline(always)]
    fn splat(self, value: Self) -> Self {
        value
    }

    #[inline(always)]
    fn any(mask: bool) -> bool {
        mask
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
