//! Pairs of which one set slides along the other.

use super::numbers::fraction;
use super::{Choices, Format, PairCase};
use selvedge_core::PairKind;

/// The number of binary digits after the point in most coordinates.
const EIGHTHS: i32 = 3;

impl<S: Format> PairCase<S> {
    /// Chooses a pair of about unit size. A point of one set begins and ends its way beside a corner, a side or the face of the
    /// other. The distance is between 2⁻¹⁰ and 2⁻²⁶. In some pairs a second point does so too.
    pub fn choose_sliding(kind: PairKind, choices: &mut Choices<'_>) -> Self {
        let distance = choices.pick(&[10, 12, 14, 17, 20, 23, 26]);
        let mut points = [[[S::ZERO; 3]; 2]; 4];
        for coordinate in points.as_flattened_mut().as_flattened_mut() {
            *coordinate = S::exact(choices.within(8), -EIGHTHS);
        }
        if choices.once_in(4) {
            // The way is short.
            for [start, end] in &mut points {
                *end = std::array::from_fn(|axis| start[axis] + S::exact(1, -4) * (end[axis] - start[axis]));
            }
        }
        let distance = S::exact(1, -distance);
        let (target, along) = match kind {
            PairKind::VertexFace => ([1, 2, 3], choices.below(8)),
            PairKind::EdgeEdge => ([2, 3, 3], choices.below(6)),
        };
        let place = |choices: &mut Choices<'_>| -> [S; 3] {
            let [a, b] = [fraction::<S>(choices).abs(), fraction::<S>(choices).abs()];
            match along {
                0..=2 => [S::ONE, S::ZERO, S::ZERO],
                3..=5 => [S::ONE - a, a, S::ZERO],
                _ => [S::ONE - a, a * (S::ONE - b), a * b],
            }
        };
        let movers: &[usize] = match kind {
            PairKind::EdgeEdge if choices.once_in(4) => &[1, 0],
            PairKind::EdgeEdge => &[1],
            PairKind::VertexFace => &[0],
        };
        for (index, &mover) in movers.iter().enumerate() {
            let mut weights = place(choices);
            if index > 0 {
                // The other end lies beside the other corner.
                weights.swap(0, 1);
            }
            let moves_along = choices.once_in(2);
            for end in 0..2 {
                if end > 0 && moves_along && along > 2 {
                    weights = place(choices);
                }
                points[mover][end] = std::array::from_fn(|axis| {
                    let sum = (0..3).fold(S::ZERO, |sum, k| sum + weights[k] * points[target[k]][end][axis]);
                    sum + distance * fraction::<S>(choices)
                });
            }
        }
        if kind == PairKind::VertexFace && choices.once_in(4) {
            // A second corner of the face is near as well.
            for end in 0..2 {
                points[2][end] = points[0][end].map(|x| x + S::exact(8, 0) * distance * fraction::<S>(choices));
            }
        }
        Self::new(kind, points)
    }
}
