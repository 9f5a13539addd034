//! How many steps to look ahead: what costs least.
//!
//! Far ahead, pairs are looked for seldom, but more are found, and all of them have to be looked at in every step; and more vertices stray. What that
//! costs depends on the motion: on a sheet of 130 thousand triangles that falls two steps take 1.3 times as long as four or eight, and a fifth less than
//! eight while it lands. So now and then twice as many steps are tried, or half as many, and kept if a step costs less than just before.
//!
//! Costs are counts, not times, so that they are the same on every machine and every number of threads.

/// For how many steps a number of them is kept before others are tried. Measured: after eight choices each a sleeve takes 2 to 4 % longer than with
/// the best number, after twenty a sheet that lands takes as long as with one number always, after so many steps neither.
const PATIENCE: f64 = 32.0;

#[derive(Clone, Copy, Debug)]
pub(super) struct Ahead {
    /// At most.
    farthest: u32,
    steps: u32,
    /// What was spent since the last choice.
    work: f64,
    /// Whether more steps are tried next, or fewer.
    tries_more: bool,
    /// After how many steps.
    patience: f64,
    /// If the present number is a trial: the one before, and what a step cost then.
    before: Option<(u32, f64)>,
}

impl Default for Ahead {
    fn default() -> Self {
        Self::new(1)
    }
}

impl Ahead {
    /// One step at first.
    pub(super) fn new(farthest: u32) -> Self {
        Self {
            farthest,
            steps: 1,
            work: 0.0,
            tries_more: true,
            patience: 0.0,
            before: None,
        }
    }

    /// Learns nothing from the past; half as far as it may at first.
    pub(super) fn forget(&mut self) {
        *self = Self {
            steps: self.farthest.div_ceil(2),
            ..Self::new(self.farthest)
        };
    }

    pub(super) const fn steps(&self) -> u32 {
        self.steps
    }

    /// Something was done that costs so much, in any unit.
    pub(super) fn spend(&mut self, work: f64) {
        self.work += work;
    }

    /// Chooses anew, after so many steps of those that were to come.
    pub(super) fn choose(&mut self, lasted: f64) {
        let cost = std::mem::take(&mut self.work) / lasted.max(1.0);
        if 2.0 * lasted < f64::from(self.steps) {
            // Most of the way was for nothing.
            self.steps = (self.steps / 2).max(1);
            self.before = None;
            self.patience = PATIENCE;
            return;
        }
        match self.before.take() {
            // Better than before: perhaps even more so farther on.
            Some((_, cost_before)) if cost < cost_before => {}
            Some((steps_before, _)) => {
                self.steps = steps_before;
                self.tries_more = !self.tries_more;
                self.patience = PATIENCE;
                return;
            }
            None if self.patience > lasted => {
                self.patience -= lasted;
                return;
            }
            None => {}
        }
        let possible = |more: bool| {
            if more {
                2 * self.steps <= self.farthest
            } else {
                self.steps > 1
            }
        };
        if !possible(self.tries_more) {
            self.tries_more = !self.tries_more;
            self.patience = PATIENCE;
            if !possible(self.tries_more) {
                return;
            }
        }
        self.before = Some((self.steps, cost));
        self.steps = if self.tries_more { 2 * self.steps } else { self.steps / 2 };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The share of so many horizons that were of so many steps, where a step costs what is given for that number.
    fn share_of(wanted: u32, horizons: u32, cost: impl Fn(u32) -> f64) -> f64 {
        let mut ahead = Ahead::new(8);
        let mut found = 0;
        for _ in 0..horizons {
            found += u32::from(ahead.steps() == wanted);
            let steps = f64::from(ahead.steps());
            ahead.spend(steps * cost(ahead.steps()));
            ahead.choose(steps);
        }
        f64::from(found) / f64::from(horizons)
    }

    #[test]
    fn the_number_of_steps_that_costs_least_is_found_and_kept() {
        for best in [1_u32, 2, 4, 8] {
            let cost = |steps: u32| 1.0 + (f64::from(steps).log2() - f64::from(best).log2()).abs();
            let share = share_of(best, 200, cost);
            assert!(share > 0.75, "{best}: {share}");
        }
    }

    #[test]
    fn costs_that_grow_all_the_time_do_not_mislead_for_long() {
        let horizon = std::cell::Cell::new(0.0);
        let cost = |steps: u32| {
            horizon.set(horizon.get() + 1.0);
            (1.0 + 0.01 * horizon.get()) * if steps == 2 { 1.0 } else { 1.3 }
        };
        let share = share_of(2, 200, cost);
        assert!(share > 0.7, "{share}");
    }

    #[test]
    fn a_motion_that_ends_early_is_looked_ahead_less_far() {
        let mut ahead = Ahead::new(8);
        ahead.forget();
        assert_eq!(ahead.steps(), 4);
        ahead.choose(1.0);
        assert_eq!(ahead.steps(), 2);
        ahead.choose(0.0);
        assert_eq!(ahead.steps(), 1);
        ahead.choose(0.0);
        assert_eq!(ahead.steps(), 1);
    }
}
