//! What the text of a scene may refer to.

use selvedge::Mesh;
use selvedge_core::glam::DVec3;
use selvedge_files::FileSource;

/// What the text of a scene may refer to, and whether code runs the scene.
///
/// ```
/// use selvedge_cloth::glam::DVec3;
/// use selvedge_cloth::{Mesh, NamedMesh, Scene, SceneContext};
/// use std::path::Path;
///
/// let text = r#"
/// cloth = { shape = "mesh", mesh = "kite", density = 0.05 }
/// effects = { gravity = {} }
/// "#;
/// let triangle = Mesh::new(vec![DVec3::ZERO, DVec3::X, DVec3::Y], vec![[0, 1, 2]]);
/// let context = SceneContext {
///     meshes: vec![NamedMesh::new("kite", triangle)],
///     is_run_by_code: true,
///     ..SceneContext::default()
/// };
/// let scene = Scene::parse_in(text, Path::new("kite.toml"), &context)?;
/// assert_eq!(scene.cloths[0].mesh().positions.len(), 3);
/// # Ok::<(), selvedge_cloth::SceneError>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct SceneContext {
    /// The source of the files that the text names.
    pub files: FileSource,
    /// The meshes that cloths and bodies of the shape `mesh` name.
    pub meshes: Vec<NamedMesh>,
    /// True if code decides when the scene ends. Then the text may leave `duration` out, and the duration is unlimited.
    pub is_run_by_code: bool,
}

/// A mesh from code, which the text of a scene names.
#[derive(Clone, Debug, Default)]
pub struct NamedMesh {
    /// The name in the text.
    pub name: String,
    /// The vertices, where they start, and the triangles. The keys `unit`, `scale`, `rotation` and `translation` apply to them.
    pub mesh: Mesh,
    /// Edges of a cloth that belong to no triangle.
    pub loose_edges: Vec<[u32; 2]>,
    /// The positions at rest, if they are not those at the start: for a cloth. The keys above apply to them too.
    pub rest: Option<Vec<DVec3>>,
    /// Frames of a body that deforms, each with the positions of all vertices; empty for any other mesh. The text has their
    /// `frames_per_second`.
    pub frames: Vec<Vec<DVec3>>,
}

impl NamedMesh {
    /// Makes a mesh of triangles alone.
    #[must_use]
    pub fn new(name: &str, mesh: Mesh) -> Self {
        Self {
            name: name.to_owned(),
            mesh,
            ..Self::default()
        }
    }
}
