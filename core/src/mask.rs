//! Sixteen lanes, and one bit for each.

/// The number of pairs that go side by side.
pub const LANES: usize = 16;

/// One bit for each of sixteen pairs, the first pair's lowest. Bits past the last pair are zero.
pub type Mask = u16;

/// Returns the lowest set lane, and clears it.
#[inline(always)]
pub(crate) fn next_lane(lanes: &mut Mask) -> usize {
    let lane = lanes.trailing_zeros() as usize % LANES;
    *lanes &= lanes.wrapping_sub(1);
    lane
}
