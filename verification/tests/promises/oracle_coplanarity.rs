//! The coplanarity of four moving points agrees with the extremes of the volume.

use crate::support::determinant;
use crate::support::prelude::*;
use rug::Integer;
use std::cmp::Ordering;

type Positions = [[f64; 3]; 4];

/// Returns the sign of `a + b·√d`, `d ≥ 0`.
fn sign(a: i128, b: i128, d: i128) -> Ordering {
    let root = if d == 0 { Ordering::Equal } else { b.cmp(&0) };
    match a.cmp(&0) {
        whole if whole == root || root.is_eq() => whole,
        Ordering::Equal => root,
        whole => match Integer::from(a).square().cmp(&(Integer::from(b).square() * d)) {
            Ordering::Equal => Ordering::Equal,
            Ordering::Greater => whole,
            Ordering::Less => root,
        },
    }
}

/// The volume is continuous, so it has a zero in [0, 1] exactly if its extremes there do not have the same strict sign. The
/// extremes are at the ends or where the derivative, a quadratic, is zero. The coefficients come from the volumes at four times.
fn by_extremes(start: &[[i32; 3]; 4], end: &[[i32; 3]; 4]) -> bool {
    let volume = |t: i32| -> i128 {
        let at = |i: usize, axis: usize| {
            let relative = |p: &[[i32; 3]; 4]| p[i][axis] - p[0][axis];
            i128::from(relative(start) * (1 - t) + relative(end) * t)
        };
        determinant([1, 2, 3].map(|i| [at(i, 0), at(i, 1), at(i, 2)]))
    };
    let [v0, v1, v2, v3] = [0, 1, 2, 3].map(volume);
    // This is Newton's interpolation, times 6.
    let (d1, d2, d3) = (v1 - v0, v2 - 2 * v1 + v0, v3 - 3 * v2 + 3 * v1 - v0);
    let (c0, c1, c2, c3) = (6 * v0, 6 * d1 - 3 * d2 + 2 * d3, 3 * d2 - 3 * d3, d3);
    let mut extremes = vec![v0.cmp(&0), v1.cmp(&0)];
    if c3 != 0 {
        let d = c2 * c2 - 3 * c1 * c3;
        for s in [1, -1].into_iter().filter(|_| d >= 0) {
            // The critical times are t = (−c2 + s·√d) / (3·c3), where 27·c3²·K(t) is as below.
            let after_start = sign(-c2, s, d) == c3.cmp(&0);
            let before_end = sign(-c2 - 3 * c3, s, d) == 0.cmp(&c3);
            if after_start && before_end {
                let whole = 27 * c0 * c3 * c3 - 9 * c1 * c2 * c3 + 2 * c2 * c2 * c2;
                extremes.push(sign(whole, -2 * d * s, d));
            }
        }
    } else if c2 != 0 {
        // The critical time is t = −c1 / (2·c2), where 4·c2·K(t) = 4·c2·c0 − c1².
        if (0..=2 * c2.abs()).contains(&(-c1 * c2.signum())) {
            extremes.push(((4 * c2 * c0 - c1 * c1) * c2.signum()).cmp(&0));
        }
    }
    !(extremes.iter().all(|e| e.is_gt()) || extremes.iter().all(|e| e.is_lt()))
}

fn to_f64(points: &[[i32; 3]; 4]) -> Positions {
    points.map(|p| p.map(f64::from))
}

/// Returns the ends of a step on a small or a large grid.
fn ends() -> impl Strategy<Value = [[[i32; 3]; 4]; 2]> {
    let grid = |limit: i32| prop::array::uniform2(prop::array::uniform4(prop::array::uniform3(-limit..=limit)));
    prop_oneof![grid(1), grid(50)]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40_000))]

    #[test]
    fn coplanar_is_what_the_extremes_say([start, end] in ends()) {
        prop_assert_eq!(are_ever_coplanar(&to_f64(&start), &to_f64(&end)), by_extremes(&start, &end));
    }
}

/// Returns whether a tetrahedron over a fixed face with its apex at height `from`, then `to`, is ever flat.
fn apex_moves([from, to]: [f64; 2]) -> bool {
    let face = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let with_apex = |z| [face[0], face[1], face[2], [0.25, 0.25, z]];
    are_ever_coplanar(&with_apex(from), &with_apex(to))
}

#[test]
fn touching_the_plane_at_an_end_or_in_a_step_at_rest_is_coplanar() {
    for ends in [[0.0, 0.0], [0.0, 1.0], [-1.0, 0.0]] {
        assert!(apex_moves(ends), "{ends:?}");
    }
    for ends in [[5e-324, 5e-324], [5e-324, 1.0], [-1.0, -5e-324]] {
        assert!(!apex_moves(ends), "{ends:?}");
    }
}

#[test]
fn multiple_roots_are_found_and_none_once_they_are_parted() {
    // Three edges with the volume (1 − 2t)² + gap².
    let double = |x: f64, gap: f64| [[0.0; 3], [x, -gap, 0.0], [gap, x, 0.0], [0.0, 0.0, 1.0]];
    assert!(are_ever_coplanar(&double(1.0, 0.0), &double(-1.0, 0.0)));
    assert!(!are_ever_coplanar(&double(1.0, 1e-300), &double(-1.0, 1e-300)));
    let triple = |x: f64| [[0.0; 3], [x, 0.0, 0.0], [0.0, x, 0.0], [0.0, 0.0, x]];
    assert!(are_ever_coplanar(&triple(1.0), &triple(-1.0)));
    assert!(!are_ever_coplanar(&triple(1.0), &triple(5e-324)));
}

#[test]
#[should_panic(expected = "finite")]
fn infinite_coordinates_are_refused() {
    let mut start = [[0.0; 3]; 4];
    start[2][1] = f64::INFINITY;
    let _ = are_ever_coplanar(&start, &start);
}
