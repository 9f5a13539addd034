//! The place that files come from.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};

/// The place that files come from: the disk, or memory where there is no disk, as in a browser.
///
/// Binary data beside a glTF file is read from the disk alone.
#[derive(Clone, Debug, Default)]
pub enum FileSource {
    /// The disk.
    #[default]
    Disk,
    /// Files by path. A path that a caller asks for must be equal, component by component.
    Memory(BTreeMap<PathBuf, Vec<u8>>),
}

impl FileSource {
    /// Reads a whole file.
    pub(crate) fn read(&self, path: &Path) -> io::Result<Cow<'_, [u8]>> {
        match self {
            Self::Disk => std::fs::read(path).map(Cow::Owned),
            Self::Memory(files) => {
                let bytes = files.get(plain(path)).ok_or(io::ErrorKind::NotFound)?;
                Ok(Cow::Borrowed(&bytes[..]))
            }
        }
    }

    pub(crate) fn is_folder(&self, path: &Path) -> bool {
        match self {
            Self::Disk => path.is_dir(),
            Self::Memory(files) => files.keys().any(|file| file != path && file.starts_with(path)),
        }
    }

    /// Returns the names of all files in a folder, in order. Names that are not text are left out.
    pub(crate) fn names(&self, folder: &Path) -> io::Result<Vec<String>> {
        let mut names = Vec::new();
        match self {
            Self::Disk => {
                for entry in std::fs::read_dir(folder)? {
                    names.extend(entry?.file_name().into_string().ok());
                }
            }
            Self::Memory(files) => {
                let inside = files.keys().filter(|file| file.parent() == Some(plain(folder)));
                names.extend(inside.filter_map(|file| Some(file.file_name()?.to_str()?.to_owned())));
            }
        }
        names.sort_unstable();
        Ok(names)
    }

    /// Returns the path from which a glTF file may name others; empty if it may not.
    pub(crate) fn beside<'a>(&self, path: &'a Path) -> &'a Path {
        match self {
            Self::Disk => path,
            Self::Memory(_) => Path::new(""),
        }
    }
}

/// Returns a path without a leading `./`.
fn plain(path: &Path) -> &Path {
    path.strip_prefix(".").unwrap_or(path)
}

#[cfg(test)]
mod tests {
    use super::FileSource;
    use crate::mesh::{ReadOptions, read_from, read_sequence_from};
    use std::path::Path;

    fn leaves() -> FileSource {
        let leaf = |height| format!("v 0 0 {height}\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").into_bytes();
        let files = [
            ("leaf-1.obj", leaf(0)),
            ("leaf-2.obj", leaf(1)),
            ("frames/leaf-7.obj", leaf(2)),
        ];
        FileSource::Memory(files.into_iter().map(|(name, bytes)| (name.into(), bytes)).collect())
    }

    #[test]
    fn files_in_memory_are_read_as_those_of_a_folder() {
        let mesh = read_from(&leaves(), Path::new("leaf-2.obj"), &ReadOptions::default()).unwrap();
        assert_eq!(mesh.positions[0].z, 1.0);
        let frames = |pattern: &str| read_sequence_from(&leaves(), Path::new(pattern)).unwrap().frames;
        assert_eq!(frames("leaf-#.obj").len(), 2);
        assert_eq!(frames("frames")[0][0].z, 2.0);
    }

    #[test]
    fn an_absent_file_is_an_error_that_names_it() {
        let error = read_from(&leaves(), Path::new("leaf-3.obj"), &ReadOptions::default())
            .unwrap_err()
            .to_string();
        assert_eq!(error, "leaf-3.obj: there is no such file");
    }
}
