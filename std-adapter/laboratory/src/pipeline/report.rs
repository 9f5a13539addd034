//! What a step counted and how long its stages took.

use crate::methods::Stage;
use arrayvec::ArrayVec;
use selvedge::PairCounts;
use selvedge::StepStatistics;

/// One stage after the broad phase.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StageReport {
    /// Which stage.
    pub stage: Stage,
    /// The pairs that it passed on; for the elementary test, the contacts.
    pub survivors: PairCounts,
    /// Seconds, summed over threads.
    pub seconds: f64,
}

/// One step.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StepReport {
    /// Candidate triangle pairs: their swept boxes overlap. Zero for a method that has none.
    pub triangle_pairs: u64,
    /// The primitive pairs that the broad phase finds itself, for a method without triangle pairs.
    pub broad_phase_pairs: Option<PairCounts>,
    /// Seconds of the broad phase: boxes, refit or build, traversal.
    pub broad_phase_seconds: f64,
    /// The stages after it, in order, up to the elementary test.
    pub stages: ArrayVec<StageReport, 8>,
    /// Seconds of the whole step by the clock on the wall.
    pub seconds: f64,
}

impl StepReport {
    /// What our own detector counted, as the stages of a method.
    #[must_use]
    pub fn of_detector(tally: &StepStatistics) -> Self {
        let stage = |stage, survivors, seconds| StageReport {
            stage,
            survivors,
            seconds,
        };
        let stages = [
            stage(Stage::NonCoplanarity, tally.filtered, tally.filter_seconds),
            stage(Stage::Elementary, tally.contacts, tally.elementary_seconds),
        ];
        Self {
            triangle_pairs: 0,
            broad_phase_pairs: Some(tally.candidates),
            broad_phase_seconds: tally.broad_phase_seconds,
            stages: stages.into_iter().collect(),
            seconds: tally.seconds,
        }
    }

    /// The same of a caller's pairs that a broad phase has found in so many seconds.
    #[must_use]
    pub fn of_detector_after(tally: &StepStatistics, broad_phase_seconds: f64) -> Self {
        let mut report = Self::of_detector(tally);
        let boxes = StageReport {
            stage: Stage::RelativeBoxes,
            survivors: tally.candidates,
            seconds: tally.broad_phase_seconds,
        };
        report.stages.insert(0, boxes);
        Self {
            broad_phase_pairs: Some(tally.given),
            broad_phase_seconds,
            seconds: broad_phase_seconds + tally.seconds,
            ..report
        }
    }

    /// What a stage passed on, if the method has that stage.
    #[must_use]
    pub fn survivors(&self, stage: Stage) -> Option<PairCounts> {
        let report = self.stages.iter().find(|report| report.stage == stage)?;
        Some(report.survivors)
    }

    /// The pairs that reach the elementary test.
    #[must_use]
    pub fn candidates(&self) -> PairCounts {
        self.last_survivors(|stage| stage != Stage::Elementary)
    }

    /// The pairs after the last box test; where there is none, as distributed, or as the broad phase finds them.
    #[must_use]
    pub fn after_boxes(&self) -> PairCounts {
        let survivors = self.last_survivors(|stage| stage == Stage::Distribution || stage.is_box_test());
        self.broad_phase_pairs.unwrap_or(survivors)
    }

    /// The contacts found.
    #[must_use]
    pub fn contacts(&self) -> PairCounts {
        self.survivors(Stage::Elementary).unwrap_or_default()
    }

    /// Adds the counts and times of another step of the same method (of any, to a report that is still empty).
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
