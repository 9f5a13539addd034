//! The cloth at several resolutions, for effects that act over longer ways than an edge.
//!
//! ```text
//! Surface ──▶ Seeds ──▶ Dual ──▶ Chart by Chart ──▶ Level
//! ways over   farthest  where    each cell laid     masses, triangles at rest, and
//! the cloth   points    three    flat with the      how every vertex follows seeds
//!                       cells    triangles around
//!                       meet
//! ```
//!
//! Made once, of the mesh at rest alone: any triangles, with holes, in several parts, open or closed, flat or curved. A part that a
//! level does not represent well is left out of it, and of all coarser ones: there its effects are what they are without levels.

mod chart;
mod dual;
mod grouped;
mod level;
mod seeds;
mod surface;

pub(crate) use level::{CoarseTriangle, Level};

use crate::world::Cloth;
use std::sync::Arc;
use surface::Surface;

/// How much farther apart seeds are than those of the level before.
const RATIO: f64 = 2.0;
/// No level has fewer than so many spacings along a part of the cloth (along a square of its area): below that it is hardly a mesh.
const FEWEST_SPACINGS: f64 = 4.0;

/// The levels so far, from fine to coarse. They are made when they are asked for.
#[derive(Debug)]
pub(crate) struct Hierarchy<'a> {
    surface: Surface<'a>,
    masses: Vec<f64>,
    is_pinned: Vec<bool>,
    /// The parts of the cloth that the next level has.
    wanted: Vec<bool>,
    /// Of the next level.
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

    /// The levels whose seeds are no farther apart than `coarsest`, from fine to coarse.
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

/// How far apart vertices are, about, in metres.
pub(crate) fn mesh_spacing(cloth: &Cloth) -> f64 {
    let area = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|v| cloth.mesh.positions[v as usize]);
        0.5 * (b - a).cross(c - a).length()
    };
    let area: f64 = cloth.mesh.triangles.iter().map(area).sum();
    (area / cloth.mesh.positions.len() as f64).sqrt()
}
