//! Parts of core that are private to it, compiled once more from their source files, under the same path.

pub(crate) mod exact;
