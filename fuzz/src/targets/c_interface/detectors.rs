//! Calls on detectors.

use super::caller::{Caller, ROOM, VERTICES};
use selvedge_c::interface::*;
use std::ffi::CStr;
use std::fmt::Debug;
use std::{ptr, slice};

/// The small triangle falls through the large one.
const TRIANGLES: [u32; 6] = [0, 1, 2, 3, 4, 5];
const START: [[f64; 3]; VERTICES] = [
    [-5.0, -5.0, 0.0],
    [5.0, -5.0, 0.0],
    [0.0, 5.0, 0.0],
    [0.0, 0.0, 1.0],
    [1.0, 0.0, 1.1],
    [0.0, 1.0, 1.2],
];

/// Returns the numbers of a frame for as many vertices as the arrays have: the start or the end of the fall, with some changes.
pub(super) fn frame(caller: &mut Caller<'_>) -> [f64; 3 * ROOM] {
    let mut numbers = [0.25; 3 * ROOM];
    numbers[..3 * VERTICES].copy_from_slice(START.as_flattened());
    let falls = caller.byte();
    if falls & 1 != 0 {
        (3..VERTICES).for_each(|vertex| numbers[3 * vertex + 2] -= 2.0);
    }
    for _ in 0..falls >> 6 {
        let place = usize::from(caller.byte()) % numbers.len();
        numbers[place] = caller.number();
    }
    numbers
}

/// Returns triangles, with a change at times.
pub(super) fn triangles(caller: &mut Caller<'_>) -> [u32; 3 * ROOM] {
    let mut numbers = [0; 3 * ROOM];
    numbers[..TRIANGLES.len()].copy_from_slice(&TRIANGLES);
    if caller.byte() > 200 {
        let place = usize::from(caller.byte()) % numbers.len();
        numbers[place] = caller.whole();
    }
    numbers
}

fn pairs(caller: &mut Caller<'_>) -> [PairRow; ROOM] {
    [(); ROOM].map(|()| PairRow {
        first: caller.whole(),
        second: caller.whole(),
    })
}

/// A list that the library shows, and its entries when it was shown.
#[derive(Debug)]
struct Shown<T> {
    start: *const T,
    entries: Vec<T>,
}

impl<T: Copy + PartialEq + Debug> Shown<T> {
    /// Checks that the list has not changed.
    fn check(&self) {
        assert_eq!(
            rows(self.start, self.entries.len()),
            self.entries,
            "a call that fails changes nothing"
        );
    }
}

/// Returns the entries of a list that the library shows.
pub(super) fn rows<T: Copy>(start: *const T, count: usize) -> Vec<T> {
    assert_eq!(start.is_null(), count == 0, "an empty list is at NULL");
    if count == 0 {
        return Vec::new();
    }
    // SAFETY: the library shows so many rows until its next answer.
    unsafe { slice::from_raw_parts(start, count) }.to_vec()
}

/// Two detectors, and the last contacts of each.
pub(super) struct Detectors {
    handles: [*mut Handle; 2],
    contacts: [Option<Shown<ContactRow>>; 2],
}

impl Default for Detectors {
    fn default() -> Self {
        Self {
            handles: [ptr::null_mut(); 2],
            contacts: [None, None],
        }
    }
}

impl Detectors {
    pub(super) fn call(&mut self, caller: &mut Caller<'_>) {
        match caller.byte() % 8 {
            0 => self.make(caller),
            1 => self.set(caller),
            2 => self.filter(caller),
            3 => weld(caller),
            4 => self.ask_contacts(caller),
            5 => self.ask_others(caller),
            6 => self.ask_state(caller),
            _ => self.ask_single(caller),
        }
        self.contacts.iter().flatten().for_each(Shown::check);
    }

    pub(super) fn free(&mut self) {
        for handle in self.handles {
            assert_eq!(selvedge_detector_free(handle), Status::Ok);
            let again = if handle.is_null() {
                Status::Ok
            } else {
                Status::NoSuchDetector
            };
            assert_eq!(selvedge_detector_free(handle), again);
        }
    }

    fn make(&mut self, caller: &mut Caller<'_>) {
        let slot = usize::from(caller.byte()) % 2;
        assert_eq!(selvedge_detector_free(self.handles[slot]), Status::Ok);
        (self.handles[slot], self.contacts[slot]) = (ptr::null_mut(), None);
        let scalar = caller.one_of(&[1, 1, 1, 0, 0, 2, u32::MAX]);
        let vertex_count = match caller.count(VERTICES) {
            // So many vertices can be numbered, and no array has that many.
            ROOM => u32::MAX as usize,
            count => count,
        };
        let (triangles, triangle_count) = (triangles(caller), caller.count(2));
        let made = caller.call(ptr::null_mut(), |out, caller| {
            let at = caller.array(&triangles, triangle_count);
            // SAFETY: the array has as many entries as any count that is not refused unread.
            unsafe { selvedge_detector_new(scalar, vertex_count, at, triangle_count, caller.place(out)) }
        });
        if let Some(handle) = made {
            assert!(!handle.is_null());
            self.handles[slot] = handle;
        }
    }

    fn set(&mut self, caller: &mut Caller<'_>) {
        let handle = caller.handle(&self.handles);
        let (number, other) = (caller.number(), caller.number());
        let limit = caller.one_of(&[u64::MAX, 0, 1, 100, 1 << 40]);
        let threads = caller.one_of(&[1, 1, 1, 2, 257, usize::MAX]);
        let which = caller.byte() % 9;
        caller.call((), |_, _| match which {
            0 => selvedge_detector_set_threads(handle, threads),
            1 => selvedge_detector_set_within(handle, number, other),
            2 => selvedge_detector_set_touching(handle, number),
            3 => selvedge_detector_set_coherent(handle, limit as i32),
            4 => selvedge_detector_set_pair_limit(handle, limit),
            5 => selvedge_detector_set_memory_limit(handle, limit),
            6 => selvedge_detector_set_cancelled(handle, i32::from(limit == 1)),
            _ => Status::Ok,
        });
        if which == 7 {
            caller.call(0, |out, caller| {
                // SAFETY: there is a place for the answer.
                unsafe { selvedge_detector_threads(handle, caller.place(out)) }
            });
        }
        if which == 8 {
            let moving = [caller.byte() & 1; ROOM];
            let count = caller.count(VERTICES);
            caller.call((), |_, caller| {
                let at = caller.array(&moving, count);
                // SAFETY: the array has as many entries as any count that is not refused unread.
                unsafe { selvedge_detector_set_moving(handle, at, count) }
            });
        }
    }

    fn filter(&mut self, caller: &mut Caller<'_>) {
        let handle = caller.handle(&self.handles);
        let groups = [(); ROOM].map(|()| GroupsRow {
            memberships: caller.whole(),
            filter: caller.whole(),
        });
        let patches = [(); ROOM].map(|()| caller.whole());
        let (excluded, given) = (pairs(caller), caller.byte());
        let (count, excluded_count) = (caller.count(VERTICES), caller.short_count(2));
        caller.call((), |_, caller| {
            // NULL leaves a rule out.
            let at_groups = if given & 1 == 0 { ptr::null() } else { groups.as_ptr() };
            let at_patches = if given & 2 == 0 { ptr::null() } else { patches.as_ptr() };
            let at_excluded = caller.array(&excluded, excluded_count);
            // SAFETY: the arrays have as many entries as any count that is not refused unread.
            unsafe { selvedge_detector_set_collision_filter(handle, at_groups, at_patches, count, at_excluded, excluded_count) }
        });
        let edges = caller.call((ptr::null(), 0), |out, caller| {
            // SAFETY: there are places for the list.
            unsafe {
                let places = (caller.place(&raw mut (*out).0), caller.place(&raw mut (*out).1));
                selvedge_detector_edges(handle, places.0, places.1)
            }
        });
        edges.map(|(start, count)| rows::<PairRow>(start, count));
    }

    fn ask_contacts(&mut self, caller: &mut Caller<'_>) {
        let slot = usize::from(caller.byte()) % 2;
        let handle = self.handles[slot];
        let (start, end, count) = (frame(caller), frame(caller), caller.count(VERTICES));
        let of_pairs = caller.byte().is_multiple_of(4);
        let (vertex_face, edge_edge) = (pairs(caller), pairs(caller));
        let (vf_count, ee_count) = (caller.short_count(1), caller.short_count(1));
        let found = caller.call((ptr::null(), usize::MAX), |out, caller| {
            let (start, end) = (caller.array(&start, count), caller.array(&end, count));
            let (vf, ee) = if of_pairs {
                (caller.array(&vertex_face, vf_count), caller.array(&edge_edge, ee_count))
            } else {
                (ptr::null(), ptr::null())
            };
            // SAFETY: the arrays have as many entries as any count that is not refused unread, and there are places for the list.
            unsafe {
                let (to, rows) = (caller.place(&raw mut (*out).0), caller.place(&raw mut (*out).1));
                if of_pairs {
                    selvedge_detector_contacts_of_f64(handle, start, end, count, vf, vf_count, ee, ee_count, to, rows)
                } else {
                    selvedge_detector_contacts_f64(handle, start, end, count, to, rows)
                }
            }
        });
        if let Some((at, found)) = found {
            let entries = rows::<ContactRow>(at, found);
            assert!(entries.iter().all(|contact| (0.0..=1.0).contains(&contact.time)));
            self.contacts[slot] = Some(Shown { start: at, entries });
        }
    }

    fn ask_others(&mut self, caller: &mut Caller<'_>) {
        let handle = caller.handle(&self.handles);
        let (start, end, count) = (frame(caller), frame(caller), caller.count(VERTICES));
        let [start, end] = [caller.array::<_, f64>(&start, count), caller.array(&end, count)];
        let (which, boxes) = (caller.byte() % 5, caller.one_of(&[0, 1, 2, u32::MAX]));
        // SAFETY: the arrays have as many entries as any count that is not refused unread, and there are places for answers.
        unsafe {
            match which {
                0 => drop(caller.call((false, ContactRow::default()), |out, caller| {
                    let (found, contact) = (caller.place(&raw mut (*out).0), caller.place(&raw mut (*out).1));
                    selvedge_detector_earliest_f64(handle, start, end, count, found, contact)
                })),
                1 => drop(caller.call(false, |out, caller| {
                    selvedge_detector_is_free_f64(handle, start, end, count, caller.place(out))
                })),
                2 => drop(caller.call((ptr::null(), 7, ptr::null(), 7), |out, caller| {
                    let (vf, vf_count) = (caller.place(&raw mut (*out).0), caller.place(&raw mut (*out).1));
                    let (ee, ee_count) = (caller.place(&raw mut (*out).2), caller.place(&raw mut (*out).3));
                    selvedge_detector_candidates_f64(handle, start, end, count, boxes, vf, vf_count, ee, ee_count)
                })),
                3 => {
                    let contacts = [(); ROOM].map(|()| contact(caller));
                    let given = caller.short_count(1);
                    let found = caller.call((ptr::null(), 7), |out, caller| {
                        let at = caller.array(&contacts, given);
                        let (to, rows) = (caller.place(&raw mut (*out).0), caller.place(&raw mut (*out).1));
                        selvedge_detector_contact_geometries_f64(handle, start, end, count, at, given, to, rows)
                    });
                    if let Some((at, found)) = found {
                        assert_eq!(rows::<GeometryRow>(at, found).len(), given);
                    }
                }
                _ => {
                    let reached = [0.5_f64; 3 * ROOM];
                    let moved = caller.call((reached, TruncationRow::default()), |out, caller| {
                        let (to, truncation) = (caller.place((&raw mut (*out).0).cast()), caller.place(&raw mut (*out).1));
                        selvedge_detector_truncate_f64(handle, start, end, count, to, truncation)
                    });
                    if let Some((reached, _)) = moved {
                        assert!(reached.iter().all(|number| number.is_finite()));
                        assert!(
                            reached[3 * count..].iter().all(|&number| number == 0.5),
                            "it writes beyond the vertices"
                        );
                    }
                }
            }
        }
    }

    fn ask_state(&mut self, caller: &mut Caller<'_>) {
        let handle = caller.handle(&self.handles);
        let (positions, count, distance) = (frame(caller), caller.count(VERTICES), caller.number());
        let at = caller.array::<_, f64>(&positions, count);
        // SAFETY: the array has as many entries as any count that is not refused unread, and there are places for answers.
        unsafe {
            match caller.byte() % 3 {
                0 => {
                    let found = caller.call((ptr::null(), 7), |out, caller| {
                        let (to, rows) = (caller.place(&raw mut (*out).0), caller.place(&raw mut (*out).1));
                        selvedge_detector_intersections_f64(handle, at, count, to, rows)
                    });
                    found.map(|(at, found)| rows::<IntersectionRow>(at, found));
                }
                1 => drop(caller.call(false, |out, caller| {
                    selvedge_detector_has_intersections_f64(handle, at, count, caller.place(out))
                })),
                _ => {
                    let found = caller.call((ptr::null(), 7), |out, caller| {
                        let (to, rows) = (caller.place(&raw mut (*out).0), caller.place(&raw mut (*out).1));
                        selvedge_detector_near_f64(handle, at, count, distance, to, rows)
                    });
                    found.map(|(at, found)| rows::<GeometryRow>(at, found));
                }
            }
        }
    }

    fn ask_single(&mut self, caller: &mut Caller<'_>) {
        let handle = caller.handle(&self.handles);
        let [start, end] = [(); 2].map(|()| frame(caller).map(|number| number as f32));
        let count = caller.count(VERTICES);
        let [start, end] = [caller.array::<_, f32>(&start, count), caller.array(&end, count)];
        // SAFETY: the arrays have as many entries as any count that is not refused unread, and there are places for answers.
        unsafe {
            if caller.byte().is_multiple_of(2) {
                caller.call(false, |out, caller| {
                    selvedge_detector_is_free_f32(handle, start, end, count, caller.place(out))
                });
            } else {
                let reached = [0.5_f32; 3 * ROOM];
                caller.call((reached, TruncationRow::default()), |out, caller| {
                    let (to, truncation) = (caller.place((&raw mut (*out).0).cast()), caller.place(&raw mut (*out).1));
                    selvedge_detector_truncate_f32(handle, start, end, count, to, truncation)
                });
            }
        }
    }
}

/// Returns a contact that the mesh may not have.
pub(super) fn contact(caller: &mut Caller<'_>) -> ContactRow {
    ContactRow {
        time: caller.number(),
        kind: caller.whole() % 3,
        pair: PairRow {
            first: caller.whole(),
            second: caller.whole(),
        },
        vertices: [0; 4],
    }
}

fn weld(caller: &mut Caller<'_>) {
    let (positions, tolerance, count) = (frame(caller), caller.number(), caller.short_count(VERTICES));
    let found = caller.call(([u32::MAX; ROOM], 7_usize), |out, caller| {
        let at = caller.array(&positions, count);
        // SAFETY: the arrays have as many entries as the count, which is no larger than they are.
        unsafe {
            let (vertex_of, new_count) = (caller.place((&raw mut (*out).0).cast()), caller.place(&raw mut (*out).1));
            selvedge_weld(at, count, tolerance, vertex_of, new_count)
        }
    });
    if let Some((vertex_of, new_count)) = found {
        assert!(vertex_of[..count].iter().all(|&vertex| (vertex as usize) < new_count));
        assert!(
            vertex_of[count..].iter().all(|&vertex| vertex == u32::MAX),
            "it writes beyond the vertices"
        );
    }
}

/// A text of C, sometimes NULL, empty or not UTF-8.
pub(super) fn text(caller: &mut Caller<'_>, right: &CStr, room: &mut Vec<u8>) -> *const std::ffi::c_char {
    room.clear();
    room.extend(right.to_bytes());
    match caller.byte() {
        0..200 => {}
        200..215 => room.clear(),
        215..230 => room.insert(usize::from(caller.byte()) % (room.len() + 1), 0xff),
        230..245 => {
            let other = caller.byte().max(1);
            room.push(other);
        }
        _ => return ptr::null(),
    }
    room.push(0);
    room.as_ptr().cast()
}
