//! The motion for which near pairs were found, and how long they stay valid.
//!
//! A search extends the present motion straight ahead for several steps. Every pair that it does not find keeps more than a
//! distance along some direction on all of that path. As long as each vertex stays within some room of its path along each axis,
//! the pair keeps the rest of that distance ([`near`](super::near)).
//!
//! If few vertices leave that room, as in a crease, only they get a [new path](Horizon::lead_back), and only their pairs are
//! found again.

use super::ahead::Ahead;
use super::parts::Parts;
use selvedge_core::glam::DVec3;
use selvedge_core::separation::course::{expected, has_room, is_certain, joined, room, time_after};

/// The motion to find pairs for.
#[derive(Debug)]
pub(super) struct Expected<'a> {
    /// The start and the end of each vertex. Vertices of far parts rest.
    pub(super) motion: [&'a [DVec3]; 2],
    /// The largest coordinate of vertices of no far part.
    pub(super) largest: f64,
    pub(super) parts: &'a Parts,
}

/// The motion for which near pairs were found.
#[derive(Debug, Default)]
pub(super) struct Horizon {
    /// The start of each vertex. For a new path, the point where it would have started.
    origin: Vec<DVec3>,
    /// The velocity of each vertex.
    drift: Vec<DVec3>,
    /// The end of each vertex.
    far: Vec<DVec3>,
    /// The largest coordinate of `origin` and `far`, without far parts.
    largest: f64,
    /// The duration; zero if there is no motion.
    span: f64,
    /// The time since the start.
    elapsed: f64,
    /// The number of steps in the span.
    pub(super) ahead: Ahead,
    /// The difference between the displacement of each vertex in a step and its displacement in the last one; empty if unknown.
    pub(super) bends: Vec<DVec3>,
    pub(super) parts: Parts,
}

impl Horizon {
    /// Looks at most this number of steps ahead.
    pub(super) fn new(farthest: u32) -> Self {
        Self {
            ahead: Ahead::new(farthest),
            ..Self::default()
        }
    }

    pub(super) fn forget(&mut self) {
        self.span = 0.0;
        self.ahead.forget();
        self.bends.clear();
    }

    /// Begins a motion with the step from `start` to `end` in a time of `h`. Returns the motion to find pairs for.
    ///
    /// It looks as many steps [ahead](Ahead) as cost least. Vertices have to stay within `room` of the motion.
    pub(super) fn begin<'a>(&'a mut self, start: &'a [DVec3], end: &[DVec3], h: f64, room: f64) -> Expected<'a> {
        self.parts.begin([start, end]);
        if self.span > 0.0 {
            let lasted = self.elapsed / self.span * f64::from(self.ahead.steps());
            self.ahead.choose(lasted);
        }
        let steps = f64::from(self.ahead.steps());
        self.elapsed = 0.0;
        self.span = h * steps;
        self.origin.clear();
        self.origin.extend_from_slice(start);
        self.drift.clear();
        self.drift.extend(start.iter().zip(end).map(|(&from, &to)| (to - from) / h));
        let drifts = self.drift.iter_mut().zip(&self.bends);
        drifts.for_each(|(drift, &bend)| *drift += bent(bend, steps, h, room));
        self.parts.far().for_each(|part| self.drift[part].fill(DVec3::ZERO));
        self.far.clear();
        let span = self.span;
        let drifts = start.iter().zip(&self.drift);
        self.far.extend(drifts.map(|(&from, &drift)| expected(from, drift, span)));
        self.largest = self.parts.largest(start).max(self.parts.largest(&self.far));
        if !is_certain(room, self.largest) {
            // Rounding is too coarse to measure strays, so the motion is exactly this step.
            self.span = h;
            self.far.copy_from_slice(end);
        }
        Expected {
            motion: [start, &self.far],
            largest: self.largest,
            parts: &self.parts,
        }
    }

    /// Returns whether the motion lasts for a time of `h` more, and all vertices are then within `room` of it along each axis.
    #[cfg(test)]
    pub(super) fn covers(&self, end: &[DVec3], h: f64, room: f64) -> bool {
        self.lasts(h) && self.find_strayed(end, h, room, &mut Vec::new()) == 0
    }

    /// Returns whether the motion lasts for a time of `h` more.
    pub(super) fn lasts(&self, h: f64) -> bool {
        time_after(self.elapsed, h, self.span).is_some()
    }

    /// Finds the vertices that are not certainly within `room` of the motion, a time of `h` later. Returns their number. These
    /// are all vertices of no far part if the motion has ended.
    pub(super) fn find_strayed(&self, end: &[DVec3], h: f64, room: f64, strayed: &mut Vec<bool>) -> usize {
        strayed.clear();
        match time_after(self.elapsed, h, self.span) {
            Some(time) if is_certain(room, self.largest) => {
                let courses = self.origin.iter().zip(&self.drift).zip(end);
                strayed.extend(courses.map(|((&origin, &drift), &end)| !has_room(end, expected(origin, drift, time), room)));
            }
            _ => strayed.resize(end.len(), true),
        }
        self.parts.correct(strayed);
        strayed.iter().filter(|&&strayed| strayed).count()
    }

    /// Gives strayed vertices a new path for the rest of the motion, in the direction from `start` to `end`. Returns the motion
    /// of all vertices, with new paths extended back to its beginning. Returns `None` if rounding is too coarse for that; the
    /// motion is then over.
    pub(super) fn lead_back(&mut self, strayed: &[bool], [start, end]: [&[DVec3]; 2], h: f64, room: f64) -> Option<Expected<'_>> {
        for vertex in (0..strayed.len()).filter(|&vertex| strayed[vertex]) {
            let mut drift = (end[vertex] - start[vertex]) / h;
            if let Some(&own) = self.bends.get(vertex) {
                drift += bent(own, (self.span - self.elapsed) / h, h, room);
            }
            self.drift[vertex] = drift;
            self.origin[vertex] = joined(start[vertex], drift, self.elapsed);
            self.far[vertex] = expected(start[vertex], drift, self.span - self.elapsed);
        }
        self.largest = self.parts.largest(&self.origin).max(self.parts.largest(&self.far));
        is_certain(room, self.largest).then_some(Expected {
            motion: [&self.origin, &self.far],
            largest: self.largest,
            parts: &self.parts,
        })
    }

    /// Raises the stray of each vertex to that from the motion, a time of `h` later, in the measure of
    /// [`Reach::beyond`](super::interest::Reach::beyond). The stray is infinite where it cannot be measured.
    pub(super) fn find_strays(&self, end: &[DVec3], h: f64, beyond: f64, strays: &mut [f32]) {
        let time = time_after(self.elapsed, h, self.span).unwrap_or(f64::NAN);
        let mut grades = [(f64::NEG_INFINITY, f32::INFINITY); GRADES];
        let mut stray = beyond;
        for grade in &mut grades {
            let room = room(stray, 0.0);
            if is_certain(room, self.largest) {
                // The stray is rounded up, which is safe.
                *grade = (room, stray as f32);
            }
            stray *= 0.5;
        }
        let courses = self.origin.iter().zip(&self.drift).zip(end);
        for (((&origin, &drift), &end), stray) in courses.zip(strays) {
            let expected = expected(origin, drift, time);
            let within = grades.iter().take_while(|(room, _)| has_room(end, expected, *room)).last();
            *stray = stray.max(within.map_or(f32::INFINITY, |&(_, stray)| stray));
        }
    }

    /// Ends a step that took a time of `h`.
    pub(super) fn advance(&mut self, h: f64) {
        self.elapsed += h;
    }
}

/// The number of grades of strays, each half of the one before.
const GRADES: usize = 6;

/// Returns the correction of a drift for a vertex whose path bends in each step.
///
/// The correction is half of the one that leads to the end of the vertex's parabola, since bends do not last. It is limited so
/// that the vertex stays within half of its room in the first step. On a bending sleeve this halves the strays.
fn bent(bend: DVec3, steps: f64, h: f64, room: f64) -> DVec3 {
    let most = 0.5 * room;
    (bend * (0.25 * (steps - 1.0).max(0.0))).clamp(DVec3::splat(-most), DVec3::splat(most)) / h
}

#[cfg(test)]
mod tests {
    use super::*;

    fn looking(steps: u32) -> Horizon {
        let mut horizon = Horizon::new(2 * steps);
        horizon.forget();
        horizon
    }

    #[test]
    fn a_straight_motion_is_covered_to_its_end() {
        let mut horizon = looking(4);
        let at = |step: u32| [DVec3::X * f64::from(step)];
        horizon.begin(&at(0), &at(1), 1.0, 0.1);
        for step in 0..4 {
            assert!(horizon.covers(&at(step + 1), 1.0, 0.1));
            horizon.advance(1.0);
        }
        assert!(!horizon.covers(&at(5), 1.0, 0.1));
    }

    #[test]
    fn a_vertex_that_strays_is_led_back_and_the_others_go_on() {
        let mut horizon = looking(4);
        horizon.begin(&[DVec3::ZERO; 2], &[DVec3::X; 2], 1.0, 0.1);
        horizon.advance(1.0);
        let (start, end) = ([DVec3::X; 2], [DVec3::new(2.0, 0.05, 0.0), DVec3::X]);
        let mut strayed = Vec::new();
        assert_eq!(horizon.find_strayed(&end, 1.0, 0.1, &mut strayed), 1);
        assert_eq!(strayed, [false, true]);
        let [origin, far] = horizon.lead_back(&strayed, [&start, &end], 1.0, 0.1).unwrap().motion;
        assert_eq!(origin, [DVec3::ZERO, DVec3::X]);
        assert_eq!(far, [DVec3::X * 4.0, DVec3::X]);
        assert!(horizon.covers(&end, 1.0, 0.1));
        horizon.advance(1.0);
        assert!(horizon.covers(&[DVec3::X * 3.0, DVec3::X], 1.0, 0.1));
    }

    #[test]
    fn far_from_the_origin_a_motion_lasts_one_step_and_no_vertex_has_room() {
        let mut horizon = looking(4);
        let (start, end) = ([DVec3::X * 1e12], [DVec3::X * 1e12 + DVec3::Y]);
        assert_eq!(horizon.begin(&start, &end, 1.0, 0.1).motion, [&start[..], &end[..]]);
        assert!(horizon.lasts(1.0) && !horizon.covers(&end, 1.0, 0.1));
        horizon.advance(1.0);
        assert!(!horizon.lasts(1.0));
    }

    #[test]
    fn a_vertex_that_strays_ends_it() {
        let mut horizon = looking(4);
        horizon.begin(&[DVec3::ZERO], &[DVec3::X], 1.0, 0.1);
        horizon.advance(1.0);
        assert!(horizon.covers(&[DVec3::new(2.0, 0.09, 0.0)], 1.0, 0.1));
        assert!(!horizon.covers(&[DVec3::new(2.0, 0.11, 0.0)], 1.0, 0.1));
        assert!(!horizon.covers(&[DVec3::new(f64::NAN, 0.0, 0.0)], 1.0, 0.1));
    }
}
