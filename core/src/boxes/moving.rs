//! Moving boxes: a set's box at the start of the step, and its box at the end.
//!
//! Two sets whose boxes are apart along one axis, *in the same order* at both ends of the step, are apart throughout. Reason:
//! each coordinate moves linearly. This is the test of [relative boxes](super::relative) for sets of any number of points, and so
//! for the nodes of a hierarchy. It culls every pair that the overlap of swept boxes culls, and more, since it uses that the two
//! move together. It is **exact**, since it only compares.
//!
//! [`MovingBox`] is one box; [`MovingBlock`] is sixteen of them side by side.
//!
//! # Boxes in fewer digits
//! A block holds `f32`. Any monotone function may map coordinates of more digits; rounding is monotone in any direction. What is
//! strictly ordered after the mapping was so before. So nothing has to be rounded outwards, and no touching pair is culled. Pairs
//! that are apart by less than the mapping shows are kept.

use super::Aabb;
use super::block::BoxBlock;
#[cfg(not(unoptimised))]
use crate::mask::LANES;
use crate::mask::{Mask, next_lane};
use crate::motion::Motion;
use crate::scalar::Scalar;

/// The box of a set at the start of the step and at its end.
///
/// ```
/// use selvedge_core::boxes::moving::MovingBox;
/// // A point that follows another one at a distance, over ten times that distance.
/// let first = MovingBox::<f64>::from_motion(&([0.0, 0.0, 0.0], [10.0, 0.0, 0.0]).into());
/// let second = MovingBox::from_motion(&([1.0, 0.0, 0.0], [11.0, 0.0, 0.0]).into());
/// assert!(first.is_apart_from(&second));
/// assert!(first.swept().overlaps(&second.swept()));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MovingBox<S> {
    /// The box at time 0.
    pub start: Aabb<S>,
    /// The box at time 1.
    pub end: Aabb<S>,
}

impl<S: Scalar> MovingBox<S> {
    /// Returns the box of no points, which is apart from every bounded box. [`merged`](Self::merged) with another box, it gives
    /// that box.
    #[must_use]
    pub fn empty() -> Self {
        Self {
            start: Aabb::empty(),
            end: Aabb::empty(),
        }
    }

    /// Returns the box of one moving point. It is unbounded, and so apart from nothing, if a coordinate is NaN or infinite.
    #[inline]
    #[must_use]
    pub fn from_motion(motion: &Motion<S>) -> Self {
        if !motion.is_finite() {
            return Self {
                start: Aabb::everything(),
                end: Aabb::everything(),
            };
        }
        let [start, end] = motion.ends().map(|position| Aabb {
            lower: position,
            upper: position,
        });
        Self { start, end }
    }

    /// Returns the smallest moving box that holds both.
    #[inline]
    #[must_use]
    pub fn merged(&self, other: &Self) -> Self {
        let mut both = *self;
        both.merge(other);
        both
    }

    /// Grows to the smallest moving box that holds both.
    #[inline]
    pub fn merge(&mut self, other: &Self) {
        self.start.merge(&other.start);
        self.end.merge(&other.end);
    }

    /// Returns the box that holds the set throughout the step.
    #[inline]
    #[must_use]
    pub fn swept(&self) -> Aabb<S> {
        self.start.merged(&self.end)
    }

    /// Returns whether all of one set stays above all of the other along one axis throughout the step. This is exact.
    #[inline]
    #[must_use]
    pub fn is_apart_from(&self, other: &Self) -> bool {
        let mut apart = false;
        for axis in 0..3 {
            apart |= (self.start.lower[axis] > other.start.upper[axis]) & (self.end.lower[axis] > other.end.upper[axis]);
            apart |= (other.start.lower[axis] > self.start.upper[axis]) & (other.end.lower[axis] > self.end.upper[axis]);
        }
        apart
    }
}

impl MovingBox<f32> {
    /// Returns the box with each side moved inwards by `by`, rounded. The result may be inside out.
    /// [`Inset`](super::mapping::Inset) says what it proves.
    #[inline(always)]
    #[must_use]
    pub fn drawn_in(&self, by: f32) -> Self {
        let ([a, b, c], [d, e, f]) = (self.start.lower, self.start.upper);
        let ([g, h, i], [j, k, l]) = (self.end.lower, self.end.upper);
        Self {
            start: Aabb {
                lower: [a + by, b + by, c + by],
                upper: [d - by, e - by, f - by],
            },
            end: Aabb {
                lower: [g + by, h + by, i + by],
                upper: [j - by, k - by, l - by],
            },
        }
    }
}

/// Sixteen moving boxes side by side: their boxes at the start, and at the end.
///
/// ```
/// use selvedge_core::{batch::Level, boxes::moving::{MovingBlock, MovingBox}};
/// let point = |x: f32| MovingBox::from_motion(&([x, 0.0, 0.0], [x, 1.0, 0.0]).into());
/// let mut block = MovingBlock::empty();
/// for lane in 0..16 {
///     block.set(lane, &point(lane as f32));
/// }
/// assert_eq!(block.near(&point(3.0), 0xFFFF), 0b1000);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MovingBlock {
    start: BoxBlock,
    end: BoxBlock,
}

impl MovingBlock {
    /// Returns a block of [empty](MovingBox::empty) boxes.
    #[must_use]
    pub const fn empty() -> Self {
        Self {
            start: BoxBlock::empty(),
            end: BoxBlock::empty(),
        }
    }

    /// Stores a box in lane `lane`. It does nothing from lane [`LANES`](crate::batch::LANES) on.
    #[inline]
    pub const fn set(&mut self, lane: usize, moving: &MovingBox<f32>) {
        self.start.set(lane, &moving.start);
        self.end.set(lane, &moving.end);
    }

    /// Returns the box in lane `lane`, or an [empty](MovingBox::empty) one from lane [`LANES`](crate::batch::LANES) on.
    #[inline(always)]
    #[must_use]
    pub fn get(&self, lane: usize) -> MovingBox<f32> {
        MovingBox {
            start: self.start.get(lane),
            end: self.end.get(lane),
        }
    }

    /// Returns the smallest moving box that holds all sixteen.
    #[inline]
    #[must_use]
    pub fn merged(&self) -> MovingBox<f32> {
        MovingBox {
            start: self.start.merged(),
            end: self.end.merged(),
        }
    }

    /// Returns the lanes `among` these bits whose box is not [apart from](MovingBox::is_apart_from) `other`, one lane after the
    /// other. [`Compares::near`](crate::batch::Compares::near) tests sixteen lanes at once.
    #[must_use]
    pub fn near(&self, other: &MovingBox<f32>, among: Mask) -> Mask {
        let (mut asked, mut near) = (among, 0);
        while asked != 0 {
            let lane = next_lane(&mut asked);
            near |= Mask::from(!self.get(lane).is_apart_from(other)) << lane;
        }
        near
    }

    /// Returns the numbers of all lanes at the start, and at the end.
    #[cfg(not(unoptimised))]
    #[inline(always)]
    pub(crate) const fn rows(&self) -> (&[[f32; LANES]; 6], &[[f32; LANES]; 6]) {
        (self.start.rows(), self.end.rows())
    }
}
