//! A constraint on a few vertices.

use selvedge_core::glam::DVec3;
use std::fmt::Debug;

pub(crate) trait Local<const N: usize>: Debug + Send + Sync {
    /// The multipliers of compliant constraints. They are kept from sweep to sweep of a step, and are zero before the first.
    /// Without compliance the type is `()`.
    type Multipliers: Copy + Debug + Default + Send + Sync;

    /// Returns true only if all corrections are zero. The test is quick, and may miss such cases.
    fn moves_nothing(&self, _positions: [DVec3; N]) -> bool {
        false
    }

    /// True if the constraint has [room](Self::room).
    const HAS_ROOM: bool = false;

    /// Returns a sum of the ways of its vertices, in metres, while which all corrections stay zero. It is not positive if some may
    /// not be zero already.
    fn room(&self, _positions: [DVec3; N]) -> f64 {
        0.0
    }

    /// Returns the correction of each vertex. `stiffening` is 1/h², the factor of compliances.
    ///
    /// `so_far` has the multipliers of earlier sweeps of the step; this sweep adds to them.
    fn corrections(
        &self,
        positions: [DVec3; N],
        inverse_masses: [f64; N],
        stiffening: f64,
        so_far: &mut Self::Multipliers,
    ) -> [DVec3; N];

    /// Returns the elastic energy in J, or `None` if the constraint never stores any.
    fn energy(&self, _positions: [DVec3; N]) -> Option<f64> {
        None
    }
}

/// The vertices of a constraint, and the constraint.
pub(crate) type On<C, const N: usize> = ([u32; N], C);
