//! Checks every promise of `selvedge-core` and `selvedge` against the exact oracle, and the oracle against brute force. There is
//! a module for each promise.
//!
//! All are one program, because each program would compile the lane kernels and the oracle again. `cargo test -p
//! selvedge-verification --test promises box_tests` runs the modules whose names contain `box_tests`.

mod support;

mod batches_agree_with_one_pair;
mod box_tests_never_cull_what_touches;
mod boxes_keep_their_separation;
mod certified_in_every_floating_point_environment;
mod closest_points_are_closest;
mod coherent_motion_misses_nothing;
mod collision_detector_keeps_its_promises;
mod collision_filters_exclude_what_they_say;
mod conformance_cases_are_answered;
mod contact_geometry_is_enclosed;
mod contact_is_decided_exactly;
mod decisions_are_the_same_everywhere;
mod every_constant_of_a_bound_is_needed;
mod exact_campaign_finds_what_is_wrong;
mod exact_signs_are_those_of_rationals;
mod generator_makes_what_it_promises;
mod intersections_are_exact;
mod moving_boxes_find_what_relative_boxes_leave;
mod narrowing_rounds_to_the_safe_side;
mod oracle_collision;
mod oracle_coplanarity;
mod oracle_hard_cases;
mod oracle_mesh;
mod paths_need_not_be_straight;
mod rotating_bodies_are_not_missed;
mod separations_are_never_overstated;
mod simulation_is_free_of_intersections;
mod tiers_keep_their_promises;
mod time_of_impact_advances_only_by_proofs;
mod time_of_impact_is_never_late;
mod truncated_steps_are_free;
mod witnesses_prove_what_they_claim;
mod worlds_are_as_new_detectors;
mod worlds_refuse_invalid_input;
