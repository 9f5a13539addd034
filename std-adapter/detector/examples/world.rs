//! Detects contacts between bodies that come and go, one of which rotates.

use selvedge::glam::{DQuat, DVec3};
use selvedge::{Groups, MeshMotion, Topology, World};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut world = World::<DVec3>::new();
    let floor = [
        DVec3::new(-9.0, -9.0, 0.0),
        DVec3::new(9.0, -9.0, 0.0),
        DVec3::new(0.0, 9.0, 0.0),
    ];
    let floor = world.insert(Topology::new(3, vec![[0, 1, 2]])?, &floor, Groups::ALL)?;
    let plank = [
        DVec3::new(-2.0, 0.1, 0.0),
        DVec3::new(-2.0, -0.1, 0.0),
        DVec3::new(2.0, 0.0, 0.0),
    ];
    let plank = world.insert(Topology::new(3, vec![[0, 1, 2]])?, &plank, Groups::ALL)?;

    // The plank tips over, by one radian about its middle. The floor rests.
    let start = (DQuat::IDENTITY, DVec3::Z);
    let end = (DQuat::from_rotation_y(1.0), DVec3::Z);
    let motions = [(plank, MeshMotion::Rigid { start, end })];
    let first = world.earliest(&motions)?.expect("its tip comes down");
    println!("meshes {} and {} touch at {}", first.meshes[0], first.meshes[1], first.time);

    world.remove(floor)?;
    assert!(world.is_free(&motions)?);
    Ok(())
}
