//! Builds the documents of `--json`. Names are lower case with underscores, values lower case with hyphens; times are seconds
//! unless the name says nanoseconds.

use super::distributed;
use super::n_log_n_ratios;
use super::paper::paper_row;
use super::recording::{EDGES_99, LONGEST_EDGE, Measure, MeasureKind, Recording};
use super::step::{StepQuestion, StepSummary};
use super::tangles::untangled_json;
use crate::hard_cases::ExactContact;
use crate::methods::QueryMethod;
use crate::methods::{Preset, Stage};
use crate::pipeline::StepReport;
use crate::study::elementary::ElementaryAccuracy;
use crate::study::{AccuracySet, FilterAccuracy};
use crate::study::{Comparison, ComparisonRow, MeanCounts, ScalingPoint};
use crate::study::{HardAnswer, HardResult, QueryResult};
use crate::truths::{ErrorUnit, LawRuns};
use selvedge::PairCounts;
use selvedge_cloth::{TangledStart, TornEdge};
use serde_json::{Value, json};

/// Returns one step, for `selvedge cull`.
pub fn step(summary: &StepSummary) -> Value {
    let contacts = summary.report.contacts();
    // Fields that were not requested are null.
    let has_all = summary.question == StepQuestion::Contacts;
    let contacts = (summary.question != StepQuestion::Candidates).then(|| {
        json!({
            "vertex_face": has_all.then_some(contacts.vertex_face),
            "edge_edge": has_all.then_some(contacts.edge_edge),
            "earliest": summary.earliest,
        })
    });
    json!({
        "pipeline": summary.preset.name(),
        "scalar": summary.scalar,
        "vertices": summary.vertices,
        "edges": summary.edges,
        "triangles": summary.triangles,
        "threads": summary.threads,
        "stages": step_stages(&summary.report),
        "contacts": contacts,
        "seconds": summary.report.seconds,
        "first_run_seconds": summary.first_run_seconds,
    })
}

fn step_stages(report: &StepReport) -> Vec<Value> {
    let counts = |pairs: PairCounts| [pairs.vertex_face, pairs.edge_edge];
    let first = match report.broad_phase_pairs {
        Some(pairs) => stage(Stage::BroadPhase, counts(pairs), report.broad_phase_seconds),
        None => broad_phase(report.triangle_pairs, report.broad_phase_seconds),
    };
    let later = report.stages.iter();
    let later = later.map(|report| stage(report.stage, counts(report.survivors), report.seconds));
    [first].into_iter().chain(later).collect()
}

/// Returns a stage of a step, or the mean of several.
fn stage(stage: Stage, [vertex_face, edge_edge]: [impl Into<Value>; 2], seconds: f64) -> Value {
    json!({
        "stage": stage.name(),
        "vertex_face": vertex_face.into(),
        "edge_edge": edge_edge.into(),
        "seconds": seconds,
    })
}

fn broad_phase(triangle_pairs: impl Into<Value>, seconds: f64) -> Value {
    json!({
        "stage": Stage::BroadPhase.name(),
        "triangle_pairs": triangle_pairs.into(),
        "seconds": seconds,
    })
}

/// Returns every method on the same steps, for `selvedge compare`.
pub fn comparison(comparison: &Comparison) -> Value {
    json!({
        "scene": comparison.name,
        "vertices": comparison.vertices,
        "edges": comparison.edges,
        "triangles": comparison.triangles,
        "steps": comparison.steps,
        "threads": comparison.threads,
        "rounds": comparison.rounds,
        "rows": comparison.rows.iter().map(comparison_row).collect::<Vec<_>>(),
    })
}

fn comparison_row(row: &ComparisonRow) -> Value {
    let kind = |pick: fn(&MeanCounts) -> f64| {
        json!({
            "distributed": distributed(row).as_ref().map(pick),
            "after_boxes": pick(&row.after_boxes),
            "after_filter": pick(&row.candidates),
            "contacts": pick(&row.contacts),
        })
    };
    json!({
        "pipeline": row.preset.name(),
        "reconstructed": row.preset.is_reconstructed(),
        "vertex_face": kind(|counts| counts.vertex_face),
        "edge_edge": kind(|counts| counts.edge_edge),
        "missed": row.missed.vertex_face + row.missed.edge_edge,
        "frames_per_second": row.frames_per_second,
        "stages": comparison_stages(row),
        "paper": paper_row(row.preset).map(|paper| json!({
            "row": paper.label,
            "vertex_face": paper.vertex_face,
            "edge_edge": paper.edge_edge,
            "frames_per_second": paper.frames_per_second,
        })),
    })
}

fn comparison_stages(row: &ComparisonRow) -> Vec<Value> {
    let counts = |pairs: MeanCounts| [pairs.vertex_face, pairs.edge_edge];
    let first = if row.has_triangle_pairs {
        broad_phase(row.triangle_pairs, row.broad_phase_seconds)
    } else {
        stage(Stage::BroadPhase, counts(row.after_boxes), row.broad_phase_seconds)
    };
    let later = row.stages.iter();
    let later = later.map(|report| stage(report.stage, counts(report.survivors), report.seconds));
    [first].into_iter().chain(later).collect()
}

/// Returns each method's answers to queries, for `selvedge queries`.
pub fn queries(scalar: &str, results: &[QueryResult]) -> Value {
    let methods = results.iter().map(|result| {
        let time = result.nanoseconds;
        json!({
            "method": result.method.name(),
            "kind": result.kind.name(),
            "certified": result.method.is_certified(),
            "queries": result.queries,
            "positives": result.positives,
            "truth_positives": result.truth.map(|truth| truth.positives),
            "false_positives": result.truth.map(|truth| truth.false_positives),
            "false_negatives": result.truth.map(|truth| truth.false_negatives),
            "nanoseconds": {
                "mean": time.mean,
                "median": time.median,
                "p99": time.p99,
                "max": time.max,
            },
        })
    });
    json!({"scalar": scalar, "methods": methods.collect::<Vec<_>>()})
}

/// Returns the cost of a step with no effect, with the first one, with the first two, and so on.
pub fn effects_one_by_one(costs: &[crate::study::EffectCost]) -> Value {
    let costs = costs
        .iter()
        .map(|cost| json!({"added": cost.added, "steps": cost.steps, "seconds_a_step": cost.seconds}));
    costs.collect()
}

/// Returns a simulation and its recording, for `selvedge simulate`.
///
/// Energies are in J; gravitational energy counts from the scene's origin. Stretch is relative to the length at rest. Loads are
/// forces in N on bodies and groups, each the mean of the last step or frame. All lists belong to the times in `seconds`. The
/// mass, the motion and the placement of free bodies at the end are in SI units; a rotation is a quaternion (x, y, z, w).
/// Vertices have the numbers of the [mesh in files](selvedge_cloth::MeshInFiles), those of `torn` within their cloth.
pub fn simulation(simulation: &selvedge_cloth::Simulation, recording: &Recording) -> Value {
    let seconds = recording.wall_seconds.unwrap_or(f64::NAN);
    let steps = simulation.steps_done();
    let effects = simulation.effects().iter();
    let effects: Vec<_> = effects
        .map(|effect| json!({"effect": effect.name, "seconds": effect.seconds}))
        .collect();
    let counts = simulation.contact_counts();
    let pairs = counts.iter().flat_map(|counts| counts.pairs());
    let pairs = pairs.map(|(stage, count)| json!({"stage": stage, "pairs": count}));
    let stages = simulation.contact_seconds().into_iter();
    let stages = stages.flat_map(|seconds| seconds.stages());
    let stages = [("solve", simulation.solve_seconds())].into_iter().chain(stages);
    let stages = stages.map(|(stage, seconds)| json!({"stage": stage, "seconds": seconds}));
    let stretch = simulation.edge_stretch();
    let released = simulation.released().into_iter();
    let in_files = simulation.mesh_in_files();
    let number = |vertex: usize| in_files.number_of[vertex];
    let released = released
        .map(|release| json!({"group": release.group, "vertex": number(release.vertex as usize), "seconds": release.time}));
    let torn = simulation.torn_edges().iter();
    let torn = torn.map(|edge| {
        let TornEdge {
            cloth,
            vertices,
            time,
            load,
        } = *edge;
        let first = simulation.vertices_of_cloth(cloth).unwrap_or_default().start;
        let first_in_file = in_files.vertices_of_cloths[cloth].start as u32;
        let edge = vertices.map(|vertex| number(first + vertex as usize) - first_in_file);
        json!({"cloth": cloth, "edge": edge, "seconds": time, "newtons_per_metre": load})
    });
    let slowest = |unit: &str| {
        let times = recording.step_times().filter(|_| recording.about.unit == unit);
        times.map(|steps| json!({unit: steps.largest_step, "seconds": steps.largest}))
    };
    json!({
        "scene": simulation.name(),
        "steps": steps,
        "seconds": seconds,
        "steps_per_second": steps as f64 / seconds,
        "slowest_step": slowest("step"),
        "slowest_frame": slowest("frame"),
        "simulated_seconds": simulation.time(),
        "edge_stretch_at_end": {"percentile_99": stretch.percentile_99, "largest": stretch.largest},
        "edge_stretch": edge_stretch(recording),
        "energy": energy(recording),
        "loads": loads(recording),
        "free_bodies_at_end": free_bodies(simulation),
        "effects": effects,
        "pairs": pairs.collect::<Vec<_>>(),
        "stages": stages.collect::<Vec<_>>(),
        "contacts_resolved": counts.map(|counts| counts.pushed),
        "vertices_held": counts.map(|counts| counts.held),
        "cuts": counts.map(|counts| counts.cuts),
        "released": released.collect::<Vec<_>>(),
        "torn": torn.collect::<Vec<_>>(),
        "blocked_steps": simulation.blocked_steps(),
        "overstretched_steps": simulation.overstretched_steps(),
        "lag_seconds": simulation.lag(),
        "untangled": simulation.untangled().map(untangled_json),
        "tolerated": (simulation.tangled_start() == TangledStart::Tolerate)
            .then(|| json!({"crossings_at_end": simulation.crossings().len(), "pairs_at_end": simulation.tolerated_pairs()})),
        // Contact effects certify every state. Without them nothing is known, so the value is null.
        "intersections_at_end": simulation.is_certified().then_some(0),
    })
}

/// Returns the times of measurements, in seconds.
fn measured_seconds(recording: &Recording) -> Vec<f64> {
    let steps = recording.measured_steps.iter();
    steps.map(|&step| recording.end_of(step)).collect()
}

fn edge_stretch(recording: &Recording) -> Value {
    let [of_most, of_longest] = [EDGES_99, LONGEST_EDGE].map(|name| recording.measure(name));
    let values = |measure: Option<&Measure>| measure.map(|measure| measure.values.clone());
    let largest = |measure: Option<&Measure>| {
        measure.map(|measure| json!({"value": measure.largest, "seconds": recording.end_of(measure.largest_step)}))
    };
    json!({
        "seconds": measured_seconds(recording),
        "percentile_99": values(of_most),
        "largest": values(of_longest),
        "most": {"percentile_99": largest(of_most), "largest": largest(of_longest)},
    })
}

fn energy(recording: &Recording) -> Value {
    let mut energy = json!({"seconds": measured_seconds(recording)});
    for measure in recording.measures_of(MeasureKind::Energy) {
        energy[&measure.name] = measure.values.clone().into();
    }
    let effects = recording.measures_of(MeasureKind::EffectEnergy);
    let effects = effects.map(|measure| json!({"effect": measure.name, "joules": measure.values}));
    energy["effects"] = effects.collect();
    energy
}

fn loads(recording: &Recording) -> Value {
    let on = recording.measures_of(MeasureKind::Load).map(|measure| {
        let mean = measure.values.iter().sum::<f64>() / measure.values.len() as f64;
        json!({
            "on": measure.name,
            "newtons": measure.values,
            "mean": mean,
            "largest": {"value": measure.largest, "seconds": recording.end_of(measure.largest_step)},
        })
    });
    json!({"seconds": measured_seconds(recording), "on": on.collect::<Vec<_>>()})
}

fn free_bodies(simulation: &selvedge_cloth::Simulation) -> Value {
    let bodies = simulation.body_names().iter().enumerate();
    let free = bodies.filter_map(|(body, name)| Some((name, simulation.body_motion(body)?, simulation.placement(body)?)));
    free.map(|(name, motion, placement)| {
        json!({
            "body": name,
            "mass": motion.mass,
            "centre": motion.centre.to_array(),
            "velocity": motion.velocity.to_array(),
            "spin": motion.spin.to_array(),
            "angular_momentum": motion.angular_momentum.to_array(),
            "translation": placement.translation.to_array(),
            "rotation": placement.rotation.to_array(),
        })
    })
    .collect()
}

/// Returns cost against size, for `selvedge scaling`.
pub fn scaling(preset: Preset, threads: usize, points: &[ScalingPoint]) -> Value {
    let ratios = n_log_n_ratios(points);
    let sizes = points.iter().zip(ratios).map(|(point, ratio)| {
        let candidates = point.step.candidates();
        json!({
            "triangles": point.triangles,
            "triangle_pairs": point.step.broad_phase_pairs.is_none().then_some(point.step.triangle_pairs),
            "candidates": {
                "vertex_face": candidates.vertex_face,
                "edge_edge": candidates.edge_edge,
            },
            "setup_seconds": point.setup_seconds,
            "first_step_seconds": point.first_step_seconds,
            "seconds": point.step.seconds,
            "seconds_over_n_log_n": ratio,
            "stages": step_stages(&point.step),
        })
    });
    json!({
        "pipeline": preset.name(),
        "threads": threads,
        "sizes": sizes.collect::<Vec<_>>(),
    })
}

/// Returns the simulation's errors against laws, for `selvedge truths`: one row for each law, mesh, accuracy and pace. Errors
/// that are not numbers are null.
#[must_use]
pub fn truths(all: &[LawRuns]) -> Value {
    let rows = all.iter().flat_map(|LawRuns { law, runs, .. }| {
        runs.iter().map(|run| {
            let worst = run.worst();
            let (of, unit) = match law.error {
                ErrorUnit::Of(quantity) => (Some(quantity), None),
                ErrorUnit::In(unit) => (None, Some(unit)),
            };
            json!({
                "law": law.name,
                "mesh": run.conditions.grid.number,
                "irregular": run.conditions.grid.is_irregular,
                "accuracy": run.conditions.accuracy.name(),
                "pace": run.conditions.pace.to_string(),
                "error": run.error(),
                "error_of": of,
                "error_unit": unit,
                "unpredicted_error": run.unpredicted(),
                "failure": run.failure,
                "worst": {"at": worst.at, "exact": worst.exact, "simulated": worst.simulated, "aside": worst.aside},
                "seconds": run.seconds,
            })
        })
    });
    json!({"rows": rows.collect::<Vec<_>>()})
}

/// Returns filters and their times, for `selvedge accuracy`: one row for each set, format, filter and instruction set.
pub fn accuracy(accuracy: &FilterAccuracy) -> Value {
    let options = accuracy.options;
    let sets = accuracy.sets.iter().map(|set| {
        let more = [
            ("drawn_from", set.drawn_from),
            ("timed", set.timed),
            ("cullable", set.cullable),
        ];
        pairs_of(&set.name, set.scalar, [set.vertex_face, set.edge_edge], &more)
    });
    json!({
        "seed": options.seed,
        "repeat": options.repeat,
        "separation": options.separation,
        "sets": sets.collect::<Vec<_>>(),
        "rows": accuracy.sets.iter().flat_map(accuracy_rows).collect::<Vec<_>>(),
    })
}

/// Returns a set of pairs: the number of each kind, and further counts.
fn pairs_of(name: &str, scalar: &str, pairs: [usize; 2], more: &[(&str, usize)]) -> Value {
    let [vertex_face, edge_edge] = pairs;
    let mut set = json!({
        "set": name,
        "scalar": scalar,
        "vertex_face": vertex_face,
        "edge_edge": edge_edge,
    });
    for &(key, count) in more {
        set[key] = count.into();
    }
    set
}

fn accuracy_rows(set: &AccuracySet) -> Vec<Value> {
    let share = |count: usize, of: usize| count as f64 / of as f64;
    let mut rows = Vec::new();
    for row in &set.rows {
        for &time in &row.times {
            let is_best = row.best_time() == Some(time);
            rows.push(json!({
                "set": set.name,
                "tier": row.filter.name(),
                "certified": row.filter.is_certified(),
                "scalar": set.scalar,
                "backend": time.backend,
                "nanoseconds_per_pair": time.nanoseconds,
                "nanoseconds_per_pair_in_first_cache": row.in_first_cache.filter(|_| is_best),
                "over_uncertified": set.over_uncertified(time),
                "culled_fraction": share(row.culled, set.pairs()),
                "cullable_fraction": share(set.cullable, set.pairs()),
                "kept_of_cullable_fraction": share(row.kept_cullable, set.cullable),
                "false_culls": row.false_culls,
            }));
        }
    }
    rows
}

/// Returns elementary tests, their times and errors: a part of `selvedge accuracy`.
pub fn elementary(accuracy: &ElementaryAccuracy) -> Value {
    let sets = accuracy.sets.iter().map(|set| {
        let more = [("touching", set.touching), ("with_time", set.with_time)];
        pairs_of(&set.name, set.scalar, [set.vertex_face, set.edge_edge], &more)
    });
    let rows = accuracy.sets.iter().flat_map(|set| {
        set.rows.iter().map(|row| {
            json!({
                "set": set.name,
                "scalar": set.scalar,
                "method": row.method.name(),
                "tolerance": row.method.tolerance(),
                "certified": row.method.is_certified(),
                "pairs": row.asked,
                "touching": row.touching,
                "nanoseconds_per_pair": row.nanoseconds,
                "false_negatives": row.missed,
                "late": row.late,
                "latest": row.latest,
                "false_positives": row.false_alarms,
                "early_median": row.early,
                "early_most": row.early.map(|_| row.earliest),
            })
        })
    });
    json!({
        "seed": accuracy.options.seed,
        "repeat": accuracy.options.repeat,
        "sets": sets.collect::<Vec<_>>(),
        "rows": rows.collect::<Vec<_>>(),
    })
}

/// Returns every method's answers to the hard cases, for `selvedge hard-cases`.
pub fn hard_cases(scalar: &str, results: &[HardResult]) -> Value {
    let cases = results.iter().map(|result| {
        let case = result.case;
        let (first, enclosure) = match &case.contact {
            ExactContact::Never => ("never", None),
            ExactContact::Undefined => ("undefined", None),
            ExactContact::First { exact, from, to } => (exact.as_str(), Some([*from, *to])),
        };
        let answers = QueryMethod::ALL.into_iter().zip(result.answers);
        let answers = answers.map(|(method, answer)| {
            let answer = match answer {
                HardAnswer::Right => "right",
                HardAnswer::FalseAlarm => "false-alarm",
                HardAnswer::Missed => "missed",
            };
            (method.name().to_owned(), Value::from(answer))
        });
        json!({
            "case": case.name,
            "placement": case.placement,
            "kind": case.pair.kind.name(),
            "first_contact": first,
            "between": enclosure,
            "answers": answers.collect::<serde_json::Map<_, _>>(),
        })
    });
    json!({
        "scalar": scalar,
        "cases": cases.collect::<Vec<_>>(),
    })
}
