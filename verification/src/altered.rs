//! Core's kernels with other constants in their error bounds, to show what each constant is there for.
//!
//! The kernels are generic over [`Lanes`], so their source runs on [`Altered`] unchanged.

use crate::generator::{Format, PairCase};
use selvedge_core::PairKind;
use selvedge_core::elementary::advance::time_of_impact_of_points;
use selvedge_core::elementary::{Impact, Limits};
#[cfg(doc)]
use selvedge_core::verification::coplanarity::MovingTetrahedron;
use selvedge_core::verification::lanes::{Lanes, Rounding};
use selvedge_core::verification::of_kind;
use selvedge_core::verification::points::{PairPoints, PairShape};
use selvedge_core::verification::vector::Vector;
use std::cmp::Ordering;
use std::marker::PhantomData;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// What the constants of [`Rounding`] are multiplied by.
pub trait Factors {
    /// Times the unit roundoff.
    const UNIT_ROUNDOFF: f64 = 1.0;
    /// Times η.
    const UNDERFLOW: f64 = 1.0;
    /// Times the largest edge.
    const LARGEST_EDGE: f64 = 1.0;
}

/// The same number, but with other constants.
pub struct Altered<F, S>(S, PhantomData<F>);

impl<F, S> Altered<F, S> {
    const fn new(number: S) -> Self {
        Self(number, PhantomData)
    }
}

impl<F, S: Copy> Clone for Altered<F, S> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<F, S: Copy> Copy for Altered<F, S> {}

impl<F, S: Format> Add for Altered<F, S> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(self.0 + other.0)
    }
}

impl<F, S: Format> Sub for Altered<F, S> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::new(self.0 - other.0)
    }
}

impl<F, S: Format> Mul for Altered<F, S> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self::new(self.0 * other.0)
    }
}

impl<F, S: Format> Div for Altered<F, S> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        Self::new(self.0 / other.0)
    }
}

impl<F, S: Format> PartialEq for Altered<F, S> {
    fn eq(&self, other: &Self) -> bool {
        self.0 == other.0
    }
}

impl<F, S: Format> PartialOrd for Altered<F, S> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.0.partial_cmp(&other.0)
    }
}

impl<F, S: Format> Neg for Altered<F, S> {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.0)
    }
}

/// As they are: a generic constant cannot be multiplied. [`Lanes::splat`] does it, through which all constants come.
impl<F, S: Format> Rounding for Altered<F, S> {
    const UNIT_ROUNDOFF: Self = Self::new(S::UNIT_ROUNDOFF);
    const UNDERFLOW: Self = Self::new(S::UNDERFLOW);
    const LARGEST_EDGE: Self = Self::new(S::LARGEST_EDGE);
    const LARGEST_EXTENT: Self = Self::new(S::LARGEST_EXTENT);
    const EXTENT_UNDERFLOW: Self = Self::new(S::EXTENT_UNDERFLOW);
    const SAFE_SQUARE: Self = Self::new(S::SAFE_SQUARE);
    const LENGTH_UNDERFLOW: Self = Self::new(S::LENGTH_UNDERFLOW);
    const ZERO: Self = Self::new(S::ZERO);
    const ONE: Self = Self::new(S::ONE);
    const HALF: Self = Self::new(S::HALF);
    const INFINITY: Self = Self::new(S::INFINITY);
    fn small(count: u8) -> Self {
        Self::new(S::small(count))
    }
}

impl<F: Factors, S: Format> Lanes for Altered<F, S> {
    type Scalar = Self;
    type Mask = bool;
    fn splat(self, Self(value, _): Self) -> Self {
        let factor = if value == S::UNIT_ROUNDOFF {
            F::UNIT_ROUNDOFF
        } else if value == S::UNDERFLOW {
            F::UNDERFLOW
        } else if value == S::LARGEST_EDGE {
            F::LARGEST_EDGE
        } else {
            return Self::new(value);
        };
        Self::new(value * S::from_f64(factor))
    }
    fn any(mask: bool) -> bool {
        mask
    }
    fn sqrt(self) -> Self {
        Self::new(self.0.sqrt())
    }
    fn abs(self) -> Self {
        Self::new(self.0.abs())
    }
    fn larger(self, other: Self) -> Self {
        Self::new(self.0.larger(other.0))
    }
    fn smaller(self, other: Self) -> Self {
        Self::new(self.0.smaller(other.0))
    }
    fn greater(self, other: Self) -> bool {
        self.0.greater(other.0)
    }
    fn at_most(self, other: Self) -> bool {
        self.0.at_most(other.0)
    }
    fn select(mask: bool, if_true: Self, if_false: Self) -> Self {
        if mask { if_true } else { if_false }
    }
    fn may_leave(open: bool) -> bool {
        !open
    }
}

fn altered<F: Factors, S: Format>(points: &PairPoints<S>) -> PairPoints<Altered<F, S>> {
    let number = Altered::<F, S>::new;
    let altered = |v: Vector<S>| Vector::new(number(v.x), number(v.y), number(v.z));
    PairPoints {
        start: points.start.map(altered),
        end: points.end.map(altered),
    }
}

/// The pair's time of impact, with the constants of its bounds times `F`. (A subnormal separation is not raised.)
pub fn time_of_impact<F: Factors, S: Format>(pair: &PairCase<S>, limits: &Limits<S>) -> Impact<S> {
    let limits = Limits {
        tolerance: Altered::new(limits.tolerance),
        separation: Altered::new(limits.separation),
    };
    let points = altered::<F, S>(&(&pair.pair()).into());
    let impact = of_kind!(pair.kind, P => time_of_impact_of_points::<P, _>(&points, &limits).0);
    match impact {
        Impact::Never => Impact::Never,
        Impact::Possible { time, reason } => Impact::Possible { time: time.0, reason },
    }
}

/// A kernel whose bound has constants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kernel {
    /// [`is_never_coplanar`](MovingTetrahedron::is_never_coplanar).
    NonCoplanarity,
    /// [`have_disjoint_primitive_boxes`](PairPoints::have_disjoint_primitive_boxes); keeps EE.
    Segment,
}

impl Kernel {
    /// All kernels that are certified.
    pub const CERTIFIED: [Self; 2] = [Self::NonCoplanarity, Self::Segment];

    /// Whether the kernel culls the pair, with its constants times `F`.
    pub fn culls<F: Factors, S: Format>(self, pair: &PairCase<S>) -> bool {
        of_kind!(pair.kind, P => self.on::<P, F, S>(&(&pair.pair()).into()))
    }

    fn on<P: PairShape, F: Factors, S: Format>(self, points: &PairPoints<S>) -> bool {
        let points = altered::<F, S>(points);
        match self {
            Self::NonCoplanarity => points.tetrahedron::<P>().is_never_coplanar(),
            Self::Segment => P::KIND == PairKind::VertexFace && points.have_disjoint_primitive_boxes::<P>(),
        }
    }
}
