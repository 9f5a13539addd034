//! Strain limit: no triangle is stretched to more than a given ratio along any direction, its principal one included.
//!
//! A triangle's deformation takes warp and weft to w_u and w_v. The direction d in it that is stretched most is the first
//! eigenvector of [[w_u·w_u, w_u·w_v], [w_u·w_v, w_v·w_v]]; the constraint |d_u·w_u + d_v·w_v| ≤ limit has the form of stretch,
//! with coefficients d_u·a + d_v·b, and no compliance. One triangle's correction stretches its neighbours, so some are left a
//! little above the limit: more `sweeps` bring them closer (an accuracy–time choice).

use super::membrane::{Membrane, all, image, membranes};
use super::{Effect, Registration};
use crate::simulation::colour::{Coloured, Local};
use crate::simulation::plan::Plan;
use crate::simulation::scene::RATIO;
use crate::simulation::sweeps::Sweeps;
use selvedge_core::glam::DVec3;

pub(super) const REGISTRATION: Registration = Registration {
    name: "strain_limit",
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
        let limits = membranes(cloth)
            .into_iter()
            .map(|(membrane, _)| Limit { membrane, limit })
            .collect();
        let vertex_count = cloth.mesh.positions.len();
        let limits = Coloured::new(limits, vertex_count);
        plan.add_constraint(Sweeps::new(limits, vertex_count, self.sweeps));
    }
}

#[derive(Debug)]
struct Limit {
    membrane: Membrane,
    limit: f64,
}

impl Local<3> for Limit {
    #[inline(always)]
    fn vertices(&self) -> [u32; 3] {
        self.membrane.vertices
    }

    /// Most are far below the limit, and a length is no more than the sum of its parts.
    #[inline(always)]
    fn moves_nothing(&self, x: [DVec3; 3]) -> bool {
        let Membrane { a, b, .. } = self.membrane;
        let (warp, weft) = (image(a, x), image(b, x));
        let (uu, uv, vv) = (warp.dot(warp), warp.dot(weft), weft.dot(weft));
        let (middle, half) = (0.5 * (uu + vv), 0.5 * (uu - vv));
        middle + half.abs() + uv.abs() < self.limit * self.limit
    }

    #[inline(always)]
    fn corrections(&self, x: [DVec3; 3], w: [f64; 3], _: f64) -> [DVec3; 3] {
        if self.moves_nothing(x) {
            return [DVec3::ZERO; 3];
        }
        let Membrane { a, b, .. } = self.membrane;
        let (warp, weft) = (image(a, x), image(b, x));
        let (uu, uv, vv) = (warp.dot(warp), warp.dot(weft), weft.dot(weft));
        let (middle, half) = (0.5 * (uu + vv), 0.5 * (uu - vv));
        let spread = (half * half + uv * uv).sqrt();
        let largest = (middle + spread).sqrt();
        if !(largest > self.limit) {
            return [DVec3::ZERO; 3];
        }
        // The eigenvector of the larger eigenvalue, by whichever of its two forms does not cancel.
        let (du, dv) = if half >= 0.0 {
            (half + spread, uv)
        } else {
            (uv, spread - half)
        };
        let length = (du * du + dv * dv).sqrt();
        let (du, dv) = if length > 0.0 {
            (du / length, dv / length)
        } else {
            (1.0, 0.0)
        };
        let two = [du * a[0] + dv * b[0], du * a[1] + dv * b[1]];
        let c = all(two);
        let weight = w[0] * c[0] * c[0] + w[1] * c[1] * c[1] + w[2] * c[2] * c[2];
        if !(weight > 0.0) {
            return [DVec3::ZERO; 3];
        }
        let along = image(two, x) * ((self.limit - largest) / (weight * largest));
        [0, 1, 2].map(|k| along * (w[k] * c[k]))
    }
}
