//! Files that get their name when they are complete.

use std::io;
use std::path::Path;
use tempfile::NamedTempFile;

/// Creates a file in the folder of `path`, which is deleted unless it is renamed to that path. It gets the permissions of any new
/// file.
///
/// # Errors
/// Returns an error if it cannot be made there.
pub fn beside(path: &Path) -> io::Result<NamedTempFile> {
    // A path without a folder is in the current one.
    let folder = match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    // Temporary files are private to their user.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder)
}
