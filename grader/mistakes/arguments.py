"""Mistakes in the arguments of a call: too few, too many, or with a name that the function does not have."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.constructor import lines_of
from grader.mistakes.ends import ends
from grader.mistakes.example import DEAD, INNER, NODE, example
from grader.mistakes.fixes import lines, node_life
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.package.edit.tree import Replace, Write
from grader.package.source.module import Function
from grader.package.source.names import dotted, last_part
from grader.package.source.node import NodeSource
from grader.package.source.node_here import node_here

LOGGER_OPTION = (
    r"TypeError: parameter \"(?P<name>\w{1,120})\" is not one of the recognized logging options"
)
UNEXPECTED = (
    r"TypeError: (?P<function>[\w.]{1,200})\(\) got an unexpected keyword argument "
    r"'(?P<name>\w{1,120})'"
)


def _missing(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A call has too few values: tell for which parameters, and of which function."""
    names = ", ".join(re.findall(r"'(\w{1,120})'", match["names"]))
    owner = match["function"].rpartition(".")[0]
    params = {"name": names, "function": match["function"]}
    found = raised.finding("argument_missing", params=params)
    if match["function"] == "spin":
        node = node_here(raised.source, raised.module, raised.line)
        words = {**found.words, "node": node or "node"}
        return replace(found, words=words, variant="spin")
    if match["name"] == "self" and owner:
        return _of_class(raised, match["function"], params)
    return found


def _of_class(raised: Raised, function: str, params: dict[str, str]) -> RecognisedMistake | None:
    """A method is named through its class: tell where that is."""
    at = [n for n in raised.source.all_nodes if dotted(n) == function]
    if len(at) == 1 and isinstance(at[0], ast.expr):
        found = raised.finding("argument_missing", at=at[0], params=params)
    elif raised.inside:
        return None
    else:
        found = raised.finding("argument_missing", params=params)
    return replace(found, variant="class")


def _of_timer(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    for timer in raised.source.timers:
        if raised.line in (None, *lines_of(timer.call)) and len(timer.call.args) > 2:
            return raised.finding("timer_arguments_many", at=timer.call)
    return None


def _many(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A call gives more arguments than the function takes."""
    name = last_part(match["function"])
    owner = match["function"].rpartition(".")[0]
    if any(t.called and raised.line == t.call.lineno for t in raised.source.timers):
        return None  # (the callback is called where it is passed)
    found = raised.finding("arguments_many", name=name)
    taken = _defs(raised.source, owner, name)
    if len(taken) != 1:
        return None if raised.inside else found
    given = [argument.arg for argument in taken[0].args.args]
    if not taken[0].decorator_list and given[:1] not in (["self"], ["this"]):
        row = raised.source.module_of(taken[0]).line(taken[0].lineno)
        written = row.replace(f"{name}(", f"{name}(self{', ' if given else ''}", 1)
        found = raised.finding("arguments_many", at=taken[0], name=row, written=written)
        return replace(found, variant="no_self", words={**found.words, "method": name})
    ways = [end.kind for end in ends(raised.source) if end.method == name]
    if ways == ["create_subscription"] and given == ["self"]:
        return replace(raised.finding("arguments_many", at=taken[0], name=name), variant="message")
    return None if raised.inside else found


def _defs(source: NodeSource, owner: str, method: str) -> list[Function]:
    """Return the defs of a method of a class, or of a method whose class Python did not name."""
    classes = [c for module in source.modules for c in module.classes if owner in ("", c.name)]
    return [m for c in classes for m in c.body if isinstance(m, Function) and m.name == method]


def _keyword(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    function = match.groupdict().get("function") or "info"
    return raised.finding("keyword_unknown", name=match["name"], function=last_part(function))


_node = Family("node", links.PYTHON_ERRORS)
KINDS = (
    _node(
        "timer_arguments_many",
        "timer",
        msg("create_timer gets more than a period and a callback"),
        msg(
            "create_timer takes the period first, then the callback. Commas separate arguments, and a "
            "decimal number has a point. A third argument would be a callback group."
        ),
        msg("Write self.create_timer({period}, self.{callback})"),
        links.FIRST_NODE,
        raised={
            "has no attribute 'add_entity'": _of_timer,
            r"create_timer\(\) takes from \d to \d positional arguments but": _of_timer,
        },
        examples=(example("decimal_comma", Replace(NODE, "(1.0,", "(1,0,"), fails="run.starts"),),
    ),
    _node(
        "arguments_many",
        "callback",
        msg("A call has too many arguments"),
        msg("{name} takes fewer arguments than this call gives it. Python passes self on its own."),
        msg("Remove what is too much from the () of {name}."),
        whys={
            "message": msg(
                "A subscription calls its callback with one value after self: the message. The def of {name} "
                "has no parameter for it."
            ),
            "no_self": msg(
                "The def of {method} has no self. Python passes the object as the first argument, and the "
                "def has no parameter for it."
            ),
        },
        fixes={
            "no_self": msg("Write: {written}"),
            "message": msg("Write: def {name}(self, msg):"),
        },
        raised={
            (
                r"TypeError: (?P<function>(?:\w{1,120}\.)?\w{1,120})\(\) takes \d positional "
                r"arguments? but \d{1,2} (?:was|were) given"
            ): _many
        },
        fixed_by=(lines.written,),
        examples=(
            example(
                "name_given_where_made",
                Replace(NODE, "node = MyFirstNode()", "node = MyFirstNode('my_first_node')"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "keyword_unknown",
        "callback",
        msg("A call names a parameter that the function does not have"),
        msg("name=value in a call works only for names that the function knows."),
        msg(
            "Look up the parameters of {function}: write the right name instead of {name}, or remove {name}=…"
        ),
        raised={UNEXPECTED: _keyword, LOGGER_OPTION: _keyword},
        examples=(
            example(
                "keyword_of_timer",
                Replace(
                    NODE, "(1.0, self.timer_callback)", "(period=1.0, callback=self.timer_callback)"
                ),
                fails="run.starts",
            ),
            example(
                "print_argument",
                Replace(NODE, "str(self.counter_))", "str(self.counter_), end='')"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "argument_missing",
        "callback",
        msg("A call has too few arguments"),
        msg("A parameter without a default needs a value in each call."),
        msg("Write a value for {name} in the () of {function}, where it is called."),
        whys={
            "class": msg(
                "{function} works on an object: Python passes the object as self. Nothing is passed if the "
                "method is called on the class."
            )
        },
        fixes={
            "class": msg(
                "This line uses the class itself, and not an object of it. Pass the object, if one was "
                "made before, such as the node. If none was, write () after the name of the class."
            ),
            "spin": msg("Write rclpy.spin({node}): spin needs the node that was created."),
        },
        raised={
            r"TypeError: (?P<function>[\w.]{1,200})\(\) missing \d{1,3} required positional arguments?: (?P<names>'(?P<name>\w{1,120})'.{0,400})": _missing
        },
        fixed_by=(node_life.spin,),
        examples=(
            example(
                "method_called_on_its_class",
                Write(
                    f"{INNER}/speaker.py",
                    "class Speaker:\n    def words(self, number):\n"
                    "        return 'Hello time: ' + str(number)\n",
                ),
                Replace(
                    NODE,
                    "import rclpy\n",
                    "import rclpy\n\nfrom my_robot_controller.speaker import Speaker\n",
                ),
                Replace(
                    NODE, "'Hello time: ' + str(self.counter_)", "Speaker.words(self.counter_)"
                ),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "init_wants_name",
                Replace(NODE, "def __init__(self)", "def __init__(self, name)"),
                Replace(NODE, "super().__init__('my_first_node')", "super().__init__(name)"),
                fails="run.starts",
            ),
            example(
                "log_without_text",
                Replace(NODE, ".info('Hello time: ' + str(self.counter_))", ".info()"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
)
