//! A primitive pair as plain numbers, which prints as the Rust that makes it.

use super::Format;
use crate::oracle::{Pair, PairKind};
use selvedge_core::verification::coplanarity::MovingTetrahedron;
use selvedge_core::{Motion, PrimitivePair};
use std::fmt;

/// Four moving points: a vertex and a face's three, or the two ends of one edge and those of the other.
///
/// `{:?}` prints the [`PrimitivePair`] as Rust to paste into a regression test; decimal numbers read back
/// as the same bits.
#[derive(Clone, Copy, PartialEq)]
pub struct PairCase<S> {
    /// What the points are.
    pub kind: PairKind,
    /// Positions at times 0 and 1 of each point.
    pub points: [[[S; 3]; 2]; 4],
}

/// Which of the two sets one of the four points belongs to, 0 or 1.
#[must_use]
pub const fn side_of(kind: PairKind, point: usize) -> usize {
    match kind {
        PairKind::VertexFace => (point > 0) as usize,
        PairKind::EdgeEdge => point / 2,
    }
}

impl<S: Format> PairCase<S> {
    /// From the two positions of each point.
    #[must_use]
    pub const fn new(kind: PairKind, points: [[[S; 3]; 2]; 4]) -> Self {
        Self { kind, points }
    }

    /// The points' motions, in their order.
    #[must_use]
    pub fn motions(&self) -> [Motion<S>; 4] {
        self.points.map(|[start, end]| Motion {
            start: start.into(),
            end: end.into(),
        })
    }

    /// The pair as the tests take it.
    #[must_use]
    pub fn pair(&self) -> PrimitivePair<S> {
        PrimitivePair {
            kind: self.kind,
            motions: self.motions(),
        }
    }

    /// The points of the one set and those of the other.
    #[must_use]
    pub fn sets(&self) -> [&[[[S; 3]; 2]]; 2] {
        let (first, second) = self.points.split_at(match self.kind {
            PairKind::VertexFace => 1,
            PairKind::EdgeEdge => 2,
        });
        [first, second]
    }

    /// The differences that the coplanarity kernels work on.
    #[must_use]
    pub fn tetrahedron(&self) -> MovingTetrahedron<S> {
        (&self.pair()).into()
    }

    /// The same question for the exact oracle.
    #[must_use]
    pub fn question(&self) -> Pair {
        let at = |end: usize| self.points.map(|point| point[end].map(S::to_f64));
        Pair {
            kind: self.kind,
            start: at(0),
            end: at(1),
        }
    }

    /// Neither NaN nor infinite, all 24.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.coordinates().all(S::is_finite)
    }

    /// Whether all 24 are below a 32nd of the largest number there is, so that no sum of them overflows. Tests that ask a
    /// sum whether all is finite keep pairs beyond.
    #[must_use]
    pub fn sums_are_finite(&self) -> bool {
        let limit = S::LARGEST * S::exact(1, -5);
        self.coordinates().all(|x| x.abs() < limit)
    }

    /// Whether some are so small, but not zero, that the gap which tests along nine directions ask for is more than nothing beside them.
    /// Those tests keep pairs that are apart by less, and rounding decides about half a gap.
    #[must_use]
    pub fn has_dust(&self) -> bool {
        let is_dust = |x: S| x != S::ZERO && x.abs() + S::UNDERFLOW / S::UNIT_ROUNDOFF != x.abs();
        self.coordinates().any(is_dust)
    }

    /// All 24.
    pub fn coordinates(&self) -> impl Iterator<Item = S> {
        self.points.into_iter().flatten().flatten()
    }

    /// The points in another order.
    #[must_use]
    pub fn reordered(&self, order: [usize; 4]) -> Self {
        Self::new(self.kind, order.map(|point| self.points[point]))
    }

    /// Start and end exchanged.
    #[must_use]
    pub fn reversed(&self) -> Self {
        Self::new(self.kind, self.points.map(|[start, end]| [end, start]))
    }

    /// The coordinates in another order.
    #[must_use]
    pub fn with_axes(&self, axes: [usize; 3]) -> Self {
        self.with_positions(|position| axes.map(|axis| position[axis]))
    }

    /// Each coordinate changed on its own.
    #[must_use]
    pub fn map(&self, change: impl Fn(S) -> S) -> Self {
        self.with_positions(|position| position.map(&change))
    }

    /// Each of the eight positions changed on its own.
    #[must_use]
    pub fn with_positions(&self, change: impl Fn([S; 3]) -> [S; 3]) -> Self {
        Self::new(self.kind, self.points.map(|ends| ends.map(&change)))
    }
}

impl PairCase<f32> {
    /// The same numbers as `f64`.
    #[must_use]
    pub fn widened(&self) -> PairCase<f64> {
        let points = self.points.map(|ends| ends.map(|position| position.map(f64::from)));
        PairCase::new(self.kind, points)
    }
}

impl<S: Format> fmt::Debug for PairCase<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let motion = |k: usize| {
            let [start, end] = self.points[k].map(|position| {
                let [x, y, z] = position.map(written::<S>);
                format!("[{x}, {y}, {z}]")
            });
            format!("Motion::from(({start}, {end})),")
        };
        let (name, sets): (_, [&[usize]; 2]) = match self.kind {
            PairKind::VertexFace => ("vertex_face", [&[0], &[1, 2, 3]]),
            PairKind::EdgeEdge => ("edge_edge", [&[0, 1], &[2, 3]]),
        };
        writeln!(f, "PrimitivePair::<{}>::{name}(", S::NAME)?;
        for set in sets {
            match set {
                [point] => writeln!(f, "    {}", motion(*point))?,
                points => {
                    writeln!(f, "    [")?;
                    points
                        .iter()
                        .try_for_each(|&point| writeln!(f, "        {}", motion(point)))?;
                    writeln!(f, "    ],")?;
                }
            }
        }
        write!(f, ")")
    }
}

/// As Rust. The shortest decimal that reads back as the same number.
fn written<S: Format>(number: S) -> String {
    if S::is_finite(number) {
        format!("{number:?}")
    } else if number > S::ZERO {
        format!("{}::INFINITY", S::NAME)
    } else if number < S::ZERO {
        format!("{}::NEG_INFINITY", S::NAME)
    } else {
        format!("{}::NAN", S::NAME)
    }
}
