//! Experiments: they run pipelines and return data. Nothing here prints or writes a file; `report` does.

#[cfg(feature = "accuracy")]
mod accuracy;
mod arm;
mod candidates;
mod comparison;
#[cfg(feature = "simulation")]
mod effects;
mod frames;
#[cfg(feature = "files")]
mod hard_cases;
#[cfg(feature = "files")]
mod queries;
mod scaling;
#[cfg(feature = "simulation")]
mod simulated;

#[cfg(all(feature = "accuracy", feature = "files"))]
pub use accuracy::elementary;
#[cfg(feature = "accuracy")]
pub use accuracy::{
    Accuracy, AccuracyOptions, AccuracyRow, AccuracySet, BackendTime, BackendsDisagree, MeasuredFilter, PairSet, measure_accuracy,
};
pub use arm::ArmFrames;
pub use candidates::{StepCandidates, busiest_step, step_candidates};
pub use comparison::{Comparison, ComparisonRow, MeanCounts, MeanStage, compare};
#[cfg(feature = "simulation")]
pub use effects::{EffectCost, effects_one_by_one};
pub use frames::{Frames, TwoFrames};
#[cfg(feature = "files")]
pub use hard_cases::{HardAnswer, HardResult, ask_hard_cases};
#[cfg(feature = "files")]
pub use queries::{Nanoseconds, QueryMethod, QueryResult, TruthCounts, UnknownMethod, measure_queries};
pub use scaling::{ScalingPoint, measure_size};
#[cfg(feature = "simulation")]
pub use simulated::SimulatedSteps;
