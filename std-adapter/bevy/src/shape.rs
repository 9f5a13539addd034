//! What of Bevy's meshes collides: positions and triangles, joined where Bevy parts them.

use bevy_mesh::{Indices, Mesh, MeshAccessError, PrimitiveTopology, VertexAttributeValues};
use selvedge::{Topology, TopologyError};
use std::collections::HashMap;
use std::hash::Hash;
use std::sync::Arc;

/// Why a `Mesh` cannot collide.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MeshError {
    /// It is none of triangles, each given by three indices or vertices.
    #[error("its primitive topology is {found:?}: make it a TriangleList")]
    NotTriangles {
        /// What it is.
        found: PrimitiveTopology,
    },
    /// It has no attribute `Mesh::ATTRIBUTE_POSITION`.
    #[error("it has no positions: insert the attribute Mesh::ATTRIBUTE_POSITION")]
    NoPositions,
    /// Its positions are compressed, or of two dimensions.
    #[error("its positions are no Float32x3: uncompressed ones in three dimensions are needed")]
    PositionFormat,
    /// Bevy has moved its data to the graphics card.
    #[error("its data is on the graphics card alone: give the mesh RenderAssetUsages::MAIN_WORLD, too")]
    OnlyRendered,
    /// It has indices or vertices that are left over.
    #[error("it has {count} corners, which is not three for each triangle")]
    Corners {
        /// How many indices, or vertices without indices.
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

/// A mesh's positions, if they can collide.
pub(crate) fn positions_of(mesh: &Mesh) -> Result<&[[f32; 3]], MeshError> {
    let positions = match mesh.try_attribute(Mesh::ATTRIBUTE_POSITION) {
        Ok(VertexAttributeValues::Float32x3(positions)) => positions,
        Ok(_) => return Err(MeshError::PositionFormat),
        Err(MeshAccessError::ExtractedToRenderWorld) => return Err(MeshError::OnlyRendered),
        Err(MeshAccessError::NotFound) => return Err(MeshError::NoPositions),
    };
    match positions.iter().position(|position| !position.iter().all(|x| x.is_finite())) {
        Some(vertex) => Err(MeshError::NotFinite { vertex }),
        None => Ok(positions),
    }
}

/// A mesh's triangles, as its vertices are numbered.
pub(crate) fn triangles_of(mesh: &Mesh) -> Result<Vec<[u32; 3]>, MeshError> {
    if mesh.primitive_topology() != PrimitiveTopology::TriangleList {
        let found = mesh.primitive_topology();
        return Err(MeshError::NotTriangles { found });
    }
    let corners: Vec<u32> = match mesh.try_indices_option() {
        Ok(Some(Indices::U16(indices))) => indices.iter().map(|&index| u32::from(index)).collect(),
        Ok(Some(Indices::U32(indices))) => indices.clone(),
        Ok(None) | Err(MeshAccessError::NotFound) => {
            let count = positions_of(mesh)?.len();
            // As topologies count them, which refuse so many.
            (0..u32::try_from(count).unwrap_or(u32::MAX)).collect()
        }
        Err(MeshAccessError::ExtractedToRenderWorld) => return Err(MeshError::OnlyRendered),
    };
    let (triangles, left_over) = corners.as_chunks::<3>();
    if left_over.is_empty() {
        Ok(triangles.to_vec())
    } else {
        Err(MeshError::Corners { count: corners.len() })
    }
}

/// Triangles between points, each of which is one or several of a mesh's vertices. Bevy's meshes have a vertex several times where its normal
/// or its texture coordinate differs from face to face: what collides has it once.
#[derive(Debug)]
pub(crate) struct Shape {
    /// As the mesh numbers vertices.
    pub(crate) triangles: Vec<[u32; 3]>,
    /// Of each vertex the point.
    pub(crate) points: Vec<u32>,
    /// Of each point its first vertex.
    pub(crate) vertices: Vec<u32>,
    /// Of points.
    pub(crate) topology: Arc<Topology>,
}

impl Shape {
    pub(crate) fn of(mesh: &Mesh) -> Result<Self, MeshError> {
        let triangles = triangles_of(mesh)?;
        let positions = positions_of(mesh)?;
        // Adding zero makes one zero of two.
        Self::new(
            triangles,
            positions.iter().map(|position| position.map(|x| (x + 0.0).to_bits())),
        )
    }

    /// Vertices with the same key are one point.
    pub(crate) fn new<K: Hash + Eq>(triangles: Vec<[u32; 3]>, keys: impl Iterator<Item = K>) -> Result<Self, MeshError> {
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
            point.ok_or(MeshError::Topology(TopologyError::VertexOutOfRange {
                triangle,
                vertex,
                vertex_count,
            }))
        };
        let named: Result<Vec<[u32; 3]>, MeshError> = triangles
            .iter()
            .enumerate()
            .map(|(triangle, corners)| {
                let [a, b, c] = corners.map(|vertex| point_of((triangle, vertex)));
                Ok([a?, b?, c?])
            })
            .collect();
        let topology = Topology::new(vertices.len(), named?).map_err(MeshError::Topology)?;
        Ok(Self {
            triangles,
            points,
            vertices,
            topology: Arc::new(topology),
        })
    }

    /// Something of each point, given that of each vertex.
    pub(crate) fn of_points<T: Copy>(&self, of_vertices: &[T]) -> Vec<T> {
        self.vertices.iter().map(|&vertex| of_vertices[vertex as usize]).collect()
    }

    /// Whether all vertices of a point are at one place.
    pub(crate) fn is_together<T: PartialEq>(&self, of_vertices: &[T]) -> bool {
        let first = |point: u32| self.vertices[point as usize] as usize;
        self.points
            .iter()
            .zip(of_vertices)
            .all(|(&point, own)| *own == of_vertices[first(point)])
    }
}
