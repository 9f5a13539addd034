//! Bending resistance of loose edges: ropes, laces and fringes ([`ropes`](crate::solve::ropes)).

use super::registration::{ActsOn, Effect, Registration};
use crate::effects::plan::Plan;
use crate::input::{Field, ROPE_BENDING_STIFFNESS, ValueError};
use crate::world::SceneParts;

const STIFFNESS: Field = Field::new("stiffness", ROPE_BENDING_STIFFNESS, 1e-15, 1e3);
const REST: [(&str, RopeShape); 2] = [("straight", RopeShape::Straight), ("as_built", RopeShape::AsBuilt)];

pub(super) const REGISTRATION: Registration = Registration::new(&["stiffness", "rest"], |table, _| {
    Ok(Box::new(RopeBend {
        stiffness: table.required_number(&STIFFNESS)?,
        rest: table.choice("rest", &REST)?.unwrap_or_default(),
    }))
});

/// Bending resistance where exactly two loose edges meet.
///
/// There is no resistance to twist. A rope turns freely where it begins at a triangle's vertex, as on a ring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RopeBend {
    /// The flexural rigidity in N·m²: the moment that bends the rope by a radian per metre. For a solid rod of the diameter d it
    /// is Young's modulus times πd⁴/64. Strands that slide on each other have much less.
    pub stiffness: f64,
    /// The shape without energy.
    pub rest: RopeShape,
}

/// The shape of a rope at rest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RopeShape {
    /// The rope is straight, in whatever shape the scene lays it.
    #[default]
    Straight,
    /// The angle at each vertex is that in the scene, in any direction.
    AsBuilt,
}

impl RopeBend {
    /// Sets a flexural rigidity in N·m² and a straight rest shape.
    #[must_use]
    pub const fn straight(stiffness: f64) -> Self {
        Self {
            stiffness,
            rest: RopeShape::Straight,
        }
    }
}

crate::identify!(RopeBend { stiffness, rest });
crate::identify!(enum RopeShape { 0 => Straight, 1 => AsBuilt });

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
        let (effect, cloth, first) = (plan.effect, plan.scene.cloth, plan.first_vertex());
        plan.ropes().bend(effect, self.stiffness, is_bent_at_rest, cloth, first);
    }
}
