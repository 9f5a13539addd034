//! The constants of the solve, each with its meaning and the law that pins it. None depends on a scene.

/// The accuracy of a simulation: one tolerance of the solve in each step.
///
/// It is the error that a step may leave, as a share of what it changes, in the norm of the energy. All three come to the same
/// rest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Accuracy {
    /// A fiftieth, in steps of first order, which damp fast motion.
    #[default]
    Game,
    /// A hundredth, in steps of second order: cloth swings on, and long steps show the motion of short ones.
    Film,
    /// Two thousandths, for measurements of forces and motion.
    Exact,
}

crate::identify!(enum Accuracy { 0 => Game, 1 => Film, 2 => Exact });

impl Accuracy {
    /// All accuracies, from the fastest to the most accurate.
    pub const ALL: [Self; 3] = [Self::Game, Self::Film, Self::Exact];

    /// Returns the name in scene files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Game => "game",
            Self::Film => "film",
            Self::Exact => "exact",
        }
    }

    /// Returns the error that a solve may leave, as a share of what it changes.
    ///
    /// What a solve leaves of a slow motion comes late. A force that lags by the share ε feeds a swing of the frequency ω by
    /// about ε(ωh)² a step. Steps of first order damp it by ½(ωh)², so they are stable for any ε below a half. Their friction
    /// needs a smaller one: the law of the capstan pins it. Steps of second order damp it by ¼(ωh)⁴, so they need a small ε: the
    /// law of the cantilever pins it.
    pub(super) const fn share(self) -> f64 {
        match self {
            Self::Game => 0.02,
            Self::Film => 0.01,
            Self::Exact => 0.002,
        }
    }

    /// Returns whether steps are of second order, where nothing presses.
    #[must_use]
    pub const fn is_of_second_order(self) -> bool {
        !matches!(self, Self::Game)
    }

    /// Returns the largest change of a contact's depth that needs no other Newton step, as a share of the thickness.
    pub(super) const fn largest_change(self) -> f64 {
        match self {
            Self::Game => 0.02,
            Self::Film => 0.01,
            Self::Exact => 0.002,
        }
    }
}

/// The largest number of Newton steps of a solve. Nearly all solves end by their tolerance, after two to five. Multipliers are
/// kept, so that the next step of time goes on with what is not finished. The law of the bag's speed pins the number: with 6 the
/// bag trembled by 22 mm/s at 4 ms, with 12 and 40 by less than 1 mm/s. Crushed cloth takes all steps that it may.
pub(super) const MOST_NEWTON_STEPS: u32 = 12;
/// The largest number of iterations of conjugate gradients in one Newton step.
pub(super) const MOST_ITERATIONS: usize = 1000;
/// The largest number of linear problems in one Newton step, between which contacts join in and drop out. The line search sees
/// to the rest. Where cloth buckles on a body, 122 of 491 solves were not converged after the most Newton steps with one linear
/// problem, 86 with two, 32 with four, 7 with nine; the time is the same from four on.
pub(super) const MOST_ROUNDS: u32 = 4;
/// The share of the energy that may remain of contacts that the linear problem has wrong. With 1, stacks of two layers
/// rested 2,000 times less accurately, at the same cost: stack laws.
pub(super) const NEGLIGIBLE: f64 = 0.01;
/// The share, in the norm of the energy, of what a Newton step mends that it may leave to the next one, which has another matrix.
/// Smaller values need more iterations, larger ones more Newton steps: 0.05 takes as long. The law of the inclined plane pins it:
/// with 0.05 friction was off by 5e-4 of the path, with 0.02 by 1e-4.
pub(super) const LINEAR_SHARE: f64 = 0.02;
/// The largest number of halvings of a Newton step. Slack foil may fly ten thousand times too far.
pub(super) const MOST_HALVINGS: usize = 16;
/// An error of velocity that does not matter, in m/s: a thousandth of a millimetre in half a second. Pinned by the speed of
/// layers at rest.
pub(super) const STILL: f64 = 2e-6;
/// A speed that is hardly visible, in m/s. What changes by less is solved more accurately, since the error of many layers that
/// rest on each other would keep them in motion: the speed of ten layers.
pub(super) const QUIET: f64 = 1e-3;
/// The largest energy that a solve may leave, over that of its motion and over the square of the accuracy. At the first guess, a
/// cloth that swings is too long, by the square of its turn. In stiff cloth that is much energy, and a share of it would make
/// the cloth tremble for ever. With 4 instead of 16, the solves of random sheets take a seventh more iterations, and no less
/// energy comes in: law of the swinging sheet.
pub(super) const BESIDE_MOTION: f64 = 16.0;
/// The ratio of the square of the remaining force to that of the linear problem below which another Newton step gains little.
pub(super) const NEARLY_LINEAR: f64 = 4.0;

/// The stiffness of a contact with a body, beside that of its vertices. Larger values need fewer Newton steps and more
/// iterations. The result does not depend on it.
pub(super) const STIFFER_THAN_BODIES: f64 = 5.0;
/// The same for contacts of cloth. Layers pass a load on from one to the next, which takes stiffer contacts: stack laws.
pub(super) const STIFFER_THAN_CLOTH: f64 = 20.0;
/// The same for strain limits, stitches and ties.
pub(super) const STIFFER_THAN_LIMITS: f64 = 3.0;
/// The depth to which the load of the last step may press a contact within a solve, as a share of its thickness. What has come
/// nearer has no room, and does not rest there: law of the pinched cloth.
pub(super) const GIVE: f64 = 0.05;

/// The change of a contact's depth that needs no other Newton step, as a share of the largest move in the step.
pub(super) const SMALL_CHANGE: f64 = 0.05;
/// The change that never needs another Newton step, as a speed in m/s. It is what layers at rest may keep: stack laws.
pub(super) const SLOWEST_CHANGE: f64 = 5e-4;
/// The change of a limited stretch that needs no other Newton step.
pub(super) const LIMIT_CHANGE: f64 = 5e-3;

/// The rate at which contacts that start too near come apart, in 1/s. A layer that was pressed has its height again in a tenth of
/// a second.
pub(crate) const RECOVERY: f64 = 50.0;

/// The largest stiffness of a rope's edge, as a multiple of the mass of its lighter end over h². Single precision resolves its
/// mass beside it. A rope of 1,000 vertices stretches by less than a micrometre at 4 ms by its weight.
pub(super) const STIFFEST: f64 = 1e6;
