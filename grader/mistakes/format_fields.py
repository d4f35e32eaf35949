"""Mistakes in the places of a text for format() and %: names and numbers for which no value is given."""

from __future__ import annotations

import ast
import re
import string
from collections.abc import Iterator
from dataclasses import dataclass, replace

from grader.base.i18n.message import msg
from grader.base.shown import shown
from grader.mistakes import links
from grader.mistakes.example import DEAD, NODE, example
from grader.mistakes.fixes import lines, node_words
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.package.edit.tree import Replace
from grader.package.source.counter import targets_of
from grader.package.source.module import Module
from grader.package.source.names import called_name, dotted, last_part
from grader.package.source.place import function_at, statement_at
from grader.package.source.readable import is_readable

NO_KEY = r"KeyError: (?P<name>'[^'\n]{1,120}'|\"[^\"\n]{1,120}\")"
NO_INDEX = r"IndexError: Replacement index \d{1,9} out of range"
TEXT = "'Hello time: ' + str(self.counter_)"
MOST_CODE = 80  # characters of a piece of code that a text shows


@dataclass(frozen=True)
class Format:
    """A call of format on a text in the code: the code of the text, and its places."""

    call: ast.Call
    made: ast.expr
    text: str
    fields: tuple[str, ...]

    @property
    def numbers(self) -> list[int]:
        """The places with a number."""
        return [int(field) for field in self.fields if field.isdecimal()]

    @property
    def is_plain(self) -> bool:
        """Whether the call gives nothing with * or **."""
        starred = any(isinstance(a, ast.Starred) for a in self.call.args)
        return not starred and all(k.arg for k in self.call.keywords)


def _formats(raised: Raised) -> Iterator[Format]:
    statement = statement_at(raised.module, raised.line)
    for call in ast.walk(statement) if statement is not None else ():
        if not isinstance(call, ast.Call) or called_name(call) != "format":
            continue
        made = call.func.value if isinstance(call.func, ast.Attribute) else None
        made = text_of(raised, made) if dotted(made or call) else made
        text = raised.source.module_of(made).text if made is not None else raised.module.text
        code = text.code(made) if made is not None else ""
        plain = text.plain_string(made)
        if made is None or plain is None or "\n" in code:
            continue
        try:
            fields = tuple(f for _, f, _, _ in string.Formatter().parse(plain) if f is not None)
        except ValueError:
            continue
        found = Format(call, made, code, fields)
        if found.is_plain:
            yield found


def text_of(raised: Raised, named: ast.expr | None) -> ast.expr | None:
    """Return the text that a name gets, if that is its only value in its function or its module."""
    if not isinstance(named, ast.Name):
        return _text_elsewhere(raised, named) if named is not None else None
    name = named
    function = function_at(raised.module, raised.line)
    values = [
        n.value
        for n in (ast.walk(function) if function is not None else ())
        if isinstance(n, ast.Assign | ast.AugAssign) and name.id in targets_of(n)
    ]
    values = values or [
        n.value
        for n in raised.module.tree.body
        if isinstance(n, ast.Assign) and name.id in targets_of(n)
    ]
    if not values:
        return _text_elsewhere(raised, name)
    return values[0] if len(values) == 1 else None


def _text_elsewhere(raised: Raised, named: ast.expr) -> ast.expr | None:
    """Return the only value of an attribute, or of a variable of an imported module."""
    plain, name = isinstance(named, ast.Name), last_part(dotted(named))
    known = raised.source.beside if plain else (*raised.source.modules, *raised.source.beside)
    values = [
        n.value
        for module in known
        for n in (module.tree.body if plain else module.nodes)
        if isinstance(n, ast.Assign | ast.AugAssign | ast.AnnAssign)
        and name in map(last_part, targets_of(n))
    ]
    return values[0] if len(values) == 1 else None


def _named(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A place of the text has a name for which the call of format gives no value."""
    name = match["name"][1:-1]
    for found in _formats(raised):
        code = raised.module.text.code(found.call)
        wrong = [field for field in found.fields if re.split(r"[.\[]", field)[0] == name]
        if not wrong or "\n" in code:
            continue
        args, keywords = found.call.args, found.call.keywords
        direct = found.made in ast.walk(found.call)
        if direct and not args and not keywords and all(_is_known(raised, f) for f in found.fields):
            return _finding(raised, found, code, f"f{found.text}", "f_string")
        if len(found.fields) == 1 and len(args) == 1 and not keywords:
            place = re.search(rf"\{{{re.escape(wrong[0])}([^{{}}]*)\}}", found.text)
            if place is not None:
                return _finding(raised, found, place[0], f"{{{place[1]}}}", "empty")
        given = keywords[0].arg if len(keywords) == 1 and not args else None
        if len(found.fields) == 1 and given and wrong[0] != name:
            place = re.search(rf"\{{{re.escape(wrong[0])}([^{{}}]*)\}}", found.text)
            if place is not None:
                return _finding(raised, found, place[0], f"{{{given}{place[1]}}}", "given")
        if len(found.fields) == 1 and len(keywords) == 1 and not args and wrong[0] == name:
            old = f"{keywords[0].arg}={raised.module.text.code(keywords[0].value)}"
            new = f"{name}={raised.module.text.code(keywords[0].value)}"
            if name.isidentifier() and raised.module.text.code(keywords[0]) == old:
                return _finding(raised, found, old, new, "keyword")
        return _finding(raised, found, f"{{{wrong[0]}}}", "", "value")
    return _of_percent(raised, name)


def _is_known(raised: Raised, field: str) -> bool:
    """Whether the code at this place can read what a place of the text names."""
    function = function_at(raised.module, raised.line)
    return is_readable(raised.source, raised.module, function, field)


def _numbered(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The places of the text count from 1, or one has a number for which there is no value."""
    del match
    for found in _formats(raised):
        count = len(found.call.args)
        if not count or len(found.numbers) != len(found.fields):
            if count and not found.numbers and set(found.fields) == {""}:
                return _finding(raised, found, found.text, str(len(found.fields)), "too_many")
            continue
        if count == len(found.numbers) == 1:
            new = found.text.replace(f"{{{found.fields[0]}", "{0")
            return _finding(raised, found, found.text, new, "counted")
        if sorted(set(found.numbers)) != list(range(1, count + 1)):
            return _finding(raised, found, found.text, str(count - 1), "highest")
        new = re.sub(r"\{(\d{1,3})", lambda m: f"{{{int(m[1]) - 1}", found.text)
        return _finding(raised, found, found.text, new, "counted")
    return None


def _of_percent(raised: Raised, name: str) -> RecognisedMistake | None:
    """A text with %(name)d gets a dict without this name."""
    statement = statement_at(raised.module, raised.line)
    for part in ast.walk(statement) if statement is not None else ():
        if not isinstance(part, ast.BinOp) or not isinstance(part.op, ast.Mod):
            continue
        text = raised.module.text.plain_string(part.left)
        keys = _keys(raised.module, part.right)
        if text is None or f"%({name})" not in text or keys is None or len(keys) != 1:
            continue
        if len(re.findall(r"%\(\w+\)", text)) == 1:
            found = raised.finding(
                "format_value_missing", at=part, name=keys[0], written=repr(name)
            )
            words = {**found.words, "place": f"%({name})"}
            return replace(found, words=words, variant="key")
    return _of_mapping(raised, name)


def _of_mapping(raised: Raised, name: str) -> RecognisedMistake | None:
    """A text with %(name)d, or one for format_map(), gets values of which none has this name."""
    statement = statement_at(raised.module, raised.line)
    for part in ast.walk(statement) if statement is not None else ():
        made, given, place = None, None, f"{{{name}}}"
        if isinstance(part, ast.BinOp) and isinstance(part.op, ast.Mod):
            made, given, place = part.left, part.right, f"%({name})"
        elif isinstance(part, ast.Call) and called_name(part) == "format_map" and part.args:
            made = part.func.value if isinstance(part.func, ast.Attribute) else None
            given = part.args[0]
        if made is None or given is None or not isinstance(part, ast.expr):
            continue
        texts = [getattr(v, "value", None) for v in node_words.values_of(raised.source, made)]
        code = raised.module.text.code(given)
        pattern = rf"%\({re.escape(name)}\)|\{{{re.escape(name)}[}}!:.\[]"
        is_text = len(texts) == 1 and isinstance(texts[0], str) and re.search(pattern, texts[0])
        if not is_text or "\n" in code or len(code) > MOST_CODE:
            continue
        found = raised.finding("format_value_missing", at=part, name=code)
        words = {**found.words, "place": place, "key": repr(name)}
        known = [v for v in node_words.values_of(raised.source, given) if isinstance(v, ast.Dict)]
        keys = _keys(raised.module, known[0]) if len(known) == 1 else None
        words["found"] = keys[0] if keys is not None and len(keys) == 1 else ""
        return replace(found, words=words, variant="one_key" if words["found"] else "mapping")
    return None


def _keys(module: Module, given: ast.expr) -> list[str] | None:
    if not isinstance(given, ast.Dict):
        return None
    if not all(given.keys):
        return None  # (** brings names that are not in the code)
    return [module.text.code(key) for key in given.keys if key is not None]


def _finding(
    raised: Raised, found: Format, name: str, written: str, variant: str
) -> RecognisedMistake:
    params = {"name": shown(name), "written": shown(written)}
    at = found.made if variant in ("empty", "given", "counted", "highest") else found.call
    mistake = raised.finding("format_value_missing", at=at, params=params)
    place = next((f for f in found.fields if not f.isdecimal()), "")
    words = {**mistake.words, "place": shown(place)}
    return replace(mistake, words=words, variant=variant)


_node = Family("node", links.PYTHON_STRINGS)
OF_FORMAT = msg(
    "format() puts the values of its () in the places of the text. A place with a name needs "
    "name=value in the (), and {{}} takes the next value."
)
MAPPING = msg("{place} takes the value that {name} has under this name. It has none.")
KINDS = (
    _node(
        "format_value_missing",
        "text",
        msg("A place of the text gets no value"),
        OF_FORMAT,
        msg("Give a value for this place in the () of format: {place}"),
        whys={
            "f_string": msg(
                "format() does not know {place}: it only has the values of its (). An f-string reads "
                "the variables themselves."
            ),
            "counted": msg("format() counts its values from 0: {{0}} is the first one."),
            "highest": msg("format() counts its values from 0: {{0}} is the first one."),
            "too_many": msg("Each {{}} of the text takes one value of the () of format."),
            "key": msg("{place} takes the value that the dict has under this name."),
            "mapping": MAPPING,
            "one_key": MAPPING,
        },
        fixes={
            "f_string": msg("Write an f-string: {written} instead of {name}"),
            "empty": msg(
                "Write {written} instead of {name} in the text: it takes the value of the ()."
            ),
            "given": msg(
                "Write {written} instead of {name} in the text: the () of format gives a value this name."
            ),
            "keyword": msg("Write {written} instead of {name} in the () of format."),
            "value": msg(
                "Write in the () of format a name and a value for {name}. Or write {{}} instead of "
                "{name}, and the value in the ()."
            ),
            "counted": msg("Write {written} instead of {name}."),
            "highest": msg(
                "No place of {name} may have a higher number than {written}: the last value of the () "
                "has this number. Write a lower number, or give more values."
            ),
            "too_many": msg(
                "The text has more places {{}} than format has values. Write a value in the () of "
                "format for each place, or delete the places that are too many."
            ),
            "key": msg("Write {written} instead of {name} in the dict."),
            "one_key": msg(
                "{name} has only the key {found}. Write this name in {place} of the text; or use the key "
                "{key} wherever {found} is used."
            ),
            "mapping": msg(
                "Write in {place} of the text a name that {name} has; or give {name} a value under the "
                "name {key} before this line."
            ),
        },
        raised={NO_KEY: _named, NO_INDEX: _numbered},
        fixed_by=(lines.written,),
        examples=(
            example(
                "text_of_the_class_with_a_name",
                Replace(NODE, "(Node):\n", "(Node):\n    TEXT = 'Hello time: {seconds}'\n\n"),
                Replace(NODE, TEXT, "self.TEXT.format(self.counter_)"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "format_place_with_self",
                Replace(NODE, TEXT, "'Hello time: {self.counter_}'.format(n=self.counter_)"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "format_without_values",
                Replace(NODE, TEXT, "'Hello time: {self.counter_}'.format()"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "format_counts_from_one",
                Replace(NODE, TEXT, "'Hello time: {1}'.format(self.counter_)"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "format_of_other_name",
                Replace(NODE, TEXT, "'Hello time: {n}'.format(m=self.counter_)"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "format_with_name_and_no_keyword",
                Replace(NODE, TEXT, "'Hello time: {counter}'.format(self.counter_)"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "percent_of_other_key",
                Replace(
                    NODE, "class MyFirstNode", "FORM = 'Hello time: %(n)d'\n\n\nclass MyFirstNode"
                ),
                Replace(NODE, TEXT, "FORM % {'count': self.counter_}"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "format_map_of_other_key",
                Replace(NODE, TEXT, "'Hello time: {n}'.format_map(vars(self))"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
)
