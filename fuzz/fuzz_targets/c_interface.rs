//! The target of this name in `selvedge_fuzz`.
#![cfg_attr(fuzzing, no_main)]
selvedge_fuzz::target!(c_interface);
