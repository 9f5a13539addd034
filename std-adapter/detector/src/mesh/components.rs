//! Connected components, by union-find.

/// Sets of connected items, such as the vertices of each component of a mesh. Items are numbered from 0, and at first each is
/// alone.
///
/// ```
/// use selvedge::Components;
///
/// let mut components = Components::new(5);
/// components.join(3, 1);
/// components.join(4, 3);
/// assert_eq!(components.first(4), 1);
/// assert_eq!(components.into_firsts(), [0, 1, 2, 1, 1]);
/// ```
#[derive(Clone, Debug, Default)]
pub struct Components {
    /// For each item, an item of its set with a smaller number, or itself if it is the first.
    parents: Vec<u32>,
}

impl Components {
    /// Makes `count` items that are not connected.
    ///
    /// # Panics
    /// Panics if there are more than a `u32` can number.
    #[must_use]
    pub fn new(count: usize) -> Self {
        let count = u32::try_from(count).expect("items have 32-bit numbers");
        Self {
            parents: (0..count).collect(),
        }
    }

    /// Joins the sets of two items.
    ///
    /// # Panics
    /// Panics if there is no such item. So do the other methods.
    pub fn join(&mut self, one: u32, other: u32) {
        let (one, other) = (self.first(one), self.first(other));
        self.parents[one.max(other) as usize] = one.min(other);
    }

    /// Returns the item with the smallest number in the set of `item`.
    #[must_use]
    pub fn first(&mut self, mut item: u32) -> u32 {
        // Path halving: each item on the way gets its grandparent as parent.
        while self.parents[item as usize] != item {
            let grandparent = self.parents[self.parents[item as usize] as usize];
            self.parents[item as usize] = grandparent;
            item = grandparent;
        }
        item
    }

    /// Returns, for each item, the item with the smallest number in its set.
    #[must_use]
    pub fn into_firsts(mut self) -> Vec<u32> {
        for item in 0..self.parents.len() {
            // A parent has a smaller number, so it has its first already.
            self.parents[item] = self.parents[self.parents[item] as usize];
        }
        self.parents
    }
}

/// Returns the components of the vertices of triangles.
pub(super) fn of_triangles(vertex_count: usize, triangles: &[[u32; 3]]) -> Components {
    let mut components = Components::new(vertex_count);
    for &[a, b, c] in triangles {
        components.join(a, b);
        components.join(b, c);
    }
    components
}
