//! What both contact effects are told: the distance that contacts aim at, and the one that every step keeps.

use crate::contact::Thickness;
use crate::input::{LENGTH, SceneError, Table};

pub(super) fn read(table: &Table<'_>) -> Result<Thickness, SceneError> {
    let thickness = table.required_number("thickness", LENGTH, 1e-5..=0.1)?;
    let separation = table.number("separation", LENGTH, 1e-6..=0.1)?;
    let separation = separation.unwrap_or(0.1 * thickness);
    if separation > 0.9 * thickness {
        let message = format!("`separation` is {separation} m, but must be at most nine tenths of the thickness, {thickness} m");
        return Err(table.error("separation", message));
    }
    Ok(Thickness { thickness, separation })
}

/// Both, as settings of an effect.
pub(super) fn settings(of: &Thickness) -> Vec<(&'static str, String)> {
    vec![
        ("thickness", LENGTH.written_short(of.thickness)),
        ("separation", LENGTH.written_short(of.separation)),
    ]
}
