//! Records a [`Simulation`]. Loose edges are recorded as [tubes](selvedge_cloth::Tubes): see [shown](super::shown).

use super::shown::ShownGeometry;
use super::{About, Added, Knob, Measure, MeasureKind, PartKind, RecordedPart, Recorder, Recording, RecordingError, SeriesKind};
use super::{EDGES_99, GRAVITATIONAL, LONGEST_EDGE};
use crate::report::{label, printed};
use crate::study::EffectCost;
use selvedge::Mesh;
use selvedge_cloth::{Scene, Simulation, TangledStart, Wrench};
use selvedge_core::glam::DVec3;

/// The description of a scene for a recording. It is taken before a [`Simulation`] consumes the scene.
#[derive(Clone, Debug)]
pub struct Subject {
    about: About,
    parts: Vec<RecordedPart>,
    /// The geometry of the cloths, if any has loose edges.
    shown: Vec<ShownGeometry>,
}

/// Names the measured costs of effects for a [`Recording`]'s `added`.
pub fn costs_of_added_effects(costs: &[EffectCost]) -> Vec<Added> {
    let named = |cost: &EffectCost| Added {
        name: label(cost.added.unwrap_or("no effect")),
        seconds: cost.seconds,
    };
    costs.iter().map(named).collect()
}

impl Subject {
    /// Takes the scene's text, its up direction, its cloths and its bodies, each as a part of its own.
    pub fn new(scene: &Scene) -> Self {
        let about = About {
            name: scene.name.clone(),
            scene: scene.text.clone(),
            up: scene.up,
            time_step: scene.time_of_run(),
            unit: if scene.by_frames { "frame" } else { "step" },
            fabric: scene
                .fabric()
                .into_iter()
                .map(|(name, value)| Knob::new(name, printed(&value)))
                .collect(),
            knobs: { scene.settings().into_iter() }
                .map(|(name, value)| Knob::new(label(&name), value))
                .collect(),
        };
        let bodies = scene.bodies.iter().map(|body| {
            let Mesh { positions, triangles } = &body.mesh;
            RecordedPart::new(&body.name, PartKind::Body, positions.len(), triangles.clone())
        });
        let shown: Vec<ShownGeometry> = (0..scene.cloths.len())
            .map(|index| ShownGeometry::new(scene, index))
            .collect();
        let cloths = scene.cloths.iter().zip(&shown).map(|(cloth, shown)| {
            let (vertices, triangles) = shown.mesh(cloth);
            RecordedPart::new(&cloth.name, PartKind::Cloth, vertices, triangles)
        });
        let parts = cloths.chain(bodies).collect();
        let has_loose_edges = !scene.all_loose_edges().is_empty();
        Self {
            about,
            parts,
            shown: if has_loose_edges { shown } else { Vec::new() },
        }
    }
}

/// A [`Recorder`] of a simulation. Its series are effects, and contacts if there are any; its measures are energy, stretch and
/// loads.
///
/// Tearing adds vertices to cloth; all frames have those of the end.
#[derive(Clone, Debug)]
pub struct SimulationRecorder {
    recorder: Recorder,
    measured: Vec<(String, MeasureKind)>,
    /// The number of copied vertices of each cloth.
    copied: Vec<usize>,
    /// The geometry of the cloths, if any has loose edges.
    shown: Vec<ShownGeometry>,
    /// The positions of all visible vertices in the last frame.
    positions: Vec<DVec3>,
}

impl SimulationRecorder {
    /// Begins with the present state and counters of the simulation of `subject`'s scene.
    ///
    /// # Errors
    /// Returns an error if a coordinate is not finite as an `f32`.
    ///
    /// # Panics
    /// Panics if the simulation has another number of vertices than the scene.
    pub fn new(subject: Subject, simulation: &Simulation) -> Result<Self, RecordingError> {
        let counters = counters(simulation, 0.0);
        let series: Vec<_> = counters.iter().map(|&(name, kind, _)| (name, kind)).collect();
        let Subject { about, parts, shown } = subject;
        let recorder = Recorder::new(about, parts, &series, &readings(simulation, 0.0));
        let measured: Vec<_> = measures(simulation).into_iter().map(|(name, kind, _)| (name, kind)).collect();
        let measures: Vec<_> = measured.iter().map(|(name, kind)| (&**name, *kind)).collect();
        let mut recorder = Self {
            recorder: recorder.with_measures(&measures),
            measured,
            copied: vec![0; simulation.cloth_names().len()],
            shown,
            positions: Vec::new(),
        };
        recorder.frame(simulation)?;
        Ok(recorder)
    }

    /// Records the counts and times of the last step. `seconds` is its wall-clock time.
    pub fn step(&mut self, simulation: &Simulation, seconds: f64) {
        self.follow_tears(simulation);
        self.recorder.step(&readings(simulation, seconds));
    }

    /// Gives cloths the vertices that the simulation has added.
    fn follow_tears(&mut self, simulation: &Simulation) {
        for (cloth, known) in self.copied.iter_mut().enumerate() {
            let copied = simulation.copied_vertices(cloth);
            let own = simulation.vertices_of_cloth(cloth).filter(|_| copied.len() > *known);
            if let Some(own) = own {
                let shown = self.shown.get(cloth);
                let placed = |vertex: u32| shown.map_or(vertex, |shown| shown.place_of(vertex));
                let triangles = simulation.triangles()[..simulation.cloth_triangles()].iter();
                let triangles = triangles.filter(|triangle| own.contains(&(triangle[0] as usize)));
                let mut triangles: Vec<[u32; 3]> = triangles
                    .map(|triangle| triangle.map(|vertex| placed(vertex - own.start as u32)))
                    .collect();
                if let Some(shown) = shown {
                    shown.add_tubes(&mut triangles);
                }
                let copies: Vec<u32> = copied[*known..].iter().map(|&vertex| placed(vertex)).collect();
                self.recorder.split(cloth, &copies, triangles);
                *known = copied.len();
            }
        }
    }

    /// Offers the state as a frame, and measures its energy, the stretch of the cloth, and loads.
    ///
    /// # Errors
    /// Returns an error if a coordinate is not finite as an `f32`.
    pub fn frame(&mut self, simulation: &Simulation) -> Result<(), RecordingError> {
        let step = simulation.runs_done();
        self.follow_tears(simulation);
        let mut positions = simulation.positions();
        if !self.shown.is_empty() {
            self.positions.clear();
            for (cloth, shown) in self.shown.iter().enumerate() {
                if let Some(own) = simulation.vertices_of_cloth(cloth) {
                    shown.place(&positions[own], &mut self.positions);
                }
            }
            self.positions.extend_from_slice(&positions[simulation.cloth_vertices()..]);
            positions = &self.positions;
        }
        self.recorder.frame(step, positions)?;
        let now = measures(simulation);
        // A balloon that has burst holds no pressure and no energy.
        let value = |(wanted, of): &(String, MeasureKind)| {
            now.iter()
                .find(|(name, kind, _)| name == wanted && kind == of)
                .map_or(0.0, |(_, _, value)| *value)
        };
        let values: Vec<f64> = self.measured.iter().map(value).collect();
        self.recorder.measure(step, &values);
        Ok(())
    }

    /// Returns the recording so far as bytes. `seconds` is the wall-clock time so far.
    pub fn save(&self, seconds: f64) -> Vec<u8> {
        self.recorder.save(seconds)
    }

    /// Continues a recording that another recorder of the same simulation has [saved](Self::save), and returns its seconds.
    /// `simulation` must have resumed from a checkpoint of the same step. Returns `None`, and changes nothing, if the bytes are
    /// damaged, or belong to other series or another number of vertices.
    pub fn restore(&mut self, bytes: &[u8], simulation: &Simulation) -> Option<f64> {
        let mut restored = self.clone();
        restored.follow_tears(simulation);
        let seconds = restored.recorder.restore(bytes)?;
        *self = restored;
        Some(seconds)
    }

    /// Adds a sentence for readers.
    pub fn remark(&mut self, sentence: impl Into<String>) {
        self.recorder.remark(sentence);
    }

    /// Ends the recording, without the loads of what the cloth never loads. `seconds` is the wall-clock time of the steps.
    pub fn finish(self, seconds: f64) -> Recording {
        let mut recording = self.recorder.finish(Some(seconds));
        let lost = lost(&recording);
        let kinds = recording.measures_of(MeasureKind::Energy).count();
        recording.measures.insert(kinds, lost);
        let measures = &mut recording.measures;
        measures.retain(|measure| measure.kind != MeasureKind::Load || measure.largest > 0.0);
        recording
    }
}

/// Returns all counters and times of a simulation, one for each series.
fn counters(simulation: &Simulation, seconds: f64) -> Vec<(&'static str, SeriesKind, f64)> {
    let effects = simulation.effects().iter();
    let mut counters: Vec<_> = effects
        .map(|effect| (effect.name, SeriesKind::Effect, effect.seconds))
        .collect();
    let mut add = |kind, named: &[(&'static str, f64)]| {
        counters.extend(named.iter().map(|&(name, reading)| (name, kind, reading)));
    };
    let number = |(name, count)| (name, count as f64);
    if let Some(counts) = simulation.contact_counts() {
        add(SeriesKind::Pairs, &counts.pairs().map(number));
        add(SeriesKind::Events, &counts.events().map(number));
        let blocked = ("steps blocked", simulation.blocked_steps());
        add(SeriesKind::Events, &[blocked].map(number));
    }
    if simulation.longest_over_limit().is_some() {
        let steps = ("steps beyond the limit", simulation.overstretched_steps());
        add(SeriesKind::Events, &[steps].map(number));
    }
    if simulation.effects().iter().any(|effect| effect.name == "tearing") {
        add(
            SeriesKind::Events,
            &[number(("edges torn", simulation.torn_edges().len() as u64))],
        );
    }
    if simulation.tangled_start() == TangledStart::Tolerate {
        let crossings = ("edges through faces, tolerated", simulation.crossings().len() as f64);
        let pairs = ("pairs out of the promise", simulation.tolerated_pairs() as f64);
        add(SeriesKind::Gauge(""), &[crossings, pairs]);
    }
    add(SeriesKind::Stage, &[("solve", simulation.solve_seconds())]);
    if let Some(seconds) = simulation.contact_seconds() {
        add(SeriesKind::Stage, &seconds.stages());
    }
    counters.push(("whole step", SeriesKind::Step, seconds));
    counters
}

/// Returns the readings, in the order of the series.
fn readings(simulation: &Simulation, seconds: f64) -> Vec<f64> {
    let counters = counters(simulation, seconds).into_iter();
    counters.map(|(_, _, reading)| reading).collect()
}

/// Returns all measures of a state; kinds of energy come first.
fn measures(simulation: &Simulation) -> Vec<(String, MeasureKind, f64)> {
    let energy = simulation.energy();
    let kinds = [
        ("kinetic", Some(energy.kinetic)),
        ("elastic", energy.elastic()),
        (GRAVITATIONAL, energy.gravitational()),
    ];
    let kinds = kinds
        .into_iter()
        .filter_map(|(name, joules)| Some((name, MeasureKind::Energy, joules?)));
    let effects = energy.stored.iter();
    let effects = effects.map(|(name, stored)| (*name, MeasureKind::EffectEnergy, stored.joules()));
    let stretch = simulation.edge_stretch();
    let stretch = [
        (EDGES_99, MeasureKind::Stretch, stretch.percentile_99),
        (LONGEST_EDGE, MeasureKind::Stretch, stretch.largest),
    ];
    let named = kinds.chain(effects).chain(stretch);
    named
        .map(|(name, kind, value)| (name.to_owned(), kind, value))
        .chain(loads(simulation))
        .collect()
}

/// Returns the force on each body and on each group of pins and attachments.
fn loads(simulation: &Simulation) -> Vec<(String, MeasureKind, f64)> {
    let about = DVec3::ZERO;
    let bodies = simulation.body_names().iter().enumerate();
    let bodies = bodies.filter_map(|(body, name)| Some((name.clone(), simulation.mean_body_load(body, about)?.total())));
    let groups = |what: &'static str, load: fn(&Simulation, usize, DVec3) -> Option<Wrench>| {
        (0..).map_while(move |group| Some((format!("{what}, group {group}"), load(simulation, group, about)?)))
    };
    bodies
        .chain(groups("pins", Simulation::mean_pin_load))
        .chain(groups("attachments", Simulation::mean_attachment_load))
        .map(|(name, load)| (name, MeasureKind::Load, load.force.length()))
        .collect()
}

/// Returns the energy drop since the start. It is below zero if moving bodies and wind have added more than was lost.
fn lost(recording: &Recording) -> Measure {
    let energies: Vec<_> = recording.measures_of(MeasureKind::Energy).collect();
    let total = |k: usize| -> f64 { energies.iter().map(|energy| energy.values[k]).sum() };
    let steps = &recording.measured_steps;
    let values: Vec<f64> = (0..steps.len()).map(|k| total(0) - total(k)).collect();
    let largest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let at = values.iter().position(|&value| value == largest);
    Measure {
        name: "lost".to_owned(),
        kind: MeasureKind::Energy,
        largest,
        largest_step: at.map_or(0, |at| steps[at]),
        values,
    }
}
