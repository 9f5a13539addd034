//! The `selvedge` command as its users meet it: the real program, real files, exit status and all.

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
