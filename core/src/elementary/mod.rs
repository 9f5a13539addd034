//! Elementary tests: when does a primitive pair first touch?
//!
//! | test | promise |
//! |---|---|
//! | [`advance`] | certified: a lower bound of the time of impact, or the certainty that there is none |
//! | [`cubic`] | none: the plain textbook test (Provot 1997), which misses contacts; a baseline |

pub mod advance;
pub mod cubic;
