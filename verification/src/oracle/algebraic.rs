//! Times in [0, 1] that are roots of polynomials.

use super::geometry::Signs;
use super::polynomial::{Polynomial, SturmSequence};
use rug::ops::DivRounding;
use rug::{Integer, Rational};
use std::cmp::Ordering;

/// A real root, in [0, 1], of a polynomial with integer coefficients. It is known exactly; equality and order are those of the
/// numbers.
#[derive(Clone, Debug)]
pub struct AlgebraicTime {
    /// A square-free polynomial that has this root.
    polynomial: Polynomial,
    place: RootPlace,
}

#[derive(Clone, Debug)]
enum RootPlace {
    Exact(Rational),
    /// The only root in the closed interval `[index, index + 1] / 2^bits`, and not at an end of it.
    Isolated {
        index: Integer,
        bits: u32,
        /// The polynomial's sign at the low end.
        sign_at_low: Ordering,
        /// The number of bits that [`AlgebraicTime::narrow`] tries to add next.
        pace: u32,
    },
}

/// The number of bits to which [`sign`](Signs::sign) narrows an interval before a greatest common divisor decides whether the
/// value is zero. It affects speed alone.
const BITS_BEFORE_GCD: u32 = 48;

impl AlgebraicTime {
    /// Makes a rational time.
    ///
    /// # Panics
    /// Panics if it is not in [0, 1].
    pub fn rational(time: Rational) -> Self {
        assert!((0..=1).contains(&time), "a time of the step lies in [0, 1], not at {time}");
        let coefficients = vec![Integer::from(-time.numer()), time.denom().clone()];
        Self {
            polynomial: Polynomial::new(coefficients),
            place: RootPlace::Exact(time),
        }
    }

    /// Returns the distinct roots in [0, 1] of a polynomial that is not zero, in ascending order.
    pub(crate) fn roots(polynomial: &Polynomial) -> Vec<Self> {
        let mut roots = Vec::new();
        if polynomial.degree() == 0 {
            return roots;
        }
        let isolation = Isolation(SturmSequence::new(polynomial));
        let (low, high) = (isolation.end(&Integer::from(0), 0), isolation.end(&Integer::from(1), 0));
        if low.sign.is_eq() {
            roots.push(Self::rational(Rational::from(0)));
        }
        isolation.inside(Integer::from(0), 0, &low, &high, &mut roots);
        if high.sign.is_eq() {
            roots.push(Self::rational(Rational::from(1)));
        }
        roots
    }

    /// Returns a square-free polynomial that has this root.
    pub fn polynomial(&self) -> &Polynomial {
        &self.polynomial
    }

    /// Returns the value if it is known to be rational. For the times that [`collides`](super::collides) returns it is known if
    /// it is rational.
    pub fn as_rational(&self) -> Option<&Rational> {
        match &self.place {
            RootPlace::Exact(value) => Some(value),
            RootPlace::Isolated { .. } => None,
        }
    }

    /// Returns an interval that holds this root and no other root of [`polynomial`](Self::polynomial). Both ends are the root
    /// itself if it is known to be rational.
    pub fn interval(&self) -> [Rational; 2] {
        match &self.place {
            RootPlace::Exact(value) => [value.clone(), value.clone()],
            RootPlace::Isolated { index, bits, .. } => {
                [index.clone(), Integer::from(index + 1)].map(|end| Rational::from(end) >> *bits)
            }
        }
    }

    /// Makes the interval no wider than `2^-bits`.
    pub fn refine(&mut self, bits: u32) {
        while self.bits() < bits {
            self.narrow();
        }
    }

    /// Returns the largest n such that the interval is no wider than `2^-n`.
    fn bits(&self) -> u32 {
        match self.place {
            RootPlace::Exact(_) => u32::MAX,
            RootPlace::Isolated { bits, .. } => bits,
        }
    }

    /// Halves the interval at least. Near the root the number of known bits doubles.
    ///
    /// This is quadratic interval refinement (J. Abbott 2006): the secant shows which of `2^pace` parts of the interval should
    /// hold the root. If that part holds it, the next step uses twice the pace.
    fn narrow(&mut self) {
        let RootPlace::Isolated {
            index,
            bits,
            sign_at_low,
            pace,
        } = &mut self.place
        else {
            return;
        };
        let low = self.polynomial.value_at_dyadic(index, *bits);
        let high = self.polynomial.value_at_dyadic(&Integer::from(&*index + 1), *bits);
        // The signs differ, so the quotient is in (0, 1), and its scaled floor is a valid part.
        let part = (Integer::from(&low << *pace)).div_floor(low - high);
        *index <<= *pace;
        *index += part;
        *bits += *pace;
        let ends = [index.clone(), Integer::from(&*index + 1)];
        let signs = ends.each_ref().map(|end| self.polynomial.sign_at_dyadic(end, *bits));
        if let Some(found) = signs.iter().position(|sign| sign.is_eq()) {
            self.place = RootPlace::Exact(Rational::from(ends[found].clone()) >> *bits);
        } else if signs[0] == *sign_at_low && signs[1] != *sign_at_low {
            *pace *= 2;
        } else {
            // The guess was wrong: returns to the interval before it, and halves that.
            *index >>= *pace;
            *bits -= *pace;
            *pace = (*pace / 2).max(1);
            self.halve();
        }
    }

    fn halve(&mut self) {
        if let RootPlace::Isolated {
            index,
            bits,
            sign_at_low,
            ..
        } = &mut self.place
        {
            *index <<= 1;
            *bits += 1;
            let middle = Integer::from(&*index + 1);
            let sign = self.polynomial.sign_at_dyadic(&middle, *bits);
            if sign.is_eq() {
                self.place = RootPlace::Exact(Rational::from(middle) >> *bits);
            } else if sign == *sign_at_low {
                *index = middle;
            }
        }
    }

    pub fn cmp_rational(&self, other: &Rational) -> Ordering {
        match &self.place {
            RootPlace::Exact(value) => value.cmp(other),
            RootPlace::Isolated { sign_at_low, .. } => {
                let [low, high] = self.interval();
                if *other <= low {
                    Ordering::Greater
                } else if *other >= high {
                    Ordering::Less
                } else {
                    match self.polynomial.sign_at(other) {
                        Ordering::Equal => Ordering::Equal,
                        sign if sign == *sign_at_low => Ordering::Greater,
                        _ => Ordering::Less,
                    }
                }
            }
        }
    }

    /// Compares with a floating-point number, exactly.
    ///
    /// # Panics
    /// Panics if `other` is NaN.
    pub fn cmp_f64(&self, other: f64) -> Ordering {
        assert!(!other.is_nan(), "NaN has no place among the times");
        match Rational::from_f64(other) {
            Some(value) => self.cmp_rational(&value),
            None if other > 0.0 => Ordering::Less,
            None => Ordering::Greater,
        }
    }

    /// Returns the largest floating-point number that is not above the root.
    pub fn to_f64_down(&self) -> f64 {
        // The representations of nonnegative floats are ordered as the floats are.
        let (mut below, mut above) = (0_f64.to_bits(), 1_f64.next_up().to_bits());
        while above - below > 1 {
            let middle = below.midpoint(above);
            if self.cmp_f64(f64::from_bits(middle)).is_ge() {
                below = middle;
            } else {
                above = middle;
            }
        }
        f64::from_bits(below)
    }

    /// Returns the same number, known to be rational if it is.
    ///
    /// A rational root times the leading coefficient is an integer.
    pub(crate) fn settled(mut self) -> Self {
        let lead = self.polynomial.coefficients().last().map(|c| Integer::from(c.abs_ref()));
        let lead = lead.expect("not the zero polynomial");
        self.refine(lead.significant_bits() + 1);
        if let RootPlace::Isolated { index, bits, .. } = &self.place {
            // The interval is shorter than 1 / lead, so it can hold no other candidate.
            let candidate = ((Integer::from(&lead * index) >> *bits) + 1, lead);
            let candidate = Rational::from(candidate);
            if self.cmp_rational(&candidate).is_eq() {
                self.place = RootPlace::Exact(candidate);
            }
        }
        self
    }
}

impl Signs<Polynomial> for AlgebraicTime {
    /// Returns the sign of another polynomial at this time.
    fn sign(&mut self, value: &Polynomial) -> Ordering {
        let mut is_not_zero = false;
        loop {
            let (index, bits, pace) = match &self.place {
                RootPlace::Exact(time) => return value.sign_at(time),
                RootPlace::Isolated { index, bits, pace, .. } => (index, *bits, *pace),
            };
            if let Some(sign) = value.sign_on_cell(index, bits) {
                return sign;
            }
            if !is_not_zero && bits >= BITS_BEFORE_GCD {
                // A common factor is square-free like the polynomial, and not zero at the ends of the interval. It has the root
                // if it changes sign.
                let common = self.polynomial.gcd(value);
                let sign_at_low = common.sign_at_dyadic(index, bits);
                if sign_at_low != common.sign_at_dyadic(&Integer::from(index + 1), bits) {
                    // The common factor describes the root as well, and is simpler.
                    self.place = RootPlace::Isolated {
                        index: index.clone(),
                        bits,
                        sign_at_low,
                        pace,
                    };
                    self.polynomial = common;
                    return Ordering::Equal;
                }
                is_not_zero = true;
            }
            self.narrow();
        }
    }
}

impl Ord for AlgebraicTime {
    fn cmp(&self, other: &Self) -> Ordering {
        let (mut a, mut b) = (self.clone(), other.clone());
        let mut b_vanishes_at_a = None;
        loop {
            if let Some(value) = b.as_rational() {
                return a.cmp_rational(value);
            }
            if let Some(value) = a.as_rational() {
                return b.cmp_rational(value).reverse();
            }
            let ([a_low, a_high], [b_low, b_high]) = (a.interval(), b.interval());
            if a_high <= b_low {
                return Ordering::Less;
            }
            if b_high <= a_low {
                return Ordering::Greater;
            }
            // If a is a root of b's polynomial and in b's interval, it is b.
            if *b_vanishes_at_a.get_or_insert_with(|| a.sign(&b.polynomial).is_eq())
                && a.cmp_rational(&b_low).is_gt()
                && a.cmp_rational(&b_high).is_lt()
            {
                return Ordering::Equal;
            }
            // Only the wider one is narrowed. One may double its bits while the other still adds one at a time; narrowing both
            // would give the first exponentially many bits.
            if a.bits() <= b.bits() {
                a.narrow();
            } else {
                b.narrow();
            }
        }
    }
}

impl PartialOrd for AlgebraicTime {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for AlgebraicTime {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for AlgebraicTime {}

struct Isolation(SturmSequence);

/// An end of an interval, with what the sequence shows there.
struct End {
    variations: usize,
    sign: Ordering,
}

impl Isolation {
    fn end(&self, index: &Integer, bits: u32) -> End {
        let variations = self.0.variations(index, bits);
        End {
            variations,
            sign: self.0.polynomial().sign_at_dyadic(index, bits),
        }
    }

    /// Appends the roots in the open interval `(index, index + 1) / 2^bits`, in ascending order.
    fn inside(&self, index: Integer, bits: u32, low: &End, high: &End, roots: &mut Vec<AlgebraicTime>) {
        let count = low.variations - high.variations - usize::from(high.sign.is_eq());
        if count == 0 {
            return;
        }
        let polynomial = self.0.polynomial();
        if count == 1 && low.sign.is_ne() && high.sign.is_ne() {
            let place = RootPlace::Isolated {
                index,
                bits,
                sign_at_low: low.sign,
                pace: 1,
            };
            roots.push(AlgebraicTime {
                polynomial: polynomial.clone(),
                place,
            });
            return;
        }
        let left = index << 1;
        let right = Integer::from(&left + 1);
        let middle = self.end(&right, bits + 1);
        self.inside(left, bits + 1, low, &middle, roots);
        if middle.sign.is_eq() {
            let time = Rational::from(right.clone()) >> (bits + 1);
            roots.push(AlgebraicTime {
                polynomial: polynomial.clone(),
                place: RootPlace::Exact(time),
            });
        }
        self.inside(right, bits + 1, &middle, high, roots);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::oracle::geometry::Ring;
    use proptest::prelude::*;

    /// Generates products of small factors, with roots at both ends, in between and outside, single, repeated, or without a root.
    fn polynomials() -> impl Strategy<Value = Polynomial> {
        let factor = prop::collection::vec(-4..=4, 2..=4);
        let factors = prop::collection::vec(factor, 1..=3);
        let product = factors.prop_map(|factors| {
            let factors = factors
                .into_iter()
                .map(|own| Polynomial::new(own.into_iter().map(Integer::from).collect()));
            factors.reduce(|a, b| a.product(&b)).expect("one factor at least")
        });
        product.prop_filter("every number is a root of zero", |product| !product.is_zero())
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4_000))]

        #[test]
        fn roots_are_those_that_sturm_counts_and_in_order(polynomial in polynomials()) {
            let sequence = SturmSequence::new(&polynomial);
            let at = |t: i32| sequence.variations(&Integer::from(t), 0);
            let at_start = usize::from(polynomial.sign_at_dyadic(&Integer::from(0), 0).is_eq());
            let roots = AlgebraicTime::roots(&polynomial);
            prop_assert_eq!(roots.len(), at(0) - at(1) + at_start);
            prop_assert!(roots.is_sorted_by(|a, b| a < b));
            for mut root in roots {
                prop_assert!(root.sign(&polynomial).is_eq());
                let common = root.polynomial().gcd(&polynomial);
                prop_assert!(root.sign(&common).is_eq(), "{root:?} is a root of another polynomial");
            }
        }
    }
}
