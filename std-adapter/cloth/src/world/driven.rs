//! What carries kinematic vertices; and bodies and pins that the caller moves, step by step.
//!
//! Before a step the caller may say where it leads: a rigid body turns about its origin and moves along evenly, points that are given
//! one by one go straight. A step that has to be cut, or to wait, leaves them on the way; the next one starts from there.

use super::animation::Animation;
use super::motion::{BodyMotion, KeyframeMotion, Pose};
use super::placement::Placement;
use selvedge_core::glam::DVec3;

/// What carries kinematic vertices.
#[derive(Debug)]
pub(crate) enum Kinematic {
    Keyframes(KeyframeMotion),
    Animated(Animated),
    Driven(Box<Driven>),
}

/// Something of which each vertex goes its own way, known ahead.
#[derive(Debug)]
pub(crate) struct Animated {
    /// Of the scene.
    vertices: Vec<u32>,
    animation: Animation,
    /// Of its vertices.
    positions: Vec<DVec3>,
}

/// Something that the caller moves.
#[derive(Debug)]
pub(crate) struct Driven {
    /// Of the scene.
    pub(crate) vertices: Vec<u32>,
    /// Where its points at rest are now; `None` when they have been moved one by one.
    pub(crate) placement: Option<Placement>,
    goal: Option<Goal>,
    leg: Leg,
    /// Of the clock, when the leg starts and when it ends.
    clock: [f64; 2],
}

/// Where the next step leads.
#[derive(Debug)]
enum Goal {
    Placement(Placement),
    /// Of each of its vertices.
    Points(Vec<DVec3>),
}

/// Its way in this step.
#[derive(Debug)]
enum Leg {
    Rigid {
        axis: DVec3,
        angle: f64,
        from: Placement,
        to: Placement,
    },
    Points {
        from: Vec<DVec3>,
        to: Vec<DVec3>,
        then: Option<Placement>,
    },
}

impl Kinematic {
    pub(crate) fn new(motion: BodyMotion, vertices: Vec<u32>) -> Self {
        match motion {
            BodyMotion::Keyframes(motion) => Self::Keyframes(motion),
            BodyMotion::Animated(animation) => Self::Animated(Animated {
                vertices,
                animation,
                positions: Vec::new(),
            }),
            BodyMotion::Driven(placement) => {
                // Scenes are checked before.
                let placement = placement.checked().unwrap_or(placement);
                Self::Driven(Box::new(Driven {
                    vertices,
                    placement: Some(placement),
                    goal: None,
                    leg: Leg::standing(placement),
                    clock: [0.0; 2],
                }))
            }
        }
    }

    /// Where it is at a time of the clock.
    pub(crate) fn pose(&self, clock: f64) -> Pose {
        match self {
            Self::Keyframes(motion) => motion.pose(clock),
            Self::Animated(animated) => Pose::deformed(animated.animation.key(clock)),
            Self::Driven(driven) => driven.pose(clock),
        }
    }

    /// Puts points that go their own ways where they are at a time of the clock.
    pub(crate) fn put(&mut self, clock: f64, positions: &mut [DVec3]) {
        match self {
            Self::Keyframes(_) => {}
            Self::Animated(animated) => animated.put(clock, positions),
            Self::Driven(driven) => driven.put(clock, positions),
        }
    }

    /// Goes on where another one is that does the same to the same vertices, which have other numbers now.
    pub(crate) fn take_over(&mut self, other: Self) {
        if let (Self::Driven(own), Self::Driven(other)) = (self, other) {
            let vertices = std::mem::take(&mut own.vertices);
            **own = Driven { vertices, ..*other };
        }
    }

    pub(crate) fn driven(&self) -> Option<&Driven> {
        match self {
            Self::Keyframes(_) | Self::Animated(_) => None,
            Self::Driven(driven) => Some(driven),
        }
    }

    pub(crate) fn driven_mut(&mut self) -> Option<&mut Driven> {
        match self {
            Self::Keyframes(_) | Self::Animated(_) => None,
            Self::Driven(driven) => Some(driven),
        }
    }
}

impl Animated {
    fn put(&mut self, clock: f64, positions: &mut [DVec3]) {
        self.animation.sample(clock, &mut self.positions);
        for (&vertex, &position) in self.vertices.iter().zip(&self.positions) {
            positions[vertex as usize] = position;
        }
    }
}

impl Leg {
    fn standing(placement: Placement) -> Self {
        Self::Rigid {
            axis: DVec3::Z,
            angle: 0.0,
            from: placement,
            to: placement,
        }
    }
}

impl Driven {
    pub(crate) fn lead_to(&mut self, placement: Placement) {
        self.goal = Some(Goal::Placement(placement));
    }

    /// One position for each of its vertices.
    pub(crate) fn lead_points_to(&mut self, positions: Vec<DVec3>) {
        self.goal = Some(Goal::Points(positions));
    }

    /// A step of `h` seconds of the clock begins, with all points at `positions`; `rest`: where they are when not moved at all.
    pub(crate) fn begin(&mut self, clock: f64, h: f64, positions: &[DVec3], rest: &[DVec3]) {
        self.clock = [clock, clock + h];
        let now = |positions: &[DVec3]| self.vertices.iter().map(|&v| positions[v as usize]).collect::<Vec<_>>();
        self.leg = match (self.goal.take(), self.placement) {
            (None, Some(placement)) => Leg::standing(placement),
            (None, None) => Leg::Points {
                from: now(positions),
                to: now(positions),
                then: None,
            },
            (Some(Goal::Placement(to)), Some(from)) => {
                let (axis, angle) = from.turn_to(&to);
                Leg::Rigid { axis, angle, from, to }
            }
            (Some(Goal::Placement(placement)), None) => Leg::Points {
                from: now(positions),
                to: now(rest).into_iter().map(|point| placement.apply(point)).collect(),
                then: Some(placement),
            },
            (Some(Goal::Points(to)), _) => Leg::Points {
                from: now(positions),
                to,
                then: None,
            },
        };
    }

    /// The step has gone on to this time of the clock, all the way or not: there it stands.
    pub(crate) fn end(&mut self, clock: f64, has_arrived: bool) {
        let share = self.share(clock);
        self.placement = match &self.leg {
            Leg::Rigid { to, .. } if has_arrived => Some(*to),
            Leg::Rigid { axis, angle, from, to } => {
                Some(from.on(*axis, share * angle, share * (to.translation - from.translation)))
            }
            Leg::Points { then, .. } if has_arrived => *then,
            Leg::Points { .. } => None,
        };
    }

    fn put(&self, clock: f64, positions: &mut [DVec3]) {
        if let Leg::Points { from, to, .. } = &self.leg {
            let share = self.share(clock);
            for ((&vertex, from), to) in self.vertices.iter().zip(from).zip(to) {
                positions[vertex as usize] = if share < 1.0 { *from + (*to - *from) * share } else { *to };
            }
        }
    }

    fn pose(&self, clock: f64) -> Pose {
        let share = self.share(clock);
        match &self.leg {
            Leg::Rigid { axis, angle, from, to } => {
                let way = to.translation - from.translation;
                Pose::standing(*from).turned_and_moved(*axis, share * angle, share * way)
            }
            Leg::Points { from, to, .. } if from == to => Pose::deformed(0.0),
            Leg::Points { .. } => Pose::deformed(share),
        }
    }

    /// Of the leg, from 0 to 1.
    fn share(&self, clock: f64) -> f64 {
        let [from, to] = self.clock;
        if to > from {
            ((clock - from) / (to - from)).clamp(0.0, 1.0)
        } else {
            0.0
        }
    }
}
