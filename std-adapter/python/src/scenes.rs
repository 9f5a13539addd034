//! Scenes for simulations: from files, and from dicts with meshes as arrays.

use crate::arrays::indices;
use crate::driven::copied_as;
use crate::errors::{self, SceneError as PySceneError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{Mesh, NamedMesh, Scene, SceneContext, SceneError};
use std::path::{Path, PathBuf};

/// The name of a scene without a file, in messages.
pub(crate) const NAME: &str = "scene.toml";

/// Reads a scene file. Code decides when the scene ends.
pub(crate) fn of_file(path: &Path) -> Result<Scene, SceneError> {
    let context = SceneContext {
        is_run_by_code: true,
        ..SceneContext::default()
    };
    Scene::read_in(path, &context)
}

/// Makes a scene of dicts. Messages name the path of a field, since nobody sees the text.
pub(crate) fn of_dict(scene: &Bound<'_, PyDict>, folder: Option<PathBuf>) -> PyResult<Scene> {
    let module = scene.py().import("selvedge._scenes")?;
    let (text, meshes): (String, Vec<Bound<'_, PyDict>>) = module.call_method1("text_of", (scene,))?.extract()?;
    let context = SceneContext {
        meshes: meshes.iter().map(mesh).collect::<PyResult<_>>()?,
        is_run_by_code: true,
        ..SceneContext::default()
    };
    let path = folder.unwrap_or_default().join(NAME);
    Scene::parse_in(&text, &path, &context).map_err(|error| {
        let message = match error.field(&text) {
            Some(field) => format!("{field}: {}", error.message),
            None => error.message,
        };
        PySceneError::new_err(message)
    })
}

/// Converts the arrays of a mesh, which `_scenes.py` has collected.
fn mesh(arrays: &Bound<'_, PyDict>) -> PyResult<NamedMesh> {
    let get = |key: &str| Ok::<_, PyErr>(arrays.get_item(key)?.filter(|value| !value.is_none()));
    let name: String = get("name")?.map_or(Ok(String::new()), |name| name.extract())?;
    let place = |key: &str| format!("{name}.{key}");
    let positions = |key: &str| get(key)?.map(|array| copied_as(&array, &place(key))).transpose();
    let mut frames: Vec<Vec<DVec3>> = Vec::new();
    if let Some(array) = get("frames")? {
        for frame in array.try_iter()? {
            frames.push(copied_as(&frame?, &place("frames"))?);
        }
        if frames.is_empty() {
            return Err(errors::InputError::new_err(format!(
                "{}: there are no frames",
                place("frames")
            )));
        }
    }
    let triangles = get("faces")?.map(|faces| indices::<3>(&faces, &place("faces"))).transpose()?;
    let edges = get("edges")?.map(|edges| indices::<2>(&edges, &place("edges"))).transpose()?;
    let start = positions("positions")?.or_else(|| frames.first().cloned());
    Ok(NamedMesh {
        mesh: Mesh::new(start.unwrap_or_default(), triangles.unwrap_or_default()),
        loose_edges: edges.unwrap_or_default(),
        rest: positions("rest_positions")?,
        frames,
        name,
    })
}
