//! Tests of the laboratory's methods against the exact oracle of `selvedge-verification`, which needs GMP. GMP does not build
//! with Microsoft's compiler, so there these tests are left out.
#![cfg(not(target_env = "msvc"))]

mod arm_scene_starts_free;
mod baselines_are_no_straw_men;
mod culling_tests_never_cull_what_touches;
mod exact_answers_enclose_the_first_time;
mod pipeline_distributes_each_pair_once;
mod queries_are_read_to_the_nearest;
