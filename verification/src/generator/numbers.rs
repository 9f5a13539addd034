//! Single coordinates, biased to values at which floating-point code fails.

use super::Choices;
use selvedge_core::Scalar;

/// The properties of a number format that the generator needs.
pub trait Format: Scalar {
    /// The number of significant bits, the leading one included.
    const PRECISION: u32;
    /// Two to this power is the smallest positive number.
    const MIN_EXPONENT: i32;
    /// Two to this power is the first that overflows.
    const MAX_EXPONENT: i32;
    const LARGEST: Self;
    const NAN: Self;

    /// Returns the number with these bits (the low ones, for `f32`).
    fn from_word(bits: u64) -> Self;
    fn up(self) -> Self;
    fn down(self) -> Self;

    /// Returns `mantissa` · 2^`exponent`, exactly.
    ///
    /// # Panics
    /// Panics if the format has no such number.
    fn exact(mantissa: i64, exponent: i32) -> Self {
        assert!(
            mantissa.unsigned_abs() < 1 << Self::PRECISION
                && exponent >= Self::MIN_EXPONENT
                && exponent + Self::PRECISION.cast_signed() <= Self::MAX_EXPONENT,
            "{mantissa} · 2^{exponent} is no {}",
            Self::NAME
        );
        // Uses two factors, because 2^-1074 alone is subnormal. The first product is far from underflow.
        let half = exponent / 2;
        Self::from_f64(mantissa as f64 * power_of_two(half) * power_of_two(exponent - half))
    }

    /// Returns the number that is `steps` numbers further up, or down. Stops at the largest finite one.
    fn nudged(self, steps: i64) -> Self {
        let mut number = self;
        for _ in 0..steps.abs() {
            let next = if steps > 0 { number.up() } else { number.down() };
            if !Scalar::is_finite(next) {
                break;
            }
            number = next;
        }
        number
    }

    /// Returns the number itself if it is finite, or the largest of its sign, or 0 for NaN.
    fn made_finite(self) -> Self {
        if Scalar::is_finite(self) {
            self
        } else if self > Self::ZERO {
            Self::LARGEST
        } else if self < Self::ZERO {
            -Self::LARGEST
        } else {
            Self::ZERO
        }
    }
}

/// Returns 2^`exponent`.
///
/// # Panics
/// Panics if the result is not a normal number.
#[inline]
const fn power_of_two(exponent: i32) -> f64 {
    assert!(-1022 <= exponent && exponent < 1024, "2^exponent is not normal");
    f64::from_bits(((exponent + 1023).cast_unsigned() as u64) << 52)
}

impl Format for f32 {
    const PRECISION: u32 = 24;
    const MIN_EXPONENT: i32 = -149;
    const MAX_EXPONENT: i32 = 128;
    const LARGEST: Self = Self::MAX;
    const NAN: Self = Self::NAN;

    fn from_word(bits: u64) -> Self {
        Self::from_bits(bits as u32)
    }

    fn up(self) -> Self {
        self.next_up()
    }

    fn down(self) -> Self {
        self.next_down()
    }
}

impl Format for f64 {
    const PRECISION: u32 = 53;
    const MIN_EXPONENT: i32 = -1074;
    const MAX_EXPONENT: i32 = 1024;
    const LARGEST: Self = Self::MAX;
    const NAN: Self = Self::NAN;

    fn from_word(bits: u64) -> Self {
        Self::from_bits(bits)
    }

    fn up(self) -> Self {
        self.next_up()
    }

    fn down(self) -> Self {
        self.next_down()
    }
}

/// Returns the exponent of the power of two below the number's magnitude, far below for zero.
pub(super) fn binary_exponent<S: Format>(number: S) -> i32 {
    (number.to_f64().to_bits() >> 52 & 0x7ff) as i32 - 1023
}

/// Chooses the exponent of a power of two that scales integers. Most often it is zero. Else the numbers, or products of two or
/// three of them, underflow or overflow.
pub(super) fn exponent<S: Format>(choices: &mut Choices<'_>) -> i32 {
    let highest = S::MAX_EXPONENT - S::PRECISION.cast_signed();
    let near = choices.within(12) as i32;
    let exponent = match choices.below(16) {
        0..=7 => 0,
        8 => near,
        9 => S::MIN_EXPONENT,
        10 => S::MIN_EXPONENT + near.abs(),
        11 => S::MIN_EXPONENT / if near % 2 == 0 { 2 } else { 3 } + near,
        // Here the filter's underflow term matters.
        12 => binary_exponent(S::UNDERFLOW) / 3 + near,
        13 => S::MAX_EXPONENT / 3 - S::PRECISION.cast_signed() + 4 * near,
        14 => highest,
        _ => (choices.word() % (S::MAX_EXPONENT - S::MIN_EXPONENT) as u64) as i32 + S::MIN_EXPONENT,
    };
    exponent.clamp(S::MIN_EXPONENT, highest)
}

/// Chooses an integer of at most `bits` bits and a sign.
pub(super) fn whole(choices: &mut Choices<'_>, bits: u32) -> i64 {
    if bits <= 6 {
        return choices.within((1 << bits) - 1);
    }
    let magnitude = (choices.word() >> (64 - bits)).cast_signed();
    if choices.once_in(2) { -magnitude } else { magnitude }
}

/// Chooses a number between −1 and 1 with random bits.
pub(super) fn fraction<S: Format>(choices: &mut Choices<'_>) -> S {
    let bits = S::PRECISION - 1;
    S::exact(whole(choices, bits), -bits.cast_signed())
}

/// Chooses any finite number: zero, a small integer, a fraction, a power of two or its neighbour, an extreme number, or random
/// bits.
pub(super) fn finite<S: Format>(choices: &mut Choices<'_>) -> S {
    match choices.below(8) {
        0 => S::ZERO,
        1 => S::exact(choices.within(4), 0),
        2 => S::exact(choices.within(4), choices.within(8) as i32),
        3 => fraction(choices),
        4 => S::exact(choices.within(3), exponent::<S>(choices)).nudged(choices.within(2)),
        5 => S::exact(choices.within(20), S::MIN_EXPONENT),
        6 => S::exact(whole(choices, S::PRECISION), S::MAX_EXPONENT - S::PRECISION.cast_signed()),
        _ => S::from_word(choices.word()).made_finite(),
    }
}

/// Chooses NaN, an infinity, or a number so large that sums and products overflow.
pub(super) fn extraordinary<S: Format>(choices: &mut Choices<'_>) -> S {
    match choices.below(5) {
        0 => S::NAN,
        1 => S::INFINITY,
        2 => -S::INFINITY,
        3 => S::LARGEST,
        _ => -S::LARGEST,
    }
}
