//! Fuzz targets for `selvedge-core` and `selvedge`.
//!
//! Each target is an ordinary function of bytes in [`targets`] that panics if a promise is broken. `cargo fuzz run NAME` feeds it
//! to libFuzzer; `cargo test` feeds it the kept inputs, on any compiler.

// The tests are within the crate, because a test beside it would build the programs of all targets.
#[cfg(test)]
mod replay;
pub mod targets;

#[cfg(fuzzing)]
#[doc(hidden)]
pub use libfuzzer_sys;

/// The `main` of a target's program. Under `cargo fuzz` it is libFuzzer's. Otherwise it runs the target on each file named on the
/// command line, which helps with a debugger.
#[macro_export]
macro_rules! target {
    ($name:ident) => {
        #[cfg(fuzzing)]
        $crate::libfuzzer_sys::fuzz_target!(|data: &[u8]| $crate::targets::$name(data));

        #[cfg(not(fuzzing))]
        fn main() -> std::io::Result<()> {
            std::env::args_os().skip(1).try_for_each(|path| {
                $crate::targets::$name(&std::fs::read(path)?);
                Ok(())
            })
        }
    };
}
