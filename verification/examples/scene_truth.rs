//! Compares the oracle with the truth of a scene of the scalable collision detection data (Belgrod et al. 2023).
//!
//! `cargo run --release -p selvedge-verification --example scene_truth -- \
//!     START.ply END.ply PAIRS.json TRUTH.json [PAIRS.json TRUTH.json…]`
//!
//! `PAIRS.json` lists pairs of ids, and `TRUTH.json` whether each pair collides. Ids number the vertices, then the edges by
//! larger and then smaller vertex, then the triangles. The program prints each disagreement. The exit status is 1 if there is
//! one, or the input is invalid.

use indicatif::{ProgressBar, ProgressIterator, ProgressStyle};
use selvedge::Mesh;
use selvedge_core::PairKind;
use selvedge_files::mesh::read;
use selvedge_verification::oracle::{Pair, collides};
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

type Result<T> = std::result::Result<T, String>;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let ([start, end], lists) = match arguments.split_first_chunk::<2>() {
        Some((meshes, lists)) if !lists.is_empty() && lists.len() % 2 == 0 => (meshes, lists),
        _ => {
            eprintln!("usage: scene_truth START.ply END.ply PAIRS.json TRUTH.json…");
            return ExitCode::from(2);
        }
    };
    let compare_all = || {
        let scene = Scene::read(start, end)?;
        println!("   pairs  colliding  disagreements  mean time  file");
        let mut disagreements = 0;
        for [pairs, truth] in lists.as_chunks::<2>().0 {
            disagreements += compare(&scene, pairs, truth)?;
        }
        Ok::<usize, String>(disagreements)
    };
    match compare_all() {
        Ok(0) => ExitCode::SUCCESS,
        Ok(_) => ExitCode::FAILURE,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

/// Compares one list of pairs and returns the number of disagreements.
fn compare(scene: &Scene, pairs_path: &str, truth_path: &str) -> Result<usize> {
    let pairs: Vec<[usize; 2]> = json(pairs_path)?;
    let truth: Vec<bool> = json(truth_path)?;
    if pairs.len() != truth.len() {
        let (p, t) = (pairs.len(), truth.len());
        return Err(format!("{pairs_path} has {p} pairs, but {truth_path} has {t} entries"));
    }
    let style = ProgressStyle::with_template("{bar:40} {human_pos}/{human_len} pairs, {eta} left");
    let progress = ProgressBar::new(pairs.len() as u64).with_style(style.expect("valid template"));
    let begin = Instant::now();
    let (mut colliding, mut disagreements) = (0, 0);
    for (ids, expected) in pairs.iter().zip(&truth).progress_with(progress.clone()) {
        let pair = scene.pair(*ids).map_err(|what| format!("{pairs_path}: {what}"))?;
        let time = collides(&pair);
        colliding += usize::from(time.is_some());
        if time.is_some() != *expected {
            disagreements += 1;
            progress.suspend(|| println!("{ids:?}: truth {expected}, oracle {time:?}\n{pair:?}"));
        }
    }
    let mean = begin.elapsed().as_secs_f64() * 1e6 / pairs.len().max(1) as f64;
    let count = pairs.len();
    println!("{count:8}  {colliding:9}  {disagreements:13}  {mean:6.1} µs  {pairs_path}");
    Ok(disagreements)
}

fn json<T: serde::de::DeserializeOwned>(path: &str) -> Result<T> {
    let text = std::fs::read(path).map_err(|error| format!("{path}: {error}"))?;
    serde_json::from_slice(&text).map_err(|error| format!("{path}: {error}"))
}

struct Scene {
    start: Mesh,
    end: Mesh,
    /// The edges, smaller vertex first, ordered by the larger and then the smaller vertex.
    edges: Vec<[u32; 2]>,
}

impl Scene {
    fn read(start: &str, end: &str) -> Result<Self> {
        let mesh = |path: &str| read(Path::new(path)).map(|file| file.mesh);
        let [start, end] = [mesh(start), mesh(end)].map(|m| m.map_err(|e| e.to_string()));
        let (start, end) = (start?, end?);
        if start.triangles != end.triangles || start.positions.len() != end.positions.len() {
            return Err("the two meshes differ in topology".into());
        }
        let corners = [[0, 1], [1, 2], [2, 0]];
        let mut edges: Vec<[u32; 2]> = start
            .triangles
            .iter()
            .flat_map(|t| corners.map(|[i, j]| [t[i].min(t[j]), t[i].max(t[j])]))
            .collect();
        edges.sort_unstable_by_key(|&[smaller, larger]| (larger, smaller));
        edges.dedup();
        Ok(Self { start, end, edges })
    }

    fn pair(&self, [first, second]: [usize; 2]) -> Result<Pair> {
        let edges_from = self.start.positions.len();
        let faces_from = edges_from + self.edges.len();
        let edge = |id: usize| id.checked_sub(edges_from).and_then(|i| self.edges.get(i));
        let face = |id: usize| id.checked_sub(faces_from).and_then(|i| self.start.triangles.get(i));
        let (kind, vertices) = match (edge(first), edge(second), face(second)) {
            (Some([a, b]), Some([c, d]), _) => (PairKind::EdgeEdge, [*a, *b, *c, *d]),
            (None, _, Some([a, b, c])) if first < edges_from => {
                let vertex = u32::try_from(first).expect("the reader's indices have 32 bits");
                (PairKind::VertexFace, [vertex, *a, *b, *c])
            }
            _ => {
                return Err(format!("[{first}, {second}] is neither a vertex and a face nor two edges"));
            }
        };
        let [start, end] = [&self.start, &self.end].map(|mesh| vertices.map(|v| mesh.positions[v as usize].to_array()));
        Ok(Pair { kind, start, end })
    }
}
