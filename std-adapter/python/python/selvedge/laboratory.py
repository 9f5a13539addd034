"""Measures what accuracy costs in time and where methods go wrong, by running the `selvedge` command.

:func:`compare` runs every published method on the same steps, :func:`accuracy` every filter and elementary test on the same pairs, and
:func:`hard_cases` every method on degenerate pairs from the literature. A table is a dict of columns of equal length, which
``pandas.DataFrame`` and ``polars.DataFrame`` accept; ``examples/accuracy.ipynb`` plots them.

The studies measure other people's methods too, which may miss contacts, so they are not in this package but in the ``selvedge``
command: ``pip install selvedge-command`` (in a clone: ``pip install ./std-adapter/command``). ``SELVEDGE_COMMAND`` names another one.
"""

import json
import os
import shutil
import subprocess
import sysconfig
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays
from ._native import __version__
from .errors import CommandError, InputError

Table = dict[str, NDArray[Any]]
"""Columns of equal length by name. A missing value is NaN in a column of numbers and None elsewhere."""

Step = tuple[ArrayLike, ArrayLike, ArrayLike]
"""The faces and the positions at the start and at the end of a step."""


def compare(step: Step | None = None, *, pipelines: Sequence[str] = (), threads: int = 1, rounds: int = 3) -> dict[str, Table]:
    """Runs every published method on the same step of a mesh, or on the paper's bending arm: the paper's Table 1.

    :param step: faces, start and end; None for the steps of the built-in arm scene
    :param pipelines: names of methods such as ``"lv_2014"``; all of them if empty
    :param threads: 0 is one for each core
    :param rounds: how often each method runs each step; the fastest counts
    :returns: ``methods``, a row each, with pairs and contacts a step, missed contacts, frames per second, and the paper's own figures
        if it has them; ``stages``, a row for each stage of each method, with seconds a step
    :raises InputError: if the command rejects the arguments; the message is the command's
    :raises CommandError: if the command is missing or has another version
    """
    arguments = [f"--rounds={rounds}", f"--threads={threads}"]
    if pipelines:
        arguments.append(f"--pipelines={','.join(pipelines)}")
    with _meshes(step) as files:
        document = _run("compare", *files, *arguments, "--json")
    stages = [{"pipeline": row["pipeline"], **stage} for row in document["rows"] for stage in row.pop("stages")]
    return {"methods": _table(document["rows"]), "stages": _table(stages)}


def accuracy(
    step: Step | None = None,
    *,
    only: Literal["filters", "elementary"] | None = None,
    pairs: int = 200_000,
    repeat: int = 5,
    seed: int = 1,
    separation: float = 0.0,
) -> dict[str, Table]:
    """Measures what accuracy costs in time, in float32 and float64.

    :param step: a step to take pairs from as well; pairs of the built-in scene, far from the origin, and nearly coplanar ones are always
        measured
    :param only: ``"filters"`` or ``"elementary"`` to leave the other out
    :param pairs: the largest number of pairs of each set
    :param repeat: how often each timed pair goes through each filter; the fastest counts
    :param seed: the seed of random pairs
    :param separation: cull only pairs that stay farther apart than this
    :returns: ``filters``, a row for each set, format, filter and instruction set, with nanoseconds a pair, the share that it culls and
        its false culls; ``elementary``, a row for each set, format and test, with the number of misses and how early its times are;
        ``filter_sets`` and ``elementary_sets``, the pairs
    :raises InputError: if the command rejects the arguments; the message is the command's
    :raises CommandError: if the command is missing or has another version
    """
    arguments = [f"--pairs={pairs}", f"--repeat={repeat}", f"--seed={seed}", f"--separation={float(separation)!r}"]
    if only is not None:
        arguments.append(f"--only={only}")
    with _meshes(step) as files:
        document = _run("accuracy", *files, *arguments, "--json")
    tables: dict[str, Table] = {}
    if "rows" in document:
        tables |= {"filters": _table(document["rows"]), "filter_sets": _table(document["sets"])}
    if "elementary" in document:
        elementary = document["elementary"]
        tables |= {"elementary": _table(elementary["rows"]), "elementary_sets": _table(elementary["sets"])}
    return tables


def hard_cases(name: str = "", *, scalar: Literal["f32", "f64"] = "f64") -> Table:
    """Runs every method on hard cases: degenerate pairs, grazes and shapes of the literature, at several sizes and places.

    :param name: only cases whose name contains it
    :param scalar: the format to compute in; in f32 only cases whose coordinates it holds exactly
    :returns: a row for each case and method: ``case``, ``placement``, ``kind``, the exact time of ``first_contact`` as text, its bounds
        ``not_before`` and ``not_after`` (NaN if there is none), ``method``, and ``answer``: ``right``, ``false-alarm`` or ``missed``
    :raises InputError: if no case has that name
    :raises CommandError: if the command is missing or has another version
    """
    document = _run("hard-cases", f"--scalar={scalar}", "--json", "--", name)
    rows = []
    for case in document["cases"]:
        answers = case.pop("answers")
        case["not_before"], case["not_after"] = case.pop("between") or (None, None)
        rows += [{**case, "method": method, "answer": answer} for method, answer in answers.items()]
    return _table(rows)


def _table(rows: list[dict[str, Any]]) -> Table:
    """Converts rows to columns; a nested value gets both names."""
    flat = [dict(_flat(row)) for row in rows]
    names = dict.fromkeys(name for row in flat for name in row)
    return {name: _column([row.get(name) for row in flat]) for name in names}


def _flat(row: Mapping[str, Any], outer: str = "") -> Iterator[tuple[str, Any]]:
    for name, value in row.items():
        if isinstance(value, Mapping):
            yield from _flat(value, f"{outer}{name}_")
        else:
            yield outer + name, value


def _column(values: list[Any]) -> NDArray[Any]:
    known = [value for value in values if value is not None]
    is_number = all(isinstance(value, (int, float)) and not isinstance(value, bool) for value in known)
    if len(known) == len(values):
        return np.array(values)
    if known and is_number:
        return np.array([np.nan if value is None else value for value in values])
    return np.array(values, object)


@contextmanager
def _meshes(step: Step | None) -> Iterator[list[str]]:
    """Writes the two meshes of a step to files, bit for bit."""
    if step is None:
        yield []
        return
    try:
        faces, start, end = step
    except (TypeError, ValueError):
        raise InputError("step: faces, start and end are expected, three arrays") from None
    triangles = _arrays.indices(faces, "faces", 3)
    frames = {"start": _arrays.positions(start, "start", False), "end": _arrays.positions(end, "end", False)}
    with tempfile.TemporaryDirectory(prefix="selvedge-") as folder:
        files = []
        for name, positions in frames.items():
            path = Path(folder, f"{name}.ply")
            path.write_bytes(_ply(triangles, positions))
            files.append(str(path))
        yield files


def _ply(faces: NDArray[np.uint32], positions: NDArray[np.float64]) -> bytes:
    header = (
        "ply\nformat binary_little_endian 1.0\n"
        f"element vertex {len(positions)}\nproperty double x\nproperty double y\nproperty double z\n"
        f"element face {len(faces)}\nproperty list uchar uint vertex_indices\nend_header\n"
    )
    lists = np.empty(len(faces), [("count", "u1"), ("corners", "<u4", 3)])
    lists["count"] = 3
    lists["corners"] = faces
    return header.encode() + positions.astype("<f8").tobytes() + lists.tobytes()


def _command() -> str:
    """Returns the command beside this Python or on the path. It must have the same version."""
    scripts = sysconfig.get_path("scripts")
    path = os.environ.get("SELVEDGE_COMMAND") or shutil.which("selvedge", path=scripts) or shutil.which("selvedge")
    if path is None:
        raise CommandError("the `selvedge` command is missing: pip install selvedge-command, or set SELVEDGE_COMMAND to its path")
    try:
        version = subprocess.run([path, "--version"], capture_output=True, text=True, check=True).stdout.split()
    except (OSError, subprocess.CalledProcessError) as error:
        raise CommandError(f"{path}: cannot be run: {error}") from None
    if version != ["selvedge", __version__]:
        raise CommandError(f"{path} is {' '.join(version) or 'another program'}, but this package is {__version__}; install both again")
    return path


def _run(*arguments: str) -> dict[str, Any]:
    path = _command()
    # Ctrl-C reaches the command too; it writes no file of its own.
    done = subprocess.run([path, *arguments], stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if done.returncode in (1, 2):
        lines = done.stderr.strip().splitlines()
        complaint = [line.removeprefix("error: ") for line in lines if line.startswith("error: ")] or lines
        raise InputError(" ".join(complaint[:1]))
    if done.returncode != 0:
        raise CommandError(f"{path} {arguments[0]}: ended with {done.returncode}: {done.stderr.strip()[-500:]}")
    document: dict[str, Any] = json.loads(done.stdout)
    return document


__all__ = ["Step", "Table", "accuracy", "compare", "hard_cases"]
