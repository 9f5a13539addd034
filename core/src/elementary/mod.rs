//! Elementary tests: does a primitive pair touch, and when first?
//!
//! | test | promise |
//! |---|---|
//! | [`contact`](mod@contact) | **exact**: whether there is contact, not when; a bounded amount of work |
//! | [`advance`] | **certified**: never a miss, a time that is never too late, a bounded amount of work |
//! | [`tight_inclusion`] | no miss; no useful bound of the work (Wang et al. 2021); a baseline |
//! | [`additive`] | none under rounding: in practice no miss, many false alarms (Li et al. 2021); a baseline |
//! | [`advance::uncertified`] | none: what the bounds of `advance` cost, and what they are there for; a baseline |
//! | [`bernstein_sign`] | none: signs of polynomials (Tang et al. 2014) without their exact arithmetic; whether, not when; a baseline |
//! | [`cubic`] | none: the plain textbook test (Provot 1997), which misses contacts; a baseline |

pub mod additive;
pub mod advance;
pub mod bernstein_sign;
pub mod contact;
pub mod cubic;
mod impact;
pub mod tight_inclusion;

pub use contact::{Contact, Evidence, contact};
pub use impact::{Impact, Limits, Reason};
