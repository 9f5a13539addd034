//! Candidate vertex–face and edge–edge pairs, from hierarchies of moving boxes.
//!
//! Each vertex, edge and face has a box at the start and a box at the end of the step ([`selvedge_core::boxes::moving`]). Two
//! primitives whose boxes keep one order along an axis cannot meet. All others are candidates, unless they have a vertex in
//! common. The same test holds for groups of primitives. So three hierarchies, over vertices, edges and faces, find each
//! candidate once without looking at every pair.
//!
//! A [`CollisionDetector`](crate::CollisionDetector) holds such a broad phase. Use [`MovingBroadPhase`] by itself for stages of
//! your own.
//!
//! ```
//! use selvedge::{CandidateBoxes, CollisionDetector, Topology, glam::DVec3};
//!
//! // A small triangle falls through a large one.
//! let topology = Topology::new(6, vec![[0, 1, 2], [3, 4, 5]])?;
//! let mut start = vec![DVec3::new(-5.0, -5.0, 0.0), DVec3::new(5.0, -5.0, 0.0), DVec3::new(0.0, 5.0, 0.0)];
//! start.extend([DVec3::new(0.0, 0.0, 1.0), DVec3::new(1.0, 0.0, 1.1), DVec3::new(0.0, 1.0, 1.2)]);
//! let mut end = start.clone();
//! for vertex in &mut end[3..] {
//!     vertex.z -= 4.0;
//! }
//!
//! let mut detector = CollisionDetector::<f64>::new(topology);
//! let (mut vertex_face, mut edge_edge) = (Vec::new(), Vec::new());
//! detector.candidates(&start, &end, CandidateBoxes::Moving, &mut vertex_face, &mut edge_edge)?;
//! vertex_face.sort();
//! assert_eq!(vertex_face, [[3, 0], [4, 0], [5, 0]]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Which pairs
//! The candidates are the pairs that [relative boxes along three axes](selvedge_core::boxes::relative::three_axes) leave. This
//! holds for `f32` positions, and for `f64` positions that are `f32` numbers, unless the mesh is far from the origin for its
//! size. Other `f64` positions are [rounded to `f32`](selvedge_core::boxes::mapping) for the boxes. Pairs that are apart by less
//! than the rounding are then candidates too; none is lost.
//!
//! The order of the candidates depends on the hierarchies, and so on earlier steps. The same sequence of steps gives the same
//! candidates in the same order, on any number of threads and every instruction set.

mod bounds;
mod degradation;
mod hierarchies;
mod hubs;
mod moving;
mod neighbours;
mod order;
mod over_meshes;
mod pairing;
mod pairs;
mod rows;
mod statistics;
mod traversal;
mod tree;

pub(crate) use hierarchies::{BoxFit, Hierarchies, mapping_within};
pub use moving::MovingBroadPhase;
pub use neighbours::Neighbours;
pub(crate) use over_meshes::MeshHierarchy;
pub(crate) use pairing::{FacesAndEdges, Pairing};
pub(crate) use pairs::{CHUNK, Sink};
pub(crate) use rows::{RowSlices, Rows};
pub use statistics::MovingStatistics;
pub(crate) use traversal::{BlockPair, Scratch};
