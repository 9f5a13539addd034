"""Times one whole collision step of a mesh: selvedge against ipctk (the IPC Toolkit for Python).

Both start from positions and triangles in memory; reading files is not timed. README.md describes the
compared work.
"""

import argparse
import json
import os
import platform
import resource
import statistics
import time
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple, TypeVar

import common

try:
    import ipctk
except ImportError as error:
    common.missing_package(error)

# ipctk's defaults, written out so that a new version cannot change the comparison silently.
TIGHT_INCLUSION = {"tolerance": 1e-6, "max_iterations": 10_000_000, "conservative_rescaling": 0.8}
ADDITIVE = {"max_iterations": 10_000_000, "conservative_rescaling": 0.9}
MINIMUM_DISTANCE = 0.0

BROAD_PHASE = "ipctk broad phase (LBVH)"
# Further runs of `selvedge cull` with the pipeline selvedge: a row of the table, and its options.
SHORT_QUESTIONS = {
    "selvedge candidates (moving boxes)": ["--candidates-only"],
    "selvedge candidates (swept boxes)": ["--candidates-only", "--swept-boxes"],
    "selvedge earliest": ["--earliest"],
}
TIGHT_INCLUSION_STEP = "ipctk LBVH + Tight-Inclusion"
ADDITIVE_STEP = "ipctk LBVH + additive CCD"
# The computation of each step size.
TESTS = {
    TIGHT_INCLUSION_STEP: lambda: ipctk.TightInclusionCCD(**TIGHT_INCLUSION),
    ADDITIVE_STEP: lambda: ipctk.AdditiveCCD(**ADDITIVE),
}

T = TypeVar("T")


class Sample(NamedTuple):
    seconds: float
    # Process time over wall time.
    cores: float


class Measurement:
    """The samples of one row of the table, one for each round."""

    def __init__(self, result: str = "") -> None:
        self.samples: list[Sample] = []
        self.result = result

    def seconds(self) -> list[float]:
        return [sample.seconds for sample in self.samples]

    def as_json(self) -> dict:
        return {**spread(self.seconds()), "cores": self.cores(), "result": self.result}

    def cores(self) -> float:
        return statistics.median(sample.cores for sample in self.samples)


class Ipctk:
    """Runs ipctk on one step. Its mesh (edges and adjacency) is built once, outside the timed part."""

    def __init__(self, step: common.Step, threads: int, tests: list[str]) -> None:
        ipctk.set_num_threads(threads)
        self.step = step
        self.tests = tests
        begin = time.perf_counter()
        edges = ipctk.edges(step.triangles)
        self.mesh = ipctk.CollisionMesh(step.start, edges, step.triangles)
        self.mesh_seconds = time.perf_counter() - begin
        self.edges = len(edges)

    def run(self, rows: dict[str, Measurement], record: bool) -> None:
        """Runs one round: candidates, then the step sizes from these candidates."""
        motion = (self.mesh, self.step.start, self.step.end)
        candidates = ipctk.Candidates()
        _, build = timed(lambda: candidates.build(*motion, 0.0, ipctk.LBVH()))
        size = candidates.compute_collision_free_stepsize
        counts = f"{len(candidates.fv_candidates):,} VF, {len(candidates.ee_candidates):,} EE pairs"
        results = [(BROAD_PHASE, build, counts)]
        for name in self.tests:
            test = TESTS[name]()
            found, seconds = timed(lambda: size(*motion, MINIMUM_DISTANCE, test))
            results.append((name, add(build, seconds), f"step size {found:.4g}"))
        if not record:
            return
        for name, sample, result in results:
            rows[name].samples.append(sample)
            rows[name].result = result


def timed(work: Callable[[], T]) -> tuple[T, Sample]:
    cpu, wall = time.process_time(), time.perf_counter()
    result = work()
    wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
    return result, Sample(wall, cpu / wall)


def add(first: Sample, second: Sample) -> Sample:
    seconds = first.seconds + second.seconds
    cpu = first.seconds * first.cores + second.seconds * second.cores
    return Sample(seconds, cpu / seconds)


class Own(NamedTuple):
    """The settings of one row of selvedge: a pipeline, the instruction set (None: the best), and the options of a short question."""

    pipeline: str
    simd: str | None
    options: list[str]

    def run(self, arguments: argparse.Namespace) -> common.Run:
        return common.cull(
            arguments.selvedge,
            arguments.START,
            arguments.END,
            self.pipeline,
            arguments.threads,
            # The first run builds hierarchies and allocates buffers, as ipctk's unmeasured round does.
            "--repeat",
            "3",
            *([] if self.simd is None else ["--simd", self.simd]),
            *self.options,
        )


def run_selvedge(
    arguments: argparse.Namespace, own: Own, row: Measurement, stages: dict[str, list[float]]
) -> None:
    run = own.run(arguments)
    try:
        row.samples.append(Sample(run.report["seconds"], run.cores))
        first = run.report["first_run_seconds"]
        for stage in run.report["stages"]:
            stages.setdefault(stage["stage"], []).append(stage["seconds"])
        contacts = run.report["contacts"]
        earliest = contacts["earliest"]
        row.result = f"{contacts['vertex_face']:,} VF, {contacts['edge_edge']:,} EE contacts" + (
            "" if earliest is None else f" from {earliest:.4g}"
        ) + f"; first run, hierarchies built: {first:.3f} s"
    except (KeyError, TypeError) as error:
        common.fail(f"selvedge's report for {own.pipeline} lacks or mistypes a field: {error}")


def ask_selvedge(arguments: argparse.Namespace, own: Own, row: Measurement) -> None:
    """One of the short questions."""
    run = own.run(arguments)
    try:
        row.samples.append(Sample(run.report["seconds"], run.cores))
        pairs = run.report["stages"][0]
        contacts = run.report["contacts"]
        if contacts is None:
            row.result = f"{pairs['vertex_face']:,} VF, {pairs['edge_edge']:,} EE pairs"
        elif contacts["earliest"] is None:
            row.result = "free"
        else:
            row.result = f"at {contacts['earliest']:.4g}"
    except (KeyError, TypeError) as error:
        common.fail(f"selvedge's report lacks or mistypes a field: {error}")


def peak_bytes(who: int) -> int:
    """Returns the peak memory of this process (or of the largest of those it has started and waited for)."""
    return 1024 * resource.getrusage(who).ru_maxrss


def spread(values: list[float]) -> dict[str, float]:
    return {"median": statistics.median(values), "min": min(values), "max": max(values)}


def compare(
    rows: dict[str, Measurement], stages: dict[str, dict[str, list[float]]], short: dict[str, Own]
) -> list[dict]:
    """Returns ipctk's time over selvedge's, round by round, for each row of selvedge and each figure of ipctk."""
    ratios = []
    for name in short:
        peers = [BROAD_PHASE]
        if "earliest" in name:
            peers = [peer for peer in TESTS if peer in rows]
        ratios += [(peer, name, "whole question", rows[name].seconds()) for peer in peers]
    for pipeline, own_stages in stages.items():
        for peer in [peer for peer in TESTS if peer in rows]:
            ratios.append((peer, pipeline, "whole step", rows[pipeline].seconds()))
        if "broad-phase" in own_stages:
            ratios.append((BROAD_PHASE, pipeline, "broad-phase stage", own_stages["broad-phase"]))
    return [
        {
            "ipctk": peer,
            "pipeline": pipeline,
            "part": part,
            **spread([a / b if b else float("inf") for a, b in zip(rows[peer].seconds(), own)]),
        }
        for peer, pipeline, part, own in ratios
    ]


def print_tables(settings: dict, rows: dict[str, Measurement], ratios: list[dict]) -> None:
    def megabytes(process: str) -> str:
        return f"{settings['peak_bytes'][process] / 1e6:.0f} MB"

    print(
        f"{settings['vertices']:,} vertices, {settings['edges']:,} edges,"
        f" {settings['triangles']:,} triangles; {settings['threads']} thread(s), f64,"
        f" {settings['repeats']} rounds, {settings['processor']}\n"
        f"Tight-Inclusion: {written_out(TIGHT_INCLUSION)}\n"
        f"additive CCD: {written_out(ADDITIVE)}\n"
        f"minimum distance {MINIMUM_DISTANCE:g}; ipctk's mesh, not timed below:"
        f" {settings['ipctk_mesh_seconds']:.3f} s\n"
        f"peak memory: {megabytes('selvedge_process')} for the first selvedge cull, files included;"
        f" ipctk's process {megabytes('ipctk_process')},"
        f" of which {megabytes('ipctk_process_without_its_work')} before its mesh\n"
    )
    width = max(map(len, rows)) + 2
    print(f"{'seconds':<{width}} {'median':>8} {'min':>8} {'max':>8} {'cores':>6}  result")
    for name, row in rows.items():
        time = spread(row.seconds())
        figures = " ".join(f"{time[key]:8.4f}" for key in ("median", "min", "max"))
        print(f"{name:<{width}} {figures} {row.cores():6.2f}  {row.result}")
    if ratios:
        print("\nHow many times as long ipctk takes (of the same round)")
    for ratio in ratios:
        figures = " ".join(f"{ratio[key]:8.3f}" for key in ("median", "min", "max"))
        print(f"{figures}  {ratio['ipctk']} / {ratio['pipeline']}, {ratio['part']}")
    if any(row.cores() < 0.9 for row in rows.values()):
        print("\nA row below 0.9 cores means that the machine was busy: trust only the ratios.")


def written_out(settings: dict) -> str:
    return ", ".join(f"{name.replace('_', ' ')} {value:g}" for name, value in settings.items())


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("START", type=Path, help="mesh at the start of the step (OBJ, PLY)")
    parser.add_argument("END", type=Path, help="mesh at its end, with the same triangles")
    parser.add_argument(
        "--repeats", type=common.positive, default=5, help="rounds (default: %(default)s)"
    )
    parser.add_argument(
        "--additive-only",
        action="store_true",
        help="leave out Tight-Inclusion, and ipctk's unmeasured round: for meshes on which they take minutes",
    )
    parser.add_argument(
        "--simd",
        metavar="NAME[,NAME…]",
        help="instruction sets to force in selvedge, one after the other (default: the machine's best)",
    )
    common.add_shared_arguments(parser, "selvedge,lv_2014,curtis_2008")
    arguments = parser.parse_args()
    names = common.pipelines(arguments) if arguments.selvedge else []

    # This process is the first, so that the peak of all processes is its own.
    if arguments.selvedge:
        Own(names[0], None, []).run(arguments)
    selvedge_bytes = peak_bytes(resource.RUSAGE_CHILDREN)

    step = common.read_step(arguments.START, arguments.END)
    before = peak_bytes(resource.RUSAGE_SELF)
    tests = [ADDITIVE_STEP] if arguments.additive_only else list(TESTS)
    peer = Ipctk(step, arguments.threads, tests)
    if ipctk.get_num_threads() != arguments.threads:
        common.fail(f"ipctk runs on {ipctk.get_num_threads()} threads, not {arguments.threads}")
    # The meaning of a row's name, and the instruction set.
    sets = [(f", {name}", name) for name in arguments.simd.split(",")] if arguments.simd else [("", None)]
    own = {
        f"selvedge cull {name}{tail}": Own(name, simd, []) for tail, simd in sets for name in names
    }
    short = {
        question + tail: Own("selvedge", simd, options)
        for tail, simd in sets
        for question, options in SHORT_QUESTIONS.items()
        if "selvedge" in names
    }
    all_rows = (BROAD_PHASE, *tests, *own, *short)
    rows = {name: Measurement() for name in all_rows}
    stages: dict[str, dict[str, list[float]]] = {name: {} for name in own}

    # ipctk's first round is not measured; each run of selvedge is a new process that runs the step three times.
    if not arguments.additive_only:
        peer.run(rows, record=False)
    for number in range(arguments.repeats):
        turns: list[Callable[[], None]] = [lambda: peer.run(rows, record=True)]
        for row, what in own.items():
            turns.append(
                lambda row=row, what=what: run_selvedge(arguments, what, rows[row], stages[row])
            )
        for row, what in short.items():
            turns.append(lambda row=row, what=what: ask_selvedge(arguments, what, rows[row]))
        # Every other round runs backwards, so that the neighbours in time change.
        for turn in turns if number % 2 == 0 else reversed(turns):
            turn()

    ratios = compare(rows, stages, short)
    ipctk_bytes = peak_bytes(resource.RUSAGE_SELF)
    settings = {
        "start": os.fspath(arguments.START),
        "end": os.fspath(arguments.END),
        "vertices": len(step.start),
        "edges": peer.edges,
        "triangles": len(step.triangles),
        "threads": arguments.threads,
        "repeats": arguments.repeats,
        "scalar": "f64",
        "simd": arguments.simd,
        "processor": platform.processor() or platform.machine(),
        "ipctk_version": ipctk.__version__,
        "ipctk_mesh_seconds": peer.mesh_seconds,
        "peak_bytes": {
            "selvedge_process": selvedge_bytes,
            "ipctk_process": ipctk_bytes,
            "ipctk_process_without_its_work": before,
        },
        "tight_inclusion": TIGHT_INCLUSION,
        "additive": ADDITIVE,
        "minimum_distance": MINIMUM_DISTANCE,
    }
    if arguments.json:
        stage_seconds = {
            row: {stage: spread(seconds) for stage, seconds in own_stages.items()}
            for row, own_stages in stages.items()
        }
        report = {"settings": settings, "seconds": {n: r.as_json() for n, r in rows.items()}}
        report |= {"stages": stage_seconds, "ratios": ratios}
        print(json.dumps(report, indent=2))
    else:
        print_tables(settings, rows, ratios)


if __name__ == "__main__":
    main()
