//! The cloth at several resolutions, for effects over distances longer than an edge.
//!
//! ```text
//! Surface ──▶ Seeds ──▶ Dual ──▶ Chart by Chart ──▶ Level
//! distances   farthest  where    each cell laid     masses, triangles at rest, and
//! over the    points    three    flat with the      how every vertex follows seeds
//! cloth                 cells    triangles around
//!                       meet
//! ```
//!
//! Levels are made once, from the mesh at rest alone. The mesh may have any triangles, holes and several parts; it may be open or
//! closed, flat or curved. A part that a level does not represent well is left out of this level and of all coarser ones. Effects
//! act there as without levels.

mod chart;
mod dual;
mod grouped;
#[cfg(test)]
pub(crate) mod irregular;
mod level;
mod seeds;
mod surface;

pub(crate) use level::{CoarseTriangle, Level};

use crate::world::Cloth;
use std::sync::Arc;
use surface::Surface;

/// The ratio of seed distances from level to level.
const RATIO: f64 = 2.0;
/// The least number of spacings along a part of the cloth (along a square of its area). Coarser levels would have too few
/// triangles.
const FEWEST_SPACINGS: f64 = 4.0;

/// The levels so far, from fine to coarse, made on demand.
#[derive(Debug)]
pub(crate) struct Hierarchy<'a> {
    surface: Surface<'a>,
    masses: Vec<f64>,
    is_pinned: Vec<bool>,
    wanted: Vec<bool>,
    spacing: f64,
    levels: Vec<Arc<Level>>,
}

impl<'a> Hierarchy<'a> {
    pub(crate) fn new(cloth: &'a Cloth, masses: Vec<f64>, is_pinned: Vec<bool>) -> Self {
        let surface = Surface::new(cloth);
        let wanted = vec![true; surface.parts.len()];
        Self {
            spacing: RATIO * mesh_spacing(cloth),
            surface,
            masses,
            is_pinned,
            wanted,
            levels: Vec::new(),
        }
    }

    /// Returns the levels with seeds at most `coarsest` apart, from fine to coarse.
    pub(crate) fn levels_to(&mut self, coarsest: f64) -> Vec<Arc<Level>> {
        while self.spacing <= coarsest {
            for (wanted, (_, area)) in self.wanted.iter_mut().zip(&self.surface.parts) {
                *wanted &= self.spacing * FEWEST_SPACINGS <= area.sqrt();
            }
            if !self.wanted.contains(&true) {
                break;
            }
            let Self { surface, masses, .. } = self;
            let level = Level::new(surface, masses, &self.is_pinned, &mut self.wanted, self.spacing);
            self.levels.extend(level.map(Arc::new));
            self.spacing *= RATIO;
        }
        let made = self.levels.iter().filter(|level| level.spacing <= coarsest);
        made.cloned().collect()
    }
}

/// Returns the typical distance of vertices in metres: of its triangles, or of its loose edges if it has no triangles.
pub(crate) fn mesh_spacing(cloth: &Cloth) -> f64 {
    let at = |v: u32| cloth.mesh.positions[v as usize];
    let edges = cloth.topology.loose_edges();
    if !cloth.has_triangles() {
        let count = edges.len() as f64;
        return edges.map(|[a, b]| at(a).distance(at(b))).sum::<f64>() / count;
    }
    let area = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(at);
        0.5 * (b - a).cross(c - a).length()
    };
    let area: f64 = cloth.mesh.triangles.iter().map(area).sum();
    let mut is_of_triangle = vec![!cloth.has_loose_edges(); cloth.mesh.positions.len()];
    if cloth.has_loose_edges() {
        let corners = cloth.mesh.triangles.iter().flatten();
        corners.for_each(|&vertex| is_of_triangle[vertex as usize] = true);
    }
    let vertices = is_of_triangle.into_iter().filter(|own| *own).count();
    (area / vertices as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use selvedge::Mesh;
    use selvedge_core::glam::DVec3;

    fn levels(cloth: &Cloth, pins: &[u32]) -> Vec<Arc<Level>> {
        let mut is_pinned = vec![false; cloth.mesh.positions.len()];
        pins.iter().for_each(|&pin| is_pinned[pin as usize] = true);
        Hierarchy::new(cloth, cloth.masses(), is_pinned).levels_to(f64::INFINITY)
    }

    fn regular(cells: u32) -> Mesh {
        let sides = [DVec3::X, DVec3::Y];
        crate::world::sheet(DVec3::new(-0.5, -0.5, 0.0), sides, [cells; 2])
    }

    /// Returns sheets that are regular, randomly displaced, relaxed, and with a hole.
    fn sheets() -> [Mesh; 4] {
        let thrown = irregular::sheet(32, 0);
        let hole = irregular::with_hole(&thrown, DVec3::new(-0.1, 0.2, 0.0), 0.15);
        [regular(32), thrown, irregular::sheet(32, 4), hole]
    }

    fn area(level: &Level) -> f64 {
        level.triangles.iter().map(|(_, triangle)| triangle.area).sum()
    }

    #[test]
    fn levels_get_coarser_by_two_down_to_a_quarter_of_the_cloth() {
        for mesh in sheets() {
            let cloth = Cloth::of(mesh);
            let levels = levels(&cloth, &[]);
            let spacings: Vec<_> = levels.iter().map(|level| level.spacing).collect();
            assert!(spacings.windows(2).all(|two| two[1] == 2.0 * two[0]));
            assert_eq!(levels.len(), 3, "{spacings:?}");
            let seeds: Vec<_> = levels.iter().map(|level| level.inverse_masses.len()).collect();
            assert!(seeds.windows(2).all(|two| (2..=6).contains(&(two[0] / two[1]))), "{seeds:?}");
        }
    }

    /// A cloth moves, rotates or stretches evenly if its seeds do.
    #[test]
    fn what_is_linear_in_the_plane_is_interpolated_exactly_but_for_a_rim() {
        for mesh in sheets() {
            let cloth = Cloth::of(mesh);
            let rest = &cloth.mesh.positions;
            for level in levels(&cloth, &[]) {
                let mut seeds = Vec::new();
                level.read(rest, &mut seeds);
                let mut found = vec![DVec3::ZERO; rest.len()];
                level.spread(&seeds, &mut found);
                let wrong = found.iter().zip(rest).map(|(a, b)| a.distance(*b)).filter(|far| *far > 1e-12);
                let wrong: Vec<_> = wrong.collect();
                assert!(wrong.len() * 20 <= rest.len(), "{} of {}", wrong.len(), rest.len());
                assert!(wrong.iter().all(|far| *far < level.spacing));
                let mut moved = vec![DVec3::ZERO; rest.len()];
                level.spread(&vec![DVec3::ONE; seeds.len()], &mut moved);
                assert!(moved.iter().all(|by| by.distance(DVec3::ONE) < 1e-12));
            }
        }
    }

    #[test]
    fn seeds_weigh_as_much_as_the_cloth_and_move_its_centre_by_their_own() {
        for mesh in sheets() {
            let cloth = Cloth::of(mesh);
            let masses = cloth.masses();
            for level in levels(&cloth, &[]) {
                // A seed without followers has no mass.
                let mass = |inverse: &f64| if *inverse > 0.0 { 1.0 / inverse } else { 0.0 };
                let own: Vec<f64> = level.inverse_masses.iter().map(mass).collect();
                let all: f64 = masses.iter().sum();
                assert!((own.iter().sum::<f64>() / all - 1.0).abs() < 1e-12);
                let moves: Vec<_> = (0..own.len()).map(|k| DVec3::new((k as f64).sin(), k as f64, 1.0)).collect();
                let mut of_cloth = vec![DVec3::ZERO; masses.len()];
                level.spread(&moves, &mut of_cloth);
                let momentum = |masses: &[f64], moves: &[DVec3]| masses.iter().zip(moves).map(|(m, by)| *by * *m).sum::<DVec3>();
                let [seeds, cloth] = [momentum(&own, &moves), momentum(&masses, &of_cloth)];
                assert!(seeds.distance(cloth) < 1e-12 * seeds.length(), "{seeds} {cloth}");
            }
        }
    }

    #[test]
    fn a_pin_is_a_seed_that_does_not_move_and_no_vertex_that_is_pinned_follows_any() {
        for mesh in sheets() {
            let cloth = Cloth::of(mesh);
            let pins = [17, 400];
            for level in levels(&cloth, &pins) {
                let seed = |pin| level.seeds.iter().position(|&seed| seed == pin);
                assert!(pins.iter().all(|&pin| level.inverse_masses[seed(pin).unwrap()] == 0.0));
                let mut moved = vec![DVec3::ZERO; cloth.mesh.positions.len()];
                level.spread(&vec![DVec3::ONE; level.inverse_masses.len()], &mut moved);
                assert!(pins.iter().all(|&pin| moved[pin as usize] == DVec3::ZERO));
            }
        }
    }

    #[test]
    fn coarse_triangles_cover_the_cloth_and_no_hole() {
        for mesh in sheets() {
            let cloth = Cloth::of(mesh);
            let own = Surface::new(&cloth).parts[0].1;
            for level in levels(&cloth, &[]) {
                let share = area(&level) / own;
                assert!((0.93..1.05).contains(&share), "{share} at {}", level.spacing);
            }
        }
    }

    /// On a sheet and on a tube whose triangles lie on a cylinder, rest lengths go around the cylinder, not through it.
    #[test]
    fn a_tube_is_laid_flat_around_each_of_its_seeds() {
        let tube = crate::world::tube([DVec3::ZERO, DVec3::Z], 0.2, [80, 64]);
        let cloth = Cloth::of(tube);
        let own = Surface::new(&cloth).parts[0].1;
        let levels = levels(&cloth, &[]);
        assert!(levels.len() >= 3);
        for level in levels {
            let share = area(&level) / own;
            assert!((0.95..1.02).contains(&share), "{share} at {}", level.spacing);
        }
    }

    #[test]
    fn parts_of_a_cloth_have_levels_of_their_own_and_small_ones_few() {
        let mut mesh = regular(32);
        let scrap = regular(4);
        let first = mesh.positions.len() as u32;
        mesh.positions.extend(scrap.positions.iter().map(|p| *p * 0.12 + DVec3::Z));
        mesh.triangles.extend(scrap.triangles.iter().map(|t| t.map(|v| v + first)));
        let cloth = Cloth::of(mesh);
        let levels = levels(&cloth, &[]);
        assert_eq!(levels.len(), 3);
        for level in levels {
            let mut moved = vec![DVec3::ZERO; cloth.mesh.positions.len()];
            level.spread(&vec![DVec3::ONE; level.inverse_masses.len()], &mut moved);
            let (large, small) = moved.split_at(first as usize);
            assert!(large.iter().all(|by| by.distance(DVec3::ONE) < 1e-12));
            assert!(small.iter().all(|by| *by == DVec3::ZERO));
        }
    }

    /// No part of a ball can be laid flat, so levels have at most as much cloth as there is.
    #[test]
    fn a_closed_ball_has_levels_that_hold_no_more_cloth_than_there_is() {
        let ball = crate::world::capsule([DVec3::ZERO; 2], 0.3, 64);
        let cloth = Cloth::of(ball);
        let own = Surface::new(&cloth).parts[0].1;
        for level in levels(&cloth, &[]) {
            let share = area(&level) / own;
            assert!((0.7..1.05).contains(&share), "{share} at {}", level.spacing);
        }
    }
}
