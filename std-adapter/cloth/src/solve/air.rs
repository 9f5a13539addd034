//! The push of moving air on triangles and on loose edges.
//!
//! A triangle of area A with the normal n and the velocity u of itself against the air feels −½ρcA|u·n|(u·n)n, a third at each
//! corner (Keller et al. 2003 use the same normal term). A loose edge of length L and diameter d feels −½ρcdL|u|u with the part u
//! of its velocity across it (the cross-flow principle; Hoerner, Fluid-Dynamic Drag, 1965, chapter 3), half at each end.
//!
//! The velocity is that at the end of the step. So light cloth goes with the wind and never overshoots it, and cloth that is held
//! feels the whole push. With r the time in which a move becomes a velocity, the push has the potential r/6·ρcA|u·n|³ for a
//! constant area and normal: both are those at the start of each Newton step.

use super::matrix::{Matrix, directed};
use super::term::{Prediction, Renewed, Term};
use crate::model::length::length;
use crate::model::step::TimeStep;
use selvedge_core::glam::DVec3;
use std::fmt::Debug;

/// The motion of the air.
pub(crate) trait Blowing: Debug + Send + Sync {
    /// Returns the velocity of the air at a triangle's corners or an edge's ends, in m/s, at a time in seconds.
    fn velocity(&self, corners: &[DVec3], time: f64) -> DVec3;

    /// Sets a new wind, in m/s. Returns false if it is no uniform wind.
    fn set(&mut self, _velocity: DVec3) -> bool {
        false
    }
}

/// A triangle or an edge in the air.
#[derive(Clone, Copy, Debug)]
struct Panel<const N: usize> {
    vertices: [u32; N],
    /// The velocity of the air, in m/s.
    air: DVec3,
    /// Half the density of the air, times drag and area, in kg/m; and the direction, at the start of the Newton step: the normal
    /// of a triangle, or the line of an edge.
    size: f64,
    direction: DVec3,
}

/// The triangles and loose edges of a cloth in the air.
#[derive(Debug)]
pub(crate) struct InAir<B> {
    air: B,
    /// Half the density of the air times the coefficient of drag, in kg/m³; and that times the diameter of loose edges.
    half_density: f64,
    of_edges: f64,
    triangles: Vec<Panel<3>>,
    first_triangle: usize,
    edges: Vec<Panel<2>>,
    base: Vec<DVec3>,
    rate: Vec<f64>,
}

impl<B: Blowing> InAir<B> {
    /// The first two numbers are half the density of the air times the coefficient of drag, in kg/m³, and the diameter of loose
    /// edges, in m. `first_triangle` is the place of the first triangle among those of all cloths.
    pub(crate) fn new(
        air: B,
        [half_density, diameter]: [f64; 2],
        (first_triangle, triangles): (usize, Vec<[u32; 3]>),
        edges: Vec<[u32; 2]>,
    ) -> Self {
        Self {
            first_triangle,
            air,
            half_density,
            of_edges: half_density * diameter,
            triangles: triangles.into_iter().map(Panel::new).collect(),
            edges: if diameter > 0.0 {
                edges.into_iter().map(Panel::new).collect()
            } else {
                Vec::new()
            },
            base: Vec::new(),
            rate: Vec::new(),
        }
    }

    /// Takes areas and directions at `x`.
    fn look(&mut self, x: &[DVec3]) {
        for panel in &mut self.triangles {
            let [a, b, c] = panel.vertices.map(|vertex| x[vertex as usize]);
            let normal = (b - a).cross(c - a);
            let twice = length(normal);
            panel.direction = if twice > 0.0 { normal / twice } else { DVec3::ZERO };
            panel.size = 0.5 * twice * self.half_density;
        }
        for panel in &mut self.edges {
            let [a, b] = panel.vertices.map(|vertex| x[vertex as usize]);
            let now = length(b - a);
            panel.direction = if now > 0.0 { (b - a) / now } else { DVec3::ZERO };
            panel.size = now * self.of_edges;
        }
    }

    /// Adds the gradient, times `by`, and returns the energy.
    fn push(&self, by: f64, x: &[DVec3], gradient: &mut [DVec3]) -> f64 {
        let mut energy = 0.0;
        for panel in &self.triangles {
            let (against, rate) = panel.against(x, &self.base, &self.rate);
            let across = against.dot(panel.direction);
            let push = panel.size * across.abs() * across;
            energy += rate * push * across / 3.0;
            panel.scatter(panel.direction * (by * push), gradient);
        }
        for panel in &self.edges {
            let (against, rate) = panel.against(x, &self.base, &self.rate);
            let across = against - panel.direction * against.dot(panel.direction);
            let speed = length(across);
            energy += rate * panel.size * speed.powi(3) / 3.0;
            panel.scatter(across * (by * panel.size * speed), gradient);
        }
        energy
    }
}

impl<const N: usize> Panel<N> {
    const fn new(vertices: [u32; N]) -> Self {
        Self {
            vertices,
            air: DVec3::ZERO,
            size: 0.0,
            direction: DVec3::ZERO,
        }
    }

    /// Returns the velocity against the air, and the mean rate.
    #[inline(always)]
    fn against(&self, x: &[DVec3], base: &[DVec3], rate: &[f64]) -> (DVec3, f64) {
        let (mut velocity, mut rates) = (DVec3::ZERO, 0.0);
        for vertex in self.vertices.map(|vertex| vertex as usize) {
            velocity += (x[vertex] - base[vertex]) / rate[vertex];
            rates += rate[vertex];
        }
        (velocity / N as f64 - self.air, rates / N as f64)
    }

    #[inline(always)]
    fn scatter(&self, force: DVec3, gradient: &mut [DVec3]) {
        for vertex in self.vertices {
            gradient[vertex as usize] += force / N as f64;
        }
    }
}

impl<B: Blowing> Term for InAir<B> {
    fn begin(&mut self, step: &TimeStep<'_>, prediction: &Prediction, x: &[DVec3]) {
        self.base.clone_from(&prediction.base);
        self.rate.clone_from(&prediction.rate);
        let time = step.time + step.h;
        for panel in &mut self.triangles {
            panel.air = self
                .air
                .velocity(&panel.vertices.map(|vertex| step.start[vertex as usize]), time);
        }
        for panel in &mut self.edges {
            panel.air = self
                .air
                .velocity(&panel.vertices.map(|vertex| step.start[vertex as usize]), time);
        }
        self.look(x);
    }

    fn gradient(&mut self, x: &[DVec3], gradient: &mut [DVec3]) -> f64 {
        self.push(1.0, x, gradient)
    }

    fn curvature(&mut self, x: &[DVec3], matrix: &mut Matrix) {
        for (place, panel) in self.triangles.iter().enumerate() {
            let (against, rate) = panel.against(x, &self.base, &self.rate);
            let stiffness = 2.0 * panel.size * against.dot(panel.direction).abs() / rate;
            let block = directed(panel.direction, stiffness / 9.0, 0.0);
            matrix.add_triangle(self.first_triangle + place, [block; 3]);
            // A corner itself has the block once, and the triangle's blocks imply minus twice of it.
            panel
                .vertices
                .into_iter()
                .for_each(|vertex| matrix.add_own(vertex, block * 3.0));
        }
        for panel in &self.edges {
            let (against, rate) = panel.against(x, &self.base, &self.rate);
            let across = against - panel.direction * against.dot(panel.direction);
            let stiffness = 2.0 * panel.size * length(across) / rate;
            matrix.add_link(&panel.vertices, &[0.5; 2], directed(panel.direction, 0.0, stiffness));
        }
    }

    fn renew(&mut self, x: &[DVec3], gradient: &mut [DVec3]) -> Renewed {
        let before = self.push(-1.0, x, gradient);
        self.look(x);
        let energy = self.push(1.0, x, gradient) - before;
        Renewed { energy, error: 0.0 }
    }

    fn is_load(&self) -> bool {
        true
    }

    fn set_wind(&mut self, velocity: DVec3) -> bool {
        self.air.set(velocity)
    }
}
