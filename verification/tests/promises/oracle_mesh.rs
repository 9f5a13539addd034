//! The oracle's triangle intersections at rest agree with clipping.

use crate::support::prelude::*;
use crate::support::{common_part, contains, point};
use selvedge_verification::oracle::{
    mesh_intersections, mesh_self_intersections, triangles_intersect, triangles_intersect_by_signs,
};

type Triangle = [[f64; 3]; 3];

/// Returns whether the common part is more than the hull of the shared corners.
fn by_clipping(a: &Triangle, b: &Triangle, shared: &[[usize; 2]]) -> bool {
    let corners = common_part(&a.map(point), &b.map(point));
    let simplex: Vec<_> = shared.iter().map(|&[i, _]| point(a[i])).collect();
    corners.iter().any(|corner| simplex.is_empty() || !contains(&simplex, corner))
}

fn grid_point() -> impl Strategy<Value = [f64; 3]> {
    prop::array::uniform3((-1..=1).prop_map(f64::from))
}

fn triangle() -> impl Strategy<Value = Triangle> {
    prop::array::uniform3(grid_point())
}

/// Returns every way to share no, one, two or three corners.
fn shared() -> impl Strategy<Value = Vec<[usize; 2]>> {
    let corners = || Just([0, 1, 2]).prop_shuffle();
    (corners(), corners(), 0..=3_usize).prop_map(|(a, b, count)| a.into_iter().zip(b).take(count).map(|(i, j)| [i, j]).collect())
}

/// Returns the second triangle with the corners that it shares with the first.
fn joined(a: &Triangle, mut b: Triangle, shared: &[[usize; 2]]) -> Triangle {
    for &[i, j] in shared {
        b[j] = a[i];
    }
    b
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    #[test]
    fn intersection_is_what_clipping_finds_in_any_order(a in triangle(), b in triangle(), shared in shared(), turn in 0..3_usize) {
        let b = joined(&a, b, &shared);
        let intersect = triangles_intersect(&a, &b, &shared);
        prop_assert_eq!(intersect, by_clipping(&a, &b, &shared));
        let turned: Triangle = std::array::from_fn(|i| a[(i + turn) % 3]);
        let swapped: Vec<_> = shared.iter().map(|&[i, j]| [j, (i + 3 - turn) % 3]).collect();
        prop_assert_eq!(intersect, triangles_intersect(&b, &turned, &swapped));
    }

    /// The triangles touch, are coplanar, or are one unit in the last place off; they are large, small, and beyond the range of
    /// signs.
    #[test]
    fn signs_of_volumes_agree_with_integers_wherever_they_answer(
        a in triangle(), b in triangle(), shared in shared(),
        ulps in prop::array::uniform6(prop::array::uniform3(-1..=1_i8)),
        exponent in prop_oneof![Just(0), -310..310_i32],
        offset in prop_oneof![Just(0.0), Just(0.1), Just(3.7e5)],
    ) {
        let b = joined(&a, b, &shared);
        let nudged = |corner: [f64; 3], ulps: [i8; 3]| [0, 1, 2].map(|axis| {
            let at = (corner[axis] + offset) * f64::powi(2.0, exponent);
            match ulps[axis] {
                -1 => at.next_down(),
                0 => at,
                _ => at.next_up(),
            }
        });
        let a: Triangle = std::array::from_fn(|i| nudged(a[i], ulps[i]));
        let b = joined(&a, std::array::from_fn(|j| nudged(b[j], ulps[3 + j])), &shared);
        if let Some(answer) = triangles_intersect_by_signs(&a, &b, &shared) {
            prop_assert_eq!(answer, triangles_intersect(&a, &b, &shared));
        }
    }

    #[test]
    fn signs_of_volumes_settle_pairs_in_general_position(
        a in prop::array::uniform3(prop::array::uniform3(-1.0..1.0_f64)),
        b in prop::array::uniform3(prop::array::uniform3(-1.0..1.0_f64)),
        shared in shared(),
    ) {
        let b = joined(&a, b, &shared);
        let answer = triangles_intersect_by_signs(&a, &b, &shared);
        prop_assert_eq!(answer, Some(triangles_intersect(&a, &b, &shared)));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn mesh_intersections_are_those_of_all_pairs(
        positions in prop::collection::vec(grid_point(), 3..12),
        corners in prop::collection::vec(prop::array::uniform3(any::<prop::sample::Index>()), 0..12),
    ) {
        let triangles: Vec<[u32; 3]> = corners
            .iter()
            .map(|c| c.map(|i| u32::try_from(i.index(positions.len())).expect("small")))
            .collect();
        let mut expected = Vec::new();
        for (j, b) in triangles.iter().enumerate() {
            for (i, a) in triangles[..j].iter().enumerate() {
                let [at_a, at_b] = [a, b].map(|t| t.map(|v| point(positions[v as usize])));
                let mut simplex: Vec<u32> = a.iter().copied().filter(|v| b.contains(v)).collect();
                simplex.sort_unstable();
                simplex.dedup();
                let simplex: Vec<_> =
                    simplex.into_iter().map(|v| point(positions[v as usize])).collect();
                let beyond =
                    |x| simplex.is_empty() || !contains(&simplex, x);
                if common_part(&at_a, &at_b).iter().any(beyond) {
                    expected.push([i, j].map(|i| u32::try_from(i).expect("small")));
                }
            }
        }
        expected.sort_unstable();
        prop_assert_eq!(mesh_self_intersections(&positions, &triangles), expected.clone());
        let count = triangles.len() / 2;
        expected.retain(|&[i, _]| (i as usize) < count);
        prop_assert_eq!(mesh_intersections(&positions, &triangles, count), expected);
    }
}

#[test]
fn triangles_one_ulp_apart_do_not_intersect() {
    let a = [[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]];
    let above = a.map(|[x, y, z]: [f64; 3]| [x, y, z.next_up()]);
    assert!(triangles_intersect(&a, &a, &[]));
    assert!(!triangles_intersect(&a, &above, &[]));
}

#[test]
fn a_corner_that_touches_from_above_intersects() {
    let a = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0]];
    let b = [[1.0, 1.0, 0.0], [1.0, 1.0, 1.0], [2.0, 1.0, 1.0]];
    assert!(triangles_intersect(&a, &b, &[]));
    let lifted = b.map(|[x, y, z]| [x, y, z + f64::MIN_POSITIVE]);
    assert!(!triangles_intersect(&a, &lifted, &[]));
}

#[test]
fn a_fold_onto_the_neighbour_intersects_and_an_open_hinge_does_not() {
    let (p, q) = ([0.0, 0.0, 0.0], [1.0, 0.0, 0.0]);
    let hinge = |b| triangles_intersect(&[p, q, [0.0, 1.0, 0.0]], &[q, p, b], &[[0, 1], [1, 0]]);
    assert!(hinge([0.5, 1.0, 0.0]));
    assert!(!hinge([0.5, 1.0, 1e-300]));
    assert!(!hinge([0.5, -1.0, 0.0]));
}

#[test]
fn coordinates_at_both_ends_of_the_range_are_exact() {
    let tiny = 5e-324;
    let a = [[-1e308, -1e308, 0.0], [1e308, -1e308, 0.0], [0.0, 1e308, 0.0]];
    let b = [[0.0, 0.0, tiny], [1.0, 0.0, tiny], [0.0, 1e308, tiny]];
    assert!(!triangles_intersect(&a, &b, &[]));
    assert!(triangles_intersect(&a, &b.map(|[x, y, z]| [x, y, z - tiny]), &[]));
}
