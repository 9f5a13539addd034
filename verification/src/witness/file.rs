//! Reads files of witnesses: see `docs/witnesses.md`.

use super::{Claim, ExactPart};
use selvedge_core::PairKind;
use std::io::{ErrorKind, Read};

const MAGIC: &[u8; 8] = b"SLVWIT01";

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answer {
    Never,
    /// Contact cannot be ruled out from a time on.
    Possible,
}

/// Why a file of witnesses cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum WitnessFileError {
    /// It cannot be read, or ends within a record.
    #[error(transparent)]
    Io(#[from] std::io::Error),
    /// It has an invalid value.
    #[error("invalid {what}")]
    Invalid { what: &'static str },
}

/// An open file of witnesses.
#[derive(Debug)]
pub struct WitnessFile<R> {
    bytes: R,
    separation: f64,
    /// The positions at the start and at the end of the step.
    positions: [Vec<[f64; 3]>; 2],
    triangles: Vec<[u32; 3]>,
}

/// A record: a pair of the mesh, the answer and the claim.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// The vertex and those of the face, or those of the first and of the second edge.
    pub vertices: [u32; 4],
    pub answer: Answer,
    pub claim: Claim,
}

impl<R: Read> WitnessFile<R> {
    /// Reads the header.
    ///
    /// # Errors
    /// Returns an error if the file cannot be read or is no file of witnesses.
    pub fn open(mut bytes: R) -> Result<Self, WitnessFileError> {
        let mut magic = [0; 8];
        bytes.read_exact(&mut magic)?;
        if magic != *MAGIC {
            return Err(WitnessFileError::Invalid { what: "first bytes" });
        }
        let separation = number(&mut bytes)?;
        let vertices = index(&mut bytes)?;
        let mut frame = || (0..vertices).map(|_| vector(&mut bytes)).collect::<Result<Vec<_>, _>>();
        let positions = [frame()?, frame()?];
        let count = index(&mut bytes)?;
        let triangle = |_| Ok([index(&mut bytes)?, index(&mut bytes)?, index(&mut bytes)?]);
        let triangles = (0..count).map(triangle).collect::<Result<Vec<_>, std::io::Error>>()?;
        if triangles.as_flattened().iter().any(|&vertex| vertex >= vertices) {
            return Err(WitnessFileError::Invalid { what: "triangle" });
        }
        Ok(Self {
            bytes,
            separation,
            positions,
            triangles,
        })
    }

    /// The positions of the vertices at the start and at the end of the step.
    pub const fn positions(&self) -> &[Vec<[f64; 3]>; 2] {
        &self.positions
    }

    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    fn record(&mut self, kind: u8) -> Result<Record, WitnessFileError> {
        let invalid = |what| Err(WitnessFileError::Invalid { what });
        let bytes = &mut self.bytes;
        let kind = match kind {
            0 => PairKind::VertexFace,
            1 => PairKind::EdgeEdge,
            _ => return invalid("kind"),
        };
        let vertices = [index(bytes)?, index(bytes)?, index(bytes)?, index(bytes)?];
        let answer = match byte(bytes)? {
            0 => Answer::Never,
            1 => Answer::Possible,
            _ => return invalid("answer"),
        };
        let until = number(bytes)?;
        if answer == Answer::Never && until != 1.0 {
            return invalid("time of an answer");
        }
        let mut parts = Vec::new();
        for _ in 0..byte(bytes)? {
            let directions = byte(bytes)?;
            if directions > 3 {
                return invalid("proof");
            }
            let until = number(bytes)?;
            let directions = (0..directions).map(|_| vector(bytes)).collect::<Result<_, _>>()?;
            parts.push(ExactPart { until, directions });
        }
        let mut points = [[[0.0; 3]; 2]; 4];
        for (point, vertex) in points.iter_mut().zip(vertices) {
            for (position, frame) in point.iter_mut().zip(&self.positions) {
                match frame.get(vertex as usize) {
                    Some(there) => *position = *there,
                    None => return invalid("vertex"),
                }
            }
        }
        let separation = self.separation;
        Ok(Record {
            vertices,
            answer,
            claim: Claim {
                kind,
                points,
                separation,
                until,
                parts,
            },
        })
    }
}

impl<R: Read> Iterator for WitnessFile<R> {
    type Item = Result<Record, WitnessFileError>;

    fn next(&mut self) -> Option<Self::Item> {
        match byte(&mut self.bytes) {
            Ok(kind) => Some(self.record(kind)),
            Err(error) if error.kind() == ErrorKind::UnexpectedEof => None,
            Err(error) => Some(Err(error.into())),
        }
    }
}

fn bytes<const N: usize>(reader: &mut impl Read) -> std::io::Result<[u8; N]> {
    let mut bytes = [0; N];
    reader.read_exact(&mut bytes)?;
    Ok(bytes)
}

fn byte(reader: &mut impl Read) -> std::io::Result<u8> {
    bytes(reader).map(|[byte]| byte)
}

fn index(reader: &mut impl Read) -> std::io::Result<u32> {
    bytes(reader).map(u32::from_le_bytes)
}

fn number(reader: &mut impl Read) -> std::io::Result<f64> {
    bytes(reader).map(f64::from_le_bytes)
}

fn vector(reader: &mut impl Read) -> std::io::Result<[f64; 3]> {
    Ok([number(reader)?, number(reader)?, number(reader)?])
}
