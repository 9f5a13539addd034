//! Scenes and mesh files that come from JavaScript.

use crate::numbers::{Bytes, Text, bytes, keys, short, text};
use crate::values::{Exception, Files, array, floats, get, object, whole_numbers};
use js_sys::Uint8Array;
use selvedge_cloth::Scene;
use selvedge_cloth::files::FileSource;
use selvedge_cloth::files::mesh::{FileFormat, read_bytes};
use std::collections::BTreeMap;
use std::path::Path;
use wasm_bindgen::{JsCast, JsValue, prelude::wasm_bindgen};

/// Reads a scene; its name in messages is `scene.toml`.
pub(crate) fn scene_of(scene: &Text, files: &Files) -> Result<Scene, Exception> {
    let scene = text(scene, "text")?;
    let mut given = BTreeMap::new();
    let names = if files.is_undefined() || files.is_null() {
        Vec::new()
    } else {
        keys(files, "files")?
    };
    for name in names {
        let file = get(files, &name).unwrap_or(JsValue::UNDEFINED);
        let read = match (file.is_instance_of::<Uint8Array>(), file.as_string()) {
            (true, _) => bytes(&file, &name)?,
            (false, Some(text)) => text.into_bytes(),
            (false, None) => {
                return Err(Exception::input(&format!(
                    "files: the file '{}' must be a Uint8Array or a string",
                    short(&name)
                )));
            }
        };
        given.insert(name.into(), read);
    }
    let scene = Scene::parse_with_files(&scene, Path::new("scene.toml"), &FileSource::Memory(given));
    scene.map_err(|error| Exception::new("SceneError", &error))
}

/// Returns the names of the effects that a scene calls for, in the order in which they run.
#[wasm_bindgen(js_name = effectNames)]
pub fn effect_names(text: &Text, files: &Files) -> Result<Vec<String>, Exception> {
    Ok(scene_of(text, files)?.effect_names().into_iter().map(str::to_owned).collect())
}

/// Reads a mesh file: OBJ, PLY, STL, OFF or glTF, as its name says. Throws a `MeshError` that names the place.
#[wasm_bindgen(js_name = readMesh, unchecked_return_type = "{ positions: Float64Array; triangles: Uint32Array }")]
pub fn read_mesh(name: &Text, bytes: &Bytes) -> Result<JsValue, Exception> {
    let name = text(name, "name")?;
    let bytes = self::bytes(bytes, "bytes")?;
    let error = |words: &dyn ToString| Exception::new("MeshError", &format!("{}: {}", short(&name), words.to_string()));
    let format = FileFormat::from_path(Path::new(&name))
        .ok_or_else(|| error(&format!("its ending must be {}", FileFormat::extensions_in_words())))?;
    let mesh = read_bytes(&bytes, format).map_err(|problem| error(&problem))?.mesh;
    let positions: Vec<f64> = mesh.positions.iter().flat_map(|position| position.to_array()).collect();
    let properties = [
        ("positions", floats(&positions)),
        ("triangles", whole_numbers(mesh.triangles.as_flattened())),
    ];
    Ok(object(properties).into())
}

/// Returns a range of vertices as two numbers, the second exclusive.
pub(crate) fn range(vertices: std::ops::Range<usize>) -> JsValue {
    array([vertices.start as u32, vertices.end as u32])
}
