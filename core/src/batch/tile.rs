use super::mask::LANES;
use crate::motion::Motion;
use crate::scalar::Scalar;

/// Sixteen pairs side by side: three coordinates of sixteen pairs, for each of the four points, at the start and at the end.
///
/// A tile takes four times the memory of indices. It pays where pairs are tested more than once, or already lie side by side.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct Tile<S>(pub(super) [[[[S; LANES]; 3]; 2]; 4]);

impl<S: Scalar> Tile<S> {
    /// Makes a tile of sixteen unknown pairs: their coordinates are NaN, so that every test keeps them.
    #[must_use]
    pub fn unknown() -> Self {
        Self([[[[S::INFINITY * S::ZERO; LANES]; 3]; 2]; 4])
    }

    /// Makes a tile of the first sixteen of `pairs`, each given by its four points. If there are fewer, the other lanes are
    /// [`unknown`](Self::unknown).
    ///
    /// ```
    /// use selvedge_core::batch::{culled_from_tiles, Level, Test, Tile};
    /// use selvedge_core::{glam::Vec3, PairKind, Motion, PrimitivePair};
    /// let pairs = [Vec3::ZERO, Vec3::Z].map(|vertex| PrimitivePair::vertex_face(
    ///     Motion::resting(vertex),
    ///     [Vec3::ZERO, Vec3::X, Vec3::Y].map(Motion::resting),
    /// ));
    /// let tile = Tile::new(pairs.map(|pair| pair.motions));
    /// let mut masks = [0];
    /// culled_from_tiles(Level::baseline(), PairKind::VertexFace, Test::SweptBoxes, &[tile], &mut masks);
    /// assert_eq!(masks, [0b10]);
    /// ```
    #[inline]
    pub fn new(pairs: impl IntoIterator<Item = [Motion<S>; 4]>) -> Self {
        let mut tile = Self::unknown();
        for (lane, points) in pairs.into_iter().take(LANES).enumerate() {
            tile.set(lane, points);
        }
        tile
    }

    /// Stores a pair's four points (vertex, face; or first, second edge) in lane `lane`. Does nothing from lane [`LANES`] on.
    #[inline]
    pub fn set(&mut self, lane: usize, points: [Motion<S>; 4]) {
        for (coordinates, motion) in self.0.iter_mut().zip(points) {
            for (coordinates, position) in coordinates.iter_mut().zip(motion.ends()) {
                for (numbers, number) in coordinates.iter_mut().zip(position) {
                    if let Some(place) = numbers.get_mut(lane) {
                        *place = number;
                    }
                }
            }
        }
    }

    /// Returns the four points of a lane; NaN from lane [`LANES`] on.
    #[inline]
    pub(super) fn motions(&self, lane: usize) -> [Motion<S>; 4] {
        let number = |numbers: &[S; LANES]| match numbers.get(lane) {
            Some(&number) => number,
            None => S::INFINITY * S::ZERO,
        };
        let position = |coordinates: &[[S; LANES]; 3]| coordinates.each_ref().map(number).into();
        self.0.each_ref().map(|[start, end]| Motion {
            start: position(start),
            end: position(end),
        })
    }
}
