//! Body contact: the cloth keeps a thickness from bodies, and every step is certified not to pass through their triangles.
//!
//! Capsules and balls push vertices by their exact distance, so that cloth slides on a smooth surface. Edges and faces of the
//! cloth are kept off by the pairs with the body's mesh, as for any other body.

use super::registration::{Effect, Registration, Scope};
use super::thickness;
use crate::contact::Thickness;
use crate::contact::smooth_body::SmoothBody;
use crate::effects::plan::Plan;
use crate::input::ValueError;
use crate::model::length::length;
use crate::model::schedule::Rooms;
use crate::model::step::{Constraint, TimeStep, Touches};
use crate::model::touches::Touch;
use crate::world::{Pose, SceneParts};
use selvedge_core::glam::DVec3;
use std::ops::Range;

pub(super) const REGISTRATION: Registration = Registration::new(&["thickness", "separation"], |table, _| {
    Ok(Box::new(BodyContact(thickness::read(table)?)))
});

/// The cloth keeps a thickness from bodies, and every step is certified not to pass through their triangles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyContact(pub Thickness);

impl Effect for BodyContact {
    fn name(&self) -> &'static str {
        "body_contact"
    }

    fn scope(&self) -> Scope {
        Scope::AllCloths
    }

    fn check(&self, world: &SceneParts<'_>) -> Result<(), ValueError> {
        if world.bodies.is_empty() {
            let message = "body contact has nothing to act on: the scene has no [[body]]";
            return Err(ValueError::new("", message));
        }
        thickness::check(&self.0)
    }

    fn settings(&self) -> Vec<(&'static str, String)> {
        thickness::settings(&self.0)
    }

    fn register(&self, plan: &mut Plan<'_>) {
        plan.contact.keep_from_bodies(plan.effect, self.0);
        let first = plan.first_vertex() as usize;
        let vertices = first..first + plan.scene.cloth.mesh.positions.len();
        let bodies = plan.scene.bodies.iter().enumerate();
        let capsules: Vec<_> = bodies
            .filter_map(|(carrier, body)| {
                let (ends, radius) = body.capsule?;
                Some(Capsule { carrier, ends, radius })
            })
            .collect();
        if plan.solves_at_once() {
            let smooth = capsules.into_iter().map(|Capsule { carrier, ends, radius }| SmoothBody {
                carrier,
                ends,
                radius,
                thickness: self.0.thickness,
                vertices: vertices.clone(),
            });
            plan.smooth_bodies.extend(smooth);
            return;
        }
        if !capsules.is_empty() {
            plan.add_push(Push {
                capsules,
                vertices,
                thickness: self.0.thickness,
                rooms: Rooms::default(),
                seen: Vec::new(),
            });
        }
    }
}

/// The share of lengths that exceeds the rounding of a distance.
const ROUNDING: f64 = 1e-9;

#[derive(Debug)]
struct Capsule {
    carrier: usize,
    /// The ends of the axis at rest.
    ends: [DVec3; 2],
    radius: f64,
}

#[derive(Debug)]
struct Push {
    capsules: Vec<Capsule>,
    /// The cloth's vertices among the scene's.
    vertices: Range<usize>,
    thickness: f64,
    /// The ways of the vertices and then of the ends of capsules, and the room of each vertex beside each capsule.
    rooms: Rooms,
    /// The positions of both when they acted last.
    seen: Vec<DVec3>,
}

/// Returns the vector from the nearest point of a capsule's axis to a point, at one pose.
fn outward(capsule: &Capsule, pose: &Pose, point: DVec3) -> DVec3 {
    let [from, to] = capsule.ends.map(|end| pose.apply(end));
    point - nearest(from, to - from, point)
}

/// Returns the nearest point of a line segment from `from` along `axis`.
#[inline(always)]
fn nearest(from: DVec3, axis: DVec3, point: DVec3) -> DVec3 {
    let squared = axis.length_squared();
    if squared > 0.0 {
        from + axis * ((point - from).dot(axis) / squared).clamp(0.0, 1.0)
    } else {
        from
    }
}

impl Constraint for Push {
    fn project(&mut self, step: &TimeStep<'_>, positions: &mut [DVec3], touches: &mut Touches) {
        let Self {
            capsules,
            vertices,
            thickness,
            rooms,
            seen,
        } = self;
        let count = vertices.len();
        let ends = |capsule: &Capsule| capsule.ends.map(|end| step.poses[capsule.carrier][1].apply(end));
        let now = positions[vertices.clone()]
            .iter()
            .copied()
            .chain(capsules.iter().flat_map(ends));
        rooms.begin(seen, now, count * capsules.len());
        for (index, capsule) in capsules.iter().enumerate() {
            let [before, now] = step.poses[capsule.carrier];
            if !now.is_rigid() {
                continue;
            }
            let first = count + 2 * index;
            let [from, to] = [seen[first], seen[first + 1]];
            let axis = to - from;
            let reach = capsule.radius + *thickness;
            let rounding = ROUNDING * (reach + length(from) + length(to));
            for (place, vertex) in vertices.clone().enumerate() {
                let position = positions[vertex];
                let room = || (1.0 - ROUNDING) * length(position - nearest(from, axis, position)) - reach - rounding;
                let places = [place, first, first + 1].map(|place| place as u32);
                if rooms.suffices(index * count + place, &places, room) {
                    continue;
                }
                let way = position - nearest(from, axis, position);
                let distance = length(way);
                let inverse_mass = step.inverse_masses[vertex];
                if !(distance < reach && distance > 0.0 && inverse_mass > 0.0) {
                    continue;
                }
                let normal = way / distance;
                let start = step.start[vertex];
                let touch = Touch {
                    drift: before.carry(&now, start) - start,
                    ..Touch::new([vertex as u32; 4], [1.0, 0.0, 0.0, 0.0], normal, inverse_mass, 0.0)
                };
                // A vertex that starts too deep is shifted out. A shift gives no velocity.
                let at_start = outward(capsule, &before, start).length();
                let missing = reach - at_start;
                let start_to_end = (start - nearest(from, axis, start)).length();
                let at_start = match touches.shift().get(vertex) {
                    Some(shift) => at_start + normal.dot(*shift),
                    None => at_start,
                };
                let push = reach.min(at_start) - distance;
                touches.record_missing(
                    touch,
                    [missing, missing.max(reach - start_to_end)],
                    *thickness,
                    step.inverse_masses,
                );
                if push > 0.0 {
                    positions[vertex] += normal * push;
                    rooms.follow(&[place as u32], [normal * push]);
                    touches.record(|| Touch { push, ..touch });
                }
            }
        }
    }
}
