//! Writes PLY.

use super::super::format::PlyEncoding;
use selvedge::Mesh;
use std::io::{self, Write};

/// Writes a mesh with coordinates of the type `double`.
pub(in super::super) fn write(
    out: &mut impl Write,
    mesh: &Mesh,
    loose_edges: &[[u32; 2]],
    encoding: PlyEncoding,
) -> io::Result<()> {
    let format = match encoding {
        PlyEncoding::Ascii => "ascii",
        PlyEncoding::LittleEndian => "binary_little_endian",
        PlyEncoding::BigEndian => "binary_big_endian",
    };
    write!(
        out,
        "ply\nformat {format} 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n\
         element face {}\nproperty list uchar uint vertex_indices\n",
        mesh.positions.len(),
        mesh.triangles.len()
    )?;
    if !loose_edges.is_empty() {
        let count = loose_edges.len();
        write!(out, "element edge {count}\nproperty uint vertex1\nproperty uint vertex2\n")?;
    }
    out.write_all(b"end_header\n")?;
    match encoding {
        PlyEncoding::Ascii => write_text(out, mesh, loose_edges),
        PlyEncoding::LittleEndian => write_binary(out, mesh, loose_edges, f64::to_le_bytes, u32::to_le_bytes),
        PlyEncoding::BigEndian => write_binary(out, mesh, loose_edges, f64::to_be_bytes, u32::to_be_bytes),
    }
}

fn write_text(out: &mut impl Write, mesh: &Mesh, loose_edges: &[[u32; 2]]) -> io::Result<()> {
    // `{:?}` is the shortest decimal that reads back as the same number.
    for p in &mesh.positions {
        writeln!(out, "{:?} {:?} {:?}", p.x, p.y, p.z)?;
    }
    for [a, b, c] in &mesh.triangles {
        writeln!(out, "3 {a} {b} {c}")?;
    }
    for [a, b] in loose_edges {
        writeln!(out, "{a} {b}")?;
    }
    Ok(())
}

fn write_binary(
    out: &mut impl Write,
    mesh: &Mesh,
    loose_edges: &[[u32; 2]],
    coordinate: fn(f64) -> [u8; 8],
    index: fn(u32) -> [u8; 4],
) -> io::Result<()> {
    for position in &mesh.positions {
        out.write_all(position.to_array().map(coordinate).as_flattened())?;
    }
    for triangle in &mesh.triangles {
        out.write_all(&[3])?;
        out.write_all(triangle.map(index).as_flattened())?;
    }
    for ends in loose_edges {
        out.write_all(ends.map(index).as_flattened())?;
    }
    Ok(())
}
