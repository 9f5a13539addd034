//! Tests the work of a decision. (`verification/` checks decisions against the oracle.)

extern crate std;

use super::touches;
use crate::{Motion, PairKind, PrimitivePair};
use glam::DVec3;
use std::cell::Cell;

std::thread_local! {
    static SIGNS: Cell<u32> = const { Cell::new(0) };
}

pub(super) fn count_a_sign() {
    SIGNS.set(SIGNS.get() + 1);
}

/// Returns the most signs at roots that a pair took, out of many whose coordinates are whole numbers up to `limit`. Those along
/// some axes are all zero, or the same at the start and at the end.
fn most_signs(kind: PairKind, limit: u64) -> u32 {
    let mut state = 0x9E37_79B9_7F4A_7C15_u64;
    let mut random = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        state >> 33
    };
    let mut most = 0;
    for _ in 0..100_000 {
        let mut points = || {
            [(); 4].map(|()| {
                let [x, y, z] = [(); 3].map(|()| (random() % (limit + 1)) as f64);
                DVec3::new(x, y, z)
            })
        };
        let (start, mut end) = (points(), points());
        let flat = random() % 8;
        let mut start = start;
        for (a, b) in start.iter_mut().zip(&mut end) {
            if flat & 1 != 0 {
                (a.z, b.z) = (0.0, 0.0);
            }
            if flat & 3 == 3 {
                (a.y, b.y) = (0.0, 0.0);
            }
            if flat & 4 != 0 {
                b.x = a.x;
            }
        }
        let mut motions = start.map(Motion::resting);
        for (motion, end) in motions.iter_mut().zip(end) {
            motion.end = end;
        }
        SIGNS.set(0);
        assert!(touches(&PrimitivePair { kind, motions }).is_some());
        most = most.max(SIGNS.get());
    }
    most
}

#[test]
fn no_more_signs_are_taken_than_stated() {
    for limit in [1, 2, 5, 1000] {
        let most = [PairKind::VertexFace, PairKind::EdgeEdge].map(|kind| most_signs(kind, limit));
        // Some signs are taken, so that they are counted at all.
        assert!(most.iter().all(|most| (10..=864).contains(most)), "{most:?}");
    }
}
