//! Strain limits, and jerks: how long edges ever become.
//!
//! **A jerk.** One side of a strip suddenly moves away with the velocity v. A wave of the strain v/c runs through the strip, c =
//! √(k/ρ), and is reflected at the free end as a wave that takes the strain away. So no edge becomes longer than 1 + v/c, at any
//! step.
//!
//! **A strip over a rod** without friction has the same tension everywhere. If its ends are pulled until its path is 2 % longer
//! than the strip, all edges are 2 % longer. Chords are shorter than the arc on the rod: by 0.4 % of the length at 30 cells, 0.1
//! % at 60.

use super::conditions::{Conditions, irregular, regular};
use super::run::Run;
use super::setting::{DENSITY, elastic, pinned, scene, sheet, vertices_where, weightless};
use super::{ErrorUnit, Failure, Law, Outcome, Sample};
use selvedge_cloth::effects::{AirDrag, BodyContact, PinGroup, PinMotion, Pins, StrainLimit, Thickness};
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{Body, BodyMotion, Cloth, Interpolation, Keyframe, KeyframeMotion, Mesh, Placement, Simulation};
use std::f64::consts::FRAC_PI_2;

/// The edges of a cloth, and the largest stretch of theirs so far.
struct Edges {
    /// The ends of each edge, and its length at rest.
    all: Vec<([usize; 2], f64)>,
    stretches: Vec<f64>,
    /// The stretch that one in a hundred edges exceeds, and that of the longest: the largest of all states.
    largest: [f64; 2],
}

impl Edges {
    fn new(mesh: &Mesh) -> Self {
        let sides = mesh.triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        let mut ends: Vec<[u32; 2]> = sides.map(|[a, b]| [a.min(b), a.max(b)]).collect();
        ends.sort_unstable();
        ends.dedup();
        let with_length = |ends: [u32; 2]| {
            let ends = ends.map(|vertex| vertex as usize);
            (ends, mesh.positions[ends[0]].distance(mesh.positions[ends[1]]))
        };
        Self {
            all: ends.into_iter().map(with_length).collect(),
            stretches: Vec::new(),
            largest: [0.0; 2],
        }
    }

    fn see(&mut self, simulation: &Simulation) {
        let all = simulation.positions();
        let stretch = |&([a, b], rest): &([usize; 2], f64)| all[a].distance(all[b]) / rest;
        self.stretches.clear();
        self.stretches.extend(self.all.iter().map(stretch));
        let at = self.stretches.len() * 99 / 100;
        let (_, percentile_99, longer) = self.stretches.select_nth_unstable_by(at, f64::total_cmp);
        let longest = longer.iter().copied().fold(*percentile_99, f64::max);
        self.largest = [self.largest[0].max(*percentile_99), self.largest[1].max(longest)];
    }
}

const LIMIT: f64 = 1.08;

/// Lets a soft sheet swing from two corners on its limit. Returns the [largest stretches](Edges::largest).
fn swung(conditions: &Conditions) -> Result<[f64; 2], Failure> {
    let side = 0.5;
    let sides = [side * DVec3::X, side * DVec3::Y];
    let cloth = sheet(
        DVec3::ZERO,
        sides,
        [conditions.grid.number; 2],
        DENSITY,
        conditions.grid,
        |_| false,
    )?;
    let mut edges = Edges::new(cloth.mesh());
    let is_corner = |point: DVec3| point.y == 0.0 && (point.x - 0.5 * side).abs() > 0.5 * side - 1e-9;
    let corners = pinned(vertices_where(cloth.mesh(), is_corner));
    let mut scene = scene(cloth);
    elastic(&mut scene, 60.0, 1e-5);
    scene.add(corners).add(StrainLimit::at(LIMIT));
    let mut run = Run::new(scene, conditions)?;
    run.watch_to(1.5, |run| edges.see(run))?;
    Ok(edges.largest)
}

pub(super) const STRAIN_LIMIT: Law = Law {
    name: "strain_limit",
    statement: "A soft sheet (60 N/m) swings from two corners: 99 % of its edges are never longer than the limit of 1.08",
    axes: ["share of edges", "stretch"],
    error: ErrorUnit::Of("the length"),
    mesh: "cells a side",
    meshes: &[regular(12), regular(24), irregular(24), regular(36)],
    remark: "The sheet hangs on its two corners, and edges there reach the limit.",
    simulate: |conditions| {
        let [percentile_99, _] = swung(conditions)?;
        Ok(Outcome {
            samples: vec![Sample {
                at: 0.99,
                exact: LIMIT,
                // Being shorter is no error.
                simulated: percentile_99.max(LIMIT),
                ..Sample::default()
            }],
            scale: 1.0,
        })
    },
};

pub(super) const LONGEST_EDGE: Law = Law {
    name: "longest_edge",
    statement: "A soft sheet (60 N/m) swings from two corners: its longest edge ever is at the limit of 1.08",
    simulate: |conditions| {
        let [_, longest] = swung(conditions)?;
        Ok(Outcome {
            samples: vec![Sample {
                at: 1.0,
                exact: LIMIT,
                simulated: longest,
                ..Sample::default()
            }],
            scale: 1.0,
        })
    },
    ..STRAIN_LIMIT
};

/// Pins that the caller moves.
fn driven(vertices: &[u32]) -> Pins {
    Pins {
        groups: vec![PinGroup::new(
            vertices.to_vec(),
            PinMotion::Own(BodyMotion::Driven(Placement::default())),
        )],
    }
}

/// Moves driven pins at every tick by `path`, which takes the time at its end, and watches the edges until a time in seconds.
fn jerked(
    run: &mut Run,
    pins: &[u32],
    edges: &mut Edges,
    end: f64,
    tick: f64,
    path: impl Fn(f64) -> DVec3,
) -> Result<(), Failure> {
    let start: Vec<DVec3> = pins.iter().map(|&pin| run.positions()[pin as usize]).collect();
    while run.time() < end - 0.5 * tick {
        let way = path(run.time() + tick);
        let goals: Vec<DVec3> = start.iter().map(|point| *point + way).collect();
        run.move_pins(0, &goals)?;
        run.tick()?;
        edges.see(run);
    }
    Ok(())
}

pub(super) const JERK: Law = Law {
    name: "jerk",
    statement: "One side of a stiff strip suddenly moves with v = 0.02·c, c = √(k/ρ): no edge ever becomes longer than 1.02",
    axes: [
        "velocity over that of waves",
        "length of the longest edge ever, over its length at rest",
    ],
    error: ErrorUnit::Of("the length"),
    mesh: "cells along",
    meshes: &[regular(24), irregular(24), regular(48)],
    remark: "c is 115 m/s: in 4 ms waves run through the strip twice.",
    simulate: |conditions| {
        let (cells, stiffness, length) = (conditions.grid.number, 2e3, 0.24);
        let sides = [length * DVec3::X, 0.08 * DVec3::Y];
        let cloth = sheet(DVec3::ZERO, sides, [cells, cells / 3], DENSITY, conditions.grid, |_| false)?;
        let side = vertices_where(cloth.mesh(), |point| point.x == 0.0);
        let mut edges = Edges::new(cloth.mesh());
        let mut scene = weightless(cloth);
        elastic(&mut scene, stiffness, 25e-6);
        scene.add(driven(&side));
        let mut run = Run::new(scene, conditions)?;
        let share = 0.02;
        let velocity = share * f64::sqrt(stiffness / DENSITY);
        let tick = conditions.pace.seconds();
        jerked(&mut run, &side, &mut edges, 0.1, tick, |time| -velocity * time * DVec3::X)?;
        Ok(Outcome {
            samples: vec![Sample {
                at: share,
                exact: 1.0 + share,
                simulated: edges.largest[1].max(1.0 + share),
                ..Sample::default()
            }],
            scale: 1.0,
        })
    },
};

pub(super) const TAUT: Law = Law {
    name: "taut",
    statement: "A strip over a rod whose ends are pulled taut in 0.1 s, 2 % too far, is never longer than 1.02, and is so at the end",
    axes: ["time, s", "length of the longest edge, over its length at rest"],
    error: ErrorUnit::Of("the length"),
    mesh: "cells along",
    meshes: &[regular(30), irregular(30), regular(60)],
    remark: "k = 2 kN/m, and no friction. The ends stop within 0.1 s. Chords are shorter than the arc on the rod.",
    simulate: |conditions| {
        let (cells, half, radius, thickness) = (conditions.grid.number, 0.12, 6e-3, 2e-3);
        let sides = [2.0 * half * DVec3::X, 0.08 * DVec3::Y];
        let corner = DVec3::new(-half, -0.04, 0.0);
        let cloth = sheet(corner, sides, [cells, cells / 3], DENSITY, conditions.grid, |_| false)?;
        let mut edges = Edges::new(cloth.mesh());
        let (reach, depth) = (radius + thickness, 1.05 * thickness + radius);
        let taut = 1.02 * half - reach * FRAC_PI_2;
        let group = |side: f64| -> Result<_, Failure> {
            let key = |time, z| Keyframe {
                time,
                translation: DVec3::new(if time > 0.0 { side * (reach - half) } else { 0.0 }, 0.0, z),
                ..Keyframe::default()
            };
            let keys = vec![key(0.0, 0.0), key(0.4, -0.07), key(0.5, -depth - taut)];
            let motion = KeyframeMotion::new(DVec3::ZERO, DVec3::Z, keys)?;
            Ok(PinGroup::new(
                vertices_where(cloth.mesh(), |point| point.x * side > half - 1e-9),
                PinMotion::Own(motion.interpolated(Interpolation::Smooth).into()),
            ))
        };
        let groups = vec![group(-1.0)?, group(1.0)?];
        let mut scene = scene(cloth);
        let axis = [-0.2, 0.2].map(|y| DVec3::new(0.0, y, -depth));
        scene.bodies.push(Body::capsule("rod", axis, radius, 24)?);
        elastic(&mut scene, 2e3, 25e-6);
        scene.add(Pins { groups }).add(AirDrag { rate: 2.0 });
        scene.add(BodyContact(Thickness::new(thickness)));
        let mut run = Run::new(scene, conditions)?;
        run.watch_to(0.9, |run| edges.see(run))?;
        let ever = edges.largest[1];
        edges.largest = [0.0; 2];
        edges.see(&run);
        let sample = |at, simulated| Sample {
            at,
            exact: 1.02,
            simulated,
            ..Sample::default()
        };
        Ok(Outcome {
            samples: vec![sample(0.5, ever), sample(0.9, edges.largest[1])],
            scale: 1.0,
        })
    },
};

pub(super) const JERK_ON_LIMIT: Law = Law {
    name: "jerk_on_limit",
    statement: "A sheet with a limit of 1.05 hangs from a bar that is suddenly lifted with 3 m/s: no edge ever becomes longer",
    axes: ["velocity, m/s", "length of the longest edge ever, over its length at rest"],
    error: ErrorUnit::Of("the length"),
    mesh: "cells along",
    meshes: &[regular(16), irregular(16), regular(32)],
    remark: "k = 300 N/m: without the limit the wave of the jerk alone has the strain v/c = 0.067.",
    simulate: |conditions| {
        let (cells, limit, velocity) = (conditions.grid.number, 1.05, 3.0);
        let sides = [0.3 * DVec3::X, -0.3 * DVec3::Z];
        let cloth: Cloth = sheet(DVec3::ZERO, sides, [cells; 2], DENSITY, conditions.grid, |_| false)?;
        let bar = vertices_where(cloth.mesh(), |point| point.z == 0.0);
        let mut edges = Edges::new(cloth.mesh());
        let mut scene = scene(cloth);
        elastic(&mut scene, 300.0, 25e-6);
        scene.add(driven(&bar)).add(StrainLimit::at(limit));
        let mut run = Run::new(scene, conditions)?;
        let lifted = |time: f64| velocity * (time - 0.2).clamp(0.0, 0.1) * DVec3::Z;
        jerked(&mut run, &bar, &mut edges, 0.6, conditions.pace.seconds(), lifted)?;
        Ok(Outcome {
            samples: vec![Sample {
                at: velocity,
                exact: limit,
                simulated: edges.largest[1].max(limit),
                ..Sample::default()
            }],
            scale: 1.0,
        })
    },
};
