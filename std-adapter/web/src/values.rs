//! Conversion of values to JavaScript and back.

use crate::numbers::{is_empty, numbers};
use js_sys::{Error, Float64Array, Object, Reflect, Uint32Array, WebAssembly};
use selvedge::StepError;
use selvedge_core::PairKind;
use wasm_bindgen::{JsCast, JsValue, prelude::wasm_bindgen};

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &str = include_str!("types.d.ts");

// Arguments with the types that the declarations give them.
#[wasm_bindgen]
extern "C" {
    #[wasm_bindgen(typescript_type = "Positions")]
    pub type Positions;
    #[wasm_bindgen(typescript_type = "Positions | undefined")]
    pub type Frame;
    #[wasm_bindgen(typescript_type = "Record<string, Uint8Array | string> | undefined")]
    pub type Files;
}

/// An exception with a name and the message of an error of the library.
pub struct Exception(JsValue);

impl Exception {
    pub(crate) fn new(name: &str, message: &impl ToString) -> Self {
        let error = Error::new(&message.to_string());
        error.set_name(name);
        Self(error.into())
    }

    pub(crate) fn input(message: &impl ToString) -> Self {
        Self::new("InputError", message)
    }
}

impl From<Exception> for JsValue {
    fn from(exception: Exception) -> Self {
        exception.0
    }
}

impl From<StepError> for Exception {
    fn from(error: StepError) -> Self {
        let name = match error {
            StepError::TooManyPairs { .. } => "TooManyPairsError",
            StepError::TooMuchMemory { .. } => "TooMuchMemoryError",
            _ => "InputError",
        };
        Self::new(name, &error)
    }
}

/// Makes an object from its properties.
pub(crate) fn object<'a>(properties: impl IntoIterator<Item = (&'a str, JsValue)>) -> Object {
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
pub(crate) fn take_positions(positions: &JsValue, name: &str, rows: &mut Vec<[f64; 3]>) -> Result<(), Exception> {
    let mut take = |length: usize| {
        if !length.is_multiple_of(3) {
            let words = format!("{name}: {length} numbers are not three for each vertex");
            return Err(Exception::input(&words));
        }
        rows.resize(length / 3, [0.0; 3]);
        Ok(())
    };
    // Nothing is copied twice.
    if let Some(array) = positions.dyn_ref::<Float64Array>() {
        let length = if is_empty(positions) { 0 } else { array.length() as usize };
        take(length)?;
        if length > 0 {
            array.copy_to(rows.as_flattened_mut());
        }
        return Ok(());
    }
    let numbers = numbers(positions, name)?;
    take(numbers.len())?;
    rows.as_flattened_mut().copy_from_slice(&numbers);
    Ok(())
}

/// Splits a flat list into rows.
pub(crate) fn rows_of<const N: usize>(values: &[u32], name: &str) -> Result<Vec<[u32; N]>, Exception> {
    match values.as_chunks::<N>() {
        (rows, []) => Ok(rows.to_vec()),
        _ => {
            let text = format!("{name}: {} numbers are not {N} for each entry", values.len());
            Err(Exception::input(&text))
        }
    }
}

pub(crate) fn kind_number(kind: PairKind) -> u8 {
    u8::from(kind == PairKind::EdgeEdge)
}

pub(crate) fn kind_of(name: &str) -> Result<PairKind, Exception> {
    name.parse().map_err(|error| Exception::input(&error))
}

pub(crate) fn array<const N: usize>(values: [u32; N]) -> JsValue {
    values.into_iter().map(JsValue::from).collect::<js_sys::Array>().into()
}
