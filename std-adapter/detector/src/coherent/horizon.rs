//! For how long candidates stay good.
//!
//! Candidates are found for a motion straight on from the present one, several steps ahead: whatever is no candidate keeps more
//! than a distance along some direction, on all of that way. As long as every vertex stays within some room of it along each axis, a
//! pair that is no candidate keeps the rest of that distance ([`near`](super::near)).
//!
//! Where few vertices leave that room, as in a crease, they alone get a [new way](Horizon::lead_back) for the rest of the time, and
//! candidates are looked for with what they belong to.

use super::ahead::Ahead;
use selvedge_core::glam::DVec3;
use selvedge_core::separation::course::{expected, has_room, is_certain, joined, room, time_after};
use selvedge_core::separation::largest_coordinate;

/// The motion that candidates were found for.
#[derive(Debug, Default)]
pub(super) struct Horizon {
    /// Where the motion began; of a vertex with a new way, where that would have.
    origin: Vec<DVec3>,
    /// In metres a second.
    drift: Vec<DVec3>,
    /// The end of the motion.
    far: Vec<DVec3>,
    /// Of `origin` and `far`.
    largest: f64,
    /// In seconds; zero if there is no motion.
    span: f64,
    /// Since it began, in seconds.
    elapsed: f64,
    /// How many steps the span is meant to last.
    pub(super) ahead: Ahead,
    /// By how much the way of each vertex in a step differs from that in the step before; empty if nobody has told.
    pub(super) bends: Vec<DVec3>,
}

impl Horizon {
    /// Looks no more than so many steps ahead.
    pub(super) fn new(farthest: u32) -> Self {
        Self {
            ahead: Ahead::new(farthest),
            ..Self::default()
        }
    }

    /// Begins anew, and learns nothing from the past: looks half as far ahead as it may.
    pub(super) fn forget(&mut self) {
        self.span = 0.0;
        self.ahead.forget();
        self.bends.clear();
    }

    /// Begins with the step from `start` to `end` in `h` seconds. Returns the motion to find candidates for.
    ///
    /// Looks as many steps [ahead](Ahead) as cost least. Vertices are to stay within `room` of it.
    pub(super) fn begin<'a>(&'a mut self, start: &'a [DVec3], end: &[DVec3], h: f64, room: f64) -> [&'a [DVec3]; 2] {
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
        let ways = self.drift.iter_mut().zip(&self.bends);
        ways.for_each(|(drift, &own)| *drift += bent(own, steps, h, room));
        self.far.clear();
        let span = self.span;
        let ways = start.iter().zip(&self.drift);
        self.far.extend(ways.map(|(&from, &drift)| expected(from, drift, span)));
        self.largest = largest_coordinate(start).max(largest_coordinate(&self.far));
        if !is_certain(room, self.largest) {
            // Rounding is too coarse to tell who strays: for this step only, and exactly for it.
            self.span = h;
            self.far.copy_from_slice(end);
        }
        [start, &self.far]
    }

    /// Whether, `h` seconds on, all vertices are within `room` of the motion along each axis, and it has not ended.
    #[cfg(test)]
    pub(super) fn covers(&self, end: &[DVec3], h: f64, room: f64) -> bool {
        self.lasts(h) && self.find_strayed(end, h, room, &mut Vec::new()) == 0
    }

    /// Whether the motion lasts for another `h` seconds.
    pub(super) fn lasts(&self, h: f64) -> bool {
        time_after(self.elapsed, h, self.span).is_some()
    }

    /// Sets in `strayed` which vertices are not certainly within `room` of the motion, `h` seconds on; returns how many. All, if the
    /// motion has ended.
    pub(super) fn find_strayed(&self, end: &[DVec3], h: f64, room: f64, strayed: &mut Vec<bool>) -> usize {
        strayed.clear();
        match time_after(self.elapsed, h, self.span) {
            Some(time) if is_certain(room, self.largest) => {
                let courses = self.origin.iter().zip(&self.drift).zip(end);
                strayed.extend(courses.map(|((&origin, &drift), &end)| !has_room(end, expected(origin, drift, time), room)));
            }
            _ => strayed.resize(end.len(), true),
        }
        strayed.iter().filter(|&&strayed| strayed).count()
    }

    /// Gives the vertices that have strayed the way from `start` to `end`, on which they are now, for the rest of the motion. Returns
    /// the motion that all vertices have now, as if the new ways had been theirs from its beginning: that of the others stays. `None` if
    /// rounding is too coarse for that; then the motion is over.
    pub(super) fn lead_back(
        &mut self,
        strayed: &[bool],
        [start, end]: [&[DVec3]; 2],
        h: f64,
        room: f64,
    ) -> Option<[&[DVec3]; 2]> {
        for vertex in (0..strayed.len()).filter(|&vertex| strayed[vertex]) {
            let mut drift = (end[vertex] - start[vertex]) / h;
            if let Some(&own) = self.bends.get(vertex) {
                drift += bent(own, (self.span - self.elapsed) / h, h, room);
            }
            self.drift[vertex] = drift;
            self.origin[vertex] = joined(start[vertex], drift, self.elapsed);
            self.far[vertex] = expected(start[vertex], drift, self.span - self.elapsed);
        }
        self.largest = largest_coordinate(&self.origin).max(largest_coordinate(&self.far));
        is_certain(room, self.largest).then_some([&self.origin, &self.far])
    }

    /// Sets how far each vertex strays from the motion, `h` seconds on, as [`Reach::beyond`](super::Reach::beyond) has it: no less than was
    /// set before, and infinite if that cannot be told.
    pub(super) fn find_strays(&self, end: &[DVec3], h: f64, beyond: f64, strays: &mut [f32]) {
        let time = time_after(self.elapsed, h, self.span).unwrap_or(f64::NAN);
        let mut grades = [(f64::NEG_INFINITY, f32::INFINITY); GRADES];
        let mut stray = beyond;
        for grade in &mut grades {
            let room = room(stray, 0.0);
            if is_certain(room, self.largest) {
                // A little more than it is: what takes it for the stray allows for more.
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

    /// A step of `h` seconds was made.
    pub(super) fn advance(&mut self, h: f64) {
        self.elapsed += h;
    }
}

/// How many grades of strays there are: each half of the one before.
const GRADES: usize = 6;

/// What to add to a drift that is to last for so many steps of `h` seconds, of a vertex whose way bends by so much a step: half of what
/// leads to the end of its parabola, as bends do not last, and so little that it stays within half of its room in the first step. Measured
/// on the arm sleeve: vertices stray half as far in eight steps; on a sheet that drops on a ball, as far as without it.
fn bent(bend: DVec3, steps: f64, h: f64, room: f64) -> DVec3 {
    let most = 0.5 * room;
    (bend * (0.25 * (steps - 1.0).max(0.0))).clamp(DVec3::splat(-most), DVec3::splat(most)) / h
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One that looks so many steps ahead.
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
        let [origin, far] = horizon.lead_back(&strayed, [&start, &end], 1.0, 0.1).unwrap();
        assert_eq!(origin, [DVec3::ZERO, DVec3::X]);
        assert_eq!(far, [DVec3::X * 4.0, DVec3::X]);
        assert!(horizon.covers(&end, 1.0, 0.1));
        horizon.advance(1.0);
        assert!(horizon.covers(&[DVec3::X * 3.0, DVec3::X], 1.0, 0.1));
    }

    #[test]
    fn far_from_the_origin_for_its_room_a_motion_is_one_step_and_nobody_has_room() {
        let mut horizon = looking(4);
        let (start, end) = ([DVec3::X * 1e12], [DVec3::X * 1e12 + DVec3::Y]);
        assert_eq!(horizon.begin(&start, &end, 1.0, 0.1), [&start[..], &end[..]]);
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
