//! Attachments hold vertices with a limited force. A vertex that needs more is released by itself and for good.
//!
//! Each attachment is a spring between a vertex and its anchor, of the stiffness k = limit/give. The force reaches the limit when
//! the spring is as long as `give`. A vertex is released when an accepted step ends with the vertex farther from its anchor than
//! that.
//!
//! The step is [solved](crate::solve::springs) with the springs in it. At rest the force is then k·|x − a| whatever else pulls,
//! and light vertices are held as well as heavy ones.

use super::anchor::Anchor;
use super::pins::PinMotion;
use super::registration::{Effect, Registration, Scope};
use super::selection::{check_body, check_vertices, group_keys, placed, read_motion, read_vertices};
use crate::effects::plan::Plan;
use crate::input::{FORCE, Field, LENGTH, ValueError};
use crate::model::step::{Memory, Release, TimeStep};
use crate::solve::SpringGroup;
use crate::solve::springs::{Held, Spring, Springs};
use crate::world::{BodyMotion, KeyframeMotion, SceneParts};
use selvedge_core::glam::DVec3;

const LIMIT: Field = Field::new("limit", FORCE, 1e-6, 1e6);
const GIVE: Field = Field::new("give", LENGTH, 1e-6, 1.0);

pub(super) const REGISTRATION: Registration = Registration::new(&["group"], |table, world| {
    let mut attachments = Attachments::default();
    let mut taken = vec![false; world.cloth_vertices()];
    for table in table.tables("group")? {
        table.expect_keys(&group_keys(&[LIMIT.name, GIVE.name]))?;
        let mut group = AttachmentGroup::resting(read_vertices(&table, world)?, table.required_number(&LIMIT)?);
        group.motion = read_motion(&table, world)?;
        group.give = table.number(&GIVE)?.unwrap_or(group.give);
        group.check(world, &mut taken).map_err(|error| placed(&table, error))?;
        attachments.groups.push(group);
    }
    Ok(Box::new(attachments))
});

/// Vertices of the cloth that are held until the force exceeds a limit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Attachments {
    /// Groups of vertices. A vertex may be in one group at most.
    pub groups: Vec<AttachmentGroup>,
}

/// A group of held vertices with a common motion of their anchors.
#[derive(Clone, Debug, PartialEq)]
pub struct AttachmentGroup {
    /// The vertices, as the scene numbers them through all cloths. [`Scene::part`](crate::Scene::part) returns named ones.
    pub vertices: Vec<u32>,
    /// The motion of the anchors. The caller cannot drive it directly ([`BodyMotion::Driven`]), but it may follow a body that the
    /// caller drives.
    pub motion: PinMotion,
    /// The force in N above which a vertex is released.
    pub limit: f64,
    /// The distance in m from the anchor at which a vertex is released.
    pub give: f64,
}

impl AttachmentGroup {
    /// Holds vertices at their initial positions. Each is released above a force in N, which is reached at a millimetre.
    #[must_use]
    pub fn resting(vertices: impl Into<Vec<u32>>, limit: f64) -> Self {
        Self {
            vertices: vertices.into(),
            motion: PinMotion::Own(KeyframeMotion::resting().into()),
            limit,
            give: 1e-3,
        }
    }

    /// Checks the group, and marks its vertices as taken.
    fn check(&self, world: &SceneParts<'_>, taken: &mut [bool]) -> Result<(), ValueError> {
        check_vertices(&self.vertices, taken, "attached")?;
        LIMIT.check(self.limit)?;
        GIVE.check(self.give)?;
        match &self.motion {
            &PinMotion::Body(body) => {
                check_body(body, world)?;
                if matches!(world.bodies[body].motion, BodyMotion::Free(_)) {
                    let name = &world.bodies[body].name;
                    let message =
                        format!("attachments cannot follow '{name}', which moves freely (it has a mass): pin the vertices to it");
                    return Err(ValueError::new("follow", message));
                }
                Ok(())
            }
            PinMotion::Own(motion @ BodyMotion::Keyframes(_)) => {
                motion.check(&world.positions_of(&self.vertices), world.time_step)
            }
            PinMotion::Own(_) => {
                let message =
                    "attachments follow keyframes or a body (`follow`), which may be driven; they cannot be driven themselves";
                Err(ValueError::new("driven", message))
            }
        }
    }
}

crate::identify!(Attachments { groups });
crate::identify!(AttachmentGroup {
    vertices,
    motion,
    limit,
    give
});

impl Effect for Attachments {
    fn name(&self) -> &'static str {
        "attachments"
    }

    fn scope(&self) -> Scope {
        Scope::Scene
    }

    fn check(&self, world: &SceneParts<'_>) -> Result<(), ValueError> {
        if self.groups.is_empty() {
            let message = "attachments need at least one [[effects.attachments.group]]";
            return Err(ValueError::new("group", message));
        }
        let mut taken = vec![false; world.cloth_vertices()];
        self.groups.iter().try_for_each(|group| group.check(world, &mut taken))
    }

    fn register(&self, plan: &mut Plan<'_>) {
        let start = plan.start();
        let mut all = Vec::new();
        for (index, group) in self.groups.iter().enumerate() {
            let anchor: Box<dyn Fn(DVec3) -> Anchor + '_> = match &group.motion {
                &PinMotion::Body(body) => {
                    let triangles = plan.triangles_of(body);
                    let start = &start;
                    Box::new(move |point| Anchor::on(&triangles, start, point))
                }
                PinMotion::Own(motion) => {
                    let carrier = plan.add_motion(motion.clone(), Vec::new());
                    Box::new(move |point| Anchor::Carried(carrier, point))
                }
            };
            let place = |vertex: u32| start[vertex as usize];
            all.extend(plan.scene.numbered(&group.vertices).into_iter().map(|vertex| Attachment {
                group: index,
                vertex,
                anchor: anchor(place(vertex)),
                last: place(vertex),
                stiffness: group.limit / group.give,
                give: group.give,
                released: None,
            }));
        }
        plan.attachment_groups = self.groups.len();
        plan.add_term(Held::new(Holding(all)));
    }
}

#[derive(Debug)]
struct Attachment {
    group: usize,
    vertex: u32,
    anchor: Anchor,
    /// The anchor's position at the end of the last step.
    last: DVec3,
    /// The stiffness, in N/m.
    stiffness: f64,
    /// The distance at which the vertex is released, in m.
    give: f64,
    /// The time of the release, in seconds.
    released: Option<f64>,
}

#[derive(Debug)]
struct Holding(Vec<Attachment>);

impl Attachment {
    fn spring(&self, anchor: DVec3) -> Spring {
        Spring {
            vertex: self.vertex,
            anchor,
            stiffness: self.stiffness,
            group: SpringGroup::Attachments(self.group),
            body: self.anchor.vertex_of_body(),
        }
    }
}

impl Springs for Holding {
    fn springs(&self, step: &TimeStep<'_>, x: &[DVec3], springs: &mut Vec<Spring>) {
        let holding = self.0.iter().filter(|held| held.released.is_none());
        springs.extend(holding.map(|held| held.spring(held.anchor.end_position(step, x))));
    }

    fn settled(&self) -> Vec<Spring> {
        let holding = self.0.iter().filter(|held| held.released.is_none());
        holding.map(|held| held.spring(held.last)).collect()
    }
}

impl Memory for Holding {
    fn settle(&mut self, step: &TimeStep<'_>, positions: &[DVec3]) {
        for held in self.0.iter_mut().filter(|held| held.released.is_none()) {
            held.last = held.anchor.end_position(step, positions);
            if held.last.distance(positions[held.vertex as usize]) > held.give {
                held.released = Some(step.time);
            }
        }
    }

    /// Returns for each vertex the time of its release, −1 while it holds, and the position of its anchor.
    fn numbers(&self) -> Vec<f64> {
        let of = |held: &Attachment| {
            let [x, y, z] = held.last.to_array();
            [held.released.unwrap_or(-1.0), x, y, z]
        };
        self.0.iter().flat_map(of).collect()
    }

    fn recall(&mut self, numbers: &[f64]) {
        for (held, own) in self.0.iter_mut().zip(numbers.chunks_exact(4)) {
            held.released = (own[0] >= 0.0).then_some(own[0]);
            held.last = DVec3::new(own[1], own[2], own[3]);
        }
    }

    fn held_by(&self) -> Vec<(u32, Option<u32>)> {
        let held = self.0.iter().filter(|held| held.released.is_none());
        held.map(|held| (held.vertex, held.anchor.vertex_of_body())).collect()
    }

    fn teleport(&mut self, is_moved: &[bool], to: &dyn Fn(DVec3) -> DVec3) {
        for held in self.0.iter_mut().filter(|held| is_moved[held.vertex as usize]) {
            held.last = to(held.last);
        }
    }

    fn released(&self) -> Vec<Release> {
        let released = |held: &Attachment| {
            held.released.map(|time| Release {
                group: held.group,
                vertex: held.vertex,
                time,
            })
        };
        self.0.iter().filter_map(released).collect()
    }
}
