use super::table;
use crate::methods::Preset;
use crate::report::n_log_n_ratios;
use crate::report::number::{counted, grouped, time};
use crate::study::ScalingPoint;

/// Returns a table of cost against size.
pub fn scaling(preset: Preset, threads: usize, points: &[ScalingPoint]) -> String {
    let header = [
        "triangles",
        "triangle\npairs",
        "candi-\ndates",
        "set-up",
        "first\nstep",
        "step",
        "ns a\ntriangle",
        "over\nn log n",
    ];
    let rows = points.iter().zip(n_log_n_ratios(points)).map(|(point, ratio)| {
        [
            grouped(point.triangles),
            match point.step.broad_phase_pairs {
                None => grouped(point.step.triangle_pairs),
                Some(_) => String::new(),
            },
            grouped(point.step.candidates().total()),
            time(point.setup_seconds),
            time(point.first_step_seconds),
            time(point.step.seconds),
            format!("{:.0}", point.step.seconds * 1e9 / point.triangles as f64),
            format!("{ratio:.2}"),
        ]
    });
    format!(
        "{preset} on one late step of the arm scene, {}\n\n{}\n\
         over n log n: the step's time over n log n, relative to the first size.\n\
         The finer the sleeve, the shorter the step, so that vertices move as many edge\n\
         lengths a step at every size.\n",
        counted(threads, "thread"),
        table(header, rows)
    )
}
