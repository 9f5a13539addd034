//! Figures of glTF 2.0 files. The `gltf` crate reads and validates the JSON half; the bytes that it points to are read here, where every
//! range is checked: that crate's own readers trust it.

use super::Choice;
use super::error::{AnimationProblem, Choices};
use super::figure::{Figure, Local, Node, Shape, Skin, Target};
use super::track::{Interpolation, Property, Track};
use crate::bytes::Fingerprint;
use crate::mesh::{FileProblem, check_finite};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use gltf::accessor::{Accessor, DataType, Dimensions};
use gltf::buffer::{Source, View};
use gltf::json::validation::Checked;
use gltf::mesh::{Mode, Primitive, Semantic};
use gltf::scene::Transform;
use selvedge::Mesh;
use selvedge_core::glam::{DAffine3, DMat4, DQuat, DVec3};
use std::path::Path;

pub(super) fn parse(bytes: &[u8], path: &Path, choice: &Choice<'_>) -> Result<Figure, AnimationProblem> {
    if bytes.is_empty() {
        return Err(FileProblem::Empty.into());
    }
    check_length(bytes)?;
    let invalid = |error: gltf::Error| AnimationProblem::NotGltf(error.to_string());
    let gltf::Gltf { document, blob } = gltf::Gltf::from_slice_without_validation(bytes).map_err(invalid)?;
    let root = document.into_json();
    check_indices(&root)?;
    let document = gltf::Document::from_json(root).map_err(invalid)?;
    let buffers = buffers(&document, blob, path)?;
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

/// Whether a binary file is as long as it says: the `gltf` crate would take a length below that of the header for an enormous one.
fn check_length(bytes: &[u8]) -> Result<(), AnimationProblem> {
    if !bytes.starts_with(b"glTF") {
        return Ok(());
    }
    let length = bytes.get(8..12).and_then(|length| length.try_into().ok());
    let length = length.map_or(0, u32::from_le_bytes) as usize;
    if length < 12 || length > bytes.len() {
        let message = format!(
            "its header says that it has {length} bytes, but it has {}; is it complete?",
            bytes.len()
        );
        return Err(AnimationProblem::NotGltf(message));
    }
    Ok(())
}

/// Whether all attributes of primitives are there, which the `gltf` crate looks at before it asks, and all that animations name, which it does
/// not ask.
fn check_indices(root: &gltf::json::Root) -> Result<(), AnimationProblem> {
    let primitives = root.meshes.iter().flat_map(|mesh| &mesh.primitives);
    let missing = { primitives }
        .flat_map(|primitive| primitive.attributes.values())
        .find(|index| index.value() >= root.accessors.len());
    if let Some(index) = missing {
        let message = format!(
            "a primitive names accessor {}, but there are {}",
            index.value(),
            root.accessors.len()
        );
        return Err(AnimationProblem::NotGltf(message));
    }
    for animation in &root.animations {
        let is_there = |accessor: usize| accessor < root.accessors.len();
        let is_known = |sampler: &gltf::json::animation::Sampler| {
            matches!(sampler.interpolation, Checked::Valid(_))
                && is_there(sampler.input.value())
                && is_there(sampler.output.value())
        };
        let names_a_property = |channel: &gltf::json::animation::Channel| matches!(channel.target.path, Checked::Valid(_));
        if !animation.samplers.iter().all(is_known) || !animation.channels.iter().all(names_a_property) {
            let name = short(animation.name.as_deref().unwrap_or("without a name"));
            let message =
                format!("the animation '{name}' has a sampler or a channel of no known kind, or an accessor that is not there");
            return Err(AnimationProblem::NotGltf(message));
        }
    }
    let mut channels = root.animations.iter().flat_map(|animation| &animation.channels);
    if let Some(channel) = channels.find(|channel| channel.target.node.value() >= root.nodes.len()) {
        let node = channel.target.node.value();
        let message = format!("a channel moves node {node}, but there are {}", root.nodes.len());
        return Err(AnimationProblem::NotGltf(message));
    }
    Ok(())
}

/// The bytes of all buffers, each as long as the file says.
fn buffers(document: &gltf::Document, blob: Option<Vec<u8>>, path: &Path) -> Result<Vec<Vec<u8>>, AnimationProblem> {
    let mut blob = blob;
    let one = |buffer: gltf::Buffer<'_>| {
        let wrong = |reason: String| AnimationProblem::Buffer {
            buffer: buffer.index(),
            reason,
        };
        let mut bytes = match buffer.source() {
            Source::Bin => blob
                .take()
                .ok_or_else(|| wrong("is to be the file's binary part, but it has none".to_owned()))?,
            Source::Uri(uri) => match uri.strip_prefix("data:") {
                Some(data) => inline(data).map_err(wrong)?,
                None => {
                    let name = plain(uri);
                    let read = std::fs::read(path.parent().unwrap_or(Path::new("")).join(&name));
                    read.map_err(|error| wrong(format!("is the file '{}', which cannot be read: {error}", short(&name))))?
                }
            },
        };
        if bytes.len() < buffer.length() {
            let (found, said) = (bytes.len(), buffer.length());
            return Err(wrong(format!(
                "is to have {said} bytes, but has {found}; is the file complete?"
            )));
        }
        bytes.truncate(buffer.length());
        Ok(bytes)
    };
    document.buffers().map(one).collect()
}

/// The bytes of `TYPE;base64,TEXT`.
fn inline(data: &str) -> Result<Vec<u8>, String> {
    let text = data.split_once(";base64,").map(|(_, text)| text);
    let text = text.ok_or("is given in the file, but not in base64")?;
    STANDARD.decode(text).map_err(|error| format!("is no valid base64: {error}"))
}

/// A file's name with what is escaped in an URI (`%20`).
fn plain(uri: &str) -> String {
    let mut bytes = Vec::new();
    let mut rest = uri.as_bytes();
    while let Some((&first, after)) = rest.split_first() {
        let code = after.get(..2).filter(|_| first == b'%');
        let code = code.and_then(|code| u8::from_str_radix(std::str::from_utf8(code).ok()?, 16).ok());
        bytes.push(code.unwrap_or(first));
        rest = if code.is_some() { &after[2..] } else { after };
    }
    String::from_utf8(bytes).unwrap_or_else(|_| uri.to_owned())
}

fn short(name: &str) -> String {
    crate::excerpt::excerpt(name, 60)
}

struct File<'a> {
    document: &'a gltf::Document,
    nodes: Vec<gltf::Node<'a>>,
    buffers: &'a [Vec<u8>],
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

impl<'a> File<'a> {
    fn choose_node(&self, name: Option<&str>) -> Result<gltf::Node<'a>, AnimationProblem> {
        let mut with_mesh: Vec<_> = self.nodes.iter().filter(|node| node.mesh().is_some()).cloned().collect();
        let choices = |nodes: &[gltf::Node<'_>]| Choices(nodes.iter().map(label).collect());
        let all = choices(&with_mesh);
        if with_mesh.is_empty() {
            return Err(AnimationProblem::NoMesh);
        }
        if let Some(name) = name {
            let is_called = |node: &gltf::Node<'_>| label(node) == name || node.mesh().is_some_and(|m| m.name() == Some(name));
            with_mesh.retain(is_called);
        }
        match (with_mesh.len(), name) {
            (1, _) => Ok(with_mesh.remove(0)),
            (0, name) => Err(AnimationProblem::NoSuchNode {
                name: short(name.unwrap_or_default()),
                choices: all,
            }),
            _ => Err(AnimationProblem::SeveralNodes {
                choices: choices(&with_mesh),
            }),
        }
    }

    fn choose_animation(&self, name: Option<&str>) -> Result<gltf::Animation<'a>, AnimationProblem> {
        let label = |animation: &gltf::Animation<'_>| match animation.name() {
            Some(name) => name.to_owned(),
            None => format!("animation {}", animation.index()),
        };
        let mut all: Vec<_> = self.document.animations().collect();
        let choices = Choices(all.iter().map(label).collect());
        if all.is_empty() {
            return Err(AnimationProblem::NoAnimation);
        }
        all.retain(|animation| name.is_none_or(|name| label(animation) == name));
        match (all.len(), name) {
            (1, _) => Ok(all.remove(0)),
            (0, name) => Err(AnimationProblem::NoSuchAnimation {
                name: short(name.unwrap_or_default()),
                choices,
            }),
            _ => Err(AnimationProblem::SeveralAnimations { choices }),
        }
    }

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

    /// Adds the triangles and vertices of a primitive.
    fn add(&self, primitive: &Primitive<'a>, skin: Option<&gltf::Skin<'a>>, parts: &mut Parts) -> Result<(), AnimationProblem> {
        let what = format!("primitive {} of the mesh", primitive.index());
        if primitive.mode() != Mode::Triangles {
            return Err(wrong(
                &what,
                format!("is of {:?}, but must be of triangles", primitive.mode()),
            ));
        }
        let positions = primitive
            .get(&Semantic::Positions)
            .ok_or_else(|| wrong(&what, "has no positions"))?;
        let positions = self.vectors(&positions, None, &format!("{what}, positions"))?;
        let (first, count) = (parts.positions.len(), positions.len());
        let indices = match primitive.indices() {
            None => (0..count as u32).map(f64::from).collect(),
            Some(indices) => self.numbers(&indices, Dimensions::Scalar, None, &format!("{what}, indices"))?,
        };
        if indices.len() % 3 != 0 {
            return Err(wrong(&what, format!("has {} indices, no multiple of three", indices.len())));
        }
        for (face, corners) in indices.chunks_exact(3).enumerate() {
            if let Some(&vertex) = corners.iter().find(|&&vertex| vertex >= count as f64) {
                let problem = FileProblem::IndexOutOfRange {
                    line: None,
                    face: parts.triangles.len() + face,
                    vertex: vertex as i64,
                    first: 0,
                    vertex_count: count,
                };
                return Err(problem.into());
            }
        }
        let corners = indices
            .chunks_exact(3)
            .map(|t| [t[0], t[1], t[2]].map(|vertex| first as u32 + vertex as u32));
        parts.triangles.extend(corners);
        let targets: Vec<_> = primitive.morph_targets().collect();
        if first > 0 && targets.len() != parts.targets.len() {
            return Err(wrong(&what, "has another number of morph targets than the first"));
        }
        parts.targets.resize(targets.len(), Vec::new());
        for (index, target) in targets.iter().enumerate() {
            let moves = match target.positions() {
                None => vec![DVec3::ZERO; count],
                Some(moves) => self.vectors(&moves, Some(count), &format!("{what}, morph target {index}"))?,
            };
            parts.targets[index].extend(moves);
        }
        parts.positions.extend(positions);
        match skin {
            None => Ok(()),
            Some(skin) => self.add_influences(primitive, &what, skin.joints().count(), count, parts),
        }
    }

    /// Adds which joints move the `count` vertices of a primitive.
    fn add_influences(
        &self,
        primitive: &Primitive<'a>,
        what: &str,
        joint_count: usize,
        count: usize,
        parts: &mut Parts,
    ) -> Result<(), AnimationProblem> {
        let mut sets = Vec::new();
        while let Some(joints) = primitive.get(&Semantic::Joints(sets.len() as u32)) {
            let set = sets.len();
            let weights = primitive.get(&Semantic::Weights(set as u32));
            let weights = weights.ok_or_else(|| wrong(what, format!("has JOINTS_{set}, but no WEIGHTS_{set}")))?;
            let read = |accessor, name| self.numbers(accessor, Dimensions::Vec4, Some(count), &format!("{what}, {name}_{set}"));
            sets.push((read(&joints, "JOINTS")?, read(&weights, "WEIGHTS")?));
        }
        if sets.is_empty() {
            return Err(wrong(
                what,
                "has a skin, but no JOINTS_0 that say which joints its vertices follow",
            ));
        }
        for vertex in 0..count {
            let of_vertex = 4 * vertex..4 * vertex + 4;
            let all = sets
                .iter()
                .flat_map(|(joints, weights)| joints[of_vertex.clone()].iter().zip(&weights[of_vertex.clone()]));
            let begin = parts.influences.len();
            for (&joint, &weight) in all.filter(|(_, weight)| **weight != 0.0) {
                if weight < 0.0 {
                    return Err(wrong(
                        what,
                        format!("vertex {vertex} has the weight {weight}, but none may be negative"),
                    ));
                }
                if joint >= joint_count as f64 {
                    let reason = format!("vertex {vertex} follows joint {joint}, but the skin has {joint_count}, from 0 on");
                    return Err(wrong(what, reason));
                }
                parts.influences.push((joint as u32, weight));
            }
            let own = &mut parts.influences[begin..];
            let sum: f64 = own.iter().map(|(_, weight)| weight).sum();
            if sum <= 0.0 {
                return Err(wrong(what, format!("vertex {vertex} follows no joint: its weights are zero")));
            }
            own.iter_mut().for_each(|(_, weight)| *weight /= sum);
            parts.ends.push(parts.influences.len() as u32);
        }
        Ok(())
    }

    /// The nodes that `wanted` depend on, parents first, and where among them each node of the file is.
    fn skeleton(&self, wanted: Vec<usize>) -> Result<(Vec<Node>, Vec<Option<usize>>), AnimationProblem> {
        let mut parents = vec![None; self.nodes.len()];
        for node in &self.nodes {
            for child in node.children() {
                if parents[child.index()].replace(node.index()).is_some() {
                    return Err(AnimationProblem::NotGltf(format!("node {} has two parents", child.index())));
                }
            }
        }
        let mut nodes = Vec::new();
        let mut places = vec![None; self.nodes.len()];
        for node in wanted {
            // Up to what is there already, then down again.
            let mut way = Vec::new();
            let mut above = Some(node);
            while let Some(node) = above.filter(|&node| places[node].is_none()) {
                if way.len() == self.nodes.len() {
                    return Err(AnimationProblem::NotGltf(format!("node {node} is above itself")));
                }
                way.push(node);
                above = parents[node];
            }
            for node in way.into_iter().rev() {
                places[node] = Some(nodes.len());
                let parent = parents[node].and_then(|parent| places[parent]);
                nodes.push(Node {
                    parent,
                    local: local(&self.nodes[node])?,
                });
            }
        }
        Ok((nodes, places))
    }

    fn joints(
        &self,
        skin: &gltf::Skin<'a>,
        joints: &[usize],
        places: &[Option<usize>],
    ) -> Result<Vec<(usize, DAffine3)>, AnimationProblem> {
        let inverses = match skin.inverse_bind_matrices() {
            None => vec![DAffine3::IDENTITY; joints.len()],
            Some(accessor) => {
                let what = "the skin's inverse bind matrices";
                let numbers = self.numbers(&accessor, Dimensions::Mat4, Some(joints.len()), what)?;
                let matrices = numbers.chunks_exact(16).map(DMat4::from_cols_slice);
                matrices.map(DAffine3::from_mat4).collect()
            }
        };
        let places = joints.iter().map(|&joint| places[joint].unwrap_or_default());
        Ok(places.zip(inverses).collect())
    }

    /// The channels that move one of the nodes that are there, or the weights of the mesh's node.
    fn tracks(
        &self,
        animation: &gltf::Animation<'a>,
        mesh_node: usize,
        target_count: usize,
        places: &[Option<usize>],
    ) -> Result<Vec<Track>, AnimationProblem> {
        let mut tracks: Vec<Track> = Vec::new();
        for (index, channel) in animation.channels().enumerate() {
            let target = channel.target();
            let node = target.node();
            let (property, dimensions, width) = match target.property() {
                gltf::animation::Property::Translation => (Property::Translation, Dimensions::Vec3, 3),
                gltf::animation::Property::Rotation => (Property::Rotation, Dimensions::Vec4, 4),
                gltf::animation::Property::Scale => (Property::Scale, Dimensions::Vec3, 3),
                gltf::animation::Property::MorphTargetWeights => (Property::Weights, Dimensions::Scalar, target_count),
            };
            let place = match property {
                Property::Weights if node.index() == mesh_node && target_count > 0 => 0,
                Property::Weights => continue,
                _ => match places[node.index()] {
                    Some(place) => place,
                    None => continue,
                },
            };
            let what = format!(
                "channel {index} of the animation ({property:?} of '{}')",
                short(&label(&node))
            );
            if matches!(node.transform(), Transform::Matrix { .. }) && property != Property::Weights {
                return Err(wrong(
                    &what,
                    "moves a node that has a `matrix`; it must have `translation`, `rotation`, `scale`",
                ));
            }
            if tracks.iter().any(|track| (track.node, track.property) == (place, property)) {
                return Err(wrong(&what, "there is another channel of the same"));
            }
            let sampler = channel.sampler();
            let times = self.numbers(&sampler.input(), Dimensions::Scalar, None, &format!("{what}, times"))?;
            let (interpolation, parts) = match sampler.interpolation() {
                gltf::animation::Interpolation::Step => (Interpolation::Step, 1),
                gltf::animation::Interpolation::Linear => (Interpolation::Linear, 1),
                gltf::animation::Interpolation::CubicSpline => (Interpolation::Cubic, 3),
            };
            if times.is_empty() || times[0] < 0.0 || !times.is_sorted_by(|a, b| a < b) {
                return Err(wrong(
                    &what,
                    "its times must be zero or more, each later than the one before, and one at least",
                ));
            }
            let each = if property == Property::Weights { width } else { 1 };
            let count = times.len().saturating_mul(parts).saturating_mul(each);
            let mut values = self.numbers(&sampler.output(), dimensions, Some(count), &format!("{what}, values"))?;
            if property == Property::Rotation && interpolation != Interpolation::Cubic {
                for (key, value) in values.chunks_exact_mut(4).enumerate() {
                    let rotation = DQuat::from_slice(value);
                    if rotation.length_squared() <= 0.0 {
                        return Err(wrong(
                            &what,
                            format!("the rotation of key {key} is zero, but must be a quaternion of length one"),
                        ));
                    }
                    value.copy_from_slice(&rotation.normalize().to_array());
                }
            }
            tracks.push(Track {
                node: place,
                property,
                interpolation,
                times,
                values,
                width,
            });
        }
        Ok(tracks)
    }

    fn vectors(&self, accessor: &Accessor<'a>, count: Option<usize>, what: &str) -> Result<Vec<DVec3>, AnimationProblem> {
        let numbers = self.numbers(accessor, Dimensions::Vec3, count, what)?;
        Ok(numbers.chunks_exact(3).map(DVec3::from_slice).collect())
    }

    /// All numbers of an accessor, which must be of these dimensions, and as many as `count` if that is known.
    fn numbers(
        &self,
        accessor: &Accessor<'a>,
        dimensions: Dimensions,
        count: Option<usize>,
        what: &str,
    ) -> Result<Vec<f64>, AnimationProblem> {
        let wrong = |reason: String| wrong(what, reason);
        if accessor.dimensions() != dimensions {
            return Err(wrong(format!(
                "are of type {:?}, but must be of {dimensions:?}",
                accessor.dimensions()
            )));
        }
        if let Some(count) = count.filter(|&count| count != accessor.count()) {
            return Err(wrong(format!("there are {}, but must be {count}", accessor.count())));
        }
        let (data, width) = (accessor.data_type(), dimensions.multiplicity());
        let mut numbers = match accessor.view() {
            Some(view) => {
                let run = self.run(&view, accessor.offset(), view.stride(), accessor.size(), accessor.count());
                read(run.map_err(wrong)?, accessor.count(), data, width)
            }
            // Zeros: as many as somebody else has said and has the bytes for.
            None if count.is_some() => vec![0.0; accessor.count() * width],
            None => return Err(wrong("have no bytes in the file".to_owned())),
        };
        if let Some(sparse) = accessor.sparse() {
            let (indices, values) = (sparse.indices(), sparse.values());
            let index = match indices.index_type() {
                gltf::accessor::sparse::IndexType::U8 => DataType::U8,
                gltf::accessor::sparse::IndexType::U16 => DataType::U16,
                gltf::accessor::sparse::IndexType::U32 => DataType::U32,
            };
            let (places, count) = (indices.view(), sparse.count());
            let run = self.run(&places, indices.offset(), None, index.size(), count);
            let places = read(run.map_err(wrong)?, count, index, 1);
            let run = self.run(&values.view(), values.offset(), None, accessor.size(), count);
            let values = read(run.map_err(wrong)?, count, data, width);
            for (place, values) in places.into_iter().zip(values.chunks_exact(width)) {
                let own = numbers.get_mut(place as usize * width..(place as usize + 1) * width);
                let own = own.ok_or_else(|| wrong(format!("number {place} is replaced, but there is none")))?;
                own.copy_from_slice(values);
            }
        }
        if accessor.normalized() {
            let largest = match data {
                DataType::I8 => 127.0,
                DataType::U8 => 255.0,
                DataType::I16 => 32767.0,
                DataType::U16 => 65535.0,
                DataType::U32 | DataType::F32 => 1.0,
            };
            numbers.iter_mut().for_each(|number| *number = (*number / largest).max(-1.0));
        }
        match numbers.iter().position(|number| !number.is_finite()) {
            None => Ok(numbers),
            Some(index) => Err(wrong(format!(
                "number {} is {}, but must be finite",
                index / width,
                numbers[index]
            ))),
        }
    }

    /// The bytes of a view from an offset on, with what goes from one element to the next, if all its elements are there.
    fn run(&self, view: &View<'a>, offset: usize, stride: Option<usize>, size: usize, count: usize) -> Result<Run<'_>, String> {
        let stride = stride.unwrap_or(size);
        let buffer = &self.buffers[view.buffer().index()];
        let end = view.offset().checked_add(view.length());
        let bytes = end.and_then(|end| buffer.get(view.offset()..end));
        let needed = count
            .checked_sub(1)
            .map_or(Some(0), |last| last.checked_mul(stride)?.checked_add(size));
        let bytes = bytes
            .and_then(|bytes| bytes.get(offset..))
            .filter(|bytes| needed.is_some_and(|needed| needed <= bytes.len()));
        match bytes {
            Some(bytes) if stride >= size => Ok(Run { bytes, stride }),
            _ => Err(format!(
                "are to be {count}, more than the bytes hold that the file gives them; is it complete?"
            )),
        }
    }
}

/// Where elements lie.
#[derive(Clone, Copy)]
struct Run<'a> {
    bytes: &'a [u8],
    stride: usize,
}

fn read(run: Run<'_>, count: usize, data: DataType, width: usize) -> Vec<f64> {
    let size = data.size();
    let mut numbers = Vec::with_capacity(count * width);
    for element in 0..count {
        let element = &run.bytes[element * run.stride..][..width * size];
        numbers.extend(element.chunks_exact(size).map(|bytes| match (data, bytes) {
            (DataType::I8, &[a]) => f64::from(a.cast_signed()),
            (DataType::U8, &[a]) => f64::from(a),
            (DataType::I16, &[a, b]) => f64::from(i16::from_le_bytes([a, b])),
            (DataType::U16, &[a, b]) => f64::from(u16::from_le_bytes([a, b])),
            (DataType::U32, &[a, b, c, d]) => f64::from(u32::from_le_bytes([a, b, c, d])),
            (DataType::F32, &[a, b, c, d]) => f64::from(f32::from_le_bytes([a, b, c, d])),
            // Chunks are of the type's size.
            _ => f64::NAN,
        }));
    }
    numbers
}

/// All primitives of a mesh as one.
#[derive(Default)]
struct Parts {
    positions: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    targets: Vec<Vec<DVec3>>,
    ends: Vec<u32>,
    influences: Vec<(u32, f64)>,
}

/// Where a node is in its parent, if all its numbers are finite and it turns.
fn local(node: &gltf::Node<'_>) -> Result<Local, AnimationProblem> {
    let refuse = |reason: &str| Err(wrong(&format!("node '{}'", short(&label(node))), reason));
    match node.transform() {
        Transform::Matrix { matrix } => {
            let matrix = DMat4::from_cols_array_2d(&matrix.map(|column| column.map(f64::from)));
            if !matrix.is_finite() {
                return refuse("its matrix has a number that is not finite");
            }
            Ok(Local::Whole(DAffine3::from_mat4(matrix)))
        }
        Transform::Decomposed {
            translation,
            rotation,
            scale,
        } => {
            let [translation, scale] = [translation, scale].map(|vector| DVec3::from_array(vector.map(f64::from)));
            let rotation = DQuat::from_array(rotation.map(f64::from));
            if !(translation.is_finite() && rotation.is_finite() && scale.is_finite()) {
                return refuse("its place has a number that is not finite");
            }
            if rotation.length_squared() <= 0.0 {
                return refuse("its rotation is zero, but must be a quaternion of length one");
            }
            Ok(Local::Parts {
                translation,
                rotation: rotation.normalize(),
                scale,
            })
        }
    }
}
