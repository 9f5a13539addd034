//! Resistance of loose edges to being bent: of ropes, laces and fringes ([`rope`](crate::model::rope)).

use super::registration::{ActsOn, Effect, Registration};
use crate::effects::plan::Plan;
use crate::input::{Field, ROPE_BENDING_STIFFNESS, ValueError};
use crate::model::rope::Bending;
use crate::world::SceneParts;

const STIFFNESS: Field = Field::new("stiffness", ROPE_BENDING_STIFFNESS, 1e-15, 1e3);
const REST: [(&str, RopeShape); 2] = [("straight", RopeShape::Straight), ("as_built", RopeShape::AsBuilt)];

pub(super) const REGISTRATION: Registration = Registration {
    keys: &["stiffness", "rest"],
    needs: &[],
    read: |table, _| {
        Ok(Box::new(RopeBend {
            stiffness: table.required_number(&STIFFNESS)?,
            rest: table.choice("rest", &REST)?.unwrap_or_default(),
        }))
    },
};

/// Resistance of loose edges to being bent where two of them meet, and no third.
///
/// It does not resist being twisted, and where a rope begins at a triangle's vertex it turns freely, as on a ring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RopeBend {
    /// The flexural rigidity in N·m²: the moment that it takes to bend it by a radian a metre. Of a solid rod of the diameter d that is
    /// Young's modulus times πd⁴/64; of strands that slide on each other much less.
    pub stiffness: f64,
    /// How it is bent where it holds no energy.
    pub rest: RopeShape,
}

/// How a rope is bent at rest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RopeShape {
    /// Not at all, however the scene lays it.
    #[default]
    Straight,
    /// By as much at each vertex as in the scene; to which side does not matter.
    AsBuilt,
}

impl RopeBend {
    /// Of a flexural rigidity in N·m², straight at rest.
    #[must_use]
    pub const fn straight(stiffness: f64) -> Self {
        Self {
            stiffness,
            rest: RopeShape::Straight,
        }
    }
}

impl Effect for RopeBend {
    fn name(&self) -> &'static str {
        "rope_bend"
    }

    fn acts_on(&self) -> ActsOn {
        ActsOn::LooseEdges
    }

    fn check(&self, _: &SceneParts<'_>) -> Result<(), ValueError> {
        STIFFNESS.check(self.stiffness)
    }

    fn fabric(&self) -> Vec<(&'static str, String)> {
        let stiffness = ROPE_BENDING_STIFFNESS.written_short(self.stiffness);
        vec![("bending stiffness of loose edges", stiffness)]
    }

    fn register(&self, plan: &mut Plan<'_>) {
        let is_bent_at_rest = self.rest == RopeShape::AsBuilt;
        plan.add_constraint(Bending::new(plan.scene.cloth, self.stiffness, is_bent_at_rest));
    }
}
