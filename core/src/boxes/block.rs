//! Sixteen boxes side by side.

use super::Aabb;
use crate::mask::{LANES, Mask, next_lane};

/// Sixteen boxes side by side: one row of sixteen numbers for each coordinate of the lower and the upper corner.
///
/// ```
/// use selvedge_core::boxes::{Aabb, block::BoxBlock};
/// let at = |x: f32| Aabb { lower: [x, 0.0, 0.0], upper: [x, 1.0, 0.0] };
/// let mut block = BoxBlock::empty();
/// for lane in 0..15 {
///     block.set(lane, &at(lane as f32));
/// }
/// assert_eq!(block.within(&at(3.0), 1.0, 0xFFFF), 0b11100);
/// assert_eq!(block.within(&at(15.0), 9.0, 0xFFFF), 0b0111_1111_1100_0000);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct BoxBlock {
    /// The lower corner (x, y, z), then the upper corner.
    rows: [[f32; LANES]; 6],
}

impl BoxBlock {
    /// Returns a block of [empty](Aabb::empty) boxes, which are at no finite distance from any box.
    #[must_use]
    pub const fn empty() -> Self {
        const LOWER: [f32; LANES] = [f32::INFINITY; LANES];
        const UPPER: [f32; LANES] = [f32::NEG_INFINITY; LANES];
        Self {
            rows: [LOWER, LOWER, LOWER, UPPER, UPPER, UPPER],
        }
    }

    /// Stores a box in lane `lane`. It does nothing from lane [`LANES`] on.
    #[inline(always)]
    pub const fn set(&mut self, lane: usize, own: &Aabb<f32>) {
        if lane >= LANES {
            return;
        }
        let [a, b, c, d, e, f] = &mut self.rows;
        [a[lane], b[lane], c[lane]] = own.lower;
        [d[lane], e[lane], f[lane]] = own.upper;
    }

    /// Returns the box in lane `lane`, or an [empty](Aabb::empty) one from lane [`LANES`] on.
    #[inline(always)]
    #[must_use]
    pub fn get(&self, lane: usize) -> Aabb<f32> {
        if lane >= LANES {
            return Aabb::empty();
        }
        let [a, b, c, d, e, f] = &self.rows;
        Aabb {
            lower: [a[lane], b[lane], c[lane]],
            upper: [d[lane], e[lane], f[lane]],
        }
    }

    /// Returns the smallest box that holds all sixteen.
    #[inline]
    #[must_use]
    pub fn merged(&self) -> Aabb<f32> {
        let [a, b, c, d, e, f] = &self.rows;
        let least = |row: &[f32; LANES]| row.iter().fold(f32::INFINITY, |least, &x| if x < least { x } else { least });
        let greatest = |row: &[f32; LANES]| {
            let above = |greatest, &x| if x > greatest { x } else { greatest };
            row.iter().fold(f32::NEG_INFINITY, above)
        };
        Aabb {
            lower: [least(a), least(b), least(c)],
            upper: [greatest(d), greatest(e), greatest(f)],
        }
    }

    /// Returns the lanes `among` these bits whose box comes [within](Aabb::is_within) `distance` of `other`, one lane after the
    /// other. [`Compares::within`](crate::batch::Compares::within) tests sixteen lanes at once.
    #[must_use]
    pub fn within(&self, other: &Aabb<f32>, distance: f32, among: Mask) -> Mask {
        let (mut asked, mut within) = (among, 0);
        while asked != 0 {
            let lane = next_lane(&mut asked);
            within |= Mask::from(self.get(lane).is_within(other, distance)) << lane;
        }
        within
    }

    /// Returns the numbers of all lanes: lower corners, then upper corners.
    #[cfg(not(unoptimised))]
    #[inline(always)]
    pub(crate) const fn rows(&self) -> &[[f32; LANES]; 6] {
        &self.rows
    }
}
