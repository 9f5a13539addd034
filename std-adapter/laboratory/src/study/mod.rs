//! Experiments. They run pipelines and return data; `report` prints and writes it.

mod accuracy;
mod arm;
mod candidates;
mod comparison;
mod effects;
mod frames;
mod hard_cases;
mod queries;
mod scaling;
mod simulated;

pub use accuracy::elementary;
pub use accuracy::{
    AccuracyOptions, AccuracyRow, AccuracySet, BackendTime, BackendsDisagree, FilterAccuracy, PairSet, measure_accuracy,
};
pub use arm::ArmFrames;
pub use candidates::{StepCandidates, busiest_step, step_candidates};
pub use comparison::{Comparison, ComparisonRow, MeanCounts, MeanStage, compare};
pub use effects::{EffectCost, effects_one_by_one};
pub use frames::{Frames, TwoFrames};
pub use hard_cases::{HardAnswer, HardResult, ask_hard_cases};
pub use queries::{Nanoseconds, QueryResult, TruthCounts, measure_queries};
pub use scaling::{ScalingPoint, measure_size};
pub use simulated::SimulatedSteps;
