//! The class `Simulation`. Its state and its calls without the interpreter lock are in `simulated.rs`.

use crate::answers::{self, class, rows, show_crossings, show_near_pairs, show_released, show_torn_edges, show_untangled};
use crate::call::{Length, interruptible};
use crate::driven::{Body, Cloth, brought_to, copied, placement, whole_numbers};
use crate::errors::{self, BlockedError, CheckpointError, InputError};
use crate::loads;
use crate::scenes;
use crate::simulated::{Call, Simulation};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyBytes, PyDict, PySlice, PyType};
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{FrameError, Scene, SceneContext, vertex_normals};
use std::ops::{ControlFlow, Range};
use std::path::PathBuf;

#[pymethods]
impl Simulation {
    #[new]
    #[pyo3(signature = (scene, threads=1))]
    fn new(py: Python<'_>, scene: PathBuf, threads: usize) -> PyResult<Self> {
        let scene = scenes::of_file(&scene).map_err(|error| errors::of_scene(&error))?;
        Self::of(py, scene, threads)
    }

    #[doc = crate::stub!("Simulation.from_text")]
    #[classmethod]
    #[pyo3(signature = (text, threads=1, *, path=None))]
    fn from_text(class: &Bound<'_, PyType>, text: &str, threads: usize, path: Option<PathBuf>) -> PyResult<Self> {
        let path = path.unwrap_or_else(|| scenes::NAME.into());
        let context = SceneContext {
            is_run_by_code: true,
            ..SceneContext::default()
        };
        let scene = Scene::parse_in(text, &path, &context).map_err(|error| errors::of_scene(&error))?;
        Self::of(class.py(), scene, threads)
    }

    #[doc = crate::stub!("Simulation.from_dict")]
    #[classmethod]
    #[pyo3(signature = (scene, threads=1, *, folder=None))]
    fn from_dict(
        class: &Bound<'_, PyType>,
        scene: &Bound<'_, PyDict>,
        threads: usize,
        folder: Option<PathBuf>,
    ) -> PyResult<Self> {
        Self::of(class.py(), scenes::of_dict(scene, folder)?, threads)
    }

    #[doc = crate::stub!("Simulation.step")]
    #[pyo3(signature = (count=1))]
    fn step(&self, py: Python<'_>, count: u64) -> PyResult<()> {
        let mut simulation = self.simulation()?;
        let simulation = &mut *simulation;
        let before = simulation.overstretched_steps();
        let mut call = Call::begin(self, py, count)?;
        // Nothing interrupts a step, and signals are checked between steps: it runs on the caller's thread.
        let done = interruptible(
            py,
            Length::Short,
            || (),
            || {
                for done in 1..=count {
                    simulation.step()?;
                    if call.is_to_stop(done, simulation.time(), simulation.steps_done()) && done < count {
                        break;
                    }
                }
                Ok(())
            },
        );
        let stopped = call.end();
        let done = self.shown_after(py, simulation, done)?;
        stopped?;
        if simulation.overstretched_steps() > before {
            self.warn_of_stretch(py, "use a shorter time step, or advance()")?;
        }
        done.map_err(|blocked: selvedge_cloth::Blocked| BlockedError::new_err(blocked.to_string()))
    }

    #[doc = crate::stub!("Simulation.advance")]
    #[pyo3(signature = (seconds=None, *, most=64))]
    fn advance(&self, py: Python<'_>, seconds: Option<f64>, most: u32) -> PyResult<(u32, u32)> {
        let mut simulation = self.simulation()?;
        let simulation = &mut *simulation;
        let before = simulation.overstretched_steps();
        let seconds = seconds.unwrap_or(self.of_scene.frame);
        let mut call = Call::begin(self, py, 0)?;
        // Nothing interrupts a step, and signals are checked between steps: it runs on the caller's thread.
        let done = interruptible(
            py,
            Length::Short,
            || (),
            || {
                simulation.advance_while(seconds, most, &mut |now| {
                    call.of(now.of.into());
                    match call.is_to_stop(now.steps.into(), now.time, now.steps_done) {
                        true => ControlFlow::Break(()),
                        false => ControlFlow::Continue(()),
                    }
                })
            },
        );
        let stopped = call.end();
        let done = self.shown_after(py, simulation, done)?;
        stopped?;
        let frame = done.map_err(|error| match error {
            FrameError::Seconds(error) => InputError::new_err(error.to_string()),
            FrameError::Blocked(blocked) => BlockedError::new_err(blocked.to_string()),
        })?;
        // A frame with all the steps that it needs has none that is too long.
        if frame.needed > frame.steps && simulation.overstretched_steps() > before {
            self.warn_of_stretch(py, "allow more steps with `most`")?;
        }
        self.log_frame(py, frame)?;
        Ok((frame.steps, frame.needed))
    }

    #[doc = crate::stub!("Simulation.cancel")]
    fn cancel(&self) {
        self.progress.cancel();
    }

    #[doc = crate::stub!("Simulation.progress")]
    #[getter]
    fn progress(&self) -> (u64, u64) {
        self.progress.now()
    }

    #[doc = crate::stub!("Simulation.remarks")]
    #[getter]
    fn remarks(&self) -> Vec<String> {
        self.of_scene.remarks.clone()
    }

    #[doc = crate::stub!("Simulation.cloth_names")]
    #[getter]
    fn cloth_names(&self) -> Vec<String> {
        self.of_scene.cloth_names.clone()
    }

    #[doc = crate::stub!("Simulation.vertices_of_cloth")]
    fn vertices_of_cloth<'py>(&self, py: Python<'py>, cloth: Cloth) -> PyResult<Bound<'py, PySlice>> {
        let cloth = cloth.index(&self.of_scene.cloth_names)?;
        Ok(slice_of(py, &self.known().vertices_of_cloths[cloth]))
    }

    #[doc = crate::stub!("Simulation.positions_of_cloth")]
    fn positions_of_cloth<'py>(&self, py: Python<'py>, cloth: Cloth) -> PyResult<Bound<'py, PyAny>> {
        let cloth = cloth.index(&self.of_scene.cloth_names)?;
        let made = self.simulation()?.mesh_in_files();
        let own = &made.mesh.positions[made.vertices_of_cloths[cloth].clone()];
        rows(py, own.iter().map(DVec3::to_array).collect())
    }

    #[doc = crate::stub!("Simulation.set_velocity")]
    fn set_velocity(&self, vertices: &Bound<'_, PyAny>, velocity: [f64; 3]) -> PyResult<()> {
        let vertices = whole_numbers(vertices, "vertices", self.known().cloth_vertices)?;
        let set = self.simulation()?.set_velocity(&vertices, velocity.into());
        set.map_err(|error| errors::of_driving(&error))
    }

    #[doc = crate::stub!("Simulation.body_names")]
    #[getter]
    fn body_names(&self) -> Vec<String> {
        self.of_scene.body_names.clone()
    }

    #[doc = crate::stub!("Simulation.body_vertices")]
    fn body_vertices<'py>(&self, py: Python<'py>, body: Body) -> PyResult<Bound<'py, PySlice>> {
        let body = body.index(&self.of_scene.body_names)?;
        Ok(slice_of(py, &self.known().body_vertices[body]))
    }

    #[doc = crate::stub!("Simulation.place_body")]
    #[pyo3(signature = (body, translation=[0.0; 3], rotation=[0.0, 0.0, 0.0, 1.0]))]
    fn place_body(&self, body: Body, translation: [f64; 3], rotation: [f64; 4]) -> PyResult<()> {
        let body = body.index(&self.of_scene.body_names)?;
        let placed = self.simulation()?.place_body(body, placement(translation, rotation));
        placed.map_err(|error| errors::of_driving(&error))
    }

    #[doc = crate::stub!("Simulation.bring_body")]
    fn bring_body(
        &self,
        body: Body,
        translation: [f64; 3],
        rotation: [f64; 4],
        velocity: [f64; 3],
        spin: [f64; 3],
    ) -> PyResult<()> {
        let body = body.index(&self.of_scene.body_names)?;
        let to = brought_to(placement(translation, rotation), velocity, spin);
        let brought = self.simulation()?.bring_body(body, to);
        brought.map_err(|error| errors::of_driving(&error))
    }

    #[doc = crate::stub!("Simulation.teleport")]
    #[pyo3(signature = (bodies, translation=[0.0; 3], rotation=[0.0, 0.0, 0.0, 1.0], *, cloths=Vec::new()))]
    fn teleport(
        &self,
        py: Python<'_>,
        bodies: Vec<Body>,
        translation: [f64; 3],
        rotation: [f64; 4],
        cloths: Vec<Cloth>,
    ) -> PyResult<()> {
        let bodies = Body::indices(&bodies, &self.of_scene.body_names)?;
        let cloths = Cloth::indices(&cloths, &self.of_scene.cloth_names)?;
        let mut simulation = self.simulation()?;
        let teleported = simulation.teleport(&bodies, &cloths, placement(translation, rotation));
        teleported.map_err(|error| errors::of_teleport(&error))?;
        self.show(py, &simulation)
    }

    #[doc = crate::stub!("Simulation.placement")]
    fn placement(&self, body: Body) -> PyResult<Option<([f64; 3], [f64; 4])>> {
        let simulation = self.simulation()?;
        let placement = simulation.placement(body.index(&self.of_scene.body_names)?);
        Ok(placement.map(|placement| (placement.translation.to_array(), placement.rotation.to_array())))
    }

    #[doc = crate::stub!("Simulation.body_motion")]
    fn body_motion<'py>(&self, py: Python<'py>, body: Body) -> PyResult<Option<Bound<'py, PyAny>>> {
        let body = body.index(&self.of_scene.body_names)?;
        loads::of_free_body(py, &*self.simulation()?, body)
    }

    #[doc = crate::stub!("Simulation.proxy_load")]
    fn proxy_load<'py>(&self, py: Python<'py>, body: Body) -> PyResult<Option<Bound<'py, PyAny>>> {
        let load = self.simulation()?.proxy_load(body.index(&self.of_scene.body_names)?);
        load.map(|load| loads::wrench(py, load)).transpose()
    }

    #[doc = crate::stub!("Simulation.move_body")]
    fn move_body(&self, body: Body, positions: &Bound<'_, PyAny>) -> PyResult<()> {
        let positions = copied(positions)?;
        let body = body.index(&self.of_scene.body_names)?;
        let moved = self.simulation()?.move_body(body, &positions);
        moved.map_err(|error| errors::of_driving(&error))
    }

    #[doc = crate::stub!("Simulation.move_pins")]
    fn move_pins(&self, group: usize, positions: &Bound<'_, PyAny>) -> PyResult<()> {
        let positions = copied(positions)?;
        let moved = self.simulation()?.move_pins(group, &positions);
        moved.map_err(|error| errors::of_driving(&error))
    }

    #[doc = crate::stub!("Simulation.set_wind")]
    fn set_wind(&self, velocity: [f64; 3]) -> PyResult<()> {
        let set = self.simulation()?.set_wind(velocity.into());
        set.map_err(|error| errors::of_driving(&error))
    }

    #[doc = crate::stub!("Simulation.add_force")]
    fn add_force(&self, vertices: &Bound<'_, PyAny>, force: &Bound<'_, PyAny>) -> PyResult<()> {
        let vertices = whole_numbers(vertices, "vertices", self.known().cloth_vertices)?;
        loads::add_force(&mut *self.simulation()?, &vertices, force)
    }

    #[doc = crate::stub!("Simulation.body_load")]
    #[pyo3(signature = (body, about=[0.0; 3], *, mean=false))]
    fn body_load<'py>(&self, py: Python<'py>, body: Body, about: [f64; 3], mean: bool) -> PyResult<Bound<'py, PyAny>> {
        let body = body.index(&self.of_scene.body_names)?;
        loads::of_body(py, &*self.simulation()?, body, about.into(), mean)
    }

    #[doc = crate::stub!("Simulation.pin_load")]
    #[pyo3(signature = (group, about=[0.0; 3], *, mean=false))]
    fn pin_load<'py>(&self, py: Python<'py>, group: usize, about: [f64; 3], mean: bool) -> PyResult<Bound<'py, PyAny>> {
        loads::of_group(py, &*self.simulation()?, loads::PINS, (group, about.into()), mean)
    }

    #[doc = crate::stub!("Simulation.attachment_load")]
    #[pyo3(signature = (group, about=[0.0; 3], *, mean=false))]
    fn attachment_load<'py>(&self, py: Python<'py>, group: usize, about: [f64; 3], mean: bool) -> PyResult<Bound<'py, PyAny>> {
        loads::of_group(py, &*self.simulation()?, loads::ATTACHMENTS, (group, about.into()), mean)
    }

    #[doc = crate::stub!("Simulation.contact_loads")]
    fn contact_loads<'py>(&self, py: Python<'py>, body: Body) -> PyResult<Bound<'py, PyAny>> {
        let body = body.index(&self.of_scene.body_names)?;
        loads::of_contacts(py, &*self.simulation()?, body)
    }

    #[doc = crate::stub!("Simulation.unbalanced_force")]
    #[getter]
    fn unbalanced_force<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(loads::vector(py, self.simulation()?.unbalanced_force()))
    }

    #[doc = crate::stub!("Simulation.velocities")]
    #[getter]
    fn velocities<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        rows(py, self.simulation()?.velocities().iter().map(DVec3::to_array).collect())
    }

    #[doc = crate::stub!("Simulation.normals")]
    #[getter]
    fn normals<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let simulation = self.simulation()?;
        let mut normals = Vec::new();
        vertex_normals(simulation.positions(), simulation.triangles(), &mut normals);
        rows(py, normals.iter().map(DVec3::to_array).collect())
    }

    #[doc = crate::stub!("Simulation.near_pairs")]
    #[getter]
    fn near_pairs<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        show_near_pairs(py, &self.simulation()?.near_pairs().collect::<Vec<_>>())
    }

    #[doc = crate::stub!("Simulation.crossings")]
    #[getter]
    fn crossings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        show_crossings(py, self.simulation()?.crossings())
    }

    #[doc = crate::stub!("Simulation.tolerated_pairs")]
    #[getter]
    fn tolerated_pairs(&self) -> usize {
        self.known().tolerated_pairs
    }

    #[doc = crate::stub!("Simulation.untangled")]
    #[getter]
    fn untangled<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        show_untangled(py, self.simulation()?.untangled())
    }

    #[doc = crate::stub!("Simulation.released")]
    #[getter]
    fn released<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyAny>>> {
        show_released(py, &self.simulation()?.released())
    }

    #[doc = crate::stub!("Simulation.torn_edges")]
    #[getter]
    fn torn_edges<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyAny>>> {
        show_torn_edges(py, self.simulation()?.torn_edges())
    }

    #[doc = crate::stub!("Simulation.positions")]
    #[getter]
    fn positions(&self, py: Python<'_>) -> Py<PyAny> {
        self.view(py)
    }

    #[doc = crate::stub!("Simulation.faces")]
    #[getter]
    fn faces<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        rows(py, self.simulation()?.triangles().to_vec())
    }

    #[doc = crate::stub!("Simulation.loose_edges")]
    #[getter]
    fn loose_edges<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        rows(py, self.simulation()?.loose_edges().to_vec())
    }

    #[doc = crate::stub!("Simulation.mesh_in_files")]
    fn mesh_in_files<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let now = self.simulation()?.mesh_in_files();
        class(py, "MeshInFiles")?.call1((
            rows(py, now.mesh.positions.iter().map(DVec3::to_array).collect())?,
            rows(py, now.mesh.triangles)?,
            rows(py, now.loose_edges)?,
            PyArray1::from_vec(py, now.number_of),
        ))
    }

    #[doc = crate::stub!("Simulation.cloth_vertex_count")]
    #[getter]
    fn cloth_vertex_count(&self) -> usize {
        self.known().cloth_vertices
    }

    #[doc = crate::stub!("Simulation.cloth_face_count")]
    #[getter]
    const fn cloth_face_count(&self) -> usize {
        self.of_scene.cloth_triangles
    }

    #[doc = crate::stub!("Simulation.name")]
    #[getter]
    fn name(&self) -> &str {
        &self.of_scene.name
    }

    #[doc = crate::stub!("Simulation.time_step")]
    #[getter]
    const fn time_step(&self) -> f64 {
        self.of_scene.time_step
    }

    #[doc = crate::stub!("Simulation.steps")]
    #[getter]
    const fn steps(&self) -> Option<u64> {
        self.of_scene.steps
    }

    #[doc = crate::stub!("Simulation.steps_per_frame")]
    #[getter]
    const fn steps_per_frame(&self) -> u64 {
        self.of_scene.steps_per_frame
    }

    #[doc = crate::stub!("Simulation.settings")]
    #[getter]
    fn settings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.of_scene.settings.iter().into_py_dict(py)
    }

    #[doc = crate::stub!("Simulation.steps_done")]
    #[getter]
    fn steps_done(&self) -> u64 {
        self.known().steps_done
    }

    #[doc = crate::stub!("Simulation.time")]
    #[getter]
    fn time(&self) -> f64 {
        self.known().time
    }

    #[doc = crate::stub!("Simulation.lag")]
    #[getter]
    fn lag(&self) -> f64 {
        self.known().lag
    }

    #[doc = crate::stub!("Simulation.is_certified")]
    #[getter]
    fn is_certified(&self) -> bool {
        self.known().is_certified
    }

    #[doc = crate::stub!("Simulation.blocked_steps")]
    #[getter]
    fn blocked_steps(&self) -> u64 {
        self.known().blocked_steps
    }

    #[doc = crate::stub!("Simulation.overstretched_steps")]
    #[getter]
    fn overstretched_steps(&self) -> u64 {
        self.known().overstretched_steps
    }

    #[doc = crate::stub!("Simulation.edge_stretch")]
    #[getter]
    fn edge_stretch(&self) -> PyResult<(f64, f64)> {
        let stretch = self.simulation()?.edge_stretch();
        Ok((stretch.percentile_99, stretch.largest))
    }

    #[doc = crate::stub!("Simulation.effect_seconds")]
    #[getter]
    fn effect_seconds<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let simulation = self.simulation()?;
        let seconds = simulation.effects().iter().map(|effect| (effect.name, effect.seconds));
        seconds.into_py_dict(py)
    }

    #[doc = crate::stub!("Simulation.contact_counts")]
    #[getter]
    fn contact_counts<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        answers::show_contact_counts(py, self.simulation()?.contact_counts())
    }

    #[doc = crate::stub!("Simulation.contact_seconds")]
    #[getter]
    fn contact_seconds<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        answers::show_contact_seconds(py, self.simulation()?.contact_seconds())
    }

    #[doc = crate::stub!("Simulation.checkpoint")]
    fn checkpoint<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyBytes>>> {
        Ok(self.simulation()?.checkpoint().map(|bytes| PyBytes::new(py, &bytes)))
    }

    #[doc = crate::stub!("Simulation.resume")]
    fn resume(&self, py: Python<'_>, checkpoint: &[u8]) -> PyResult<()> {
        let mut simulation = self.simulation()?;
        simulation
            .resume(checkpoint)
            .map_err(|error| CheckpointError::new_err(error.to_string()))?;
        self.show(py, &simulation)
    }

    fn __repr__(&self) -> String {
        format!("<selvedge.Simulation '{}' at {:.6} s>", self.of_scene.name, self.known().time)
    }
}

fn slice_of<'py>(py: Python<'py>, vertices: &Range<usize>) -> Bound<'py, PySlice> {
    PySlice::new(py, vertices.start as isize, vertices.end as isize, 1)
}
