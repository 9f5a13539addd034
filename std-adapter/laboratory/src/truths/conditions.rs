//! The conditions of a run: mesh, pace and accuracy.

use selvedge_cloth::Accuracy;
use std::fmt::{Display, Formatter, Result as Written};

/// How time advances in a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pace {
    /// In steps of so many seconds.
    Steps(f64),
    /// By frames of 1/60 s. The simulation chooses the steps of a frame.
    Frames,
}

/// The paces at which laws are measured.
pub const PACES: [Pace; 3] = [Pace::Steps(1e-3), Pace::Steps(4e-3), Pace::Frames];

impl Pace {
    /// The length of a frame, in seconds.
    pub(super) const FRAME: f64 = 1.0 / 60.0;

    /// Returns the time from one state that a user sees to the next, in seconds.
    #[must_use]
    pub const fn seconds(self) -> f64 {
        match self {
            Self::Steps(seconds) => seconds,
            Self::Frames => Self::FRAME,
        }
    }

    /// Returns the scene's time step, in seconds. Frames do not use it.
    pub(super) const fn time_step(self) -> f64 {
        match self {
            Self::Steps(seconds) => seconds,
            Self::Frames => 1e-3,
        }
    }
}

impl Display for Pace {
    /// Writes `1 ms` or `frames`.
    fn fmt(&self, formatter: &mut Formatter<'_>) -> Written {
        match self {
            // Rounded to a nanosecond, since 4e-3 is not exactly 4 ms.
            Self::Steps(seconds) => write!(formatter, "{} ms", (seconds * 1e9).round() / 1e6),
            Self::Frames => formatter.write_str("frames"),
        }
    }
}

/// A mesh of a law.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Grid {
    /// The number that [`Law::mesh`](super::Law::mesh) explains.
    pub number: u32,
    /// Whether the inner vertices are moved at random, so that triangles differ.
    pub is_irregular: bool,
}

impl Display for Grid {
    /// Writes `16` or `16 irregular`.
    fn fmt(&self, formatter: &mut Formatter<'_>) -> Written {
        let kind = if self.is_irregular { " irregular" } else { "" };
        write!(formatter, "{}{kind}", self.number)
    }
}

pub(super) const fn regular(number: u32) -> Grid {
    Grid {
        number,
        is_irregular: false,
    }
}

pub(super) const fn irregular(number: u32) -> Grid {
    Grid {
        number,
        is_irregular: true,
    }
}

/// The conditions of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conditions {
    /// The mesh.
    pub grid: Grid,
    /// The accuracy.
    pub accuracy: Accuracy,
    /// The pace.
    pub pace: Pace,
}
