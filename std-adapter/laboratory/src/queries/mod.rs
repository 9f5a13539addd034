//! Primitive-pair queries in the rational CSV format of the public continuous collision detection
//! benchmark (Wang, Ferguson, Schneider, Jiang, Attene and Panozzo, "A Large-scale Benchmark and
//! an Inclusion-based Algorithm for Continuous Collision Detection", 2021).
//!
//! A query is one vertex-face or edge-edge pair that moves linearly over the step, and takes eight
//! rows: its four points at the start of the step, then the same four at the end. A row has the
//! columns `x numerator, x denominator, y numerator, y denominator, z numerator, z denominator`
//! and, where the verdict is known, the truth: 1 if the pair collides within the step, else 0, the
//! same on all eight rows. Numerators and denominators are integers of any length. There is no
//! header; blank lines are skipped.
//!
//! ```
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! # let folder = tempfile::tempdir()?;
//! # let path = folder.path().join("fall-vf.csv");
//! // A vertex falls from z = 1/2 to z = -1/2 through a resting triangle.
//! let face = "0,1,0,1,0,1,1\n1,1,0,1,0,1,1\n0,1,1,1,0,1,1\n";
//! std::fs::write(&path, format!("1,4,1,4,1,2,1\n{face}1,4,1,4,-1,2,1\n{face}"))?;
//!
//! let file = selvedge_laboratory::queries::read(&path, None)?;
//! assert_eq!(file.kind, selvedge::PairKind::VertexFace);
//! assert_eq!(file.inexact, 0);
//! let query = &file.queries[0];
//! let vertex = query.pair.motions[0];
//! assert_eq!((vertex.start.z, vertex.end.z), (0.5, -0.5));
//! assert_eq!(query.collides, Some(true));
//! # Ok(())
//! # }
//! ```

mod error;
mod kind;
mod query;
mod rational;
mod read;
#[cfg(test)]
mod tests;

pub use error::QueryError;
pub use kind::kind_of_path;
pub use query::{Query, QueryFile, SinglePrecision};
pub use read::{read, read_from};
