//! Numbers and texts from JavaScript, checked before they are used. wasm-bindgen itself would turn NaN, `undefined` and 2³² into
//! 0, 2.5 into 2, and −1 into 4294967295. It would read any value as a text, and write where it must not if that has no length.

use crate::values::Exception;
use js_sys::{Array, ArrayBuffer, BigInt64Array, BigUint64Array, DataView, Float64Array, Reflect, Uint8Array, Uint32Array};
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
    #[wasm_bindgen(typescript_type = "string")]
    pub type Text;
    #[wasm_bindgen(typescript_type = "string[]")]
    pub type Texts;
    #[wasm_bindgen(typescript_type = "boolean")]
    pub type Flag;
}

/// The largest whole number that a `number` holds exactly.
const LARGEST_WHOLE: f64 = 9_007_199_254_740_991.0;

fn wrong(name: &str, expected: &str, found: &JsValue) -> Exception {
    Exception::input(&format!("{name} must be {expected}, not {}", shown(found)))
}

/// Returns the beginning of a text, without characters that are not shown.
pub(crate) fn short(text: &str) -> String {
    text.chars().take(40).flat_map(char::escape_debug).collect()
}

/// Returns a value in a few words.
fn shown(value: &JsValue) -> String {
    if let Some(number) = value.as_f64() {
        return js_sys::Number::from(number)
            .to_string_with_radix(10)
            .map_or_else(|_| number.to_string(), String::from);
    }
    if let Some(text) = value.as_string() {
        return format!("the text '{}'", short(&text));
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

/// Returns whether a list has no entry. So does a typed array whose buffer was transferred; it must not be copied from.
pub(crate) fn is_empty(list: &JsValue) -> bool {
    crate::values::get(list, "length").and_then(|length| length.as_f64()) == Some(0.0)
}

/// Returns the numbers of a list: a typed array, an array, or what is like one. Each entry must be a number.
pub(crate) fn numbers(list: &JsValue, name: &str) -> Result<Vec<f64>, Exception> {
    let is_view = ArrayBuffer::is_view(list) && !list.is_instance_of::<DataView>();
    if list.is_instance_of::<BigInt64Array>() || list.is_instance_of::<BigUint64Array>() {
        return Err(Exception::input(&format!(
            "{name} must hold numbers, not values of type bigint"
        )));
    }
    if is_view && is_empty(list) {
        return Ok(Vec::new());
    }
    if let Some(array) = list.dyn_ref::<Float64Array>() {
        return Ok(array.to_vec());
    }
    if is_view {
        return Ok(Float64Array::new(list).to_vec());
    }
    entries(list, name, ["an array of numbers", "a number"], JsValue::as_f64)
}

/// Returns the entries of an array, or of an object with a length, in words the list and an entry if they are something else.
///
/// They are read one by one up to the first that is wrong, since a list may claim any length.
fn entries<T>(
    list: &JsValue,
    name: &str,
    [expected, expected_entry]: [&str; 2],
    read: impl Fn(&JsValue) -> Option<T>,
) -> Result<Vec<T>, Exception> {
    let length = crate::values::get(list, "length").filter(|_| list.is_object());
    let length = length.and_then(|length| length.as_f64());
    let Some(length) = length.filter(|&length| is_whole(length, u32::MAX.into())) else {
        return Err(wrong(name, expected, list));
    };
    let entry = |place: u32| {
        let entry = Reflect::get_u32(list, place).unwrap_or(JsValue::UNDEFINED);
        read(&entry).ok_or_else(|| wrong(&format!("{name}: entry {place}"), expected_entry, &entry))
    };
    (0..length as u32).map(entry).collect()
}

pub(crate) fn text(value: &JsValue, name: &str) -> Result<String, Exception> {
    value.as_string().ok_or_else(|| wrong(name, "a text", value))
}

pub(crate) fn texts(list: &JsValue, name: &str) -> Result<Vec<String>, Exception> {
    entries(list, name, ["an array of texts", "a text"], JsValue::as_string)
}

/// Returns the whole numbers of a list.
pub(crate) fn wholes(list: &JsValue, name: &str) -> Result<Vec<u32>, Exception> {
    if let Some(array) = list.dyn_ref::<Uint32Array>().filter(|_| !is_empty(list)) {
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
    if let Some(array) = list.dyn_ref::<Uint8Array>().filter(|_| !is_empty(list)) {
        return Ok(array.to_vec().into_iter().map(|flag| flag != 0).collect());
    }
    if ArrayBuffer::is_view(list) {
        return Ok(wholes(list, name)?.into_iter().map(|flag| flag != 0).collect());
    }
    let whole = |entry: &JsValue| entry.as_f64().filter(|&number| is_whole(number, u32::MAX.into()));
    let flag = |entry: &JsValue| entry.as_bool().or_else(|| Some(whole(entry)? != 0.0));
    let expected = format!("true, false or a whole number from 0 to {}", u32::MAX);
    entries(list, name, ["an array of numbers", &expected], flag)
}

pub(crate) fn bytes(value: &JsValue, name: &str) -> Result<Vec<u8>, Exception> {
    let array = value.dyn_ref::<Uint8Array>();
    let bytes = array.map(|array| if is_empty(value) { Vec::new() } else { array.to_vec() });
    bytes.ok_or_else(|| wrong(name, "a Uint8Array", value))
}

/// Returns a number of a settings object; `None` if it is absent. `undefined` counts as absent.
pub(crate) fn setting(object: &JsValue, name: &str) -> Result<Option<f64>, Exception> {
    crate::values::get(object, name).map(|value| number(&value, name)).transpose()
}

/// Returns the names of the properties of an object.
pub(crate) fn keys(object: &JsValue, what: &str) -> Result<Vec<String>, Exception> {
    let own = object.dyn_ref::<js_sys::Object>().and_then(|own| Reflect::own_keys(own).ok());
    let own = own.ok_or_else(|| wrong(what, "an object", object))?;
    Ok(own.iter().filter_map(|key| key.as_string()).collect())
}

/// Refuses a settings object with other properties than these.
pub(crate) fn check_names(object: &JsValue, what: &str, names: &[&str]) -> Result<(), Exception> {
    match keys(object, what)?.iter().find(|key| !names.contains(&key.as_str())) {
        None => Ok(()),
        Some(key) => {
            let (short, all) = (short(key), names.join(", "));
            Err(Exception::input(&format!(
                "{what} has no property '{short}'; choose from {all}"
            )))
        }
    }
}
