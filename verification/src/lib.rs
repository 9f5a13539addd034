//! What `selvedge-core` and `selvedge` are checked against; never published.
//!
//! [`oracle`] answers their questions exactly, from the definitions alone.

pub mod oracle;
