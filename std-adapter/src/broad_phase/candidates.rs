//! Lists of triangles with their boxes, in order of triangle, laid out so that one comparison tests 16.

use super::SweptBox;

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
#[derive(Clone, Debug)]
pub(super) struct Block {
    /// `bounds[k][lane]`; NaN, which is within no limits, in lanes that are not used.
    bounds: [[f32; LANES]; 6],
    triangles: [u32; LANES],
}

impl Block {
    const UNUSED: Self = Self {
        bounds: [[f32::NAN; LANES]; 6],
        triangles: [u32::MAX; LANES],
    };

    /// The lanes whose box is within `limits`, as bits.
    #[inline]
    fn within(&self, limits: &Bounds) -> u32 {
        const BIT: [u32; LANES] = {
            let mut bits = [0; LANES];
            let mut lane = 0;
            while lane < LANES {
                bits[lane] = 1 << lane;
                lane += 1;
            }
            bits
        };
        let mut mask = 0;
        for lane in 0..LANES {
            let mut inside = true;
            for k in 0..6 {
                inside &= self.bounds[k][lane] <= limits[k];
            }
            mask |= if inside { BIT[lane] } else { 0 };
        }
        mask
    }
}

/// Triangles with their boxes, in order of triangle.
#[derive(Clone, Debug, Default)]
pub(super) struct CandidateList {
    /// Grows, and never shrinks; only the first `len` lanes count.
    blocks: Vec<Block>,
    len: usize,
}

impl CandidateList {
    /// All triangles.
    pub(super) fn assign(&mut self, boxes: &[SweptBox]) {
        self.reserve(boxes.len());
        for (index, swept) in boxes.iter().enumerate() {
            let block = &mut self.blocks[index / LANES];
            let bounds = bounds(swept);
            for k in 0..6 {
                block.bounds[k][index % LANES] = bounds[k];
            }
            block.triangles[index % LANES] = index as u32;
        }
        self.len = boxes.len();
        self.close();
    }

    /// The triangles of `list` from `first` on whose boxes overlap `bounds`. Returns the number of
    /// blocks tested.
    pub(super) fn assign_overlapping(&mut self, list: &Self, bounds: &Bounds, first: u32) -> u64 {
        let blocks = list.blocks_from(first);
        self.reserve(LANES * blocks.len());
        let limits = limits(bounds);
        let mut len = 0;
        for source in blocks {
            let mut mask = source.within(&limits);
            while mask != 0 {
                let lane = mask.trailing_zeros() as usize % LANES;
                mask &= mask - 1;
                let target = &mut self.blocks[len / LANES];
                for k in 0..6 {
                    target.bounds[k][len % LANES] = source.bounds[k][lane];
                }
                target.triangles[len % LANES] = source.triangles[lane];
                len += 1;
            }
        }
        self.len = len;
        self.close();
        blocks.len() as u64
    }

    /// Appends the triangles after `triangle` whose boxes overlap `bounds` to `partners`. Returns the
    /// number of blocks tested.
    pub(super) fn append_overlapping(
        &self,
        bounds: &Bounds,
        triangle: u32,
        partners: &mut Partners,
    ) -> u64 {
        let blocks = self.blocks_from(triangle);
        let Some(first) = blocks.first() else {
            return 0;
        };
        let limits = limits(bounds);
        let mut later = 0;
        for lane in 0..LANES {
            later |= u32::from(first.triangles[lane] > triangle) << lane;
        }
        let target = partners.room_for(LANES * blocks.len());
        let mut len = 0;
        for source in blocks {
            let mut mask = source.within(&limits) & later;
            later = u32::MAX;
            while mask != 0 {
                let lane = mask.trailing_zeros() as usize % LANES;
                mask &= mask - 1;
                target[len] = source.triangles[lane];
                len += 1;
            }
        }
        partners.len += len;
        blocks.len() as u64
    }

    /// The blocks without those that end before `triangle`.
    fn blocks_from(&self, triangle: u32) -> &[Block] {
        let blocks = &self.blocks[..self.len.div_ceil(LANES)];
        let start = blocks.partition_point(|block| block.triangles[LANES - 1] < triangle);
        &blocks[start..]
    }

    fn reserve(&mut self, len: usize) {
        if self.blocks.len() < len.div_ceil(LANES) {
            self.blocks.resize(len.div_ceil(LANES), Block::UNUSED);
        }
    }

    /// Marks the lanes after the last as unused.
    fn close(&mut self) {
        if !self.len.is_multiple_of(LANES) {
            let block = &mut self.blocks[self.len / LANES];
            for lane in self.len % LANES..LANES {
                block.bounds[0][lane] = f32::NAN;
                block.triangles[lane] = u32::MAX;
            }
        }
    }
}

/// The partners of one triangle after another.
#[derive(Debug, Default)]
pub(super) struct Partners {
    /// Grows, and never shrinks; only the first `len` count.
    triangles: Vec<u32>,
    len: usize,
}

impl Partners {
    pub(super) fn clear(&mut self) {
        self.len = 0;
    }

    pub(super) fn len(&self) -> usize {
        self.len
    }

    pub(super) fn get(&self, start: usize, len: usize) -> &[u32] {
        &self.triangles[start..start + len]
    }

    fn room_for(&mut self, count: usize) -> &mut [u32] {
        if self.triangles.len() < self.len + count {
            self.triangles
                .resize((self.len + count).max(2 * self.triangles.len()), 0);
        }
        &mut self.triangles[self.len..self.len + count]
    }
}
