//! Elementary tests: does a primitive pair touch, and when first?
//!
//! | test | promise |
//! |---|---|
//! | [`contact`](mod@contact) | **exact**: whether there is contact, not when; a bounded amount of work |
//! | [`advance`] | **certified**: never a miss, a time that is never too late, a bounded amount of work |
//! | `additive`, with the feature `verification` only | none under rounding: in practice no miss, many false alarms (Li et al. 2021); a baseline |
//! | [`advance::uncertified`] | none: what the bounds of `advance` cost, and what they are there for; a baseline |

#[cfg(feature = "verification")]
pub mod additive;
pub mod advance;
pub mod contact;
mod impact;

pub use contact::{Contact, Evidence, contact};
pub use impact::{Impact, Limits, Reason};
