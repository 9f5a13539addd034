//! Writes the binary half of a glTF file, and the JSON that refers to it.

use serde_json::{Value, json};

/// A file that the format, which numbers bytes by a `u32`, cannot hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("an animation of {0} bytes does not fit into a glTF file, which holds 4 GiB; record fewer frames")]
pub struct TooLarge(pub u64);

/// The code of a number format.
const UNSIGNED_INT: u32 = 5125;
const FLOAT: u32 = 5126;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// One buffer, with a view and an accessor for each array in it.
#[derive(Debug, Default)]
pub(super) struct Binary {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Binary {
    /// Adds the vertices of triangles. Returns the accessor, as all such functions do.
    pub(super) fn add_indices(&mut self, triangles: &[[u32; 3]]) -> usize {
        let bytes = triangles.iter().flatten().flat_map(|index| index.to_le_bytes());
        let view = self.add_view(bytes, Some(ELEMENT_ARRAY_BUFFER));
        let count = 3 * triangles.len();
        self.add_accessor(view, UNSIGNED_INT, "SCALAR", count, json!({}))
    }

    pub(super) fn add_vectors(&mut self, vectors: &[[f32; 3]]) -> usize {
        let (mut least, mut most) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
        for vector in vectors {
            for axis in 0..3 {
                least[axis] = least[axis].min(vector[axis]);
                most[axis] = most[axis].max(vector[axis]);
            }
        }
        let bytes = vectors.iter().flatten().flat_map(|number| number.to_le_bytes());
        let view = self.add_view(bytes, Some(ARRAY_BUFFER));
        let bounds = json!({"min": least, "max": most});
        self.add_accessor(view, FLOAT, "VEC3", vectors.len(), bounds)
    }

    /// Adds vectors of the type `kind`, as an animation needs them.
    pub(super) fn add_items<const N: usize>(&mut self, kind: &str, items: &[[f32; N]]) -> usize {
        let bytes = items.iter().flatten().flat_map(|number| number.to_le_bytes());
        let view = self.add_view(bytes, None);
        self.add_accessor(view, FLOAT, kind, items.len(), json!({}))
    }

    /// Adds numbers for an animation; there must be some.
    pub(super) fn add_numbers(&mut self, numbers: &[f32]) -> usize {
        let least = numbers.iter().copied().fold(f32::INFINITY, f32::min);
        let most = numbers.iter().copied().fold(f32::NEG_INFINITY, f32::max);
        let bytes = numbers.iter().flat_map(|number| number.to_le_bytes());
        let view = self.add_view(bytes, None);
        let bounds = json!({"min": [least], "max": [most]});
        self.add_accessor(view, FLOAT, "SCALAR", numbers.len(), bounds)
    }

    /// Adds a view. Every number takes four bytes, so that every view begins at a multiple of four.
    fn add_view(&mut self, bytes: impl Iterator<Item = u8>, target: Option<u32>) -> usize {
        let begin = self.bytes.len();
        self.bytes.extend(bytes);
        let mut view = json!({
            "buffer": 0,
            "byteOffset": begin,
            "byteLength": self.bytes.len() - begin,
        });
        if let Some(target) = target {
            view["target"] = target.into();
        }
        self.views.push(view);
        self.views.len() - 1
    }

    fn add_accessor(&mut self, view: usize, component: u32, kind: &str, count: usize, mut accessor: Value) -> usize {
        accessor["bufferView"] = view.into();
        accessor["componentType"] = component.into();
        accessor["type"] = kind.into();
        accessor["count"] = count.into();
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    /// Returns the file: header, JSON, binary.
    pub(super) fn into_file(self, mut document: Value) -> Result<Vec<u8>, TooLarge> {
        if !self.bytes.is_empty() {
            document["buffers"] = json!([{"byteLength": self.bytes.len()}]);
            document["bufferViews"] = self.views.into();
            document["accessors"] = self.accessors.into();
        }
        let mut text = document.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let mut chunks = vec![(*b"JSON", text)];
        if !self.bytes.is_empty() {
            chunks.push((*b"BIN\0", self.bytes));
        }
        let length = 12 + chunks.iter().map(|(_, data)| 8 + data.len()).sum::<usize>();
        let whole = u32::try_from(length).map_err(|_| TooLarge(length as u64))?;
        let mut file = Vec::with_capacity(length);
        file.extend(b"glTF");
        file.extend(2_u32.to_le_bytes());
        file.extend(whole.to_le_bytes());
        for (kind, data) in chunks {
            // This is shorter than the whole, which fits.
            file.extend((data.len() as u32).to_le_bytes());
            file.extend(kind);
            file.extend(data);
        }
        Ok(file)
    }
}
