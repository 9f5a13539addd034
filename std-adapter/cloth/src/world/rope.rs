//! Ropes: cloths of loose edges alone.

use super::Cloth;
use super::cloth::{POINTS, SEGMENTS};
use crate::input::ValueError;
use selvedge::Mesh;
use selvedge_core::glam::DVec3;

impl Cloth {
    /// Makes a rope along a line through these points, in `segments` segments of equal length. Points are in metres;
    /// `linear_density` is in kg/m.
    ///
    /// The rope cuts corners of the line by less than a segment. Vertices are numbered from the first point to the last.
    ///
    /// [`RopeStretch`](crate::effects::RopeStretch) and [`RopeBend`](crate::effects::RopeBend) set its resistance,
    /// [`SelfCollision`](crate::effects::SelfCollision) and [`BodyContact`](crate::effects::BodyContact) its thickness.
    ///
    /// Parts: `start` and `end`, the first and the last vertex.
    ///
    /// ```
    /// use selvedge_cloth::effects::{Gravity, PinGroup, Pins, RopeBend, RopeStretch};
    /// use selvedge_cloth::{Cloth, Scene, Simulation, glam::DVec3};
    ///
    /// let line = Cloth::rope(&[DVec3::ZERO, DVec3::X], 20, 0.05)?.named("line");
    /// let mut scene = Scene::new(line, 2e-3);
    /// let ends = ["start", "end"].iter().filter_map(|part| scene.part("line", part)).flatten().collect::<Vec<_>>();
    /// scene.add(Gravity::default()).add(RopeStretch::new(5e3)).add(RopeBend::straight(1e-4));
    /// scene.add(Pins { groups: vec![PinGroup::resting(ends)] });
    ///
    /// let mut simulation = Simulation::new(scene, 1)?;
    /// for _ in 0..100 {
    ///     simulation.step()?;
    /// }
    /// assert!(simulation.positions()[10].z < -1e-3 && simulation.edge_stretch().largest < 1.01);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Returns an error if a number is out of range, there are fewer than two points, or two successive points are equal.
    pub fn rope(points: &[DVec3], segments: u32, linear_density: f64) -> Result<Self, ValueError> {
        points.iter().try_for_each(|&point| POINTS.check_vector(point))?;
        SEGMENTS.check(segments)?;
        if points.len() < 2 || points.windows(2).any(|two| two[0] == two[1]) {
            let message = "a rope needs at least two points, and successive points must differ";
            return Err(ValueError::new(POINTS.name, message));
        }
        let mesh = Mesh::new(along(points, segments), Vec::new());
        let edges: Vec<[u32; 2]> = (0..segments).map(|first| [first, first + 1]).collect();
        let parts = vec![("start", vec![0]), ("end", vec![segments])];
        Self::with_loose_edges(mesh, &edges, DVec3::X, [0.0, linear_density], parts)
    }
}

/// Returns points spaced evenly by arc length on the line through `points`, both ends included.
fn along(points: &[DVec3], segments: u32) -> Vec<DVec3> {
    let lengths: Vec<f64> = points.windows(2).map(|two| two[0].distance(two[1])).collect();
    let whole: f64 = lengths.iter().sum();
    let (mut leg, mut before) = (0, 0.0);
    let at = |k: u32| {
        let along = whole * f64::from(k) / f64::from(segments);
        while leg + 1 < lengths.len() && along > before + lengths[leg] {
            before += lengths[leg];
            leg += 1;
        }
        points[leg].lerp(points[leg + 1], ((along - before) / lengths[leg]).min(1.0))
    };
    (0..=segments).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vertices_lie_on_the_line_evenly_from_its_first_point_to_its_last() {
        let corner = [DVec3::ZERO, DVec3::X, DVec3::new(1.0, 3.0, 0.0)];
        let rope = along(&corner, 8);
        assert_eq!((rope[0], rope[2], rope[8]), (corner[0], corner[1], corner[2]));
        assert!(rope.windows(2).all(|two| (two[0].distance(two[1]) - 0.5).abs() < 1e-12));
    }
}
