//! Ropes, hair and particles: edges and points that belong to no triangle.

use selvedge::{CollisionDetector, Criterion, FeaturePair, Intersection, PairKind, Topology, TopologyError};
use selvedge_core::elementary::Limits;

type Frame = Vec<[f64; 3]>;

/// Returns the features that meet during a step, in order.
fn contacts(topology: &Topology, start: &Frame, end: &Frame, separation: f64) -> Vec<FeaturePair> {
    let mut detector = CollisionDetector::<f64>::new(topology.clone());
    detector.set_criterion(criterion(separation)).unwrap();
    let mut found = Vec::new();
    detector.contacts(start, end, &mut found).unwrap();
    assert_eq!(detector.is_free(start, end).unwrap(), found.is_empty());
    assert_eq!(detector.earliest(start, end).unwrap().is_none(), found.is_empty());
    let mut features: Vec<_> = found
        .iter()
        .map(|found| topology.features_of(found.kind, found.pair))
        .collect();
    features.sort_unstable();
    features
}

/// Reports pairs within the separation; if it is zero, only pairs that truly touch.
fn criterion(separation: f64) -> Criterion<f64> {
    let tolerance = 1e-6;
    if separation > 0.0 {
        Criterion::Within(Limits { tolerance, separation })
    } else {
        Criterion::Touching { tolerance }
    }
}

fn shifted(frame: &Frame, vertices: &[usize], by: [f64; 3]) -> Frame {
    let mut shifted = frame.clone();
    for &vertex in vertices {
        for axis in 0..3 {
            shifted[vertex][axis] += by[axis];
        }
    }
    shifted
}

#[test]
fn loose_features_are_faces_after_the_triangles_that_name_a_vertex_again() {
    let topology = Topology::with_loose_features(7, vec![[0, 1, 2]], &[[2, 3], [3, 4]], &[5]).unwrap();
    let faces = [[0, 1, 2], [2, 3, 3], [3, 4, 4], [5, 5, 5]];
    assert_eq!(topology.triangles(), faces);
    let same = Topology::new(7, faces.to_vec()).unwrap();
    assert_eq!(topology.edges(), same.edges());
    assert_eq!(topology.triangle_edges(), same.triangle_edges());
    assert_eq!(topology.components(), [0, 0, 0, 0, 0, 5, 6]);
}

#[test]
fn statistics_tell_what_is_loose_from_degenerate_triangles() {
    let topology = Topology::with_loose_features(7, vec![[0, 1, 2], [0, 1, 1]], &[[2, 3], [0, 1]], &[5]).unwrap();
    let statistics = topology.statistics();
    assert_eq!((statistics.loose_edges, statistics.points), (2, 1));
    // The degenerate triangle lies on the edge 0-1, which has two triangles then. A loose edge is no triangle.
    let text =
        "2 components, 2 boundary and 1 interior edges, 2 isolated vertices, 1 degenerate triangle, 2 loose edges, 1 point";
    assert_eq!(statistics.to_string(), text);
}

#[test]
fn what_names_no_vertex_of_the_mesh_is_an_error_that_says_where() {
    let wrong = |index, is_point, vertex| TopologyError::LooseVertexOutOfRange {
        index,
        is_point,
        vertex,
        vertex_count: 3,
    };
    let edge = Topology::with_loose_features(3, vec![], &[[0, 1], [1, 3]], &[9]).unwrap_err();
    assert_eq!(edge, wrong(1, false, 3));
    assert_eq!(
        edge.to_string(),
        "loose edge 1 names vertex 3, but there are 3 vertices, numbered from 0"
    );
    let point = Topology::with_loose_features(3, vec![], &[[0, 1]], &[2, 9]).unwrap_err();
    assert_eq!(point, wrong(1, true, 9));
    assert_eq!(
        point.to_string(),
        "point 1 names vertex 9, but there are 3 vertices, numbered from 0"
    );
    assert_eq!(
        Topology::with_loose_features(3, vec![], &[], &[]),
        Err(TopologyError::NoTriangles)
    );
}

#[test]
fn a_rope_meets_a_rope_and_a_triangle_and_a_particle_meets_the_inside_of_a_triangle() {
    let topology = Topology::with_loose_features(8, vec![[0, 1, 2]], &[[3, 4], [5, 6]], &[7]).unwrap();
    let edge = |ends| topology.edges().iter().position(|&edge| edge == ends).unwrap() as u32;
    let start = vec![
        [-5.0, -5.0, 0.0],
        [5.0, -5.0, 0.0],
        [0.0, 5.0, 0.0],
        [-9.0, 0.0, 9.0],
        [9.0, 0.0, 9.0],
        [0.0, -1.0, 10.0],
        [0.0, 1.0, 10.0],
        [0.5, 0.5, 1.0],
    ];
    let falls = shifted(&start, &[7], [0.0, 0.0, -2.0]);
    assert_eq!(
        contacts(&topology, &start, &falls, 0.0),
        [FeaturePair::VertexFace { vertex: 7, face: 0 }]
    );
    let crosses = shifted(&start, &[5, 6], [0.0, 0.0, -2.0]);
    let ropes = FeaturePair::EdgeEdge {
        edges: [edge([3, 4]), edge([5, 6])],
    };
    assert_eq!(contacts(&topology, &start, &crosses, 0.0), [ropes]);
    let long = shifted(&start, &[3, 4], [0.0, 0.0, -10.0]);
    let both = contacts(&topology, &start, &long, 0.0);
    let sides = [[0, 2], [1, 2]].map(|side| FeaturePair::EdgeEdge {
        edges: [edge(side).min(edge([3, 4])), edge(side).max(edge([3, 4]))],
    });
    assert_eq!(both, sides);
}

#[test]
fn particles_meet_if_they_meet_exactly_or_come_within_the_separation() {
    let topology = Topology::with_loose_features(2, vec![], &[], &[0, 1]).unwrap();
    let start = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]];
    // Each is the point of the other.
    let both = [[0, 1], [1, 0]].map(|vertices| FeaturePair::VertexVertex { vertices });
    let through = shifted(&start, &[1], [-3.0, 0.0, 0.0]);
    assert_eq!(contacts(&topology, &start, &through, 0.0), both);
    let past = shifted(&start, &[1], [-3.0, 1e-12, 0.0]);
    assert_eq!(contacts(&topology, &start, &past, 0.0), []);
    assert_eq!(contacts(&topology, &start, &past, 0.1), both);
    let wide = vec![[0.0, 0.2, 0.0], [1.0, 0.0, 0.0]];
    assert_eq!(contacts(&topology, &wide, &shifted(&wide, &[1], [-3.0, 0.0, 0.0]), 0.1), []);
}

#[test]
fn the_end_of_a_rope_that_folds_back_meets_the_next_piece() {
    let topology = Topology::with_loose_features(3, vec![], &[[0, 1], [1, 2]], &[]).unwrap();
    let start = vec![[-1.0, 0.0, 1.0], [0.0, 0.0, 0.0], [2.0, 0.0, 0.0]];
    let folded = shifted(&start, &[0], [2.0, 0.0, -2.0]);
    let edge = topology.edges().iter().position(|&ends| ends == [1, 2]).unwrap() as u32;
    assert_eq!(
        contacts(&topology, &start, &folded, 0.0),
        [FeaturePair::VertexEdge { vertex: 0, edge }]
    );
}

#[test]
fn coherent_steps_find_the_same() {
    let topology = Topology::with_loose_features(4, vec![], &[[0, 1]], &[2, 3]).unwrap();
    let mut positions = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.5, 0.0, 1.0], [0.5, 0.0, 1.5]];
    let mut coherent = CollisionDetector::<f64>::new(topology.clone());
    coherent.set_coherent(true);
    coherent.set_criterion(criterion(0.05)).unwrap();
    let mut found = 0;
    for _ in 0..40 {
        let end = shifted(&positions, &[2, 3], [0.0, 0.0, -0.05]);
        let (mut ours, mut theirs) = (Vec::new(), Vec::new());
        coherent.contacts(&positions, &end, &mut ours).unwrap();
        let mut fresh = CollisionDetector::<f64>::new(topology.clone());
        fresh.set_criterion(criterion(0.05)).unwrap();
        fresh.contacts(&positions, &end, &mut theirs).unwrap();
        let pairs = |contacts: &[selvedge::Contact<f64>]| {
            let mut pairs: Vec<_> = contacts.iter().map(|contact| (contact.kind, contact.pair)).collect();
            pairs.sort_unstable();
            pairs
        };
        assert_eq!(pairs(&ours), pairs(&theirs));
        found += ours.len();
        positions = end;
    }
    assert!(found > 4, "{found}");
}

#[test]
fn at_rest_a_point_inside_of_a_triangle_or_on_an_edge_or_point_is_an_intersection() {
    let triangle = [[-5.0, -5.0, 0.0], [5.0, -5.0, 0.0], [0.0, 5.0, 0.0]];
    let rest = [[8.0, 0.0, 0.0], [9.0, 0.0, 0.0]];
    let topology = Topology::with_loose_features(6, vec![[0, 1, 2]], &[[3, 4]], &[5]).unwrap();
    let found_at = |point: [f64; 3]| {
        let mut detector = CollisionDetector::<f64>::new(topology.clone());
        let positions = [&triangle[..], &rest, &[point]].concat();
        let mut found = Vec::new();
        detector.intersections(&positions, &mut found).unwrap();
        assert_eq!(detector.has_intersections(&positions).unwrap(), !found.is_empty());
        found
    };
    let touches = |face| Intersection::VertexFace { vertex: 5, face };
    assert_eq!(found_at([0.5, 0.5, 0.0]), [touches(0)]);
    assert_eq!(found_at([0.5, 0.5, f64::MIN_POSITIVE]), []);
    assert!(found_at([8.5, 0.0, 0.0]).contains(&touches(1)));

    let points = Topology::with_loose_features(2, vec![], &[], &[0, 1]).unwrap();
    let mut detector = CollisionDetector::<f64>::new(points);
    assert!(detector.has_intersections(&[[1.0, 2.0, 3.0]; 2]).unwrap());
    assert!(
        !detector
            .has_intersections(&[[1.0, 2.0, 3.0], [1.0, 2.0, 3.0_f64.next_up()]])
            .unwrap()
    );
}

#[test]
fn the_normal_of_two_particles_and_of_a_particle_at_an_edge_points_from_the_second() {
    let topology = Topology::with_loose_features(4, vec![], &[[0, 1]], &[2, 3]).unwrap();
    let start = vec![[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 3.0]];
    let end = shifted(&shifted(&start, &[2], [0.0, 0.0, -0.95]), &[3], [0.0, 0.0, -2.85]);
    let mut detector = CollisionDetector::<f64>::new(topology);
    detector.set_criterion(criterion(0.1)).unwrap();
    let mut found = Vec::new();
    detector.contacts(&start, &end, &mut found).unwrap();
    let mut kinds = Vec::new();
    for contact in &found {
        let geometry = detector.contact_geometry(&start, &end, contact).unwrap();
        let features = detector.topology().features_of(PairKind::VertexFace, contact.pair);
        let up = match features {
            FeaturePair::VertexEdge { vertex: 2 | 3, edge: 0 } | FeaturePair::VertexVertex { vertices: [3, 2] } => 1.0,
            FeaturePair::VertexVertex { vertices: [2, 3] } => -1.0,
            other => panic!("{other:?}"),
        };
        kinds.push(features);
        let normal: [f64; 3] = geometry.geometry.normal.expect("they are apart").into();
        let is_right = (normal[2] - up).abs() < 1e-9 && normal[0].abs() < 1e-9 && normal[1].abs() < 1e-9;
        assert!(is_right, "{features:?}: {normal:?}");
    }
    assert!(
        kinds.iter().any(|kind| matches!(kind, FeaturePair::VertexEdge { .. })),
        "{kinds:?}"
    );
}

/// Every edge of the vertex has an end of the loose edge, and the two share no proper triangle's edge.
#[test]
fn at_rest_a_vertex_on_a_loose_edge_that_lies_on_the_opposite_edge_of_its_triangle_is_an_intersection() {
    let topology = Topology::with_loose_features(3, vec![[2, 0, 1]], &[[0, 1]], &[]).unwrap();
    let mut detector = CollisionDetector::<f64>::new(topology);
    let mut positions = vec![[0.0, -3.0, 0.0], [-2.0, 1.0, 2.0], [-1.0, -1.0, 1.0]];
    let mut found = Vec::new();
    detector.intersections(&positions, &mut found).unwrap();
    assert_eq!(found, [Intersection::VertexFace { vertex: 2, face: 1 }]);
    assert!(detector.has_intersections(&positions).unwrap());
    positions[2][0] += f64::EPSILON;
    assert!(!detector.has_intersections(&positions).unwrap());
}
