//! The colours that distinguish cloths in pictures, glTF files and on the page, whose style sheet has the same four.

use super::recording::{PartKind, RecordedPart};

/// The colours of the page's light theme, as linear light. A fifth cloth has the first one again.
pub(super) const CLOTHS: [[f64; 3]; 4] = [
    [0.046_1, 0.183, 0.467],
    [0.114, 0.330, 0.157],
    [0.470, 0.086_9, 0.075_9],
    [0.259, 0.125, 0.442],
];

/// Returns for each part the number of its colour, or `None` for a body.
pub(super) fn cloth_colours(parts: &[RecordedPart]) -> Vec<Option<usize>> {
    let mut next = (0..CLOTHS.len()).cycle();
    let own = |part: &RecordedPart| match part.kind() {
        PartKind::Cloth => next.next(),
        PartKind::Body => None,
    };
    parts.iter().map(own).collect()
}
