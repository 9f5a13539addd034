"""All mutants in one program: rewrites core's sources so that each mutant sleeps behind a condition that a number wakes.

`cargo mutants` builds the tests anew for each of its 1,700 mutants, which takes more than a day. Built once, with every mutant in it
("mutant schemata", Untch, Offutt, Harrold 1993), they are run one after the other in an hour.
"""

import json
from collections import defaultdict
from pathlib import Path

import tree_sitter_rust
from tree_sitter import Language, Parser

PARSER = Parser(Language(tree_sitter_rust.language()))
COMPARISONS = ("==", "!=", "<", "<=", ">", ">=")

SWITCH = """
#[doc(hidden)]
pub mod mutant {
    use core::sync::atomic::{AtomicU32, Ordering};
    pub static AWAKE: AtomicU32 = AtomicU32::new(0);
    #[inline(always)]
    pub fn is(number: u32) -> bool { AWAKE.load(Ordering::Relaxed) == number }
}
"""

# Before `main`, because the test harness has it.
CHOICE = """
#[used]
#[unsafe(link_section = ".init_array")]
static CHOOSE_MUTANT: extern "C" fn() = {
    extern crate std;
    extern "C" fn choose() {
        if let Some(number) = std::env::var("MUTANT").ok().and_then(|number| number.parse().ok()) {
            SWITCH::mutant::AWAKE.store(number, core::sync::atomic::Ordering::Relaxed);
        }
    }
    choose
};
"""


def awake(number):
    return f"crate::mutant::is({number})"


class Source:
    """One source file and the mutants that it is to hold, by number."""

    def __init__(self, text, wanted):
        self.text = text
        self.unplaced = {}
        lines = text.decode().split("\n")
        starts = [0]
        for line in lines:
            starts.append(starts[-1] + len(line.encode()) + 1)

        def offset(place):
            line = lines[place["line"] - 1]
            return starts[place["line"] - 1] + len(line[: place["column"] - 1].encode())

        self._find(PARSER.parse(text).root_node)
        groups = defaultdict(list)
        for number, mutant in wanted:
            span = [offset(mutant["span"][end]) for end in ("start", "end")]
            node = self._node(mutant["genre"], *span)
            modifier = self._constant(node) if node else None
            if node is None:
                self.unplaced[number] = "not found"
            elif modifier == "constant":
                self.unplaced[number] = "a constant"
            else:
                if modifier is not None:
                    groups[modifier.start_byte, modifier.end_byte] = [(0, None, modifier)]
                groups[node.start_byte, node.end_byte].append((number, mutant, node))
        self.groups = sorted(groups.items(), key=lambda group: (group[0][0], -group[0][1]))

    def _find(self, root):
        self.operators, self.signs, self.bodies, self.arms = {}, {}, [], {}
        stack = [root]
        while stack:
            node = stack.pop()
            stack += node.children
            if node.type in ("binary_expression", "compound_assignment_expr"):
                self.operators[node.child_by_field_name("operator").start_byte] = node
            elif node.type == "unary_expression":
                self.signs[node.start_byte] = node
            elif node.type == "function_item" and node.child_by_field_name("body"):
                self.bodies.append(node.child_by_field_name("body"))
            elif node.type == "match_arm":
                self.arms[node.start_byte] = node

    def _node(self, genre, start, end):
        match genre:
            case "BinaryOperator":
                return self.operators.get(start)
            case "UnaryOperator":
                return self.signs.get(start)
            case "FnValue":
                around = [body for body in self.bodies if body.start_byte <= start and end <= body.end_byte]
                return max(around, key=lambda body: body.start_byte, default=None)
            case "MatchArm":
                return self.arms.get(start)
            case "MatchArmGuard":
                for arm in self.arms.values():
                    guard = arm.child_by_field_name("pattern").child_by_field_name("condition")
                    if guard is not None and guard.start_byte == start:
                        return arm
        return None

    @staticmethod
    def _constant(node):
        """`const` of the function around it, which has to go; "constant" where there is no function."""
        while node is not None:
            if node.type in ("const_item", "static_item", "array_type", "const_block"):
                return "constant"
            if node.type == "function_item":
                for child in node.children:
                    if child.type == "function_modifiers":
                        return next((word for word in child.children if word.type == "const"), None)
                return None
            node = node.parent
        return None

    def rewritten(self):
        return self._between(0, len(self.text))

    def _between(self, start, end, but=None):
        """This part of the text with everything rewritten in it, except the node `but` itself."""
        parts, at = [], start
        for (first, last), group in self.groups:
            if first >= at and last <= end and (first, last) != but:
                parts += [self.text[at:first].decode(), self._mutated((first, last), group)]
                at = last
        return "".join(parts) + self.text[at:end].decode()

    def _part(self, node):
        return self._between(node.start_byte, node.end_byte)

    def _mutated(self, place, group):
        node = group[0][2]
        match node.type:
            case "const":
                return ""
            case "binary_expression":
                return self._operation(node, group)
            case "compound_assignment_expr":
                left, right, operator = self._operands(node)
                chosen = "".join(
                    f"if {awake(n)} {{ {left.text.decode()} {m['replacement']} r__ }} else " for n, m, _ in group
                )
                whole = f"{left.text.decode()} {operator} r__"
                return f"(match {self._part(right)} {{ r__ => {chosen}{{ {whole} }} }})"
            case "unary_expression":
                sign = self.text[node.start_byte : node.start_byte + 1].decode()
                return f"(match {self._part(node.children[-1])} {{ v__ => if {awake(group[0][0])} {{ v__ }} else {{ {sign}v__ }} }})"
            case "block":
                returns = "".join(f"if {awake(n)} {{ return {m['replacement']}; }} " for n, m, _ in group)
                return "{ " + returns + self._between(node.start_byte + 1, node.end_byte, place)
            case "match_arm":
                return self._arm(node, group)
        raise ValueError(node.type)

    @staticmethod
    def _operands(node):
        left, right, operator = (node.child_by_field_name(name) for name in ("left", "right", "operator"))
        return left, right, operator.text.decode()

    def _operation(self, node, group):
        left, right, operator = self._operands(node)
        left, right = self._part(left), self._part(right)
        if operator in ("&&", "||"):
            # The right side is asked only if the left one leaves the answer open.
            test = "!=" if operator == "&&" else "=="
            return f"(match ({left}) {{ l__ => if l__ {test} {awake(group[0][0])} {{ {right} }} else {{ l__ }} }})"
        star = ""
        if operator in COMPARISONS:
            left, right, star = f"&({left})", f"&({right})", "*"
        chosen = "".join(f"if {awake(n)} {{ {star}l__ {m['replacement']} {star}r__ }} else " for n, m, _ in group)
        return f"(match ({left}, {right}) {{ (l__, r__) => {chosen}{{ {star}l__ {operator} {star}r__ }} }})"

    def _arm(self, arm, group):
        pattern = arm.child_by_field_name("pattern")
        guard = pattern.child_by_field_name("condition")
        head = self.text[arm.start_byte : guard.start_byte if guard else pattern.end_byte].decode().rstrip()
        condition = self._part(guard) if guard else "true"
        head = head.removesuffix("if").rstrip() if guard else head
        for number, mutant, _ in group:
            if mutant["replacement"] == "true":
                condition = f"({awake(number)} || ({condition}))"
            else:
                condition = f"(!{awake(number)} && ({condition}))"
        return f"{head} if {condition} " + self._between(pattern.end_byte, arm.end_byte)


def rewrite(original, copy, mutants, left_out):
    """Writes the sources of `original` with the mutants in them to `copy`; why which could not be placed."""
    by_file = {mutant["file"]: [] for mutant in mutants}
    for number, mutant in enumerate(mutants, 1):
        if number not in left_out:
            by_file[mutant["file"]].append((number, mutant))
    unplaced = {}
    for file, wanted in by_file.items():
        source = Source((Path(original) / file).read_bytes(), wanted)
        (Path(copy) / file).write_text(source.rewritten())
        unplaced |= source.unplaced
    library = "core/src/lib.rs"
    text = (Path(original) / library).read_text().replace("#![forbid(unsafe_code)]", "")
    choice = "\n#[cfg(test)]" + CHOICE.replace("SWITCH", "crate")
    (Path(copy) / library).write_text(text + SWITCH + choice)
    promises = "verification/tests/promises/main.rs"
    text = (Path(original) / promises).read_text()
    (Path(copy) / promises).write_text(text + CHOICE.replace("SWITCH", "selvedge_core"))
    return unplaced


def load(path):
    return json.loads(Path(path).read_text())
