//! Polynomials in one variable with integer coefficients, and Sturm's theorem.

use rug::{Assign, Integer, Rational};
use std::cmp::Ordering;

/// A polynomial with integer coefficients, by powers of the variable.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Polynomial {
    /// The coefficients, lowest power first. The last one is not zero; the zero polynomial has none.
    coefficients: Vec<Integer>,
}

impl Polynomial {
    /// Makes the polynomial with these coefficients, lowest power first.
    pub fn new(mut coefficients: Vec<Integer>) -> Self {
        while coefficients.last().is_some_and(Integer::is_zero) {
            coefficients.pop();
        }
        Self { coefficients }
    }

    /// Returns the coefficients, lowest power first, without leading zeros.
    pub fn coefficients(&self) -> &[Integer] {
        &self.coefficients
    }

    /// Combines each coefficient with the other's of the same power, or with zero if there is none.
    pub(crate) fn combined(self, other: &Self, change: impl Fn(&mut Integer, &Integer)) -> Self {
        let mut coefficients = self.coefficients;
        let length = coefficients.len().max(other.coefficients.len());
        coefficients.resize(length, Integer::new());
        for (coefficient, c) in coefficients.iter_mut().zip(&other.coefficients) {
            change(coefficient, c);
        }
        Self::new(coefficients)
    }

    pub fn is_zero(&self) -> bool {
        self.coefficients.is_empty()
    }

    /// Returns the highest power; 0 for constants, the zero polynomial included.
    pub fn degree(&self) -> usize {
        self.coefficients.len().saturating_sub(1)
    }

    /// Returns the sign of the value at a rational number.
    pub fn sign_at(&self, x: &Rational) -> Ordering {
        // Horner's rule on numerators computes denominator^degree · value, and the denominator is positive.
        let Some((last, lower)) = self.coefficients.split_last() else {
            return Ordering::Equal;
        };
        let mut value = last.clone();
        let mut power = Integer::from(1);
        for coefficient in lower.iter().rev() {
            power *= x.denom();
            value *= x.numer();
            value += coefficient * &power;
        }
        value.cmp0()
    }

    /// Returns the value at `index / 2^bits`, times `2^(bits · degree)`.
    pub(crate) fn value_at_dyadic(&self, index: &Integer, bits: u32) -> Integer {
        let Some((last, lower)) = self.coefficients.split_last() else {
            return Integer::new();
        };
        let mut value = last.clone();
        let mut shifted = Integer::new();
        for (coefficient, steps) in lower.iter().rev().zip(1u32..) {
            value *= index;
            shifted.assign(coefficient << (bits * steps));
            value += &shifted;
        }
        value
    }

    /// Returns the sign of the value at `index / 2^bits`.
    pub(crate) fn sign_at_dyadic(&self, index: &Integer, bits: u32) -> Ordering {
        self.value_at_dyadic(index, bits).cmp0()
    }

    /// Returns the sign on the whole closed interval `[index, index + 1] / 2^bits` if interval arithmetic shows that there is
    /// only one. `index` must not be negative.
    ///
    /// The width of the computed range shrinks with the interval. So the sign of a value that is not zero is found once the
    /// interval around it is small enough.
    pub(crate) fn sign_on_cell(&self, index: &Integer, bits: u32) -> Option<Ordering> {
        let Some((last, lower)) = self.coefficients.split_last() else {
            return Some(Ordering::Equal);
        };
        let above = Integer::from(index + 1);
        let (mut low, mut high) = (last.clone(), last.clone());
        let mut shifted = Integer::new();
        for (coefficient, steps) in lower.iter().rev().zip(1u32..) {
            low *= if low.is_negative() { &above } else { index };
            high *= if high.is_negative() { index } else { &above };
            shifted.assign(coefficient << (bits * steps));
            low += &shifted;
            high += &shifted;
        }
        (low.cmp0() == high.cmp0()).then(|| low.cmp0())
    }

    pub fn derivative(&self) -> Self {
        let terms = self.coefficients.iter().zip(0u32..).skip(1);
        Self::new(terms.map(|(c, power)| Integer::from(c * power)).collect())
    }

    /// Returns this polynomial divided by the (positive) greatest common divisor of its coefficients.
    fn primitive(mut self) -> Self {
        let mut content = Integer::new();
        for coefficient in &self.coefficients {
            content.gcd_mut(coefficient);
            if content == 1 {
                return self;
            }
        }
        for coefficient in &mut self.coefficients {
            coefficient.div_exact_mut(&content);
        }
        self
    }

    /// Returns a positive multiple of the remainder on division by `divisor`, reduced to its primitive part.
    fn remainder(&self, divisor: &Self) -> Self {
        let lead = divisor.coefficients.last().expect("division by the zero polynomial");
        let scale = Integer::from(lead.abs_ref());
        let mut rest = self.coefficients.clone();
        while rest.len() >= divisor.coefficients.len() {
            let mut factor = rest.pop().expect("longer than the divisor, so not empty");
            if factor.is_zero() {
                continue;
            }
            if lead.is_negative() {
                factor = -factor;
            }
            let shift = rest.len() + 1 - divisor.coefficients.len();
            for coefficient in &mut rest {
                *coefficient *= &scale;
            }
            for (coefficient, d) in rest[shift..].iter_mut().zip(&divisor.coefficients) {
                *coefficient -= &factor * d;
            }
        }
        Self::new(rest).primitive()
    }

    /// Returns the greatest common divisor, up to a constant factor.
    pub(crate) fn gcd(&self, other: &Self) -> Self {
        let (mut a, mut b) = (self.clone(), other.clone());
        while !b.is_zero() {
            let rest = a.remainder(&b);
            (a, b) = (b, rest);
        }
        a.primitive()
    }

    /// Returns a positive multiple of the quotient by a divisor that leaves no remainder.
    fn quotient(&self, divisor: &Self) -> Self {
        let lead = divisor.coefficients.last().expect("division by the zero polynomial");
        let scale = Integer::from(lead.abs_ref());
        let mut rest = self.coefficients.clone();
        let mut quotient = Vec::new();
        while rest.len() >= divisor.coefficients.len() {
            let mut factor = rest.pop().expect("longer than the divisor, so not empty");
            if lead.is_negative() {
                factor = -factor;
            }
            let shift = rest.len() + 1 - divisor.coefficients.len();
            for coefficient in rest.iter_mut().chain(&mut quotient) {
                *coefficient *= &scale;
            }
            for (coefficient, d) in rest[shift..].iter_mut().zip(&divisor.coefficients) {
                *coefficient -= &factor * d;
            }
            quotient.push(factor);
        }
        assert!(rest.iter().all(Integer::is_zero), "the division leaves a remainder");
        quotient.reverse();
        Self::new(quotient).primitive()
    }
}

/// Sturm's sequence of a square-free polynomial: the number of roots between two points is the
/// difference of the sign variations there.
#[derive(Clone, Debug)]
pub(crate) struct SturmSequence {
    terms: Vec<Polynomial>,
}

impl SturmSequence {
    /// Makes the sequence of the square-free part of `polynomial`, which must not be zero.
    pub(crate) fn new(polynomial: &Polynomial) -> Self {
        assert!(!polynomial.is_zero(), "every number is a root of the zero polynomial");
        let mut sequence = Self::with_repeated_roots(polynomial.clone().primitive());
        let common = sequence.terms.last().expect("the polynomial itself is the first term");
        if common.degree() > 0 {
            // The last term is the greatest common divisor with the derivative.
            sequence = Self::with_repeated_roots(polynomial.quotient(common));
        }
        sequence
    }

    fn with_repeated_roots(polynomial: Polynomial) -> Self {
        let derivative = polynomial.derivative();
        let mut terms = vec![polynomial];
        let mut next = derivative.primitive();
        while !next.is_zero() {
            let mut rest = terms[terms.len() - 1].remainder(&next);
            for coefficient in &mut rest.coefficients {
                *coefficient = Integer::from(-&*coefficient);
            }
            terms.push(next);
            next = rest;
        }
        Self { terms }
    }

    /// Returns the square-free polynomial whose roots this sequence counts.
    pub(crate) fn polynomial(&self) -> &Polynomial {
        &self.terms[0]
    }

    /// Returns the number of sign variations at `index / 2^bits`. The variations at a minus those at b are the number of roots in
    /// (a, b].
    pub(crate) fn variations(&self, index: &Integer, bits: u32) -> usize {
        let mut count = 0;
        let mut previous = Ordering::Equal;
        for term in &self.terms {
            let sign = term.sign_at_dyadic(index, bits);
            if sign.is_ne() {
                count += usize::from(sign == previous.reverse() && previous.is_ne());
                previous = sign;
            }
        }
        count
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polynomial(coefficients: &[i32]) -> Polynomial {
        Polynomial::new(coefficients.iter().map(|&c| Integer::from(c)).collect())
    }

    #[test]
    fn sturm_counts_distinct_roots_in_the_half_open_interval() {
        // (2t − 1)²(t − 1)(t − 3): two distinct roots in (0, 1].
        let square = polynomial(&[1, -4, 4]);
        let ends = polynomial(&[3, -4, 1]);
        let sequence = SturmSequence::new(&crate::oracle::geometry::Ring::product(&square, &ends));
        let at = |x: i32| sequence.variations(&Integer::from(x), 0);
        assert_eq!(sequence.polynomial().degree(), 3);
        assert_eq!(at(0) - at(1), 2);
        assert_eq!(at(0) - at(3), 3);
        assert_eq!(at(1) - at(2), 0);
    }

    #[test]
    fn remainder_keeps_its_sign_under_a_negative_leading_coefficient() {
        // t² = (−t)(−2t + 1)/2 …: the remainder of t² by 1 − 2t is 1/4 > 0.
        assert_eq!(polynomial(&[0, 0, 1]).remainder(&polynomial(&[1, -2])), polynomial(&[1]));
    }

    #[test]
    fn gcd_finds_the_common_factor() {
        let a = polynomial(&[-2, 1, 1]); // (t − 1)(t + 2)
        let b = polynomial(&[3, -4, 1]); // (t − 1)(t − 3)
        let g = a.gcd(&b);
        assert_eq!(g.degree(), 1);
        assert_eq!(g.sign_at(&Rational::from(1)), Ordering::Equal);
    }
}
