//! Seams: rows of vertices that are held together, or drawn together over a time ([`stitches`](crate::model::stitches)).
//!
//! **A seam keeps a gap.** Two rows at no distance would be in contact, and no state would be free. So a closed seam has a gap of
//! at least the thickness that contact keeps between the rows. (For cloth without a seam, use a mesh whose triangles share
//! vertices.)
//!
//! A seam does not resist bending.

use super::registration::{Effect, Registration, Scope};
use super::vertices::{no_vertex, of_cloth};
use crate::contact::Thickness;
use crate::effects::plan::{Fabric, Plan};
use crate::input::{Field, LARGEST_TIME, LENGTH, SPEED, SceneError, TIME, Table, ValueError};
use crate::model::stitches::{Sewing, Stitch, TIED, stitches};
use crate::solve::stitches::Stitches;
use crate::world::{FASTEST_VERTEX, SceneParts};
use selvedge_core::glam::DVec3;

const GAP: Field = Field::new("gap", LENGTH, 0.0, 0.1);
const CLOSING: Field = Field::new("closing", TIME, 1e-6, LARGEST_TIME);

pub(super) const REGISTRATION: Registration = Registration::new(&["seam"], |table, world| {
    let tables = table.tables("seam")?;
    let seams = { tables.iter() }
        .map(|table| read_seam(table, world))
        .collect::<Result<_, _>>()?;
    Ok(Box::new(Seams { seams }))
});

/// Rows of vertices of one cloth or of two that are sewn together.
///
/// ```
/// use selvedge_cloth::effects::{Seam, Seams, SelfCollision, Thickness};
/// use selvedge_cloth::glam::DVec3;
/// use selvedge_cloth::{Cloth, Scene, Simulation};
///
/// let panel = |x| Cloth::sheet(DVec3::X * x, [0.1 * DVec3::X, 0.1 * DVec3::Y], [6, 6], 0.2);
/// let mut scene = Scene::new(panel(0.0)?.named("left"), 2e-3);
/// scene.cloths.push(panel(0.12)?.named("right"));
/// let rows = [scene.part("left", "right"), scene.part("right", "left")].map(Option::unwrap_or_default);
/// let [first, second] = rows.clone();
/// scene.add(SelfCollision(Thickness::new(2e-3)));
/// scene.add(Seams { seams: vec![Seam { closing: Some(0.1), ..Seam::new(first, second) }] });
///
/// let mut simulation = Simulation::new(scene, 1)?;
/// for _ in 0..60 {
///     simulation.step()?;
/// }
/// let gap = simulation.positions()[rows[0][3] as usize].distance(simulation.positions()[rows[1][3] as usize]);
/// assert!((gap - 2e-3).abs() < 1e-4 && simulation.is_certified());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Seams {
    /// The seams, at least one.
    pub seams: Vec<Seam>,
}

/// Two rows of vertices that are sewn together, or two single vertices, such as the end of a rope and a vertex of cloth.
#[derive(Clone, Debug, PartialEq)]
pub struct Seam {
    /// Successive vertices, as the scene numbers them through all cloths. [`Scene::part`](crate::Scene::part) returns named ones.
    /// A closed row ends with its first vertex.
    pub first: Vec<u32>,
    /// The other row, from the same end. It may have another number of vertices.
    pub second: Vec<u32>,
    /// The distance of the rows when the seam is closed, in metres: at least the thickness that contact keeps between them, which
    /// is the default.
    pub gap: Option<f64>,
    /// The time after which the seam is closed, in seconds from the start. Until then the rows approach evenly. `None` holds the
    /// rows at their initial distance, or at the gap if that is larger.
    pub closing: Option<f64>,
}

impl Seam {
    /// Holds two rows at their initial distance.
    #[must_use]
    pub const fn new(first: Vec<u32>, second: Vec<u32>) -> Self {
        Self {
            first,
            second,
            gap: None,
            closing: None,
        }
    }

    /// Checks that there are two rows, and the numbers `gap` and `closing`.
    fn check(&self, rest: &[DVec3]) -> Result<(), ValueError> {
        for (name, row) in [("first", &self.first), ("second", &self.second)] {
            let wrong = |message| Err(ValueError::new(name, message));
            if let Some(&vertex) = row.iter().find(|&&vertex| vertex as usize >= rest.len()) {
                return wrong(no_vertex(vertex, rest.len()));
            }
            let is_step = |two: &[u32]| rest[two[0] as usize] != rest[two[1] as usize];
            let is_stitch = [&self.first, &self.second].iter().all(|row| row.len() == 1);
            if row.len() < 2 && !is_stitch || !row.windows(2).all(is_step) {
                let message = "a row of a seam needs at least two vertices, and successive vertices must differ in place; or both rows are single vertices";
                return wrong(message.to_owned());
            }
        }
        if let Some(vertex) = self.first.iter().find(|vertex| self.second.contains(vertex)) {
            let message = format!("vertex {vertex} is in both rows of a seam, but cannot be sewn to itself");
            return Err(ValueError::new("second", message));
        }
        self.gap.map_or(Ok(()), |gap| GAP.check(gap))?;
        self.closing.map_or(Ok(()), |closing| CLOSING.check(closing))
    }

    /// Returns the stitches, each with the initial distance of its points, in metres.
    fn stitches(&self, [rest, start]: [&[DVec3]; 2]) -> Vec<(Stitch, f64)> {
        let made = stitches(&self.first, &self.second, rest).into_iter();
        made.map(|stitch| (stitch, stitch.length(start))).collect()
    }

    /// Checks that the closed seam leaves contact its thickness, and that it does not close too fast.
    fn check_shapes(&self, shapes: [&[DVec3]; 2], thickness: f64) -> Result<(), ValueError> {
        let gap = self.gap.unwrap_or(thickness);
        if gap < thickness {
            let [gap, thickness] = [gap, thickness].map(|length| LENGTH.written(length));
            let message = format!(
                "`gap` is {gap}, but contact keeps {thickness} between the rows: choose at least that, or leave `gap` out"
            );
            return Err(ValueError::new(GAP.name, message));
        }
        let Some(closing) = self.closing else { return Ok(()) };
        let farthest = self.stitches(shapes).iter().map(|(_, start)| *start).fold(0.0, f64::max);
        let speed = (farthest - gap) / closing;
        if speed > FASTEST_VERTEX {
            let [speed, most] = [speed, FASTEST_VERTEX].map(|speed| SPEED.written(speed));
            let message =
                format!("the rows of the seam would close at {speed}, but the limit is {most}: choose a longer `closing`");
            return Err(ValueError::new(CLOSING.name, message));
        }
        Ok(())
    }
}

fn rest_of(world: &SceneParts<'_>) -> Vec<DVec3> {
    world.cloths.iter().flat_map(|cloth| &cloth.mesh.positions).copied().collect()
}

fn start_of(world: &SceneParts<'_>) -> Vec<DVec3> {
    world.cloths.iter().flat_map(|cloth| cloth.start()).copied().collect()
}

/// Returns the largest thickness that contact keeps between the rows of a seam, in metres; zero without contact.
fn thickness(seam: &Seam, world: &SceneParts<'_>, fabrics: &[Fabric]) -> f64 {
    let thickest = |row: &[u32]| {
        let cloths = world.vertices_of_cloths().zip(fabrics);
        let own = cloths.filter(|(vertices, _)| row.iter().any(|&vertex| vertices.contains(&(vertex as usize))));
        let own = own.map(|(_, fabric)| fabric.thickness.unwrap_or(0.0));
        Thickness::new(own.fold(0.0, f64::max))
    };
    thickest(&seam.first).between(thickest(&seam.second)).thickness
}

fn read_seam(table: &Table<'_>, world: &SceneParts<'_>) -> Result<Seam, SceneError> {
    table.expect_keys(&["first", "second", "reversed", "gap", "closing"])?;
    let row = |key: &str| {
        let table = table.required_table(key)?;
        table.expect_keys(&["cloth", "part", "vertices"])?;
        if table.has("part") == table.has("vertices") {
            let message = "a row of a seam needs either `part` or `vertices`".to_owned();
            return Err(table.error("vertices", message));
        }
        of_cloth(&table, world)
    };
    let mut seam = Seam::new(row("first")?, row("second")?);
    if table.flag("reversed")? {
        seam.second.reverse();
    }
    (seam.gap, seam.closing) = (table.number(&GAP)?, table.number(&CLOSING)?);
    seam.check(&rest_of(world)).map_err(|error| table.placed(&error))?;
    Ok(seam)
}

crate::identify!(Seams { seams });
crate::identify!(Seam {
    first,
    second,
    gap,
    closing
});

impl Effect for Seams {
    fn name(&self) -> &'static str {
        "seams"
    }

    fn scope(&self) -> Scope {
        Scope::Scene
    }

    fn check(&self, world: &SceneParts<'_>) -> Result<(), ValueError> {
        if self.seams.is_empty() {
            return Err(ValueError::new("seam", "seams need at least one [[effects.seams.seam]]"));
        }
        let rest = rest_of(world);
        self.seams.iter().try_for_each(|seam| seam.check(&rest))
    }

    fn check_fabrics(&self, world: &SceneParts<'_>, fabrics: &[Fabric]) -> Result<(), ValueError> {
        let (rest, start) = (rest_of(world), start_of(world));
        let mut seams = self.seams.iter();
        seams.try_for_each(|seam| seam.check_shapes([&rest, &start], thickness(seam, world, fabrics)))
    }

    fn register(&self, plan: &mut Plan<'_>) {
        let world = plan.scene();
        let (rest, start) = (rest_of(&world), start_of(&world));
        for seam in &self.seams {
            let seam = &Seam {
                first: world.numbered(&seam.first),
                second: world.numbered(&seam.second),
                ..*seam
            };
            let gap = seam.gap.unwrap_or_else(|| thickness(seam, &world, &plan.fabrics));
            let gap = if seam.first.len() == 1 { gap.max(TIED) } else { gap };
            let sewing = Sewing {
                stitches: seam.stitches([&rest, &start]),
                gap,
                closing: seam.closing,
            };
            plan.ties.extend(sewing.tied_vertices());
            plan.add_term(Stitches::new(sewing));
        }
    }
}
