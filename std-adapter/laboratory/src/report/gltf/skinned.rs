//! The walker as a skinned figure with an animation.

use super::binary::Binary;
use super::{BODY, TooLarge};
use crate::scene::Walker;
use selvedge_core::glam::{DQuat, DVec3};
use serde_json::{Value, json};

/// Keys a second.
const RATE: u32 = 30;

/// The bytes of a `.glb` file with the figure alone, its bones, and the animation `walk`.
///
/// # Errors
/// If the file would be larger than the format allows.
pub fn walker(walker: &Walker) -> Result<Vec<u8>, TooLarge> {
    let mut binary = Binary::default();
    let bones = walker.bones();
    let single = |vector: DVec3| vector.as_vec3().to_array();
    let body = walker.body();
    let positions: Vec<[f32; 3]> = body.positions.iter().map(|&position| single(position)).collect();
    let influences = walker.influences();
    let primitive = json!({
        "attributes": {
            "POSITION": binary.add_vectors(&positions),
            "JOINTS_0": binary.add_joints(influences.iter().map(|own| own.map(|(bone, _)| bone))),
            "WEIGHTS_0": binary.add_weights(influences.iter().map(|own| own.map(|(_, weight)| weight))),
        },
        "indices": binary.add_indices(&body.triangles),
        "material": 0,
    });
    let inverses = bones.map(|bone| {
        let [x, y, z] = single(-bone.joint);
        [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, x, y, z, 1.0]
    });
    let inverses = binary.add_items("MAT4", &inverses);
    let above = |bone: usize| bones[bone].parent.map_or(DVec3::ZERO, |parent| bones[parent].joint);
    let mut nodes: Vec<Value> = (0..bones.len())
        .map(|index| {
            let own = json!({"name": bones[index].name, "translation": single(bones[index].joint - above(index))});
            let children: Vec<usize> = (0..bones.len()).filter(|&child| bones[child].parent == Some(index)).collect();
            with_children(own, children)
        })
        .collect();
    nodes.push(json!({"name": "figure", "mesh": 0, "skin": 0}));
    let figure = nodes.len() - 1;

    let keys = (Walker::DURATION * f64::from(RATE)) as u32;
    let seconds: Vec<f64> = (0..=keys).map(|key| f64::from(key) / f64::from(RATE)).collect();
    let input = binary.add_numbers(&seconds.iter().map(|&time| time as f32).collect::<Vec<_>>());
    let (mut samplers, mut channels) = (Vec::new(), Vec::new());
    let mut add = |output: usize, node: usize, path: &str| {
        channels.push(json!({"sampler": samplers.len(), "target": {"node": node, "path": path}}));
        samplers.push(json!({"input": input, "output": output, "interpolation": "LINEAR"}));
    };
    let moved: Vec<[f32; 3]> = { seconds.iter() }
        .map(|&time| single(bones[0].joint + walker.moved(time)))
        .collect();
    add(binary.add_items("VEC3", &moved), 0, "translation");
    for bone in 0..bones.len() {
        let turn = |&time: &f64| rotation(walker.turns(time)[bone]).to_array().map(|number| number as f32);
        let turns: Vec<[f32; 4]> = seconds.iter().map(turn).collect();
        add(binary.add_items("VEC4", &turns), bone, "rotation");
    }
    let document = json!({
        "asset": {"version": "2.0", "generator": concat!("selvedge ", env!("CARGO_PKG_VERSION"))},
        "scene": 0,
        "scenes": [{"name": "walker", "nodes": [0, figure]}],
        "nodes": nodes,
        "meshes": [{"name": "figure", "primitives": [primitive]}],
        "skins": [{"joints": (0..bones.len()).collect::<Vec<_>>(), "inverseBindMatrices": inverses, "skeleton": 0}],
        "animations": [{"name": "walk", "samplers": samplers, "channels": channels}],
        "materials": [BODY.json()],
    });
    binary.into_file(document)
}

fn with_children(mut node: Value, children: Vec<usize>) -> Value {
    // A list of no children is not allowed.
    if !children.is_empty() {
        node["children"] = children.into();
    }
    node
}

/// About x, then y, then z.
fn rotation(angles: DVec3) -> DQuat {
    // The same bits on every platform.
    let about = |axis: DVec3, angle: f64| {
        let along = axis * libm::sin(0.5 * angle);
        DQuat::from_xyzw(along.x, along.y, along.z, libm::cos(0.5 * angle))
    };
    about(DVec3::Z, angles.z) * about(DVec3::Y, angles.y) * about(DVec3::X, angles.x)
}
