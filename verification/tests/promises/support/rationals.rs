//! Separations at which the answer about the signed volume changes.

use rug::Float;
use selvedge_verification::generator::{Format, PairCase};
use selvedge_verification::oracle::InRationals;

/// Returns separations at which the answer changes, and others of every size.
pub(crate) fn separations<S: Format>(pair: &PairCase<S>, exact: &InRationals) -> Vec<S> {
    // The largest separation that the control values exceed, saturating; 0 if they do not have one sign.
    let critical = exact.squared_separation().map_or(S::ZERO, |square| {
        S::from_f64(Float::with_val(200, square).sqrt().to_f64()).made_finite()
    });
    let mut separations = vec![S::ZERO.up(), S::LARGEST];
    separations.extend([-2, -1, 0, 1, 2].map(|steps| critical.nudged(steps).abs()));
    let [[x, y, _], _] = pair.points[1];
    separations.extend([x.abs(), y.abs()]);
    separations
}
