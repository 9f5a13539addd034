//! Colours the surfaces. Light comes from a sun with shadows, the sky, the floor, and a lamp at the eye, which keeps folds in the
//! shade legible.

use super::raster::Raster;
use super::scenery::{Ray, Scenery, Surface};
use crate::report::colours::CLOTHS;
use selvedge_core::glam::{DVec3, dvec3};

type Colour = [f64; 3];

/// Colours of the page's light theme, as linear light. The fronts of cloths are [`CLOTHS`].
const LINING: DVec3 = dvec3(0.658, 0.332, 0.073_5);
const BODY: DVec3 = dvec3(0.481, 0.412, 0.358);
const SKY: [Colour; 2] = [[0.933, 0.945, 0.957], [0.835, 0.863, 0.890]];
const INK: Colour = [0.486, 0.529, 0.576];

/// The extent of the sun's view.
const REACH: f64 = 1.05;
/// The distance from a surface at which the sun is tested, so that coarse triangles do not shade themselves.
const LIFT: f64 = 0.012;

pub(super) struct Light {
    sun: DVec3,
    across: DVec3,
    along: DVec3,
    scale: f64,
    shadow: Raster,
}

impl Light {
    pub(super) fn new(surface: &Surface, size: usize) -> Self {
        let sun = dvec3(-0.5, 1.0, 0.65).normalize();
        let across = DVec3::Y.cross(sun).normalize();
        let along = sun.cross(across);
        let scale = 0.5 * size as f64 / REACH;
        let place = |point: DVec3| {
            [
                (point.dot(across) + REACH) * scale,
                (point.dot(along) + REACH) * scale,
                point.dot(sun),
            ]
        };
        Self {
            shadow: Raster::new(surface, [size; 2], |point| Some(place(point))),
            sun,
            across,
            along,
            scale,
        }
    }

    /// Returns the share of sunlight at a point, over a few samples around its place.
    fn sunlight(&self, point: DVec3) -> f64 {
        let [x, y] = [self.across, self.along].map(|axis| ((point.dot(axis) + REACH) * self.scale).floor() as isize);
        let height = point.dot(self.sun);
        let is_lit = |k: isize| {
            self.shadow
                .nearness(x + k % 5 - 2, y + k / 5 - 2)
                .is_none_or(|near| near <= height)
        };
        (0..25).filter(|&k| is_lit(k)).count() as f64 / 25.0
    }

    pub(super) fn on_surface(&self, surface: &Surface, triangle: usize, ray: &Ray, eye: DVec3) -> Colour {
        let vertices = surface.triangles[triangle].map(|vertex| vertex as usize);
        let [a, b, c] = vertices.map(|vertex| surface.points[vertex]);
        let flat = (b - a).cross(c - a);
        let faces_eye = flat.dot(ray.direction) < 0.0;
        let point = eye + ray.direction * ((a - eye).dot(flat) / ray.direction.dot(flat));
        // These are the weights of the corners, as areas.
        let shares = [(b, c), (c, a), (a, b)].map(|(p, q)| (p - point).cross(q - point).dot(flat).max(0.0));
        let outward: DVec3 = vertices
            .iter()
            .zip(shares)
            .map(|(&vertex, share)| surface.normals[vertex] * share)
            .sum();
        let outward = outward.try_normalize().unwrap_or_else(|| flat.normalize_or(DVec3::Y));
        let normal = if faces_eye { outward } else { -outward };

        let cloth = surface.cloths[triangle];
        let is_cloth = cloth.is_some();
        let base = match (cloth, faces_eye) {
            (Some(colour), true) => CLOTHS[colour].into(),
            (Some(_), false) => LINING,
            (None, _) => BODY,
        };
        let to_eye = -ray.direction.normalize();
        let facing = normal.dot(self.sun);
        let side = if outward.dot(self.sun) >= 0.0 { 1.0 } else { -1.0 };
        let sunlit = self.sunlight(point + outward * (side * LIFT));
        let direct = ((facing + 0.2) / 1.2).max(0.0) * (0.1 + 0.9 * sunlit);
        let ambient = dvec3(0.13, 0.12, 0.115).lerp(dvec3(0.30, 0.32, 0.36), 0.5 + 0.5 * normal.y);
        let towards = normal.dot(to_eye).clamp(0.0, 1.0);
        let away = 1.0 - towards;
        let gloss = normal.dot((self.sun + to_eye).normalize_or_zero()).max(0.0);
        let light = base * (ambient + 0.14 * towards + 0.85 * direct * dvec3(1.0, 0.97, 0.92));
        let light = match is_cloth {
            true => light + 0.16 * away * away * away * (base + 0.15),
            false => light + 0.08 * libm::pow(gloss, 32.0) * direct,
        };
        light.to_array().map(shown)
    }

    /// Returns the colour of the floor, or of the sky behind it. `down` is the share of the picture's height. `beside` are rays
    /// one pixel to the right and below.
    pub(super) fn on_floor(&self, scenery: &Scenery, ray: &Ray, beside: &[Ray; 2], eye: DVec3, down: f64) -> Colour {
        let [top, bottom] = SKY;
        let sky = [0, 1, 2].map(|k| top[k] + (bottom[k] - top[k]) * down);
        let place = |ray: &Ray| {
            let distance = (scenery.floor - eye.y) / ray.direction.y;
            (distance > 0.0).then(|| eye + ray.direction * distance)
        };
        let (Some(point), [Some(right), Some(below)]) = (place(ray), [place(&beside[0]), place(&beside[1])]) else {
            return sky;
        };
        let from_middle = (point.x * point.x + point.z * point.z).sqrt();
        let faded = ((from_middle - 0.9) / 1.7).clamp(0.0, 1.0);
        let fade = 1.0 - faded * faded * (3.0 - 2.0 * faded);
        if fade == 0.0 {
            return sky;
        }
        let line = [0, 2].into_iter().enumerate().map(|(k, axis)| {
            let cell = (point[axis] + scenery.origin[k]) / scenery.spacing;
            let width = ((right[axis] - point[axis]).abs() + (below[axis] - point[axis]).abs()) / scenery.spacing;
            let distance = (cell - cell.round()).abs() / width.max(1e-6);
            (1.3 - distance).clamp(0.0, 1.0) * (0.35 / width.max(1e-6)).clamp(0.0, 1.0)
        });
        let line = line.fold(0.0, f64::max) * 0.55 * fade;
        let shade = (1.0 - self.sunlight(point)) * 0.28 * fade;
        [0, 1, 2].map(|k| (INK[k] * line + sky[k] * (1.0 - line)) * (1.0 - shade))
    }
}

/// Converts linear light to a screen's value.
fn shown(light: f64) -> f64 {
    libm::pow(light.clamp(0.0, 1.0), 1.0 / 2.2)
}
