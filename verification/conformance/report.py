"""Writes scores as Markdown, JSON, sortable HTML whose cells lead to the cases, and a plot of accuracy against time."""

import json
import math
from html import escape

QUESTIONS = {
    "vertex-face": "a vertex and a face in linear motion",
    "edge-edge": "two edges in linear motion",
    "moving-mesh": "a mesh in linear motion",
    "moving-triangle": "a translating triangle and one at rest",
    "triangles": "two triangles at rest",
    "meshes": "two meshes at rest",
}
COLUMNS = [
    ("asked", "asked", None),
    ("missed", "missed", "missed"),
    ("deep", "of these deep", "missed"),
    ("false", "false alarms", "false alarm"),
    ("beyond", "of these beyond tolerance", "false alarm"),
    ("late", "late", "late"),
    ("late_max", "largest delay", "late"),
    ("early", "early by > 0.01", None),
    ("hang", "hang", "hang"),
    ("crash", "crash", "crash"),
    ("nan", "not a number", "not a number"),
    ("nonfinite", "not finite, answered none", "not finite, answered none"),
    ("undecided", "undecided", None),
    ("refused", "refused", None),
    ("mean_us", "mean, µs", None),
    ("p99_us", "99 %, µs", None),
    ("max_us", "largest, µs", None),
]
GROUPS = {
    "deformable pairs and meshes": {"vertex-face", "edge-edge", "moving-mesh"},
    "translating triangles, and at rest": {"moving-triangle"},
    "at rest only": {"triangles", "meshes"},
}
COLOURS = {"deformable pairs and meshes": "#0b6e99", "translating triangles, and at rest": "#c2410c", "at rest only": "#2f7d32"}


def shown(value):
    if isinstance(value, float):
        return "–" if value == 0 else "> 1e9" if value > 1e9 else f"{value:,.0f}" if value >= 100 else f"{value:.2g}"
    return "–" if value == 0 else f"{value:,}" if isinstance(value, int) else str(value)


def by_question(scores):
    for question in QUESTIONS:
        rows = [(n, r["scores"][question]) for n, r in scores["runners"].items() if question in r["scores"]]
        if rows:
            yield question, sorted(rows, key=lambda row: (row[1]["wrong"] / row[1]["asked"], row[1].get("mean_us", 0)))


def markdown(scores):
    out = []
    for question, rows in by_question(scores):
        used = [c for c in COLUMNS if any(r.get(c[0], 0) for _, r in rows)]
        out += [f"### `{question}`: {QUESTIONS[question]}", ""]
        out += ["| runner | " + " | ".join(c[1] for c in used) + " |", "|---" * (len(used) + 1) + "|"]
        out += [f"| {name} | " + " | ".join(shown(row.get(c[0], 0)) for c in used) + " |" for name, row in rows] + [""]
    return "\n".join(out)


def examples(scores, count=3):
    """The smallest faults of each runner, in decimals that identify the numbers."""
    out = []
    for name, runner in scores["runners"].items():
        chosen = {}
        for fault in runner["faults"]:
            question = scores["texts"][fault["id"]]["question"]
            if len(chosen) < count and (question, fault["fault"]) not in chosen:
                chosen[question, fault["fault"]] = fault
        rest = [f for f in runner["faults"] if f not in chosen.values()]
        for fault in [*chosen.values(), *rest][:count]:
            out.append((name, fault, scores["texts"][fault["id"]]))
    return out


def exact_text(case):
    if case["touches"] is None:
        return "a number is not finite"
    if not case["touches"]:
        low, high = (float.fromhex(x) for x in case["distance"])
        return f"apart by {low:.3g} to {high:.3g}"
    deep = float.fromhex(case["depth"])
    text = "touches" + (f", {deep:.2g} of the size deep" if deep else "")
    if "first" in case:
        text += f", first at {case.get('exact') or repr(float.fromhex(case['first'][0]))}"
    return text


def numbers(points):
    return " ".join("(" + ", ".join(repr(float.fromhex(x)) for x in p) + ")" for p in points)


def said(fault):
    answer = fault["answer"]
    if "time" not in answer:
        return answer["verdict"]
    return f"{answer['verdict']} at {float.fromhex(answer['time']) if 'x' in answer['time'] else answer['time']}"


def examples_markdown(scores):
    out, last = [], None
    for name, fault, case in examples(scores):
        if name != last:
            out += ["", f"## {name}", ""]
            last = name
        out.append(f"- `{case['id']}` ({fault['fault']}): exact: {exact_text(case)}; answered {said(fault)}.")
        out.append(f"  - start: {numbers(case['start'])}")
        if "end" in case:
            out.append(f"  - end: {numbers(case['end'])}")
        if "move" in case:
            out.append(f"  - the second moves by {numbers([case['move']])}")
        if "faces" in case:
            out.append(
                f"  - faces: {case['faces']}" + (f"; the first {case['split']} are the first mesh" if "split" in case else "")
            )
    return "\n".join(out).strip() + "\n"


STYLE = """body{font:15px/1.4 system-ui,sans-serif;margin:2rem;max-width:100rem}table{border-collapse:collapse;margin:1rem 0 2rem}
td,th{padding:.25rem .6rem;border-bottom:1px solid #ddd;text-align:right}td:first-child,th:first-child{text-align:left}
th{cursor:pointer;vertical-align:bottom}pre{white-space:pre-wrap;background:#f6f6f6;padding:.5rem}img{max-width:100%}"""
SORT = """document.querySelectorAll('th').forEach(th=>th.onclick=()=>{const t=th.closest('table'),i=th.cellIndex,
b=t.tBodies[0],up=th.dataset.up=th.dataset.up==='1'?'':'1',k=r=>r.cells[i].dataset.v;
[...b.rows].sort((p,q)=>{const x=k(p),y=k(q),c=isNaN(x)||isNaN(y)?x.localeCompare(y):x-y;return up?c:-c})
.forEach(r=>b.append(r))})"""


def page(title, body):
    head = f'<!doctype html><html lang="en"><meta charset="utf-8"><title>{escape(title)}</title><style>{STYLE}</style>'
    return f"{head}<body><h1>{escape(title)}</h1>{body}<script>{SORT}</script></body></html>\n"


def anchor(question, kind, fault):
    return f"{question}-{kind}-{fault}".replace(" ", "-").replace(",", "")


def table(rows, first, link):
    used = [c for c in COLUMNS if any(r.get(c[0], 0) for _, r in rows)]
    out = [
        "<table><thead><tr>"
        + f"<th>{escape(first)}</th>"
        + "".join(f"<th>{escape(c[1])}</th>" for c in used)
        + "</tr></thead><tbody>"
    ]
    for name, row in rows:
        cells = [f'<td data-v="{escape(str(name))}">{link(name, None)}</td>']
        for key, _, fault in used:
            value = row.get(key, 0)
            text = link(name, fault, shown(value)) if fault and value else shown(value)
            cells.append(f'<td data-v="{value}">{text}</td>')
        out.append("<tr>" + "".join(cells) + "</tr>")
    return "".join(out) + "</tbody></table>"


def index(scores):
    body = ['<p>Columns sort on a click. Cells lead to the cases.</p><img src="accuracy.svg" alt="accuracy against time">']
    for question, rows in by_question(scores):

        def link(name, fault, text=None, question=question):
            target = f"#{anchor(question, 'all', fault)}" if fault else ""
            return f'<a href="{escape(name)}.html{target}">{escape(text or name)}</a>'

        body.append(f"<h2>{escape(question)}: {escape(QUESTIONS[question])}</h2>" + table(rows, "runner", link))
    return page("Conformance of collision tests", "".join(body))


def runner_page(name, runner, texts):
    facts = f"{runner['library']} {runner['found_version']}, {runner['processor']}; see {runner['page']}"
    body = [f"<p>{escape(facts)}</p>"]
    for question in runner["scores"]:
        rows = [(row["kind"], row) for row in runner["kinds"] if row["question"] == question]

        def link(kind, fault, text=None, question=question):
            return f'<a href="#{anchor(question, kind, fault)}">{escape(text)}</a>' if fault else escape(str(kind))

        body.append(f"<h2>{escape(question)}</h2>" + table(rows, "kind", link))
    groups = {}
    for fault in runner["faults"]:
        case = texts[fault["id"]]
        groups.setdefault((case["question"], fault["fault"]), {}).setdefault(case["kind"], []).append((fault, case))
    for (question, fault), kinds in groups.items():
        body.append(f'<h2 id="{anchor(question, "all", fault)}">{escape(question)}: {escape(fault)}</h2>')
        for kind, found in kinds.items():
            body.append(f'<h3 id="{anchor(question, kind, fault)}">{escape(kind)}</h3>')
            for one, case in found:
                line = f"<b>{escape(case['id'])}</b>: {escape(exact_text(case))}; answered {escape(said(one))}"
                body.append(f"<details><summary>{line}</summary><pre>{escape(json.dumps(case))}</pre></details>")
    return page(name, "".join(body))


def totals(scores):
    """For each runner: its hardest kind of question, mean time and share of wrong answers, over all that it claims."""
    for name, runner in scores["runners"].items():
        rows = [row for row in runner["scores"].values() if "mean_us" in row]
        asked = sum(row["asked"] for row in rows)
        if asked:
            mean = sum(row["mean_us"] * row["asked"] for row in rows) / asked
            hardest = next(group for group, questions in GROUPS.items() if questions & set(runner["scores"]))
            yield name, hardest, mean, sum(row["wrong"] for row in rows) / asked


def free_place(px, py, words, taken):
    """A place for a label that covers no other: its left edge and baseline."""
    length = 6.2 * len(words)
    for row in range(12):
        for down in sorted({row * 11, -row * 11}):
            for left in (px + 7, px - 7 - length):
                box = (left, py + down - 6, left + length, py + down + 5)
                if not any(box[0] < b[2] and b[0] < box[2] and box[1] < b[3] and b[1] < box[3] for b in taken):
                    taken.append(box)
                    return left, py + down + 4
    return px + 7, py + 4


def plot(scores):
    """Share of wrong answers against mean time: a mark for each runner."""
    left, top, width, height, band = 70, 20, 900, 480, 110
    points = sorted(totals(scores), key=lambda p: (p[3], p[2]))
    low = math.floor(min(math.log10(p[2]) for p in points))
    high = math.ceil(max(math.log10(p[2]) for p in points))
    x = lambda us: left + width * (math.log10(us) - low) / max(1, high - low)
    # Shares from one in two thousand up are logarithmic; above them is a band for none.
    y = lambda share: top + band / 2 if share == 0 else top + band + (height - band) * (math.log10(max(share, 5e-4)) + 3.3) / 3.3
    box = f"0 0 {left + width + 20} {top + height + 60}"
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}" font-family="sans-serif" font-size="11">']
    out.append('<rect width="100%" height="100%" fill="white"/>')

    def label(px, py, words, anchor="start", **more):
        style = "".join(f' {key.replace("_", "-")}="{value}"' for key, value in more.items())
        out.append(f'<text x="{px:.1f}" y="{py:.1f}" text-anchor="{anchor}"{style}>{escape(words)}</text>')

    for power in range(low, high + 1):
        at = x(10.0**power)
        out.append(f'<path d="M{at:.1f} {top}V{top + height}" stroke="#ddd"/>')
        unit, exponent = ("µs", power) if power < 3 else ("ms", power - 3) if power < 6 else ("s", power - 6)
        words = f"{10.0**exponent:g} {unit}"
        label(at, top + height + 18, words, "middle")
    for share, words in ((0, "none"), (0.001, "0.1 %"), (0.01, "1 %"), (0.1, "10 %"), (1, "all")):
        out.append(f'<path d="M{left} {y(share):.1f}h{width}" stroke="#ddd"/>')
        label(left - 8, y(share) + 4, words, "end")
    label(left + width / 2, top + height + 42, "mean time of a query", "middle", font_size=13)
    label(0, 0, "wrong answers", "middle", font_size=13, transform=f"translate(16 {top + height / 2}) rotate(-90)")
    taken = [(x(us) - 4, y(share) - 4, x(us) + 4, y(share) + 4) for _, _, us, share in points]
    for name, group, us, share in points:
        title = escape(f"{name}: {share:.2%} wrong, {us:.3g} µs")
        mark = f'<circle cx="{x(us):.1f}" cy="{y(share):.1f}" r="4" fill="{COLOURS[group]}">'
        out.append(f"{mark}<title>{title}</title></circle>")
        label(*free_place(x(us), y(share), name, taken), name, fill=COLOURS[group])
    for i, (group, colour) in enumerate(COLOURS.items()):
        py = top + height - 20 - 18 * i
        out.append(f'<circle cx="{left + width - 260}" cy="{py}" r="5" fill="{colour}"/>')
        label(left + width - 248, py + 4, group)
    return "\n".join([*out, "</svg>"]) + "\n"


def write(scores, folder):
    """Writes everything into the folder."""
    (folder / "scores.md").write_text(markdown(scores) + "\n", encoding="utf-8")
    (folder / "examples.md").write_text("# The smallest faults of each runner\n\n" + examples_markdown(scores), encoding="utf-8")
    plain = {key: value for key, value in scores.items() if key != "texts"}
    (folder / "scores.json").write_text(json.dumps(plain, indent=1) + "\n", encoding="utf-8")
    (folder / "index.html").write_text(index(scores), encoding="utf-8")
    for name, runner in scores["runners"].items():
        (folder / f"{name}.html").write_text(runner_page(name, runner, scores["texts"]), encoding="utf-8")
    if any(totals(scores)):
        (folder / "accuracy.svg").write_text(plot(scores), encoding="utf-8")
