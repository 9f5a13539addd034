//! The setting of both contact effects: the distance at which contacts aim, and the distance that every step keeps.

use crate::contact::Thickness;
use crate::input::{Field, LENGTH, SceneError, Table, ValueError};

const THICKNESS: Field = Field::new("thickness", LENGTH, 1e-5, 0.1);
const SEPARATION: Field = Field::new("separation", LENGTH, 1e-6, 0.1);

pub(super) fn read(table: &Table<'_>) -> Result<Thickness, SceneError> {
    let mut thickness = Thickness::new(table.required_number(&THICKNESS)?);
    if let Some(separation) = table.number(&SEPARATION)? {
        thickness.separation = separation;
    }
    Ok(thickness)
}

pub(super) fn check(Thickness { thickness, separation }: &Thickness) -> Result<(), ValueError> {
    THICKNESS.check(*thickness)?;
    SEPARATION.check(*separation)?;
    if *separation <= 0.9 * thickness {
        return Ok(());
    }
    let message = format!("`separation` is {separation} m, but must be at most nine tenths of the thickness, {thickness} m");
    Err(ValueError::new(SEPARATION.name, message))
}

/// Returns both distances as settings of an effect.
pub(super) fn settings(of: &Thickness) -> Vec<(&'static str, String)> {
    vec![
        ("thickness", LENGTH.written_short(of.thickness)),
        ("separation", LENGTH.written_short(of.separation)),
    ]
}
