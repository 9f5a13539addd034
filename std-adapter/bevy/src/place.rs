//! The places of entities, in `f64`.

use crate::SelvedgeError;
use bevy_ecs::entity::Entity;
use bevy_ecs::hierarchy::ChildOf;
use bevy_ecs::system::{Query, SystemParam};
use bevy_transform::components::Transform;
use selvedge::glam::{DMat3, DQuat, DVec3};

/// A position p of the entity's mesh is at rotation · (form · p) + translation in the world. The form contains the scale and the
/// shear that results from non-uniform scales of ancestors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place {
    pub(crate) rotation: DQuat,
    pub(crate) form: DMat3,
    pub(crate) translation: DVec3,
}

impl Place {
    fn of(transform: &Transform) -> Self {
        let [x, y, z, w] = transform.rotation.to_array().map(f64::from);
        Self {
            // The quaternion comes from f32 numbers, so its length is one except for rounding.
            rotation: DQuat::from_xyzw(x, y, z, w).normalize(),
            form: DMat3::from_diagonal(widened(transform.scale.to_array())),
            translation: widened(transform.translation.to_array()),
        }
    }

    /// Returns the place in the world of a child that is at `self` in `parent`.
    fn with_parent(self, parent: Self) -> Self {
        let turned = DMat3::from_quat(self.rotation);
        Self {
            rotation: (parent.rotation * self.rotation).normalize(),
            form: turned.transpose() * parent.form * turned * self.form,
            translation: parent.rotation * (parent.form * self.translation) + parent.translation,
        }
    }

    fn is_finite(&self) -> bool {
        self.rotation.is_finite() && self.form.is_finite() && self.translation.is_finite()
    }

    /// Returns whether a motion from one place to the other keeps the form.
    ///
    /// The form is a product of matrices whose numbers come from `f32`. Each ancestor adds errors of a few units in the last
    /// place of `f64`. Below a hundred ancestors they sum to less than 2⁻⁴⁰ of the form. The smallest change of a scale that
    /// `f32` can hold is 2⁻²⁴ of it. Forms that count as equal differ by far less than the rounding of the mesh's positions.
    pub(crate) fn has_form_of(&self, other: &Self) -> bool {
        let largest = |matrix: DMat3| {
            matrix
                .to_cols_array()
                .into_iter()
                .fold(0.0, |most: f64, own| most.max(own.abs()))
        };
        largest(self.form - other.form) <= largest(other.form) * 2.0_f64.powi(-30)
    }

    pub(crate) fn pose(&self) -> (DQuat, DVec3) {
        (self.rotation, self.translation)
    }

    pub(crate) fn linear(&self) -> DMat3 {
        DMat3::from_quat(self.rotation) * self.form
    }

    /// Applies the form to a position, without the pose.
    pub(crate) fn formed(&self, position: [f32; 3]) -> DVec3 {
        self.form * widened(position)
    }

    pub(crate) fn apply(&self, position: [f32; 3]) -> DVec3 {
        self.rotation * self.formed(position) + self.translation
    }
}

fn widened(position: [f32; 3]) -> DVec3 {
    DVec3::from_array(position.map(f64::from))
}

/// Computes the current places of entities from their `Transform`s and those of their ancestors, like
/// [`TransformHelper`](bevy_transform::helper::TransformHelper). `GlobalTransform` is one frame old while the fixed schedules
/// run.
#[derive(SystemParam)]
pub(crate) struct Places<'w, 's> {
    transforms: Query<'w, 's, &'static Transform>,
    parents: Query<'w, 's, &'static ChildOf>,
}

impl Places<'_, '_> {
    pub(crate) fn of(&self, entity: Entity) -> Result<Place, SelvedgeError> {
        let own = |entity| self.transforms.get(entity).map(Place::of);
        let mut place = own(entity).map_err(|_| SelvedgeError::NoTransform { entity })?;
        for ancestor in self.parents.iter_ancestors(entity) {
            let parent = own(ancestor).map_err(|_| SelvedgeError::NoTransform { entity: ancestor })?;
            place = place.with_parent(parent);
        }
        if place.is_finite() {
            Ok(place)
        } else {
            Err(SelvedgeError::BadTransform)
        }
    }

    /// Returns the place of the parent of an entity; `None` without one.
    pub(crate) fn of_parent(&self, entity: Entity) -> Result<Option<Place>, SelvedgeError> {
        let parent = self.parents.get(entity).ok().map(ChildOf::parent);
        parent.map(|parent| self.of(parent)).transpose()
    }
}
