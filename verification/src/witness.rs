//! A checker of the proofs that [`witness`](selvedge_core::elementary::advance::witness) returns, in exact numbers.
//!
//! It shares no arithmetic with core. `docs/witnesses.md` states what it requires, and the format of the file.

mod file;

pub use file::{Answer, Record, WitnessFile, WitnessFileError};

use crate::oracle::volume::{cross, dot, minus};
use rug::Rational;
use selvedge_core::elementary::Impact;
use selvedge_core::elementary::advance::{Proof, Witness};
use selvedge_core::{PairKind, PrimitivePair, Scalar};

type RationalVector = [Rational; 3];
/// A corner at two times.
type Corner = [RationalVector; 2];

/// How often a part is halved to find the sign of its volume.
const HALVINGS: u32 = 80;

/// The bits of a computed length below its own size.
const LENGTH_BITS: u32 = 64;

/// The claim that a pair stays farther apart than a separation from the start of the step until a time.
#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    /// The kind of the pair.
    pub kind: PairKind,
    /// The positions of its points at the start and at the end of the step.
    pub points: [[[f64; 3]; 2]; 4],
    pub separation: f64,
    pub until: f64,
    /// The proof: consecutive parts of the step.
    pub parts: Vec<ExactPart>,
}

/// A part of the step, from the end of the part before.
#[derive(Clone, Debug, PartialEq)]
pub struct ExactPart {
    pub until: f64,
    /// The directions of its proof: none for the volume, one that is held, two of one that turns, three of one that curves.
    pub directions: Vec<[f64; 3]>,
}

impl Claim {
    /// The claim of an answer to which core added `witness`.
    pub fn new<S: Scalar>(pair: &PrimitivePair<S>, separation: S, impact: Impact<S>, witness: &Witness<S>) -> Self {
        let vector = |w: [S; 3]| w.map(S::to_f64);
        let parts = witness.parts().iter().map(|part| ExactPart {
            until: part.until.to_f64(),
            directions: match part.proof {
                Proof::Volume => Vec::new(),
                Proof::Held(w) => vec![vector(w)],
                Proof::Turning(ws) => ws.map(vector).to_vec(),
                Proof::Curving(ws) => ws.map(vector).to_vec(),
            },
        });
        Self {
            kind: pair.kind,
            points: pair
                .motions
                .map(|motion| [motion.start, motion.end].map(|position| vector(position.into()))),
            separation: separation.to_f64(),
            until: impact.time().map_or(1.0, S::to_f64),
            parts: parts.collect(),
        }
    }

    /// Returns whether the parts prove the claim. Numbers that are not finite prove nothing.
    pub fn is_proven(&self) -> bool {
        self.check().is_some()
    }

    fn check(&self) -> Option<()> {
        let pairs: &[[usize; 2]] = match self.kind {
            PairKind::VertexFace => &[[0, 1], [0, 2], [0, 3]],
            PairKind::EdgeEdge => &[[0, 2], [0, 3], [1, 2], [1, 3]],
        };
        let mut corners = Vec::new();
        for &[one, other] in pairs {
            let at = |end: usize| Some(minus(&exact(self.points[one][end])?, &exact(self.points[other][end])?));
            corners.push([at(0)?, at(1)?]);
        }
        let separation = Rational::from_f64(self.separation)?;
        let mut from = Rational::new();
        for part in &self.parts {
            let until = Rational::from_f64(part.until)?;
            if until < from || until > 1 {
                return None;
            }
            let moved: Vec<Corner> = corners.iter().map(|corner| [at(corner, &from), at(corner, &until)]).collect();
            let holds = match part.directions.as_slice() {
                [] => keeps_its_sign(&moved, &separation, HALVINGS),
                directions => {
                    let directions: Option<Vec<RationalVector>> = directions.iter().map(|&w| exact(w)).collect();
                    keeps_apart(&directions?, &moved, &separation)
                }
            };
            if !holds {
                return None;
            }
            from = until;
        }
        (separation >= 0 && from >= Rational::from_f64(self.until)?).then_some(())
    }
}

fn exact(vector: [f64; 3]) -> Option<RationalVector> {
    let [x, y, z] = vector.map(Rational::from_f64);
    Some([x?, y?, z?])
}

fn at([start, end]: &Corner, time: &Rational) -> RationalVector {
    std::array::from_fn(|k| Rational::from(&end[k] - &start[k]) * time + &start[k])
}

/// Returns a number that is no less than s·|w|, by less than a 2⁶⁴th.
fn length_times(separation: &Rational, w: &RationalVector) -> Rational {
    if separation.is_zero() {
        return Rational::new();
    }
    let (numerator, denominator) = dot(w, w).into_numer_denom();
    // |w|² = n/d, so |w| = √(nd)/d.
    let root = ((numerator * &denominator) << (2 * LENGTH_BITS)).sqrt() + 1u32;
    Rational::from((root, denominator << LENGTH_BITS)) * separation
}

/// Returns whether the products of the direction with all corners exceed s times its length: all Bernstein coefficients of each.
///
/// The direction has the control points w₀ … w_d with their binomial factors: the middle one of three counts twice. The
/// coefficients, times factors of their own, are w_k·e₀ + w_{k−1}·e₁.
fn keeps_apart(directions: &[RationalVector], corners: &[Corner], separation: &Rational) -> bool {
    let bars: Vec<Rational> = directions.iter().map(|w| length_times(separation, w)).collect();
    corners.iter().all(|[start, end]| {
        (0..=directions.len()).all(|k| {
            let mut coefficient = Rational::new();
            if k < directions.len() {
                coefficient += dot(&directions[k], start) - &bars[k];
            }
            if k > 0 {
                coefficient += dot(&directions[k - 1], end) - &bars[k - 1];
            }
            coefficient > 0
        })
    })
}

/// Returns whether the signed volume of the first three corners, less s times the length of their normal, keeps its sign.
fn keeps_its_sign(corners: &[Corner], separation: &Rational, halvings: u32) -> bool {
    let [a, b, c] = [&corners[0], &corners[1], &corners[2]];
    let volume = |i: usize, j: usize, k: usize| dot(&a[i], &cross(&b[j], &c[k]));
    // The Bernstein coefficients times 1, 3, 3, 1.
    let volumes = [
        volume(0, 0, 0),
        volume(1, 0, 0) + volume(0, 1, 0) + volume(0, 0, 1),
        volume(0, 1, 1) + volume(1, 0, 1) + volume(1, 1, 0),
        volume(1, 1, 1),
    ];
    let side = |other: &Corner| [0, 1].map(|end| minus(&a[end], &other[end]));
    let ([u0, u1], [v0, v1]) = (side(b), side(c));
    let (first, second) = (cross(&u0, &v1), cross(&u1, &v0));
    // The normal's times 1, 2, 1.
    let middle: RationalVector = std::array::from_fn(|k| Rational::from(&first[k] + &second[k]));
    let [before, middle, after] = [cross(&u0, &v0), middle, cross(&u1, &v1)].map(|normal| length_times(separation, &normal));
    let bars = [before.clone(), Rational::from(&before + &middle), middle + &after, after];
    let is_positive = volumes[0] > 0;
    let exceeds = |volume: &Rational, bar: &Rational| (volume.clone() * if is_positive { 1 } else { -1 }) > *bar;
    if !exceeds(&volumes[0], &bars[0]) || !exceeds(&volumes[3], &bars[3]) {
        return false;
    }
    if volumes.iter().zip(&bars).all(|(volume, bar)| exceeds(volume, bar)) {
        return true;
    }
    let half = Rational::from((1, 2));
    let middle: Vec<RationalVector> = corners.iter().map(|corner| at(corner, &half)).collect();
    let part = |ends: fn(&Corner, &RationalVector) -> Corner| {
        corners
            .iter()
            .zip(&middle)
            .map(|(corner, middle)| ends(corner, middle))
            .collect()
    };
    let first: Vec<Corner> = part(|[start, _], middle| [start.clone(), middle.clone()]);
    let second: Vec<Corner> = part(|[_, end], middle| [middle.clone(), end.clone()]);
    halvings > 0 && keeps_its_sign(&first, separation, halvings - 1) && keeps_its_sign(&second, separation, halvings - 1)
}
