"""A text that shows an object, a function or bytes as Python writes them, instead of a value."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import LOG_LINE, NODE, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.counter import targets_of
from grader.package.source.module import Function
from grader.package.source.names import dotted, is_enum, last_part, named_in
from grader.package.source.place import statement_at

OBJECT = re.compile(
    r"<(?:[\w<>]{1,100}\.){0,9}(?P<name>\w{1,100}) object(?: [\w.<>]{1,100})? at 0x"
)
FUNCTION = re.compile(
    r"<(?:bound method|function) (?:[\w<>]{1,100}\.){0,9}(?P<name>\w{1,100}) (?:of|at) "
)
SHOWN = re.compile(r"(?<!\w)(?P<name>[A-Z]\w{0,100})\((?P<field>\w{1,100})=[^,()]{0,100}\)")
WITH_ARGUMENTS = re.compile(r"(?<!\w)(?P<name>[A-Z]\w{0,100})\(.{0,200}\)")
MEMBER = re.compile(r"(?<![\w.])(?P<name>[A-Za-z_]\w{0,100})\.(?P<member>[A-Za-z_]\w{0,100})")
OF_ITEMS = re.compile(r"(?<!\w)(?P<name>Counter|OrderedDict|defaultdict|deque|array)\([\[{<]")
MESSAGE = re.compile(
    r"(?<![\w.])[a-z]\w{0,60}\.msg\.(?P<name>[A-Z]\w{0,60})\((?P<field>\w{1,60})=[^(,]{0,100}\)"
)
LIST = re.compile(r"\[(['\"]).{0,200}\1.{0,200}\]")
BYTES = re.compile(r"(?<!\w)b(['\"]).{0,200}\1")
OTHER_NAMES = ("tostring", "string", "str")
"""The names that other languages give to the method that makes a text of an object, without _."""


def _shown_object(suspect: Suspect) -> RecognisedMistake | None:
    """The text has an object as Python writes it: with its class and its address, or its fields."""
    text = suspect.text
    if (member := _member(suspect)) is not None:
        return member
    if (function := FUNCTION.search(text)) is not None:
        return _function(suspect, function["name"])
    if (found := OBJECT.search(text)) is not None:
        if found["name"] == "Parameter" and (parameter := _parameter(suspect)) is not None:
            return parameter
        method = _named_otherwise(suspect, found["name"])
        if method is not None:
            mistake = suspect.finding("object_in_text", method, name=method.name, written="__str__")
            return _with_class(mistake, found["name"], "renamed")
        return _told(suspect, found["name"], "address")
    for pattern, variant in ((SHOWN, "field"), (WITH_ARGUMENTS, "shown")):
        found = pattern.search(text)
        if found is not None and _class_of(suspect, found["name"]) is not None:
            mistake = _told(suspect, found["name"], variant)
            words = {**mistake.words, "field": found.groupdict().get("field") or ""}
            return replace(mistake, words=words)
    if "ParameterValue(" in text and (value := _parameter_value(suspect)) is not None:
        return value
    if (message := MESSAGE.search(text)) is not None:
        return _message(suspect, message["name"], message["field"])
    if LIST.search(text) and (parts := _list(suspect)) is not None:
        return parts
    if (held := OF_ITEMS.search(text)) is not None:
        return _told(suspect, held["name"], "items")
    if re.search(r"(?<![\w.])count\(-?\d{1,20}(?:, -?\d{1,20})?\)", text):
        return _told(suspect, "count", "count")
    return _told(suspect, "bytes", "bytes") if BYTES.search(text) else None


def _message(suspect: Suspect, name: str, field: str) -> RecognisedMistake:
    """The text has a message: name its field, at the only variable of the line that has one."""
    mistake = suspect.finding("object_in_text", suspect.place, name=name)
    mistake = replace(mistake, words={**mistake.words, "field": field, "class": name})
    made = {
        target
        for part in suspect.source.all_nodes
        if isinstance(part, ast.stmt)
        and isinstance(value := getattr(part, "value", None), ast.Call)
        and last_part(dotted(value.func)) == name
        for target in targets_of(part)
    }
    shown = [(code, part) for code, part in _used(suspect) if code in made]
    if len(shown) != 1:
        return replace(mistake, variant="message")
    code, part = shown[0]
    found = suspect.finding("object_in_text", part, name=code, written=f"{code}.{field}")
    words = {**found.words, "field": field, "class": name}
    return replace(found, words=words, variant="of_message")


def _used(suspect: Suspect) -> list[tuple[str, ast.expr]]:
    """Return the variables and attributes in the statement that logs, with their code."""
    place = suspect.place
    module = suspect.source.module_at(place.file if place is not None else "")
    statement = statement_at(module, place.line if place is not None else None)
    return [(dotted(n), n) for n in named_in(statement)] if statement is not None else []


def _list(suspect: Suspect) -> RecognisedMistake | None:
    """The text has a list of texts, which a variable of the line got in square brackets."""
    for code, part in _used(suspect):
        module = suspect.source.module_of(part)
        function = suspect.source.function_around(part)
        values = [
            n.value
            for n in (ast.walk(function) if function is not None else ())
            if isinstance(n, ast.Assign) and code in targets_of(n)
        ]
        if len(values) == 1 and isinstance(values[0], ast.List) and _are_texts(values[0]):
            around = module.parents.get(part)
            call = isinstance(around, ast.Call) and dotted(around.func) == "str"
            at = around if call and isinstance(around, ast.Call) else part
            name = module.text.code(at)
            found = suspect.finding("object_in_text", at, name=name, written=f"''.join({code})")
            words = {**found.words, "line": str(values[0].lineno)}
            return replace(found, words=words, variant="list")
    return None


def _are_texts(found: ast.List) -> bool:
    """Whether all items of a list are texts for certain."""
    return bool(found.elts) and all(
        isinstance(item, ast.JoinedStr)
        or (isinstance(item, ast.Constant) and isinstance(item.value, str))
        or (isinstance(item, ast.Call) and dotted(item.func) == "str")
        for item in found.elts
    )


def _only_unread(suspect: Suspect, *names: str) -> ast.Call | None:
    """Return the only call of these functions whose value is used, and of which no attribute is read."""
    found = [
        call
        for call, name in suspect.source.calls
        if last_part(name) in names
        and not isinstance(
            suspect.source.module_of(call).parents.get(call), ast.Attribute | ast.Expr
        )
    ]
    return found[0] if len(found) == 1 else None


def _parameter(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the only call that gets a parameter and does not ask for its value."""
    call = _only_unread(suspect, "get_parameter", "declare_parameter")
    if call is None:
        return None
    code = suspect.source.module_of(call).text.code(call)
    found = suspect.finding("parameter_object", call, name=code, written=f"{code}.value")
    return replace(found, variant="written") if "\n" not in code else None


def _parameter_value(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the only call of get_parameter_value() of which no field is asked for."""
    call = _only_unread(suspect, "get_parameter_value")
    if call is None or not isinstance(call.func, ast.Attribute):
        return None
    module = suspect.source.module_of(call)
    code, owner = module.text.code(call), module.text.code(call.func.value)
    found = suspect.finding("object_in_text", call, name=code, written=f"{owner}.value")
    return replace(found, variant="parameter_value") if "\n" not in code else None


def _member(suspect: Suspect) -> RecognisedMistake | None:
    """The text has a member of an Enum by its name: the class, a dot, and the member."""
    for match in MEMBER.finditer(suspect.text):
        own = _class_of(suspect, match["name"])
        if own is None or not is_enum(own):
            continue
        # (a number of the count can follow the name without a blank)
        names = [n for s in own.body for n in targets_of(s)]
        name = next((n for n in names if match["member"].startswith(n)), "")
        code = f"{match['name']}.{name}"
        uses = [
            n
            for module in suspect.source.modules
            for n in module.nodes
            if isinstance(n, ast.Attribute) and dotted(n) == code
        ]
        at = uses[0] if len(uses) == 1 else suspect.place
        mistake = suspect.finding("object_in_text", at, name=code, written=f"{code}.value")
        return _with_class(mistake, match["name"], "member") if name else None
    return None


def _told(suspect: Suspect, name: str, variant: str) -> RecognisedMistake:
    mistake = suspect.finding("object_in_text", suspect.place, name=name)
    if variant == "address" and _class_of(suspect, name) is None:
        variant = "of_python"
    return _with_class(mistake, name, variant)


def _with_class(mistake: RecognisedMistake, name: str, variant: str) -> RecognisedMistake:
    return replace(mistake, words={**mistake.words, "class": name}, variant=variant)


def _class_of(suspect: Suspect, name: str) -> ast.ClassDef | None:
    """Return the only class of this name in the files."""
    found = [c for module in suspect.source.modules for c in module.classes if c.name == name]
    return found[0] if len(found) == 1 else None


def _named_otherwise(suspect: Suspect, name: str) -> ast.FunctionDef | None:
    """Return the method that makes a text of an object, under a name of another language.

    Nothing calls it: with another name, all calls would have to change.
    """
    of = _class_of(suspect, name)
    methods = [s for s in of.body if isinstance(s, ast.FunctionDef)] if of is not None else []
    if any(method.name in ("__str__", "__format__") for method in methods):
        return None
    for method in methods:
        plain = len(method.args.args) == 1 and not method.decorator_list
        returns = any(isinstance(n, ast.Return) and n.value is not None for n in ast.walk(method))
        called = any(last_part(called) == method.name for _, called in suspect.source.calls)
        if method.name.replace("_", "").lower() in OTHER_NAMES and plain and returns and not called:
            return method
    return None


def _function(suspect: Suspect, name: str) -> RecognisedMistake:
    """The text has a function: name it with its (), if it can be called with nothing in them."""
    mistake = suspect.finding("object_in_text", suspect.place, name=name)
    known = [n for n in suspect.source.all_nodes if isinstance(n, Function) and n.name == name]
    place = suspect.place
    module = suspect.source.module_at(place.file if place is not None else "")
    statement = statement_at(module, place.line if place is not None else None)
    used = [
        n
        for n in (ast.walk(statement) if statement is not None else ())
        if isinstance(n, ast.Name | ast.Attribute)
        and last_part(dotted(n)) == name
        and getattr(module.parents.get(n), "func", None) is not n
    ]
    code = module.text.code(used[0]) if len(used) == 1 else ""
    if code and len(known) == 1 and _takes_nothing(known[0], used[0]):
        found = suspect.finding("object_in_text", used[0], name=code, written=f"{code}()")
        return replace(found, variant="called")
    return replace(mistake, variant="function")


def _takes_nothing(function: Function, used: ast.expr) -> bool:
    """Whether a function, or a method of an object, can be called with nothing in the ()."""
    given, own = function.args, int(isinstance(used, ast.Attribute))
    needed = len(given.args) - len(given.defaults)
    return needed == own and not given.posonlyargs and not function.decorator_list


WHOLE = msg(
    "Log a value of the object, not the object itself: one of its attributes, or what one of its "
    "methods returns."
)
NO_STR = msg(
    "Python asks the class of an object for __str__ to show it in a text. {class} has no such method: "
    "Python then shows the class and an address."
)
FUNCTION_SHOWN = msg(
    "Without (), the name of a function is the function itself. With (), Python calls it."
)
_node = Family("node", links.PYTHON_CLASSES)
KINDS = (
    _node(
        "object_in_text",
        "text",
        msg("The text shows an object, not its value"),
        msg("Python writes an object into a text in the object's own form."),
        WHOLE,
        whys={
            "address": NO_STR,
            "renamed": NO_STR,
            "function": FUNCTION_SHOWN,
            "called": FUNCTION_SHOWN,
            "member": msg(
                "{class} is an Enum: its members have a name and a value. Such a text shows {name}, the "
                "name of the member."
            ),
            "items": msg(
                "An object of the type {class} has items. A text shows the type and all items with it."
            ),
            "bytes": msg("b'…' is how Python shows bytes in a text. They are not a text."),
            **dict.fromkeys(
                ("message", "of_message"),
                msg(
                    "A message of the type {class} is no number: its value is in its field {field}. A text "
                    "shows the type and the fields with it."
                ),
            ),
            "parameter_value": msg(
                "{name} gives a message that has a field for each type of parameters, and the value is in one of "
                "them. A text shows the whole message. A parameter has its value alone in .value."
            ),
            "list": msg(
                "Square brackets make a list (line {line}). A text shows a list with its brackets, with "
                "the commas, and with the quotes of its texts."
            ),
            "count": msg(
                "An object of itertools.count is not a number. next() returns its next number."
            ),
        },
        fixes={
            "address": msg(
                "Log a value of the object, not the object itself: one of its attributes, or what one "
                "of its methods returns. Or write a method __str__ in the class {class} that returns "
                "the text."
            ),
            "shown": msg(
                "Log a value of the object, not the object itself: one of its attributes, or what one "
                "of its methods returns. Or write a method __str__ in the class {class} that returns "
                "the text."
            ),
            "field": msg(
                "Log only the attribute {field}: write .{field} behind the object of the class {class}."
            ),
            "renamed": msg("Write {written} instead of {name}: Python does not know {name}."),
            "function": msg(
                "Log what {name} returns: write () behind the name, with the values that it needs."
            ),
            **dict.fromkeys(
                ("called", "of_message", "parameter_value"),
                msg("Write {written} instead of {name}."),
            ),
            "message": msg("Log only the field {field}: write .{field} behind the message."),
            "list": msg(
                "Write {written} instead of {name}: it makes one text of the parts. Or add the parts with + "
                "instead of putting them into a list."
            ),
            "member": msg("Write {written} instead of {name}."),
            "items": msg(
                "Log only the item that is the number: write its key or its index in [] behind the object."
            ),
            "bytes": msg(
                "Make a text of the bytes with .decode() before they are logged, or use a text from the "
                "start."
            ),
            "count": msg(
                "Log the number that next() returns, and call next() only once for each line."
            ),
        },
        behind={"run.wrong_text": _shown_object},
        fixed_by=(lines.written,),
        examples=(
            example(
                "to_string_of_another_language",
                Replace(
                    NODE,
                    "class MyFirstNode",
                    "class Ticks:\n    def __init__(self):\n        self.value = 0\n\n"
                    "    def toString(self):\n        return str(self.value)\n\n\nclass MyFirstNode",
                ),
                Replace(NODE, "self.counter_ = 0", "self.counter_ = Ticks()"),
                Replace(NODE, "self.counter_ += 1", "self.counter_.value += 1"),
                fails="run.output",
            ),
            example(
                "member_of_an_enum_in_text",
                Replace(NODE, "import rclpy\n", "from enum import Enum\n\nimport rclpy\n"),
                Replace(
                    NODE,
                    "class MyFirstNode",
                    "class Words(Enum):\n    HELLO = 'Hello time: '\n\n\nclass MyFirstNode",
                ),
                Replace(
                    NODE, "'Hello time: ' + str(self.counter_)", "f'{Words.HELLO}{self.counter_}'"
                ),
                fails="run.output",
            ),
            example(
                "counter_of_collections_in_text",
                Replace(
                    NODE, "import rclpy\n", "from collections import Counter\n\nimport rclpy\n"
                ),
                Replace(NODE, "self.counter_ = 0", "self.counter_ = Counter(time=0)"),
                Replace(NODE, "self.counter_ += 1", "self.counter_['time'] += 1"),
                fails="run.output",
            ),
            example(
                "message_in_text",
                Replace(NODE, "import rclpy\n", "import rclpy\nfrom std_msgs.msg import Int32\n"),
                Replace(NODE, "self.counter_ = 0", "self.counter_ = Int32()"),
                Replace(NODE, "self.counter_ += 1", "self.counter_.data += 1"),
                fails="run.output",
            ),
            example(
                "value_message_of_a_parameter_in_text",
                Replace(
                    NODE,
                    "self.counter_ = 0",
                    "self.declare_parameter('text', 'Hello time: ')\n"
                    "        self.text_ = self.get_parameter('text').get_parameter_value()\n"
                    "        self.counter_ = 0",
                ),
                Replace(
                    NODE, "'Hello time: ' + str(self.counter_)", "f'{self.text_}{self.counter_}'"
                ),
                fails="run.output",
            ),
            example(
                "list_in_text",
                Replace(
                    NODE,
                    LOG_LINE,
                    "        text = ['Hello time: ', str(self.counter_)]\n"
                    "        self.get_logger().info(str(text))\n",
                ),
                fails="run.output",
            ),
            example(
                "method_in_text",
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    def number(self):\n        return self.counter_\n\n    def timer_callback",
                ),
                Replace(
                    NODE, "'Hello time: ' + str(self.counter_)", "f'Hello time: {self.number}'"
                ),
                fails="run.output",
            ),
        ),
    ),
)
