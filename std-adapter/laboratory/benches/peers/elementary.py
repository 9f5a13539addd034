"""Times the tests of all candidate pairs over a whole step: selvedge against ipctk.

`whole_step.py` measures what ipctk's users run: a step size, for which it cuts most tests short. Here each pair is tested over the
whole step, as for a list of all contacts. README.md describes the timed work.
"""

import argparse
import json
import statistics
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NamedTuple

import common
import numpy as np
from truth import KINDS, read_pairs
from whole_step import ADDITIVE, MINIMUM_DISTANCE, TIGHT_INCLUSION, timed

try:
    import ipctk
except ImportError as error:
    common.missing_package(error)

# Without rescaling a pair is in contact if its distance may be zero, as in the paper. With
# ipctk's defaults (0.8 and 0.9) they also report pairs that only come near each other.
WHOLE = {"conservative_rescaling": 1.0}
PEERS: dict[str, Callable[[], ipctk.NarrowPhaseCCD]] = {
    "Tight-Inclusion": lambda: ipctk.TightInclusionCCD(**TIGHT_INCLUSION | WHOLE),
    "additive CCD": lambda: ipctk.AdditiveCCD(**ADDITIVE),
}
# The runs of selvedge: a name, a pipeline and further options.
OWN = {
    "selvedge": ("selvedge", ()),
    "selvedge, exact verdict": ("selvedge_exact", ()),
    "selvedge, f32": ("selvedge", ("--scalar", "f32")),
}
# The number of pairs in one call of ipctk's loop, which takes a fraction of a second.
BLOCK = 8192


class Pairs(NamedTuple):
    """Pairs of one kind: two of ipctk's ids each."""

    kind: str
    ids: np.ndarray
    in_contact: np.ndarray


class Part(NamedTuple):
    """The time of a peer for some of the pairs that are apart, or of those in contact."""

    total: int
    pairs: int
    seconds: float
    # Found pairs in contact; among the others, blocks in which it takes a pair for a contact.
    found: int

    @property
    def nanoseconds(self) -> float:
        return self.seconds * 1e9 / self.pairs if self.pairs else 0.0


class Sample(NamedTuple):
    apart: Part
    in_contact: Part

    @property
    def whole(self) -> float:
        """Seconds for all pairs, at the rate of those that were tested."""
        return sum(part.total * part.nanoseconds for part in self) * 1e-9


class Peers:
    """Runs ipctk on the pairs of selvedge, those that are apart and those in contact separately.

    ipctk's loop over candidates, which is C++, passes the earliest impact so far to each later test as the end of its time span.
    Among pairs without contact there is no impact, so that the loop tests each of them over its whole step. The others are tested
    one by one from Python.
    """

    def __init__(self, step: common.Step, candidates: dict, contacts: dict) -> None:
        self.step = step
        self.edges = ipctk.edges(step.triangles)
        self.mesh = ipctk.CollisionMesh(step.start, self.edges, step.triangles)
        ends, sides = np.sort(self.edges, axis=1), np.sort(step.triangles, axis=1)
        self.pairs = []
        for kind in KINDS:
            both = [rows[kind].to_numpy() for rows in (candidates, contacts)]
            if kind == "vertex-face":
                ids = [np.column_stack([index_of(sides, r[:, 1:]), r[:, 0]]) for r in both]
            else:
                ids = [np.column_stack([index_of(ends, r[:, k : k + 2]) for k in (0, 2)]) for r in both]
            everything, touching = (np.sort(i, axis=1) if kind == "edge-edge" else i for i in ids)
            in_contact = np.isin(keys(everything), keys(touching))
            self.pairs.append(Pairs(kind, everything, in_contact))

    def count(self, in_contact: bool | None = None) -> int:
        masks = (pairs.in_contact for pairs in self.pairs)
        return sum(len(m) if in_contact is None else int((m == in_contact).sum()) for m in masks)

    def blocks(self, in_contact: bool, seed: int) -> list[tuple[str, np.ndarray]]:
        """Yields the pairs in blocks of neighbours, the blocks in random order."""
        blocks = []
        for pairs in self.pairs:
            ids = pairs.ids[pairs.in_contact == in_contact]
            size = BLOCK if not in_contact else BLOCK // 64
            blocks += [(pairs.kind, ids[k : k + size]) for k in range(0, len(ids), size)]
        order = np.random.default_rng(seed).permutation(len(blocks))
        return [blocks[index] for index in order]

    def run(self, name: str, seed: int, budget: float) -> Sample:
        """Times both kinds of pairs, until all are done or the time is over; a share of it is for pairs in contact."""
        method = PEERS[name]()
        apart = self.part(name, seed, 0.8 * budget, method, in_contact=False)
        touching = self.part(name, seed, 0.2 * budget, method, in_contact=True)
        return Sample(apart, touching)

    def part(
        self, name: str, seed: int, budget: float, method: ipctk.NarrowPhaseCCD, in_contact: bool
    ) -> Part:
        begin = time.monotonic()
        done, seconds, found = 0, 0.0, 0
        total = self.count(in_contact)
        what = f"{name}, pairs in contact" if in_contact else name
        for kind, ids in self.blocks(in_contact, seed):
            if time.monotonic() - begin > budget:
                break
            if in_contact:
                took, hits = self.one_by_one(kind, ids, method)
                found += hits
            else:
                took, is_clear = self.in_loop(kind, ids, method)
                found += not is_clear
            seconds += took
            done += len(ids)
            progress(f"{what}: {done:,} of {total:,} pairs, {seconds:.1f} s")
        progress("")
        return Part(total, done, seconds, found)

    def stencils(self, kind: str, ids: np.ndarray) -> list:
        if kind == "vertex-face":
            return [ipctk.FaceVertexCandidate(f, v) for f, v in ids.tolist()]
        return [ipctk.EdgeEdgeCandidate(a, b) for a, b in ids.tolist()]

    def in_loop(self, kind: str, ids: np.ndarray, method: ipctk.NarrowPhaseCCD) -> tuple[float, bool]:
        """Returns the seconds, and whether all are found apart."""
        candidates = ipctk.Candidates()
        if kind == "vertex-face":
            candidates.fv_candidates = self.stencils(kind, ids)
        else:
            candidates.ee_candidates = self.stencils(kind, ids)
        motion = (self.mesh, self.step.start, self.step.end, MINIMUM_DISTANCE, method)
        size, sample = timed(lambda: candidates.compute_collision_free_stepsize(*motion))
        return sample.seconds, size >= 1.0

    def one_by_one(self, kind: str, ids: np.ndarray, method: ipctk.NarrowPhaseCCD) -> tuple[float, int]:
        """Returns the seconds, and how many are found in contact."""
        motion = (self.step.start, self.step.end)
        asked = [
            (pair, *(pair.dof(at, self.edges, self.step.triangles) for at in motion))
            for pair in self.stencils(kind, ids)
        ]
        ask = (MINIMUM_DISTANCE, 1.0, method)
        hits, sample = timed(lambda: sum(pair.ccd(a, b, *ask)[0] for pair, a, b in asked))
        return sample.seconds, hits


def index_of(table: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """Returns the place of each row in a table that has it; both have ascending numbers in each row."""
    places = np.argsort(keys(table))
    return places[np.searchsorted(keys(table), keys(rows), sorter=places)]


def keys(rows: np.ndarray) -> np.ndarray:
    """Returns one number for each row of small numbers."""
    key = np.zeros(len(rows), dtype=np.int64)
    for column in rows.T:
        key = key * 2**21 + column
    return key


def progress(text: str) -> None:
    if sys.stderr.isatty():
        print(f"\r\033[K{text}", end="", file=sys.stderr, flush=True)
    elif text and time.monotonic() - progress.last > 10:
        print(text, file=sys.stderr, flush=True)
        progress.last = time.monotonic()


progress.last = 0.0


class Own(NamedTuple):
    seconds: float
    whole_step: float
    contacts: int


def own(arguments: argparse.Namespace, name: str) -> Own:
    """Times all stages after the broad phase on the same pairs that ipctk gets, and the whole step with moving boxes."""
    pipeline, options = OWN[name]
    paths = (arguments.selvedge, arguments.START, arguments.END)
    repeat = (*options, "--repeat", "5")
    given = common.cull(*paths, pipeline, arguments.threads, "--swept-boxes", *repeat).report
    step = common.cull(*paths, pipeline, arguments.threads, *repeat).report
    contacts = given["contacts"]
    return Own(
        given["seconds"] - given["stages"][0]["seconds"],
        step["seconds"],
        contacts["vertex_face"] + contacts["edge_edge"],
    )


def read_candidates(arguments: argparse.Namespace, step: common.Step) -> tuple[dict, dict]:
    with tempfile.TemporaryDirectory(prefix="selvedge-elementary-") as folder:
        pairs, contacts = Path(folder) / "candidates.csv", Path(folder) / "contacts.csv"
        paths = (arguments.selvedge, arguments.START, arguments.END, "selvedge", arguments.threads)
        common.cull(*paths, "--swept-boxes", "--candidates", pairs, "--pairs", contacts)
        return read_pairs(pairs, len(step.start)), read_pairs(contacts, len(step.start))


def ratios(peer: list[Sample], ours: list[float]) -> dict[str, float]:
    values = [a.whole / b for a, b in zip(peer, ours)]
    return {"median": statistics.median(values), "min": min(values), "max": max(values)}


def each_turn(rounds: int, names: list[str]) -> Iterator[str]:
    """Every other round runs backwards, so that no one always comes after the same neighbour."""
    for number in range(rounds):
        yield from names if number % 2 == 0 else reversed(names)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("START", type=Path, help="mesh at the start of the step (OBJ, PLY)")
    parser.add_argument("END", type=Path, help="mesh at its end, with the same triangles")
    parser.add_argument(
        "--selvedge", type=Path, required=True, help="the selvedge binary (built with --release)"
    )
    parser.add_argument("--threads", type=common.positive, default=1, help="threads (default: 1)")
    parser.add_argument("--repeats", type=common.positive, default=1, help="rounds (default: 1)")
    parser.add_argument(
        "--peers",
        default=",".join(PEERS),
        metavar="NAME[,NAME]",
        help="tests of ipctk to run (default: %(default)s)",
    )
    parser.add_argument(
        "--seconds",
        type=common.positive,
        default=120,
        help="at most so long for each peer in each round; then the pairs done so far stand for all "
        "(default: %(default)s)",
    )
    parser.add_argument(
        "--seed", type=int, default=1, help="in which order pairs are taken (default: 1)"
    )
    parser.add_argument("--json", action="store_true", help="print JSON instead of a table")
    arguments = parser.parse_args()
    peers = [name.strip() for name in arguments.peers.split(",")]
    for name in set(peers) - set(PEERS):
        parser.error(f"{name} is not one of {', '.join(PEERS)}")

    step = common.read_step(arguments.START, arguments.END)
    ipctk.set_num_threads(arguments.threads)
    progress("listing the candidates")
    ipc = Peers(step, *read_candidates(arguments, step))

    samples: dict[str, list[Sample]] = {name: [] for name in peers}
    ours: dict[str, list[Own]] = {name: [] for name in OWN}
    for name in each_turn(arguments.repeats, [*OWN, *peers]):
        if name in OWN:
            progress(name)
            ours[name].append(own(arguments, name))
        else:
            samples[name].append(ipc.run(name, arguments.seed, arguments.seconds))
    progress("")

    count = {pairs.kind: len(pairs.ids) for pairs in ipc.pairs}
    parts = {"same pairs": "seconds", "whole step": "whole_step"}
    table = {
        f"{peer} / {name}, {part}": ratios(
            samples[peer], [getattr(sample, field) for sample in ours[name]]
        )
        for peer in peers
        for name in OWN
        for part, field in parts.items()
    }
    if arguments.json:
        report = {
            "pairs": count,
            "in_contact": ipc.count(True),
            "threads": arguments.threads,
            "seed": arguments.seed,
            "peers": {
                name: [
                    {"seconds": s.whole, "apart": s.apart._asdict(), "in_contact": s.in_contact._asdict()}
                    for s in rows
                ]
                for name, rows in samples.items()
            },
            "selvedge": {name: [s._asdict() for s in rows] for name, rows in ours.items()},
            "ratios": table,
        }
        json.dump(report, sys.stdout, indent=2)
        print()
        return
    total = sum(count.values())
    print(" and ".join(f"{n:,} {kind}" for kind, n in count.items()), "pairs whose swept boxes overlap")
    print(f"{ipc.count(True):,} of them in contact; {arguments.threads} thread(s), f64\n")
    print(f"{'':<36}{'seconds':>7}{'ns a pair':>11}")
    for name, rows in samples.items():
        time_taken = statistics.median(row.whole for row in rows)
        print(f"{name:<36}{time_taken:7.3f}{time_taken / total * 1e9:11.1f}")
        for what, part in (("apart", rows[0].apart), ("in contact", rows[0].in_contact)):
            label = f"  {what}, {part.pairs:,} of {part.total:,}"
            print(f"{label:<36}{part.seconds:7.3f}{part.nanoseconds:11.1f}  {remark(what, part)}")
    for name, rows in ours.items():
        for part, field in parts.items():
            time_taken = statistics.median(getattr(row, field) for row in rows)
            label = f"{name}, {part}"
            note = f"  {rows[0].contacts:,} contacts" if part == "same pairs" else ""
            print(f"{label:<36}{time_taken:7.4f}{time_taken / total * 1e9:11.1f}{note}")
    print("\nHow many times as long ipctk takes: median (lowest to highest)")
    for name, ratio in table.items():
        print(f"{ratio['median']:9.1f} ({ratio['min']:.1f} to {ratio['max']:.1f})  {name}")


def remark(what: str, part: Part) -> str:
    if what == "in contact":
        return f"{part.found:,} found"
    if part.found:
        return f"in {part.found} blocks of {BLOCK:,} a false alarm cuts others short"
    return "no false alarm"


if __name__ == "__main__":
    main()
