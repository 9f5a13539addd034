//! The paper's Figure 3: which primitives still have a candidate pair, before and after culling.

mod drawing;
mod lettering;
mod panel;
mod view;

use drawing::{Drawing, Marks};
use selvedge::Topology;
use selvedge::glam::DVec3;
use std::error::Error;
use tiny_skia::{Color, Pixmap};
use view::View;

/// Width and height of the picture of [`figure_3`], in pixels.
pub const FIGURE_SIZE: [u32; 2] = [1600, 1000];

/// One panel of [`figure_3`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FigurePairs<'a> {
    /// What is written under the panel: the method's name.
    pub name: String,
    /// Vertex and face of each pair, as numbered by the topology.
    pub vertex_face: &'a [[u32; 2]],
    /// The two edges of each pair, as numbered by the topology.
    pub edge_edge: &'a [[u32; 2]],
}

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FigureError {
    /// There are too few or too many positions.
    #[error("there are {found} positions to draw, but the mesh has {expected} vertices")]
    WrongLength {
        /// How many positions there are.
        found: usize,
        /// The mesh's vertices.
        expected: usize,
    },
    /// A position is NaN or infinite.
    #[error("vertex {vertex} cannot be drawn: a coordinate is not a finite number")]
    NotFinite {
        /// The first such vertex.
        vertex: usize,
    },
    /// A pair names a vertex, face or edge that the mesh does not have.
    #[error("a pair of `{name}` names {feature} {index}, but the mesh has {count}, numbered from 0")]
    OutOfRange {
        /// The panel's name.
        name: String,
        /// `"vertex"`, `"face"` or `"edge"`.
        feature: &'static str,
        /// The number in the pair.
        index: u32,
        /// How many the mesh has.
        count: usize,
    },
    /// The picture could not be written as PNG.
    #[error("the picture cannot be written as PNG: {0}")]
    Encoding(#[source] Box<dyn Error + Send + Sync>),
}

/// Draws a mesh twice, side by side, with the primitives of two sets of candidate pairs marked, and returns the PNG file's
/// bytes.
///
/// The marks are those of Figure 3 in Lv, He, Mi: vertices of vertex–face pairs are blue, their faces yellow, and edges of
/// edge–edge pairs green. The mesh is seen without perspective from the side to which it bends, so that the inner side of
/// an elbow faces the viewer. Cloth without a mark never hides a mark. Where the right panel's marks are in a small part
/// of the mesh, both panels show that part close up.
///
/// ```
/// use selvedge::{glam::DVec3, Topology};
/// use selvedge_laboratory::report::{FigurePairs, figure_3};
///
/// let topology = Topology::new(4, vec![[0, 1, 2]])?;
/// let positions = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
/// let before = FigurePairs { name: "basic".into(), vertex_face: &[[3, 0]], edge_edge: &[] };
/// let after = FigurePairs { name: "selvedge".into(), vertex_face: &[], edge_edge: &[] };
/// let png = figure_3(&topology, &positions, &before, &after)?;
/// assert_eq!(&png[1..4], b"PNG");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// If there is not one finite position for each vertex, a pair names something that the mesh does not have, or the picture
/// cannot be encoded.
pub fn figure_3(
    topology: &Topology,
    positions: &[DVec3],
    left: &FigurePairs<'_>,
    right: &FigurePairs<'_>,
) -> Result<Vec<u8>, FigureError> {
    check_positions(topology, positions)?;
    let panels = [left, right];
    let marks = [Marks::new(topology, left)?, Marks::new(topology, right)?];

    let [width, height] = FIGURE_SIZE;
    let mut picture = Pixmap::new(width, height).expect("the size is not zero");
    picture.fill(Color::WHITE);
    let view = View::new(topology, positions, panel::OVERVIEW);
    let close_up = view.close_up(&marks[1].positions(topology, positions), panel::CLOSE_UP);
    let view = match close_up {
        Some(_) => view,
        None => View::new(topology, positions, panel::OVERVIEW_ALONE),
    };
    for (index, (pairs, marks)) in panels.into_iter().zip(&marks).enumerate() {
        let left = index as f32 * panel::WIDTH;
        let mesh = Drawing {
            topology,
            positions,
            marks,
        };
        mesh.draw(&mut picture, &view.moved(left, 0.0));
        if let Some(close_up) = &close_up {
            panel::draw_close_up(&mut picture, left, &mesh, &view, close_up);
        }
        panel::write_caption(&mut picture, left, pairs);
    }
    panel::write_legend(&mut picture);
    picture.encode_png().map_err(|error| FigureError::Encoding(error.into()))
}

fn check_positions(topology: &Topology, positions: &[DVec3]) -> Result<(), FigureError> {
    if positions.len() != topology.vertex_count() {
        return Err(FigureError::WrongLength {
            found: positions.len(),
            expected: topology.vertex_count(),
        });
    }
    match positions.iter().position(|position| !position.is_finite()) {
        Some(vertex) => Err(FigureError::NotFinite { vertex }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests;
