#!/usr/bin/env python3
"""Wraps comments of more than 130 characters: `.ci/wrap.py [FOLDER-OR-FILE...]`, by default all that git knows. Words that do not
fit go to the next line of their paragraph. Tables, code in comments and generated files stay as they are. `.ci/structure.py` names
what is left."""

import re
import subprocess
import sys
from pathlib import Path

LINE = 130
ROOT = Path(__file__).resolve().parent.parent
HASH, SLASHES = r"#", r"//[/!]?"
MARKS = {".py": HASH, ".sh": HASH, ".bash": HASH} | dict.fromkeys((".rs", ".c", ".cpp", ".hpp", ".js", ".mjs", ".ts"), SLASHES)
GENERATED = re.compile(r"/include/selvedge(_cloth)?\.h$|/reference/|/data/")
ITEM = re.compile(r"([-*] |\d+\. |\| |#|```|>)")


def wrapped(text, mark):
    comment = re.compile(rf"^(\s*)({mark})( ?)(.*)$")
    lines, out, at, is_code = text.split("\n"), [], 0, False
    while at < len(lines):
        line, found = lines[at], comment.match(lines[at])
        at += 1
        is_code = bool(found) and is_code != found[4].strip().startswith("```")
        words = found[4].strip() if found else ""
        out.append(line)
        if len(line) <= LINE or is_code or " " not in words or words.startswith("|"):
            continue
        indent, sign, space, body = found.groups()
        lead, item = len(body) - len(body.lstrip()), ITEM.match(body.lstrip())
        inner = " " * (lead + (len(item[0]) if item and item[0][0] in "-*0123456789" else 0))
        kept = body
        while len(indent + sign + space + kept) > LINE and " " in kept.strip():
            kept = kept.rsplit(" ", 1)[0]
        rest = body[len(kept) :].strip()
        if not kept.strip() or not rest:
            continue
        out[-1] = f"{indent}{sign}{space}{kept}".rstrip()
        after = comment.match(lines[at]) if at < len(lines) else None
        goes_on = after and after.group(1, 2) == (indent, sign) and re.match(rf"{inner}(?! )", after[4]) and after[4].strip()
        if goes_on and not ITEM.match(after[4].lstrip()):
            lines[at] = f"{indent}{sign}{space}{inner}{rest} {after[4].lstrip()}"
        else:
            lines.insert(at, f"{indent}{sign}{space}{inner}{rest}")
    return "\n".join(out)


def main():
    listed = subprocess.run(["git", "ls-files", *sys.argv[1:]], capture_output=True, text=True, check=True, cwd=ROOT)
    for name in listed.stdout.splitlines():
        path = ROOT / name
        if path.suffix in MARKS and path.is_file() and not GENERATED.search(name):
            text = path.read_text()
            new = wrapped(text, MARKS[path.suffix])
            if new != text:
                path.write_text(new)


if __name__ == "__main__":
    main()
