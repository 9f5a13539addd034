"""Which mutants of core does a test notice? Builds all of them into one program, then wakes one after the other.

Every test is tried in order of the time it takes, those first that noticed something in the same file, until one fails, crashes or
does not end; see README.md. What is known of a mutant is kept in results.jsonl: a run that is stopped goes on there. Beside it
state.json says the same as the other campaigns do (verification/src/campaign/), so that their `merge` joins shards.
"""

import argparse
import hashlib
import json
import os
import random
import re
import signal
import subprocess
import sys
import threading
import time
from collections import Counter, defaultdict
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from tqdm import tqdm

from schemata import load, rewrite

ROOT = Path(__file__).resolve().parents[2]
# Of the cases that properties are given.
SEED = 1
# They look at no code of core.
NOT_OF_CORE = re.compile(r"^(oracle_|generator_makes)")


class Work:
    """The folder of a run: the rewritten sources, what was built from them and the results."""

    def __init__(self, folder):
        self.folder = folder
        self.copy = folder / "sources"
        self.results = folder / "results.jsonl"
        self.state = folder / "state.json"
        self.environment = os.environ | {
            "CARGO_TARGET_DIR": str(folder / "target"),
            "RUSTFLAGS": "-Awarnings",
            # One file of tests is built once and run a thousand times, and debug assertions notice overflows.
            "CARGO_PROFILE_TEST_DEBUG": "false",
        }

    def kept(self, name, make):
        """What `make` gives, computed once."""
        path = self.folder / name
        if not path.exists():
            replace(path, make())
        return load(path)

    def known(self):
        """The last result of each mutant, by number."""
        known = {}
        for line in self.results.read_text().splitlines() if self.results.exists() else []:
            try:
                result = json.loads(line)
            except json.JSONDecodeError:
                # A run that was killed while it wrote: this mutant is asked about again.
                continue
            known[result["number"]] = result
        return known

    def cargo(self, *arguments):
        """The compiler's messages, and whether it succeeded."""
        command = ["cargo", *arguments, "--message-format=json"]
        done = subprocess.run(command, cwd=self.copy, env=self.environment, stdout=subprocess.PIPE, text=True)
        return [json.loads(line) for line in done.stdout.splitlines()], done.returncode == 0


def replace(path, value):
    """In one step: a kill leaves the old file or the new one."""
    following = path.with_suffix(".next")
    with following.open("w") as file:
        json.dump(value, file)
        file.flush()
        os.fsync(file.fileno())
    following.replace(path)


class Shard:
    """One of `of` parts of the mutants, `number` from 1, and what is known of them, as verification/src/campaign/ keeps it.

    A chunk is one mutant, in an order of its own: next to each other are often those of one function, which all take long or none.
    """

    def __init__(self, work, commit, mutants, fit, chosen):
        self.work, self.mutants, self.fit, self.longest = work, mutants, fit, chosen.longest
        self.order = list(range(1, len(mutants) + 1))
        random.Random(1).shuffle(self.order)
        number, of = chosen.shard
        self.range = range((number - 1) * len(mutants) // of, number * len(mutants) // of)
        self.numbers = [self.order[chunk] for chunk in self.range]
        self.settings = {
            "campaign": "mutants",
            "commit": commit,
            "seed": SEED,
            "chunks": len(mutants),
            "cases_per_chunk": 1,
            "depends_on": {
                "mutants": hashlib.sha256(json.dumps(mutants, sort_keys=True).encode()).hexdigest(),
                "cases of a property": str(chosen.cases),
                "longest test": f"{chosen.longest:g} s",
            },
        }

        if chosen.shard != (1, 1) and work.state.exists():
            state = load(work.state)
            if any(state[name] != value for name, value in self.settings.items()) or state["range"] != self.state_range():
                sys.exit(f"{work.state}: the state of another run or shard; name another folder")

    def state_range(self):
        return {"start": self.range.start, "end": self.range.stop}

    def outcome(self, number, known):
        """What became of a mutant, or None while that is open."""
        if number in self.fit["unviable"]:
            return "unviable"
        if str(number) in self.fit["unplaced"]:
            return "unplaced"
        result = known.get(number)
        if result and result["noticed"]:
            return "noticed"
        return "missed" if result and result["longest"] >= self.longest else None

    def keep(self, known):
        found, runs, digest = {}, [], 0
        for chunk in self.range:
            number = self.order[chunk]
            outcome = self.outcome(number, known)
            if outcome is None:
                continue
            found[chunk] = {"name": self.mutants[number - 1]["name"], "outcome": outcome}
            # Of one chunk, added up, as verification/src/campaign/digest.rs says why.
            text = json.dumps([chunk, found[chunk]], separators=(",", ":"), ensure_ascii=False)
            digest += int.from_bytes(hashlib.sha256(text.encode()).digest()[:16], "big")
            if runs and runs[-1][1] == chunk:
                runs[-1][1] += 1
            else:
                runs.append([chunk, chunk + 1])
        state = self.settings | {
            "command": " ".join(sys.argv),
            "range": self.state_range(),
            "done": runs,
            "digest": f"{digest % 2**128:032x}",
            "found": found,
        }
        replace(self.work.state, state)


def copy_of_sources(work):
    """The commit that was copied."""
    work.copy.mkdir(parents=True, exist_ok=True)
    head = subprocess.run(["git", "rev-parse", "HEAD"], cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True).stdout.strip()
    files = subprocess.run(["git", "archive", head], cwd=ROOT, check=True, stdout=subprocess.PIPE).stdout
    subprocess.run(["tar", "x", "-C", work.copy], input=files, check=True)
    # Kernels with a condition in every operation take minutes at level 3; nobody needs the simplest failing case.
    manifest = work.copy / "Cargo.toml"
    manifest.write_text(re.sub(r"opt-level = 3", "opt-level = 1", manifest.read_text()))
    strategy = work.copy / "verification/src/generator/strategy.rs"
    strategy.write_text(strategy.read_text().replace("max_shrink_iters: 50_000", "max_shrink_iters: 0"))
    return head


def all_mutants():
    command = ["cargo", "mutants", "--list", "--json"]
    listed = json.loads(subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.PIPE).stdout)
    return [{key: mutant[key] for key in ("file", "genre", "name", "replacement", "span")} for mutant in listed]


def fitted(work, mutants):
    """The mutants that do not compile, and why others have no place: found by compiling, and leaving out what is complained of."""
    left_out = set()
    original = work.folder / "original"
    original.mkdir(exist_ok=True)
    subprocess.run(["cp", "-r", work.copy / "core", work.copy / "verification", original], check=True)
    while True:
        unplaced = rewrite(original, work.copy, mutants, left_out)
        # As its own tests and as the promises have it: neither compiles all that the other does.
        ways = (["--lib", "--profile", "test"], ["--features", "verification"])
        checks = [work.cargo("check", "-p", "selvedge-core", *way) for way in ways]
        if all(succeeded for _, succeeded in checks):
            return {"unviable": sorted(left_out), "unplaced": unplaced}
        complaints = set().union(*(numbers_in(work.copy, message) for messages, _ in checks for message in messages))
        if complaints <= left_out:
            commands = " or ".join(f"`cargo check -p selvedge-core {' '.join(way)}`" for way in ways)
            sys.exit(f"core does not compile with its mutants: {commands} in {work.copy}")
        left_out |= complaints


def numbers_in(copy, message):
    """The mutants that a message of the compiler is about: those in the place, or the one just before it."""
    error = message.get("message", {})
    found = set()
    if message.get("reason") != "compiler-message" or error["level"] != "error":
        return found
    if (error["code"] or {}).get("code") == "E0015":
        # A constant calls a function that its mutants no longer let be `const`: these are at fault, not those before the call.
        places = [span for note in error["children"] for span in note["spans"]]
        return set().union(*(numbers_in_function(copy, place) for place in places))
    for span in error["spans"]:
        if span["is_primary"] and (copy / span["file_name"]).exists():
            text = (copy / span["file_name"]).read_bytes()
            place = text[span["byte_start"] : span["byte_end"]].decode(errors="ignore")
            numbers = re.findall(r"is\((\d+)\)", place)
            if not 0 < len(numbers) <= 12:
                numbers = re.findall(r"is\((\d+)\)", text[: span["byte_start"]].decode(errors="ignore"))[-1:]
            found |= {int(number) for number in numbers}
    return found


def numbers_in_function(copy, signature):
    """The mutants of the function that begins there: up to the brace that stands as far to the left as its first line."""
    path = copy / signature["file_name"]
    if not path.exists():
        return set()
    text = path.read_bytes()
    begin = text.rfind(b"\n", 0, signature["byte_start"]) + 1
    line = text[begin:]
    indent = line[: len(line) - len(line.lstrip(b" "))]
    end = text.find(b"\n" + indent + b"}", begin)
    return {int(number) for number in re.findall(rb"is\((\d+)\)", text[begin:end])}


def callers_of_constant_functions(work):
    """Functions outside of core that are `const` and call one that its mutants no longer let be: they lose the word too."""
    lost = []
    while True:
        messages, succeeded = work.cargo("check", "-p", "selvedge-verification", "--test", "promises")
        errors = [m["message"] for m in messages if m["reason"] == "compiler-message" and m["message"]["level"] == "error"]
        places = [span for error in errors for span in error["spans"] if span["is_primary"]]
        if succeeded or not places:
            return lost
        for place in sorted(places, key=lambda place: -place["byte_start"]):
            path = work.copy / place["file_name"]
            before, after = path.read_bytes()[: place["byte_start"]], path.read_bytes()[place["byte_start"] :]
            if place["file_name"].startswith("core/") or b"const fn" not in before:
                sys.exit(f"{place['file_name']}, line {place['line_start']}, does not compile with core's mutants")
            head, tail = before.rsplit(b"const fn", 1)
            path.write_bytes(head + b"fn" + tail + after)
            lost.append(f"{place['file_name']}:{place['line_start']}")


def built(work):
    """The programs of tests: core's own, and the promises."""
    programs = {}
    for name, choice in {"core": ["-p", "selvedge-core", "--lib"], "promises": ["-p", "selvedge-verification", "--test", "promises"]}.items():
        messages, succeeded = work.cargo("test", *choice, "--no-run")
        if not succeeded:
            sys.exit(f"the tests of {work.copy} do not compile")
        programs[name] = next(m["executable"] for m in reversed(messages) if m.get("executable"))
    return programs


class Tests:
    """Runs tests with one mutant awake."""

    def __init__(self, work, programs, cases):
        self.programs, self.cases, self.folder = programs, cases, work.copy / "verification"

    def run(self, program, mutant, tests, limit):
        """What was noticed, or None; seconds by test."""
        command = [self.programs[program], "--test-threads=1", "-Zunstable-options", "--report-time", "--exact", *tests]
        # The same cases each time: a test that passes with nothing awake, and fails now, does so for the mutant. With few cases some
        # that count what they saw fail for want of it. (The last is the switch by which the standard library's own tests allow
        # themselves the options above.)
        few = {"PROPTEST_CASES": str(self.cases), "PROPTEST_RNG_SEED": str(SEED)}
        environment = os.environ | few | {"MUTANT": str(mutant), "RUSTC_BOOTSTRAP": "1"}
        process = subprocess.Popen(
            command,
            env=environment | {"CARGO_MANIFEST_DIR": str(self.folder)},
            cwd=self.folder,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
            start_new_session=True,
        )
        alarm = threading.Timer(limit, lambda: os.killpg(process.pid, signal.SIGKILL))
        alarm.start()
        noticed, seconds = None, {}
        for line in process.stdout:
            if told := re.match(r"test (\S+).* \.\.\. (ok|FAILED) <([\d.]+)s>", line):
                seconds[told[1]] = float(told[3])
                if told[2] == "FAILED":
                    noticed = told[1]
                    os.killpg(process.pid, signal.SIGKILL)
                    break
        process.stdout.close()
        process.wait()
        if noticed is None and process.returncode != 0:
            where = next((test for test in tests if test not in seconds), "the end")
            noticed = f"{where} ({'no crash, but no end' if not alarm.is_alive() else 'crash'})"
        alarm.cancel()
        return noticed, seconds

    def times(self, program, longest):
        """The seconds of every test that passes with nothing awake and takes no longer than `longest`."""

        def listed(*which):
            command = [self.programs[program], "--list", "--format", "terse", *which]
            lines = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout.splitlines()
            return {line.removesuffix(": test") for line in lines if line.endswith(": test")}

        seconds = {}
        for test in tqdm(sorted(listed() - listed("--ignored")), desc=f"tests of {program}", unit="test"):
            if not NOT_OF_CORE.match(test):
                noticed, taken = self.run(program, 0, [test], longest)
                seconds |= {} if noticed else taken
        return seconds


def hunt(work, tests, times, mutants, shard):
    """Asks the tests that take no longer than the shard's longest about each of its mutants."""
    longest = shard.longest
    known = work.known()
    if work.results.exists() and not work.results.read_text().endswith("\n"):
        # The next result is not to be written behind half of one.
        with work.results.open("a") as results:
            results.write("\n")
    by_cost = sorted((cost, program, test) for program in times for test, cost in times[program].items() if cost <= longest)
    noticed_by = defaultdict(Counter)
    lock = threading.Lock()
    numbers = [number for number in shard.numbers if shard.outcome(number, known) is None]
    shard.keep(known)
    outcomes = dict(known)
    bar = tqdm(total=len(numbers), unit="mutant")

    def ask(number):
        begin = time.monotonic()
        mutant = mutants[number - 1]
        with lock:
            successes = noticed_by[mutant["file"]].copy()
        before = known[number]["longest"] if number in known else -1
        order = [entry for entry in by_cost if entry[0] > before]
        order.sort(key=lambda entry: (entry[0] + 0.02) / (1 + 20 * successes[entry[1:]]))
        noticed = None
        while order and noticed is None:
            # Several at a time, as starting a program takes time too.
            program, cost, batch = order[0][1], 0.0, []
            while order and order[0][1] == program and len(batch) < 24 and (not batch or cost + order[0][0] < 6):
                cost += order[0][0]
                batch.append(order.pop(0)[2])
            noticed, _ = tests.run(program, number, batch, 30 + 10 * cost)
        with lock:
            if noticed:
                noticed_by[mutant["file"]][program, noticed] += 1
            result = {"number": number, "name": mutant["name"], "noticed": noticed, "longest": longest}
            with work.results.open("a") as results:
                results.write(json.dumps(result | {"seconds": round(time.monotonic() - begin, 1)}) + "\n")
            outcomes[number] = result
            shard.keep(outcomes)
            bar.update()

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(ask, numbers))
    bar.close()


def report(work, mutants, fit):
    results = work.known()
    rows = defaultdict(Counter)
    for result in results.values():
        rows[mutants[result["number"] - 1]["file"]]["noticed" if result["noticed"] else "missed"] += 1
    print(f"{'file':46} {'noticed':>8} {'missed':>7}")
    for file, row in sorted(rows.items()):
        print(f"{file:46} {row['noticed']:8} {row['missed']:7}")
    noticed = sum(row["noticed"] for row in rows.values())
    print(f"{noticed} of {len(results)} noticed ({100 * noticed / max(len(results), 1):.1f} %), {len(fit['unviable'])} do not compile")
    print("\nMissed:")
    for result in sorted(results.values(), key=lambda result: result["number"]):
        if not result["noticed"]:
            print(result["name"])
    for number, why in fit["unplaced"].items():
        print(f"not tried, {why}: {mutants[int(number) - 1]['name']}")


def part(text):
    """Of `--shard`."""
    numbers = re.fullmatch(r"(\d+)/(\d+)", text)
    if not numbers or not 1 <= int(numbers[1]) <= int(numbers[2]):
        raise argparse.ArgumentTypeError(f"a shard is I/N, I from 1 to N, not {text!r}")
    return int(numbers[1]), int(numbers[2])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="sources, programs and results (2 GB); a run in it goes on")
    parser.add_argument("--longest", type=float, default=1000, help="leave out tests that take more seconds than that")
    parser.add_argument("--cases", type=int, default=256, help="PROPTEST_CASES: 256 is what ./test.sh does")
    parser.add_argument("--shard", type=part, default=(1, 1), help="I/N, I from 1 to N: one of N parts; in a folder of its own")
    parser.add_argument("--report", action="store_true", help="print what is known and end")
    chosen = parser.parse_args()
    work = Work(chosen.folder.resolve())
    work.folder.mkdir(parents=True, exist_ok=True)
    mutants = work.kept("mutants.json", all_mutants)
    commit = work.kept("copied.json", lambda: copy_of_sources(work))
    fit = work.kept("fit.json", lambda: fitted(work, mutants))
    work.kept("no-longer-constant.json", lambda: callers_of_constant_functions(work))
    if not chosen.report:
        tests = Tests(work, work.kept("programs.json", lambda: built(work)), chosen.cases)
        times = work.kept(
            f"times-{chosen.longest:g}-{chosen.cases}.json",
            lambda: {program: tests.times(program, chosen.longest) for program in tests.programs},
        )
        hunt(work, tests, times, mutants, Shard(work, commit, mutants, fit, chosen))
    report(work, mutants, fit)


if __name__ == "__main__":
    main()
