//! Loads: the forces of cloth and ropes on bodies, pins and attachments.
//!
//! They are those of the [solve](crate::solve::loads), by Newton's third law. A part of a step that is not accepted leaves none.
//! Torques are summed about the origin of the scene, so that a caller may name any point later.
//!
//! **Pins.** A pinned vertex of mass m has a given motion. What holds it feels all that pulls the vertex, its weight, and −m·a of
//! its acceleration. Forces leave pinned vertices alone, so they are applied again to a copy in which no vertex is pinned. A soft
//! pin feels the pull of its spring alone.
//!
//! **Accuracy.** The sum of all loads is the change of the cloth's momentum without that by gravity, up to the force that the
//! solve left ([`Accuracy`](crate::Accuracy)), and what the certificate took from the motion. At rest both vanish.

use super::added_forces::AddedForces;
use crate::contact::smooth_body::SmoothBody;
use crate::effects::plan::ActingForce;
use crate::model::step::{Carrier, TimeStep};
use crate::solve::{ContactRow, RowKey, Solve, SpringGroup};
use crate::world::Cloth;
use selvedge_core::glam::DVec3;

/// A force and its torque about a point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wrench {
    /// The force, in N.
    pub force: DVec3,
    /// The torque, in N·m.
    pub torque: DVec3,
}

impl Wrench {
    /// Returns a force at a point, with its torque about the origin.
    fn at(point: DVec3, force: DVec3) -> Self {
        let torque = point.cross(force);
        Self { force, torque }
    }

    /// Returns the same about another point than the origin.
    pub(super) fn about(self, point: DVec3) -> Self {
        let torque = self.torque - point.cross(self.force);
        Self { torque, ..self }
    }

    fn add(&mut self, other: Self, times: f64) {
        self.force += other.force * times;
        self.torque += other.torque * times;
    }

    fn scaled(self, by: f64) -> Self {
        Self {
            force: self.force * by,
            torque: self.torque * by,
        }
    }
}

/// The load of cloth and ropes on a body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BodyLoad {
    /// The push of contacts, along their normals.
    pub contact: Wrench,
    /// The friction of contacts.
    pub friction: Wrench,
    /// The pull of [pins](crate::effects::Pins) that follow the body.
    pub pins: Wrench,
    /// The pull of [attachments](crate::effects::Attachments) to the body.
    pub attachments: Wrench,
}

impl BodyLoad {
    /// Returns the sum.
    #[must_use]
    pub fn total(&self) -> Wrench {
        let mut total = Wrench::default();
        self.parts().into_iter().for_each(|part| total.add(part, 1.0));
        total
    }

    const fn parts(&self) -> [Wrench; 4] {
        [self.contact, self.friction, self.pins, self.attachments]
    }

    pub(super) fn map(self, part: impl Fn(Wrench) -> Wrench) -> Self {
        let [contact, friction, pins, attachments] = self.parts().map(part);
        Self {
            contact,
            friction,
            pins,
            attachments,
        }
    }

    fn add(&mut self, other: &Self, times: f64) {
        self.contact.add(other.contact, times);
        self.friction.add(other.friction, times);
        self.pins.add(other.pins, times);
        self.attachments.add(other.attachments, times);
    }
}

/// The load of one contact on a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactLoad {
    /// The point of the cloth, in m, about which the contact acts.
    pub point: DVec3,
    /// The vertices of the cloth and of the body. On a ball or a capsule, all four are the vertex of the cloth.
    pub vertices: [u32; 4],
    /// The push on the body, in N.
    pub push: DVec3,
    /// The friction on the body, in N.
    pub friction: DVec3,
}

/// The pins and attachments that hold the cloth.
#[derive(Debug)]
pub(super) struct Supports {
    /// The vertices of each group of pins, apart from those with soft pins.
    groups: Vec<Vec<u32>>,
    attachment_groups: usize,
    /// All pinned vertices, each once, with their masses in kg.
    pinned: Vec<(usize, f64)>,
}

impl Supports {
    pub(super) fn new(groups: Vec<Vec<u32>>, attachment_groups: usize, cloths: &[Cloth]) -> Self {
        let mut pinned = groups.concat();
        pinned.sort_unstable();
        pinned.dedup();
        let masses: Vec<f64> = if pinned.is_empty() {
            Vec::new()
        } else {
            cloths.iter().flat_map(Cloth::masses).collect()
        };
        let pinned = pinned.into_iter().map(|vertex| vertex as usize);
        Self {
            groups,
            attachment_groups,
            pinned: pinned.map(|vertex| (vertex, masses[vertex])).collect(),
        }
    }
}

/// A solve that has ended. Its positions have not been moved since.
pub(super) struct Solved<'a> {
    pub(super) solve: &'a Solve,
    pub(super) step: &'a TimeStep<'a>,
    /// The velocities at the start of the step.
    pub(super) velocities: &'a [DVec3],
    pub(super) x: &'a [DVec3],
    pub(super) carriers: &'a [Carrier],
    pub(super) smooth_bodies: &'a [SmoothBody],
    pub(super) supports: &'a Supports,
    pub(super) drag: &'a [f64],
    pub(super) added_forces: &'a AddedForces,
    pub(super) cloth_vertices: usize,
}

/// Loads about the origin, or their impulses.
#[derive(Clone, Debug, Default)]
pub(super) struct Sums {
    pub(super) bodies: Vec<BodyLoad>,
    pub(super) pins: Vec<Wrench>,
    pub(super) attachments: Vec<Wrench>,
}

impl Sums {
    fn clear(&mut self) {
        self.bodies.fill(BodyLoad::default());
        self.pins.fill(Wrench::default());
        self.attachments.fill(Wrench::default());
    }

    fn add(&mut self, other: &Self, times: f64) {
        for (own, other) in self.bodies.iter_mut().zip(&other.bodies) {
            own.add(other, times);
        }
        let groups = self.pins.iter_mut().chain(&mut self.attachments);
        for (own, other) in groups.zip(other.pins.iter().chain(&other.attachments)) {
            own.add(*other, times);
        }
    }
}

/// The loads of the last step, and of all steps of the last run.
#[derive(Debug)]
pub(super) struct Loads {
    pub(super) now: Sums,
    pub(super) contacts: Vec<(usize, ContactLoad)>,
    /// The same for a solve whose positions are not accepted yet.
    next: Sums,
    next_contacts: Vec<(usize, ContactLoad)>,
    /// The impulses in the last run, in N·s, and its length in seconds.
    pub(super) impulses: Sums,
    seconds: f64,
    /// The motion of pinned vertices if nothing were pinned: all inverse masses, and the velocities after forces.
    inverse_masses: Vec<f64>,
    forced: Vec<DVec3>,
}

impl Loads {
    pub(super) fn new(supports: &Supports, bodies: usize) -> Self {
        let none = Sums {
            bodies: vec![BodyLoad::default(); bodies],
            pins: vec![Wrench::default(); supports.groups.len()],
            attachments: vec![Wrench::default(); supports.attachment_groups],
        };
        Self {
            now: none.clone(),
            contacts: Vec::new(),
            next: none.clone(),
            next_contacts: Vec::new(),
            impulses: none,
            seconds: 0.0,
            inverse_masses: Vec::new(),
            forced: Vec::new(),
        }
    }

    /// Forgets the last run.
    pub(super) fn begin_run(&mut self) {
        self.impulses.clear();
        self.seconds = 0.0;
    }

    /// Forgets everything, as after a checkpoint.
    pub(super) fn forget(&mut self) {
        self.begin_run();
        self.now.clear();
        self.contacts.clear();
    }

    /// Measures the loads of a solve.
    pub(super) fn measure(&mut self, solved: &Solved<'_>, forces: &mut [ActingForce]) {
        self.next.clear();
        self.next_contacts.clear();
        self.measure_contacts(solved);
        self.measure_pins(solved, forces);
        let Solved { solve, x, carriers, .. } = *solved;
        solve.visit_pulls(x, &mut |pull| {
            let load = Wrench::at(pull.anchor, pull.force);
            let body = pull.body.map(|vertex| carriers[vertex as usize] as usize);
            let body = body.and_then(|body| self.next.bodies.get_mut(body));
            let (group, of_body) = match pull.group {
                SpringGroup::Attachments(group) => (&mut self.next.attachments[group], body.map(|body| &mut body.attachments)),
                SpringGroup::Pins(group) => (&mut self.next.pins[group], body.map(|body| &mut body.pins)),
            };
            group.add(load, 1.0);
            if let Some(of_body) = of_body {
                of_body.add(load, 1.0);
            }
        });
    }

    fn measure_contacts(&mut self, solved: &Solved<'_>) {
        let (h, x) = (solved.step.h, solved.x);
        solved.solve.visit_pushes(h, x, &mut |row, forces| {
            for (body, point, side) in solved.body_sides(row).into_iter().flatten() {
                let [push, friction] = forces.map(|force| force * side);
                let load = &mut self.next.bodies[body];
                load.contact.add(Wrench::at(point, push), 1.0);
                load.friction.add(Wrench::at(point, friction), 1.0);
                let vertices = row.vertices;
                self.next_contacts.push((
                    body,
                    ContactLoad {
                        point,
                        vertices,
                        push,
                        friction,
                    },
                ));
            }
        });
    }

    fn measure_pins(&mut self, solved: &Solved<'_>, forces: &mut [ActingForce]) {
        let Solved {
            solve,
            step,
            velocities,
            x,
            carriers,
            supports,
            drag,
            added_forces,
            ..
        } = *solved;
        if supports.pinned.is_empty() {
            return;
        }
        self.inverse_masses.clear();
        self.inverse_masses.extend_from_slice(step.inverse_masses);
        for &(vertex, mass) in &supports.pinned {
            self.inverse_masses[vertex] = mass.recip();
        }
        let unpinned = TimeStep {
            inverse_masses: &self.inverse_masses,
            ..*step
        };
        self.forced.clear();
        self.forced.extend_from_slice(velocities);
        forces.iter_mut().for_each(|force| force.apply(&unpinned, &mut self.forced));
        added_forces.apply(&unpinned, &mut self.forced);
        let load = |vertex: usize| {
            let mass = unpinned.inverse_masses[vertex].recip();
            let velocity = (x[vertex] - step.start[vertex]) / step.h;
            let slowed = velocity * drag.get(vertex).copied().unwrap_or(0.0);
            let inertial = ((self.forced[vertex] - velocity) / step.h - slowed) * mass;
            Wrench::at(x[vertex], solve.force_on_pinned(vertex) + inertial)
        };
        for (sum, group) in self.next.pins.iter_mut().zip(&supports.groups) {
            group.iter().for_each(|&vertex| sum.add(load(vertex as usize), 1.0));
        }
        for &(vertex, _) in &supports.pinned {
            let carrier = carriers[vertex] as usize;
            if let Some(body) = self.next.bodies.get_mut(carrier) {
                body.pins.add(load(vertex), 1.0);
            }
        }
    }

    /// Takes the loads that were measured last as those of an accepted step of `h` seconds.
    pub(super) fn accept(&mut self, h: f64) {
        std::mem::swap(&mut self.now, &mut self.next);
        std::mem::swap(&mut self.contacts, &mut self.next_contacts);
        self.impulses.add(&self.now, h);
        self.seconds += h;
    }

    /// Returns the mean load of an impulse in the last run.
    pub(super) fn mean(&self, impulse: Wrench) -> Wrench {
        if self.seconds > 0.0 {
            impulse.scaled(self.seconds.recip())
        } else {
            impulse
        }
    }
}

impl Solved<'_> {
    /// Returns the bodies of a row, each with the point of what it meets, and the sign of its own side.
    fn body_sides(&self, row: &ContactRow) -> [Option<(usize, DVec3, f64)>; 2] {
        if let RowKey::Smooth(vertex, index) = row.key {
            let body = self.smooth_bodies[index as usize].carrier;
            return [Some((body, self.x[vertex as usize], -1.0)), None];
        }
        [1.0, -1.0].map(|side| {
            let (mut body, mut point) = (None, DVec3::ZERO);
            for (vertex, weight) in row.parts() {
                if weight * side < 0.0 {
                    point += self.x[vertex] * weight.abs();
                } else if vertex >= self.cloth_vertices {
                    body = Some(self.carriers[vertex] as usize);
                }
            }
            Some((body?, point, side))
        })
    }
}
