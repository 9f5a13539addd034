//! A cloth: its mesh, mass and initial velocity. Loose edges model ropes, laces and fringes.

use super::file_mesh::FileMesh;
use super::runs::{Run, runs};
use super::sleeve::{RefinementError, ring_sizes, sleeve};
use super::{Material, shapes};
use crate::identity::{Identify, Identity};
use crate::input::{
    AREA_DENSITY, Count, Field, LARGEST_COORDINATE, LENGTH, LINEAR_DENSITY, RATIO, SPEED, ValueError, suggestion,
};
use crate::model::triangle_edges::{edges_of, undirected};
use selvedge::{Mesh, Topology, TopologyError};
use selvedge_core::glam::DVec3;
use std::borrow::Cow;
use std::collections::HashSet;

/// A cloth at rest: its mesh, its density and its initial velocity.
///
/// ```
/// use selvedge_cloth::glam::DVec3;
/// use selvedge_cloth::{Cloth, Material};
///
/// let mut lining = Cloth::sheet(DVec3::ZERO, [DVec3::X, DVec3::Y], [10, 10], 0.08)?.named("lining");
/// lining.set_material(Material::SILK);
/// # Ok::<(), selvedge_cloth::ValueError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Cloth {
    /// The name in the scene and in messages, `cloth` by default. Names of cloths in a scene must differ.
    pub name: String,
    pub(crate) mesh: Mesh,
    pub(crate) topology: Topology,
    /// The positions at the start, if they are not those at rest.
    pub(super) start: Option<Vec<DVec3>>,
    /// The source vertex of each copy that a tear has made. Copies are the last vertices, in this order; a source may be a copy
    /// itself.
    copied: Vec<u32>,
    /// Mass per area in kg/m². Without triangles it has no meaning.
    pub density: f64,
    /// Mass per length of loose edges in kg/m. Without loose edges it has no meaning.
    pub linear_density: f64,
    /// The direction of the warp. Each triangle uses its projection.
    pub(crate) warp: DVec3,
    /// The initial velocity of all vertices, in m/s.
    pub velocity: DVec3,
    /// The material, if it was chosen by name.
    pub(crate) material: Option<Material>,
    /// The mesh of its file, if that numbers vertices otherwise.
    pub(crate) file: Option<FileMesh>,
    /// Named groups of vertices.
    parts: Vec<(&'static str, Vec<u32>)>,
}

impl Identify for Cloth {
    fn identify(&self, identity: &mut Identity) {
        let loose_edges: Vec<_> = self.topology.loose_edges().collect();
        let parts: [&dyn Identify; 8] = [
            &self.name,
            &self.density,
            &self.linear_density,
            &self.velocity,
            &self.warp,
            &self.mesh,
            &loose_edges,
            &self.start,
        ];
        parts.iter().for_each(|part| part.identify(identity));
    }
}

pub(crate) const NAME: &str = "cloth";

pub(crate) const CELLS: Count = Count::new("cells", 1, 2000);
pub(crate) const CELLS_AROUND: Count = Count::new("cells", 3, 2000);
pub(crate) const REFINEMENT: Count = Count::new("refinement", 1, 1000);
pub(crate) const CORNER: Field = Field::vector("corner", LENGTH, LARGEST_COORDINATE);
pub(crate) const FIRST: Field = Field::vector("first", LENGTH, LARGEST_COORDINATE);
pub(crate) const SECOND: Field = Field::vector("second", LENGTH, LARGEST_COORDINATE);
pub(crate) const FROM: Field = Field::vector("from", LENGTH, LARGEST_COORDINATE);
pub(crate) const TO: Field = Field::vector("to", LENGTH, LARGEST_COORDINATE);
pub(crate) const RADIUS: Field = Field::new("radius", LENGTH, 1e-3, LARGEST_COORDINATE);
pub(crate) const WARP: Field = Field::vector("warp", RATIO, LARGEST_COORDINATE);
pub(crate) const DENSITY: Field = Field::new("density", AREA_DENSITY, 1e-3, 100.0);
pub(crate) const LINEAR_DENSITY_OF_EDGES: Field = Field::new("linear_density", LINEAR_DENSITY, 1e-6, 100.0);
pub(crate) const POINTS: Field = Field::vector("points", LENGTH, LARGEST_COORDINATE);
pub(crate) const SEGMENTS: Count = Count::new("segments", 1, 100_000);
pub(crate) const VELOCITY: Field = Field::vector("velocity", SPEED, 1e3);

impl Cloth {
    /// Makes a parallelogram from a corner and two sides, in metres, with `cells` cells along each side; `density` is in kg/m².
    ///
    /// The warp follows the first side. Vertices are numbered row by row along the first side.
    ///
    /// Parts: `left`, `right`, `bottom`, `top`, and the corners, such as `bottom-left`.
    ///
    /// # Errors
    /// Returns an error if a number is out of range, or the sides are parallel.
    pub fn sheet(corner: DVec3, sides: [DVec3; 2], cells: [u32; 2], density: f64) -> Result<Self, ValueError> {
        CORNER.check_vector(corner)?;
        FIRST.check_vector(sides[0])?;
        SECOND.check_vector(sides[1])?;
        cells.into_iter().try_for_each(|count| CELLS.check(count))?;
        if sides[0].cross(sides[1]).length() < 0.1 * sides[0].length() * sides[1].length() || sides.contains(&DVec3::ZERO) {
            return Err(ValueError::new(
                "sides",
                "the two sides of the sheet must not be parallel or zero",
            ));
        }
        let [columns, rows] = cells;
        let at = |column: u32, row: u32| row * (columns + 1) + column;
        let parts = vec![
            ("left", (0..=rows).map(|row| at(0, row)).collect()),
            ("right", (0..=rows).map(|row| at(columns, row)).collect()),
            ("bottom", (0..=columns).map(|column| at(column, 0)).collect()),
            ("top", (0..=columns).map(|column| at(column, rows)).collect()),
            ("bottom-left", vec![at(0, 0)]),
            ("bottom-right", vec![at(columns, 0)]),
            ("top-left", vec![at(0, rows)]),
            ("top-right", vec![at(columns, rows)]),
        ];
        Self::with_parts(shapes::sheet(corner, sides, cells), sides[0], density, parts)
    }

    /// Makes an open tube between two points, in metres, with `cells` cells around and along it; `density` is in kg/m².
    ///
    /// The warp follows the axis.
    ///
    /// Parts: `start`, `end`.
    ///
    /// # Errors
    /// Returns an error if a number is out of range, or the two points are equal.
    pub fn tube([from, to]: [DVec3; 2], radius: f64, cells: [u32; 2], density: f64) -> Result<Self, ValueError> {
        FROM.check_vector(from)?;
        TO.check_vector(to)?;
        if from == to {
            return Err(ValueError::new(TO.name, "`from` and `to` are the same point"));
        }
        RADIUS.check(radius)?;
        cells.into_iter().try_for_each(|count| CELLS_AROUND.check(count))?;
        let mesh = shapes::tube([from, to], radius, cells);
        let count = mesh.positions.len() as u32;
        let parts = vec![
            ("start", (0..cells[0]).collect()),
            ("end", (count - cells[0]..count).collect()),
        ];
        Self::with_parts(mesh, to - from, density, parts)
    }

    /// Makes the paper's [`sleeve`]; `density` is in kg/m². The warp follows x.
    ///
    /// Parts: `shoulder`, `cuff`.
    ///
    /// # Errors
    /// Returns an error if a number is out of range.
    pub fn sleeve(refinement: u32, density: f64) -> Result<Self, ValueError> {
        REFINEMENT.check(refinement)?;
        let complain = |error: RefinementError| ValueError::new(REFINEMENT.name, error.to_string());
        let mesh = sleeve(refinement).map_err(complain)?;
        let sizes = ring_sizes(refinement).map_err(complain)?;
        let count = mesh.positions.len() as u32;
        let [first, last] = [sizes[0], sizes[sizes.len() - 1]];
        let parts = vec![("shoulder", (0..first).collect()), ("cuff", (count - last..count).collect())];
        Self::with_parts(mesh, DVec3::X, density, parts)
    }

    /// Makes a cloth from a mesh of proper triangles at rest, in metres. `warp` is the direction of the warp; each triangle uses
    /// its projection. `density` is in kg/m².
    ///
    /// # Errors
    /// Returns an error if a number is out of range, or the mesh has no triangles, triangles without area or vertices without
    /// triangles.
    pub fn from_mesh(mesh: Mesh, warp: DVec3, density: f64) -> Result<Self, ValueError> {
        Self::with_parts(mesh, warp, density, Vec::new())
    }

    /// Makes a cloth from a mesh with loose edges, which belong to no triangle: fringes, laces, or ropes alone.
    ///
    /// Each edge names two vertices of the mesh. Every vertex must be in a triangle or in a loose edge. `densities` are that of
    /// triangles in kg/m² and that of loose edges in kg/m.
    ///
    /// ```
    /// use selvedge_cloth::{Cloth, Mesh, glam::DVec3};
    ///
    /// let positions = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::NEG_X, DVec3::NEG_X * 2.0];
    /// let mesh = Mesh { positions, triangles: vec![[0, 1, 2]] };
    /// let tail = [[0, 3], [3, 4]];
    /// let kite = Cloth::from_mesh_with_loose_edges(mesh, &tail, DVec3::X, [0.05, 0.002])?;
    /// assert_eq!(kite.topology().loose_edges().len(), 2);
    /// # Ok::<(), selvedge_cloth::ValueError>(())
    /// ```
    ///
    /// # Errors
    /// Returns the errors of [`from_mesh`](Self::from_mesh), except that triangles may be missing if there are loose edges. Also
    /// returns an error if an edge names a missing vertex, repeats another edge, or is shorter than a hundredth of a millimetre.
    pub fn from_mesh_with_loose_edges(
        mesh: Mesh,
        loose_edges: &[[u32; 2]],
        warp: DVec3,
        densities: [f64; 2],
    ) -> Result<Self, ValueError> {
        Self::with_loose_edges(mesh, loose_edges, warp, densities, Vec::new())
    }

    fn with_parts(mesh: Mesh, warp: DVec3, density: f64, parts: Vec<(&'static str, Vec<u32>)>) -> Result<Self, ValueError> {
        Self::with_loose_edges(mesh, &[], warp, [density, 0.0], parts)
    }

    pub(super) fn with_loose_edges(
        mesh: Mesh,
        loose_edges: &[[u32; 2]],
        warp: DVec3,
        [density, linear_density]: [f64; 2],
        parts: Vec<(&'static str, Vec<u32>)>,
    ) -> Result<Self, ValueError> {
        WARP.check_vector(warp)?;
        shapes::check(&mesh)?;
        let topology = Topology::with_loose_features(mesh.positions.len(), mesh.triangles.clone(), loose_edges, &[]);
        let topology = topology.map_err(|error| ValueError::new("shape", error.to_string()))?;
        let statistics = topology.statistics();
        if statistics.degenerate_triangles > 0 || statistics.isolated_vertices > 0 {
            let hint = if statistics.isolated_vertices > 0 && loose_edges.is_empty() {
                "; give `linear_density` if lines `l` of the file join them"
            } else {
                ""
            };
            let message = format!("cloth must consist of proper triangles, but the mesh has {statistics}{hint}");
            return Err(ValueError::new("file", message));
        }
        check_triangles(&mesh)?;
        check_loose_edges(&mesh, loose_edges)?;
        let cloth = Self {
            name: NAME.to_owned(),
            density,
            linear_density,
            velocity: DVec3::ZERO,
            material: None,
            mesh,
            topology,
            start: None,
            copied: Vec::new(),
            warp,
            file: None,
            parts,
        };
        cloth.check_densities()?;
        Ok(cloth)
    }

    /// Returns the cloth with this name.
    #[must_use]
    pub fn named(self, name: &str) -> Self {
        let name = name.to_owned();
        Self { name, ..self }
    }

    /// Makes the cloth of a material, which sets its density. [`Stretch`](crate::effects::Stretch),
    /// [`Shear`](crate::effects::Shear) and [`Bend`](crate::effects::Bend) take the material's numbers, unless the scene adds
    /// these effects itself.
    pub fn set_material(&mut self, material: Material) -> &mut Self {
        self.density = material.density;
        self.material = Some(material);
        self
    }

    /// Checks the public fields.
    pub(crate) fn check(&self) -> Result<(), ValueError> {
        let checked = self.check_densities().and(VELOCITY.check_vector(self.velocity));
        checked.map_err(|error| error.with_owner(&self.name))
    }

    /// Checks the density of triangles and of loose edges, as far as the cloth has them.
    fn check_densities(&self) -> Result<(), ValueError> {
        if self.has_triangles() {
            DENSITY.check(self.density)?;
        }
        if self.has_loose_edges() {
            LINEAR_DENSITY_OF_EDGES.check(self.linear_density)?;
        }
        Ok(())
    }

    pub(crate) fn has_triangles(&self) -> bool {
        !self.mesh.triangles.is_empty()
    }

    pub(crate) fn has_loose_edges(&self) -> bool {
        self.topology.loose_edges().len() > 0
    }

    /// Returns the vertices and triangles at rest. The simulation starts from them, unless the cloth
    /// [starts elsewhere](Self::starting_at). [`topology`](Self::topology) has the loose edges.
    #[must_use]
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// Returns the edges, loose ones included.
    #[must_use]
    pub fn topology(&self) -> &Topology {
        &self.topology
    }

    /// Returns the mass in kg.
    #[must_use]
    pub fn mass(&self) -> f64 {
        self.masses().iter().sum()
    }

    /// Returns the mass of each vertex, in kg: a third of the mass of its triangles and half of that of its loose edges.
    pub(crate) fn masses(&self) -> Vec<f64> {
        let positions = &self.mesh.positions;
        let mut masses = vec![0.0; positions.len()];
        for triangle in &self.mesh.triangles {
            let [a, b, c] = triangle.map(|v| positions[v as usize]);
            let mass = self.density * 0.5 * (b - a).cross(c - a).length();
            for &vertex in triangle {
                masses[vertex as usize] += mass / 3.0;
            }
        }
        for edge in self.topology.loose_edges() {
            let [a, b] = edge.map(|v| positions[v as usize]);
            let mass = self.linear_density * a.distance(b);
            edge.iter().for_each(|&vertex| masses[vertex as usize] += mass / 2.0);
        }
        masses
    }

    fn loose_edges(&self) -> Vec<[u32; 2]> {
        self.topology.loose_edges().collect()
    }

    /// Returns the loose edges as rows of joined vertices. A row runs between places where a rope begins, ends or branches. A
    /// closed row ends with its first vertex.
    pub(crate) fn loose_rows(&self) -> Vec<Vec<u32>> {
        let runs = runs(&self.loose_edges(), self.mesh.positions.len()).into_iter();
        runs.map(Run::into_vertices).collect()
    }

    /// Returns the number of vertices before the cloth tore.
    pub(crate) fn vertices_as_made(&self) -> usize {
        self.mesh.positions.len() - self.copied.len()
    }

    /// Returns the vertex of the whole cloth from which a vertex was copied, or the vertex itself.
    pub(crate) fn as_made(&self, mut vertex: u32) -> u32 {
        // The source of a copy comes before the copy.
        while let Some(copy) = (vertex as usize).checked_sub(self.vertices_as_made()) {
            vertex = self.copied[copy];
        }
        vertex
    }

    /// Returns the source vertex of each copy, in the order of the copies, which are the last vertices. A source may be a copy
    /// itself.
    pub(crate) fn copy_sources(&self) -> &[u32] {
        &self.copied
    }

    /// Returns the vertices of the whole cloth from which the copies stem.
    pub(crate) fn sources_as_made(&self) -> Vec<u32> {
        self.copied.iter().map(|&vertex| self.as_made(vertex)).collect()
    }

    /// Returns the topology before the cloth tore.
    pub(crate) fn topology_as_made(&self) -> Cow<'_, Topology> {
        let made = || {
            let triangles = self.mesh.triangles.iter();
            let triangles = triangles.map(|triangle| triangle.map(|vertex| self.as_made(vertex)));
            Topology::with_loose_features(self.vertices_as_made(), triangles.collect(), &self.loose_edges(), &[])
        };
        match made() {
            Ok(made) if !self.copied.is_empty() => Cow::Owned(made),
            _ => Cow::Borrowed(&self.topology),
        }
    }

    /// Replaces the copies of vertices, each with its source before it, and the triangles. Loose edges keep their vertices.
    ///
    /// # Errors
    /// Returns an error if there are too many edges to count.
    pub(crate) fn tear(&mut self, copied: Vec<u32>, triangles: Vec<[u32; 3]>) -> Result<(), TopologyError> {
        let mut positions = self.mesh.positions[..self.vertices_as_made()].to_vec();
        copied.iter().for_each(|&vertex| positions.push(positions[vertex as usize]));
        self.topology = Topology::with_loose_features(positions.len(), triangles.clone(), &self.loose_edges(), &[])?;
        let count = self.vertices_as_made();
        if let Some(start) = &mut self.start {
            start.truncate(count);
            copied.iter().for_each(|&vertex| start.push(start[vertex as usize]));
        }
        (self.mesh, self.copied) = (Mesh { positions, triangles }, copied);
        Ok(())
    }

    /// Returns the vertices of a named part; `None` if there is no such part.
    #[must_use]
    pub fn part(&self, name: &str) -> Option<&[u32]> {
        let part = self.parts.iter().find(|(known, _)| *known == name);
        part.map(|(_, vertices)| vertices.as_slice())
    }

    /// Makes a cloth of 100 g/m² with its warp along x.
    #[cfg(test)]
    pub(crate) fn of(mesh: Mesh) -> Self {
        Self {
            name: NAME.to_owned(),
            topology: mesh.topology().unwrap(),
            start: None,
            copied: Vec::new(),
            mesh,
            density: 0.1,
            linear_density: 0.0,
            warp: DVec3::X,
            velocity: DVec3::ZERO,
            material: None,
            file: None,
            parts: Vec::new(),
        }
    }

    /// Returns the vertices of a part, or an error message about its name.
    pub(crate) fn named_part(&self, name: &str) -> Result<&[u32], String> {
        self.part(name).ok_or_else(|| {
            let names = self.parts.iter().map(|(known, _)| *known);
            format!("this cloth has no part '{name}'{}", suggestion(name, names))
        })
    }
}

/// The length of the shortest edge, in metres.
const SMALLEST_EDGE: f64 = 1e-5;
/// The area of the smallest triangle, in m²: that of a square with such edges.
const SMALLEST_AREA: f64 = SMALLEST_EDGE * SMALLEST_EDGE;

/// The smallest height of a triangle, in metres. Contact keeps less than that from the opposite edge, and cannot distinguish
/// nearer vertices.
const SMALLEST_HEIGHT: f64 = 1e-6;

/// Checks that no triangle is too small, and none so thin that contact blocks the cloth.
pub(super) fn check_triangles(mesh: &Mesh) -> Result<(), ValueError> {
    for (triangle, corners) in mesh.triangles.iter().enumerate() {
        let [a, b, c] = corners.map(|v| mesh.positions[v as usize]);
        let area = 0.5 * (b - a).cross(c - a).length();
        let lengths = [a.distance(b), b.distance(c), c.distance(a)];
        let height = 2.0 * area / lengths.into_iter().fold(0.0, f64::max);
        let message = if area < SMALLEST_AREA {
            format!(
                "has an area below {:.4} square millimetres; are the units metres?",
                1e6 * SMALLEST_AREA
            )
        } else if height < SMALLEST_HEIGHT {
            let [a, b, c] = corners;
            format!(
                "(vertices {a}, {b}, {c}) is only {height:.1e} m high: a sliver, which contact cannot keep apart from its neighbours; \
                 merge vertices that are so near with `weld = \"1 um\"`, or mesh it again"
            )
        } else {
            continue;
        };
        return Err(ValueError::new(
            "shape",
            format!("triangle {triangle} of the cloth {message}"),
        ));
    }
    Ok(())
}

/// Checks that each loose edge joins two distinct vertices that no other edge joins.
fn check_loose_edges(mesh: &Mesh, loose_edges: &[[u32; 2]]) -> Result<(), ValueError> {
    if loose_edges.is_empty() {
        return Ok(());
    }
    let wrong = |edge: usize, what: &str| {
        let message = format!("loose edge {edge} of the cloth {what}");
        Err(ValueError::new("shape", message))
    };
    let mut joined: HashSet<[u32; 2]> = edges_of(&mesh.triangles).map(undirected).collect();
    for (edge, &ends) in loose_edges.iter().enumerate() {
        let [from, to] = ends.map(|vertex| mesh.positions[vertex as usize]);
        if !(from.distance(to) >= SMALLEST_EDGE) {
            return wrong(
                edge,
                &format!("is shorter than {SMALLEST_EDGE:e} metres; are the units metres?"),
            );
        }
        if !joined.insert(undirected(ends)) {
            return wrong(edge, "joins two vertices that a triangle or another loose edge joins already");
        }
    }
    Ok(())
}
