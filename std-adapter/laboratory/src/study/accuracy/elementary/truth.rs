use selvedge_core::elementary::advance::certain_contact;
use selvedge_core::elementary::advance::time_of_impact;
use selvedge_core::elementary::{ContactVerdict, Limits, contact};
use selvedge_core::{PrimitivePair, Scalar};

/// The widest enclosure of a first contact, in steps, that counts as a known time.
pub const WIDEST: f64 = 1e-10;

/// The exact answer about the first contact of a pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ExactAnswer {
    /// The pair does not touch at any time in [0, 1].
    Never,
    /// It touches.
    Touches {
        /// The bounds of the first time; `None` if they are not close.
        first: Option<[f64; 2]>,
    },
}

/// Returns the exact answer and an enclosure of the first time.
///
/// A pair that is not finite counts as touching at an unknown time.
pub fn exact_answer<S: Scalar>(pair: &PrimitivePair<S>) -> ExactAnswer {
    let pair = pair.widened();
    match contact(&pair) {
        ContactVerdict::Never => ExactAnswer::Never,
        ContactVerdict::Happens => ExactAnswer::Touches {
            first: first_time(&pair),
        },
        ContactVerdict::Undefined => ExactAnswer::Touches { first: None },
    }
}

/// Returns an enclosure of the first time of a pair that touches.
fn first_time(pair: &PrimitivePair<f64>) -> Option<[f64; 2]> {
    let as_tight_as_can_be = Limits::accurate_to(0.0);
    let from = time_of_impact(pair, &as_tight_as_can_be).time()?;
    let [_, to] = certain_contact(pair, from)?;
    (to - from <= WIDEST).then_some([from, to])
}
