//! Elementary tests: when does a primitive pair first touch?
//!
//! | test | promise |
//! |---|---|
//! | [`cubic`] | none: the plain textbook test (Provot 1997), which misses contacts; a baseline |

pub mod cubic;
