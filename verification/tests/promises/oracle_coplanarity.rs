//! The coplanarity of four moving points agrees with the extremes of the volume.

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
        let [a, b, c] = [1, 2, 3].map(|i| [at(i, 0), at(i, 1), at(i, 2)]);
        // This is the rule of Sarrus.
        a[0] * b[1] * c[2] + a[1] * b[2] * c[0] + a[2] * b[0] * c[1]
            - a[2] * b[1] * c[0]
            - a[1] * b[0] * c[2]
            - a[0] * b[2] * c[1]
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

fn grid(limit: i32) -> impl Strategy<Value = [[i32; 3]; 4]> {
    prop::array::uniform4(prop::array::uniform3(-limit..=limit))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    #[test]
    fn coplanar_on_a_small_grid_is_what_the_extremes_say(start in grid(1), end in grid(1)) {
        let oracle = coplanar(&to_f64(&start), &to_f64(&end));
        prop_assert_eq!(oracle, by_extremes(&start, &end));
    }

    #[test]
    fn coplanar_on_a_large_grid_is_what_the_extremes_say(start in grid(50), end in grid(50)) {
        let oracle = coplanar(&to_f64(&start), &to_f64(&end));
        prop_assert_eq!(oracle, by_extremes(&start, &end));
    }
}

/// Returns whether a tetrahedron over a fixed face with its apex at height `from`, then `to`, is ever flat.
fn apex_moves(from: f64, to: f64) -> bool {
    let face = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let with_apex = |z| [face[0], face[1], face[2], [0.25, 0.25, z]];
    coplanar(&with_apex(from), &with_apex(to))
}

#[test]
fn no_motion_is_decided_by_the_volume() {
    assert!(!apex_moves(5e-324, 5e-324));
    assert!(apex_moves(0.0, 0.0));
}

#[test]
fn touching_the_plane_at_an_end_of_the_step_is_coplanar() {
    assert!(apex_moves(0.0, 1.0));
    assert!(apex_moves(-1.0, 0.0));
    assert!(!apex_moves(5e-324, 1.0));
    assert!(!apex_moves(-1.0, -5e-324));
}

#[test]
fn a_double_root_is_found_and_none_once_it_is_parted() {
    // Three edges with the volume (1 − 2t)² + gap².
    let edges = |x: f64, gap: f64| [[0.0; 3], [x, -gap, 0.0], [gap, x, 0.0], [0.0, 0.0, 1.0]];
    assert!(coplanar(&edges(1.0, 0.0), &edges(-1.0, 0.0)));
    assert!(!coplanar(&edges(1.0, 1e-300), &edges(-1.0, 1e-300)));
}

#[test]
fn a_triple_root_is_found() {
    let at = |x: f64| [[0.0; 3], [x, 0.0, 0.0], [0.0, x, 0.0], [0.0, 0.0, x]];
    assert!(coplanar(&at(1.0), &at(-1.0)));
    assert!(!coplanar(&at(1.0), &at(5e-324)));
}

#[test]
#[should_panic(expected = "finite")]
fn infinite_coordinates_are_refused() {
    let mut start = [[0.0; 3]; 4];
    start[2][1] = f64::INFINITY;
    let _ = coplanar(&start, &start);
}
