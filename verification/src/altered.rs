//! Core's kernels with other constants in their error bounds, which shows why each constant is needed.

use crate::generator::{Format, PairCase};
use selvedge_core::altered::{self, Constants};
#[cfg(doc)]
use selvedge_core::kernels::coplanarity::MovingTetrahedron;
#[cfg(doc)]
use selvedge_core::kernels::lanes::Rounding;
use selvedge_core::kernels::of_kind;
use selvedge_core::kernels::points::{PairPoints, PairShape};
use selvedge_core::{PairKind, Scalar};
use std::marker::PhantomData;

/// The factors by which the constants of [`Rounding`] are multiplied.
pub trait Factors {
    const UNIT_ROUNDOFF: f64 = 1.0;
    const UNDERFLOW: f64 = 1.0;
    const LARGEST_EDGE: f64 = 1.0;
}

/// The constants of a format, multiplied.
struct Multiplied<F>(PhantomData<F>);

impl<F: Factors> Constants for Multiplied<F> {
    fn altered<S: Scalar>(constant: S) -> S {
        let factor = if constant == S::UNIT_ROUNDOFF {
            F::UNIT_ROUNDOFF
        } else if constant == S::UNDERFLOW {
            F::UNDERFLOW
        } else if constant == S::LARGEST_EDGE {
            F::LARGEST_EDGE
        } else {
            return constant;
        };
        constant * S::from_f64(factor)
    }
}

type Altered<F, S> = altered::Altered<Multiplied<F>, S>;

/// A kernel whose bound has constants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kernel {
    /// [`is_never_coplanar`](MovingTetrahedron::is_never_coplanar).
    NonCoplanarity,
    /// [`have_disjoint_primitive_boxes`](PairPoints::have_disjoint_primitive_boxes), which keeps EE.
    Segment,
}

impl Kernel {
    /// Returns whether the kernel culls the pair, with its constants times `F`.
    pub fn culls<F: Factors, S: Format>(self, pair: &PairCase<S>) -> bool {
        of_kind!(pair.kind, P => self.on::<P, F, S>(&Altered::points(&pair.pair())))
    }

    fn on<P: PairShape, F: Factors, S: Format>(self, points: &PairPoints<Altered<F, S>>) -> bool {
        match self {
            Self::NonCoplanarity => points.tetrahedron::<P>().is_never_coplanar(),
            Self::Segment => P::KIND == PairKind::VertexFace && points.have_disjoint_primitive_boxes::<P>(),
        }
    }
}
