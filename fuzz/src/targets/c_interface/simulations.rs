//! Calls on simulations and mesh files.

use super::caller::{Caller, ROOM};
use super::detectors::{rows, text};
use selvedge_c::interface::*;
use std::ffi::CStr;
use std::ptr;

/// The scene of the tests of messages, with self-collision.
const SCENE: &CStr = {
    let text = concat!(
        include_str!("../../../../std-adapter/c/tests/messages/scene.toml"),
        "\n[effects.self_collision]\nthickness = 0.005\n\0"
    );
    match CStr::from_bytes_with_nul(text.as_bytes()) {
        Ok(text) => text,
        Err(_) => panic!("a zero in the scene"),
    }
};
/// The room for the vertices and triangles of the scene, each with three numbers.
const LARGE: usize = 128;

/// A simulation, and the room of its caller.
pub(super) struct Simulations {
    handle: *mut SimulationHandle,
    sizes: SizesRow,
}

impl Default for Simulations {
    fn default() -> Self {
        Self {
            handle: ptr::null_mut(),
            sizes: SizesRow::default(),
        }
    }
}

/// Returns numbers about the place of the pins and the ball.
fn numbers(caller: &mut Caller<'_>) -> [f64; 3 * LARGE] {
    let mut numbers = [0.05; 3 * LARGE];
    for _ in 0..caller.byte() % 4 {
        let place = usize::from(caller.byte()) % numbers.len();
        numbers[place] = caller.number();
    }
    numbers
}

fn pose(caller: &mut Caller<'_>) -> [PoseRow; 1] {
    let scale = caller.one_of(&[1.0, 1e-3, 1e-3, 1e3]);
    [PoseRow {
        rotation: match caller.byte() {
            0..128 => [0.0, 0.0, 0.0, 1.0],
            _ => [(); 4].map(|()| caller.number()),
        },
        origin: [(); 3].map(|()| scale * caller.number()),
    }]
}

impl Simulations {
    pub(super) fn call(&mut self, caller: &mut Caller<'_>) {
        match caller.byte() % 8 {
            0 => self.make(caller),
            1 => self.run(caller),
            2 => self.copy(caller),
            3 => self.lead(caller),
            4 => self.teleport(caller),
            5 => self.find(caller),
            6 => self.checkpoint(caller),
            _ => read_file(caller),
        }
    }

    pub(super) fn free(&mut self) {
        assert_eq!(selvedge_simulation_free(self.handle), Status::Ok);
        let again = if self.handle.is_null() {
            Status::Ok
        } else {
            Status::NoSuchSimulation
        };
        assert_eq!(selvedge_simulation_free(self.handle), again);
    }

    fn make(&mut self, caller: &mut Caller<'_>) {
        assert_eq!(selvedge_simulation_free(self.handle), Status::Ok);
        *self = Self::default();
        let (mut scene, mut folder) = (Vec::new(), Vec::new());
        let (scene, folder) = (text(caller, SCENE, &mut scene), text(caller, c"no-such-folder", &mut folder));
        let threads = caller.one_of(&[1, 1, 1, 2, 257, usize::MAX]);
        let reads = caller.byte() == 255;
        let made = caller.call(ptr::null_mut(), |out, caller| {
            let place = caller.place(out);
            // SAFETY: texts end with a zero, and there is a place for the handle.
            unsafe {
                if reads {
                    selvedge_simulation_read(folder, threads, place)
                } else {
                    selvedge_simulation_new(scene, folder, threads, place)
                }
            }
        });
        let Some(handle) = made else {
            return;
        };
        self.handle = handle;
        // SAFETY: there is one entry.
        let status = unsafe { selvedge_simulation_sizes(handle, &raw mut self.sizes) };
        assert_eq!(status, Status::Ok);
        assert!(self.sizes.vertex_count <= LARGE && self.sizes.triangle_count <= LARGE);
    }

    fn run(&mut self, caller: &mut Caller<'_>) {
        let handle = caller.handle(&[self.handle]);
        if caller.byte().is_multiple_of(2) {
            caller.call((), |_, _| selvedge_simulation_step(handle));
        } else {
            let (seconds, most) = (caller.number() / 256.0, caller.one_of(&[1, 2, 4, 0]));
            caller.call(FrameRow::default(), |out, caller| {
                let place = if caller.byte() < 128 {
                    ptr::null_mut()
                } else {
                    caller.place(out)
                };
                // SAFETY: there is one entry, or none.
                unsafe { selvedge_simulation_advance(handle, seconds, most, place) }
            });
        }
        let mut positions = [[f64::NAN; 3]; LARGE];
        let count = self.sizes.vertex_count;
        if !self.handle.is_null() {
            // SAFETY: there is room for the vertices.
            let status = unsafe { selvedge_simulation_positions(self.handle, positions.as_mut_ptr().cast(), count) };
            assert_eq!(status, Status::Ok);
            assert!(positions[..count].as_flattened().iter().all(|number| number.is_finite()));
        }
    }

    fn copy(&mut self, caller: &mut Caller<'_>) {
        let handle = caller.handle(&[self.handle]);
        let (which, is_exact) = (caller.byte() % 6, caller.byte() < 200);
        let right = [
            self.sizes.vertex_count,
            self.sizes.triangle_count,
            self.sizes.loose_edge_count,
        ];
        let right = right[usize::from(which).saturating_sub(2).min(2)];
        let count = if is_exact { right } else { caller.count(right) };
        // SAFETY: there is room for any number of rows that is not refused.
        unsafe {
            match which {
                0..3 => {
                    let copied = caller.call([f64::MAX; 3 * LARGE], |out, caller| {
                        let to = caller.place(out.cast());
                        match which {
                            0 => selvedge_simulation_positions(handle, to, count),
                            1 => selvedge_simulation_velocities(handle, to, count),
                            _ => selvedge_simulation_normals(handle, to, count),
                        }
                    });
                    if let Some(copied) = copied {
                        assert!(copied[3 * count..].iter().all(|&number| number == f64::MAX));
                    }
                }
                3 => drop(caller.call([u32::MAX; 3 * LARGE], |out, caller| {
                    selvedge_simulation_triangles(handle, caller.place(out.cast()), count)
                })),
                4 => drop(caller.call([u32::MAX; 3 * LARGE], |out, _| {
                    // An empty list needs no array.
                    selvedge_simulation_loose_edges(handle, out.cast(), count)
                })),
                _ => {
                    let near = caller.call((ptr::null(), 7), |out, caller| {
                        let (to, count) = (caller.place(&raw mut (*out).0), caller.place(&raw mut (*out).1));
                        selvedge_simulation_near_pairs(handle, to, count)
                    });
                    near.map(|(start, count)| rows::<NearPairRow>(start, count));
                }
            }
        }
    }

    fn lead(&mut self, caller: &mut Caller<'_>) {
        let handle = caller.handle(&[self.handle]);
        let part = caller.one_of(&[0, 0, 0, 1, usize::MAX]);
        let (numbers, pose) = (numbers(caller), pose(caller));
        let (which, right) = (
            caller.byte() % 5,
            caller.one_of(&[3, 3, self.sizes.vertex_count - self.sizes.cloth_vertex_count]),
        );
        let count = caller.count(right);
        let wind = [(); 3].map(|()| caller.number());
        caller.call((), |_, caller| {
            // SAFETY: the arrays have as many entries as any count that is not refused unread.
            unsafe {
                match which {
                    0 => selvedge_simulation_place_body(handle, part, caller.array(&pose, 1)),
                    1 => selvedge_simulation_move_body(handle, part, caller.array(&numbers, count), count),
                    2 => selvedge_simulation_move_pins(handle, part, caller.array(&numbers, count), count),
                    3 => selvedge_simulation_set_wind(handle, wind[0], wind[1], wind[2]),
                    _ => Status::Ok,
                }
            }
        });
        if which == 4 {
            let answer = (false, [7.0; 7]);
            let placed = caller.call(answer, |out, caller| {
                // SAFETY: there are places for the answers; a placement is seven numbers.
                unsafe {
                    let (known, place) = (caller.place(&raw mut (*out).0), caller.place((&raw mut (*out).1).cast()));
                    selvedge_simulation_placement(handle, part, known, place)
                }
            });
            if let Some((is_known, place)) = placed {
                assert_eq!(is_known, place != [7.0; 7]);
            }
        }
    }

    fn teleport(&mut self, caller: &mut Caller<'_>) {
        let handle = caller.handle(&[self.handle]);
        let [bodies, cloths] = [(); 2].map(|()| [caller.one_of(&[0, 0, 0, 1, usize::MAX]); ROOM]);
        let (body_count, cloth_count) = (caller.count(1), caller.count(0));
        let by = pose(caller);
        caller.call((), |_, caller| {
            let (bodies, cloths) = (caller.array(&bodies, body_count), caller.array(&cloths, cloth_count));
            // SAFETY: the arrays have as many entries as any count that is not refused unread.
            unsafe { selvedge_simulation_teleport(handle, bodies, body_count, cloths, cloth_count, caller.array(&by, 1)) }
        });
    }

    fn find(&mut self, caller: &mut Caller<'_>) {
        let handle = caller.handle(&[self.handle]);
        let (which, mut room) = (caller.byte() % 5, Vec::new());
        let name = text(caller, if which == 0 { c"ball" } else { c"cloth" }, &mut room);
        // SAFETY: texts end with a zero, and there are places for answers.
        unsafe {
            match which {
                0 | 1 => {
                    let part = caller.call(PartRow::default(), |out, caller| {
                        let find = [selvedge_simulation_body, selvedge_simulation_cloth][usize::from(which)];
                        find(handle, name, caller.place(out))
                    });
                    if let Some(part) = part {
                        assert!(part.first_vertex + part.vertex_count <= self.sizes.vertex_count);
                    }
                }
                2 => drop(caller.call(ProgressRow::default(), |out, caller| {
                    selvedge_simulation_progress(handle, caller.place(out))
                })),
                3 => drop(caller.call(SizesRow::default(), |out, caller| {
                    selvedge_simulation_sizes(handle, caller.place(out))
                })),
                _ => {
                    let mut mesh = no_lists();
                    let mesh = &raw mut mesh;
                    let found = caller.call((ptr::null(), 7), |out, caller| {
                        let (to, count) = (caller.place(&raw mut (*out).0), caller.place(&raw mut (*out).1));
                        selvedge_simulation_mesh_in_files(handle, caller.place(mesh), to, count)
                    });
                    assert_eq!(
                        found.is_none(),
                        (*mesh).vertex_count == usize::MAX,
                        "the mesh is written with its numbers"
                    );
                    if let Some((start, count)) = found {
                        let numbers = rows::<u32>(start, count);
                        assert!(numbers.iter().all(|&number| (number as usize) < (*mesh).vertex_count));
                    }
                }
            }
        }
    }

    fn checkpoint(&mut self, caller: &mut Caller<'_>) {
        let handle = caller.handle(&[self.handle]);
        let written = caller.call((ptr::null(), 7), |out, caller| {
            // SAFETY: there are places for the list.
            unsafe {
                let (to, count) = (caller.place(&raw mut (*out).0), caller.place(&raw mut (*out).1));
                selvedge_simulation_checkpoint(handle, to, count)
            }
        });
        let mut bytes = written.map_or(vec![7; ROOM], |(start, count)| rows::<u8>(start, count));
        for _ in 0..caller.byte() % 4 {
            let place = (usize::from(caller.byte()) * 256 + usize::from(caller.byte())) % bytes.len();
            bytes[place] = caller.byte();
        }
        let cut = if caller.byte() < 200 {
            0
        } else {
            usize::from(caller.byte()) % bytes.len()
        };
        let count = bytes.len() - cut;
        caller.call((), |_, caller| {
            // SAFETY: there are as many bytes.
            unsafe { selvedge_simulation_resume(handle, caller.array(&bytes, count), count) }
        });
    }
}

/// Lists that no call writes.
fn no_lists() -> MeshLists {
    MeshLists {
        positions: ptr::null(),
        vertex_count: usize::MAX,
        triangles: ptr::null(),
        triangle_count: 7,
        loose_edges: ptr::null(),
        loose_edge_count: 7,
        points: ptr::null(),
        point_count: 7,
    }
}

/// Reads a file that is not there.
fn read_file(caller: &mut Caller<'_>) {
    let mut room = Vec::new();
    let path = text(caller, c"no-such-folder/a.obj", &mut room);
    let made = caller.call(ptr::null_mut(), |out, caller| {
        // SAFETY: the text ends with a zero, and there is a place for the handle.
        unsafe { selvedge_file_new(path, caller.place(out)) }
    });
    assert!(made.is_none());
    let handle = caller.handle(&[ptr::null_mut::<FileHandle>()]);
    let mut mesh = no_lists();
    let mesh = &raw mut mesh;
    let found = caller.call((ptr::null(), ptr::null()), |out, caller| {
        // SAFETY: there are places for the answers.
        unsafe {
            let (missing, notes) = (caller.place(&raw mut (*out).0), caller.place(&raw mut (*out).1));
            selvedge_file_mesh(handle, caller.place(mesh), missing, notes)
        }
    });
    assert!(found.is_none());
}
