//! Queries in memory, and their conversion to single precision.

use std::path::PathBuf;

use selvedge_core::glam::Vec3;
use selvedge_core::{Motion, PrimitivePair, Scalar};

use super::QueryError;
use super::kind::point_names;
use selvedge::PairKind;

/// A primitive pair that moves linearly over the step, and whether it collides. Positions are in the file's length unit and always finite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Query<S: Scalar = f64> {
    /// The pair: `v, f0, f1, f2` or `a0, a1, b0, b1`.
    pub pair: PrimitivePair<S>,
    /// Whether the primitives touch at some time in [0, 1]; `None` if the file does not say.
    pub collides: Option<bool>,
    /// The line of the file on which the query starts, counted from 1.
    pub line: u64,
}

/// The queries of one file, in double precision.
#[derive(Debug, Clone, PartialEq)]
pub struct QueryFile {
    /// The kind of all pairs in the file.
    pub kind: PairKind,
    /// The queries, in the order of the file; at least one.
    pub queries: Vec<Query>,
    /// The path that was read, as given.
    pub path: PathBuf,
    /// How many coordinates are not exactly representable in `f64` and were rounded to the
    /// nearest. If this is not 0, the truth column may not hold for the rounded coordinates.
    pub inexact: usize,
}

/// The queries of one file, rounded to single precision.
#[derive(Debug, Clone, PartialEq)]
pub struct SinglePrecision {
    /// The queries, in the order of the file.
    pub queries: Vec<Query<f32>>,
    /// How many coordinates changed in the conversion from `f64`. If this is not 0, the truth
    /// column may not hold for the rounded coordinates. [`QueryFile::inexact`] counts the
    /// roundings before that.
    pub rounded: usize,
}

impl QueryFile {
    /// Rounds every coordinate to the nearest `f32`, ties to even.
    ///
    /// # Errors
    ///
    /// [`QueryError::OverflowsF32`] if a coordinate rounds to infinity. Underflow is no error; it
    /// counts as rounding.
    pub fn to_f32(&self) -> Result<SinglePrecision, QueryError> {
        let mut rounded = 0;
        let queries = self
            .queries
            .iter()
            .map(|query| {
                let start = self.points_to_f32(query, 0, &mut rounded)?;
                let end = self.points_to_f32(query, 1, &mut rounded)?;
                Ok(Query {
                    pair: PrimitivePair {
                        kind: query.pair.kind,
                        motions: [0, 1, 2, 3].map(|k| Motion::new(start[k], end[k])),
                    },
                    collides: query.collides,
                    line: query.line,
                })
            })
            .collect::<Result<_, _>>()?;
        Ok(SinglePrecision { queries, rounded })
    }

    fn points_to_f32(&self, query: &Query, time: u8, rounded: &mut usize) -> Result<[Vec3; 4], QueryError> {
        let points = query
            .pair
            .motions
            .map(|motion| if time == 0 { motion.start } else { motion.end });
        let mut result = [Vec3::ZERO; 4];
        for (index, (wide, narrow)) in points.into_iter().zip(&mut result).enumerate() {
            *narrow = wide.as_vec3();
            for axis in 0..3 {
                if !narrow[axis].is_finite() {
                    return Err(QueryError::OverflowsF32 {
                        path: self.path.clone(),
                        line: query.line,
                        coordinate: ["x", "y", "z"][axis],
                        point: point_names(self.kind)[index],
                        time,
                        value: wide[axis],
                    });
                }
            }
            *rounded += narrow.as_dvec3().cmpne(wide).bitmask().count_ones() as usize;
        }
        Ok(result)
    }
}
