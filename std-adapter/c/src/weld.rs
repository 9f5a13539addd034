//! Merges vertices in the same place.

use crate::guard::guarded;
use crate::input::{Out, OutFrame, view};
use crate::status::{Failure, Status};
use selvedge::first_coincident;
use selvedge::glam::DVec3;

/// Finds the vertices that are at most `tolerance` apart, such as the split seams of a garment; 0 finds those in the same place.
/// A chain of near vertices becomes one. `vertex_of` receives the new number of each vertex: the mesh without the others has
/// `*new_count` vertices, in the same order, each with the position of the first that was merged into it. Number triangles with
/// it, and leave out those that name a vertex twice; read positions through it to get the seams back.
///
/// # Safety
/// `positions` points to 3 * `vertex_count` numbers, `vertex_of` to room for `vertex_count` numbers, `new_count` to one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_weld(
    positions: *const f64,
    vertex_count: usize,
    tolerance: f64,
    vertex_of: *mut u32,
    new_count: *mut usize,
) -> Status {
    guarded(|| {
        // SAFETY: the caller's promises.
        let (given, room, count) = unsafe {
            let given = view::<f64, 3>("positions", positions, vertex_count)?;
            (
                given,
                OutFrame::new("vertex_of", vertex_of, vertex_count)?,
                Out::new("new_count", new_count)?,
            )
        };
        if !(0.0..f64::INFINITY).contains(&tolerance) {
            let text = format!("the tolerance is {tolerance}, but must be a distance, 0 or more");
            return Err(Failure::new(Status::BadValue, text));
        }
        if u32::try_from(vertex_count).is_err() {
            return Err(Failure::new(
                Status::BadCount,
                format!("there are {vertex_count} vertices: too many for 32-bit numbers"),
            ));
        }
        let positions: Vec<DVec3> = given.iter().map(|&point| point.into()).collect();
        let mut numbers: Vec<u32> = Vec::with_capacity(vertex_count);
        let mut merged = 0;
        for (vertex, first) in (0_u32..).zip(first_coincident(&positions, tolerance)) {
            // An earlier vertex has its number.
            numbers.push(if first == vertex { merged } else { numbers[first as usize] });
            merged += u32::from(first == vertex);
        }
        room.fill(numbers.into_iter().map(|number| [number]));
        count.set(merged as usize);
        Ok(())
    })
}
