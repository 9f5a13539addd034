//! Detectors for both formats of positions, with the same settings.

use numpy::Element;
use selvedge::core::elementary::Limits;
use selvedge::core::narrowing::rounded_up;
use selvedge::{
    CollisionDetector, CollisionFilter, Contact, ContactGeometry, Criterion, DEFAULT_MEMORY_LIMIT, Groups, Scalar, StepError,
    ThreadError, Threads, Topology,
};
use std::sync::Arc;

/// The settings of a detector; they pickle.
#[derive(Clone)]
pub(crate) struct Settings {
    pub(crate) threads: usize,
    pub(crate) separation: f64,
    pub(crate) tolerance: Option<f64>,
    pub(crate) touching: bool,
    pub(crate) moving: Option<Vec<bool>>,
    pub(crate) groups: Option<Vec<[u32; 2]>>,
    pub(crate) patches: Option<Vec<u32>>,
    pub(crate) excluded: Vec<[u32; 2]>,
    pub(crate) coherent: bool,
    pub(crate) pair_limit: Option<u64>,
    pub(crate) memory_limit: Option<u64>,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            threads: 1,
            separation: 0.0,
            tolerance: None,
            touching: false,
            moving: None,
            groups: None,
            patches: None,
            excluded: Vec::new(),
            coherent: false,
            pair_limit: None,
            memory_limit: Some(DEFAULT_MEMORY_LIMIT),
        }
    }
}

/// The settings that are passed together.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Part {
    Threads,
    Limits,
    Moving,
    Filter,
    Coherent,
    PairLimit,
    MemoryLimit,
}

const PARTS: [Part; 7] = [
    Part::Threads,
    Part::Limits,
    Part::Moving,
    Part::Filter,
    Part::Coherent,
    Part::PairLimit,
    Part::MemoryLimit,
];

pub(crate) enum SettingError {
    Step(StepError),
    Threads(ThreadError),
}

impl From<StepError> for SettingError {
    fn from(error: StepError) -> Self {
        Self::Step(error)
    }
}

impl From<ThreadError> for SettingError {
    fn from(error: ThreadError) -> Self {
        Self::Threads(error)
    }
}

/// Rounds a length up to the format of the positions, so that the requested distance is kept.
pub(crate) fn length<S: Scalar>(given: f64) -> Result<S, StepError> {
    if given >= 0.0 && given.is_finite() {
        Ok(rounded_up(given))
    } else {
        Err(StepError::BadLimit { length: given })
    }
}

pub(crate) fn limits<S: Scalar>(separation: f64, tolerance: Option<f64>) -> Result<Limits<S>, StepError> {
    let tolerance = tolerance.map(length).transpose()?;
    Ok(Limits {
        separation: length(separation)?,
        tolerance: tolerance.unwrap_or(Limits::default().tolerance),
    })
}

/// A detector for one format of positions, with buffers for its results.
pub(crate) struct Finder<S: Scalar> {
    pub(crate) detector: CollisionDetector<S>,
    pub(crate) contacts: Vec<Contact<S>>,
    pub(crate) geometries: Vec<ContactGeometry>,
}

impl<S: Scalar> Finder<S> {
    fn new(topology: Arc<Topology>, settings: &Settings) -> Result<Self, SettingError> {
        let mut made = Self {
            detector: CollisionDetector::new(topology),
            contacts: Vec::new(),
            geometries: Vec::new(),
        };
        PARTS.into_iter().try_for_each(|part| made.apply(settings, part))?;
        Ok(made)
    }

    fn apply(&mut self, settings: &Settings, part: Part) -> Result<(), SettingError> {
        let detector = &mut self.detector;
        match part {
            Part::Threads => detector.set_threads(Threads::from_count(settings.threads))?,
            Part::Limits => {
                let limits = limits(settings.separation, settings.tolerance)?;
                let tolerance = limits.tolerance;
                let criterion = if settings.touching {
                    Criterion::Touching { tolerance }
                } else {
                    Criterion::Within(limits)
                };
                detector.set_criterion(criterion)?;
            }
            Part::Moving => detector.set_moving(settings.moving.as_deref())?,
            Part::Filter => {
                let mut filter = CollisionFilter::new();
                if let Some(groups) = &settings.groups {
                    let groups = groups.iter().map(|&[memberships, filter]| Groups::new(memberships, filter));
                    filter = filter.with_groups(groups.collect());
                }
                if let Some(patches) = &settings.patches {
                    filter = filter.with_patches(patches.clone());
                }
                detector.set_collision_filter(filter.without_vertex_pairs(settings.excluded.iter().copied()))?;
            }
            Part::Coherent => detector.set_coherent(settings.coherent),
            Part::PairLimit => detector.set_pair_limit(settings.pair_limit),
            Part::MemoryLimit => detector.set_memory_limit(settings.memory_limit),
        }
        Ok(())
    }
}

/// The detectors for both formats. The one for `f64` always exists; the one for `f32` is created when it is needed.
pub(crate) struct Finders {
    topology: Arc<Topology>,
    pub(crate) settings: Settings,
    single: Option<Finder<f32>>,
    double: Option<Finder<f64>>,
    /// The process that started their threads, if they have any.
    threads_of: Option<u32>,
}

pub(crate) trait Format: Scalar + Element {
    fn finder(finders: &mut Finders) -> &mut Option<Finder<Self>>;
}

impl Format for f32 {
    fn finder(finders: &mut Finders) -> &mut Option<Finder<Self>> {
        &mut finders.single
    }
}

impl Format for f64 {
    fn finder(finders: &mut Finders) -> &mut Option<Finder<Self>> {
        &mut finders.double
    }
}

impl Finders {
    pub(crate) fn new(topology: Arc<Topology>, settings: Settings) -> Result<Self, SettingError> {
        let mut made = Self {
            topology,
            threads_of: (settings.threads != 1).then(std::process::id),
            settings,
            single: None,
            double: None,
        };
        made.of::<f64>()?;
        Ok(made)
    }

    pub(crate) fn of<S: Format>(&mut self) -> Result<&mut Finder<S>, SettingError> {
        if S::finder(self).is_none() {
            let made = Finder::new(Arc::clone(&self.topology), &self.settings)?;
            *S::finder(self) = Some(made);
        }
        Ok(S::finder(self).as_mut().expect("it was made"))
    }

    /// Returns whether the threads stayed behind in a parent process. Waiting for them would never end.
    pub(crate) fn is_forked(&self) -> bool {
        self.threads_of.is_some_and(|process| process != std::process::id())
    }

    /// Changes a part of the settings, or none of them.
    pub(crate) fn change(&mut self, part: Part, change: impl FnOnce(&mut Settings)) -> Result<(), SettingError> {
        let mut settings = self.settings.clone();
        change(&mut settings);
        if let Err(error) = self.apply(&settings, part) {
            // The old settings were valid, but new threads may be refused; the detectors then keep the threads they have.
            let former = self.settings.clone();
            let _ = self.apply(&former, part);
            return Err(error);
        }
        if part == Part::Threads {
            self.threads_of = (settings.threads != 1).then(std::process::id);
        }
        self.settings = settings;
        Ok(())
    }

    fn apply(&mut self, settings: &Settings, part: Part) -> Result<(), SettingError> {
        if let Some(double) = &mut self.double {
            double.apply(settings, part)?;
        }
        self.single.as_mut().map_or(Ok(()), |single| single.apply(settings, part))
    }
}

impl Drop for Finders {
    fn drop(&mut self) {
        if self.is_forked() {
            // The threads do not exist in this process, so they cannot be stopped. Their memory belongs to the parent.
            std::mem::forget((self.single.take(), self.double.take()));
        }
    }
}
