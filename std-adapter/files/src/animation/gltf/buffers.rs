//! The bytes that a file points to: in the file, beside it, or written in it as text.

use super::short;
use crate::problem::AnimationProblem;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use gltf::buffer::Source;
use std::io::{self, Read};
use std::path::Path;

/// Returns the bytes of all buffers, each as long as the file says.
pub(super) fn read(document: &gltf::Document, blob: Option<Vec<u8>>, path: &Path) -> Result<Vec<Vec<u8>>, AnimationProblem> {
    let mut blob = blob;
    let one = |buffer: gltf::Buffer<'_>| {
        let wrong = |reason: String| AnimationProblem::Buffer {
            buffer: buffer.index(),
            reason,
        };
        let mut bytes = match buffer.source() {
            Source::Bin => blob
                .take()
                .ok_or_else(|| wrong("is to be the file's binary part, but it has none".to_owned()))?,
            Source::Uri(uri) => match uri.strip_prefix("data:") {
                Some(data) => inline(data).map_err(wrong)?,
                None => {
                    let name = plain(uri);
                    let read = beside(path, &name, buffer.length());
                    read.map_err(|error| wrong(format!("is the file '{}', which cannot be read: {error}", short(&name))))?
                }
            },
        };
        if bytes.len() < buffer.length() {
            let (found, said) = (bytes.len(), buffer.length());
            return Err(wrong(format!(
                "is to have {said} bytes, but has {found}; is the file complete?"
            )));
        }
        bytes.truncate(buffer.length());
        Ok(bytes)
    };
    document.buffers().map(one).collect()
}

/// Returns the first bytes of a file in the folder of `path`. The path is empty if the bytes came from no file.
fn beside(path: &Path, name: &str, length: usize) -> io::Result<Vec<u8>> {
    if path.as_os_str().is_empty() {
        return Err(io::Error::other("the bytes come without a folder"));
    }
    let path = path.parent().unwrap_or(Path::new("")).join(name);
    // This refuses devices, which may have no end.
    if !std::fs::metadata(&path)?.is_file() {
        return Err(io::Error::other("it is no file"));
    }
    let mut bytes = Vec::new();
    std::fs::File::open(&path)?.take(length as u64).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Returns the bytes of `TYPE;base64,TEXT`.
fn inline(data: &str) -> Result<Vec<u8>, String> {
    let text = data.split_once(";base64,").map(|(_, text)| text);
    let text = text.ok_or("is given in the file, but not in base64")?;
    STANDARD.decode(text).map_err(|error| format!("is no valid base64: {error}"))
}

/// Returns a file's name without the escapes of a URI (`%20`).
fn plain(uri: &str) -> String {
    let mut bytes = Vec::new();
    let mut rest = uri.as_bytes();
    while let Some((&first, after)) = rest.split_first() {
        let code = after.get(..2).filter(|_| first == b'%');
        let code = code.and_then(|code| u8::from_str_radix(std::str::from_utf8(code).ok()?, 16).ok());
        bytes.push(code.unwrap_or(first));
        rest = if code.is_some() { &after[2..] } else { after };
    }
    String::from_utf8(bytes).unwrap_or_else(|_| uri.to_owned())
}
