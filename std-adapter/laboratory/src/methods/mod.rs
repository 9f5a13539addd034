//! **The one table of methods**: what is measured, what it is called, and how it is run. Pipelines, studies and reports read it.
//!
//! | list | of what | who reads it |
//! |---|---|---|
//! | [`Preset`] | whole steps: the published methods, and ours, as [`Stages`] | the pipeline, `cull`, `compare`, `scaling` |
//! | [`QueryMethod`] | single pairs: a stage alone, or ours as a whole | `queries`, `hard-cases` |
//! | [`CullingTest`] | tests that drop pairs, a [`Stage`] each | the two above |
//! | [`MeasuredFilter`] | non-coplanarity filters, with and without proof | `accuracy`, and the culling tests that are such |
//! | [`ElementaryTest`] | tests that tell contacts | `accuracy`, and the first two |
//!
//! A row says its name, what it promises and which function it is, once.

mod culling;
mod elementary;
mod filter;
mod preset;
mod query;
mod table;

pub use culling::{CullingTest, Stage};
pub use elementary::ElementaryTest;
pub use filter::MeasuredFilter;
pub use preset::{Preset, Redundancy, Source, Stages, UnknownPreset};
pub use query::{QueryMethod, UnknownMethod};

use selvedge_core::batch::BatchTest;
use selvedge_core::{PrimitivePair, Scalar};

/// What is done with a test of one pair. It is compiled for each test alone, so that times compare: a test takes a few nanoseconds.
pub(crate) trait WithTest<S: Scalar, A> {
    /// What comes of it.
    type Outcome;

    /// Does it with a test that answers `A`.
    fn with(self, test: impl Fn(&PrimitivePair<S>) -> A) -> Self::Outcome;
}

/// The same with a test of sixteen pairs side by side.
pub(crate) trait WithLanes<S: Scalar> {
    fn with(self, test: impl BatchTest<S>);
}

/// Asks a test about this pair.
struct Ask<'a, S: Scalar>(&'a PrimitivePair<S>);

impl<S: Scalar, A> WithTest<S, A> for Ask<'_, S> {
    type Outcome = A;

    #[inline(always)]
    fn with(self, test: impl Fn(&PrimitivePair<S>) -> A) -> A {
        test(self.0)
    }
}
