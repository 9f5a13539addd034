//! Runs of the program that `tables/*.toml` lists, with what each must print and write.
//!
//! | key of a case | meaning |
//! |---|---|
//! | `run` | the arguments, or several lists of arguments with the same results; `'…'` holds a word with spaces |
//! | `status` | the exit status, 0 by default. 1 and 2 print one message, nothing else, and leave no file behind |
//! | `out`, `lacks`, `notes` | texts on standard output, texts that are not there, texts on standard error |
//! | `json` | values in the document on standard output, by pointer: a value, or `least`, `most`, `length`, `keys` |
//! | `wrote` | every file and folder that is there afterwards and was not before |
//! | `text`, `is` | texts in a file; all of a file |
//!
//! `[files]` lists the files of all cases, and `files` those of one. `then` holds further runs in the same folder.

use crate::support::Workplace;
use serde_json::{Map, Value};
use toml::de::{DeTable, DeValue};

/// Converts what a table holds.
fn value(toml: &DeValue<'_>) -> Value {
    match toml {
        DeValue::String(text) => text.as_ref().into(),
        DeValue::Integer(number) => number.as_str().parse::<i64>().unwrap().into(),
        DeValue::Float(number) => number.as_str().parse::<f64>().unwrap().into(),
        DeValue::Boolean(value) => (*value).into(),
        DeValue::Array(values) => values.iter().map(|own| value(own.get_ref())).collect(),
        DeValue::Table(table) => object(table).into(),
        DeValue::Datetime(_) => unreachable!("no case has a date"),
    }
}

fn object(table: &DeTable<'_>) -> Map<String, Value> {
    let entries = table.iter();
    entries
        .map(|(key, own)| (key.get_ref().to_string(), value(own.get_ref())))
        .collect()
}

/// Returns whether a value of a document is the expected one; numbers are equal whatever their type.
fn fits(expected: &Value, found: &Value) -> bool {
    match expected {
        Value::Object(rules) => rules.iter().all(|(rule, bound)| match rule.as_str() {
            "least" => found.as_f64() >= bound.as_f64(),
            "most" => found.as_f64().is_some_and(|found| found <= bound.as_f64().unwrap()),
            "length" => found.as_array().is_some_and(|list| bound.as_u64() == Some(list.len() as u64)),
            "keys" => found.as_object().is_some_and(|own| own.keys().eq(bound.as_array().unwrap())),
            _ => panic!("there is no rule `{rule}`"),
        }),
        Value::Array(list) => found
            .as_array()
            .is_some_and(|own| own.len() == list.len() && list.iter().zip(own).all(|(expected, found)| fits(expected, found))),
        Value::Number(number) => number.as_f64() == found.as_f64(),
        Value::String(text) if text == "null" => found.is_null(),
        _ => expected == found,
    }
}

fn words(line: &str) -> Vec<&str> {
    let parts = line.split('\'').enumerate();
    parts
        .flat_map(|(index, part)| match index % 2 {
            0 => part.split_whitespace().collect(),
            _ => vec![part],
        })
        .collect()
}

fn list(value: &Value) -> Vec<&str> {
    match value {
        Value::String(text) => vec![text],
        Value::Array(all) => all.iter().map(|text| text.as_str().expect("a text")).collect(),
        _ => Vec::new(),
    }
}

/// Runs a command of a case, and returns what is wrong.
fn mistakes(place: &Workplace, case: &Value, line: &str) -> Vec<String> {
    let before = place.listing();
    let output = place.run(&words(line));
    let [out, notes] = [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes).into_owned());
    let mut wrong = Vec::new();
    let mut check = |is_right: bool, what: String| {
        if !is_right {
            wrong.push(what);
        }
    };
    let status = case["status"].as_i64().unwrap_or(0);
    check(
        output.status.code().map(i64::from) == Some(status),
        format!("status {:?}", output.status.code()),
    );
    check(!notes.contains("panicked"), "a panic".into());
    let written: Vec<String> = place.listing().into_iter().filter(|name| !before.contains(name)).collect();
    if status == 1 || status == 2 {
        let message = notes.find("error: ").map_or("", |start| &notes[start..]);
        check(out.is_empty() && written.is_empty(), format!("{out}{written:?}"));
        check(
            if status == 1 {
                message.lines().count() == 1
            } else {
                !message.is_empty()
            },
            "no message".into(),
        );
    }
    for text in list(&case["out"]) {
        check(out.contains(text), format!("`{text}` is not printed"));
    }
    for text in list(&case["lacks"]) {
        check(!out.contains(text), format!("`{text}` is printed"));
    }
    for text in list(&case["notes"]) {
        check(notes.contains(text), format!("`{text}` is not among the notes"));
    }
    if let Value::Object(expected) = &case["json"] {
        let document: Value = serde_json::from_str(&out).unwrap_or_default();
        for (pointer, expected) in expected {
            let found = document.pointer(pointer);
            check(
                found.is_some_and(|found| fits(expected, found)),
                format!("{pointer}: {expected} is {found:?}"),
            );
        }
    }
    if case["wrote"].is_array() {
        check(written == list(&case["wrote"]), format!("wrote {written:?}"));
    }
    for (name, texts) in case["text"].as_object().into_iter().flatten() {
        for text in list(texts) {
            check(place.read(name).contains(text), format!("`{text}` is not in {name}"));
        }
    }
    for (name, all) in case["is"].as_object().into_iter().flatten() {
        check(
            Some(&*place.read(name)) == all.as_str(),
            format!("{name}: {}", place.read(name)),
        );
    }
    if !wrong.is_empty() {
        wrong.push(format!("{out}{notes}"));
    }
    wrong
}

fn run(table: &str) {
    let table = Value::from(object(DeTable::parse(table).expect("a table").get_ref()));
    let mut failures = Vec::new();
    for case in table["case"].as_array().expect("cases") {
        let place = Workplace::new();
        for (name, content) in [&table["files"], &case["files"]]
            .into_iter()
            .filter_map(Value::as_object)
            .flatten()
        {
            place.write(name, content.as_str().expect("a text"));
        }
        for step in std::iter::once(case).chain(case["then"].as_array().into_iter().flatten()) {
            for line in list(&step["run"]) {
                let wrong = mistakes(&place, step, line);
                if !wrong.is_empty() {
                    failures.push(format!("{}: selvedge {line}\n  {}", case["name"], wrong.join("\n  ")));
                }
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// A test for each table, so that they run side by side.
macro_rules! tables {
    ($($name:ident),*) => {
        $(#[test]
        fn $name() {
            run(include_str!(concat!("tables/", stringify!($name), ".toml")));
        })*
    };
}

tables!(cull, check, compare, queries, refusals, simulate);
