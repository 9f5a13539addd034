//! Simulates the sheet that falls on a ball in Rapier. `../sheet_on_ball.py` runs this program and reads its output.
//!
//! ```text
//! selvedge-peer-rapier CELLS RADIUS TIME_STEP SECONDS MOST_PROCESSOR_SECONDS FOLDER
//! ```
//!
//! RADIUS is that of the sheet's particles, in metres. The program writes `triangles.u32` and the positions of every 50 ms in
//! `states.f32` (little endian) to the folder. It prints the number of steps, and their processor time.

use rapier3d::prelude::*;
use std::error::Error;
use std::fs::File;
use std::io::{BufWriter, Write};

/// The side of the sheet, in metres.
const SIDE: f32 = 0.8;
/// The mass of the sheet in kg: 150 g/m².
const MASS: f32 = 0.096;
const FRICTION: f32 = 0.3;
/// The interval between states, in seconds.
const INTERVAL: f32 = 0.05;

/// Returns the processor time of this process, in seconds.
fn processor_seconds() -> Result<f64, Box<dyn Error>> {
    let statistics = std::fs::read_to_string("/proc/self/schedstat")?;
    let nanoseconds: f64 = statistics.split(' ').next().unwrap_or_default().parse()?;
    Ok(nanoseconds * 1e-9)
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [cells, radius, time_step, seconds, most, folder] = &arguments[..] else {
        return Err("usage: selvedge-peer-rapier CELLS RADIUS TIME_STEP SECONDS MOST_PROCESSOR_SECONDS FOLDER".into());
    };
    let cells: usize = cells.parse()?;
    let [radius, time_step, seconds]: [f32; 3] = [radius.parse()?, time_step.parse()?, seconds.parse()?];
    let most: f64 = most.parse()?;

    let mut world = PhysicsWorld::new();
    world.gravity = Vector::new(0.0, 0.0, -9.81);
    world.integration_parameters.dt = time_step;
    world.integration_parameters.num_solver_iterations = 4;
    let ball = ColliderBuilder::ball(0.2).translation(Vector::new(0.03, 0.02, 0.0));
    world.insert(RigidBodyBuilder::fixed(), ball.friction(FRICTION));
    let spacing = SIDE / cells as f32;
    let mut material = SoftBodyMaterial::default();
    // The sheet is as stiff as the solver allows with steps of 1/240 s, and soft in bending.
    material.edge_softness = SpringCoefficients::new(60.0, 1.0);
    material.bend_softness = SpringCoefficients::new(1.0, 1.0);
    let corner = Vector::new(-0.4, -0.4, 0.35);
    let (first, second) = (Vector::new(spacing, 0.0, 0.0), Vector::new(0.0, spacing, 0.0));
    let sheet = SoftBodyBuilder::cloth(corner, first, second, cells + 1, cells + 1)
        .mass(MASS)
        .material(material)
        .self_contacts(true)
        .particle_radius(radius)
        .linear_damping(0.5)
        .can_sleep(false)
        .surface_collider(ColliderBuilder::ball(0.01).friction(FRICTION));
    let triangles = sheet.surface.clone();
    let sheet = world.insert_soft_body(sheet);

    let mut file = BufWriter::new(File::create(format!("{folder}/triangles.u32"))?);
    for vertex in triangles.iter().flatten() {
        file.write_all(&vertex.to_le_bytes())?;
    }
    file.flush()?;
    let mut states = BufWriter::new(File::create(format!("{folder}/states.f32"))?);
    let mut write = |world: &PhysicsWorld| -> std::io::Result<()> {
        for position in world.soft_bodies[sheet].particle_positions() {
            for coordinate in [position.x, position.y, position.z] {
                states.write_all(&coordinate.to_le_bytes())?;
            }
        }
        Ok(())
    };
    write(&world)?;
    let steps = (seconds / time_step).round() as usize;
    let every = ((INTERVAL / time_step).round() as usize).max(1);
    let (mut done, mut taken) = (0, 0.0);
    while done < steps && taken < most {
        let begin = processor_seconds()?;
        for _ in 0..every.min(steps - done) {
            world.step();
            done += 1;
        }
        taken += processor_seconds()? - begin;
        write(&world)?;
    }
    drop(write);
    states.flush()?;
    println!("{done} {taken}");
    Ok(())
}
