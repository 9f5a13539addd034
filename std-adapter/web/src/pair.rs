//! Functions of one pair.

use crate::numbers::{Number, Text, number, optional, text};
use crate::values::{Exception, Positions, floats, kind_of, object, take_positions};
use selvedge_core::elementary::{ContactVerdict, Impact, Limits, Reason, advance, contact};
use selvedge_core::filter::{Filter, Tier};
use selvedge_core::kernels::coplanarity::MovingTetrahedron;
use selvedge_core::{Motion, PrimitivePair, boxes};
use wasm_bindgen::{JsValue, prelude::wasm_bindgen};

/// Makes a pair from twelve coordinates at the start of the step and twelve at its end.
pub(crate) fn pair_of(kind: &str, start: &JsValue, end: &JsValue) -> Result<PrimitivePair<f64>, Exception> {
    let kind = kind_of(kind)?;
    let (mut from, mut to) = (Vec::new(), Vec::new());
    take_positions(start, "start", &mut from)?;
    take_positions(end, "end", &mut to)?;
    let (Ok(from), Ok(to)) = (<[_; 4]>::try_from(from), <[_; 4]>::try_from(to)) else {
        return Err(Exception::input(
            &"a pair has four points, twelve numbers at the start and twelve at the end",
        ));
    };
    let motions = [0, 1, 2, 3].map(|point| Motion::new(from[point].into(), to[point].into()));
    Ok(PrimitivePair { kind, motions })
}

fn limits(separation: Option<f64>, tolerance: Option<f64>) -> Limits<f64> {
    Limits {
        separation: separation.unwrap_or(0.0),
        tolerance: tolerance.unwrap_or(Limits::<f64>::default().tolerance),
    }
}

/// Returns a time before which a pair certainly is farther apart than the separation; undefined if it is throughout the step.
#[wasm_bindgen(js_name = timeOfImpact)]
pub fn time_of_impact(
    #[wasm_bindgen(unchecked_param_type = "PairKind")] kind: &Text,
    start: &Positions,
    end: &Positions,
    separation: Option<Number>,
    tolerance: Option<Number>,
) -> Result<Option<f64>, Exception> {
    let separation = optional(separation.as_ref(), "separation", number)?;
    let tolerance = optional(tolerance.as_ref(), "tolerance", number)?;
    let impact = advance::time_of_impact(&pair_of(&text(kind, "kind")?, start, end)?, &limits(separation, tolerance));
    Ok(impact.time())
}

/// Runs all tests of a pair: boxes, each tier of the filter, the time of impact, and the exact verdict. Control values come with
/// their error bounds.
#[wasm_bindgen(js_name = pairVerdicts, unchecked_return_type = "PairVerdicts")]
pub fn pair_verdicts(
    #[wasm_bindgen(unchecked_param_type = "PairKind")] kind: &Text,
    start: &Positions,
    end: &Positions,
) -> Result<JsValue, Exception> {
    let pair = pair_of(&text(kind, "kind")?, start, end)?;
    let volume = MovingTetrahedron::from(&pair);
    let filter = |tier| JsValue::from(Filter::new(tier).verdict(&pair).is_culled());
    let culled_by = object([
        ("sweptBoxes", boxes::swept_boxes(&pair).is_culled().into()),
        ("segmentBox", boxes::segment::primitive_boxes(&pair).is_culled().into()),
        ("relativeBoxes", boxes::relative::three_axes(&pair).is_culled().into()),
        ("permanent", filter(Tier::Permanent)),
        ("widened", filter(Tier::Widened)),
        ("exact", filter(Tier::Exact)),
    ]);
    let impact = advance::time_of_impact(&pair, &limits(None, None));
    let verdict = match contact::contact_given_impact(&pair, &impact) {
        ContactVerdict::Never => "never",
        ContactVerdict::Happens => "happens",
        ContactVerdict::Undefined => "undefined",
    };
    let reason = match impact {
        Impact::Never => JsValue::UNDEFINED,
        Impact::Possible { reason, .. } => words(reason).into(),
    };
    let properties = [
        ("controlValues", floats(&volume.control_values().0)),
        ("errorBounds", floats(&volume.error_bounds())),
        ("culledBy", culled_by.into()),
        ("time", impact.time().map_or(JsValue::UNDEFINED, JsValue::from)),
        ("reason", reason),
        ("contact", verdict.into()),
    ];
    Ok(object(properties).into())
}

fn words(reason: Reason) -> &'static str {
    match reason {
        Reason::WithinTolerance => "the pair is within the tolerance",
        Reason::WithinError => "the pair is so close that rounding hides whether it touches",
        Reason::LastResort => "the allowed work is used up",
        Reason::OutOfRange => "coordinates differ too much",
        Reason::NotFinite => "a coordinate is not finite",
    }
}
