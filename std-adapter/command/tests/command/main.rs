//! Tests the `selvedge` command as its users run it: the real program, real files, and the exit status.

mod accuracy;
mod bad_input;
mod check;
mod compare;
mod cull;
mod hard_cases;
mod queries;
mod simulate;
mod support;
mod terminal;
mod walker;
