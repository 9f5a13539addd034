//! Runs the certified filter on numbers of 4 to 9 significant bits, in every floating-point environment, on every input of a
//! grid.
//!
//! # Proven precisions
//! The constants 16u and 20u cover 7 and 9 roundings of 2u each, as any direction may have. This requires u ≤ 2⁻⁸ for k₀ and k₃,
//! and u ≤ 2⁻⁹ for 3k₁ and 3k₂. The bounds by magnitudes, 96u and 384u, are proven for u ≤ 2⁻¹⁰. If rounding is to nearest, a
//! rounding is at most u, and 16u and 20u suffice for u ≤ 2⁻⁵. [`the_constants_suffice_for_the_precisions_that_are_documented`]
//! recomputes this; `f32` has u = 2⁻²⁴. So the grids have 5 or 6 bits to nearest, and 9 bits in the other environments.
//!
//! No input may have a wrong sign. The tests also assert how close the grids come to the bounds, so they would detect constants
//! that are a fraction of these.

use crate::support::determinant;
use crate::support::prelude::*;
use rug::ops::Pow;
use selvedge_verification::minifloat::{DOWNWARD, FLUSHING, Minifloat, TO_NEAREST, TOWARDS_ZERO, UPWARD, every, numbers};

/// A moving tetrahedron by the points a, b, c, p at times 0 and 1.
type Points<T> = [[[T; 3]; 2]; 4];

/// Returns one of k₀, 3k₁, 3k₂, k₃ times a power of two, from the definition, in integers.
fn exact_control_value<const E: u32, const F: u32, const ENVIRONMENT: u32>(
    points: &Points<Minifloat<E, F, ENVIRONMENT>>,
    k: usize,
) -> i128 {
    let units = points.map(|ends| ends.map(|x| x.map(|x| i128::from(x.units()))));
    let from_a = |point: usize, end: usize| [0, 1, 2].map(|axis| units[point][end][axis] - units[0][end][axis]);
    let determinant = |i: usize, j: usize, k: usize| determinant([from_a(3, i), from_a(1, j), from_a(2, k)]);
    match k {
        0 => determinant(0, 0, 0),
        1 => determinant(1, 0, 0) + determinant(0, 1, 0) + determinant(0, 0, 1),
        2 => determinant(0, 1, 1) + determinant(1, 0, 1) + determinant(1, 1, 0),
        _ => determinant(1, 1, 1),
    }
}

fn tetrahedron<const E: u32, const F: u32, const ENVIRONMENT: u32>(
    points: &Points<Minifloat<E, F, ENVIRONMENT>>,
) -> MovingTetrahedron<Minifloat<E, F, ENVIRONMENT>> {
    let at = |end: usize| points.map(|ends| Vector::from(ends[end]));
    MovingTetrahedron::from_points(at(0), at(1))
}

/// The findings on a grid.
#[derive(Debug, Default)]
struct Seen {
    inputs: u64,
    culled: u64,
    /// The number of values beyond their bound.
    certain: u64,
    /// The largest ratio of a computed value to its bound if the exact value is zero or has the other sign.
    worst: f64,
}

impl Seen {
    /// Examines one input, and the signs of its control values `which`.
    fn look<const E: u32, const F: u32, const ENVIRONMENT: u32>(
        &mut self,
        points: &Points<Minifloat<E, F, ENVIRONMENT>>,
        which: impl IntoIterator<Item = usize>,
    ) {
        self.inputs += 1;
        let tetrahedron = tetrahedron(points);
        let (values, bounds) = (tetrahedron.control_values(), tetrahedron.error_bounds());
        for k in which {
            let (value, bound) = (values.0[k].value(), bounds[k].value());
            let share = value.abs() / bound;
            self.certain += u64::from(share > 1.0);
            if share > self.worst {
                let sign = if value > 0.0 { 1 } else { -1 };
                if exact_control_value(points, k).signum() != sign {
                    assert!(share <= 1.0, "control value {k} of {points:?} has the wrong sign");
                    self.worst = share;
                }
            }
        }
        if tetrahedron.is_never_coplanar() {
            self.culled += 1;
            let signs = [0, 1, 2, 3].map(|k| exact_control_value(points, k).signum());
            assert!(signs == [1; 4] || signs == [-1; 4], "{points:?} is culled");
        }
    }
}

/// Returns k₀ of every tetrahedron at rest with all twelve coordinates on the grid.
fn at_rest<const E: u32, const F: u32, const ENVIRONMENT: u32>(grid: &[Minifloat<E, F, ENVIRONMENT>]) -> Seen {
    let mut seen = Seen::default();
    every::<_, 12>(grid, |coordinates| {
        let points = std::array::from_fn(|point| [std::array::from_fn(|axis| coordinates[3 * point + axis]); 2]);
        seen.look(&points, [0]);
    });
    assert_eq!(seen.inputs, (grid.len() as u64).pow(12));
    seen
}

#[test]
fn nothing_is_certain_with_4_bits_since_the_bound_is_the_permanent_itself() {
    let seen = at_rest::<4, 3, TO_NEAREST>(&numbers([-1.75, -0.625, 1.25]));
    assert_eq!((seen.certain, seen.culled), (0, 0));
}

#[test]
fn every_tetrahedron_on_a_grid_of_three_values_with_5_bits() {
    let seen = at_rest::<4, 4, TO_NEAREST>(&numbers([-0.71875, 1.8125, 1.875]));
    assert!(seen.certain > 0 && seen.worst > 0.1, "{seen:?}");
}

#[test]
fn every_tetrahedron_on_a_grid_of_three_values_with_6_bits() {
    let seen = at_rest::<4, 5, TO_NEAREST>(&numbers([-1.406_25, -0.765_625, 0.578_125]));
    assert!(seen.certain > 0 && seen.worst > 0.05, "{seen:?}");
}

/// The numbers are subnormal, so products underflow.
#[test]
fn every_tetrahedron_on_a_grid_of_tiny_values_with_5_bits() {
    let seen = at_rest::<4, 4, TO_NEAREST>(&numbers([-0.1875, 0.003_906_25, 0.156_25]));
    assert!(seen.worst > 0.01, "{seen:?}");
}

/// An input must come at least as close as `worst`.
fn every_tetrahedron_with_9_bits<const ENVIRONMENT: u32>(grid: [f64; 3], worst: f64) {
    let seen = at_rest::<5, 8, ENVIRONMENT>(&numbers(grid));
    assert!(seen.culled > 0 && seen.worst > worst, "{seen:?}");
}

#[test]
fn every_tetrahedron_on_a_grid_of_three_values_with_9_bits_in_every_direction() {
    let grid = [-1.363_281_25, 0.869_140_625, 1.925_781_25];
    every_tetrahedron_with_9_bits::<DOWNWARD>(grid, 0.19);
    every_tetrahedron_with_9_bits::<UPWARD>(grid, 0.18);
    every_tetrahedron_with_9_bits::<TOWARDS_ZERO>(grid, 0.11);
}

/// The numbers are about the smallest normal number, 2⁻¹⁴, so differences and products are flushed.
#[test]
fn every_tetrahedron_on_a_grid_of_tiny_values_with_9_bits_where_they_are_flushed() {
    let grid = [-1.0 / 16_384.0, 1.5 / 16_384.0, 1.0];
    every_tetrahedron_with_9_bits::<{ TO_NEAREST | FLUSHING }>(grid, 0.001);
    every_tetrahedron_with_9_bits::<{ DOWNWARD | FLUSHING }>(grid, 0.06);
    every_tetrahedron_with_9_bits::<{ UPWARD | FLUSHING }>(grid, 0.001);
    every_tetrahedron_with_9_bits::<{ TOWARDS_ZERO | FLUSHING }>(grid, 0.001);
}

/// Runs the filter on every motion whose ends are among `ends`. k₀ and k₃ depend on one end each. So only ends whose own value is
/// beyond its bound can be part of a culled motion, and all pairs of those are tried.
fn every_motion_between<const E: u32, const F: u32, const ENVIRONMENT: u32>(
    ends: &[[[Minifloat<E, F, ENVIRONMENT>; 3]; 4]],
) -> Seen {
    let mut certain_ends = [Vec::new(), Vec::new()];
    for end in ends {
        let tetrahedron = tetrahedron(&end.map(|point| [point; 2]));
        let value = tetrahedron.control_values().0[0].value();
        if value.abs() > tetrahedron.error_bounds()[0].value() {
            certain_ends[usize::from(value < 0.0)].push(end);
        }
    }
    let mut seen = Seen::default();
    for ends in certain_ends {
        for start in &ends {
            for end in &ends {
                seen.look(&std::array::from_fn(|k| [start[k], end[k]]), 0..4);
            }
        }
    }
    seen
}

#[test]
fn every_motion_around_a_point_at_rest_on_a_grid_of_three_values_with_5_bits() {
    type Number = Minifloat<4, 4>;
    let grid: [Number; 3] = numbers([0.53125, 1.3125, 1.9375]);
    let zero = Number::nearest(0.0);
    let mut ends = Vec::new();
    every::<_, 9>(&grid, |[b, c, d, e, f, g, h, i, j]| {
        ends.push([[zero; 3], [b, c, d], [e, f, g], [h, i, j]]);
    });
    // There are 3⁹ ends and 3¹⁸ motions.
    assert_eq!(ends.len(), 19_683);
    let seen = every_motion_between(&ends);
    assert!(seen.culled > 0, "{seen:?}");
}

#[test]
fn every_motion_of_four_points_on_grids_of_two_values_with_5_bits() {
    type Number = Minifloat<4, 4>;
    for grid in [[-1.875, 0.8125], [0.625, 1.875]] {
        let grid: [Number; 2] = numbers(grid);
        let mut ends = Vec::new();
        every::<_, 12>(&grid, |x| {
            ends.push(std::array::from_fn(|point| std::array::from_fn(|axis| x[3 * point + axis])));
        });
        // There are 2¹² ends and 2²⁴ motions.
        assert_eq!(ends.len(), 4096);
        let seen = every_motion_between(&ends);
        assert!(seen.culled > 0, "{seen:?}");
    }
}

/// The test covers the middle value of all 2¹⁸ motions, culled or not.
#[test]
fn every_middle_control_value_on_grids_of_two_values_with_6_bits() {
    type Number = Minifloat<4, 5>;
    let zero = Number::nearest(0.0);
    for grid in [[-1.125, 0.75], [-1.625, 0.5], [-1.375, 1.25]] {
        let grid: [Number; 2] = numbers(grid);
        let mut seen = Seen::default();
        every::<_, 18>(&grid, |numbers| {
            let mut points = [[[zero; 3]; 2]; 4];
            let components = points[1..].iter_mut().flatten().flatten();
            components.zip(numbers).for_each(|(component, number)| *component = number);
            seen.look(&points, [1]);
        });
        assert!(seen.certain > 0 && seen.worst > 0.01, "{seen:?}");
    }
}

/// Returns (1 + x)^n.
fn power(x: &Rational, n: u32) -> Rational {
    (Rational::from(x) + 1_u32).pow(n)
}

#[test]
fn the_constants_suffice_for_the_precisions_that_are_documented() {
    // Returns whether `constant`·u, less `lost` roundings, covers `count` monomials of `roundings` roundings each. `per_rounding`
    // is the largest error of one rounding, and `more` is the number of roundings in the computed magnitudes.
    let covers = |u: &Rational, per_rounding: u32, [constant, lost, count, roundings, more]: [u32; 5]| {
        let rounding = Rational::from(u * per_rounding);
        let down = Rational::from(-&rounding);
        let needed = (power(&rounding, roundings) - 1_u32) * count / power(&down, more);
        Rational::from(u * constant) * power(&down, lost) >= needed
    };
    let (outer, inner) = ([16, 10, 1, 7, 0], [20, 13, 1, 9, 0]);
    let by_magnitudes = [[96, 5, 6, 7, 3], [384, 5, 18, 9, 3]];
    for bits in 5..=53 {
        let u = Rational::from(1) >> bits;
        assert!(covers(&u, 1, outer) && covers(&u, 1, inner), "{bits}");
        assert!(bits < 8 || covers(&u, 2, outer), "{bits}");
        assert!(bits < 9 || covers(&u, 2, inner), "{bits}");
        for constants in by_magnitudes {
            assert!(bits < 10 || covers(&u, 2, constants), "{bits}");
        }
    }
    let at = |bits: u32| Rational::from(1) >> bits;
    assert!(!covers(&at(4), 1, outer));
    assert!(!covers(&at(7), 2, outer) && !covers(&at(8), 2, inner));
}
