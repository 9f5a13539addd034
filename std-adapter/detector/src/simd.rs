//! Instruction sets of the batched kernels.
//!
//! A detector uses the best instruction set of the machine, found at run time. All of them give the same results, bit for bit.

pub use selvedge_core::batch::Level;

/// Returns the widest instruction set that the machine and the kernels have: SSE2, AVX2 or AVX-512 on x86, NEON on 64-bit Arm,
/// otherwise a plain loop.
#[must_use]
pub fn best_level() -> Level {
    Level::new()
}

/// Returns every instruction set of the machine with its name, the simplest first.
///
/// ```
/// let levels = selvedge::simd::available_levels();
/// assert!(!levels.is_empty());
/// ```
#[must_use]
pub fn available_levels() -> Vec<(&'static str, Level)> {
    let best = best_level();
    let mut levels = Vec::new();
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    {
        use fearless_simd::Simd;
        levels.extend(best.as_sse2().map(|token| ("sse2", token.level())));
        levels.extend(best.as_avx2().map(|token| ("avx2", token.level())));
        levels.extend(best.as_avx512().map(|token| ("avx512", token.level())));
    }
    #[cfg(target_arch = "aarch64")]
    {
        use fearless_simd::Simd;
        levels.extend(best.as_neon().map(|token| ("neon", token.level())));
    }
    if levels.is_empty() {
        levels.push(("plain", best));
    }
    levels
}
