//! Tests of topology and its counts.

use crate::{Topology, TopologyError, TopologyStatistics};
use proptest::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

/// Generates triangles over a few vertices, with many duplicates, degenerates and non-manifold edges.
fn index_soup() -> impl Strategy<Value = (usize, Vec<[u32; 3]>)> {
    (1..9_u32).prop_flat_map(|vertex_count| {
        let triangles = prop::collection::vec(prop::array::uniform3(0..vertex_count), 1..24);
        (Just(vertex_count as usize), triangles)
    })
}

fn naive_edges(triangles: &[[u32; 3]]) -> BTreeMap<(u32, u32), BTreeSet<usize>> {
    let mut edges: BTreeMap<_, BTreeSet<_>> = BTreeMap::new();
    for (index, t) in triangles.iter().enumerate() {
        for (a, b) in [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])] {
            if a != b {
                edges.entry((a.max(b), a.min(b))).or_default().insert(index);
            }
        }
    }
    edges
}

/// Grows each component until nothing more joins it.
fn naive_components(triangles: &[[u32; 3]]) -> usize {
    let mut rest: Vec<BTreeSet<u32>> = triangles.iter().map(|t| t.iter().copied().collect()).collect();
    let mut components = 0;
    while let Some(mut component) = rest.pop() {
        while let Some(index) = rest.iter().position(|t| !t.is_disjoint(&component)) {
            component.extend(rest.swap_remove(index));
        }
        components += 1;
    }
    components
}

proptest! {
    #[test]
    fn vertices_without_a_triangle_change_no_edge_but_its_vertices_numbers((n, triangles) in index_soup()) {
        let far = |vertex: u32| 400_000_000 * vertex + 5;
        let topology = Topology::new(n, triangles.clone()).unwrap();
        let scattered = triangles.iter().map(|corners| corners.map(far)).collect();
        let scattered = Topology::new(u32::MAX as usize, scattered).unwrap();
        let edges: Vec<_> = topology.edges().iter().map(|ends| ends.map(far)).collect();
        prop_assert_eq!(scattered.edges(), edges);
        prop_assert_eq!(scattered.triangle_edges(), topology.triangle_edges());
        let expected = topology.statistics();
        let isolated_vertices = expected.isolated_vertices + u32::MAX as usize - n;
        prop_assert_eq!(scattered.statistics(), TopologyStatistics { isolated_vertices, ..expected });
    }

    #[test]
    fn edges_are_each_found_once_and_sorted_by_larger_then_smaller_vertex((n, triangles) in index_soup()) {
        let topology = Topology::new(n, triangles.clone()).unwrap();
        let expected: Vec<[u32; 2]> = naive_edges(&triangles).keys().map(|&(large, small)| [small, large]).collect();
        prop_assert_eq!(topology.edges(), expected);
    }

    #[test]
    fn a_triangles_edge_k_joins_its_vertices_k_and_k_plus_1((n, triangles) in index_soup()) {
        let topology = Topology::new(n, triangles.clone()).unwrap();
        prop_assert_eq!(topology.triangles(), &triangles);
        for (triangle, edges) in triangles.iter().zip(topology.triangle_edges()) {
            for k in 0..3 {
                let (a, b) = (triangle[k], triangle[(k + 1) % 3]);
                if a == b {
                    prop_assert_eq!(edges[k], Topology::NO_EDGE);
                } else {
                    prop_assert_eq!(topology.edges()[edges[k] as usize], [a.min(b), a.max(b)]);
                }
            }
        }
    }

    #[test]
    fn statistics_agree_with_a_naive_recount((n, triangles) in index_soup()) {
        let statistics = Topology::new(n, triangles.clone()).unwrap().statistics();
        let edges = naive_edges(&triangles);
        let edges_with = |wanted: fn(usize) -> bool| edges.values().filter(|t| wanted(t.len())).count();
        let sets: Vec<BTreeSet<u32>> = triangles.iter().map(|t| t.iter().copied().collect()).collect();
        let used: BTreeSet<u32> = triangles.iter().flatten().copied().collect();
        prop_assert_eq!(statistics, TopologyStatistics {
            components: naive_components(&triangles),
            isolated_vertices: n - used.len(),
            boundary_edges: edges_with(|count| count == 1),
            interior_edges: edges_with(|count| count == 2),
            non_manifold_edges: edges_with(|count| count >= 3),
            duplicate_triangles: (0..sets.len()).filter(|&i| sets[..i].contains(&sets[i])).count(),
            degenerate_triangles: sets.iter().filter(|set| set.len() < 3).count(),
            loose_edges: 0,
            points: 0,
        });
    }
}

#[test]
fn a_triangle_that_names_a_vertex_twice_has_one_edge_in_two_entries() {
    let topology = Topology::new(2, vec![[0, 0, 1]]).unwrap();
    assert_eq!(topology.edges(), [[0, 1]]);
    assert_eq!(topology.triangle_edges(), [[Topology::NO_EDGE, 0, 0]]);
    assert_eq!(topology.statistics().boundary_edges, 1);
}

#[test]
fn a_triangle_of_one_vertex_has_no_edge_and_is_a_component() {
    let topology = Topology::new(1, vec![[0, 0, 0]]).unwrap();
    assert_eq!(topology.triangle_edges(), [[Topology::NO_EDGE; 3]]);
    assert_eq!(topology.statistics().components, 1);
    assert_eq!(topology.statistics().isolated_vertices, 0);
}

#[test]
fn an_index_out_of_range_is_refused_with_the_first_triangle_and_its_vertex() {
    let error = Topology::new(3, vec![[0, 1, 2], [0, 3, 1], [9, 9, 9]]).unwrap_err();
    assert_eq!(
        error.to_string(),
        "triangle 1 names vertex 3, but there are 3 vertices, numbered from 0"
    );
}

#[test]
fn a_mesh_without_triangles_is_refused() {
    assert_eq!(Topology::new(3, vec![]).unwrap_err(), TopologyError::NoTriangles);
}

#[test]
fn more_vertices_than_a_u32_can_number_are_refused_before_memory_is_asked_for() {
    let error = Topology::new(usize::MAX, vec![[0, 1, 2]]).unwrap_err();
    assert!(matches!(error, TopologyError::TooLarge { .. }), "{error}");
}

#[test]
fn statistics_print_only_what_is_unusual() {
    let plain = Topology::new(3, vec![[0, 1, 2]]).unwrap().statistics();
    assert_eq!(plain.to_string(), "1 component, 3 boundary and 0 interior edges");
    let odd = Topology::new(5, vec![[0, 1, 2], [2, 1, 0], [3, 3, 3]]).unwrap().statistics();
    assert_eq!(
        odd.to_string(),
        "2 components, 0 boundary and 3 interior edges, 1 isolated vertex, 1 duplicate triangle, 1 degenerate triangle"
    );
}
