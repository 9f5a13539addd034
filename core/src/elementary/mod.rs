//! Elementary tests of a primitive pair: whether it touches, and when first.
//!
//! | test | guarantee |
//! |---|---|
//! | [`contact`](mod@contact) | **exact**: whether there is contact, but not when; bounded work |
//! | [`advance`] | **certified**: no miss, a time that is never too late, bounded work |

pub mod advance;
pub mod contact;
mod impact;

pub use contact::{ContactVerdict, contact};
pub use impact::{Impact, Limits, Reason};
