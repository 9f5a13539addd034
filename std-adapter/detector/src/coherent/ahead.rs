//! Chooses the number of steps to look ahead that costs least.
//!
//! A search that looks far ahead is needed seldom. But it finds more pairs, each of which costs something in every step, and more
//! vertices stray. The best number depends on the motion. So now and then the search tries twice as many steps, or half as many,
//! and keeps them if a step then costs less.
//!
//! Costs are counts, not times, so they are the same on every machine and every number of threads.

/// The number of steps before another choice is tried. Trials that are much more frequent cost 2 to 4 % of a step; rarer ones
/// miss changes of the motion.
const PATIENCE: f64 = 32.0;

#[derive(Clone, Copy, Debug)]
pub(super) struct Ahead {
    /// The largest number of steps.
    farthest: u32,
    steps: u32,
    /// The cost since the last choice.
    work: f64,
    /// True if the next trial has more steps, false if fewer.
    tries_more: bool,
    /// The number of steps until the next trial.
    patience: f64,
    /// During a trial, the number of steps before it, and the cost of a step then.
    before: Option<(u32, f64)>,
}

impl Default for Ahead {
    fn default() -> Self {
        Self::new(1)
    }
}

impl Ahead {
    /// Starts with one step.
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

    /// Forgets the past, and starts with half of the largest number of steps.
    pub(super) fn forget(&mut self) {
        *self = Self {
            steps: self.farthest.div_ceil(2),
            ..Self::new(self.farthest)
        };
    }

    pub(super) const fn steps(&self) -> u32 {
        self.steps
    }

    /// Adds a cost, in any unit.
    pub(super) fn spend(&mut self, work: f64) {
        self.work += work;
    }

    pub(super) fn choose(&mut self, lasted: f64) {
        let cost = std::mem::take(&mut self.work) / lasted.max(1.0);
        if 2.0 * lasted < f64::from(self.steps) {
            // Most of the steps ahead were wasted.
            self.steps = (self.steps / 2).max(1);
            self.before = None;
            self.patience = PATIENCE;
            return;
        }
        match self.before.take() {
            // The trial was better, so the next one goes farther in the same direction.
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

    /// Returns the share of horizons of the wanted number of steps, given the cost of a step for each number.
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
