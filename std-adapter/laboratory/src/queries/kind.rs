//! How a benchmark file's path tells the kind of its pairs, and what its points are called.

use selvedge::PairKind;
use std::path::Path;

/// The kind that a path names, or `None`.
///
/// The file's folder decides if it is called `vertex-face` or `edge-edge` (so the benchmark's query sets are laid out); else a file
/// name that ends in `vf` or `ee` before its extension does, if no letter comes before it (`227vf.csv`, but not `knee.csv`).
#[must_use]
pub fn kind_of_path(path: &Path) -> Option<PairKind> {
    // Made absolute so that `data.csv` inside `vertex-face` is recognised from there.
    let absolute = std::path::absolute(path);
    let folder = absolute.as_deref().unwrap_or(path).parent();
    let folder_name = folder.and_then(Path::file_name).and_then(|name| name.to_str());
    folder_name
        .and_then(|name| name.parse().ok())
        .or_else(|| kind_of_stem(path.file_stem()?.to_str()?))
}

fn kind_of_stem(stem: &str) -> Option<PairKind> {
    let ends_in = |suffix| {
        stem.strip_suffix(suffix)
            .is_some_and(|rest| !rest.ends_with(char::is_alphabetic))
    };
    if ends_in("vf") {
        Some(PairKind::VertexFace)
    } else if ends_in("ee") {
        Some(PairKind::EdgeEdge)
    } else {
        None
    }
}

/// The names of a query's four points, in the order of its rows.
pub(super) const fn point_names(kind: PairKind) -> [&'static str; 4] {
    match kind {
        PairKind::VertexFace => ["v", "f0", "f1", "f2"],
        PairKind::EdgeEdge => ["a0", "a1", "b0", "b1"],
    }
}
