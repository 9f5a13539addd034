//! The broad phase of the published methods: finds the triangles whose swept boxes overlap.
//!
//! [`BroadPhase`] takes one box for each triangle and returns every pair of overlapping boxes once, in order. Boxes that only
//! touch overlap. Adjacent triangles are pairs like any other, since they can hold vertex–face and edge–edge pairs that no other
//! triangle pair holds.
//!
//! Triangles stand in leaves of sixteen neighbours, and leaves in a binary tree. Each step refits the boxes. Every leaf then
//! descends the tree and tests its triangles against the sixteen triangles of each leaf that it meets.
//!
//! The pairs do not depend on the number of threads. After the first step nothing is allocated, unless some list needs half as
//! much again as in any step before.
//!
//! ```
//! use selvedge_laboratory::broad_phase::{BroadPhase, SweptBox};
//!
//! let boxes = [
//!     SweptBox { lower: [0.0, 0.0, 0.0], upper: [1.0, 1.0, 1.0] },
//!     SweptBox { lower: [5.0, 0.0, 0.0], upper: [6.0, 1.0, 1.0] },
//!     SweptBox { lower: [1.0, 1.0, 1.0], upper: [2.0, 2.0, 2.0] },
//! ];
//! let mut pairs = Vec::new();
//! BroadPhase::default().overlapping_pairs(&boxes, &mut pairs);
//! assert_eq!(pairs, [[0, 2]]);
//! ```

use selvedge::parallel;
use selvedge_core::batch::LANES;

/// The box that a triangle sweeps during the step, in the caller's length unit.
///
/// Boxes that overlap must still do so after rounding. A caller with `f64` positions either rounds outwards, or maps all
/// coordinates of an axis by one monotone function.
///
/// Two boxes overlap unless, along some axis, the lower bound of one is greater than the upper bound of the other. A NaN bound
/// separates nothing. Infinite bounds compare as numbers do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SweptBox {
    /// The least coordinate along each axis.
    pub lower: [f32; 3],
    /// The greatest coordinate along each axis.
    pub upper: [f32; 3],
}

/// The lower bounds, then the negated upper bounds, so that the bounds of a union are minima. NaN becomes negative infinity,
/// which is unbounded.
type Bounds = [f32; 6];

/// The neutral element of [`union`].
const EMPTY: Bounds = [f32::INFINITY; 6];

impl SweptBox {
    fn bounds(&self) -> Bounds {
        let ([x, y, z], [u, v, w]) = (self.lower, self.upper);
        [x, y, z, -u, -v, -w].map(|bound| bound.max(f32::NEG_INFINITY))
    }

    /// Returns the middle along an axis; zero if it is not finite.
    fn middle(&self, axis: usize) -> f32 {
        let middle = 0.5 * self.lower[axis] + 0.5 * self.upper[axis];
        if middle.is_finite() { middle } else { 0.0 }
    }
}

fn union(a: &Bounds, b: &Bounds) -> Bounds {
    std::array::from_fn(|k| a[k].min(b[k]))
}

/// Returns the greatest bounds of a box that overlaps `bounds`.
fn limits(bounds: &Bounds) -> Bounds {
    let [x, y, z, u, v, w] = *bounds;
    [-u, -v, -w, -x, -y, -z]
}

/// A group of up to sixteen neighbouring triangles.
#[derive(Clone, Copy, Debug)]
struct Leaf {
    triangles: [u32; LANES],
    /// The bounds, as `bounds[k][lane]`. Unused lanes have NaN, which is within no limits.
    bounds: [[f32; LANES]; 6],
}

impl Leaf {
    fn lane(&self, lane: usize) -> Bounds {
        self.bounds.map(|row| row[lane])
    }

    /// Takes the boxes of a step, and returns their union.
    fn refit(&mut self, boxes: &[SweptBox]) -> Bounds {
        let mut all = EMPTY;
        for (lane, &triangle) in self.triangles.iter().enumerate() {
            let Some(swept) = boxes.get(triangle as usize) else { break };
            let own = swept.bounds();
            (0..6).for_each(|k| self.bounds[k][lane] = own[k]);
            all = union(&all, &own);
        }
        all
    }

    /// Returns the lanes whose box is within `limits`, as bits.
    #[inline]
    fn within(&self, limits: &Bounds) -> u32 {
        let mut mask = 0;
        for lane in 0..LANES {
            let mut is_inside = true;
            for (bounds, limit) in self.bounds.iter().zip(limits) {
                is_inside &= bounds[lane] <= *limit;
            }
            mask |= u32::from(is_inside) << lane;
        }
        mask
    }
}

/// The pairs that a run of leaves finds.
#[derive(Debug, Default)]
struct Task {
    pairs: Vec<[u32; 2]>,
    leaf_tests: u64,
}

const TASK: usize = 64;
/// The factor by which tests for each triangle and pair exceed those just after the build when the tree is built again.
const DEGRADED: f64 = 1.5;

/// Finds the pairs of triangles whose swept boxes overlap; see the [module](self).
#[derive(Debug, Default)]
pub struct BroadPhase {
    triangles: usize,
    leaves: Vec<Leaf>,
    /// The boxes of the binary tree. The children of node `k` are `2k` and `2k + 1`, the root is 1, and the leaves are the last
    /// half.
    nodes: Vec<Bounds>,
    tasks: Vec<Task>,
    /// The end of each triangle's pairs in the result.
    ends: Vec<usize>,
    /// The tests for each triangle and pair, just after the build and in the last step.
    cost: Option<[f64; 2]>,
}

impl BroadPhase {
    /// Replaces `pairs` by all pairs `[a, b]`, `a < b`, of triangles whose boxes overlap, in lexicographic order.
    ///
    /// # Panics
    /// Panics if there are `u32::MAX` boxes or more.
    pub fn overlapping_pairs(&mut self, boxes: &[SweptBox], pairs: &mut Vec<[u32; 2]>) {
        assert!(boxes.len() < u32::MAX as usize, "too many boxes");
        if boxes.len() != self.triangles || self.cost.is_some_and(|[fresh, last]| last > DEGRADED * fresh) {
            self.build(boxes);
        }
        let half = self.nodes.len() / 2;
        parallel::for_each_with_chunk(&mut self.leaves, &mut self.nodes[half..], 1, |_, leaf, bounds| {
            bounds[0] = leaf.refit(boxes);
        });
        for node in (1..half).rev() {
            self.nodes[node] = union(&self.nodes[2 * node], &self.nodes[2 * node + 1]);
        }
        let (leaves, nodes) = (&self.leaves, &self.nodes);
        parallel::for_each(&mut self.tasks, |index, task| {
            task.pairs.clear();
            task.leaf_tests = 0;
            for leaf in index * TASK..leaves.len().min((index + 1) * TASK) {
                task.meet(leaf, leaves, nodes);
            }
        });
        self.put_in_order(pairs);
        let tests: u64 = self.tasks.iter().map(|task| task.leaf_tests).sum();
        let cost = tests as f64 / (boxes.len() + pairs.len()).max(1) as f64;
        self.cost = Some([self.cost.map_or(cost, |[fresh, _]| fresh), cost]);
    }

    fn build(&mut self, boxes: &[SweptBox]) {
        let mut order: Vec<u32> = (0..boxes.len() as u32).collect();
        let leaves = boxes.len().div_ceil(LANES);
        split(&mut order, leaves, boxes);
        self.leaves.clear();
        self.leaves.extend(order.chunks(LANES).map(|own| Leaf {
            triangles: std::array::from_fn(|lane| own.get(lane).copied().unwrap_or(u32::MAX)),
            bounds: [[f32::NAN; LANES]; 6],
        }));
        self.triangles = boxes.len();
        self.nodes.clear();
        self.nodes.resize(2 * leaves.next_power_of_two(), EMPTY);
        self.tasks.resize_with(leaves.div_ceil(TASK), Task::default);
        self.cost = None;
    }

    /// Puts the pairs of all tasks in order: counts them by first triangle, then sorts each triangle's own.
    fn put_in_order(&mut self, pairs: &mut Vec<[u32; 2]>) {
        self.ends.clear();
        self.ends.resize(self.triangles, 0);
        let found = || self.tasks.iter().flat_map(|task| &task.pairs);
        found().for_each(|pair| self.ends[pair[0] as usize] += 1);
        let mut total = 0;
        for end in &mut self.ends {
            // Until the pairs are written this is where those of the triangle begin.
            total += std::mem::replace(end, total);
        }
        if pairs.capacity() < total {
            pairs.clear();
            pairs.reserve_exact(total + total / 2);
        }
        pairs.resize(total, [0; 2]);
        for &pair in self.tasks.iter().flat_map(|task| &task.pairs) {
            let end = &mut self.ends[pair[0] as usize];
            pairs[*end] = pair;
            *end += 1;
        }
        let mut begin = 0;
        for &end in &self.ends {
            pairs[begin..end].sort_unstable();
            begin = end;
        }
    }
}

/// Orders triangles so that each of `leaves` runs of sixteen lies close together, by halving along the widest axis.
fn split(order: &mut [u32], leaves: usize, boxes: &[SweptBox]) {
    if leaves < 2 {
        return;
    }
    let middle = |triangle: u32, axis: usize| boxes[triangle as usize].middle(axis);
    let width = |axis: &usize| {
        let ends = order.iter().map(|&triangle| middle(triangle, *axis));
        let (low, high) = ends.fold((f32::MAX, f32::MIN), |(low, high), x| (low.min(x), high.max(x)));
        0.5 * high - 0.5 * low
    };
    let axis = (0..3).max_by(|a, b| width(a).total_cmp(&width(b))).unwrap_or(0);
    // The first half is a power of two of leaves, as in the tree.
    let first = leaves.next_power_of_two() / 2;
    order.select_nth_unstable_by(first * LANES, |&a, &b| {
        middle(a, axis).total_cmp(&middle(b, axis)).then(a.cmp(&b))
    });
    let (left, right) = order.split_at_mut(first * LANES);
    split(left, first, boxes);
    split(right, leaves - first, boxes);
}

impl Task {
    /// Finds the pairs of a leaf's triangles with each other, and with those of all later leaves.
    fn meet(&mut self, own: usize, leaves: &[Leaf], nodes: &[Bounds]) {
        let half = nodes.len() / 2;
        let limits_of_leaf = limits(&nodes[half + own]);
        // The stack has at most one open node at each level of the tree, and one more.
        let mut open = [1_usize; 34];
        let mut count = 1;
        while count > 0 {
            count -= 1;
            let node = open[count];
            let is_apart = (0..6).any(|k| nodes[node][k] > limits_of_leaf[k]);
            if is_apart {
                continue;
            }
            if node >= half {
                // The empty box of an unused leaf overlaps unbounded boxes.
                if let Some(other) = leaves.get(node - half) {
                    self.test(&leaves[own], other, own == node - half);
                }
                continue;
            }
            for child in [2 * node + 1, 2 * node] {
                // This is the last leaf below a node.
                let height = half.ilog2() - child.ilog2();
                let last = ((child + 1) << height) - 1 - half;
                if last >= own {
                    open[count] = child;
                    count += 1;
                }
            }
        }
    }

    fn test(&mut self, own: &Leaf, other: &Leaf, is_same: bool) {
        for (lane, &triangle) in own
            .triangles
            .iter()
            .enumerate()
            .filter(|(_, triangle)| **triangle != u32::MAX)
        {
            let mut hits = other.within(&limits(&own.lane(lane)));
            if is_same {
                hits &= u32::MAX << lane << 1;
            }
            self.leaf_tests += 1;
            while hits != 0 {
                let partner = other.triangles[hits.trailing_zeros() as usize % LANES];
                self.pairs.push([triangle.min(partner), triangle.max(partner)]);
                hits &= hits - 1;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn by_definition(boxes: &[SweptBox]) -> Vec<[u32; 2]> {
        let is_apart =
            |a: &SweptBox, b: &SweptBox| (0..3).any(|axis| a.lower[axis] > b.upper[axis] || b.lower[axis] > a.upper[axis]);
        let all = 0..boxes.len();
        let pairs = all.clone().flat_map(|i| (i + 1..boxes.len()).map(move |j| [i, j]));
        let overlapping = pairs.filter(|&[i, j]| !is_apart(&boxes[i], &boxes[j]));
        overlapping.map(|pair| pair.map(|index| index as u32)).collect()
    }

    fn step(broad_phase: &mut BroadPhase, boxes: &[SweptBox]) -> Vec<[u32; 2]> {
        let mut pairs = vec![[7, 7]; 3];
        broad_phase.overlapping_pairs(boxes, &mut pairs);
        pairs
    }

    /// Generates boxes on a coarse grid, so that many are equal, touch, or have no extent along an axis.
    fn grid_box() -> impl Strategy<Value = SweptBox> {
        (prop::array::uniform3(-20i8..20), prop::array::uniform3(0i8..4)).prop_map(|(lower, extent)| SweptBox {
            lower: lower.map(f32::from),
            upper: std::array::from_fn(|axis| f32::from(lower[axis] + extent[axis])),
        })
    }

    /// Generates boxes with any bounds, in any order.
    fn lawless_box() -> impl Strategy<Value = SweptBox> {
        let special = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, f32::MIN, 0.0, -0.0];
        let bound = move || prop_oneof![any::<f32>(), prop::sample::select(special.to_vec()), -2.0f32..2.0];
        (prop::array::uniform3(bound()), prop::array::uniform3(bound())).prop_map(|(lower, upper)| SweptBox { lower, upper })
    }

    fn boxes(count: usize) -> impl Strategy<Value = Vec<SweptBox>> {
        prop_oneof![
            prop::collection::vec(grid_box(), 0..count),
            prop::collection::vec(prop_oneof![20 => grid_box(), 1 => lawless_box()], 0..count),
            prop::collection::vec(lawless_box(), 0..count.min(300)),
            (grid_box(), 0..count.min(300)).prop_map(|(swept, count)| vec![swept; count]),
        ]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn finds_the_overlapping_pairs_in_order_after_any_earlier_steps(steps in prop::collection::vec(boxes(1000), 1..5)) {
            let mut broad_phase = BroadPhase::default();
            for boxes in &steps {
                prop_assert_eq!(step(&mut broad_phase, boxes), by_definition(boxes));
            }
        }

        #[test]
        fn finds_them_after_a_refit(
            (before, after) in (1usize..600).prop_flat_map(|count| {
                let boxes = || prop::collection::vec(prop_oneof![20 => grid_box(), 1 => lawless_box()], count);
                (boxes(), boxes())
            })
        ) {
            let mut broad_phase = BroadPhase::default();
            step(&mut broad_phase, &before);
            prop_assert_eq!(step(&mut broad_phase, &after), by_definition(&after));
        }
    }

    /// Makes a square sheet of `side * side` boxes that touch their neighbours, in rows.
    fn sheet(side: usize) -> Vec<SweptBox> {
        let corner = |index: usize| [(index % side) as f32, (index / side) as f32, 0.0];
        let swept = |lower: [f32; 3]| SweptBox {
            lower,
            upper: lower.map(|x| x + 1.0),
        };
        (0..side * side).map(|index| swept(corner(index))).collect()
    }

    #[test]
    fn large_meshes_give_the_same_for_any_number_of_threads() {
        let boxes = sheet(110);
        let with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| step(&mut BroadPhase::default(), &boxes))
        };
        let one = with(1);
        assert_eq!(one.len(), 2 * 110 * 109 + 2 * 109 * 109);
        assert!(with(3) == one);
    }

    #[test]
    fn a_tree_that_has_degraded_is_built_again_and_costs_as_if_it_were_new() {
        let ordered = sheet(40);
        // The numbers 7 and 1600 have no common divisor, so this is a permutation, far from the identity.
        let mixed: Vec<_> = (0..ordered.len()).map(|index| ordered[index * 7 % ordered.len()]).collect();
        let cost = |steps: &[&[SweptBox]]| {
            let mut broad_phase = BroadPhase::default();
            steps.iter().for_each(|boxes| drop(step(&mut broad_phase, boxes)));
            broad_phase.cost.unwrap()[1]
        };
        let fresh = cost(&[&mixed]);
        assert!(cost(&[&ordered, &mixed]) > DEGRADED * fresh);
        assert_eq!(cost(&[&ordered, &mixed, &mixed]), fresh);
        assert_eq!(cost(&[ordered.as_slice(); 9]), cost(&[&ordered]));
    }
}
