//! A simulation as one animated glTF 2.0 file (`.glb`), which Blender and most viewers open.
//!
//! Each part is a mesh, with normals. Its first frame is its shape, every later frame a morph target (Blender: a shape key), and an animation
//! of their weights leads from each frame to the next; positions in between are interpolated along straight lines. Of bodies that keep
//! their shape nodes are animated instead, by turns and shifts; parts that never move have neither.
//!
//! Written with `serde_json` alone: what is needed of the format is a page, the types of `gltf-json` would be three more
//! dependencies and no shorter. The tests read it back with the `gltf` crate, which validates it.

mod binary;
mod rigid;
mod skinned;
#[cfg(test)]
mod tests;

use super::colours::{CLOTHS, of_cloths};
use super::recording::{Frame, Part, PartKind, Recording};
use binary::Binary;
use rigid::{Pose, poses};
use selvedge_cloth::vertex_normals;
use selvedge_core::glam::{DQuat, DVec3};
use serde_json::{Value, json};
pub use skinned::walker;

/// The format numbers bytes by a `u32`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("an animation of {0} bytes does not fit into a glTF file, which holds 4 GiB; record fewer frames")]
pub struct TooLarge(pub u64);

/// Weights take the square of the frames, and programs slow down with the number of targets.
const MOST_FRAMES: usize = 600;

/// The bytes of a `.glb` file.
///
/// Times begin at 0 with the first frame. Of more than 600 frames, evenly chosen ones and the last are written. y is up in glTF:
/// one node above all parts turns the scene's up direction there.
///
/// # Errors
/// If the file would be larger than the format allows.
pub fn binary(recording: &Recording) -> Result<Vec<u8>, TooLarge> {
    let frames = chosen(&recording.frames);
    let mut binary = Binary::default();
    let (mut nodes, mut meshes) = (Vec::new(), Vec::new());
    let (mut deforming, mut rigid) = (Vec::new(), Vec::new());
    let colours = of_cloths(&recording.parts);
    let parts = recording.placed_parts().zip(colours);
    for ((first, part), colour) in parts.filter(|((_, part), _)| !part.triangles().is_empty()) {
        let vertices = first..first + part.vertex_count();
        let shape = |frame: &Frame| frame.positions[vertices.clone()].to_vec();
        let rest = shape(frames[0]);
        let moves = frames.iter().any(|frame| frame.positions[vertices.clone()] != rest);
        let in_frames: Vec<&[[f32; 3]]> = frames.iter().map(|frame| &frame.positions[vertices.clone()]).collect();
        let keeps_shape = moves && part.kind() == PartKind::Body;
        let poses = keeps_shape.then(|| poses(&in_frames)).flatten();
        let later = if moves && poses.is_none() { &frames[1..] } else { &[] };
        match poses {
            Some(poses) => rigid.push((nodes.len(), poses)),
            None if moves => deforming.push(nodes.len()),
            None => {}
        }
        nodes.push(json!({"name": part.name(), "mesh": meshes.len()}));
        let up = recording.up();
        meshes.push(mesh(
            &mut binary,
            part,
            colour,
            &rest,
            later.iter().map(|frame| (frame.step, shape(frame))),
            up,
        ));
    }
    let root = nodes.len();
    let turn = DQuat::from_rotation_arc(recording.up(), DVec3::Y);
    nodes.push(json!({
        "name": recording.about.name,
        "rotation": turn.to_array().map(|number| number as f32),
        "children": (0..root).collect::<Vec<_>>(),
    }));
    let mut document = json!({
        "asset": {"version": "2.0", "generator": concat!("selvedge ", env!("CARGO_PKG_VERSION"))},
        "scene": 0,
        "scenes": [{"name": recording.about.name, "nodes": [root]}],
        "nodes": nodes,
        "materials": materials(&recording.parts),
    });
    if root == 0 {
        // A list of no children is not allowed.
        document["nodes"][root].as_object_mut().map(|node| node.remove("children"));
    } else {
        document["meshes"] = meshes.into();
    }
    if !deforming.is_empty() || !rigid.is_empty() {
        document["animations"] = json!([animation(&mut binary, recording, &frames, &deforming, &rigid)]);
    }
    binary.into_file(document)
}

/// Every so many frames and the last, at most [`MOST_FRAMES`].
fn chosen(frames: &[Frame]) -> Vec<&Frame> {
    let stride = if frames.len() <= MOST_FRAMES {
        1
    } else {
        // One place is for the last.
        frames.len().div_ceil(MOST_FRAMES - 1)
    };
    let mut chosen: Vec<&Frame> = frames.iter().step_by(stride).collect();
    if !(frames.len() - 1).is_multiple_of(stride) {
        chosen.extend(frames.last());
    }
    chosen
}

/// A part in its first frame, and a target for each later one.
fn mesh(
    binary: &mut Binary,
    part: &Part,
    colour: Option<usize>,
    rest: &[[f32; 3]],
    later: impl Iterator<Item = (u64, Vec<[f32; 3]>)>,
    up: DVec3,
) -> Value {
    // What has no triangles to face anywhere faces up.
    let mut facing = Vec::new();
    let mut normals_of = |positions: &[[f32; 3]]| -> Vec<[f32; 3]> {
        let positions: Vec<_> = positions.iter().map(|p| DVec3::from(p.map(f64::from))).collect();
        vertex_normals(&positions, part.triangles(), &mut facing);
        let or_up = facing.iter().map(|&normal| if normal == DVec3::ZERO { up } else { normal });
        or_up.map(|normal| normal.as_vec3().to_array()).collect()
    };
    let normals = normals_of(rest);
    let (mut targets, mut names, mut weights) = (Vec::new(), Vec::new(), Vec::new());
    let indices = binary.add_indices(part.triangles());
    let attributes = json!({
        "POSITION": binary.add_vectors(rest),
        "NORMAL": binary.add_vectors(&normals),
    });
    for (step, positions) in later {
        targets.push(json!({
            "POSITION": binary.add_vectors(&differences(&positions, rest)),
            "NORMAL": binary.add_vectors(&differences(&normals_of(&positions), &normals)),
        }));
        names.push(format!("step {step}"));
        weights.push(0.0);
    }
    let mut primitive = json!({
        "attributes": attributes,
        "indices": indices,
        // That of bodies comes after the first cloth's.
        "material": colour.map_or(1, |colour| if colour == 0 { 0 } else { colour + 1 }),
    });
    let mut mesh = json!({"name": part.name()});
    if !targets.is_empty() {
        primitive["targets"] = targets.into();
        mesh["weights"] = weights.into();
        // Where Blender looks for the names of shape keys.
        mesh["extras"] = json!({"targetNames": names});
    }
    mesh["primitives"] = json!([primitive]);
    mesh
}

fn differences(to: &[[f32; 3]], from: &[[f32; 3]]) -> Vec<[f32; 3]> {
    let pairs = to.iter().zip(from);
    pairs.map(|(a, b)| [a[0] - b[0], a[1] - b[1], a[2] - b[2]]).collect()
}

/// At the time of frame k the weight of target k − 1 is 1 and all others are 0; the first frame has no target. Rigid parts have their poses.
fn animation(
    binary: &mut Binary,
    recording: &Recording,
    frames: &[&Frame],
    deforming: &[usize],
    rigid: &[(usize, Vec<Pose>)],
) -> Value {
    let start = recording.time(frames[0]);
    let times = frames.iter().map(|frame| (recording.time(frame) - start) as f32);
    let input = binary.add_numbers(&times.collect::<Vec<_>>());
    let (mut samplers, mut channels) = (Vec::new(), Vec::new());
    let mut add = |output: usize, path: &str, nodes: &[usize]| {
        let channel = |&node: &usize| json!({"sampler": samplers.len(), "target": {"node": node, "path": path}});
        channels.extend(nodes.iter().map(channel));
        samplers.push(json!({"input": input, "output": output, "interpolation": "LINEAR"}));
    };
    if !deforming.is_empty() {
        let targets = frames.len() - 1;
        let mut weights = vec![0.0; frames.len() * targets];
        for target in 0..targets {
            weights[(target + 1) * targets + target] = 1.0;
        }
        add(binary.add_numbers(&weights), "weights", deforming);
    }
    for (node, poses) in rigid {
        let rotations = poses.iter().map(|pose| pose.rotation.to_array().map(|number| number as f32));
        let rotations = binary.add_items("VEC4", &rotations.collect::<Vec<_>>());
        add(rotations, "rotation", &[*node]);
        let translations = poses.iter().map(|pose| pose.translation.as_vec3().to_array());
        let translations = binary.add_items("VEC3", &translations.collect::<Vec<_>>());
        add(translations, "translation", &[*node]);
    }
    json!({
        "name": recording.about.name,
        "samplers": samplers,
        "channels": channels,
    })
}

/// How a part looks, as the page shows it.
struct Material {
    name: &'static str,
    /// Red, green, blue, as linear light.
    colour: [f32; 3],
    both_sides: bool,
}

/// Of cloths, as many as the recording has colours for, and after the first that of bodies.
fn materials(parts: &[Part]) -> Vec<Value> {
    let cloth = |colour: usize| Material {
        name: ["cloth", "second cloth", "third cloth", "fourth cloth"][colour],
        colour: CLOTHS[colour].map(|light| light as f32),
        both_sides: true,
    };
    let last = of_cloths(parts).into_iter().flatten().max().unwrap_or(0);
    let mut materials: Vec<_> = (0..=last).map(|colour| cloth(colour).json()).collect();
    materials.insert(1, BODY.json());
    materials
}

const BODY: Material = Material {
    name: "body",
    colour: [0.47, 0.41, 0.36],
    both_sides: false,
};

impl Material {
    fn json(&self) -> Value {
        let [red, green, blue] = self.colour;
        json!({
            "name": self.name,
            "pbrMetallicRoughness": {
                "baseColorFactor": [red, green, blue, 1.0],
                "metallicFactor": 0.0,
                "roughnessFactor": 0.85,
            },
            "doubleSided": self.both_sides,
        })
    }
}
