//! Creates, steps and frees simulations.

use super::{HandledSimulation, OfScene, SimulationAnswers, on};
use crate::guard::guarded;
use crate::handles;
use crate::input::{Out, text};
use crate::status::{Failure, Status};
use selvedge_cloth::{FrameError, FrameSteps, Scene, Simulation};
use std::ffi::c_char;
use std::path::Path;

/// A simulation of a scene. Its pointer is a handle: a number that is looked up and never followed.
///
/// One thread at a time may use a simulation, as for a detector.
pub struct SimulationHandle {
    _nothing: [u8; 0],
}

fn keep(scene: Scene, threads: usize, out: Out<*mut SimulationHandle>) -> Result<(), Failure> {
    let of_scene = OfScene {
        time_step: scene.time_step,
        steps: scene.steps(),
        steps_per_frame: scene.steps_per_frame(),
    };
    out.set(handles::keep(HandledSimulation {
        simulation: Simulation::new(scene, threads)?,
        of_scene,
        has_threads: threads != 1,
        answers: SimulationAnswers::default(),
    })?);
    Ok(())
}

/// Creates a simulation from the text of a scene (TOML, see std-adapter/cloth/scenes/README.md). It uses `threads` threads, 0 for
/// one per core; the result is the same bit for bit. Paths in the text are relative to `folder`; NULL is the current folder.
///
/// Texts are UTF-8, end with a zero and are copied. Messages call the scene scene.toml. `*simulation` receives the handle; free
/// it with selvedge_simulation_free.
///
/// # Safety
/// `scene`, and `folder` unless it is NULL, point to texts that a zero ends, `simulation` to a pointer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_simulation_new(
    scene: *const c_char,
    folder: *const c_char,
    threads: usize,
    simulation: *mut *mut SimulationHandle,
) -> Status {
    guarded(|| {
        // SAFETY: the caller's promises.
        let (out, scene) = unsafe { (Out::new("where the simulation goes", simulation)?, text("the scene", scene)?) };
        let folder = if folder.is_null() {
            ""
        } else {
            // SAFETY: the caller's promise.
            unsafe { text("the folder", folder) }?
        };
        keep(Scene::parse(scene, &Path::new(folder).join("scene.toml"))?, threads, out)
    })
}

/// Creates a simulation from a scene file, as selvedge_simulation_new. Paths in it are relative to its folder.
///
/// # Safety
/// `path` points to a text that a zero ends, `simulation` to a pointer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_simulation_read(
    path: *const c_char,
    threads: usize,
    simulation: *mut *mut SimulationHandle,
) -> Status {
    guarded(|| {
        // SAFETY: the caller's promises.
        let (out, path) = unsafe { (Out::new("where the simulation goes", simulation)?, text("the path", path)?) };
        keep(Scene::read(Path::new(path))?, threads, out)
    })
}

/// Runs one step. SELVEDGE_STATUS_BLOCKED means that no motion leaves the cloth free of intersections, in a scene that stops
/// then. The part of the step that was done remains, the message names the obstacle, and the state stays free of intersections.
/// It also means that a body or pins were to move faster than 100 m/s, before anything moved; selvedge_simulation_teleport jumps.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_simulation_step(simulation: *mut SimulationHandle) -> Status {
    on(simulation, |it| {
        let blocked = |error| Failure::new(Status::Blocked, error);
        it.simulation.step().map_err(blocked)
    })
}

/// The steps of a frame.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FrameRow {
    /// The number of steps that were done.
    pub steps: u32,
    /// The number of steps that the cloth needs. If it is larger, edges may be longer than their limit, and contacts act late.
    pub needed: u32,
}

/// Runs a frame of a game or film: lets time pass, from a microsecond to a second, in as many steps as the cloth needs, at least
/// one and at most `most`; 64 is a good limit. The scene's time step has no part in it. Bodies and pins that were moved do so
/// evenly throughout.
///
/// Statuses are those of selvedge_simulation_step, and SELVEDGE_STATUS_BAD_VALUE for a time out of range, which changes nothing.
///
/// # Safety
/// `frame` is NULL or points to one entry.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_simulation_advance(
    simulation: *mut SimulationHandle,
    seconds: f64,
    most: u32,
    frame: *mut FrameRow,
) -> Status {
    on(simulation, |it| {
        let out = if frame.is_null() {
            None
        } else {
            // SAFETY: the caller's promise.
            Some(unsafe { Out::new("frame", frame) }?)
        };
        let status = |error: &FrameError| match error {
            FrameError::Seconds(_) => Status::BadValue,
            FrameError::Blocked(_) => Status::Blocked,
        };
        let made = it.simulation.advance_within(seconds, most);
        let FrameSteps { steps, needed } = made.map_err(|error| Failure::new(status(&error), error))?;
        if let Some(out) = out {
            out.set(FrameRow { steps, needed });
        }
        Ok(())
    })
}

/// Frees a simulation and its lists. NULL is allowed. A simulation that another thread is using is freed when that call has
/// ended.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_simulation_free(simulation: *mut SimulationHandle) -> Status {
    handles::free::<HandledSimulation>(simulation)
}
