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
from grader.mistakes import links
from grader.mistakes.example import DEAD, LOG_LINE, NODE, example
from grader.mistakes.kind import Family
from grader.mistakes.recognised import FromError, Raised, RecognisedMistake, always, on_line
from grader.package.edit.tree import Replace
from grader.package.source.counter import targets_of
from grader.package.source.module import Function
from grader.package.source.names import called_name, dotted, own_name

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
    found = raised.finding("none_used", name=code)
    function = _gives_nothing(raised, used[0])
    if function is None:
        return found
    words = {**found.words, "function": function.name, "line": function.lineno}
    return replace(found, words=words, variant="function")


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
    return _told("no_such_item", "key")(raised, match)


def _too_many_values(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The text before % has too few places; it can be a value that should be a number."""
    left = [
        n.left for n in _on_line(raised) if isinstance(n, ast.BinOp) and isinstance(n.op, ast.Mod)
    ]
    written = any(isinstance(n, ast.Constant | ast.JoinedStr) for n in left)
    return _told("text_and_values", "" if written else "left")(raised, match)


def _no_file(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The path is relative, or a whole one, of a file that is read or written."""
    calls = [n for n in _on_line(raised) if isinstance(n, ast.Call)]
    if any(called_name(call) in STARTERS for call in calls):
        return None
    if any(_writes(call) for call in calls):
        return _told("no_such_file", "written")(raised, match)
    whole = match["name"].startswith("'/")
    return _told("no_such_file", "whole" if whole else "")(raised, match)


def _writes(call: ast.Call) -> bool:
    """Whether a call opens a file to write it."""
    given = [*call.args[:2], *(w.value for w in call.keywords if w.arg == "mode")]
    modes = [n.value for n in given[-1:] if isinstance(n, ast.Constant)]
    mode = str(modes[0]) if modes else ""
    opens = called_name(call) == "open" and re.fullmatch(r"[wax][bt+]*", mode) is not None
    return opens or called_name(call) in ("write_text", "write_bytes", "mkdir")


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
        },
        fixes={
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
            r"'NoneType' object is not (?:subscriptable|iterable)": on_line(_none_operand),
        },
        examples=(
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
            "function": msg("name[…] reads one item. A function has no items: it is called."),
            "each": msg(
                "Only a value that consists of items can be unpacked or used behind in. The type {first} has none."
            ),
            "set": msg("name[…] = … sets one item. The items of the type {first} cannot be set."),
            "join": msg("join() puts texts together. One item of this list has the type {first}."),
            "sign": msg(
                "{operator} in front of a value needs a number. This value has the type {first}."
            ),
            "whole": msg("A whole number is needed here, and this value has the type {first}."),
            "number": msg("int() makes a number only of digits. It cannot read {text}."),
            "returned": msg("Python calls {operator} and needs a {first} from it."),
        },
        fixes={
            "items": msg("Look in which line this value is set, or remove the […]."),
            "function": ROUND,
            "each": msg(
                "Find out which value on this line has the type {first}, and which line gives it. To repeat "
                "something n times, write range(n)."
            ),
            "set": msg("Make a new value instead, or use a list."),
            "join": msg("Convert each item to a text first: str(…)."),
            "sign": msg("Find the line that gives this value: it must be a number there."),
            "whole": msg("Convert the value with int(…), or write a number without a point."),
            "number": msg(
                "Give int() a text that has only digits. float() also reads numbers with a point."
            ),
            "returned": msg(
                "Look at each return in {operator}: its value must be a {first}. Without a return, the "
                "value is None."
            ),
        },
        raised={
            r"'(?P<first>method|function|builtin_function_or_method|type)' object is not subscriptable": (
                _told("types_do_not_fit", "function")
            ),
            r"'(?P<first>\w{1,60})' object is not subscriptable": _told(
                "types_do_not_fit", "items"
            ),
            r"'(?P<first>\w{1,60})' object is not iterable": _told("types_do_not_fit", "each"),
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
            r"bad operand type for unary (?P<operator>\S{1,3}): '(?P<first>\w{1,60})'": (
                _told("types_do_not_fit", "sign")
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
        examples=(
            example(
                "start_is_a_text_compared",
                Replace(NODE, LOG_LINE, f"        if self.counter_ < '5':\n    {LOG_LINE}"),
                fails="run.output",
                blocks=DEAD,
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
        "text_and_values",
        "text",
        msg("The text and its values do not fit together"),
        msg(
            "With %, a text has one place for each value: %d for a whole number, %s for anything. "
            "This text has another number of places than there are values."
        ),
        msg("Give the text one place for each value. A text with {{}} needs .format(…) and no %."),
        whys={
            "type": msg(
                "The place %d in a text needs a number, and gets a value of the type {first}."
            ),
            "left": msg(
                "The value before % is a text on this line. Then % puts values into the places of the text, "
                "such as %d, and this text has fewer places than there are values. Between two numbers, % "
                "gives the remainder."
            ),
        },
        fixes={
            "type": msg("Write %s in the text, or give it a number."),
            "left": msg(
                "If you want the remainder, find the line that gives the value before %, and make it a "
                "number there. If you want to fill a text, give it one place for each value."
            ),
        },
        raised={
            r"not all arguments converted during string formatting": on_line(_too_many_values),
            r"not enough arguments for format string": _told("text_and_values"),
            r"%[a-z] format: a (?:real )?number is required, not (?P<first>\w{1,60})": (
                _told("text_and_values", "type")
            ),
        },
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
        },
        fixes={
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
        examples=(
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
            "written": msg(
                "Python creates a file that is opened to be written, but not the folder that contains it. "
                "A path that does not begin with / begins in the folder in which ros2 run is started."
            ),
        },
        fixes={
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
            r"catching classes that do not inherit from BaseException": _told("not_an_exception"),
            r"exceptions must derive from BaseException": _told("not_an_exception", "raised"),
        },
        whys={
            "raised": msg("raise takes an exception, for example ValueError('text')."),
        },
        fixes={
            "raised": msg("Write an exception behind raise, or remove that line."),
        },
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
                _told("not_for_with")
            )
        },
        examples=(
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
