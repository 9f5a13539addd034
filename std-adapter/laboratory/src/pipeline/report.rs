//! Counts and times of a step and its stages.

use crate::methods::Stage;
use arrayvec::ArrayVec;
use selvedge::PairCounts;
use selvedge::StepStatistics;

/// One stage after the broad phase.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StageReport {
    /// The stage.
    pub stage: Stage,
    /// The pairs that it passes on; for the elementary test, the contacts.
    pub survivors: PairCounts,
    /// The seconds, summed over threads.
    pub seconds: f64,
}

impl StageReport {
    /// Returns a stage without counts.
    pub(super) fn empty(stage: Stage) -> Self {
        Self {
            stage,
            survivors: PairCounts::default(),
            seconds: 0.0,
        }
    }
}

/// One step.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StepReport {
    /// The number of candidate triangle pairs, whose swept boxes overlap. It is zero for a method without them.
    pub triangle_pairs: u64,
    /// The primitive pairs that the broad phase finds itself, for a method without triangle pairs.
    pub broad_phase_pairs: Option<PairCounts>,
    /// The seconds of the broad phase: boxes, refit or build, traversal.
    pub broad_phase_seconds: f64,
    /// The stages after the broad phase, in order, up to the elementary test.
    pub stages: ArrayVec<StageReport, 8>,
    /// The wall-clock seconds of the whole step.
    pub seconds: f64,
}

impl StepReport {
    /// Converts the counts of our own detector to the stages of a method.
    pub fn from_detector(counts: &StepStatistics) -> Self {
        let stage = |stage, survivors, seconds| StageReport {
            stage,
            survivors,
            seconds,
        };
        let stages = [
            stage(Stage::NonCoplanarity, counts.filtered, counts.filter_seconds),
            stage(Stage::Elementary, counts.contacts, counts.elementary_seconds),
        ];
        Self {
            triangle_pairs: 0,
            broad_phase_pairs: Some(counts.candidates),
            broad_phase_seconds: counts.broad_phase_seconds,
            stages: stages.into_iter().collect(),
            seconds: counts.seconds,
        }
    }

    /// Converts the counts for a caller's pairs, which a broad phase has found in this many seconds.
    pub fn from_given_pairs(counts: &StepStatistics, broad_phase_seconds: f64) -> Self {
        let mut report = Self::from_detector(counts);
        let boxes = StageReport {
            stage: Stage::RelativeBoxes,
            survivors: counts.candidates,
            seconds: counts.broad_phase_seconds,
        };
        report.stages.insert(0, boxes);
        Self {
            broad_phase_pairs: Some(counts.given),
            broad_phase_seconds,
            seconds: broad_phase_seconds + counts.seconds,
            ..report
        }
    }

    /// Returns the pairs that a stage passed on, if the method has that stage.
    pub fn survivors(&self, stage: Stage) -> Option<PairCounts> {
        let report = self.stages.iter().find(|report| report.stage == stage)?;
        Some(report.survivors)
    }

    /// Returns the pairs that reach the elementary test.
    pub fn candidates(&self) -> PairCounts {
        self.last_survivors(|stage| stage != Stage::Elementary)
    }

    /// Returns the pairs after the last box test. Without one, these are the pairs as distributed, or as the broad phase finds
    /// them.
    pub fn after_boxes(&self) -> PairCounts {
        let survivors = self.last_survivors(|stage| stage == Stage::Distribution || stage.is_box_test());
        self.broad_phase_pairs.unwrap_or(survivors)
    }

    /// Returns the contacts.
    pub fn contacts(&self) -> PairCounts {
        self.survivors(Stage::Elementary).unwrap_or_default()
    }

    /// Adds the counts and times of another step of the same method. An empty report takes those of any method.
    pub fn add(&mut self, other: &Self) {
        if self.stages.is_empty() {
            self.stages.clone_from(&other.stages);
        } else {
            for (stage, other) in self.stages.iter_mut().zip(&other.stages) {
                stage.survivors += other.survivors;
                stage.seconds += other.seconds;
            }
        }
        self.triangle_pairs += other.triangle_pairs;
        if let Some(pairs) = other.broad_phase_pairs {
            *self.broad_phase_pairs.get_or_insert_default() += pairs;
        }
        self.broad_phase_seconds += other.broad_phase_seconds;
        self.seconds += other.seconds;
    }

    fn last_survivors(&self, wanted: impl Fn(Stage) -> bool) -> PairCounts {
        let last = self.stages.iter().rfind(|report| wanted(report.stage));
        last.map(|report| report.survivors).unwrap_or_default()
    }
}
