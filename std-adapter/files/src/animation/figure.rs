//! A mesh that a skeleton, morph targets or its own node move.

use super::track::{Interpolation, Property, Track};
use selvedge::Mesh;
use selvedge_core::glam::{DAffine3, DQuat, DVec3};

/// A mesh, and where an animation takes its vertices: read from a [file](super::read).
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
    /// At its first key.
    pub(super) mesh: Mesh,
    pub(super) shape: Shape,
    pub(super) fingerprint: u64,
}

/// What moves the vertices.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Shape {
    /// Parents before children.
    pub(super) nodes: Vec<Node>,
    pub(super) tracks: Vec<Track>,
    /// Of each vertex, before it is moved.
    pub(super) rest: Vec<DVec3>,
    pub(super) targets: Vec<Target>,
    /// The mesh's node.
    pub(super) node: usize,
    /// `None`: the mesh follows its node.
    pub(super) skin: Option<Skin>,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Node {
    pub(super) parent: Option<usize>,
    pub(super) local: Local,
}

/// Where a node is in its parent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Local {
    Parts {
        translation: DVec3,
        rotation: DQuat,
        scale: DVec3,
    },
    /// What no track moves.
    Whole(DAffine3),
}

/// A morph target.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Target {
    /// Where no track says otherwise.
    pub(super) weight: f64,
    /// What it adds to each vertex.
    pub(super) moves: Vec<DVec3>,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Skin {
    /// Nodes, each with where the mesh at rest is as it sees it.
    pub(super) joints: Vec<(usize, DAffine3)>,
    /// Of each vertex, the end of its influences.
    pub(super) ends: Vec<u32>,
    /// Joints, and how much they count: of each vertex together one.
    pub(super) influences: Vec<(u32, f64)>,
}

impl Figure {
    /// Its triangles, and where its vertices are at its first key and before, in the file's unit (glTF: metres, y is up).
    #[must_use]
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// The times of its first and of its last key, in seconds.
    #[must_use]
    pub fn span(&self) -> [f64; 2] {
        let ends = |track: &Track| [track.times[0], track.times[track.times.len() - 1]];
        let all = self.shape.tracks.iter().map(ends);
        all.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]).unwrap_or_default()
    }

    /// The times of all its keys, in seconds, ascending, each once.
    #[must_use]
    pub fn key_times(&self) -> Vec<f64> {
        let mut times: Vec<f64> = self.shape.tracks.iter().flat_map(|track| &track.times).copied().collect();
        times.sort_unstable_by(f64::total_cmp);
        times.dedup();
        times
    }

    /// Whether some of it jumps from key to key (`STEP`), instead of going there.
    #[must_use]
    pub fn has_steps(&self) -> bool {
        let jumps = |track: &Track| track.interpolation == Interpolation::Step && track.times.len() > 1;
        self.shape.tracks.iter().any(jumps)
    }

    /// Tells figures of different files, or of different parts of one, from each other.
    #[must_use]
    pub fn fingerprint(&self) -> u64 {
        self.fingerprint
    }

    /// Replaces `positions` by those of all vertices at a time, in seconds: before the first key they are where they are there, after the
    /// last as well. The same bits for the same time, on every platform.
    pub fn positions_at(&self, time: f64, positions: &mut Vec<DVec3>) {
        self.shape.positions_at(time, positions);
    }
}

impl Shape {
    pub(super) fn positions_at(&self, time: f64, positions: &mut Vec<DVec3>) {
        let mut weights: Vec<f64> = self.targets.iter().map(|target| target.weight).collect();
        let places = self.places(time, &mut weights);
        positions.clear();
        positions.extend_from_slice(&self.rest);
        for (target, &weight) in self.targets.iter().zip(&weights).filter(|(_, weight)| **weight != 0.0) {
            let moves = positions.iter_mut().zip(&target.moves);
            moves.for_each(|(position, &by)| *position += by * weight);
        }
        match &self.skin {
            None => {
                let place = places[self.node];
                positions.iter_mut().for_each(|p| *p = place.transform_point3(*p));
            }
            Some(skin) => skin.apply(&places, positions),
        }
    }

    /// Where each node is at a time. Writes to `weights` those that tracks change.
    fn places(&self, time: f64, weights: &mut [f64]) -> Vec<DAffine3> {
        let mut locals: Vec<Local> = self.nodes.iter().map(|node| node.local).collect();
        let mut values = Vec::new();
        for track in &self.tracks {
            track.sample(time, &mut values);
            if track.property == Property::Weights {
                weights.copy_from_slice(&values);
            } else if let Local::Parts {
                translation,
                rotation,
                scale,
            } = &mut locals[track.node]
            {
                match track.property {
                    Property::Translation => *translation = DVec3::from_slice(&values),
                    Property::Rotation => *rotation = DQuat::from_slice(&values),
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
