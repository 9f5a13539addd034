//! Verdicts do not depend on how a pair is written, as far as that is possible.
//!
//! Rounding depends on the order of operations. So most rearrangements change the last bits, and with them the verdict of a pair
//! that is a rounding error away from coplanar. The following is the same bit for bit, by construction:
//!
//! | change | non-coplanarity | segment–box | relative boxes, swept boxes |
//! |---|---|---|---|
//! | time reversed | same: k₀ and k₃, 3k₁ and 3k₂ trade places | sound only | same |
//! | an axis mirrored | same: every value changes sign, exactly | same | same |
//! | x and y exchanged | same: every value changes sign, exactly | same | same |
//! | axes permuted otherwise | sound only: the dot product sums in another order | same | same |
//! | face: second and third vertex exchanged | same: B and C trade places, n and h change sign | same | same |
//! | face: vertices permuted otherwise | sound only: another point is the base | same | same |
//! | first edge's ends exchanged | same: B and C trade places | (swept boxes) | same |
//! | second edge's ends, or the edges, exchanged | sound only: another point is the base | (swept boxes) | same |
//! | scaled by a power of two, far from underflow and overflow | same: the underflow term vanishes in rounding | same | same |
//! | translated, all sums exact | same: differences are | same, if the box is | same |
//!
//! Swept boxes and relative boxes also keep a pair when the sum of its coordinates overflows, which depends on the order. For
//! them the table is about pairs with finite sums.
//!
//! *Sound only* means that the verdict may change, but never to a wrong one. The properties of the other files check that, with
//! pairs in every arrangement; here it is checked for pairs that are coplanar by construction.
//!
//! The *plain* filter is not symmetric in time, since it computes from velocities. Nothing is promised for it.

use crate::support::prelude::*;
use selvedge_verification::culling::CullingTest::{self, CertifiedNonCoplanarity, RelativeBoxes, SegmentBox, SweptBoxes};

const EXACT_BOXES: [CullingTest; 2] = [SweptBoxes, RelativeBoxes];

fn all_but<const N: usize>(missing: [CullingTest; N]) -> impl Iterator<Item = CullingTest> {
    let all = EXACT_BOXES.into_iter().chain([SegmentBox, CertifiedNonCoplanarity]);
    all.filter(move |test| !missing.contains(test))
}

fn same<S: Format>(tests: impl Iterator<Item = CullingTest>, pair: &PairCase<S>, changed: &PairCase<S>) -> TestCaseResult {
    for test in tests.filter(|&test| test == CertifiedNonCoplanarity || pair.sums_are_finite()) {
        let (before, after): (Verdict, Verdict) = (verdict(test, pair), verdict(test, changed));
        prop_assert_eq!(before, after, "{:?}, changed to {:?}", test, changed);
    }
    Ok(())
}

fn mirrored<S: Format>(pair: &PairCase<S>, axis: usize) -> PairCase<S> {
    pair.with_positions(|mut position| {
        position[axis] = -position[axis];
        position
    })
}

fn rearranging_changes_no_verdict<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    const BOXES_ALONE: [CullingTest; 1] = [CertifiedNonCoplanarity];
    same(all_but([SegmentBox]), pair, &pair.reversed())?;
    for axis in 0..3 {
        same(all_but([]), pair, &mirrored(pair, axis))?;
    }
    same(all_but([]), pair, &pair.with_axes([1, 0, 2]))?;
    for axes in [[1, 2, 0], [2, 0, 1], [2, 1, 0], [0, 2, 1]] {
        same(all_but(BOXES_ALONE), pair, &pair.with_axes(axes))?;
    }
    let (same_for_all, same_for_boxes): (_, &[_]) = match pair.kind {
        PairKind::VertexFace => ([0, 1, 3, 2], &[[0, 2, 3, 1], [0, 3, 1, 2], [0, 2, 1, 3], [0, 3, 2, 1]]),
        PairKind::EdgeEdge => ([1, 0, 2, 3], &[[2, 3, 0, 1], [0, 1, 3, 2], [3, 2, 1, 0]]),
    };
    same(all_but([]), pair, &pair.reordered(same_for_all))?;
    for &order in same_for_boxes {
        same(all_but(BOXES_ALONE), pair, &pair.reordered(order))?;
    }
    Ok(())
}

formats!(rearranging_changes_no_verdict(60_000, pairs_of_any_kind()));

/// Chooses multiples of 2⁻¹⁰ up to 16 in magnitude. A permanent of them is at least 2⁻³⁰, or zero; then the value is zero, too,
/// and its sign is never certain. With u = 2⁻²⁴ the bound is at least 2⁻⁵⁰, of which the last bit is worth 2⁻⁷³, and (1 + M)²·η <
/// 2⁻¹⁰⁶ vanishes in it. This holds all the more scaled by 2¹². Scaled by 2⁻¹², the last bit is worth 2⁻¹⁰⁹, and M < 1 makes the
/// other term less than 2⁻¹¹⁵. The segment test's products are larger.
fn on_a_grid<S: Format>(kind: PairKind, choices: &mut Choices<'_>) -> PairCase<S> {
    // Few values make nearly coplanar pairs, which matter; other cases use any.
    let limit = choices.pick(&[2, 64, 16_384]);
    PairCase::from_coordinates(kind, || {
        let whole = (choices.word() % (2 * limit + 1)) as i64 - limit as i64;
        S::exact(whole, -10)
    })
}

fn grids<S: Format>() -> impl Strategy<Value = PairCase<S>> {
    from_choices(|choices| {
        let kind = choices.pick(&[PairKind::VertexFace, PairKind::EdgeEdge]);
        on_a_grid(kind, choices)
    })
}

fn scaling_by_a_power_of_two_changes_no_verdict<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    [-12, -1, 1, 12].into_iter().try_for_each(|exponent| {
        let factor = S::exact(1, exponent);
        same(all_but([]), pair, &pair.map(|x| x * factor))
    })
}

formats!(scaling_by_a_power_of_two_changes_no_verdict(30_000, grids()));

// Integer multiples of 2⁻¹⁰ below 2⁵ stay exact when moved by multiples of 2⁻¹⁰ up to 2⁸, and so do sums of two of them.
fn an_exact_translation_changes_no_verdict<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    let by = [1 << 18, -102_528, 2].map(|whole| S::exact(whole, -10));
    let moved = pair.with_positions(|x| std::array::from_fn(|axis| x[axis] + by[axis]));
    let back = moved.with_positions(|x| std::array::from_fn(|axis| x[axis] - by[axis]));
    prop_assert_eq!(back, *pair);
    same(all_but([]), pair, &moved)
}

formats!(an_exact_translation_changes_no_verdict(30_000, grids()));
