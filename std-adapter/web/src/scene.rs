//! Scenes and mesh files that come from JavaScript.

use crate::numbers::Bytes;
use crate::values::{Exception, Files, array, floats, object, whole_numbers};
use js_sys::{Array, Object, Uint8Array};
use selvedge_cloth::Scene;
use selvedge_cloth::files::FileSource;
use selvedge_cloth::files::mesh::{FileFormat, read_bytes};
use std::collections::BTreeMap;
use std::path::Path;
use wasm_bindgen::{JsCast, JsValue, prelude::wasm_bindgen};

/// Reads a scene; its name in messages is `scene.toml`.
pub(crate) fn scene_of(text: &str, files: &Files) -> Result<Scene, Exception> {
    let mut given = BTreeMap::new();
    if let Some(files) = files.dyn_ref::<Object>() {
        for entry in Object::entries(files).iter() {
            let entry: Array = entry.unchecked_into();
            let name = entry.get(0).as_string().unwrap_or_default();
            let file = entry.get(1);
            let bytes = match (file.dyn_ref::<Uint8Array>(), file.as_string()) {
                (Some(bytes), _) => bytes.to_vec(),
                (None, Some(text)) => text.into_bytes(),
                (None, None) => {
                    return Err(Exception::input(&format!(
                        "the file '{name}' must be a Uint8Array or a string"
                    )));
                }
            };
            given.insert(name.into(), bytes);
        }
    }
    let scene = Scene::parse_with_files(text, Path::new("scene.toml"), &FileSource::Memory(given));
    scene.map_err(|error| Exception::new("SceneError", &error))
}

/// Returns the names of the effects that a scene calls for, in the order in which they run.
#[wasm_bindgen(js_name = effectNames)]
pub fn effect_names(text: &str, files: &Files) -> Result<Vec<String>, Exception> {
    Ok(scene_of(text, files)?.effect_names().into_iter().map(str::to_owned).collect())
}

/// Reads a mesh file: OBJ, PLY, STL, OFF or glTF, as its name says. Throws a `MeshError` that names the place.
#[wasm_bindgen(js_name = readMesh, unchecked_return_type = "{ positions: Float64Array; triangles: Uint32Array }")]
pub fn read_mesh(name: &str, bytes: &Bytes) -> Result<JsValue, Exception> {
    let error = |words: &dyn ToString| Exception::new("MeshError", &format!("{name}: {}", words.to_string()));
    let format = FileFormat::from_path(Path::new(name))
        .ok_or_else(|| error(&format!("its ending must be {}", FileFormat::extensions_in_words())))?;
    let bytes = crate::numbers::bytes(bytes, "bytes")?;
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
