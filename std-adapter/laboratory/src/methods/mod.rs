//! **The table of methods**: their names, and how they run. Pipelines, studies and reports read it.
//!
//! | list | entries | used by |
//! |---|---|---|
//! | [`Preset`] | whole steps: the published methods, and ours, as [`Stages`] | the pipeline, `cull`, `compare`, `scaling` |
//! | [`QueryMethod`] | single pairs: a stage alone, or ours as a whole | `queries`, `hard-cases` |
//! | [`CullingTest`] | tests that drop pairs, one [`Stage`] each | the two above |
//! | [`MeasuredFilter`] | non-coplanarity filters, with and without proof | `accuracy`, and culling tests that are filters |
//! | [`ElementaryTest`] | tests that find contacts | `accuracy`, and the first two |
//!
//! Each row states a name, a guarantee and a function, once.

mod culling;
mod elementary;
mod filter;
mod preset;
mod query;
mod table;

pub use culling::{CullingTest, Stage};
pub use elementary::ElementaryTest;
pub use filter::MeasuredFilter;
pub use preset::{PairSource, Preset, Redundancy, Stages, UnknownPreset};
pub use query::{QueryMethod, UnknownMethod};

use selvedge_core::batch::BatchTest;
use selvedge_core::{PrimitivePair, Scalar};

/// A use of a test of one pair. The compiler builds it for each test alone, so that times compare: a test takes a few
/// nanoseconds.
pub(crate) trait WithTest<S: Scalar, A> {
    type Outcome;

    fn with(self, test: impl Fn(&PrimitivePair<S>) -> A) -> Self::Outcome;
}

/// A use of a test of sixteen pairs side by side.
pub(crate) trait WithLanes<S: Scalar> {
    fn with(self, test: impl BatchTest<S>);
}

/// An application of a test to this pair.
struct Ask<'a, S: Scalar>(&'a PrimitivePair<S>);

impl<S: Scalar, A> WithTest<S, A> for Ask<'_, S> {
    type Outcome = A;

    #[inline(always)]
    fn with(self, test: impl Fn(&PrimitivePair<S>) -> A) -> A {
        test(self.0)
    }
}
