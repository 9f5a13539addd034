//! Published filters and elementary tests, for comparison with certified ones. Except [`nine_directions`], **they promise
//! nothing**: each may cull a pair that touches, or miss a contact, as its own page says.
//!
//! | baseline | what it is | what is not promised |
//! |---|---|---|
//! | [`plain`] | the paper's non-coplanarity filter, equations 1 to 14, as printed | ignores rounding: culls a colliding pair now and then |
//! | [`as_computed`] | control values of one sign, as computed | ignores rounding as well |
//! | [`nine_directions`] | subspace filter (Tang, Li, Wang 2011) and 18-DOPs (Hutter, Fuhrmann 2007) | nothing: they never cull what touches |
//! | [`cubic`] | the plain textbook test (Provot 1997) | misses contacts |
//! | [`bernstein_sign`] | signs of polynomials (Tang et al. 2014) without their exact arithmetic; no times | misses contacts |
//! | [`additive`] | additive advancement (Li et al. 2021) | ignores rounding: in practice no miss, many false alarms |
//! | [`uncertified`] | our advancing without its bounds | ignores rounding: misses contacts, or finds them too late |
//! | [`tight_inclusion`] | bisection of time and parameters (Wang et al. 2021) | no miss, but no useful bound of the work |
//!
//! The filters run sixteen pairs at a time on core's own code, at the same width, so that times compare the tests alone.

pub mod additive;
pub mod as_computed;
pub mod bernstein_sign;
pub mod cubic;
pub mod nine_directions;
pub mod plain;
pub mod tight_inclusion;
pub mod uncertified;
