//! The class `Detector`.

use crate::numbers::{Flag, Flags, Number, WholeNumbers, check_names, flags, large, number, optional, setting, whole, wholes};
use crate::values::{
    Exception, Frame as Given, Positions, array, floats, get, kind_number, object, rows_of, set, take_positions, view,
    whole_numbers,
};
use js_sys::{Float64Array, Uint8Array};
use selvedge::{
    CandidateBoxes, CollisionDetector, CollisionFilter, Contact, ContactGeometry, Criterion, Frame, Groups, Intersection,
    StepError, Topology,
};
use selvedge_core::elementary::Limits;
use selvedge_core::glam::DVec3;
use wasm_bindgen::{JsValue, prelude::wasm_bindgen};

/// Finds the contacts of a moving triangle mesh, one step after another, and never misses one.
///
/// Positions hold x, y, z for each vertex. Methods that take them may be called without: they then use what `start` and `end`
/// hold, where you can write without a copy.
#[wasm_bindgen]
pub struct Detector {
    detector: CollisionDetector<f64>,
    start: Vec<[f64; 3]>,
    end: Vec<[f64; 3]>,
    contacts: Vec<Contact<f64>>,
    geometries: Vec<ContactGeometry>,
}

#[wasm_bindgen]
impl Detector {
    /// Makes a detector for a mesh: three vertices for each triangle, two for each loose edge (rope, hair), one for each loose
    /// point.
    ///
    /// Throws an `InputError` if there is no primitive or one names a vertex that does not exist.
    #[wasm_bindgen(constructor)]
    pub fn new(
        #[wasm_bindgen(js_name = vertexCount)] vertex_count: &Number,
        triangles: &WholeNumbers,
        #[wasm_bindgen(js_name = looseEdges)] loose_edges: Option<WholeNumbers>,
        #[wasm_bindgen(js_name = loosePoints)] loose_points: Option<WholeNumbers>,
    ) -> Result<Detector, Exception> {
        let vertex_count = whole(vertex_count, "vertexCount")? as usize;
        let list = |list: Option<WholeNumbers>, name| list.map_or_else(|| Ok(Vec::new()), |list| wholes(&list, name));
        let triangles = rows_of(&wholes(triangles, "triangles")?, "triangles")?;
        let edges = rows_of(&list(loose_edges, "looseEdges")?, "looseEdges")?;
        let points = list(loose_points, "loosePoints")?;
        let topology = Topology::with_loose_features(vertex_count, triangles, &edges, &points);
        let topology = topology.map_err(|error| Exception::input(&error))?;
        Ok(Self {
            start: zeros(vertex_count)?,
            end: zeros(vertex_count)?,
            detector: CollisionDetector::new(topology),
            contacts: Vec::new(),
            geometries: Vec::new(),
        })
    }

    /// A view of the positions at the start of the step. Write here to save a copy.
    #[wasm_bindgen(getter)]
    pub fn start(&mut self) -> Float64Array {
        view(self.start.as_mut_ptr() as usize, self.start.len())
    }

    /// A view of the positions at the end of the step. Write here to save a copy.
    #[wasm_bindgen(getter)]
    pub fn end(&mut self) -> Float64Array {
        view(self.end.as_mut_ptr() as usize, self.end.len())
    }

    /// Finds all contacts of the step, with points, normals, distances and speeds if `geometry` is true.
    ///
    /// Throws an `InputError` if a frame has the wrong length or a coordinate is NaN or infinite.
    #[wasm_bindgen(unchecked_return_type = "Contacts")]
    pub fn contacts(&mut self, start: &Given, end: &Given, geometry: Option<bool>) -> Result<JsValue, Exception> {
        self.take(start, end)?;
        self.detector.contacts(&self.start, &self.end, &mut self.contacts)?;
        self.geometries.clear();
        if geometry == Some(true) {
            self.detector
                .contact_geometries(&self.start, &self.end, &self.contacts, &mut self.geometries)?;
        }
        Ok(self.columns(geometry == Some(true)))
    }

    /// Finds the earliest contact. The step is certainly free before its time, and throughout if the result is undefined.
    #[wasm_bindgen(unchecked_return_type = "Contact | undefined")]
    pub fn earliest(&mut self, start: &Given, end: &Given) -> Result<JsValue, Exception> {
        self.take(start, end)?;
        let earliest = self.detector.earliest(&self.start, &self.end)?;
        Ok(earliest.map_or(JsValue::UNDEFINED, |contact| {
            let vertices = self.detector.topology().vertices_of(contact.kind, contact.pair);
            let properties = [
                ("kind", contact.kind.to_string().into()),
                ("pair", array(contact.pair)),
                ("time", contact.time.into()),
                ("vertices", array(vertices)),
            ];
            object(properties).into()
        }))
    }

    /// Decides whether the step is certainly free of contact. The search ends at the first contact.
    #[wasm_bindgen(js_name = isFree)]
    pub fn is_free(&mut self, start: &Given, end: &Given) -> Result<bool, Exception> {
        self.take(start, end)?;
        Ok(self.detector.is_free(&self.start, &self.end)?)
    }

    /// Finds the pairs that bounding boxes keep: two numbers each, vertices and faces, and edges and edges.
    #[wasm_bindgen(unchecked_return_type = "{ vertexFace: Uint32Array; edgeEdge: Uint32Array }")]
    pub fn candidates(&mut self, start: &Given, end: &Given, swept: Option<bool>) -> Result<JsValue, Exception> {
        self.take(start, end)?;
        let boxes = match swept {
            Some(true) => CandidateBoxes::Swept,
            _ => CandidateBoxes::Moving,
        };
        let (mut vertex_face, mut edge_edge) = (Vec::new(), Vec::new());
        self.detector
            .candidates(&self.start, &self.end, boxes, &mut vertex_face, &mut edge_edge)?;
        let pairs = |pairs: &[[u32; 2]]| whole_numbers(pairs.as_flattened());
        Ok(object([("vertexFace", pairs(&vertex_face)), ("edgeEdge", pairs(&edge_edge))]).into())
    }

    /// Finds all pairs of a mesh at rest within a distance, with their closest points. None is missed.
    #[wasm_bindgen(unchecked_return_type = "Contacts")]
    pub fn near(&mut self, positions: &Positions, distance: &Number) -> Result<JsValue, Exception> {
        let distance = number(distance, "distance")?;
        self.take_state(positions)?;
        self.detector.near(&self.start, distance, &mut self.geometries)?;
        let contact = |near: &ContactGeometry| Contact {
            kind: near.kind,
            pair: near.pair,
            time: 0.0,
        };
        self.contacts.clear();
        self.contacts.extend(self.geometries.iter().map(contact));
        Ok(self.columns(true))
    }

    /// Moves each vertex as far towards `wanted` as its neighbourhood allows, so that the step is certainly free of contact.
    #[wasm_bindgen(unchecked_return_type = "Truncation")]
    pub fn truncate(&mut self, start: &Given, wanted: &Given) -> Result<JsValue, Exception> {
        self.take_frames([start, wanted], ["start", "wanted"])?;
        let mut end = Vec::new();
        let truncation = self.detector.truncate(&self.start, &self.end, &mut end)?;
        let properties = [
            ("end", floats(end.as_flattened())),
            ("heldBack", truncation.held_back.into()),
            ("inContact", truncation.in_contact.into()),
        ];
        Ok(object(properties).into())
    }

    /// Finds all intersections of a mesh at rest, exactly, touching included.
    #[wasm_bindgen(unchecked_return_type = "Intersections")]
    pub fn intersections(&mut self, positions: &Positions) -> Result<JsValue, Exception> {
        self.take_state(positions)?;
        let mut found = Vec::new();
        self.detector.intersections(&self.start, &mut found)?;
        let row = |intersection: &Intersection| match *intersection {
            Intersection::EdgeFace { edge, face } => (0_u8, [edge, face]),
            Intersection::VertexFace { vertex, face } => (1, [vertex, face]),
            Intersection::EdgeEdge { edges } => (2, edges),
        };
        let (kinds, pairs): (Vec<_>, Vec<_>) = found.iter().map(row).unzip();
        let properties = [
            ("count", found.len().into()),
            ("kind", Uint8Array::from(&kinds[..]).into()),
            ("pair", whole_numbers(pairs.as_flattened())),
        ];
        Ok(object(properties).into())
    }

    /// Decides whether there is any intersection. The search ends at the first.
    #[wasm_bindgen(js_name = hasIntersections)]
    pub fn has_intersections(&mut self, positions: &Positions) -> Result<bool, Exception> {
        self.take_state(positions)?;
        Ok(self.detector.has_intersections(&self.start)?)
    }

    /// Sets what counts as a contact.
    #[wasm_bindgen(js_name = setLimits)]
    pub fn set_limits(&mut self, #[wasm_bindgen(unchecked_param_type = "Limits")] limits: &JsValue) -> Result<(), Exception> {
        check_names(limits, "limits", &["separation", "tolerance", "touching"])?;
        let tolerance = setting(limits, "tolerance")?.unwrap_or(Limits::<f64>::default().tolerance);
        let separation = setting(limits, "separation")?.unwrap_or(0.0);
        let touching = get(limits, "touching").is_some_and(|value| value.is_truthy());
        let criterion = match (touching, separation == 0.0) {
            (true, true) => Criterion::Touching { tolerance },
            (true, false) => return Err(Exception::input(&"with touching there is no separation")),
            (false, _) => Criterion::Within(Limits { tolerance, separation }),
        };
        Ok(self.detector.set_criterion(criterion)?)
    }

    /// Names the moving vertices by a number that is not zero. Without an argument all vertices move.
    #[wasm_bindgen(js_name = setMoving)]
    pub fn set_moving(&mut self, moving: Option<Flags>) -> Result<(), Exception> {
        let moving = moving.map(|moving| flags(&moving, "moving")).transpose()?;
        Ok(self.detector.set_moving(moving.as_deref())?)
    }

    /// Sets which pairs may collide; it replaces the previous filter.
    #[wasm_bindgen(js_name = setCollisionFilter)]
    pub fn set_collision_filter(
        &mut self,
        #[wasm_bindgen(unchecked_param_type = "CollisionFilter")] filter: &JsValue,
    ) -> Result<(), Exception> {
        check_names(filter, "filter", &["groups", "patches", "excluded"])?;
        let list = |name: &str| get(filter, name).map(|list| wholes(&list, name)).transpose();
        let mut made = CollisionFilter::new();
        if let Some(groups) = list("groups")? {
            let rows = rows_of::<2>(&groups, "groups")?.into_iter();
            made = made.with_groups(rows.map(|[memberships, filter]| Groups::new(memberships, filter)).collect());
        }
        if let Some(patches) = list("patches")? {
            made = made.with_patches(patches);
        }
        if let Some(excluded) = list("excluded")? {
            made = made.without_vertex_pairs(rows_of::<2>(&excluded, "excluded")?);
        }
        Ok(self.detector.set_collision_filter(made)?)
    }

    /// Sets whether each step starts where the last one ended. Such steps are faster; the contacts are the same.
    #[wasm_bindgen(js_name = setCoherent)]
    pub fn set_coherent(&mut self, coherent: &Flag) {
        self.detector.set_coherent(coherent.is_truthy());
    }

    /// Limits the pairs that a step may look at; more throw a `TooManyPairsError`. Without an argument there is no limit.
    #[wasm_bindgen(js_name = setPairLimit)]
    pub fn set_pair_limit(&mut self, limit: Option<Number>) -> Result<(), Exception> {
        self.detector.set_pair_limit(optional(limit.as_ref(), "limit", large)?);
        Ok(())
    }

    /// Limits the memory of pairs and contacts, in bytes; a step that needs more throws a `TooMuchMemoryError`.
    #[wasm_bindgen(js_name = setMemoryLimit)]
    pub fn set_memory_limit(&mut self, limit: Option<Number>) -> Result<(), Exception> {
        self.detector.set_memory_limit(optional(limit.as_ref(), "limit", large)?);
        Ok(())
    }

    /// The counts of the last step.
    #[wasm_bindgen(getter, unchecked_return_type = "Statistics")]
    pub fn statistics(&self) -> JsValue {
        let statistics = self.detector.statistics();
        let properties = [
            ("candidates", (statistics.candidates.total() as f64).into()),
            ("filtered", (statistics.filtered.total() as f64).into()),
            ("contacts", (statistics.contacts.total() as f64).into()),
            ("seconds", statistics.seconds.into()),
        ];
        object(properties).into()
    }

    /// The vertices of each triangle.
    #[wasm_bindgen(getter)]
    pub fn triangles(&self) -> Vec<u32> {
        self.detector.topology().proper_triangles().as_flattened().to_vec()
    }

    /// The vertices of each edge, in the order of their numbers.
    #[wasm_bindgen(getter)]
    pub fn edges(&self) -> Vec<u32> {
        self.detector.topology().edges().as_flattened().to_vec()
    }

    /// The connected component of each vertex. As `patches`, they let only different components collide.
    #[wasm_bindgen(getter)]
    pub fn components(&self) -> Vec<u32> {
        self.detector.topology().components()
    }

    fn take(&mut self, start: &JsValue, end: &JsValue) -> Result<(), Exception> {
        self.take_frames([start, end], ["start", "end"])
    }

    /// Copies the frames that are given. A frame of the wrong length changes nothing of the other.
    fn take_frames(&mut self, frames: [&JsValue; 2], names: [&str; 2]) -> Result<(), Exception> {
        let expected = self.detector.topology().vertex_count();
        let own = [(Frame::Start, &mut self.start), (Frame::End, &mut self.end)];
        for ((positions, name), (frame, rows)) in frames.into_iter().zip(names).zip(own) {
            if !positions.is_undefined() {
                take_frame(positions, name, (frame, expected), rows)?;
            }
        }
        Ok(())
    }

    /// Copies the positions of a mesh at rest.
    fn take_state(&mut self, positions: &JsValue) -> Result<(), Exception> {
        let expected = self.detector.topology().vertex_count();
        take_frame(positions, "positions", (Frame::Start, expected), &mut self.start)
    }

    /// Returns the contacts as arrays.
    fn columns(&self, with_geometry: bool) -> JsValue {
        let (contacts, topology) = (&self.contacts, self.detector.topology());
        let kinds: Vec<u8> = contacts.iter().map(|contact| kind_number(contact.kind)).collect();
        let pairs: Vec<u32> = contacts.iter().flat_map(|contact| contact.pair).collect();
        let times: Vec<f64> = contacts.iter().map(|contact| contact.time).collect();
        let vertices: Vec<u32> = contacts
            .iter()
            .flat_map(|contact| topology.vertices_of(contact.kind, contact.pair))
            .collect();
        let columns = object([
            ("count", contacts.len().into()),
            ("kind", Uint8Array::from(&kinds[..]).into()),
            ("pair", whole_numbers(&pairs)),
            ("time", floats(&times)),
            ("vertices", whole_numbers(&vertices)),
        ]);
        if with_geometry {
            let all = || self.geometries.iter().map(|found| &found.geometry);
            let column = |name, values: Vec<f64>| set(&columns, name, &floats(&values));
            let points = all().flat_map(|found| found.points);
            column("points", points.flat_map(|point| point.to_array()).collect());
            column("weights", all().flat_map(|found| found.weights).collect());
            let normal = |normal: Option<DVec3>| normal.map_or([f64::NAN; 3], |normal| normal.to_array());
            column("normal", all().flat_map(|found| normal(found.normal)).collect());
            column("distance", all().flat_map(|found| found.distance).collect());
            column("speed", all().map(|found| found.speed).collect());
        }
        columns.into()
    }
}

/// Returns positions of zeros, if the memory has room for them.
fn zeros(vertex_count: usize) -> Result<Vec<[f64; 3]>, Exception> {
    let mut rows = Vec::new();
    rows.try_reserve_exact(vertex_count).map_err(|_| {
        let text = format!("vertexCount: there is no memory for the positions of {vertex_count} vertices");
        Exception::input(&text)
    })?;
    rows.resize(vertex_count, [0.0; 3]);
    Ok(rows)
}

/// Copies the positions of a frame, which keeps its length whatever is given.
fn take_frame(
    positions: &JsValue,
    name: &str,
    (frame, expected): (Frame, usize),
    rows: &mut Vec<[f64; 3]>,
) -> Result<(), Exception> {
    take_positions(positions, name, rows)?;
    let found = rows.len();
    if found == expected {
        return Ok(());
    }
    rows.resize(expected, [0.0; 3]);
    Err(StepError::WrongLength { frame, found, expected }.into())
}
