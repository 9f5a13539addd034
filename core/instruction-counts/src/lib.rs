//! This crate consists of benches.
