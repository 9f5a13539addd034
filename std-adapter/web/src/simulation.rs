//! The class `Simulation`.

use crate::numbers::{
    Bytes, Number, Numbers, Text, Texts, WholeNumbers, bytes, number, numbers, optional, short, text, texts, whole, wholes,
};
use crate::scene::{range, scene_of};
use crate::values::{Exception, Files, Positions, floats, object, take_positions, view, whole_numbers};
use js_sys::Float64Array;
use selvedge_cloth::glam::{DQuat, DVec3};
use selvedge_cloth::{
    Blocked, BroughtBody, DriveError, FrameError, Placement, SetupError, Simulation as Cloth, Wrench, vertex_normals,
};
use wasm_bindgen::{JsValue, prelude::wasm_bindgen};

/// A simulation of cloth. Each state is certified free of intersections, with the same bits as in native programs. SI units.
#[wasm_bindgen]
pub struct Simulation {
    cloth: Cloth,
    steps: u64,
    steps_per_frame: u64,
    time_step: f64,
    up: DVec3,
    settings: Vec<(String, String)>,
}

#[wasm_bindgen]
impl Simulation {
    /// Makes a simulation from the text of a scene (TOML) and the files that it names.
    ///
    /// Throws a `SceneError` that names line and column, or a `TangledError` if surfaces pass through each other.
    #[wasm_bindgen(constructor)]
    pub fn new(text: &Text, files: &Files) -> Result<Simulation, Exception> {
        let scene = scene_of(text, files)?;
        let (steps, steps_per_frame, time_step) = (scene.steps(), scene.steps_per_frame(), scene.time_step);
        let up = scene.up.normalize_or(DVec3::Z);
        let settings = scene.settings();
        let cloth = Cloth::new(scene, 1).map_err(|error| match error {
            SetupError::Tangled(tangled) => Exception::new("TangledError", &tangled),
            error => Exception::new("SceneError", &error),
        })?;
        Ok(Self {
            cloth,
            steps,
            steps_per_frame,
            time_step,
            up,
            settings,
        })
    }

    /// Runs steps. Throws a `BlockedError` if bodies or pins force the cloth where it cannot go and the scene stops then; the
    /// steps before it remain.
    pub fn step(&mut self, count: Option<Number>) -> Result<(), Exception> {
        let count = optional(count.as_ref(), "count", whole)?;
        for _ in 0..count.unwrap_or(1) {
            self.cloth.step()?;
        }
        Ok(())
    }

    /// Lets seconds pass, in as many steps as the cloth needs, and at most `most` (default 64). Returns both numbers.
    #[wasm_bindgen(unchecked_return_type = "{ steps: number; needed: number }")]
    pub fn advance(&mut self, seconds: &Number, most: Option<Number>) -> Result<JsValue, Exception> {
        let most = optional(most.as_ref(), "most", whole)?;
        let seconds = number(seconds, "seconds")?;
        let frame = self.cloth.advance_within(seconds, most.unwrap_or(64));
        let frame = frame.map_err(|error| match error {
            FrameError::Blocked(blocked) => blocked.into(),
            FrameError::Seconds(error) => Exception::input(&error),
        })?;
        Ok(object([("steps", frame.steps.into()), ("needed", frame.needed.into())]).into())
    }

    /// A view of the positions in metres: the vertices of the cloths, then of the bodies. Tearing adds vertices.
    #[wasm_bindgen(getter)]
    pub fn positions(&self) -> Float64Array {
        view(self.cloth.positions().as_ptr() as usize, self.cloth.positions().len())
    }

    /// A view of the velocities in m/s.
    #[wasm_bindgen(getter)]
    pub fn velocities(&self) -> Float64Array {
        view(self.cloth.velocities().as_ptr() as usize, self.cloth.velocities().len())
    }

    /// The unit normal at each vertex; zero for a vertex without a face.
    #[must_use]
    pub fn normals(&self) -> Vec<f64> {
        let mut normals = Vec::new();
        vertex_normals(self.cloth.positions(), self.cloth.triangles(), &mut normals);
        normals.iter().flat_map(DVec3::to_array).collect()
    }

    /// The vertices of each triangle, of the cloths and then of the bodies.
    #[wasm_bindgen(getter)]
    pub fn triangles(&self) -> Vec<u32> {
        self.cloth.triangles().as_flattened().to_vec()
    }

    /// The vertices of each loose edge: ropes, laces and fringes.
    #[wasm_bindgen(getter, js_name = looseEdges)]
    pub fn loose_edges(&self) -> Vec<u32> {
        self.cloth.loose_edges().as_flattened().to_vec()
    }

    /// The number of vertices of cloth, which come first.
    #[wasm_bindgen(getter, js_name = clothVertexCount)]
    pub fn cloth_vertex_count(&self) -> usize {
        self.cloth.cloth_vertices()
    }

    /// The number of triangles of cloth, which come first.
    #[wasm_bindgen(getter, js_name = clothTriangleCount)]
    pub fn cloth_triangle_count(&self) -> usize {
        self.cloth.cloth_triangles()
    }

    /// The names of the bodies, in the order of the scene.
    #[wasm_bindgen(getter, js_name = bodyNames)]
    pub fn body_names(&self) -> Vec<String> {
        self.cloth.body_names().to_vec()
    }

    /// The name of the scene.
    #[wasm_bindgen(getter)]
    pub fn name(&self) -> String {
        self.cloth.name().to_owned()
    }

    /// The direction against gravity, a unit vector.
    #[wasm_bindgen(getter)]
    pub fn up(&self) -> Vec<f64> {
        self.up.to_array().to_vec()
    }

    /// The scene's time step in seconds.
    #[wasm_bindgen(getter, js_name = timeStep)]
    pub fn time_step(&self) -> f64 {
        self.time_step
    }

    /// The number of steps in the scene's duration.
    #[wasm_bindgen(getter)]
    pub fn steps(&self) -> f64 {
        self.steps as f64
    }

    /// The number of steps from one frame to the next.
    #[wasm_bindgen(getter, js_name = stepsPerFrame)]
    pub fn steps_per_frame(&self) -> f64 {
        self.steps_per_frame as f64
    }

    /// The number of steps so far.
    #[wasm_bindgen(getter, js_name = stepsDone)]
    pub fn steps_done(&self) -> f64 {
        self.cloth.steps_done() as f64
    }

    /// The time simulated so far, in seconds.
    #[wasm_bindgen(getter)]
    pub fn time(&self) -> f64 {
        self.cloth.time()
    }

    /// The time by which bodies and pins lag behind their keyframes, in seconds.
    #[wasm_bindgen(getter)]
    pub fn lag(&self) -> f64 {
        self.cloth.lag()
    }

    /// True if the state is certified free of the intersections that the scene's contact effects name.
    #[wasm_bindgen(getter, js_name = isCertified)]
    pub fn is_certified(&self) -> bool {
        self.cloth.is_certified()
    }

    /// The number of steps in which bodies or pins had to wait.
    #[wasm_bindgen(getter, js_name = blockedSteps)]
    pub fn blocked_steps(&self) -> f64 {
        self.cloth.blocked_steps() as f64
    }

    /// The length of edges relative to rest: the 99th percentile and the largest.
    #[wasm_bindgen(getter, js_name = edgeStretch, unchecked_return_type = "[number, number]")]
    pub fn edge_stretch(&self) -> JsValue {
        let stretch = self.cloth.edge_stretch();
        js_sys::Array::of2(&stretch.percentile_99.into(), &stretch.largest.into()).into()
    }

    /// The processing time of each effect so far, in seconds, by its name. An effect that the scene does not name is absent.
    #[wasm_bindgen(getter, js_name = effectSeconds, unchecked_return_type = "Record<string, number>")]
    pub fn effect_seconds(&self) -> JsValue {
        by_name(self.cloth.effects().iter().map(|effect| (effect.name, effect.seconds)))
    }

    /// The counts of contact so far; undefined without a contact effect.
    #[wasm_bindgen(getter, js_name = contactCounts, unchecked_return_type = "Record<string, number> | undefined")]
    pub fn contact_counts(&self) -> JsValue {
        self.cloth.contact_counts().map_or(JsValue::UNDEFINED, |counts| {
            by_name([
                ("candidates", counts.candidates as f64),
                ("lookedAt", counts.looked_at as f64),
                ("pushed", counts.pushed as f64),
                ("violated", counts.violated as f64),
                ("held", counts.held as f64),
                ("cuts", counts.cuts as f64),
            ])
        })
    }

    /// The processing time of the solve so far, in seconds: contact, friction, pins and the linear problems, without the
    /// energies of effects.
    #[wasm_bindgen(getter, js_name = solveSeconds)]
    pub fn solve_seconds(&self) -> f64 {
        self.cloth.solve_seconds()
    }

    /// The processing time of contact so far, without its pushes; undefined without a contact effect.
    #[wasm_bindgen(getter, js_name = contactSeconds, unchecked_return_type = "Record<string, number> | undefined")]
    pub fn contact_seconds(&self) -> JsValue {
        let seconds = self.cloth.contact_seconds();
        seconds.map_or(JsValue::UNDEFINED, |seconds| by_name(seconds.stages()))
    }

    /// The near pairs of the last step: four vertices and a unit normal each.
    #[wasm_bindgen(getter, js_name = nearPairs, unchecked_return_type = "{ vertices: Uint32Array; normals: Float64Array }")]
    pub fn near_pairs(&self) -> JsValue {
        let (vertices, normals): (Vec<_>, Vec<_>) = self
            .cloth
            .near_pairs()
            .map(|pair| (pair.vertices, pair.normal.to_array()))
            .unzip();
        let properties = [
            ("vertices", whole_numbers(vertices.as_flattened())),
            ("normals", floats(normals.as_flattened())),
        ];
        object(properties).into()
    }

    /// The settings that trade time for accuracy, with values and units.
    #[wasm_bindgen(getter, unchecked_return_type = "Record<string, string>")]
    pub fn settings(&self) -> JsValue {
        object(self.settings.iter().map(|(name, value)| (&**name, value.into()))).into()
    }

    /// The vertices of a body, from the first to before the second number.
    #[wasm_bindgen(js_name = bodyVertices, unchecked_return_type = "[number, number]")]
    pub fn body_vertices(&self, body: &Text) -> Result<JsValue, Exception> {
        Ok(range(self.cloth.body_vertices(self.body(body)?).unwrap_or_default()))
    }

    /// Moves a driven body in the next step: its mesh in the scene is rotated by a quaternion (x, y, z, w) and then translated.
    #[wasm_bindgen(js_name = placeBody)]
    pub fn place_body(&mut self, body: &Text, translation: &Numbers, rotation: Option<Numbers>) -> Result<(), Exception> {
        let (body, placement) = (self.body(body)?, placement(translation, rotation)?);
        Ok(self.cloth.place_body(body, placement)?)
    }

    /// Says where another physics engine has brought the body of a proxy, a free body with `proxy = true`, in the time of the
    /// next `advance` or step: the placement of its mesh as in `placeBody`, the velocity of its centre of mass in m/s, and its
    /// angular velocity in rad/s. The proxy goes there, and yields to cloth on the way by its mass. Without a call it stays, and
    /// yields.
    ///
    /// Afterwards move the engine's body to `placement`, and add the impulse of `proxyLoad` to it. Both steps must have the same
    /// length.
    #[wasm_bindgen(js_name = bringBody)]
    pub fn bring_body(
        &mut self,
        body: &Text,
        translation: &Numbers,
        rotation: Numbers,
        velocity: &Numbers,
        spin: &Numbers,
    ) -> Result<(), Exception> {
        let body = self.body(body)?;
        let to = BroughtBody {
            placement: placement(translation, Some(rotation))?,
            velocity: vector(velocity, "velocity")?,
            spin: vector(spin, "spin")?,
        };
        Ok(self.cloth.bring_body(body, to)?)
    }

    /// Returns the mean load on a proxy in the last step or `advance`, with the torque about its centre of mass; undefined for
    /// any other body. Cloth that is pinned to it is part of the load.
    #[wasm_bindgen(js_name = proxyLoad, unchecked_return_type = "Wrench | undefined")]
    pub fn proxy_load(&self, body: &Text) -> Result<JsValue, Exception> {
        let load = self.cloth.proxy_load(self.body(body)?);
        Ok(load.map_or(JsValue::UNDEFINED, wrench))
    }

    /// Moves driven and free bodies, their pins and the cloth that hangs on them elsewhere at once, without a step: positions in
    /// the world are rotated by a quaternion (x, y, z, w), and then translated. `cloths` names further cloths that move along,
    /// such as a garment without pins.
    ///
    /// Throws an `InputError`, and changes nothing, if something else holds the cloth or there is no room.
    pub fn teleport(
        &mut self,
        bodies: &Texts,
        translation: &Numbers,
        rotation: Option<Numbers>,
        cloths: Option<Texts>,
    ) -> Result<(), Exception> {
        let by = placement(translation, rotation)?;
        let bodies = texts(bodies, "bodies")?;
        let cloths = cloths.map_or_else(|| Ok(Vec::new()), |cloths| texts(&cloths, "cloths"))?;
        let bodies: Vec<usize> = bodies.iter().map(|name| self.body_named(name)).collect::<Result<_, _>>()?;
        let cloths: Vec<usize> = cloths.iter().map(|name| self.cloth_named(name)).collect::<Result<_, _>>()?;
        let teleported = self.cloth.teleport(&bodies, &cloths, by);
        teleported.map_err(|error| Exception::input(&error))
    }

    /// Moves each vertex of a driven body straight to a position in the next step.
    #[wasm_bindgen(js_name = moveBody)]
    pub fn move_body(&mut self, body: &Text, positions: &Positions) -> Result<(), Exception> {
        let (body, positions) = (self.body(body)?, vectors(positions)?);
        Ok(self.cloth.move_body(body, &positions)?)
    }

    /// Moves each vertex of a driven group of pins, given by its index, in the next step.
    #[wasm_bindgen(js_name = movePins)]
    pub fn move_pins(&mut self, group: &Number, positions: &Positions) -> Result<(), Exception> {
        let group = whole(group, "group")? as usize;
        Ok(self.cloth.move_pins(group, &vectors(positions)?)?)
    }

    /// Sets the velocity of the scene's wind from now on, in m/s.
    #[wasm_bindgen(js_name = setWind)]
    pub fn set_wind(&mut self, velocity: &Numbers) -> Result<(), Exception> {
        Ok(self.cloth.set_wind(vector(velocity, "velocity")?)?)
    }

    /// Sets the velocity, in m/s, with which vertices of cloth start the next step, as if a hand pulled them.
    #[wasm_bindgen(js_name = setVelocity)]
    pub fn set_velocity(&mut self, vertices: &WholeNumbers, velocity: &Numbers) -> Result<(), Exception> {
        let vertices = wholes(vertices, "vertices")?;
        Ok(self.cloth.set_velocity(&vertices, vector(velocity, "velocity")?)?)
    }

    /// Adds a force, in N, on each of these vertices of cloth, for the whole of the next step or `advance`; after it the force is
    /// gone. Forces on the same vertex add up. With a count, `step` applies them in its first step alone.
    #[wasm_bindgen(js_name = addForce)]
    pub fn add_force(&mut self, vertices: &WholeNumbers, force: &Numbers) -> Result<(), Exception> {
        let vertices = wholes(vertices, "vertices")?;
        Ok(self.cloth.add_force(&vertices, vector(force, "force")?)?)
    }

    /// Returns the placement of a driven or free body, which takes the mesh of the scene to where it is now; undefined for other
    /// bodies and for one that was moved vertex by vertex.
    #[wasm_bindgen(unchecked_return_type = "Placement | undefined")]
    pub fn placement(&self, body: &Text) -> Result<JsValue, Exception> {
        let placement = self.cloth.placement(self.body(body)?);
        Ok(placement.map_or(JsValue::UNDEFINED, |Placement { rotation, translation }| {
            let parts = [
                ("translation", floats(&translation.to_array())),
                ("rotation", floats(&rotation.to_array())),
            ];
            object(parts).into()
        }))
    }

    /// Returns the mass and the present motion of a free body, one with a `mass` or a `density`; undefined for any other body.
    #[wasm_bindgen(js_name = bodyMotion, unchecked_return_type = "FreeBodyState | undefined")]
    pub fn body_motion(&self, body: &Text) -> Result<JsValue, Exception> {
        let motion = self.cloth.body_motion(self.body(body)?);
        Ok(motion.map_or(JsValue::UNDEFINED, |motion| {
            let vectors = [
                ("centre", motion.centre),
                ("velocity", motion.velocity),
                ("spin", motion.spin),
                ("angularMomentum", motion.angular_momentum),
            ];
            let vectors = vectors.map(|(name, vector)| (name, floats(&vector.to_array())));
            object([("mass", motion.mass.into())].into_iter().chain(vectors)).into()
        }))
    }

    /// Returns the load of the cloth on a body, with torques about a point (default: the origin): the mean over the last step or
    /// `advance`. It is zero before the first step and after `resume`.
    #[wasm_bindgen(js_name = bodyLoad, unchecked_return_type = "BodyLoad")]
    pub fn body_load(&self, body: &Text, about: Option<Numbers>) -> Result<JsValue, Exception> {
        let (body, about) = (self.body(body)?, point(about.as_ref())?);
        let load = self.cloth.mean_body_load(body, about).unwrap_or_default();
        let parts = [
            ("contact", load.contact),
            ("friction", load.friction),
            ("pins", load.pins),
            ("attachments", load.attachments),
            ("total", load.total()),
        ];
        Ok(object(parts.map(|(name, part)| (name, wrench(part)))).into())
    }

    /// Returns the load on a group of pins, given by its index, as `bodyLoad`. The weight and the inertia of the pinned vertices
    /// are in it.
    #[wasm_bindgen(js_name = pinLoad, unchecked_return_type = "Wrench")]
    pub fn pin_load(&self, group: &Number, about: Option<Numbers>) -> Result<JsValue, Exception> {
        let (group, about) = (whole(group, "group")? as usize, point(about.as_ref())?);
        load_of("pins", group, self.cloth.mean_pin_load(group, about))
    }

    /// Returns the load on a group of attachments, given by its index, as `bodyLoad`.
    #[wasm_bindgen(js_name = attachmentLoad, unchecked_return_type = "Wrench")]
    pub fn attachment_load(&self, group: &Number, about: Option<Numbers>) -> Result<JsValue, Exception> {
        let (group, about) = (whole(group, "group")? as usize, point(about.as_ref())?);
        load_of("attachments", group, self.cloth.mean_attachment_load(group, about))
    }

    /// Returns the state as bytes after every 200th step; undefined in between.
    #[must_use]
    pub fn checkpoint(&self) -> Option<Vec<u8>> {
        self.cloth.checkpoint()
    }

    /// Continues from a checkpoint of the same scene, with the same bits as an uninterrupted simulation.
    pub fn resume(&mut self, checkpoint: &Bytes) -> Result<(), Exception> {
        let resumed = self.cloth.resume(&bytes(checkpoint, "checkpoint")?);
        resumed.map_err(|error| Exception::new("CheckpointError", &error))
    }

    fn body(&self, body: &Text) -> Result<usize, Exception> {
        self.body_named(&text(body, "body")?)
    }

    fn body_named(&self, name: &str) -> Result<usize, Exception> {
        numbered(self.cloth.body_names(), "body", name)
    }

    fn cloth_named(&self, name: &str) -> Result<usize, Exception> {
        numbered(self.cloth.cloth_names(), "cloth", name)
    }
}

/// Returns the number of a name of the scene.
fn numbered(names: &[String], kind: &str, name: &str) -> Result<usize, Exception> {
    let found = names.iter().position(|known| known == name);
    found.ok_or_else(|| {
        let short = short(name);
        Exception::input(&format!("there is no {kind} '{short}'; the scene has {names:?}"))
    })
}

/// Returns a point, or the origin without one.
fn point(about: Option<&Numbers>) -> Result<DVec3, Exception> {
    about.map_or(Ok(DVec3::ZERO), |about| vector(about, "about"))
}

fn wrench(wrench: Wrench) -> JsValue {
    let parts = [("force", wrench.force), ("torque", wrench.torque)];
    object(parts.map(|(name, part)| (name, floats(&part.to_array())))).into()
}

fn load_of(what: &str, group: usize, load: Option<Wrench>) -> Result<JsValue, Exception> {
    let none = || Exception::input(&format!("there is no group {group} of {what}"));
    load.map(wrench).ok_or_else(none)
}

impl From<Blocked> for Exception {
    fn from(blocked: Blocked) -> Self {
        Self::new("BlockedError", &blocked)
    }
}

impl From<DriveError> for Exception {
    fn from(error: DriveError) -> Self {
        Self::input(&error)
    }
}

fn by_name<'a>(values: impl IntoIterator<Item = (&'a str, f64)>) -> JsValue {
    object(values.into_iter().map(|(name, value)| (name, value.into()))).into()
}

/// Returns a placement: without a rotation if that is left out.
fn placement(translation: &Numbers, rotation: Option<Numbers>) -> Result<Placement, Exception> {
    let rotation = match rotation {
        None => DQuat::IDENTITY,
        Some(rotation) => {
            let rotation = <[f64; 4]>::try_from(numbers(&rotation, "rotation")?);
            DQuat::from_array(rotation.map_err(|_| Exception::input(&"rotation must have four numbers"))?)
        }
    };
    Ok(Placement::new(rotation, vector(translation, "translation")?))
}

fn vector(values: &Numbers, name: &str) -> Result<DVec3, Exception> {
    let values =
        <[f64; 3]>::try_from(numbers(values, name)?).map_err(|_| Exception::input(&format!("{name} must have three numbers")))?;
    Ok(values.into())
}

fn vectors(positions: &JsValue) -> Result<Vec<DVec3>, Exception> {
    let mut rows = Vec::new();
    take_positions(positions, "positions", &mut rows)?;
    Ok(rows.into_iter().map(DVec3::from).collect())
}
