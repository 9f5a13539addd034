//! A mesh of a world, and how it moves in a step.

use crate::broad_phase::{BoxFit, Hierarchies};
use crate::mesh::Topology;
use crate::parallel;
use crate::step::{Groups, Motions};
use selvedge_core::Motion;
use selvedge_core::boxes::Aabb;
use selvedge_core::boxes::mapping::Mapping;
use selvedge_core::glam::{DQuat, DVec3};
use selvedge_core::paths::{Path, Piece, RigidMotion, separation_of_pieces};
use std::sync::Arc;

/// The motion of a mesh in a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Moves {
    /// The mesh rests.
    Not,
    /// Each vertex has its own path, so the mesh can meet itself.
    Deforming,
    /// All vertices move alike, straight.
    Straight,
    /// The mesh rotates as a body. The number is the largest distance of a vertex from its straight path.
    Turning(RigidMotion, f64),
}

impl Moves {
    pub(crate) const fn deviation(&self) -> f64 {
        match self {
            Self::Turning(_, deviation) => *deviation,
            _ => 0.0,
        }
    }

    pub(crate) const fn turning(&self) -> Option<RigidMotion> {
        match self {
            Self::Turning(motion, _) => Some(*motion),
            _ => None,
        }
    }
}

#[derive(Debug)]
pub(crate) struct WorldMesh {
    pub(crate) hierarchies: Hierarchies,
    /// The positions of the insertion.
    pub(crate) shape: Vec<DVec3>,
    pub(crate) groups: Groups,
    pub(crate) moves: Moves,
    /// The place of its rows among those of all meshes.
    pub(crate) rows_at: Option<RowsAt>,
}

/// A place among the rows of all meshes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RowsAt {
    /// The arrangement of rows for which the place is valid.
    pub(crate) arrangement: u64,
    pub(crate) first: u32,
    /// True if the rows are those of the hierarchies.
    pub(crate) are_current: bool,
}

impl WorldMesh {
    /// Builds the hierarchies of a mesh that rests.
    pub(crate) fn new(topology: Arc<Topology>, shape: Vec<DVec3>, groups: Groups, separation: f64) -> Self {
        let mut mesh = Self {
            hierarchies: Hierarchies::new(topology),
            shape: Vec::new(),
            groups,
            moves: Moves::Not,
            rows_at: None,
        };
        let resting = Frames(shape.iter().map(|&position| Motion::resting(position)).collect());
        mesh.set_motion(&resting, Moves::Not, separation);
        mesh.shape = shape;
        mesh
    }

    /// Sets the motion of the next step. Makes boxes for `separation`.
    pub(crate) fn set_motion(&mut self, motions: &dyn Motions, moves: Moves, separation: f64) {
        let separation = match moves {
            // A box holds half of the separation on each side, and the whole deviation.
            Moves::Turning(_, deviation) => separation_of_pieces(separation, 2.0 * deviation),
            _ => separation,
        };
        let fit = BoxFit {
            separation,
            ..BoxFit::default()
        };
        self.hierarchies.fit_boxes(&AboutOrigin(motions), &fit);
        self.hierarchies.narrow();
        self.moves = moves;
        if let Some(place) = &mut self.rows_at {
            place.are_current = false;
        }
    }

    /// Lets the mesh rest where its last motion ended.
    pub(crate) fn come_to_rest(&mut self, separation: f64) {
        let motion = |vertex| self.hierarchies.motion_of(vertex).unwrap_or_default();
        let vertices = 0..self.hierarchies.topology().vertex_count();
        let resting = Frames(vertices.map(|vertex| Motion::resting(motion(vertex).end)).collect());
        self.set_motion(&resting, Moves::Not, separation);
    }
}

#[derive(Debug)]
pub(crate) struct Frames(pub(crate) Vec<Motion<f64>>);

impl Motions for Frames {
    fn len(&self) -> usize {
        self.0.len()
    }

    fn motion(&self, vertex: usize) -> Motion<f64> {
        self.0[vertex]
    }

    fn mapping(&self, extent: &Aabb<f64>, separation: f64, until: f64, is_swept: bool) -> Mapping {
        Mapping::new(extent, separation, until, is_swept)
    }
}

/// Makes boxes about one origin for all meshes, [so that they compare](selvedge_core::boxes::mapping#two-mappings).
struct AboutOrigin<'a>(&'a dyn Motions);

impl Motions for AboutOrigin<'_> {
    fn len(&self) -> usize {
        self.0.len()
    }

    fn motion(&self, vertex: usize) -> Motion<f64> {
        self.0.motion(vertex)
    }

    fn mapping(&self, _: &Aabb<f64>, separation: f64, until: f64, is_swept: bool) -> Mapping {
        self.0.mapping(&Aabb::empty(), separation, until, is_swept)
    }
}

/// A rotation, and the position of the mesh's origin.
pub(crate) type Pose = (DQuat, DVec3);

/// Returns the motion of a mesh from one pose to another, or `None` if a pose is invalid or too far out. `rounded` rounds the
/// positions of straight motion.
pub(crate) fn between_poses(shape: &[DVec3], [start, end]: [Pose; 2], rounded: fn(DVec3) -> DVec3) -> Option<(Frames, Moves)> {
    let motion = RigidMotion::between(start, end)?;
    let turn = start.0.normalize();
    let turned = |&position: &DVec3| turn * position;
    let (frames, moves) = if start.0 == end.0 || start.0 == -end.0 {
        let ends = |position: DVec3| Motion::new(rounded(position + start.1), rounded(position + end.1));
        let frames = shape.iter().map(|position| ends(turned(position))).collect();
        (Frames(frames), Moves::Straight)
    } else {
        let mut pieces: Vec<Piece> = Vec::new();
        let piece = |position: &DVec3| motion.path(turned(position) + start.1).piece(0.0, 1.0);
        parallel::fill(&mut pieces, shape, piece);
        // `max` drops NaN; the product keeps it.
        let deviations = pieces.iter().map(|piece| piece.deviation);
        let deviation = deviations.fold(0.0, |most: f64, deviation| most.max(deviation) + 0.0 * deviation);
        (
            Frames(pieces.iter().map(|piece| piece.motion).collect()),
            Moves::Turning(motion, deviation),
        )
    };
    let are_finite = frames
        .0
        .iter()
        .all(|motion| motion.start.is_finite() && motion.end.is_finite());
    (are_finite && moves.deviation().is_finite()).then_some((frames, moves))
}
