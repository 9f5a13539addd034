//! One level: seeds with masses, the triangles between them, and the weights by which every vertex follows them.

use super::chart::Chart;
use super::dual::Dual;
use super::grouped::Grouped;
use super::seeds::Seeds;
use super::surface::Surface;
use crate::model::membrane::Membrane;
use crate::model::schedule::On;
use selvedge::parallel;
use selvedge_core::glam::{DVec2, DVec3};

/// The largest share of vertices outside all coarse triangles. A part of the cloth with more of them is left out.
const MOST_OUTSIDE: f64 = 0.05;

/// A triangle between seeds, at rest.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CoarseTriangle {
    pub(crate) membrane: Membrane,
    /// The area, in m².
    pub(crate) area: f64,
    /// The squares of the sides, in m². The side from the first to the second vertex comes first.
    pub(crate) sides: [f64; 3],
}

/// A vertex within this distance of a triangle, in spacings, counts as inside.
const INSIDE: f64 = 1e-6;

/// A coarse level of a cloth.
#[derive(Debug)]
pub(crate) struct Level {
    /// The typical distance of seeds, in metres.
    pub(crate) spacing: f64,
    /// The triangles, on indices of seeds.
    pub(crate) triangles: Vec<On<CoarseTriangle, 3>>,
    /// The inverse mass of each seed, in 1/kg; zero if it is pinned. The mass is the sum of its shares in its followers' masses.
    /// So moves of seeds that conserve Σ mass·position of seeds conserve that of vertices, and with it momentum.
    pub(crate) inverse_masses: Vec<f64>,
    /// The vertices of the cloth that are seeds.
    pub(super) seeds: Vec<u32>,
    /// The seeds that each vertex of the cloth follows. A pinned or left-out vertex follows none.
    follows: Vec<Follows>,
}

/// The seeds that a vertex moves with, and their shares.
#[derive(Clone, Copy, Debug, Default)]
struct Follows {
    seeds: [u32; 3],
    shares: [f64; 3],
}

impl Level {
    /// Makes a level of the `wanted` parts of the cloth, and removes those that it does not represent well. Returns `None` if no
    /// part remains.
    pub(super) fn new(
        surface: &Surface<'_>,
        masses: &[f64],
        is_pinned: &[bool],
        wanted: &mut [bool],
        spacing: f64,
    ) -> Option<Self> {
        let seeds = Seeds::new(surface, is_pinned, wanted, spacing);
        let Interpolation {
            mut triangles,
            follows: mut all,
            outside,
        } = Interpolation::new(surface, &seeds, spacing);
        for (part, outside) in outside.into_iter().enumerate() {
            wanted[part] &= outside as f64 <= MOST_OUTSIDE * surface.parts[part].0 as f64;
        }
        let is_wanted = |vertex: u32| wanted[surface.part[vertex as usize] as usize];
        triangles.retain(|(corners, _)| is_wanted(seeds.vertices[corners[0] as usize]));
        if triangles.is_empty() {
            return None;
        }
        let mut seed_masses = vec![0.0; seeds.vertices.len()];
        for (vertex, follows) in all.iter_mut().enumerate() {
            if is_pinned[vertex] || !is_wanted(vertex as u32) {
                *follows = Follows::default();
            }
            for (seed, share) in follows.seeds.into_iter().zip(follows.shares) {
                seed_masses[seed as usize] += share * masses[vertex];
            }
        }
        let inverse = |(&seed, mass): (&u32, f64)| {
            if is_pinned[seed as usize] || mass <= 0.0 {
                0.0
            } else {
                1.0 / mass
            }
        };
        let inverse_masses: Vec<f64> = seeds.vertices.iter().zip(seed_masses).map(inverse).collect();
        // A completely pinned triangle moves nothing.
        triangles.retain(|(corners, _)| corners.iter().any(|&seed| inverse_masses[seed as usize] > 0.0));
        Some(Self {
            spacing,
            triangles,
            inverse_masses,
            seeds: seeds.vertices,
            follows: all,
        })
    }

    /// Computes the inverse masses of seeds when some vertices are heavier, each by a mass in kg.
    pub(crate) fn weigh(&self, heavier: &[(u32, f64)], inverse_masses: &mut Vec<f64>) {
        inverse_masses.clone_from(&self.inverse_masses);
        for &(vertex, mass) in heavier {
            let Follows { seeds, shares } = self.follows[vertex as usize];
            for (seed, share) in seeds.into_iter().zip(shares) {
                let inverse_mass = &mut inverse_masses[seed as usize];
                *inverse_mass /= 1.0 + *inverse_mass * share * mass;
            }
        }
    }

    pub(crate) fn read(&self, positions: &[DVec3], seeds: &mut Vec<DVec3>) {
        seeds.clear();
        seeds.extend(self.seeds.iter().map(|&seed| positions[seed as usize]));
    }

    /// Moves every vertex with the seeds that it follows.
    pub(crate) fn spread(&self, moves: &[DVec3], positions: &mut [DVec3]) {
        let follows = &self.follows;
        parallel::for_each(&mut positions[..follows.len()], |vertex, position| {
            let Follows { seeds, shares } = follows[vertex];
            let [a, b, c] = seeds.map(|seed| moves[seed as usize]);
            *position += a * shares[0] + b * shares[1] + c * shares[2];
        });
    }
}

/// The seeds that every vertex follows.
struct Interpolation {
    triangles: Vec<On<CoarseTriangle, 3>>,
    follows: Vec<Follows>,
    /// The number of vertices outside all triangles, by part of the cloth.
    outside: Vec<usize>,
}

struct Flat {
    corners: [u32; 3],
    places: [DVec2; 3],
}

/// A place in a coarse triangle, and its distance from the follower.
struct Nearest {
    follows: Follows,
    squared_way: f64,
}

impl Interpolation {
    /// Interpolates each cell in a chart of its own. The chart has the triangles around the seed, and those around its neighbours
    /// where the cell reaches beyond.
    fn new(surface: &Surface<'_>, seeds: &Seeds, spacing: f64) -> Self {
        let dual = Dual::new(surface, seeds);
        let owned = seeds.owner.iter().enumerate();
        let owned = owned.filter(|(_, owner)| **owner != Seeds::NONE);
        let cells: Vec<_> = owned.map(|(vertex, &owner)| (owner, vertex as u32)).collect();
        let cells = Grouped::new(seeds.vertices.len(), &cells);
        let mut all = Self {
            triangles: Vec::new(),
            follows: vec![Follows::default(); seeds.owner.len()],
            outside: vec![0; surface.parts.len()],
        };
        let mut chart = Chart::new(surface);
        let (mut wanted, mut flats, mut left) = (Vec::new(), Vec::new(), Vec::new());
        for own in 0..seeds.vertices.len() as u32 {
            let mut near = vec![own];
            left.clear();
            left.extend_from_slice(&cells[own]);
            for ring in 0..2 {
                let triangles = with_neighbours(&dual, &mut near);
                wanted.clear();
                wanted.extend(near.iter().map(|&seed| seeds.vertices[seed as usize]));
                wanted.extend_from_slice(&left);
                let middle = seeds.vertices[own as usize];
                chart.lay(middle, &wanted, |v| near.binary_search(&seeds.owner[v as usize]).is_ok());
                flats.clear();
                flats.extend(triangles.into_iter().filter_map(|index| {
                    let corners = dual.triangles[index as usize];
                    let [a, b, c] = corners.map(|seed| chart.at(seeds.vertices[seed as usize]));
                    let places = [a?, b?, c?];
                    dual.fits(index, places).then_some(Flat { corners, places })
                }));
                if ring == 0 {
                    let first = flats.iter().filter(|flat| flat.corners[0] == own);
                    all.triangles.extend(first.map(|flat| (flat.corners, flat.at_rest())));
                }
                left.retain(|&vertex| {
                    let Some(place) = chart.at(vertex) else { return true };
                    // A vertex outside all triangles is assigned to the nearest.
                    let nearest = flats.iter().map(|flat| flat.nearest(place));
                    let Some(nearest) = nearest.min_by(|a, b| a.squared_way.total_cmp(&b.squared_way)) else {
                        return true;
                    };
                    all.follows[vertex as usize] = nearest.follows;
                    nearest.squared_way > (INSIDE * spacing).powi(2)
                });
                if left.is_empty() {
                    break;
                }
            }
            for &vertex in &left {
                all.outside[surface.part[vertex as usize] as usize] += 1;
            }
        }
        all.join(surface, seeds);
        all
    }

    /// Makes vertices that no chart reached follow the seeds of their neighbours. Such vertices lie beyond a vertex that alone
    /// joins two pieces of cloth.
    fn join(&mut self, surface: &Surface<'_>, seeds: &Seeds) {
        let follows_any = |follows: &Follows| follows.shares != [0.0; 3];
        let is_left =
            |all: &[Follows], vertex: u32| seeds.owner[vertex as usize] != Seeds::NONE && !follows_any(&all[vertex as usize]);
        let all = &mut self.follows;
        let mut left: Vec<u32> = (0..all.len() as u32).filter(|&vertex| is_left(all, vertex)).collect();
        let mut before = usize::MAX;
        while left.len() < before {
            before = left.len();
            left.retain(|&vertex| {
                let known = surface.ways[vertex]
                    .iter()
                    .filter(|(other, _)| follows_any(&all[*other as usize]));
                let nearest = known.min_by(|a, b| a.1.total_cmp(&b.1));
                if let Some((other, _)) = nearest {
                    all[vertex as usize] = all[*other as usize];
                }
                nearest.is_none()
            });
        }
    }
}

/// Adds the neighbours of seeds to them, sorted. Returns the triangles around the original seeds.
fn with_neighbours(dual: &Dual, near: &mut Vec<u32>) -> Vec<u32> {
    let mut triangles: Vec<u32> = near.iter().flat_map(|&seed| &dual.around[seed]).copied().collect();
    triangles.sort_unstable();
    triangles.dedup();
    near.extend(triangles.iter().flat_map(|&index| dual.triangles[index as usize]));
    near.sort_unstable();
    near.dedup();
    triangles
}

impl Flat {
    fn at_rest(&self) -> CoarseTriangle {
        let [a, b, c] = self.places;
        CoarseTriangle {
            membrane: Membrane::new(b - a, c - a),
            area: 0.5 * (b - a).perp_dot(c - a),
            sides: [(a, b), (b, c), (c, a)].map(|(from, to)| from.distance_squared(to)),
        }
    }

    /// Returns the nearest point of the triangle in barycentric coordinates, none of them negative. At a corner it is only
    /// approximately the nearest.
    fn nearest(&self, place: DVec2) -> Nearest {
        let [a, b, c] = self.places.map(|corner| corner - place);
        let [across_a, across_b, across_c] =
            [b.perp_dot(c), c.perp_dot(a), a.perp_dot(b)].map(|double_area| double_area.max(0.0));
        let sum = across_a + across_b + across_c;
        let shares = [across_a, across_b, across_c].map(|double_area| double_area / sum);
        Nearest {
            squared_way: (a * shares[0] + b * shares[1] + c * shares[2]).length_squared(),
            follows: Follows {
                seeds: self.corners,
                shares,
            },
        }
    }
}
