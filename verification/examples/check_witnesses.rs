//! Checks the proofs that `selvedge cull --witnesses FILE` writes, in exact numbers, and that no pair is missing.
//!
//! `cargo run --release -p selvedge-verification --example check_witnesses -- FILE`
//!
//! Each pair whose swept boxes overlap must have a record, and each record a proof that holds: see `docs/witnesses.md`. Exit
//! status 1 if one has not, or the file is invalid.

use fnv::FnvHashSet;
use indicatif::{ProgressBar, ProgressStyle};
use rayon::prelude::*;
use selvedge_core::PairKind;
use selvedge_verification::witness::{Answer, Record, WitnessFile, WitnessFileError};
use std::fs::File;
use std::io::BufReader;
use std::process::ExitCode;

/// The number of records that are checked at a time.
const CHUNK: usize = 50_000;

fn main() -> ExitCode {
    let mut arguments = std::env::args_os().skip(1);
    let (Some(path), None) = (arguments.next(), arguments.next()) else {
        eprintln!("usage: check_witnesses FILE");
        return ExitCode::from(2);
    };
    let file = File::open(&path).map_err(WitnessFileError::from);
    match file.and_then(|file| WitnessFile::open(BufReader::new(file))).and_then(check) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("{}: {error}", path.display());
            ExitCode::FAILURE
        }
    }
}

#[derive(Default)]
struct Counts {
    records: usize,
    never: usize,
    parts: usize,
    most_parts: usize,
    refused: usize,
}

/// A pair by its vertices, in an order that does not depend on which edge is the first.
type Key = (bool, [u32; 4]);

fn check(mut file: WitnessFile<BufReader<File>>) -> Result<bool, WitnessFileError> {
    let pairs = overlapping(file.positions(), file.triangles());
    let mut missing: FnvHashSet<Key> = pairs.into_iter().collect();
    println!("{} pairs with swept boxes that overlap", missing.len());
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} pairs, {eta} left").expect("valid template");
    let progress = ProgressBar::new(missing.len() as u64).with_style(style);
    let mut counts = Counts::default();
    loop {
        let records = file.by_ref().take(CHUNK).collect::<Result<Vec<Record>, _>>()?;
        if records.is_empty() {
            break;
        }
        let refused = records.par_iter().filter(|record| !record.claim.is_proven());
        counts.refused += refused.inspect(|record| println!("refused: {record:?}")).count();
        for record in &records {
            let parts = record.claim.parts.len();
            counts.records += 1;
            counts.never += usize::from(record.answer == Answer::Never);
            counts.parts += parts;
            counts.most_parts = counts.most_parts.max(parts);
            missing.remove(&key(record.claim.kind, record.vertices));
        }
        progress.inc(records.len() as u64);
    }
    progress.finish_and_clear();
    let Counts {
        records,
        never,
        parts,
        most_parts,
        refused,
    } = counts;
    println!(
        "{records} records: {never} never touch, {} until a time; {parts} parts, at most {most_parts} in one",
        records - never
    );
    println!("{refused} refused, {} pairs missing", missing.len());
    Ok(refused == 0 && missing.is_empty())
}

fn key(kind: PairKind, mut vertices: [u32; 4]) -> Key {
    match kind {
        PairKind::VertexFace => vertices[1..].sort_unstable(),
        PairKind::EdgeEdge => {
            vertices[..2].sort_unstable();
            vertices[2..].sort_unstable();
            if vertices[..2] > vertices[2..] {
                vertices.rotate_left(2);
            }
        }
    }
    (kind == PairKind::VertexFace, vertices)
}

/// A feature of the mesh: its vertices, and its box during the step. Only comparisons make it, so it is exact.
struct Swept<const N: usize> {
    vertices: [u32; N],
    low: [f64; 3],
    high: [f64; 3],
}

fn swept<const N: usize>(positions: &[Vec<[f64; 3]>; 2], features: impl IntoIterator<Item = [u32; N]>) -> Vec<Swept<N>> {
    let swept = |vertices: [u32; N]| {
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for vertex in vertices {
            for frame in positions {
                let position = frame[vertex as usize];
                low = std::array::from_fn(|axis| low[axis].min(position[axis]));
                high = std::array::from_fn(|axis| high[axis].max(position[axis]));
            }
        }
        Swept { vertices, low, high }
    };
    let mut swept: Vec<_> = features.into_iter().map(swept).collect();
    swept.sort_by(|a, b| a.low[0].total_cmp(&b.low[0]));
    swept
}

/// Returns all pairs without a common vertex whose swept boxes overlap.
fn overlapping(positions: &[Vec<[f64; 3]>; 2], triangles: &[[u32; 3]]) -> Vec<Key> {
    let is_proper = |&&[a, b, c]: &&[u32; 3]| a != b && b != c && c != a;
    let sides = triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let edges: FnvHashSet<[u32; 2]> = sides.filter(|[a, b]| a != b).map(|[a, b]| [a.min(b), a.max(b)]).collect();
    let vertices: FnvHashSet<[u32; 1]> = triangles.as_flattened().iter().map(|&vertex| [vertex]).collect();
    let (vertices, edges) = (swept(positions, vertices), swept(positions, edges));
    let faces = swept(positions, triangles.iter().filter(is_proper).copied());
    let mut pairs = sweep(&vertices, &faces, |&[v], &[a, b, c]| key(PairKind::VertexFace, [v, a, b, c]));
    pairs.extend(sweep(&edges, &edges, |&[u, v], &[k, l]| {
        key(PairKind::EdgeEdge, [u, v, k, l])
    }));
    pairs
}

/// Both lists are in the order of the lower ends of their boxes along the first axis.
fn sweep<const N: usize, const M: usize>(
    first: &[Swept<N>],
    second: &[Swept<M>],
    key: impl Fn(&[u32; N], &[u32; M]) -> Key + Sync,
) -> Vec<Key> {
    let width = second
        .iter()
        .map(|one| one.high[0] - one.low[0])
        .fold(0.0, f64::max)
        .next_up();
    let pairs = first.par_iter().flat_map_iter(|one| {
        // Rounded down, and by one place more, so that no box that begins later is left out.
        let begin = second.partition_point(|other| other.low[0] < (one.low[0] - width).next_down());
        let near = second[begin..].iter().take_while(|other| other.low[0] <= one.high[0]);
        let near = near.filter(|other| (0..3).all(|axis| one.low[axis] <= other.high[axis] && other.low[axis] <= one.high[axis]));
        let near = near.filter(|other| !one.vertices.iter().any(|vertex| other.vertices.contains(vertex)));
        near.map(|other| key(&one.vertices, &other.vertices)).collect::<Vec<_>>()
    });
    pairs.collect()
}
