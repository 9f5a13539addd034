"""Runs a campaign on Ray: a task of one core for each shard, repeated elsewhere if its node is lost. Then joins the shards.

    python verification/cluster/on_ray.py PROGRAMS FOLDER SHARDS CAMPAIGN [ARGUMENT...]
    python verification/cluster/on_ray.py /shared/programs /shared/exact 64 exact_campaign 1_000_000_000 --seed 2026

PROGRAMS is the folder of build.sh. States, logs and the joined state (merged.json) go to FOLDER. All nodes must see both. The cluster is
the one that $RAY_ADDRESS names, or a new one on this machine. The same command resumes a run that was stopped: finished shards end at
once. Exit status as for `merge`: 0 nothing is wrong, 1 something is, or a shard is missing.
"""

import subprocess
import sys
from pathlib import Path

import ray


# A lost node is not the shard's fault, so it is repeated without limit.
@ray.remote(num_cpus=1, max_retries=-1)
def run(programs, folder, shards, campaign, arguments, number):
    command = [programs / campaign, *arguments, "--threads", "1"]
    command += ["--shard", f"{number}/{shards}", "--state", folder / f"{number}.json"]
    with (folder / f"{number}.log").open("a") as log:
        return subprocess.run(command, stdin=subprocess.DEVNULL, stdout=log, stderr=log).returncode


def main():
    if len(sys.argv) < 5 or not sys.argv[3].isdigit():
        print(__doc__, file=sys.stderr)
        return 2
    programs, folder = (Path(path).resolve() for path in sys.argv[1:3])
    shards, campaign, arguments = int(sys.argv[3]), sys.argv[4], sys.argv[5:]
    folder.mkdir(parents=True, exist_ok=True)
    ray.init()
    numbers = range(1, shards + 1)
    tasks = {run.remote(programs, folder, shards, campaign, arguments, number): number for number in numbers}
    left = list(tasks)
    while left:
        [ended], left = ray.wait(left)
        try:
            status = ray.get(ended)
        except ray.exceptions.RayError as error:
            status = error
        if status != 0:
            log = folder / f"{tasks[ended]}.log"
            print(f"\nshard {tasks[ended]} of {shards} ended with {status}: {log}", file=sys.stderr)
        print(f"\r{shards - len(left)} of {shards} shards have ended", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    states = [folder / f"{number}.json" for number in numbers]
    return subprocess.run([programs / "merge", *states, "--state", folder / "merged.json"]).returncode


if __name__ == "__main__":
    sys.exit(main())
