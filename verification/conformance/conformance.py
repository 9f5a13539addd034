#!/usr/bin/env python3
"""Gives collision libraries the cases of the suite, and scores their answers.

    conformance.py --list
    conformance.py RUNNER... [--out FOLDER]

Each RUNNER is installed into an environment of its own on first use. Answers are appended to FOLDER/answers/RUNNER.jsonl, so a
run that was stopped resumes. Then all answers in FOLDER are scored: scores.md, scores.json, index.html and accuracy.svg.
"""

import argparse
import json
import os
import platform
import random
import select
import shutil
import subprocess
import sys
import time
import venv
from pathlib import Path

import report
import score

SUITE = Path(__file__).resolve().parent
CACHE = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "selvedge-conformance"


def runners():
    """All runners by name: the entry of runner.json joined with that of its library."""
    found = {}
    for path in sorted(SUITE.glob("runners/*/runner.json")):
        library = json.loads(path.read_text(encoding="utf-8"))
        for name, own in library.pop("runners").items():
            found[name] = {**library, **own, "folder": path.parent}
    return found


def cases(paths=None):
    """All cases by name."""
    found = {}
    for path in paths or sorted(SUITE.glob("cases/*.jsonl")):
        with open(path, encoding="ascii") as lines:
            for line in lines:
                case = json.loads(line)
                found[case["id"]] = case
    return found


def question_line(case):
    """Returns the line that a runner reads: the question without its answer."""
    words = [case["id"].replace(" ", "_"), case["question"], case["format"]]
    if "faces" in case:
        words += [len(case["start"]), len(case["faces"]), case.get("split", 0)]
    for point in [*case["start"], *case.get("end", []), *([case["move"]] if "move" in case else [])]:
        words += point
    for face in case.get("faces", []):
        words += face
    return " ".join(map(str, words))


def run(command, folder, **variables):
    subprocess.run(command, cwd=folder, check=True, env={**os.environ, **variables}, stdout=sys.stderr)


def installed(runner, cache):
    """The command that starts a runner. Installs it on first use, and those of this repository each time."""
    wanted, folder = runner["install"], runner["folder"]
    place = cache / folder.name
    stamp, text = place / "installed.json", json.dumps(wanted)
    python = place / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
    values = {"python": python, "place": place, "target": cache / "target", "folder": folder, "repository": SUITE.parent.parent}
    filled = lambda words: [word.format(**values) for word in words]
    is_own = runner["version"] == "of this repository"
    if is_own or not stamp.exists() or stamp.read_text(encoding="utf-8") != text:
        place.mkdir(parents=True, exist_ok=True)
        target = {"CARGO_TARGET_DIR": str(cache / "target")}
        if "pip" in wanted:
            if not python.exists():
                venv.create(place, with_pip=True, symlinks=os.name != "nt")
            command = [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", *filled(wanted["pip"])]
            run(command, folder, **target)
        if "npm" in wanted:
            (place / "package.json").write_text('{"private": true}\n', encoding="utf-8")
            run(["npm", "install", "--silent", *wanted["npm"]], place)
        if "cargo" in wanted:
            run(["cargo", "build", "--release", "--quiet", *filled(wanted["cargo"])], folder, **target)
        for command in wanted.get("commands", []):
            run(filled(command), folder, **target)
        for name in wanted.get("copy", []):
            shutil.copy(folder / name, place / Path(name).name)
        stamp.write_text(text, encoding="utf-8")
    return filled(runner["command"])


class Child:
    """A runner's process. `ask` returns its line, None after the limit, or an empty text if it has ended."""

    def __init__(self, command, folder):
        variables = {**os.environ, "PYTHONPATH": str(SUITE / "runners"), "OMP_NUM_THREADS": "1", "PYTHONDONTWRITEBYTECODE": "1"}
        null = subprocess.DEVNULL
        self.process = subprocess.Popen(
            command, cwd=folder, env=variables, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=null
        )
        self.rest = b""
        first = self.line(60)
        if not first or not first.startswith("ready"):
            self.end()
            sys.exit(f"{' '.join(map(str, command))}: it does not start; it must print `ready VERSION`, but printed {first!r}")
        self.version = first[6:]

    def line(self, limit):
        until = time.monotonic() + limit
        while b"\n" not in self.rest:
            ready, _, _ = select.select([self.process.stdout], [], [], max(0, until - time.monotonic()))
            if not ready:
                return None
            data = os.read(self.process.stdout.fileno(), 1 << 16)
            if not data:
                return ""
            self.rest += data
        line, self.rest = self.rest.split(b"\n", 1)
        return line.decode(errors="replace").strip()

    def ask(self, text, limit):
        try:
            self.process.stdin.write(text.encode() + b"\n")
            self.process.stdin.flush()
        except BrokenPipeError:
            return ""
        return self.line(limit)

    def end(self):
        self.process.kill()
        return self.process.wait()


def answer(line, child, limit):
    """A line as a row of answers."""
    if line is None:
        child.end()
        return {"verdict": "hang", "ns": int(limit * 1e9)}
    if line == "":
        return {"verdict": "crash", "note": f"exit {child.end()}"}
    words = line.split(" ", 4)
    row = {"verdict": words[1], "ns": int(words[3])}
    if words[2] != "-":
        row["time"] = words[2]
    if len(words) > 4:
        row["note"] = words[4]
    return row


def ask_all(name, runner, command, asked, path, arguments):
    """Appends answers to the file until all cases are asked or the seconds are over. Returns how many are left."""
    known = set()
    if path.exists():
        known = {json.loads(line)["id"] for line in path.read_text(encoding="utf-8").splitlines()[1:]}
    claimed = [c for c in asked.values() if c["question"] in runner["questions"] and c["format"] in runner["formats"]]
    random.Random(5).shuffle(claimed)
    if arguments.sample:
        kept = {}
        for case in claimed:
            kept.setdefault((case["question"], case["format"], case["kind"]), []).append(case)
        claimed = [c for group in kept.values() for c in group[: arguments.sample]]
        random.Random(6).shuffle(claimed)
    todo = [c for c in claimed if c["id"] not in known]
    if not todo:
        return 0
    until = time.monotonic() + arguments.seconds
    child = Child(command, runner["folder"])
    with open(path, "a", encoding="utf-8") as out:
        if not known:
            print(
                json.dumps({"runner": name, "version": child.version, "processor": processor(), "limit": arguments.limit}),
                file=out,
            )
        for index, case in enumerate(todo):
            if time.monotonic() > until:
                child.end()
                return len(todo) - index
            text = question_line(case)
            row = answer(child.ask(text, arguments.limit), child, arguments.limit)
            print(json.dumps({"id": case["id"], **row}), file=out)
            if child.process.poll() is not None:
                child = Child(command, runner["folder"])
    child.end()
    return 0


def processor():
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as lines:
            return next(line.split(":", 1)[1].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.processor() or platform.machine()


def main():
    parser = argparse.ArgumentParser(
        prog="conformance", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("runners", nargs="*", metavar="RUNNER", help="a name that --list shows, or `all`")
    parser.add_argument("--list", action="store_true", help="show the runners")
    parser.add_argument("--out", type=Path, default=Path("conformance"), help="folder of answers and scores")
    parser.add_argument("--cases", type=Path, nargs="+", metavar="FILE", help="other cases than the suite's")
    parser.add_argument("--limit", type=float, default=1.0, help="seconds for a case before the runner is killed")
    parser.add_argument("--seconds", type=float, default=float("inf"), help="stop asking after this time; run again to resume")
    parser.add_argument("--sample", type=int, help="only so many cases of each question, format and kind")
    parser.add_argument("--cache", type=Path, default=CACHE, help="folder of the runners' environments")
    parser.add_argument("--again", action="store_true", help="forget the answers of these runners first")
    arguments = parser.parse_args()
    known = runners()
    if arguments.list:
        for name, runner in known.items():
            print(f"{name:24} {runner['library']} {runner['version']}: {', '.join(runner['questions'])}")
        return
    chosen = list(known) if arguments.runners == ["all"] else arguments.runners
    unknown = [name for name in chosen if name not in known]
    if unknown:
        parser.error(f"no runner is called {unknown[0]}; --list shows all")
    asked = cases(arguments.cases)
    answers = arguments.out / "answers"
    answers.mkdir(parents=True, exist_ok=True)
    failed = False
    for name in chosen:
        path = answers / f"{name}.jsonl"
        if arguments.again:
            path.unlink(missing_ok=True)
        try:
            left = ask_all(name, known[name], installed(known[name], arguments.cache), asked, path, arguments)
            print(f"{name}: {left} left" if left else f"{name}: done", file=sys.stderr)
        except (OSError, subprocess.CalledProcessError) as error:
            print(f"{name}: cannot be installed: {error}", file=sys.stderr)
            failed = True
    scores = score.score(asked, known, answers)
    report.write(scores, arguments.out)
    print((arguments.out / "scores.md").read_text(encoding="utf-8"))
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
