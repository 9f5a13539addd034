//! What is seen: positions and normals of a simulation, written into a mesh.

use crate::SelvedgeError;
use crate::place::Place;
use bevy_mesh::{Mesh, VertexAttributeValues};
use selvedge::glam::DVec3;

/// Writes where vertices are in the world, and the surface's normals there, into a mesh that is at `place`.
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

/// Where the mesh has room for them nothing is allocated.
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
        // Its positions have been read, or it is new, so that it takes attributes.
        _ => drop(mesh.try_insert_attribute(attribute, values.collect::<Vec<_>>())),
    }
}
