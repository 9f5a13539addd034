//! The motion of kinematic vertices in a step, and of bodies and pins that the caller moves.
//!
//! Before a step the caller may set a goal. A rigid body then rotates about its origin and moves evenly; points with goals of
//! their own move straight. If a step is cut or waits, they are on the way, and the next step starts from there.

use super::animation::Animation;
use super::keyframes::KeyframeMotion;
use super::motion::{BodyMotion, Pose};
use super::placement::Placement;
use crate::model::step::Carrier;
use selvedge_core::glam::DVec3;

#[derive(Debug)]
pub(crate) enum Kinematic {
    Keyframes(KeyframeMotion),
    Animated(Animated),
    Driven(Box<Driven>),
}

/// A known motion of each vertex.
#[derive(Debug)]
pub(crate) struct Animated {
    vertices: Vec<u32>,
    animation: Animation,
    positions: Vec<DVec3>,
}

/// A motion that the caller drives.
#[derive(Debug)]
pub(crate) struct Driven {
    pub(crate) vertices: Vec<u32>,
    /// The present placement of the points at rest; `None` after the caller moved them one by one.
    pub(crate) placement: Option<Placement>,
    goal: Option<Goal>,
    leg: Leg,
    /// The times of the clock at which the leg starts and ends.
    clock: [f64; 2],
}

#[derive(Debug)]
enum Goal {
    Placement(Placement),
    Points(Vec<DVec3>),
}

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
                // Scenes are checked earlier.
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

    pub(crate) fn pose(&self, clock: f64) -> Pose {
        match self {
            Self::Keyframes(motion) => motion.pose(clock),
            Self::Animated(animated) => Pose::deformed(animated.animation.key(clock)),
            Self::Driven(driven) => driven.pose(clock),
        }
    }

    /// Writes the positions of points with separate paths at a time of the clock.
    pub(crate) fn put(&mut self, clock: f64, positions: &mut [DVec3]) {
        match self {
            Self::Keyframes(_) => {}
            Self::Animated(animated) => animated.put(clock, positions),
            Self::Driven(driven) => driven.put(clock, positions),
        }
    }

    /// Takes over the state of another motion of the same vertices, which have new numbers.
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

/// Writes where bodies and pins are at a time of the clock. `carried` has the vertices of rigid motions as they carry them; other
/// vertices stay.
pub(crate) fn put_kinematic(
    motions: &mut [Kinematic],
    carriers: &[Carrier],
    carried: &[DVec3],
    clock: f64,
    positions: &mut [DVec3],
) {
    // The vertices of a body follow each other.
    let mut first = 0;
    for own in carriers.chunk_by(|one, other| one == other) {
        let range = first..first + own.len();
        first = range.end;
        let Some(pose) = motions.get(own[0] as usize).map(|motion| motion.pose(clock)) else {
            continue;
        };
        if pose.is_rigid() {
            for (position, &point) in positions[range.clone()].iter_mut().zip(&carried[range]) {
                *position = pose.apply(point);
            }
        }
    }
    motions.iter_mut().for_each(|motion| motion.put(clock, positions));
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

    /// Returns the leg of points that stay where they are.
    fn at_points() -> Self {
        Self::Points {
            from: Vec::new(),
            to: Vec::new(),
            then: None,
        }
    }
}

impl Driven {
    pub(crate) fn lead_to(&mut self, placement: Placement) {
        self.goal = Some(Goal::Placement(placement));
    }

    pub(crate) fn lead_points_to(&mut self, positions: Vec<DVec3>) {
        self.goal = Some(Goal::Points(positions));
    }

    /// Begins a step of `h` seconds of the clock, with all points at `positions`. `rest` are the points without any motion.
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

    /// Returns a bound on the speed in m/s of its points in the step that [began](Self::begin). `positions` are those of the
    /// points that a rigid motion moves.
    pub(crate) fn speed(&self, positions: impl Iterator<Item = DVec3>) -> f64 {
        let way = match &self.leg {
            Leg::Rigid { from, to, .. } if from == to => 0.0,
            Leg::Rigid { axis, angle, from, to } => {
                let arm = |point: DVec3| axis.cross(point - from.translation).length();
                let longest = positions.map(arm).fold(0.0, f64::max);
                from.translation.distance(to.translation) + angle.abs() * longest
            }
            Leg::Points { from, to, .. } => {
                let ways = from.iter().zip(to).map(|(from, to)| from.distance(*to));
                ways.fold(0.0, f64::max)
            }
        };
        way / (self.clock[1] - self.clock[0])
    }

    /// Drops the goal, and stays at a placement, or where the points are.
    pub(crate) fn stand(&mut self, placement: Option<Placement>) {
        self.goal = None;
        self.placement = placement;
        self.leg = placement.map_or_else(Leg::at_points, Leg::standing);
    }

    /// Returns whether points move on paths of their own in the present step.
    pub(crate) fn deforms(&self) -> bool {
        matches!(&self.leg, Leg::Points { from, to, .. } if from != to)
    }

    /// Ends the step at a time of the clock, and keeps the goal unless the body has arrived.
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

    /// Returns the progress on the leg, from 0 to 1.
    fn share(&self, clock: f64) -> f64 {
        let [from, to] = self.clock;
        if to > from {
            ((clock - from) / (to - from)).clamp(0.0, 1.0)
        } else {
            0.0
        }
    }
}
