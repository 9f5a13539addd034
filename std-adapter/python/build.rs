//! Writes the docstrings of the stub to files, one for each name, from which the native module takes its documentation.

use std::{env, fs, path::PathBuf};

const STUB: &str = "python/selvedge/_native.pyi";

fn main() {
    println!("cargo::rerun-if-changed={STUB}");
    println!("cargo::rerun-if-changed=build.rs");
    let stub = fs::read_to_string(STUB).expect("the stub is part of the package");
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("Cargo sets it"));
    for (name, text) in docstrings(&stub) {
        fs::write(out.join(format!("{name}.txt")), text).expect("OUT_DIR is writable");
    }
}

/// Returns the names of the stub that have a docstring, such as `Detector.near`, each with its docstring without indentation.
fn docstrings(stub: &str) -> Vec<(String, String)> {
    let mut found: Vec<(String, String)> = Vec::new();
    let (mut class, mut name) = (String::new(), None);
    let mut lines = stub.lines();
    while let Some(line) = lines.next() {
        let word = line.trim_start();
        let is_inner = line.starts_with(' ');
        if let Some(rest) = word.strip_prefix("class ") {
            class = identifier(rest);
            name = Some(class.clone());
        } else if let Some(rest) = word.strip_prefix("def ") {
            let own = identifier(rest);
            name = match own.as_str() {
                // It is that of the class.
                "__new__" => Some(class.clone()),
                _ if is_inner => Some(format!("{class}.{own}")),
                _ => Some(own),
            };
            if word.ends_with("...") {
                name = None;
            }
        } else if let (Some(rest), Some(own)) = (word.strip_prefix("\"\"\""), &name) {
            let mut text = rest.to_owned();
            while !text.contains("\"\"\"") {
                text.push('\n');
                text.push_str(lines.next().expect("a docstring has an end").trim());
            }
            let end = text.find("\"\"\"").expect("it was found");
            text.truncate(end);
            match found.iter_mut().find(|(known, _)| known == own) {
                Some((_, of_class)) => *of_class = format!("{of_class}\n\n{text}"),
                None => found.push((own.clone(), text)),
            }
            name = None;
        }
    }
    found
}

fn identifier(text: &str) -> String {
    let is_part = |letter: &char| letter.is_alphanumeric() || *letter == '_';
    text.chars().take_while(is_part).collect()
}
