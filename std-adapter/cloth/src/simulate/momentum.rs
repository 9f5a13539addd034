//! Conservation of momentum: inner forces neither move nor turn a piece of cloth.
//!
//! The solve ends with a small error, and forces act at other positions than those between which angular momentum is counted. So
//! after a solve each piece moves like a rigid body on top, so that its momentum is what forces from outside leave it
//! ([`Piece::keep_momentum`]). The piece turns as the solve has left it, not as it was before, so that no strain changes: stiff
//! cloth would throw it back.
//!
//! **Held pieces.** A pinned vertex takes up any force but no moment about itself. Pins on a line take up every moment except the
//! one about that line. Then the piece turns about it. Other pins take up all moments. A piece that something presses is left as
//! it is.
//!
//! **What the certificate holds back** loses momentum. If only pieces and free bodies take part, all get it back as velocities.
//!
//! **Free bodies** that press, and are pressed by, free pieces or other free bodies alone keep their momentum together with
//! those, and with pieces that are pinned to them.
//!
//! **A piece** is what edges and [joints](crate::solve::Term::joints) connect, pinned vertices included.

use crate::model::rigid::{outer, trace};
use crate::model::step::TimeStep;
use crate::solve::ContactRow;
use crate::solve::Prediction;
use crate::solve::prediction::MotionHistory;
use crate::solve::rigid::RigidBodies;
use crate::solve::rigid_body::{Balance, Correction, Sums, moments_of_bodies, sums_of_bodies};
use selvedge::Components;
use selvedge_core::glam::{DMat3, DQuat, DVec3};

/// Pins are on a line if none is farther from it than this share of their extent, which exceeds rounding to single precision.
const STRAIGHT: f64 = 1e-6;
/// The number added to the inertia, as a share of its trace: a straight rope has no inertia and no moment about its own line.
const LEAST_INERTIA: f64 = 1e-12;
/// The largest number of turns of a correction; each leaves the square of the last one.
const MOST_TURNS: u32 = 4;
/// A turn that needs no other one, in radians: its square is rounding.
const SMALLEST_TURN: f64 = 1e-8;

/// The pieces of all cloths.
#[derive(Debug, Default)]
pub(super) struct Pieces(Vec<Piece>);

/// Vertices that inner forces connect.
#[derive(Clone, Debug, Default)]
struct Piece {
    free: Vec<u32>,
    /// The vertices that are pinned, and those that are pinned to free bodies.
    pinned: Vec<u32>,
    riders: Vec<u32>,
}

/// The possible rotations of a piece.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Hinge {
    CentreOfMass,
    Point(DVec3),
    /// A point, and a direction of length one.
    Axis(DVec3, DVec3),
}

impl Pieces {
    /// Connects vertices with these inverse masses by `edges`; a vertex without edges is no piece. `rides` says which vertices
    /// are pinned to free bodies.
    pub(super) fn new(inverse_masses: &[f64], rides: impl Fn(usize) -> bool, edges: impl Iterator<Item = [u32; 2]>) -> Self {
        let mut components = Components::new(inverse_masses.len());
        for [one, other] in edges {
            components.join(one, other);
        }
        let mut pieces = vec![Piece::default(); inverse_masses.len()];
        for (vertex, &inverse_mass) in inverse_masses.iter().enumerate() {
            let piece = &mut pieces[components.first(vertex as u32) as usize];
            let list = if inverse_mass > 0.0 {
                &mut piece.free
            } else if rides(vertex) {
                &mut piece.riders
            } else {
                &mut piece.pinned
            };
            list.push(vertex as u32);
        }
        pieces.retain(|piece| !piece.free.is_empty() && piece.vertices().nth(1).is_some());
        Self(pieces)
    }

    /// The vertices of each piece. A vertex that nothing connects is in none.
    pub(super) fn vertices(&self) -> impl Iterator<Item = impl Iterator<Item = u32> + Clone> {
        self.0.iter().map(Piece::vertices)
    }
}

/// The motion before a step, and what forces make of it.
pub(super) struct Motion<'a> {
    /// The velocities after forces, and those at the start, in m/s.
    pub(super) forced: &'a [DVec3],
    pub(super) velocities: &'a [DVec3],
    pub(super) history: &'a MotionHistory,
    pub(super) prediction: &'a Prediction,
}

impl Pieces {
    /// Returns whether pins do not take up the momentum of every piece.
    pub(super) fn may_move(&self, step: &TimeStep<'_>) -> bool {
        self.0.iter().any(|piece| piece.hinge(step.start).is_some())
    }

    /// Gives each piece that touches nothing the momentum that forces leave it; all terms are inner forces. If nothing that is
    /// held presses (`is_held`), the free pieces and the bodies that press each other keep theirs together.
    pub(super) fn keep_momentum(
        &self,
        step: &TimeStep<'_>,
        motion: &Motion<'_>,
        (is_pressed, is_held): (&[bool], bool),
        correction: Correction,
        (x, velocities): (&mut [DVec3], &mut [DVec3]),
        (bodies, are_pressed): (&mut RigidBodies, &[bool]),
    ) {
        for piece in self.0.iter().filter(|piece| piece.is_free(is_pressed)) {
            let none = (&mut RigidBodies::default(), &[][..]);
            piece.keep_momentum(step, motion, correction, (x, velocities), none);
        }
        let pressed = || self.0.iter().filter(|piece| !piece.is_free(is_pressed));
        let is_any = pressed().next().is_some() || are_pressed.contains(&true);
        if !is_held && is_any && pressed().all(|piece| piece.pinned.is_empty()) {
            let together = Piece {
                free: pressed().flat_map(|piece| piece.free.iter().copied()).collect(),
                ..Piece::default()
            };
            together.keep_momentum(step, motion, correction, (x, velocities), (bodies, are_pressed));
        }
    }
}

/// Returns whether a row presses against something that the solve does not move: a body that is not free. The scene has so many
/// vertices of cloth.
pub(super) fn is_held(row: &ContactRow, cloth_vertices: usize) -> bool {
    let sides_of_cloth = || row.parts().any(|(vertex, _)| vertex < cloth_vertices);
    row.push > 0.0
        && row.is_with_body
        && match row.touches[1] {
            0 => true,
            1 => !sides_of_cloth(),
            _ => false,
        }
}

impl Piece {
    /// The rotations that pinned vertices allow; `None` if they allow none.
    fn hinge(&self, start: &[DVec3]) -> Option<Hinge> {
        let [first, others @ ..] = &self.pinned[..] else {
            return Some(Hinge::CentreOfMass);
        };
        let first = start[*first as usize];
        let offsets = || others.iter().map(|&pin| start[pin as usize] - first);
        let Some(farthest) = offsets().max_by(|a, b| a.length_squared().total_cmp(&b.length_squared())) else {
            return Some(Hinge::Point(first));
        };
        let Some(axis) = farthest.try_normalize() else {
            return Some(Hinge::Point(first));
        };
        let allowed = STRAIGHT * farthest.length();
        let is_straight = offsets().all(|offset| offset.cross(axis).length() <= allowed);
        is_straight.then_some(Hinge::Axis(first, axis))
    }

    fn vertices(&self) -> impl Iterator<Item = u32> + Clone {
        let pinned = self.pinned.iter().chain(&self.riders);
        self.free.iter().chain(pinned).copied()
    }

    /// Returns whether nothing presses the piece, and no free body holds it.
    fn is_free(&self, is_pressed: &[bool]) -> bool {
        self.riders.is_empty() && !self.free.iter().any(|&vertex| is_pressed[vertex as usize])
    }

    /// Gives the piece the momentum that forces leave it, and the angular momentum about its hinge.
    ///
    /// A vertex has v′ = (x′ − b)/r with the base b and the rate r of its [prediction](Prediction), so that x′ × v′ = b × v′.
    /// Contacts that started too near also move vertices, and v′ leaves that out. So b is x′ − r·v′ here. If velocities alone are
    /// corrected, x′ stays and takes the place of b. The equation of motion is m(v′ − w)/r = −g with w = (y − b)/r, and the
    /// gradient g of inner forces has no sum. The angular momentum about a fixed point is L′ = L + h·τ after a step of first
    /// order, and L′ = (4L − L₋)/3 + ⅔h·τ after one of second order: the same formulas as for v′, with the moment τ of forces
    /// from outside. A pinned point is at its place at the end of the step, where its force has no moment about it.
    ///
    /// The correction displaces a vertex by s + (exp(φ) − 1)(x′ − c). Its velocity changes by that over r, and its angular
    /// momentum by m/r·(b − c) × (φ × (x′ − c)) in the first order of the turn φ.
    ///
    /// Bodies that are pressed belong to a piece without pins.
    fn keep_momentum(
        &self,
        step: &TimeStep<'_>,
        motion: &Motion<'_>,
        correction: Correction,
        (x, velocities): (&mut [DVec3], &mut [DVec3]),
        (bodies, are_pressed): (&mut RigidBodies, &[bool]),
    ) {
        let Some(hinge) = self.hinge(x) else { return };
        let after = After {
            step,
            motion,
            correction,
        };
        let rounds = match correction {
            Correction::Motion => MOST_TURNS,
            Correction::Velocity => 1,
        };
        for _ in 0..rounds {
            let turned = self.correct(hinge, &after, (&mut *x, &mut *velocities), (bodies, are_pressed));
            if !(turned > SMALLEST_TURN) {
                break;
            }
        }
    }

    /// Makes one correction, which is exact but for the square of its turn. Returns that turn, in radians.
    fn correct(
        &self,
        hinge: Hinge,
        after: &After<'_>,
        (x, velocities): (&mut [DVec3], &mut [DVec3]),
        (bodies, are_pressed): (&mut RigidBodies, &[bool]),
    ) -> f64 {
        let Motion { forced, history, .. } = after.motion;
        let (h, start, before) = (after.step.h, after.step.start, after.motion.velocities);
        let rate = &after.motion.prediction.rate;
        let is_second_order = self.free().all(|vertex| rate[vertex] < h);
        let balances = bodies.balances(h, after.correction, are_pressed);
        let [shift, centre] = match hinge {
            Hinge::CentreOfMass => self.shift(after, &balances, [x, velocities]),
            Hinge::Point(point) | Hinge::Axis(point, _) => [DVec3::ZERO, point],
        };
        let (mut moment, mut arms) = moments_of_bodies(&balances, centre, shift, after.seconds(h));
        for vertex in self.free() {
            let (mass, seconds) = (after.mass(vertex), after.seconds(rate[vertex]));
            let end = x[vertex] - centre;
            let arm = match after.correction {
                Correction::Motion => end - velocities[vertex] * rate[vertex],
                Correction::Velocity => end,
            };
            let angular = |at: DVec3, velocity: DVec3| (at - centre).cross(velocity * mass);
            let kept = if is_second_order {
                let kept =
                    angular(start[vertex], before[vertex]) * 4.0 - angular(history.positions[vertex], history.velocities[vertex]);
                let forces = (forced[vertex] - before[vertex]) * mass;
                kept / 3.0 + end.cross(forces) * (2.0 / 3.0)
            } else {
                angular(start[vertex], forced[vertex])
            };
            moment += kept / after.slowing(vertex);
            moment -= arm.cross((velocities[vertex] + shift / seconds) * mass);
            arms += outer(end * (mass / seconds), arm);
        }
        let turn = turn(hinge, moment, arms);
        if !(turn.is_finite() && shift.is_finite()) {
            return 0.0;
        }
        let moved = |end: DVec3| match after.correction {
            Correction::Motion => shift + (DQuat::from_scaled_axis(turn) * (end - centre) - (end - centre)),
            Correction::Velocity => shift + turn.cross(end - centre),
        };
        for vertex in self.free() {
            let moved = moved(x[vertex]);
            velocities[vertex] += moved / after.seconds(rate[vertex]);
            if after.correction == Correction::Motion {
                x[vertex] += moved;
            }
        }
        bodies.correct(h, after.correction, are_pressed, turn, &moved, x);
        turn.length()
    }

    fn free(&self) -> impl Iterator<Item = usize> {
        self.free.iter().map(|&vertex| vertex as usize)
    }

    /// Returns the displacement that gives the piece and these bodies the momentum that forces leave them, and the point about
    /// which a turn changes no momentum.
    fn shift(&self, after: &After<'_>, bodies: &[Balance], [x, velocities]: [&[DVec3]; 2]) -> [DVec3; 2] {
        let Prediction { goal, base, rate, .. } = after.motion.prediction;
        let h = after.step.h;
        let Sums {
            mut total,
            mut centre,
            mut yields,
            mut added,
        } = sums_of_bodies(bodies, h, after.seconds(h));
        for vertex in self.free() {
            let (mass, rate) = (after.mass(vertex), rate[vertex]);
            let predicted = (goal[vertex] - base[vertex]) / rate;
            let weight = after.slowing(vertex) * mass / rate;
            added += (velocities[vertex] - predicted) * weight;
            yields += weight / after.seconds(rate);
            centre += x[vertex] * (mass / after.seconds(rate));
            total += mass / after.seconds(rate);
        }
        [-added / yields, centre / total]
    }
}

/// A step that has been solved, and the correction that it gets.
struct After<'a> {
    step: &'a TimeStep<'a>,
    motion: &'a Motion<'a>,
    correction: Correction,
}

impl After<'_> {
    fn mass(&self, vertex: usize) -> f64 {
        self.step.inverse_masses[vertex].recip()
    }

    /// Returns the factor by which still air adds to the weight of a vertex.
    fn slowing(&self, vertex: usize) -> f64 {
        let Prediction { masses, rate, .. } = self.motion.prediction;
        masses[vertex] * rate[vertex] * rate[vertex] * self.step.inverse_masses[vertex]
    }

    /// Returns the seconds over which a velocity changes by the displacement of a correction, for a vertex of this rate.
    fn seconds(&self, rate: f64) -> f64 {
        match self.correction {
            Correction::Motion => rate,
            Correction::Velocity => 1.0,
        }
    }
}

/// The turn φ that gives a moment, from Σ m·q·aᵀ of the arms q of displacements φ × q and the arms a of momenta:
/// a × (φ × q) = φ(a·q) − q(a·φ).
fn turn(hinge: Hinge, moment: DVec3, arms: DMat3) -> DVec3 {
    let trace = trace(arms);
    let inertia = DMat3::from_diagonal(DVec3::splat(trace * (1.0 + LEAST_INERTIA))) - arms;
    match hinge {
        Hinge::Axis(_, axis) => axis * (axis.dot(moment) / axis.dot(inertia * axis)),
        Hinge::CentreOfMass | Hinge::Point(_) => inertia.inverse() * moment,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const H: f64 = 1e-2;

    fn vectors(count: usize) -> impl Strategy<Value = Vec<DVec3>> {
        prop::collection::vec(prop::array::uniform3(-1.0..1.0_f64).prop_map(DVec3::from), count)
    }

    /// A step of first order in which a solve has left a row of vertices at random places.
    struct Left {
        start: Vec<DVec3>,
        forced: Vec<DVec3>,
        x: Vec<DVec3>,
        inverse_masses: Vec<f64>,
    }

    impl Left {
        /// Returns the velocities after the correction; `x` is where the solve left the vertices.
        fn corrected(&self) -> Vec<DVec3> {
            let Self {
                start,
                forced,
                x,
                inverse_masses,
            } = self;
            let step = TimeStep::first(H, start, inverse_masses);
            let count = start.len();
            let prediction = Prediction {
                goal: start.iter().zip(forced).map(|(x, v)| *x + *v * H).collect(),
                masses: inverse_masses
                    .iter()
                    .map(|&w| if w > 0.0 { 1.0 / (w * H * H) } else { 0.0 })
                    .collect(),
                base: start.clone(),
                rate: vec![H; count],
            };
            let motion = Motion {
                forced,
                velocities: forced,
                history: &MotionHistory::default(),
                prediction: &prediction,
            };
            let mut x = x.clone();
            let mut velocities = self.velocities();
            let pieces = Pieces::new(
                inverse_masses,
                |_| false,
                (1..count as u32).map(|vertex| [vertex - 1, vertex]),
            );
            let is_pressed = vec![false; count];
            let none = (&mut RigidBodies::default(), &[][..]);
            let pressed = (&is_pressed[..], false);
            pieces.keep_momentum(&step, &motion, pressed, Correction::Motion, (&mut x, &mut velocities), none);
            for (vertex, velocity) in velocities.iter().enumerate() {
                assert!(
                    (start[vertex] + *velocity * H - x[vertex]).length() < 1e-12,
                    "a velocity is that of the move"
                );
            }
            velocities
        }

        fn velocities(&self) -> Vec<DVec3> {
            self.x.iter().zip(&self.start).map(|(x, start)| (*x - *start) / H).collect()
        }
    }

    /// The first `pins` vertices are pinned, on a line.
    fn left(pins: usize, [start, forced, moves]: [Vec<DVec3>; 3], masses: &[f64]) -> Left {
        let mut start = start;
        start[2] = start[0] + (start[1] - start[0]) * 0.3;
        let is_pinned = |k: usize| k < pins;
        let x = (0..6).map(|k| if is_pinned(k) { start[k] } else { start[k] + moves[k] * 0.1 });
        Left {
            x: x.collect(),
            inverse_masses: (0..6).map(|k| if is_pinned(k) { 0.0 } else { 1.0 / masses[k] }).collect(),
            start,
            forced,
        }
    }

    proptest! {
        /// The momentum is what forces from outside leave, except where pins take it up.
        #[test]
        fn inner_forces_give_no_momentum_that_nothing_takes_up(
            vectors in [vectors(6), vectors(6), vectors(6)],
            masses in prop::collection::vec(0.1..10.0_f64, 6),
            pins in 0..4_usize,
        ) {
            let left = left(pins, vectors, &masses);
            let velocities = left.corrected();
            let about = left.start[0];
            let (mut moment, mut sum) = (DVec3::ZERO, DVec3::ZERO);
            for k in pins..6 {
                moment += (left.start[k] - about).cross(velocities[k] * masses[k]);
                moment -= (left.start[k] - about).cross(left.forced[k] * masses[k]);
                sum += (velocities[k] - left.forced[k]) * masses[k];
            }
            match pins {
                0 => prop_assert!(moment.length() < 1e-7 && sum.length() < 1e-9, "{moment} {sum}"),
                1 => prop_assert!(moment.length() < 1e-7, "{moment}"),
                _ => {
                    let axis = (left.start[1] - left.start[0]).normalize();
                    prop_assert!(moment.dot(axis).abs() < 1e-7, "{moment}");
                }
            }
            prop_assert!((0..pins).all(|k| velocities[k] == DVec3::ZERO));
        }

        #[test]
        fn a_correction_turns_and_moves_a_piece_and_stretches_nothing(
            vectors in [vectors(6), vectors(6), vectors(6)],
            masses in prop::collection::vec(0.1..10.0_f64, 6),
            pins in 0..4_usize,
        ) {
            let left = left(pins, vectors, &masses);
            let velocities = left.corrected();
            let ends: Vec<_> = { velocities.iter() }.zip(&left.start).map(|(v, start)| *start + *v * H).collect();
            for (i, j) in (pins..6).flat_map(|i| (pins..i).map(move |j| (i, j))) {
                let [found, expected] = [&ends, &left.x].map(|x| x[i].distance(x[j]));
                prop_assert!((found - expected).abs() < 1e-12, "{found} instead of {expected}");
            }
        }

        #[test]
        fn pins_that_are_not_on_a_line_take_up_everything(
            vectors in [vectors(6), vectors(6), vectors(6)],
            aside in 0.1..1.0_f64,
        ) {
            let mut left = left(3, vectors, &[1.0; 6]);
            let across = (left.start[1] - left.start[0]).any_orthogonal_vector();
            left.start[2] += across * aside;
            left.x[2] = left.start[2];
            prop_assert_eq!(left.corrected(), left.velocities());
        }
    }

    #[test]
    fn what_no_edge_connects_is_no_piece_and_a_straight_row_does_not_turn_about_itself() {
        let Pieces(pieces) = Pieces::new(&[1.0; 5], |_| false, [[0, 1], [3, 4]].into_iter());
        assert_eq!(
            pieces.iter().map(|piece| &piece.free[..]).collect::<Vec<_>>(),
            [[0, 1], [3, 4]]
        );
        let start: Vec<DVec3> = [0.0, 1.0, 2.0].map(|x| DVec3::X * x).into();
        let row = Left {
            x: start.clone(),
            forced: vec![DVec3::Y, DVec3::ZERO, DVec3::Y],
            inverse_masses: vec![1.0; 3],
            start,
        };
        let velocities = row.corrected();
        assert!(
            velocities.iter().all(|v| (*v - DVec3::Y * (2.0 / 3.0)).length() < 1e-9),
            "{velocities:?}"
        );
    }
}
