//! Which instruction set the batched kernels use.

pub use selvedge_core::batch::Level;

/// The widest instruction set that this machine has and the kernels know: SSE2, AVX2 or AVX-512 on x86, NEON on
/// 64-bit Arm, else a plain loop. Detected once. All of them give the same verdicts, bit for bit.
#[must_use]
pub fn best_level() -> Level {
    Level::new()
}

/// Every level that this machine has, the plainest first, with its name: for tests and studies that force each.
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
