//! Light cloth that carries a heavy load: a cord with a weight, a strip and a sheet under a heavy patch.
//!
//! **A cord** of the stiffness EA bears the tension T with the strain T/EA. A weight m that hangs from it has T = m·g, and half
//! of the cord's own weight on the average. Where the weight starts at rest at the angle φ, it passes the lowest point with T =
//! m·g·(3 − 2cos φ). Its period is 4√(L/g)·K(sin ½φ), with the complete elliptic integral K, and L from the pin to the centre of
//! the weight. The weight is a short rod of two masses. Its own turning changes L by the square of half its length, 0.003 %.
//!
//! **A strip** that is held at two sides and carries a heavy, soft strip around its middle is an elastic catenary with the weight
//! of both there: its horizontal tension H is the same everywhere, and its vertical tension V is the weight below
//! ([`LoadedStrip`]).
//!
//! **A sheet** that is held at its border has no closed form: [`HEAVY_PATCH`].

use super::conditions::{Conditions, irregular, regular};
use super::forms::{elliptic_k, root};
use super::run::Run;
use super::setting::{G, membrane, pinned, scene, sheet, vertices_where};
use super::{ErrorUnit, Failure, Law, Outcome, Sample};
use selvedge_cloth::effects::{AirDrag, Friction, Pins, RopeStretch, Seam, Seams, SelfCollision, Shear, Stretch, Thickness};
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{Cloth, Scene, Simulation};

/// The stiffness of the cord, in N.
const CORD: f64 = 1e4;
/// Its mass, in kg/m.
const LINE: f64 = 5e-3;
/// The length of the rod that is its weight, in m.
const ROD: f64 = 0.01;

/// Ties a weight in kg to a cord of 1 m that leaves the origin in one direction. The weight is a rod in another direction.
fn loaded(mass: f64, [cord, rod]: [DVec3; 2], drag: f64, conditions: &Conditions) -> Result<Run, Failure> {
    let segments = conditions.grid.number;
    let line = Cloth::rope(&[DVec3::ZERO, cord], segments, LINE)?.named("cord");
    let weight = Cloth::rope(&[cord, cord + ROD * rod], 1, mass / ROD)?.named("weight");
    let mut scene = scene(line);
    scene.cloths.push(weight);
    scene.add(RopeStretch::new(CORD)).add(pinned([0]));
    if drag > 0.0 {
        scene.add(AirDrag { rate: drag });
    }
    scene.add(Seams {
        seams: vec![Seam::new(vec![segments], vec![segments + 1])],
    });
    Run::new(scene, conditions)
}

/// Returns the strains of the cord's segments, which all have one length at rest.
fn strains(run: &Simulation, segments: u32) -> impl Iterator<Item = f64> {
    let cord = run.positions()[..=segments as usize].windows(2);
    cord.map(move |ends| ends[0].distance(ends[1]) * f64::from(segments) - 1.0)
}

/// Returns the direction at an angle from straight down.
fn direction(angle: f64) -> DVec3 {
    DVec3::new(angle.sin(), 0.0, -angle.cos())
}

pub(super) const CORD_LOAD: Law = Law {
    name: "cord_load",
    statement: "A cord of 5 g and 10 kN with a weight m has the tension (m + half of the cord's)·g in the mean, once the weight hangs still",
    axes: ["weight, kg", "tension, N"],
    error: ErrorUnit::Of("the largest tension"),
    mesh: "segments",
    meshes: &[regular(10), regular(50), regular(100)],
    remark: "The cord leans by 20° at first and the weight by 45° more, so that both swing and turn.",
    simulate: |conditions| {
        let segments = conditions.grid.number;
        let tension = |mass: f64| (mass + 0.5 * LINE) * G;
        let mut samples = Vec::new();
        for mass in [0.01, 0.3, 1.0] {
            let leaning = [direction(f64::to_radians(20.0)), direction(f64::to_radians(65.0))];
            let mut run = loaded(mass, leaning, 5.0, conditions)?;
            run.advance_to(4.0)?;
            let strain = strains(&run, segments).sum::<f64>() / f64::from(segments);
            samples.push(Sample {
                at: mass,
                exact: tension(mass),
                simulated: CORD * strain,
                ..Sample::default()
            });
        }
        Ok(Outcome {
            samples,
            scale: tension(1.0),
        })
    },
};

/// The angle at which the swinging weight starts, in rad.
const START: f64 = std::f64::consts::FRAC_PI_3;

pub(super) const CORD_SWING: Law = Law {
    name: "cord_swing",
    statement: "A weight of 1 kg that swings on a cord of 5 g from 60° never stretches a segment beyond 1 + m·g·(3 − 2cos 60°)/EA",
    axes: ["time, s", "length of the longest segment so far, over its length at rest"],
    error: ErrorUnit::Of("the length"),
    mesh: "segments",
    meshes: &[regular(10), regular(50), regular(100)],
    remark: "The cord starts without tension, so that the weight bounces a little at first: half the tension at the lowest point.",
    simulate: |conditions| {
        let longest_at_most = 1.0 + (1.0 + LINE) * G * (3.0 - 2.0 * START.cos()) / CORD;
        let mut run = loaded(1.0, [direction(START); 2], 0.0, conditions)?;
        let (mut longest, mut samples) = (0.0_f64, Vec::new());
        for quarter in 1..=16 {
            run.watch_to(0.25 * f64::from(quarter), |run| {
                longest = strains(run, conditions.grid.number)
                    .map(|strain| 1.0 + strain)
                    .fold(longest, f64::max);
            })?;
            samples.push(Sample {
                at: run.time(),
                exact: longest_at_most,
                // Before the lowest point it may be less.
                simulated: longest.max(if quarter < 16 { longest_at_most } else { 0.0 }),
                ..Sample::default()
            });
        }
        Ok(Outcome { samples, scale: 1.0 })
    },
};

pub(super) const CORD_PERIOD: Law = Law {
    name: "cord_period",
    statement: "A weight of 1 kg swings on a cord of 5 g from 60° with the period 4·√(L/g)·K(sin 30°)",
    axes: ["crossing of the lowest point", "time, s"],
    error: ErrorUnit::Of("the time of two periods"),
    mesh: "segments",
    meshes: &[regular(10), regular(50), regular(100)],
    remark: "What the time stepping takes from the energy makes the swing smaller, and its period shorter.",
    simulate: |conditions| {
        let segments = conditions.grid.number as usize;
        let mut run = loaded(1.0, [direction(START); 2], 0.0, conditions)?;
        // The cord is a pendulum of its own: its mass acts at a third of its inertia, and with half of its weight.
        let length = 1.0 + 0.5 * ROD;
        let length = length * (1.0 - LINE / 6.0) * (1.0 + G / CORD);
        let period = 4.0 * (length / G).sqrt() * elliptic_k((0.5 * START).sin());
        let mut crossings = Vec::new();
        while crossings.len() < 4 {
            let before = run.positions()[segments].x;
            run.tick()?;
            let after = run.positions()[segments].x;
            if before * after < 0.0 {
                crossings.push(run.time() - conditions.pace.seconds() * after / (after - before));
            }
            if run.time() > 10.0 {
                return Err("the weight does not swing".into());
            }
        }
        let samples = crossings.iter().enumerate().map(|(k, &time)| Sample {
            at: (k + 1) as f64,
            exact: period * (0.25 + 0.5 * k as f64),
            simulated: time,
            ..Sample::default()
        });
        Ok(Outcome {
            samples: samples.collect(),
            scale: 2.0 * period,
        })
    },
};

/// Half of an elastic strip, which is held at its side and carries a load around its middle.
struct LoadedStrip {
    /// The length at rest, and the distance of the side from the middle, in m.
    length: f64,
    /// The stiffness, in N/m.
    stiffness: f64,
    /// The weight, in N/m².
    own: f64,
    /// The weight under the load, with that of the load, in N/m².
    loaded: f64,
    /// The length at rest under the load, in m.
    reach: f64,
}

impl LoadedStrip {
    /// Returns width and depth from the middle to the side, in m, for a horizontal tension H in N/m. From a vertical tension of V
    /// to one of V′, over the length s, the width grows by H·s/k + H/w·(asinh V′/H − asinh V/H) and the depth by (V′² − V²)/2wk +
    /// H/w·(√(1 + V′²/H²) − √(1 + V²/H²)).
    fn size(&self, tension: f64) -> [f64; 2] {
        let part = |weight: f64, length: f64, before: f64| {
            let after = before + weight * length;
            let [a, b] = [before, after].map(|vertical| vertical / tension);
            let scale = tension / weight;
            let width = tension * length / self.stiffness + scale * (b.asinh() - a.asinh());
            let depth =
                (after * after - before * before) / (2.0 * weight * self.stiffness) + scale * (b.hypot(1.0) - a.hypot(1.0));
            ([width, depth], after)
        };
        let (under_load, vertical) = part(self.loaded, self.reach, 0.0);
        let (beyond, _) = part(self.own, self.length - self.reach, vertical);
        [under_load[0] + beyond[0], under_load[1] + beyond[1]]
    }

    fn sag(&self) -> f64 {
        let tension = root([1e-6 * self.stiffness, self.stiffness], |tension| {
            self.size(tension)[0] - self.length
        });
        self.size(tension)[1]
    }
}

pub(super) const HEAVY_STRIP: Law = Law {
    name: "heavy_strip",
    statement: "A strip of 20 g/m² that carries a soft, heavy strip in its middle hangs as an elastic catenary with both weights",
    axes: ["mass of the load, kg/m²", "sag of the middle, m"],
    error: ErrorUnit::Of("the largest sag"),
    mesh: "cells between the sides",
    meshes: &[regular(20), irregular(20), regular(40)],
    remark: "The load has up to a thousand times the mass of what carries it. It sticks by friction, and its own tension is 0.1 % of the strip's.",
    simulate: |conditions| {
        let (cells, thickness) = (conditions.grid.number, 3e-3);
        let (mut samples, mut scale) = (Vec::new(), 0.0);
        for density in [0.2, 2.0, 20.0] {
            let strip = |corner: DVec3, length: f64, cells: u32, density: f64| {
                let sides = [length * DVec3::X, 0.1 * DVec3::Y];
                sheet(
                    corner,
                    sides,
                    [cells, conditions.grid.number / 5],
                    density,
                    conditions.grid,
                    |_| false,
                )
            };
            let bed = strip(DVec3::new(-0.2, -0.05, 0.0), 0.4, cells, 0.02)?;
            let held = pinned(vertices_where(bed.mesh(), |point| point.x.abs() > 0.2 - 1e-9));
            let load = strip(DVec3::new(-0.06, -0.05, 1.01 * thickness), 0.12, 3 * cells / 10, density)?;
            let mut run = Run::new(carrying([bed, load], held, thickness), conditions)?;
            run.advance_to(2.0)?;
            scale = LoadedStrip {
                length: 0.2,
                stiffness: BED,
                own: 0.02 * G,
                loaded: (0.02 + density) * G,
                reach: 0.06,
            }
            .sag();
            samples.push(Sample {
                at: density,
                exact: scale,
                simulated: -lowest(&run),
                ..Sample::default()
            });
        }
        Ok(Outcome { samples, scale })
    },
};

/// The stiffness of what carries a strip or a patch, in N/m.
const BED: f64 = 3e3;

/// Makes a scene of a held cloth and of a load on it, which hardly has a stiffness.
fn carrying([bed, load]: [Cloth; 2], held: Pins, thickness: f64) -> Scene {
    let mut scene = scene(bed.named("bed"));
    scene.cloths.push(load.named("load"));
    membrane(&mut scene, BED);
    scene.add_to("load", Stretch::isotropic(3.0)).add_to("load", Shear::new(1.0));
    scene.add(held).add(AirDrag { rate: 10.0 });
    scene.add(SelfCollision(Thickness::new(thickness)));
    scene.add(Friction { coefficient: 0.5 });
    scene
}

/// Returns the height of the lowest vertex of the first cloth.
fn lowest(run: &Simulation) -> f64 {
    let own = run.vertices_of_cloth(0).unwrap_or_default();
    run.positions()[own].iter().map(|point| point.z).fold(f64::INFINITY, f64::min)
}

/// The masses of patches in kg/m², and the sags of the sheet under them, in m. They are those of the least energy of the mesh of
/// 20 cells with the masses of the patch's vertices on those below them: a minimisation by quasi-Newton steps in another program,
/// down to forces of 1e-7 N.
const SAGS: [[f64; 2]; 3] = [[0.5, 8.5393e-3], [5.0, 17.785e-3], [20.0, 28.2078e-3]];

pub(super) const HEAVY_PATCH: Law = Law {
    name: "heavy_patch",
    statement: "A held sheet of 20 g/m² under a soft patch of up to 20 kg/m² has the form of least energy",
    axes: ["mass of the patch, kg/m²", "sag of the middle, m"],
    error: ErrorUnit::Of("the largest sag"),
    mesh: "cells of the sheet a side",
    meshes: &[regular(20)],
    remark: "The form was computed once, by another program. The patch sticks by friction, a thickness above the vertices that carry it.",
    simulate: |conditions| {
        let (cells, thickness) = (conditions.grid.number, 3e-3);
        let square = |corner: DVec3, length: f64, cells: u32, density: f64| {
            Cloth::sheet(corner, [length * DVec3::X, length * DVec3::Y], [cells; 2], density)
        };
        let mut samples = Vec::new();
        for [density, exact] in SAGS {
            let bed = square(DVec3::new(-0.2, -0.2, 0.0), 0.4, cells, 0.02)?;
            let held = pinned(vertices_where(bed.mesh(), |point| {
                point.x.abs().max(point.y.abs()) > 0.2 - 1e-9
            }));
            let load = square(DVec3::new(-0.06, -0.06, 1.01 * thickness), 0.12, 3 * cells / 10, density)?;
            let mut run = Run::new(carrying([bed, load], held, thickness), conditions)?;
            run.advance_to(2.0)?;
            samples.push(Sample {
                at: density,
                exact,
                simulated: -lowest(&run),
                ..Sample::default()
            });
        }
        Ok(Outcome {
            samples,
            scale: SAGS[2][1],
        })
    },
};
