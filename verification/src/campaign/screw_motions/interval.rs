//! Enclosures: intervals of `f64`, each operation rounded outwards.

use rug::{Assign, Float};
use std::ops::{Add, Div, Mul, Sub};

/// All real numbers from `low` to `high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Interval {
    pub(super) low: f64,
    pub(super) high: f64,
}

/// Widens two bounds that were rounded to nearest: the exact ones are between their neighbours. A NaN, such as that of infinity
/// minus infinity, becomes an infinite bound.
fn outwards(low: f64, high: f64) -> Interval {
    let known = |bound: f64, unknown: f64| if bound.is_nan() { unknown } else { bound };
    Interval {
        low: known(low.next_down(), f64::NEG_INFINITY),
        high: known(high.next_up(), f64::INFINITY),
    }
}

impl From<f64> for Interval {
    fn from(x: f64) -> Self {
        Self { low: x, high: x }
    }
}

impl Interval {
    /// Encloses a number with more digits.
    fn of(x: &Float) -> Self {
        let nearest = x.to_f64();
        outwards(nearest, nearest)
    }

    /// Encloses sine and cosine of the product of two numbers.
    pub(super) fn sine_and_cosine(angle: f64, time: f64) -> [Self; 2] {
        // The product of two 53-bit numbers is exact in 128 bits. MPFR rounds sine and cosine correctly to 64 bits, so the error is at most
        // 1/4096 of the distance of two neighbouring `f64`s. Hence the exact value lies between the neighbours of the nearest `f64`.
        let angle = Float::with_val(128, angle) * time;
        let mut rounded = (Float::new(64), Float::new(64));
        (&mut rounded.0, &mut rounded.1).assign(angle.sin_cos_ref());
        [Self::of(&rounded.0), Self::of(&rounded.1)]
    }

    pub(super) fn square(self) -> Self {
        let (a, b) = (self.low.abs(), self.high.abs());
        let least = if self.low <= 0.0 && self.high >= 0.0 { 0.0 } else { a.min(b) };
        let square = outwards(least * least, a.max(b) * a.max(b));
        Self {
            low: square.low.max(0.0),
            ..square
        }
    }

    /// Encloses the square roots of the nonnegative numbers of the interval.
    pub(super) fn root(self) -> Self {
        let root = outwards(self.low.max(0.0).sqrt(), self.high.sqrt());
        Self {
            low: root.low.max(0.0),
            ..root
        }
    }
}

impl Add for Interval {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        outwards(self.low + other.low, self.high + other.high)
    }
}

impl Sub for Interval {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        outwards(self.low - other.high, self.high - other.low)
    }
}

impl Mul for Interval {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let products = [
            self.low * other.low,
            self.low * other.high,
            self.high * other.low,
            self.high * other.high,
        ];
        // A minimum may drop NaN.
        let unknown = 0.0 * products.iter().sum::<f64>();
        let low = products.into_iter().fold(f64::INFINITY, f64::min) + unknown;
        let high = products.into_iter().fold(f64::NEG_INFINITY, f64::max) + unknown;
        outwards(low, high)
    }
}

impl Div for Interval {
    type Output = Self;

    /// Divides by a positive interval. For any other divisor the result is all real numbers.
    fn div(self, other: Self) -> Self {
        if other.low <= 0.0 {
            return outwards(f64::NAN, f64::NAN);
        }
        let bounds = [
            self.low / other.low,
            self.low / other.high,
            self.high / other.low,
            self.high / other.high,
        ];
        let unknown = 0.0 * bounds.iter().sum::<f64>();
        let low = bounds.into_iter().fold(f64::INFINITY, f64::min) + unknown;
        let high = bounds.into_iter().fold(f64::NEG_INFINITY, f64::max) + unknown;
        outwards(low, high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use rug::Rational;

    fn exact(x: f64) -> Rational {
        Rational::from_f64(x).expect("a finite number")
    }

    fn holds(interval: Interval, number: &Rational) -> bool {
        (interval.low.is_infinite() || exact(interval.low) <= *number)
            && (interval.high.is_infinite() || *number <= exact(interval.high))
    }

    fn number() -> impl Strategy<Value = f64> {
        prop_oneof![-10.0..10.0, Just(0.0), -1e-300..1e-300, prop::num::f64::NORMAL]
    }

    proptest! {
        #[test]
        fn what_is_computed_of_two_numbers_is_enclosed(a in number(), b in number(), c in number(), d in number()) {
            let [x, y] = [[a, b], [c, d]].map(|[from, to]| Interval { low: from.min(to), high: from.max(to) });
            for (p, q) in [(a, c), (a, d), (b, c), (b, d)] {
                let (p, q) = (exact(p), exact(q));
                prop_assert!(holds(x + y, &Rational::from(&p + &q)));
                prop_assert!(holds(x - y, &Rational::from(&p - &q)));
                prop_assert!(holds(x * y, &Rational::from(&p * &q)));
                if q != 0 {
                    prop_assert!(holds(x / y, &Rational::from(&p / &q)));
                }
                prop_assert!(holds(x.square(), &Rational::from(&p * &p)));
                let Interval { low, high } = x.square().root();
                let size = Rational::from(p.abs_ref());
                prop_assert!(low >= 0.0 && exact(low) <= size && (high.is_infinite() || size <= exact(high)));
            }
        }

        #[test]
        fn sine_and_cosine_are_enclosed(angle in -1e6..1e6, time in 0.0..1.0) {
            let exact = Float::with_val(512, angle) * Float::with_val(512, time);
            let (sine, cosine) = exact.sin_cos(Float::new(512));
            for (interval, exact) in Interval::sine_and_cosine(angle, time).into_iter().zip([sine, cosine]) {
                prop_assert!(interval.low <= exact && exact <= interval.high && interval.high - interval.low < 1e-15);
            }
        }
    }
}
