//! Table 1 of Lv, He, Mi, as printed.

use super::number::grouped;
use crate::methods::Preset;

/// One row of the paper's Table 1, measured on its authors' mesh (693 vertices, 1,345 triangles) and machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PaperRow {
    /// The paper's name of the method.
    pub label: &'static str,
    /// *Qty. of candidate VF primitive pair*.
    pub vertex_face: u32,
    /// *Qty. of candidate EE primitive pair*.
    pub edge_edge: u32,
    /// *Frame rate*, of the whole simulation, in frames a second.
    pub frames_per_second: f64,
}

/// Returns the paper's row for a method, if it has one.
///
/// The paper does not say which work of 2010 and 2011 by two authors named Tang its row *2011 Tang* stands for. Here it is beside
/// [`Preset::Tang2010`], whose filter the paper builds on.
pub const fn paper_row(preset: Preset) -> Option<PaperRow> {
    let (label, vertex_face, edge_edge, frames_per_second) = match preset {
        Preset::Basic => ("Basic", 1122, 2056, 12.70),
        Preset::Curtis2008 => ("2008 Curtis", 74, 475, 32.0),
        Preset::Tang2010 => ("2011 Tang", 44, 338, 37.54),
        Preset::Lv2014 => ("Ours", 31, 137, 34.22),
        _ => return None,
    };
    Some(PaperRow {
        label,
        vertex_face,
        edge_edge,
        frames_per_second,
    })
}

/// Returns a method's pairs and frame rate as printed, or empty texts.
pub(super) fn printed(preset: Preset) -> [String; 3] {
    paper_row(preset).map_or_else(Default::default, |paper| {
        let frames_per_second = format!("{:.2}", paper.frames_per_second);
        [grouped(paper.vertex_face), grouped(paper.edge_edge), frames_per_second]
    })
}
