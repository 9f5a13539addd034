//! Pairs that exactly touch, or exactly are coplanar, at a chosen time. They do so by construction, without an oracle.

use super::numbers::{exponent, whole};
use super::strategy::Simplify;
use super::{Choices, Format, PairCase};
use rug::Rational;
use selvedge_core::PairKind;
use std::fmt;
use std::marker::PhantomData;

/// The property of the points at the chosen time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Meeting {
    /// The vertex is in the face, or the edges have a point in common, often at a corner or an end.
    Touching,
    /// The four points are in one plane.
    Coplanar,
}

/// Four points that pass through `target` at the time `numerator / 2^bits`. All numbers are integers, so start and end are
/// integers, too. Scaled by a power of two, they are exact numbers of the format.
#[derive(Clone, PartialEq)]
pub struct MeetingPair<S> {
    pub kind: PairKind,
    numerator: i64,
    bits: u32,
    target: [[i64; 3]; 4],
    velocity: [[i64; 3]; 4],
    offset: [i64; 3],
    exponent: i32,
    format: PhantomData<S>,
}

impl<S: Format> MeetingPair<S> {
    pub fn choose(kind: PairKind, meeting: Meeting, choices: &mut Choices<'_>) -> Self {
        // A target has 4 bits more than `reach`, and a velocity no more than a target. The time adds 3 bits, and the sum 1.
        let reach = S::PRECISION - 10;
        let reach = choices.pick(&[2, 1, 3, 6, 10.min(reach), reach]);
        let bits = choices.pick(&[0, 1, 2, 3]);
        let numerator = i64::from(choices.below((1 << bits) + 1));
        let target = target(kind, meeting, reach, choices);
        let mut moment = Self {
            kind,
            numerator,
            bits,
            target,
            velocity: velocity(reach, choices),
            offset: [0; 3],
            exponent: exponent::<S>(choices),
            format: PhantomData,
        };
        if choices.once_in(4) {
            // Far from the origin it uses all remaining bits.
            let room = (1 << S::PRECISION) - 1 - moment.largest();
            let scale = choices.pick(&[1, 2, 16, 1024]);
            moment.offset = std::array::from_fn(|_| choices.pick(&[0, room, -room, room / 2 + 1]) / scale);
        }
        moment
    }

    /// Returns the time, in [0, 1].
    pub fn time(&self) -> Rational {
        Rational::from(self.numerator) >> self.bits
    }

    pub fn pair(&self) -> PairCase<S> {
        let points = self
            .whole_points()
            .map(|ends| ends.map(|position| position.map(|whole| S::exact(whole, self.exponent))));
        PairCase::new(self.kind, points)
    }

    fn whole_points(&self) -> [[[i64; 3]; 2]; 4] {
        let position = |point: usize, axis: usize, times: i64| {
            (self.target[point][axis] << self.bits) + times * self.velocity[point][axis] + self.offset[axis]
        };
        let (before, after) = (-self.numerator, (1 << self.bits) - self.numerator);
        std::array::from_fn(|point| [before, after].map(|times| std::array::from_fn(|axis| position(point, axis, times))))
    }

    fn largest(&self) -> i64 {
        let all = self.whole_points().into_iter().flatten().flatten();
        all.map(i64::abs).max().unwrap_or(0)
    }
}

/// Returns four positions that touch, or are coplanar, each up to 2^(reach + 4).
fn target(kind: PairKind, meeting: Meeting, reach: u32, choices: &mut Choices<'_>) -> [[i64; 3]; 4] {
    let position = |choices: &mut Choices<'_>| -> [i64; 3] { std::array::from_fn(|_| whole(choices, reach)) };
    let combine = |from: [i64; 3], terms: [(i64, [i64; 3]); 2]| -> [i64; 3] {
        std::array::from_fn(|axis| {
            let sum: i64 = terms.iter().map(|(times, x)| times * x[axis]).sum();
            from[axis] + sum
        })
    };
    let quarters = |x: [i64; 3]| x.map(|x| 4 * x);
    let minus = |x: [i64; 3], y: [i64; 3]| combine(x, [(-1, y), (0, y)]);
    let zero = [0; 3];
    match (kind, meeting) {
        (PairKind::VertexFace, Meeting::Touching) => {
            let [a, b, c] = std::array::from_fn(|_| position(choices));
            let i = i64::from(choices.below(5));
            let j = i64::from(choices.below(5)).min(4 - i);
            let p = combine(quarters(a), [(i, minus(b, a)), (j, minus(c, a))]);
            [p, quarters(a), quarters(b), quarters(c)]
        }
        (PairKind::EdgeEdge, Meeting::Touching) => {
            let common = position(choices);
            let edge = |choices: &mut Choices<'_>| {
                let along = position(choices);
                let (i, j) = (i64::from(choices.below(3)), i64::from(choices.below(3)));
                [
                    combine(common, [(-i, along), (0, zero)]),
                    combine(common, [(j, along), (0, zero)]),
                ]
            };
            let ([u, v], [k, l]) = (edge(choices), edge(choices));
            [u, v, k, l]
        }
        (_, Meeting::Coplanar) => {
            let [a, b, c] = std::array::from_fn(|_| position(choices));
            let (i, j) = (choices.within(2), choices.within(2));
            let d = combine(a, [(i, minus(b, a)), (j, minus(c, a))]);
            [d, a, b, c]
        }
    }
}

/// Returns a displacement for each point: none, a common one, small ones, or any.
fn velocity(reach: u32, choices: &mut Choices<'_>) -> [[i64; 3]; 4] {
    let bits = choices.pick(&[reach, 1, 2]);
    match choices.below(6) {
        0 => {
            let common = std::array::from_fn(|_| whole(choices, bits));
            [common; 4]
        }
        1 => {
            // Three points rest.
            let mut velocity = [[0; 3]; 4];
            let moving = choices.below(4) as usize;
            velocity[moving] = std::array::from_fn(|_| whole(choices, bits));
            velocity
        }
        2 => {
            // All move along one axis.
            let axis = choices.below(3) as usize;
            std::array::from_fn(|_| {
                let mut along = [0; 3];
                along[axis] = whole(choices, bits);
                along
            })
        }
        _ => std::array::from_fn(|_| std::array::from_fn(|_| whole(choices, bits))),
    }
}

impl<S: Format> Simplify for MeetingPair<S> {
    /// Displacements, offset, scale and time do not change the meeting, and neither does dropping an axis.
    fn attempts(&self) -> usize {
        35
    }

    fn simpler(&self, attempt: usize) -> Option<Self> {
        let mut simpler = self.clone();
        match attempt {
            0 => simpler.exponent = 0,
            1 => simpler.offset = [0; 3],
            2 => (simpler.numerator, simpler.bits) = (0, 0),
            3 => (simpler.numerator, simpler.bits) = (1, 0),
            4 => simpler.velocity = [[0; 3]; 4],
            5..8 => {
                let axis = attempt - 5;
                for point in 0..4 {
                    simpler.target[point][axis] = 0;
                    simpler.velocity[point][axis] = 0;
                }
            }
            8..20 => simpler.velocity[(attempt - 8) / 3][(attempt - 8) % 3] = 0,
            20..32 => simpler.velocity[(attempt - 20) / 3][(attempt - 20) % 3] /= 2,
            _ => simpler.offset[attempt - 32] /= 2,
        }
        // Another time or velocity may take a position out of the range of the format.
        let fits = simpler.largest() < 1 << S::PRECISION;
        (fits && simpler.complexity() < self.complexity()).then_some(simpler)
    }
}

impl<S> MeetingPair<S> {
    fn complexity(&self) -> u64 {
        let size = |x: i64| u64::from(64 - x.unsigned_abs().leading_zeros());
        let positions = [self.target, self.velocity];
        let all = positions.iter().flatten().flatten().chain(&self.offset);
        all.map(|&x| size(x)).sum::<u64>() + u64::from(self.exponent != 0) + u64::from(self.bits) + self.numerator.unsigned_abs()
    }
}

impl<S: Format> fmt::Debug for MeetingPair<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "at {}: {:?}", self.time(), self.pair())
    }
}
