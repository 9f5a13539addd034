//! The colliding shape of a Bevy mesh: positions and triangles, with seams joined.

use bevy_mesh::{Indices, Mesh, MeshAccessError, PrimitiveTopology, VertexAttributeValues};
use selvedge::{Topology, TopologyError};
use std::collections::HashMap;
use std::hash::Hash;
use std::sync::Arc;

/// The reason why a `Mesh` cannot collide.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RenderMeshError {
    /// The mesh is not a triangle list.
    #[error("its primitive topology is {found:?}: make it a TriangleList")]
    NotTriangles {
        /// The mesh's topology.
        found: PrimitiveTopology,
    },
    /// The attribute `Mesh::ATTRIBUTE_POSITION` is missing.
    #[error("it has no positions: insert the attribute Mesh::ATTRIBUTE_POSITION")]
    NoPositions,
    /// The positions are compressed or two-dimensional.
    #[error("its positions are not Float32x3: uncompressed positions in three dimensions are needed")]
    PositionFormat,
    /// Bevy has moved the mesh's data to the graphics card.
    #[error("its data is only on the graphics card: add RenderAssetUsages::MAIN_WORLD to the mesh")]
    OnlyRendered,
    /// The number of indices or vertices is not a multiple of three.
    #[error("it has {count} corners, which is not a multiple of three")]
    Corners {
        /// The number of indices, or of vertices without indices.
        count: usize,
    },
    /// A position is NaN or infinite.
    #[error("the position of vertex {vertex} is not finite")]
    NotFinite {
        /// The first such vertex.
        vertex: usize,
    },
    /// An index is out of range, there are no triangles, or too many.
    #[error("{0}")]
    Topology(TopologyError),
}

/// Returns the positions of a mesh, if they can collide.
pub(crate) fn positions_of(mesh: &Mesh) -> Result<&[[f32; 3]], RenderMeshError> {
    let positions = match mesh.try_attribute(Mesh::ATTRIBUTE_POSITION) {
        Ok(VertexAttributeValues::Float32x3(positions)) => positions,
        Ok(_) => return Err(RenderMeshError::PositionFormat),
        Err(MeshAccessError::ExtractedToRenderWorld) => return Err(RenderMeshError::OnlyRendered),
        Err(MeshAccessError::NotFound) => return Err(RenderMeshError::NoPositions),
    };
    match positions.iter().position(|position| !position.iter().all(|x| x.is_finite())) {
        Some(vertex) => Err(RenderMeshError::NotFinite { vertex }),
        None => Ok(positions),
    }
}

pub(crate) fn triangles_of(mesh: &Mesh) -> Result<Vec<[u32; 3]>, RenderMeshError> {
    if mesh.primitive_topology() != PrimitiveTopology::TriangleList {
        let found = mesh.primitive_topology();
        return Err(RenderMeshError::NotTriangles { found });
    }
    let corners: Vec<u32> = match mesh.try_indices_option() {
        Ok(Some(Indices::U16(indices))) => indices.iter().map(|&index| u32::from(index)).collect(),
        Ok(Some(Indices::U32(indices))) => indices.clone(),
        Ok(None) | Err(MeshAccessError::NotFound) => {
            let count = positions_of(mesh)?.len();
            // A topology refuses so many vertices.
            (0..u32::try_from(count).unwrap_or(u32::MAX)).collect()
        }
        Err(MeshAccessError::ExtractedToRenderWorld) => return Err(RenderMeshError::OnlyRendered),
    };
    let (triangles, left_over) = corners.as_chunks::<3>();
    if left_over.is_empty() {
        Ok(triangles.to_vec())
    } else {
        Err(RenderMeshError::Corners { count: corners.len() })
    }
}

/// Triangles between points. A Bevy mesh repeats a vertex whose normal or texture coordinate differs between faces; the shape has
/// one point for all of them.
#[derive(Debug)]
pub(crate) struct Shape {
    /// The triangles with the vertex numbers of the mesh.
    pub(crate) triangles: Vec<[u32; 3]>,
    pub(crate) points: Vec<u32>,
    /// The first vertex of each point.
    pub(crate) vertices: Vec<u32>,
    pub(crate) topology: Arc<Topology>,
}

impl Shape {
    pub(crate) fn of(mesh: &Mesh) -> Result<Self, RenderMeshError> {
        let triangles = triangles_of(mesh)?;
        let positions = positions_of(mesh)?;
        // Adding zero turns −0 into +0.
        Self::new(
            triangles,
            positions.iter().map(|position| position.map(|x| (x + 0.0).to_bits())),
        )
    }

    /// Joins vertices with the same key.
    pub(crate) fn new<K: Hash + Eq>(triangles: Vec<[u32; 3]>, keys: impl Iterator<Item = K>) -> Result<Self, RenderMeshError> {
        let mut vertices = Vec::new();
        let mut points_by_key = HashMap::new();
        let mut points: Vec<u32> = Vec::new();
        for (vertex, key) in keys.enumerate() {
            points.push(*points_by_key.entry(key).or_insert_with(|| {
                vertices.push(vertex as u32);
                vertices.len() as u32 - 1
            }));
        }
        let vertex_count = points.len();
        let point_of = |(triangle, vertex): (usize, u32)| {
            let point = points.get(vertex as usize).copied();
            point.ok_or(RenderMeshError::Topology(TopologyError::VertexOutOfRange {
                triangle,
                vertex,
                vertex_count,
            }))
        };
        let named: Result<Vec<[u32; 3]>, RenderMeshError> = triangles
            .iter()
            .enumerate()
            .map(|(triangle, corners)| {
                let [a, b, c] = corners.map(|vertex| point_of((triangle, vertex)));
                Ok([a?, b?, c?])
            })
            .collect();
        let topology = Topology::new(vertices.len(), named?).map_err(RenderMeshError::Topology)?;
        Ok(Self {
            triangles,
            points,
            vertices,
            topology: Arc::new(topology),
        })
    }

    /// Converts a list per vertex to a list per point.
    pub(crate) fn of_points<T: Copy>(&self, of_vertices: &[T]) -> Vec<T> {
        self.vertices.iter().map(|&vertex| of_vertices[vertex as usize]).collect()
    }

    /// Returns whether all vertices of each point have the same position.
    pub(crate) fn is_together<T: PartialEq>(&self, of_vertices: &[T]) -> bool {
        let first = |point: u32| self.vertices[point as usize] as usize;
        self.points
            .iter()
            .zip(of_vertices)
            .all(|(&point, own)| *own == of_vertices[first(point)])
    }
}
