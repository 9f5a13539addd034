//! Small meshes in motion, with the defects that files have.

use super::numbers::{exponent, finite, fraction};
use super::pairs::{complexity, simpler_number};
use super::{Choices, Format, PairCase, Simplify};
use selvedge::Topology;
use selvedge_core::PairKind;
use std::fmt;

/// Triangles over 4 to 12 vertices with any three indices. So degenerate triangles (v, v, w), duplicates, edges with many
/// triangles and isolated vertices are common. Some meshes have ropes, made of loose edges, and particles.
#[derive(Clone, PartialEq)]
pub struct MeshCase<S> {
    /// The three vertices of each triangle.
    pub triangles: Vec<[u32; 3]>,
    /// The positions of each vertex at times 0 and 1.
    pub positions: Vec<[[S; 3]; 2]>,
}

/// Two primitives of a mesh, by their indices.
pub type MeshPair = (PairKind, [u32; 2]);

/// Returns every vertex–face and every edge–edge pair without a common vertex, by definition; the smaller edge is first. Vertices
/// without a triangle are not part of the surface.
pub fn all_pairs(topology: &Topology) -> [Vec<[u32; 2]>; 2] {
    let (mut vertex_face, mut edge_edge) = (Vec::new(), Vec::new());
    for vertex in 0..topology.vertex_count() as u32 {
        let has_triangle = topology.triangles().iter().any(|t| t.contains(&vertex));
        for (face, triangle) in (0..).zip(topology.triangles()) {
            if has_triangle && !triangle.contains(&vertex) {
                vertex_face.push([vertex, face]);
            }
        }
    }
    for (second, b) in (0..).zip(topology.edges()) {
        for (first, a) in (0..second).zip(topology.edges()) {
            if !a.iter().any(|end| b.contains(end)) {
                edge_edge.push([first, second]);
            }
        }
    }
    [vertex_face, edge_edge]
}

/// Returns pairs of either kind as one list, vertex–face pairs first.
pub fn with_kinds([vertex_face, edge_edge]: [Vec<[u32; 2]>; 2]) -> Vec<MeshPair> {
    let of_kind = |kind, pairs: Vec<[u32; 2]>| pairs.into_iter().map(move |pair| (kind, pair));
    of_kind(PairKind::VertexFace, vertex_face)
        .chain(of_kind(PairKind::EdgeEdge, edge_edge))
        .collect()
}

impl<S: Format> MeshCase<S> {
    pub fn from_bytes(bytes: &[u8]) -> Self {
        Self::choose(&mut Choices::new(bytes))
    }

    pub fn choose(choices: &mut Choices<'_>) -> Self {
        let vertices = 4 + choices.below(9);
        let positions = positions(vertices as usize, choices);
        // Not all vertices are used: some are isolated.
        let used = vertices - choices.pick(&[0, 0, 1, 2]).min(vertices - 3);
        let mut triangles: Vec<[u32; 3]> = if choices.once_in(3) {
            // A strip: every inner edge has two triangles.
            (2..used).map(|k| [k - 2, k - 1, k]).collect()
        } else {
            let count = choices.pick(&[3, 1, 2, 8, 16, 40, 80]);
            (0..count).map(|_| std::array::from_fn(|_| choices.below(used))).collect()
        };
        if choices.once_in(4) {
            // Ropes and particles, as in `Topology::with_loose_features`, beside triangles or alone.
            if choices.once_in(3) {
                triangles.clear();
            }
            let rope = (1..used).map(|k| [k - 1, k, k]).take(1 + choices.below(used - 1) as usize);
            triangles.extend(rope);
            triangles.extend((0..choices.below(4)).map(|k| [vertices - 1 - k; 3]));
        }
        Self { triangles, positions }
    }

    /// Returns the topology.
    ///
    /// # Panics
    /// It never panics: there is a triangle, and its vertices exist.
    pub fn topology(&self) -> Topology {
        Topology::new(self.positions.len(), self.triangles.clone()).expect("indices are in range")
    }

    /// Returns two primitives of the mesh by their indices in its `topology`.
    ///
    /// # Panics
    /// Panics if there is no primitive with one of these indices.
    pub fn pair(&self, topology: &Topology, (kind, pair): MeshPair) -> PairCase<S> {
        let points = topology.vertices_of(kind, pair).map(|vertex| self.positions[vertex as usize]);
        PairCase::new(kind, points)
    }

    /// Returns the positions at time 0 (for `end` 0) or 1.
    pub fn frame(&self, end: usize) -> Vec<S::Vector> {
        self.positions.iter().map(|ends| ends[end].into()).collect()
    }

    /// Returns the mesh moved by `offset`, with every sum rounded.
    pub fn moved_by(&self, offset: [S; 3]) -> Self {
        let moved = |position: [S; 3]| std::array::from_fn(|axis| position[axis] + offset[axis]);
        self.with_positions(|_, ends| ends.map(moved))
    }

    /// Returns the mesh with other positions, each made from a vertex and its positions, perhaps in another format.
    pub fn with_positions<T: Format>(&self, mut other: impl FnMut(usize, [[S; 3]; 2]) -> [[T; 3]; 2]) -> MeshCase<T> {
        MeshCase {
            triangles: self.triangles.clone(),
            positions: { self.positions.iter().enumerate() }
                .map(|(vertex, &ends)| other(vertex, ends))
                .collect(),
        }
    }
}

fn positions<S: Format>(vertices: usize, choices: &mut Choices<'_>) -> Vec<[[S; 3]; 2]> {
    let place = choices.below(8);
    let motion = choices.below(5);
    let common: [S; 3] = std::array::from_fn(|_| S::exact(choices.within(4), -1));
    let scale = exponent::<S>(choices);
    let mut positions = Vec::with_capacity(vertices);
    for _ in 0..vertices {
        let start: [S; 3] = match place {
            // Many coordinates are equal.
            0..=2 => std::array::from_fn(|_| S::exact(choices.within(3), 0)),
            // All are in one plane.
            3 => [S::exact(choices.within(5), 0), S::exact(choices.within(5), 0), S::ZERO],
            4 | 5 => std::array::from_fn(|_| fraction(choices)),
            // The point is like the first, at another scale.
            6 => std::array::from_fn(|_| S::exact(choices.within(9), scale)),
            _ => std::array::from_fn(|_| finite(choices)),
        };
        let end: [S; 3] = std::array::from_fn(|axis| match motion {
            0 => start[axis] + common[axis],
            1 => start[axis] + S::exact(choices.within(2), 0),
            2 => start[axis] + S::exact(1, -12) * fraction::<S>(choices),
            3 => start[axis].nudged(choices.within(2)),
            _ => start[(axis + 1) % 3],
        });
        positions.push([start, end.map(S::made_finite)]);
    }
    positions
}

impl<S: Format> Simplify for MeshCase<S> {
    fn attempts(&self) -> usize {
        self.triangles.len() + 4 * 6 * self.positions.len()
    }

    fn simpler(&self, attempt: usize) -> Option<Self> {
        let mut simpler = self.clone();
        match attempt.checked_sub(self.triangles.len()) {
            None => {
                if self.triangles.len() == 1 {
                    return None;
                }
                simpler.triangles.remove(attempt);
            }
            Some(attempt) => {
                let (vertex, end, axis) = (attempt / 24, attempt / 12 % 2, attempt / 4 % 3);
                let number = &mut simpler.positions[vertex][end][axis];
                *number = simpler_number(*number, attempt % 4);
            }
        }
        (simpler.complexity() < self.complexity()).then_some(simpler)
    }
}

impl<S: Format> MeshCase<S> {
    fn complexity(&self) -> u64 {
        let numbers = self.positions.iter().flatten().flatten();
        numbers.map(|&number| complexity(number)).sum::<u64>() + self.triangles.len() as u64
    }
}

impl<S: Format> fmt::Debug for MeshCase<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "MeshCase::<{}> {{", S::NAME)?;
        writeln!(f, "    triangles: vec!{:?},", self.triangles)?;
        writeln!(f, "    positions: vec![")?;
        for [start, end] in &self.positions {
            writeln!(f, "        [{start:?}, {end:?}],")?;
        }
        write!(f, "    ],\n}}")
    }
}
