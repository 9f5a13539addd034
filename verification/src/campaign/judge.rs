//! Judges claims by exact signs, an axis, integers, and the oracle.

use super::{ClaimCounts, SAMPLE, TestedClaim};
use crate::generator::{Format, PairCase};
use crate::oracle;
use selvedge_core::PrimitivePair;
use selvedge_core::kernels::exact::{control_value_signs, touches};
use std::cmp::Ordering::{Greater, Less};

/// One pair, and what is proven about it so far.
pub(super) struct Judge<'a, S: Format> {
    case: &'a PairCase<S>,
    pair: &'a PrimitivePair<S>,
    has_one_sign: Option<bool>,
    is_apart: Option<By>,
}

/// The proof that the sets stay apart.
#[derive(Clone, Copy, PartialEq)]
enum By {
    Axis,
    Signs,
    WholeNumbers,
    Nothing,
}

impl<'a, S: Format> Judge<'a, S> {
    pub(super) const fn new(case: &'a PairCase<S>, pair: &'a PrimitivePair<S>) -> Self {
        Self {
            case,
            pair,
            has_one_sign: None,
            is_apart: None,
        }
    }

    /// Counts the claim and decides whether it is right.
    pub(super) fn judge(&mut self, claim: TestedClaim, count: &mut ClaimCounts, chunk: u64) {
        count.claims += 1;
        let by = if claim.is_of_the_volume() {
            if self.has_one_sign() { By::Signs } else { By::Nothing }
        } else {
            self.is_apart()
        };
        match by {
            By::Axis => count.by_axis += 1,
            By::Signs => count.by_signs += 1,
            By::WholeNumbers => count.by_whole_numbers += 1,
            By::Nothing => {}
        }
        if by != By::Nothing && count.claims % SAMPLE != 1 {
            return;
        }
        count.by_oracle += 1;
        let question = self.case.question();
        let is_wrong = if claim.is_of_the_volume() {
            oracle::are_ever_coplanar(&question.start, &question.end)
        } else {
            oracle::collides(&question).is_some()
        };
        if is_wrong {
            count.wrong += 1;
            let example = (chunk, format!("{:?}", self.case));
            count.example = count.example.take().into_iter().chain([example]).min();
        }
    }

    fn has_one_sign(&mut self) -> bool {
        *self.has_one_sign.get_or_insert_with(|| {
            let signs = control_value_signs(self.pair);
            matches!(signs, Some([Less, Less, Less, Less] | [Greater, Greater, Greater, Greater]))
        })
    }

    fn is_apart(&mut self) -> By {
        if let Some(by) = self.is_apart {
            return by;
        }
        let by = if self.is_apart_along_an_axis() {
            By::Axis
        } else if self.has_one_sign() {
            By::Signs
        } else if touches(self.pair) == Some(false) {
            By::WholeNumbers
        } else {
            By::Nothing
        };
        self.is_apart = Some(by);
        by
    }

    /// Returns whether one set is ahead of the other along an axis, at both ends of the step.
    fn is_apart_along_an_axis(&self) -> bool {
        let [first, second] = self.case.sets();
        let ahead = |one: &[[[S; 3]; 2]], other: &[[[S; 3]; 2]], axis: usize| {
            let all_ahead = |end: usize| one.iter().all(|p| other.iter().all(|q| p[end][axis] > q[end][axis]));
            all_ahead(0) && all_ahead(1)
        };
        (0..3).any(|axis| ahead(first, second, axis) || ahead(second, first, axis))
    }
}
