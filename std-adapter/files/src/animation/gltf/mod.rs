//! Figures of glTF 2.0 files. The `gltf` crate reads and validates the JSON half; the bytes that it points to are read here, where every
//! range is checked: that crate's own readers trust it.

mod accessor;
mod buffers;
mod choose;
mod mesh;
mod skeleton;
mod tracks;
mod trusted;

use super::Choice;
use super::error::AnimationProblem;
use super::figure::{Figure, Shape, Skin, Target};
use crate::bytes::Fingerprint;
use crate::mesh::{FileProblem, check_finite};
use mesh::Parts;
use selvedge::Mesh;
use std::path::Path;

pub(super) fn parse(bytes: &[u8], path: &Path, choice: &Choice<'_>) -> Result<Figure, AnimationProblem> {
    if bytes.is_empty() {
        return Err(FileProblem::Empty.into());
    }
    trusted::check_length(bytes)?;
    let invalid = |error: gltf::Error| AnimationProblem::NotGltf(error.to_string());
    let gltf::Gltf { document, blob } = gltf::Gltf::from_slice_without_validation(bytes).map_err(invalid)?;
    let root = document.into_json();
    trusted::check_indices(&root)?;
    let document = gltf::Document::from_json(root).map_err(invalid)?;
    let buffers = buffers::read(&document, blob, path)?;
    let mut fingerprint = Fingerprint::default();
    fingerprint.take(bytes);
    buffers.iter().for_each(|buffer| fingerprint.take(buffer));
    let file = File {
        nodes: document.nodes().collect(),
        document: &document,
        buffers: &buffers,
    };
    let node = file.choose_node(choice.node)?;
    let animation = file.choose_animation(choice.animation)?;
    fingerprint.take(&node.index().to_le_bytes());
    fingerprint.take(&animation.index().to_le_bytes());
    let (shape, triangles) = file.shape(&node, &animation)?;
    let mut figure = Figure {
        mesh: Mesh {
            positions: Vec::new(),
            triangles,
        },
        shape,
        fingerprint: fingerprint.value(),
    };
    let [first, _] = figure.span();
    figure.shape.positions_at(first, &mut figure.mesh.positions);
    for (vertex, &position) in figure.mesh.positions.iter().enumerate() {
        check_finite(vertex, position, None)?;
    }
    figure.mesh.topology().map_err(FileProblem::from)?;
    Ok(figure)
}

/// A file that is looked into, with all its bytes.
struct File<'a> {
    document: &'a gltf::Document,
    nodes: Vec<gltf::Node<'a>>,
    buffers: &'a [Vec<u8>],
}

impl<'a> File<'a> {
    fn shape(&self, node: &gltf::Node<'a>, animation: &gltf::Animation<'a>) -> Result<(Shape, Vec<[u32; 3]>), AnimationProblem> {
        let Some(mesh) = node.mesh() else {
            return Err(AnimationProblem::NoMesh);
        };
        let mut parts = Parts::default();
        let skin = node.skin();
        for primitive in mesh.primitives() {
            self.add(&primitive, skin.as_ref(), &mut parts)?;
        }
        let weights = node.weights().or(mesh.weights()).unwrap_or_default();
        if !weights.iter().all(|weight| weight.is_finite()) {
            return Err(wrong("the weights of the morph targets", "one is not finite"));
        }
        let targets = parts.targets.into_iter().enumerate().map(|(index, moves)| Target {
            weight: weights.get(index).map_or(0.0, |&weight| f64::from(weight)),
            moves,
        });
        let targets: Vec<Target> = targets.collect();
        let joints: Vec<usize> = skin
            .iter()
            .flat_map(|skin| skin.joints())
            .map(|joint| joint.index())
            .collect();
        let (nodes, places) = self.skeleton(if joints.is_empty() {
            vec![node.index()]
        } else {
            joints.clone()
        })?;
        let skin = match &skin {
            None => None,
            Some(skin) => Some(Skin {
                joints: self.joints(skin, &joints, &places)?,
                ends: parts.ends,
                influences: parts.influences,
            }),
        };
        let tracks = self.tracks(animation, node.index(), targets.len(), &places)?;
        if tracks.is_empty() {
            return Err(AnimationProblem::NothingMoves {
                animation: short(animation.name().unwrap_or("without a name")),
                node: short(&label(node)),
            });
        }
        let shape = Shape {
            nodes,
            tracks,
            rest: parts.positions,
            targets,
            node: places[node.index()].unwrap_or_default(),
            skin,
        };
        Ok((shape, parts.triangles))
    }
}

/// Numbers that are not as they should be, of whom.
fn wrong(what: &str, reason: impl Into<String>) -> AnimationProblem {
    AnimationProblem::Values {
        what: what.to_owned(),
        reason: reason.into(),
    }
}

fn label(node: &gltf::Node<'_>) -> String {
    let mesh = node.mesh();
    let name = node.name().or(mesh.as_ref().and_then(|mesh| mesh.name()));
    name.map_or_else(|| format!("node {}", node.index()), str::to_owned)
}

fn short(name: &str) -> String {
    crate::excerpt::excerpt(name, 60)
}
