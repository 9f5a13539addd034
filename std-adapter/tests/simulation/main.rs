//! Cloth simulation as a library's user meets it.

mod wrong_scenes;
