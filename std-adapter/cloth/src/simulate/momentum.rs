//! Conservation of momentum: inner forces neither move nor turn a piece of cloth.
//!
//! A step takes a vertex from x to x′ = x + h·v + D. Here v is the velocity after the forces, and D sums up what the constraints correct. The new
//! velocity is v′ = (x′ − x)/h. Since x′ × (x′ − x) = x × (x′ − x), a piece of vertices with masses m has the angular momentum
//!
//! ```text
//! L′ = Σ m·x′ × v′ = Σ m·x × v + (1/h)·Σ m·x × D
//! ```
//!
//! The first sum is the angular momentum at the start plus h times the moment of the forces. So the corrections change it by
//! their moment about the positions at the **start** of the step, for any solver. Each constraint has no moment about the
//! positions at which it acts, but these differ from x. The remaining moment would turn the cloth.
//!
//! **The projection.** The nearest corrections D + δ, in the metric of the masses, that have neither a sum nor a moment are
//!
//! ```text
//! δ = −a − ω × (x − c),   a = Σ m·D / Σ m,   I·ω = Σ m·(x − c) × D
//! ```
//!
//! with the centre of mass c and the inertia I about it: Lagrange multipliers for Σ m·(D + δ) = 0 and Σ m·(x − c) × (D + δ) = 0. δ moves the whole
//! piece as a rigid body, so that no strain changes but in the second order of ω.
//!
//! **Held pieces.** A pinned vertex p takes up any force but no moment about itself: then c = p and a = 0. Pins on a line take up
//! every moment except the one about that line. Then ω is along it. Other pins take up all moments, and nothing is projected. A
//! vertex that a spring [holds](crate::model::step::Memory::hold) has the larger mass that all constraints see: in that metric,
//! too, inner forces do not change Σ m·D.
//!
//! **A piece** is what edges and [joints](crate::model::step::Constraint::joints) connect, pinned vertices included.

use crate::model::step::TimeStep;
use crate::solve::Prediction;
use crate::solve::prediction::History;
use selvedge_core::glam::{DMat3, DVec3};

/// Pins are on a line if none is farther from it than this share of their extent, which exceeds rounding to single precision.
const STRAIGHT: f64 = 1e-6;
/// The number added to the inertia, as a share of its trace: a straight rope has no inertia and no moment about its own line.
const LEAST_INERTIA: f64 = 1e-12;

/// The pieces of all cloths, and the positions before constraints correct them.
#[derive(Debug, Default)]
pub(super) struct Pieces {
    pieces: Vec<Piece>,
    /// The positions before corrections; empty if pins take up the momentum of every piece.
    before: Vec<DVec3>,
}

/// Vertices that inner forces connect.
#[derive(Clone, Debug, Default)]
struct Piece {
    free: Vec<u32>,
    pinned: Vec<u32>,
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
    /// Connects vertices with these inverse masses by `edges`; a vertex without edges is no piece.
    pub(super) fn new(inverse_masses: &[f64], edges: impl Iterator<Item = [u32; 2]>) -> Self {
        let mut parents: Vec<u32> = (0..inverse_masses.len() as u32).collect();
        for edge in edges {
            let [one, other] = edge.map(|vertex| root(&mut parents, vertex));
            parents[one.max(other) as usize] = one.min(other);
        }
        let mut of_roots = vec![Piece::default(); inverse_masses.len()];
        for (vertex, &inverse_mass) in inverse_masses.iter().enumerate() {
            let piece = &mut of_roots[root(&mut parents, vertex as u32) as usize];
            let list = if inverse_mass > 0.0 {
                &mut piece.free
            } else {
                &mut piece.pinned
            };
            list.push(vertex as u32);
        }
        of_roots.retain(|piece| !piece.free.is_empty() && piece.free.len() + piece.pinned.len() > 1);
        Self {
            pieces: of_roots,
            before: Vec::new(),
        }
    }

    /// The vertices of each piece. A vertex that nothing connects is in none.
    pub(super) fn vertices(&self) -> impl Iterator<Item = impl Iterator<Item = u32> + Clone> {
        let pieces = self.pieces.iter();
        pieces.map(|piece| piece.free.iter().chain(&piece.pinned).copied())
    }

    /// Stores the positions before corrections, unless nothing is projected.
    pub(super) fn begin(&mut self, step: &TimeStep<'_>, positions: &[DVec3]) {
        self.before.clear();
        if self.pieces.iter().any(|piece| piece.hinge(step.start).is_some()) {
            self.before.extend_from_slice(positions);
        }
    }

    /// Removes the sum and the moment of the corrections since [`begin`](Self::begin), except where pins take them up.
    pub(super) fn project(&self, step: &TimeStep<'_>, positions: &mut [DVec3]) {
        let pieces = self.pieces.iter().filter(|_| !self.before.is_empty());
        for piece in pieces {
            piece.project(step, &self.before, positions);
        }
    }
}

/// The motion before a step, and what forces make of it.
pub(super) struct Motion<'a> {
    /// The velocities after forces, and those at the start, in m/s.
    pub(super) forced: &'a [DVec3],
    pub(super) velocities: &'a [DVec3],
    pub(super) history: &'a History,
    pub(super) prediction: &'a Prediction,
}

impl Pieces {
    /// Returns whether pins do not take up the momentum of every piece.
    pub(super) fn may_move(&self, step: &TimeStep<'_>) -> bool {
        self.pieces.iter().any(|piece| piece.hinge(step.start).is_some())
    }

    /// Gives each piece that touches nothing the momentum that forces leave it; all terms are inner forces. If no body presses
    /// (`is_body_near`), the free pieces that press each other keep theirs together.
    pub(super) fn keep_momentum(
        &self,
        step: &TimeStep<'_>,
        motion: &Motion<'_>,
        (is_pressed, is_body_near): (&[bool], bool),
        x: &mut [DVec3],
        velocities: &mut [DVec3],
    ) {
        for piece in self.pieces.iter().filter(|piece| piece.is_free(is_pressed)) {
            piece.keep_momentum(step, motion, x, velocities);
        }
        let pressed = || self.pieces.iter().filter(|piece| !piece.is_free(is_pressed));
        if !is_body_near && pressed().next().is_some() && pressed().all(|piece| piece.pinned.is_empty()) {
            let together = Piece {
                free: pressed().flat_map(|piece| piece.free.iter().copied()).collect(),
                pinned: Vec::new(),
            };
            together.keep_momentum(step, motion, x, velocities);
        }
    }
}

/// The smallest vertex known to be connected with this one. Shortens the path to it.
fn root(parents: &mut [u32], mut vertex: u32) -> u32 {
    while parents[vertex as usize] != vertex {
        let next = parents[parents[vertex as usize] as usize];
        parents[vertex as usize] = next;
        vertex = next;
    }
    vertex
}

impl Piece {
    /// The rotations that pinned vertices allow; `None` if they allow none.
    fn hinge(&self, start: &[DVec3]) -> Option<Hinge> {
        let [first, others @ ..] = &self.pinned[..] else {
            return Some(Hinge::CentreOfMass);
        };
        let first = start[*first as usize];
        let ways = || others.iter().map(|&pin| start[pin as usize] - first);
        let Some(farthest) = ways().max_by(|a, b| a.length_squared().total_cmp(&b.length_squared())) else {
            return Some(Hinge::Point(first));
        };
        let Some(axis) = farthest.try_normalize() else {
            return Some(Hinge::Point(first));
        };
        let allowed = STRAIGHT * farthest.length();
        let is_straight = ways().all(|way| way.cross(axis).length() <= allowed);
        is_straight.then_some(Hinge::Axis(first, axis))
    }

    fn project(&self, step: &TimeStep<'_>, before: &[DVec3], positions: &mut [DVec3]) {
        let Some(hinge) = self.hinge(step.start) else { return };
        let free = || self.free.iter().map(|&vertex| vertex as usize);
        let mass = |vertex: usize| step.inverse_masses[vertex].recip();
        let (mut centre, mut shift) = (DVec3::ZERO, DVec3::ZERO);
        match hinge {
            Hinge::CentreOfMass => {
                let mut total = 0.0;
                for vertex in free() {
                    let mass = mass(vertex);
                    total += mass;
                    centre += step.start[vertex] * mass;
                    shift += (positions[vertex] - before[vertex]) * mass;
                }
                (centre, shift) = (centre / total, shift / total);
            }
            Hinge::Point(point) | Hinge::Axis(point, _) => centre = point,
        }
        let mut moment = DVec3::ZERO;
        // Σ m·q·qᵀ, from which the inertia follows.
        let (mut squares, mut products) = (DVec3::ZERO, DVec3::ZERO);
        for vertex in free() {
            let arm = step.start[vertex] - centre;
            let weighted = arm * mass(vertex);
            moment += weighted.cross(positions[vertex] - before[vertex]);
            squares += weighted * arm;
            products += weighted * DVec3::new(arm.y, arm.z, arm.x);
        }
        let turn = turn(hinge, moment, squares, products);
        if !(turn.is_finite() && shift.is_finite()) {
            return;
        }
        for vertex in free() {
            positions[vertex] -= shift + turn.cross(step.start[vertex] - centre);
        }
    }

    /// Returns whether nothing presses the piece.
    fn is_free(&self, is_pressed: &[bool]) -> bool {
        !self.free.iter().any(|&vertex| is_pressed[vertex as usize])
    }

    /// Gives the piece the momentum that forces leave it, and the angular momentum about its hinge.
    ///
    /// A vertex has v′ = (x′ − b)/r with the base b and the rate r of its [prediction](Prediction), so that x′ × v′ = b × v′. The
    /// equation of motion is m(v′ − w)/r = −g with w = (y − b)/r, and the gradient g of inner forces has no sum. The
    /// angular momentum about a fixed point is L′ = L + h·τ after a step of first order, and L′ = (4L − L₋)/3 + ⅔h·τ after one
    /// of second order: the same formulas as for v′, with the moment τ of forces from outside. A pinned point is at its place at the
    /// end of the step, where its force has no moment about it.
    fn keep_momentum(&self, step: &TimeStep<'_>, motion: &Motion<'_>, x: &mut [DVec3], velocities: &mut [DVec3]) {
        let Some(hinge) = self.hinge(x) else { return };
        let Motion {
            forced,
            velocities: before,
            history,
            prediction: Prediction { goal, masses, base, rate },
        } = motion;
        let (h, start) = (step.h, step.start);
        let free = || self.free.iter().map(|&vertex| vertex as usize);
        let mass = |vertex: usize| step.inverse_masses[vertex].recip();
        // What still air adds to the weight of a vertex.
        let slowing = |vertex: usize| masses[vertex] * rate[vertex] * rate[vertex] * step.inverse_masses[vertex];
        let is_second_order = free().all(|vertex| rate[vertex] < h);
        let mut shift = DVec3::ZERO;
        let centre = match hinge {
            Hinge::CentreOfMass => {
                let (mut total, mut of_rates, mut centre) = (0.0, 0.0, DVec3::ZERO);
                for vertex in free() {
                    let (mass, rate) = (mass(vertex), rate[vertex]);
                    let predicted = (goal[vertex] - base[vertex]) / rate;
                    let weight = slowing(vertex) * mass / rate;
                    shift -= (velocities[vertex] - predicted) * weight;
                    of_rates += weight;
                    centre += base[vertex] * mass;
                    total += mass;
                }
                shift /= of_rates;
                centre / total
            }
            Hinge::Point(point) | Hinge::Axis(point, _) => point,
        };
        let mut moment = DVec3::ZERO;
        // Σ m·q·qᵀ, from which the inertia follows.
        let (mut squares, mut products) = (DVec3::ZERO, DVec3::ZERO);
        for vertex in free() {
            let (mass, arm) = (mass(vertex), base[vertex] - centre);
            let end = x[vertex] - centre;
            let angular = |at: DVec3, velocity: DVec3| (at - centre).cross(velocity * mass);
            let kept = if is_second_order {
                let kept = angular(start[vertex], before[vertex]) * 4.0 - angular(history.positions[vertex], history.velocities[vertex]);
                let forces = (forced[vertex] - before[vertex]) * mass;
                kept / 3.0 + end.cross(forces) * (2.0 / 3.0)
            } else {
                angular(start[vertex], forced[vertex])
            };
            moment += kept / slowing(vertex);
            moment -= arm.cross((velocities[vertex] + shift) * mass);
            let weighted = arm * mass;
            squares += weighted * arm;
            products += weighted * DVec3::new(arm.y, arm.z, arm.x);
        }
        let turn = turn(hinge, moment, squares, products);
        if !(turn.is_finite() && shift.is_finite()) {
            return;
        }
        for vertex in free() {
            let change = shift + turn.cross(base[vertex] - centre);
            velocities[vertex] += change;
            x[vertex] += change * rate[vertex];
        }
    }
}

/// The rotation ω of the projection, from Σ m·q², one for each axis, and Σ m·(xy, yz, zx) of the arms q.
fn turn(hinge: Hinge, moment: DVec3, squares: DVec3, products: DVec3) -> DVec3 {
    let trace = squares.element_sum();
    let diagonal = DVec3::splat(trace * (1.0 + LEAST_INERTIA)) - squares;
    let inertia = DMat3::from_cols(
        DVec3::new(diagonal.x, -products.x, -products.z),
        DVec3::new(-products.x, diagonal.y, -products.y),
        DVec3::new(-products.z, -products.y, diagonal.z),
    );
    match hinge {
        Hinge::Axis(_, axis) => axis * (axis.dot(moment) / axis.dot(inertia * axis)),
        Hinge::CentreOfMass | Hinge::Point(_) => inertia.inverse() * moment,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn vectors(count: usize) -> impl Strategy<Value = Vec<DVec3>> {
        prop::collection::vec(prop::array::uniform3(-1.0..1.0_f64).prop_map(DVec3::from), count)
    }

    /// Projects random corrections, and returns the result, with the vertices and masses.
    fn left(start: &[DVec3], corrections: &[DVec3], inverse_masses: &[f64]) -> Vec<DVec3> {
        let step = TimeStep::first(1e-3, start, inverse_masses);
        let mut pieces = Pieces::new(inverse_masses, (1..start.len() as u32).map(|vertex| [vertex - 1, vertex]));
        pieces.begin(&step, start);
        let moved = start.iter().zip(corrections).zip(inverse_masses);
        let mut positions: Vec<DVec3> = moved.map(|((x, d), &w)| if w > 0.0 { *x + *d } else { *x }).collect();
        pieces.project(&step, &mut positions);
        positions.iter().zip(start).map(|(x, start)| *x - *start).collect()
    }

    proptest! {
        /// Projected corrections have neither sum nor moment, except where pins take them up.
        #[test]
        fn corrections_keep_no_momentum_that_nothing_takes_up(
            start in vectors(6),
            corrections in vectors(6),
            masses in prop::collection::vec(0.1..10.0_f64, 6),
            pins in 0..4_usize,
        ) {
            let mut start = start;
            // Three pins are on a line.
            start[2] = start[0] + (start[1] - start[0]) * 0.3;
            let inverse: Vec<f64> = masses.iter().enumerate().map(|(k, m)| if k < pins { 0.0 } else { 1.0 / m }).collect();
            let left = left(&start, &corrections, &inverse);
            let free = || (pins..6).map(|k| (start[k], left[k], masses[k]));
            let about = start[0];
            let moment: DVec3 = free().map(|(x, d, m)| (x - about).cross(d) * m).sum();
            let sum: DVec3 = free().map(|(_, d, m)| d * m).sum();
            match pins {
                0 => prop_assert!(moment.length() < 1e-8 && sum.length() < 1e-12, "{moment} {sum}"),
                1 => prop_assert!(moment.length() < 1e-8, "{moment}"),
                _ => {
                    let axis = (start[1] - start[0]).normalize();
                    prop_assert!(moment.dot(axis).abs() < 1e-8, "{moment}");
                }
            }
            prop_assert!((0..pins).all(|k| left[k] == DVec3::ZERO));
        }

        #[test]
        fn pins_that_are_not_on_a_line_take_up_everything(start in vectors(6), corrections in vectors(6)) {
            let inverse = [0.0, 0.0, 0.0, 1.0, 2.0, 3.0];
            let left = left(&start, &corrections, &inverse);
            for k in 3..6 {
                prop_assert!((left[k] - corrections[k]).length() < 1e-12);
            }
        }
    }

    #[test]
    fn what_no_edge_connects_is_no_piece_and_a_straight_row_does_not_turn_about_itself() {
        let pieces = Pieces::new(&[1.0; 5], [[0, 1], [3, 4]].into_iter()).pieces;
        assert_eq!(
            pieces.iter().map(|piece| &piece.free[..]).collect::<Vec<_>>(),
            [[0, 1], [3, 4]]
        );
        let row = [0.0, 1.0, 2.0].map(|x| DVec3::X * x);
        let left = left(&row, &[DVec3::Y, DVec3::ZERO, -DVec3::Y], &[1.0; 3]);
        assert!(left.iter().all(|d| d.length() < 1e-9), "{left:?}");
    }
}
