//! Experiments: they run pipelines and return data. Nothing here prints or writes a file; `report` does.

mod arm;
mod comparison;
mod frames;
mod scaling;

pub use arm::ArmFrames;
pub use comparison::{Comparison, ComparisonRow, MeanCounts, MeanStage, compare};
pub use frames::{Frames, TwoFrames};
pub use scaling::{ScalingPoint, measure_size};
