//! The state of a simulation and its measurements as bytes.

use super::state::State;
use crate::contact::{ContactCounts, ContactSeconds, PairKey};
use crate::model::tearing::TornEdge;
use crate::solve::Kept;
use crate::world::{Cloth, Placement};
use serde::{Deserialize, Serialize};

/// A simulation can be saved as a checkpoint after this many steps, and again after each further so many. Contact then discards
/// its data besides the state, which a resumed simulation does not have either.
pub const CHECKPOINT_STEPS: u64 = 200;

const MAGIC: &[u8; 15] = b"selvedge state ";
/// The version of the format: of the structs below, and of all that are in them.
const VERSION: u8 = b'6';

/// Bytes from which a simulation cannot continue.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CheckpointError {
    /// The bytes are no checkpoint.
    #[error("this is not a checkpoint of a simulation")]
    NotOne,
    /// The checkpoint has the format of an earlier or a later version of this crate.
    #[error("the checkpoint was written by another version of the simulator")]
    OtherVersion,
    /// The checkpoint is of another scene, or of an earlier version of this one.
    #[error("the checkpoint belongs to another scene, or to this scene before a change")]
    OtherScene,
    /// The checkpoint is cut short, or has numbers that no simulation has.
    #[error("the checkpoint is damaged, or cut short")]
    Damaged,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct TornCloth {
    /// The vertex that each of the last vertices is a copy of.
    pub(super) copied: Vec<u32>,
    pub(super) triangles: Vec<[u32; 3]>,
}

impl TornCloth {
    /// Returns whether it is that cloth, perhaps torn. If copies count as their originals its triangles are the same, and they
    /// and its loose edges have all vertices.
    pub(super) fn is_torn_from(&self, cloth: &Cloth) -> bool {
        let made = cloth.vertices_as_made();
        let are_before = (made..).zip(&self.copied).all(|(copy, &vertex)| (vertex as usize) < copy);
        let as_made = |mut vertex: u32| {
            while let Some(copy) = (vertex as usize).checked_sub(made) {
                vertex = *self.copied.get(copy)?;
            }
            Some(vertex)
        };
        let own = cloth
            .mesh()
            .triangles
            .iter()
            .flatten()
            .map(|&vertex| Some(cloth.as_made(vertex)));
        let mut has = vec![false; made + self.copied.len()];
        let is_of = are_before && self.triangles.iter().flatten().map(|&vertex| as_made(vertex)).eq(own);
        if is_of {
            let loose = cloth.topology().loose_edges().flatten();
            let named = self.triangles.iter().copied().flatten().chain(loose);
            named.for_each(|vertex| has[vertex as usize] = true);
        }
        is_of && !has.contains(&false)
    }
}

/// A simulation at one moment. The measurements in it have no influence on the steps that follow.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Checkpoint {
    /// The cloths after all tears, and the edges that tore; `None` if nothing tears.
    pub(super) torn: Option<(Vec<TornCloth>, Vec<TornEdge>)>,
    pub(super) state: State,
    /// True for bodies that are let pass; empty without contact.
    pub(super) yielding: Vec<bool>,
    /// The pairs of a tangle at the start that no longer meet and are not yet apart; `None` if there is no tangle.
    pub(super) parting: Option<Vec<PairKey>>,
    /// The seconds of each effect, and of the solve.
    pub(super) seconds: Vec<f64>,
    /// The placement of each body and group of pins that the caller moves, unless it was moved point by point.
    pub(super) placements: Vec<Option<Placement>>,
    /// The states of the free bodies, one after the other.
    pub(super) free_bodies: Vec<f64>,
    pub(super) memories: Vec<f64>,
    /// The counts of contact; all zero without contact.
    pub(super) counts: ContactCounts,
    /// The times of contact; all zero without contact.
    pub(super) stages: ContactSeconds,
    /// What the solve keeps from step to step.
    pub(super) kept: Kept,
}

impl Checkpoint {
    pub(super) fn write(&self, fingerprint: u64) -> Vec<u8> {
        let start = [&MAGIC[..], &[VERSION], &fingerprint.to_le_bytes()].concat();
        postcard::to_extend(self, start).expect("all lengths are known, and a list of bytes has room")
    }

    /// Reads a checkpoint of the scene with this fingerprint. Whether lists have the lengths of the scene is not checked.
    pub(super) fn read(bytes: &[u8], fingerprint: u64) -> Result<Self, CheckpointError> {
        let bytes = bytes.strip_prefix(MAGIC).ok_or(CheckpointError::NotOne)?;
        let (&version, bytes) = bytes.split_first().ok_or(CheckpointError::Damaged)?;
        if version != VERSION {
            return Err(CheckpointError::OtherVersion);
        }
        let (&found, bytes) = bytes.split_first_chunk().ok_or(CheckpointError::Damaged)?;
        if u64::from_le_bytes(found) != fingerprint {
            return Err(CheckpointError::OtherScene);
        }
        match postcard::take_from_bytes::<Self>(bytes) {
            Ok((checkpoint, [])) if checkpoint.is_sound() => Ok(checkpoint),
            _ => Err(CheckpointError::Damaged),
        }
    }

    /// Returns whether all numbers but measurements are finite, placements are rigid, and edges tore in cloths that there are.
    fn is_sound(&self) -> bool {
        let State { before, clock, .. } = &self.state;
        let mut numbers = self.free_bodies.iter().chain(&self.memories).chain([before, clock]);
        let mut vectors = self.state.positions.iter().chain(&self.state.velocities);
        // To normalise a rotation again would change bits.
        let are_rigid = self.placements.iter().flatten().all(|placement| placement.checked().is_ok());
        let is_of = |edge: &TornEdge, cloths: &[_]| edge.cloth < cloths.len() && edge.time.is_finite() && edge.load.is_finite();
        let mut tears = self.torn.iter();
        are_rigid
            && tears.all(|(cloths, edges)| edges.iter().all(|edge| is_of(edge, cloths)))
            && numbers.all(|number| number.is_finite())
            && vectors.all(|vector| vector.is_finite())
            && self.kept.is_finite()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solve::prediction::MotionHistory;
    use crate::solve::{Remembered, RowKey};
    use selvedge::PairKind;
    use selvedge_core::glam::DVec3;

    fn checkpoint() -> Checkpoint {
        Checkpoint {
            torn: Some((
                vec![TornCloth {
                    copied: vec![1],
                    triangles: vec![[0, 1, 2], [3, 2, 0]],
                }],
                vec![TornEdge {
                    cloth: 0,
                    vertices: [1, 2],
                    time: 0.5,
                    load: 12.0,
                }],
            )),
            state: State {
                step: 400,
                blocked_steps: 3,
                overstretched_steps: 5,
                before: 0.25,
                since: 7,
                clock: 0.1,
                positions: vec![DVec3::new(1.0, -0.0, 1e-300), DVec3::X],
                velocities: vec![DVec3::Y, DVec3::splat(f64::MIN_POSITIVE)],
            },
            yielding: vec![true, false],
            parting: Some(vec![(PairKind::VertexFace, [1, 0]), (PairKind::EdgeEdge, [0, 2])]),
            seconds: vec![0.25],
            placements: vec![Some(Placement::at(DVec3::Y)), None],
            free_bodies: vec![0.5; 3],
            memories: vec![-1.0, 0.5, 2.0],
            kept: Kept {
                pushes: vec![(RowKey::Smooth(1, 2), Remembered::default())],
                multipliers: vec![0.25],
                history: MotionHistory {
                    positions: vec![DVec3::Z],
                    velocities: vec![DVec3::NEG_X],
                    h: 0.5,
                    is_first_order: vec![true, false],
                },
            },
            counts: ContactCounts {
                candidates: 1,
                looked_at: 2,
                pushed: 3,
                violated: 4,
                zone_rounds: 5,
                held: 6,
                cuts: 7,
            },
            stages: ContactSeconds {
                candidates: 0.1,
                constraints: 0.2,
                certificates: 0.3,
                repairs: 0.4,
            },
        }
    }

    #[test]
    fn what_is_written_is_read_back_to_the_last_bit() {
        assert_eq!(Checkpoint::read(&checkpoint().write(7), 7), Ok(checkpoint()));
        let whole = Checkpoint {
            torn: None,
            ..checkpoint()
        };
        assert_eq!(Checkpoint::read(&whole.write(7), 7), Ok(whole));
    }

    #[test]
    fn other_scenes_other_versions_and_damage_are_noticed() {
        let bytes = checkpoint().write(7);
        assert_eq!(Checkpoint::read(&bytes, 8), Err(CheckpointError::OtherScene));
        assert_eq!(Checkpoint::read(b"v 0 0 0", 7), Err(CheckpointError::NotOne));
        assert_eq!(Checkpoint::read(b"selvedge state 5", 7), Err(CheckpointError::OtherVersion));
        for length in MAGIC.len()..bytes.len() {
            assert_eq!(
                Checkpoint::read(&bytes[..length], 7),
                Err(CheckpointError::Damaged),
                "{length}"
            );
        }
        assert!(Checkpoint::read(&[&bytes[..], &[0]].concat(), 7).is_err());
        let mut damaged = bytes.clone();
        let clock = bytes.windows(8).position(|eight| eight == 0.1_f64.to_le_bytes()).unwrap();
        damaged[clock..][..8].copy_from_slice(&f64::NAN.to_le_bytes());
        assert_eq!(Checkpoint::read(&damaged, 7), Err(CheckpointError::Damaged));
    }

    /// A length that is not true is not believed.
    #[test]
    fn damage_anywhere_takes_little_memory() {
        let bytes = checkpoint().write(7);
        let large = [0xff, 0xff, 0xff, 0xff, 0x0f];
        for place in MAGIC.len() + 9..bytes.len() - large.len() {
            let mut damaged = bytes.clone();
            damaged[place..][..large.len()].copy_from_slice(&large);
            let taken = allocation_counter::measure(|| drop(Checkpoint::read(&damaged, 7)));
            assert!(taken.bytes_max < 64 * bytes.len() as u64, "{place}: {taken:?}");
        }
    }

    #[test]
    fn a_torn_cloth_has_the_triangles_of_the_whole_one_and_all_its_vertices() {
        let cloth = Cloth::of(crate::world::sheet(DVec3::ZERO, [DVec3::X, DVec3::Y], [1, 1]));
        let torn = |copied: &[u32], triangles: [[u32; 3]; 2]| {
            let triangles = triangles.to_vec();
            let copied = copied.to_vec();
            TornCloth { copied, triangles }.is_torn_from(&cloth)
        };
        assert_eq!(cloth.mesh().triangles, [[0, 1, 3], [0, 3, 2]]);
        assert!(torn(&[], [[0, 1, 3], [0, 3, 2]]));
        assert!(torn(&[3], [[0, 1, 3], [0, 4, 2]]));
        assert!(!torn(&[0, 4], [[4, 1, 3], [5, 3, 2]]), "nothing has its first vertex");
        assert!(!torn(&[0], [[0, 1, 3], [0, 4, 2]]), "a copy of another one");
        assert!(!torn(&[4], [[0, 1, 3], [0, 4, 2]]), "a copy of itself");
        assert!(!torn(&[3], [[0, 1, 3], [0, 3, 2]]), "a copy without a triangle");
        assert!(!torn(&[], [[0, 1, 3], [0, 4, 2]]), "no such copy");
    }
}
