//! Handles of meshes that come and go.

use std::fmt;

/// Names a mesh of a [`World`](crate::World). No other mesh gets the same handle, even after the mesh is removed.
///
/// A world does not recognise handles of other worlds: it may mistake one for a handle of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct MeshHandle {
    index: u32,
    generation: u32,
}

impl MeshHandle {
    /// Returns the mesh's place, counted from zero, for tables of your own. Another mesh gets the place once this one is removed.
    #[must_use]
    pub const fn index(self) -> usize {
        self.index as usize
    }

    /// Returns the handle as one number, which is never zero. [`from_bits`](Self::from_bits) is the inverse.
    #[must_use]
    pub const fn to_bits(self) -> u64 {
        // Indices end before the largest number.
        (self.generation as u64) << 32 | (self.index as u64 + 1)
    }

    /// Returns the handle for a [number](Self::to_bits), or `None` if no handle has it. A world need not have such a mesh.
    #[must_use]
    pub const fn from_bits(bits: u64) -> Option<Self> {
        match (bits as u32).checked_sub(1) {
            Some(index) => Some(Self {
                index,
                generation: (bits >> 32) as u32,
            }),
            None => None,
        }
    }
}

impl fmt::Display for MeshHandle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} (generation {})", self.index, self.generation)
    }
}

/// Items with handles, in places that are used again.
#[derive(Debug)]
pub(crate) struct Places<T> {
    places: Vec<Place<T>>,
    free: Vec<u32>,
}

#[derive(Debug)]
struct Place<T> {
    /// The generation of the present or the next item.
    generation: u32,
    item: Option<T>,
}

impl<T> Places<T> {
    pub(crate) const fn new() -> Self {
        Self {
            places: Vec::new(),
            free: Vec::new(),
        }
    }

    /// Inserts an item. Returns `None` if there is no handle left.
    pub(crate) fn insert(&mut self, item: T) -> Option<MeshHandle> {
        let index = match self.free.pop() {
            Some(index) => index,
            None => {
                let index = u32::try_from(self.places.len()).ok().filter(|&index| index < u32::MAX)?;
                self.places.push(Place {
                    generation: 0,
                    item: None,
                });
                index
            }
        };
        let place = &mut self.places[index as usize];
        place.item = Some(item);
        Some(MeshHandle {
            index,
            generation: place.generation,
        })
    }

    pub(crate) fn remove(&mut self, handle: MeshHandle) -> Option<T> {
        self.get(handle)?;
        let place = &mut self.places[handle.index()];
        // A place that has no generation left is not used again.
        if let Some(next) = place.generation.checked_add(1) {
            place.generation = next;
            self.free.push(handle.index);
        }
        place.item.take()
    }

    pub(crate) fn get(&self, handle: MeshHandle) -> Option<&T> {
        let place = self.places.get(handle.index())?;
        place.item.as_ref().filter(|_| place.generation == handle.generation)
    }

    pub(crate) fn get_mut(&mut self, handle: MeshHandle) -> Option<&mut T> {
        let place = self.places.get_mut(handle.index())?;
        place.item.as_mut().filter(|_| place.generation == handle.generation)
    }

    /// Returns all items, in ascending order of their places.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (MeshHandle, &T)> {
        (0..).zip(&self.places).filter_map(|(index, place)| {
            let generation = place.generation;
            Some((MeshHandle { index, generation }, place.item.as_ref()?))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_handle_names_one_thing_for_good() {
        let mut places = Places::new();
        let first = places.insert("first").unwrap();
        assert_eq!(places.remove(first), Some("first"));
        let second = places.insert("second").unwrap();
        assert_eq!((first.index(), second.index()), (0, 0));
        assert_eq!((places.get(first), places.get(second)), (None, Some(&"second")));
        assert_eq!(places.remove(first), None);
        assert!(places.iter().eq([(second, &"second")]));
    }

    #[test]
    fn a_handle_is_a_number_that_is_not_zero_and_back() {
        for (index, generation) in [(0, 0), (7, 1), (u32::MAX - 1, u32::MAX)] {
            let handle = MeshHandle { index, generation };
            assert_ne!(handle.to_bits(), 0);
            assert_eq!(MeshHandle::from_bits(handle.to_bits()), Some(handle));
        }
        assert_eq!(MeshHandle::from_bits(0), None);
        assert_eq!(MeshHandle::from_bits(5 << 32), None);
    }

    #[test]
    fn a_place_without_generations_left_is_not_used_again() {
        let mut places = Places::new();
        places.insert(0).unwrap();
        places.places[0].generation = u32::MAX;
        let last = places.iter().next().unwrap().0;
        assert_eq!(places.remove(last), Some(0));
        assert_eq!(places.insert(1).unwrap().index(), 1);
        assert_eq!(places.get(last), None);
    }
}
