//! Worlds of meshes: random choices, motions, and contacts with their geometry.

use super::prelude::*;
use selvedge::glam::DQuat;
use selvedge::{Geometry, MeshHandle, MeshMotion, World, WorldContact};
use selvedge_verification::random::Random;
use std::f64::consts::PI;

/// Random choices from a seed. Seeds that once failed are kept, so the sequence of choices must not change.
pub(crate) struct Chance(Random);

impl Chance {
    pub(crate) const fn new(seed: u64) -> Self {
        Self(Random(seed))
    }

    pub(crate) fn below(&mut self, count: usize) -> usize {
        (self.0.word() % count as u64) as usize
    }

    pub(crate) fn pick<T: Copy>(&mut self, options: &[T]) -> T {
        options[self.below(options.len())]
    }

    /// Returns a number in [-1, 1].
    pub(crate) fn unit(&mut self) -> f64 {
        (self.0.word() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    pub(crate) fn vector(&mut self) -> DVec3 {
        DVec3::new(self.unit(), self.unit(), self.unit())
    }

    /// Chooses positions with many equal coordinates, or with none.
    pub(crate) fn point(&mut self, on_lattice: bool) -> DVec3 {
        let point = self.vector();
        if on_lattice { (point * 2.0).round() * 0.5 } else { point }
    }

    pub(crate) fn rotation(&mut self) -> DQuat {
        DQuat::from_axis_angle(DVec3::new(self.unit(), self.unit(), 1.5).normalize(), PI * self.unit())
    }
}

pub(crate) fn narrow<S: Scalar>(point: DVec3) -> [S; 3] {
    point.to_array().map(S::from_f64)
}

pub(crate) fn wide<S: Scalar>(point: [S; 3]) -> DVec3 {
    point.map(S::to_f64).into()
}

/// A contact, its vertices and its geometry.
pub(crate) type Known<S> = (WorldContact<S>, [u32; 4], Geometry);

pub(crate) fn sorted<S>(mut known: Vec<Known<S>>) -> Vec<Known<S>> {
    known.sort_by_key(|(contact, ..)| (contact.kind, contact.meshes, contact.pair));
    known
}

pub(crate) fn known<P: Position>(
    world: &World<P>,
    contacts: &[WorldContact<P::Scalar>],
) -> Result<Vec<Known<P::Scalar>>, TestCaseError> {
    let mut geometries = Vec::new();
    prop_assert_eq!(world.contact_geometries(contacts, &mut geometries), Ok(()));
    let mut known = Vec::new();
    for (contact, shown) in contacts.iter().zip(&geometries) {
        prop_assert_eq!(
            (shown.kind, shown.meshes, shown.pair),
            (contact.kind, contact.meshes, contact.pair)
        );
        prop_assert_eq!(world.contact_geometry(contact), Ok(*shown));
        known.push((*contact, shown.vertices, shown.geometry));
    }
    Ok(sorted(known))
}

/// Checks that the other queries to a world agree with its contacts.
pub(crate) fn agrees<P: Position>(
    world: &mut World<P>,
    motions: &[(MeshHandle, MeshMotion<'_, P>)],
    contacts: &[WorldContact<P::Scalar>],
) -> TestCaseResult {
    prop_assert_eq!(world.is_free(motions), Ok(contacts.is_empty()));
    let earliest = world.earliest(motions);
    let first = contacts.iter().map(|contact| contact.time.to_f64()).min_by(f64::total_cmp);
    prop_assert_eq!(earliest.map(|found| found.map(|found| found.time.to_f64())), Ok(first));
    prop_assert!(earliest.is_ok_and(|found| found.is_none_or(|found| contacts.contains(&found))));
    Ok(())
}

pub(crate) fn triangle() -> Topology {
    Topology::new(3, vec![[0, 1, 2]]).expect("a triangle")
}

/// The motion of a mesh whose vertices move.
pub(crate) fn deforms<'a>(start: &'a [DVec3], end: &'a [DVec3]) -> MeshMotion<'a, DVec3> {
    MeshMotion::Deforming { start, end }
}

/// The motion of a body from one pose to another.
pub(crate) fn moves<P>(start: (DQuat, DVec3), end: (DQuat, DVec3)) -> MeshMotion<'static, P> {
    MeshMotion::Rigid { start, end }
}

pub(crate) const CORNERS: [DVec3; 3] = [DVec3::ZERO, DVec3::X, DVec3::Y];
pub(crate) const AT_REST: (DQuat, DVec3) = (DQuat::IDENTITY, DVec3::ZERO);
