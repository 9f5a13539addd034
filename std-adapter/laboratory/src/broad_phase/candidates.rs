//! Lists of triangles with their boxes, in order of triangle, laid out so that one comparison tests 16.

use super::SweptBox;
use super::buffer::Buffer;

/// Lanes of a block.
pub(super) const LANES: usize = 16;

/// A box as its lower bounds and its negated upper bounds, so that the bounds of a union are minima.
///
/// Never NaN: that becomes negative infinity, which is unbounded.
pub(super) type Bounds = [f32; 6];

/// Bounds of nothing: the neutral element of [`union`].
pub(super) const EMPTY: Bounds = [f32::INFINITY; 6];

pub(super) fn bounds(swept: &SweptBox) -> Bounds {
    let [x, y, z] = swept.lower;
    let [u, v, w] = swept.upper;
    [x, y, z, -u, -v, -w].map(|bound| {
        if bound >= f32::NEG_INFINITY {
            bound
        } else {
            f32::NEG_INFINITY
        }
    })
}

pub(super) fn union(a: &Bounds, b: &Bounds) -> Bounds {
    std::array::from_fn(|k| if a[k] < b[k] { a[k] } else { b[k] })
}

/// The greatest bounds that a box may have to overlap `bounds`: lower bounds up to its upper ones, and
/// the other way round.
pub(super) fn limits(bounds: &Bounds) -> Bounds {
    let [x, y, z, u, v, w] = *bounds;
    [-u, -v, -w, -x, -y, -z]
}

/// Up to 16 triangles.
#[derive(Clone, Copy, Debug)]
struct Block {
    /// `bounds[k][lane]`; NaN, which is within no limits, in lanes that are not used.
    bounds: [[f32; LANES]; 6],
    triangles: [u32; LANES],
}

impl Default for Block {
    /// No triangles.
    fn default() -> Self {
        Self {
            bounds: [[f32::NAN; LANES]; 6],
            triangles: [u32::MAX; LANES],
        }
    }
}

impl Block {
    /// The lanes whose box is within `limits`, as bits.
    #[inline]
    fn within(&self, limits: &Bounds) -> u32 {
        let mut mask = 0;
        for lane in 0..LANES {
            let mut inside = true;
            for (bounds, limit) in self.bounds.iter().zip(limits) {
                inside &= bounds[lane] <= *limit;
            }
            mask |= if inside { 1 << lane } else { 0 };
        }
        mask
    }

    /// The lanes with a triangle after `triangle`, as bits.
    fn after(&self, triangle: u32) -> u32 {
        (0..LANES).fold(0, |mask, lane| mask | u32::from(self.triangles[lane] > triangle) << lane)
    }
}

/// The bits set in `mask`, lowest first.
#[inline]
fn lanes(mut mask: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        (mask != 0).then(|| {
            let lane = mask.trailing_zeros() as usize;
            mask &= mask - 1;
            // The remainder changes nothing but tells the compiler that the lane exists.
            lane % LANES
        })
    })
}

/// Triangles with their boxes, in order of triangle.
#[derive(Debug, Default)]
pub(super) struct CandidateList {
    /// Only the first `len` lanes count.
    blocks: Buffer<Block>,
    len: usize,
}

impl CandidateList {
    /// All triangles.
    pub(super) fn assign(&mut self, boxes: &[SweptBox]) {
        self.blocks.ensure(boxes.len().div_ceil(LANES));
        for ((first, block), boxes) in (0..).step_by(LANES).zip(self.blocks.iter_mut()).zip(boxes.chunks(LANES)) {
            for (lane, swept) in boxes.iter().enumerate() {
                for (row, bound) in block.bounds.iter_mut().zip(bounds(swept)) {
                    row[lane] = bound;
                }
                block.triangles[lane] = first + lane as u32;
            }
        }
        self.end_at(boxes.len());
    }

    /// The triangles of `list` from `first` on whose boxes overlap `bounds`. Returns the number of
    /// blocks tested.
    pub(super) fn assign_overlapping(&mut self, list: &Self, bounds: &Bounds, first: u32) -> u64 {
        let sources = list.blocks_from(first);
        let limits = limits(bounds);
        let mut len = 0;
        for source in sources {
            self.blocks.ensure((len + LANES).div_ceil(LANES));
            for lane in lanes(source.within(&limits)) {
                let target = &mut self.blocks[len / LANES];
                for k in 0..6 {
                    target.bounds[k][len % LANES] = source.bounds[k][lane];
                }
                target.triangles[len % LANES] = source.triangles[lane];
                len += 1;
            }
        }
        self.end_at(len);
        sources.len() as u64
    }

    /// Appends the triangles after `triangle` whose boxes overlap `bounds` to `partners`. Returns the
    /// number of blocks tested.
    pub(super) fn append_overlapping(&self, bounds: &Bounds, triangle: u32, partners: &mut Partners) -> u64 {
        let sources = self.blocks_from(triangle);
        let Some(first) = sources.first() else {
            return 0;
        };
        let limits = limits(bounds);
        let mut after = first.after(triangle);
        let target = partners.room_for(LANES * sources.len());
        let mut len = 0;
        for source in sources {
            for lane in lanes(source.within(&limits) & after) {
                target[len] = source.triangles[lane];
                len += 1;
            }
            after = u32::MAX;
        }
        partners.len += len;
        sources.len() as u64
    }

    /// To be called at the end of a step.
    pub(super) fn settle(&mut self) {
        self.blocks.settle();
    }

    /// The blocks in use, without those that end before `triangle`.
    fn blocks_from(&self, triangle: u32) -> &[Block] {
        let blocks = &self.blocks[..self.len.div_ceil(LANES)];
        let start = blocks.partition_point(|block| block.triangles[LANES - 1] < triangle);
        &blocks[start..]
    }

    /// Makes the list `len` long, and marks the lanes left in the last block as unused.
    fn end_at(&mut self, len: usize) {
        self.len = len;
        if !len.is_multiple_of(LANES) {
            let block = &mut self.blocks[len / LANES];
            block.bounds[0][len % LANES..].fill(f32::NAN);
            block.triangles[len % LANES..].fill(u32::MAX);
        }
    }
}

/// The partners of one triangle after another.
#[derive(Debug, Default)]
pub(super) struct Partners {
    /// Only the first `len` count.
    triangles: Buffer<u32>,
    len: usize,
}

impl Partners {
    pub(super) fn clear(&mut self) {
        self.len = 0;
    }

    /// To be called at the end of a step.
    pub(super) fn settle(&mut self) {
        self.triangles.settle();
    }

    pub(super) fn len(&self) -> usize {
        self.len
    }

    pub(super) fn get(&self, start: usize, len: usize) -> &[u32] {
        &self.triangles[start..start + len]
    }

    fn room_for(&mut self, count: usize) -> &mut [u32] {
        self.triangles.ensure(self.len + count);
        &mut self.triangles[self.len..self.len + count]
    }
}
