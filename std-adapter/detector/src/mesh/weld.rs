//! Merges vertices in the same place.

use super::Mesh;
use super::components::Components;
use selvedge_core::glam::DVec3;
use std::collections::HashMap;

/// A mesh whose coincident vertices are merged, and the way back to the original's numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WeldedMesh {
    /// The merged mesh. Each vertex has the position of the lowest-numbered vertex that was merged into it; vertices keep their
    /// order.
    pub mesh: Mesh,
    /// For each vertex of the original, its vertex in [`mesh`](Self::mesh).
    pub vertex_of: Vec<u32>,
    /// The number of triangles that named a vertex twice, then or already before, and are left out. They have no area.
    pub collapsed_triangles: usize,
}

impl WeldedMesh {
    /// Returns values of the merged vertices, such as positions of a later frame, for the vertices of the original. Seams stay
    /// closed.
    ///
    /// # Panics
    /// Panics if there are fewer values than merged vertices.
    #[must_use]
    pub fn for_original<T: Copy>(&self, values: &[T]) -> Vec<T> {
        self.vertex_of.iter().map(|&vertex| values[vertex as usize]).collect()
    }
}

impl Mesh {
    /// Merges vertices that are at most `tolerance` apart, in the caller's length unit; 0 (or a negative number, or NaN) merges
    /// equal positions alone. Merging is transitive: a chain of near vertices becomes one vertex. The tolerance should be far
    /// below the length of an edge: time grows with the number of vertices within it.
    ///
    /// ```
    /// use selvedge::{Mesh, glam::DVec3};
    ///
    /// // Two triangles of a square, exported with vertices of their own.
    /// let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Y, DVec3::X, DVec3::ONE];
    /// let mesh = Mesh { positions: corners.to_vec(), triangles: vec![[0, 1, 2], [3, 4, 5]] };
    /// let welded = mesh.welded(0.0);
    /// assert_eq!(welded.mesh.triangles, [[0, 1, 2], [2, 1, 3]]);
    /// assert_eq!(welded.vertex_of, [0, 1, 2, 2, 1, 3]);
    /// assert_eq!(welded.for_original(&welded.mesh.positions), corners);
    /// ```
    #[must_use]
    pub fn welded(&self, tolerance: f64) -> WeldedMesh {
        let first = first_coincident(&self.positions, tolerance);
        let mut welded = WeldedMesh::default();
        for (vertex, &first) in first.iter().enumerate() {
            let number = if first as usize == vertex {
                welded.mesh.positions.push(self.positions[vertex]);
                welded.mesh.positions.len() as u32 - 1
            } else {
                // This is an earlier vertex, which has its number.
                welded.vertex_of[first as usize]
            };
            welded.vertex_of.push(number);
        }
        let merged = |vertex: u32| welded.vertex_of.get(vertex as usize).copied().unwrap_or(vertex);
        let triangles = self.triangles.iter().map(|corners| corners.map(merged));
        welded.mesh.triangles = triangles.filter(|[a, b, c]| a != b && b != c && c != a).collect();
        welded.collapsed_triangles = self.triangles.len() - welded.mesh.triangles.len();
        welded
    }
}

/// Returns, for each position, the lowest number of those that are merged with it: see [`Mesh::welded`].
#[must_use]
pub fn first_coincident(positions: &[DVec3], tolerance: f64) -> Vec<u32> {
    let first = first_equal(positions);
    if tolerance.is_nan() || tolerance <= 0.0 {
        return first;
    }
    let mut merged = Components::new(positions.len());
    (0..).zip(&first).for_each(|(vertex, &first)| merged.join(vertex, first));
    // Positions at most `tolerance` apart are in the same cell or in cells next to each other.
    let cell = |position: DVec3| (position / tolerance).floor();
    let mut cells: HashMap<[u64; 3], Vec<u32>> = HashMap::new();
    for (vertex, &position) in positions.iter().enumerate() {
        if first[vertex] as usize != vertex || !position.is_finite() {
            continue;
        }
        let home = cell(position);
        for step in 0..27_i32 {
            let step = DVec3::new((step % 3).into(), (step / 3 % 3).into(), (step / 9).into()) - 1.0;
            for &other in cells.get(&bits(home + step)).into_iter().flatten() {
                if positions[other as usize].distance(position) <= tolerance {
                    merged.join(vertex as u32, other);
                }
            }
        }
        cells.entry(bits(home)).or_default().push(vertex as u32);
    }
    merged.into_firsts()
}

fn first_equal(positions: &[DVec3]) -> Vec<u32> {
    const EMPTY: u32 = u32::MAX;
    // The table has at least twice as many places, and its size is a power of two. A taken place leads to the next.
    let bits_of_size = (2 * positions.len()).next_power_of_two().trailing_zeros().max(1);
    let mut table = vec![EMPTY; 1 << bits_of_size];
    let mask = table.len() - 1;
    let mut first: Vec<u32> = (0..positions.len() as u32).collect();
    for (vertex, &position) in positions.iter().enumerate().filter(|(_, position)| !position.is_nan()) {
        let [x, y, z] = bits(position);
        let mixed = (x.wrapping_mul(MIX).rotate_left(23) ^ y).wrapping_mul(MIX).rotate_left(23) ^ z;
        let mut place = (mixed.wrapping_mul(MIX) >> (64 - bits_of_size)) as usize;
        loop {
            match table[place] {
                EMPTY => {
                    table[place] = vertex as u32;
                    break;
                }
                other if positions[other as usize] == position => {
                    first[vertex] = other;
                    break;
                }
                _ => place = (place + 1) & mask,
            }
        }
    }
    first
}

/// An odd number with irregular bits: 2⁶⁴ over the golden ratio.
const MIX: u64 = 0x9e37_79b9_7f4a_7c15;

/// Returns the same bits for equal coordinates; zero has one sign.
fn bits(position: DVec3) -> [u64; 3] {
    (position + 0.0).to_array().map(f64::to_bits)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn vertices_within_reach_are_one_and_those_beyond_are_not(
            points in prop::collection::vec(prop::array::uniform3(-3..3_i32), 0..40),
            tolerance in prop::sample::select(vec![0.0, 1.0, 1.5, 2.0]),
        ) {
            let positions: Vec<DVec3> = points.iter().map(|point| DVec3::from_array(point.map(f64::from)) * -1.0).collect();
            let first = first_coincident(&positions, tolerance);
            // The definition merges as long as anything changes.
            let mut expected: Vec<u32> = (0..positions.len() as u32).collect();
            loop {
                let before = expected.clone();
                for a in 0..positions.len() {
                    for b in 0..positions.len() {
                        if positions[a].distance(positions[b]) <= tolerance {
                            expected[a] = expected[a].min(expected[b]);
                        }
                    }
                }
                if expected == before {
                    break;
                }
            }
            prop_assert_eq!(first, expected);
        }
    }

    #[test]
    fn a_triangle_that_collapses_is_left_out() {
        let mesh = Mesh::new(
            vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::X * 1.001],
            vec![[0, 1, 2], [1, 3, 2]],
        );
        let welded = mesh.welded(0.01);
        assert_eq!((welded.mesh.triangles, welded.collapsed_triangles), (vec![[0, 1, 2]], 1));
        assert_eq!(mesh.welded(f64::NAN).mesh, mesh);
    }
}
