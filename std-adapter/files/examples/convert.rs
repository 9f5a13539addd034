//! Reads a mesh and writes it in another format: `cargo run --example convert -- FROM TO`, both named `.obj`, `.ply` and so on.
//!
//! It reports on standard error the properties of the file and the parts that were left out.

use selvedge_files::mesh::{Findings, MeshError, read, write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

fn main() -> ExitCode {
    let paths: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    let [from, to] = paths.as_slice() else {
        eprintln!("usage: convert FROM TO");
        return ExitCode::from(2);
    };
    match convert(from, to) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn convert(from: &Path, to: &Path) -> Result<(), MeshError> {
    let file = read(from)?;
    eprintln!("{}: {}", from.display(), file.notes);
    if let Ok(topology) = file.mesh.topology() {
        eprintln!("{}", Findings::of(&file.mesh.positions, &topology));
    }
    write(to, &file.mesh)
}
