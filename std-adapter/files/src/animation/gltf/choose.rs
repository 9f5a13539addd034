//! Which node and which animation are meant.

use super::{File, label, short};
use crate::animation::error::{AnimationProblem, Choices};

impl<'a> File<'a> {
    pub(super) fn choose_node(&self, name: Option<&str>) -> Result<gltf::Node<'a>, AnimationProblem> {
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

    pub(super) fn choose_animation(&self, name: Option<&str>) -> Result<gltf::Animation<'a>, AnimationProblem> {
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
}
