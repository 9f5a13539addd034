//! Groups of constraints: by position, and by colour.

use selvedge_core::glam::DVec3;
use std::ops::Range;

/// The largest number of constraints in one of many blocks. Its vertices, positions and constraints take some 30 kB.
const MOST: usize = 256;

/// Splits constraints in two by position, repeatedly, until each group fits into a block.
pub(super) fn in_groups(order: &mut [u32], centres: &[DVec3], groups: &mut Vec<Vec<u32>>) {
    if order.len() <= MOST {
        groups.push(order.to_vec());
        return;
    }
    let points = || order.iter().map(|&k| centres[k as usize]);
    let lower = points().fold(DVec3::INFINITY, DVec3::min);
    let upper = points().fold(DVec3::NEG_INFINITY, DVec3::max);
    let axis = (upper - lower).max_position();
    let middle = order.len() / 2;
    order.select_nth_unstable_by(middle, |&a, &b| {
        let [x, y] = [a, b].map(|k| centres[k as usize][axis]);
        x.total_cmp(&y).then(a.cmp(&b))
    });
    let (first, second) = order.split_at_mut(middle);
    in_groups(first, centres, groups);
    in_groups(second, centres, groups);
}

/// Sorts items so that those of one colour, which share no vertex, are contiguous. Returns the range of each colour.
///
/// The colouring is greedy: each item takes the first colour that no earlier item has at any of its vertices. If a vertex has
/// more neighbours than there are colours, the item gets a colour of its own.
pub(super) fn sort_by_colour<T>(items: &mut Vec<T>, vertices: impl Fn(&T) -> &[u32], vertex_count: usize) -> Vec<Range<usize>> {
    let mut taken = vec![0_u128; vertex_count];
    let colour_of = |(k, item): (usize, &T)| {
        let all = vertices(item).iter().map(|&v| taken[v as usize]);
        let colour = all.fold(0, |all, own| all | own).trailing_ones();
        let bit = 1_u128.checked_shl(colour).unwrap_or(0);
        vertices(item).iter().for_each(|&v| taken[v as usize] |= bit);
        (colour, k)
    };
    let mut by_colour: Vec<(u32, usize)> = items.iter().enumerate().map(colour_of).collect();
    // Places are sorted and not items, whose types would each add the code of a sort to the program.
    by_colour.sort_unstable();
    let mut end = 0;
    let colours = by_colour.chunk_by(|a, b| a.0 == b.0 && a.0 < u128::BITS).map(|group| {
        let begin = end;
        end += group.len();
        begin..end
    });
    let colours = colours.collect();
    let mut all: Vec<Option<T>> = items.drain(..).map(Some).collect();
    items.extend(by_colour.into_iter().filter_map(|(_, k)| all[k].take()));
    colours
}
