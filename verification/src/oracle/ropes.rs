//! Edges that belong to no triangle: their intersections at rest, and whether they pass through each other during a step.

use super::collision::collides;
use super::mesh::mesh_intersections;
use super::motion::{Pair, PairKind};

/// Returns pairs of triangles and loose edges that intersect, each by its vertices; an edge from a to b is (a, b, b). At least
/// one of the two is a loose edge or among the first `count` triangles. Vertices are shared by index, as in
/// [`mesh_intersections`].
///
/// ```
/// use selvedge_verification::oracle::intersections_with_loose_edges;
/// let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.2, 0.2, 1.0], [0.2, 0.2, -1.0]];
/// let found = |edge| intersections_with_loose_edges(&positions, &[[0, 1, 2]], &[edge], 0);
/// assert_eq!(found([3, 4]), [[[3, 4, 4], [0, 1, 2]]]);
/// assert!(found([3, 0]).is_empty());
/// ```
///
/// # Panics
/// Panics if a coordinate is NaN or infinite, or an index is out of range.
pub fn intersections_with_loose_edges(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    loose_edges: &[[u32; 2]],
    count: usize,
) -> Vec<[[u32; 3]; 2]> {
    let loose = loose_edges.iter().map(|&[a, b]| [a, b, b]);
    let (first, others) = triangles.split_at(count);
    let faces: Vec<[u32; 3]> = loose.chain(first.iter().copied()).chain(others.iter().copied()).collect();
    let found = mesh_intersections(positions, &faces, loose_edges.len() + count);
    found.into_iter().map(|pair| pair.map(|face| faces[face as usize])).collect()
}

/// Returns pairs of edges without a common vertex that touch while all points move straight from `start` to `end`. So it finds
/// ropes that passed through each other, which no state at rest shows.
///
/// # Panics
/// Panics if a coordinate is NaN or infinite, or an index is out of range.
pub fn edges_that_meet(start: &[[f64; 3]], end: &[[f64; 3]], edges: &[[u32; 2]]) -> Vec<[[u32; 2]; 2]> {
    let ranges = |edge: &[u32; 2]| {
        [0, 1, 2].map(|axis| {
            let all = edge
                .iter()
                .flat_map(|&vertex| [start, end].map(|frame| frame[vertex as usize][axis]));
            all.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
        })
    };
    let mut boxes: Vec<_> = edges.iter().map(|edge| (*edge, ranges(edge))).collect();
    boxes.sort_by(|(_, a), (_, b)| a[0][0].total_cmp(&b[0][0]));
    let mut found = Vec::new();
    for (place, (one, own)) in boxes.iter().enumerate() {
        let near = boxes[place + 1..].iter().take_while(|(_, other)| other[0][0] <= own[0][1]);
        for (other, of_other) in near {
            let overlap = own.iter().zip(of_other).all(|(a, b)| a[0] <= b[1] && b[0] <= a[1]);
            if !overlap || one.iter().any(|vertex| other.contains(vertex)) {
                continue;
            }
            let vertices = [one[0], one[1], other[0], other[1]];
            let pair = Pair::new(
                PairKind::EdgeEdge,
                vertices.map(|vertex| start[vertex as usize]),
                vertices.map(|vertex| end[vertex as usize]),
            );
            if collides(&pair).is_some() {
                found.push([*one, *other]);
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edges_that_cross_each_others_way_meet_and_those_beside_each_other_do_not() {
        let start = [
            [0.0, 0.0, 0.0],
            [2.0, 0.0, 0.0],
            [1.0, -1.0, 1.0],
            [1.0, 1.0, 1.0],
            [1.0, 3.0, 1.0],
        ];
        let moved = |by: f64| start.map(|[x, y, z]| if z > 0.0 { [x, y, z + by] } else { [x, y, z] });
        let edges = [[0, 1], [2, 3], [3, 4]];
        assert_eq!(edges_that_meet(&start, &moved(-2.0), &edges), [[[0, 1], [2, 3]]]);
        assert!(edges_that_meet(&start, &moved(-0.5), &edges).is_empty());
    }

    #[test]
    fn a_rope_meets_itself_only_where_it_folds_back_onto_itself() {
        let found = |points: &[[f64; 3]]| {
            let edges: Vec<[u32; 2]> = (1..points.len() as u32).map(|k| [k - 1, k]).collect();
            intersections_with_loose_edges(points, &[], &edges, 0).len()
        };
        let bent = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.5, 0.5, 0.5]];
        assert_eq!(found(&bent), 0);
        assert_eq!(found(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.25, 0.0, 0.0]]), 1);
        assert_eq!(
            found(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.5, -1.0, 0.0]]),
            1
        );
    }
}
