//! The forces of a solve on bodies, pins and attachments, as its last residual had them.
//!
//! A multiplier alone is one Newton step old. The residual that ended the solve had λ − κC, and this balances the other forces at
//! the same positions. So the sum of these forces is the change of the cloth's momentum, up to what the solve left.

use super::Solve;
use super::contact_row::ContactRow;
use selvedge_core::glam::DVec3;

/// The group to which a spring belongs.
#[derive(Clone, Copy, Debug)]
pub(crate) enum SpringGroup {
    Attachments(usize),
    /// A group of pins, which are soft.
    Pins(usize),
}

/// The pull of a spring on what holds it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pull {
    pub(crate) group: SpringGroup,
    /// A vertex of the body that holds the spring; `None` for something else.
    pub(crate) body: Option<u32>,
    /// The place of the anchor, and the force on it, in N.
    pub(crate) anchor: DVec3,
    pub(crate) force: DVec3,
}

impl Solve {
    /// Visits the contacts with bodies that push, in their order, with the push and the friction on their first side, in N. `x`
    /// is where the solve of `h` seconds has ended.
    pub(crate) fn visit_pushes(&self, h: f64, x: &[DVec3], visit: &mut dyn FnMut(&ContactRow, [DVec3; 2])) {
        for row in self.rows.iter().filter(|row| row.is_with_body) {
            if let Some(forces) = row.push_and_grip(h, x) {
                visit(row, forces);
            }
        }
    }

    /// Visits the springs that hold the cloth, in their order.
    pub(crate) fn visit_pulls(&self, x: &[DVec3], visit: &mut dyn FnMut(Pull)) {
        self.terms.iter().for_each(|entry| entry.action.visit_pulls(x, visit));
    }

    /// Returns the sum of the forces that the solve left, in N: free vertices move as if it acted on them, too.
    pub(crate) fn left(&self, inverse_masses: &[f64]) -> DVec3 {
        let each = self.work.linear.gradient.iter().zip(inverse_masses);
        { each }.filter(|(_, inverse)| **inverse > 0.0).map(|(whole, _)| *whole).sum()
    }

    /// Returns the force of all terms and contacts on a pinned vertex, in N.
    pub(crate) fn force_on_pinned(&self, vertex: usize) -> DVec3 {
        -self.work.linear.gradient[vertex]
    }
}
