//! The page's contents besides the library: published methods and hard cases.

use crate::pair::pair_of;
use crate::values::{Exception, floats, object, rows_of, set, take_positions, whole_numbers};
use js_sys::Array;
use selvedge::{CandidateBoxes, CollisionDetector, PairKind, Topology};
use selvedge_core::PrimitivePair;
use selvedge_core::glam::DVec3;
use selvedge_laboratory::baselines::{cubic, plain};
use selvedge_laboratory::hard_cases::{ExactContact, hard_cases};
use selvedge_laboratory::methods::{PairSource, Preset, Stages};
use selvedge_laboratory::pipeline::{Pipeline, StepReport};
use selvedge_laboratory::scene::ArmScene;
use std::sync::Arc;
use wasm_bindgen::{JsValue, prelude::wasm_bindgen};

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &str = include_str!("page.d.ts");

fn coordinates(pair: &PrimitivePair<f64>, end: bool) -> JsValue {
    let points = pair
        .motions
        .map(|motion| if end { motion.end } else { motion.start }.to_array());
    floats(points.as_flattened())
}

/// Returns the hard cases of the literature, with exact answers.
#[wasm_bindgen(js_name = hardCases, unchecked_return_type = "HardCase[]")]
#[must_use]
pub fn named_hard_cases() -> JsValue {
    let show = |case: &selvedge_laboratory::hard_cases::HardCase| {
        let (exact, time) = match &case.contact {
            ExactContact::Never => ("never", JsValue::UNDEFINED),
            ExactContact::Undefined => ("undefined", JsValue::UNDEFINED),
            ExactContact::First { exact, from, .. } => (&exact[..], (*from).into()),
        };
        object([
            ("name", (&case.name).into()),
            ("placement", (&case.placement).into()),
            ("kind", case.pair.kind.to_string().into()),
            ("start", coordinates(&case.pair, false)),
            ("end", coordinates(&case.pair, true)),
            ("exact", exact.into()),
            ("time", time),
        ])
    };
    hard_cases().iter().map(show).collect::<Array>().into()
}

/// Runs the published tests of a pair, which may be wrong: the paper's filter as printed, and Provot's cubic.
#[wasm_bindgen(js_name = publishedVerdicts, unchecked_return_type = "{ filterCulls: boolean; cubicTime: number | undefined }")]
pub fn published_verdicts(kind: &str, start: &JsValue, end: &JsValue) -> Result<JsValue, Exception> {
    let pair = pair_of(kind, start, end)?;
    let time = cubic::time_of_impact(&pair).map_or(JsValue::UNDEFINED, JsValue::from);
    Ok(object([
        ("filterCulls", plain::non_coplanarity(&pair).is_culled().into()),
        ("cubicTime", time),
    ])
    .into())
}

/// Returns the names of all methods, the certified ones last.
#[wasm_bindgen(js_name = methodNames)]
#[must_use]
pub fn method_names() -> Vec<String> {
    Preset::ALL.iter().map(|preset| preset.name().to_owned()).collect()
}

/// Returns a step of the sleeve on the bending arm, from time `start` to time `end` of 0 to 1.
#[wasm_bindgen(js_name = armStep, unchecked_return_type = "{ triangles: Uint32Array; start: Float64Array; end: Float64Array }")]
pub fn arm_step(start: f64, end: f64) -> Result<JsValue, Exception> {
    if !(0.0..=1.0).contains(&start) || !(0.0..=1.0).contains(&end) {
        return Err(Exception::input(&"times must be from 0 to 1"));
    }
    let scene = ArmScene::new(1).map_err(|error| Exception::input(&error))?;
    let positions = |time| floats(&scene.positions(time).iter().flat_map(DVec3::to_array).collect::<Vec<_>>());
    let properties = [
        ("triangles", whole_numbers(scene.mesh().triangles.as_flattened())),
        ("start", positions(start)),
        ("end", positions(end)),
    ];
    Ok(object(properties).into())
}

/// Runs a method on one step. Each stage has its count, its time, and the four vertices of each pair that it leaves.
#[wasm_bindgen(js_name = runMethod, unchecked_return_type = "{ stages: MethodStage[]; milliseconds: number; certified: boolean }")]
pub fn run_method(name: &str, triangles: &[u32], start: &JsValue, end: &JsValue) -> Result<JsValue, Exception> {
    let preset: Preset = name.parse().map_err(|error| Exception::input(&error))?;
    let (mut from, mut to) = (Vec::new(), Vec::new());
    take_positions(start, "start", &mut from)?;
    take_positions(end, "end", &mut to)?;
    let topology = Topology::new(from.len(), rows_of(triangles, "triangles")?).map_err(|error| Exception::input(&error))?;
    let topology = Arc::new(topology);
    let [from, to] = [from, to].map(|rows| rows.into_iter().map(DVec3::from).collect::<Vec<_>>());
    let stages = preset.stages();
    let run = Run { topology, from, to };
    let (report, pairs) = run.whole(stages)?;
    let shown = Array::new();
    let show = |name: &str, pairs: u64, seconds: f64, vertices: &[u32]| {
        let stage = object([
            ("name", name.into()),
            ("pairs", (pairs as f64).into()),
            ("milliseconds", (1e3 * seconds).into()),
        ]);
        set(&stage, "vertices", &whole_numbers(vertices));
        shown.push(&stage);
    };
    match report.broad_phase_pairs {
        Some(found) => show(
            "broad phase: moving boxes",
            found.total(),
            report.broad_phase_seconds,
            &run.candidates()?,
        ),
        None => show(
            "broad phase: triangle pairs",
            report.triangle_pairs,
            report.broad_phase_seconds,
            &[],
        ),
    }
    let count = report.stages.len();
    for (index, stage) in report.stages.iter().enumerate() {
        let vertices = match stages.source {
            _ if index + 1 == count => pairs.clone(),
            // The pairs after some of the tests are those that a method with these tests alone hands on.
            PairSource::TrianglePairs(_) => run.after(Stages {
                tests: &stages.tests[..index],
                ..stages
            })?,
            PairSource::MovingBoxes => Vec::new(),
        };
        show(stage.stage.name(), stage.survivors.total(), stage.seconds, &vertices);
    }
    let properties = [
        ("stages", shown.into()),
        ("milliseconds", (1e3 * report.seconds).into()),
        ("certified", stages.is_certified().into()),
    ];
    Ok(object(properties).into())
}

/// A step of a mesh.
struct Run {
    topology: Arc<Topology>,
    from: Vec<DVec3>,
    to: Vec<DVec3>,
}

impl Run {
    fn pipeline(&self, stages: Stages) -> Result<Pipeline<f64>, Exception> {
        Pipeline::new(self.topology.clone(), stages, 1).map_err(|error| Exception::input(&error))
    }

    /// Runs the method twice, since the first step builds its hierarchies. Returns the report and the vertices of the contacts.
    fn whole(&self, stages: Stages) -> Result<(StepReport, Vec<u32>), Exception> {
        let mut pipeline = self.pipeline(stages)?;
        for _ in 0..2 {
            pipeline
                .step(&self.from, &self.to)
                .map_err(|error| Exception::input(&error))?;
        }
        let contacts = pipeline.contacts().iter();
        let vertices = contacts.flat_map(|contact| self.topology.vertices_of(contact.kind, contact.pair));
        Ok((pipeline.report().clone(), vertices.collect()))
    }

    /// Returns the vertices of the pairs that reach the elementary test.
    fn after(&self, stages: Stages) -> Result<Vec<u32>, Exception> {
        let mut pipeline = self.pipeline(stages)?;
        pipeline.keep_candidates(true);
        pipeline
            .step(&self.from, &self.to)
            .map_err(|error| Exception::input(&error))?;
        let [vertex_face, edge_edge] = [PairKind::VertexFace, PairKind::EdgeEdge].map(|kind| pipeline.candidates(kind));
        Ok(self.vertices(vertex_face, edge_edge))
    }

    fn candidates(&self) -> Result<Vec<u32>, Exception> {
        let mut detector = CollisionDetector::<f64>::new(self.topology.clone());
        let (mut vertex_face, mut edge_edge) = (Vec::new(), Vec::new());
        let found = detector.candidates(&self.from, &self.to, CandidateBoxes::Moving, &mut vertex_face, &mut edge_edge);
        found.map_err(|error| Exception::input(&error))?;
        Ok(self.vertices(&vertex_face, &edge_edge))
    }

    fn vertices(&self, vertex_face: &[[u32; 2]], edge_edge: &[[u32; 2]]) -> Vec<u32> {
        let vertices = |kind, pairs: &[[u32; 2]]| -> Vec<u32> {
            pairs.iter().flat_map(|&pair| self.topology.vertices_of(kind, pair)).collect()
        };
        [
            vertices(PairKind::VertexFace, vertex_face),
            vertices(PairKind::EdgeEdge, edge_edge),
        ]
        .concat()
    }
}
