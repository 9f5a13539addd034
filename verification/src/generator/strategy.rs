//! The generator as a proptest strategy, with shrinking.

use super::Choices;
use proptest::prelude::*;
use proptest::strategy::{NewTree, ValueTree};
use proptest::test_runner::{TestCaseResult, TestError, TestRunner};
use std::fmt;

/// A value that can be made simpler, in a fixed list of attempts.
pub trait Simplify: Clone + fmt::Debug {
    fn attempts(&self) -> usize;

    /// Returns the result of an attempt, by number, or `None` if it is not simpler.
    ///
    /// The order of simplicity must not descend without end.
    fn simpler(&self, attempt: usize) -> Option<Self>;
}

/// A strategy that feeds random bytes to a function. See [`from_choices`].
#[derive(Clone)]
pub struct FromChoices<F>(F);

/// Generates cases with `make`. They shrink by their own [attempts](Simplify).
pub fn from_choices<T: Simplify>(make: impl Fn(&mut Choices<'_>) -> T + Clone) -> impl Strategy<Value = T> + Clone {
    FromChoices(make)
}

impl<F> fmt::Debug for FromChoices<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("FromChoices")
    }
}

impl<T: Simplify, F: Fn(&mut Choices<'_>) -> T> Strategy for FromChoices<F> {
    type Tree = Simplification<T>;
    type Value = T;

    fn new_tree(&self, runner: &mut TestRunner) -> NewTree<Self> {
        let mut bytes = [0; Choices::ENOUGH];
        runner.rng().fill_bytes(&mut bytes);
        Ok(Simplification::new((self.0)(&mut Choices::new(&bytes))))
    }
}

/// A case that is being simplified.
#[derive(Clone, Debug)]
pub struct Simplification<T> {
    current: T,
    /// The case before the last attempt, until it is known whether the attempt fails the test.
    before: Option<T>,
    attempt: usize,
    /// True if this round of attempts has made the case simpler.
    succeeded: bool,
}

impl<T: Simplify> Simplification<T> {
    fn new(case: T) -> Self {
        Self {
            current: case,
            before: None,
            attempt: 0,
            succeeded: false,
        }
    }
}

impl<T: Simplify> ValueTree for Simplification<T> {
    type Value = T;

    fn current(&self) -> T {
        self.current.clone()
    }

    fn simplify(&mut self) -> bool {
        // The last attempt, if there was one, still fails the test.
        if self.before.take().is_some() {
            self.succeeded = true;
        }
        loop {
            if self.attempt >= self.current.attempts() {
                if !self.succeeded {
                    return false;
                }
                (self.attempt, self.succeeded) = (0, false);
            }
            let simpler = self.current.simpler(self.attempt);
            self.attempt += 1;
            if let Some(simpler) = simpler {
                self.before = Some(std::mem::replace(&mut self.current, simpler));
                return true;
            }
        }
    }

    fn complicate(&mut self) -> bool {
        match self.before.take() {
            Some(before) => {
                self.current = before;
                true
            }
            None => false,
        }
    }
}

/// Checks that `property` holds for `cases` cases, or for more in proportion if `PROPTEST_CASES` is more than 256.
///
/// # Panics
/// Panics if the property fails. The message has the simplest failing case that was found, as Rust to paste into a regression
/// test. Seeds are not kept.
pub fn check<T: fmt::Debug>(cases: u32, strategy: impl Strategy<Value = T> + 'static, property: impl Fn(&T) -> TestCaseResult) {
    check_dynamically(cases, &strategy.boxed(), &property);
}

/// This is compiled once for each type of case, not for each property, since proptest's runner takes long to compile.
fn check_dynamically<T: fmt::Debug>(cases: u32, strategy: &BoxedStrategy<T>, property: &dyn Fn(&T) -> TestCaseResult) {
    match TestRunner::new(config(cases)).run(strategy, |case| property(&case)) {
        Ok(()) => {}
        Err(TestError::Fail(reason, case)) => {
            panic!("{reason}\nThe simplest case found:\n{case:?}")
        }
        Err(TestError::Abort(reason)) => panic!("{reason}"),
    }
}

/// Returns the settings of [`check`].
pub fn config(cases: u32) -> ProptestConfig {
    let default = ProptestConfig::default();
    let scaled = u64::from(cases) * u64::from(default.cases) / 256;
    ProptestConfig {
        cases: u32::try_from(scaled.max(1)).unwrap_or(u32::MAX),
        max_shrink_iters: 50_000,
        failure_persistence: None,
        ..default
    }
}
