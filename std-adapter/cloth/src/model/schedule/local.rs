//! A constraint on a few vertices.

use selvedge_core::glam::DVec3;
use std::fmt::Debug;

/// A constraint on `N` vertices.
pub(crate) trait Local<const N: usize>: Debug + Send + Sync {
    /// The multipliers of compliant constraints, kept from sweep to sweep of a step and zero before the first; `()` without
    /// compliance.
    type Multipliers: Copy + Debug + Default + Send + Sync;

    /// A quick test: returns true only if all corrections are zero.
    fn moves_nothing(&self, _positions: [DVec3; N]) -> bool {
        false
    }

    /// Returns the correction of each vertex. `stiffening` is 1/h², the factor of compliances.
    ///
    /// `so_far` has the multipliers of earlier sweeps of the step, to which this one adds.
    fn corrections(
        &self,
        positions: [DVec3; N],
        inverse_masses: [f64; N],
        stiffening: f64,
        so_far: &mut Self::Multipliers,
    ) -> [DVec3; N];

    /// Returns the elastic energy in J; `None` if the constraint never stores any.
    fn energy(&self, _positions: [DVec3; N]) -> Option<f64> {
        None
    }
}

/// The vertices of a constraint, and the constraint.
pub(crate) type On<C, const N: usize> = ([u32; N], C);
