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
from grader.mistakes.example import DEAD, NODE, example
from grader.mistakes.kind import Family
from grader.mistakes.recognised import FromError, Raised, RecognisedMistake, always, on_line
from grader.package.edit.tree import Replace
from grader.package.source.counter import targets_of
from grader.package.source.module import Function
from grader.package.source.names import called_name, dotted, own_name

STARTERS = ("run", "Popen", "call", "check_call", "check_output", "execv", "execvp", "spawn")
MOST_CODE = 60  # characters of a piece of code that a text shows
Named = ast.Name | ast.Attribute | ast.Call
TYPE = r"(?P<first>\w{1,60})"


def _told(slug: str, variant: str = "") -> FromError:
    """Return a function that finds `node.slug` with the groups of its pattern as words.

    It finds it only if the student's line itself raised the error.
    """

    def found(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
        return replace(raised.finding(slug, params=match.groupdict("")), variant=variant)

    return on_line(found)


def _none(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    """Something is done with None: tell what is None, and why if the source shows it."""
    attribute = match.groupdict().get("name")
    parts = [n for n in _on_line(raised) if isinstance(n, Named)]
    if attribute:
        parts = _owners(parts, attribute)
    code = {raised.module.text.code(part): _gives_nothing(raised, part) for part in parts}
    known = {name: function for name, function in code.items() if function is not None}
    if len(known) == 1:
        [(name, function)] = known.items()
        mistake = raised.finding("none_used", name=name)
        words = {**mistake.words, "function": function.name, "line": function.lineno}
        return replace(mistake, words=words, variant="function")
    short = [name for name in code if len(name) <= MOST_CODE and "\n" not in name]
    if attribute and len(short) == 1:
        return raised.finding("none_used", name=short[0])
    return replace(raised.finding("none_used"), variant="line")


def _owners(parts: list[Named], attribute: str) -> list[Named]:
    """Return what stands before the dot and the name of an attribute."""
    owners = [n.value for n in parts if isinstance(n, ast.Attribute) and n.attr == attribute]
    return [n for n in owners if isinstance(n, Named)]


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
    calls, name = [part] if isinstance(part, ast.Call) else [], dotted(part)
    if name and not calls:
        sets = [n for n in raised.source.own_nodes if isinstance(n, ast.Assign)]
        values = [n.value for n in sets if name in targets_of(n)]
        calls = [value for value in values if isinstance(value, ast.Call)]
    functions = [_called(raised, call) for call in calls] if len(calls) == 1 else []
    return next((f for f in functions if f is not None and not _has_value(f)), None)


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


def _no_key(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A key is missing; format() says the same of a name that it gets no value for."""
    line = list(_on_line(raised))
    calls = [called_name(n) for n in line if isinstance(n, ast.Call)]
    read = [n.slice for n in line if isinstance(n, ast.Subscript)]
    written = any(isinstance(n, ast.Constant) and repr(n.value) == match["name"] for n in read)
    if not written and any(name in ("format", "format_map", "substitute") for name in calls):
        return _told("text_and_values", "format")(raised, match)
    return _told("no_such_item", "key")(raised, match)


def _no_file(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A file is read or written that is not there; not the program that a line starts."""
    calls = [n for n in _on_line(raised) if isinstance(n, ast.Call)]
    if any(called_name(call) in STARTERS for call in calls):
        return None
    return _told("no_such_file", "written" if any(map(_writes, calls)) else "")(raised, match)


def _writes(call: ast.Call) -> bool:
    """Whether a call opens a file to write it."""
    given = [*call.args[:2], *(w.value for w in call.keywords if w.arg == "mode")]
    mode = "".join(str(n.value) for n in given[-1:] if isinstance(n, ast.Constant))
    opens = called_name(call) == "open" and re.fullmatch(r"[wax][bt+]*", mode) is not None
    return opens or called_name(call) in ("write_text", "write_bytes", "mkdir")


def _value_called(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A value is called on that line, or by ROS, to which a timer gave it as a callback."""
    params = {"type": match.groupdict("").get("type", "")}
    found = raised.finding("not_callable", params=params)
    by_ros = raised.inside or "spin" in raised.module.line(raised.line)
    if not by_ros and "is not callable" in match[0]:
        return found
    for timer in raised.source.timers:
        if timer.callback is not None and timer.method not in raised.source.methods:
            found = raised.finding("not_callable", at=timer.call, params=params)
            return replace(found, variant="passed")
    return None


NONE_IN = r"(?:'NoneType' and '\w{1,60}'|'\w{1,60}' and 'NoneType')"
_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "none_used",
        "callback",
        msg("A value is None, and something else is needed"),
        msg(
            "A function without return gives back None, and a name that was set to None has this value."
        ),
        msg("Find the line that gives {name} its value, and see why it is None."),
        whys={
            "function": msg(
                "{function} (line {line}) has no return with a value, so {name} is None."
            ),
        },
        fixes={
            "function": msg(
                "If {function} is meant to give a value, write return and the value at its end. If not, do not use "
                "what it gives back."
            ),
            "line": msg("Find out which value on that line is None, and which line set it."),
        },
        raised={
            r"AttributeError: 'NoneType' object has no attribute '(?P<name>\w{1,120})'": on_line(
                _none
            ),
            rf"unsupported operand type\(s\) for .{{1,20}}: {NONE_IN}": on_line(_none),
            rf"not supported between instances of {NONE_IN}": on_line(_none),
            r"can only concatenate str \(not \"NoneType\"\)": on_line(_none),
            r"'NoneType' object is not (?:subscriptable|iterable)": on_line(_none),
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
        "not_callable",
        "callback",
        msg("A value is called like a function"),
        msg("() after a name calls it, and a value of this type cannot be called."),
        msg(
            "This line calls a value of the type {type}. If the value is meant, remove the () behind "
            "its name. If a function is meant, a line has given its name this value: give the value "
            "another name there."
        ),
        links.PYTHON_ERRORS,
        whys={
            "passed": msg(
                "The timer calls what create_timer gets, so it must be a method or a function."
            )
        },
        seen=r"TypeError: '(?P<type>(?!NoneType)\w{1,60})' object is not callable",
        fixes={"passed": msg("Write self.create_timer({period}, self.{callback})")},
        raised={
            r"TypeError: '(?P<type>\w{1,60})' object is not callable": _value_called,
            r"TypeError: (?P<type>[\w.'\"-]{1,60}) is not a callable object": _value_called,
            r"UnboundLocalError: .{0,60}'(?P<type>arg_name)'": _value_called,
        },
        examples=(
            example(
                "counter_called",
                Replace(NODE, "str(self.counter_)", "str(self.counter_())"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "timer_gets_counter",
                Replace(NODE, "self.timer_callback)", "self.counter_)"),
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
            "Look in which line each of the two gets its value, and which type is meant. If one is a text and "
            "should be a number, int(…) or float(…) makes one; str(…) makes a text of a number."
        ),
        whys={
            "function": msg("name[…] reads one item. A function has no items: it is called."),
            "one": msg("What this line does with a value does not work with the type {first}."),
            "power": msg("^ works on the bits of whole numbers. A power is written **."),
            "number": msg("int() and float() read only a number. They cannot read {text}."),
        },
        fixes={
            "function": msg("A call is written with (), not with []: replace the square brackets."),
            "one": msg(
                "Find out which value on this line has the type {first}, and which line gives it. str(…) "
                "makes a text of a number, int(…) a whole number, and range(n) repeats something n times."
            ),
            "power": msg("Write ** instead of ^ if you mean a power."),
            "number": msg(
                "If this must be a number, correct the line that gives {text}. If another text may come, ask "
                "before: if text.isdigit():, or try: and except ValueError:."
            ),
        },
        raised={
            **{
                pattern: _told("types_do_not_fit", "one")
                for pattern in (
                    rf"'(?!method|function|builtin_function|type'){TYPE}' object is not subscriptable",
                    rf"'{TYPE}' object is not iterable",
                    rf"argument of type '{TYPE}' is not iterable",
                    rf"cannot unpack non-iterable {TYPE} object",
                    rf"'{TYPE}' object does not support item assignment",
                    rf"expected str instance, {TYPE} found",
                    rf"bad operand type for unary \S{{1,3}}: '{TYPE}'",
                    rf"'{TYPE}' object cannot be interpreted as an integer",
                    rf"__\w{{1,30}}__ returned non-{TYPE}",
                    rf"can only concatenate {TYPE} \(not",
                )
            },
            r"'(?:method|function|builtin_function_or_method|type)' object is not subscriptable": (
                _told("types_do_not_fit", "function")
            ),
            r"type '\w{1,60}' is not subscriptable": _told("types_do_not_fit", "function"),
            r"(?:invalid literal for int\(\) with base 10|could not convert string to float): "
            r"(?P<text>'[^'\n]{0,60}')": _told("types_do_not_fit", "number"),
            r"type\(s\) for \^: '(?:float|int)' and '(?:float|int)'": _told(
                "types_do_not_fit", "power"
            ),
            rf"unsupported operand type\(s\) for (?P<operator>\S{{1,3}})(?: or \S{{1,5}})?: "
            rf"'{TYPE}' and '(?P<second>\w{{1,60}})'": _told("types_do_not_fit"),
            rf"'(?P<operator>[<>=]{{1,2}})' not supported between instances of '{TYPE}' and "
            r"'(?P<second>\w{1,60})'": _told("types_do_not_fit"),
        },
        examples=(
            example(
                "info_in_square_brackets",
                Replace(
                    NODE,
                    ".info('Hello time: ' + str(self.counter_))",
                    ".info['Hello time: ' + str(self.counter_)]",
                ),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "counter_is_tuple",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = 0,"),
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
            "Between two numbers, % gives the remainder."
        ),
        msg(
            "Give the text before % one place for each value, and each place a value of its type. A text with "
            "{{}} needs .format(…) and no %. If the remainder is meant, the value before % has to be a number."
        ),
        whys={
            "format": msg(
                "format() puts the values of its () in the places of the text. A place with a name needs "
                "name=value in the (), and {{}} takes the next value."
            )
        },
        fixes={
            "format": msg(
                "Give each place of the text a value in the () of format, or write an f-string: it reads the "
                "variables themselves. The first value has the number 0."
            )
        },
        raised={
            r"not all arguments converted during string formatting": _told("text_and_values"),
            r"not enough arguments for format string": _told("text_and_values"),
            r"%[a-z] format: a (?:real )?number is required": _told("text_and_values"),
            r"IndexError: Replacement index \d{1,9} out of range": (
                _told("text_and_values", "format")
            ),
        },
        examples=(
            example(
                "format_without_values",
                Replace(
                    NODE,
                    "'Hello time: ' + str(self.counter_)",
                    "'Hello time: {self.counter_}'.format()",
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
        ),
    ),
    _node(
        "no_such_file",
        "start",
        msg("A file is opened that is not there"),
        msg(
            "A path that does not begin with / is looked for in the folder in which ros2 run is "
            "started, and not beside the file of the node. The folders of one computer do not exist on "
            "another one."
        ),
        msg(
            "Write the values that the program takes from {name} into the program, in place of what "
            "opens and reads the file. If it must be a file, let setup.py install it: add it to the list "
            "with 'package.xml' in data_files, and build again. Then open it in the folder that "
            "get_package_share_directory('{package}') returns (from ament_index_python.packages)."
        ),
        whys={
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
            "commas. raise takes an exception, for example ValueError('text')."
        ),
        msg(
            "Write the name of the class, without quotes, behind except without (). Put several names in "
            "round brackets."
        ),
        raised={
            r"catching classes that do not inherit from BaseException"
            r"|exceptions must derive from BaseException": _told("not_an_exception"),
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
)
