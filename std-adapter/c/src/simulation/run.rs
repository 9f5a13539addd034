//! How simulations are made, stepped and freed.

use super::{Answers, HandledSimulation, OfScene, on};
use crate::guard::guarded;
use crate::handles;
use crate::input::{Out, text};
use crate::status::{Failure, Status};
use selvedge_cloth::{Scene, Simulation};
use std::ffi::c_char;
use std::path::Path;

/// A scene in motion. Only pointers to it exist; they are numbers, and nothing is behind them.
///
/// One thread at a time, as for a detector.
pub struct SimulationHandle {
    _nothing: [u8; 0],
}

/// Sets a scene up. From now on it lives.
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
        answers: Answers::default(),
    })?);
    Ok(())
}

/// A simulation of the scene that `scene` is the text of, TOML as std-adapter/cloth/scenes/README.md explains, on `threads` threads
/// (0: one for each core): their number changes no bit of the result. Paths in the text are relative to `folder`; NULL is the
/// process's own.
///
/// Texts are UTF-8, with a zero at the end, and copied. Words about the scene call it scene.toml. `*simulation` becomes the handle;
/// selvedge_simulation_free gives back what it takes.
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

/// selvedge_simulation_new of a scene file. Paths in it are relative to its folder.
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

/// Does one step. SELVEDGE_STATUS_BLOCKED: no motion was found that leaves the cloth free of intersections, in a scene that stops
/// then; what is done of the step stays, and the words say what was in the way. The state is as free as it was before.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_simulation_step(simulation: *mut SimulationHandle) -> Status {
    on(simulation, |it| {
        let blocked = |error| Failure::new(Status::Blocked, error);
        it.simulation.step().map_err(blocked)
    })
}

/// Frees a simulation and all that it has shown. NULL is well. One that another thread is using goes when that call has ended.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_simulation_free(simulation: *mut SimulationHandle) -> Status {
    handles::free::<HandledSimulation>(simulation)
}
