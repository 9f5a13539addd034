//! Point caches: the positions of a mesh's vertices frame by frame, without its faces.
//!
//! Both formats hold 32-bit numbers. MDD (LightWave, Blender) is big endian: the numbers of frames and points, the time of each
//! frame in seconds, the positions. PC2 (3ds Max, Blender) is little endian: `POINTCACHE2` and a zero, version 1, the number of
//! points, the first frame, the frames per sample, the number of samples, the positions.

use super::checks::check_finite;
use super::error::MeshError;
use crate::FileSource;
use crate::problem::FileProblem;
use selvedge_core::glam::DVec3;
use std::path::Path;

/// A point cache's format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CacheFormat {
    /// MDD.
    Mdd,
    /// PC2.
    Pc2,
}

impl CacheFormat {
    /// Returns the format that the extension of `path` names, in capitals or not: `.mdd` or `.pc2`.
    #[must_use]
    pub fn from_path(path: &Path) -> Option<Self> {
        let is = |name: &str| path.extension().is_some_and(|own| own.eq_ignore_ascii_case(name));
        match (is("mdd"), is("pc2")) {
            (true, _) => Some(Self::Mdd),
            (_, true) => Some(Self::Pc2),
            _ => None,
        }
    }
}

/// Reads the frames of the point cache at `path`: in each, the positions of all `vertex_count` vertices of a mesh.
///
/// # Errors
/// Returns an error if the file cannot be read, is no MDD or PC2 file, has another length than its header declares, has no frame,
/// has another number of points than the mesh has vertices, or has a coordinate that is not finite.
pub fn read_point_cache(source: &FileSource, path: &Path, vertex_count: usize) -> Result<Vec<Vec<DVec3>>, MeshError> {
    let format = CacheFormat::from_path(path)
        .ok_or_else(|| FileProblem::Header("is not known: a point cache is a .mdd or a .pc2 file".to_owned()));
    let bytes = || source.read(path).map_err(FileProblem::from_read);
    let read = format.and_then(|format| parse(&bytes()?, format, vertex_count));
    read.map_err(|problem| MeshError::file(path, problem))
}

/// Reads all frames. Asks for memory only in proportion to the bytes.
fn parse(bytes: &[u8], format: CacheFormat, vertex_count: usize) -> Result<Vec<Vec<DVec3>>, FileProblem> {
    let number = |word: [u8; 4]| match format {
        CacheFormat::Mdd => u32::from_be_bytes(word),
        CacheFormat::Pc2 => u32::from_le_bytes(word),
    };
    let numbers: &[[u8; 4]] = bytes.as_chunks().0;
    let header = |words: String| Err(FileProblem::Header(words));
    let (frames, points, first) = match (format, numbers) {
        (CacheFormat::Mdd, &[frames, points, ..]) => (number(frames), number(points), 2 + u64::from(number(frames))),
        (CacheFormat::Pc2, &[_, _, _, version, points, _, _, frames, ..]) if bytes.starts_with(b"POINTCACHE2\0") => {
            if number(version) != 1 {
                return header(format!("declares version {}, but only version 1 is read", number(version)));
            }
            (number(frames), number(points), 8)
        }
        (CacheFormat::Mdd, _) => {
            return header("is missing: an MDD file begins with its numbers of frames and points".to_owned());
        }
        (CacheFormat::Pc2, _) => return header("is missing: a PC2 file begins with 'POINTCACHE2'".to_owned()),
    };
    if frames == 0 {
        return header("declares no frame".to_owned());
    }
    let needed = u128::from(frames) * u128::from(points) * 12 + 4 * u128::from(first);
    if needed != bytes.len() as u128 {
        let found = bytes.len();
        return header(format!(
            "declares {frames} frames of {points} points, which take {needed} bytes, but the file has {found}; is it complete?"
        ));
    }
    if points == 0 || points as usize != vertex_count {
        return header(format!(
            "declares {points} points, but the mesh has {vertex_count} vertices; export both from one mesh"
        ));
    }
    // The length was checked.
    let (positions, _) = numbers[first as usize..].as_chunks::<3>();
    let frame = |(index, frame): (usize, &[[[u8; 4]; 3]])| {
        let position = |(vertex, words): (usize, &[[u8; 4]; 3])| {
            let position = DVec3::from_array(words.map(|word| f32::from_bits(number(word)).into()));
            check_finite(vertex, position, None).map(|()| position)
        };
        let read: Result<Vec<DVec3>, FileProblem> = frame.iter().enumerate().map(position).collect();
        read.map_err(|problem| FileProblem::Element {
            element: "frame".to_owned(),
            index,
            reason: problem.to_string(),
        })
    };
    positions.chunks_exact(points as usize).enumerate().map(frame).collect()
}
