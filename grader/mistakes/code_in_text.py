"""Code that a text shows as it is written: round brackets for braces, an f inside of the quotes."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.tree import Replace

HELPER = "class Line:\n    n = 0\n\n    def text(self):\n"
IN_BRACKETS = re.compile(r"\((?P<code>(?:self\.)?[A-Za-z_]\w*(?:\.\w+)*)\)")
IN_BRACES = re.compile(r"\{(?P<code>(?:self\.)?[A-Za-z_]\w*(?:\.\w+)*)\}")


def _shown(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the string whose text came with code in it, in all files of the node."""
    brackets, braces = IN_BRACKETS.search(suspect.text), IN_BRACES.search(suspect.text)
    if brackets is None and braces is None:
        return None
    own = set(suspect.source.own_nodes)
    logged = {part for call in suspect.source.own_logs for part in ast.walk(call)}
    for node in suspect.source.all_nodes:
        if not isinstance(node, ast.Constant | ast.JoinedStr):
            continue
        module = suspect.source.module_of(node)
        if isinstance(module.parents.get(node), ast.JoinedStr | ast.FormattedValue):
            continue
        code = module.text.code(node)
        in_line = node in logged  # (the texts of the line itself have a mistake of their own)
        if brackets is not None and _is_filled(node, brackets, code) and not in_line:
            written = code.replace(brackets[0], f"{{{brackets['code']}}}", 1)
            written = written if isinstance(node, ast.JoinedStr) else f"f{written}"
            return _written(suspect, node, code, written, "brackets")
        plain = isinstance(node, ast.Constant) and isinstance(node.value, str)
        if plain and braces is not None and braces[0] in code and re.match(r"['\"]f?(?=\w)", code):
            inside = re.match(r"(?P<quote>['\"])f(?=[A-Z])", code)
            if (inside is None and node in own) or in_line:
                continue
            written = f"f{code}" if inside is None else f"f{code[0]}{code[2:]}"
            return _written(suspect, node, code, written, "" if inside is None else "inside")
    return None


def _is_filled(node: ast.expr, brackets: re.Match[str], code: str) -> bool:
    """Whether a text was meant to show a value, and has round brackets around it."""
    return brackets[0] in code and (isinstance(node, ast.JoinedStr) or "{" not in code)


def _written(
    suspect: Suspect, node: ast.expr, code: str, written: str, variant: str
) -> RecognisedMistake | None:
    if "\n" in code:
        return None
    found = suspect.finding("code_in_text", node, name=code, written=written)
    return replace(found, variant=variant)


_node = Family("node", links.PYTHON_STRINGS)
KINDS = (
    _node(
        "code_in_text",
        "text",
        msg("A text shows the name of a value instead of the value"),
        msg("Braces in a text are replaced by a value only if an f is directly before the quote."),
        msg("Write {written} instead of {name}."),
        whys={
            "brackets": msg("In an f-string, only braces {{ }} are replaced by the value in them."),
            "inside": msg(
                "The f of an f-string is before the quote. Behind the quote it is a letter of the text, "
                "and the braces are shown as they are."
            ),
        },
        behind={"run.wrong_text": _shown},
        fixed_by=(lines.written,),
        examples=(
            example(
                "brackets_for_braces",
                Replace(
                    NODE,
                    "class MyFirstNode",
                    f"{HELPER}        return f'Hello time: (self.n)'\n\n\nclass MyFirstNode",
                ),
                Replace(NODE, "self.counter_ = 0", "self.counter_ = 0\n        self.line = Line()"),
                Replace(NODE, "'Hello time: ' + str(self.counter_)", "self.line.text()"),
                fails="run.output",
            ),
            example(
                "f_behind_the_quote",
                Replace(
                    NODE,
                    "class MyFirstNode",
                    f"{HELPER}        return 'fHello time: {{self.n}}'\n\n\nclass MyFirstNode",
                ),
                Replace(NODE, "self.counter_ = 0", "self.counter_ = 0\n        self.line = Line()"),
                Replace(NODE, "'Hello time: ' + str(self.counter_)", "self.line.text()"),
                fails="run.output",
            ),
            example(
                "f_inside_of_the_quotes_of_helper",
                Replace(NODE, "'Hello time: ' + str(self.counter_)", "self.label()"),
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    def label(self):\n        return 'fHello time: {self.counter_}'\n\n"
                    "    def timer_callback",
                ),
                fails="run.output",
            ),
            example(
                "round_brackets_in_f_string_of_helper",
                Replace(NODE, "'Hello time: ' + str(self.counter_)", "self.label()"),
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    def label(self):\n        return f'Hello time: (self.counter_)'\n\n"
                    "    def timer_callback",
                ),
                fails="run.output",
            ),
        ),
    ),
)
