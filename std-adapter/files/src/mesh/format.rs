//! The formats of mesh files and their extensions.

use std::path::Path;

/// The form of the numbers of a PLY file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PlyEncoding {
    /// Text.
    Ascii,
    /// Binary, least significant byte first.
    #[default]
    LittleEndian,
    /// Binary, most significant byte first.
    BigEndian,
}

/// The format of a mesh file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileFormat {
    /// Wavefront OBJ: text, vertices numbered from 1.
    Obj,
    /// PLY, the Stanford polygon format. A reader finds the encoding in the header.
    Ply(PlyEncoding),
    /// STL, text or binary. It is read, not written: its binary form holds 32-bit numbers.
    Stl,
    /// OFF, text. It is read, not written.
    Off,
    /// glTF, text or binary (`.glb`): the meshes of the whole scene, at rest. It is read, not written, and needs the feature
    /// `gltf`. For animations see [`animation`](crate::animation).
    Gltf,
}

impl FileFormat {
    /// Each extension, in lower case, and its format. `.ply` is written as binary, little endian.
    pub const EXTENSIONS: [(&str, Self); 6] = [
        ("obj", Self::Obj),
        ("ply", Self::Ply(PlyEncoding::LittleEndian)),
        ("stl", Self::Stl),
        ("off", Self::Off),
        ("gltf", Self::Gltf),
        ("glb", Self::Gltf),
    ];

    /// Returns the format that the extension of `path` names, in upper or lower case.
    ///
    /// ```
    /// use selvedge_files::mesh::FileFormat;
    /// assert_eq!(FileFormat::from_path("body.STL".as_ref()), Some(FileFormat::Stl));
    /// assert_eq!(FileFormat::from_path("body.fbx".as_ref()), None);
    /// ```
    #[must_use]
    pub fn from_path(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_str()?;
        let format = Self::EXTENSIONS.iter().find(|(name, _)| extension.eq_ignore_ascii_case(name));
        format.map(|&(_, format)| format)
    }

    /// Returns the extensions as a list in words: `.obj, .ply or .stl`.
    #[must_use]
    pub fn extensions_in_words() -> String {
        let [first @ .., last] = Self::EXTENSIONS.map(|(name, _)| format!(".{name}"));
        format!("{} or {last}", first.join(", "))
    }
}
