//! Writes the JavaScript and the TypeScript declarations of a module: `selvedge-bindgen MODULE.wasm FOLDER NAME`.
//!
//! It does what the command `wasm-bindgen --target web` does, at the version in the lock file, and builds in a third of the time.

use wasm_bindgen_cli_support::Bindgen;

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
    if let Err(error) = written.and_then(|written| written) {
        eprintln!("selvedge-bindgen: {error:#}");
        std::process::exit(1);
    }
}
