//! Stretch and bending of ropes.
//!
//! An edge of stiffness k = (axial stiffness)/(length L at rest) and length ℓ stores ½k(ℓ − L)². A joint b between a and c, with
//! edges of lengths u and v at rest, has the change of direction e = (c − b)/v − (b − a)/u, up to stretch. With D the flexural
//! rigidity it stores ½D/w·|e|², w = (u + v)/2 (Bergou et al. 2006). A joint that is bent by r at rest stores ½D/w·|e − r·ê|²,
//! with the direction ê of e in the last Newton step: the side of the bend is free.
//!
//! A rope is solved as a [band](super::preconditioner) of vertices that are each linked with the next two.

use super::constants::STIFFEST;
use super::matrix::Matrix;
use super::term::{Prediction, Renewed, Term};
use crate::model::energy::{Configuration, StoredEnergy};
use crate::model::length::length;
use crate::model::step::TimeStep;
use crate::world::{Cloth, runs};
use selvedge_core::glam::{DMat3, DVec3};

/// An edge shorter than this share of its length at rest has no reliable direction.
const SHORTEST: f64 = 1e-6;

/// The ropes of a cloth.
#[derive(Debug)]
pub(crate) struct Ropes {
    edges: Vec<Edge>,
    joints: Vec<Joint>,
    /// The effects of stretch and of bending, with the axial stiffness in N and the flexural rigidity in N·m².
    stretch: Option<(usize, f64)>,
    bend: Option<(usize, f64)>,
    /// Successive vertices, for the bands of the preconditioner.
    rows: Vec<Vec<u32>>,
}

#[derive(Clone, Copy, Debug)]
struct Edge {
    vertices: [u32; 2],
    /// The length at rest, in m.
    length: f64,
    /// The stiffness in this step, in N/m.
    stiffness: f64,
}

#[derive(Clone, Copy, Debug)]
struct Joint {
    vertices: [u32; 3],
    /// The weights of e at the vertices, in 1/m.
    weights: [f64; 3],
    /// The length w of rope of the joint, in m.
    width: f64,
    /// The length of e at rest, and its direction.
    bent: f64,
    side: DVec3,
    /// The stiffness in this step, in J.
    stiffness: f64,
}

impl Ropes {
    /// Makes the ropes of a cloth, whose first vertex in the scene is `first`.
    pub(crate) fn new(cloth: &Cloth, first: u32) -> Self {
        let edges: Vec<[u32; 2]> = cloth.topology.loose_edges().collect();
        let rest = &cloth.mesh.positions;
        let edge = |ends: &[u32; 2]| {
            let [a, b] = ends.map(|vertex| rest[vertex as usize]);
            Edge {
                vertices: ends.map(|vertex| first + vertex),
                length: a.distance(b),
                stiffness: 0.0,
            }
        };
        let rows = runs(&edges, rest.len());
        let rows = rows.iter().flat_map(|run| run.pieces());
        Self {
            edges: edges.iter().map(edge).collect(),
            joints: Vec::new(),
            stretch: None,
            bend: None,
            rows: rows
                .map(|row| row.into_iter().map(|vertex| first + vertex).collect())
                .collect(),
        }
    }

    /// Sets the axial stiffness, in N, of the effect of this index.
    pub(crate) fn stretch(&mut self, effect: usize, stiffness: f64) {
        self.stretch = Some((effect, stiffness));
    }

    /// Sets the flexural rigidity, in N·m².
    pub(crate) fn bend(&mut self, effect: usize, rigidity: f64, is_bent_at_rest: bool, cloth: &Cloth, first: u32) {
        self.bend = Some((effect, rigidity));
        let edges: Vec<[u32; 2]> = cloth.topology.loose_edges().collect();
        let rest = &cloth.mesh.positions;
        let joint = |three: &[u32]| {
            let three = [three[0], three[1], three[2]];
            let [a, b, c] = three.map(|vertex| rest[vertex as usize]);
            let [u, v] = [a.distance(b), b.distance(c)];
            let mut joint = Joint {
                vertices: three.map(|vertex| first + vertex),
                weights: [1.0 / u, -1.0 / u - 1.0 / v, 1.0 / v],
                width: 0.5 * (u + v),
                bent: 0.0,
                side: DVec3::ZERO,
                stiffness: 0.0,
            };
            if is_bent_at_rest {
                joint.bent = joint.turn([a, b, c]).length();
            }
            joint
        };
        let runs = runs(&edges, rest.len());
        let rows = runs.iter().flat_map(|run| run.rows_of_joints());
        self.joints = rows.flat_map(|row| row.windows(3).map(joint).collect::<Vec<_>>()).collect();
    }

    /// Returns the successive vertices of each rope.
    pub(crate) fn rows(&self) -> &[Vec<u32>] {
        &self.rows
    }
}

impl Edge {
    fn offset(&self, x: &[DVec3]) -> DVec3 {
        let [from, to] = self.vertices.map(|vertex| x[vertex as usize]);
        to - from
    }
}

impl Joint {
    /// Returns the change of direction e.
    fn turn(&self, [a, b, c]: [DVec3; 3]) -> DVec3 {
        (c - b) * self.weights[2] - (b - a) * self.weights[0]
    }

    fn turn_at(&self, x: &[DVec3]) -> DVec3 {
        self.turn(self.vertices.map(|vertex| x[vertex as usize]))
    }

    /// Returns the direction of e, or the last one if e has none.
    fn side_at(&self, x: &[DVec3]) -> DVec3 {
        self.turn_at(x).try_normalize().unwrap_or(self.side)
    }
}

impl Term for Ropes {
    fn begin(&mut self, _: &TimeStep<'_>, prediction: &Prediction, x: &[DVec3]) {
        let (axial, rigidity) = (self.stretch.map_or(0.0, |own| own.1), self.bend.map_or(0.0, |own| own.1));
        let lightest = |vertices: &[u32]| {
            let masses = vertices.iter().map(|&vertex| prediction.masses[vertex as usize]);
            masses.filter(|&mass| mass > 0.0).fold(f64::INFINITY, f64::min)
        };
        for edge in &mut self.edges {
            edge.stiffness = (axial / edge.length).min(STIFFEST * lightest(&edge.vertices));
        }
        for joint in &mut self.joints {
            let steepest: f64 = joint.weights.iter().map(|weight| weight * weight).sum();
            joint.stiffness = (rigidity / joint.width).min(STIFFEST * lightest(&joint.vertices) / steepest);
            if joint.bent > 0.0 {
                joint.side = joint.side_at(x);
            }
        }
    }

    fn gradient(&mut self, x: &[DVec3], gradient: &mut [DVec3]) -> f64 {
        let mut energy = 0.0;
        for edge in self.edges.iter().filter(|_| self.stretch.is_some()) {
            let along = edge.offset(x);
            let now = length(along);
            let over = now - edge.length;
            energy += 0.5 * edge.stiffness * over * over;
            if now > 0.0 {
                let pull = along * (edge.stiffness * over / now);
                let [from, to] = edge.vertices.map(|vertex| vertex as usize);
                gradient[from] -= pull;
                gradient[to] += pull;
            }
        }
        for joint in &self.joints {
            let excess = joint.turn_at(x) - joint.side * joint.bent;
            energy += 0.5 * joint.stiffness * excess.length_squared();
            for (&vertex, weight) in joint.vertices.iter().zip(joint.weights) {
                gradient[vertex as usize] += excess * (joint.stiffness * weight);
            }
        }
        energy
    }

    fn curvature(&mut self, x: &[DVec3], matrix: &mut Matrix) {
        for edge in self.edges.iter().filter(|_| self.stretch.is_some()) {
            let along = edge.offset(x);
            let now = length(along);
            if now > SHORTEST * edge.length {
                let direction = along / now;
                let across = (edge.stiffness * (1.0 - edge.length / now)).max(0.0);
                let outer = DMat3::from_cols(direction * direction.x, direction * direction.y, direction * direction.z);
                let stiffness = outer * (edge.stiffness - across) + DMat3::from_diagonal(DVec3::splat(across));
                matrix.add_of_rope(&edge.vertices, &[-1.0, 1.0], stiffness);
            }
        }
        for joint in &self.joints {
            let stiffness = DMat3::from_diagonal(DVec3::splat(joint.stiffness));
            matrix.add_of_rope(&joint.vertices, &joint.weights, stiffness);
        }
    }

    fn renew(&mut self, x: &[DVec3], gradient: &mut [DVec3]) -> Renewed {
        let mut renewed = Renewed::default();
        for joint in self.joints.iter_mut().filter(|joint| joint.bent > 0.0) {
            let (turn, side) = (joint.turn_at(x), joint.side_at(x));
            let by = (joint.side - side) * (joint.bent * joint.stiffness);
            for (&vertex, weight) in joint.vertices.iter().zip(joint.weights) {
                gradient[vertex as usize] += by * weight;
            }
            let of = |side: DVec3| 0.5 * joint.stiffness * (turn - side * joint.bent).length_squared();
            renewed.energy += of(side) - of(joint.side);
            joint.side = side;
        }
        renewed
    }

    fn is_inner(&self) -> bool {
        true
    }

    fn energy(&self, now: &Configuration<'_>, _: usize) -> Vec<(usize, StoredEnergy)> {
        let x = now.positions;
        let over = |edge: &Edge| (edge.offset(x).length() - edge.length).powi(2) / edge.length;
        let stretch = self.stretch.map(|(effect, axial)| {
            let all: f64 = self.edges.iter().map(over).sum();
            (effect, StoredEnergy::Elastic(0.5 * axial * all))
        });
        let excess = |joint: &Joint| (joint.turn_at(x).length() - joint.bent).powi(2) / joint.width;
        let bend = self.bend.map(|(effect, rigidity)| {
            let all: f64 = self.joints.iter().map(excess).sum();
            (effect, StoredEnergy::Elastic(0.5 * rigidity * all))
        });
        stretch.into_iter().chain(bend).collect()
    }
}
