//! A simulation as one animated glTF file (`.glb`), which Blender and web viewers open.
//!
//! The mesh has the first frame's positions and one morph target for each later frame; an animation goes from one to the next.
//! Cloth and bodies are two primitives with their own materials.

use crate::simulation::Recording;
use serde_json::{Value, json};

/// Component types and targets of the glTF specification.
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// The bytes of the file.
///
/// # Panics
/// Without a frame.
#[must_use]
pub fn animated_gltf(recording: &Recording) -> Vec<u8> {
    let (first, later) = recording
        .frames
        .split_first()
        .expect("a recording begins with a frame");
    let mut buffer = Buffer::default();
    let base = buffer.positions(&first.positions);
    let targets: Vec<Value> = later
        .iter()
        .map(|frame| {
            let pairs = frame.positions.iter().zip(&first.positions);
            let moved: Vec<_> = pairs
                .map(|(now, then)| [0, 1, 2].map(|k| now[k] - then[k]))
                .collect();
            json!({"POSITION": buffer.positions(&moved)})
        })
        .collect();
    let (cloth, bodies) = recording.triangles.split_at(recording.cloth_triangles);
    let mut primitives = Vec::new();
    for (material, triangles) in [cloth, bodies].into_iter().enumerate() {
        if !triangles.is_empty() {
            let mut primitive = json!({
                "attributes": {"POSITION": base},
                "indices": buffer.indices(triangles),
                "material": material,
            });
            if !targets.is_empty() {
                primitive["targets"] = json!(targets);
            }
            primitives.push(primitive);
        }
    }
    let mut document = json!({
        "asset": {"version": "2.0", "generator": "selvedge"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "name": recording.name}],
        "materials": [
            material("cloth", [0.25, 0.45, 0.8, 1.0]),
            material("body", [0.6, 0.6, 0.6, 1.0]),
        ],
    });
    document["meshes"] = json!([{"primitives": primitives}]);
    if !later.is_empty() {
        let times: Vec<f32> = recording
            .frames
            .iter()
            .map(|frame| frame.time as f32)
            .collect();
        let input = buffer.scalars(&times);
        // At frame k all of target k − 1 and nothing of the others.
        let weights = (0..=later.len()).flat_map(|frame| {
            (1..=later.len()).map(move |target| f32::from(u8::from(frame == target)))
        });
        let output = buffer.scalars(&weights.collect::<Vec<_>>());
        document["meshes"][0]["weights"] = json!(vec![0.0; later.len()]);
        document["animations"] = json!([{
            "name": recording.name,
            "samplers": [{"input": input, "output": output, "interpolation": "LINEAR"}],
            "channels": [{"sampler": 0, "target": {"node": 0, "path": "weights"}}],
        }]);
    }
    document["accessors"] = buffer.accessors.into();
    document["bufferViews"] = buffer.views.into();
    document["buffers"] = json!([{"byteLength": buffer.bytes.len()}]);
    binary(&document, &buffer.bytes)
}

fn material(name: &str, colour: [f64; 4]) -> Value {
    json!({
        "name": name,
        "doubleSided": true,
        "pbrMetallicRoughness": {"baseColorFactor": colour, "metallicFactor": 0.0, "roughnessFactor": 0.9},
    })
}

/// The binary container: a header, the document, the buffer, each padded to four bytes.
fn binary(document: &Value, buffer: &[u8]) -> Vec<u8> {
    let mut text = document.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut data = buffer.to_vec();
    data.resize(data.len().next_multiple_of(4), 0);
    let length = 12 + 8 + text.len() + 8 + data.len();
    let mut bytes = Vec::with_capacity(length);
    bytes.extend(b"glTF");
    bytes.extend(2_u32.to_le_bytes());
    bytes.extend((length as u32).to_le_bytes());
    for (kind, chunk) in [(b"JSON", text), (b"BIN\0", data)] {
        bytes.extend((chunk.len() as u32).to_le_bytes());
        bytes.extend(kind);
        bytes.extend(chunk);
    }
    bytes
}

/// The binary data, and what describes it.
#[derive(Default)]
struct Buffer {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Buffer {
    /// Returns the number of the accessor.
    fn positions(&mut self, positions: &[[f32; 3]]) -> usize {
        let extreme = |pick: fn(f32, f32) -> f32, from: f32| {
            let pick = |a: [f32; 3], b: &[f32; 3]| [0, 1, 2].map(|k| pick(a[k], b[k]));
            positions.iter().fold([from; 3], pick)
        };
        let limits = [extreme(f32::min, f32::MAX), extreme(f32::max, f32::MIN)];
        let numbers = positions.iter().flatten().flat_map(|x| x.to_le_bytes());
        self.bytes.extend(numbers);
        let accessor = self.accessor(FLOAT, "VEC3", positions.len(), 12, Some(ARRAY_BUFFER));
        self.accessors[accessor]["min"] = json!(limits[0]);
        self.accessors[accessor]["max"] = json!(limits[1]);
        accessor
    }

    fn indices(&mut self, triangles: &[[u32; 3]]) -> usize {
        self.bytes.extend(
            triangles
                .iter()
                .flatten()
                .flat_map(|vertex| vertex.to_le_bytes()),
        );
        self.accessor(
            UNSIGNED_INT,
            "SCALAR",
            3 * triangles.len(),
            4,
            Some(ELEMENT_ARRAY_BUFFER),
        )
    }

    fn scalars(&mut self, numbers: &[f32]) -> usize {
        self.bytes
            .extend(numbers.iter().flat_map(|x| x.to_le_bytes()));
        let accessor = self.accessor(FLOAT, "SCALAR", numbers.len(), 4, None);
        let [least, greatest] =
            [f32::min, f32::max].map(|pick| numbers.iter().copied().reduce(pick));
        self.accessors[accessor]["min"] = json!([least]);
        self.accessors[accessor]["max"] = json!([greatest]);
        accessor
    }

    /// Describes the last `count` elements of `size` bytes.
    fn accessor(
        &mut self,
        component: u32,
        kind: &str,
        count: usize,
        size: usize,
        target: Option<u32>,
    ) -> usize {
        let length = count * size;
        let mut view =
            json!({"buffer": 0, "byteOffset": self.bytes.len() - length, "byteLength": length});
        if let Some(target) = target {
            view["target"] = target.into();
        }
        self.views.push(view);
        self.accessors.push(json!({
            "bufferView": self.views.len() - 1,
            "componentType": component,
            "count": count,
            "type": kind,
        }));
        self.accessors.len() - 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulation::{Scene, Simulation};
    use std::path::Path;

    fn recording(frames: usize) -> Recording {
        let text = r#"
            time_step = 0.01
            duration = 1
            [cloth]
            shape = "sheet"
            sides = { first = [1, 0, 0], second = [0, 1, 0] }
            cells = [2, 2]
            density = 1
            [[body]]
            name = "ball"
            shape = "ball"
            centre = [0, 0, 3]
            radius = 1
            [effects.gravity]
        "#;
        let scene = Scene::parse(text, Path::new("s.toml")).unwrap();
        let mut simulation = Simulation::new(scene, 1).unwrap();
        let mut recording = Recording::new(&simulation);
        for _ in 1..frames {
            simulation.step().unwrap();
            recording.add(&simulation);
        }
        recording
    }

    #[test]
    fn the_file_is_valid_and_holds_every_frame() {
        for frames in [1, 4] {
            let recording = recording(frames);
            // Checks the document against the specification.
            let file = gltf::Gltf::from_slice(&animated_gltf(&recording)).unwrap();
            let blob = file.blob.as_deref().unwrap();
            let mesh = file.meshes().next().unwrap();
            assert_eq!(mesh.primitives().len(), 2);
            for primitive in mesh.primitives() {
                let reader = primitive.reader(|_| Some(blob));
                let base: Vec<_> = reader.read_positions().unwrap().collect();
                assert_eq!(base, recording.frames[0].positions);
                let targets: Vec<_> = reader.read_morph_targets().collect();
                assert_eq!(targets.len(), frames - 1);
                for ((moved, ..), frame) in targets.into_iter().zip(&recording.frames[1..]) {
                    for (k, moved) in moved.unwrap().enumerate() {
                        let now = base[k][2] + moved[2];
                        assert!((now - frame.positions[k][2]).abs() < 1e-6);
                    }
                }
            }
            assert_eq!(file.animations().len(), usize::from(frames > 1));
        }
    }
}
