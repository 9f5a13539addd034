//! The class `Detector`.

use crate::answers::{Columns, class, rows, show_contact, show_intersections};
use crate::arrays::{Frames, flags, indices, with_frames};
use crate::call::{Length, interruptible};
use crate::errors::{self, BrokenError, ForkedError, InputError};
use crate::finder::{Finder, Finders, Format, Part, SettingError, Settings, length};
use crate::intersections;
use numpy::IntoPyArray;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use selvedge::{Cancellation, CandidateBoxes, StepError, Topology};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, TryLockError};

/// Calls with so few pairs run on the caller's thread, where Ctrl-C takes effect when they end. This is usually after a
/// millisecond, and after a second if all pairs touch. A thread for each call would cost a third to a half of the time of small
/// meshes.
const FEW_PAIRS: usize = 1 << 22;

#[doc = crate::stub!("Detector")]
#[pyclass(frozen, module = "selvedge")]
pub(crate) struct Detector {
    topology: Arc<Topology>,
    length: Length,
    finders: Mutex<Finders>,
    /// The cancellation of the running call.
    asked: Mutex<Option<Cancellation>>,
    is_broken: AtomicBool,
}

fn setting_error(error: SettingError) -> PyErr {
    match error {
        SettingError::Step(error) => errors::of_step(&error),
        SettingError::Threads(error) => errors::of_threads(&error),
    }
}

impl Detector {
    fn finders(&self) -> PyResult<MutexGuard<'_, Finders>> {
        if self.is_broken.load(Ordering::Relaxed) {
            return Err(BrokenError::new_err(
                "a call on this detector failed because of a bug in Selvedge: create a new detector",
            ));
        }
        let finders = match self.finders.try_lock() {
            Ok(finders) => finders,
            Err(TryLockError::WouldBlock) => return Err(errors::busy()),
            // A panic is caught earlier and marks the detector.
            Err(TryLockError::Poisoned(poisoned)) => poisoned.into_inner(),
        };
        if finders.is_forked() {
            return Err(ForkedError::new_err(
                "the detector's threads are in the parent process: create a detector in the child, or start children by 'spawn'",
            ));
        }
        Ok(finders)
    }

    fn asked(&self) -> MutexGuard<'_, Option<Cancellation>> {
        self.asked.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Runs a question about the whole mesh on the detector of a format, without the interpreter lock.
    fn ask<S: Format, T: Send>(
        &self,
        py: Python<'_>,
        question: impl FnOnce(&mut Finder<S>) -> Result<T, StepError> + Send,
    ) -> PyResult<T> {
        self.ask_at_length(py, self.length, question)
    }

    fn ask_at_length<S: Format, T: Send>(
        &self,
        py: Python<'_>,
        length: Length,
        question: impl FnOnce(&mut Finder<S>) -> Result<T, StepError> + Send,
    ) -> PyResult<T> {
        let mut finders = self.finders()?;
        let finder = finders.of::<S>().map_err(setting_error)?;
        let cancellation = finder.detector.cancellation();
        *self.asked() = Some(cancellation.clone());
        let answer = interruptible(py, length, || cancellation.cancel(), || question(finder));
        *self.asked() = None;
        // It is kept for the next call, and no other reference remains.
        cancellation.reset();
        match answer? {
            Ok(answer) => answer.map_err(|error| errors::of_step(&error)),
            Err(words) => {
                self.is_broken.store(true, Ordering::Relaxed);
                Err(errors::broken(&words))
            }
        }
    }

    fn change(&self, part: Part, change: impl FnOnce(&mut Settings)) -> PyResult<()> {
        self.finders()?.change(part, change).map_err(setting_error)
    }

    fn columns<S: Format>(
        &self,
        py: Python<'_>,
        length: Length,
        [start, end]: [&[[S; 3]]; 2],
        geometry: bool,
        find: impl FnOnce(&mut Finder<S>) -> Result<(), StepError> + Send,
    ) -> PyResult<Columns<S>> {
        let topology = &*self.topology;
        self.ask_at_length(py, length, |finder: &mut Finder<S>| {
            find(finder)?;
            let Finder {
                detector,
                contacts,
                geometries,
            } = finder;
            if geometry {
                detector.contact_geometries(start, end, contacts, geometries)?;
            }
            Ok(Columns::of(contacts, topology, geometry.then_some(&geometries[..])))
        })
    }

    fn near_of<S: Format>(&self, py: Python<'_>, positions: &[[S; 3]], distance: f64) -> PyResult<Columns<S>> {
        self.ask(py, |finder: &mut Finder<S>| {
            finder.detector.near(positions, length(distance)?, &mut finder.geometries)?;
            Ok(Columns::at_rest(&finder.geometries))
        })
    }

    fn settings(&self) -> PyResult<Settings> {
        Ok(self.finders()?.settings.clone())
    }
}

fn step<'py>(start: &Bound<'py, PyAny>, end: &Bound<'py, PyAny>) -> PyResult<Frames<'py, 2>> {
    Frames::of([("start", start), ("end", end)])
}

/// Returns the expected length of a call about a mesh.
fn length_of(topology: &Topology) -> Length {
    let (vertices, faces) = (topology.vertex_count(), topology.triangles().len());
    let edges = topology.edges().len();
    let pairs = vertices.saturating_mul(faces).saturating_add(edges.saturating_mul(edges) / 2);
    length_of_pairs(pairs)
}

fn length_of_pairs(pairs: usize) -> Length {
    if pairs <= FEW_PAIRS { Length::Short } else { Length::Long }
}

#[pymethods]
impl Detector {
    #[new]
    #[pyo3(signature = (faces, vertex_count, threads=1, *, edges=None, points=None))]
    fn new(
        py: Python<'_>,
        faces: &Bound<'_, PyAny>,
        vertex_count: usize,
        threads: usize,
        edges: Option<&Bound<'_, PyAny>>,
        points: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let faces = indices::<3>(faces, "faces")?;
        let edges = edges
            .map(|edges| indices::<2>(edges, "edges"))
            .transpose()?
            .unwrap_or_default();
        let points = points
            .map(|points| indices::<1>(points, "points"))
            .transpose()?
            .unwrap_or_default();
        let topology = py.detach(|| {
            if edges.is_empty() && points.is_empty() {
                Topology::new(vertex_count, faces)
            } else {
                Topology::with_loose_features(vertex_count, faces, &edges, points.as_flattened())
            }
        });
        let topology = Arc::new(topology.map_err(errors::of_topology)?);
        let settings = Settings {
            threads,
            ..Settings::default()
        };
        Ok(Self {
            length: length_of(&topology),
            finders: Mutex::new(Finders::new(Arc::clone(&topology), settings).map_err(setting_error)?),
            topology,
            asked: Mutex::new(None),
            is_broken: AtomicBool::new(false),
        })
    }

    #[doc = crate::stub!("Detector.contacts")]
    #[pyo3(signature = (start, end, *, geometry=true))]
    fn contacts<'py>(
        &self,
        py: Python<'py>,
        start: &Bound<'py, PyAny>,
        end: &Bound<'py, PyAny>,
        geometry: bool,
    ) -> PyResult<Bound<'py, PyAny>> {
        with_frames!(step(start, end)?, [start, end] => {
            let (start, end) = (start.rows()?, end.rows()?);
            let find = |finder: &mut Finder<_>| finder.detector.contacts(start, end, &mut finder.contacts);
            self.columns(py, self.length, [start, end], geometry, find)?.show(py)
        })
    }

    #[doc = crate::stub!("Detector.contacts_of")]
    #[pyo3(signature = (start, end, vertex_face, edge_edge, *, geometry=true))]
    fn contacts_of<'py>(
        &self,
        py: Python<'py>,
        start: &Bound<'py, PyAny>,
        end: &Bound<'py, PyAny>,
        vertex_face: &Bound<'py, PyAny>,
        edge_edge: &Bound<'py, PyAny>,
        geometry: bool,
    ) -> PyResult<Bound<'py, PyAny>> {
        let vertex_face = indices::<2>(vertex_face, "vertex_face")?;
        let edge_edge = indices::<2>(edge_edge, "edge_edge")?;
        // The list may be longer than the mesh: it may repeat pairs.
        let length = length_of_pairs(vertex_face.len() + edge_edge.len());
        with_frames!(step(start, end)?, [start, end] => {
            let (start, end) = (start.rows()?, end.rows()?);
            let find = |finder: &mut Finder<_>| {
                finder.detector.contacts_of(start, end, &vertex_face, &edge_edge, &mut finder.contacts)
            };
            self.columns(py, length, [start, end], geometry, find)?.show(py)
        })
    }

    #[doc = crate::stub!("Detector.earliest")]
    fn earliest<'py>(
        &self,
        py: Python<'py>,
        start: &Bound<'py, PyAny>,
        end: &Bound<'py, PyAny>,
    ) -> PyResult<Option<Bound<'py, PyAny>>> {
        with_frames!(step(start, end)?, [start, end] => {
            let (start, end) = (start.rows()?, end.rows()?);
            let earliest = self.ask(py, |finder: &mut Finder<_>| finder.detector.earliest(start, end))?;
            earliest.map(|contact| show_contact(py, &contact, &self.topology)).transpose()
        })
    }

    #[doc = crate::stub!("Detector.is_free")]
    fn is_free(&self, py: Python<'_>, start: &Bound<'_, PyAny>, end: &Bound<'_, PyAny>) -> PyResult<bool> {
        with_frames!(step(start, end)?, [start, end] => {
            let (start, end) = (start.rows()?, end.rows()?);
            self.ask(py, |finder: &mut Finder<_>| finder.detector.is_free(start, end))
        })
    }

    #[doc = crate::stub!("Detector.candidates")]
    #[pyo3(signature = (start, end, *, swept=false))]
    fn candidates<'py>(
        &self,
        py: Python<'py>,
        start: &Bound<'py, PyAny>,
        end: &Bound<'py, PyAny>,
        swept: bool,
    ) -> PyResult<Bound<'py, PyAny>> {
        let boxes = if swept {
            CandidateBoxes::Swept
        } else {
            CandidateBoxes::Moving
        };
        let (vertex_face, edge_edge) = with_frames!(step(start, end)?, [start, end] => {
            let (start, end) = (start.rows()?, end.rows()?);
            self.ask(py, |finder: &mut Finder<_>| {
                let (mut vertex_face, mut edge_edge) = (Vec::new(), Vec::new());
                finder.detector.candidates(start, end, boxes, &mut vertex_face, &mut edge_edge)?;
                Ok((vertex_face, edge_edge))
            })
        })?;
        class(py, "CandidatePairs")?.call1((rows(py, vertex_face)?, rows(py, edge_edge)?))
    }

    #[doc = crate::stub!("Detector.intersections")]
    fn intersections<'py>(&self, py: Python<'py>, positions: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let found = with_frames!(Frames::of([("positions", positions)])?, [positions] => {
            let positions = positions.rows()?;
            self.ask(py, |finder: &mut Finder<_>| {
                let mut found = Vec::new();
                finder.detector.intersections(positions, &mut found)?;
                let points = intersections::points(&found, &self.topology, positions).collect();
                Ok((intersections::face_pairs(&found, &self.topology), points, found))
            })
        })?;
        let (faces, points, found) = found;
        show_intersections(py, &found, faces, points)
    }

    #[doc = crate::stub!("Detector.has_intersections")]
    fn has_intersections(&self, py: Python<'_>, positions: &Bound<'_, PyAny>) -> PyResult<bool> {
        with_frames!(Frames::of([("positions", positions)])?, [positions] => {
            let positions = positions.rows()?;
            self.ask(py, |finder: &mut Finder<_>| finder.detector.has_intersections(positions))
        })
    }

    #[doc = crate::stub!("Detector.near")]
    fn near<'py>(&self, py: Python<'py>, positions: &Bound<'py, PyAny>, distance: f64) -> PyResult<Bound<'py, PyAny>> {
        with_frames!(Frames::of([("positions", positions)])?, [positions] => {
            let positions = positions.rows()?;
            self.near_of(py, positions, distance)?.show(py)
        })
    }

    #[doc = crate::stub!("Detector.truncate")]
    fn truncate<'py>(
        &self,
        py: Python<'py>,
        start: &Bound<'py, PyAny>,
        wanted: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        with_frames!(Frames::of([("start", start), ("wanted", wanted)])?, [start, wanted] => {
            let (start, wanted) = (start.rows()?, wanted.rows()?);
            let (end, done) = self.ask(py, |finder: &mut Finder<_>| {
                let mut end = Vec::new();
                let done = finder.detector.truncate(start, wanted, &mut end)?;
                Ok((end, done))
            })?;
            class(py, "Truncation")?.call1((rows(py, end)?, done.held_back, done.in_contact, done.rounds))
        })
    }

    #[doc = crate::stub!("Detector.cancel")]
    fn cancel(&self) {
        if let Some(asked) = &*self.asked() {
            asked.cancel();
        }
    }

    #[doc = crate::stub!("Detector.set_threads")]
    fn set_threads(&self, py: Python<'_>, threads: usize) -> PyResult<()> {
        let mut finders = self.finders()?;
        let finders = &mut *finders;
        // Dropping the detectors waits for their threads to end.
        let changed = py.detach(|| finders.change(Part::Threads, |settings| settings.threads = threads));
        changed.map_err(setting_error)
    }

    #[doc = crate::stub!("Detector.set_limits")]
    #[pyo3(signature = (separation=0.0, tolerance=None, *, touching=false))]
    fn set_limits(&self, separation: f64, tolerance: Option<f64>, touching: bool) -> PyResult<()> {
        if touching && separation != 0.0 {
            return Err(InputError::new_err(
                "touching is decided exactly, without a distance: pass a separation of 0, or touching=False",
            ));
        }
        let limits = (separation, tolerance, touching);
        let mut finders = self.finders()?;
        let of = |settings: &Settings| (settings.separation, settings.tolerance, settings.touching);
        // The limits are set again before each call, so the other settings, with an entry per vertex, need no copy.
        if of(&finders.settings) == limits {
            return Ok(());
        }
        let change = |settings: &mut Settings| (settings.separation, settings.tolerance, settings.touching) = limits;
        finders.change(Part::Limits, change).map_err(setting_error)
    }

    #[doc = crate::stub!("Detector.set_moving")]
    #[pyo3(signature = (moving=None))]
    fn set_moving(&self, moving: Option<&Bound<'_, PyAny>>) -> PyResult<()> {
        let moving = moving.map(|moving| flags(moving, "moving")).transpose()?;
        self.change(Part::Moving, |settings| settings.moving = moving)
    }

    #[doc = crate::stub!("Detector.set_collision_filter")]
    #[pyo3(signature = (*, groups=None, patches=None, excluded=None))]
    fn set_collision_filter(
        &self,
        groups: Option<&Bound<'_, PyAny>>,
        patches: Option<&Bound<'_, PyAny>>,
        excluded: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let groups = groups.map(|groups| indices::<2>(groups, "groups")).transpose()?;
        let patches = patches.map(|patches| indices::<1>(patches, "patches")).transpose()?;
        let excluded = excluded.map(|excluded| indices::<2>(excluded, "excluded")).transpose()?;
        self.change(Part::Filter, |settings| {
            settings.groups = groups;
            settings.patches = patches.map(Vec::into_flattened);
            settings.excluded = excluded.unwrap_or_default();
        })
    }

    #[doc = crate::stub!("Detector.set_coherent")]
    fn set_coherent(&self, coherent: bool) -> PyResult<()> {
        self.change(Part::Coherent, |settings| settings.coherent = coherent)
    }

    #[doc = crate::stub!("Detector.set_pair_limit")]
    #[pyo3(signature = (limit=None))]
    fn set_pair_limit(&self, limit: Option<u64>) -> PyResult<()> {
        self.change(Part::PairLimit, |settings| settings.pair_limit = limit)
    }

    #[doc = crate::stub!("Detector.set_memory_limit")]
    #[pyo3(signature = (limit=Some(selvedge::DEFAULT_MEMORY_LIMIT)), text_signature = "($self, limit=2147483648)")]
    fn set_memory_limit(&self, limit: Option<u64>) -> PyResult<()> {
        self.change(Part::MemoryLimit, |settings| settings.memory_limit = limit)
    }

    #[doc = crate::stub!("Detector.vertex_count")]
    #[getter]
    fn vertex_count(&self) -> usize {
        self.topology.vertex_count()
    }

    #[doc = crate::stub!("Detector.faces")]
    #[getter]
    fn faces<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        rows(py, self.topology.triangles().to_vec())
    }

    #[doc = crate::stub!("Detector.edges")]
    #[getter]
    fn edges<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        rows(py, self.topology.edges().to_vec())
    }

    #[doc = crate::stub!("Detector.components")]
    #[getter]
    fn components<'py>(&self, py: Python<'py>) -> Bound<'py, PyAny> {
        self.topology.components().into_pyarray(py).into_any()
    }

    #[doc = crate::stub!("Detector.threads")]
    #[getter]
    fn threads(&self) -> PyResult<usize> {
        Ok(self.finders()?.of::<f64>().map_err(setting_error)?.detector.threads())
    }

    fn __repr__(&self) -> String {
        let topology = &self.topology;
        format!(
            "<selvedge.Detector of {} vertices, {} edges and {} faces>",
            topology.vertex_count(),
            topology.edges().len(),
            topology.triangles().len()
        )
    }

    /// Returns the arguments that create it again. Loose edges and points are faces already.
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyTuple>> {
        let (py, this) = (slf.py(), slf.get());
        let settings = this.settings()?;
        let made_of = (this.faces(py)?, this.vertex_count(), settings.threads);
        let state = PyDict::new(py);
        state.set_item("limits", (settings.separation, settings.tolerance, settings.touching))?;
        state.set_item("moving", settings.moving.map(|moving| moving.into_pyarray(py)))?;
        state.set_item("groups", settings.groups.map(|groups| rows(py, groups)).transpose()?)?;
        state.set_item("patches", settings.patches.map(|patches| patches.into_pyarray(py)))?;
        state.set_item("excluded", rows(py, settings.excluded)?)?;
        state.set_item("coherent", settings.coherent)?;
        state.set_item("pair_limit", settings.pair_limit)?;
        state.set_item("memory_limit", settings.memory_limit)?;
        (slf.get_type(), made_of, state).into_pyobject(py)
    }

    fn __setstate__(&self, state: &Bound<'_, PyDict>) -> PyResult<()> {
        let entry = |name: &str| {
            let entry = state.get_item(name)?;
            entry.ok_or_else(|| InputError::new_err(format!("the pickled detector has no {name}")))
        };
        let some = |name: &str| Ok::<_, PyErr>(Some(entry(name)?).filter(|entry| !entry.is_none()));
        let (separation, tolerance, touching) = entry("limits")?.extract()?;
        self.set_limits(separation, tolerance, touching)?;
        self.set_moving(some("moving")?.as_ref())?;
        let (groups, patches, excluded) = (some("groups")?, some("patches")?, some("excluded")?);
        self.set_collision_filter(groups.as_ref(), patches.as_ref(), excluded.as_ref())?;
        self.set_coherent(entry("coherent")?.extract()?)?;
        self.set_pair_limit(entry("pair_limit")?.extract()?)?;
        self.set_memory_limit(entry("memory_limit")?.extract()?)
    }
}
