"""Mistakes in which a line that is needed is a comment."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.counted import counter_in
from grader.mistakes.example import DEAD, LOG, NODE, SILENT, STEP_LINE, example
from grader.mistakes.fixes import node_words
from grader.mistakes.kind import Family
from grader.mistakes.recognised import OWN_ATTRIBUTE, Raised, RecognisedMistake, Suspect, of_self
from grader.package.edit.tree import Replace
from grader.package.source.commented import commented
from grader.package.source.counter import targets_of
from grader.package.source.hidden_def import HiddenDef, hidden_def
from grader.package.source.module import Function
from grader.package.source.names import last_part
from grader.package.source.node import NodeSource
from grader.report.model import Where

NAME_ERROR = r"(?:NameError: name|UnboundLocalError: .{0,60}variable) '(?P<name>\w{1,120})'"
NOT_INITIALIZED = r"NotInitializedException"
SPIN = r"(?:rclpy\.)?(?:spin|spin_once)\(|\w+\.spin\("
QUOTES = r"[ \t'\"]{0,9}"
LOGGED = r"self\.get_logger\(\)\.\w+\(|self\.\w+\.info\("


def _in_comment(
    source: NodeSource, pattern: str, within: Function | None = None
) -> tuple[Where, str] | None:
    """Return where a comment has a statement that begins with a pattern, and its code."""
    for module in source.modules:
        for found in commented(module.text, pattern):
            if within is not None and not (
                module.has(within) and within.lineno < found.line <= (within.end_lineno or 0) + 1
            ):
                continue
            return Where(file=module.path, line=found.line), found.code
    return None


def _found(
    suspect: Suspect, pattern: str, within: Function | None = None
) -> RecognisedMistake | None:
    found = _in_comment(suspect.source, pattern, within)
    return suspect.finding("commented_out", found[0], written=found[1]) if found else None


def _raised(raised: Raised, pattern: str) -> RecognisedMistake | None:
    found = _in_comment(raised.source, pattern)
    if found is None:
        return None
    return replace(raised.finding("commented_out", written=found[1]), where=found[0])


def _silent(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the timer, or for the callback's line that logs."""
    source, callback = suspect.source, suspect.source.callback
    if not source.timers and not source.calls_of("create_timer"):
        return _found(suspect, r"(?:self\.\w+[ \t]*=[ \t]*)?self\.create_timer\(")
    if callback is None or source.logs(callback) or source.prints(callback):
        return None
    return _found(suspect, LOGGED, callback)


def _ends(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the line that spins."""
    if any(last_part(name).startswith("spin") for _, name in suspect.source.calls):
        return None
    return _found(suspect, SPIN)


def _constant(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the line that adds to the counter."""
    counter = counter_in(suspect)
    if counter is None or counter.added or counter.set:
        return None
    name = re.escape(counter.name)
    return _found(suspect, rf"{name}[ \t]*(?:\+=|=[ \t]*{name}[ \t]*\+)", suspect.source.callback)


def _attribute(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    name = match["name"]
    if not of_self(raised, match) or f"self.{name}" in _assigned(raised.source):
        return None
    found = hidden_def(raised.source.module.text, name, raised.source.class_body)
    if found is not None:
        return _def(raised, name, found)
    return _raised(raised, rf"self\.{name}[ \t]*=(?!=)|def {name}\(")


def _def(raised: Raised, name: str, found: HiddenDef) -> RecognisedMistake:
    """Return the mistake of a method whose def is in a comment, or in a text in three quotes."""
    mistake = raised.finding("commented_out", written=found.code, name=name)
    words = {**mistake.words, "line": str(found.last), "wanted": str(found.first)}
    variant = "text" if found.is_text else "def" if found.fixed is not None else "def_lines"
    where = Where(file=raised.source.module.path, line=found.line)
    return replace(mistake, where=where, variant=variant, words=words)


def _assigned(source: NodeSource) -> set[str]:
    return {
        name
        for node in source.own_nodes
        if isinstance(node, ast.Assign | ast.AnnAssign)
        for name in targets_of(node)
    }


def _name(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    name = match["name"]
    found = _raised(raised, rf"{name}[ \t]*=(?!=)|(?:from|import)[ \t][^#]*\b{name}\b")
    return found or _assigned_in_text(raised, name)


def _assigned_in_text(raised: Raised, name: str) -> RecognisedMistake | None:
    """The line that gives the name its value is in a text that nothing uses."""
    module = raised.module
    for node in module.nodes:
        text = node.value if isinstance(node, ast.Expr) else None
        if not isinstance(text, ast.Constant) or not isinstance(text.value, str):
            continue
        for number in range(text.lineno, (text.end_lineno or text.lineno) + 1):
            match = re.fullmatch(
                rf"{QUOTES}({name}[ \t]*=[^='\"]{{1,80}}?){QUOTES}", module.line(number)
            )
            if match is not None:
                found = raised.finding("commented_out", written=match[1].strip(), name=name)
                where = Where(file=module.path, line=number)
                return replace(found, where=where, variant="assigned")
    return None


def _not_initialized(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    if raised.source.calls_of("init"):
        return None
    return _raised(raised, r"rclpy\.init\(")


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "commented_out",
        "file",
        msg("A line that the node needs is in a comment or in a text"),
        msg("Python does not run what is behind a # on the same line."),
        msg("Write {written} on a line of its own, without # before it."),
        whys={
            "text": msg("What is between three quotes is a text, and Python does not run it."),
            "assigned": msg("What is between quotes is a text, and Python does not run it."),
        },
        fixes={
            "def": msg(
                "Write {written} on a line of its own, without # before it, and in the column of the "
                "other methods: the lines below it are its block."
            ),
            "def_lines": msg(
                "Write {written} on a line of its own, without # before it. Do the same with the "
                "lines of its block, if they are comments too."
            ),
            "assigned": msg("Write {written} on a line of its own, outside of the text in quotes."),
            "text": msg(
                "Delete the three quotes in line {wanted} and in line {line}: the lines between them, "
                "with {written}, are code."
            ),
        },
        raised={
            OWN_ATTRIBUTE: _attribute,
            NAME_ERROR: _name,
            NOT_INITIALIZED: _not_initialized,
        },
        behind={
            "run.no_lines": _silent,
            "run.exits_at_once": _ends,
            "run.constant_counter": _constant,
        },
        fixed_by=(node_words.uncommented, node_words.shown_def),
        examples=(
            example(
                "step_in_comment",
                Replace(NODE, f"{LOG}\n{STEP_LINE}", f"{LOG}  # then count: self.counter_ += 1\n"),
                fails="run.output",
            ),
            example(
                "timer_in_comment",
                Replace(NODE, "self.create_timer(", "# self.create_timer("),
                fails="run.output",
                blocks=SILENT,
            ),
            example(
                "counter_in_comment",
                Replace(NODE, "        self.counter_ = 0", "        # self.counter_ = 0"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "spin_in_comment",
                Replace(
                    NODE, "        rclpy.spin(node)", "        # rclpy.spin(node)\n        pass"
                ),
                fails="run.starts",
            ),
            example(
                "init_in_comment",
                Replace(NODE, "    rclpy.init(args=args)", "    # rclpy.init(args=args)"),
                fails="run.starts",
            ),
            example(
                "import_in_comment",
                Replace(NODE, "from rclpy.node", "# from rclpy.node"),
                fails="run.starts",
            ),
        ),
    ),
)
