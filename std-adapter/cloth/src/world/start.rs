//! Where a cloth starts, if that is not its shape at rest.

use super::cloth::{Cloth, check_triangles};
use super::shapes;
use crate::input::ValueError;
use selvedge::Mesh;
use selvedge_core::glam::DVec3;

impl Cloth {
    /// Returns the cloth, to start at other positions than those at rest: a garment that is made in one pose and worn in another.
    ///
    /// The mesh at rest stays what lengths, angles, areas, masses and the warp are measured on. There is one position for each
    /// vertex, in metres. Boxes and balls that select vertices select them where they start.
    ///
    /// ```
    /// use selvedge_cloth::effects::Stretch;
    /// use selvedge_cloth::glam::DVec3;
    /// use selvedge_cloth::{Cloth, Scene, Simulation};
    ///
    /// // A sheet that starts 10 % too long draws together.
    /// let sheet = Cloth::sheet(DVec3::ZERO, [DVec3::X, DVec3::Y], [10, 10], 0.2)?;
    /// let stretched = sheet.mesh().positions.iter().map(|position| *position * 1.1).collect();
    /// let mut scene = Scene::new(sheet.starting_at(stretched)?, 1e-3);
    /// scene.add(Stretch::isotropic(1000.0));
    /// let mut simulation = Simulation::new(scene, 1)?;
    /// assert!((simulation.edge_stretch().largest - 1.1).abs() < 1e-9);
    /// simulation.step()?;
    /// assert!(simulation.edge_stretch().largest < 1.1);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Returns an error if there is not one position for each vertex, or a triangle would have no area.
    pub fn starting_at(mut self, positions: Vec<DVec3>) -> Result<Self, ValueError> {
        let expected = self.mesh.positions.len();
        if positions.len() != expected {
            let message = format!(
                "there are {} positions to start at, but the cloth has {expected} vertices",
                positions.len()
            );
            return Err(ValueError::new("mesh", message));
        }
        let mesh = Mesh::new(positions, std::mem::take(&mut self.mesh.triangles));
        let checked = shapes::check(&mesh).and_then(|()| check_triangles(&mesh));
        (self.mesh.triangles, self.start) = (mesh.triangles, Some(mesh.positions));
        checked.map(|()| self)
    }

    /// Returns the positions from which the simulation starts, in metres.
    #[must_use]
    pub fn start(&self) -> &[DVec3] {
        self.start.as_deref().unwrap_or(&self.mesh.positions)
    }
}
