//! Light cloth that carries a heavy load: a cord with a weight, a strip and a sheet under a heavy patch.
//!
//! **A cord** of the stiffness EA bears the tension T with the strain T/EA. A weight m that hangs from it has T = m·g, and half of the cord's own weight
//! on the average. Where the weight starts at rest at the angle φ, it passes the lowest point with T = m·g·(3 − 2cos φ). Its period is
//! 4√(L/g)·K(sin ½φ), with the complete elliptic integral K, and L from the pin to the centre of the weight. The weight is a short rod of
//! two masses. Its own turning changes L by the square of half its length, 0.003 %.
//!
//! **A strip** that is held at two sides and carries a heavy strip in its middle without friction is an [`ElasticCurve`] in a plane.
//!
//! **A sheet** that is held at its border has no closed form: [`HEAVY_PATCH`].

use super::conditions::{Conditions, irregular, regular};
use super::forms::{elliptic_k, root};
use super::run::Run;
use super::setting::{G, elastic, membrane, pinned, scene, sheet, vertices_where};
use super::{ErrorUnit, Failure, Law, Outcome, Sample};
use selvedge_cloth::effects::{AirDrag, Friction, RopeStretch, Seam, Seams, SelfCollision, Thickness};
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{Cloth, Simulation};

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

/// Half of an elastic strip from its middle to the side where it is held, in the plane across. It carries an inextensible strip, which rests on it at
/// the distance d without friction.
///
/// With the tension T, the angle θ, the weights w and w′ of strip and load per length at rest, the load's own tension T′ and the length σ along it:
/// dT = w·sin θ·ds, dT′ = w′·sin θ·dσ, and T′ = 0 at the load's end. The load presses with N = w′·cos θ − T′·dθ/dσ on the strip, and
/// T·dθ = w·cos θ·ds + N·dσ. As it lies inside of the bend, dσ = λ·ds − d·dθ with the stretch λ = 1 + T/k. So, under the load,
/// (T + T′ + d·w′·cos θ)·dθ = (w + w′·λ)·cos θ·ds.
struct ElasticCurve {
    stiffness: f64,
    /// The weight of the strip, in N/m².
    own: f64,
    /// The weight of the load, in N/m².
    load: f64,
    /// Half of the load's length, in m.
    reach: f64,
    /// The distance of the load, in m.
    gap: f64,
}

/// The end of a curve.
struct CurveEnd {
    /// The distance of the side from the middle, in m.
    width: f64,
    /// How far the middle is below the side, in m.
    sag: f64,
    /// The load's tension at its end, in N/m.
    load_tension: f64,
}

impl ElasticCurve {
    /// Integrates over the length at rest in m from the middle, where the tensions of strip and load are given.
    fn end(&self, length: f64, [tension, load_tension]: [f64; 2]) -> CurveEnd {
        const PARTS: u32 = 4000;
        let ds = length / f64::from(PARTS);
        let derivative = |[angle, tension, load_tension, along, ..]: [f64; 6]| {
            let (sine, cosine, stretch) = (angle.sin(), angle.cos(), 1.0 + tension / self.stiffness);
            let carries = f64::from(u8::from(along < self.reach));
            let load = carries * self.load;
            let bent = cosine * (self.own + load * stretch) / (tension + carries * load_tension + self.gap * load * cosine);
            let moved = carries * (stretch - self.gap * bent);
            [
                bent,
                self.own * sine,
                load * sine * moved,
                if carries > 0.0 { moved } else { 1.0 },
                stretch * cosine,
                stretch * sine,
            ]
        };
        let added = |state: [f64; 6], rate: [f64; 6], ds: f64| std::array::from_fn(|k| state[k] + ds * rate[k]);
        // The midpoint rule.
        let state = (0..PARTS).fold([0.0, tension, load_tension, 0.0, 0.0, 0.0], |state, _| {
            let middle = added(state, derivative(state), 0.5 * ds);
            added(state, derivative(middle), ds)
        });
        CurveEnd {
            width: state[4],
            sag: state[5],
            load_tension: state[2],
        }
    }

    /// Returns the sag between sides at a distance from the middle that is also the length at rest.
    fn sag(&self, width: f64) -> f64 {
        // The load is pressed together by at most its weight along the slope.
        let load_tension = |tension: f64| {
            root([-self.load * width, self.load * width], |own| {
                self.end(width, [tension, own]).load_tension
            })
        };
        let at = |tension: f64| self.end(width, [tension, load_tension(tension)]);
        let tension = root([1e-3 * self.stiffness, 0.5 * self.stiffness], |tension| {
            at(tension).width - width
        });
        at(tension).sag
    }
}

pub(super) const HEAVY_STRIP: Law = Law {
    name: "heavy_strip",
    statement: "A strip of 20 g/m² that carries a heavy strip in its middle without friction hangs as the elastic curve T·dθ/ds = w + w′",
    axes: ["mass of the load, kg/m²", "sag of the middle, m"],
    error: ErrorUnit::Of("the largest sag"),
    mesh: "cells between the sides",
    meshes: &[regular(20), irregular(20), regular(40)],
    remark: "The load has up to a thousand times the mass of what carries it. Its ends are bends of the mesh, which have an error of the cells.",
    simulate: |conditions| {
        let (cells, thickness, stiffness) = (conditions.grid.number, 3e-3, 3e3);
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
            let load = strip(DVec3::new(-0.06, -0.05, 0.004), 0.12, 3 * cells / 10, density)?;
            let mut scene = scene(bed.named("bed"));
            scene.cloths.push(load.named("load"));
            membrane(&mut scene, stiffness);
            scene.add(held).add(AirDrag { rate: 6.0 });
            scene.add(SelfCollision(Thickness::new(thickness)));
            let mut run = Run::new(scene, conditions)?;
            run.advance_to(3.0)?;
            let curve = ElasticCurve {
                stiffness,
                own: 0.02 * G,
                load: density * G,
                reach: 0.06,
                gap: thickness,
            };
            scale = curve.sag(0.2);
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

/// Returns the height of the lowest vertex of the first cloth.
fn lowest(run: &Simulation) -> f64 {
    let own = run.vertices_of_cloth(0).unwrap_or_default();
    run.positions()[own].iter().map(|point| point.z).fold(f64::INFINITY, f64::min)
}

/// The sag of the sheet under the heavy patch, in m: see [`HEAVY_PATCH`].
const CONVERGED_SAG: f64 = 0.0190;

pub(super) const HEAVY_PATCH: Law = Law {
    name: "heavy_patch",
    statement: "A patch of 5 kg/m² that lies on a held sheet of 20 g/m² makes it sag by 19.0 mm (converged simulation)",
    axes: ["mass of the patch, kg/m²", "sag of the middle, m"],
    error: ErrorUnit::Of("the sag"),
    mesh: "cells of the sheet a side",
    meshes: &[regular(20)],
    remark: "There is no closed form.",
    simulate: |conditions| {
        let cells = conditions.grid.number;
        let strip = |corner: DVec3, length: f64, cells: u32, density: f64| {
            Cloth::sheet(corner, [length * DVec3::X, length * DVec3::Y], [cells; 2], density)
        };
        let bed = strip(DVec3::new(-0.2, -0.2, 0.0), 0.4, cells, 0.02)?;
        let held = pinned(vertices_where(bed.mesh(), |point| {
            point.x.abs().max(point.y.abs()) > 0.2 - 1e-9
        }));
        let load = strip(DVec3::new(-0.06, -0.06, 0.01), 0.12, 3 * cells / 10, 5.0)?;
        let mut scene = scene(bed.named("bed"));
        scene.cloths.push(load.named("load"));
        elastic(&mut scene, 3e3, 50e-6);
        scene.add(held).add(AirDrag { rate: 3.0 });
        scene
            .add(SelfCollision(Thickness::new(3e-3)))
            .add(Friction { coefficient: 0.5 });
        let mut run = Run::new(scene, conditions)?;
        run.advance_to(2.0)?;
        let sample = Sample {
            at: 5.0,
            exact: CONVERGED_SAG,
            simulated: -lowest(&run),
            ..Sample::default()
        };
        Ok(Outcome {
            samples: vec![sample],
            scale: CONVERGED_SAG,
        })
    },
};
