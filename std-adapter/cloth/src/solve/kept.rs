//! What a solve keeps from step to step, as bytes: the forces of contacts by their keys, the multipliers of terms, and the motion
//! before the present step. A checkpoint has them, so that a resumed simulation goes on with the same bits.

use super::Solve;
use super::contact_row::{Remembered, RowKey};
use super::prediction::MotionHistory;
use selvedge::PairKind;
use selvedge_core::glam::DVec3;
use selvedge_files::bytes::Reader;

/// What a solve keeps, read from bytes.
#[derive(Debug)]
pub(crate) struct Kept {
    pushes: Vec<(RowKey, Remembered)>,
    multipliers: Vec<f64>,
    history: MotionHistory,
}

impl Solve {
    /// Returns the multipliers of all terms, one after the other.
    fn multipliers(&self) -> Vec<f64> {
        self.terms.iter().flat_map(|entry| entry.action.multipliers()).collect()
    }

    /// Writes what the solve keeps.
    pub(crate) fn write_kept(&self, history: &MotionHistory) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut pushes: Vec<_> = self.pushes.iter().collect();
        pushes.sort_unstable_by_key(|(key, _)| **key);
        bytes.extend((pushes.len() as u64).to_le_bytes());
        for (key, remembered) in pushes {
            let (tag, [first, second]) = match *key {
                RowKey::Pair((PairKind::VertexFace, pair)) => (0, pair),
                RowKey::Pair((PairKind::EdgeEdge, pair)) => (1, pair),
                RowKey::Smooth(vertex, body) => (2, [vertex, body]),
            };
            bytes.extend([tag, first, second].into_iter().flat_map(u32::to_le_bytes));
            bytes.extend(remembered.numbers().into_iter().flat_map(f64::to_le_bytes));
        }
        bytes.extend(self.multipliers().into_iter().flat_map(f64::to_le_bytes));
        bytes.extend(history.h.to_le_bytes());
        bytes.extend((history.positions.len() as u64).to_le_bytes());
        let vectors = history.positions.iter().chain(&history.velocities);
        bytes.extend(vectors.flat_map(|vector| vector.to_array()).flat_map(f64::to_le_bytes));
        bytes.extend(history.is_first_order.iter().map(|&is| u8::from(is)));
        bytes
    }

    /// Reads what [`write_kept`](Self::write_kept) has written, for so many vertices in all and of cloth; `None` if it is
    /// damaged.
    pub(crate) fn read_kept(&self, bytes: &[u8], [vertices, of_cloth]: [usize; 2]) -> Option<Kept> {
        let mut reader = Reader(bytes);
        let mut pushes = Vec::new();
        for _ in 0..reader.u64()? {
            let [tag, first, second] = [reader.u32()?, reader.u32()?, reader.u32()?];
            let key = match tag {
                0 => RowKey::Pair((PairKind::VertexFace, [first, second])),
                1 => RowKey::Pair((PairKind::EdgeEdge, [first, second])),
                2 => RowKey::Smooth(first, second),
                _ => return None,
            };
            pushes.push((key, Remembered::from_numbers(finite(&mut reader)?)));
        }
        let count = self.multipliers().len();
        let multipliers = (0..count)
            .map(|_| finite(&mut reader).map(|[number]| number))
            .collect::<Option<_>>()?;
        let [h] = finite(&mut reader)?;
        let known = usize::try_from(reader.u64()?).ok()?;
        if known != 0 && known != vertices {
            return None;
        }
        let mut vectors = || {
            (0..known)
                .map(|_| finite(&mut reader).map(DVec3::from_array))
                .collect::<Option<Vec<_>>>()
        };
        let (positions, velocities) = (vectors()?, vectors()?);
        let is_first_order: Vec<bool> = reader.0.iter().map(|&byte| byte == 1).collect();
        if !is_first_order.is_empty() && is_first_order.len() != of_cloth || known != 0 && is_first_order.is_empty() {
            return None;
        }
        Some(Kept {
            pushes,
            multipliers,
            history: MotionHistory {
                positions,
                velocities,
                h,
                is_first_order,
            },
        })
    }

    /// Continues with what another solve has kept.
    pub(crate) fn keep(&mut self, kept: Kept, history: &mut MotionHistory) {
        self.pushes = kept.pushes.into_iter().collect();
        let mut numbers = &kept.multipliers[..];
        for entry in &mut self.terms {
            let own;
            (own, numbers) = numbers.split_at(entry.action.multipliers().len());
            entry.action.set_multipliers(own);
        }
        *history = kept.history;
    }
}

fn finite<const N: usize>(reader: &mut Reader<'_>) -> Option<[f64; N]> {
    reader
        .numbers()
        .filter(|numbers| numbers.iter().all(|number| number.is_finite()))
}
