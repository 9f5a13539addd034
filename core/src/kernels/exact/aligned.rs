//! The 24 coordinates of a pair as whole numbers, axis by axis.

use super::magnitude::Magnitude;
use crate::PairKind;
use crate::motion::PrimitivePair;
use crate::points::PairPoints;
use crate::scalar::Scalar;

/// An odd number, or zero, times a power of two.
#[derive(Clone, Copy, Debug)]
struct Term {
    significand: i64,
    /// The exponent, biased by [`bias`]; [`u32::MAX`] for zero.
    exponent: u32,
}

/// Returns the bias, the difference of a biased exponent and the true one. Biased exponents are never negative: the smallest
/// subnormal has 1.
const fn bias<S: Scalar>() -> i32 {
    // This is 127 + 23 or 1023 + 52.
    ((1 << (S::EXPONENT_BITS - 1)) - 1 + S::FRACTION_BITS) as i32
}

struct Parts {
    term: Term,
    /// A biased power of two above all bits of the number.
    top: u32,
    is_finite: bool,
}

/// Splits a number into its parts by its encoding alone, so that no control register matters.
#[inline(always)]
fn take_apart<S: Scalar>(number: S) -> Parts {
    let encoding = number.encoding();
    let largest_field = (1 << S::EXPONENT_BITS) - 1;
    let field = (encoding >> S::FRACTION_BITS) as u32 & largest_field;
    let is_negative = encoding >> (S::FRACTION_BITS + S::EXPONENT_BITS) != 0;
    // Subnormal numbers have the exponent of the smallest normal ones and no leading one.
    let is_normal = field != 0;
    let exponent = field.max(1);
    let fraction = encoding & ((1 << S::FRACTION_BITS) - 1);
    let magnitude = fraction | u64::from(is_normal) << S::FRACTION_BITS;

    let zeros = magnitude.trailing_zeros();
    let odd = magnitude.wrapping_shr(zeros).cast_signed();
    Parts {
        term: Term {
            significand: if is_negative { -odd } else { odd },
            exponent: if magnitude == 0 { u32::MAX } else { exponent + zeros },
        },
        top: exponent + S::FRACTION_BITS + 1,
        is_finite: field != largest_field,
    }
}

/// Returns a length exactly, or `None` if it is negative, infinite or NaN.
pub(super) fn length<S: Scalar>(number: S) -> Option<Magnitude> {
    let Parts { term, is_finite, .. } = take_apart(number);
    let significand = u64::try_from(term.significand).ok()?;
    if !is_finite {
        return None;
    }
    if significand == 0 {
        return Some(Magnitude::ZERO);
    }
    Some(Magnitude::exact(significand, term.exponent.cast_signed() - bias::<S>()))
}

/// The eight coordinates along one axis: those at the start, then those at the end.
#[derive(Clone, Copy, Debug)]
struct Axis {
    terms: [Term; 8],
    /// The smallest of their exponents, biased.
    unit: u32,
    /// The number of bits of the coordinates, which are whole numbers times 2^`unit`.
    bits: u32,
}

impl Axis {
    /// Returns `None` if a coordinate is not finite.
    #[inline(always)]
    fn new<S: Scalar>(coordinates: [S; 8]) -> Option<Self> {
        let parts = coordinates.map(take_apart);
        let mut is_finite = true;
        let (mut unit, mut top) = (u32::MAX, 0);
        for part in &parts {
            is_finite &= part.is_finite;
            unit = unit.min(part.term.exponent);
            top = top.max(part.top);
        }
        is_finite.then_some(Self {
            terms: parts.map(|part| part.term),
            unit,
            bits: top.saturating_sub(unit),
        })
    }

    /// Builds the coordinates from significands and powers of two.
    #[inline(always)]
    fn integers<T>(&self, shifted: &mut impl FnMut(i64, u32) -> T) -> [T; 8] {
        self.terms
            .map(|term| shifted(term.significand, term.exponent.wrapping_sub(self.unit)))
    }
}

/// The axes' units, as powers of two.
#[derive(Clone, Copy, Debug)]
pub(super) struct Units(pub(super) [i32; 3]);

/// A pair's coordinates as whole numbers, each axis in its own unit.
#[derive(Clone, Copy, Debug)]
pub(super) struct AlignedPair {
    pub(super) kind: PairKind,
    axes: [Axis; 3],
    pub(super) units: Units,
}

impl AlignedPair {
    /// Returns the coordinates, or `None` if one is not finite.
    #[inline(never)]
    pub(super) fn new<S: Scalar>(pair: &PrimitivePair<S>) -> Option<Self> {
        let points = PairPoints::from(pair);
        let [a, b, c, d] = points.start;
        let [e, f, g, h] = points.end;
        let axes = [
            Axis::new([a.x, b.x, c.x, d.x, e.x, f.x, g.x, h.x])?,
            Axis::new([a.y, b.y, c.y, d.y, e.y, f.y, g.y, h.y])?,
            Axis::new([a.z, b.z, c.z, d.z, e.z, f.z, g.z, h.z])?,
        ];
        // Any unit is valid if all coordinates are zero.
        let unit = |axis: &Axis| i32::try_from(axis.unit).unwrap_or(0);
        let [x, y, z] = &axes;
        Some(Self {
            kind: pair.kind,
            units: Units([x, y, z].map(|axis| unit(axis) - bias::<S>())),
            axes,
        })
    }

    /// Returns the largest number of bits of a coordinate.
    #[inline(always)]
    pub(super) fn bits(&self) -> u32 {
        let [x, y, z] = &self.axes;
        x.bits.max(y.bits).max(z.bits)
    }

    /// Returns the four points' coordinates along each axis, at the start, then at the end. `shifted` makes significand · 2ⁿ.
    #[inline(always)]
    pub(super) fn coordinates<T>(&self, mut shifted: impl FnMut(i64, u32) -> T) -> [[T; 8]; 3] {
        let [x, y, z] = &self.axes;
        [x.integers(&mut shifted), y.integers(&mut shifted), z.integers(&mut shifted)]
    }
}

#[cfg(test)]
mod tests {
    use super::{bias, take_apart};

    #[test]
    fn the_top_is_one_above_the_highest_bit_of_a_normal_number() {
        for power in [-1022, -1, 0, 1, 52, 1023] {
            let number = 2.0_f64.powi(power);
            let expected = power + bias::<f64>() + 1;
            for number in [number, -number, number * 1.75] {
                assert_eq!(take_apart(number).top.cast_signed(), expected, "{number}");
            }
        }
    }
}
