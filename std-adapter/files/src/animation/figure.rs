//! A mesh that a skeleton, morph targets or its own node move.

use super::track::{AnimatedProperty, Interpolation, Track};
use crate::bytes::Fingerprint;
use crate::mesh::LeftOut;
use selvedge::Mesh;
use selvedge_core::glam::{DAffine3, DQuat, DVec3};

/// A mesh and the motion of its vertices in an animation, read from a [file](super::read).
///
/// ```no_run
/// use selvedge_files::animation::{Choice, read};
///
/// let figure = read("figure.glb".as_ref(), &Choice { animation: Some("walk"), ..Choice::default() })?;
/// let [first, last] = figure.span();
/// let mut positions = Vec::new();
/// figure.positions_at(0.5 * (first + last), &mut positions);
/// assert_eq!(positions.len(), figure.mesh().positions.len());
/// # Ok::<(), selvedge_files::animation::AnimationError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// The mesh at the first key.
    pub(super) mesh: Mesh,
    pub(super) shape: Shape,
    pub(super) left_out: Vec<LeftOut>,
    pub(super) fingerprint: u64,
}

/// The meshes of nodes, and the nodes and tracks that move their vertices.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Shape {
    /// The nodes, parents before children.
    pub(super) nodes: Vec<Node>,
    pub(super) tracks: Vec<Track>,
    pub(super) parts: Vec<Part>,
    /// The times of the first and of the last key of the whole animation. Nodes that share it share its clock.
    pub(super) span: [f64; 2],
    /// Applied to all positions at last.
    pub(super) placement: DAffine3,
}

/// The mesh of one node.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Part {
    /// The position of each vertex before anything moves it.
    pub(super) rest: Vec<DVec3>,
    pub(super) targets: Vec<Target>,
    pub(super) node: usize,
    /// The skin. With `None` the mesh follows its node.
    pub(super) skin: Option<Skin>,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Node {
    pub(super) parent: Option<usize>,
    pub(super) local: Local,
}

/// The place of a node in its parent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Local {
    Parts {
        translation: DVec3,
        rotation: DQuat,
        scale: DVec3,
    },
    /// A matrix. No track moves it.
    Whole(DAffine3),
}

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Target {
    /// The weight, unless a track changes it.
    pub(super) weight: f64,
    /// The vector that it adds to each vertex.
    pub(super) moves: Vec<DVec3>,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Skin {
    /// The joints: nodes, each with the placement of the mesh at rest relative to it.
    pub(super) joints: Vec<(usize, DAffine3)>,
    /// For each vertex, the end of its influences.
    pub(super) ends: Vec<u32>,
    /// Joints and their weights; those of a vertex sum to one.
    pub(super) influences: Vec<(u32, f64)>,
}

impl Figure {
    /// Returns the triangles, and the positions of vertices at the first key and before, in the file's unit (glTF: metres, y is
    /// up), or [transformed](Self::transformed).
    #[must_use]
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// Returns the parts of the file that were left out.
    #[must_use]
    pub fn left_out(&self) -> &[LeftOut] {
        &self.left_out
    }

    /// Transforms all positions: `DAffine3::from_scale(DVec3::splat(0.01))` for a file in centimetres.
    #[must_use]
    pub fn transformed(mut self, transform: DAffine3) -> Self {
        self.shape.placement = transform * self.shape.placement;
        self.shape.positions_at(self.shape.span[0], &mut self.mesh.positions);
        self
    }

    /// Returns the times of the first and of the last key of the animation, in seconds, for all of its nodes. Both are zero if
    /// nothing moves.
    #[must_use]
    pub fn span(&self) -> [f64; 2] {
        self.shape.span
    }

    /// Returns the times of all keys that move the figure, and both ends of the [span](Self::span), in seconds. They ascend, and
    /// each occurs once.
    #[must_use]
    pub fn key_times(&self) -> Vec<f64> {
        let mut times: Vec<f64> = self.shape.tracks.iter().flat_map(|track| &track.times).copied().collect();
        times.extend(self.shape.span);
        times.sort_unstable_by(f64::total_cmp);
        times.dedup();
        times
    }

    /// Returns whether a part of the figure jumps from key to key (`STEP`).
    #[must_use]
    pub fn has_steps(&self) -> bool {
        let jumps = |track: &Track| track.interpolation == Interpolation::Step && track.times.len() > 1;
        self.shape.tracks.iter().any(jumps)
    }

    /// Returns a number that differs for figures of different files, or of different parts of one.
    #[must_use]
    pub fn fingerprint(&self) -> u64 {
        if self.shape.placement == DAffine3::IDENTITY {
            return self.fingerprint;
        }
        let mut fingerprint = Fingerprint::default();
        fingerprint.take(&self.fingerprint.to_le_bytes());
        let numbers = self.shape.placement.to_cols_array();
        numbers.iter().for_each(|number| fingerprint.take(&number.to_le_bytes()));
        fingerprint.value()
    }

    /// Replaces `positions` by those of all vertices at a time, in seconds. Vertices rest before the first key and after the last
    /// one. The result has the same bits for the same time on every platform.
    pub fn positions_at(&self, time: f64, positions: &mut Vec<DVec3>) {
        self.shape.positions_at(time, positions);
    }
}

impl Shape {
    pub(super) fn positions_at(&self, time: f64, positions: &mut Vec<DVec3>) {
        let default = |part: &Part| part.targets.iter().map(|target| target.weight).collect();
        let mut weights: Vec<Vec<f64>> = self.parts.iter().map(default).collect();
        let places = self.places(time, &mut weights);
        positions.clear();
        for (part, weights) in self.parts.iter().zip(&weights) {
            let first = positions.len();
            positions.extend_from_slice(&part.rest);
            let own = &mut positions[first..];
            for (target, &weight) in part.targets.iter().zip(weights).filter(|(_, weight)| **weight != 0.0) {
                let moves = own.iter_mut().zip(&target.moves);
                moves.for_each(|(position, &by)| *position += by * weight);
            }
            match &part.skin {
                None => {
                    let place = places[part.node];
                    own.iter_mut().for_each(|p| *p = place.transform_point3(*p));
                }
                Some(skin) => skin.apply(&places, own),
            }
        }
        if self.placement != DAffine3::IDENTITY {
            positions.iter_mut().for_each(|p| *p = self.placement.transform_point3(*p));
        }
    }

    /// Returns the placement of each node at a time. Writes the weights that tracks change to `weights`, part by part.
    fn places(&self, time: f64, weights: &mut [Vec<f64>]) -> Vec<DAffine3> {
        let mut locals: Vec<Local> = self.nodes.iter().map(|node| node.local).collect();
        let mut values = Vec::new();
        for track in &self.tracks {
            track.sample(time, &mut values);
            if track.property == AnimatedProperty::Weights {
                weights[track.node].copy_from_slice(&values);
            } else if let Local::Parts {
                translation,
                rotation,
                scale,
            } = &mut locals[track.node]
            {
                match track.property {
                    AnimatedProperty::Translation => *translation = DVec3::from_slice(&values),
                    AnimatedProperty::Rotation => *rotation = DQuat::from_slice(&values),
                    _ => *scale = DVec3::from_slice(&values),
                }
            }
        }
        let mut places: Vec<DAffine3> = Vec::with_capacity(locals.len());
        for (node, local) in self.nodes.iter().zip(locals) {
            let own = match local {
                Local::Whole(own) => own,
                Local::Parts {
                    translation,
                    rotation,
                    scale,
                } => DAffine3::from_scale_rotation_translation(scale, rotation, translation),
            };
            places.push(node.parent.map_or(own, |parent| places[parent] * own));
        }
        places
    }
}

impl Skin {
    /// Moves points at rest to where their joints take them: linear blend skinning.
    fn apply(&self, places: &[DAffine3], positions: &mut [DVec3]) {
        let joints: Vec<DAffine3> = self.joints.iter().map(|&(node, inverse)| places[node] * inverse).collect();
        let mut begin = 0;
        for (position, &end) in positions.iter_mut().zip(&self.ends) {
            let mut sum = DVec3::ZERO;
            for &(joint, weight) in &self.influences[begin as usize..end as usize] {
                sum += joints[joint as usize].transform_point3(*position) * weight;
            }
            *position = sum;
            begin = end;
        }
    }
}
