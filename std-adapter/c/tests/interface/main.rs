//! What C and C++ are given: the headers, and programs that use them.

mod header;
#[cfg(unix)]
mod programs;
#[cfg(unix)]
#[path = "../sheet/mod.rs"]
mod sheet;
