//! Filters that cull a pair because its four points are never coplanar during the step.
//!
//! | filter | rounding | source |
//! |---|---|---|
//! | [`certified`] | covered: never culls a pair that is coplanar at some t in [0, 1] | `coplanarity`'s bound |
//! | [`plain`] | ignored: culls a colliding pair now and then | the paper, equations 1 to 14, as printed |

pub mod certified;
pub mod plain;
