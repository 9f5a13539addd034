//! Collects steps of a simulation.

use super::Frames;
use selvedge::glam::DVec3;
use selvedge::{Mesh, Topology, TopologyError};
use selvedge_cloth::{Scene, Simulation};

/// Some of a simulation's steps, evenly spread over it. They contain its cloths without bodies. Cloth that tears counts as whole,
/// without the copies of its vertices.
///
/// They are collected while the simulation runs. [`observe`](Self::observe) sees each of its states:
///
/// ```
/// use selvedge_cloth::{Scene, Simulation};
/// use selvedge_laboratory::study::{Frames, SimulatedSteps};
/// # let text = r#"
/// # time_step = "2 ms"
/// # duration = "20 ms"
/// # [cloth]
/// # shape = "sheet"
/// # sides = { first = [0.3, 0, 0], second = [0, 0, 0.3] }
/// # cells = [10, 10]
/// # density = "200 g/m2"
/// # [effects.gravity]
/// # "#;
/// let scene = Scene::parse(text, "fall.toml".as_ref())?;
/// let mut frames = SimulatedSteps::new(&scene, 5)?;
/// let (steps, mut simulation) = (scene.steps(), Simulation::new(scene, 1)?);
/// frames.observe(&simulation);
/// for _ in 0..steps {
///     simulation.run()?;
///     frames.observe(&simulation);
/// }
/// assert_eq!((frames.step_count(), steps), (5, 10));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct SimulatedSteps {
    scene: String,
    topology: Topology,
    /// The number of the scene's steps.
    all: u64,
    /// The number of chosen steps.
    count: u64,
    /// The chosen steps so far, before and after. The last may still lack its end.
    steps: Vec<[Vec<DVec3>; 2]>,
}

impl SimulatedSteps {
    /// Prepares to keep `count` of the scene's steps, or all if it has fewer.
    ///
    /// # Errors
    /// Returns an error if the cloths together have too many triangles.
    pub fn new(scene: &Scene, count: usize) -> Result<Self, TopologyError> {
        let Mesh { positions, triangles } = scene.all_cloth();
        let topology = Topology::with_loose_features(positions.len(), triangles, &scene.all_loose_edges(), &[])?;
        Ok(Self {
            scene: scene.name.clone(),
            topology,
            all: scene.steps(),
            count: scene.steps().min(count as u64),
            steps: Vec::new(),
        })
    }

    /// Returns the number of the state after the chosen step `index`.
    fn end(&self, index: usize) -> u64 {
        // The product is in 128 bits, since both may be large.
        let end = (index as u128 + 1) * u128::from(self.all) / u128::from(self.count.max(1));
        end as u64
    }

    /// Observes a state: the start first, then the state after each step.
    pub fn observe(&mut self, simulation: &Simulation) {
        let done = simulation.runs_done();
        let as_made = |cloth| {
            let own = simulation.vertices_of_cloth(cloth).unwrap_or_default();
            &simulation.positions()[own.start..own.end - simulation.copied_vertices(cloth).len()]
        };
        let state = || {
            (0..simulation.cloth_names().len())
                .flat_map(as_made)
                .copied()
                .collect::<Vec<_>>()
        };
        if let Some(last) = self.steps.len().checked_sub(1)
            && self.steps[last][1].is_empty()
            && self.end(last) == done
        {
            self.steps[last][1] = state();
        }
        let next = self.steps.len();
        if (next as u64) < self.count && self.end(next) == done + 1 {
            self.steps.push([state(), Vec::new()]);
        }
    }
}

impl Frames for SimulatedSteps {
    fn name(&self) -> String {
        let (scene, count, all) = (&self.scene, self.step_count(), self.all);
        format!("{scene}, {count} of its {all} simulated steps")
    }

    fn topology(&self) -> &Topology {
        &self.topology
    }

    fn step_count(&self) -> usize {
        let complete = self.steps.iter().filter(|[_, end]| !end.is_empty());
        complete.count()
    }

    fn step(&self, step: usize, start: &mut Vec<DVec3>, end: &mut Vec<DVec3>) {
        let [before, after] = &self.steps[step];
        start.clone_from(before);
        end.clone_from(after);
    }
}
