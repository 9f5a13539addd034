//! Finds the nearest triangle at each sample.

use super::scenery::Surface;
use selvedge_core::glam::DVec3;

const NOTHING: u32 = u32::MAX;

/// The nearest triangles from a point of view.
pub(super) struct Raster {
    width: usize,
    height: usize,
    /// The nearness, and the triangle.
    samples: Vec<(f32, u32)>,
}

impl Raster {
    /// Finds the nearest triangles. `see` maps a point to a place in pixels, from the left and from the top, and a nearness that
    /// is linear there. Triangles with a vertex that is out of sight (`None`) are left out.
    pub(super) fn new(surface: &Surface, [width, height]: [usize; 2], see: impl Fn(DVec3) -> Option<[f64; 3]>) -> Self {
        let mut raster = Self {
            width,
            height,
            samples: vec![(f32::NEG_INFINITY, NOTHING); width * height],
        };
        let seen: Vec<_> = surface.points.iter().map(|&point| see(point)).collect();
        for (index, triangle) in surface.triangles.iter().enumerate() {
            if let [Some(a), Some(b), Some(c)] = triangle.map(|vertex| seen[vertex as usize]) {
                raster.fill([a, b, c], index as u32);
            }
        }
        raster
    }

    /// Fills the samples whose middles are in the triangle or on its sides, where no earlier triangle is nearer.
    fn fill(&mut self, [a, b, c]: [[f64; 3]; 3], index: u32) {
        let doubled = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        if !(doubled != 0.0) {
            return;
        }
        let range = |axis: usize, size: usize| {
            let [a, b, c] = [a[axis], b[axis], c[axis]];
            // The conversion saturates.
            let first = (a.min(b).min(c) - 0.5).ceil() as usize;
            let last = (a.max(b).max(c) + 0.5).floor() as usize;
            first..last.min(size)
        };
        for y in range(1, self.height) {
            for x in range(0, self.width) {
                let (px, py) = (x as f64 + 0.5, y as f64 + 0.5);
                let side = |p: [f64; 3], q: [f64; 3]| ((q[0] - p[0]) * (py - p[1]) - (q[1] - p[1]) * (px - p[0])) / doubled;
                let weights = [side(b, c), side(c, a), side(a, b)];
                if weights.iter().all(|&weight| weight >= 0.0) {
                    let near = (weights[0] * a[2] + weights[1] * b[2] + weights[2] * c[2]) as f32;
                    let sample = &mut self.samples[y * self.width + x];
                    if near > sample.0 {
                        *sample = (near, index);
                    }
                }
            }
        }
    }

    pub(super) fn at(&self, x: usize, y: usize) -> Option<usize> {
        let (_, triangle) = self.samples[y * self.width + x];
        (triangle != NOTHING).then_some(triangle as usize)
    }

    /// Returns the nearness of the nearest triangle: negative infinity without one, `None` outside the picture.
    pub(super) fn nearness(&self, x: isize, y: isize) -> Option<f64> {
        let [x, y] = [usize::try_from(x).ok()?, usize::try_from(y).ok()?];
        (x < self.width && y < self.height).then(|| f64::from(self.samples[y * self.width + x].0))
    }
}
