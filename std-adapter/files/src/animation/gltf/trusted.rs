//! Checks that the `gltf` crate omits.

use super::short;
use crate::mesh::{FilePart, LeftOut};
use crate::problem::AnimationProblem;
use gltf::json::validation::Checked;

/// Checks that a binary file is as long as its header says, and reports bytes after that. The `gltf` crate would take a length
/// below that of the header for an enormous one.
pub(super) fn check_length(bytes: &[u8]) -> Result<Option<LeftOut>, AnimationProblem> {
    if !bytes.starts_with(b"glTF") {
        return Ok(None);
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
    let rest = &bytes[length..];
    let is_padding = rest.iter().all(|&byte| byte == 0);
    Ok((!is_padding).then(|| LeftOut::new(FilePart::TrailingByte, "", rest.len(), None, true)))
}

/// Checks that all indices in attributes of primitives and in animations exist. The `gltf` crate uses the former before it checks
/// them, and does not check the latter.
pub(super) fn check_indices(root: &gltf::json::Root) -> Result<(), AnimationProblem> {
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
