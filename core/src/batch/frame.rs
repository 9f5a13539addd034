//! Aligned stack frames.

use core::hint::black_box;
use core::mem::MaybeUninit;

#[repr(align(64))]
struct Line(#[expect(dead_code, reason = "it only takes space")] [u8; 64]);

/// Aligns the frame of the function that this is inlined into, to a cache line.
///
/// LLVM decides before it allocates registers whether a function aligns its frame. Registers that it then puts onto the stack lie
/// at multiples of 16 bytes, so that most registers of 64 bytes straddle two cache lines.
#[inline(always)]
pub(super) fn align() {
    let line = MaybeUninit::<Line>::uninit();
    black_box(&line);
}
