//! The fans of a vertex: its triangles, grouped by edges at the vertex that are not cut.

use selvedge::Adjacency;
use selvedge_core::glam::DVec3;

/// The present triangles of a cloth.
#[derive(Debug)]
pub(super) struct Fabric {
    pub(super) triangles: Vec<[u32; 3]>,
    /// The triangles of each vertex; the shares are not used.
    pub(super) around: Adjacency<(u32, f64)>,
    pub(super) rest: Vec<DVec3>,
}

impl Fabric {
    fn around(&self, vertex: u32) -> Vec<u32> {
        let around = self.around.of(vertex as usize).iter();
        around.map(|&(triangle, _)| triangle).collect()
    }

    /// Returns the fans of a vertex, if cutting these edges increases their number.
    pub(super) fn parted(&self, vertex: u32, cut: &[[u32; 2]]) -> Option<Vec<Vec<u32>>> {
        let around = self.around(vertex);
        let is_cut = |edge: [u32; 2]| cut.iter().any(|own| *own == edge || [own[1], own[0]] == edge);
        let after = fans(vertex, &around, &self.triangles, is_cut);
        (after.len() > fans(vertex, &around, &self.triangles, |_| false).len()).then_some(after)
    }
}

/// Returns the triangles of each fan of `vertex`, among those `around` it, in ascending order. Fans are in the order of their
/// first triangles.
fn fans(vertex: u32, around: &[u32], triangles: &[[u32; 3]], is_cut: impl Fn([u32; 2]) -> bool) -> Vec<Vec<u32>> {
    // The fan of each triangle. Its name is the place of one of its triangles.
    let mut fan_of: Vec<usize> = (0..around.len()).collect();
    for first in 0..around.len() {
        for second in first + 1..around.len() {
            let [one, other] = [first, second].map(|place| triangles[around[place] as usize]);
            let joins = |&end: &u32| end != vertex && other.contains(&end) && !is_cut([vertex, end]);
            let [from, to] = [fan_of[second], fan_of[first]];
            if from != to && one.iter().any(joins) {
                fan_of.iter_mut().filter(|fan| **fan == from).for_each(|fan| *fan = to);
            }
        }
    }
    let mut fans: Vec<(usize, Vec<u32>)> = Vec::new();
    for (&triangle, &fan) in around.iter().zip(&fan_of) {
        match fans.iter_mut().find(|(known, _)| *known == fan) {
            Some((_, own)) => own.push(triangle),
            None => fans.push((fan, vec![triangle])),
        }
    }
    fans.into_iter().map(|(_, own)| own).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Six triangles around vertex 0.
    const WHEEL: [[u32; 3]; 6] = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5], [0, 5, 6], [0, 6, 1]];

    fn cut(around: &[u32], cut: &[u32]) -> Vec<Vec<u32>> {
        fans(0, around, &WHEEL, |[_, end]| cut.contains(&end))
    }

    #[test]
    fn an_inner_vertex_falls_apart_with_two_cuts_and_one_of_the_border_with_one() {
        let all = [0, 1, 2, 3, 4, 5];
        assert_eq!(cut(&all, &[]), [all]);
        assert_eq!(cut(&all, &[3]), [all]);
        assert_eq!(cut(&all, &[3, 6]), [vec![0, 1, 5], vec![2, 3, 4]]);
        assert_eq!(cut(&all[..3], &[]), [[0, 1, 2]]);
        assert_eq!(cut(&all[..3], &[2]), [vec![0], vec![1, 2]]);
    }

    #[test]
    fn triangles_with_the_vertex_alone_in_common_are_fans_of_their_own() {
        assert_eq!(cut(&[0, 2, 4], &[]), [[0], [2], [4]]);
    }
}
