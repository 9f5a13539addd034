//! The intersections of a mesh at rest are those of exact triangles, pair by pair and all together.

use crate::support::prelude::*;
use selvedge::Intersection;
use selvedge::glam::Vec3;
use selvedge_verification::oracle::{mesh_self_intersections, triangles_intersect};

type Point = [f64; 3];

fn intersections<P: Position>(detector: &mut CollisionDetector<P::Scalar>, positions: &[P]) -> Vec<Intersection> {
    let mut found = Vec::new();
    detector
        .intersections(positions, &mut found)
        .expect("finite positions, one for each vertex");
    found
}

fn points<S: Format>(mesh: &MeshCase<S>) -> Vec<Point> {
    mesh.positions.iter().map(|[start, _]| start.map(Scalar::to_f64)).collect()
}

/// Returns whether two hulls of up to three vertices each, without a common vertex, have a point in common. Points and segments
/// are triangles with a repeated corner.
fn meet(positions: &[Point], one: &[u32], other: &[u32]) -> bool {
    let hull = |vertices: &[u32]| [0, 1, 2].map(|k| positions[vertices[k.min(vertices.len() - 1)] as usize]);
    triangles_intersect(&hull(one), &hull(other), &[])
}

fn are_apart(one: &[u32], other: &[u32]) -> bool {
    one.iter().all(|vertex| !other.contains(vertex))
}

/// The expected result, found by examining everything.
struct Truth {
    /// All edges and faces that meet.
    edge_face: BTreeSet<Intersection>,
    /// All vertices and faces, and all edges, that touch.
    touching: BTreeSet<Intersection>,
}

fn truth(topology: &Topology, positions: &[Point]) -> Truth {
    let meet = |one: &[u32], other: &[u32]| are_apart(one, other) && meet(positions, one, other);
    let faces: Vec<_> = (0..).zip(topology.triangles()).collect();
    let edges: Vec<_> = (0..).zip(topology.edges()).collect();
    let mut truth = Truth {
        edge_face: BTreeSet::new(),
        touching: BTreeSet::new(),
    };
    for &(face, corners) in &faces {
        let met = edges.iter().filter(|(_, ends)| meet(*ends, corners));
        truth
            .edge_face
            .extend(met.map(|&(edge, _)| Intersection::EdgeFace { edge, face }));
        let used: BTreeSet<u32> = topology.triangles().iter().flatten().copied().collect();
        let met = used.into_iter().filter(|&vertex| meet(&[vertex], corners));
        truth
            .touching
            .extend(met.map(|vertex| Intersection::VertexFace { vertex, face }));
    }
    for (k, &(first, ends)) in edges.iter().enumerate() {
        let met = edges[k + 1..].iter().filter(|(_, others)| meet(ends, *others));
        truth
            .touching
            .extend(met.map(|&(second, _)| Intersection::EdgeEdge { edges: [first, second] }));
    }
    truth
}

/// Checks that all edges and faces that meet are found, and no others. The vertices and faces, and the edges, that are found do
/// touch, and some are found if any touch.
fn intersections_are_those_of_exact_triangles<S: Format>(mesh: &MeshCase<S>) -> TestCaseResult {
    let topology = mesh.topology();
    let positions = points(mesh);
    let mut detector = CollisionDetector::<S>::new(topology.clone());
    let found = intersections(&mut detector, &mesh.frame(0));
    prop_assert!(found.is_sorted_by(|a, b| a < b), "{:?}", found);
    let found: BTreeSet<_> = found.into_iter().collect();
    let truth = truth(&topology, &positions);
    let is_edge_face = |found: &&Intersection| matches!(found, Intersection::EdgeFace { .. });
    let edge_face: BTreeSet<_> = found.iter().filter(is_edge_face).copied().collect();
    prop_assert_eq!(&edge_face, &truth.edge_face);
    let others: BTreeSet<_> = found.difference(&edge_face).copied().collect();
    prop_assert!(others.is_subset(&truth.touching), "{:?} of {:?}", others, truth.touching);
    prop_assert_eq!(found.is_empty(), truth.edge_face.is_empty() && truth.touching.is_empty());
    prop_assert_eq!(detector.has_intersections(&mesh.frame(0)), Ok(!found.is_empty()));
    // These are two triangles that share more than the hull of their common vertices.
    let triangles = mesh_self_intersections(&positions, topology.triangles());
    prop_assert!(triangles.is_empty() || !found.is_empty(), "{:?}", triangles);
    if topology.triangles().iter().all(|&corners| has_area(&positions, corners)) {
        prop_assert_eq!(triangles.is_empty(), found.is_empty(), "{:?}, {:?}", triangles, found);
    }
    Ok(())
}

/// Returns whether the corners are not on a line. A triangle without area touches its neighbours' edges with its own corners.
fn has_area(positions: &[Point], [a, b, c]: [u32; 3]) -> bool {
    let edges = [[a, b, c], [b, c, a], [c, a, b]];
    edges.iter().all(|&[u, v, w]| !meet(positions, &[u, v], &[w]))
}

formats!(intersections_are_those_of_exact_triangles(150, meshes()));

/// Makes two sheets of `n` by `n` squares that wave through each other.
fn tangled_sheets(n: u32) -> (Topology, Vec<DVec3>) {
    let at = |index: u32| f64::from(index) / f64::from(n);
    let rows = (0..=n).flat_map(|j| (0..=n).map(move |i| (at(i), at(j))));
    let height = |x: f64, y: f64| 0.02 * ((17.0 * x).sin() * (13.0 * y).cos() + 0.3 * (41.0 * x + 23.0 * y).sin());
    let sheet = rows.map(|(x, y)| DVec3::new(x, y, height(x, y)));
    let other = sheet.clone().map(|p| DVec3::new(p.y + 0.013, p.x + 0.007, p.z + 0.004));
    let positions: Vec<_> = sheet.chain(other).collect();
    let first = |sheet: u32, i: u32, j: u32| sheet * (n + 1) * (n + 1) + j * (n + 1) + i;
    let squares = (0..2).flat_map(|sheet| (0..n).flat_map(move |j| (0..n).map(move |i| first(sheet, i, j))));
    let triangles = squares.flat_map(|a| [[a, a + 1, a + n + 2], [a, a + n + 2, a + n + 1]]);
    let topology = Topology::new(positions.len(), triangles.collect()).expect("corners exist");
    (topology, positions)
}

#[test]
fn the_same_list_on_any_number_of_threads_on_every_instruction_set_and_after_any_step() {
    let (topology, positions) = tangled_sheets(60);
    let expected = intersections(&mut CollisionDetector::<f64>::new(topology.clone()), &positions);
    assert!(expected.len() > 500, "{}", expected.len());
    let moved: Vec<_> = positions.iter().map(|p| DVec3::new(p.z, p.x * p.y, p.x - p.y)).collect();
    for count in [1, 2, 3, 7] {
        for (name, level) in available_levels() {
            let mut detector = CollisionDetector::<f64>::new(topology.clone());
            detector.set_threads(Threads::from_count(count)).expect("a few threads");
            detector.set_level(level);
            assert!(detector.is_free(&moved, &positions).is_ok());
            assert!(
                intersections(&mut detector, &positions) == expected,
                "{count} threads, {name}"
            );
        }
    }
}

#[test]
fn triangles_of_a_large_mesh_that_intersect_are_those_of_the_pairs_found() {
    let (topology, positions) = tangled_sheets(60);
    let found = intersections(&mut CollisionDetector::<f64>::new(topology.clone()), &positions);
    let mut triangles = BTreeSet::new();
    for intersection in found {
        let Intersection::EdgeFace { edge, face } = intersection else {
            panic!("nothing is folded: {intersection:?}");
        };
        let of_edge = (0..)
            .zip(topology.triangle_edges())
            .filter(|(_, edges)| edges.contains(&edge));
        triangles.extend(of_edge.map(|(triangle, _): (u32, _)| [triangle.min(face), triangle.max(face)]));
    }
    let positions: Vec<Point> = positions.iter().map(DVec3::to_array).collect();
    let expected: BTreeSet<_> = mesh_self_intersections(&positions, topology.triangles())
        .into_iter()
        .collect();
    // An edge of two triangles that ends in a face's plane would be found with both; here there is none.
    assert_eq!(triangles, expected);
}

/// Makes two triangles with a common edge, opened by that height.
fn hinge(opened: f32) -> [Vec3; 4] {
    [
        Vec3::ZERO,
        Vec3::new(3.0, 1.0, 0.0),
        Vec3::new(1.0, 2.0, 0.0),
        Vec3::new(2.0, 2.0, opened),
    ]
}

#[test]
fn neighbours_intersect_only_when_they_are_folded_flat() {
    let topology = Topology::new(4, vec![[0, 1, 2], [1, 0, 3]]).expect("corners exist");
    let mut detector = CollisionDetector::<f32>::new(topology);
    assert_eq!(intersections(&mut detector, &hinge(1e-30)), []);
    // The edges from 1 to 2 and from 0 to 3 cross.
    assert_eq!(detector.topology().edges()[1..], [[0, 2], [1, 2], [0, 3], [1, 3]]);
    let folded = intersections(&mut detector, &hinge(0.0));
    assert_eq!(folded, [Intersection::EdgeEdge { edges: [2, 3] }]);
    // The hinge is flat, but not folded.
    let mut open = hinge(0.0);
    open[3].y = -5.0;
    assert_eq!(intersections(&mut detector, &open), []);
}

#[test]
fn resting_vertices_among_themselves_are_not_asked_about() {
    let (topology, positions) = tangled_sheets(8);
    let mut detector = CollisionDetector::<f64>::new(topology);
    let all = intersections(&mut detector, &positions);
    detector
        .set_moving(Some(&vec![false; positions.len()]))
        .expect("one for each vertex");
    assert_eq!(intersections(&mut detector, &positions), []);
    // All triangles of the first sheet move, so all others are tested against nothing but the sheet.
    let half: Vec<_> = (0..positions.len()).map(|vertex| vertex < positions.len() / 2).collect();
    detector.set_moving(Some(&half)).expect("one for each vertex");
    assert!(!all.is_empty() && intersections(&mut detector, &positions) == all);
}
