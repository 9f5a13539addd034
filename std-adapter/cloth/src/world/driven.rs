//! The motion of kinematic vertices in a step, and of bodies and pins that the caller moves.
//!
//! Before a step the caller may set a goal. A rigid body then rotates about its origin and moves evenly; points with goals of
//! their own move straight. If a step is cut or waits, they are on the way, and the next step starts from there.

use super::animation::Animation;
use super::body::Body;
use super::free::Free;
use super::keyframes::KeyframeMotion;
use super::motion::{BodyMotion, Carrier, Pose};
use super::placement::Placement;
use selvedge_core::glam::DVec3;

#[derive(Debug)]
pub(crate) enum Kinematic {
    Keyframes(KeyframeMotion),
    Animated(Animated),
    Driven(Box<Driven>),
    /// A free body, which the solve moves.
    Free(Box<Free>),
}

/// The vertex of a point that no vertex follows, such as the anchor of a soft pin.
pub(crate) const NO_VERTEX: u32 = u32::MAX;

/// A known motion of each vertex.
#[derive(Debug)]
pub(crate) struct Animated {
    vertices: Vec<u32>,
    animation: Animation,
    /// The points where [`Kinematic::put`] has left them.
    positions: Vec<DVec3>,
}

/// A motion that the caller drives.
#[derive(Debug)]
pub(crate) struct Driven {
    /// The vertex of each point, or [`NO_VERTEX`].
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
    /// Makes the motion of a body.
    pub(crate) fn of_body(body: &Body, vertices: Vec<u32>) -> Self {
        match &body.motion {
            BodyMotion::Free(motion) => Self::Free(Box::new(Free::new(motion, &body.mesh))),
            motion => Self::new(motion.clone(), vertices),
        }
    }

    /// Makes the motion of pins. Scenes are checked earlier: pins do not move freely, and rest.
    pub(crate) fn new(motion: BodyMotion, vertices: Vec<u32>) -> Self {
        match motion {
            BodyMotion::Free(_) => Self::Keyframes(KeyframeMotion::resting()),
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
            Self::Free(free) => Pose::standing(free.placement()),
        }
    }

    /// Writes the positions of points with separate paths at a time of the clock.
    pub(crate) fn put(&mut self, clock: f64, positions: &mut [DVec3]) {
        match self {
            Self::Keyframes(_) | Self::Free(_) => {}
            Self::Animated(animated) => animated.put(clock, positions),
            Self::Driven(driven) => driven.put(clock, positions),
        }
    }

    /// Returns the place of a point in a pose of this motion; `None` if the motion does not say it. `index` is its place among
    /// the points on separate paths, if it is one of them, and `rest` is where it is without any motion. Points of an animation
    /// are where they were put last.
    pub(crate) fn point(&self, pose: &Pose, index: Option<u32>, rest: DVec3) -> Option<DVec3> {
        let Some(along) = pose.deformed else {
            return Some(pose.apply(rest));
        };
        let index = index? as usize;
        match self {
            Self::Keyframes(_) | Self::Free(_) => None,
            Self::Animated(animated) => animated.positions.get(index).copied(),
            Self::Driven(driven) => driven.point(along, index),
        }
    }

    /// Takes over the state of another motion of the same vertices, which have new numbers.
    pub(crate) fn take_over(&mut self, other: Self) {
        match (self, other) {
            (Self::Driven(own), Self::Driven(other)) => {
                let vertices = std::mem::take(&mut own.vertices);
                **own = Driven { vertices, ..*other };
            }
            (Self::Free(own), Self::Free(other)) => own.take_over(&other),
            _ => {}
        }
    }

    pub(crate) fn driven(&self) -> Option<&Driven> {
        match self {
            Self::Keyframes(_) | Self::Animated(_) | Self::Free(_) => None,
            Self::Driven(driven) => Some(driven),
        }
    }

    pub(crate) fn driven_mut(&mut self) -> Option<&mut Driven> {
        match self {
            Self::Keyframes(_) | Self::Animated(_) | Self::Free(_) => None,
            Self::Driven(driven) => Some(driven),
        }
    }

    pub(crate) const fn is_free(&self) -> bool {
        matches!(self, Self::Free(_))
    }

    pub(crate) fn free(&self) -> Option<&Free> {
        match self {
            Self::Free(free) => Some(free),
            Self::Keyframes(_) | Self::Animated(_) | Self::Driven(_) => None,
        }
    }

    pub(crate) fn free_mut(&mut self) -> Option<&mut Free> {
        match self {
            Self::Free(free) => Some(free),
            Self::Keyframes(_) | Self::Animated(_) | Self::Driven(_) => None,
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
        for (&vertex, &point) in self.vertices.iter().zip(&self.positions) {
            if let Some(position) = positions.get_mut(vertex as usize) {
                *position = point;
            }
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

    /// Begins a step of `h` seconds of the clock, with all vertices at `positions`. `rest` are the vertices without any motion.
    /// `anchors` are points without a vertex, by their index.
    pub(crate) fn begin(
        &mut self,
        clock: f64,
        h: f64,
        [positions, rest]: [&[DVec3]; 2],
        anchors: impl Iterator<Item = (u32, DVec3)>,
    ) {
        self.clock = [clock, clock + h];
        // Points with neither a vertex nor an anchor do not matter, and stay where `others` has them.
        let points = |all: &[DVec3], others: &[DVec3]| {
            let point = |(index, &vertex): (usize, &u32)| all.get(vertex as usize).or(others.get(index)).copied();
            let points = self.vertices.iter().enumerate();
            points.map(|of| point(of).unwrap_or_default()).collect::<Vec<_>>()
        };
        let now = |others: &[DVec3]| {
            let mut points = points(positions, others);
            anchors.for_each(|(index, place)| points[index as usize] = place);
            points
        };
        self.leg = match (self.goal.take(), self.placement) {
            (None, Some(placement)) => Leg::standing(placement),
            (None, None) => {
                let from = now(&[]);
                Leg::Points {
                    to: from.clone(),
                    from,
                    then: None,
                }
            }
            (Some(Goal::Placement(to)), Some(from)) => {
                let (axis, angle) = from.turn_to(&to);
                Leg::Rigid { axis, angle, from, to }
            }
            (Some(Goal::Placement(placement)), None) => Leg::Points {
                from: now(&[]),
                to: points(rest, &[]).into_iter().map(|point| placement.apply(point)).collect(),
                then: Some(placement),
            },
            (Some(Goal::Points(to)), _) => Leg::Points {
                from: now(&to),
                to,
                then: None,
            },
        };
    }

    /// Returns a bound on the speed in m/s of its points in the step that [began](Self::begin). `positions` are those of the
    /// points that a rigid motion moves.
    pub(crate) fn speed(&self, positions: impl Iterator<Item = DVec3>) -> f64 {
        let length = match &self.leg {
            Leg::Rigid { from, to, .. } if from == to => 0.0,
            Leg::Rigid { axis, angle, from, to } => {
                let arm = |point: DVec3| axis.cross(point - from.translation).length();
                let longest = positions.map(arm).fold(0.0, f64::max);
                from.translation.distance(to.translation) + angle.abs() * longest
            }
            Leg::Points { from, to, .. } => {
                let lengths = from.iter().zip(to).map(|(from, to)| from.distance(*to));
                lengths.fold(0.0, f64::max)
            }
        };
        length / (self.clock[1] - self.clock[0])
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
                Some(from.turned_and_moved(*axis, share * angle, share * (to.translation - from.translation)))
            }
            Leg::Points { then, .. } if has_arrived => *then,
            Leg::Points { .. } => None,
        };
    }

    fn put(&self, clock: f64, positions: &mut [DVec3]) {
        if let Leg::Points { from, to, .. } = &self.leg {
            let share = self.share(clock);
            for ((&vertex, from), to) in self.vertices.iter().zip(from).zip(to) {
                if let Some(position) = positions.get_mut(vertex as usize) {
                    *position = on_path([*from, *to], share);
                }
            }
        }
    }

    /// Returns a point at this progress on the leg; `None` if the leg does not say it.
    fn point(&self, share: f64, index: usize) -> Option<DVec3> {
        match &self.leg {
            Leg::Rigid { .. } => None,
            Leg::Points { from, to, .. } => Some(on_path([*from.get(index)?, *to.get(index)?], share)),
        }
    }

    fn pose(&self, clock: f64) -> Pose {
        let share = self.share(clock);
        match &self.leg {
            Leg::Rigid { axis, angle, from, to } => {
                let displacement = to.translation - from.translation;
                Pose::standing(*from).turned_and_moved(*axis, share * angle, share * displacement)
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

/// Returns the point at a share of the way, and exactly its end there.
fn on_path([from, to]: [DVec3; 2], share: f64) -> DVec3 {
    if share < 1.0 { from + (to - from) * share } else { to }
}
