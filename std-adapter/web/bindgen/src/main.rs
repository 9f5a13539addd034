//! Writes the JavaScript and the TypeScript declarations of a module: `selvedge-bindgen MODULE.wasm FOLDER NAME`.
//!
//! It does what the command `wasm-bindgen --target web` does, at the version in the lock file, and builds in a third of the time.

use std::path::Path;
use wasm_bindgen_cli_support::Bindgen;

/// What the JavaScript begins with: the errors of calls before the module is loaded, and after an object is freed.
const ERRORS: &str = r#"
function refusal(message) {
    const error = new Error(message);
    error.name = "InputError";
    return error;
}
const notLoaded = new Proxy({}, {
    get() { throw refusal("the module is not loaded: call `await load()` before anything else"); },
});
function forget(object, name) {
    const done = () => {};
    Object.defineProperty(object, "__wbg_ptr", { get() { throw refusal(`this ${name} was freed`); } });
    // To free an object again does nothing.
    Object.defineProperty(object, "free", { value: done });
    if (Symbol.dispose) Object.defineProperty(object, Symbol.dispose, { value: done });
}
"#;

/// Lets calls before the module is loaded, and of freed objects, say so.
fn with_errors(script: &str) -> Result<String, String> {
    let mut text = script.to_owned();
    let mut replace = |from: &str, to: &str| {
        let found = text.contains(from);
        text = text.replace(from, to);
        if found {
            Ok(())
        } else {
            Err(format!("the JavaScript has no '{from}'"))
        }
    };
    replace(
        "let wasmModule, wasmInstance, wasm;",
        &format!("{ERRORS}\nlet wasmModule, wasmInstance, wasm = notLoaded;"),
    )?;
    replace("if (wasm !== undefined) return wasm;", "if (wasm !== notLoaded) return wasm;")?;
    const DESTROY: &str = "this.__wbg_ptr = 0;";
    let mut parts = text.split(DESTROY);
    let mut made = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        // `NAMEFinalization.unregister(this)` follows.
        let name = part.split("Finalization.unregister").next().unwrap_or_default().trim();
        made += &format!("forget(this, \"{name}\");{part}");
    }
    Ok(made)
}

/// Declares the classes and functions alone, without the functions that load the module. Those name types of the DOM, which a
/// program in Node may not have; the package has its own `load`.
fn without_loading(declarations: &str) -> Result<String, String> {
    let (own, _) = declarations
        .split_once("export type InitInput")
        .ok_or("the declarations have no 'InitInput'")?;
    // `Symbol.dispose` is newer than ES2022.
    Ok(format!("/// <reference lib=\"esnext.disposable\" />\n{}\n", own.trim_end()))
}

fn change(path: &Path, how: fn(&str) -> Result<String, String>) -> Result<(), String> {
    let text = std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))?;
    std::fs::write(path, how(&text)?).map_err(|error| format!("{}: {error}", path.display()))
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [module, folder, name] = &arguments[..] else {
        eprintln!("usage: selvedge-bindgen MODULE.wasm FOLDER NAME");
        std::process::exit(2);
    };
    let written = Bindgen::new().input_path(module).out_name(name).web(true).map(|bindgen| {
        bindgen
            .typescript(true)
            .remove_producers_section(true)
            .omit_default_module_path(false)
            .generate(folder)
    });
    let written = written.and_then(|written| written).map_err(|error| format!("{error:#}"));
    let file = |ending: &str| Path::new(folder).join(format!("{name}{ending}"));
    let changed = written
        .and_then(|()| change(&file(".js"), with_errors))
        .and_then(|()| change(&file(".d.ts"), without_loading))
        .and_then(|()| std::fs::remove_file(file("_bg.wasm.d.ts")).map_err(|error| error.to_string()));
    if let Err(error) = changed {
        eprintln!("selvedge-bindgen: {error}");
        std::process::exit(1);
    }
}
