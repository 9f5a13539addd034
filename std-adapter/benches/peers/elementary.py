"""Times the tests of all candidate pairs of a step over the whole of it: selvedge against ipctk.

`whole_step.py` measures what ipctk's users run, a step size, for which it cuts most tests short. Here each pair is asked about
the whole step, as for the list of all contacts. What is timed, and what is not, is in README.md.
"""

import argparse
import json
import statistics
import sys
import tempfile
from pathlib import Path

import common
import numpy as np
from truth import read_pairs
from whole_step import ADDITIVE, MINIMUM_DISTANCE, TIGHT_INCLUSION, timed

try:
    import ipctk
except ImportError as error:
    common.missing_package(error)

PEERS = {
    "Tight-Inclusion": lambda: ipctk.TightInclusionCCD(**TIGHT_INCLUSION),
    "additive CCD": lambda: ipctk.AdditiveCCD(**ADDITIVE),
}


class Pairs:
    """All pairs whose swept boxes overlap, those apart from those in contact.

    ipctk's loop over candidates hands the earliest impact so far to each later test as the end of its time span. Among
    pairs without contact there is no impact, so the loop runs over all of them and their whole step, in C++. The others are
    asked one by one from here.
    """

    def __init__(self, step: common.Step, contacts: dict) -> None:
        self.step = step
        self.edges = ipctk.edges(step.triangles)
        self.mesh = ipctk.CollisionMesh(step.start, self.edges, step.triangles)
        found = ipctk.Candidates()
        found.build(self.mesh, step.start, step.end, MINIMUM_DISTANCE, ipctk.LBVH())
        vertex_face, edge_edge = found.fv_candidates, found.ee_candidates
        self.count = {"vertex-face": len(vertex_face), "edge-edge": len(edge_edge)}

        sides = np.sort(step.triangles, axis=1)
        faces = index_of(sides, contacts["vertex-face"].select("i1", "i2", "i3").to_numpy())
        vertices = contacts["vertex-face"]["i0"].to_numpy()
        touching = set(zip(vertices.tolist(), faces.tolist()))
        in_contact = [(pair.vertex_id, pair.face_id) in touching for pair in vertex_face]

        ends = np.sort(self.edges, axis=1)
        first = index_of(ends, contacts["edge-edge"].select("i0", "i1").to_numpy())
        second = index_of(ends, contacts["edge-edge"].select("i2", "i3").to_numpy())
        touching = {frozenset(pair) for pair in zip(first.tolist(), second.tolist())}
        in_contact_too = [frozenset((p.edge0_id, p.edge1_id)) in touching for p in edge_edge]

        self.apart = ipctk.Candidates()
        self.apart.fv_candidates = split(vertex_face, in_contact, False)
        self.apart.ee_candidates = split(edge_edge, in_contact_too, False)
        stencils = split(vertex_face, in_contact, True) + split(edge_edge, in_contact_too, True)
        self.touching = [
            (pair, *(pair.dof(at, self.edges, step.triangles) for at in (step.start, step.end)))
            for pair in stencils
        ]

    def run(self, method: ipctk.NarrowPhaseCCD) -> tuple[float, int, bool]:
        """Seconds, how many of the pairs in contact are found, and whether some pair that is apart is taken for one."""
        size = self.apart.compute_collision_free_stepsize
        motion = (self.mesh, self.step.start, self.step.end)
        step_size, apart = timed(lambda: size(*motion, MINIMUM_DISTANCE, method))

        def each() -> int:
            ask = (MINIMUM_DISTANCE, 1.0, method)
            return sum(pair.ccd(start, end, *ask)[0] for pair, start, end in self.touching)

        found, touching = timed(each)
        return apart.seconds + touching.seconds, found, step_size < 1.0


def index_of(table: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """Where each row is in a table that has it."""
    where = {tuple(row): index for index, row in enumerate(table.tolist())}
    return np.array([where[tuple(row)] for row in rows.tolist()], dtype=np.int64)


def split(pairs: list, mask: list[bool], wanted: bool) -> list:
    return [pair for pair, is_in in zip(pairs, mask) if is_in == wanted]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("START", type=Path, help="mesh at the start of the step (OBJ, PLY)")
    parser.add_argument("END", type=Path, help="mesh at its end, with the same triangles")
    parser.add_argument(
        "--repeats", type=common.positive, default=1, help="rounds (default: %(default)s)"
    )
    common.add_shared_arguments(parser, "selvedge")
    arguments = parser.parse_args()
    if arguments.selvedge is None:
        parser.error("--selvedge is needed: the binary to measure")
    names = common.pipelines(arguments)

    step = common.read_step(arguments.START, arguments.END)
    paths = (arguments.selvedge, arguments.START, arguments.END)
    ipctk.set_num_threads(arguments.threads)
    with tempfile.TemporaryDirectory(prefix="selvedge-elementary-") as folder:
        csv = Path(folder) / "pairs.csv"
        common.cull(*paths, names[0], arguments.threads, "--pairs", csv)
        pairs = Pairs(step, read_pairs(csv, len(step.start)))

    seconds: dict[str, list[float]] = {name: [] for name in (*PEERS, *names)}
    notes: dict[str, str] = {}
    for _ in range(arguments.repeats):
        for name in names:
            run = common.cull(*paths, name, arguments.threads, "--repeat", "3")
            seconds[name].append(run.report["seconds"])
            contacts = run.report["contacts"]
            notes[name] = f"{contacts['vertex_face'] + contacts['edge_edge']:,} contacts"
        for name, method in PEERS.items():
            time, found, alarm = pairs.run(method())
            seconds[name].append(time)
            notes[name] = f"{found:,} of {len(pairs.touching):,} contacts" + (
                ", and some pair that selvedge has apart" if alarm else ""
            )

    median = {name: statistics.median(times) for name, times in seconds.items()}
    ratios = {
        f"{peer} / {name}": statistics.median(a / b for a, b in zip(seconds[peer], seconds[name]))
        for peer in PEERS
        for name in names
    }
    total = sum(pairs.count.values())
    if arguments.json:
        report = {"pairs": pairs.count, "seconds": seconds, "notes": notes, "ratios": ratios}
        json.dump(report | {"threads": arguments.threads}, sys.stdout, indent=2)
        print()
        return
    print(" and ".join(f"{count:,} {kind}" for kind, count in pairs.count.items()), "pairs")
    for name, time in median.items():
        print(f"{name:<16} {time:9.3f} s {time / total * 1e9:9.1f} ns a pair  {notes[name]}")
    for name, ratio in ratios.items():
        print(f"{ratio:9.1f}  {name}")


if __name__ == "__main__":
    main()
