//! The nodes that a mesh depends on.

use super::{File, label, short, wrong};
use crate::animation::figure::{Local, Node};
use crate::problem::AnimationProblem;
use gltf::accessor::Dimensions;
use gltf::scene::Transform;
use selvedge_core::glam::{DAffine3, DMat4, DQuat, DVec3};

impl<'a> File<'a> {
    /// Returns the nodes that `wanted` depend on, parents first, and the place of each node of the file among them.
    pub(super) fn skeleton(&self, wanted: Vec<usize>) -> Result<(Vec<Node>, Vec<Option<usize>>), AnimationProblem> {
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
            // The way goes up to a node that is already there, then down again.
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

    pub(super) fn joints(
        &self,
        skin: &gltf::Skin<'a>,
        places: &[Option<usize>],
    ) -> Result<Vec<(usize, DAffine3)>, AnimationProblem> {
        let joints: Vec<usize> = skin.joints().map(|joint| joint.index()).collect();
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
}

/// Returns the place of a node in its parent, if all its numbers are finite and its rotation is not zero.
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
