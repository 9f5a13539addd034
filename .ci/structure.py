#!/usr/bin/env python3
"""Checks what ARCHITECTURE.md promises about files: no two files of a crate import each other in a circle, no line of a comment has
more than 130 characters, no file more than 500 lines, no function more than 80. Prints each place that breaks a rule.

A re-export (`pub use`) is followed to the file that defines the name, so a module may offer what is below it, and a file may use
what the module around it defines. Tests may import anything. A proof in Coq may be as long as it needs.
Run it from anywhere: `.ci/structure.py`, or `.ci/structure.py FILE...` for the lengths of some files alone."""

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
LINE, FILE, FUNCTION = 130, 500, 80
# Written by programs, or by others.
GENERATED = re.compile(r"Cargo\.lock|/include/selvedge(_cloth)?\.h$|/reference/|/data/|package-lock\.json|\.coq$|/extracted/.*\.ml")
# What breaks a rule and waits to be mended. Nothing may be added.
KNOWN_CIRCLES = [
    {"cloth/src/effects/air/drag.rs", "cloth/src/effects/plan.rs", "cloth/src/effects/registration.rs"},
    {"cloth/src/simulate/simulation.rs", "cloth/src/simulate/substep.rs", "cloth/src/simulate/waiting.rs"},
    {"cloth/src/solve/bands.rs", "cloth/src/solve/matrix.rs"},
    {"cloth/src/world/keyframes.rs", "cloth/src/world/motion.rs"},
    {"web/src/numbers.rs", "web/src/values.rs"},
]
KNOWN_LENGTHS = {
    "cloth/src/simulate/assembly.rs: function of": 100,
    "cloth/src/simulate/substep.rs: function attempt": 160,
    "cloth/src/world/keyframes.rs": 560,
    "cloth/tests/simulation/from_code.rs": 590,
    "python/python/selvedge/ipc.py": 580,
    "python/src/simulation.rs": 501,
}
SOURCE = {".rs", ".py", ".sh", ".bash", ".c", ".h", ".hpp", ".cpp", ".js", ".mjs", ".ts"}


def listed(patterns=()):
    names = subprocess.run(["git", "ls-files", *patterns], cwd=ROOT, capture_output=True, text=True, check=True)
    return [name for name in names.stdout.splitlines() if (ROOT / name).is_file()]


def code_of(text):
    """The text with comments, strings and character literals blanked; line breaks stay."""
    token = r'//[^\n]*|/\*.*?\*/|b?r(#*)".*?"\1|b?"(?:\\.|[^"\\])*"|\'(?:\\[^\n]{1,9}?|[^\\\'\n])\''
    return re.sub(token, lambda found: re.sub(r"[^\n]", " ", found[0]), text, flags=re.S)


def allowed(what, rule):
    return KNOWN_LENGTHS.get(what.removeprefix("std-adapter/"), rule)


def lengths(name, text):
    lines = text.splitlines()
    is_figure = False
    for number, line in enumerate(lines, 1):
        # A diagram in a block of text is as wide as its arrows.
        is_figure = is_figure != bool(re.match(r"\s*//[/!]? ?```", line))
        # Formatters break code. A row of a table and a link cannot be broken.
        comment = re.match(r"\s*(//[/!]?|#)(?= )" if name.endswith(".rs") else r"\s*(//+|#|/?\*+)(?= )", line)
        words = line[comment.end() :].strip() if comment else ""
        if len(line) > LINE and " " in words and not words.startswith("|") and not is_figure:
            yield f"{name}:{number}: {len(line)} characters; at most {LINE}"
    if len(lines) > allowed(name, FILE) and not name.endswith(".v"):
        yield f"{name}: {len(lines)} lines; at most {FILE}"
    if name.endswith(".rs"):
        code = code_of(text).splitlines()
        for number, line in enumerate(code, 1):
            found = re.match(r"( *)(?:pub(?:\([^)]*\))? )?(?:const |async |unsafe |extern \S* ?)*fn (\w+)", line)
            if found and not line.rstrip().endswith((";", "}")):
                last = next((n for n in range(number, len(code)) if code[n].startswith(found[1] + "}")), number)
                if last + 2 - number > allowed(f"{name}: function {found[2]}", FUNCTION):
                    yield f"{name}:{number}: function {found[2]} has {last + 2 - number} lines; at most {FUNCTION}"


class Crate:
    """The modules of a crate, by path, and the names that each imports."""

    def __init__(self, root):
        self.files, self.uses, self.exports, self.globs, self.children = {}, {}, {}, {}, {}
        self.read(ROOT / root, ())

    def read(self, file, module):
        text = code_of(file.read_text())
        # Modules for tests, inline or in files, may import anything.
        text = re.sub(r"#\[cfg\((?:all\()?test\b[^\n]*\n(?:#\[[^\n]*\n)*(pub(\(\w+\))? )?mod \w+;", "", text)
        text = re.split(r"\n#\[cfg\((?:all\()?test\b[^\n]*\n(?:#\[[^\n]*\n)*mod \w+ \{", text)[0]
        self.files[module], self.uses[module] = file, []
        self.exports[module], self.globs[module] = {}, []
        self.children[module] = set()
        folder = file.parent if file.name in ("mod.rs", "lib.rs", "main.rs") else file.with_suffix("")
        for child in re.findall(r"^\s*(?:pub(?:\(\w+\))? )?mod (\w+);", text, re.M):
            for path in (folder / f"{child}.rs", folder / child / "mod.rs"):
                if path.is_file():
                    self.children[module].add(child)
                    self.read(path, (*module, child))
        for public, tree in re.findall(r"^\s*(pub(?:\([^)]*\))? )?use ([^;]+);", text, re.M):
            for path, name in flattened("".join(tree.split(" ")) if " as " not in tree else tree):
                self.exports[module][name] = path
                if name == "*":
                    self.globs[module].append(path)
                if not public:
                    self.uses[module].append(path)
        body = re.sub(r"^\s*(?:pub(?:\([^)]*\))? )?use [^;]+;", "", text, flags=re.M)
        heads = "|".join(["crate", "super", "self", *self.children[module]])
        self.uses[module] += [tuple(path.split("::")) for path in re.findall(rf"(?<![\w:])(?:{heads})(?:::\w+)+", body)]

    def home(self, module, path, depth=0):
        """The module that defines what `path` names in `module`, or None if that is another crate."""
        here, first = module, True
        for position, name in enumerate(path):
            if name == "crate":
                here = ()
            elif name == "super":
                here = here[:-1]
            elif name == "self":
                pass
            elif name in self.children[here]:
                here = (*here, name)
            elif name in self.exports[here] and depth < 8:
                return self.home(here, (*self.exports[here][name], *path[position + 1 :]), depth + 1)
            elif first:
                return None
            else:
                for glob in self.globs[here]:
                    target = self.home(here, glob[:-1], depth + 1)
                    if target is not None and re.search(rf"\b(fn|struct|enum|trait|type|const|static|mod|macro_rules!) {name}\b",
                                                        self.files[target].read_text()):
                        return target
                return here
            first = False
        return here

    def circles(self):
        # A file may use what the module around it defines: the two are one room.
        around = {m: {m[:depth] for depth in range(len(m) + 1)} for m in self.uses}
        arrows = {m: {self.home(m, path) for path in paths} - {None} - around[m] for m, paths in self.uses.items()}
        reached = {}
        for start in arrows:
            seen, open_ = set(), [start]
            while open_:
                for target in arrows.get(open_.pop(), ()):
                    if target not in seen:
                        seen.add(target)
                        open_.append(target)
            reached[start] = seen
        left = {m for m in arrows if m in reached[m]}
        while left:
            start = min(left)
            circle = {m for m in left if m in reached[start] and start in reached[m]}
            left -= circle
            names = {m: str(self.files[m].relative_to(ROOT)) for m in circle}
            yield [f"{names[m]} -> " + ", ".join(sorted(names[t] for t in arrows[m] & circle)) for m in sorted(circle)]


def flattened(tree, prefix=()):
    """The paths of a `use` tree, each with the name that it binds."""
    tree = tree.strip()
    head, brace, rest = tree.partition("{")
    if brace:
        prefix = (*prefix, *(part for part in head.strip().split("::") if part))
        depth, start, rest = 0, 0, rest.rstrip()[:-1] + ","
        for position, letter in enumerate(rest):
            depth += (letter == "{") - (letter == "}")
            if letter == "," and depth == 0:
                if rest[start:position].strip():
                    yield from flattened(rest[start:position], prefix)
                start = position + 1
        return
    path, _, name = tree.partition(" as ")
    path = (*prefix, *path.strip().split("::"))
    path = path[:-1] if path[-1] == "self" and len(path) > 1 else path
    yield path, name.strip() or path[-1]


def main():
    problems = []
    for name in sys.argv[1:] or listed():
        if Path(name).suffix in SOURCE and not GENERATED.search(name):
            problems += lengths(name, (ROOT / name).read_text())
    if not sys.argv[1:]:
        for root in listed(["*/src/lib.rs", "*/src/main.rs"]):
            for circle in Crate(root).circles():
                if {line.split(" -> ")[0].removeprefix("std-adapter/") for line in circle} in KNOWN_CIRCLES:
                    continue
                problems.append("these files import each other in a circle:\n    " + "\n    ".join(circle))
    print("\n".join(problems) or "structure: no circle of imports, no long line, file or function")
    sys.exit(bool(problems))


if __name__ == "__main__":
    main()
