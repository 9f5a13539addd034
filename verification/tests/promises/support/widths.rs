//! Pairs at the limits of the fixed widths that `selvedge_core::kernels::exact` computes in.

use selvedge_core::PairKind;
use selvedge_verification::generator::{Choices, Format, PairCase};

/// Generates coordinates that are as large and as small as a fixed width holds, or a little larger, so that the next width is
/// used. Most of them are ±(2^bits − 2^k) or ±1, times a power of two.
pub(crate) fn at_the_limit_of_a_width<S: Format>(choices: &mut Choices<'_>) -> PairCase<S> {
    let kind = choices.pick(&PairKind::ALL);
    let limits = choices.pick(&[61, 125, 317, 2098]).min(S::MAX_EXPONENT - S::MIN_EXPONENT);
    let bits = (limits + choices.within(2) as i32).min(S::MAX_EXPONENT - S::MIN_EXPONENT);
    let unit = S::MIN_EXPONENT;
    let top = unit + bits - S::PRECISION.cast_signed();
    PairCase::from_coordinates(kind, || {
        let sign = choices.pick(&[1, -1]);
        match choices.below(8) {
            0 => S::exact(sign, unit),
            1 => S::ZERO,
            2 => S::exact(sign << (S::PRECISION - 1), top),
            _ => S::exact(sign * ((1 << S::PRECISION) - 1), top),
        }
    })
}
