"""Functions that the scripts of this folder share: arguments, mesh files, runs of the selvedge command."""

import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import NamedTuple, NoReturn

HERE = Path(__file__).parent


def fail(message: str, status: int = 1) -> NoReturn:
    print(f"{Path(sys.argv[0]).name}: {message}", file=sys.stderr)
    sys.exit(status)


def missing_package(error: ImportError) -> NoReturn:
    """Explains in one line how to get the packages; `error` is the exception of an import."""
    venv = Path(tempfile.gettempdir()) / "selvedge-peers"
    fail(
        f"{error}; install the packages and run again with their Python:\n"
        f"  python3 -m venv {venv} && {venv}/bin/pip install -r {HERE / 'requirements.txt'}"
        f" && {venv}/bin/python {' '.join(sys.argv)}"
    )


try:
    import meshio
    import numpy as np
except ImportError as error:
    missing_package(error)


class Step(NamedTuple):
    """A triangle mesh at both ends of a step: positions as float64, vertex ids counted from 0."""

    start: np.ndarray
    end: np.ndarray
    triangles: np.ndarray


class Run(NamedTuple):
    """One run of `selvedge cull`."""

    report: dict
    # Process time over wall time, file reading included: below 1 on one thread, something else
    # was running.
    cores: float


def add_shared_arguments(parser: argparse.ArgumentParser, default_pipeline: str) -> None:
    parser.add_argument(
        "--selvedge", type=Path, metavar="PATH", help="the selvedge binary (built with --release)"
    )
    parser.add_argument(
        "--pipeline",
        default=default_pipeline,
        metavar="NAME[,NAME…]",
        help="pipelines of selvedge to run (default: %(default)s)",
    )
    parser.add_argument("--threads", type=positive, default=1, help="threads (default: 1)")
    parser.add_argument("--json", action="store_true", help="print JSON instead of a table")


def positive(text: str) -> int:
    number = int(text)
    if number < 1:
        raise argparse.ArgumentTypeError("must be 1 or more")
    return number


def pipelines(arguments: argparse.Namespace) -> list[str]:
    names = [name.strip() for name in arguments.pipeline.split(",") if name.strip()]
    if not names:
        fail("--pipeline names no pipeline", 2)
    return names


def read_step(start: Path, end: Path) -> Step:
    (start_points, triangles), (end_points, end_triangles) = read_mesh(start), read_mesh(end)
    if not np.array_equal(triangles, end_triangles) or len(start_points) != len(end_points):
        fail(f"{start} and {end} have different topology")
    return Step(start_points, end_points, triangles)


def read_mesh(path: Path) -> tuple[np.ndarray, np.ndarray]:
    if not path.is_file():
        fail(f"{path} is no file")
    try:
        mesh = meshio.read(path)
    # meshio ends the process on some of the files that it cannot read.
    except (Exception, SystemExit) as error:
        fail(f"{path} cannot be read: {error}")
    others = {cell.type for cell in mesh.cells} - {"triangle"}
    if others or not mesh.cells:
        fail(f"{path} must hold triangles only; it has {', '.join(others) or 'no faces'}")
    # ipctk takes column-major arrays.
    points = np.asfortranarray(mesh.points, dtype=np.float64)
    return points, np.asfortranarray(np.vstack([cell.data for cell in mesh.cells]), dtype=np.int32)


def cull(
    binary: Path, start: Path, end: Path, pipeline: str, threads: int, *extra: str | Path
) -> Run:
    """Runs `selvedge cull` and returns its report."""
    command = [binary, "cull", start, end, "--pipeline", pipeline]
    command += ["--threads", threads, "--json", *extra]
    command = [os.fspath(part) if isinstance(part, Path) else str(part) for part in command]
    # A bare name would be looked up in PATH instead of the current folder.
    command[0] = os.fspath(binary.absolute())
    cpu, wall = children_cpu_seconds(), time.perf_counter()
    try:
        done = subprocess.run(command, stdout=subprocess.PIPE, check=True)
    except FileNotFoundError:
        fail(
            f"{binary} is missing; build it with `cargo build --release` and name it by --selvedge"
        )
    except PermissionError:
        fail(f"{binary} cannot be executed")
    except subprocess.CalledProcessError as error:
        fail(f"`{' '.join(command)}` ended with status {error.returncode}")
    wall, cpu = time.perf_counter() - wall, children_cpu_seconds() - cpu
    try:
        report = json.loads(done.stdout)
    except json.JSONDecodeError as error:
        fail(f"`{' '.join(command)}` printed no JSON: {error}")
    return Run(report, cpu / wall)


def children_cpu_seconds() -> float:
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime
