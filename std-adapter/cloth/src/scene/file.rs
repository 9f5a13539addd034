//! Scenes from TOML files.

use super::{
    OnBlocked, START, Scene, TIME_STEP, TangledStart, check_name, check_start, duration_field, frame_rate_field, steps_of_frame,
};
use crate::effects::{self, Called, Effects, Gravity, Wrong};
use crate::input::{LARGEST_TIME, SceneContext, SceneError, Source, Table};
use crate::solve::Accuracy;
use crate::world::{Body, Cloth, SceneParts};
use selvedge_core::glam::DVec3;
use selvedge_files::FileSource;
use selvedge_files::mesh::Findings;
use std::path::Path;

impl Scene {
    /// Reads a scene file. Paths in it are relative to its folder.
    ///
    /// # Errors
    /// Returns an error if the file cannot be read or contains an error. The message names file, line and column.
    pub fn read(path: &Path) -> Result<Self, SceneError> {
        Self::read_in(path, &SceneContext::default())
    }

    /// Reads a scene file like [`read`](Self::read), with the files and meshes that it names.
    ///
    /// # Errors
    /// Those of [`read`](Self::read).
    pub fn read_in(path: &Path, context: &SceneContext) -> Result<Self, SceneError> {
        let bytes = std::fs::read(path).map_err(|error| {
            let message = match path.is_dir() {
                true => "this is a folder; name a scene file in it".to_owned(),
                false => format!("cannot be read: {error}"),
            };
            SceneError::whole(path, message)
        })?;
        let text = String::from_utf8(bytes)
            .map_err(|_| SceneError::whole(path, "is not UTF-8 text; a scene is a TOML file".to_owned()))?;
        Self::parse_in(&text, path, context)
    }

    /// Reads a scene from the text of a file. `path` appears in messages, and paths in the text are relative to its folder.
    ///
    /// # Errors
    /// Returns an error if the text contains an error. The message names file, line and column.
    pub fn parse(text: &str, path: &Path) -> Result<Self, SceneError> {
        Self::parse_in(text, path, &SceneContext::default())
    }

    /// Reads a scene from the text of a file like [`parse`](Self::parse), and the files that it names from `files`.
    ///
    /// ```
    /// use selvedge_cloth::files::FileSource;
    /// use selvedge_cloth::{Scene, WALKER};
    ///
    /// let [(name, text), rest @ ..] = WALKER;
    /// let files = FileSource::Memory(rest.into_iter().map(|(name, bytes)| (name.into(), bytes.to_vec())).collect());
    /// # if cfg!(feature = "gltf") {
    /// let scene = Scene::parse_with_files(std::str::from_utf8(text)?, name.as_ref(), &files)?;
    /// assert_eq!(scene.cloths.len(), 1);
    /// # }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`parse`](Self::parse).
    pub fn parse_with_files(text: &str, path: &Path, files: &FileSource) -> Result<Self, SceneError> {
        let files = files.clone();
        Self::parse_in(
            text,
            path,
            &SceneContext {
                files,
                ..SceneContext::default()
            },
        )
    }

    /// Reads a scene from the text of a file like [`parse`](Self::parse), with the files and meshes that it names.
    ///
    /// # Errors
    /// Those of [`parse`](Self::parse).
    pub fn parse_in(text: &str, path: &Path, context: &SceneContext) -> Result<Self, SceneError> {
        let root = toml::de::DeTable::parse(text).map_err(|error| {
            let span = error.span().unwrap_or(0..0);
            SceneError::at(path, text, &span, error.message().trim().replace('\n', ", "))
        })?;
        let source = Source { path, context, text };
        let root = Table::root(&source, root.get_ref());
        root.expect_keys(&[
            "name",
            "time_step",
            "duration",
            "frames_per_second",
            "on_blocked",
            START,
            "accuracy",
            "cloth",
            "body",
            "effects",
        ])?;
        let fixed = root.number(&TIME_STEP)?;
        let frame_rate = root.number(&frame_rate_field(fixed.is_none()))?.unwrap_or(60.0);
        let time_step = fixed.unwrap_or_else(|| 1.0 / frame_rate / steps_of_frame(1.0 / frame_rate));
        let unlimited = context.is_run_by_code.then_some(LARGEST_TIME);
        let duration = root.number_or(&duration_field(time_step), |duration| duration, unlimited)?;
        let (cloths, remarks) = read_cloths(&root)?;
        let bodies = read_bodies(&root, time_step)?;
        let (effects, own) = read_effects(&root, &cloths, &bodies, time_step)?;
        let gravity = match root.table("effects")? {
            Some(table) => Gravity::read_acceleration(&table)?,
            None => None,
        };
        let choices = [
            ("stop", OnBlocked::Stop),
            ("hold", OnBlocked::Hold),
            ("yield", OnBlocked::Yield),
        ];
        let starts = [
            ("refuse", TangledStart::Refuse),
            ("tolerate", TangledStart::Tolerate),
            ("untangle", TangledStart::Untangle),
        ];
        let tangled_start = root.choice(START, &starts)?.unwrap_or_default();
        let called = Called::new(&effects, &cloths, own.clone());
        check_start(tangled_start, &called.names()).map_err(|error| root.placed(&error))?;
        let stem = path.file_stem().map(|stem| stem.to_string_lossy());
        Ok(Self {
            name: root
                .text("name")?
                .map_or_else(|| stem.unwrap_or_default().into_owned(), str::to_owned),
            frame_rate,
            by_frames: fixed.is_none(),
            on_blocked: root.choice("on_blocked", &choices)?.unwrap_or_default(),
            tangled_start,
            accuracy: root
                .choice("accuracy", &Accuracy::ALL.map(|accuracy| (accuracy.name(), accuracy)))?
                .unwrap_or_default(),
            up: gravity.map_or(DVec3::Z, |acceleration| -acceleration),
            text: text.to_owned(),
            remarks,
            time_step,
            duration,
            own: { cloths.iter() }.map(|cloth| cloth.name.clone()).zip(own).collect(),
            cloths,
            bodies,
            effects,
        })
    }
}

/// Reads `[cloth]`, or any number of `[[cloth]]`, without their own effects.
///
/// Returns remarks about their files as well.
fn read_cloths(root: &Table<'_>) -> Result<(Vec<Cloth>, Vec<String>), SceneError> {
    let mut cloths: Vec<Cloth> = Vec::new();
    let mut remarks = Vec::new();
    for table in root.one_or_more_tables("cloth")? {
        let (cloth, isolated) = Cloth::read(&table)?;
        if isolated > 0 {
            remarks.push(format!(
                "Isolated vertices in the file of the cloth '{}': {isolated}. They are left out, and the others are numbered without them.",
                cloth.name
            ));
        }
        let mut findings = Findings::of(&cloth.mesh.positions, &cloth.topology);
        let size = std::mem::take(&mut findings.size).max_element();
        if !(findings.coincident_vertices.is_empty() && findings.duplicate_triangles == 0) {
            remarks.push(format!("The file of the cloth '{}' has {findings}.", cloth.name));
        }
        if size > Findings::LARGE && table.has("file") {
            remarks.push(format!(
                "The cloth '{}' is {size:.0} m long. If its file is not in metres, `unit` says in what it is.",
                cloth.name
            ));
        }
        check_name("cloths", cloths.iter().map(|other| &other.name), &cloth.name).map_err(|error| table.placed(&error))?;
        cloths.push(cloth);
    }
    Ok((cloths, remarks))
}

fn read_bodies(root: &Table<'_>, time_step: f64) -> Result<Vec<Body>, SceneError> {
    let mut bodies: Vec<Body> = Vec::new();
    for table in root.any_tables("body")? {
        let body = Body::read(&table, time_step)?;
        check_name("bodies", bodies.iter().map(|other| &other.name), &body.name).map_err(|error| table.placed(&error))?;
        bodies.push(body);
    }
    Ok(bodies)
}

fn parts<'a>(root: &Table<'_>, cloths: &'a [Cloth], bodies: &'a [Body], time_step: f64) -> Result<SceneParts<'a>, SceneError> {
    SceneParts::new(cloths, bodies, time_step).map_err(|error| root.placed(&error))
}

/// Reads `[effects]` and the cloths' own effects, and checks them together.
fn read_effects(
    root: &Table<'_>,
    cloths: &[Cloth],
    bodies: &[Body],
    time_step: f64,
) -> Result<(Effects, Vec<Effects>), SceneError> {
    let tables = root.one_or_more_tables("cloth")?;
    let effects = root.table("effects")?;
    let of_scene = |world: &SceneParts<'_>| match &effects {
        Some(table) => effects::read(table, world),
        None => Ok(Effects::default()),
    };
    // The scene's effects take defaults from the material only if there is one cloth. Where there are several, each cloth of a
    // material gets effects of its own. Ropes have no material.
    let is_plain = |cloth: &Cloth| cloth.material.is_none() && cloth.has_triangles();
    let plain = cloths.iter().position(is_plain);
    let by_scene = of_scene(&parts(root, cloths, bodies, time_step)?.of_cloth(plain))?;
    let world = parts(root, cloths, bodies, time_step)?;
    let mut own = Vec::with_capacity(cloths.len());
    for (index, (table, cloth)) in tables.iter().zip(cloths).enumerate() {
        let world = world.of_cloth(Some(index));
        let mut effects = effects::read_known(table, &world)?;
        if cloth.material.is_some() && tables.len() > 1 {
            let of_scene = of_scene(&world)?;
            for name in ["stretch", "shear", "bend"] {
                if let Some(said) = of_scene.shared(name)
                    && effects.get(name).is_none()
                {
                    effects.add_shared(said);
                }
            }
        }
        own.push(effects);
    }
    let called = Called::new(&by_scene, cloths, own.clone());
    let place = |Wrong { name, cloth, error }: Wrong| {
        let above = cloth.map_or(effects.as_ref(), |cloth| tables.get(cloth)).unwrap_or(root);
        match above.table(name) {
            Ok(Some(table)) => table.placed(&error),
            _ => above.placed(&error),
        }
    };
    called.check(&world).map_err(place)?;
    Ok((by_scene, own))
}
