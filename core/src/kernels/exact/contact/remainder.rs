//! The numbers whose signs decide a polynomial's sign at a root of another: the same formulas for whole numbers and for rounded
//! ones.

use crate::exact::integer::{Space, Whole, Words};

/// The common arithmetic of whole numbers and rounded ones.
pub(super) trait Ring {
    type Number: Copy;
    const ZERO: Self::Number;
    fn plus(&mut self, a: Self::Number, b: Self::Number) -> Self::Number;
    fn minus(&mut self, a: Self::Number, b: Self::Number) -> Self::Number;
    fn times(&mut self, a: Self::Number, b: Self::Number) -> Self::Number;
    /// Returns a·d − b·c.
    #[inline(always)]
    fn minor(&mut self, a: Self::Number, b: Self::Number, c: Self::Number, d: Self::Number) -> Self::Number {
        let (x, y) = (self.times(a, d), self.times(b, c));
        self.minus(x, y)
    }
}

impl<'a> Ring for Space<'a> {
    type Number = Words<'a>;
    const ZERO: Words<'a> = <Words<'a> as Whole>::ZERO;

    fn plus(&mut self, a: Words<'a>, b: Words<'a>) -> Words<'a> {
        Space::plus(self, a, b)
    }

    fn minus(&mut self, a: Words<'a>, b: Words<'a>) -> Words<'a> {
        Space::minus(self, a, b)
    }

    fn times(&mut self, a: Words<'a>, b: Words<'a>) -> Words<'a> {
        Space::times(self, a, b)
    }

    fn minor(&mut self, a: Words<'a>, b: Words<'a>, c: Words<'a>, d: Words<'a>) -> Words<'a> {
        Space::minor(self, a, b, c, d)
    }
}

/// Returns v₀ for the value v₀·b⁻ⁿ that a polynomial of degree n has at −a/b, where b > 0 (Horner's rule).
#[inline(never)]
pub(super) fn value_at_quotient<R: Ring>(ring: &mut R, [a, b]: [R::Number; 2], polynomial: &[R::Number]) -> R::Number {
    let mut coefficients = polynomial.iter().rev();
    let mut value = coefficients.next().copied().unwrap_or(R::ZERO);
    let mut power = b;
    for (step, &coefficient) in coefficients.enumerate() {
        if step > 0 {
            power = ring.times(power, b);
        }
        value = ring.minor(coefficient, value, a, power);
    }
    value
}

/// Returns the three numbers whose signs decide a polynomial's sign at a root of q = a + b·s + c·s², c > 0.
///
/// First comes the remainder l₀ + l₁·s, a positive multiple of the polynomial at both roots of q, by Horner's rule. (l₀ + l₁·s)·s
/// times c, with c·s² = −a − b·s, is −a·l₁ + (c·l₀ − b·l₁)·s. Its value at σ = (−b ± √D)/2c, D = b² − 4ac, times 2c, is A ± l₁√D
/// with A = 2c·l₀ − b·l₁. Where the two have opposite signs, A² − l₁²D = 4c·(c·l₀² − b·l₀l₁ + a·l₁²) shows which is larger. (The
/// number in brackets is the resultant of the polynomial and q times a power of c.) The result is l₁, A and the number in
/// brackets.
#[inline(never)]
pub(super) fn terms<R: Ring>(ring: &mut R, [a, b, c]: [R::Number; 3], polynomial: &[R::Number]) -> [R::Number; 3] {
    let mut coefficients = polynomial.iter().rev();
    let mut l1 = coefficients.next().copied().unwrap_or(R::ZERO);
    let mut l0 = coefficients.next().copied().unwrap_or(R::ZERO);
    let mut power = c;
    for (step, &coefficient) in coefficients.enumerate() {
        if step > 0 {
            power = ring.times(power, c);
        }
        (l0, l1) = (ring.minor(coefficient, l1, a, power), ring.minor(l0, l1, b, c));
    }
    let (from_l0, of_b) = (ring.times(l0, c), ring.times(l1, b));
    let half = ring.minus(from_l0, of_b);
    let (of_half, squared) = (ring.times(l0, half), ring.times(l1, l1));
    let of_a = ring.times(squared, a);
    [l1, ring.plus(half, from_l0), ring.plus(of_half, of_a)]
}

#[cfg(test)]
mod tests {
    use super::{Ring, terms, value_at_quotient};
    use crate::exact::contact::rounded::{FixedPoint, Rounded, Scale};
    use crate::exact::integer::{Integer, Whole};

    struct BuiltIn;

    impl Ring for BuiltIn {
        type Number = i128;
        const ZERO: i128 = 0;

        fn plus(&mut self, a: i128, b: i128) -> i128 {
            a + b
        }

        fn minus(&mut self, a: i128, b: i128) -> i128 {
            a - b
        }

        fn times(&mut self, a: i128, b: i128) -> i128 {
            a * b
        }
    }

    /// With coefficients of 16 bits all terms of a cubic fit into 128.
    #[test]
    fn rounded_terms_are_as_close_as_documented() {
        let mut state = 0x9E37_79B9_7F4A_7C15_u64;
        let mut random = || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            i64::from(state as i16) >> (state >> 60)
        };
        let whole = |x: i64| Integer::<1>::shifted(x, 0);
        let mut largest = [0; 4];
        for degree in [1, 2, 3] {
            for _ in 0..100_000 {
                let quadratic = [random(), random(), random()];
                let cubic = [random(), random(), random(), random()];
                let polynomial = cubic.map(i128::from);
                let polynomial = polynomial.get(..=degree).unwrap_or_default();
                let [a, b, c] = quadratic.map(i128::from);
                let [l1, first, last] = terms(&mut BuiltIn, [a, b, c], polynomial);
                let exact = [l1, first, last, value_at_quotient(&mut BuiltIn, [a, b], polynomial)];
                // The scale has this power of two, by which the terms are too large.
                let bits = |coefficients: &[i64]| {
                    let bits = coefficients.iter().map(|&x| whole(x).words().bits());
                    bits.max().unwrap_or(0).cast_signed()
                };
                let [of_quadratic, of_polynomial] = [bits(&quadratic), bits(cubic.get(..=degree).unwrap_or(&[]))];
                let steps = degree as i32 - 1;
                let of_remainder = of_polynomial + steps * of_quadratic;
                let powers = [
                    of_remainder,
                    of_remainder + of_quadratic,
                    2 * of_remainder + of_quadratic,
                    of_remainder + of_quadratic,
                ];

                let quadratic = quadratic.map(whole);
                let quadratic = quadratic.each_ref().map(Whole::words);
                let scale = Scale::of(&quadratic);
                let rounded_quadratic = quadratic.map(|x| scale.rounded(x));
                let cubic = cubic.map(whole);
                let cubic = cubic.each_ref().map(Whole::words);
                let scale = Scale::of(cubic.get(..=degree).unwrap_or_default());
                let rounded: [Rounded; 4] = cubic.map(|x| scale.rounded(x));
                let rounded = rounded.get(..=degree).unwrap_or_default();
                let [a, b, _] = rounded_quadratic;
                let [l1, first, last] = terms(&mut FixedPoint, rounded_quadratic, rounded);
                let rounded = [l1, first, last, value_at_quotient(&mut FixedPoint, [a, b], rounded)];
                for (i, (exact, rounded)) in exact.into_iter().zip(rounded).enumerate() {
                    let unit = 56 - powers[i];
                    let exact = if unit >= 0 { exact << unit } else { exact >> -unit };
                    let error = (exact - i128::from(rounded.0)).abs();
                    largest[i] = largest[i].max(error);
                }
            }
        }
        // One more is for the shift of the exact value.
        assert!(
            largest[0] <= 19 && largest[1] <= 60 && largest[2] <= 385 && largest[3] <= 26,
            "{largest:?}"
        );
        // With so few bits only the last products are cut off.
        assert!(largest[2] > 1 && largest[3] > 0, "{largest:?}");
    }
}
