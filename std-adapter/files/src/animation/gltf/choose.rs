//! The choice of nodes and of an animation.

use super::{File, label, short};
use crate::animation::Choice;
use crate::problem::{AnimationProblem, NamesInFile};

impl<'a> File<'a> {
    /// Returns the nodes with a mesh that have a name or a path, or all nodes with a mesh in the scene.
    pub(super) fn choose_nodes(&self, name: Option<&str>) -> Result<Vec<gltf::Node<'a>>, AnimationProblem> {
        let mut with_mesh: Vec<_> = self.nodes.iter().filter(|node| node.mesh().is_some()).cloned().collect();
        if with_mesh.is_empty() {
            return Err(AnimationProblem::NoMesh);
        }
        let paths = self.paths();
        let choices =
            |nodes: &[gltf::Node<'_>], by: &dyn Fn(&gltf::Node<'_>) -> String| NamesInFile(nodes.iter().map(by).collect());
        let Some(name) = name else {
            let shown = self.shown();
            if with_mesh.iter().any(|node| shown[node.index()]) {
                with_mesh.retain(|node| shown[node.index()]);
            }
            return Ok(with_mesh);
        };
        let all = choices(&with_mesh, &label);
        let is_called = |node: &gltf::Node<'_>| {
            let of_mesh = node.mesh().is_some_and(|mesh| mesh.name() == Some(name));
            label(node) == name || of_mesh || paths[node.index()] == name
        };
        with_mesh.retain(is_called);
        match with_mesh.len() {
            1 => Ok(with_mesh),
            0 => Err(AnimationProblem::NoSuchNode {
                name: short(name),
                choices: all,
            }),
            _ => Err(AnimationProblem::SeveralNodes {
                choices: choices(&with_mesh, &|node| paths[node.index()].clone()),
            }),
        }
    }

    /// Returns the path of each node: the names of its ancestors and its own, with `/` between them.
    fn paths(&self) -> Vec<String> {
        let mut paths: Vec<String> = self.nodes.iter().map(label).collect();
        let mut parents = vec![None; self.nodes.len()];
        for node in &self.nodes {
            node.children().for_each(|child| parents[child.index()] = Some(node.index()));
        }
        for (node, path) in paths.iter_mut().enumerate() {
            let mut above = parents[node];
            // A path of a thousand names is a circle, or useless.
            for _ in 0..1000 {
                let Some(parent) = above else { break };
                *path = format!("{}/{path}", label(&self.nodes[parent]));
                above = parents[parent];
                if path.len() > 4000 {
                    break;
                }
            }
        }
        paths
    }

    /// Returns for each node whether the file's scene shows it.
    fn shown(&self) -> Vec<bool> {
        let mut shown = vec![false; self.nodes.len()];
        let scene = self.document.default_scene().or_else(|| self.document.scenes().next());
        let Some(scene) = scene else {
            return vec![true; self.nodes.len()];
        };
        let mut open: Vec<usize> = scene.nodes().map(|node| node.index()).collect();
        while let Some(node) = open.pop() {
            if !std::mem::replace(&mut shown[node], true) {
                open.extend(self.nodes[node].children().map(|child| child.index()));
            }
        }
        shown
    }

    /// Returns the animation with that name, or the only one, or none.
    pub(super) fn choose_animation(&self, choice: &Choice<'_>) -> Result<Option<gltf::Animation<'a>>, AnimationProblem> {
        let label = |animation: &gltf::Animation<'_>| match animation.name() {
            Some(name) => name.to_owned(),
            None => format!("animation {}", animation.index()),
        };
        let mut all: Vec<_> = self.document.animations().collect();
        let choices = NamesInFile(all.iter().map(label).collect());
        if choice.at_rest || all.is_empty() && choice.animation.is_none() {
            return Ok(None);
        }
        all.retain(|animation| choice.animation.is_none_or(|name| label(animation) == name));
        match (all.len(), choice.animation) {
            (1, _) => Ok(all.pop()),
            (0, name) => Err(AnimationProblem::NoSuchAnimation {
                name: short(name.unwrap_or_default()),
                choices,
            }),
            _ => Err(AnimationProblem::SeveralAnimations { choices }),
        }
    }
}
