//! Strain limit: no triangle is stretched beyond a given ratio along any direction.
//!
//! For the principal direction d ([`SquaredStretch`]) the constraint |d_u·w_u + d_v·w_v| ≤ limit has the form of stretch. Its
//! coefficients are d_u·a + d_v·b, and it has no compliance. One triangle's correction stretches its neighbours, so some stay a
//! little above the limit. More `sweeps` bring them closer and take longer. The same limit first acts on all coarse
//! [`levels`](super::levels).

use super::levels::{self, OnLevels, Tension};
use super::registration::{ActsOn, Effect, Registration};
use crate::effects::plan::{Fabric, Plan};
use crate::input::{Count, Field, RATIO, ValueError};
use crate::model::edge_lengths::Lengths;
use crate::model::membrane::{Membrane, SquaredStretch, all, image, of_triangles};
use crate::model::schedule::{Local, Schedule};
use crate::model::step::{Constraint, TimeStep, Touches};
use crate::world::SceneParts;
use selvedge_core::glam::DVec3;

const LIMIT: Field = Field::new("limit", RATIO, 1.0, 10.0);
const SWEEPS: Count = Count::new("sweeps", 1, 100);

pub(super) const REGISTRATION: Registration = Registration::new(&["limit", "sweeps", "levels"], |table, _| {
    Ok(Box::new(StrainLimit {
        limit: table.required_number(&LIMIT)?,
        sweeps: table.count(&SWEEPS)?.unwrap_or(1),
        levels: levels::read_most(table)?,
    }))
});

/// No triangle is stretched beyond a ratio.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StrainLimit {
    /// The largest ratio of a length to its length at rest, along any direction.
    pub limit: f64,
    /// The number of sweeps over all triangles in a step. More sweeps bring the last triangles closer to the limit.
    pub sweeps: u32,
    /// The number of coarse levels on which the limit acts as well, from the finest. `None` uses all.
    pub levels: Option<u32>,
}

impl StrainLimit {
    /// Sets a limit with one sweep, on all levels.
    #[must_use]
    pub const fn at(limit: f64) -> Self {
        Self {
            limit,
            sweeps: 1,
            levels: None,
        }
    }
}

impl Effect for StrainLimit {
    fn name(&self) -> &'static str {
        "strain_limit"
    }

    fn acts_on(&self) -> ActsOn {
        ActsOn::Triangles
    }

    fn check(&self, _: &SceneParts<'_>) -> Result<(), ValueError> {
        LIMIT.check(self.limit)?;
        SWEEPS.check(self.sweeps)?;
        levels::check(self.levels)
    }

    fn announce(&self, fabric: &mut Fabric) {
        fabric.is_limited = true;
    }

    fn fabric(&self) -> Vec<(&'static str, String)> {
        vec![("longest over rest", RATIO.written_short(self.limit))]
    }

    fn settings(&self) -> Vec<(&'static str, String)> {
        let mut settings = vec![("sweeps", self.sweeps.to_string())];
        settings.extend(levels::settings(self.levels));
        settings
    }

    fn register(&self, plan: &mut Plan<'_>) {
        let cloth = plan.scene.cloth;
        let limit = self.limit;
        if plan.solves_at_once() {
            return plan.membranes().limit(limit, cloth);
        }
        // The limit has no compliance, so that a pull crosses the whole cloth at once.
        let levels = plan.levels(f64::INFINITY, self.levels);
        let limits = of_triangles(cloth, |membrane, _| Limit::new(membrane, limit));
        let limits = Schedule::in_blocks(limits, &cloth.mesh.positions, self.sweeps.into());
        plan.add_constraint(Limits {
            limits: OnLevels::new(levels, limits, |triangle| Tension::limit(triangle, limit)),
            longest: Lengths::new(&cloth.mesh, limit),
        });
    }
}

#[derive(Debug)]
struct Limits {
    limits: OnLevels<Schedule<Limit, 3>>,
    longest: Lengths,
}

impl Constraint for Limits {
    fn project(&mut self, step: &TimeStep<'_>, positions: &mut [DVec3], touches: &mut Touches) {
        self.limits.project(step, positions, touches);
    }

    fn is_inner(&self) -> bool {
        true
    }

    fn over_limit(&self, positions: &[DVec3]) -> Option<f64> {
        Some(self.longest.largest(positions))
    }
}

#[derive(Debug)]
struct Limit {
    membrane: Membrane,
    limit: f64,
    /// The square of the limit, less what rounding may add to a squared stretch.
    kept: f64,
    /// The way of a vertex, in metres, that changes the squared stretch by one near the limit.
    way: f64,
}

impl Limit {
    /// Moves of the vertices by δᵢ change the stretch σ along a direction d by at most Σ|d_u·aᵢ + d_v·bᵢ|·|δᵢ| ≤ K·Σ|δᵢ|, where K
    /// is the largest length of the vectors (aᵢ, bᵢ). Below the limit L, L − σ = (L² − σ²)/(L + σ) ≥ (L² − σ²)/2L.
    fn new(membrane: Membrane, limit: f64) -> Self {
        let [a, b] = [membrane.a, membrane.b].map(all);
        let steepest = [0, 1, 2].map(|k| a[k].hypot(b[k])).into_iter().fold(0.0, f64::max);
        Self {
            membrane,
            limit,
            kept: limit * limit * (1.0 - 1e-9),
            way: 1.0 / (2.0 * limit * steepest),
        }
    }
}

impl Local<3> for Limit {
    type Multipliers = ();

    const HAS_ROOM: bool = true;

    #[inline(always)]
    fn room(&self, x: [DVec3; 3]) -> f64 {
        let stretch = SquaredStretch::new(self.membrane, x);
        let bound = stretch.bound();
        let squared = if bound < self.kept { bound } else { stretch.largest() };
        (self.kept - squared) * self.way
    }

    #[inline(always)]
    fn corrections(&self, x: [DVec3; 3], w: [f64; 3], _: f64, _: &mut ()) -> [DVec3; 3] {
        let Membrane { a, b, .. } = self.membrane;
        // The length of the direction does not matter: the correction is a product with the direction, divided by its square.
        let (largest, [du, dv]) = SquaredStretch::new(self.membrane, x).principal();
        // A branch would be unpredictable.
        let excess = largest - self.limit;
        let excess = if excess > 0.0 { excess } else { 0.0 };
        let two = [du * a[0] + dv * b[0], du * a[1] + dv * b[1]];
        let c = all(two);
        let weight = w[0] * c[0] * c[0] + w[1] * c[1] * c[1] + w[2] * c[2] * c[2];
        // Values whose squares overflow are not corrected.
        if !(weight > 0.0 && largest.is_finite()) {
            return [DVec3::ZERO; 3];
        }
        let along = image(two, x) * (-excess / (weight * largest));
        [0, 1, 2].map(|k| along * (w[k] * c[k]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moved(x: [DVec3; 3]) -> [DVec3; 3] {
        let membrane = Membrane {
            a: [1.0, 0.0],
            b: [0.0, 1.0],
        };
        let limit = Limit::new(membrane, 1.1);
        let moves = limit.corrections(x, [1.0; 3], 0.0, &mut ());
        [0, 1, 2].map(|k| x[k] + moves[k])
    }

    #[test]
    fn a_stretched_triangle_comes_back_to_its_limit() {
        let [a, b, c] = moved([DVec3::ZERO, 2.0 * DVec3::X, DVec3::Y]);
        assert!(((b - a).length() - 1.1).abs() < 1e-12);
        let before = 2.0 * DVec3::X + DVec3::Y;
        assert!((a + b + c - before).length() < 1e-12, "the middle stays where it is");
    }

    #[test]
    fn a_triangle_too_large_to_square_stays_as_it_is() {
        for x in [
            [DVec3::ZERO, 1e160 * DVec3::X, DVec3::Y],
            [DVec3::ZERO, DVec3::X, 1e160 * DVec3::Y],
            [DVec3::ZERO, 1e160 * DVec3::X, 1e160 * DVec3::Y],
        ] {
            assert_eq!(moved(x), x);
        }
    }
}
