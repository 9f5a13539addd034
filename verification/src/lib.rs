//! Exact oracle.
