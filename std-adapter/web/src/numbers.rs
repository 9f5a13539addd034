//! Numbers from JavaScript, checked before they are used. wasm-bindgen itself would turn NaN, `undefined` and 2³² into 0, 2.5
//! into 2, and −1 into 4294967295.

use crate::values::Exception;
use js_sys::{Array, ArrayBuffer, BigInt64Array, BigUint64Array, DataView, Float64Array, Uint8Array, Uint32Array};
use wasm_bindgen::{JsCast, JsValue, prelude::wasm_bindgen};

// Arguments with the types that the declarations give them.
#[wasm_bindgen]
extern "C" {
    #[wasm_bindgen(typescript_type = "number")]
    pub type Number;
    #[wasm_bindgen(typescript_type = "Uint32Array | ArrayLike<number>")]
    pub type WholeNumbers;
    #[wasm_bindgen(typescript_type = "Uint8Array | ArrayLike<number | boolean>")]
    pub type Flags;
    #[wasm_bindgen(typescript_type = "ArrayLike<number>")]
    pub type Numbers;
    #[wasm_bindgen(typescript_type = "Uint8Array")]
    pub type Bytes;
}

/// The largest whole number that a `number` holds exactly.
const LARGEST_WHOLE: f64 = 9_007_199_254_740_991.0;

fn wrong(name: &str, expected: &str, found: &JsValue) -> Exception {
    Exception::input(&format!("{name} must be {expected}, not {}", shown(found)))
}

/// Returns a value in a few words.
fn shown(value: &JsValue) -> String {
    if let Some(number) = value.as_f64() {
        return js_sys::Number::from(number)
            .to_string_with_radix(10)
            .map_or_else(|_| number.to_string(), String::from);
    }
    if let Some(text) = value.as_string() {
        let short: String = text.chars().take(40).collect();
        return format!("the text '{short}'");
    }
    match value {
        _ if value.is_undefined() => "undefined".to_owned(),
        _ if value.is_null() => "null".to_owned(),
        _ if Array::is_array(value) => "an array".to_owned(),
        _ => format!("a value of type {}", value.js_typeof().as_string().unwrap_or_default()),
    }
}

pub(crate) fn number(value: &JsValue, name: &str) -> Result<f64, Exception> {
    value.as_f64().ok_or_else(|| wrong(name, "a number", value))
}

/// Returns a number that may be left out.
pub(crate) fn optional<T>(
    value: Option<&Number>,
    name: &str,
    read: impl Fn(&JsValue, &str) -> Result<T, Exception>,
) -> Result<Option<T>, Exception> {
    value.map(|value| read(value, name)).transpose()
}

fn is_whole(number: f64, largest: f64) -> bool {
    number >= 0.0 && number <= largest && number.trunc() == number
}

fn whole_below(value: &JsValue, name: &str, largest: f64) -> Result<f64, Exception> {
    let whole = value.as_f64().filter(|&number| is_whole(number, largest));
    whole.ok_or_else(|| wrong(name, &format!("a whole number from 0 to {largest}"), value))
}

pub(crate) fn whole(value: &JsValue, name: &str) -> Result<u32, Exception> {
    whole_below(value, name, u32::MAX.into()).map(|whole| whole as u32)
}

/// Returns a whole number of any size.
pub(crate) fn large(value: &JsValue, name: &str) -> Result<u64, Exception> {
    whole_below(value, name, LARGEST_WHOLE).map(|whole| whole as u64)
}

/// Returns the numbers of a list: a typed array, an array, or what is like one. Each entry must be a number.
pub(crate) fn numbers(list: &JsValue, name: &str) -> Result<Vec<f64>, Exception> {
    let is_view = ArrayBuffer::is_view(list) && !list.is_instance_of::<DataView>();
    if list.is_instance_of::<BigInt64Array>() || list.is_instance_of::<BigUint64Array>() {
        return Err(Exception::input(&format!(
            "{name} must hold numbers, not values of type bigint"
        )));
    }
    if let Some(array) = list.dyn_ref::<Float64Array>() {
        return Ok(array.to_vec());
    }
    if is_view {
        return Ok(Float64Array::new(list).to_vec());
    }
    entries(list, name)?
        .iter()
        .enumerate()
        .map(|(place, entry)| number(&entry, &format!("{name}: entry {place}")))
        .collect()
}

/// Returns the entries of an array, or of an object with a length.
fn entries(list: &JsValue, name: &str) -> Result<Array, Exception> {
    if let Some(array) = list.dyn_ref::<Array>() {
        return Ok(array.clone());
    }
    let length = crate::values::get(list, "length").filter(|_| list.is_object());
    match length.and_then(|length| length.as_f64()) {
        Some(length) if is_whole(length, u32::MAX.into()) => Ok(Array::from(list)),
        _ => Err(wrong(name, "an array of numbers", list)),
    }
}

/// Returns the whole numbers of a list.
pub(crate) fn wholes(list: &JsValue, name: &str) -> Result<Vec<u32>, Exception> {
    if let Some(array) = list.dyn_ref::<Uint32Array>() {
        return Ok(array.to_vec());
    }
    let numbers = numbers(list, name)?;
    match numbers.iter().position(|&number| !is_whole(number, u32::MAX.into())) {
        None => Ok(numbers.into_iter().map(|number| number as u32).collect()),
        Some(place) => {
            let expected = format!("a whole number from 0 to {}", u32::MAX);
            Err(wrong(&format!("{name}: entry {place}"), &expected, &numbers[place].into()))
        }
    }
}

/// Returns for each entry of a list whether it is true or a number that is not zero.
pub(crate) fn flags(list: &JsValue, name: &str) -> Result<Vec<bool>, Exception> {
    if let Some(array) = list.dyn_ref::<Uint8Array>() {
        return Ok(array.to_vec().into_iter().map(|flag| flag != 0).collect());
    }
    if ArrayBuffer::is_view(list) {
        return Ok(wholes(list, name)?.into_iter().map(|flag| flag != 0).collect());
    }
    let flag = |(place, entry): (usize, JsValue)| match entry.as_bool() {
        Some(flag) => Ok(flag),
        None => whole(&entry, &format!("{name}: entry {place}")).map(|number| number != 0),
    };
    entries(list, name)?.iter().enumerate().map(flag).collect()
}

pub(crate) fn bytes(value: &JsValue, name: &str) -> Result<Vec<u8>, Exception> {
    let bytes = value.dyn_ref::<Uint8Array>().map(Uint8Array::to_vec);
    bytes.ok_or_else(|| wrong(name, "a Uint8Array", value))
}

/// Returns a number of a settings object; `None` if it is absent. `undefined` counts as absent.
pub(crate) fn setting(object: &JsValue, name: &str) -> Result<Option<f64>, Exception> {
    crate::values::get(object, name).map(|value| number(&value, name)).transpose()
}

/// Refuses a settings object with other properties than these.
pub(crate) fn check_names(object: &JsValue, what: &str, names: &[&str]) -> Result<(), Exception> {
    let Some(own) = object.dyn_ref::<js_sys::Object>() else {
        return Err(wrong(what, "an object", object));
    };
    let all = js_sys::Object::keys(own);
    let mut keys = all.iter().filter_map(|key| key.as_string());
    match keys.find(|key| !names.contains(&&**key)) {
        None => Ok(()),
        Some(key) => {
            let short: String = key.chars().take(40).collect();
            Err(Exception::input(&format!(
                "{what} has no property '{short}'; choose from {}",
                names.join(", ")
            )))
        }
    }
}
