//! The sections on energy, on the stretch of the cloth and on loads, which are measured at frames.

use super::tables;
use crate::report::number::{moment, three_figures};
use crate::report::recording::{GRAVITATIONAL, Measure, MeasureKind, Recording};
use maud::{Markup, html};

/// A measure on the page.
pub(in crate::report) struct ShownMeasure<'a> {
    pub(in crate::report) name: &'a str,
    pub(in crate::report) kind: MeasureKind,
    pub(in crate::report) values: Vec<f64>,
}

impl<'a> ShownMeasure<'a> {
    pub(in crate::report) fn all(recording: &'a Recording) -> Vec<Self> {
        recording.measures.iter().map(Self::new).collect()
    }

    /// Gravitational energy counts from its least value, since an arbitrary origin would dwarf everything else.
    fn new(measure: &'a Measure) -> Self {
        let least = measure.values.iter().copied().fold(f64::INFINITY, f64::min);
        let floor = if measure.name == GRAVITATIONAL { least } else { 0.0 };
        Self {
            name: &measure.name,
            kind: measure.kind,
            values: measure.values.iter().map(|value| value - floor).collect(),
        }
    }

    pub(super) const fn kind_name(&self) -> &'static str {
        match self.kind {
            MeasureKind::Energy => "energy",
            MeasureKind::EffectEnergy => "effect-energy",
            MeasureKind::Stretch => "stretch",
            MeasureKind::Load => "load",
        }
    }

    pub(super) const fn unit(&self) -> &'static str {
        match self.kind {
            MeasureKind::Energy | MeasureKind::EffectEnergy => "J",
            MeasureKind::Stretch => "",
            MeasureKind::Load => "N",
        }
    }

    /// Returns the values at the start, at most, and at the end.
    fn row(&self) -> (&str, [String; 3]) {
        let values = &self.values;
        let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let ends = [values.first(), values.last()].map(|end| end.copied().unwrap_or(f64::NAN));
        (self.name, [ends[0], most, ends[1]].map(three_figures))
    }
}

/// Returns all sections, as far as they have content.
pub(super) fn sections(recording: &Recording) -> Markup {
    let shown = ShownMeasure::all(recording);
    let rows = |kind: MeasureKind| shown.iter().filter(move |one| one.kind == kind).map(ShownMeasure::row);
    let has = |kind: MeasureKind| !recording.measured_steps.is_empty() && rows(kind).next().is_some();
    html! {
        @if has(MeasureKind::Energy) {
            section {
                h2 { "Energy" }
                div.chart data-kind="energy" {}
                @if has(MeasureKind::EffectEnergy) { div.chart data-kind="effect-energy" {} }
                (tables::table(["energy, in J", "at the start", "most", "at the end"], rows(MeasureKind::Energy)))
                p.note {
                    "Gravitational energy counts from its least value. Lost is the energy drop since the start: the losses to friction, drag, contacts, \
                     strain limits and implicit steps, less the work of moving bodies, pins and wind."
                }
            }
        }
        @if has(MeasureKind::Stretch) {
            section {
                h2 { "Edge lengths relative to rest" }
                div.chart data-kind="stretch" {}
                (stretch(recording))
            }
        }
        @if has(MeasureKind::Load) {
            section {
                h2 { "Force of the cloth on what holds it" }
                div.chart data-kind="load" {}
                (tables::table(["force, in N", "at the start", "most", "at the end"], rows(MeasureKind::Load)))
                p.note { "Each value is the mean of the " (recording.about.unit) " before a picture." }
            }
        }
    }
}

fn stretch(recording: &Recording) -> Markup {
    let rows = recording.measures_of(MeasureKind::Stretch).map(|measure| {
        let end = measure.values.last().copied().unwrap_or(f64::NAN);
        let when = moment(recording.end_of(measure.largest_step));
        (&*measure.name, [three_figures(end), three_figures(measure.largest), when])
    });
    tables::table(["", "at the end", "largest, of all frames", "when"], rows)
}
