//! Constraints that need no look, since their vertices have hardly moved since the last.
//!
//! A constraint that keeps its limit by some room moves nothing until the ways of its vertices add up to that room. So the sum
//! of the ways of each vertex, from look to look and by corrections, decides whether to look again. The result has the same bits.

use selvedge_core::glam::DVec3;

/// The number of runs after which all constraints are looked at, and ways start at zero.
const RUNS: u32 = 256;
/// The share of ways that is added to them for rounding. A vertex has at most 257 ways in a run: one before it, and one for each
/// constraint of a block, or each capsule. So a sum has at most 65,792 roundings, each by at most 1.2e-16 of it.
const ROUNDING: f64 = 1e-10;

/// The ways of vertices, and the rooms of their constraints.
#[derive(Debug, Default)]
pub(crate) struct Rooms {
    ways: Vec<f64>,
    /// The sum of the ways of its vertices up to which each constraint moves nothing.
    until: Vec<f64>,
    runs: u32,
    /// True if a constraint has moved a vertex in this run.
    pub(crate) has_moved: bool,
}

/// Returns a length that is at least that of a vector, without a square root.
#[inline(always)]
fn way_of(vector: DVec3) -> f64 {
    vector.x.abs() + vector.y.abs() + vector.z.abs()
}

impl Rooms {
    /// Begins a run at these positions; `seen` has those of the end of the last run, and follows.
    pub(crate) fn begin(&mut self, seen: &mut Vec<DVec3>, now: impl Iterator<Item = DVec3>, constraints: usize) {
        self.has_moved = false;
        self.runs += 1;
        if self.ways.is_empty() || self.runs > RUNS {
            self.runs = 0;
            seen.clear();
            seen.extend(now);
            self.ways.clear();
            self.ways.resize(seen.len(), 0.0);
            self.until.clear();
            self.until.resize(constraints, -1.0);
            return;
        }
        for ((seen, way), now) in seen.iter_mut().zip(&mut self.ways).zip(now) {
            *way += way_of(now - *seen);
            *seen = now;
        }
    }

    #[inline(always)]
    fn sum<const N: usize>(&self, places: &[u32; N]) -> f64 {
        let mut sum = 0.0;
        for k in 0..N {
            sum += self.ways[places[k] as usize];
        }
        sum
    }

    /// Returns whether a constraint certainly moves nothing. `room` returns its room if that is not yet known.
    #[inline(always)]
    pub(crate) fn suffices<const N: usize>(&mut self, index: usize, places: &[u32; N], room: impl FnOnce() -> f64) -> bool {
        let sum = self.sum(places);
        let until = &mut self.until[index];
        if sum <= *until {
            return true;
        }
        let room = room();
        let has_room = room > 0.0;
        *until = if has_room { (1.0 - ROUNDING) * sum + room } else { -1.0 };
        has_room
    }

    /// Adds the moves of a constraint.
    #[inline(always)]
    pub(crate) fn follow<const N: usize>(&mut self, places: &[u32; N], moves: [DVec3; N]) {
        for k in 0..N {
            let way = way_of(moves[k]);
            self.ways[places[k] as usize] += way;
            self.has_moved |= way != 0.0;
        }
    }
}
