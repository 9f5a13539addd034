//! Reports on a scene that starts tangled.

use super::doubled;
use super::measures::EdgeStretch;
use crate::contact::Crossing;
use crate::model::step::{Carrier, FREE};
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
    /// The pinned vertices of cloth that these edges and faces have, by the numbers of `mesh`, in their order. Untangling cannot
    /// move them.
    pub pinned: Vec<u32>,
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

    /// Returns the vertices of cloth in crossings that a motion carries, in their order.
    pub(super) fn pinned_of(crossings: &[Crossing], carriers_of_cloth: &[Carrier]) -> Vec<u32> {
        let vertices = crossings
            .iter()
            .flat_map(|crossing| crossing.edge.into_iter().chain(crossing.face));
        let is_pinned = |vertex: &u32| {
            carriers_of_cloth
                .get(*vertex as usize)
                .is_some_and(|&carrier| carrier != FREE)
        };
        let mut pinned: Vec<u32> = vertices.filter(is_pinned).collect();
        pinned.sort_unstable();
        pinned.dedup();
        pinned
    }

    /// Writes which of the vertices are pinned, if any is.
    fn write_pinned(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        /// The number of vertices that a message names.
        const NAMED: usize = 5;
        if self.pinned.is_empty() {
            return Ok(());
        }
        let number = |&vertex: &u32| self.numbers_in_files[vertex as usize].to_string();
        let named: Vec<String> = self.pinned.iter().take(NAMED).map(number).collect();
        let more = if self.pinned.len() > NAMED { ", …" } else { "" };
        let what = if self.pinned.len() == 1 {
            "pinned vertex is"
        } else {
            "pinned vertices are"
        };
        write!(
            f,
            "; {} {what} there ({}{more}): nothing moves pins, so start them in free space",
            self.pinned.len(),
            named.join(", ")
        )
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
                    "untangling stopped after {steps} steps, since {end}: {count} of {crossings} edges still meet faces"
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
        if let Some(first) = self.crossings_in_files().next() {
            let DVec3 { x, y, z } = first.point;
            write!(f, "; first {first}, at ({x:.4}, {y:.4}, {z:.4}) m")?;
        }
        self.write_pinned(f)?;
        let doubled = if self.untangled.is_none() {
            doubled::triangles(&self.mesh, self.cloth_triangles)
        } else {
            Vec::new()
        };
        if !doubled.is_empty() {
            write!(
                f,
                "; the faces {} lie on earlier ones, as those of a second side do: leave them out of the mesh",
                doubled::in_words(&doubled)
            )?;
        }
        match (&self.untangled, self.coincident_vertices()) {
            (Some(_), _) | (None, 0) => {}
            // Merging vertices leaves both sides.
            _ if !doubled.is_empty() => {}
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
