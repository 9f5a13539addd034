//! A sheet falls on a ball.
//!
//! ```text
//! cargo run --release -p selvedge-cloth --example sheet_on_a_ball
//! ```

use selvedge_cloth::effects::{BodyContact, Friction, Gravity, SelfCollision, Thickness};
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{Body, Cloth, Material, Scene, Simulation};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    // Units are metres, kilograms and seconds. The material sets density and stiffness.
    let corner = DVec3::new(-0.2, -0.2, 0.12);
    let mut sheet = Cloth::sheet(corner, [DVec3::X * 0.4, DVec3::Y * 0.4], [24, 24], 0.15)?;
    sheet.set_material(Material::COTTON);

    let mut scene = Scene::new(sheet, 1e-3);
    scene.bodies.push(Body::ball("ball", DVec3::ZERO, 0.1, 32)?);
    scene.add(Gravity::default()).add(Friction { coefficient: 0.3 });
    scene.add(BodyContact(Thickness::new(3e-3)));
    scene.add(SelfCollision(Thickness::new(3e-3)));

    let mut simulation = Simulation::new(scene, 0)?; // 0: a thread for each core
    for step in 1..=500 {
        simulation.step()?;
        if step % 100 == 0 {
            let stretch = simulation.edge_stretch().largest;
            println!(
                "{:.1} s: certified: {}, longest edge {stretch:.3}",
                simulation.time(),
                simulation.is_certified()
            );
        }
    }
    Ok(())
}
