//! Conversion of values to JavaScript and back.

use js_sys::{Error, Float64Array, Object, Reflect, Uint32Array, WebAssembly};
use selvedge_core::PairKind;
use wasm_bindgen::{JsCast, JsValue, prelude::wasm_bindgen};

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &str = r#"
/** Coordinates x, y, z of one vertex after another. */
export type Positions = Float64Array | Float32Array | ArrayLike<number>;
export type PairKind = "vertex-face" | "edge-edge";

/** Contacts, or pairs near each other, one after another in each array. */
export interface Contacts {
  count: number;
  /** 0: a vertex and a face; 1: two edges. */
  kind: Uint8Array;
  /** Two numbers each: the vertex and the face, or the two edges. */
  pair: Uint32Array;
  /** Times in [0, 1] of the step, none later than the exact one. */
  time: Float64Array;
  /** Four each: the vertex and the corners of the face, or the ends of both edges. */
  vertices: Uint32Array;
  /** With geometry: six coordinates each, the closest points of the first and of the second primitive. */
  points?: Float64Array;
  /** With geometry: four each, the weights of the vertices in the closest points. */
  weights?: Float64Array;
  /** With geometry: three each, the unit normal; NaN where there is none. */
  normal?: Float64Array;
  /** With geometry: two each, the bounds of the distance. */
  distance?: Float64Array;
  /** With geometry: the relative speed along the normal, in lengths per step. */
  speed?: Float64Array;
}
export interface Contact { kind: PairKind; pair: [number, number]; time: number; vertices: [number, number, number, number]; }
export interface Truncation {
  /** Positions to which the step is free of contact. */
  end: Float64Array;
  heldBack: number;
  inContact: number;
}
export interface Intersections {
  count: number;
  /** 0: an edge and a face; 1: a vertex and a face; 2: two edges. */
  kind: Uint8Array;
  pair: Uint32Array;
}
export interface Limits {
  /** Pairs that may come within this distance are contacts. Default 0. */
  separation?: number;
  /** The accuracy of times, as a length. Default 2^-30. */
  tolerance?: number;
  /** Only pairs that truly touch are contacts, decided exactly. */
  touching?: boolean;
}
export interface CollisionFilter {
  /** Two numbers for each vertex: the bits of its groups, and of the groups that it collides with. */
  groups?: Uint32Array;
  /** One number for each vertex. Vertices of one patch do not collide. */
  patches?: Uint32Array;
  /** Pairs of vertices that do not collide. */
  excluded?: Uint32Array;
}
export interface Statistics { candidates: number; filtered: number; contacts: number; seconds: number; }
export interface PairVerdicts {
  /** k0, 3 k1, 3 k2, k3 of the signed volume, and the certified bound of the error of each. */
  controlValues: Float64Array;
  errorBounds: Float64Array;
  /** True: the test proves that the pair does not touch. */
  culledBy: { sweptBoxes: boolean; segmentBox: boolean; relativeBoxes: boolean; permanent: boolean; widened: boolean; exact: boolean };
  /** No later than the first contact; undefined if there is certainly none. */
  time: number | undefined;
  /** Why no later time is proven; undefined without a time. */
  reason: string | undefined;
  /** The exact verdict. */
  contact: "never" | "happens" | "undefined";
}
"#;

/// Makes an exception with a name and the message of an error of the library.
pub(crate) fn exception(name: &str, message: &str) -> JsValue {
    let error = Error::new(message);
    error.set_name(name);
    error.into()
}

pub(crate) fn input_error(message: &impl ToString) -> JsValue {
    exception("InputError", &message.to_string())
}

/// Makes an object from its properties.
pub(crate) fn object<const N: usize>(properties: [(&str, JsValue); N]) -> Object {
    let object = Object::new();
    for (name, value) in properties {
        set(&object, name, &value);
    }
    object
}

/// Sets a property of an object of this crate, which never fails.
pub(crate) fn set(object: &Object, name: &str, value: &JsValue) {
    let _ = Reflect::set(object, &name.into(), value);
}

pub(crate) fn get(object: &JsValue, name: &str) -> Option<JsValue> {
    let value = Reflect::get(object, &name.into()).ok()?;
    (!value.is_undefined() && !value.is_null()).then_some(value)
}

pub(crate) fn floats(values: &[f64]) -> JsValue {
    Float64Array::from(values).into()
}

pub(crate) fn whole_numbers(values: &[u32]) -> JsValue {
    Uint32Array::from(values).into()
}

/// Returns a view of rows in the module's memory.
pub(crate) fn view(address: usize, rows: usize) -> Float64Array {
    let memory: WebAssembly::Memory = wasm_bindgen::memory().unchecked_into();
    Float64Array::new_with_byte_offset_and_length(&memory.buffer(), address as u32, 3 * rows as u32)
}

/// Copies positions of any number format into `rows`.
pub(crate) fn take_positions(positions: &JsValue, name: &str, rows: &mut Vec<[f64; 3]>) -> Result<(), JsValue> {
    let length = get(positions, "length").and_then(|length| length.as_f64());
    let length = length.ok_or_else(|| input_error(&format!("{name}: positions must be an array of numbers")))? as usize;
    if !length.is_multiple_of(3) {
        return Err(input_error(&format!(
            "{name}: {length} numbers are not three for each vertex"
        )));
    }
    rows.resize(length / 3, [0.0; 3]);
    match positions.dyn_ref::<Float64Array>() {
        Some(array) => array.copy_to(rows.as_flattened_mut()),
        None => Float64Array::new(positions).copy_to(rows.as_flattened_mut()),
    }
    Ok(())
}

/// Splits a flat list into rows.
pub(crate) fn rows_of<const N: usize>(values: &[u32], name: &str) -> Result<Vec<[u32; N]>, JsValue> {
    let (rows, rest) = values.as_chunks::<N>();
    if rest.is_empty() {
        Ok(rows.to_vec())
    } else {
        Err(input_error(&format!(
            "{name}: {} numbers are not {N} for each entry",
            values.len()
        )))
    }
}

pub(crate) fn kind_number(kind: PairKind) -> u8 {
    u8::from(kind == PairKind::EdgeEdge)
}

pub(crate) fn kind_of(name: &str) -> Result<PairKind, JsValue> {
    name.parse().map_err(|error| input_error(&error))
}

pub(crate) fn array<const N: usize>(values: [u32; N]) -> JsValue {
    values.into_iter().map(JsValue::from).collect::<js_sys::Array>().into()
}
