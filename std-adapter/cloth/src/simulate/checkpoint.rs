//! The state of a simulation and its measurements as bytes.

use super::state::State;
use crate::contact::{ContactCounts, ContactSeconds, PairKey};
use crate::model::tearing::TornEdge;
use crate::world::{Cloth, KEPT, Placement};
use selvedge::PairKind;
use selvedge_core::glam::{DQuat, DVec3};
use selvedge_files::bytes::{Reader, put_block};

/// A simulation can be saved as a checkpoint after this many steps, and again after each further so many. Contact then discards
/// its data besides the state, which a resumed simulation does not have either.
pub const CHECKPOINT_STEPS: u64 = 200;

const MAGIC: &[u8; 16] = b"selvedge state 5";

/// Bytes from which a simulation cannot continue.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CheckpointError {
    /// The bytes are no checkpoint.
    #[error("this is not a checkpoint of a simulation")]
    NotOne,
    /// The checkpoint is of another scene, or of an earlier version of this one.
    #[error("the checkpoint belongs to another scene, or to this scene before a change")]
    OtherScene,
    /// The checkpoint is cut short, or has numbers that no simulation has.
    #[error("the checkpoint is damaged")]
    Damaged,
}

#[derive(Clone, Debug, PartialEq)]
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

/// The tears: each cloth after them, and the edges that tore. A checkpoint has them only if its scene may tear, before all data
/// that depend on them.
pub(super) type Torn = (Vec<TornCloth>, Vec<TornEdge>);

fn write_torn((cloths, edges): &Torn, bytes: &mut Vec<u8>) {
    for TornCloth { copied, triangles } in cloths {
        bytes.extend((copied.len() as u64).to_le_bytes());
        let vertices = copied.iter().chain(triangles.as_flattened());
        bytes.extend(vertices.flat_map(|vertex| vertex.to_le_bytes()));
    }
    bytes.extend((edges.len() as u64).to_le_bytes());
    for edge in edges {
        let [first, second] = edge.vertices.map(u64::from);
        let numbers = [edge.cloth as u64, first, second, edge.time.to_bits(), edge.load.to_bits()];
        bytes.extend(numbers.into_iter().flat_map(u64::to_le_bytes));
    }
}

/// Reads the tears of cloths with so many triangles each.
fn read_torn(reader: &mut Reader<'_>, triangles_of_cloths: &[usize]) -> Option<Torn> {
    let cloth = |&triangles: &usize| {
        let copied = reader.count(size_of::<u32>())?;
        let mut numbers = |count: usize| (0..count).map(|_| reader.u32()).collect::<Option<Vec<u32>>>();
        let (copied, corners) = (numbers(copied)?, numbers(3 * triangles)?);
        let triangles = corners.as_chunks().0.to_vec();
        Some(TornCloth { copied, triangles })
    };
    let cloths = triangles_of_cloths.iter().map(cloth).collect::<Option<_>>()?;
    let count = reader.count(5 * size_of::<u64>())?;
    let edge = |_| {
        let edge = TornEdge {
            cloth: usize::try_from(reader.u64()?).ok()?,
            vertices: [u32::try_from(reader.u64()?).ok()?, u32::try_from(reader.u64()?).ok()?],
            time: reader.f64()?,
            load: reader.f64()?,
        };
        (edge.cloth < triangles_of_cloths.len() && edge.time.is_finite() && edge.load.is_finite()).then_some(edge)
    };
    let edges = (0..count).map(edge).collect::<Option<_>>()?;
    Some((cloths, edges))
}

/// A simulation at one moment. The measurements in it have no influence on the steps that follow.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Checkpoint {
    /// The tears; `None` if nothing tears.
    pub(super) torn: Option<Torn>,
    pub(super) state: State,
    /// True for bodies that are let pass; empty without contact.
    pub(super) yielding: Vec<bool>,
    /// The pairs of a tangle at the start that no longer meet and are not yet apart; `None` if there is no tangle.
    pub(super) parting: Option<Vec<PairKey>>,
    /// The seconds of each effect, and of the solve.
    pub(super) seconds: Vec<f64>,
    /// The placement of each body and group of pins that the caller moves, unless it was moved point by point.
    pub(super) placements: Vec<Option<Placement>>,
    /// The state of each free body.
    pub(super) free_bodies: Vec<[f64; KEPT]>,
    pub(super) memories: Vec<f64>,
    /// The counts of contact; all zero without contact.
    pub(super) counts: ContactCounts,
    /// The times of contact; all zero without contact.
    pub(super) stages: ContactSeconds,
    /// What the solve keeps from step to step.
    pub(super) kept: Vec<u8>,
}

/// The lengths of the lists in a checkpoint of the scene.
#[derive(Clone, Copy, Debug)]
pub(super) struct ListLengths {
    pub(super) vertices: usize,
    pub(super) yielding: usize,
    pub(super) seconds: usize,
    pub(super) placements: usize,
    pub(super) free_bodies: usize,
    pub(super) memories: usize,
}

impl Checkpoint {
    pub(super) fn write(&self, fingerprint: u64) -> Vec<u8> {
        let mut bytes = MAGIC.to_vec();
        bytes.extend(fingerprint.to_le_bytes());
        if let Some(torn) = &self.torn {
            write_torn(torn, &mut bytes);
        }
        let state = &self.state;
        let times = [state.before, state.clock].map(f64::to_bits);
        let numbers = [state.step, state.blocked_steps, state.overstretched_steps, state.since]
            .into_iter()
            .chain(times);
        bytes.extend(numbers.flat_map(u64::to_le_bytes));
        let vectors = state.positions.iter().chain(&state.velocities);
        let numbers = vectors.flat_map(|vector| vector.to_array());
        bytes.extend(numbers.flat_map(f64::to_le_bytes));
        bytes.extend(self.yielding.iter().map(|&yields| u8::from(yields)));
        bytes.push(u8::from(self.parting.is_some()));
        if let Some(parting) = &self.parting {
            bytes.extend((parting.len() as u64).to_le_bytes());
            for (kind, pair) in parting {
                bytes.push(u8::from(*kind == PairKind::EdgeEdge));
                bytes.extend(pair.iter().flat_map(|feature| u64::from(*feature).to_le_bytes()));
            }
        }
        bytes.extend(self.seconds.iter().flat_map(|x| x.to_le_bytes()));
        for placement in &self.placements {
            bytes.push(u8::from(placement.is_some()));
            let Placement { rotation, translation } = placement.unwrap_or_default();
            let numbers = rotation.to_array().into_iter().chain(translation.to_array());
            bytes.extend(numbers.flat_map(f64::to_le_bytes));
        }
        let of_bodies = self.free_bodies.as_flattened().iter();
        bytes.extend(of_bodies.chain(&self.memories).flat_map(|x| x.to_le_bytes()));
        let ContactCounts {
            candidates,
            looked_at,
            pushed,
            violated,
            zone_rounds,
            held,
            cuts,
        } = self.counts;
        let pairs = [candidates, looked_at, pushed, violated];
        let counts = pairs.into_iter().chain([zone_rounds, held, cuts]);
        bytes.extend(counts.flat_map(u64::to_le_bytes));
        let stages = self.stages.stages().map(|(_, seconds)| seconds);
        bytes.extend(stages.into_iter().flat_map(f64::to_le_bytes));
        put_block(&mut bytes, &self.kept);
        bytes
    }

    /// Reads the first part of a checkpoint, and returns it with a reader of the rest; `triangles_of_cloths` is for a scene that
    /// may tear.
    pub(super) fn begin<'a>(
        bytes: &'a [u8],
        fingerprint: u64,
        triangles_of_cloths: Option<&[usize]>,
    ) -> Result<(Option<Torn>, Reader<'a>), CheckpointError> {
        let bytes = bytes.strip_prefix(MAGIC).ok_or(CheckpointError::NotOne)?;
        let mut reader = Reader(bytes);
        let found = reader.u64().ok_or(CheckpointError::Damaged)?;
        if found != fingerprint {
            return Err(CheckpointError::OtherScene);
        }
        let torn = match triangles_of_cloths {
            Some(cloths) => Some(read_torn(&mut reader, cloths).ok_or(CheckpointError::Damaged)?),
            None => None,
        };
        Ok((torn, reader))
    }

    /// Reads all but the tears.
    pub(super) fn read(mut reader: Reader<'_>, lengths: ListLengths) -> Result<Self, CheckpointError> {
        let checkpoint = Self::read_on(&mut reader, lengths).ok_or(CheckpointError::Damaged)?;
        let state = &checkpoint.state;
        let all = state.positions.iter().chain(&state.velocities);
        let of_bodies = checkpoint.free_bodies.as_flattened().iter();
        let remembered = of_bodies.chain(&checkpoint.memories).all(|number| number.is_finite());
        let is_finite = remembered && [state.clock, state.before].iter().all(|time| time.is_finite()) && { all }
            .all(|vector| vector.is_finite());
        if is_finite && reader.0.is_empty() {
            Ok(checkpoint)
        } else {
            Err(CheckpointError::Damaged)
        }
    }

    fn read_on(reader: &mut Reader<'_>, lengths: ListLengths) -> Option<Self> {
        let [step, blocked_steps] = [reader.u64()?, reader.u64()?];
        let [overstretched_steps, since] = [reader.u64()?, reader.u64()?];
        let [before, clock] = reader.numbers()?;
        let mut vectors = || {
            let vectors = (0..lengths.vertices).map(|_| reader.numbers().map(DVec3::from_array));
            vectors.collect::<Option<_>>()
        };
        let (positions, velocities) = (vectors()?, vectors()?);
        let yielding = reader.bytes(lengths.yielding)?;
        let parting = match flag(reader)? {
            true => {
                let count = reader.u64()?;
                Some((0..count).map(|_| pair(reader)).collect::<Option<_>>()?)
            }
            false => None,
        };
        let seconds: Option<Vec<_>> = (0..lengths.seconds).map(|_| reader.f64()).collect();
        let placements: Option<Vec<_>> = (0..lengths.placements).map(|_| placement(reader)).collect();
        let free_bodies: Option<Vec<_>> = (0..lengths.free_bodies).map(|_| reader.numbers()).collect();
        let memories: Option<Vec<_>> = (0..lengths.memories).map(|_| reader.f64()).collect();
        Some(Self {
            torn: None,
            state: State {
                step,
                blocked_steps,
                overstretched_steps,
                before,
                since,
                clock,
                positions,
                velocities,
            },
            yielding: { yielding.iter() }
                .map(|&byte| (byte <= 1).then_some(byte == 1))
                .collect::<Option<_>>()?,
            parting,
            seconds: seconds?,
            placements: placements?,
            free_bodies: free_bodies?,
            memories: memories?,
            counts: ContactCounts {
                candidates: reader.u64()?,
                looked_at: reader.u64()?,
                pushed: reader.u64()?,
                violated: reader.u64()?,
                zone_rounds: reader.u64()?,
                held: reader.u64()?,
                cuts: reader.u64()?,
            },
            stages: ContactSeconds {
                candidates: reader.f64()?,
                constraints: reader.f64()?,
                certificates: reader.f64()?,
                repairs: reader.f64()?,
            },
            kept: reader.block()?.to_vec(),
        })
    }
}

fn flag(reader: &mut Reader<'_>) -> Option<bool> {
    match reader.bytes(1)? {
        [flag @ (0 | 1)] => Some(*flag == 1),
        _ => None,
    }
}

fn pair(reader: &mut Reader<'_>) -> Option<PairKey> {
    let kind = if flag(reader)? {
        PairKind::EdgeEdge
    } else {
        PairKind::VertexFace
    };
    let mut feature = || u32::try_from(reader.u64()?).ok();
    Some((kind, [feature()?, feature()?]))
}

/// Reads whether there is a placement, and its numbers.
fn placement(reader: &mut Reader<'_>) -> Option<Option<Placement>> {
    let is_there = flag(reader)?;
    let [x, y, z, w, translation @ ..] = reader.numbers::<7>()?;
    let placement = Placement::new(DQuat::from_xyzw(x, y, z, w), translation.into());
    // To normalise the rotation again would change bits.
    placement.checked().ok()?;
    Some(is_there.then_some(placement))
}

#[cfg(test)]
mod tests {
    use super::*;

    const LENGTHS: ListLengths = ListLengths {
        vertices: 2,
        yielding: 2,
        seconds: 1,
        placements: 2,
        free_bodies: 1,
        memories: 3,
    };

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
            free_bodies: vec![[0.5; KEPT]],
            memories: vec![-1.0, 0.5, 2.0],
            kept: vec![1, 2, 3],
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

    fn read(bytes: &[u8], fingerprint: u64) -> Result<Checkpoint, CheckpointError> {
        let (torn, reader) = Checkpoint::begin(bytes, fingerprint, Some(&[2]))?;
        Ok(Checkpoint {
            torn,
            ..Checkpoint::read(reader, LENGTHS)?
        })
    }

    #[test]
    fn what_is_written_is_read_back_to_the_last_bit() {
        assert_eq!(read(&checkpoint().write(7), 7), Ok(checkpoint()));
        let whole = Checkpoint {
            torn: None,
            ..checkpoint()
        };
        let bytes = whole.write(7);
        let (torn, reader) = Checkpoint::begin(&bytes, 7, None).unwrap();
        assert!(torn.is_none() && Checkpoint::read(reader, LENGTHS) == Ok(whole));
    }

    #[test]
    fn other_scenes_and_damage_are_noticed() {
        let bytes = checkpoint().write(7);
        assert_eq!(read(&bytes, 8), Err(CheckpointError::OtherScene));
        assert_eq!(read(b"v 0 0 0", 7), Err(CheckpointError::NotOne));
        for length in MAGIC.len()..bytes.len() {
            assert_eq!(read(&bytes[..length], 7), Err(CheckpointError::Damaged), "{length}");
        }
        assert!(read(&[&bytes[..], &[0]].concat(), 7).is_err());
        let mut damaged = bytes.clone();
        let clock = bytes.windows(8).position(|eight| eight == 0.1_f64.to_le_bytes()).unwrap();
        damaged[clock..][..8].copy_from_slice(&f64::NAN.to_le_bytes());
        assert_eq!(read(&damaged, 7), Err(CheckpointError::Damaged));
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
