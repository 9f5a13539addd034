//! The stiffness of contacts that are caught between a free body and something else.
//!
//! The multipliers of a contact grow by its stiffness times its depth. What is light and lies between a heavy body and something
//! else passes the load of that body on, of which its mass says nothing: a box of 10 g under one of 10 kg, or a cloth under a
//! plate. With the stiffness of what is light, the heavy body would sink in for many steps. So contacts of what is pressed from
//! two sides are at least as stiff as the inertia of the body over the number of its contacts: M/n.

use super::contact_row::ContactRow;
use super::rigid::RigidBodies;
use rustc_hash::FxHashMap;
use selvedge_core::glam::DVec3;

/// The largest number of things between a body and what carries it, through which the load is passed on.
const MOST_ROUNDS: usize = 16;

/// A vertex or a free body that contacts press.
#[derive(Clone, Copy, Debug, Default)]
struct Pressed {
    /// The inertia M of the heaviest body that it carries, in N/m, and the number of contacts.
    load: f64,
    contacts: f64,
    /// The direction in which the first contact presses.
    direction: DVec3,
    is_caught: bool,
}

/// The vertices and bodies that contacts press, by slots.
#[derive(Debug, Default)]
pub(super) struct CarriedLoads(FxHashMap<usize, Pressed>);

impl CarriedLoads {
    /// Finds what is caught by the rows that pushed in the last step, or are pressed where everything else leads.
    pub(super) fn new(rows: &[ContactRow], bodies: &RigidBodies, goal: &[DVec3]) -> Self {
        let mut pressed: FxHashMap<usize, Pressed> = FxHashMap::default();
        if bodies.is_empty() {
            return Self(pressed);
        }
        let pushing = || rows.iter().filter(|row| row.push > 0.0 || row.gap(goal) < 0.0);
        for row in pushing() {
            visit(row, bodies, &mut |slot, side| {
                let own = pressed.entry(slot).or_default();
                own.contacts += 1.0;
                let direction = row.normal * side.signum();
                if own.direction == DVec3::ZERO {
                    own.direction = direction;
                }
                own.is_caught |= own.direction.dot(direction) < 0.0;
            });
        }
        bodies.visit_inertia(&mut |slot, inertia| {
            if let Some(own) = pressed.get_mut(&slot) {
                own.load = inertia;
            }
        });
        for _ in 0..MOST_ROUNDS {
            let mut has_changed = false;
            for row in pushing() {
                let mut load = 0.0_f64;
                visit(row, bodies, &mut |slot, _| load = load.max(pressed[&slot].load));
                visit(row, bodies, &mut |slot, _| {
                    if let Some(own) = pressed.get_mut(&slot)
                        && own.is_caught
                        && own.load < load
                    {
                        own.load = load;
                        has_changed = true;
                    }
                });
            }
            if !has_changed {
                break;
            }
        }
        Self(pressed)
    }

    /// Returns the least stiffness of a row, in N/m.
    pub(super) fn least_stiffness(&self, row: &ContactRow, bodies: &RigidBodies) -> f64 {
        let mut least = 0.0_f64;
        visit(row, bodies, &mut |slot, _| {
            if let Some(own) = self.0.get(&slot).filter(|own| own.is_caught) {
                least = least.max(own.load / own.contacts);
            }
        });
        least
    }
}

/// Visits what a row presses: the slot of each vertex of cloth and of each free body, and the sign of its side.
fn visit(row: &ContactRow, bodies: &RigidBodies, visit: &mut dyn FnMut(usize, f64)) {
    { row.parts() }
        .filter(|(vertex, _)| *vertex < bodies.first_slot)
        .for_each(|(vertex, weight)| visit(vertex, weight));
    bodies.visit(row.touches, &mut |slot, side, _| visit(slot, side));
}
