//! Sixteen pairs side by side: the same tests, at the machine's width.
//!
//! A batched test is the one-pair test, from the same source, on vectors of lanes. Its verdicts are **the same, bit for bit**,
//! for every instruction set: each operation rounds on its own, and nothing is fused or reassociated.
//!
//! Pairs come from a mesh: the caller gives any number of them, as indices into [`VertexRow`]s.
//!
//! | function | result for each pair |
//! |---|---|
//! | [`culled_from_rows`] | one bit of a [`Mask`] for every sixteen pairs: set if the pair is culled |
//! | [`advance_from_rows`] | one round of the certified [time of impact](crate::elementary::advance) |
//! | [`largest_strays_from_rows`] | how far points may stray while the pair keeps its distance |
//! | [`closest_points`] | where the pair is closest |
//!
//! [`culled`] and [`culled_from_tiles`] take pairs that already lie side by side, and [`Test`] and [`ByPoints`] are further
//! tests.
//!
//! The caller names the instruction set by a [`Level`]; `selvedge` detects the best one at run time.
//!
//! # The path of a call
//! Each macro makes one choice, and none is made twice. Every leaf is one loop, compiled for one instruction set, format and kind
//! of pair.
//!
//! ```text
//! culled_from_rows(level, kind, filter, rows, indices)      generic over the format, inlined into the caller
//!   │  in_format!        f32 or f64: from here on nothing is generic, so this crate compiles it once
//!   ▼
//! single::by_filter / double::by_filter                     one module for each format, made by kernels!
//!   │  of_kind!          vertex–face or edge–edge
//!   │  vectorized!       AVX-512, AVX2, SSE2, NEON, simd128, or one lane
//!   ▼
//! test_volume::<Kind, Lanes>                                loops over the sixteen pairs at the width of the registers
//!   │  Chunk             loads four points of each pair
//!   ▼
//! MovingTetrahedron::decide                                 the kernel that one pair runs, too
//! ```
//!
//! ```
//! use selvedge_core::batch::{culled_from_rows, Level, VertexRow};
//! use selvedge_core::filter::{Filter, Tier};
//! use selvedge_core::{glam::Vec3, Motion, PairKind};
//!
//! // A triangle, and twenty vertices above it: the first nineteen stay there, the last falls through.
//! let mut rows = [Vec3::ZERO, Vec3::X, Vec3::Y].map(|corner| VertexRow::new(Motion::resting(corner))).to_vec();
//! rows.extend((1..=20).map(|k| {
//!     let end = Vec3::new(0.2, 0.2, 19.5 - k as f32);
//!     VertexRow::new(Motion::new(Vec3::new(0.2, 0.2, 2.0), end))
//! }));
//! let pairs: Vec<_> = (3..23).map(|vertex| [vertex, 0, 1, 2]).collect();
//! let mut masks = [0; 2];
//! culled_from_rows(Level::baseline(), PairKind::VertexFace, Filter::new(Tier::Permanent), &rows, &pairs, &mut masks);
//! assert_eq!(masks, [0xFFFF, 0b0111]);
//! ```

#[macro_use]
mod vectorized;
mod advance;
mod chunk;
mod closest;
mod compared;
mod culled;
#[cfg(not(unoptimised))]
mod extremes;
#[cfg(not(unoptimised))]
mod frame;
mod kernels;
mod lane_test;
mod rows;
#[cfg(not(unoptimised))]
mod simd;
mod sixteen;
mod strays;
mod tile;

use crate::mask;

pub use crate::mask::{LANES, Mask};
pub use advance::{Round, RoundQuestion, advance_from_rows};
pub use closest::closest_points;
pub use compared::{Compares, Loop, in_lanes};
pub use culled::{BatchTest, culled_from_rows};
pub use culled::{culled, culled_from_tiles};
pub use fearless_simd::Level;
pub use lane_test::{ByPoints, ByVolume, PointsTest, Test, VolumeTest};
pub use rows::VertexRow;
pub use strays::largest_strays_from_rows;
pub use tile::Tile;
