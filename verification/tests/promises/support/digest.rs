//! Digests of answers to fixed questions, and the pairs that they are about.

use super::prelude::*;
use fnv::FnvHasher;
use selvedge_verification::campaign::{CaseSource, sample};
use std::hash::Hasher;

/// The hash FNV-1a.
#[derive(Default)]
pub(crate) struct Digest(FnvHasher);

impl Digest {
    pub(crate) fn finish(&self) -> u64 {
        self.0.finish()
    }

    pub(crate) fn add(&mut self, answer: u64) {
        self.0.write(&answer.to_le_bytes());
    }

    /// All NaNs are the same, since the machine chooses their bits.
    pub(crate) fn add_number<S: Format>(&mut self, number: S) {
        let number = number.to_f64();
        self.add(if number.is_nan() { 1 } else { number.to_bits() });
    }

    pub(crate) fn add_numbers<S: Format, const N: usize>(&mut self, numbers: [S; N]) {
        for number in numbers {
            self.add_number(number);
        }
    }

    pub(crate) fn add_impact<S: Format>(&mut self, impact: Impact<S>) {
        match impact {
            Impact::Never => self.add(u64::MAX),
            Impact::Possible { time, reason } => {
                self.add(reason as u64);
                self.add_number(time);
            }
        }
    }
}

/// Makes a pair of integers so small that values are often equal, and often zero.
fn on_a_grid<S: Format>(kind: PairKind, index: usize) -> PairCase<S> {
    let mut coordinate = 0;
    let mut next = || {
        coordinate += 1;
        let mut digest = Digest::default();
        digest.add((24 * index + coordinate) as u64);
        S::from_f64((digest.finish() % 5) as f64 - 2.0)
    };
    PairCase::new(kind, [(); 4].map(|()| [(); 2].map(|()| [(); 3].map(|()| next()))))
}

/// Makes random and adversarial pairs. One in sixteen has a coordinate that is not finite or huge. Others are so large or small
/// that products nearly overflow or underflow, or are on a grid.
pub(crate) fn cases<S: Format>(kind: PairKind, count: usize) -> Vec<PairCase<S>> {
    let mut cases = sample(CaseSource::Random, kind, 1, count);
    cases.append(&mut sample(CaseSource::Adversarial, kind, 2, count));
    let odd = [
        S::NAN,
        S::INFINITY,
        -S::INFINITY,
        S::LARGEST,
        -S::LARGEST,
        S::exact(1, S::MIN_EXPONENT),
        S::exact(1, S::MAX_EXPONENT / 3),
        S::exact(1, S::MAX_EXPONENT / 4),
    ];
    for (index, case) in cases.iter_mut().step_by(16).enumerate() {
        let place = index % 24;
        case.points[place / 6][place / 3 % 2][place % 3] = odd[index / 24 % odd.len()];
    }
    let sized = sample(CaseSource::Random, kind, 3, count);
    cases.extend(sized.iter().enumerate().map(|(index, case)| {
        let part = [5, 6, 7, 9, 12, 16][index % 6];
        let exponents = [S::MAX_EXPONENT, S::MIN_EXPONENT];
        let scale = S::exact(1, exponents[index / 6 % 2] / part);
        case.map(|x| x * scale)
    }));
    cases.extend((0..count).map(|index| on_a_grid(kind, index)));
    cases
}
