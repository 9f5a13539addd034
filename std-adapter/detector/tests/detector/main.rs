//! The detector as its users meet it. Worlds, and what is compared with exact arithmetic, are in `verification`.

mod cut_short;
mod loose_edges_and_points;
mod python_has_the_same_bits;
