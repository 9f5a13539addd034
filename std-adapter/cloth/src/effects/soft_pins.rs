//! Soft pins: springs between vertices and the places where hard pins would hold them.
//!
//! The anchor moves as a vertex with a hard pin does. The step is [solved](crate::solve::springs) with the springs in it.

use super::selection::PinMotion;
use crate::effects::plan::Plan;
use crate::model::step::{Carrier, Memory, MovedAnchor, TimeStep};
use crate::solve::SpringGroup;
use crate::solve::springs::{Spring, Springs};
use crate::world::BodyMotion;
use selvedge_core::glam::DVec3;

/// The soft pins of a group, whose motion is in the plan.
pub(super) struct OfGroup<'a> {
    pub(super) group: usize,
    pub(super) motion: &'a PinMotion,
    pub(super) carrier: Carrier,
    /// The place of each vertex in its group, the vertex, as the scene numbers it now, and the stiffness, in N/m.
    pub(super) pins: Vec<(u32, u32, f64)>,
}

#[derive(Debug)]
struct SoftPin {
    group: usize,
    anchor: MovedAnchor,
    /// The stiffness, in N/m.
    stiffness: f64,
    mover: Mover,
}

#[derive(Clone, Copy, Debug)]
enum Mover {
    /// A body, by one of its vertices.
    Body(u32),
    Caller,
    /// Keyframes or an animation.
    Keys,
}

/// The soft pins of all groups.
#[derive(Debug, Default)]
pub(super) struct SoftPins(Vec<SoftPin>);

impl SoftPins {
    /// Adds the soft pins of a group.
    pub(super) fn add(&mut self, soft: OfGroup<'_>, plan: &mut Plan<'_>) {
        let OfGroup {
            group,
            motion,
            carrier,
            pins,
        } = soft;
        if pins.is_empty() {
            return;
        }
        let start = plan.start();
        let mover = match motion {
            &PinMotion::Body(body) => Mover::Body(plan.first_vertex_of(body)),
            PinMotion::Own(BodyMotion::Driven(_)) => Mover::Caller,
            PinMotion::Own(_) => Mover::Keys,
        };
        let motion = &mut plan.motions[carrier as usize];
        // Only samples an animation, whose vertices are not put anywhere yet.
        motion.put(0.0, &mut []);
        let pose = motion.pose(0.0);
        // A driven body starts at a placement, and takes the cloth from where it is.
        let standing = motion.driven().and_then(|driven| driven.placement);
        let standing = standing.filter(|_| matches!(mover, Mover::Body(_)));
        for (index, vertex, stiffness) in pins {
            let own = start[vertex as usize];
            let rest = standing.map_or(own, |standing| standing.apply_inverse(own));
            let index = (!matches!(mover, Mover::Body(_))).then_some(index);
            let place = motion.point(&pose, index, rest).unwrap_or(own);
            let anchor = MovedAnchor {
                vertex,
                carrier,
                index,
                rest,
                place,
            };
            self.0.push(SoftPin {
                group,
                anchor,
                stiffness,
                mover,
            });
        }
    }

    pub(super) const fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl SoftPin {
    fn spring(&self, anchor: DVec3) -> Spring {
        Spring {
            vertex: self.anchor.vertex,
            anchor,
            stiffness: self.stiffness,
            group: SpringGroup::Pins(self.group),
            body: match self.mover {
                Mover::Body(vertex) => Some(vertex),
                Mover::Caller | Mover::Keys => None,
            },
        }
    }
}

impl Springs for SoftPins {
    fn springs(&self, step: &TimeStep<'_>, _: &[DVec3], springs: &mut Vec<Spring>) {
        springs.extend(self.0.iter().map(|pin| pin.spring(pin.anchor.end_position(step))));
    }

    fn settled(&self) -> Vec<Spring> {
        self.0.iter().map(|pin| pin.spring(pin.anchor.place)).collect()
    }
}

impl Memory for SoftPins {
    fn settle(&mut self, step: &TimeStep<'_>, _: &[DVec3]) {
        for SoftPin { anchor, .. } in &mut self.0 {
            anchor.place = anchor.end_position(step);
        }
    }

    /// Returns the places of the anchors.
    fn numbers(&self) -> Vec<f64> {
        self.0.iter().flat_map(|pin| pin.anchor.place.to_array()).collect()
    }

    fn recall(&mut self, numbers: &[f64]) {
        for (pin, place) in self.0.iter_mut().zip(numbers.as_chunks().0) {
            pin.anchor.place = DVec3::from_array(*place);
        }
    }

    /// Leaves out what the caller moves, which is where the caller wants it.
    fn held_by(&self) -> Vec<(u32, Option<u32>)> {
        let held = |pin: &SoftPin| match pin.mover {
            Mover::Body(on) => Some((pin.anchor.vertex, Some(on))),
            Mover::Keys => Some((pin.anchor.vertex, None)),
            Mover::Caller => None,
        };
        self.0.iter().filter_map(held).collect()
    }

    fn anchors(&self) -> Vec<MovedAnchor> {
        self.0.iter().map(|pin| pin.anchor).collect()
    }

    fn teleport(&mut self, is_moved: &[bool], to: &dyn Fn(DVec3) -> DVec3) {
        for pin in self.0.iter_mut().filter(|pin| is_moved[pin.anchor.vertex as usize]) {
            pin.anchor.place = to(pin.anchor.place);
        }
    }
}
