//! Computes how far the points of many pairs may [stray](crate::separation::clearance).

use super::chunk::{Chunk, points};
use super::mask::LANES;
use super::rows::{Padded, VertexRow};
use super::sixteen::Sixteen;
use crate::kind::PairKind;
use crate::points::PairShape;
use crate::separation::clearance::{Clearance, largest_stray};
use fearless_simd::Level;
#[cfg(not(unoptimised))]
use fearless_simd::{Simd, f32x4, f32x8, f32x16};

/// Writes to `strays` how far the points of each pair may stray: the same bits as [`Clearance::largest_stray`]. `classes` selects
/// each pair's clearance. The value is less than zero if points may not stray, an index is not in the rows, or a class has no
/// clearance. Handles as many pairs as all slices have.
///
/// Rows hold positions rounded to the nearest `f32`, in any rounding direction.
///
/// ```
/// use selvedge_core::batch::{Level, VertexRow, largest_strays_from_rows};
/// use selvedge_core::{Motion, PairKind, glam::Vec3, separation::clearance::Clearance};
///
/// let points = [Vec3::new(0.2, 0.2, 0.5), Vec3::ZERO, Vec3::X, Vec3::Y];
/// let rows = points.map(|point| VertexRow::new(Motion::resting(point)));
/// let clearances = [0.1, 0.6].map(|distance| Clearance::new(distance, 1.0, 0.0));
/// let mut strays = [0.0; 2];
/// let level = Level::baseline();
/// largest_strays_from_rows(level, PairKind::VertexFace, &clearances, &rows, &[[0, 1, 2, 3]; 2], &[0, 1], &mut strays);
/// assert!(strays[0] > 0.3999 && strays[1] < 0.0);
/// ```
pub fn largest_strays_from_rows(
    level: Level,
    kind: PairKind,
    clearances: &[Clearance],
    rows: &[VertexRow<f32>],
    pairs: &[[u32; 4]],
    classes: &[u8],
    strays: &mut [f32],
) {
    let all = pairs.chunks(LANES).zip(classes.chunks(LANES)).zip(strays.chunks_mut(LANES));
    for ((indices, classes), own) in all {
        let mut asked = [[f32::INFINITY; LANES]; 2];
        for (lane, &class) in classes.iter().enumerate() {
            let clearance = clearances.get(usize::from(class)).unwrap_or(&Clearance::UNKNOWN);
            [asked[0][lane % LANES], asked[1][lane % LANES]] = clearance.asked();
        }
        let whole = match (indices.first_chunk(), own.first_chunk_mut()) {
            (Some(indices), Some(strays)) => sixteen(level, kind, &asked, rows, indices, strays),
            _ => None,
        };
        if whole.is_none() {
            padded(level, kind, &asked, rows, indices, own);
        }
    }
}

/// Handles fewer than sixteen pairs, or some whose indices are not in `rows`.
#[cold]
fn padded(
    level: Level,
    kind: PairKind,
    asked: &[[f32; LANES]; 2],
    rows: &[VertexRow<f32>],
    indices: &[[u32; 4]],
    strays: &mut [f32],
) {
    let mut known = 0;
    let mut all = [f32::NEG_INFINITY; LANES];
    if let Some(padded) = Padded::new(indices, rows.len()) {
        let looked_at = sixteen(level, kind, asked, rows, &padded.indices, &mut all);
        known = if looked_at.is_some() { padded.known } else { 0 };
    }
    for (lane, (own, stray)) in strays.iter_mut().zip(all).enumerate() {
        *own = if known >> lane & 1 != 0 { stray } else { f32::NEG_INFINITY };
    }
}

/// Returns `None` if an index is not in the rows.
fn sixteen(
    level: Level,
    kind: PairKind,
    asked: &[[f32; LANES]; 2],
    rows: &[VertexRow<f32>],
    indices: &[[u32; 4]; LANES],
    strays: &mut [f32; LANES],
) -> Option<()> {
    of_kind!(kind, P => vectorized!(level, [f32x16, f32x8, f32x4, f32], all::<P>(asked, rows, indices, strays)))
}

#[inline(always)]
fn all<P: PairShape, L: Chunk<Scalar = f32>>(
    token: L::Token,
    asked: &[[f32; LANES]; 2],
    rows: &[VertexRow<f32>],
    indices: &[[u32; 4]; LANES],
    strays: &mut [f32; LANES],
) -> Option<()> {
    for chunk in 0..LANES / L::WIDTH {
        let first = chunk * L::WIDTH;
        let points = points::<L>(token, Sixteen::Mesh { rows, indices }, first)?;
        let asked = [L::load(token, &asked[0], first), L::load(token, &asked[1], first)];
        largest_stray::<P, L>(&points, asked).store(strays, first);
    }
    Some(())
}
