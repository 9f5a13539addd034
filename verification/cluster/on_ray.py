"""Runs exact_campaign on Ray: a task of one core for each seed from 1 to SEEDS, repeated elsewhere if its node is lost. Then adds the counts.

    python verification/cluster/on_ray.py PROGRAM FOLDER SEEDS PAIRS [ARGUMENT...]
    python verification/cluster/on_ray.py target/release/examples/exact_campaign /shared/exact 64 1_000_000_000

All nodes must see PROGRAM and FOLDER, which receives counts and logs. The cluster is the one that $RAY_ADDRESS names, or a new one on this
machine. A seed whose counts are there is not run again, so the same command completes a run that was stopped. The exit status is that of
the program's `--sum`: 0 if nothing is wrong.
"""

import subprocess
import sys
from pathlib import Path

import ray


# A lost node is not the seed's fault, so it is repeated without limit.
@ray.remote(num_cpus=1, max_retries=-1)
def run(program, folder, arguments, seed):
    counts = folder / f"{seed}.json"
    if counts.exists():
        return 0
    command = [program, *arguments, "--threads", "1", "--seed", str(seed), "--json", counts]
    with (folder / f"{seed}.log").open("a") as log:
        return subprocess.run(command, stdin=subprocess.DEVNULL, stdout=log, stderr=log).returncode


def main():
    if len(sys.argv) < 5 or not sys.argv[3].isdigit():
        print(__doc__, file=sys.stderr)
        return 2
    program, folder = (Path(path).resolve() for path in sys.argv[1:3])
    seeds, arguments = range(1, int(sys.argv[3]) + 1), sys.argv[4:]
    folder.mkdir(parents=True, exist_ok=True)
    ray.init()
    for seed, status in zip(seeds, ray.get([run.remote(program, folder, arguments, seed) for seed in seeds])):
        if status != 0:
            print(f"seed {seed} ended with {status}: {folder / f'{seed}.log'}", file=sys.stderr)
    return subprocess.run([program, "--sum", *(folder / f"{seed}.json" for seed in seeds)]).returncode


if __name__ == "__main__":
    sys.exit(main())
