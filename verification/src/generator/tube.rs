//! A mesh in large motion, for promises about many triangles and steps that follow one another.

use libm::{cos, sin};
use selvedge::Topology;
use selvedge_core::glam::DVec3;
use std::f64::consts::TAU;

const LENGTH: f64 = 0.6;
const RADIUS: f64 = 0.06;
/// The bend is spread over this length on either side of the middle.
const REACH: f64 = 0.06;
/// The tube bends by this angle in all, in radians.
const BEND: f64 = 2.5;

/// A wrinkled tube that bends in the middle until its inner side passes through itself. Nothing keeps it from that.
///
/// Positions are the same bits on every platform: sine and cosine are those of `libm`.
#[derive(Clone, Debug)]
pub struct BendingTube {
    rest: Vec<DVec3>,
    topology: Topology,
}

impl BendingTube {
    /// The bend takes this many steps.
    pub const STEPS: usize = 60;

    /// Makes a tube of about 1,350 triangles times `refinement`.
    ///
    /// # Panics
    /// Panics if `refinement` is zero, or the tube has more vertices than `u32` counts.
    pub fn new(refinement: u32) -> Self {
        let finer = f64::from(refinement).sqrt();
        let [rings, points] = [28.0, 24.0].map(|count| (count * finer).round() as u32);
        let mut rest = Vec::new();
        for ring in 0..=rings {
            for point in 0..points {
                // Every other ring is turned by half a point, which makes the triangles nearly equilateral.
                let angle = TAU * (f64::from(point) + 0.5 * f64::from(ring % 2)) / f64::from(points);
                let along = LENGTH * (f64::from(ring) / f64::from(rings) - 0.5);
                rest.push(DVec3::new(along, RADIUS * cos(angle), RADIUS * sin(angle)));
            }
        }
        let mut triangles = Vec::new();
        for ring in 0..rings {
            for point in 0..points {
                let next = (point + 1) % points;
                let [a, b, c, d] = [[0, point], [0, next], [1, point], [1, next]].map(|[up, point]| (ring + up) * points + point);
                triangles.extend(if ring % 2 == 0 {
                    [[a, b, c], [b, d, c]]
                } else {
                    [[a, d, c], [a, b, d]]
                });
            }
        }
        let topology = Topology::new(rest.len(), triangles).expect("indices are in range");
        Self { rest, topology }
    }

    pub fn topology(&self) -> &Topology {
        &self.topology
    }

    /// Returns the positions after `step` steps, from 0 to [`STEPS`](Self::STEPS).
    pub fn frame(&self, step: usize) -> Vec<DVec3> {
        let time = step as f64 / Self::STEPS as f64;
        self.rest.iter().map(|&point| bent(wrinkled(point, time), time)).collect()
    }
}

/// Waves that grow with time: across the inner side of the bend, and slight ones around the whole tube.
fn wrinkled(point: DVec3, time: f64) -> DVec3 {
    let [inner, flank] = [point.y, point.z].map(|x| x / RADIUS);
    let fading = (1.0 - (point.x / 0.14) * (point.x / 0.14)).max(0.0);
    let folds = -0.017 * time * fading * fading * 0.25 * (1.0 + inner) * (1.0 + inner) * cos(TAU * point.x / 0.075 + 0.9 * flank);
    let waves = 0.006 * time * (0.65 + 0.35 * inner) * sin(TAU * point.x / 0.11 + 1.5 * flank);
    let radius = RADIUS + folds + waves;
    DVec3::new(point.x, radius * inner, radius * flank)
}

/// Bends the x axis into a straight line, an arc, and a straight line; cross-sections stay upright on it.
fn bent(point: DVec3, time: f64) -> DVec3 {
    let arc = (point.x + REACH).clamp(0.0, 2.0 * REACH);
    let [before, beyond] = [point.x.min(-REACH), (point.x - REACH).max(0.0)];
    let angle = BEND * time * arc / (2.0 * REACH);
    // An arc of this length and angle ends at arc · (sin a / a, (1 − cos a) / a).
    let chord = |angle: f64| if angle == 0.0 { 1.0 } else { sin(0.5 * angle) / (0.5 * angle) };
    let (sine, cosine) = (sin(angle), cos(angle));
    let x = before + arc * chord(angle) * cos(0.5 * angle) + beyond * cosine;
    let y = arc * chord(angle) * sin(0.5 * angle) + beyond * sine;
    DVec3::new(x - sine * point.y, y + cosine * point.y, point.z)
}
