//! The cases of the conformance suite in `conformance/`.

use crate::oracle::{Pair, PairKind};
use serde::Deserialize;
use std::path::Path;

/// A number as a hexadecimal float.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(try_from = "String")]
pub struct Hexadecimal(pub f64);

impl TryFrom<String> for Hexadecimal {
    type Error = hexf_parse::ParseHexfError;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        match text.as_str() {
            "nan" => Ok(Self(f64::NAN)),
            "inf" => Ok(Self(f64::INFINITY)),
            "-inf" => Ok(Self(f64::NEG_INFINITY)),
            number => hexf_parse::parse_hexf64(number, false).map(Self),
        }
    }
}

#[derive(Clone, Copy, Debug, Deserialize, Eq, PartialEq)]
#[serde(rename_all = "kebab-case")]
pub enum CaseQuestion {
    VertexFace,
    EdgeEdge,
    Triangles,
    /// A triangle that translates, and one at rest before it.
    MovingTriangle,
    Meshes,
    /// A mesh whose vertices move linearly, and its pairs without a shared vertex.
    MovingMesh,
}

/// A case as the suite's schema describes it.
#[derive(Debug, Deserialize)]
pub struct Case {
    pub id: String,
    pub question: CaseQuestion,
    /// `f32` or `f64`, the smallest format that holds all numbers.
    pub format: String,
    start: Vec<[Hexadecimal; 3]>,
    end: Option<Vec<[Hexadecimal; 3]>>,
    #[serde(rename = "move")]
    translation: Option<[Hexadecimal; 3]>,
    #[serde(default)]
    pub faces: Vec<[u32; 3]>,
    /// The number of triangles of the first of two meshes.
    #[serde(default)]
    pub split: usize,
    /// Says whether there is a contact. `None` if a number is not finite.
    pub touches: Option<bool>,
    /// The first time of contact, if it is a quotient: `1/2`.
    pub exact: Option<String>,
    /// Two numbers that enclose the first time of contact.
    pub first: Option<[Hexadecimal; 2]>,
    /// Two numbers that enclose the smallest distance.
    pub distance: Option<[Hexadecimal; 2]>,
}

impl Case {
    /// Returns all cases of the suite, file by file.
    ///
    /// # Errors
    /// Returns an error if a file cannot be read, or a line is not a case.
    pub fn read_all() -> std::io::Result<Vec<Self>> {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("conformance/cases");
        let files = std::fs::read_dir(folder)?.map(|entry| Ok(entry?.path()));
        let mut files = files.collect::<std::io::Result<Vec<_>>>()?;
        files.sort();
        let mut cases = Vec::new();
        for file in files {
            for line in std::fs::read_to_string(file)?.lines() {
                cases.push(serde_json::from_str(line)?);
            }
        }
        Ok(cases)
    }

    /// Returns all positions at the start and at the end.
    pub fn positions(&self) -> [Vec<[f64; 3]>; 2] {
        let numbers = |points: &[[Hexadecimal; 3]]| -> Vec<_> { points.iter().map(|point| point.map(|x| x.0)).collect() };
        let start = numbers(&self.start);
        let mut end = self.end.as_deref().map_or_else(|| start.clone(), numbers);
        if let Some(translation) = self.translation {
            for point in &mut end[3..] {
                for (x, step) in point.iter_mut().zip(translation) {
                    *x += step.0;
                }
            }
        }
        [start, end]
    }

    /// Returns the triangles. For two triangles, the second has the vertices 3 to 5.
    pub fn triangles(&self) -> Vec<[u32; 3]> {
        match self.question {
            CaseQuestion::Triangles | CaseQuestion::MovingTriangle => vec![[0, 1, 2], [3, 4, 5]],
            _ => self.faces.clone(),
        }
    }

    /// Returns the primitive pairs that the question is about, by the indices of their points.
    pub fn pairs(&self) -> Vec<(PairKind, [u32; 4])> {
        let triangles = self.triangles();
        let (split, vertices) = match self.question {
            CaseQuestion::VertexFace => return vec![(PairKind::VertexFace, [0, 1, 2, 3])],
            CaseQuestion::EdgeEdge => return vec![(PairKind::EdgeEdge, [0, 1, 2, 3])],
            CaseQuestion::Meshes => (self.split, self.start.len()),
            CaseQuestion::Triangles | CaseQuestion::MovingTriangle => (1, 6),
            CaseQuestion::MovingMesh => (0, self.start.len()),
        };
        let is_first = |vertex: u32| triangles[..split].iter().any(|triangle| triangle.contains(&vertex));
        let are_apart = |one: u32, other: u32| one != other && (split == 0 || is_first(one) != is_first(other));
        let edges = triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        let mut edges: Vec<_> = edges.map(|[a, b]| [a.min(b), a.max(b)]).collect();
        edges.sort_unstable();
        edges.dedup();
        let mut pairs = Vec::new();
        for vertex in (0..).take(vertices) {
            let others = triangles
                .iter()
                .filter(|face| face.iter().all(|&other| are_apart(vertex, other)));
            pairs.extend(others.map(|&[a, b, c]| (PairKind::VertexFace, [vertex, a, b, c])));
        }
        for (index, &[a, b]) in edges.iter().enumerate() {
            let is_apart = |[c, d]: &&[u32; 2]| [c, d].iter().all(|&&other| are_apart(a, other) && are_apart(b, other));
            let others = edges[..index].iter().filter(is_apart);
            pairs.extend(others.map(|&[c, d]| (PairKind::EdgeEdge, [a, b, c, d])));
        }
        pairs
    }

    /// Returns the pairs of [`pairs`](Self::pairs) as the oracle takes them.
    pub fn questions(&self) -> Vec<Pair> {
        let [start, end] = self.positions();
        let pair = |(kind, points): (PairKind, [u32; 4])| {
            Pair::new(
                kind,
                points.map(|point| start[point as usize]),
                points.map(|point| end[point as usize]),
            )
        };
        self.pairs().into_iter().map(pair).collect()
    }
}
