"""Scores answers by the labels of the cases."""

import json
import math
from fractions import Fraction

FAULTS = ("missed", "false alarm", "late", "not a number", "hang", "crash", "not finite, answered none")
DISTANCES = (1e-12, 1e-9, 1e-6, 1e-3)


def number(text):
    return float.fromhex(text) if "x" in text or text in ("nan", "inf", "-inf") else float(text)


def size(case):
    """The largest extent of the case along an axis."""
    points = case["start"] + case.get("end", [])
    values = [[float.fromhex(p[x]) for p in points] for x in range(3)]
    moves = [abs(float.fromhex(x)) for x in case.get("move", [])]
    return max(max(v) - min(v) for v in values) + max(moves, default=0.0)


def empty():
    counts = "asked contacts apart missed deep false beyond late early undecided refused hang crash nan nonfinite".split()
    return {**dict.fromkeys(counts, 0), "late_max": 0.0, "by_distance": [0] * (len(DISTANCES) + 1), "times": []}


def judge(case, row, runner):
    """Returns the error in an answer: (fault or None, counts to raise, details)."""
    verdict = row["verdict"]
    if verdict in ("hang", "crash"):
        return verdict, [verdict], {}
    if verdict in ("refused", "undecided"):
        return None, [verdict], {}
    if case["touches"] is None:
        return ("not finite, answered none", ["nonfinite"], {}) if verdict == "none" else (None, [], {})
    tolerance = runner["tolerance"].get(case["format"], runner["tolerance"])
    share = tolerance["relative"] + tolerance["absolute"] / (size(case) or 1.0)
    if case["touches"] and verdict == "none":
        deep = float.fromhex(case["depth"]) > share
        return "missed", ["missed"] + ["deep"] * deep, {"deep": deep}
    if not case["touches"] and verdict == "touches":
        distance = float.fromhex(case["distance"][0]) / (size(case) or 1.0)
        bucket = sum(distance > limit for limit in DISTANCES)
        beyond = distance > share
        return "false alarm", ["false"] + ["beyond"] * beyond, {"bucket": bucket, "distance": distance, "beyond": beyond}
    if case["touches"] and "time" in row and "first" in case:
        answered = number(row["time"])
        if not math.isfinite(answered):
            return "not a number", ["nan"], {}
        low, high = (Fraction(float.fromhex(x)) for x in case["first"])
        if Fraction(answered) > low and (low == high or Fraction(answered) >= high):
            return "late", ["late"], {"by": float(Fraction(answered) - low)}
        if low - Fraction(answered) > Fraction(1, 100):
            return None, ["early"], {}
    return None, [], {}


def finish(counts):
    times = sorted(counts.pop("times"))
    if times:
        counts["mean_us"] = sum(times) / len(times) / 1e3
        counts["p99_us"] = times[min(len(times) - 1, int(0.99 * len(times)))] / 1e3
        counts["max_us"] = times[-1] / 1e3
    wrong = counts["missed"] + counts["beyond"] + counts["late"] + counts["hang"] + counts["crash"] + counts["nan"]
    counts["wrong"] = wrong + counts["nonfinite"]
    return counts


def score_runner(cases, runner, path):
    lines = path.read_text(encoding="utf-8").splitlines()
    head = json.loads(lines[0])
    questions, kinds, faults = {}, {}, []
    for line in lines[1:]:
        row = json.loads(line)
        case = cases.get(row["id"])
        if case is None:
            continue
        fault, raised, details = judge(case, row, runner)
        groups = questions.setdefault(case["question"], empty()), kinds.setdefault((case["question"], case["kind"]), empty())
        for counts in groups:
            counts["asked"] += 1
            counts["contacts" if case["touches"] else "apart"] += 1
            for name in raised:
                counts[name] += 1
            if "bucket" in details:
                counts["by_distance"][details["bucket"]] += 1
            counts["late_max"] = max(counts["late_max"], details.get("by", 0.0))
            if row.get("ns") and row["verdict"] not in ("refused", "crash"):
                counts["times"].append(row["ns"])
        if fault:
            faults.append({"id": row["id"], "fault": fault, **details, "answer": {k: row[k] for k in row if k != "id"}})
    return {
        **{key: runner[key] for key in ("library", "version", "language", "tolerance", "questions", "formats")},
        "found_version": head["version"],
        "processor": head["processor"],
        "limit": head["limit"],
        "page": f"runners/{runner['folder'].name}/README.md",
        "scores": {question: finish(counts) for question, counts in questions.items()},
        "kinds": [{"question": q, "kind": k, **finish(counts)} for (q, k), counts in sorted(kinds.items())],
        "faults": sorted(faults, key=lambda fault: rank(fault, cases)),
    }


def rank(fault, cases):
    """Clear faults first, then those with few digits."""
    case = cases[fault["id"]]
    digits = sum(len(x) for p in case["start"] + case.get("end", []) for x in p)
    clear = fault.get("deep") or fault.get("beyond") or fault.get("by", 0.0) > 1e-9
    return FAULTS.index(fault["fault"]), not clear, digits, fault["id"]


def score(cases, runners, folder):
    """The scores of all runners with answers in the folder."""
    found = {}
    for name, runner in runners.items():
        path = folder / f"{name}.jsonl"
        if path.exists():
            found[name] = score_runner(cases, runner, path)
    return {
        "cases": {q: sum(c["question"] == q for c in cases.values()) for q in sorted({c["question"] for c in cases.values()})},
        "runners": found,
        "texts": cases,
    }
