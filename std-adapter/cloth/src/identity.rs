//! Bytes that distinguish a scene from others, so that checkpoints know theirs.

use selvedge::Mesh;
use selvedge_core::glam::{DQuat, DVec3};
use selvedge_files::bytes::Fingerprint;
use std::sync::Arc;

/// A digest of all that a scene depends on. It does not depend on the versions of the crates that this one uses.
#[derive(Default)]
pub struct Identity(Fingerprint);

impl Identity {
    /// Adds bytes.
    pub fn add(&mut self, bytes: &[u8]) {
        self.0.take(bytes);
    }

    pub(crate) fn value(&self) -> u64 {
        self.0.value()
    }
}

/// A setting of a scene, whose bytes checkpoints use to distinguish scenes. [`identify!`](crate::identify) implements it.
pub trait Identify {
    /// Adds bytes that differ if the value differs.
    fn identify(&self, identity: &mut Identity);
}

/// Implements [`Identify`] for a struct by all of its fields, or for an enum by a number for each variant.
///
/// ```
/// use selvedge_cloth::identify;
///
/// struct Magnet {
///     strength: f64,
///     until: Option<f64>,
/// }
/// identify!(Magnet { strength, until });
///
/// struct Ceiling(f64);
/// identify!(Ceiling { 0 });
///
/// enum Pole {
///     North,
///     Other(f64),
/// }
/// identify!(enum Pole { 0 => North, 1 => Other(angle) });
/// ```
#[macro_export]
macro_rules! identify {
    (enum $type:ty { $($number:literal => $variant:ident $(($inner:ident))?),* $(,)? }) => {
        impl $crate::Identify for $type {
            fn identify(&self, identity: &mut $crate::Identity) {
                match self {
                    $(Self::$variant $(($inner))? => {
                        identity.add(&[$number]);
                        $($crate::Identify::identify($inner, identity);)?
                    })*
                }
            }
        }
    };
    ($type:ty { $($field:tt),* $(,)? }) => {
        impl $crate::Identify for $type {
            fn identify(&self, identity: &mut $crate::Identity) {
                // A field that is not listed does not compile.
                let Self { $($field: _),* } = self;
                // A struct may have no fields.
                let _ = &identity;
                $($crate::Identify::identify(&self.$field, identity);)*
            }
        }
    };
}

macro_rules! numbers {
    ($($number:ty),*) => {$(
        impl Identify for $number {
            fn identify(&self, identity: &mut Identity) {
                identity.add(&self.to_le_bytes());
            }
        }
    )*};
}

numbers!(f64, u32, u64);

impl Identify for usize {
    fn identify(&self, identity: &mut Identity) {
        (*self as u64).identify(identity);
    }
}

impl Identify for bool {
    fn identify(&self, identity: &mut Identity) {
        u32::from(*self).identify(identity);
    }
}

impl Identify for str {
    fn identify(&self, identity: &mut Identity) {
        self.len().identify(identity);
        identity.add(self.as_bytes());
    }
}

impl Identify for String {
    fn identify(&self, identity: &mut Identity) {
        self.as_str().identify(identity);
    }
}

impl Identify for DVec3 {
    fn identify(&self, identity: &mut Identity) {
        self.to_array().identify(identity);
    }
}

impl Identify for DQuat {
    fn identify(&self, identity: &mut Identity) {
        self.to_array().identify(identity);
    }
}

impl<T: Identify, const N: usize> Identify for [T; N] {
    fn identify(&self, identity: &mut Identity) {
        self.iter().for_each(|item| item.identify(identity));
    }
}

impl<T: Identify, U: Identify> Identify for (T, U) {
    fn identify(&self, identity: &mut Identity) {
        self.0.identify(identity);
        self.1.identify(identity);
    }
}

impl<T: Identify> Identify for [T] {
    fn identify(&self, identity: &mut Identity) {
        self.len().identify(identity);
        self.iter().for_each(|item| item.identify(identity));
    }
}

impl<T: Identify> Identify for Vec<T> {
    fn identify(&self, identity: &mut Identity) {
        self.as_slice().identify(identity);
    }
}

impl<T: Identify> Identify for Option<T> {
    fn identify(&self, identity: &mut Identity) {
        self.as_slice().identify(identity);
    }
}

impl<T: Identify + ?Sized> Identify for Arc<T> {
    fn identify(&self, identity: &mut Identity) {
        (**self).identify(identity);
    }
}

identify!(Mesh { positions, triangles });

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::Body;

    fn value(of: &dyn Identify) -> u64 {
        let mut identity = Identity::default();
        of.identify(&mut identity);
        identity.value()
    }

    /// Contact uses the smooth surface of a ball, and the faces of its mesh.
    #[test]
    fn a_ball_is_another_body_than_its_mesh() {
        let ball = Body::ball("ball", DVec3::ZERO, 0.1, 8).unwrap();
        let mesh = Body::from_mesh("ball", ball.mesh.clone());
        assert_ne!(value(&ball), value(&mesh));
    }

    #[test]
    fn values_that_differ_have_other_bytes() {
        let lists: [&dyn Identify; 4] = [
            &vec![vec![1_u32], vec![]],
            &vec![vec![], vec![1_u32]],
            &[Some(1_u32), None],
            &[None, Some(1_u32)],
        ];
        let mut values = lists.map(value).to_vec();
        values.extend([0.0, -0.0, f64::MIN_POSITIVE].map(|number| value(&number)));
        values.extend([["a", "bc"], ["ab", "c"]].map(|texts| value(&texts.map(str::to_owned))));
        for (index, one) in values.iter().enumerate() {
            assert!(!values[..index].contains(one), "value {index}");
        }
    }
}
