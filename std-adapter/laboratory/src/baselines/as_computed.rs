//! Decides by the signs of the control values as computed. **Not certified**: rounding makes it cull a colliding pair now and
//! then.
//!
//! The certified filters ([`Filter`]) compute the same values, and also require that they exceed a bound of their rounding error.
//! The comparison with this baseline shows what that costs and what it prevents.

use selvedge_core::batch::VolumeTest;
use selvedge_core::filter::{Filter, Tier};
use selvedge_core::kernels::coplanarity::{Decision, MovingTetrahedron};
use selvedge_core::kernels::lanes::{Lanes, Rounding};
use selvedge_core::kernels::of_kind;
use selvedge_core::kernels::points::PairShape;
use selvedge_core::{PrimitivePair, Scalar, Verdict};

/// Culls pairs whose control values have one strict sign as computed, and exceed the separation if there is one. For batches, see
/// [`ByVolume`](selvedge_core::batch::ByVolume).
///
/// ```
/// use selvedge_core::{glam::DVec3, Motion, PrimitivePair};
/// use selvedge_laboratory::baselines::as_computed::AsComputed;
/// let pair = PrimitivePair::vertex_face(
///     Motion::new(DVec3::new(0.2, 0.2, 2.0), DVec3::new(0.2, 0.2, 1.0)),
///     [DVec3::ZERO, DVec3::X, DVec3::Y].map(Motion::resting),
/// );
/// assert!(AsComputed::new().verdict(&pair).is_culled());
/// assert!(!AsComputed::new().with_separation(1.5).unwrap().verdict(&pair).is_culled());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AsComputed<S> {
    separation: S,
}

impl<S: Scalar> AsComputed<S> {
    /// Makes a filter for pairs that never touch: the separation is zero.
    pub const fn new() -> Self {
        Self { separation: S::ZERO }
    }

    /// Makes a filter for pairs that must stay farther apart than `separation`. It accepts the separations that
    /// [`Filter::with_separation`] accepts.
    pub fn with_separation(self, separation: S) -> Option<Self> {
        let separation = Filter::new(Tier::Permanent).with_separation(separation)?.separation();
        Some(Self { separation })
    }

    /// Culls `pair`, or keeps it. Either result may be wrong.
    #[inline]
    pub fn verdict(&self, pair: &PrimitivePair<S>) -> Verdict {
        Verdict::culled_if(of_kind!(pair.kind, P => self.on::<P, S>(&pair.into()).culled))
    }
}

impl<S: Scalar> Default for AsComputed<S> {
    fn default() -> Self {
        Self::new()
    }
}

impl<S: Scalar> VolumeTest for AsComputed<S> {
    #[inline(always)]
    fn on<P: PairShape, L: Lanes<Scalar: Scalar>>(self, tetrahedron: &MovingTetrahedron<L>) -> Decision<L::Mask> {
        let constant = |value| tetrahedron.p[0].x.splat(value);
        let zero = constant(L::Scalar::ZERO);
        let clearances = if self.separation > S::ZERO {
            let outer = constant(L::Scalar::from_f64(self.separation.to_f64())) * tetrahedron.largest_normal(P::KIND);
            let inner = outer * constant(L::Scalar::small(3));
            [outer, inner, inner, outer]
        } else {
            [zero; 4]
        };
        Decision {
            culled: tetrahedron.control_values().one_sign_beyond(clearances),
            settled: zero.greater(zero),
        }
    }
}
