//! The choice of edges that tear after a step.

use super::loads::{Edge, Tearable};
use selvedge_core::glam::DVec3;
use std::collections::BTreeSet;

/// A place where a cloth tears. Vertices and triangles are the cloth's.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Tear {
    pub(crate) cloth: usize,
    /// One edge, or two within the cloth, each with its load in N/m.
    pub(crate) edges: Vec<([u32; 2], f64)>,
    /// The split vertices with their fans. The vertex stays in the first fan.
    pub(crate) splits: Vec<(u32, Vec<Vec<u32>>)>,
    /// All vertices of the fans, in order.
    pub(crate) around: Vec<u32>,
}

impl Tearable {
    /// Returns the tears at `positions`, in descending order of load over strength. `may_split` says which vertices may be split.
    pub(crate) fn tears(&mut self, positions: &[DVec3], may_split: impl Fn(u32) -> bool) -> Vec<Tear> {
        self.look(positions);
        let this = &*self;
        let loads = this.edges.iter().map(|edge| this.load(edge));
        let above = { this.edges.iter().zip(loads) }.filter(|(edge, load)| *load > edge.strength);
        let mut above: Vec<(&Edge, f64)> = above.collect();
        // The sort is stable, so edges with equal loads stay in ascending order of their ends.
        above.sort_by(|(one, a), (other, b)| (b / other.strength).total_cmp(&(a / one.strength)));
        // The places of edges, by their ends.
        let mut places: Vec<(u32, usize)> = { above.iter().enumerate() }
            .flat_map(|(place, (edge, _))| edge.vertices.map(|end| (end, place)))
            .collect();
        places.sort_unstable();
        let of_end = |end: u32| {
            let first = places.partition_point(|(other, _)| *other < end);
            places[first..].iter().take_while(move |(other, _)| *other == end)
        };
        let mut taken = BTreeSet::new();
        let mut tears = Vec::new();
        for (place, &(edge, load)) in above.iter().enumerate() {
            if edge.vertices.iter().any(|end| taken.contains(end)) {
                continue;
            }
            let alone = this.tear(&[(edge.vertices, load)], &may_split);
            let tear = alone.or_else(|| {
                // Pairs with an earlier edge were tried before, as that edge's second.
                let after = edge.vertices.into_iter().flat_map(of_end).filter(|(_, other)| *other > place);
                let seconds: BTreeSet<usize> = after.map(|(_, other)| *other).collect();
                seconds.into_iter().find_map(|second| {
                    let (other, of_other) = above[second];
                    let goes_on = this.goes_on(edge.vertices, other.vertices);
                    let both = || this.tear(&[(edge.vertices, load), (other.vertices, of_other)], &may_split);
                    goes_on.then(both).flatten()
                })
            });
            if let Some(tear) = tear.filter(|tear| tear.around.iter().all(|vertex| !taken.contains(vertex))) {
                taken.extend(tear.around.iter().copied());
                tears.push(tear);
            }
        }
        tears
    }

    /// Returns whether a tear along one edge continues along the other, with a turn of less than a right angle.
    fn goes_on(&self, one: [u32; 2], other: [u32; 2]) -> bool {
        let Some(&middle) = one.iter().find(|end| other.contains(end)) else {
            return false;
        };
        let outward = |edge: [u32; 2]| {
            let far = if edge[0] == middle { edge[1] } else { edge[0] };
            self.fabric.rest[far as usize] - self.fabric.rest[middle as usize]
        };
        outward(one).dot(outward(other)) < 0.0
    }

    /// Returns the tear along these edges, if it splits one of their ends.
    fn tear(&self, edges: &[([u32; 2], f64)], may_split: &impl Fn(u32) -> bool) -> Option<Tear> {
        let cut: Vec<[u32; 2]> = edges.iter().map(|(edge, _)| *edge).collect();
        let ends: BTreeSet<u32> = cut.iter().flatten().copied().collect();
        let free = ends.into_iter().filter(|&end| may_split(end));
        let splits: Vec<_> = free.filter_map(|end| Some((end, self.fabric.parted(end, &cut)?))).collect();
        let fans = splits.iter().flat_map(|(_, fans)| fans.iter().flatten());
        let around: BTreeSet<u32> = fans.flat_map(|&triangle| self.fabric.triangles[triangle as usize]).collect();
        (!splits.is_empty()).then(|| Tear {
            cloth: self.cloth,
            edges: edges.to_vec(),
            splits,
            around: around.into_iter().collect(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::{Cloth, sheet};

    /// Returns the tears of a sheet of 6 by 6 cells of a metre, stretched by a tenth along x; `strength` selects edges.
    fn tears(strength: impl Fn([DVec3; 2]) -> Option<f64>) -> Vec<Tear> {
        let cloth = Cloth::of(sheet(DVec3::ZERO, [DVec3::X * 6.0, DVec3::Y * 6.0], [6, 6]));
        let positions: Vec<_> = { cloth.mesh.positions.iter() }
            .map(|p| DVec3::new(1.1 * p.x, p.y, 0.0))
            .collect();
        let rest = cloth.mesh.positions.clone();
        let mut tearable = Tearable::new(&cloth, [1000.0; 2], |edge| strength(edge.map(|v| rest[v as usize])));
        tearable.tears(&positions, |vertex| vertex != 0)
    }

    fn edges(tears: &[Tear]) -> Vec<[u32; 2]> {
        tears
            .iter()
            .flat_map(|tear| tear.edges.iter().map(|(edge, _)| *edge))
            .collect()
    }

    /// Selects the edges from one row of the column x = 3 to the next.
    fn column(rows: std::ops::Range<u32>) -> impl Fn([DVec3; 2]) -> Option<f64> {
        move |[a, b]| {
            let is_within = a.x == 3.0 && b.x == 3.0 && rows.contains(&(a.y.min(b.y) as u32));
            is_within.then_some(50.0)
        }
    }

    #[test]
    fn an_edge_at_the_border_tears_by_itself_and_splits_the_vertex_there() {
        let tears = tears(column(0..1));
        assert_eq!(edges(&tears), [[3, 10]]);
        assert_eq!(tears[0].splits.len(), 1);
        let (vertex, fans) = &tears[0].splits[0];
        assert_eq!((*vertex, fans.len()), (3, 2));
        assert!((tears[0].edges[0].1 - 100.0).abs() < 1e-9);
    }

    #[test]
    fn an_edge_within_the_cloth_tears_only_with_another_that_goes_on() {
        assert_eq!(tears(column(2..3)), []);
        let tears = tears(column(2..4));
        assert_eq!(edges(&tears), [[17, 24], [24, 31]]);
        assert_eq!(tears[0].splits.iter().map(|(vertex, _)| *vertex).collect::<Vec<_>>(), [24]);
    }

    #[test]
    fn what_shares_a_triangle_tears_one_after_the_other_and_the_most_loaded_first() {
        let weaker = |[a, b]: [DVec3; 2]| (a.x == b.x && a.x > 0.0 && a.x < 6.0).then_some(if a.x == 2.0 { 40.0 } else { 50.0 });
        let tears = tears(weaker);
        assert_eq!(tears[0].edges[0].0, [2, 9]);
        let mut taken = BTreeSet::new();
        assert!(tears.iter().flat_map(|tear| &tear.around).all(|vertex| taken.insert(*vertex)));
    }

    #[test]
    fn nothing_tears_below_its_strength_or_at_a_vertex_that_must_stay_whole() {
        assert_eq!(tears(|edge| column(0..6)(edge).map(|_| 100.1)), []);
        // This edge is the diagonal at the held corner.
        let corner = |edge: [DVec3; 2]| edge.contains(&DVec3::ZERO).then_some(50.0);
        assert_eq!(tears(corner), []);
    }
}
