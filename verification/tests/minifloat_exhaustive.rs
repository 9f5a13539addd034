//! The certified filter on numbers of 3 to 5 significant bits: every input of a grid, none left out.
//!
//! # What is proven for which precision
//! The constants 8u and 10u cover the first-order terms of 7 and 9 roundings, and leave one u for all that is of higher
//! order. By hand, for k₀: the exact value's monomials pass through at most 7 roundings that count, the computed permanent has lost
//! at most 8, and adding the underflow term rounds once more, so that a sufficient condition is
//! 8u(1 − u)⁹ ≥ (1 + u)⁷ − 1, true for u ≤ 2⁻⁷. For 3k₁: the product with 10u rounds as well, 10u(1 − u)¹² ≥ (1 + u)⁹ − 1, true for
//! u ≤ 2⁻⁸. So **as they stand the constants are proven from 8 significant bits on**
//! ([`the_constants_suffice_from_eight_significant_bits_on`]); `f32` has 24.
//!
//! Below that the proof fails but the filter does not: no input here has a wrong sign, and a search that climbs from random inputs in
//! formats of 2 to 11 bits (20 s each) found no wrong-signed value above 0.375 of its bound. The tests assert how close the
//! grids come, so that a constant cut to a fifth would be seen.

use selvedge_core::Vector;
use selvedge_core::coplanarity::MovingTetrahedron;
use selvedge_verification::minifloat::Minifloat;

/// A moving tetrahedron by the points a, b, c, p at times 0 and 1.
type Points<T> = [[[T; 3]; 2]; 4];

/// From the definition, in whole numbers: one of k₀, 3k₁, 3k₂, k₃ times a power of two.
fn exact_control_value<const E: u32, const F: u32>(
    points: &Points<Minifloat<E, F>>,
    k: usize,
) -> i64 {
    let units = points.map(|ends| ends.map(|x| x.map(Minifloat::units)));
    let from_a = |point: usize, end: usize| {
        [0, 1, 2].map(|axis| units[point][end][axis] - units[0][end][axis])
    };
    let determinant = |i: usize, j: usize, k: usize| {
        let [p, b, c] = [from_a(3, i), from_a(1, j), from_a(2, k)];
        p[0] * b[1] * c[2] + p[1] * b[2] * c[0] + p[2] * b[0] * c[1]
            - p[2] * b[1] * c[0]
            - p[0] * b[2] * c[1]
            - p[1] * b[0] * c[2]
    };
    match k {
        0 => determinant(0, 0, 0),
        1 => determinant(1, 0, 0) + determinant(0, 1, 0) + determinant(0, 0, 1),
        2 => determinant(0, 1, 1) + determinant(1, 0, 1) + determinant(1, 1, 0),
        _ => determinant(1, 1, 1),
    }
}

fn tetrahedron<const E: u32, const F: u32>(
    points: &Points<Minifloat<E, F>>,
) -> MovingTetrahedron<Minifloat<E, F>> {
    let at = |end: usize| points.map(|ends| Vector::from(ends[end]));
    MovingTetrahedron::from_points(at(0), at(1))
}

/// What was seen on a grid.
#[derive(Debug, Default)]
struct Seen {
    inputs: u64,
    culled: u64,
    /// Values beyond their bound, of those looked at.
    certain: u64,
    /// The largest computed value, over its bound, whose exact value is zero or of the other sign.
    worst: f64,
}

impl Seen {
    /// Looks at one input, and at the signs of its control values `which`.
    fn look<const E: u32, const F: u32>(
        &mut self,
        points: &Points<Minifloat<E, F>>,
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
                    assert!(
                        share <= 1.0,
                        "control value {k} of {points:?} has the wrong sign"
                    );
                    self.worst = share;
                }
            }
        }
        // What `is_never_coplanar` does.
        if values.one_sign_beyond(bounds) {
            self.culled += 1;
            let signs = [0, 1, 2, 3].map(|k| exact_control_value(points, k).signum());
            assert!(signs == [1; 4] || signs == [-1; 4], "{points:?} is culled");
        }
    }
}

/// Calls `visit` with every way to choose `N` of `values`, in the order of counting.
fn every<T: Copy, const N: usize>(values: &[T], mut visit: impl FnMut([T; N])) {
    let mut digits = [0; N];
    loop {
        visit(digits.map(|digit| values[digit]));
        let Some(place) = digits.iter().position(|&digit| digit + 1 < values.len()) else {
            return;
        };
        digits[..place].fill(0);
        digits[place] += 1;
    }
}

fn numbers<const E: u32, const F: u32, const N: usize>(values: [f64; N]) -> [Minifloat<E, F>; N] {
    values.map(|value| {
        let number = Minifloat::nearest(value);
        assert_eq!(number.value(), value, "the format has this number");
        number
    })
}

/// k₀ of every tetrahedron at rest with all twelve coordinates on the grid.
fn at_rest<const E: u32, const F: u32>(grid: &[Minifloat<E, F>]) -> Seen {
    let mut seen = Seen::default();
    every::<_, 12>(grid, |coordinates| {
        let points = std::array::from_fn(|point| {
            [std::array::from_fn(|axis| coordinates[3 * point + axis]); 2]
        });
        seen.look(&points, [0]);
    });
    assert_eq!(seen.inputs, (grid.len() as u64).pow(12));
    seen
}

#[test]
fn nothing_is_certain_with_3_bits_since_the_bound_is_the_permanent_itself() {
    let seen = at_rest::<4, 2>(&numbers([-1.75, -0.625, 1.25]));
    assert_eq!((seen.certain, seen.culled), (0, 0));
}

#[test]
fn every_tetrahedron_on_a_grid_of_three_values_with_4_bits() {
    let seen = at_rest::<4, 3>(&numbers([-1.375, -0.75, 0.5625]));
    assert!(seen.certain > 0 && seen.worst > 0.2, "{seen:?}");
}

#[test]
fn every_tetrahedron_on_a_grid_of_three_values_with_5_bits() {
    let seen = at_rest::<4, 4>(&numbers([-0.71875, 1.8125, 1.875]));
    assert!(seen.certain > 0 && seen.worst > 0.2, "{seen:?}");
}

/// Subnormal numbers: products underflow.
#[test]
fn every_tetrahedron_on_a_grid_of_tiny_values_with_4_bits() {
    let seen = at_rest::<4, 3>(&numbers([-0.1875, 0.003_906_25, 0.156_25]));
    assert!(seen.worst > 0.04, "{seen:?}");
}

/// The filter on every motion whose ends are among `ends`: k₀ and k₃ depend on one end each, so only ends whose own value is
/// beyond its bound can be part of a culled one, and all pairs of those are tried.
fn every_motion_between<const E: u32, const F: u32>(ends: &[[[Minifloat<E, F>; 3]; 4]]) -> Seen {
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
    // 3⁹ ends, 3¹⁸ motions.
    assert_eq!(ends.len(), 19_683);
    let seen = every_motion_between(&ends);
    assert!(seen.culled > 0, "{seen:?}");
}

#[test]
fn every_motion_of_four_points_on_grids_of_two_values_with_4_bits() {
    type Number = Minifloat<4, 3>;
    for grid in [
        [-1.875, 0.8125],
        [-1.125, 0.75],
        [0.625, 1.875],
        [-0.5625, 1.0],
    ] {
        let grid: [Number; 2] = numbers(grid);
        let mut ends = Vec::new();
        every::<_, 12>(&grid, |x| {
            ends.push(std::array::from_fn(|point| {
                std::array::from_fn(|axis| x[3 * point + axis])
            }));
        });
        // 2¹² ends, 2²⁴ motions.
        assert_eq!(ends.len(), 4096);
        let seen = every_motion_between(&ends);
        assert!(seen.culled > 0, "{seen:?}");
    }
}

/// The middle value of all 2¹⁸ motions, culled or not.
#[test]
fn every_middle_control_value_on_grids_of_two_values_with_4_bits() {
    type Number = Minifloat<4, 3>;
    let zero = Number::nearest(0.0);
    for grid in [[-1.125, 0.75], [-1.625, 0.5], [-1.375, 1.25]] {
        let grid: [Number; 2] = numbers(grid);
        let mut seen = Seen::default();
        every::<_, 18>(&grid, |numbers| {
            let mut points = [[[zero; 3]; 2]; 4];
            let components = points[1..].iter_mut().flatten().flatten();
            components
                .zip(numbers)
                .for_each(|(component, number)| *component = number);
            seen.look(&points, [1]);
        });
        assert!(seen.certain > 0 && seen.worst > 0.05, "{seen:?}");
    }
}

#[test]
fn the_constants_suffice_from_eight_significant_bits_on() {
    // f64 is precise enough for a comparison that is not close.
    let outer = |u: f64| 8.0 * u * (1.0 - u).powi(9) - ((1.0 + u).powi(7) - 1.0);
    let inner = |u: f64| 10.0 * u * (1.0 - u).powi(12) - ((1.0 + u).powi(9) - 1.0);
    for bits in 8..=53 {
        let u = 0.5_f64.powi(bits);
        assert!(outer(u) > 0.25 * u && inner(u) > 0.25 * u, "{bits} bits");
    }
    assert!(outer(0.5_f64.powi(7)) > 0.0 && outer(0.5_f64.powi(6)) < 0.0);
    assert!(inner(0.5_f64.powi(7)) < 0.0);
}
