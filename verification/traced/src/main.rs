//! Writes the computations of core's kernels for Gappa or Coq, or accepts them: see `usage` below.

use selvedge_traced::{Prover, accepted};
use std::path::Path;
use std::process::ExitCode;
use std::{env, fs};

const USAGE: &str = "\
usage: selvedge-traced gappa|coq FOLDER    write the terms of the code; fails if they are not the accepted ones
       selvedge-traced accept              accept the terms of the code";

fn main() -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let done = match arguments[..] {
        ["accept"] => accept(),
        [name, folder] => match Prover::ALL.into_iter().find(|prover| prover.name() == name) {
            Some(prover) => write(prover, Path::new(folder)),
            None => Err(USAGE.to_owned()),
        },
        _ => Err(USAGE.to_owned()),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("{why}");
            ExitCode::FAILURE
        }
    }
}

/// Writes the texts, which show the changes, and checks them.
fn write(prover: Prover, folder: &Path) -> Result<(), String> {
    for (name, text) in [prover.texts(), prover.checked_texts()].concat() {
        let path = folder.join(name);
        fs::write(&path, text).map_err(|error| format!("{}: {error}", path.display()))?;
    }
    accepted::check(prover)
}

fn accept() -> Result<(), String> {
    let path = accepted::path();
    fs::write(&path, accepted::list()).map_err(|error| format!("{}: {error}", path.display()))
}
