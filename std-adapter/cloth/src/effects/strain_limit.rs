//! Strain limit: no triangle is stretched to more than a given ratio along any direction, its principal one included.
//!
//! A triangle's deformation takes warp and weft to w_u and w_v. The direction d in it that is stretched most is the first
//! eigenvector of [[w_u·w_u, w_u·w_v], [w_u·w_v, w_v·w_v]]; the constraint |d_u·w_u + d_v·w_v| ≤ limit has the form of stretch,
//! with coefficients d_u·a + d_v·b, and no compliance. One triangle's correction stretches its neighbours, so some are left a
//! little above the limit: more `sweeps` bring them closer (an accuracy–time choice).

use super::membrane::{Membrane, all, image, of_triangles};
use super::registration::{Effect, Registration};
use crate::input::RATIO;
use crate::plan::Plan;
use crate::schedule::{Local, Schedule};
use selvedge_core::glam::DVec3;

pub(super) const REGISTRATION: Registration = Registration {
    keys: &["limit", "sweeps"],
    needs: &[],
    read: |table, _| {
        Ok(Box::new(StrainLimit {
            limit: table.required_number("limit", RATIO, 1.0..=10.0)?,
            sweeps: table.count("sweeps", 1..=100)?.unwrap_or(1),
        }))
    },
};

#[derive(Debug)]
struct StrainLimit {
    limit: f64,
    sweeps: u64,
}

impl Effect for StrainLimit {
    fn settings(&self) -> Vec<(&'static str, String)> {
        vec![("sweeps", self.sweeps.to_string())]
    }

    fn register(self: Box<Self>, plan: &mut Plan<'_>) {
        let cloth = plan.world.cloth;
        let limit = self.limit;
        let limits = of_triangles(cloth, |membrane, _| Limit { membrane, limit });
        plan.add_constraint(Schedule::in_blocks(limits, &cloth.mesh.positions, self.sweeps));
    }
}

#[derive(Debug)]
struct Limit {
    membrane: Membrane,
    limit: f64,
}

impl Limit {
    /// The squared stretch is middle ± √(half² + shear²): these three.
    #[inline(always)]
    fn squared_stretch(&self, x: [DVec3; 3]) -> [f64; 3] {
        let Membrane { a, b, .. } = self.membrane;
        let (warp, weft) = (image(a, x), image(b, x));
        let (uu, uv, vv) = (warp.dot(warp), warp.dot(weft), weft.dot(weft));
        [0.5 * (uu + vv), 0.5 * (uu - vv), uv]
    }

    /// Most are: a length is no more than the sum of its parts.
    #[inline(always)]
    fn is_far_below(&self, [middle, half, shear]: [f64; 3]) -> bool {
        middle + half.abs() + shear.abs() < self.limit * self.limit
    }
}

impl Local<3> for Limit {
    #[inline(always)]
    fn moves_nothing(&self, x: [DVec3; 3]) -> bool {
        self.is_far_below(self.squared_stretch(x))
    }

    #[inline(always)]
    fn corrections(&self, x: [DVec3; 3], w: [f64; 3], _: f64) -> [DVec3; 3] {
        let stretch = self.squared_stretch(x);
        if self.is_far_below(stretch) {
            return [DVec3::ZERO; 3];
        }
        let Membrane { a, b, .. } = self.membrane;
        let [middle, half, uv] = stretch;
        let spread = (half * half + uv * uv).sqrt();
        let largest = (middle + spread).sqrt();
        // No branch: nobody could foretell it.
        let excess = (largest - self.limit).max(0.0);
        // The eigenvector of the larger eigenvalue, by whichever of its two forms does not cancel. Its length does not matter: the
        // correction is a product with it, divided by its square.
        let (du, dv) = match (half >= 0.0, spread > 0.0) {
            (_, false) => (1.0, 0.0),
            (true, _) => (half + spread, uv),
            (false, _) => (uv, spread - half),
        };
        let two = [du * a[0] + dv * b[0], du * a[1] + dv * b[1]];
        let c = all(two);
        let weight = w[0] * c[0] * c[0] + w[1] * c[1] * c[1] + w[2] * c[2] * c[2];
        // What is too large to square is left as it is.
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
        let limit = Limit { membrane, limit: 1.1 };
        let moves = limit.corrections(x, [1.0; 3], 0.0);
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
