//! Built-in scenes: meshes with a motion.

mod arm;

pub use arm::ArmScene;
