"""Mistakes with string.Template and replace(): the place in the text and the value have other names."""

from __future__ import annotations

import ast
import re
from collections.abc import Callable
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import DEAD, LOG_LINE, NODE, example
from grader.mistakes.fixes import lines, node_words
from grader.mistakes.fixes.case import Case
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect
from grader.package.edit.files import Files
from grader.package.edit.tree import Replace
from grader.package.source.counter import parts_of_callback
from grader.package.source.module import Function
from grader.package.source.names import called_name, dotted
from grader.package.source.place import function_at, statement_at

PLACE = re.compile(r"\$(?:\{(\w{1,80})\}|(\w{1,80}))")
ANY_PLACE = re.compile(r"\{\w{0,80}\}|\$\{?\w{1,80}\}?|%\w|<\w{1,80}>|\[\w{1,80}\]")
DOLLAR = re.compile(r"\$\{[^{}\n]{1,200}\}")
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


def _dollar(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the f-string whose braces have a $ before them, which is in the text that came."""
    logged = [node for part in parts_of_callback(suspect.source) for node in ast.walk(part)]
    for text in (node for node in logged if isinstance(node, ast.JoinedStr)):
        code = suspect.source.module_of(text).text.code(text)
        found = DOLLAR.findall(code)
        if len(found) == 1 and code.count("$") == 1 and "$" in suspect.text:
            return suspect.finding("dollar", text, name=found[0], written=found[0][1:])
    return None


def _overwritten(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a line that keeps the filled text in the attribute that had the places."""
    for function in parts_of_callback(suspect.source):
        for node in ast.walk(function):
            target = _filled(node)
            if isinstance(node, ast.stmt) and target:
                return _keeps(suspect.finding("template_overwritten", node), target, function)
    return None


def _overwritten_raised(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The text that % fills on the line is the one of the last call."""
    del match
    node = statement_at(raised.module, raised.line)
    function = function_at(raised.module, raised.line)
    target = _filled(node) if node is not None else ""
    if not target or function is None:
        return None
    return _keeps(raised.finding("template_overwritten", at=node), target, function)


def _keeps(mistake: RecognisedMistake, target: str, function: Function) -> RecognisedMistake:
    used = {n.id for n in ast.walk(function) if isinstance(n, ast.Name)}
    name = next(name for name in ("line", "filled", "filled_text") if name not in used)
    words = {**mistake.words, "name": target, "written": name}
    return replace(mistake, params={"name": target, "written": name}, words=words)


def _filled(node: ast.AST) -> str:
    """Return the attribute that an assignment fills and keeps: `self.a = self.a.replace(…)`."""
    if not isinstance(node, ast.Assign) or len(node.targets) != 1:
        return ""
    target, value = dotted(node.targets[0]), node.value
    filled: ast.expr | None = None
    if isinstance(value, ast.Call) and isinstance(value.func, ast.Attribute):
        filled = value.func.value if value.func.attr in ("replace", "format", *FILLS) else None
    elif isinstance(value, ast.BinOp) and isinstance(value.op, ast.Mod):
        filled = value.left
    return target if target.startswith("self.") and filled and dotted(filled) == target else ""


def _kept_apart(case: Case) -> Files | None:
    """Give the filled text a name of its own, in the line that fills it and in those below it."""
    module, line = case.module, case.finding.line
    target, name = (str(case.finding.params.get(key, "")) for key in ("name", "written"))
    function = function_at(module, line) if module is not None else None
    if module is None or line is None or function is None:
        return None
    uses = [n for n in ast.walk(function) if isinstance(n, ast.Attribute) and dotted(n) == target]
    changed = [n for n in uses if n.lineno > line or isinstance(n.ctx, ast.Store)]
    return case.changed(module, *(module.text.swap(use, name) for use in changed))


_node = Family("node", links.PYTHON_STRINGS)
KINDS = (
    _node(
        "dollar",
        "text",
        msg("An f-string has a $ before its braces"),
        msg(
            "In an f-string, the braces alone stand for a value. ${{…}} is the form of other languages, "
            "such as JavaScript: here the $ is a part of the text."
        ),
        msg("Write {written} instead of {name}, without the $."),
        behind={"run.wrong_text": _dollar},
        fixed_by=(lines.written,),
        examples=(
            example(
                "dollar_in_f_string",
                Replace(NODE, TEXT, "f'Hello time: ${self.counter_}'"),
                fails="run.output",
            ),
        ),
    ),
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
        "template_overwritten",
        "text",
        msg("The text loses the place for the number when it is filled"),
        msg(
            "{name} has a place for the number. This line puts the number there and keeps the result "
            "in {name}, so that the next call finds no place in it."
        ),
        msg(
            "Keep the result under another name: write {written} instead of {name} left of the =, and "
            "in the lines below that use the result."
        ),
        behind={"run.constant_counter": _overwritten},
        raised={
            r"TypeError: not all arguments converted during string formatting": _overwritten_raised
        },
        fixed_by=(_kept_apart,),
        examples=(
            example(
                "template_overwritten",
                Replace(
                    NODE,
                    "self.counter_ = 0",
                    "self.text = 'Hello time: NN'\n        self.counter_ = 0",
                ),
                Replace(
                    NODE,
                    LOG_LINE,
                    f"        self.text = self.text.replace('NN', str(self.counter_))\n{LOG_LINE}",
                ),
                Replace(NODE, TEXT, "self.text"),
                fails="run.output",
            ),
            example(
                "format_overwritten",
                Replace(
                    NODE,
                    "self.counter_ = 0",
                    "self.text = 'Hello time: {}'\n        self.counter_ = 0",
                ),
                Replace(
                    NODE,
                    LOG_LINE,
                    f"        self.text = self.text.format(self.counter_)\n{LOG_LINE}",
                ),
                Replace(NODE, TEXT, "self.text"),
                fails="run.output",
            ),
            example(
                "percent_overwritten",
                Replace(
                    NODE,
                    "self.counter_ = 0",
                    "self.text = 'Hello time: %d'\n        self.counter_ = 0",
                ),
                Replace(
                    NODE, LOG_LINE, f"        self.text = self.text % self.counter_\n{LOG_LINE}"
                ),
                Replace(NODE, TEXT, "self.text"),
                fails="run.output",
                blocks=("run.period", "run.interrupt"),
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
