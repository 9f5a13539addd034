//! Draws the paper's Figure 3: the primitives that have a candidate pair, before and after culling.

mod drawing;
mod lettering;
mod panel;
mod view;

use crate::study::StepCandidates;
use drawing::{Drawing, Marks};
use selvedge::Topology;
use selvedge::glam::DVec3;
use std::error::Error;
use tiny_skia::{Color, Pixmap};
use view::View;

/// Width and height of the picture of [`figure_3`], in pixels.
pub const FIGURE_SIZE: [u32; 2] = [1600, 1000];

/// Draws a mesh twice, side by side, with the primitives of two sets of candidate pairs marked. Returns the PNG file's bytes.
///
/// The marks are those of Figure 3 in Lv, He, Mi. Vertices of vertex–face pairs are blue, their faces yellow, and edges of
/// edge–edge pairs green. The view is orthographic, from the side to which the mesh bends, so that the inner side of an elbow
/// faces the viewer. Cloth without a mark never hides a mark. If the right panel's marks are in a small part of the mesh, both
/// panels show that part close up.
///
/// # Errors
/// Returns an error if the picture cannot be encoded.
///
/// # Panics
/// Panics if there is not one position for each vertex, or a pair names a feature that the mesh does not have.
pub fn figure_3(
    topology: &Topology,
    positions: &[DVec3],
    panels: [&StepCandidates; 2],
) -> Result<Vec<u8>, Box<dyn Error + Send + Sync>> {
    let marks = panels.map(|candidates| Marks::new(topology, candidates));

    let [width, height] = FIGURE_SIZE;
    let mut picture = Pixmap::new(width, height).expect("the size is not zero");
    picture.fill(Color::WHITE);
    let view = View::new(topology, positions, panel::OVERVIEW);
    let close_up = view.close_up(&marks[1].positions(topology, positions), panel::CLOSE_UP);
    let view = match close_up {
        Some(_) => view,
        None => View::new(topology, positions, panel::OVERVIEW_ALONE),
    };
    for (index, (candidates, marks)) in panels.into_iter().zip(&marks).enumerate() {
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
        panel::write_caption(&mut picture, left, candidates);
    }
    panel::write_legend(&mut picture);
    Ok(picture.encode_png()?)
}

#[cfg(test)]
mod tests;
