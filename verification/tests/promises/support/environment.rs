//! The floating-point environments of a thread, set in the control register.
//!
//! Rust assumes that the control register is never changed, and folds constants to nearest. So the code under test is called
//! through a pointer, on input, both of which are hidden from the compiler. Only that call runs between setting and restoring,
//! and it is neither folded nor moved across the assembly.

use std::fmt;
use std::hint::black_box;

/// A rounding direction, and whether subnormal numbers are flushed.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) struct Environment {
    direction: u32,
    flush_to_zero: bool,
    denormals_are_zero: bool,
}

/// The direction's number in the control register of x86.
const DIRECTIONS: [&str; 4] = ["to nearest", "downward", "upward", "towards zero"];

impl Environment {
    /// The default environment of a thread.
    pub(crate) const DEFAULT: Self = Self::new(0, false, false);
    pub(crate) const DOWNWARD: Self = Self::new(1, false, false);
    pub(crate) const UPWARD: Self = Self::new(2, false, false);
    /// Rounding to nearest, with subnormal results and operands flushed.
    pub(crate) const FLUSHING: Self = Self::new(0, true, true);

    const fn new(direction: u32, flush_to_zero: bool, denormals_are_zero: bool) -> Self {
        Self {
            direction,
            flush_to_zero,
            denormals_are_zero,
        }
    }

    /// Returns all sixteen environments. Returns none, with a note, on processors where the test cannot set them.
    pub(crate) fn all() -> Vec<Self> {
        if cfg!(not(target_arch = "x86_64")) {
            eprintln!("skipped: floating-point environments are set on x86-64 only");
            return Vec::new();
        }
        let modes = [(false, false), (true, false), (false, true), (true, true)];
        let all = modes.map(|(flush, zero)| [0, 1, 2, 3].map(|d| Self::new(d, flush, zero)));
        all.concat()
    }

    /// Returns `f(input)`, computed in this environment.
    ///
    /// Processors other than x86-64 have only the default environment.
    pub(crate) fn run<I: ?Sized, T>(self, input: &I, f: impl Fn(&I) -> T) -> T {
        let f: &dyn Fn(&I) -> T = &f;
        let (f, input) = (black_box(f), black_box(input));
        let _restored = register::Restored::after_setting(self);
        black_box(f(input))
    }
}

impl fmt::Debug for Environment {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(DIRECTIONS[self.direction as usize])?;
        if self.flush_to_zero {
            f.write_str(", flush to zero")?;
        }
        if self.denormals_are_zero {
            f.write_str(", denormals are zero")?;
        }
        Ok(())
    }
}

#[cfg(target_arch = "x86_64")]
mod register {
    use super::Environment;
    use std::arch::asm;

    const DENORMALS_ARE_ZERO: u32 = 6;
    const ROUNDING: u32 = 13;
    const FLUSH_TO_ZERO: u32 = 15;

    /// Restores the register when it is dropped, after a panic as well.
    pub(super) struct Restored(u32);

    impl Restored {
        #[inline(never)]
        pub(super) fn after_setting(environment: Environment) -> Self {
            let mut before = 0_u32;
            let mode = environment.direction << ROUNDING
                | u32::from(environment.flush_to_zero) << FLUSH_TO_ZERO
                | u32::from(environment.denormals_are_zero) << DENORMALS_ARE_ZERO;
            // SAFETY: the register is restored before the caller's own floating-point code runs.
            unsafe {
                asm!("stmxcsr [{}]", in(reg) &raw mut before, options(nostack));
                let cleared = before & !(3 << ROUNDING | 1 << FLUSH_TO_ZERO | 1 << DENORMALS_ARE_ZERO);
                let changed = cleared | mode;
                asm!("ldmxcsr [{}]", in(reg) &raw const changed, options(nostack));
            }
            Self(before)
        }
    }

    impl Drop for Restored {
        #[inline(never)]
        fn drop(&mut self) {
            // SAFETY: this is the register's earlier value.
            unsafe {
                asm!("ldmxcsr [{}]", in(reg) &raw const self.0, options(nostack));
            }
        }
    }
}

#[cfg(not(target_arch = "x86_64"))]
mod register {
    pub(super) struct Restored;

    impl Restored {
        pub(super) fn after_setting(environment: super::Environment) -> Self {
            assert_eq!(environment, super::Environment::DEFAULT);
            Self
        }
    }
}
