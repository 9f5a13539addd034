//! The contacts of a substep, for friction and for recovery.
//!
//! **Recovery is no push.** Two sides that start a substep nearer than their thickness have to come apart, but a push would give
//! them a velocity. So pushes only keep such a contact from getting nearer. A *shift* takes it apart, a displacement that does
//! not enter the velocity. (Guendelman, Bridson and Fedkiw 2003 separate the two in the same way, as split impulses.)
//!
//! The shift s treats contacts as soft. Contact i lacks eᵢ of its thickness along nᵢ, moves its sides apart by pᵢ ≥ 0, and yields
//! as much as its sides do:
//!
//! ```text
//! nᵢ·s + pᵢ = eᵢ  or  pᵢ = 0,      s = Σ W·nᵢ·pᵢ / mobilityᵢ
//! ```
//!
//! So opposed contacts balance: a sheet between two pads is shifted to the middle, and stays there. Then pᵢ exceeds nᵢ·s by the
//! pressure from the other side, and this *squeeze* carries friction. With n contacts in one direction, each comes apart by
//! n/(n + 1) of the missing distance, which would bend a sheet that lies flat. So contacts that are not squeezed then stop
//! yielding, and lack nothing.
//!
//! At the rim of a pad opposed contacts are oblique to each other, and their shifts add up to one that leads out of the gap. Cloth
//! would be shifted out without end, against its own forces or friction, and those would give it a velocity. So a squeezed vertex
//! is shifted only along the line on which its contacts oppose each other.
//!
//! Squeezes are found among contacts with kinematic sides. Layers of cloth that lie on each other can come apart at the open end.
//!
//! Pads that close squeeze a sheet as soon as they touch it. So squeezes are found with the distances that are missing when
//! bodies end the step. A contact that is not squeezed is shifted only by the distance missing at the start. Pushes do the rest,
//! since a moving body does push the cloth.

use selvedge_core::glam::DVec3;
use std::collections::BTreeMap;

/// The share of the shift that is done per second: a twentieth in a millisecond, so that the cloth's own forces can follow.
const RATE: f64 = 50.0;
/// The largest speed of the shift of a vertex, in m/s.
const FASTEST: f64 = 1.0;
/// The number of sweeps over all recoveries. Each halves the imbalance of two opposed contacts.
const SWEEPS: usize = 4;
/// The smallest squeeze, as a share of the contact's missing distance.
const LEAST_SQUEEZE: f64 = 0.01;
/// The smallest missing distance, as a share of the thickness. Less is not visible, and cloth at rest has nothing to recover.
pub(crate) const LEAST_MISSING: f64 = 1e-5;

/// One contact that pushed, for friction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Touch {
    pub(crate) vertices: [u32; 4],
    /// The weight of each vertex in the relative motion. The sum over both sides is zero if both are vertices.
    pub(crate) weights: [f64; 4],
    pub(crate) normal: DVec3,
    /// The [mobility](super::mobility) of its sides; zero if they cannot move.
    pub(crate) mobility: f64,
    /// The distance by which the contact has moved its two sides apart in this substep.
    pub(crate) push: f64,
    /// The motion of the other side in this step, if it is not a vertex.
    pub(crate) drift: DVec3,
    /// The sliding that friction has undone so far in this substep.
    pub(crate) rubbed: DVec3,
}

impl Touch {
    /// Makes a touch of vertices alone, without friction so far.
    pub(crate) const fn new(vertices: [u32; 4], weights: [f64; 4], normal: DVec3, mobility: f64, push: f64) -> Self {
        Self {
            vertices,
            weights,
            normal,
            mobility,
            push,
            drift: DVec3::ZERO,
            rubbed: DVec3::ZERO,
        }
    }
}

/// A contact whose sides start the substep nearer than their thickness.
#[derive(Clone, Copy, Debug)]
struct Recovery {
    touch: Touch,
    /// True if a whole side is kinematic.
    is_on_kinematic: bool,
    /// The missing distance at the start of the step, and at its end in `at_end`.
    missing: f64,
    at_end: f64,
    /// The displacement p that moves the two sides apart.
    apart: f64,
    /// The excess of p over the shift.
    squeeze: f64,
}

/// The contacts of a substep, in order: those that pushed, if friction needs them, and those that are too near.
#[derive(Debug, Default)]
pub struct Touches {
    pub(crate) wanted: bool,
    pub(crate) list: Vec<Touch>,
    /// The largest change of a contact's sliding when friction acted last, in metres.
    pub(crate) rubbed: f64,
    recoveries: Vec<Recovery>,
    /// The shift of each vertex; empty if nothing is too near.
    shift: Vec<DVec3>,
    /// True if the shift has been found.
    is_shifted: bool,
}

impl Touches {
    /// Creates an empty list; `wanted` says whether friction uses it.
    pub(crate) fn new(wanted: bool) -> Self {
        Self {
            wanted,
            ..Self::default()
        }
    }

    pub(crate) fn clear(&mut self) {
        self.list.clear();
        self.rubbed = 0.0;
        self.recoveries.clear();
        self.shift.clear();
        self.is_shifted = false;
    }

    #[inline]
    pub(crate) fn record(&mut self, touch: impl FnOnce() -> Touch) {
        if self.wanted {
            self.list.push(touch());
        }
    }

    /// Records a contact's missing distance at the start of the step, and when bodies end it, unless the shift has been found.
    /// Returns its place among the recorded contacts.
    pub(crate) fn record_missing(
        &mut self,
        touch: Touch,
        [missing, at_end]: [f64; 2],
        thickness: f64,
        inverse_masses: &[f64],
    ) -> Option<u32> {
        if self.is_shifted || !(at_end > LEAST_MISSING * thickness && touch.mobility > 0.0) {
            return None;
        }
        let is_kinematic = |sign: f64| {
            let mut own = touch.vertices.into_iter().zip(touch.weights);
            own.all(|(vertex, weight)| weight * sign <= 0.0 || inverse_masses[vertex as usize] == 0.0)
        };
        self.recoveries.push(Recovery {
            touch,
            is_on_kinematic: is_kinematic(1.0) || is_kinematic(-1.0),
            missing: missing.max(0.0),
            at_end,
            apart: 0.0,
            squeeze: 0.0,
        });
        Some(self.recoveries.len() as u32 - 1)
    }

    /// Returns whether a recorded contact is squeezed.
    pub(crate) fn is_squeezed(&self, place: u32) -> bool {
        self.recoveries
            .get(place as usize)
            .is_some_and(|recovery| recovery.squeeze > 0.0)
    }

    /// Returns the shift of each vertex in this substep; empty if there is none.
    pub(crate) fn shift(&self) -> &[DVec3] {
        &self.shift
    }

    /// Returns the distance by which the shift takes the two sides of a contact apart.
    pub(crate) fn shift_along(&self, vertices: [u32; 4], weights: [f64; 4], normal: DVec3) -> f64 {
        if self.shift.is_empty() {
            return 0.0;
        }
        along(&self.shift, vertices, weights, normal)
    }

    /// Finds the shift of a substep of `h` seconds, and records squeezes.
    pub(crate) fn find_shift(&mut self, inverse_masses: &[f64], h: f64) {
        let Self {
            wanted,
            list,
            recoveries,
            shift,
            is_shifted,
            ..
        } = self;
        *is_shifted = true;
        if recoveries.is_empty() {
            return;
        }
        shift.resize(inverse_masses.len(), DVec3::ZERO);
        for sweep in 0..SWEEPS {
            sweep_over(recoveries, sweep, |recovery| {
                if recovery.is_on_kinematic {
                    recovery.settle(inverse_masses, shift);
                }
            });
        }
        for recovery in &mut *recoveries {
            if recovery.is_on_kinematic {
                let squeeze = recovery.apart - recovery.along(shift);
                // A contact alone has no squeeze, apart from rounding.
                recovery.squeeze = if squeeze > LEAST_SQUEEZE * recovery.at_end {
                    squeeze
                } else {
                    0.0
                };
            }
            if *wanted && recovery.squeeze > 0.0 {
                list.push(Touch {
                    push: recovery.squeeze.min(FASTEST * h),
                    ..recovery.touch
                });
            }
        }
        for sweep in 0..SWEEPS {
            sweep_over(recoveries, sweep, |recovery| recovery.finish(inverse_masses, shift));
        }
        stay_between(recoveries, shift);
        let share = (RATE * h).min(1.0);
        for own in shift {
            *own = (*own * share).clamp_length_max(FASTEST * h);
        }
    }
}

/// Leaves of the shift of squeezed vertices what is along the line of their contacts: the sum of the pushes on the vertex, each
/// with the sign that it has along the largest.
fn stay_between(recoveries: &[Recovery], shift: &mut [DVec3]) {
    let pushes = |recovery: &Recovery| {
        let Recovery { touch, apart, .. } = *recovery;
        let parts = touch.vertices.into_iter().zip(touch.weights);
        parts.map(move |(vertex, weight)| (vertex as usize, touch.normal * (weight * apart)))
    };
    let squeezed = || recoveries.iter().filter(|recovery| recovery.squeeze > 0.0).flat_map(pushes);
    let mut lines: BTreeMap<usize, [DVec3; 2]> = BTreeMap::new();
    for (vertex, push) in squeezed() {
        let [largest, _] = lines.entry(vertex).or_default();
        if push.length_squared() > largest.length_squared() {
            *largest = push;
        }
    }
    for (vertex, push) in squeezed() {
        if let Some([largest, line]) = lines.get_mut(&vertex) {
            *line += push * largest.dot(push).signum();
        }
    }
    for (vertex, [_, line]) in lines {
        shift[vertex] = shift[vertex].project_onto_normalized(line.normalize_or_zero());
    }
}

/// Visits all recoveries, in alternating order from sweep to sweep.
fn sweep_over(recoveries: &mut [Recovery], sweep: usize, visit: impl FnMut(&mut Recovery)) {
    if sweep.is_multiple_of(2) {
        recoveries.iter_mut().for_each(visit);
    } else {
        recoveries.iter_mut().rev().for_each(visit);
    }
}

impl Recovery {
    fn along(&self, shift: &[DVec3]) -> f64 {
        along(shift, self.touch.vertices, self.touch.weights, self.touch.normal)
    }

    /// Moves its sides apart, or together again, until its own equation holds: they move by as much as it yields.
    fn settle(&mut self, inverse_masses: &[f64], shift: &mut [DVec3]) {
        let open = self.at_end - self.along(shift) - self.apart;
        self.push((0.5 * open).max(-self.apart), inverse_masses, shift);
    }

    /// Makes the contact stop yielding, unless it is squeezed.
    fn finish(&mut self, inverse_masses: &[f64], shift: &mut [DVec3]) {
        if self.squeeze == 0.0 {
            let open = self.missing - self.along(shift);
            self.push(open.max(-self.apart), inverse_masses, shift);
        }
    }

    fn push(&mut self, push: f64, inverse_masses: &[f64], shift: &mut [DVec3]) {
        if push == 0.0 {
            return;
        }
        let Touch {
            vertices,
            weights,
            normal,
            mobility,
            ..
        } = self.touch;
        let way = normal * (push / mobility);
        for (vertex, weight) in vertices.into_iter().zip(weights) {
            shift[vertex as usize] += way * (weight * inverse_masses[vertex as usize]);
        }
        self.apart += push;
    }
}

/// Returns n·Σ w·x.
#[inline(always)]
pub(crate) fn along(of_vertices: &[DVec3], vertices: [u32; 4], weights: [f64; 4], normal: DVec3) -> f64 {
    let parts = vertices.into_iter().zip(weights);
    parts.fold(0.0, |sum, (vertex, weight)| {
        sum + weight * normal.dot(of_vertices[vertex as usize])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const VERTEX: [u32; 4] = [0; 4];
    const ALONE: [f64; 4] = [1.0, 0.0, 0.0, 0.0];

    /// Returns the shift of one vertex with these contacts, as a share of what is done per second, and the squeezes.
    fn shifted(contacts: &[(DVec3, f64)]) -> (DVec3, Vec<f64>) {
        let h = 1e-3;
        let mut touches = Touches::new(true);
        for &(normal, missing) in contacts {
            touches.record_missing(Touch::new(VERTEX, ALONE, normal, 2.0, 0.0), [missing; 2], 1e-3, &[2.0]);
        }
        touches.find_shift(&[2.0], h);
        let shift = touches.shift().first().copied().unwrap_or_default();
        (shift / (RATE * h), touches.list.iter().map(|touch| touch.push).collect())
    }

    #[test]
    fn many_contacts_in_one_direction_shift_by_no_more_than_they_miss() {
        let (one, squeezed) = shifted(&[(DVec3::X, 1e-4)]);
        assert!(
            (one - DVec3::X * 1e-4).length() < 1e-12 && squeezed.is_empty(),
            "{one} {squeezed:?}"
        );
        let (ten, squeezed) = shifted(&[(DVec3::X, 1e-4); 10]);
        assert!((ten - one).length() < 1e-9 && squeezed.is_empty(), "{ten} {squeezed:?}");
        assert_eq!(shifted(&[(DVec3::X, 1e-9)]).0, DVec3::ZERO);
    }

    #[test]
    fn opposed_contacts_shift_to_the_middle_whatever_their_direction_and_squeeze() {
        for normal in [DVec3::X, DVec3::new(0.48, 0.6, 0.64)] {
            let (still, squeezed) = shifted(&[(normal, 1e-4), (-normal, 1e-4)]);
            assert!(still.length() < 4e-6 && squeezed.len() == 2, "{still}");
            let (moved, _) = shifted(&[(normal, 2e-4), (-normal, 1e-4)]);
            assert!(moved.dot(normal) > 2e-5 && moved.cross(normal).length() < 1e-12, "{moved}");
        }
    }

    #[test]
    fn oblique_contacts_that_squeeze_shift_along_the_line_between_them_and_not_out_of_the_gap() {
        let [left, right] = [0.96, -0.96].map(|x| DVec3::new(x, 0.0, -0.28));
        for contacts in [[(left, 1e-4), (right, 1e-4)], [(left, 2e-4), (right, 1e-4)]] {
            let (shift, squeezed) = shifted(&contacts);
            assert_eq!(squeezed.len(), 2);
            assert!(shift.z.abs() < 0.02 * contacts[0].1, "{shift}");
        }
        assert!(shifted(&[(left, 1e-4)]).0.z < -2e-5, "one contact alone shifts along itself");
    }
}
