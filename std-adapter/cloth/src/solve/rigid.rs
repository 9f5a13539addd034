//! Free rigid bodies in the solve.
//!
//! In the vectors of the linear problem each body has two [slots](RigidBodies::first_slot) after the cloth's vertices: a move of
//! the centre of mass, and a small rotation φ from the left, R ← exp(φ)·R.
//!
//! **Touches.** A contact pushes the body at an arm from its centre of mass. The arm leads to the *cloth*, a thickness off the
//! body's surface: friction there and on the cloth is one force at one point, and makes no angular momentum.

use super::rigid_body::{Balance, Correction, RigidBody};
use crate::model::rigid::{Freedom, RigidMotion, rotation_by, trace, vector_of};
use crate::model::step::Carrier;
use selvedge_core::glam::{DMat3, DVec3, Vec3A};

/// The place at which a row pushes a free body.
#[derive(Clone, Copy, Debug)]
struct Touch {
    /// The place among the bodies.
    body: usize,
    /// 1 on the first side of the row, −1 on the second.
    side: f64,
    /// The arm from the centre of mass at the start of the step, and the part of it that is off the body's surface.
    arm: DVec3,
    off: DVec3,
    /// On a smooth body the arm to the nearest point of its axis, once it is known.
    axis: Option<DVec3>,
}

/// The free bodies of a step.
#[derive(Clone, Debug, Default)]
pub(crate) struct RigidBodies {
    pub(crate) all: Vec<RigidBody>,
    /// The number of the cloth's vertices: the first slot in the vectors of the linear problem.
    pub(crate) first_slot: usize,
    touches: Vec<Touch>,
}

/// The side of a row that is on a free body.
pub(crate) struct OnBody {
    pub(crate) carrier: usize,
    pub(crate) side: f64,
    /// A point of its surface at the start of the step.
    pub(crate) point: DVec3,
}

impl RigidBodies {
    /// Takes the bodies of a step.
    pub(crate) fn begin(&mut self, bodies: Vec<RigidBody>, first_slot: usize) {
        self.all = bodies;
        self.first_slot = first_slot;
        self.touches.clear();
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// Returns the number of slots.
    pub(super) fn slots(&self) -> usize {
        2 * self.all.len()
    }

    /// Returns a body by its number in the scene.
    pub(crate) fn of_carrier(&self, carrier: usize) -> Option<&RigidBody> {
        self.all.iter().find(|body| body.carrier == carrier)
    }

    /// Returns whether a body of the scene is one of these.
    pub(crate) fn has(&self, carrier: Carrier) -> bool {
        self.of_carrier(carrier as usize).is_some()
    }

    fn place_of(&self, carrier: usize) -> Option<usize> {
        self.all.iter().position(|body| body.carrier == carrier)
    }

    /// Lets a row push the free bodies on its sides, and returns the first of its touches, and their number. `off` is the way
    /// from the second side to the first at rest; `None` for a row of a smooth body, whose points are those of the cloth.
    pub(crate) fn touch(&mut self, sides: &[OnBody], off: Option<DVec3>) -> [u32; 2] {
        let first = self.touches.len() as u32;
        for OnBody { carrier, side, point } in sides {
            let Some(body) = self.place_of(*carrier) else { continue };
            // Two free bodies meet halfway.
            let off = off.unwrap_or_default() * (-side / sides.len() as f64);
            self.touches.push(Touch {
                body,
                side: *side,
                arm: *point - self.all[body].motion.centre + off,
                off,
                axis: None,
            });
        }
        [first, self.touches.len() as u32 - first]
    }

    fn of(&self, [first, count]: [u32; 2]) -> &[Touch] {
        &self.touches[first as usize..(first + count) as usize]
    }

    /// Takes where the row of a smooth body acts now, and the nearest point of the axis.
    pub(crate) fn follow(&mut self, [first, _]: [u32; 2], [point, on_axis]: [DVec3; 2]) {
        let Some(touch) = self.touches.get_mut(first as usize) else {
            return;
        };
        let body = &self.all[touch.body];
        let back = body.rotated.transpose();
        let centre = body.motion.end_centre();
        touch.arm = back * (point - centre);
        touch.axis = Some(back * (on_axis - centre));
    }

    /// Returns the drift of a row of a smooth body, and the point of the axis where the solve is.
    pub(super) fn of_smooth(&self, touches: [u32; 2]) -> Option<(DVec3, Option<DVec3>)> {
        let touch = self.of(touches).first()?;
        let body = &self.all[touch.body];
        let drift = body.rotated * touch.arm - touch.arm + body.motion.displacement;
        let on_axis = touch.axis.map(|axis| body.motion.end_centre() + body.rotated * axis);
        Some((drift, on_axis))
    }

    /// Returns the drift of a row of meshes: it counts the motion of the surface, and friction acts off it.
    pub(super) fn drift(&self, touches: [u32; 2]) -> DVec3 {
        let each = self.of(touches).iter();
        let off = each.map(|touch| (touch.off - self.all[touch.body].rotated * touch.off) * touch.side);
        off.fold(DVec3::ZERO, |sum, own| sum + own)
    }

    /// Moves the bodies that no row touches to their goals.
    pub(crate) fn send_untouched(&mut self, x: &mut [DVec3]) {
        let mut are_touched: Vec<bool> = { self.all.iter() }.map(|body| !body.motion.riders.is_empty()).collect();
        self.touches.iter().for_each(|touch| are_touched[touch.body] = true);
        self.send(&are_touched, x);
    }

    /// Moves all bodies but these to their goals, where the solve leads them but for a little of the way.
    pub(crate) fn send(&mut self, stays: &[bool], x: &mut [DVec3]) {
        for (body, _) in self.all.iter_mut().zip(stays).filter(|(_, stays)| !**stays) {
            body.place(body.goal());
            body.motion.put(x);
        }
    }

    /// Writes the vertices of all bodies.
    pub(crate) fn put(&self, x: &mut [DVec3]) {
        self.all.iter().for_each(|body| body.motion.put(x));
    }

    /// Moves all bodies by a share of `moves` away from `before`.
    pub(super) fn advance(&mut self, before: &[RigidMotion], moves: &[Vec3A], share: f64) {
        let moves = moves[self.first_slot..].as_chunks::<2>().0;
        for ((body, before), moves) in self.all.iter_mut().zip(before).zip(moves) {
            let [displacement, turn] = moves.map(|own| own.as_dvec3() * share);
            body.motion.displacement = before.displacement + displacement;
            body.motion.turn = vector_of(rotation_by(turn) * rotation_by(before.turn));
            body.find_rotation();
        }
    }

    /// Returns all motions.
    pub(super) fn motions(&self) -> impl Iterator<Item = RigidMotion> {
        self.all.iter().map(|body| body.motion.clone())
    }

    /// Moves all bodies back.
    pub(super) fn go_back(&mut self, before: &[RigidMotion]) {
        for (body, before) in self.all.iter_mut().zip(before) {
            body.place(before.clone());
        }
    }

    /// Adds the gradients of inertia to a vector that has an entry for each slot so far, and returns the energy.
    pub(super) fn begin_gradient(&self, gradient: &mut Vec<DVec3>) -> f64 {
        let mut energy = 0.0;
        for body in &self.all {
            gradient.extend(body.gradient());
            energy += body.energy();
        }
        energy
    }

    /// Subtracts the force of a row on its first side from a gradient.
    pub(super) fn add_gradient(&self, touches: [u32; 2], force: DVec3, gradient: &mut [DVec3]) {
        for touch in self.of(touches) {
            let (slot, arm) = self.place(touch);
            let force = force * touch.side;
            gradient[slot] -= force;
            gradient[slot + 1] -= arm.cross(force);
        }
    }

    /// Returns what moves make of Σw·x.
    pub(super) fn moved(&self, touches: [u32; 2], moves: &[Vec3A]) -> DVec3 {
        let mut sum = DVec3::ZERO;
        for touch in self.of(touches) {
            let (slot, arm) = self.place(touch);
            let [displacement, turn] = [moves[slot], moves[slot + 1]].map(|own| own.as_dvec3());
            sum += (displacement + turn.cross(arm)) * touch.side;
        }
        sum
    }

    /// The first slot and the present arm of a touch.
    fn place(&self, touch: &Touch) -> (usize, DVec3) {
        (self.first_slot + 2 * touch.body, self.all[touch.body].rotated * touch.arm)
    }

    /// Visits the first slot, the side and the arm of each touch of a row.
    pub(super) fn visit(&self, touches: [u32; 2], visit: &mut dyn FnMut(usize, f64, DVec3)) {
        for touch in self.of(touches) {
            let (slot, arm) = self.place(touch);
            visit(slot, touch.side, arm);
        }
    }

    /// Takes away what locked axes take up.
    pub(super) fn lock(&self, vector: &mut [Vec3A]) {
        let slots = vector[self.first_slot..].as_chunks_mut::<2>().0;
        for (body, slots) in self.all.iter().zip(slots) {
            slots[0] *= body.freedom.translation.as_vec3a();
            slots[1] *= body.freedom.rotation.as_vec3a();
        }
    }

    /// Returns whether one of the marked bodies has a locked axis.
    pub(crate) fn is_any_locked(&self, marked: &[bool]) -> bool {
        let all = self.all.iter().zip(marked);
        { all }.any(|(body, is_marked)| *is_marked && body.freedom != Freedom::ALL)
    }

    /// Visits the first slot of each body, and its inertia M in N/m.
    pub(super) fn visit_inertia(&self, visit: &mut dyn FnMut(usize, f64)) {
        for (place, body) in self.all.iter().enumerate() {
            visit(self.first_slot + 2 * place, body.weight);
        }
    }

    /// Returns what the bodies of a row yield along its normal, in m/N.
    pub(super) fn compliance(&self, touches: [u32; 2], normal: DVec3) -> f64 {
        let each = self.of(touches).iter();
        let own = each.map(|touch| self.all[touch.body].compliance(self.place(touch).1, normal));
        own.fold(0.0, |sum, own| sum + own)
    }

    /// Returns what the bodies of a row yield to an impulse along its normal, and the speed of its sides apart that has been
    /// [removed](Self::remove) so far.
    pub(super) fn mobility(&self, touches: [u32; 2], normal: DVec3) -> (f64, f64) {
        let (mut mobility, mut removed) = (0.0, 0.0);
        for touch in self.of(touches) {
            let (body, arm) = (&self.all[touch.body], self.place(touch).1);
            mobility += body.mobility(arm, normal);
            let [speed, spin] = body.correction;
            removed += (speed + spin.cross(arm)).dot(normal) * touch.side;
        }
        (mobility, removed)
    }

    /// Takes an impulse from the bodies of a row, in N·s on its first side.
    pub(super) fn remove(&mut self, [first, count]: [u32; 2], impulse: DVec3) {
        for place in first as usize..(first + count) as usize {
            let touch = self.touches[place];
            let (_, arm) = self.place(&touch);
            let body = &mut self.all[touch.body];
            let impulse = impulse * touch.side;
            let spin = body.freedom.inverse_inertia(&body.inertia_now()) * arm.cross(impulse);
            body.correction[0] -= impulse * body.freedom.translation / body.motion.mass;
            body.correction[1] -= spin;
        }
    }

    /// Visits each vertex of cloth that is pinned to a body, with the first slot of that and its present arm.
    pub(super) fn visit_riders(&self, visit: &mut dyn FnMut(usize, usize, DVec3)) {
        for (place, body) in self.all.iter().enumerate() {
            let rotation = DMat3::from_quat(body.motion.end_rotation());
            for (vertex, point) in body.motion.rider_points() {
                visit(vertex, self.first_slot + 2 * place, rotation * point);
            }
        }
    }

    /// Returns which bodies these rows press, by their touches.
    pub(crate) fn are_pressed(&self, pushing: impl Iterator<Item = [u32; 2]>) -> Vec<bool> {
        let mut are_pressed = vec![false; self.all.len()];
        for touches in pushing {
            self.of(touches).iter().for_each(|touch| are_pressed[touch.body] = true);
        }
        are_pressed
    }

    /// Returns the momenta of the bodies that are pressed, over a step of `h` seconds, for a [correction](Self::correct).
    pub(crate) fn balances(&self, h: f64, correction: Correction, are_pressed: &[bool]) -> Vec<Balance> {
        let pressed = self.all.iter().zip(are_pressed).filter(|(_, is_pressed)| **is_pressed);
        pressed.map(|(body, _)| body.balance(h, correction)).collect()
    }

    /// Corrects the bodies that are pressed in a step of `h` seconds: `moved` is the displacement, or velocity, of a place, and
    /// `turn` its rotation, which changes the velocity alone.
    pub(crate) fn correct(
        &mut self,
        h: f64,
        correction: Correction,
        are_pressed: &[bool],
        turn: DVec3,
        moved: &dyn Fn(DVec3) -> DVec3,
        x: &mut [DVec3],
    ) {
        let pressed = self.all.iter_mut().zip(are_pressed).filter(|(_, is_pressed)| **is_pressed);
        for (body, _) in pressed {
            let moved = moved(body.motion.end_centre());
            match correction {
                Correction::Motion => {
                    body.correction[1] += turn / h;
                    body.motion.displacement += moved;
                    body.motion.put(x);
                }
                Correction::Velocity => {
                    body.correction[0] += moved;
                    body.correction[1] += turn;
                }
            }
        }
    }

    /// Returns the mass of all bodies, in kg.
    pub(super) fn mass(&self) -> f64 {
        self.all.iter().map(|body| body.motion.mass).sum()
    }

    /// Returns the squares, in the norm of the inertia, of these moves, and of the way from `guess`.
    pub(super) fn motion(&self, moves: &[Vec3A], guess: &[RigidMotion]) -> [f64; 2] {
        let mut sums = [0.0; 2];
        let moves = moves[self.first_slot..].as_chunks::<2>().0;
        for ((body, moves), guess) in self.all.iter().zip(moves).zip(guess) {
            let [displacement, turn] = moves.map(|own| own.as_dvec3());
            sums[0] += body.norm_squared(displacement, turn);
            sums[1] += body.norm_squared(body.motion.displacement - guess.displacement, body.motion.turn - guess.turn);
        }
        sums
    }

    /// Returns the square, in the norm of the inertia, of the step from the base.
    pub(super) fn squared_step(&self) -> f64 {
        let moved = |body: &RigidBody| body.norm_squared(body.motion.displacement - body.base, body.motion.turn);
        self.all.iter().map(moved).sum()
    }

    /// Returns the square of the longest way of a centre of mass from its base.
    pub(super) fn farthest_squared(&self) -> f64 {
        let each = self
            .all
            .iter()
            .map(|body| (body.motion.displacement - body.base).length_squared());
        each.fold(0.0, f64::max)
    }

    /// Returns the sum of what inertia pulls at the bodies in N, with moments as forces at the radius of gyration.
    pub(super) fn pulls(&self) -> f64 {
        let pull = |body: &RigidBody| {
            let [force, torque] = body.gradient();
            let trace = trace(body.inertia);
            force.length() + torque.length() / (0.5 * trace / body.motion.mass).sqrt()
        };
        self.all.iter().map(pull).fold(0.0, |sum, own| sum + own)
    }
}
