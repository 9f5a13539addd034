//! Stretch, shear and strain limit of a cloth's triangles.
//!
//! Warp and weft of a triangle of area A have the images u and v ([`Membrane`]). It stores ½k_u·A·(|u| − 1)² + ½k_v·A·(|v| − 1)²
//! + ½G·A·(u·v)² (Baraff and Witkin 1998).
//!
//! **Strain limit.** F = (u, v) may stretch no direction beyond L: the eigenvalues of FᵀF − L² are not positive. This is a
//! condition on a symmetric matrix, so its multiplier Λ is one as well. With S = Λ + κ(FᵀF − L²) and its positive part P, the
//! augmented Lagrangian is |P|²/2κ, and Λ ← P after each Newton step. (Two multipliers for the two principal stretches would jump
//! where these are equal.) Its gradient is 2(P₁₁u + P₁₂v) on u and 2(P₁₂u + P₂₂v) on v. Its second derivative is 2P along all
//! axes, and 4κ·Σ Ωᵢⱼ·gᵢⱼgᵢⱼᵀ with the derivatives gᵢⱼ of the entries of S in its own axes. Ω is one for two positive
//! eigenvalues, σ₁/(σ₁ − σ₂) for a positive and a negative one, and zero otherwise.

use super::constants::{LIMIT_CHANGE, RECOVERY, STIFFER_THAN_LIMITS};
use super::matrix::{Matrix, PAIRS, outer};
use super::term::{Prediction, Renewed, Term};
use crate::model::edge_lengths::Lengths;
use crate::model::energy::{Configuration, StoredEnergy};
use crate::model::length::{larger, length};
use crate::model::membrane::{Flat, Membrane, all};
use crate::model::step::TimeStep;
use crate::world::Cloth;
use selvedge_core::glam::{DVec3, Mat3A, Vec3, Vec3A};

/// A vector shorter than this has no reliable direction.
const SHORTEST: f64 = 1e-6;

/// The membranes of a cloth.
#[derive(Debug)]
pub(crate) struct Membranes {
    /// The first triangle among those of all cloths.
    first_triangle: usize,
    first_vertex: usize,
    triangles: Vec<Triangle>,
    /// The effects of stretch, shear and strain limit.
    stretch: Option<usize>,
    shear: Option<usize>,
    limit: Option<Limit>,
    /// The images of warp and weft at the last positions.
    images: Vec<[DVec3; 2]>,
}

#[derive(Clone, Copy, Debug)]
struct Triangle {
    vertices: [u32; 3],
    membrane: Membrane,
    area: f64,
    /// The stiffnesses of warp, weft and shear, times the area, in J.
    stiffness: [f64; 3],
}

/// The entries 11, 12 and 22 of a symmetric matrix.
type Symmetric = [f64; 3];

#[derive(Debug)]
struct Limit {
    limit: f64,
    /// The square of the largest stretch of each triangle in this step.
    squared: Vec<f64>,
    longest: Lengths,
    /// κ of each triangle, in J.
    stiffness: Vec<f64>,
    /// Λ of each triangle in this solve, and at the end of the last accepted step.
    multipliers: Vec<Symmetric>,
    accepted: Vec<Symmetric>,
    acting: Vec<Acting>,
}

/// The positive part of S.
#[derive(Clone, Copy, Debug, Default)]
struct Acting {
    /// The eigenvalues of S, the larger one first. The limit acts if it is positive.
    values: [f64; 2],
    /// The cosine and the sine of the first axis.
    axis: [f64; 2],
    positive: Symmetric,
}

impl Membranes {
    pub(crate) fn new(cloth: &Cloth, first_vertex: u32, first_triangle: usize) -> Self {
        let triangle = |vertices: &[u32; 3]| {
            let Flat { membrane, area, .. } = Flat::new(cloth, *vertices);
            Triangle {
                vertices: vertices.map(|vertex| first_vertex + vertex),
                membrane,
                area,
                stiffness: [0.0; 3],
            }
        };
        let triangles: Vec<_> = cloth.mesh.triangles.iter().map(triangle).collect();
        Self {
            first_triangle,
            first_vertex: first_vertex as usize,
            images: vec![[DVec3::ZERO; 2]; triangles.len()],
            triangles,
            stretch: None,
            shear: None,
            limit: None,
        }
    }

    /// Sets the stiffness along warp and weft, in N/m, of the effect of this index.
    pub(crate) fn stretch(&mut self, effect: usize, stiffness: [f64; 2]) {
        self.stretch = Some(effect);
        for triangle in &mut self.triangles {
            triangle.stiffness[..2].copy_from_slice(&stiffness.map(|k| k * triangle.area));
        }
    }

    /// Sets the stiffness of shear, in N/m.
    pub(crate) fn shear(&mut self, effect: usize, stiffness: f64) {
        self.shear = Some(effect);
        self.triangles
            .iter_mut()
            .for_each(|own| own.stiffness[2] = stiffness * own.area);
    }

    /// Sets the largest stretch along any direction.
    pub(crate) fn limit(&mut self, limit: f64, cloth: &Cloth) {
        let count = self.triangles.len();
        self.limit = Some(Limit {
            limit,
            squared: vec![limit * limit; count],
            longest: Lengths::new(&cloth.mesh, limit),
            stiffness: vec![0.0; count],
            multipliers: vec![[0.0; 3]; count],
            accepted: vec![[0.0; 3]; count],
            acting: vec![Acting::default(); count],
        });
    }
}

impl Triangle {
    #[inline(always)]
    fn images(&self, x: &[DVec3]) -> [DVec3; 2] {
        let [first, second, third] = self.vertices.map(|vertex| x[vertex as usize]);
        let (one, other) = (second - first, third - first);
        let Membrane { a, b } = self.membrane;
        [one * a[0] + other * a[1], one * b[0] + other * b[1]]
    }

    /// Returns the gradient on the images, and the energy.
    #[inline(always)]
    fn elastic(&self, [u, v]: [DVec3; 2]) -> ([DVec3; 2], f64) {
        let [warp, weft, shear] = self.stiffness;
        let ([along_u, along_v], angle) = ([length(u), length(v)], u.dot(v));
        let (longer_u, longer_v) = (along_u - 1.0, along_v - 1.0);
        let by = |stiffness: f64, longer: f64, length: f64| if length > SHORTEST { stiffness * longer / length } else { 0.0 };
        let of_u = u * by(warp, longer_u, along_u) + v * (shear * angle);
        let of_v = v * by(weft, longer_v, along_v) + u * (shear * angle);
        let energy = 0.5 * (warp * longer_u * longer_u + weft * longer_v * longer_v + shear * angle * angle);
        ([of_u, of_v], energy)
    }

    /// Adds the gradient on the images to that of the corners.
    #[inline(always)]
    fn scatter(&self, [of_u, of_v]: [DVec3; 2], gradient: &mut [DVec3]) {
        let Membrane { a, b } = self.membrane;
        let (second, third) = (of_u * a[0] + of_v * b[0], of_u * a[1] + of_v * b[1]);
        let [i, j, k] = self.vertices.map(|vertex| vertex as usize);
        gradient[i] -= second + third;
        gradient[j] += second;
        gradient[k] += third;
    }

    /// Returns the convex part of the second derivative between two corners, for each of the [`PAIRS`]. A compressed direction
    /// resists no move across, and of shear only the product of first derivatives counts.
    #[inline(always)]
    fn curvature(&self, images: [DVec3; 2]) -> [Mat3A; 3] {
        let [warp, weft, shear] = self.stiffness.map(|k| k as f32);
        let [u, v] = images.map(|image| image.as_vec3a());
        let (of_warp, of_weft) = (stretch(warp, u), stretch(weft, v));
        let [a, b] = [all(self.membrane.a), all(self.membrane.b)];
        let angles = [0, 1, 2].map(|k| v * a[k] as f32 + u * b[k] as f32);
        let block = |[i, j]: [usize; 2]| {
            let in_plane = of_warp * (a[i] * a[j]) as f32 + of_weft * (b[i] * b[j]) as f32;
            in_plane + outer(angles[i] * shear, angles[j])
        };
        [block(PAIRS[0]), block(PAIRS[1]), block(PAIRS[2])]
    }
}

/// Returns the second derivative of the energy of stretch of an image.
#[inline(always)]
fn stretch(stiffness: f32, image: Vec3A) -> Mat3A {
    let length = image.length();
    let inverse = if length > SHORTEST as f32 { length.recip() } else { 0.0 };
    let direction = image * inverse;
    // `max` is a call on WebAssembly.
    let across = if inverse < 1.0 { 1.0 - inverse } else { 0.0 };
    outer(direction * (stiffness * (1.0 - across)), direction) + Mat3A::from_diagonal(Vec3::splat(stiffness * across))
}

impl Limit {
    /// Finds the squares of the largest stretches of triangles in a step. What a solve may leave comes back at once. A blow may
    /// leave more, which comes back at a [rate](RECOVERY): in one step it would become speed.
    fn find_squares(&mut self, triangles: &[Triangle], step: &TimeStep<'_>) {
        let limit = self.limit * self.limit;
        let left = 2.0 * self.limit * LIMIT_CHANGE;
        let stays = 1.0 - (RECOVERY * step.h).min(1.0);
        for (squared, triangle) in self.squared.iter_mut().zip(triangles) {
            let [u, v] = triangle.images(step.start);
            let [of_u, of_v, both] = [u.length_squared(), v.length_squared(), u.dot(v)];
            let half = 0.5 * (of_u - of_v);
            let largest = 0.5 * (of_u + of_v) + (half * half + both * both).sqrt();
            *squared = limit + larger(largest - limit - left, 0.0) * stays;
        }
    }

    /// Finds the positive part of S, and returns its energy.
    #[inline(always)]
    fn act(&mut self, triangle: usize, [u, v]: [DVec3; 2]) -> f64 {
        let (stiffness, squared) = (self.stiffness[triangle], self.squared[triangle]);
        let multipliers = self.multipliers[triangle];
        let s = [
            multipliers[0] + stiffness * (u.length_squared() - squared),
            multipliers[1] + stiffness * u.dot(v),
            multipliers[2] + stiffness * (v.length_squared() - squared),
        ];
        let (middle, half) = (0.5 * (s[0] + s[2]), 0.5 * (s[0] - s[2]));
        let spread = (half * half + s[1] * s[1]).sqrt();
        let acting = &mut self.acting[triangle];
        acting.values = [middle + spread, middle - spread];
        if !(acting.values[0] > 0.0) {
            acting.positive = [0.0; 3];
            return 0.0;
        }
        let [first, second] = [acting.values[0], if acting.values[1] > 0.0 { acting.values[1] } else { 0.0 }];
        acting.axis = axis(half, s[1], spread);
        let [cosine, sine] = acting.axis;
        acting.positive = [
            first * cosine * cosine + second * sine * sine,
            (first - second) * sine * cosine,
            first * sine * sine + second * cosine * cosine,
        ];
        0.5 * (first * first + second * second) / stiffness
    }

    /// Adds the second derivative to the blocks between the corners.
    #[inline]
    fn add_curvature(&self, place: usize, triangle: &Triangle, [u, v]: [DVec3; 2], blocks: &mut [Mat3A; 3]) {
        let Acting {
            values: [first, second],
            axis: [cosine, sine],
            ..
        } = self.acting[place];
        let [a, b] = [all(triangle.membrane.a), all(triangle.membrane.b)];
        let along: [f32; 3] = [0, 1, 2].map(|i| (cosine * a[i] + sine * b[i]) as f32);
        let across: [f32; 3] = [0, 1, 2].map(|i| (cosine * b[i] - sine * a[i]) as f32);
        let stiffness = self.stiffness[place] as f32;
        let (of_second, mixed) = if second > 0.0 {
            (1.0, 1.0)
        } else {
            (0.0, (first / (first - second)) as f32)
        };
        let [pull, other_pull] = [first, larger(second, 0.0)].map(|value| (2.0 * value) as f32);
        let (n, m) = ((u * cosine + v * sine).as_vec3a(), (v * cosine - u * sine).as_vec3a());
        for (block, [i, j]) in blocks.iter_mut().zip(PAIRS) {
            *block += Mat3A::from_diagonal(Vec3::splat(pull * along[i] * along[j] + other_pull * across[i] * across[j]));
            *block += outer(n * (4.0 * stiffness * along[i] * along[j]), n);
            *block += outer(m * (4.0 * stiffness * of_second * across[i] * across[j]), m);
            let turned = |i: usize| n * across[i] + m * along[i];
            *block += outer(turned(i) * (2.0 * stiffness * mixed), turned(j));
        }
    }
}

/// Returns the cosine and the sine of the first principal axis.
#[inline(always)]
fn axis(half: f64, shear: f64, spread: f64) -> [f64; 2] {
    if !(spread > 0.0) {
        return [1.0, 0.0];
    }
    let [x, y] = if half >= 0.0 {
        [half + spread, shear]
    } else {
        [shear, spread - half]
    };
    let length = (x * x + y * y).sqrt();
    [x / length, y / length]
}

/// Returns the gradient of the limit on the images.
#[inline(always)]
fn pull([u, v]: [DVec3; 2], p: Symmetric) -> [DVec3; 2] {
    [(u * p[0] + v * p[1]) * 2.0, (u * p[1] + v * p[2]) * 2.0]
}

impl Term for Membranes {
    fn begin(&mut self, step: &TimeStep<'_>, prediction: &Prediction, _: &[DVec3]) {
        let Some(limit) = &mut self.limit else { return };
        limit.multipliers.clone_from(&limit.accepted);
        limit.find_squares(&self.triangles, step);
        for (stiffness, triangle) in limit.stiffness.iter_mut().zip(&self.triangles) {
            // As stiff as the cloth, or as its masses where they are more.
            let [a, b] = [all(triangle.membrane.a), all(triangle.membrane.b)];
            let steep: f64 = (0..3).map(|k| a[k] * a[k] + b[k] * b[k]).sum::<f64>() / 6.0;
            let masses = triangle.vertices.iter().map(|&vertex| prediction.masses[vertex as usize]);
            let own = larger(triangle.stiffness[0], triangle.stiffness[1]) + masses.sum::<f64>() / (3.0 * steep);
            *stiffness = STIFFER_THAN_LIMITS * larger(own, f64::MIN_POSITIVE) / (4.0 * limit.limit * limit.limit);
        }
    }

    fn gradient(&mut self, x: &[DVec3], gradient: &mut [DVec3]) -> f64 {
        let mut energy = 0.0;
        for (place, triangle) in self.triangles.iter().enumerate() {
            let images = triangle.images(x);
            let (mut on_images, own) = triangle.elastic(images);
            energy += own;
            if let Some(limit) = &mut self.limit {
                energy += limit.act(place, images);
                let acting = &limit.acting[place];
                if acting.values[0] > 0.0 {
                    let [of_u, of_v] = pull(images, acting.positive);
                    on_images = [on_images[0] + of_u, on_images[1] + of_v];
                }
            }
            triangle.scatter(on_images, gradient);
            self.images[place] = images;
        }
        energy
    }

    fn curvature(&mut self, _: &[DVec3], matrix: &mut Matrix) {
        for (place, (triangle, images)) in self.triangles.iter().zip(&self.images).enumerate() {
            let mut blocks = triangle.curvature(*images);
            if let Some(limit) = &self.limit
                && limit.acting[place].values[0] > 0.0
            {
                limit.add_curvature(place, triangle, *images, &mut blocks);
            }
            matrix.add_triangle(self.first_triangle + place, blocks);
        }
    }

    fn renew(&mut self, _: &[DVec3], gradient: &mut [DVec3]) -> Renewed {
        let mut renewed = Renewed::default();
        let Some(limit) = &mut self.limit else { return renewed };
        for (place, triangle) in self.triangles.iter().enumerate() {
            let before = limit.acting[place];
            let old = limit.multipliers[place];
            if !(before.values[0] > 0.0) && old == [0.0; 3] {
                continue;
            }
            let stiffness = limit.stiffness[place];
            let energy = |own: &Acting| {
                own.values
                    .into_iter()
                    .map(|value| if value > 0.0 { value * value } else { 0.0 })
                    .sum::<f64>()
            };
            let energy_before = energy(&before);
            let change = [0, 1, 2].map(|k| before.positive[k] - old[k]);
            let squared = change[0] * change[0] + 2.0 * change[1] * change[1] + change[2] * change[2];
            // κ changes a squared stretch by 2L times the change of the stretch.
            let error = squared.sqrt() / (2.0 * limit.limit * stiffness * LIMIT_CHANGE);
            if error > renewed.error {
                renewed.error = error;
            }
            limit.multipliers[place] = before.positive;
            let images = self.images[place];
            limit.act(place, images);
            let now = limit.acting[place];
            renewed.energy += 0.5 * (energy(&now) - energy_before) / stiffness;
            let by = [0, 1, 2].map(|k| now.positive[k] - before.positive[k]);
            triangle.scatter(pull(images, by), gradient);
        }
        renewed
    }

    fn accept(&mut self, is_moved: &[bool]) {
        let Some(limit) = &mut self.limit else { return };
        for (place, triangle) in self.triangles.iter().enumerate() {
            let is_moved = triangle.vertices.iter().any(|&vertex| is_moved[vertex as usize]);
            limit.accepted[place] = if is_moved { [0.0; 3] } else { limit.multipliers[place] };
        }
    }

    fn multipliers(&self) -> Vec<f64> {
        self.limit
            .iter()
            .flat_map(|limit| limit.accepted.as_flattened().to_vec())
            .collect()
    }

    fn set_multipliers(&mut self, numbers: &[f64]) {
        if let Some(limit) = &mut self.limit {
            limit.accepted.as_flattened_mut().copy_from_slice(numbers);
        }
    }

    fn forget(&mut self) {
        if let Some(limit) = &mut self.limit {
            limit.accepted.fill([0.0; 3]);
        }
    }

    fn is_inner(&self) -> bool {
        true
    }

    fn over_limit(&self, positions: &[DVec3]) -> Option<f64> {
        let limit = self.limit.as_ref()?;
        Some(limit.longest.largest(&positions[self.first_vertex..]))
    }

    fn energy(&self, now: &Configuration<'_>, _: usize) -> Vec<(usize, StoredEnergy)> {
        let sum = |kept: [f64; 3]| {
            let of = |triangle: &Triangle| {
                let stiffness = [0, 1, 2].map(|k| triangle.stiffness[k] * kept[k]);
                Triangle { stiffness, ..*triangle }.elastic(triangle.images(now.positions)).1
            };
            StoredEnergy::Elastic(self.triangles.iter().map(of).sum())
        };
        let stretch = self.stretch.map(|effect| (effect, sum([1.0, 1.0, 0.0])));
        stretch
            .into_iter()
            .chain(self.shear.map(|effect| (effect, sum([0.0, 0.0, 1.0]))))
            .collect()
    }
}
