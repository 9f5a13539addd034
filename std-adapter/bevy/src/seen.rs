//! Writes the positions and normals of a simulation into a rendered mesh.

use crate::SelvedgeError;
use crate::place::Place;
use bevy_mesh::{Mesh, VertexAttributeValues};
use selvedge::glam::DVec3;

/// Writes vertices and normals, given in world coordinates, into a mesh at `place`.
pub(crate) fn write(
    mesh: &mut Mesh,
    place: Place,
    vertices: impl Iterator<Item = (DVec3, DVec3)> + Clone,
) -> Result<(), SelvedgeError> {
    let linear = place.linear();
    let inverse = linear.inverse();
    if !inverse.is_finite() {
        return Err(SelvedgeError::BadTransform);
    }
    let (_, translation) = place.pose();
    let position = |(own, _): (DVec3, DVec3)| (inverse * (own - translation)).as_vec3().to_array();
    let normal = |(_, own): (DVec3, DVec3)| (linear.transpose() * own).normalize_or_zero().as_vec3().to_array();
    put(mesh, true, vertices.clone().map(position));
    put(mesh, false, vertices.map(normal));
    Ok(())
}

/// Writes an attribute, without an allocation if the mesh has room for it.
fn put(mesh: &mut Mesh, are_positions: bool, values: impl Iterator<Item = [f32; 3]>) {
    let attribute = if are_positions {
        Mesh::ATTRIBUTE_POSITION
    } else {
        Mesh::ATTRIBUTE_NORMAL
    };
    match mesh.try_attribute_mut(attribute) {
        Ok(VertexAttributeValues::Float32x3(all)) => {
            all.clear();
            all.extend(values);
        }
        // The mesh is new or its positions were read, so it accepts attributes.
        _ => drop(mesh.try_insert_attribute(attribute, values.collect::<Vec<_>>())),
    }
}
