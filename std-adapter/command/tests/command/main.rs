//! Tests the `selvedge` command as its users run it: the real program, real files, and the exit status. Most cases are rows of
//! `tables/`.

mod accuracy;
mod check;
mod compare;
mod conformance;
mod cull;
mod nonsense;
mod simulate;
mod support;
mod tables;
mod terminal;
