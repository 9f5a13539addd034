//! The compliance of vertices to a push.

/// Returns Σ wᵢ²/mᵢ, the compliance of weighted vertices to a push whose direction is shared by weight and mass. It is zero if no
/// vertex can move.
///
/// A push of p moves vertex i by p·wᵢ/mᵢ over that. If a pinned or heavy vertex has nearly all of the weight, a vertex with
/// little weight would move far to compensate. The result is then larger, so that no vertex moves farther than twice the push.
/// This never applies to free vertices of a face if none is more than four times as heavy as another. With that ratio r, w²·r +
/// (1 − w)²/2 ≥ w·r/2 for all w.
pub(crate) fn mobility<const N: usize>(inverse_masses: &[f64], vertices: [u32; N], weights: [f64; N]) -> f64 {
    let (mut mobility, mut fastest) = (0.0, 0.0_f64);
    for (vertex, weight) in vertices.into_iter().zip(weights) {
        let speed = inverse_masses[vertex as usize] * weight;
        mobility += speed * weight;
        fastest = fastest.max(speed.abs());
    }
    mobility.max(0.5 * fastest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Generates weights of a vertex and a point of a face, arbitrarily near to a corner or a side.
    fn weights() -> impl Strategy<Value = [f64; 4]> {
        let share = || prop_oneof![0.0..=1.0, Just(0.0), (-60..0).prop_map(|e| 2.0_f64.powi(e))];
        (share(), share()).prop_map(|(s, t): (f64, f64)| [1.0, -s, -(1.0 - s) * t, -(1.0 - s) * (1.0 - t)])
    }

    proptest! {
        #[test]
        fn no_vertex_goes_farther_than_twice_the_push(
            weights in weights(),
            inverse_masses in prop::array::uniform4(prop_oneof![Just(0.0), 1e-3..1e3_f64]),
        ) {
            let mobility = mobility(&inverse_masses, [0, 1, 2, 3], weights);
            for (inverse_mass, weight) in inverse_masses.into_iter().zip(weights) {
                let share = inverse_mass * weight / mobility;
                prop_assert!(inverse_mass * weight == 0.0 || share.abs() <= 2.0, "{share}");
            }
        }

        /// A push has its full effect where something can move.
        #[test]
        fn free_vertices_of_like_masses_share_a_push_by_mass_and_weight_alone(
            weights in weights(),
            inverse_masses in prop::array::uniform4(1.0..4.0_f64),
            is_kinematic in any::<bool>(),
        ) {
            let mut inverse_masses = inverse_masses;
            if is_kinematic {
                inverse_masses[0] = 0.0;
            }
            let all: f64 = inverse_masses.into_iter().zip(weights).map(|(inverse_mass, weight)| inverse_mass * weight * weight).sum();
            let mobility = mobility(&inverse_masses, [0, 1, 2, 3], weights);
            prop_assert!((mobility - all).abs() <= 1e-12 * all, "{mobility} instead of {all}");
        }
    }
}
