"""The mistake of a callback that clears the terminal, so that its lines do not stay."""

from __future__ import annotations

import ast
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import LOG_LINE, NODE, SILENT, STEP_LINE, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.clearing import calls_of_function, clearing
from grader.package.source.module import is_text
from grader.package.source.place import block_of


def _clears(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the line of the callback, or of what it calls, that clears the terminal."""
    source = suspect.source
    for found in clearing(source):
        if not found.only and not source.own_logs:
            continue  # (it writes the line itself: that has to be logged)
        code = source.module_of(found.statement).text.code(found.statement)
        at = found.statement
        name = " ".join(code.split())[:80]
        body = [s for s in found.function.body if not is_text(s)]
        if body == [found.statement] and found.function is not source.callback:
            calls = calls_of_function(source, found.function)
            if len(calls) != 1:
                continue
            at = calls[0]
        module = source.module_of(at)
        alone = len([s for s in block_of(module, at) if not is_text(s)]) == 1
        mistake = suspect.finding("clears_terminal", at, name=name)
        around = module.parents.get(at)
        whole = alone and isinstance(around, ast.If) and not around.orelse
        return replace(mistake, variant="if" if whole else "pass" if alone else "")
    return None


def _by_print(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the print() that only clears, beside the logger: it is no line that is to be logged."""
    source = suspect.source
    prints = [call for call, name in source.calls if name == "print"]
    found = clearing(source)
    only = {n for each in found if each.only for n in ast.walk(each.statement)}
    return _clears(suspect) if source.own_logs and prints and set(prints) <= only else None


_node = Family("node", links.LOGGING)
KINDS = (
    _node(
        "clears_terminal",
        "logger",
        msg("A line clears the terminal"),
        msg(
            "{name} erases what is on the terminal, or goes back over it: the lines that the node "
            "has logged do not stay."
        ),
        msg("Delete this line."),
        fixes={
            "if": msg("Delete this line and the if above it."),
            "pass": msg("Write pass instead of this line."),
        },
        behind={"run.erased": _clears, "run.print_not_logger": _by_print},
        fixed_by=(lines.deleted,),
        examples=(
            example(
                "clears_terminal",
                Replace(NODE, "import rclpy\nfrom", "import os\n\nimport rclpy\nfrom"),
                Replace(NODE, LOG_LINE, f"        os.system('clear')\n{LOG_LINE}"),
                fails="run.output",
            ),
            example(
                "erased_lines",
                Replace(
                    NODE,
                    STEP_LINE,
                    STEP_LINE + "        print('\\x1b[1A\\x1b[2K', end='', flush=True)\n",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
)
