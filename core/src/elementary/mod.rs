//! Elementary tests: does a primitive pair touch, and when first?
//!
//! | test | promise |
//! |---|---|
//! | [`contact`](mod@contact) | **exact**: whether there is contact, not when; a bounded amount of work |
//! | [`advance`] | **certified**: never a miss, a time that is never too late, a bounded amount of work |

pub mod advance;
pub mod contact;
mod impact;

pub use contact::{ContactVerdict, contact};
pub use impact::{Impact, Limits, Reason};
