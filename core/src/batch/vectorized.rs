//! Code that is compiled for each instruction set.

/// Calls `$function` as code for `$level`. Its lanes are the first of the four types with AVX-512, the second with AVX2, the
/// third with registers of 128 bits, and otherwise the last.
///
/// x86 has no code for SSE4.2, which adds next to nothing to SSE2 for these kernels.
#[cfg(not(unoptimised))]
macro_rules! vectorized {
    ($level:expr, [$wide:ident, $middle:ident, $narrow:ident, $one:ident], $function:ident::<$pair:ty>($($argument:expr),*)) => {{
        macro_rules! run {
            ($token:expr, $lanes:ident) => {
                if let Some(token) = $token {
                    return token.vectorize(
                        #[inline(always)]
                        || {
                            $crate::batch::frame::align();
                            $function::<$pair, $lanes<_>>(token, $($argument),*)
                        },
                    );
                }
            };
        }
        let level: Level = $level;
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        {
            run!(level.as_avx512(), $wide);
            run!(level.as_avx2(), $middle);
            run!(level.as_sse2(), $narrow);
        }
        #[cfg(target_arch = "aarch64")]
        run!(level.as_neon(), $narrow);
        #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
        run!(level.as_wasm_simd128(), $narrow);
        // This instruction set has no code of its own.
        let _ = level;
        $function::<$pair, $one>((), $($argument),*)
    }};
}

#[cfg(unoptimised)]
macro_rules! vectorized {
    ($level:expr, [$wide:ident, $middle:ident, $narrow:ident, $one:ident], $function:ident::<$pair:ty>($($argument:expr),*)) => {{
        let _: Level = $level;
        $function::<$pair, $one>((), $($argument),*)
    }};
}
