//! A simulation that Python threads share: one of them runs steps, and others read constants and progress meanwhile.

use crate::call::{Length, interruptible, is_main_thread};
use crate::errors::{self, BrokenError, CancelledError, ForkedError};
use numpy::{PyArray2, PyArrayMethods};
use pyo3::exceptions::PyRuntimeWarning;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use selvedge_cloth::{FrameSteps, Scene};
use std::ffi::CString;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError, TryLockError};
use std::time::{Duration, Instant};

#[doc = crate::stub!("Simulation")]
#[pyclass(frozen, module = "selvedge")]
pub(crate) struct Simulation {
    simulation: Mutex<selvedge_cloth::Simulation>,
    shown: Mutex<Shown>,
    known: Mutex<Known>,
    pub(crate) of_scene: OfScene,
    pub(crate) progress: Progress,
    /// The process that started its threads, if it has any.
    threads_of: Option<u32>,
    is_broken: AtomicBool,
}

/// The positions that the caller sees.
struct Shown {
    /// The positions, updated after each call that runs steps.
    written: Py<PyArray2<f64>>,
    /// The read-only view that the caller sees.
    view: Py<PyAny>,
    vertices: usize,
}

impl Shown {
    fn new(py: Python<'_>, vertices: usize) -> PyResult<Self> {
        let written = PyArray2::zeros(py, [vertices, 3], false);
        let view = written.call_method0("view")?;
        view.getattr("flags")?.setattr("writeable", false)?;
        Ok(Self {
            written: written.unbind(),
            view: view.unbind(),
            vertices,
        })
    }
}

/// Facts of the scene that never change. All threads read them at any time.
pub(crate) struct OfScene {
    pub(crate) name: String,
    pub(crate) cloth_names: Vec<String>,
    pub(crate) body_names: Vec<String>,
    pub(crate) cloth_triangles: usize,
    pub(crate) remarks: Vec<String>,
    /// The number of steps in the duration, if the scene has one.
    pub(crate) steps: Option<u64>,
    pub(crate) steps_per_frame: u64,
    pub(crate) time_step: f64,
    /// The length of a frame, in seconds.
    pub(crate) frame: f64,
    pub(crate) settings: Vec<(String, String)>,
}

/// Facts that threads read while another one runs steps. Time and steps are those after the last whole step, the others those
/// after the last call.
#[derive(Clone, Default)]
pub(crate) struct Known {
    pub(crate) steps_done: u64,
    pub(crate) time: f64,
    pub(crate) lag: f64,
    pub(crate) is_certified: bool,
    pub(crate) blocked_steps: u64,
    pub(crate) overstretched_steps: u64,
    pub(crate) tolerated_pairs: usize,
    pub(crate) cloth_vertices: usize,
    pub(crate) vertices_of_cloths: Vec<Range<usize>>,
    pub(crate) body_vertices: Vec<Range<usize>>,
}

impl Known {
    fn of(simulation: &selvedge_cloth::Simulation) -> Self {
        let cloths = 0..simulation.cloth_names().len();
        let bodies = 0..simulation.body_names().len();
        Self {
            steps_done: simulation.steps_done(),
            time: simulation.time(),
            lag: simulation.lag(),
            is_certified: simulation.is_certified(),
            blocked_steps: simulation.blocked_steps(),
            overstretched_steps: simulation.overstretched_steps(),
            tolerated_pairs: simulation.tolerated_pairs(),
            cloth_vertices: simulation.cloth_vertices(),
            vertices_of_cloths: cloths.filter_map(|cloth| simulation.vertices_of_cloth(cloth)).collect(),
            body_vertices: bodies.filter_map(|body| simulation.body_vertices(body)).collect(),
        }
    }
}

/// The progress of the running call, or of the last one.
#[derive(Default)]
pub(crate) struct Progress {
    done: AtomicU64,
    of: AtomicU64,
    is_cancelled: AtomicBool,
}

impl Progress {
    /// Returns the number of steps that are done, and that of the whole call.
    pub(crate) fn now(&self) -> (u64, u64) {
        (self.done.load(Ordering::Relaxed), self.of.load(Ordering::Relaxed))
    }

    pub(crate) fn cancel(&self) {
        self.is_cancelled.store(true, Ordering::Relaxed);
    }
}

/// A call that runs steps. Other threads see its progress and may cancel it; signals stop it.
pub(crate) struct Call<'a> {
    simulation: &'a Simulation,
    /// True on the thread on which Python runs signal handlers.
    sees_signals: bool,
    looked: Instant,
    stopped: Option<PyErr>,
}

/// The longest time until Ctrl-C is noticed, if steps are shorter.
const LOOK: Duration = Duration::from_millis(20);

impl<'a> Call<'a> {
    /// Begins a call of `steps` steps.
    pub(crate) fn begin(simulation: &'a Simulation, py: Python<'_>, steps: u64) -> PyResult<Self> {
        let progress = &simulation.progress;
        progress.is_cancelled.store(false, Ordering::Relaxed);
        progress.done.store(0, Ordering::Relaxed);
        progress.of.store(steps, Ordering::Relaxed);
        Ok(Self {
            simulation,
            sees_signals: is_main_thread(py)?,
            looked: Instant::now(),
            stopped: None,
        })
    }

    /// Sets the number of steps, once it is known.
    pub(crate) fn of(&self, steps: u64) {
        self.simulation.progress.of.store(steps, Ordering::Relaxed);
    }

    /// Takes note of a step, and returns whether the call must stop after it.
    pub(crate) fn is_to_stop(&mut self, done: u64, time: f64, steps_done: u64) -> bool {
        let progress = &self.simulation.progress;
        progress.done.store(done, Ordering::Relaxed);
        {
            let mut known = self.simulation.known();
            (known.time, known.steps_done) = (time, steps_done);
        }
        if progress.is_cancelled.load(Ordering::Relaxed) {
            self.stopped = Some(CancelledError::new_err(
                "another thread has cancelled the call; the steps before stay",
            ));
        } else if self.sees_signals && self.looked.elapsed() >= LOOK {
            self.looked = Instant::now();
            self.stopped = Python::attach(|py| py.check_signals()).err();
        }
        self.stopped.is_some()
    }

    /// Returns the exception that stopped the call, if any.
    pub(crate) fn end(self) -> PyResult<()> {
        self.stopped.map_or(Ok(()), Err)
    }
}

impl Simulation {
    pub(crate) fn of(py: Python<'_>, scene: Scene, threads: usize) -> PyResult<Self> {
        let begin = Instant::now();
        let of_scene = OfScene {
            name: scene.name.clone(),
            cloth_names: scene.cloths.iter().map(|cloth| cloth.name.clone()).collect(),
            body_names: scene.bodies.iter().map(|body| body.name.clone()).collect(),
            cloth_triangles: scene.cloths.iter().map(|cloth| cloth.mesh().triangles.len()).sum(),
            remarks: scene.remarks.clone(),
            steps: scene.has_duration().then(|| scene.steps()),
            steps_per_frame: scene.steps_per_frame(),
            time_step: scene.time_step,
            frame: scene.frame_rate.recip(),
            settings: scene.settings(),
        };
        let made = interruptible(py, Length::Long, || (), || selvedge_cloth::Simulation::new(scene, threads))?;
        let simulation = made
            .map_err(|words| errors::broken(&words))?
            .map_err(|error| errors::of_setup(py, &error))?;
        let made = Self {
            shown: Mutex::new(Shown::new(py, simulation.positions().len())?),
            known: Mutex::new(Known::of(&simulation)),
            simulation: Mutex::new(simulation),
            of_scene,
            progress: Progress::default(),
            threads_of: (threads != 1).then(std::process::id),
            is_broken: AtomicBool::new(false),
        };
        made.show(py, &*made.simulation()?)?;
        made.log_start(py, begin.elapsed())?;
        Ok(made)
    }

    pub(crate) fn simulation(&self) -> PyResult<MutexGuard<'_, selvedge_cloth::Simulation>> {
        if self.is_broken.load(Ordering::Relaxed) {
            return Err(BrokenError::new_err(
                "a step failed because of a bug in Selvedge: create the simulation again",
            ));
        }
        if self.threads_of.is_some_and(|process| process != std::process::id()) {
            return Err(ForkedError::new_err(
                "the simulation's threads are in the parent process: create a simulation in the child, or start children by 'spawn'",
            ));
        }
        match self.simulation.try_lock() {
            Ok(simulation) => Ok(simulation),
            Err(TryLockError::WouldBlock) => Err(errors::busy()),
            // A panic is caught earlier and marks the simulation.
            Err(TryLockError::Poisoned(poisoned)) => Ok(poisoned.into_inner()),
        }
    }

    /// Returns the facts that are known while steps run. No Python code runs while they are locked.
    pub(crate) fn known(&self) -> MutexGuard<'_, Known> {
        self.known.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn shown(&self) -> MutexGuard<'_, Shown> {
        self.shown.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Returns the read-only view of the positions.
    pub(crate) fn view(&self, py: Python<'_>) -> Py<PyAny> {
        self.shown().view.clone_ref(py)
    }

    /// Shows the steps of a call, which remain even after an interruption. `done` is its result.
    pub(crate) fn shown_after<T>(
        &self,
        py: Python<'_>,
        simulation: &selvedge_cloth::Simulation,
        done: PyResult<Result<T, String>>,
    ) -> PyResult<T> {
        if let Ok(Err(words)) = &done {
            self.is_broken.store(true, Ordering::Relaxed);
            return Err(errors::broken(words));
        }
        self.show(py, simulation)?;
        done?.map_err(|words| errors::broken(&words))
    }

    pub(crate) fn show(&self, py: Python<'_>, simulation: &selvedge_cloth::Simulation) -> PyResult<()> {
        *self.known() = Known::of(simulation);
        let vertices = simulation.positions().len();
        // No Python code runs while it is locked.
        let known = self.shown().vertices;
        if known != vertices {
            // Tearing has added vertices.
            let torn = Shown::new(py, vertices)?;
            *self.shown() = torn;
        }
        let written = self.shown().written.clone_ref(py);
        let mut written = written.bind(py).try_readwrite()?;
        let (rows, _) = written.as_slice_mut()?.as_chunks_mut::<3>();
        for (row, position) in rows.iter_mut().zip(simulation.positions()) {
            *row = position.to_array();
        }
        Ok(())
    }

    /// Warns that an edge is longer than its limit, with the remedy.
    pub(crate) fn warn_of_stretch(&self, py: Python<'_>, remedy: &str) -> PyResult<()> {
        let text = format!(
            "at {:.6} s an edge is more than 5 % above its limit: {remedy}",
            self.known().time
        );
        PyErr::warn(py, &py.get_type::<PyRuntimeWarning>(), &CString::new(text)?, 1)
    }

    /// Logs the scene, and what its files made remarkable.
    fn log_start(&self, py: Python<'_>, took: Duration) -> PyResult<()> {
        let logger = logger(py)?;
        for remark in &self.of_scene.remarks {
            logger.call_method1("warning", ("'%s': %s", &self.of_scene.name, remark))?;
        }
        let known = self.known().clone();
        let bodies: usize = known.body_vertices.iter().map(ExactSizeIterator::len).sum();
        let (name, cloth) = (&self.of_scene.name, known.cloth_vertices);
        let text = "'%s': %d vertices of cloth and %d of bodies, set up in %.3f s";
        logger.call_method1("info", (text, name, cloth, bodies, took.as_secs_f64()))?;
        Ok(())
    }

    pub(crate) fn log_frame(&self, py: Python<'_>, frame: FrameSteps) -> PyResult<()> {
        let text = "'%s': at %.6f s after %d of %d steps";
        let time = self.known().time;
        logger(py)?.call_method1("debug", (text, &self.of_scene.name, time, frame.steps, frame.needed))?;
        Ok(())
    }
}

fn logger(py: Python<'_>) -> PyResult<Bound<'_, PyAny>> {
    static LOGGER: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
    let made = || Ok::<_, PyErr>(py.import("logging")?.call_method1("getLogger", ("selvedge",))?.unbind());
    Ok(LOGGER.get_or_try_init(py, made)?.bind(py).clone())
}
