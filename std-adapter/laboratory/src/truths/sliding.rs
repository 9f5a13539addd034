//! Friction: an inclined plane, Coulomb's law in all directions, and a rope around a cylinder.

use super::conditions::{Conditions, regular};
use super::run::Run;
use super::setting::{DENSITY, G, contact, elastic, irregular_body, middle, weightless};
use super::stepping::falling;
use super::{ErrorUnit, Failure, Law, Outcome, Sample};
use selvedge_cloth::effects::{
    AirDrag, BodyContact, Effect, Force, Friction, Gravity, PinGroup, PinMotion, Pins, Plan, RopeStretch, Thickness, TimeStep,
};
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{Body, Cloth, Interpolation, Keyframe, KeyframeMotion};
use std::f64::consts::{FRAC_PI_4, PI};

const THICKNESS: f64 = 3e-3;
const TIME: f64 = 0.48;

/// Sets up a sheet on a plane of irregular triangles through the origin, `cells` of them across and five times as many along. A
/// plane of one cell has two triangles.
fn on_plane([down, normal]: [DVec3; 2], acceleration: DVec3, friction: f64, conditions: &Conditions) -> Result<Run, Failure> {
    let cells = conditions.grid.number;
    let across = normal.cross(down);
    let corner = -0.15 * (down + across) + 1.01 * THICKNESS * normal;
    let mut scene = weightless(Cloth::sheet(corner, [0.3 * down, 0.3 * across], [6; 2], DENSITY)?);
    scene.bodies.push(irregular_body(
        "plane",
        [10.0 * down, 2.0 * across],
        [if cells == 1 { 1 } else { 5 * cells }, cells],
    )?);
    scene.add(Gravity { acceleration });
    elastic(&mut scene, 400.0, 15e-6);
    contact(&mut scene, THICKNESS, friction);
    Run::new(scene, conditions)
}

pub(super) const INCLINED_PLANE: Law = Law {
    name: "inclined_plane",
    statement: "A sheet slides down a slope of 20° without friction by s = ½·g·sin α·t², whatever the slope's triangles",
    axes: ["time, s", "path, m"],
    error: ErrorUnit::Of("the path"),
    mesh: "cells of the plane across",
    meshes: &[regular(1), regular(10), regular(80)],
    remark: "The planes have 2, 1,000 and 64,000 triangles. Steps of h of what something presses give ½·a·t·(t + h). Motion to the side and above the thickness count as errors too.",
    simulate: |conditions| {
        let (sine, cosine) = f64::to_radians(20.0).sin_cos();
        let [down, normal] = [DVec3::new(cosine, 0.0, -sine), DVec3::new(sine, 0.0, cosine)];
        let mut run = on_plane([down, normal], -G * DVec3::Z, 0.0, conditions)?;
        let start = middle(&run);
        let samples = run.over_time(TIME, |run, time| {
            let way = middle(run) - start;
            Sample {
                exact: 0.5 * G * sine * time * time,
                predicted: Some(falling(G * sine).pressed(run.steps())[0]),
                simulated: way.dot(down),
                aside: way.y.hypot(middle(run).dot(normal) - THICKNESS),
                ..Sample::default()
            }
        })?;
        Ok(Outcome {
            samples,
            scale: 0.5 * G * sine * TIME * TIME,
        })
    },
};

pub(super) const COULOMB: Law = Law {
    name: "coulomb",
    statement: "Under a gravity that leans by 0.3 rad in any direction, a sheet slides that way with a = g·(sin α − μ·cos α)⁺",
    axes: ["coefficient of friction μ", "path, m"],
    error: ErrorUnit::Of("the path without friction"),
    mesh: "cells of the plane across",
    meshes: &[regular(1), regular(10), regular(40)],
    remark: "Each coefficient has a direction of its own. Steps of h of what something presses give ½·a·t·(t + h).",
    simulate: |conditions| {
        let (sine, cosine) = 0.3_f64.sin_cos();
        let mut samples = Vec::new();
        for k in 0..8 {
            let friction = 0.05 * f64::from(k);
            let direction = 0.1 + FRAC_PI_4 * f64::from(k);
            let along = DVec3::new(direction.cos(), direction.sin(), 0.0);
            let acceleration = G * (along * sine - DVec3::Z * cosine);
            let mut run = on_plane([DVec3::X, DVec3::Z], acceleration, friction, conditions)?;
            let start = middle(&run);
            run.advance_to(TIME)?;
            let way = middle(&run) - start;
            let pull = G * (sine - friction * cosine).max(0.0);
            samples.push(Sample {
                at: friction,
                exact: 0.5 * pull * run.time().powi(2),
                predicted: Some(falling(pull).pressed(run.steps())[0]),
                simulated: way.dot(along),
                aside: way.cross(along).z,
            });
        }
        Ok(Outcome {
            samples,
            scale: 0.5 * G * sine * TIME * TIME,
        })
    },
};

pub(super) const CAPSTAN: Law = Law {
    name: "capstan",
    statement: "A rope that is pulled around a cylinder by the angle φ: T₂ = T₁·exp(μ·φ), μ = 0.3 (Euler, Eytelwein)",
    axes: ["angle φ, rad", "tension T₂ over T₁"],
    error: ErrorUnit::Of("T₂ at 180°"),
    mesh: "segments",
    meshes: &[regular(40), regular(80), regular(160)],
    remark: "Only a plate of 24 g at one end has weight, the other end moves at 5 cm/s, and stretches give the tensions.",
    simulate: |conditions| {
        let friction = 0.3;
        let law = |angle: f64| (friction * angle).exp();
        let mut samples = Vec::new();
        for angle in [0.25 * PI, 0.5 * PI, 0.75 * PI, PI] {
            samples.push(Sample {
                at: angle,
                exact: law(angle),
                simulated: tensions_at_cylinder([angle, friction], conditions)?,
                ..Sample::default()
            });
        }
        Ok(Outcome { samples, scale: law(PI) })
    },
};

/// A force on the vertices from a number on, as great as their weight.
#[derive(Clone, Copy, Debug)]
struct Load(usize);

selvedge_cloth::identify!(Load { 0 });

impl Effect for Load {
    fn name(&self) -> &'static str {
        "load"
    }

    fn register(&self, plan: &mut Plan<'_>) {
        plan.add_force(*self);
    }
}

impl Force for Load {
    fn apply(&mut self, step: &TimeStep<'_>, velocities: &mut [DVec3]) {
        velocities[self.0..].iter_mut().for_each(|velocity| velocity.z -= G * step.h);
    }
}

/// Returns the tension of a rope that is pulled over a cylinder, over that of its other end, from which a plate hangs.
fn tensions_at_cylinder([angle, friction]: [f64; 2], conditions: &Conditions) -> Result<f64, Failure> {
    let segments = conditions.grid.number;
    let (radius, straight, stiffness, speed) = (0.1, 0.15, 500.0, 0.05);
    let (rope_density, plate_density, half) = (0.1, 10.0, 0.035);
    // The rope starts a little outside of its thickness, as its segments are chords.
    let around = radius + 1.05 * THICKNESS;
    let on_arc = |angle: f64| DVec3::new(angle.cos(), 0.0, angle.sin());
    let ahead = |angle: f64| DVec3::new(-angle.sin(), 0.0, angle.cos());
    let mut line = vec![around * DVec3::X - straight * DVec3::Z];
    line.extend((0..=64).map(|k| around * on_arc(angle * f64::from(k) / 64.0)));
    line.push(around * on_arc(angle) + straight * ahead(angle));
    let mut mesh = Cloth::rope(&line, segments, rope_density)?.mesh().clone();
    let corners = [[half, -half], [-half, -half], [0.0, -2.0 * half]];
    mesh.positions.extend(corners.map(|[y, z]| line[0] + DVec3::new(0.0, y, z)));
    mesh.triangles = vec![[0, segments + 1, segments + 2], [segments + 1, segments + 3, segments + 2]];
    let edges: Vec<[u32; 2]> = (0..segments).map(|k| [k, k + 1]).collect();
    let cloth = Cloth::from_mesh_with_loose_edges(mesh, &edges, DVec3::Y, [plate_density, rope_density])?;
    let mut scene = weightless(cloth);
    scene
        .bodies
        .push(Body::capsule("cylinder", [-0.3 * DVec3::Y, 0.3 * DVec3::Y], radius, 64)?);
    let time = 0.8;
    let key = |time| Keyframe {
        time,
        translation: speed * time * ahead(angle),
        ..Keyframe::default()
    };
    let motion = KeyframeMotion::new(DVec3::ZERO, DVec3::Z, vec![key(0.0), key(time)])?;
    let motion = PinMotion::Own(motion.interpolated(Interpolation::Smooth).into());
    let vertices = vec![segments];
    scene.add(Pins {
        groups: vec![PinGroup::new(vertices, motion)],
    });
    elastic(&mut scene, 1e5, 1e-3);
    scene
        .add(Load(segments as usize + 1))
        .add(RopeStretch::new(stiffness))
        .add(AirDrag { rate: 5.0 });
    scene
        .add(BodyContact(Thickness::new(THICKNESS)))
        .add(Friction { coefficient: friction });
    let mut run = Run::new(scene, conditions)?;
    let length_at_rest = run.positions()[0].distance(run.positions()[1]);
    run.advance_to(0.5 * time)?;
    // Tensions tremble, so that their means over the second half count.
    let some = segments as usize / 8;
    let mean = |points: &[DVec3]| points.windows(2).map(|two| two[0].distance(two[1])).sum::<f64>() / some as f64;
    let mut stretches = [0.0; 2];
    run.over_time(0.5 * time, |run, _| {
        let rope = &run.positions()[..=segments as usize];
        for (sum, points) in stretches.iter_mut().zip([&rope[..=some], &rope[rope.len() - 1 - some..]]) {
            *sum += mean(points) / length_at_rest - 1.0;
        }
        Sample::default()
    })?;
    Ok(stretches[1] / stretches[0])
}
