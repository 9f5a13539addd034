//! What counts as a contact, and which pairs are looked at.

use crate::engine::{Question, Wanted};
use crate::step::{StepError, check_length};
use selvedge_core::Scalar;
use selvedge_core::elementary::Limits;
use selvedge_core::narrowing::widened;

/// What counts as a contact. Lengths are in the unit of the positions.
///
/// ```
/// use selvedge::core::elementary::Limits;
/// use selvedge::{CollisionDetector, Criterion, Topology};
///
/// let mut detector = CollisionDetector::<f32>::new(Topology::new(3, vec![[0, 1, 2]])?);
/// // Cloth that is to stay a millimetre away from all else, in metres.
/// let limits = Limits { separation: 1e-3, ..Limits::default() };
/// detector.set_criterion(Criterion::Within(limits))?;
/// // A negative length is none.
/// let refused = detector.set_criterion(Criterion::Touching { tolerance: -1.0 });
/// assert!(refused.is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Criterion<S> {
    /// Pairs that cannot be proven to stay farther apart than the separation. Those that only come within the tolerance of it may be
    /// among them.
    Within(Limits<S>),
    /// Only pairs that truly touch, by the [exact verdict](mod@selvedge_core::elementary::contact). Their times are those of
    /// [`Within`](Self::Within) this tolerance of touching.
    Touching {
        /// How much earlier than the contact, as a distance between the two, a time may be.
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

    /// Both lengths must be finite, and not negative.
    pub(crate) fn check(&self) -> Result<(), StepError> {
        let limits = self.limits();
        check_length(limits.separation)?;
        check_length(limits.tolerance)
    }
}

impl<S: Scalar> Default for Criterion<S> {
    /// Within [`Limits::default`]: no separation.
    fn default() -> Self {
        Self::Within(Limits::default())
    }
}

/// Which boxes tell candidates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CandidateBoxes {
    /// Those at the start and at the end of the step, that are not in one order along an axis at both: relative boxes. Fewer pairs,
    /// in less time.
    #[default]
    Moving,
    /// The boxes that primitives sweep, that overlap: what other systems call candidates.
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
            limits: widened(&self.limits()),
            wanted,
            keeps_filtered: false,
            is_exact: matches!(self, Self::Touching { .. }),
        }
    }
}
