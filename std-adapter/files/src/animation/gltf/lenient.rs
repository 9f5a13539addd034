//! Removes all but shapes and motion from the JSON half of a file before the `gltf` crate validates it. This drops looks, lights,
//! cameras, attributes of applications, and extensions for these, even if the file requires them.

use super::short;
use crate::mesh::{FilePart, LeftOut};
use crate::problem::AnimationProblem;
use serde_json::{Map, Value};

/// The beginnings of names of extensions that do not change the positions of vertices.
const IGNORED: [&str; 17] = [
    "KHR_materials_",
    "KHR_texture_",
    "KHR_lights_",
    "KHR_xmp",
    "KHR_audio",
    "KHR_animation_pointer",
    "KHR_mesh_quantization",
    "KHR_techniques_webgl",
    "EXT_texture_",
    "EXT_lights_",
    "EXT_mesh_features",
    "EXT_mesh_manifold",
    "EXT_structural_metadata",
    "MSFT_texture_dds",
    "MSFT_packing_",
    "VRM",
    "ADOBE_materials_",
];

/// The parts of the root that no shape and no motion needs.
const LOOKS: [&str; 8] = [
    "extensionsRequired",
    "extensionsUsed",
    "extensions",
    "materials",
    "textures",
    "images",
    "samplers",
    "cameras",
];

/// Returns whether an attribute is read. The others are normals, colours, texture coordinates, or belong to an application.
fn is_read(attribute: &str) -> bool {
    attribute == "POSITION" || attribute.starts_with("JOINTS_") || attribute.starts_with("WEIGHTS_")
}

/// Removes the parts that are not read, and lists those that may matter.
///
/// # Errors
/// Returns an error if the file requires an extension without which its shapes or motion are not known.
pub(super) fn reduce(root: &mut Value) -> Result<Vec<LeftOut>, AnimationProblem> {
    let required = root.get("extensionsRequired").and_then(Value::as_array);
    let mut names = required.into_iter().flatten().filter_map(Value::as_str);
    if let Some(name) = names.find(|name| !IGNORED.iter().any(|ignored| name.starts_with(ignored))) {
        let (name, remedy) = (short(name), remedy(name));
        return Err(AnimationProblem::Extension { name, remedy });
    }
    let Some(root) = root.as_object_mut() else {
        return Ok(Vec::new());
    };
    root.retain(|key, _| !LOOKS.contains(&key.as_str()));
    let mut left_out = Vec::new();
    let mut leave_out = |part, name: &str, count: usize, may_have_area| {
        if count > 0 {
            left_out.push(LeftOut::new(part, name, count, None, may_have_area));
        }
    };
    let mut instances = 0;
    for node in objects(root, "nodes") {
        node.remove("camera");
        let extensions = node.remove("extensions");
        instances += usize::from(extensions.is_some_and(|all| all.get("EXT_mesh_gpu_instancing").is_some()));
    }
    leave_out(FilePart::Node, "EXT_mesh_gpu_instancing", instances, true);
    reduce_shapes(root);
    let mut channels = 0;
    for animation in objects(root, "animations") {
        animation.remove("extensions");
        if let Some(own) = animation.get_mut("channels").and_then(Value::as_array_mut) {
            let before = own.len();
            own.retain(moves_a_node);
            channels += before - own.len();
        }
    }
    leave_out(FilePart::Channel, "of something other than nodes", channels, false);
    Ok(left_out)
}

/// Leaves positions, joints and weights of the primitives alone.
fn reduce_shapes(root: &mut Map<String, Value>) {
    let mut shapes = Vec::new();
    for mesh in objects(root, "meshes") {
        mesh.remove("extensions");
        for primitive in objects(mesh, "primitives") {
            primitive.remove("material");
            primitive.remove("extensions");
            if let Some(attributes) = primitive.get_mut("attributes").and_then(Value::as_object_mut) {
                attributes.retain(|name, _| is_read(name));
                shapes.extend(attributes.get("POSITION").and_then(Value::as_u64));
            }
            for target in objects(primitive, "targets") {
                target.retain(|name, _| name == "POSITION");
            }
        }
    }
    // The format requires bounds of positions, but they are not used here.
    let accessors = root.get_mut("accessors").and_then(Value::as_array_mut);
    for accessor in accessors.into_iter().flatten().filter_map(Value::as_object_mut) {
        accessor.remove("extensions");
    }
    for shape in shapes {
        let accessor = root
            .get_mut("accessors")
            .and_then(|all| all.get_mut(usize::try_from(shape).unwrap_or(usize::MAX)));
        if let Some(accessor) = accessor.and_then(Value::as_object_mut) {
            for bound in ["min", "max"] {
                accessor.insert(bound.to_owned(), serde_json::json!([0.0, 0.0, 0.0]));
            }
        }
    }
}

/// Returns false for a channel without a node, or for a pointer, since these move something else.
fn moves_a_node(channel: &Value) -> bool {
    let target = channel.get("target");
    let path = target.and_then(|target| target.get("path")).and_then(Value::as_str);
    path != Some("pointer") && target.is_none_or(|target| target.get("node").is_some())
}

fn objects<'a>(of: &'a mut Map<String, Value>, list: &str) -> impl Iterator<Item = &'a mut Map<String, Value>> {
    let list = of.get_mut(list).and_then(Value::as_array_mut);
    list.into_iter().flatten().filter_map(Value::as_object_mut)
}

/// Returns how to convert a file that needs an extension.
fn remedy(name: &str) -> &'static str {
    match name {
        "KHR_draco_mesh_compression" => "decompress it: `npx gltf-pipeline -i in.glb -o out.glb`",
        "EXT_meshopt_compression" | "KHR_meshopt_compression" => "decompress it: `gltfpack -i in.glb -o out.glb -noq`",
        _ => "export it without",
    }
}
