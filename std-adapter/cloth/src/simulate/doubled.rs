//! Triangles that lie on others: meshes for rendering have a second side where both sides are seen. Its quadrilaterals may be
//! split along the other diagonal, so that no triangle stands twice.

use selvedge::{Mesh, first_coincident};
use selvedge_core::glam::DVec3;
use std::collections::{BTreeMap, BTreeSet};

/// The largest volume of four points that count as flat, over the cube of their size: positions in single precision are off by up
/// to 2⁻²⁴ of their distance from the origin, here at most sixteen times the size.
const FLAT: f64 = 1.0 / (1 << 20) as f64;

/// The triangles at an edge, each with its third vertex.
type AtEdges = BTreeMap<[u32; 2], Vec<(u32, usize)>>;

/// Returns the numbers of those of the first `count` triangles that lie on earlier ones, in their order. They have the same three
/// places, or with a neighbour the same four places in a plane, split along the other diagonal.
pub(super) fn triangles(mesh: &Mesh, count: usize) -> Vec<usize> {
    let first = first_coincident(&mesh.positions, 0.0);
    let places: Vec<[u32; 3]> = { mesh.triangles[..count].iter() }
        .map(|triangle| triangle.map(|vertex| first[vertex as usize]))
        .collect();
    let (mut known, mut doubled, mut at_edges) = (BTreeSet::new(), BTreeSet::new(), AtEdges::new());
    for (number, &triangle) in places.iter().enumerate() {
        let mut sorted = triangle;
        sorted.sort_unstable();
        if !known.insert(sorted) {
            doubled.insert(number);
        }
        let [a, b, c] = triangle;
        for [from, to, across] in [[a, b, c], [b, c, a], [c, a, b]] {
            at_edges
                .entry([from.min(to), from.max(to)])
                .or_default()
                .push((across, number));
        }
    }
    for (&[a, c], beside) in &at_edges {
        for (index, &(b, one)) in beside.iter().enumerate() {
            for &(d, two) in &beside[..index] {
                let corners = [a, b, c, d].map(|vertex| mesh.positions[vertex as usize]);
                if let Some(others) = across(&at_edges, [b, d], [a, c]).filter(|_| are_diagonals(corners)) {
                    let own = [one, two];
                    let later = if own.iter().min() > others.iter().min() { own } else { others };
                    doubled.extend(later);
                }
            }
        }
    }
    doubled.into_iter().collect()
}

/// Returns the two triangles that an edge has with these third vertices.
fn across(at_edges: &AtEdges, [b, d]: [u32; 2], third: [u32; 2]) -> Option<[usize; 2]> {
    let beside = at_edges.get(&[b.min(d), b.max(d)])?;
    let with = |third: u32| beside.iter().find(|(across, _)| *across == third).map(|&(_, number)| number);
    Some([with(third[0])?, with(third[1])?])
}

/// Returns whether a, c and b, d are the diagonals of a flat quadrilateral.
fn are_diagonals([a, b, c, d]: [DVec3; 4]) -> bool {
    let parts = |[from, to]: [DVec3; 2], [one, other]: [DVec3; 2]| {
        let along = to - from;
        along.cross(one - from).dot(along.cross(other - from)) < 0.0
    };
    let size = (b - a).length().max((c - a).length()).max((d - a).length());
    let volume = (b - a).cross(c - a).dot(d - a);
    parts([a, c], [b, d]) && parts([b, d], [a, c]) && volume.abs() <= FLAT * size * size * size
}

/// Writes numbers as ranges: `4 to 7, 9`, and `…` after a few.
pub(super) fn in_words(numbers: &[usize]) -> String {
    /// The number of ranges that a message names.
    const NAMED: usize = 5;
    let mut ranges: Vec<[usize; 2]> = Vec::new();
    for &number in numbers {
        match ranges.last_mut() {
            Some([_, last]) if *last + 1 == number => *last = number,
            _ => ranges.push([number, number]),
        }
    }
    let words = |&[first, last]: &[usize; 2]| match last - first {
        0 => first.to_string(),
        _ => format!("{first} to {last}"),
    };
    let named: Vec<String> = ranges.iter().take(NAMED).map(words).collect();
    format!("{}{}", named.join(", "), if ranges.len() > NAMED { ", …" } else { "" })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mesh(triangles: &[[u32; 3]], apart: f64) -> Mesh {
        // Two squares side by side, and their vertices once more.
        let once = [(0, 0), (1, 0), (2, 0), (0, 1), (1, 1), (2, 1)].map(|(x, y)| DVec3::new(f64::from(x), f64::from(y), 0.0));
        let again = once.map(|place| place + apart * DVec3::Z);
        Mesh::new([once, again].concat(), triangles.to_vec())
    }

    const FRONT: [[u32; 3]; 4] = [[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4]];
    const BACK: [[u32; 3]; 4] = [[0, 3, 1], [1, 3, 4], [1, 4, 2], [2, 4, 5]];

    #[test]
    fn a_second_side_with_the_same_or_other_diagonals_lies_on_the_first() {
        let both = |back: [[u32; 3]; 4]| [FRONT, back].concat();
        let numbers = |triangles: &[[u32; 3]], apart| super::triangles(&mesh(triangles, apart), triangles.len());
        assert!(numbers(&FRONT, 0.0).is_empty());
        assert_eq!(numbers(&both(BACK), 0.0), [4, 5, 6, 7]);
        assert_eq!(numbers(&both(FRONT.map(|[a, b, c]| [a, c, b])), 0.0), [4, 5, 6, 7]);
        // Each side has vertices of its own.
        let own = BACK.map(|triangle| triangle.map(|vertex| vertex + 6));
        assert_eq!(numbers(&both(own), 0.0), [4, 5, 6, 7]);
        assert!(numbers(&both(own), 0.1).is_empty());
        // A single square whose back is split differently; the other square has no back.
        assert_eq!(numbers(&[&FRONT[..], &BACK[2..]].concat(), 0.0), [4, 5]);
    }

    #[test]
    fn a_tetrahedron_has_one_side() {
        let mut mesh = mesh(&[[0, 1, 3], [0, 3, 4], [0, 4, 1], [1, 4, 3]], 0.0);
        mesh.positions[4].z = 1e-3;
        assert!(triangles(&mesh, 4).is_empty());
        mesh.positions[4].z = 0.0;
        assert_eq!(triangles(&mesh, 4).len(), 2);
    }

    #[test]
    fn numbers_are_written_as_ranges() {
        assert_eq!(in_words(&[4, 5, 6, 9]), "4 to 6, 9");
        assert_eq!(in_words(&[1, 3, 5, 7, 9, 11]), "1, 3, 5, 7, 9, …");
    }
}
