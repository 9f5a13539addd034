//! The closest points of many pairs.

use super::chunk::Chunk;
use super::mask::LANES;
use crate::kind::PairKind;
use crate::points::PairShape;
use crate::separation::closest::{ClosestInLanes, ClosestPoints};
use crate::vector::Vector;
use fearless_simd::Level;
#[cfg(not(unoptimised))]
use fearless_simd::{Simd, f64x2, f64x4, f64x8};
use glam::DVec3;

/// Writes to `closest` the closest points of each pair, given its four points: the same bits as [`ClosestPoints::from_points`],
/// except in NaN. Handles as many pairs as both slices have. The result is not certified.
///
/// ```
/// use selvedge_core::batch::{Level, closest_points};
/// use selvedge_core::{PairKind, glam::DVec3, separation::closest::ClosestPoints};
///
/// let face = [DVec3::ZERO, DVec3::X, DVec3::Y];
/// let above = [0.5, 0.25].map(|height| [DVec3::new(0.2, 0.2, height), face[0], face[1], face[2]]);
/// let mut closest = [ClosestPoints::default(); 2];
/// closest_points(Level::baseline(), PairKind::VertexFace, &above, &mut closest);
/// assert_eq!(closest.map(|own| own.distance()), [0.5, 0.25]);
/// ```
pub fn closest_points(level: Level, kind: PairKind, pairs: &[[DVec3; 4]], closest: &mut [ClosestPoints]) {
    for (pairs, closest) in pairs.chunks(LANES).zip(closest.chunks_mut(LANES)) {
        let mut sixteen = SixteenPoints([[[0.0; LANES]; 3]; 4]);
        for (lane, pair) in pairs.iter().enumerate() {
            for (rows, point) in sixteen.0.iter_mut().zip(pair) {
                for (row, coordinate) in rows.iter_mut().zip(point.to_array()) {
                    row[lane % LANES] = coordinate;
                }
            }
        }
        let Offsets {
            weights,
            offset,
            direction,
        } = found(level, kind, &sixteen);
        let vector = |[x, y, z]: &[[f64; LANES]; 3], lane: usize| DVec3::new(x[lane], y[lane], z[lane]);
        for (lane, closest) in closest.iter_mut().enumerate() {
            let lane = lane % LANES;
            *closest = ClosestPoints {
                weights: weights.map(|row| row[lane]),
                offset: vector(&offset, lane),
                direction: vector(&direction, lane),
            };
        }
    }
}

/// The coordinates of sixteen pairs' four points.
struct SixteenPoints([[[f64; LANES]; 3]; 4]);

/// The closest points of sixteen pairs.
struct Offsets {
    weights: [[f64; LANES]; 4],
    offset: [[f64; LANES]; 3],
    direction: [[f64; LANES]; 3],
}

fn found(level: Level, kind: PairKind, pairs: &SixteenPoints) -> Offsets {
    of_kind!(kind, P => vectorized!(level, [f64x8, f64x4, f64x2, f64], all::<P>(pairs)))
}

#[inline(always)]
fn all<P: PairShape, L: Chunk<Scalar = f64>>(token: L::Token, SixteenPoints(pairs): &SixteenPoints) -> Offsets {
    let mut offsets = Offsets {
        weights: [[0.0; LANES]; 4],
        offset: [[0.0; LANES]; 3],
        direction: [[0.0; LANES]; 3],
    };
    for chunk in 0..LANES / L::WIDTH {
        let first = chunk * L::WIDTH;
        // These are macros, since a closure that is not inlined has none of the machine's instructions.
        macro_rules! point {
            ($point:literal) => {
                Vector::new(
                    L::load(token, &pairs[$point][0], first),
                    L::load(token, &pairs[$point][1], first),
                    L::load(token, &pairs[$point][2], first),
                )
            };
        }
        macro_rules! store {
            ($vector:expr, $rows:expr) => {
                $vector.x.store(&mut $rows[0], first);
                $vector.y.store(&mut $rows[1], first);
                $vector.z.store(&mut $rows[2], first);
            };
        }
        let found = ClosestInLanes::<L>::of::<P>([point!(0), point!(1), point!(2), point!(3)]);
        let [a, b, c, d] = found.weights;
        a.store(&mut offsets.weights[0], first);
        b.store(&mut offsets.weights[1], first);
        c.store(&mut offsets.weights[2], first);
        d.store(&mut offsets.weights[3], first);
        store!(found.offset, offsets.offset);
        store!(found.direction, offsets.direction);
    }
    offsets
}
