"""Finds all contacts of a sequence of frames, by many workers on a Ray cluster, and writes one table.

    pip install selvedge ray meshio pyarrow
    python sequence_on_ray.py FRAMES OUT.parquet [--address auto] [--workers 2] [--chunk 100] [--separation 0.0]

FRAMES is a folder of OBJ or PLY files with the same triangles, in the order of their names; all machines see it and OUT's folder under the
same names. Each worker keeps a detector, gets pieces of consecutive steps, and writes their contacts to files. The state is a folder
beside the table, with a file for each finished piece: the same command resumes the work. A piece whose worker is lost is done again by
another, at most three times; a piece with faulty frames is reported, and the others continue. The table is sorted by step, kind and pair:
it is the same for any number of workers, losses and starts.
"""

import argparse
import os
import sys
import time
import uuid
from pathlib import Path
from typing import Any

import meshio
import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import ray

from selvedge import Detector, errors

ATTEMPTS = 3


def read(path: Path) -> tuple[np.ndarray, np.ndarray]:
    mesh = meshio.read(path)
    return np.ascontiguousarray(mesh.cells_dict["triangle"], np.uint32), np.ascontiguousarray(mesh.points, np.float64)


@ray.remote(num_cpus=1, max_restarts=0)
class Worker:
    """A worker, with one detector for all of its pieces."""

    def __init__(self, separation: float) -> None:
        self.separation = separation
        self.faces: np.ndarray | None = None
        self.detector: Detector | None = None

    def frame(self, path: Path) -> np.ndarray:
        try:
            faces, positions = read(path)
        except (Exception, SystemExit) as error:  # meshio has an exception for each format, and ends the program at times
            raise errors.InputError(f"{path}: cannot be read: {error}") from None
        if self.detector is None or self.faces is None:
            self.faces, self.detector = faces, Detector(faces, len(positions))
            self.detector.set_limits(self.separation)
        elif not np.array_equal(faces, self.faces):
            raise errors.InputError(f"{path}: has other triangles than the frames before")
        return positions

    def contacts(self, first: int, paths: list[Path]) -> dict[str, np.ndarray]:
        """Finds the contacts of the steps from each frame to the next; ``first`` is the number of the first step."""
        found = []
        start = self.frame(paths[0])
        for step, path in enumerate(paths[1:], first):
            end = self.frame(path)
            assert self.detector is not None
            try:
                contacts = self.detector.contacts(start, end)
            except errors.InputError as error:
                raise errors.InputError(f"{path}: {error}") from None
            order = np.lexsort((contacts.pair[:, 1], contacts.pair[:, 0], contacts.kind))
            found.append(
                {
                    "step": np.full(len(contacts), step, np.uint32),
                    "kind": contacts.kind[order],
                    "first": contacts.pair[order, 0],
                    "second": contacts.pair[order, 1],
                    "time": contacts.time[order],
                    "speed": contacts.speeds[order],
                    **{f"normal_{axis}": contacts.normals[order, k] for k, axis in enumerate("xyz")},
                    **{f"point_{axis}": contacts.points[order, 0, k] for k, axis in enumerate("xyz")},
                }
            )
            start = end
        return {name: np.concatenate([rows[name] for rows in found]) for name in found[0]}

    def write_contacts(self, first: int, paths: list[Path], part: Path) -> None:
        write(pa.table(self.contacts(first, paths)), part)


def write(table: pa.Table, path: Path) -> None:
    """Writes a whole table or none, even if a worker that was taken for lost writes the same one."""
    beside = path.with_suffix(f".{uuid.uuid4().hex}.writing")
    pq.write_table(table, beside)
    os.replace(beside, path)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("frames", type=Path)
    parser.add_argument("table", type=Path)
    parser.add_argument("--address", help="of a cluster that runs; without it, one on this machine")
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--chunk", type=int, default=100, help="steps that a worker gets at once")
    parser.add_argument("--separation", type=float, default=0.0, help="in the unit of the positions")
    given = parser.parse_args()

    frames = sorted(path.resolve() for path in given.frames.glob("*") if path.suffix.lower() in (".obj", ".ply"))
    if len(frames) < 2 or given.chunk < 1 or given.workers < 1:
        print(f"{given.frames}: at least two OBJ or PLY files, one worker and one step a piece are needed", file=sys.stderr)
        return 2
    # The name of the folder has all that the pieces depend on, so that another question does not find them.
    state = given.table.resolve().with_name(f"{given.table.name}.state-{len(frames)}-{given.chunk}-{given.separation!r}")
    state.mkdir(parents=True, exist_ok=True)
    firsts = range(0, len(frames) - 1, given.chunk)
    parts = {first: state / f"{first:09}.parquet" for first in firsts}
    waiting = [first for first in firsts if not parts[first].exists()]
    print(f"{len(frames) - 1} steps in {len(parts)} pieces, {len(parts) - len(waiting)} of them done before", flush=True)

    ray.init(address=given.address, log_to_driver=False, include_dashboard=False)
    workers: list[Any] = [Worker.remote(given.separation) for _ in range(min(given.workers, len(waiting)))]
    # Each worker gets two pieces: while it reports one, it has the other.
    idle = list(range(len(workers))) * 2
    running: dict[Any, tuple[int, int, Any]] = {}
    losses = dict.fromkeys(waiting, 0)
    failed: dict[int, str] = {}
    began, done = time.monotonic(), 0

    while waiting or running:
        while waiting and idle:
            first, number = waiting.pop(0), idle.pop(0)
            worker = workers[number]
            piece = worker.write_contacts.remote(first, frames[first : first + given.chunk + 1], parts[first])
            running[piece] = first, number, worker
        [ready], _ = ray.wait(list(running))
        first, number, worker = running[ready]
        try:
            ray.get(ready)
            done += 1
            print(f"steps {first} to {first + given.chunk}: done ({done} in {time.monotonic() - began:.1f} s)", flush=True)
        except ray.exceptions.RayTaskError as error:
            failed[first] = str(error.cause)
        except ray.exceptions.RayError as error:
            if workers[number] is worker:
                # A worker does its pieces in order: it was at the older one, and the other is not to blame.
                losses[next(first for first, _, lost in running.values() if lost is worker)] += 1
                workers[number] = Worker.remote(given.separation)
            print(f"steps {first} to {first + given.chunk}: worker lost ({type(error).__name__})", flush=True)
            if losses[first] < ATTEMPTS:
                waiting.append(first)
            else:
                failed[first] = f"{ATTEMPTS} workers were lost: {type(error).__name__}"
        del running[ready]
        idle.append(number)
    ray.shutdown()
    if failed:
        for first, reason in sorted(failed.items()):
            print(f"steps {first} to {first + given.chunk}: {reason}", file=sys.stderr)
        print(f"no table: {len(failed)} pieces failed; the others are kept, start again when that is mended", file=sys.stderr)
        return 1
    write(pa.concat_tables([pq.read_table(parts[first]) for first in firsts]), given.table)
    print(f"{given.table}: {pq.read_metadata(given.table).num_rows} contacts")
    return 0


if __name__ == "__main__":
    sys.exit(main())
