//! Tests of the detector's public interface. Worlds, and comparisons with exact arithmetic, are in `verification`.

mod cut_short;
mod loose_edges_and_points;
mod python_has_the_same_bits;
