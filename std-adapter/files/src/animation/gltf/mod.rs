//! Figures of glTF 2.0 files. The `gltf` crate reads and validates the JSON half. This module reads the bytes that it points to
//! and checks every range, which that crate's own readers do not.

mod accessor;
mod buffers;
mod choose;
mod lenient;
mod mesh;
mod skeleton;
mod tracks;
mod trusted;

use super::Choice;
use super::figure::{Figure, Part, Shape, Skin, Target};
use crate::bytes::Fingerprint;
use crate::excerpt::excerpt;
use crate::mesh::LeftOut;
use crate::mesh::checks::check_finite;
use crate::problem::AnimationProblem;
use crate::problem::FileProblem;
use mesh::Parts;
use selvedge::Mesh;
use selvedge_core::glam::DAffine3;
use std::borrow::Cow;
use std::fmt::Display;
use std::path::Path;

pub(crate) fn parse(bytes: &[u8], path: &Path, choice: &Choice<'_>) -> Result<Figure, AnimationProblem> {
    if bytes.is_empty() {
        return Err(FileProblem::Empty.into());
    }
    let trailing = trusted::check_length(bytes)?;
    // Messages of serde quote texts of the file whole.
    let invalid = |error: &dyn Display| AnimationProblem::NotGltf(excerpt(&error.to_string(), 200));
    let (json, blob) = if bytes.starts_with(b"glTF") {
        let glb = gltf::binary::Glb::from_slice(bytes).map_err(|error| invalid(&error))?;
        (glb.json, glb.bin.map(Cow::into_owned))
    } else {
        let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        (Cow::Borrowed(text), None)
    };
    let mut root: serde_json::Value = serde_json::from_slice(&json).map_err(|error| invalid(&error))?;
    let mut left_out = lenient::reduce(&mut root)?;
    left_out.extend(trailing);
    let root: gltf::json::Root = serde_json::from_value(root).map_err(|error| invalid(&error))?;
    trusted::check_indices(&root)?;
    let document = gltf::Document::from_json(root).map_err(|error| invalid(&error))?;
    let buffers = buffers::read(&document, blob, path)?;
    let mut fingerprint = Fingerprint::default();
    fingerprint.take(bytes);
    buffers.iter().for_each(|buffer| fingerprint.take(buffer));
    let file = File {
        nodes: document.nodes().collect(),
        document: &document,
        buffers: &buffers,
    };
    let nodes = file.choose_nodes(choice.node)?;
    let animation = file.choose_animation(choice)?;
    nodes.iter().for_each(|node| fingerprint.take(&node.index().to_le_bytes()));
    let number = animation.as_ref().map_or(usize::MAX, gltf::Animation::index);
    fingerprint.take(&number.to_le_bytes());
    let (shape, triangles) = file.shape(&nodes, animation.as_ref(), &mut left_out)?;
    let mut figure = Figure {
        mesh: Mesh::new(Vec::new(), triangles),
        shape,
        left_out,
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

struct File<'a> {
    document: &'a gltf::Document,
    nodes: Vec<gltf::Node<'a>>,
    buffers: &'a [Vec<u8>],
}

impl<'a> File<'a> {
    fn shape(
        &self,
        wanted: &[gltf::Node<'a>],
        animation: Option<&gltf::Animation<'a>>,
        left_out: &mut Vec<LeftOut>,
    ) -> Result<(Shape, Vec<[u32; 3]>), AnimationProblem> {
        let mut needed: Vec<usize> = wanted.iter().map(gltf::Node::index).collect();
        let skins = wanted.iter().filter_map(gltf::Node::skin);
        needed.extend(skins.flat_map(|skin| skin.joints().map(|joint| joint.index()).collect::<Vec<_>>()));
        let (nodes, places) = self.skeleton(needed)?;
        let (mut triangles, mut parts, mut first) = (Vec::new(), Vec::new(), 0);
        for node in wanted {
            let mut read = Parts::default();
            let part = self.part(node, &places, &mut read, left_out)?;
            triangles.extend(read.triangles.iter().map(|corners| corners.map(|vertex| vertex + first)));
            first += part.rest.len() as u32;
            parts.push(part);
        }
        let mut shape = Shape {
            nodes,
            tracks: Vec::new(),
            parts,
            span: [0.0; 2],
            placement: DAffine3::IDENTITY,
        };
        if let Some(animation) = animation {
            let targets = wanted
                .iter()
                .zip(&shape.parts)
                .map(|(node, part)| (node.index(), part.targets.len()));
            shape.tracks = self.tracks(animation, &targets.collect::<Vec<_>>(), &places)?;
            shape.span = self.span(animation)?;
        }
        Ok((shape, triangles))
    }

    fn part(
        &self,
        node: &gltf::Node<'a>,
        places: &[Option<usize>],
        parts: &mut Parts,
        left_out: &mut Vec<LeftOut>,
    ) -> Result<Part, AnimationProblem> {
        let Some(mesh) = node.mesh() else {
            return Err(AnimationProblem::NoMesh);
        };
        let skin = node.skin();
        for primitive in mesh.primitives() {
            self.add(&primitive, skin.as_ref(), parts, left_out)?;
        }
        let weights = node.weights().or(mesh.weights()).unwrap_or_default();
        if !weights.iter().all(|weight| weight.is_finite()) {
            return Err(wrong("the weights of the morph targets", "one is not finite"));
        }
        let targets = std::mem::take(&mut parts.targets).into_iter().enumerate();
        let targets = targets.map(|(index, moves)| Target {
            weight: weights.get(index).map_or(0.0, |&weight| f64::from(weight)),
            moves,
        });
        let skin = match &skin {
            None => None,
            Some(skin) => Some(Skin {
                joints: self.joints(skin, places)?,
                ends: std::mem::take(&mut parts.ends),
                influences: std::mem::take(&mut parts.influences),
            }),
        };
        Ok(Part {
            targets: targets.collect(),
            rest: std::mem::take(&mut parts.positions),
            node: places[node.index()].unwrap_or_default(),
            skin,
        })
    }
}

/// Returns an error about invalid numbers and their owner.
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
