#!/usr/bin/env python3
"""Lists the floating-point operations that may compute with an undefined value, in LLVM's optimised code (`--emit=llvm-ir`).

    undefined_inputs.py FILE.ll...

The number of an `Option<f32>` that is `None` is undefined, and LLVM may compute with it before the test for `Some`. The result is thrown
away, so no answer is wrong. But whatever the stack holds then enters the operation, and a product of a subnormal number takes more than a
hundred cycles. The time of the certified filter doubled that way.

A value is undefined if it merges an undefined constant with others (phi, select), or is moved from such a value. Functions are followed one
by one. Numbers in memory and arguments count as defined, and so do lanes of which the vectoriser knows that no one reads them.
"""

import re
import sys
from pathlib import Path

NAME = r'%(?:"[^"]*"|[\w.$-]+)'
VALUE = rf"(?:{NAME}|\bundef\b|\bpoison\b)"
ASSIGNMENT = re.compile(rf"\s+({NAME}) = (?:tail |musttail |notail )?([a-z]+) (.*)")
USED = re.compile(VALUE)
ARITHMETIC = {"fadd", "fsub", "fmul", "fdiv", "frem", "fcmp", "fptrunc", "fpext", "fptosi", "fptoui"}
# The operands that such an instruction moves into its result; of a vector that an element is put into, only the element.
MOVES = {
    "phi": lambda rest: re.findall(rf"\[ ({VALUE}), ", rest),
    "select": lambda rest: re.findall(rf"({VALUE})(?:,|$)", rest.split(", ", 1)[1]),
    "insertelement": lambda rest: USED.findall(rest.split(", ")[-2]),
    "shufflevector": lambda rest: re.findall(NAME, rest),
    **dict.fromkeys(["freeze", "fneg", "bitcast", "extractelement", "extractvalue", "insertvalue"], lambda rest: re.findall(NAME, rest)),
}
# These functions of LLVM's move a number, too.
MOVED_BY_CALL = ("llvm.fabs", "llvm.copysign")


class Function:
    def __init__(self, name):
        self.name = name
        self.moves = {}
        self.operations = []

    def add(self, line):
        found = ASSIGNMENT.match(line)
        if not found:
            return
        name, operation, rest = found.groups()
        # Lanes of a constant lie in memory.
        rest = re.sub(r"<[^<>]*,[^<>]*>", "constant", rest.split(", !")[0].split(" #")[0])
        called = re.search(r"@(llvm\.[\w.]+)\(", rest) if operation == "call" else None
        if operation in MOVES:
            self.moves[name] = MOVES[operation](rest)
        elif called and called[1].startswith(MOVED_BY_CALL):
            self.moves[name] = USED.findall(rest)
        elif operation in ARITHMETIC or (called and re.search(r"\b(?:float|double)\b", rest)):
            self.operations.append((line.strip(), USED.findall(rest)))

    def findings(self):
        undefined = {"undef", "poison"}
        before = 0
        while before < len(undefined):
            before = len(undefined)
            undefined |= {name for name, values in self.moves.items() if not undefined.isdisjoint(values)}
        return [line for line, values in self.operations if not undefined.isdisjoint(values)]


def functions(text):
    function = None
    for line in text.splitlines():
        if line.startswith("define "):
            function = Function(re.search(r'@("[^"]*"|[\w.$]+)\(', line)[1])
        elif line.startswith("}") and function:
            yield function
            function = None
        elif function:
            function.add(line)


def main(paths):
    operations, findings = 0, []
    for path in paths:
        for function in functions(Path(path).read_text()):
            operations += len(function.operations)
            findings += [(function.name, line) for line in function.findings()]
    for name, line in findings:
        print(f"{name}:\n    {line}")
    if operations == 0:
        sys.exit("undefined_inputs.py: the files have no floating-point operation")
    if findings:
        sys.exit(f"undefined_inputs.py: {len(findings)} of {operations} floating-point operations may compute with an undefined value")
    print(f"undefined_inputs.py: none of {operations} floating-point operations computes with an undefined value")


main(sys.argv[1:])
