//! Enclosures: intervals of `f64`, each operation rounded outwards.

use dashu_float::{ConstCache, Context, FBig, round::mode::HalfEven};
use std::cell::RefCell;
use std::ops::{Add, Div, Mul, Sub};

/// A number of so many binary digits.
type Float = FBig<HalfEven>;

thread_local! {
    /// Its digits, which angles are reduced by.
    static PI: RefCell<ConstCache> = const { RefCell::new(ConstCache::new()) };
}

fn float(x: f64, digits: usize) -> Float {
    Float::try_from(x).expect("not NaN").with_precision(digits).value()
}

/// All real numbers from the first to the second.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Interval {
    pub(super) low: f64,
    pub(super) high: f64,
}

/// Of two bounds to nearest: the exact ones are between the numbers next to them. NaN, as of infinity minus infinity, becomes all numbers.
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
    /// That holds a number of more digits.
    fn of(x: &Float) -> Self {
        let nearest = x.to_f64().value();
        outwards(nearest, nearest)
    }

    /// Sine and cosine of the product of two numbers.
    pub(super) fn sine_and_cosine(angle: f64, time: f64) -> [Self; 2] {
        // The product of two times 53 digits is exact. Sine and cosine are correctly rounded to 64: by at most a 4096th of what two
        // neighbours of `f64` are apart, so that the nearest `f64` is no farther off than its neighbours.
        let angle = float(angle, 128) * float(time, 128);
        let (sine, cosine) = PI.with_borrow_mut(|pi| Context::<HalfEven>::new(64).sin_cos(angle.repr(), Some(pi)));
        [sine, cosine].map(|rounded| Self::of(&rounded.expect("of a finite angle").value()))
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

    /// Of what is in it and not less than zero.
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

    /// By one that is more than zero; else all numbers.
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
    use dashu_base::Abs;
    use dashu_ratio::RBig;
    use proptest::prelude::*;

    fn exact(x: f64) -> RBig {
        RBig::try_from(x).expect("a finite number")
    }

    fn holds(interval: Interval, number: &RBig) -> bool {
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
                prop_assert!(holds(x + y, &(&p + &q)));
                prop_assert!(holds(x - y, &(&p - &q)));
                prop_assert!(holds(x * y, &(&p * &q)));
                if !q.is_zero() {
                    prop_assert!(holds(x / y, &(&p / &q)));
                }
                prop_assert!(holds(x.square(), &p.sqr()));
                let Interval { low, high } = x.square().root();
                let size = p.clone().abs();
                prop_assert!(low >= 0.0 && exact(low) <= size && (high.is_infinite() || size <= exact(high)));
            }
        }

        #[test]
        fn sine_and_cosine_are_enclosed(angle in -1e6..1e6, time in 0.0..1.0) {
            let (sine, cosine) = (float(angle, 512) * float(time, 512)).sin_cos();
            for (interval, exact) in Interval::sine_and_cosine(angle, time).into_iter().zip([sine, cosine]) {
                prop_assert!(float(interval.low, 512) <= exact && exact <= float(interval.high, 512) && interval.high - interval.low < 1e-15);
            }
        }
    }
}
