"""Checks `selvedge cull` against the truth of the Scalable CCD sample data.

For each pipeline, checks that the candidate pairs before the elementary test contain every pair that
is listed as colliding, and counts how many of those the elementary test then misses. The exit status
is 1 if a candidate is missing or listed twice. README.md describes the data's format.
"""

import argparse
import json
import re
import sys
import tempfile
from pathlib import Path

import common

try:
    import numpy as np
    import polars as pl
except ImportError as error:
    common.missing_package(error)

KINDS = {"vertex-face": "vf", "edge-edge": "ee"}
KEY = ["i0", "i1", "i2", "i3"]
# The values of the column `kind`.
SPELLINGS = {spelling: kind for kind, short in KINDS.items() for spelling in (kind, short)}
SHOWN = 5


def frames(scene: Path) -> tuple[Path, Path]:
    """Returns the two meshes of the step, in the order of the numbers at the end of their names."""

    def number(path: Path) -> int:
        digits = re.search(r"(\d+)$", path.stem)
        return int(digits[1]) if digits else common.fail(f"{path}: no frame number in the name")

    folder = scene / "frames"
    meshes = sorted((p for p in folder.glob("*") if p.suffix in {".ply", ".obj"}), key=number)
    if len(meshes) != 2:
        common.fail(f"{folder} must hold two meshes, it holds {len(meshes)}")
    return meshes[0], meshes[1]


def listed(scene: Path, kind: str) -> tuple[np.ndarray, np.ndarray]:
    """Returns the pairs of ids of one kind, and for each whether it collides."""
    short = KINDS[kind]
    pairs = np.array(load(only(scene / "boxes", f"*{short}.json")), dtype=np.int64).reshape(-1, 2)
    truth = np.array(load(only(scene / "mma_bool", f"*{short}_mma_bool.json")), dtype=bool)
    if len(pairs) != len(truth):
        common.fail(f"{scene}: {len(pairs)} {kind} pairs, but the truth of {len(truth)}")
    return pairs, truth


def only(folder: Path, pattern: str) -> Path:
    found = list(folder.glob(pattern))
    if len(found) != 1:
        common.fail(f"{folder} must hold one {pattern}, it holds {len(found)}")
    return found[0]


def load(path: Path) -> list:
    try:
        return json.loads(path.read_text())
    except (OSError, ValueError) as error:
        common.fail(f"{path}: {error}")


def edges_of(triangles: np.ndarray) -> np.ndarray:
    """Returns all edges as (larger vertex, smaller vertex), sorted, each once, in the order of their ids."""
    halves = np.vstack([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    return np.unique(np.sort(halves, axis=1)[:, ::-1], axis=0)


def as_vertices(pairs: np.ndarray, kind: str, step: common.Step) -> np.ndarray:
    """Converts ids of primitives (vertices first, then edges, then triangles) to four vertices a pair."""
    vertices, edges = len(step.start), edges_of(step.triangles)
    first_triangle = vertices + len(edges)
    if kind == "vertex-face":
        sides = np.sort(pairs, axis=1)
        bounds = ((0, vertices), (first_triangle, first_triangle + len(step.triangles)))
    else:
        sides, bounds = pairs, ((vertices, first_triangle),) * 2
    for side, (low, high) in zip(sides.T, bounds):
        if len(side) and not (low <= side.min() and side.max() < high):
            common.fail(f"an id of a {kind} pair is outside {low}..{high}; is this the right mesh?")
    if kind == "vertex-face":
        return np.column_stack([sides[:, 0], step.triangles[sides[:, 1] - first_triangle]])
    return np.column_stack([edges[sides[:, 0] - vertices], edges[sides[:, 1] - vertices]])


def canonical(pairs: pl.DataFrame, kind: str) -> pl.DataFrame:
    """Returns the pairs in canonical form: a face's vertices ascend, an edge's too, and of two
    edges the one with the smaller vertices is first."""
    i0, i1, i2, i3 = map(pl.col, KEY)
    if kind == "vertex-face":
        low, high = pl.min_horizontal(i1, i2, i3), pl.max_horizontal(i1, i2, i3)
        return pairs.select(i0, i1=low, i2=i1 + i2 + i3 - low - high, i3=high)
    a, b = pl.min_horizontal(i0, i1), pl.max_horizontal(i0, i1)
    c, d = pl.min_horizontal(i2, i3), pl.max_horizontal(i2, i3)
    ordered = pairs.select(a=a, b=b, c=c, d=d)
    a, b, c, d = map(pl.col, "abcd")
    swap = (a > c) | ((a == c) & (b > d))

    def choose(swapped: pl.Expr, kept: pl.Expr) -> pl.Expr:
        return pl.when(swap).then(swapped).otherwise(kept)

    return ordered.select(i0=choose(c, a), i1=choose(d, b), i2=choose(a, c), i3=choose(b, d))


def read_pairs(path: Path, vertices: int) -> dict[str, pl.DataFrame]:
    """Returns the pairs of a CSV file that selvedge wrote, by kind, in canonical form."""
    if not path.is_file():
        common.fail(f"selvedge wrote no {path.name}")
    schema = dict.fromkeys(KEY, pl.Int64)
    try:
        rows = pl.read_csv(path, columns=["kind", *KEY], schema_overrides=schema)
        kinds = rows["kind"].replace_strict(SPELLINGS, return_dtype=pl.String)
    except pl.exceptions.PolarsError as error:
        common.fail(f"{path.name} does not have the columns kind,i0,i1,i2,i3 as expected: {error}")
    if rows.null_count().sum_horizontal()[0]:
        common.fail(f"{path.name} has empty fields")
    for column in KEY:
        if len(rows) and not rows[column].is_between(0, vertices - 1).all():
            common.fail(f"{path.name}: column {column} leaves 0..{vertices}")
    rows = rows.with_columns(kind=kinds)
    return {kind: canonical(rows.filter(pl.col("kind") == kind), kind) for kind in KINDS}


def check(
    arguments: argparse.Namespace,
    pipeline: str,
    paths: tuple[Path, Path],
    vertices: int,
    truth: dict[str, dict[str, pl.DataFrame]],
) -> list[dict]:
    with tempfile.TemporaryDirectory(prefix="selvedge-truth-") as folder:
        candidates_path, contacts_path = Path(folder) / "candidates.csv", Path(folder) / "pairs.csv"
        outputs = ("--candidates", candidates_path, "--pairs", contacts_path)
        common.cull(arguments.selvedge, *paths, pipeline, arguments.threads, *outputs)
        candidates = read_pairs(candidates_path, vertices)
        contacts = read_pairs(contacts_path, vertices)
    rows = []
    for kind in KINDS:
        hits, misses = truth[kind]["collides"], truth[kind]["does not"]
        lost = hits.join(candidates[kind], on=KEY, how="anti")
        unlisted = contacts[kind].join(pl.concat([hits, misses]), on=KEY, how="anti")
        row = {
            "pipeline": pipeline,
            "kind": kind,
            "colliding": len(hits),
            "candidates": len(candidates[kind]),
            "duplicate_candidates": len(candidates[kind]) - candidates[kind].n_unique(),
            "lost_before_elementary_test": len(lost),
            "contacts": len(contacts[kind]),
            "lost_in_all": len(hits.join(contacts[kind], on=KEY, how="anti")),
            "contacts_listed_as_apart": len(contacts[kind].join(misses, on=KEY, how="semi")),
            "contacts_not_listed": len(unlisted),
            "first_lost": lost.sort(KEY).head(SHOWN).rows(),
        }
        rows.append(row)
    return rows


def print_table(rows: list[dict]) -> None:
    columns = {
        "pipeline": "pipeline",
        "kind": "kind",
        "colliding": "colliding",
        "candidates": "candidates",
        "duplicate_candidates": "twice",
        "lost_before_elementary_test": "lost",
        "contacts": "contacts",
        "lost_in_all": "missed",
        "contacts_listed_as_apart": "apart",
        "contacts_not_listed": "unlisted",
    }
    names = max(len(row["pipeline"]) for row in rows)
    widths = [max(names, 8), 11, 9, 10, 6, 6, 9, 7, 6, 8]

    def line(cells: list) -> str:
        texts = [cell if isinstance(cell, str) else f"{cell:,}" for cell in cells]
        left = [f"{text:<{width}}" for text, width in zip(texts[:2], widths)]
        return " ".join(left + [f"{text:>{width}}" for text, width in zip(texts[2:], widths[2:])])

    print(line(list(columns.values())))
    for row in rows:
        print(line([row[key] for key in columns]))
    print(
        "\nlost: colliding pairs that are no candidate. missed: those that are no contact at last."
        "\napart, unlisted: contacts that the list has as not colliding, or does not have."
    )
    for row in rows:
        for pair in row["first_lost"]:
            print(f"{row['pipeline']} lost the {row['kind']} pair of the vertices {pair}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("SCENE", type=Path, help="a scene's folder with frames, boxes, mma_bool")
    common.add_shared_arguments(parser, "selvedge")
    arguments = parser.parse_args()
    if arguments.selvedge is None:
        parser.error("--selvedge is needed: the binary to check")

    paths = frames(arguments.SCENE)
    step = common.read_step(*paths)
    truth = {}
    for kind in KINDS:
        pairs, collides = listed(arguments.SCENE, kind)
        frame = pl.DataFrame(as_vertices(pairs, kind, step), schema=dict.fromkeys(KEY, pl.Int64))
        mask = pl.Series(collides)
        truth[kind] = {
            "collides": canonical(frame.filter(mask), kind).unique(),
            "does not": canonical(frame.filter(~mask), kind).unique(),
        }
    rows = []
    for pipeline in common.pipelines(arguments):
        rows += check(arguments, pipeline, paths, len(step.start), truth)
    if arguments.json:
        print(json.dumps({"rows": rows}, indent=2))
    else:
        print_table(rows)
    sound = all(
        row["lost_before_elementary_test"] == row["duplicate_candidates"] == 0 for row in rows
    )
    sys.exit(0 if sound else 1)


if __name__ == "__main__":
    main()
