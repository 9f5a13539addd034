//! The state of a simulation as bytes: every number in full, least significant byte first.

use super::simulator::State;
use selvedge_core::glam::DVec3;

const MAGIC: &[u8; 16] = b"selvedge state 1";

/// Bytes from which a simulation cannot go on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CheckpointError {
    /// Something else.
    #[error("this is not a checkpoint of a simulation")]
    NotOne,
    /// Of another scene, or of an earlier version of it.
    #[error("the checkpoint is of another scene, or of this scene before it was changed")]
    OtherScene,
    /// Cut short, or with numbers that no simulation has.
    #[error("the checkpoint is damaged")]
    Damaged,
}

pub(super) fn write(fingerprint: u64, state: &State, yielding: &[bool]) -> Vec<u8> {
    let mut bytes = MAGIC.to_vec();
    let numbers = [
        fingerprint,
        state.step,
        state.blocked_steps,
        state.clock.to_bits(),
    ];
    for number in numbers {
        bytes.extend(number.to_le_bytes());
    }
    for vector in state.positions.iter().chain(&state.velocities) {
        vector
            .to_array()
            .iter()
            .for_each(|x| bytes.extend(x.to_le_bytes()));
    }
    bytes.extend(yielding.iter().map(|&yields| u8::from(yields)));
    bytes
}

/// The state, and which bodies yield.
pub(super) fn read(
    bytes: &[u8],
    fingerprint: u64,
    vertices: usize,
) -> Result<(State, Vec<bool>), CheckpointError> {
    let bytes = bytes.strip_prefix(MAGIC).ok_or(CheckpointError::NotOne)?;
    let (words, _) = bytes.as_chunks::<8>();
    let [found, step, blocked_steps, clock, vectors @ ..] = words else {
        return Err(CheckpointError::Damaged);
    };
    if u64::from_le_bytes(*found) != fingerprint {
        return Err(CheckpointError::OtherScene);
    }
    let numbers = vectors
        .get(..6 * vertices)
        .ok_or(CheckpointError::Damaged)?;
    let yielding = &bytes[8 * (4 + 6 * vertices)..];
    let vectors = |range: std::ops::Range<usize>| -> Vec<DVec3> {
        let (vectors, _) = numbers[range].as_chunks::<3>();
        vectors
            .iter()
            .map(|vector| DVec3::from_array(vector.map(f64::from_le_bytes)))
            .collect()
    };
    let state = State {
        step: u64::from_le_bytes(*step),
        blocked_steps: u64::from_le_bytes(*blocked_steps),
        clock: f64::from_le_bytes(*clock),
        positions: vectors(0..3 * vertices),
        velocities: vectors(3 * vertices..6 * vertices),
    };
    let all = state.positions.iter().chain(&state.velocities);
    let is_finite = state.clock.is_finite() && { all }.all(|vector| vector.is_finite());
    if !is_finite || yielding.iter().any(|&byte| byte > 1) {
        return Err(CheckpointError::Damaged);
    }
    Ok((state, yielding.iter().map(|&byte| byte == 1).collect()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn state() -> State {
        State {
            step: 400,
            blocked_steps: 3,
            clock: 0.1,
            positions: vec![DVec3::new(1.0, -0.0, 1e-300), DVec3::X],
            velocities: vec![DVec3::Y, DVec3::splat(f64::MIN_POSITIVE)],
        }
    }

    #[test]
    fn what_is_written_is_read_back_to_the_last_bit() {
        let bytes = write(7, &state(), &[true, false]);
        assert_eq!(read(&bytes, 7, 2), Ok((state(), vec![true, false])));
    }

    #[test]
    fn other_scenes_and_damage_are_noticed() {
        let bytes = write(7, &state(), &[true]);
        assert_eq!(read(&bytes, 8, 2), Err(CheckpointError::OtherScene));
        assert_eq!(read(b"v 0 0 0", 7, 2), Err(CheckpointError::NotOne));
        for length in MAGIC.len()..bytes.len() - 1 {
            assert!(read(&bytes[..length], 7, 2).is_err(), "{length}");
        }
        let mut damaged = bytes.clone();
        damaged[MAGIC.len() + 32..][..8].copy_from_slice(&f64::NAN.to_le_bytes());
        assert_eq!(read(&damaged, 7, 2), Err(CheckpointError::Damaged));
    }
}
