//! Cloth simulation through the public interface.

mod air;
mod animated;
mod attachments;
mod bending;
mod common;
mod determinism;
mod energy;
mod far_bodies;
mod files;
mod from_code;
mod garments;
mod irregular;
mod jumps;
mod keyframes;
mod materials;
mod paying_only;
mod plastic_folds;
mod rest_shape;
mod ropes;
mod seams;
mod several_cloths;
mod stability;
mod stretch;
mod tangled;
mod tearing;
mod wrong_scenes;
