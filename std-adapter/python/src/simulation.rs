//! The class `Simulation`.

use crate::answers::{class, rows, show_crossings, show_near_pairs, show_released, show_torn_edges, show_untangled};
use crate::call::{Length, interruptible};
use crate::driven::{Body, copied};
use crate::errors::{self, BlockedError, BrokenError, CheckpointError, ForkedError, InputError};
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::exceptions::PyRuntimeWarning;
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyBytes, PyDict, PySlice, PyType};
use selvedge_cloth::glam::{DQuat, DVec3};
use selvedge_cloth::{ContactCounts, ContactSeconds, FrameError, Placement, Scene, vertex_normals};
use std::ffi::CString;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError, TryLockError};

/// The name of a scene without a file, in messages.
const SCENE: &str = "scene.toml";

/// The stub, `_native.pyi`, documents the class.
#[pyclass(frozen, module = "selvedge")]
pub(crate) struct Simulation {
    simulation: Mutex<selvedge_cloth::Simulation>,
    shown: Mutex<Shown>,
    of_scene: OfScene,
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

/// Facts of the scene that the simulation does not store.
struct OfScene {
    steps: u64,
    steps_per_frame: u64,
    time_step: f64,
    /// The length of a frame, in seconds.
    frame: f64,
    settings: Vec<(String, String)>,
}

impl Simulation {
    fn of(py: Python<'_>, scene: PyResult<Scene>, threads: usize) -> PyResult<Self> {
        let scene = scene?;
        let of_scene = OfScene {
            steps: scene.steps(),
            steps_per_frame: scene.steps_per_frame(),
            time_step: scene.time_step,
            frame: scene.frame_rate.recip(),
            settings: scene.settings(),
        };
        let made = interruptible(py, Length::Long, || (), || selvedge_cloth::Simulation::new(scene, threads))?;
        let simulation = made
            .map_err(|words| errors::broken(&words))?
            .map_err(|error| errors::of_setup(py, &error))?;
        let shown = Shown::new(py, simulation.positions().len())?;
        let made = Self {
            simulation: Mutex::new(simulation),
            shown: Mutex::new(shown),
            of_scene,
            threads_of: (threads != 1).then(std::process::id),
            is_broken: AtomicBool::new(false),
        };
        let simulation = made.simulation()?;
        made.show(py, &simulation)?;
        drop(simulation);
        Ok(made)
    }

    fn simulation(&self) -> PyResult<MutexGuard<'_, selvedge_cloth::Simulation>> {
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

    fn shown(&self) -> MutexGuard<'_, Shown> {
        self.shown.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Shows the steps that were done, which remain even after an interruption, and warns if one of them was too long: `before` is the
    /// number of such steps before them.
    fn shown_after<T>(
        &self,
        py: Python<'_>,
        simulation: &selvedge_cloth::Simulation,
        before: u64,
        done: PyResult<Result<T, String>>,
    ) -> PyResult<T> {
        if let Ok(Err(words)) = &done {
            self.is_broken.store(true, Ordering::Relaxed);
            return Err(errors::broken(words));
        }
        self.show(py, simulation)?;
        let done = done?.map_err(|words| errors::broken(&words))?;
        if simulation.overstretched_steps() > before {
            let text = format!(
                "at {:.6} s an edge is more than 5 % above its limit: use a shorter time step, or advance()",
                simulation.time()
            );
            PyErr::warn(py, &py.get_type::<PyRuntimeWarning>(), &CString::new(text)?, 1)?;
        }
        Ok(done)
    }

    fn show(&self, py: Python<'_>, simulation: &selvedge_cloth::Simulation) -> PyResult<()> {
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
}

#[pymethods]
impl Simulation {
    #[new]
    #[pyo3(signature = (scene, threads=1))]
    fn new(py: Python<'_>, scene: PathBuf, threads: usize) -> PyResult<Self> {
        Self::of(py, Scene::read(&scene).map_err(|error| errors::of_scene(&error)), threads)
    }

    #[classmethod]
    #[pyo3(signature = (text, threads=1, *, path=None))]
    fn from_text(class: &Bound<'_, PyType>, text: &str, threads: usize, path: Option<PathBuf>) -> PyResult<Self> {
        let path = path.unwrap_or_else(|| SCENE.into());
        Self::of(
            class.py(),
            Scene::parse(text, &path).map_err(|error| errors::of_scene(&error)),
            threads,
        )
    }

    #[classmethod]
    #[pyo3(signature = (scene, threads=1, *, folder=None))]
    fn from_dict(
        class: &Bound<'_, PyType>,
        scene: &Bound<'_, PyDict>,
        threads: usize,
        folder: Option<PathBuf>,
    ) -> PyResult<Self> {
        let text = class.py().import("selvedge._scenes")?.call_method1("text_of", (scene,))?;
        let path = folder.unwrap_or_default().join(SCENE);
        let scene = Scene::parse(text.extract()?, &path).map_err(|error| errors::of_scene(&error));
        Self::of(class.py(), scene, threads)
    }

    #[pyo3(signature = (count=1))]
    fn step(&self, py: Python<'_>, count: u64) -> PyResult<()> {
        let mut simulation = self.simulation()?;
        let simulation = &mut *simulation;
        // Runs on the caller's thread: nothing interrupts a step, and signals are checked after each.
        let before = simulation.overstretched_steps();
        let mut done = Ok(Ok(Ok(())));
        for _ in 0..count {
            done = interruptible(py, Length::Short, || (), || simulation.step());
            if let Ok(Ok(Ok(()))) = done {
                done = py.check_signals().map(|()| Ok(Ok(())));
            }
            if !matches!(done, Ok(Ok(Ok(())))) {
                break;
            }
        }
        let done = self.shown_after(py, simulation, before, done)?;
        done.map_err(|blocked| BlockedError::new_err(blocked.to_string()))
    }

    #[pyo3(signature = (seconds=None, *, most=64))]
    fn advance(&self, py: Python<'_>, seconds: Option<f64>, most: u32) -> PyResult<(u32, u32)> {
        let mut simulation = self.simulation()?;
        let simulation = &mut *simulation;
        let before = simulation.overstretched_steps();
        let seconds = seconds.unwrap_or(self.of_scene.frame);
        let done = interruptible(py, Length::Short, || (), || simulation.advance_within(seconds, most));
        let done = self.shown_after(py, simulation, before, done)?;
        let frame = done.map_err(|error| match error {
            FrameError::Seconds(error) => InputError::new_err(error.to_string()),
            FrameError::Blocked(blocked) => BlockedError::new_err(blocked.to_string()),
        })?;
        Ok((frame.steps, frame.needed))
    }

    #[getter]
    fn body_names(&self) -> PyResult<Vec<String>> {
        Ok(self.simulation()?.body_names().to_vec())
    }

    fn body_vertices<'py>(&self, py: Python<'py>, body: Body) -> PyResult<Bound<'py, PySlice>> {
        let simulation = self.simulation()?;
        let vertices = simulation.body_vertices(body.index(&simulation)?).unwrap_or_default();
        Ok(PySlice::new(py, vertices.start as isize, vertices.end as isize, 1))
    }

    #[pyo3(signature = (body, translation=[0.0; 3], rotation=[0.0, 0.0, 0.0, 1.0]))]
    fn place_body(&self, body: Body, translation: [f64; 3], rotation: [f64; 4]) -> PyResult<()> {
        let mut simulation = self.simulation()?;
        let body = body.index(&simulation)?;
        let placement = Placement {
            rotation: DQuat::from_array(rotation),
            translation: translation.into(),
        };
        simulation
            .place_body(body, placement)
            .map_err(|error| errors::of_driving(&error))
    }

    #[pyo3(signature = (bodies, translation=[0.0; 3], rotation=[0.0, 0.0, 0.0, 1.0], *, cloths=Vec::new()))]
    fn teleport(&self, bodies: Vec<Body>, translation: [f64; 3], rotation: [f64; 4], cloths: Vec<Body>) -> PyResult<()> {
        let mut simulation = self.simulation()?;
        let bodies: Vec<usize> = bodies.iter().map(|body| body.index(&simulation)).collect::<PyResult<_>>()?;
        let cloths: Vec<usize> = cloths.iter().map(|cloth| cloth.index_of_cloth(&simulation)).collect::<PyResult<_>>()?;
        let by = Placement {
            rotation: DQuat::from_array(rotation),
            translation: translation.into(),
        };
        let teleported = simulation.teleport(&bodies, &cloths, by);
        teleported.map_err(|error| errors::of_teleport(&error))
    }

    fn placement(&self, body: Body) -> PyResult<Option<([f64; 3], [f64; 4])>> {
        let simulation = self.simulation()?;
        let placement = simulation.placement(body.index(&simulation)?);
        Ok(placement.map(|placement| (placement.translation.to_array(), placement.rotation.to_array())))
    }

    fn move_body(&self, body: Body, positions: &Bound<'_, PyAny>) -> PyResult<()> {
        let positions = copied(positions)?;
        let mut simulation = self.simulation()?;
        let body = body.index(&simulation)?;
        simulation
            .move_body(body, &positions)
            .map_err(|error| errors::of_driving(&error))
    }

    fn move_pins(&self, group: usize, positions: &Bound<'_, PyAny>) -> PyResult<()> {
        let positions = copied(positions)?;
        let moved = self.simulation()?.move_pins(group, &positions);
        moved.map_err(|error| errors::of_driving(&error))
    }

    fn set_wind(&self, velocity: [f64; 3]) -> PyResult<()> {
        let set = self.simulation()?.set_wind(velocity.into());
        set.map_err(|error| errors::of_driving(&error))
    }

    #[getter]
    fn velocities<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let simulation = self.simulation()?;
        rows(py, simulation.velocities().iter().map(DVec3::to_array).collect())
    }

    #[getter]
    fn normals<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let simulation = self.simulation()?;
        let mut normals = Vec::new();
        vertex_normals(simulation.positions(), simulation.triangles(), &mut normals);
        rows(py, normals.iter().map(DVec3::to_array).collect())
    }

    #[getter]
    fn near_pairs<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let pairs: Vec<_> = self.simulation()?.near_pairs().collect();
        show_near_pairs(py, &pairs)
    }

    #[getter]
    fn crossings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        show_crossings(py, self.simulation()?.crossings())
    }

    #[getter]
    fn tolerated_pairs(&self) -> PyResult<usize> {
        Ok(self.simulation()?.tolerated_pairs())
    }

    #[getter]
    fn untangled<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        show_untangled(py, self.simulation()?.untangled())
    }

    #[getter]
    fn released<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyAny>>> {
        show_released(py, &self.simulation()?.released())
    }

    #[getter]
    fn torn_edges<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyAny>>> {
        show_torn_edges(py, self.simulation()?.torn_edges())
    }

    #[getter]
    fn positions(&self, py: Python<'_>) -> Py<PyAny> {
        self.shown().view.clone_ref(py)
    }

    #[getter]
    fn faces<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        rows(py, self.simulation()?.triangles().to_vec())
    }

    #[getter]
    fn loose_edges<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        rows(py, self.simulation()?.loose_edges().to_vec())
    }

    fn mesh_in_files<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let now = self.simulation()?.mesh_in_files();
        class(py, "MeshInFiles")?.call1((
            rows(py, now.mesh.positions.iter().map(DVec3::to_array).collect())?,
            rows(py, now.mesh.triangles)?,
            rows(py, now.loose_edges)?,
            PyArray1::from_vec(py, now.number_of),
        ))
    }

    #[getter]
    fn cloth_vertex_count(&self) -> PyResult<usize> {
        Ok(self.simulation()?.cloth_vertices())
    }

    #[getter]
    fn cloth_face_count(&self) -> PyResult<usize> {
        Ok(self.simulation()?.cloth_triangles())
    }

    #[getter]
    fn name(&self) -> PyResult<String> {
        Ok(self.simulation()?.name().to_owned())
    }

    #[getter]
    const fn time_step(&self) -> f64 {
        self.of_scene.time_step
    }

    #[getter]
    const fn steps(&self) -> u64 {
        self.of_scene.steps
    }

    #[getter]
    const fn steps_per_frame(&self) -> u64 {
        self.of_scene.steps_per_frame
    }

    #[getter]
    fn settings(&self, py: Python<'_>) -> PyResult<Py<PyDict>> {
        let settings = PyDict::new(py);
        for (name, value) in &self.of_scene.settings {
            settings.set_item(name, value)?;
        }
        Ok(settings.unbind())
    }

    #[getter]
    fn steps_done(&self) -> PyResult<u64> {
        Ok(self.simulation()?.steps_done())
    }

    #[getter]
    fn time(&self) -> PyResult<f64> {
        Ok(self.simulation()?.time())
    }

    #[getter]
    fn lag(&self) -> PyResult<f64> {
        Ok(self.simulation()?.lag())
    }

    #[getter]
    fn is_certified(&self) -> PyResult<bool> {
        Ok(self.simulation()?.is_certified())
    }

    #[getter]
    fn blocked_steps(&self) -> PyResult<u64> {
        Ok(self.simulation()?.blocked_steps())
    }

    #[getter]
    fn overstretched_steps(&self) -> PyResult<u64> {
        Ok(self.simulation()?.overstretched_steps())
    }

    #[getter]
    fn edge_stretch(&self) -> PyResult<(f64, f64)> {
        let stretch = self.simulation()?.edge_stretch();
        Ok((stretch.percentile_99, stretch.largest))
    }

    #[getter]
    fn effect_seconds(&self, py: Python<'_>) -> PyResult<Py<PyDict>> {
        let seconds = PyDict::new(py);
        for effect in self.simulation()?.effects() {
            seconds.set_item(effect.name, effect.seconds)?;
        }
        Ok(seconds.unbind())
    }

    #[getter]
    fn contact_counts<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        let simulation = self.simulation()?;
        let Some(&counts) = simulation.contact_counts() else {
            return Ok(None);
        };
        let ContactCounts {
            candidates,
            looked_at,
            pushed,
            violated,
            zone_rounds,
            held,
            cuts,
        } = counts;
        let named = [
            ("candidates", candidates),
            ("looked_at", looked_at),
            ("pushed", pushed),
            ("violated", violated),
            ("zone_rounds", zone_rounds),
            ("held", held),
            ("cuts", cuts),
        ];
        named.into_py_dict(py).map(Some)
    }

    #[getter]
    fn contact_seconds<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        let simulation = self.simulation()?;
        let Some(&seconds) = simulation.contact_seconds() else {
            return Ok(None);
        };
        let ContactSeconds {
            candidates,
            constraints,
            certificates,
            repairs,
        } = seconds;
        let named = [
            ("candidates", candidates),
            ("constraints", constraints),
            ("certificates", certificates),
            ("repairs", repairs),
        ];
        named.into_py_dict(py).map(Some)
    }

    fn checkpoint<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyBytes>>> {
        Ok(self.simulation()?.checkpoint().map(|bytes| PyBytes::new(py, &bytes)))
    }

    fn resume(&self, py: Python<'_>, checkpoint: &[u8]) -> PyResult<()> {
        let mut simulation = self.simulation()?;
        simulation
            .resume(checkpoint)
            .map_err(|error| CheckpointError::new_err(error.to_string()))?;
        self.show(py, &simulation)
    }

    fn __repr__(&self) -> PyResult<String> {
        let simulation = self.simulation()?;
        Ok(format!(
            "<selvedge.Simulation '{}' at {:.6} s>",
            simulation.name(),
            simulation.time()
        ))
    }
}
