//! Built-in scenes: meshes with a motion.

mod arm;
mod walker;

pub use arm::ArmScene;
pub use walker::{Bone, Walker};
