//! Files of answers with their proofs, for a whole step. `docs/witnesses.md` has the format.

use selvedge::core::elementary::advance::{Proof, Witness, witness};
use selvedge::core::elementary::{Impact, Limits};
use selvedge::core::{Motion, PrimitivePair, Scalar};
use selvedge::{PairKind, Topology};
use std::io::{self, Write};

/// The pairs of a step, and the positions of its vertices.
pub(super) struct Step<'a, S: Scalar> {
    pub(super) topology: &'a Topology,
    /// The positions at the start and at the end.
    pub(super) frames: [&'a [S::Vector]; 2],
    /// Pairs of a vertex and a face, and of two edges.
    pub(super) pairs: [&'a [[u32; 2]]; 2],
}

impl<S: Scalar> Step<'_, S> {
    /// Writes the answer for each pair with its proof, and returns how many never touch.
    pub(super) fn write(&self, out: &mut impl Write) -> io::Result<usize> {
        let limits = Limits::<S>::default();
        out.write_all(b"SLVWIT01")?;
        write_numbers(out, [limits.separation])?;
        write_count(out, self.topology.vertex_count())?;
        for &position in self.frames.into_iter().flatten() {
            write_numbers::<S>(out, position.into())?;
        }
        let triangles = self.topology.triangles();
        write_count(out, triangles.len())?;
        for index in triangles.as_flattened() {
            out.write_all(&index.to_le_bytes())?;
        }
        let mut never = 0;
        for (kind, pairs) in PairKind::ALL.into_iter().zip(self.pairs) {
            for &pair in pairs {
                let vertices = self.topology.vertices_of(kind, pair);
                let motions = vertices.map(|vertex| {
                    let [start, end] = self.frames.map(|frame| frame[vertex as usize]);
                    Motion { start, end }
                });
                let (impact, witness) = witness(&PrimitivePair { kind, motions }, &limits);
                never += usize::from(impact == Impact::Never);
                out.write_all(&[u8::from(kind == PairKind::EdgeEdge)])?;
                for index in vertices {
                    out.write_all(&index.to_le_bytes())?;
                }
                write_answer(out, impact, &witness)?;
            }
        }
        Ok(never)
    }
}

fn write_answer<S: Scalar>(out: &mut impl Write, impact: Impact<S>, witness: &Witness<S>) -> io::Result<()> {
    let time = impact.time();
    out.write_all(&[u8::from(time.is_some())])?;
    write_numbers(out, [time.unwrap_or(S::ONE)])?;
    let parts = witness.parts();
    out.write_all(&[u8::try_from(parts.len()).map_err(io::Error::other)?])?;
    for part in parts {
        let directions = match &part.proof {
            Proof::Volume => &[],
            Proof::Held(w) => std::slice::from_ref(w),
            Proof::Turning(directions) => directions.as_slice(),
            Proof::Curving(directions) => directions.as_slice(),
        };
        out.write_all(&[directions.len() as u8])?;
        write_numbers(out, [part.until])?;
        write_numbers(out, directions.iter().flatten().copied())?;
    }
    Ok(())
}

fn write_count(out: &mut impl Write, count: usize) -> io::Result<()> {
    out.write_all(&u32::try_from(count).map_err(io::Error::other)?.to_le_bytes())
}

fn write_numbers<S: Scalar>(out: &mut impl Write, numbers: impl IntoIterator<Item = S>) -> io::Result<()> {
    numbers.into_iter().try_for_each(|x| out.write_all(&x.to_f64().to_le_bytes()))
}
