//! The caller moves a ball under a hanging sheet.
//!
//! ```text
//! cargo run --release -p selvedge-cloth --example driven_body
//! ```

use selvedge_cloth::effects::{BodyContact, Gravity, PinGroup, Pins, SelfCollision, Stretch, Thickness};
use selvedge_cloth::glam::{DQuat, DVec3};
use selvedge_cloth::{Body, BodyMotion, Cloth, OnBlocked, Placement, Scene, Simulation};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let corner = DVec3::new(-0.15, -0.15, 0.0);
    let sheet = Cloth::sheet(corner, [DVec3::X * 0.3, DVec3::Y * 0.3], [20, 20], 0.2)?;
    let mut scene = Scene::new(sheet.named("sheet"), 2e-3);
    let sides: Vec<u32> = ["left", "right"]
        .iter()
        .filter_map(|side| scene.part("sheet", side))
        .flatten()
        .collect();
    scene.add(Pins {
        groups: vec![PinGroup::resting(sides)],
    });
    scene.add(Gravity::default()).add(Stretch::isotropic(300.0));
    scene.add(BodyContact(Thickness::new(4e-3)));
    scene.add(SelfCollision(Thickness::new(4e-3)));

    let start = Placement::at(DVec3::Z * -0.1);
    let mut ball = Body::ball("ball", DVec3::ZERO, 0.05, 24)?;
    ball.motion = BodyMotion::Driven(start);
    scene.bodies.push(ball);
    scene.on_blocked = OnBlocked::Hold; // if the ball is forced through the cloth it waits

    let mut simulation = Simulation::new(scene, 0)?;
    for step in 1..=250 {
        // The ball has this position at the end of the step.
        let time = 2e-3 * f64::from(step);
        let goal = Placement::new(DQuat::from_rotation_z(time), start.translation + DVec3::Z * (0.3 * time));
        simulation.place_body(0, goal)?;
        simulation.step()?;
    }
    let highest = simulation.positions()[..21 * 21].iter().map(|p| p.z).fold(f64::MIN, f64::max);
    println!(
        "the ball lifted the sheet to {highest:.3} m; it waited for {:.3} s",
        simulation.lag()
    );
    Ok(())
}
