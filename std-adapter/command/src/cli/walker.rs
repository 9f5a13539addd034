//! `selvedge walker`.

use super::Failure;
use super::output::OutputFiles;
use std::path::PathBuf;

/// Writes a scene of a skinned figure that walks in a shirt, with its meshes
///
/// The files are walker.toml, walker.glb and walker-shirt.ply. `selvedge simulate` runs the scene.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example:
  selvedge walker --output walker
  selvedge simulate walker/walker.toml --threads 1")]
pub(crate) struct Walker {
    /// Write to this folder
    #[arg(long, value_name = "DIR", default_value = ".")]
    output: PathBuf,
}

impl Walker {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        OutputFiles::check_folder(&self.output)?;
        let mut files = OutputFiles::default();
        for (name, content) in selvedge_cloth::WALKER {
            files.add_bytes(self.output.join(name), content)?;
        }
        files.publish()
    }
}
