//! A primitive pair as plain numbers, which prints as the Rust code that makes it.

use super::Format;
use crate::oracle::{Pair, PairKind, points_of_first};
use selvedge_core::kernels::coplanarity::MovingTetrahedron;
use selvedge_core::{Motion, PrimitivePair};
use std::fmt;

/// Four moving points: a vertex and a face's three, or the two ends of one edge and those of the other.
///
/// `{:?}` prints the [`PrimitivePair`] as Rust to paste into a regression test. The printed decimals read back as the same bits.
#[derive(Clone, Copy, PartialEq)]
pub struct PairCase<S> {
    pub kind: PairKind,
    /// The positions of each point at times 0 and 1.
    pub points: [[[S; 3]; 2]; 4],
}

impl<S: Format> PairCase<S> {
    pub const fn new(kind: PairKind, points: [[[S; 3]; 2]; 4]) -> Self {
        Self { kind, points }
    }

    /// Makes a pair from its coordinates, point by point, at the start and at the end.
    pub fn from_coordinates(kind: PairKind, mut coordinate: impl FnMut() -> S) -> Self {
        Self::new(kind, [(); 4].map(|()| [(); 2].map(|()| [(); 3].map(|()| coordinate()))))
    }

    /// Returns the motions of the points, in their order.
    pub fn motions(&self) -> [Motion<S>; 4] {
        self.points.map(|[start, end]| Motion {
            start: start.into(),
            end: end.into(),
        })
    }

    /// Returns the pair in core's form.
    pub fn pair(&self) -> PrimitivePair<S> {
        PrimitivePair::new(self.kind, self.motions())
    }

    /// Returns the points of the first and of the second set.
    pub fn sets(&self) -> [&[[[S; 3]; 2]]; 2] {
        let (first, second) = self.points.split_at(points_of_first(self.kind));
        [first, second]
    }

    /// Returns the differences on which the coplanarity kernels work.
    pub fn tetrahedron(&self) -> MovingTetrahedron<S> {
        (&self.pair()).into()
    }

    /// Returns the pair in the oracle's form.
    pub fn question(&self) -> Pair {
        let at = |end: usize| self.points.map(|point| point[end].map(S::to_f64));
        Pair::new(self.kind, at(0), at(1))
    }

    pub fn is_finite(&self) -> bool {
        self.coordinates().all(S::is_finite)
    }

    /// Returns whether all 24 coordinates are below 1/32 of the largest number, so that no sum of them overflows. Tests that
    /// check a sum for finiteness keep all other pairs.
    pub fn sums_are_finite(&self) -> bool {
        let limit = S::LARGEST * S::exact(1, -5);
        self.coordinates().all(|x| x.abs() < limit)
    }

    pub fn coordinates(&self) -> impl Iterator<Item = S> {
        self.points.into_iter().flatten().flatten()
    }

    /// Returns the pair with its points in another order.
    pub fn reordered(&self, order: [usize; 4]) -> Self {
        Self::new(self.kind, order.map(|point| self.points[point]))
    }

    /// Returns the pair with start and end exchanged.
    pub fn reversed(&self) -> Self {
        Self::new(self.kind, self.points.map(|[start, end]| [end, start]))
    }

    /// Returns the pair with its coordinates in another order.
    pub fn with_axes(&self, axes: [usize; 3]) -> Self {
        self.with_positions(|position| axes.map(|axis| position[axis]))
    }

    /// Returns the pair with each coordinate changed on its own.
    pub fn map(&self, change: impl Fn(S) -> S) -> Self {
        self.with_positions(|position| position.map(&change))
    }

    /// Returns the pair with each of its eight positions changed on its own.
    pub fn with_positions(&self, change: impl Fn([S; 3]) -> [S; 3]) -> Self {
        Self::new(self.kind, self.points.map(|ends| ends.map(&change)))
    }
}

impl PairCase<f32> {
    /// Returns the same numbers as `f64`.
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

/// Writes the number as Rust: the shortest decimal that reads back as the same number.
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
