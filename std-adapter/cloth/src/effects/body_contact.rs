//! Body contact: the cloth keeps a thickness from bodies, and every step is certified not to pass through their triangles.
//!
//! Capsules and balls push vertices by their exact distance, so that cloth slides on a smooth surface; edges and faces of the
//! cloth are kept off by the pairs with the body's mesh, as for any other body.

use super::registration::{Effect, Registration, Scope};
use super::thickness;
use crate::contact::{RECOVERY, Thickness};
use crate::effects::plan::Plan;
use crate::input::ValueError;
use crate::model::step::{Constraint, TimeStep, Touch, Touches};
use crate::world::{Pose, SceneParts};
use selvedge_core::glam::DVec3;

pub(super) const REGISTRATION: Registration = Registration {
    keys: &["thickness", "separation"],
    needs: &[],
    read: |table, _| Ok(Box::new(BodyContact(thickness::read(table)?))),
};

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
        let cloth_vertices = plan.scene.cloth.mesh.positions.len();
        let bodies = plan.scene.bodies.iter().enumerate();
        let capsules: Vec<_> = bodies
            .filter_map(|(carrier, body)| {
                let (ends, radius) = body.capsule?;
                Some(Capsule { carrier, ends, radius })
            })
            .collect();
        if !capsules.is_empty() {
            plan.add_constraint(Push {
                capsules,
                cloth_vertices,
                thickness: self.0.thickness,
            });
        }
    }
}

#[derive(Debug)]
struct Capsule {
    carrier: usize,
    /// At rest.
    ends: [DVec3; 2],
    radius: f64,
}

#[derive(Debug)]
struct Push {
    capsules: Vec<Capsule>,
    cloth_vertices: usize,
    thickness: f64,
}

/// The way out of a capsule's axis to a point, at one pose.
fn outward(capsule: &Capsule, pose: &Pose, point: DVec3) -> DVec3 {
    let [from, to] = capsule.ends.map(|end| pose.apply(end));
    point - nearest(from, to - from, point)
}

/// The point of a line, from `from` along `axis`, that is nearest.
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
        for capsule in &self.capsules {
            let [before, now] = step.poses[capsule.carrier];
            if !now.is_rigid() {
                continue;
            }
            let [from, to] = capsule.ends.map(|end| now.apply(end));
            let axis = to - from;
            let reach = capsule.radius + self.thickness;
            let cloth = positions[..self.cloth_vertices].iter_mut().enumerate();
            for (vertex, position) in cloth {
                let way = *position - nearest(from, axis, *position);
                let distance = way.length();
                if !(distance < reach && distance > 0.0 && step.inverse_masses[vertex] > 0.0) {
                    continue;
                }
                // What starts too deep comes out slowly.
                let start = step.start[vertex];
                let depth = outward(capsule, &before, start).length();
                let push = reach.min(depth + RECOVERY * step.h) - distance;
                if push > 0.0 {
                    let normal = way / distance;
                    *position += normal * push;
                    touches.record(|| Touch {
                        vertices: [vertex as u32; 4],
                        weights: [1.0, 0.0, 0.0, 0.0],
                        normal,
                        push,
                        drift: before.carry(&now, start) - start,
                    });
                }
            }
        }
    }
}
