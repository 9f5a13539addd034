//! Criteria for contacts and candidates.

use crate::engine::{Question, Wanted};
use crate::step::{StepError, check_length};
use selvedge_core::Scalar;
use selvedge_core::elementary::Limits;
use selvedge_core::narrowing::limits_in_f64;

/// Defines what counts as a contact. Lengths are in the unit of the positions.
///
/// ```
/// use selvedge::core::elementary::Limits;
/// use selvedge::{CollisionDetector, Criterion, Topology};
///
/// let mut detector = CollisionDetector::<f32>::new(Topology::new(3, vec![[0, 1, 2]])?);
/// // Cloth that stays a millimetre away from everything else, in metres.
/// let limits = Limits { separation: 1e-3, ..Limits::default() };
/// detector.set_criterion(Criterion::Within(limits))?;
/// // A negative length is refused.
/// let refused = detector.set_criterion(Criterion::Touching { tolerance: -1.0 });
/// assert!(refused.is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Criterion<S> {
    /// Reports pairs that cannot be proven to stay farther apart than the separation. Pairs that come within separation and
    /// tolerance together may be among them.
    Within(Limits<S>),
    /// Reports only pairs that truly touch, by the [exact verdict](mod@selvedge_core::elementary::contact). Times are those of
    /// [`Within`](Self::Within) with this tolerance and no separation.
    Touching {
        /// The distance between the two primitives at which a time may already count.
        tolerance: S,
    },
}

impl<S: Scalar> Criterion<S> {
    pub(crate) const fn limits(&self) -> Limits<S> {
        match *self {
            Self::Within(limits) => limits,
            Self::Touching { tolerance } => Limits {
                tolerance,
                separation: S::ZERO,
            },
        }
    }

    /// Checks that both lengths are finite and not negative.
    pub(crate) fn check(&self) -> Result<(), StepError> {
        let limits = self.limits();
        check_length(limits.separation)?;
        check_length(limits.tolerance)
    }
}

impl<S: Scalar> Default for Criterion<S> {
    /// Returns [`Within`](Self::Within) [`Limits::default`], which has no separation.
    fn default() -> Self {
        Self::Within(Limits::default())
    }
}

/// Selects the bounding boxes that generate candidates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CandidateBoxes {
    /// Boxes at the start and at the end of the step. A pair is a candidate unless its boxes have the same order along one axis
    /// at both. This gives fewer pairs, in less time.
    #[default]
    Moving,
    /// Boxes that hold the whole motion of a primitive. A pair is a candidate if its boxes overlap, as in most other systems.
    Swept,
}

impl CandidateBoxes {
    pub(super) fn are_swept(self) -> bool {
        self == Self::Swept
    }
}

impl<S: Scalar> Criterion<S> {
    pub(super) fn question(&self, wanted: Wanted) -> Question {
        Question {
            limits: limits_in_f64(&self.limits()),
            wanted,
            keeps_filtered: false,
            is_exact: matches!(self, Self::Touching { .. }),
        }
    }
}
