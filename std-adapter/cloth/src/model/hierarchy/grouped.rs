//! Lists of items, one for each owner, in one buffer.

use std::ops::Index;

#[derive(Debug)]
pub(super) struct Grouped<T> {
    starts: Vec<u32>,
    items: Vec<T>,
}

impl<T: Copy> Grouped<T> {
    /// Collects items; each owner's items keep the order of `pairs`.
    pub(super) fn new(owners: usize, pairs: &[(u32, T)]) -> Self {
        let mut starts = vec![0_u32; owners + 1];
        pairs.iter().for_each(|(owner, _)| starts[*owner as usize + 1] += 1);
        for owner in 1..starts.len() {
            starts[owner] += starts[owner - 1];
        }
        let mut next = starts.clone();
        let mut order = vec![0; pairs.len()];
        for (k, (owner, _)) in pairs.iter().enumerate() {
            let place = &mut next[*owner as usize];
            order[*place as usize] = k;
            *place += 1;
        }
        let items = order.into_iter().map(|k| pairs[k].1).collect();
        Self { starts, items }
    }
}

impl<T> Index<u32> for Grouped<T> {
    type Output = [T];

    fn index(&self, owner: u32) -> &[T] {
        let owner = owner as usize;
        &self.items[self.starts[owner] as usize..self.starts[owner + 1] as usize]
    }
}
