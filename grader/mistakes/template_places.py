"""Mistakes with string.Template and replace(): the place in the text and the value have other names."""

from __future__ import annotations

import ast
import re
from collections.abc import Callable
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import DEAD, NODE, example
from grader.mistakes.fixes import lines, node_words
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.names import called_name, dotted
from grader.package.source.place import statement_at

PLACE = re.compile(r"\$(?:\{(\w{1,80})\}|(\w{1,80}))")
ANY_PLACE = re.compile(r"\{\w{0,80}\}|\$\{?\w{1,80}\}?|%\w|<\w{1,80}>|\[\w{1,80}\]")
FILLS = ("substitute", "safe_substitute")
IMPORTS = "import rclpy\nfrom"
TEXT = "'Hello time: ' + str(self.counter_)"


def _kept(suspect: Suspect) -> RecognisedMistake | None:
    """The text has a place of a Template, to which its only call gives no value."""
    places = {one or other for one, other in PLACE.findall(suspect.text)}
    calls = suspect.source.calls_of(*FILLS)
    if len(places) != 1 or len(calls) != 1:
        return None
    mistake = suspect.finding("template_place", calls[0])
    return _with_place(
        mistake, calls[0], suspect.source.module_of(calls[0]).text.code, places.pop()
    )


def _raised(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """substitute() on the line gets no value of the name that a place of the text has."""
    statement = statement_at(raised.module, raised.line)
    nodes = ast.walk(statement) if statement is not None else ()
    calls = [n for n in nodes if isinstance(n, ast.Call) and called_name(n) == "substitute"]
    if len(calls) != 1:
        return None
    mistake = raised.finding("template_place", at=calls[0])
    return _with_place(mistake, calls[0], raised.module.text.code, match["name"])


def _with_place(
    mistake: RecognisedMistake,
    call: ast.Call,
    code: Callable[[ast.expr | ast.keyword], str],
    place: str,
) -> RecognisedMistake | None:
    """Name what the call gives, and what it has to give."""
    words = {**mistake.words, "place": place}
    named = [keyword for keyword in call.keywords if keyword.arg is not None]
    if any(keyword.arg == place for keyword in named):
        return None
    if call.args or len(named) != 1 or len(call.keywords) != 1 or not place.isidentifier():
        return replace(mistake, words=words, variant="open")
    old, value = code(named[0]), code(named[0].value)
    new = f"{place}={value}"
    return replace(
        mistake, words={**words, "name": old, "written": new}, params={"name": old, "written": new}
    )


def _replaced(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the only call of replace() on the text that came: it did not change it."""
    found = [call for call in suspect.source.calls_of("replace") if len(call.args) == 2]
    made = found[0].func.value if found and isinstance(found[0].func, ast.Attribute) else None
    if made is None or len(found) != 1:
        return None
    texts = [getattr(v, "value", None) for v in node_words.values_of(suspect.source, made)]
    old = found[0].args[0]
    wanted = old.value if isinstance(old, ast.Constant) else None
    if texts != [suspect.text] or not isinstance(wanted, str):
        return None
    module = suspect.source.module_of(found[0])
    code = module.text.code(found[0])
    if wanted in suspect.text:
        if not isinstance(module.parents.get(found[0]), ast.Expr) or not dotted(made):
            return None
        written = f"{dotted(made)} = {code}"
        mistake = suspect.finding("replaced_nothing", found[0], name=code, written=written)
        return replace(mistake, variant="dropped")
    places = ANY_PLACE.findall(suspect.text)
    if len(places) != 1:
        return None
    quote = module.text.code(old)[-1]
    name, written = module.text.code(old), f"{quote}{places[0]}{quote}"
    return suspect.finding("replaced_nothing", old, name=name, written=written)


_node = Family("node", links.PYTHON_STRINGS)
KINDS = (
    _node(
        "template_place",
        "text",
        msg("A Template gets no value for a place of its text"),
        msg(
            "The place ${place} takes the value that is given under the name {place}. "
            "safe_substitute() leaves a place without a value as it is, and substitute() raises "
            "KeyError."
        ),
        msg("Write {written} instead of {name} in the () of the call."),
        fixes={"open": msg("Give the call a value under the name {place}: {place}=… in its ().")},
        behind={"run.wrong_text": _kept},
        raised={r"KeyError: '(?P<name>\w{1,120})'": _raised},
        fixed_by=(lines.written,),
        examples=(
            example(
                "template_of_other_name",
                Replace(NODE, IMPORTS, f"from string import Template\n\n{IMPORTS}"),
                Replace(
                    NODE,
                    TEXT,
                    "Template('Hello time: $count').safe_substitute(counter=self.counter_)",
                ),
                fails="run.output",
            ),
            example(
                "substitute_of_other_name",
                Replace(NODE, IMPORTS, f"from string import Template\n\n{IMPORTS}"),
                Replace(
                    NODE,
                    TEXT,
                    "Template('Hello time: $count').substitute(counter=self.counter_)",
                ),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "replaced_nothing",
        "text",
        msg("replace() does not change the text that is logged"),
        msg("replace() looks for exactly the text that it gets, which is not in this one."),
        msg("Write {written} instead of {name}."),
        whys={
            "dropped": msg("replace() returns a new text, and leaves the one that it is called on.")
        },
        fixes={"dropped": msg("Keep the new text: write {written} instead of {name}.")},
        behind={"run.wrong_text": _replaced},
        fixed_by=(lines.written,),
        examples=(
            example(
                "replace_of_other_name",
                Replace(
                    NODE,
                    TEXT,
                    "'Hello time: {n}'.replace('{count}', str(self.counter_))",
                ),
                fails="run.output",
            ),
        ),
    ),
)
