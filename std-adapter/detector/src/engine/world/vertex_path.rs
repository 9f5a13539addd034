//! The paths of a pair's vertices in the last step.

use crate::broad_phase::Hierarchies;
use selvedge_core::Motion;
use selvedge_core::PairKind;
use selvedge_core::paths::{Arc, Moment, Path, Piece, RigidMotion};

/// The path of a vertex.
pub(crate) enum VertexPath {
    Straight(Motion<f64>),
    Arc(Arc),
}

impl VertexPath {
    pub(crate) const fn straight(&self) -> Option<Motion<f64>> {
        match self {
            Self::Straight(motion) => Some(*motion),
            Self::Arc(_) => None,
        }
    }
}

impl Path for VertexPath {
    fn piece(&self, from: f64, to: f64) -> Piece {
        match self {
            Self::Straight(motion) => motion.piece(from, to),
            Self::Arc(arc) => arc.piece(from, to),
        }
    }

    fn moment(&self, time: f64) -> Moment {
        match self {
            Self::Straight(motion) => motion.moment(time),
            Self::Arc(arc) => arc.moment(time),
        }
    }
}

/// Returns the vertices of a pair whose first primitive is of the first mesh and whose second is of the second mesh. Returns
/// `None` if there is no such pair, or if the vertex belongs to no primitive, so that the hierarchies do not have it.
pub(crate) fn vertices_of([first, second]: [&Hierarchies; 2], kind: PairKind, pair: [u32; 2]) -> Option<[u32; 4]> {
    let index = pair[1] as usize;
    match kind {
        PairKind::VertexFace => {
            let &[a, b, c] = second.topology().triangles().get(index)?;
            first.motion_of(pair[0] as usize)?;
            Some([pair[0], a, b, c])
        }
        PairKind::EdgeEdge => {
            let &[a, b] = first.topology().edges().get(pair[0] as usize)?;
            let &[c, d] = second.topology().edges().get(index)?;
            Some([a, b, c, d])
        }
    }
}

/// Returns the paths of [such vertices](vertices_of): arcs if their mesh rotates.
pub(crate) fn vertex_paths(
    meshes: [&Hierarchies; 2],
    motions: &[Option<RigidMotion>; 2],
    kind: PairKind,
    [a, b, c, d]: [u32; 4],
) -> [VertexPath; 4] {
    let path = |side: usize, vertex: u32| {
        let straight = meshes[side].motion_of(vertex as usize).unwrap_or_default();
        // These are the same arcs as for boxes and sweeps: an arc has its start without rounding.
        motions[side].map_or(VertexPath::Straight(straight), |motion| {
            VertexPath::Arc(motion.path(straight.start))
        })
    };
    let second = usize::from(kind == PairKind::VertexFace);
    [path(0, a), path(second, b), path(1, c), path(1, d)]
}
