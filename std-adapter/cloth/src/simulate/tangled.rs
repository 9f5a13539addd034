//! Reports on a scene that starts tangled.

use super::measures::EdgeStretch;
use crate::contact::Crossing;
use selvedge::{Mesh, first_coincident};
use selvedge_core::glam::DVec3;
use std::fmt;

/// The progress of untangling.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UntanglingProgress {
    /// The number of steps so far.
    pub steps: u32,
    /// The number of edges that intersect faces now.
    pub crossings: usize,
}

/// The result of untangling before the first step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Untangled {
    /// The number of edges that intersected faces at the start of the scene.
    pub crossings: usize,
    /// The number of edges that still do.
    pub left: usize,
    /// The number of steps, during which no time passes.
    pub steps: u32,
    /// The reason why it ended.
    pub end: UntanglingEnd,
    /// The stretch of edges now, over their lengths in the scene.
    pub stretch: EdgeStretch,
    /// The largest move of a vertex, in metres.
    pub farthest: f64,
    /// The seconds of work; zero without the feature `timing`.
    pub seconds: f64,
}

/// The reason why untangling ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UntanglingEnd {
    /// Nothing intersects.
    Free,
    /// The number of intersections did not fall for many steps.
    NoProgress,
    /// No vertex could be moved without new intersections.
    Stuck,
    /// The limit of steps was reached.
    StepLimit,
}

impl fmt::Display for UntanglingEnd {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Free => "nothing intersects any more",
            Self::NoProgress => "the number of intersections did not fall any more",
            Self::Stuck => "nothing could be moved without new intersections",
            Self::StepLimit => "the limit of steps was reached",
        })
    }
}

/// The places where surfaces pass through each other at the start of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Tangled {
    /// The edges and faces that meet, by the numbers of `mesh`.
    pub crossings: Vec<Crossing>,
    /// For each vertex of `mesh`, its number where cloths have the vertices of their files, as in
    /// [`MeshInFiles`](crate::MeshInFiles). Messages have these numbers.
    pub numbers_in_files: Vec<u32>,
    /// The positions of all vertices, and the triangles: the cloth's, then the bodies'.
    pub mesh: Mesh,
    /// The number of the cloth's triangles.
    pub cloth_triangles: usize,
    /// The names of bodies, in the order of the scene.
    pub body_names: Vec<String>,
    /// The result of untangling, if the scene requests it.
    pub untangled: Option<Untangled>,
}

impl Tangled {
    /// Returns the edges and faces that meet, by their [numbers in files](Self::numbers_in_files).
    pub fn crossings_in_files(&self) -> impl Iterator<Item = Crossing> {
        let number = |vertex: u32| self.numbers_in_files[vertex as usize];
        self.crossings.iter().map(move |crossing| Crossing {
            edge: crossing.edge.map(number),
            face: crossing.face.map(number),
            ..*crossing
        })
    }

    /// Returns the number of the cloths' vertices that lie in the same place as an earlier one, such as those of split seams.
    fn coincident_vertices(&self) -> usize {
        let of_cloths = &self.mesh.triangles[..self.cloth_triangles];
        let vertices = of_cloths
            .iter()
            .flatten()
            .map(|&vertex| vertex as usize + 1)
            .max()
            .unwrap_or(0);
        let first = first_coincident(&self.mesh.positions[..vertices], 0.0);
        (0_u32..).zip(first).filter(|(vertex, first)| vertex != first).count()
    }
}

impl std::error::Error for Tangled {}

impl fmt::Display for Tangled {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let count = self.crossings.len();
        match &self.untangled {
            None => write!(f, "the scene starts with an intersection: {}", counted(count))?,
            Some(Untangled {
                crossings, steps, end, ..
            }) => {
                write!(
                    f,
                    "untangling stopped after {steps} steps, since {end}: {} of {crossings}",
                    counted(count)
                )?;
            }
        }
        let mut of_bodies = vec![0; self.body_names.len()];
        self.crossings
            .iter()
            .filter_map(|crossing| crossing.body)
            .for_each(|body| of_bodies[body] += 1);
        let named = of_bodies.iter().zip(&self.body_names).filter(|(count, _)| **count > 0);
        for (count, name) in named {
            write!(f, ", {count} with the body '{name}'")?;
        }
        if let Some(Crossing {
            edge: [a, b],
            face: [c, d, e],
            point,
            ..
        }) = self.crossings_in_files().next()
        {
            let DVec3 { x, y, z } = point;
            write!(
                f,
                "; first the edge {a}, {b} and the face {c}, {d}, {e}, at ({x:.4}, {y:.4}, {z:.4}) m"
            )?;
        }
        match (&self.untangled, self.coincident_vertices()) {
            (Some(_), _) | (None, 0) => {}
            (None, 1) => f.write_str("; 1 vertex lies in the same place as another: merge them with `weld = \"0\"`")?,
            (None, count) => write!(
                f,
                "; {count} vertices lie in the same place as others: merge them with `weld = \"0\"`"
            )?,
        }
        f.write_str(match self.untangled {
            None => "; `tangled_start = \"untangle\"` pulls it apart, \"tolerate\" lets it be",
            Some(_) => "; pull these apart in the mesh, or let them be with `tangled_start = \"tolerate\"`",
        })
    }
}

/// Formats a number, as in `3 edges meet faces`.
fn counted(crossings: usize) -> String {
    match crossings {
        1 => "an edge meets a face".to_owned(),
        _ => format!("{crossings} edges meet faces"),
    }
}
