//! Collects each method's answers to the built-in hard cases.

use crate::hard_cases::{ExactContact, HardCase, hard_cases};
use crate::methods::QueryMethod;
use selvedge_core::glam::DVec3;
use selvedge_core::{Motion, PrimitivePair, Scalar};

/// One method's answer beside the exact one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HardAnswer {
    /// The method keeps a pair that touches or is not finite, or culls one that does not touch.
    Right,
    /// The method keeps a pair that does not touch. That is allowed, since later tests examine it again.
    FalseAlarm,
    /// **Wrong**: the method culls a pair that touches or is not finite.
    Missed,
}

/// One case with every method's answer.
#[derive(Clone, Debug)]
pub struct HardResult {
    /// The case.
    pub case: &'static HardCase,
    /// The methods' answers, in the order of [`QueryMethod::ALL`].
    pub answers: [HardAnswer; QueryMethod::ALL.len()],
}

/// Runs every method on each of the [`hard_cases`] whose name contains `name`, in the format `S`. Calls `progress` with the share
/// that is done.
///
/// Cases whose coordinates `S` does not hold exactly are left out, since their answers would differ.
pub fn ask_hard_cases<S: Scalar>(name: &str, progress: &mut dyn FnMut(f64)) -> Vec<HardResult> {
    let cases = hard_cases().iter().filter(|case| case.name.contains(name));
    let cases: Vec<_> = cases.collect();
    let mut results = Vec::new();
    for (index, &case) in cases.iter().enumerate() {
        if let Some(pair) = exactly::<S>(case) {
            let must_be_kept = case.contact != ExactContact::Never;
            let answers = QueryMethod::ALL.map(|method| match (method.keeps(pair), must_be_kept) {
                (true, true) | (false, false) => HardAnswer::Right,
                (true, false) => HardAnswer::FalseAlarm,
                (false, true) => HardAnswer::Missed,
            });
            results.push(HardResult { case, answers });
        }
        progress((index + 1) as f64 / cases.len() as f64);
    }
    results
}

/// Returns the case's pair as `S`, if that changes none of its coordinates.
pub(super) fn exactly<S: Scalar>(case: &HardCase) -> Option<PrimitivePair<S>> {
    let convert = |position: DVec3| {
        let converted = position.to_array().map(S::from_f64);
        let is_same = |(old, new): (f64, S)| old == new.to_f64() || old.is_nan();
        let mut all = position.to_array().into_iter().zip(converted);
        all.all(is_same).then(|| converted.into())
    };
    let mut points = case.pair.motions.map(|motion| {
        Some(Motion {
            start: convert(motion.start)?,
            end: convert(motion.end)?,
        })
    });
    let [a, b, c, d] = &mut points;
    Some(PrimitivePair::new(
        case.pair.kind,
        [a.take()?, b.take()?, c.take()?, d.take()?],
    ))
}

#[cfg(test)]
mod tests {
    use super::{HardAnswer, ask_hard_cases};
    use crate::methods::QueryMethod;

    /// The command demonstrates failures of the plain test, and none of ours.
    #[test]
    fn certified_methods_miss_nothing_and_the_plain_test_does() {
        let missed = |results: &[super::HardResult], wanted: bool| {
            let of = |result: &super::HardResult| {
                let by_method = QueryMethod::ALL.into_iter().zip(result.answers);
                let missed = by_method.filter(|(_, answer)| *answer == HardAnswer::Missed);
                missed.filter(|(method, _)| method.is_certified() == wanted).count()
            };
            results.iter().map(of).sum::<usize>()
        };
        let name = "coplanar throughout";
        let double = ask_hard_cases::<f64>(name, &mut |_| {});
        let single = ask_hard_cases::<f32>(name, &mut |_| {});
        assert_eq!(missed(&double, true) + missed(&single, true), 0);
        assert!(missed(&double, false) > 5);
        // Cases that f32 does not hold exactly are left out.
        assert!(!single.is_empty() && single.len() < double.len());
    }
}
