//! `selvedge walker`.

use super::Failure;
use super::output::OutputFiles;
use selvedge_files::mesh::{FileFormat, PlyEncoding, write_bytes};
use selvedge_laboratory::report::gltf;
use selvedge_laboratory::scene::Walker as Figure;
use std::path::PathBuf;

/// Writes a scene of a skinned figure that walks in a shirt: walker.glb, walker-shirt.ply and walker.toml, which
/// `selvedge simulate` runs.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example:
  selvedge walker --output walker
  selvedge simulate walker/walker.toml --threads 1")]
pub(crate) struct Walker {
    /// How long edges are, in metres, from 0.005 to 0.035: 0.0155 makes 20,000 triangles of figure and 7,000 of shirt
    #[arg(long, value_name = "METRES", default_value_t = 0.0155, value_parser = pitch)]
    pitch: f64,
    /// Write to this folder
    #[arg(long, value_name = "DIR", default_value = ".")]
    output: PathBuf,
}

fn pitch(text: &str) -> Result<f64, String> {
    let pitch: f64 = text.parse().map_err(|_| "it is not a number".to_owned())?;
    if (0.005..=0.035).contains(&pitch) {
        Ok(pitch)
    } else {
        Err("it must be from 0.005 to 0.035".to_owned())
    }
}

impl Walker {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        OutputFiles::check_folder(&self.output)?;
        let walker = Figure::new(self.pitch);
        let shirt = write_bytes(walker.shirt(), FileFormat::Ply(PlyEncoding::LittleEndian))?;
        let mut files = OutputFiles::default();
        files.add_bytes(self.output.join("walker.glb"), &gltf::walker(&walker)?)?;
        files.add_bytes(self.output.join("walker-shirt.ply"), &shirt)?;
        files.add_bytes(self.output.join("walker.toml"), walker.scene().as_bytes())?;
        files.publish()
    }
}
