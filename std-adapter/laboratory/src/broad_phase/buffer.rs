//! Memory that is kept from step to step.

/// Returns half as much again as `len`.
pub(super) fn with_headroom(len: usize) -> usize {
    len + len / 2 + 1
}

/// A vector that grows and never shrinks.
///
/// When it has had to grow it takes half as much again as it needed, so that the next steps, which need
/// about as much, do not allocate.
#[derive(Debug, Default)]
pub(super) struct Buffer<T> {
    items: Vec<T>,
    /// The most that was needed since [`Self::settle`].
    needed: usize,
    has_grown: bool,
}

impl<T: Clone + Default> Buffer<T> {
    /// Makes room for `len` items.
    #[inline]
    pub(super) fn ensure(&mut self, len: usize) {
        self.needed = self.needed.max(len);
        if self.items.len() < len {
            self.items.resize(with_headroom(len), T::default());
            self.has_grown = true;
        }
    }

    /// To be called at the end of a step.
    pub(super) fn settle(&mut self) {
        if self.has_grown && self.items.len() < with_headroom(self.needed) {
            self.items.resize(with_headroom(self.needed), T::default());
        }
        self.has_grown = false;
        self.needed = 0;
    }
}

impl<T> std::ops::Deref for Buffer<T> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        &self.items
    }
}

impl<T> std::ops::DerefMut for Buffer<T> {
    fn deref_mut(&mut self) -> &mut [T] {
        &mut self.items
    }
}
