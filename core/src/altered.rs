//! Numbers with other rounding constants, to show why each constant is needed.
//!
//! The kernels are generic over [`Lanes`], so their source runs on [`Altered`] unchanged.

use crate::elementary::advance::{ROUNDS, time_of_impact_of_points};
use crate::elementary::{Impact, Limits};
use crate::lanes::{Lanes, Rounding};
use crate::motion::PrimitivePair;
use crate::points::PairPoints;
use crate::scalar::Scalar;
use crate::vector::Vector;
use core::cmp::Ordering;
use core::marker::PhantomData;
use core::ops::{Add, Div, Mul, Neg, Sub};

/// The constants of [`Altered`] numbers.
pub trait Constants {
    /// True if operations count as free of rounding: the unit roundoff is zero.
    const IS_EXACT: bool = false;

    /// Alters a constant of [`Rounding`] where a kernel takes it by [`Lanes::splat`].
    #[inline(always)]
    fn altered<S: Scalar>(constant: S) -> S {
        constant
    }
}

/// A number of a format whose constants are altered.
pub struct Altered<C, S>(pub S, PhantomData<C>);

impl<C, S> Altered<C, S> {
    /// Makes the same number with the constants `C`.
    #[inline(always)]
    pub const fn new(number: S) -> Self {
        Self(number, PhantomData)
    }
}

impl<C: Constants, S: Scalar> Altered<C, S> {
    /// Returns a pair's points in such numbers.
    #[inline(always)]
    #[must_use]
    pub fn points(pair: &PrimitivePair<S>) -> PairPoints<Self> {
        let PairPoints { start, end } = PairPoints::from(pair);
        let altered = |v: Vector<S>| Vector::new(Self::new(v.x), Self::new(v.y), Self::new(v.z));
        PairPoints {
            start: start.map(altered),
            end: end.map(altered),
        }
    }
}

/// Computes the time of impact with the constants `C`. A subnormal separation is not raised.
#[inline(always)]
pub fn time_of_impact<C: Constants, S: Scalar>(pair: &PrimitivePair<S>, limits: &Limits<S>) -> Impact<S> {
    let limits = Limits {
        tolerance: Altered::<C, S>::new(limits.tolerance),
        separation: Altered::new(limits.separation),
    };
    match of_kind!(pair.kind, P => time_of_impact_of_points::<P, _>(&Altered::points(pair), &limits, ROUNDS).0) {
        Impact::Never => Impact::Never,
        Impact::Possible { time, reason } => Impact::Possible { time: time.0, reason },
    }
}

impl<C, S: Copy> Clone for Altered<C, S> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}

impl<C, S: Copy> Copy for Altered<C, S> {}

impl<C, S: Scalar> PartialEq for Altered<C, S> {
    #[inline(always)]
    fn eq(&self, other: &Self) -> bool {
        self.0 == other.0
    }
}

impl<C, S: Scalar> PartialOrd for Altered<C, S> {
    #[inline(always)]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.0.partial_cmp(&other.0)
    }
}

macro_rules! operator {
    ($trait:ident, $function:ident) => {
        impl<C, S: Scalar> $trait for Altered<C, S> {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                Self::new($trait::$function(self.0, other.0))
            }
        }
    };
}

operator!(Add, add);
operator!(Sub, sub);
operator!(Mul, mul);
operator!(Div, div);

impl<C, S: Scalar> Neg for Altered<C, S> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self::new(-self.0)
    }
}

macro_rules! constants {
    ($($name:ident),+) => {
        $(const $name: Self = Self::new(S::$name);)+
    };
}

impl<C: Constants, S: Scalar> Rounding for Altered<C, S> {
    const UNIT_ROUNDOFF: Self = Self::new(if C::IS_EXACT { S::ZERO } else { S::UNIT_ROUNDOFF });
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
        Self::new(S::small(count))
    }
}

impl<C: Constants, S: Scalar> Lanes for Altered<C, S> {
    type Scalar = Self;
    type Mask = bool;

    #[inline(always)]
    fn splat(self, value: Self) -> Self {
        Self::new(C::altered(value.0))
    }

    #[inline(always)]
    fn any(mask: bool) -> bool {
        mask
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self::new(self.0.sqrt())
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self::new(self.0.abs())
    }

    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        Self::new(self.0.larger(other.0))
    }

    #[inline(always)]
    fn smaller(self, other: Self) -> Self {
        Self::new(self.0.smaller(other.0))
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
