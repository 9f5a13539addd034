//! What has which: of each vertex its edges, of each edge its triangles.

/// Lists of numbers, one after the other in one buffer.
#[derive(Debug)]
pub(super) struct Incidence {
    /// Where each list begins, and the last one ends.
    starts: Vec<u32>,
    items: Vec<u32>,
}

impl Incidence {
    /// So many lists, of `pairs`: the list that an item belongs to, and the item. Each list has its items in the order of the pairs.
    pub(super) fn new<P: Iterator<Item = (u32, u32)>>(lists: usize, pairs: impl Fn() -> P) -> Self {
        let mut starts = vec![0_u32; lists + 1];
        pairs().for_each(|(list, _)| starts[list as usize + 1] += 1);
        for list in 0..lists {
            starts[list + 1] += starts[list];
        }
        let mut next = starts.clone();
        let mut items = vec![0; starts[lists] as usize];
        for (list, item) in pairs() {
            let place = &mut next[list as usize];
            items[*place as usize] = item;
            *place += 1;
        }
        Self { starts, items }
    }

    pub(super) fn of(&self, list: u32) -> &[u32] {
        let [start, end] = [list as usize, list as usize + 1].map(|k| self.starts[k] as usize);
        &self.items[start..end]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_list_has_its_items_in_order() {
        let pairs = [(2, 7), (0, 1), (2, 3), (0, 9)];
        let incidence = Incidence::new(4, || pairs.into_iter());
        let lists: [&[u32]; 4] = [0, 1, 2, 3].map(|list| incidence.of(list));
        assert_eq!(lists, [&[1, 9][..], &[], &[7, 3], &[]]);
    }
}
