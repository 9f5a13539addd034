//! The signed volume's control values in rational arithmetic.

use super::geometry::Point;
use crate::generator::{Format, PairCase};
use rug::Rational;
use selvedge_core::{PairKind, Scalar};
use std::cmp::Ordering::{self, Greater, Less};

/// Converts a finite number exactly.
///
/// # Panics
/// Panics if it is not finite.
pub fn rational<S: Scalar>(x: S) -> Rational {
    Rational::from_f64(x.to_f64()).expect("finite")
}

pub(crate) fn minus(a: &Point<Rational>, b: &Point<Rational>) -> Point<Rational> {
    std::array::from_fn(|axis| Rational::from(&a[axis] - &b[axis]))
}

pub(crate) fn cross(a: &Point<Rational>, b: &Point<Rational>) -> Point<Rational> {
    let minor = |i: usize, j: usize| Rational::from(&a[i] * &b[j]) - Rational::from(&a[j] * &b[i]);
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

pub(crate) fn dot(a: &Point<Rational>, b: &Point<Rational>) -> Rational {
    a.iter().zip(b).map(|(x, y)| Rational::from(x * y)).sum()
}

/// The volume's control values, the middle ones tripled, and the normals that belong to them. They are computed by interpolation,
/// not by the formula of `selvedge-core`.
#[derive(Clone, Debug)]
pub struct InRationals {
    values: [Rational; 4],
    squared_normals: [Rational; 4],
}

impl InRationals {
    pub fn new<S: Format>(pair: &PairCase<S>) -> Self {
        let points = pair.points.map(|ends| ends.map(|x| x.map(rational)));
        let at = |numerator: i32, denominator: i32| -> [Point<Rational>; 4] {
            let t = Rational::from((numerator, denominator));
            std::array::from_fn(|point| {
                std::array::from_fn(|axis| {
                    let [start, end] = &points[point];
                    Rational::from(&end[axis] - &start[axis]) * &t + &start[axis]
                })
            })
        };
        let volume = |[a, b, c, d]: [Point<Rational>; 4]| match pair.kind {
            PairKind::VertexFace => dot(&minus(&a, &b), &cross(&minus(&c, &b), &minus(&d, &b))),
            // The points a, b, c, p are k, u, v, l.
            PairKind::EdgeEdge => dot(&minus(&d, &c), &cross(&minus(&a, &c), &minus(&b, &c))),
        };
        let normal = |[a, b, c, d]: [Point<Rational>; 4]| match pair.kind {
            PairKind::VertexFace => cross(&minus(&c, &b), &minus(&d, &b)),
            PairKind::EdgeEdge => cross(&minus(&b, &a), &minus(&d, &c)),
        };

        let [v0, v1, v2, v3] = [0, 1, 2, 3].map(|third| volume(at(third, 3)));
        let combined = |factors: [i32; 4]| -> Rational {
            let terms = [&v0, &v1, &v2, &v3].into_iter().zip(factors);
            terms.map(|(v, f)| Rational::from(v * f)).sum::<Rational>() / 2
        };
        let inner = [combined([-5, 18, -9, 2]), combined([2, -9, 18, -5])];
        let [inner_1, inner_2] = inner;

        let [n0, middle, n1] = [0, 1, 2].map(|half| normal(at(half, 2)));
        // The middle normal is n(½) = (n₀ + h + n₁)/4.
        let four = Rational::from(4);
        let h = minus(&minus(&middle.map(|x| x * &four), &n0), &n1);
        let plus = |a: &Point<Rational>, b: &Point<Rational>| -> Point<Rational> {
            std::array::from_fn(|axis| Rational::from(&a[axis] + &b[axis]))
        };
        let normals = [n0.clone(), plus(&n0, &h), plus(&h, &n1), n1];
        Self {
            values: [v0, inner_1, inner_2, v3],
            squared_normals: normals.map(|n| dot(&n, &n)),
        }
    }

    pub fn signs(&self) -> [Ordering; 4] {
        [0, 1, 2, 3].map(|i| self.values[i].cmp0())
    }

    /// Returns whether all four have the same strict sign.
    pub fn have_one_sign(&self) -> bool {
        [[Greater; 4], [Less; 4]].contains(&self.signs())
    }

    /// Returns whether the control value exceeds `separation` times the normal.
    fn is_beyond(&self, i: usize, separation: &Rational) -> bool {
        let bound = separation.clone().square() * &self.squared_normals[i];
        self.values[i].clone().square() > bound
    }

    /// Returns whether each exceeds `separation` times its normal, with one sign.
    pub fn are_beyond(&self, separation: &Rational) -> bool {
        self.have_one_sign() && (0..4).all(|i| self.is_beyond(i, separation))
    }

    /// Returns the square of the largest separation that they exceed, if there is a largest one.
    ///
    /// # Panics
    /// Panics if all normals and all values are zero.
    pub fn squared_separation(&self) -> Option<Rational> {
        // If the normal is zero, the value, which is not, exceeds it times any separation.
        let bounded = (0..4).filter(|&i| self.squared_normals[i].is_positive());
        let squares = bounded.map(|i| self.values[i].clone().square() / &self.squared_normals[i]);
        self.have_one_sign()
            .then(|| squares.min().expect("were all four zero, the values would be"))
    }
}
