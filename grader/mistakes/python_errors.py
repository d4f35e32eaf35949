"""Errors of Python whose cause no other record finds: what the error means, and where to look.

The texts are true of every program with that error. They name the student's code if the line shows
for certain which part of it the error is about.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.base.nearest import nearest
from grader.base.shown import shown
from grader.mistakes import links
from grader.mistakes.example import (
    BODY_OF_MAIN,
    DATACLASS_IMPORTED,
    DEAD,
    LOG,
    LOG_LINE,
    NODE,
    example,
)
from grader.mistakes.fixes import lines
from grader.mistakes.fixes.case import Case
from grader.mistakes.format_fields import text_of
from grader.mistakes.kind import Family
from grader.mistakes.recognised import (
    FromError,
    Raised,
    RecognisedMistake,
    always,
    first_of,
    on_line,
)
from grader.package.edit.files import Files
from grader.package.edit.tree import Replace, Write
from grader.package.source.counter import targets_of
from grader.package.source.module import Function
from grader.package.source.names import called_name, dotted, own_name
from grader.package.source.place import block_of, statement_at

OF_LISTS = ("append", "extend", "insert", "sort", "reverse", "clear", "update", "add")
STARTERS = ("run", "Popen", "call", "check_call", "check_output", "execv", "execvp", "spawn")
MOST_CODE = 60  # characters of a piece of code that a text shows
NONE = msg(
    "A function without return gives back None, and a name that was set to None has this value."
)
FUNCTION = msg(
    "If {function} is meant to give a value, write return and the value at its end. If not, do not use "
    "what it gives back."
)


def _told(slug: str, variant: str = "") -> FromError:
    """Return a function that finds `node.slug` with the groups of its pattern as words.

    It finds it only if the student's line itself raised the error.
    """

    def found(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
        return replace(raised.finding(slug, params=match.groupdict("")), variant=variant)

    return on_line(found)


def _none_attribute(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Something of None is used: tell what is None, and why if the source shows it."""
    used = [
        node.value
        for node in _on_line(raised)
        if isinstance(node, ast.Attribute) and node.attr == match["name"]
    ]
    code = raised.module.text.code(used[0]) if len(used) == 1 else ""
    if not code or "\n" in code or len(code) > MOST_CODE:
        return None
    owner = used[0].value if isinstance(used[0], ast.Attribute) else None
    if owner is not None and code.endswith(".executor") and match["name"] in ("spin", "spin_once"):
        call, node = raised.module.text.code(used[0]), raised.module.text.code(owner)
        params = {"name": f"{call}.{match['name']}()", "written": f"rclpy.{match['name']}({node})"}
        return replace(raised.finding("none_used", params=params), variant="executor")
    found = raised.finding("none_used", name=code)
    function = _gives_nothing(raised, used[0])
    if function is None:
        below = _set_below(raised, code)
        if below:
            return replace(found, words={**found.words, **below}, variant="below")
        later = _set_in_uncalled(raised, code)
        return (
            replace(found, words={**found.words, **later}, variant="uncalled") if later else found
        )
    words = {**found.words, "function": function.name, "line": function.lineno}
    return replace(found, words=words, variant="function")


def _set_below(raised: Raised, name: str) -> dict[str, str]:
    """Return the line below this one, in the same block, that first gives a name a value."""
    here = statement_at(raised.module, raised.line)
    around = block_of(raised.module, here) if here is not None else []
    sets = [n for n in raised.module.nodes if name in targets_of(n) and isinstance(n, ast.stmt)]
    values = [s for s in sets if not _is_none(getattr(s, "value", None))]
    below = [s for s in values if here is not None and s in around and s.lineno > here.lineno]
    if here is None or len(below) != 1 or values != below or not isinstance(below[0], ast.Assign):
        return {}
    between = [s for s in around if here.lineno < s.lineno <= below[0].lineno]
    made = set(targets_of(here)) - {name}
    if any(dotted(n) in made for s in between for n in ast.walk(s)):
        return {}
    return {"line": str(below[0].lineno)}


def _is_none(value: ast.AST | None) -> bool:
    return isinstance(value, ast.Constant) and value.value is None


def _set_in_uncalled(raised: Raised, name: str) -> dict[str, str]:
    """Return the only line that gives an attribute another value than None, in an uncalled method."""
    sets = [
        n
        for n in raised.source.own_nodes
        if isinstance(n, ast.Assign | ast.AnnAssign) and name in targets_of(n)
    ]
    values = [s for s in sets if not (isinstance(s.value, ast.Constant) and s.value.value is None)]
    method = raised.source.function_around(values[0]) if len(values) == 1 else None
    if method is None or len(sets) == 1 or method not in raised.source.own_methods:
        return {}
    named = {n.attr for n in raised.source.all_nodes if isinstance(n, ast.Attribute)}
    plain = len(method.args.args) == 1 and not method.decorator_list
    if method.name in named or method.name.startswith("__") or not plain:
        return {}
    return {"line": str(values[0].lineno), "function": method.name}


def _none_length(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """len() gets None: a method that changes a list gives back None, which takes its place."""
    del match
    given = [dotted(n.args[0]) for n in _on_line(raised) if isinstance(n, ast.Call) and n.args]
    return _changed_list(raised, given)


def _none_iterated(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A for, or square brackets, get None: a method that changes a list has given it back."""
    parts = [getattr(n, "iter", getattr(n, "value", None)) for n in _on_line(raised)]
    given = [dotted(part) for part in parts if isinstance(part, ast.Name | ast.Attribute)]
    return _changed_list(raised, given) or _none_operand(raised, match)


def _changed_list(raised: Raised, given: list[str]) -> RecognisedMistake | None:
    """Return the line that puts what a method such as append returns into one of the names."""
    for node in raised.source.all_nodes:
        value = node.value if isinstance(node, ast.Assign) else None
        if not isinstance(node, ast.Assign) or not isinstance(value, ast.Call):
            continue
        name = next((t for t in targets_of(node) if t in given), "")
        owner, _, method = dotted(value.func).rpartition(".")
        code = raised.source.module_of(node).text.code
        if name and owner == name and method in OF_LISTS and "\n" not in code(node):
            mistake = raised.finding("none_used", at=node, name=code(node), written=code(value))
            words = {**mistake.words, "function": f"{method}()"}
            return replace(mistake, words=words, variant="changes_list")
    return None


def _none_operand(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    """None is added, subtracted or compared: tell which part of the line it is, if one can be."""
    del match
    parts = [n for n in _on_line(raised) if isinstance(n, ast.Name | ast.Attribute | ast.Call)]
    found = {
        raised.module.text.code(part): function
        for part in parts
        if (function := _gives_nothing(raised, part)) is not None
    }
    if len(found) != 1:
        return replace(raised.finding("none_used"), variant="line")
    [(code, function)] = found.items()
    mistake = raised.finding("none_used", name=code)
    words = {**mistake.words, "function": function.name, "line": function.lineno}
    return replace(mistake, words=words, variant="function")


def _no_key(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A key is missing; format() says the same of a name that it gets no value for."""
    line = list(_on_line(raised))
    calls = [called_name(n) for n in line if isinstance(n, ast.Call)]
    read = [n.slice for n in line if isinstance(n, ast.Subscript)]
    written = any(isinstance(n, ast.Constant) and repr(n.value) == match["name"] for n in read)
    if not written and any(name in ("format", "format_map", "substitute") for name in calls):
        return None
    keys = _keys_given(raised) if written else None
    if keys is not None:
        spelt = _spelt_in_dict(raised, match["name"])
        if spelt is not None:
            return spelt
        found = _told("no_such_item", "known_keys")(raised, match)
        return replace(found, words={**found.words, **keys}) if found is not None else None
    return _told("no_such_item", "key")(raised, match)


def _keys_given(raised: Raised) -> dict[str, str] | None:
    """Return the keys of the only dict that the object on the line gets, and their line."""
    read = {dotted(n.value) for n in _on_line(raised) if isinstance(n, ast.Subscript)} - {""}
    given = [
        n
        for n in raised.source.own_nodes
        if isinstance(n, ast.Assign | ast.AnnAssign) and read & set(targets_of(n))
    ]
    value = given[0].value if len(given) == 1 and len(read) == 1 else None
    if not isinstance(value, ast.Dict) or not value.keys or None in value.keys:
        return None
    code = raised.source.module_of(value).text.code
    keys = ", ".join(code(key) for key in value.keys if key is not None)
    plain = len(keys) <= MOST_CODE and "\n" not in keys
    return {"line": str(given[0].lineno), "keys": keys} if plain else None


def _spelt_in_dict(raised: Raised, missing: str) -> RecognisedMistake | None:
    """The dict has a key of nearly this name, which nothing reads."""
    texts = [
        n
        for n in raised.source.all_nodes
        if isinstance(n, ast.Constant) and isinstance(n.value, str) and repr(n.value) != missing
    ]
    keys = {str(n.value): n for n in texts if _is_key(raised, n)}
    near = nearest(missing.strip("'"), dict.fromkeys(keys))
    if not near or len([n for n in texts if n.value == near]) != 1:
        return None
    code = raised.source.module_of(keys[near]).text.code(keys[near])
    mistake = raised.finding("no_such_item", at=keys[near], name=code, written=missing)
    return replace(mistake, words={**mistake.words, "at": str(raised.line)}, variant="spelt")


def _is_key(raised: Raised, text: ast.Constant) -> bool:
    """Whether a text is a key of the dict that this line reads from."""
    read = {dotted(n.value) for n in _on_line(raised) if isinstance(n, ast.Subscript)} - {""}
    parents = raised.source.module_of(text).parents
    made = parents.get(text)
    around = parents.get(made) if isinstance(made, ast.Dict) and text in made.keys else None
    return around is not None and bool(read & set(targets_of(around)))


def _too_many_values(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The text before % has too few places; it can be a value that should be a number."""
    left = [
        n.left for n in _on_line(raised) if isinstance(n, ast.BinOp) and isinstance(n.op, ast.Mod)
    ]
    left += [n.target for n in _on_line(raised) if isinstance(n, ast.AugAssign)]
    braces = _for_format(raised)
    if braces is not None:
        return braces
    written = any(isinstance(n, ast.Constant | ast.JoinedStr) for n in left)
    return _told("text_and_values", "" if written else "left")(raised, match)


def _for_format(raised: Raised) -> RecognisedMistake | None:
    """The only % of the line gets a text with places for format(): {}."""
    found = [n for n in _on_line(raised) if isinstance(n, ast.BinOp) and isinstance(n.op, ast.Mod)]
    if len(found) != 1 or isinstance(found[0].right, ast.Tuple | ast.Dict):
        return None
    value: ast.expr | None = found[0].left
    if dotted(found[0].left):
        value = text_of(raised, found[0].left)
    text = value.value if isinstance(value, ast.Constant) else None
    if not isinstance(text, str) or "%" in text or len(re.findall(r"\{[:\w]{0,20}\}", text)) != 1:
        return None
    code = raised.module.text.code
    name, place = code(found[0]), re.search(r"\{[:\w]{0,20}\}", text)
    field = re.match(r"\{([A-Za-z_]\w*)", place[0]) if place is not None else None
    given = f"{field[1]}={code(found[0].right)}" if field else code(found[0].right)
    written = f"{code(found[0].left)}.format({given})"
    if place is None or "\n" in name or len(name) > MOST_CODE:
        return None
    mistake = raised.finding("text_and_values", at=found[0], name=name, written=written)
    return replace(mistake, words={**mistake.words, "place": shown(place[0])}, variant="braces")


def _no_items(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Items are needed: by += if what it adds to is a list."""
    statement = statement_at(raised.module, raised.line)
    found = _told("types_do_not_fit", "each")(raised, match)
    sums = [n for n in _on_line(raised) if isinstance(n, ast.Call) and dotted(n.func) == "sum"]
    code = raised.module.text.code(sums[0]) if len(sums) == 1 else ""
    if found is not None and code and "\n" not in code and len(code) <= MOST_CODE:
        values = " + ".join(raised.module.text.code(part) for part in sums[0].args)
        words = {**found.words, "name": code, "written": values}
        two = len(sums[0].args) == 2
        return replace(found, words=words, variant="sum_of_two" if two else "sum")
    if found is None or not isinstance(statement, ast.AugAssign):
        return found
    name = raised.module.text.code(statement.target)
    plain = isinstance(statement.op, ast.Add)
    words = {**found.words, "name": name}
    return replace(found, words=words, variant="added") if plain else found


def _no_file(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The path is relative, or a whole one, of a file that is read or written."""
    calls = [n for n in _on_line(raised) if isinstance(n, ast.Call)]
    if any(called_name(call) in STARTERS for call in calls):
        return None
    if any(_writes(call) for call in calls):
        return _told("no_such_file", "written")(raised, match)
    shared = re.search(rf"/share/{re.escape(raised.assignment.package)}/([^']+)'", match["name"])
    if shared is not None:
        found = _told("no_such_file", "share")(raised, match)
        folder = "/".join([f"share/{raised.assignment.package}", *shared[1].split("/")[:-1]])
        written = f"('{folder}', ['{shared[1]}']),"
        return found and replace(found, words={**found.words, "written": written})
    whole = match["name"].startswith("'/")
    return _told("no_such_file", "whole" if whole else "")(raised, match)


def _writes(call: ast.Call) -> bool:
    """Whether a call opens a file to write it."""
    given = [*call.args[:2], *(w.value for w in call.keywords if w.arg == "mode")]
    modes = [n.value for n in given[-1:] if isinstance(n, ast.Constant)]
    mode = str(modes[0]) if modes else ""
    opens = called_name(call) == "open" and re.fullmatch(r"[wax][bt+]*", mode) is not None
    return opens or called_name(call) in ("write_text", "write_bytes", "mkdir")


def _shared_default(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A field of a dataclass has an object as its default that all objects would share."""
    for own in raised.module.classes:
        for statement in own.body:
            if not isinstance(statement, ast.AnnAssign) or statement.value is None:
                continue
            if dotted(statement.target) != match["name"]:
                continue
            code = raised.module.text.code(statement.value)
            made = dotted(statement.value.func) if isinstance(statement.value, ast.Call) else ""
            if code != f"{made}()":
                made = f"lambda: {code}"
            params = {"name": code, "written": f"field(default_factory={made})"}
            return raised.finding("default_shared", at=statement, params=params)
    return None


def _frozen(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The only frozen dataclass of the files that has the field."""
    name, found = match["name"], []
    statement = statement_at(raised.module, raised.line)
    sets = statement is not None and any(t.endswith(f".{name}") for t in targets_of(statement))
    for own in (c for c in raised.module.classes if sets):
        fields = [s for s in own.body if name in targets_of(s)]
        for given in own.decorator_list:
            for keyword in given.keywords if isinstance(given, ast.Call) else ():
                if fields and keyword.arg == "frozen":
                    found.append((own, keyword.value.lineno))
    if len(found) != 1:
        return None
    own, line = found[0]
    mistake = raised.finding("fields_frozen", name=name)
    return replace(mistake, words={**mistake.words, "type": own.name, "line": str(line)})


def _not_for_with(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The with of the line gets an object that has no block; it can have a name already."""
    items = [i for n in _on_line(raised) if isinstance(n, ast.With) for i in n.items]
    named = [i for i in items if dotted(i.context_expr) and i.optional_vars is None]
    alone = len(items) == len(named) == 1
    made = [i.context_expr for i in items if isinstance(i.context_expr, ast.Call)]
    function = raised.module.functions.get(dotted(made[0].func)) if len(made) == 1 else None
    if match["first"] == "generator" and function is not None and not function.decorator_list:
        found = raised.finding("not_for_with", at=function, name=function.name)
        return replace(found, variant="generator")
    return _told("not_for_with", "name" if alone else "")(raised, match)


def _values_outside(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The values behind % lack their brackets, so that the call gets all but the first."""
    found = _told("text_and_values")(raised, match)
    calls = [n for n in _on_line(raised) if isinstance(n, ast.Call) and len(n.args) > 1]
    calls = [
        c for c in calls if isinstance(c.args[0], ast.BinOp) and isinstance(c.args[0].op, ast.Mod)
    ]
    if found is None or len(calls) != 1 or calls[0].keywords:
        return found
    text, first = raised.module.text, calls[0].args[0]
    code = text.text[text.span(first)[0] : text.span(calls[0].args[-1])[1]]
    if not isinstance(first, ast.BinOp) or isinstance(first.right, ast.Tuple) or "\n" in code:
        return found
    values = ", ".join(text.code(value) for value in (first.right, *calls[0].args[1:]))
    params = {**match.groupdict(""), "name": code, "text": f"{text.code(first.left)} % ({values})"}
    return replace(raised.finding("text_and_values", at=calls[0], params=params), variant="outside")


def _values_inside(case: Case) -> Files | None:
    """Write the values behind % in brackets."""
    if "written" in case.finding.params:
        return lines.written(case)
    params = {**case.finding.params, "written": case.finding.params.get("text", "")}
    return lines.written(replace(case, finding=replace(case.finding, params=params)))


def _caught(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Except gets no class of an exception: | can be between several ones."""
    kinds = [n.type for n in _on_line(raised) if isinstance(n, ast.ExceptHandler) and n.type]
    text = raised.module.text
    parts = _alternatives(kinds[0]) if len(kinds) == 1 else []
    if len(parts) < 2 or not all(map(dotted, parts)):
        return _told("not_an_exception")(raised, match)
    code, given = text.code(kinds[0]), ", ".join(text.code(part) for part in parts)
    around = f"({code})" in raised.module.line(raised.line)
    params = {"name": f"({code})" if around else code, "written": f"({given})"}
    found = raised.finding("not_an_exception", params=params)
    return replace(found, variant="line")


def _alternatives(given: ast.expr) -> list[ast.expr]:
    if isinstance(given, ast.BinOp) and isinstance(given.op, ast.BitOr):
        return [*_alternatives(given.left), given.right]
    return [given]


def _doubled_plus(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Two texts are joined by ++, as in Haskell: the second + stands in front of a text."""
    for node in _on_line(raised):
        right = node.right if isinstance(node, ast.BinOp) else None
        if not isinstance(node, ast.BinOp) or not isinstance(node.op, ast.Add):
            continue
        if not isinstance(right, ast.UnaryOp) or not isinstance(right.op, ast.UAdd):
            continue
        code = raised.module.text.code
        name = code(node)
        params = {
            **match.groupdict(""),
            "name": name,
            "written": f"{code(node.left)} + {code(right.operand)}",
        }
        if "\n" not in name and len(name) <= MOST_CODE:
            return replace(raised.finding("types_do_not_fit", params=params), variant="doubled")
    return None


def _comma(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A comma at the end of the line makes a tuple of the number that is added."""
    statement = statement_at(raised.module, raised.line)
    value = statement.value if isinstance(statement, ast.AugAssign) else None
    if statement is None or not isinstance(value, ast.Tuple) or len(value.elts) != 1:
        return None
    code = raised.module.text.code(statement)
    if not code.endswith(","):
        return None
    params = {**match.groupdict(""), "name": code, "text": code[:-1].rstrip()}
    return replace(raised.finding("types_do_not_fit", params=params), variant="comma")


def _without_comma(case: Case) -> Files | None:
    """Remove the comma with which a statement ends."""
    name, text = (str(case.finding.params.get(word, "")) for word in ("name", "text"))
    module, line = case.module, case.finding.line
    if module is None or line is None or not name.endswith(",") or not text:
        return None
    found = [n for n in module.nodes if isinstance(n, ast.AugAssign) and n.lineno == line]
    if len(found) != 1 or module.text.code(found[0]) != name:
        return None
    return case.changed(module, module.text.swap(found[0], text))


def _on_line(raised: Raised) -> Iterator[ast.AST]:
    """Yield the syntax on the line of the error."""
    for node in raised.module.nodes:
        first, last = getattr(node, "lineno", None), getattr(node, "end_lineno", None)
        if first is None or isinstance(node, Function | ast.ClassDef):
            continue
        if first <= (raised.line or 0) <= (last or first):
            yield node


def _gives_nothing(raised: Raised, part: ast.AST) -> Function | None:
    """Return the student's function without a value of its own that gives this part its value."""
    calls = [part] if isinstance(part, ast.Call) else []
    name = dotted(part)
    if name and not calls:
        assigned = [
            node.value
            for node in raised.source.own_nodes
            if isinstance(node, ast.Assign) and name in targets_of(node)
        ]
        calls = [value for value in assigned if isinstance(value, ast.Call)]
        if len(assigned) != len(calls):
            calls = calls if len(calls) == 1 else []
    functions = [_called(raised, call) for call in calls]
    found = [f for f in functions if f is not None and not _has_value(f)]
    return found[0] if len(found) == 1 else None


def _called(raised: Raised, call: ast.Call) -> Function | None:
    """Return the student's function that a call of `name()` or `self.name()` calls."""
    method = raised.source.methods.get(own_name(call.func))
    if method is not None:
        return method
    return raised.module.functions.get(called_name(call)) if dotted(call.func) else None


def _has_value(function: Function) -> bool:
    """Whether a function gives back a value, is a coroutine or a generator, or is decorated."""
    if isinstance(function, ast.AsyncFunctionDef) or function.decorator_list:
        return True
    own = [n for n in ast.walk(function) if isinstance(n, ast.Return | ast.Yield | ast.YieldFrom)]
    return any(not isinstance(n, ast.Return) or n.value is not None for n in own)


NONE_IN = r"(?:'NoneType' and '\w{1,60}'|'\w{1,60}' and 'NoneType')"
SUM = msg(
    "sum() adds up the items of one value, such as a list. The value that it gets first has the type "
    "{first}, which has no items."
)
ROUND = msg("A call is written with (), not with []: replace the square brackets.")
_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "none_used",
        "callback",
        msg("A value is None, and something else is needed"),
        NONE,
        msg("Find the line that gives {name} its value, and see why it is None."),
        whys={
            "function": msg(
                "{function} (line {line}) has no return with a value, so {name} is None."
            ),
            "changes_list": msg(
                "{function} changes the list itself, and gives back None. This line puts that None in "
                "the place of the list."
            ),
            "below": msg(
                "{name} is None until line {line} runs, and line {line} is below this line."
            ),
            "executor": msg(
                "A new node has no executor yet: this attribute is None until something spins the node. "
                "rclpy.spin gives it one."
            ),
            "uncalled": msg(
                "{name} is None until line {line} runs. That line is in {function}, which nothing calls."
            ),
        },
        fixes={
            "executor": msg("Write {written} instead of {name}."),
            "changes_list": msg("Write only {written} instead of {name}."),
            "below": msg("Move this line below line {line}."),
            "uncalled": msg(
                "Write self.{function}() in __init__, above the line that creates the timer. Or set "
                "{name} there to the value of line {line}, instead of None."
            ),
            "function": FUNCTION,
            "line": msg("Find out which value on that line is None, and which line set it."),
        },
        raised={
            r"AttributeError: 'NoneType' object has no attribute '(?P<name>\w{1,120})'": (
                on_line(_none_attribute)
            ),
            rf"unsupported operand type\(s\) for .{{1,20}}: {NONE_IN}": on_line(_none_operand),
            rf"not supported between instances of {NONE_IN}": on_line(_none_operand),
            r"can only concatenate str \(not \"NoneType\"\)": on_line(_none_operand),
            r"object of type 'NoneType' has no len\(\)": on_line(_none_length),
            r"'NoneType' object is not (?:subscriptable|iterable)": on_line(_none_iterated),
        },
        fixed_by=(lines.written,),
        examples=(
            example(
                "list_is_what_append_returns",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = []"),
                Replace(NODE, "str(self.counter_)", "str(len(self.counter_))"),
                Replace(NODE, "self.counter_ += 1", "self.counter_ = self.counter_.append(1)"),
                fails="run.output",
                blocks=("run.period", "run.interrupt"),
            ),
            example(
                "none_until_a_line_below",
                Replace(
                    NODE,
                    "        self.create_timer(",
                    "        self.period = None\n"
                    "        self.get_logger().debug(str(self.period.real))\n"
                    "        self.period = 1.0\n"
                    "        self.create_timer(",
                ),
                fails="run.starts",
            ),
            example(
                "executor_of_a_new_node",
                Replace(NODE, "rclpy.spin(node)", "node.executor.spin()"),
                fails="run.starts",
            ),
            example(
                "names_are_what_append_returns",
                Replace(
                    NODE,
                    "node = MyFirstNode()\n",
                    "nodes = []\n    nodes = nodes.append(MyFirstNode())\n    node = nodes[0]\n",
                ),
                fails="run.starts",
            ),
            example(
                "logger_set_in_uncalled_method",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = 0\n        self.log_ = None"),
                Replace(NODE, "self.get_logger().info", "self.log_.info"),
                Replace(
                    NODE,
                    "    def timer_callback(self)",
                    "    def set_up(self):\n        self.log_ = self.get_logger()\n\n"
                    "    def timer_callback(self)",
                ),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "helper_for_the_logger_returns_nothing",
                Replace(NODE, "self.get_logger().info", "self.log().info"),
                Replace(
                    NODE,
                    "    def timer_callback(self)",
                    "    def log(self):\n        self.get_logger()\n\n    def timer_callback(self)",
                ),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "types_do_not_fit",
        "callback",
        msg("An operation gets a value of a type that it cannot use"),
        msg("{operator} does not work between the types {first} and {second}."),
        msg(
            "Look in which line each of the two gets its value. str(…) makes a text of a number, "
            "and int(…) a number of a text."
        ),
        whys={
            "items": msg("name[…] reads one item. The type {first} has no items."),
            "doubled": msg(
                "One + joins two texts. The second + stands in front of the text behind it, where + needs "
                "a number."
            ),
            "function": msg("name[…] reads one item. A function has no items: it is called."),
            "each": msg(
                "Only a value that consists of items can be unpacked or used behind in. The type {first} has none."
            ),
            "added": msg(
                "{name} has items on this line, as a list has. += adds the items of another list to it, and the type "
                "{first} has no items."
            ),
            "sum": SUM,
            "sum_of_two": SUM,
            "set": msg("name[…] = … sets one item. The items of the type {first} cannot be set."),
            "join": msg("join() puts texts together. One item of this list has the type {first}."),
            "sign": msg(
                "{operator} in front of a value needs a number. This value has the type {first}."
            ),
            "whole": msg("A whole number is needed here, and this value has the type {first}."),
            "number": msg("int() makes a number only of digits. It cannot read {text}."),
            "comma": msg("A comma after a value makes a tuple, and not a number."),
            "returned": msg("Python calls {operator} and needs a {first} from it."),
        },
        fixes={
            "doubled": msg("Write {written} instead of {name}."),
            "items": msg("Look in which line this value is set, or remove the […]."),
            "function": ROUND,
            "each": msg(
                "Find out which value on this line has the type {first}, and which line gives it. To repeat "
                "something n times, write range(n)."
            ),
            "sum": msg(
                "Find out which value sum() gets here, and which line gives it. Numbers are added with + "
                "between them."
            ),
            "sum_of_two": msg("To add two numbers, write {written} instead of {name}."),
            "set": msg("Make a new value instead, or use a list."),
            "join": msg("Convert each item to a text first: str(…)."),
            "added": msg(
                "If {name} is meant to count, let it begin with a number instead of a list. To add one item "
                "to a list, write {name}.append(…)."
            ),
            "sign": msg("Find the line that gives this value: it must be a number there."),
            "whole": msg("Convert the value with int(…), or write a number without a point."),
            "number": msg(
                "Give int() a text that has only digits. float() also reads numbers with a point."
            ),
            "comma": msg("Remove the comma at the end of the line: write {text}"),
            "returned": msg(
                "Look at each return in {operator}: its value must be a {first}. Without a return, the "
                "value is None."
            ),
        },
        raised={
            r"'(?P<first>\w{1,60})' and 'tuple'$": on_line(_comma),
            r"'(?P<first>method|function|builtin_function_or_method|type)' object is not subscriptable": (
                _told("types_do_not_fit", "function")
            ),
            r"'(?P<first>\w{1,60})' object is not subscriptable": _told(
                "types_do_not_fit", "items"
            ),
            r"'(?P<first>\w{1,60})' object is not iterable": on_line(_no_items),
            r"argument of type '(?P<first>\w{1,60})' is not iterable": (
                _told("types_do_not_fit", "each")
            ),
            r"cannot unpack non-iterable (?P<first>\w{1,60}) object": (
                _told("types_do_not_fit", "each")
            ),
            r"'(?P<first>\w{1,60})' object does not support item assignment": (
                _told("types_do_not_fit", "set")
            ),
            r"expected str instance, (?P<first>\w{1,60}) found": _told("types_do_not_fit", "join"),
            r"bad operand type for unary (?P<operator>\S{1,3}): '(?P<first>\w{1,60})'": first_of(
                _doubled_plus, _told("types_do_not_fit", "sign")
            ),
            r"'(?P<first>\w{1,60})' object cannot be interpreted as an integer": (
                _told("types_do_not_fit", "whole")
            ),
            r"invalid literal for int\(\) with base 10: (?P<text>'[^'\n]{0,60}')": (
                _told("types_do_not_fit", "number")
            ),
            r"(?P<operator>__\w{1,30}__) returned non-(?P<first>\w{1,30})": (
                _told("types_do_not_fit", "returned")
            ),
            r"unsupported operand type\(s\) for (?P<operator>\S{1,3})(?: or \S{1,5})?: "
            r"'(?P<first>\w{1,60})' and '(?P<second>\w{1,60})'": _told("types_do_not_fit"),
            r"'(?P<operator>[<>=]{1,2})' not supported between instances of '(?P<first>\w{1,60})' and "
            r"'(?P<second>\w{1,60})'": _told("types_do_not_fit"),
        },
        fixed_by=(_without_comma,),
        examples=(
            example(
                "texts_joined_by_two_plus",
                Replace(NODE, "'Hello time: ' + str", "'Hello time: ' ++ str"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "comma_behind_the_step",
                Replace(NODE, "self.counter_ += 1", "self.counter_ += 1,"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
            example(
                "sum_of_two_numbers",
                Replace(NODE, "self.counter_ += 1", "self.counter_ = sum(self.counter_, 1)"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
            example(
                "start_is_a_text_compared",
                Replace(NODE, LOG_LINE, f"        if self.counter_ < '5':\n    {LOG_LINE}"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "fields_frozen",
        "counter",
        msg("A field of a frozen dataclass is set"),
        msg(
            "With frozen=True (line {line}), the fields of {type} can be set only when an object is "
            "made. An assignment to {name} raises this error."
        ),
        msg("Remove frozen=True in line {line}: then this line can set {name}."),
        raised={r"FrozenInstanceError: cannot assign to field '(?P<name>\w{1,120})'": _frozen},
        examples=(
            example(
                "counts_in_a_frozen_dataclass",
                Replace(
                    NODE,
                    "class MyFirstNode",
                    "@dataclass(frozen=True)\nclass FrozenCount:\n    number: int = 0\n\n\nclass MyFirstNode",
                ),
                Replace(
                    NODE,
                    "import rclpy\nfrom",
                    "from dataclasses import dataclass\nimport rclpy\nfrom",
                ),
                Replace(NODE, "self.counter_ = 0", "self.counter_ = FrozenCount()"),
                Replace(NODE, "str(self.counter_)", "str(self.counter_.number)"),
                Replace(NODE, "self.counter_ += 1", "self.counter_.number += 1"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
        ),
    ),
    _node(
        "recursion",
        "callback",
        msg("Functions call each other without end"),
        msg(
            "A function that calls itself, directly or by way of another one, runs again and again "
            "until Python stops it. So does a property that reads or sets itself."
        ),
        msg(
            "Remove the call with which it begins again. A method with the name of one of Node calls "
            "that one with super()., not with self."
        ),
        seen=r"RecursionError: maximum recursion depth exceeded",
        raised={r"RecursionError": always("recursion")},
    ),
    _node(
        "abstract_method",
        "class",
        msg("The class lacks a method that its base requires"),
        msg(
            "A base class marks {name} with @abstractmethod: each class that inherits from it must "
            "have a method of exactly this name."
        ),
        msg(
            "Give {function} a method {name}, or rename the method that is meant to be it, here and "
            "wherever it is used."
        ),
        raised={
            r"Can't instantiate abstract class (?P<function>\w{1,120}) (?:with|without an implementation "
            r"for) abstract methods? '?(?P<name>\w{1,120})": _told("abstract_method"),
        },
        examples=(
            example(
                "abstract_method_of_another_name",
                Replace(
                    NODE,
                    "import rclpy\nfrom",
                    "from abc import ABC, abstractmethod\n\nimport rclpy\nfrom",
                ),
                Replace(
                    NODE,
                    "class MyFirstNode(Node):",
                    "class Ticks(ABC):\n\n    @abstractmethod\n    def on_tick(self):\n"
                    "        ...\n\n\nclass MyFirstNode(Node, Ticks):",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "await_of_other",
        "callback",
        msg("await is used on something that cannot be awaited"),
        msg(
            "await waits for a coroutine or a future. What is called here has done its work when it "
            "returns, and gives back a value of the type {first}."
        ),
        msg("Remove await on that line."),
        raised={
            r"object (?P<first>\w{1,60}) can't be used in 'await' expression": _told(
                "await_of_other"
            )
        },
        examples=(
            example(
                "logger_awaited",
                Replace(NODE, "    def timer_callback(self)", "    async def timer_callback(self)"),
                Replace(NODE, LOG, f"await {LOG}"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
        ),
    ),
    _node(
        "text_and_values",
        "text",
        msg("The text and its values do not fit together"),
        msg(
            "With %, a text has one place for each value: %d for a whole number, %s for anything. "
            "This text has another number of places than there are values."
        ),
        msg("Give the text one place for each value. A text with {{}} needs .format(…) and no %."),
        whys={
            "outside": msg(
                "% takes several values only in brackets. Without them it takes the first one, and the "
                "others are further arguments of the call."
            ),
            "type": msg(
                "The place %d in a text needs a number, and gets a value of the type {first}."
            ),
            "braces": msg(
                "The text before % has the place {place}. format() fills it, and % does not: % fills places "
                "such as %d."
            ),
            "left": msg(
                "The value before % is a text on this line. Then % puts values into the places of the text, "
                "such as %d, and this text has fewer places than there are values. Between two numbers, % "
                "gives the remainder."
            ),
        },
        fixes={
            "outside": msg("Write {text} instead of {name}."),
            "braces": msg("Write {written} instead of {name}."),
            "type": msg("Write %s in the text, or give it a number."),
            "left": msg(
                "If you want the remainder, find the line that gives the value before %, and make it a "
                "number there. If you want to fill a text, give it one place for each value."
            ),
        },
        raised={
            r"not all arguments converted during string formatting": on_line(_too_many_values),
            r"not enough arguments for format string": on_line(_values_outside),
            r"%[a-z] format: a (?:real )?number is required, not (?P<first>\w{1,60})": (
                _told("text_and_values", "type")
            ),
        },
        fixed_by=(_values_inside,),
        examples=(
            example(
                "values_outside_of_brackets",
                Replace(
                    NODE,
                    "'Hello time: ' + str(self.counter_)",
                    "'%s: %d' % 'Hello time', self.counter_",
                ),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "braces_before_percent",
                Replace(
                    NODE, "class MyFirstNode", "TEXT = 'Hello time: {}'\n\n\nclass MyFirstNode"
                ),
                Replace(NODE, "'Hello time: ' + str(self.counter_)", "TEXT % self.counter_"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "no_such_item",
        "callback",
        msg("There is no item with that key or index"),
        msg("A list of n items has the indices 0 to n - 1. A negative index counts from its end."),
        msg("Compare the index with the length of the list on that line."),
        whys={
            "key": msg(
                "What this line reads from has only the keys that it was given. {name} is not one of them."
            ),
            "spelt": msg(
                "Line {at} reads the key {written}, and the dict of this line has {name}. Nothing reads "
                "{name}."
            ),
            "known_keys": msg(
                "Line {line} makes the dict with: {keys}. The key {name} is not there, so it has no "
                "value to read."
            ),
        },
        fixes={
            "spelt": msg("Write {written} instead of {name} on this line."),
            "known_keys": msg(
                "Write in this line, instead of {name}, the key that is meant. If {name} is to be a key "
                "of its own, give it a first value in line {line}."
            ),
            "key": msg(
                "Compare {name} with the keys that exist: case and blanks count. Or find out why the line "
                "that adds this key has not run."
            ),
        },
        raised={
            r"IndexError: (?:list|tuple|string) (?:assignment )?index out of range": (
                _told("no_such_item")
            ),
            r"^KeyError: (?P<name>.{1,60})$": on_line(_no_key),
        },
        fixed_by=(lines.written,),
        examples=(
            example(
                "key_spelt_otherwise_in_the_dict",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = {'counter': 0}"),
                Replace(NODE, "str(self.counter_)", "str(self.counter_['count'])"),
                Replace(NODE, "self.counter_ += 1", "self.counter_['count'] += 1"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "counts_under_a_key_without_value",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = {'number': 0}"),
                Replace(NODE, "str(self.counter_)", "str(self.counter_['number'])"),
                Replace(NODE, "self.counter_ += 1", "self.counter_['numbers'] += 1"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
            example(
                "item_of_an_empty_list",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = 0\n        self.seen = []"),
                Replace(NODE, LOG_LINE, f"{LOG_LINE}        self.seen[0] = self.counter_\n"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
        ),
    ),
    _node(
        "no_such_file",
        "start",
        msg("A file is opened that is not there"),
        msg(
            "A path that does not begin with / is looked for in the folder in which ros2 run is "
            "started, and not beside the file of the node."
        ),
        msg(
            "Write the values that the program takes from {name} into the program, in place of what "
            "opens and reads the file. If it must be a file, let setup.py install it: add it to the list "
            "with 'package.xml' in data_files, and build again. Then open it in the folder that "
            "get_package_share_directory('{package}') returns (from ament_index_python.packages)."
        ),
        whys={
            "whole": msg(
                "There is no file {name} on the computer that runs the node. The folders of one computer do "
                "not exist on another one."
            ),
            "share": msg(
                "The folder share of a package has only the files that data_files in setup.py lists, and "
                "this file is not there."
            ),
            "written": msg(
                "Python creates a file that is opened to be written, but not the folder that contains it. "
                "A path that does not begin with / begins in the folder in which ros2 run is started."
            ),
        },
        fixes={
            "share": msg(
                "Add this to the list data_files in setup.py, with the path that the file has in your "
                "package, and build again: {written}"
            ),
            "written": msg(
                "Create the folder of {name} before this line, with os.makedirs(…, exist_ok=True), or "
                "write the file into a folder that exists."
            ),
        },
        raised={
            r"FileNotFoundError: \[Errno 2\] No such file or directory: (?P<name>'[^'\n]{1,120}')": (
                on_line(_no_file)
            )
        },
        examples=(
            example(
                "file_of_the_share_folder_not_listed",
                Write("config/start.txt", "0\n"),
                Replace(
                    NODE,
                    "import rclpy\nfrom",
                    "import rclpy\nfrom ament_index_python.packages import "
                    "get_package_share_directory\nfrom",
                ),
                Replace(
                    NODE,
                    "self.counter_ = 0",
                    "share = get_package_share_directory('my_robot_controller')\n"
                    "        self.counter_ = int(open(share + '/config/start.txt').read())",
                ),
                fails="run.starts",
            ),
            example(
                "opens_a_file_beside_it",
                Replace(
                    NODE,
                    "self.counter_ = 0",
                    "self.counter_ = int(open('start.txt').read())",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "default_shared",
        "class",
        msg("A field of a dataclass has a default that its objects would share"),
        msg(
            "{name} is made once, when Python reads the class: all objects would have the same one. A "
            "dataclass refuses such a default."
        ),
        msg(
            "Write {written} instead of {name}, and import field: from dataclasses import dataclass, field"
        ),
        raised={
            r"ValueError: mutable default <class .{1,200}> for field (?P<name>\w{1,120}) is not": (
                _shared_default
            )
        },
        examples=(
            example(
                "object_as_default_of_a_field",
                DATACLASS_IMPORTED,
                Replace(
                    NODE,
                    "class MyFirstNode",
                    "@dataclass\nclass Timing:\n    period: float = 1.0\n\n\n@dataclass\n"
                    "class Settings:\n    timing: Timing = Timing()\n\n\nclass MyFirstNode",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "not_an_exception",
        "shutdown",
        msg("except or raise gets something that is not an exception"),
        msg(
            "except takes the class of an exception, and several of them as (First, Second) with "
            "commas. Python finds out only when an exception has come."
        ),
        msg(
            "Write the name of the class, without () and quotes. Put several names in round brackets."
        ),
        raised={
            r"catching classes that do not inherit from BaseException": _caught,
            r"exceptions must derive from BaseException": _told("not_an_exception", "raised"),
        },
        whys={
            "raised": msg("raise takes an exception, for example ValueError('text')."),
            "line": msg(
                "Between the classes behind except are commas, in one pair of brackets. | makes another "
                "object of them. Python finds out only when an exception has come."
            ),
        },
        fixes={
            "raised": msg("Write an exception behind raise, or remove that line."),
            "line": msg("Write {written} instead of {name}."),
        },
        fixed_by=(lines.written,),
        examples=(
            example(
                "classes_behind_except_with_a_line_between",
                Replace(
                    NODE, "except KeyboardInterrupt:", "except (KeyboardInterrupt | ValueError):"
                ),
                fails="run.interrupt",
            ),
        ),
    ),
    _node(
        "not_for_with",
        "spin",
        msg("with gets an object that cannot be used with it"),
        msg(
            "with needs an object that has the methods __enter__ and __exit__. The type {first} does not have them."
        ),
        msg(
            "Assign the object to a name in a line of its own, without with. Then indent the lines of "
            "the block as far as that line."
        ),
        raised={
            r"'(?P<first>\w{1,120})' object does not support the context manager protocol": (
                on_line(_not_for_with)
            )
        },
        whys={
            "generator": msg(
                "A function with yield gives a generator, and with cannot use that. @contextmanager makes "
                "of it what with needs: the lines before yield run at the start of the block, and those "
                "behind it at its end (after Ctrl+C only if they are in the finally of a try around "
                "yield)."
            )
        },
        fixes={
            "generator": msg(
                "Write @contextmanager on the line above def {name}, and at the top of the file: from "
                "contextlib import contextmanager"
            ),
            "name": msg(
                "Delete the line of the with, and indent the lines of its block as far as that line."
            ),
        },
        examples=(
            example(
                "generator_in_with",
                Replace(
                    NODE,
                    "\n\ndef main(",
                    "\n\ndef session(args):\n    rclpy.init(args=args)\n    yield\n    rclpy.try_shutdown()\n\n\ndef main(",
                ),
                Replace(
                    NODE,
                    BODY_OF_MAIN,
                    "    with session(args):\n        rclpy.spin(MyFirstNode())\n",
                ),
                fails="run.starts",
            ),
            example(
                "node_in_with",
                Replace(
                    NODE,
                    "    node = MyFirstNode()\n    try:\n        rclpy.spin(node)",
                    "    try:\n        with MyFirstNode() as node:\n            rclpy.spin(node)",
                ),
                fails="run.starts",
                right_from="kilted",
                note="a Node can be used with `with` from kilted on",
            ),
        ),
    ),
)
