//! `selvedge arm`.

use super::Failure;
use super::options::refinement_parser;
use super::output::{self, OutputFiles};
use selvedge::Mesh;
use selvedge_files::mesh;
use selvedge_laboratory::scene::ArmScene;
use std::path::PathBuf;

/// Writes frames of the built-in arm scene as mesh files, to try the other commands on
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example:
  selvedge arm --frames 55,56 --output frames
  selvedge cull frames/arm-55.ply frames/arm-56.ply")]
pub(crate) struct Arm {
    /// Write these frames, from 0 (the arm straight) to 60 (fully bent), separated by commas
    #[arg(long, value_name = "N,…", value_delimiter = ',', default_value = "55,56", value_parser = clap::value_parser!(u32).range(0..=ArmScene::STEPS as i64))]
    frames: Vec<u32>,
    /// Multiply the sleeve's 1,345 triangles by this
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = refinement_parser())]
    refinement: u32,
    /// Write this kind of file
    #[arg(long, value_enum, default_value_t = Format::Ply)]
    format: Format,
    /// Write to this folder
    #[arg(long, value_name = "DIR", default_value = ".")]
    output: PathBuf,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Format {
    /// Binary PLY
    Ply,
    /// Text, without loss of precision
    Obj,
}

impl Arm {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let scene = ArmScene::new(self.refinement)?;
        OutputFiles::check_folder(&self.output)?;
        let extension = match self.format {
            Format::Ply => "ply",
            Format::Obj => "obj",
        };
        for &frame in &self.frames {
            let path = self.output.join(format!("arm-{frame:02}.{extension}"));
            let mesh = Mesh::new(scene.frame(frame as usize), scene.topology().triangles().to_vec());
            mesh::write(&path, &mesh)?;
            output::say(format_args!("wrote {}", path.display()));
        }
        Ok(())
    }
}
