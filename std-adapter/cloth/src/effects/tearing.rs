//! Tearing: edges tear when their load is above their strength ([`tearing`](crate::model::tearing)).
//!
//! **Still certified.** After the certificate of a step, overloaded edges tear, and the two sides of a tear open by a small share
//! of an edge. The opening is no part of a step. It is accepted only if the exact test finds no intersection. A certificate must
//! also show that nothing passed through anything on the way, except for pairs that had a vertex in common. Otherwise the tear
//! waits for room. So every state is free, before a tear and after it. While a body or a tangle is excluded from the guarantee,
//! nothing tears.
//!
//! **Cost.** Each step computes the tension of each triangle and the load of each edge. A step after which something tears
//! rebuilds everything that depends on the mesh: terms, the matrix, candidates. While a tear waits, each twentieth step does so
//! as well.
//!
//! A [`StrainLimit`](super::StrainLimit) of L keeps loads below k·(L − 1). A strength above that is never reached.

use super::registration::{Effect, Registration};
use super::selection::{SELECTORS, check_vertices, placed, read_vertices};
use crate::effects::plan::Plan;
use crate::input::{Field, MEMBRANE_STIFFNESS, ValueError};
use crate::model::tearing::Tearable;
use crate::world::SceneParts;

const STRENGTH: Field = Field::new("strength", MEMBRANE_STIFFNESS, 1e-3, 1e9);

pub(super) const REGISTRATION: Registration = Registration::new(&["strength", "perforation"], |table, world| {
    let mut tearing = Tearing {
        strength: table.number(&STRENGTH)?,
        perforations: Vec::new(),
    };
    for table in table.tables("perforation")? {
        table.expect_keys(&[&SELECTORS[..], &["cloth", STRENGTH.name]].concat())?;
        let perforation = Perforation {
            vertices: read_vertices(&table, world)?,
            strength: table.required_number(&STRENGTH)?,
        };
        perforation.check(world).map_err(|error| placed(&table, error))?;
        tearing.perforations.push(perforation);
    }
    Ok(Box::new(tearing))
})
.needing(&["stretch"]);

/// Edges between two triangles tear when the pull of [`Stretch`](super::Stretch) across them exceeds their strength.
///
/// A tear begins at the border with one edge, within the cloth with two edges at a vertex. It advances by an edge per step at
/// each of its ends. New vertices follow the others of their cloth, which keep their numbers; the vertices of later cloths and
/// bodies move up among the [`positions`](crate::Simulation::positions). Pinned vertices are never split. Attachments and seams
/// hold the vertex that keeps the number. A closed cloth that has torn loses its [`InternalPressure`](super::InternalPressure).
///
/// ```
/// use selvedge_cloth::effects::{PinGroup, PinMotion, Pins, SelfCollision, Stretch, Tearing, Thickness};
/// use selvedge_cloth::glam::DVec3;
/// use selvedge_cloth::{Cloth, Keyframe, KeyframeMotion, Scene, Simulation};
///
/// // A strip with a perforation across its middle. Its ends are drawn apart by a centimetre.
/// let mut scene = Scene::new(Cloth::sheet(DVec3::ZERO, [0.1 * DVec3::X, 0.05 * DVec3::Y], [10, 5], 0.2)?, 1e-3);
/// let [left, right] = ["left", "right"].map(|part| scene.part("cloth", part).unwrap_or_default());
/// let keys = [(0.0, 0.0), (0.1, 0.01)].map(|(time, x)| Keyframe { time, translation: DVec3::X * x, ..Keyframe::default() });
/// let away = PinMotion::Own(KeyframeMotion::new(DVec3::ZERO, DVec3::Z, keys.to_vec())?.into());
/// scene.add(Pins { groups: vec![PinGroup::resting(left), PinGroup::new(right, away)] });
/// scene.add(Stretch::isotropic(1000.0)).add(SelfCollision(Thickness::new(1e-3)));
/// scene.add(Tearing::perforated((0..6).map(|row| 11 * row + 5).collect::<Vec<u32>>(), 20.0));
///
/// let mut simulation = Simulation::new(scene, 1)?;
/// for _ in 0..100 {
///     simulation.step()?;
/// }
/// assert_eq!(simulation.torn_edges().len(), 5);
/// assert_eq!(simulation.positions().len(), 66 + 6);
/// assert!(simulation.is_certified());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tearing {
    /// The strength of the cloth, in N per metre of an edge at rest. With `None` only perforations tear.
    pub strength: Option<f64>,
    /// Edges with a strength of their own.
    pub perforations: Vec<Perforation>,
}

/// Edges that tear more easily than others: those with both ends in `vertices`.
#[derive(Clone, Debug, PartialEq)]
pub struct Perforation {
    /// The vertices, as the scene numbers them through all cloths.
    pub vertices: Vec<u32>,
    /// The strength, in N per metre of an edge at rest. If several strengths apply to an edge, the least counts.
    pub strength: f64,
}

impl Tearing {
    /// Lets any edge tear above a strength in N/m.
    #[must_use]
    pub const fn above(strength: f64) -> Self {
        Self {
            strength: Some(strength),
            perforations: Vec::new(),
        }
    }

    /// Lets only edges between these vertices tear, above a strength in N/m.
    #[must_use]
    pub fn perforated(vertices: impl Into<Vec<u32>>, strength: f64) -> Self {
        let vertices = vertices.into();
        Self {
            strength: None,
            perforations: vec![Perforation { vertices, strength }],
        }
    }
}

impl Perforation {
    fn check(&self, world: &SceneParts<'_>) -> Result<(), ValueError> {
        check_vertices(
            &self.vertices,
            &mut vec![false; world.cloth_vertices()],
            "in this perforation",
        )?;
        STRENGTH.check(self.strength)?;
        let is_named = world.named(&self.vertices);
        let mut cloths = world.cloths.iter().zip(world.vertices_as_made());
        let has_edge = cloths.any(|(cloth, vertices)| {
            let mut edges = cloth.topology.edges().iter();
            edges.any(|edge| edge.iter().all(|&end| is_named[vertices.start + end as usize]))
        });
        if has_edge {
            return Ok(());
        }
        let message = "no edge of the cloth has both its ends in this perforation";
        Err(ValueError::new("vertices", message))
    }
}

crate::identify!(Tearing { strength, perforations });
crate::identify!(Perforation { vertices, strength });

impl Effect for Tearing {
    fn name(&self) -> &'static str {
        "tearing"
    }

    fn check(&self, world: &SceneParts<'_>) -> Result<(), ValueError> {
        if self.strength.is_none() && self.perforations.is_empty() {
            let message = "tearing needs a `strength`, such as \"2 kN/m\", or at least one [[effects.tearing.perforation]]";
            return Err(ValueError::new(STRENGTH.name, message));
        }
        self.strength.map_or(Ok(()), |strength| STRENGTH.check(strength))?;
        self.perforations.iter().try_for_each(|perforation| perforation.check(world))
    }

    fn fabric(&self) -> Vec<(&'static str, String)> {
        let written = |strength| MEMBRANE_STIFFNESS.written_short(strength);
        let of_cloth = self.strength.map(|strength| ("tears above", written(strength)));
        let weakest = { self.perforations.iter() }
            .map(|perforation| perforation.strength)
            .reduce(f64::min);
        let perforated = weakest.map(|strength| ("perforations tear above", written(strength)));
        of_cloth.into_iter().chain(perforated).collect()
    }

    fn register(&self, plan: &mut Plan<'_>) {
        // Without stretch there is no load.
        let Some(stiffness) = plan.fabric().stretch else { return };
        let (world, cloth) = (plan.scene, plan.scene.cloth);
        let first = world
            .vertices_as_made()
            .nth(plan.cloth())
            .map_or(0, |vertices| vertices.start);
        let named: Vec<(Vec<bool>, f64)> = { self.perforations.iter() }
            .map(|perforation| (world.named(&perforation.vertices), perforation.strength))
            .collect();
        let strength = |edge: [u32; 2]| {
            let is_within = |is_named: &[bool]| edge.iter().all(|&end| is_named[first + cloth.as_made(end) as usize]);
            let own = named
                .iter()
                .filter(|(is_named, _)| is_within(is_named))
                .map(|(_, strength)| *strength);
            own.chain(self.strength).reduce(f64::min)
        };
        plan.add_tearable(Tearable::new(cloth, stiffness, strength));
    }
}
