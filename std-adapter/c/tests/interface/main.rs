//! The headers, and programs in C and C++ that use them.

mod header;
#[cfg(unix)]
mod programs;
#[cfg(unix)]
#[path = "../sheet/mod.rs"]
mod sheet;
