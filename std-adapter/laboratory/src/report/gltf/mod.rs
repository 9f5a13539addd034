//! Writes a simulation as one animated glTF 2.0 file (`.glb`), which Blender and most viewers open.
//!
//! Each part is a mesh with normals. Its first frame is its shape, and every later frame is a morph target (Blender: a shape
//! key). An animation of their weights leads from each frame to the next, along straight lines. Bodies that keep their shape have
//! animated nodes instead, with rotations and translations. Parts that never move have neither.
//!
//! The writer uses `serde_json` alone, because it needs little of the format. The tests read the file back with the `gltf` crate,
//! which validates it.

mod binary;
mod rigid;
#[cfg(test)]
mod tests;

use super::colours::{CLOTHS, cloth_colours};
use super::recording::{PartKind, RecordedFrame, RecordedPart, Recording};
use binary::Binary;
pub use binary::TooLarge;
use rigid::{Pose, poses};
use selvedge_cloth::vertex_normals;
use selvedge_core::glam::{DQuat, DVec3};
use serde_json::{Value, json};

/// The largest number of frames. The weights take the square of it, and programs slow down with the number of targets.
const MOST_FRAMES: usize = 600;

/// Returns the bytes of a `.glb` file.
///
/// Times begin at 0 with the first frame. If there are more than 600 frames, evenly chosen ones and the last are written. The
/// format's up direction is y, so one node above all parts turns the scene's up direction there.
///
/// # Errors
/// Returns an error if the file would be larger than the format allows.
pub fn binary(recording: &Recording) -> Result<Vec<u8>, TooLarge> {
    let frames = chosen(&recording.frames);
    let mut binary = Binary::default();
    let (mut nodes, mut meshes) = (Vec::new(), Vec::new());
    let (mut deforming, mut rigid) = (Vec::new(), Vec::new());
    let colours = cloth_colours(&recording.parts);
    let parts = recording.placed_parts().zip(colours);
    for ((first, part), colour) in parts.filter(|((_, part), _)| !part.triangles().is_empty()) {
        let vertices = first..first + part.vertex_count();
        let shape = |frame: &RecordedFrame| frame.positions[vertices.clone()].to_vec();
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
        // The format does not allow an empty list of children.
        document["nodes"][root].as_object_mut().map(|node| node.remove("children"));
    } else {
        document["meshes"] = meshes.into();
    }
    if !deforming.is_empty() || !rigid.is_empty() {
        document["animations"] = json!([animation(&mut binary, recording, &frames, &deforming, &rigid)]);
    }
    binary.into_file(document)
}

/// Returns evenly spaced frames and the last, at most [`MOST_FRAMES`].
fn chosen(frames: &[RecordedFrame]) -> Vec<&RecordedFrame> {
    let stride = if frames.len() <= MOST_FRAMES {
        1
    } else {
        // One place is for the last frame.
        frames.len().div_ceil(MOST_FRAMES - 1)
    };
    let mut chosen: Vec<&RecordedFrame> = frames.iter().step_by(stride).collect();
    if !(frames.len() - 1).is_multiple_of(stride) {
        chosen.extend(frames.last());
    }
    chosen
}

/// Writes a part in its first frame, and a target for each later one.
fn mesh(
    binary: &mut Binary,
    part: &RecordedPart,
    colour: Option<usize>,
    rest: &[[f32; 3]],
    later: impl Iterator<Item = (u64, Vec<[f32; 3]>)>,
    up: DVec3,
) -> Value {
    // A vertex without triangles gets a normal that points up.
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
        // The material of bodies comes after the first cloth's.
        "material": colour.map_or(1, |colour| if colour == 0 { 0 } else { colour + 1 }),
    });
    let mut mesh = json!({"name": part.name()});
    if !targets.is_empty() {
        primitive["targets"] = targets.into();
        mesh["weights"] = weights.into();
        // Blender reads the names of shape keys here.
        mesh["extras"] = json!({"targetNames": names});
    }
    mesh["primitives"] = json!([primitive]);
    mesh
}

fn differences(to: &[[f32; 3]], from: &[[f32; 3]]) -> Vec<[f32; 3]> {
    let pairs = to.iter().zip(from);
    pairs.map(|(a, b)| [a[0] - b[0], a[1] - b[1], a[2] - b[2]]).collect()
}

/// Returns the animation. At the time of frame k the weight of target k − 1 is 1, and others are 0; the first frame has no
/// target. Rigid parts have their poses.
fn animation(
    binary: &mut Binary,
    recording: &Recording,
    frames: &[&RecordedFrame],
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

/// The look of a part on the page.
struct Material {
    name: &'static str,
    /// The red, green and blue, as linear light.
    colour: [f32; 3],
    both_sides: bool,
}

/// Returns the materials of cloths, as many as the recording has colours for, with that of bodies after the first.
fn materials(parts: &[RecordedPart]) -> Vec<Value> {
    let cloth = |colour: usize| Material {
        name: ["cloth", "second cloth", "third cloth", "fourth cloth"][colour],
        colour: CLOTHS[colour].map(|light| light as f32),
        both_sides: true,
    };
    let last = cloth_colours(parts).into_iter().flatten().max().unwrap_or(0);
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
