//! Lists of lists in one buffer.

use std::ops::Range;

/// The neighbours of each item in one buffer: the triangles of each vertex, the faces at each edge.
///
/// ```
/// use selvedge::Adjacency;
///
/// let triangles = [[0, 1, 2], [2, 1, 3]];
/// let corners = || triangles.iter().zip(0..).flat_map(|(corners, triangle)| corners.map(|vertex| (vertex, triangle)));
/// let triangles_of = Adjacency::<u32>::new(5, corners);
/// assert_eq!(triangles_of.of(1), [0, 1]);
/// assert_eq!(triangles_of.of(3), [1]);
/// assert!(triangles_of.of(4).is_empty());
/// ```
#[derive(Clone, Debug, Default)]
pub struct Adjacency<T> {
    /// The start of each list, and the end of the last.
    starts: Vec<u32>,
    items: Vec<T>,
}

impl<T: Copy + Default> Adjacency<T> {
    /// Collects pairs of a list's number and an item into `lists` lists, each in the order of the pairs. `pairs` is called twice
    /// and must return the same pairs.
    ///
    /// # Panics
    /// Panics if a list's number is not below `lists`.
    #[must_use]
    pub fn new<P: Iterator<Item = (u32, T)>>(lists: usize, pairs: impl Fn() -> P) -> Self {
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

    /// Sorts each list.
    #[must_use]
    pub(super) fn sorted(mut self) -> Self
    where
        T: Ord,
    {
        for list in 0..self.len() {
            self.of_mut(list).sort_unstable();
        }
        self
    }
}

impl<T> Adjacency<T> {
    /// Returns the number of lists.
    #[must_use]
    pub fn len(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// Returns whether there are no lists.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns one list.
    ///
    /// # Panics
    /// Panics if there is no such list. So do the other methods.
    #[inline]
    #[must_use]
    pub fn of(&self, list: usize) -> &[T] {
        &self.items[self.range(list)]
    }

    /// Returns one list, to change its items.
    #[inline]
    #[must_use]
    pub fn of_mut(&mut self, list: usize) -> &mut [T] {
        let range = self.range(list);
        &mut self.items[range]
    }

    /// Returns the places of a list in the buffer of all items.
    #[inline]
    #[must_use]
    pub fn range(&self, list: usize) -> Range<usize> {
        self.starts[list] as usize..self.starts[list + 1] as usize
    }

    /// Returns the lists in order.
    pub fn iter(&self) -> impl Iterator<Item = &[T]> {
        (0..self.len()).map(|list| self.of(list))
    }
}
