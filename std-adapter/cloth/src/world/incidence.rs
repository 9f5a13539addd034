//! Incidence lists: the edges or triangles of each vertex, the triangles of each edge.

#[derive(Debug, Default)]
pub(crate) struct Incidence<T> {
    /// The start of each list, and the end of the last.
    starts: Vec<u32>,
    items: Vec<T>,
}

impl<T: Copy + Default> Incidence<T> {
    /// Collects pairs of a list and an item into `lists` lists, each in the order of the pairs.
    pub(crate) fn new<P: Iterator<Item = (u32, T)>>(lists: usize, pairs: impl Fn() -> P) -> Self {
        let mut starts = vec![0_u32; lists + 1];
        pairs().for_each(|(list, _)| starts[list as usize + 1] += 1);
        for list in 0..lists {
            starts[list + 1] += starts[list];
        }
        let mut next = starts.clone();
        let mut items = vec![T::default(); starts[lists] as usize];
        for (list, item) in pairs() {
            let place = &mut next[list as usize];
            items[*place as usize] = item;
            *place += 1;
        }
        Self { starts, items }
    }

    pub(crate) fn len(&self) -> usize {
        self.starts.len() - 1
    }

    pub(crate) fn of(&self, list: usize) -> &[T] {
        &self.items[self.range(list)]
    }

    pub(crate) fn of_mut(&mut self, list: usize) -> &mut [T] {
        let range = self.range(list);
        &mut self.items[range]
    }

    /// Returns the places of a list among all items.
    pub(crate) fn range(&self, list: usize) -> std::ops::Range<usize> {
        self.starts[list] as usize..self.starts[list + 1] as usize
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
