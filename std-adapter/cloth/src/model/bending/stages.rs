//! The stages of a first-order Runge–Kutta–Chebyshev method (van der Houwen and Sommeijer 1980; Verwer 1996).
//!
//! After s stages a mode of the motion with the eigenvalue −λ (λ = h² times that of M⁻¹Q) is multiplied by R(λ) = Tₛ(w₀ −
//! w₁λ)/Tₛ(w₀), with T Chebyshev's polynomials and w₁ = Tₛ(w₀)/Tₛ′(w₀): then R(0) = 1 and R′(0) = −1. With Tₛ(w₀) = [`DAMPING`],
//! |R| ≤ 1/`DAMPING` wherever
//! |w₀ − w₁λ| ≤ 1, up to λ = (1 + w₀)/w₁, about 0.86·s². With w₀ = cosh θ, Tⱼ(w₀) = cosh jθ.
//!
//! R(λ) = bₛTₛ with bⱼ = 1/Tⱼ(w₀), so that Chebyshev's recursion Tⱼ = 2wTⱼ₋₁ − Tⱼ₋₂ at w = w₀ − w₁λ becomes one of positions: Yⱼ
//! = 2w₀(bⱼ/bⱼ₋₁)Yⱼ₋₁ − (bⱼ/bⱼ₋₂)Yⱼ₋₂ + 2w₁(bⱼ/bⱼ₋₁)·F(Yⱼ₋₁), where F is h²M⁻¹ times the forces there. The first two factors sum
//! to one.

use libm::{acosh, cosh, sinh};

/// The least factor by which a step reduces modes that are too fast for it. Three suffices for stability; five leaves room for
/// rounding and for other constraints.
pub(super) const DAMPING: f64 = 5.0;

#[derive(Clone, Copy, Debug)]
pub(super) struct Stages {
    count: u32,
    w0: f64,
    w1: f64,
}

/// One stage: the factors of the difference of the last two positions, and of the force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stage {
    pub(super) before: f64,
    pub(super) force: f64,
}

impl Stages {
    /// Returns the coefficients of `count` stages, at least one.
    pub(super) fn of(count: u32) -> Self {
        let count = count.max(1);
        let angle = acosh(DAMPING) / f64::from(count);
        Self {
            count,
            w0: cosh(angle),
            w1: DAMPING * sinh(angle) / (f64::from(count) * (DAMPING * DAMPING - 1.0).sqrt()),
        }
    }

    /// Returns the fewest stages for an eigenvalue of h²M⁻¹Q.
    pub(super) fn to_reach(eigenvalue: f64) -> Self {
        // The reach is between 0.85 and 1.2 times the square of the count.
        let mut stages = Self::of((eigenvalue / 1.2).sqrt().min(1e6) as u32);
        while stages.reach() < eigenvalue && stages.count < 1_000_000 {
            stages = Self::of(stages.count + 1);
        }
        stages
    }

    pub(super) const fn count(self) -> u32 {
        self.count
    }

    /// Returns the largest stable eigenvalue of h²M⁻¹Q.
    pub(super) fn reach(self) -> f64 {
        (1.0 + self.w0) / self.w1
    }

    pub(super) fn each(self) -> impl Iterator<Item = Stage> {
        let Self { count, w0, w1 } = self;
        // Tⱼ₋₁ and Tⱼ₋₂ at w₀; T₋₁ = T₁.
        let mut last = [1.0, w0];
        (1..=count).map(move |stage| {
            let [one, two] = last;
            let own = 2.0 * w0 * one - two;
            last = [own, one];
            // The first stage has no predecessor: Y₁ = Y₀ + (w₁/w₀)·F(Y₀).
            if stage == 1 {
                return Stage {
                    before: 0.0,
                    force: w1 / w0,
                };
            }
            Stage {
                before: -two / own,
                force: 2.0 * w1 * one / own,
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn factor(stages: Stages, eigenvalue: f64) -> f64 {
        let [mut before, mut last] = [1.0, 1.0];
        for stage in stages.each() {
            let next = last + (before - last) * stage.before - eigenvalue * last * stage.force;
            (before, last) = (last, next);
        }
        last
    }

    #[test]
    fn slow_waves_feel_the_force_and_fast_ones_are_damped_but_not_turned_over() {
        for count in [1, 2, 3, 7, 32, 200] {
            let stages = Stages::of(count);
            let tiny = 1e-6;
            let found = (1.0 - factor(stages, tiny)) / tiny;
            assert!((found - 1.0).abs() < 1e-5, "{count} stages: {found}");
            for k in 0..=1000 {
                let eigenvalue = stages.reach() * f64::from(k) / 1000.0;
                let found = factor(stages, eigenvalue);
                assert!(
                    (-1.0 / DAMPING - 1e-9..=1.0).contains(&found),
                    "{count} stages, {eigenvalue}: {found}"
                );
            }
        }
    }

    #[test]
    fn there_are_as_few_as_reach() {
        for eigenvalue in [0.0, 1e-9, 1.0, 1.2, 1.3, 8.0, 100.0, 12_345.0] {
            let stages = Stages::to_reach(eigenvalue);
            assert!(stages.reach() >= eigenvalue);
            assert!(
                stages.count == 1 || Stages::of(stages.count - 1).reach() < eigenvalue,
                "{eigenvalue}"
            );
        }
    }
}
