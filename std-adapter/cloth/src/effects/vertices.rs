//! Vertices of a cloth in a scene file: a named part, or numbers in the cloth's mesh.

use crate::input::{Count, SceneError, Table, suggestion};
use crate::world::SceneParts;

/// Reads the vertices that `part` or `vertices` names. If there are several cloths, `cloth` says which one.
pub(super) fn of_cloth(table: &Table<'_>, world: &SceneParts<'_>) -> Result<Vec<u32>, SceneError> {
    let index = named_cloth(table, world)?;
    let cloth = &world.cloths[index];
    let own = match table.text("part")? {
        Some(part) => cloth
            .named_part(part)
            .map_err(|message| table.error("part", message))?
            .to_vec(),
        None => {
            let last = cloth.mesh().positions.len() as u32 - 1;
            table.counts(&Count::new("vertices", 0, last))?.unwrap_or_default()
        }
    };
    let first = world
        .vertices_of_cloths()
        .nth(index)
        .map_or(0, |vertices| vertices.start as u32);
    Ok(own.into_iter().map(|vertex| first + vertex).collect())
}

/// Returns the index of the cloth that `cloth` names, or of the only one.
pub(super) fn named_cloth(table: &Table<'_>, world: &SceneParts<'_>) -> Result<usize, SceneError> {
    let names = || world.cloths.iter().map(|cloth| cloth.name.as_str());
    match table.text("cloth")? {
        None if world.cloths.len() == 1 => Ok(0),
        None => {
            let message = format!(
                "the scene has several cloths: choose one with `cloth`{}",
                suggestion("", names())
            );
            Err(table.error("cloth", message))
        }
        Some(name) => names().position(|own| own == name).ok_or_else(|| {
            let message = format!("there is no cloth '{name}'{}", suggestion(name, names()));
            table.error("cloth", message)
        }),
    }
}

/// Returns the message about a vertex that no cloth has.
pub(super) fn no_vertex(vertex: u32, count: usize) -> String {
    format!("the scene has no vertex {vertex} of cloth: it has {count}, numbered from 0")
}
