//! Primitive pairs in linear motion, with their coordinates scaled to integers.

use super::geometry::{Point, Ring};
use super::polynomial::Polynomial;
use rug::{Integer, Rational};
// This is a name, not arithmetic.
pub use selvedge_core::PairKind;

/// Four points that move linearly from their positions at time 0 to those at time 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    pub kind: PairKind,
    pub start: [[f64; 3]; 4],
    pub end: [[f64; 3]; 4],
}

impl Pair {
    pub const fn new(kind: PairKind, start: [[f64; 3]; 4], end: [[f64; 3]; 4]) -> Self {
        Self { kind, start, end }
    }
}

/// Returns the set, 0 or 1, to which one of the four points belongs.
pub const fn side_of(kind: PairKind, point: usize) -> usize {
    (point >= points_of_first(kind)) as usize
}

/// Returns the number of points in the first set.
pub const fn points_of_first(kind: PairKind) -> usize {
    match kind {
        PairKind::VertexFace => 1,
        PairKind::EdgeEdge => 2,
    }
}

/// Returns mantissa and exponent: `value = mantissa · 2^exponent`, with the mantissa odd or zero.
fn decode(value: f64) -> (i64, i32) {
    assert!(value.is_finite(), "coordinates must be finite, not {value}");
    let bits = value.to_bits();
    let exponent = i32::try_from((bits >> 52) & 0x7ff).expect("eleven bits");
    let fraction = i64::try_from(bits & ((1 << 52) - 1)).expect("52 bits");
    let magnitude = if exponent == 0 { fraction } else { fraction | (1 << 52) };
    if magnitude == 0 {
        return (0, 0);
    }
    let zeros = magnitude.trailing_zeros();
    let mantissa = (magnitude >> zeros) * if value.is_sign_negative() { -1 } else { 1 };
    (mantissa, exponent.max(1) - 1075 + zeros.cast_signed())
}

/// Returns the points, all times the same power of two: the smallest that makes them integers.
///
/// # Panics
/// Panics if a coordinate is NaN or infinite.
pub(crate) fn scale_to_integers(points: &[[f64; 3]]) -> Vec<Point<Integer>> {
    let coordinates = points.iter().flatten().map(|&x| decode(x));
    let exponent = coordinates.filter(|&(m, _)| m != 0).map(|(_, e)| e).min().unwrap_or(0);
    let scale = |x: f64| match decode(x) {
        (0, _) => Integer::new(),
        (mantissa, e) => Integer::from(mantissa) << (e - exponent).cast_unsigned(),
    };
    points.iter().map(|point| point.map(scale)).collect()
}

/// Four points in motion, scaled to integers.
pub(crate) struct Motion {
    start: [Point<Integer>; 4],
    end: [Point<Integer>; 4],
}

impl Motion {
    pub(crate) fn new(start: &[[f64; 3]; 4], end: &[[f64; 3]; 4]) -> Self {
        let mut points = scale_to_integers(&[*start, *end].concat()).into_iter();
        let mut four = || std::array::from_fn(|_| points.next().expect("eight points"));
        Self {
            start: four(),
            end: four(),
        }
    }

    /// Returns the points of a pair and a length, at a common scale.
    pub(crate) fn with_separation(pair: &Pair, separation: f64) -> (Self, Integer) {
        let length = [[separation, 0.0, 0.0]; 4];
        let [start, end] = [&pair.start, &pair.end].map(|side| side.as_slice());
        let mut points = scale_to_integers(&[start, end, &length[..1]].concat());
        let [separation, _, _] = points.pop().expect("nine points");
        let mut points = points.into_iter();
        let mut four = || std::array::from_fn(|_| points.next().expect("eight points"));
        (
            Self {
                start: four(),
                end: four(),
            },
            separation,
        )
    }

    /// Returns whether the two sides of the pair are more than `separation` apart along one coordinate axis, in the same order at
    /// both ends of the step. Linear motion then keeps them so in between.
    pub(crate) fn apart_along_an_axis(&self, kind: PairKind, separation: &Integer) -> bool {
        let first = points_of_first(kind);
        let apart = |low: usize, high: usize, axis: usize| {
            [&self.start, &self.end]
                .iter()
                .all(|positions| Integer::from(&positions[high][axis] - &positions[low][axis]) > *separation)
        };
        let side = |swapped: bool, axis: usize| {
            (0..first).all(|i| (first..4).all(|j| if swapped { apart(j, i, axis) } else { apart(i, j, axis) }))
        };
        (0..3).any(|axis| side(false, axis) || side(true, axis))
    }

    pub(crate) fn trajectories(&self) -> [Point<Polynomial>; 4] {
        std::array::from_fn(|point| {
            std::array::from_fn(|axis| {
                let (start, end) = (&self.start[point][axis], &self.end[point][axis]);
                Polynomial::new(vec![start.clone(), end.clone().difference(start)])
            })
        })
    }

    /// Returns the points at time `t`, times its (positive) denominator.
    pub(crate) fn at(&self, t: &Rational) -> [Point<Integer>; 4] {
        std::array::from_fn(|point| {
            std::array::from_fn(|axis| {
                let (start, end) = (&self.start[point][axis], &self.end[point][axis]);
                Integer::from(end - start) * t.numer() + Integer::from(start * t.denom())
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_finite_number_is_decoded_exactly() {
        for value in [1.0, -0.1, f64::MAX, f64::MIN_POSITIVE, 5e-324, -5e-324 * 3.0, 0.0, -0.0] {
            let (mantissa, exponent) = decode(value);
            let decoded = Rational::from(mantissa) << exponent;
            assert_eq!(decoded, Rational::from_f64(value).expect("finite"));
        }
    }

    #[test]
    fn common_scale_keeps_the_ratios() {
        let values = [0.5, 3.0, 5e-324];
        let integers = &scale_to_integers(&[values])[0];
        let exact = values.map(|x| Rational::from_f64(x).expect("finite"));
        for (integer, value) in integers.iter().zip(&exact) {
            let ratio = Rational::from((integer, &integers[0]));
            assert_eq!(ratio, Rational::from(value / &exact[0]));
        }
    }
}
