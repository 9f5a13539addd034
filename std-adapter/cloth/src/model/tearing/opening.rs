//! The opening of a tear: the copies of a vertex move apart a little, each into its fan, so that the parts no longer touch.
//!
//! A fan spans some angle around its vertex. The mean of all directions in it is Σ (u + v)·tan(φ/2) over its triangles, with u
//! and v unit vectors along their sides and φ the angle between. It bisects the angle of a flat fan. A vertex that moves along it
//! stays within its fan, away from all others. All copies move so that their centre of mass stays; they have one velocity, so
//! momentum does not change.

use super::Tear;
use selvedge_core::glam::DVec3;

/// Moves the copies of each split vertex by about `share` of its shortest edge. `copies` maps a vertex of the tear's cloth and
/// the place of a fan to that fan's copy among all vertices. `triangle` returns the corners of a triangle among all vertices.
pub(crate) fn open(
    tear: &Tear,
    share: f64,
    inverse_masses: &[f64],
    copy: impl Fn(u32, usize) -> u32,
    triangle: impl Fn(u32) -> [u32; 3],
    positions: &mut [DVec3],
) {
    let mut moves: Vec<(u32, DVec3)> = Vec::new();
    for (vertex, fans) in &tear.splits {
        let first = moves.len();
        let mut shortest = f64::INFINITY;
        for (place, fan) in fans.iter().enumerate() {
            let own = copy(*vertex, place);
            let mut inward = DVec3::ZERO;
            for &index in fan {
                let corners = triangle(index);
                let at = positions[own as usize];
                let sides = corners
                    .iter()
                    .filter(|&&corner| corner != own)
                    .map(|&corner| positions[corner as usize] - at);
                let [u, v] = two(sides);
                shortest = shortest.min(u.length()).min(v.length());
                inward += mean_direction(u.normalize_or_zero(), v.normalize_or_zero());
            }
            moves.push((own, inward.normalize_or_zero()));
        }
        let own = &mut moves[first..];
        let mass = |vertex: u32| inverse_masses[vertex as usize].recip();
        let all: f64 = own.iter().map(|&(vertex, _)| mass(vertex)).sum();
        let middle: DVec3 = own.iter().map(|&(vertex, move_by)| move_by * mass(vertex)).sum::<DVec3>() / all;
        own.iter_mut()
            .for_each(|(_, move_by)| *move_by = (*move_by - middle) * (share * shortest));
    }
    for (vertex, move_by) in moves {
        positions[vertex as usize] += move_by;
    }
}

fn two(mut all: impl Iterator<Item = DVec3>) -> [DVec3; 2] {
    [all.next().unwrap_or_default(), all.next().unwrap_or_default()]
}

/// Returns the integral of all directions between two unit vectors: (u + v)·tan(φ/2).
fn mean_direction(u: DVec3, v: DVec3) -> DVec3 {
    let half = u.cross(v).length() / (1.0 + u.dot(v));
    if half.is_finite() { (u + v) * half } else { DVec3::ZERO }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_3;

    #[test]
    fn the_mean_of_all_directions_between_two_is_what_adding_many_of_them_comes_to() {
        let at = |angle: f64| DVec3::new(angle.cos(), angle.sin(), 0.0);
        let steps = 100_000;
        let sum: DVec3 = (0..steps)
            .map(|k| at(FRAC_PI_3 * (f64::from(k) + 0.5) / f64::from(steps)))
            .sum();
        let expected = sum * (FRAC_PI_3 / f64::from(steps));
        assert!(mean_direction(at(0.0), at(FRAC_PI_3)).distance(expected) < 1e-9);
        assert_eq!(mean_direction(DVec3::X, -DVec3::X), DVec3::ZERO);
    }

    /// The mesh is half a wheel around vertex 0, whose copy is vertex 4, cut in the middle.
    #[test]
    fn copies_move_apart_and_their_centre_of_mass_stays() {
        let mut positions = [DVec3::ZERO, DVec3::X, DVec3::Y, -DVec3::X, DVec3::ZERO];
        let tear = Tear {
            cloth: 0,
            edges: vec![([0, 2], 1.0)],
            splits: vec![(0, vec![vec![0], vec![1]])],
            around: vec![0, 1, 2, 3],
        };
        let triangles = [[0, 1, 2], [4, 2, 3]];
        let inverse_masses = [0.5, 1.0, 1.0, 1.0, 0.25];
        let copy = |_, place| if place == 0 { 0 } else { 4 };
        open(&tear, 0.1, &inverse_masses, copy, |k| triangles[k as usize], &mut positions);
        assert!(positions[0].x > 0.01 && positions[4].x < -0.01);
        let middle = positions[0] * 2.0 + positions[4] * 4.0;
        assert!(middle.length() < 1e-15);
        assert_eq!(positions[1..4], [DVec3::X, DVec3::Y, -DVec3::X]);
    }
}
