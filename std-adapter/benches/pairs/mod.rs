//! Pairs for measurements, the same on every machine.

#![allow(dead_code, reason = "each bench uses a part")]

use selvedge_core::filter::certified::non_coplanarity;
use selvedge_core::kernels::exact::{UNKNOWN, is_never_coplanar};
use selvedge_core::{Motion, PairKind, PrimitivePair, Scalar};

/// The number of pairs in a set: too many for the processor to learn their branches, few enough for the cache.
pub(crate) const COUNT: usize = 1024;

/// Uniform numbers by `SplitMix64`.
struct Random(u64);

impl Random {
    fn word(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ z >> 31
    }

    /// Returns a number between −`limit` and `limit`.
    fn within(&mut self, limit: f64) -> f64 {
        let unit = (self.word() >> 11) as f64 / (1_u64 << 53) as f64;
        limit * (2.0 * unit - 1.0)
    }

    fn position(&mut self, limit: f64) -> [f64; 3] {
        std::array::from_fn(|_| self.within(limit))
    }
}

/// Makes a pair from the start and the end of each point, rounded.
fn vertex_face<S: Scalar>(points: [[[f64; 3]; 2]; 4]) -> PrimitivePair<S> {
    let rounded = |position: [f64; 3]| position.map(S::from_f64).into();
    PrimitivePair::new(
        PairKind::VertexFace,
        points.map(|[start, end]| Motion {
            start: rounded(start),
            end: rounded(end),
        }),
    )
}

fn plus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|axis| a[axis] + b[axis])
}

/// Makes features of a centimetre in a cube of two metres, which move by up to a centimetre.
pub(crate) fn cloth<S: Scalar>() -> Vec<PrimitivePair<S>> {
    let mut random = Random(1);
    let mut pair = || {
        let place = random.position(1.0);
        let start = [(); 4].map(|()| plus(place, random.position(0.01)));
        vertex_face(start.map(|position| [position, plus(position, random.position(0.01))]))
    };
    (0..COUNT).map(|_| pair()).collect()
}

/// Makes pairs whose eight positions are within rounding of one tilted plane.
pub(crate) fn nearly_coplanar<S: Scalar>() -> Vec<PrimitivePair<S>> {
    let mut random = Random(2);
    let pairs = std::iter::repeat_with(|| near_a_plane(&mut random, 0.0));
    pairs.filter(is_undecided).take(COUNT).collect()
}

/// Makes pairs whose vertex lies a few units in the last place above the plane of the face. That is too little for floating
/// point, but all four control values have one sign, so that all four must be computed.
pub(crate) fn barely_above<S: Scalar>() -> Vec<PrimitivePair<S>> {
    let mut random = Random(3);
    let height = 4.0 * S::UNIT_ROUNDOFF.to_f64();
    let pairs = std::iter::repeat_with(|| near_a_plane(&mut random, height));
    let is_hard = |pair: &_| is_undecided(pair) && is_never_coplanar(pair, UNKNOWN);
    pairs.filter(is_hard).take(COUNT).collect()
}

fn near_a_plane<S: Scalar>(random: &mut Random, height: f64) -> PrimitivePair<S> {
    let [x_slope, y_slope, base] = random.position(0.5);
    let mut positions = [[[0.0; 3]; 2]; 4];
    for end in 0..2 {
        for (point, position) in positions.iter_mut().enumerate() {
            // Coordinates are on the grid of `S`, so that rounding to `S` does not lift a point from the plane by a slope.
            let [x, y, _] = random.position(1.0).map(|x| S::from_f64(x).to_f64());
            let above = if point == 0 { height } else { 0.0 };
            position[end] = [x, y, x_slope * x + y_slope * y + base + above];
        }
    }
    vertex_face(positions)
}

fn is_undecided<S: Scalar>(pair: &PrimitivePair<S>) -> bool {
    !non_coplanarity(pair).is_culled()
}

/// Makes pairs with coordinates of all sizes: each exponent is as likely as the others.
pub(crate) fn all_sizes<S: Scalar>() -> Vec<PrimitivePair<S>> {
    let mut random = Random(4);
    let largest = (1 << (S::EXPONENT_BITS - 1)) - 1;
    let mut coordinate = || {
        let exponent = (random.word() % (2 * largest as u64)) as i32 - largest;
        S::from_f64(libm::ldexp(random.within(1.0), exponent))
    };
    let mut position = || [(); 3].map(|()| coordinate()).into();
    let mut four = || [(); 4].map(|()| position());
    let mut pair = || {
        let mut motions = four().map(|start| Motion { start, end: start });
        for (motion, end) in motions.iter_mut().zip(four()) {
            motion.end = end;
        }
        PrimitivePair::new(PairKind::VertexFace, motions)
    };
    (0..COUNT).map(|_| pair()).collect()
}

/// Makes pairs in which a point of one set begins and ends its way near a corner of the other: within 2 to the power of
/// −`exponent` along each axis. All other coordinates are eighths.
pub(crate) fn sliding<S: Scalar>(kind: PairKind, exponent: i32) -> Vec<PrimitivePair<S>> {
    let mut random = Random(5);
    let (mover, corner) = match kind {
        PairKind::VertexFace => (0, 1),
        PairKind::EdgeEdge => (1, 3),
    };
    let distance = 0.5_f64.powi(exponent);
    let mut pair = || {
        let mut points = [(); 4].map(|()| [(); 2].map(|()| random.position(8.0).map(|x| x.round() / 8.0)));
        for end in 0..2 {
            points[mover][end] = plus(points[corner][end], random.position(distance));
        }
        PrimitivePair {
            kind,
            ..vertex_face(points)
        }
    };
    (0..COUNT).map(|_| pair()).collect()
}
