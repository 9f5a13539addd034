//! Makes a simulation from a scene.

use super::added_forces::AddedForces;
use super::assembly::Assembly;
use super::errors::SetupError;
use super::loads::Loads;
use super::measures::EffectTime;
use super::simulation::{Simulation, Work};
use super::state::State;
use super::tangled::UntanglingProgress;
use super::tearing::Tearing;
use crate::model::step::FREE;
use crate::scene::{Scene, TangledStart};
use crate::world::{Cloth, FileNumbering, Kinematic, Pose};
use selvedge::Threads;
use selvedge::parallel::Workers;
use selvedge_core::glam::DVec3;

impl Simulation {
    /// Sets a scene up, on `threads` threads (0: one for each core). The number of threads changes no bit of the result.
    ///
    /// # Errors
    /// Returns an error if the scene is not valid or starts with an intersection, or the operating system refuses the threads.
    pub fn new(scene: Scene, threads: usize) -> Result<Self, SetupError> {
        Self::with_progress(scene, threads, &mut |_| ())
    }

    /// Sets a scene up like [`new`](Self::new). If the scene is [to be untangled](TangledStart::Untangle), calls `tell` with the
    /// progress before each of its steps.
    ///
    /// # Errors
    /// Returns the errors of [`new`](Self::new).
    pub fn with_progress(
        scene: Scene,
        threads: usize,
        tell: &mut (dyn FnMut(UntanglingProgress) + Send),
    ) -> Result<Self, SetupError> {
        scene.check()?;
        let fingerprint = scene.fingerprint();
        let threads = Workers::new(Threads::from_count(threads))?;
        let mut made = Assembly::of(&scene)?;
        let (carried, state) = at_start(&scene, &mut made);
        let Scene {
            bodies,
            cloths,
            time_step,
            tangled_start,
            ..
        } = &scene;
        let (time_step, tangled_start) = (*time_step, *tangled_start);
        let spacing = cloths.iter().map(mesh_spacing).fold(f64::INFINITY, f64::min);
        let effects = made.effects.iter().map(|&name| EffectTime { name, seconds: 0.0 }).collect();
        let mut simulation = Self {
            name: scene.name.clone(),
            time_step,
            frame: scene.by_frames.then(|| scene.time_of_run()),
            is_fresh: true,
            on_blocked: scene.on_blocked,
            tangled_start,
            body_names: bodies.iter().map(|body| body.name.clone()).collect(),
            fingerprint,
            numbering: FileNumbering::new(cloths.iter().map(|cloth| cloth.file.clone())),
            cloth_names: cloths.iter().map(|cloth| cloth.name.clone()).collect(),
            effects,
            threads,
            state,
            work: Work::default(),
            loads: Loads::new(&made.supports, bodies.len()),
            added_forces: AddedForces::default(),
            carried,
            untangled: None,
            waiting: None,
            tearing: (!made.tearable.is_empty()).then(|| Box::new(Tearing::new(scene))),
            made,
        };
        let crossings = simulation.begin_contact()?;
        if tangled_start == TangledStart::Refuse && !crossings.is_empty() {
            return Err(simulation.tangled(crossings, None));
        }
        if tangled_start == TangledStart::Untangle && !simulation.is_apart() {
            let untangled = simulation.untangle(spacing, tell);
            simulation.check_untangled(untangled)?;
        }
        Ok(simulation)
    }
}

/// Returns the points that motions carry, before they do, and the state at the start.
fn at_start(scene: &Scene, made: &mut Assembly) -> (Vec<DVec3>, State) {
    let Assembly {
        cloth_vertices,
        vertices_of_cloths,
        rest,
        carriers,
        motions,
        ..
    } = made;
    let poses: Vec<Pose> = motions.iter().map(|motion| motion.pose(0.0)).collect();
    let mut carried = rest.clone();
    for (cloth, vertices) in scene.cloths.iter().zip(&*vertices_of_cloths) {
        carried[vertices.clone()].copy_from_slice(cloth.start());
    }
    for (point, &carrier) in carried[..*cloth_vertices].iter_mut().zip(&*carriers) {
        // Pins that follow a driven body start where the cloth is, wherever that body is.
        let body = motions
            .get(carrier as usize)
            .filter(|_| (carrier as usize) < scene.bodies.len());
        if let Some(standing) = body.and_then(Kinematic::driven).and_then(|driven| driven.placement) {
            *point = standing.apply_inverse(*point);
        }
    }
    let start = carried
        .iter()
        .zip(&*carriers)
        .map(|(&point, &carrier)| poses.get(carrier as usize).map_or(point, |pose| pose.apply(point)));
    let mut positions: Vec<DVec3> = start.collect();
    motions.iter_mut().for_each(|motion| motion.put(0.0, &mut positions));
    let mut velocities = vec![DVec3::ZERO; rest.len()];
    for (cloth, vertices) in scene.cloths.iter().zip(&*vertices_of_cloths) {
        let free = vertices.clone().filter(|&vertex| carriers[vertex] == FREE);
        free.for_each(|vertex| velocities[vertex] = cloth.velocity);
    }
    let state = State {
        step: 0,
        blocked_steps: 0,
        overstretched_steps: 0,
        before: 0.0,
        since: 0,
        clock: 0.0,
        velocities,
        positions,
    };
    (carried, state)
}

/// Returns the typical distance of vertices in metres: of its triangles, or of its loose edges if it has no triangles.
fn mesh_spacing(cloth: &Cloth) -> f64 {
    let at = |v: u32| cloth.mesh.positions[v as usize];
    let edges = cloth.topology.loose_edges();
    if !cloth.has_triangles() {
        let count = edges.len() as f64;
        return edges.map(|[a, b]| at(a).distance(at(b))).sum::<f64>() / count;
    }
    let area = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(at);
        0.5 * (b - a).cross(c - a).length()
    };
    let area: f64 = cloth.mesh.triangles.iter().map(area).sum();
    let mut is_of_triangle = vec![!cloth.has_loose_edges(); cloth.mesh.positions.len()];
    if cloth.has_loose_edges() {
        let corners = cloth.mesh.triangles.iter().flatten();
        corners.for_each(|&vertex| is_of_triangle[vertex as usize] = true);
    }
    let vertices = is_of_triangle.into_iter().filter(|own| *own).count();
    (area / vertices as f64).sqrt()
}
