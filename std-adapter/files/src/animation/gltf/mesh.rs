//! All primitives of a mesh as one: triangles, vertices, morph targets, and the joints of each vertex.

use super::{File, wrong};
use crate::mesh::{FilePart, LeftOut};
use crate::problem::AnimationProblem;
use crate::problem::FileProblem;
use gltf::accessor::Dimensions;
use gltf::mesh::{Mode, Primitive, Semantic};
use selvedge_core::glam::DVec3;

/// All primitives of a mesh as one.
#[derive(Default)]
pub(super) struct Parts {
    pub(super) positions: Vec<DVec3>,
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) targets: Vec<Vec<DVec3>>,
    pub(super) ends: Vec<u32>,
    pub(super) influences: Vec<(u32, f64)>,
}

impl<'a> File<'a> {
    /// Adds the triangles and vertices of a primitive.
    pub(super) fn add(
        &self,
        primitive: &Primitive<'a>,
        skin: Option<&gltf::Skin<'a>>,
        parts: &mut Parts,
        left_out: &mut Vec<LeftOut>,
    ) -> Result<(), AnimationProblem> {
        let what = format!("primitive {} of the mesh", primitive.index());
        let mode = primitive.mode();
        if !matches!(mode, Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
            left_out.push(LeftOut::new(FilePart::Primitive, format!("{mode:?}"), 1, None, false));
            return Ok(());
        }
        let positions = primitive
            .get(&Semantic::Positions)
            .ok_or_else(|| wrong(&what, "has no positions"))?;
        let positions = self.vectors(&positions, None, &format!("{what}, positions"))?;
        let (first, count) = (parts.positions.len(), positions.len());
        let indices = match primitive.indices() {
            None => (0..count as u32).map(f64::from).collect(),
            Some(indices) => self.numbers(&indices, Dimensions::Scalar, None, &format!("{what}, indices"))?,
        };
        if mode == Mode::Triangles && indices.len() % 3 != 0 {
            return Err(wrong(&what, format!("has {} indices, no multiple of three", indices.len())));
        }
        if let Some(place) = indices.iter().position(|&vertex| !is_index(vertex, count)) {
            let problem = FileProblem::IndexOutOfRange {
                line: None,
                face: parts.triangles.len()
                    + if mode == Mode::Triangles {
                        place / 3
                    } else {
                        place.saturating_sub(2)
                    },
                vertex: indices[place] as i64,
                first: 0,
                vertex_count: count,
            };
            return Err(problem.into());
        }
        let indices: Vec<u32> = indices.iter().map(|&vertex| first as u32 + vertex as u32).collect();
        push_triangles(mode, &indices, &mut parts.triangles);
        let targets: Vec<_> = primitive.morph_targets().collect();
        if first > 0 && targets.len() != parts.targets.len() {
            return Err(wrong(&what, "has another number of morph targets than the first"));
        }
        parts.targets.resize(targets.len(), Vec::new());
        for (index, target) in targets.iter().enumerate() {
            let moves = match target.positions() {
                None => vec![DVec3::ZERO; count],
                Some(moves) => self.vectors(&moves, Some(count), &format!("{what}, morph target {index}"))?,
            };
            parts.targets[index].extend(moves);
        }
        parts.positions.extend(positions);
        match skin {
            None => Ok(()),
            Some(skin) => {
                let without = self.add_influences(primitive, &what, skin.joints().count(), count, parts)?;
                if without > 0 {
                    let name = "of weight zero, which follow joint 0";
                    left_out.push(LeftOut::new(FilePart::Vertex, name, without, None, false));
                }
                Ok(())
            }
        }
    }

    /// Adds the joints of the `count` vertices of a primitive. Vertices whose weights are all zero follow joint 0; returns how
    /// many there are.
    fn add_influences(
        &self,
        primitive: &Primitive<'a>,
        what: &str,
        joint_count: usize,
        count: usize,
        parts: &mut Parts,
    ) -> Result<usize, AnimationProblem> {
        let mut sets = Vec::new();
        while let Some(joints) = primitive.get(&Semantic::Joints(sets.len() as u32)) {
            let set = sets.len();
            let weights = primitive.get(&Semantic::Weights(set as u32));
            let weights = weights.ok_or_else(|| wrong(what, format!("has JOINTS_{set}, but no WEIGHTS_{set}")))?;
            let read = |accessor, name| self.numbers(accessor, Dimensions::Vec4, Some(count), &format!("{what}, {name}_{set}"));
            sets.push((read(&joints, "JOINTS")?, read(&weights, "WEIGHTS")?));
        }
        if sets.is_empty() {
            return Err(wrong(
                what,
                "has a skin, but no JOINTS_0 that say which joints its vertices follow",
            ));
        }
        if primitive.get(&Semantic::Weights(sets.len() as u32)).is_some() {
            let set = sets.len();
            return Err(wrong(what, format!("has WEIGHTS_{set}, but no JOINTS_{set}")));
        }
        let mut without = 0;
        for vertex in 0..count {
            let of_vertex = 4 * vertex..4 * vertex + 4;
            let all = sets
                .iter()
                .flat_map(|(joints, weights)| joints[of_vertex.clone()].iter().zip(&weights[of_vertex.clone()]));
            let begin = parts.influences.len();
            for (&joint, &weight) in all.filter(|(_, weight)| **weight != 0.0) {
                if weight < 0.0 {
                    return Err(wrong(
                        what,
                        format!("vertex {vertex} has the weight {weight}, but none may be negative"),
                    ));
                }
                if !is_index(joint, joint_count) {
                    let reason = format!("vertex {vertex} follows joint {joint}, but the skin has {joint_count}, from 0 on");
                    return Err(wrong(what, reason));
                }
                parts.influences.push((joint as u32, weight));
            }
            if parts.influences.len() == begin {
                without += 1;
                parts.influences.push((0, 1.0));
            }
            let own = &mut parts.influences[begin..];
            let sum: f64 = own.iter().map(|(_, weight)| weight).sum();
            own.iter_mut().for_each(|(_, weight)| *weight /= sum);
            parts.ends.push(parts.influences.len() as u32);
        }
        Ok(without)
    }
}

/// Returns whether a number is one of the `count` indices from 0 on. A file may store indices as any type.
fn is_index(number: f64, count: usize) -> bool {
    number >= 0.0 && number < count as f64 && number.fract() == 0.0
}

/// Appends the triangles of a list, a strip or a fan of vertices. Those of a strip or fan that name a vertex twice only join two
/// parts.
fn push_triangles(mode: Mode, indices: &[u32], triangles: &mut Vec<[u32; 3]>) {
    let is_proper = |[a, b, c]: &[u32; 3]| a != b && b != c && c != a;
    match mode {
        Mode::TriangleStrip => {
            let turned = |(k, corners): (usize, &[u32])| match k % 2 {
                0 => [corners[0], corners[1], corners[2]],
                _ => [corners[1], corners[0], corners[2]],
            };
            triangles.extend(indices.windows(3).enumerate().map(turned).filter(is_proper));
        }
        Mode::TriangleFan => {
            let pairs = indices.windows(2).skip(1);
            triangles.extend(pairs.map(|pair| [indices[0], pair[0], pair[1]]).filter(is_proper));
        }
        _ => triangles.extend(indices.chunks_exact(3).map(|corners| [corners[0], corners[1], corners[2]])),
    }
}
