"""Mistakes in the arguments of a call, and calls of functions that only ROS 1 has."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.base.shown import shown
from grader.mistakes import links
from grader.mistakes.constructor import lines_of
from grader.mistakes.ends import ends
from grader.mistakes.example import DEAD, NODE, example
from grader.mistakes.fixes import lines, node_arguments, node_log
from grader.mistakes.kind import Family
from grader.mistakes.recognised import NAME_ERROR, Raised, RecognisedMistake, Suspect, on_line
from grader.package.edit.tree import Replace, Write
from grader.package.source.module import Function, Module
from grader.package.source.names import dotted, last_part, own_name
from grader.package.source.node import NodeSource
from grader.package.source.node_here import node_here
from grader.package.source.place import statement_at

LOGGER_OPTION = (
    r"TypeError: parameter \"(?P<name>\w{1,120})\" is not one of the recognized logging options"
)
UNEXPECTED = (
    r"TypeError: (?P<function>[\w.]{1,200})\(\) got an unexpected keyword argument "
    r"'(?P<name>\w{1,120})'"
)
ROS_1 = {
    "loginfo": "self.get_logger().info(…)",
    "logdebug": "self.get_logger().debug(…)",
    "logwarn": "self.get_logger().warning(…)",
    "logerr": "self.get_logger().error(…)",
    "logfatal": "self.get_logger().fatal(…)",
    "Publisher": "self.create_publisher(…)",
    "Subscriber": "self.create_subscription(…)",
    "Timer": "self.create_timer(seconds, callback)",
    "Rate": "self.create_timer(…)",
    "Service": "self.create_service(…)",
    "get_param": "self.get_parameter(…)",
    "is_shutdown": "not rclpy.ok()",
}
"""What ROS 2 has instead of the functions and classes of rospy."""
OF_BOTH = ("init", "node", "ok", "create_node", "spin_once", "shutdown", "Node")
"""Names that rclpy has: with these, rospy is a wrong name of rclpy."""

OF_ROS_1 = """#!/usr/bin/env python3
import rospy

counter = 0


def timer_callback(event):
    global counter
    rospy.loginfo('Hello time: ' + str(counter))
    counter += 1


def main():
    rospy.init_node('my_first_node')
    rospy.Timer(rospy.Duration(1.0), timer_callback)
    rospy.spin()
"""


def _many(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    for timer in raised.source.timers:
        if raised.line not in (None, *range(timer.call.lineno, (timer.call.end_lineno or 0) + 1)):
            continue
        written = node_arguments.with_comma(raised.source, timer.call)
        if written is not None:
            found = raised.finding("timer_arguments_many", at=timer.call, name=written[0])
            words = {**found.words, "written": written[1]}
            return replace(found, variant="comma", words=words)
        if len(timer.call.args) > 2 and not timer.call.keywords:
            return _first_two(raised, timer.call)
    return None


def _first_two(raised: Raised, call: ast.Call) -> RecognisedMistake:
    """Return that a period and a callback are enough, if the call has them at their places."""
    found = raised.finding("timer_arguments_many", at=call)
    text = raised.source.module_of(call).text
    code = text.code(call)
    period, callback = call.args[:2]
    named = isinstance(callback, ast.Name | ast.Attribute | ast.Lambda)
    if "\n" in code or not named or isinstance(period, ast.Lambda):
        return found
    of_class = dotted(callback).partition(".")[0] in raised.source.class_names
    own = f"self.{last_part(dotted(callback))}" if of_class else text.code(callback)
    written = f"{text.code(call.func)}({text.code(period)}, {own})"
    words = {**found.words, "written": written}
    return replace(found, variant="two", words=words)


def _given_twice(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A value without a name takes the place of a parameter that the call also names."""
    calls = [
        call
        for call, name in raised.source.calls
        if last_part(name) == last_part(match["function"]) and raised.line in lines_of(call)
    ]
    if len(calls) != 1 or not calls[0].args:
        return None
    call, text = calls[0], raised.source.module_of(calls[0]).text
    code, first = text.code(call), text.code(call.args[0])
    params = {"name": match["name"], "given": shown(first)}
    named = {keyword.arg: keyword.value for keyword in call.keywords}
    if last_part(match["function"]) != "create_timer" or "\n" in code or len(call.args) != 1:
        return raised.finding("argument_twice", at=call, params=params)
    if set(named) != {"timer_period_sec"}:
        return raised.finding("argument_twice", at=call, params=params)
    period = text.code(named["timer_period_sec"])
    new = f"{text.code(call.func)}(timer_period_sec={period}, callback={first})"
    params = {"name": code, "written": new, "given": first}
    return replace(raised.finding("argument_twice", at=call, params=params), variant="timer")


def _own_init(source: NodeSource) -> bool:
    """Whether the node's class has no __init__, but a method that is called so without underscores."""
    names = {name.strip("_") for name in source.methods}
    return "__init__" not in source.methods and "init" in names


def _keyword(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    name, function = match["name"], last_part(match["function"])
    if match["function"] == "Node.__init__" and _own_init(raised.source):
        return None  # (that method should be __init__)
    found = raised.finding("keyword_unknown", name=name, function=function)
    if match["function"] == "Node.__init__":
        return replace(found, variant="super")
    if function != "create_timer":
        return found
    plain = [
        timer
        for timer in raised.source.timers
        if raised.line in lines_of(timer.call) and dotted(timer.call.func).startswith("self.")
    ]
    given = [k.value for timer in plain for k in timer.call.keywords] + [
        value for timer in plain for value in timer.call.args
    ]
    own = any(own_name(value) in raised.source.methods for value in given)
    if own:
        return replace(found, variant="timer")
    calls = [timer.call for timer in plain]
    left = _open_names(calls[0]) if len(calls) == 1 else []
    if len(left) == 1:
        params = {"name": f"{name}=", "written": f"{left[0]}="}
        return replace(raised.finding("keyword_unknown", params=params), variant="written")
    return replace(found, variant="timer_names")


def _open_names(call: ast.Call) -> list[str]:
    """Return the first parameters of create_timer that a call gives no value."""
    names = ["timer_period_sec", "callback"][len(call.args) :]
    return [name for name in names if name not in {keyword.arg for keyword in call.keywords}]


def _option(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    found = raised.finding("keyword_unknown", name=match["name"], function="info")
    return replace(found, variant="logger")


def _rospy(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A function of rospy is called, which nothing imports."""
    used = re.search(r"\brospy\.(?P<name>\w{1,120})", raised.module.line(raised.line))
    if match["name"] != "rospy" or used is None:
        return None
    name = used["name"]
    if name == "is_shutdown":
        return _is_shutdown(raised)
    if name in ("spin", "init_node"):
        variant = "init_node" if name == "init_node" else "spin"
        return replace(raised.finding("ros_1", name=name), variant=variant)
    if name == "Rate":
        return _rate(raised)
    new = _of_ros_2(raised, name)
    found = raised.finding("ros_1", name=name, written=new)
    return replace(found, variant="rospy" if new else "rospy_other")


def _of_ros_2(raised: Raised, name: str) -> str:
    """Return what ROS 2 has instead of a name of rospy, as this line can call it; "" if nothing."""
    new, node = ROS_1.get(name, ""), node_here(raised.source, raised.module, raised.line)
    return re.sub(r"\Aself\.", f"{node or 'node'}.", new)


def _rate(raised: Raised) -> RecognisedMistake:
    """Rate, and the loop that sleeps with it: a timer takes the place of both."""
    node = node_here(raised.source, raised.module, raised.line) or "node"
    found = raised.finding("ros_1", name="Rate")
    return replace(found, variant="rate", words={**found.words, "node": node})


def _used_of_rospy(module: Module) -> list[str]:
    """Return what a file uses of rospy that rclpy does not have, in order."""
    found: list[tuple[int, str]] = []
    for node in module.nodes:
        if isinstance(node, ast.Attribute) and dotted(node.value) == "rospy":
            call = module.parents.get(node)
            spins = node.attr == "spin" and isinstance(call, ast.Call) and bool(call.args)
            found += [] if spins else [(node.lineno, node.attr)]
        elif isinstance(node, ast.ImportFrom) and node.module == "rospy":
            found += [(node.lineno, alias.name) for alias in node.names]
    return [name for _, name in sorted(found) if name not in OF_BOTH]


def _for_ros_1(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The file is written for rospy, or uses it beside rclpy."""
    del match
    used = _used_of_rospy(raised.module)
    if not used:
        return None
    name = next((each for each in used if each in ROS_1), used[0])
    found = raised.finding("for_ros_1", name=name, written=ROS_1.get(name, ""))
    if not raised.source.uses_ros:
        return found
    return replace(found, variant="part" if name in ROS_1 else "part_other")


def _many_given(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A call gives more arguments than the function takes."""
    name = last_part(match["function"])
    if match["function"].partition(".")[0] not in {"Node", *raised.source.known_classes}:
        return None
    if any(t.called and raised.line == t.call.lineno for t in raised.source.timers):
        return None  # (the callback is called where it is passed)
    found = raised.finding("arguments_many", name=name)
    if raised.inside and (of_ros := _called_by_ros(raised, match["function"])) is not None:
        return of_ros
    call = raised.source.super_init
    own = match["function"] == "Node.__init__" and call is not None
    if own and call is not None and call.args and dotted(call.args[0]) == "self":
        return None  # (super() passes self on its own)
    if own and call is not None and raised.line in lines_of(call):
        return replace(found, variant="super")
    if name == "__exit__":
        return _exit(raised, found)
    return _only_self(raised, match["function"]) or _of_own(raised, match["function"]) or found


def _of_own(raised: Raised, function: str) -> RecognisedMistake | None:
    """The function is a method of the student's, whose def has fewer parameters than values come."""
    owner, _, method = function.rpartition(".")
    taken = [m for m in _defs(raised.source, owner, method) if not m.decorator_list]
    if len(taken) != 1 or taken[0].args.vararg is not None or method == "__init__":
        return None
    names = [a.arg for a in (*taken[0].args.posonlyargs, *taken[0].args.args)][1:]
    calls = [c for c, name in raised.source.calls if last_part(name) == method]
    if not names or taken[0].args.kwonlyargs or not any(raised.line in lines_of(c) for c in calls):
        return None
    found = raised.finding("arguments_many", name=method)
    words = {**found.words, "line": str(taken[0].lineno), "names": ", ".join(names)}
    return replace(found, words=words, variant="own")


def _defs(source: NodeSource, owner: str, method: str) -> list[Function]:
    """Return the defs of a method of a class."""
    classes = [c for module in source.modules for c in module.classes if c.name == owner]
    return [m for c in classes for m in c.body if isinstance(m, Function) and m.name == method]


def _called_by_ros(raised: Raised, function: str) -> RecognisedMistake | None:
    """The method is the callback of a subscription, and has no parameter for the message."""
    owner, _, method = function.rpartition(".")
    for end in ends(raised.source):
        taken = _defs(raised.source, owner, method)
        if end.kind != "create_subscription" or end.method != method or len(taken) != 1:
            continue
        if [a.arg for a in taken[0].args.args] == ["self"]:
            found = raised.finding("arguments_many", at=taken[0], name=method)
            return replace(found, variant="message")
    return None


def _exit(raised: Raised, found: RecognisedMistake) -> RecognisedMistake:
    """With calls __exit__ with three values."""
    made = [n for n in raised.module.nodes if isinstance(n, Function) and n.name == "__exit__"]
    if len(made) != 1:
        return found
    return replace(raised.finding("arguments_many", at=made[0], name="__exit__"), variant="exit")


def _is_of_object(raised: Raised, taken: Function, name: str, made: str) -> bool:
    """Whether a call is of a method of an object, and not of a class; or of what it creates."""
    owner, _, method = name.rpartition(".")
    return name == made or (
        bool(owner) and method == taken.name and owner not in raised.source.known_classes
    )


def _without_self(raised: Raised, taken: Function) -> RecognisedMistake | None:
    """The method has no self: the object goes into its first parameter."""
    first = taken.args.args[0].arg
    read = [n for n in ast.walk(taken) if isinstance(n, ast.Name) and n.id == first]
    owner = raised.module.parents.get(taken)
    made = owner.name if isinstance(owner, ast.ClassDef) and taken.name == "__init__" else ""
    given = [
        call
        for call, name in raised.source.calls
        if _is_of_object(raised, taken, name, made) and raised.line in lines_of(call)
    ]
    if len(given) != 1 or not read or taken.decorator_list:
        return None
    if len(given[0].args) != len(taken.args.args) or given[0].keywords:
        return None
    params = {"name": f"{taken.name}({first}", "written": f"{taken.name}(self, {first}"}
    found = raised.finding("arguments_many", at=taken, params=params)
    words = {**found.words, "method": taken.name, "parameter": first}
    row = raised.source.module_of(taken).line(taken.lineno)
    words["head"] = row.replace(params["name"], params["written"], 1)
    return replace(found, variant="no_self", words=words)


def _only_self(raised: Raised, function: str) -> RecognisedMistake | None:
    """The function is a method of the student's that takes only self."""
    owner, _, method = function.rpartition(".")
    taken = _defs(raised.source, owner, method)
    if len(taken) == 1 and taken[0].args.args and taken[0].args.args[0].arg not in ("self", "this"):
        return _without_self(raised, taken[0])
    if len(taken) != 1 or len(taken[0].args.args) != 1 or taken[0].args.vararg is not None:
        return None
    wanted = owner if method == "__init__" else method
    for call, name in raised.source.calls:
        if raised.line in lines_of(call) and last_part(name) == wanted and call.args:
            text = raised.source.module_of(call).text
            code, written = text.code(call), f"{text.code(call.func)}()"
            found_call = raised.finding("arguments_many", at=call, name=code, written=written)
            return replace(found_call, variant="only_self")
    return None


def _is_shutdown(raised: Raised) -> RecognisedMistake | None:
    """rospy.is_shutdown() is the contrary of rclpy.ok()."""
    for node in raised.module.nodes:
        if not isinstance(node, ast.Call) or last_part(dotted(node.func)) != "is_shutdown":
            continue
        if raised.line not in lines_of(node):
            continue
        around = raised.module.parents.get(node)
        name, written = raised.module.text.code(node), "not rclpy.ok()"
        if isinstance(around, ast.UnaryOp) and isinstance(around.op, ast.Not):
            name, written = raised.module.text.code(around), "rclpy.ok()"
        found = raised.finding("ros_1", name=name, written=written)
        return replace(found, variant="is_shutdown")
    return None


def _ros_1(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    name = match["name"]
    if name == "is_shutdown":
        return _is_shutdown(raised)
    if name == "init_node":
        return _init_node(raised)
    if name not in ROS_1:
        return None
    if name == "Rate":
        return _rate(raised)
    return raised.finding("ros_1", name=name, written=_of_ros_2(raised, name))


def _init_node(raised: Raised) -> RecognisedMistake:
    """init_node, whose value is kept as the node if there is no class of a node."""
    statement = statement_at(raised.module, raised.line)
    if isinstance(statement, ast.Assign) and raised.source.node_class is None:
        params = {"name": "rclpy.init_node", "written": "rclpy.create_node"}
        return replace(raised.finding("ros_1", params=params), variant="create_node")
    return replace(raised.finding("ros_1", name="init_node"), variant="init_node")


def _outside(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """What belongs to the text is behind the closing bracket of the logger or of print."""
    del match
    return _text_outside(Suspect(raised.source, raised.assignment), raised.module, raised.line)


def _outside_unseen(suspect: Suspect) -> RecognisedMistake | None:
    """The same, where Python can add to what the logger returns."""
    for call in suspect.source.own_logs:
        found = _text_outside(suspect, suspect.source.module_of(call), call.lineno)
        if found is not None:
            return found
    return None


def _text_outside(suspect: Suspect, module: Module, line: int | None) -> RecognisedMistake | None:
    found = node_log.text_outside(suspect.source, module, line)
    if found is None:
        return None
    call, after = found
    written = node_log.text_inside(module, call, after) or ""
    outside = module.text.code(after)[len(module.text.code(call)) :].strip()
    params = {"name": last_part(dotted(call.func)), "outside": shown(outside)}
    mistake = suspect.finding("text_outside", after, **params)
    one_line = written and "\n" not in written
    words = {**mistake.words, "written": written}
    return replace(mistake, variant="written" if one_line else "", words=words)


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "for_ros_1",
        "start",
        msg("The file is written for ROS 1"),
        msg(
            "rospy is the Python library of ROS 1. ROS 2 does not have it: its library is rclpy, "
            "which has other functions and classes. Another name in the import is not enough."
        ),
        msg(
            "Write the node anew for ROS 2. Import it: import rclpy and from rclpy.node import "
            "Node. Write a class that inherits from Node. In its __init__: "
            "super().__init__('{node_name}') and self.create_timer({period}, self.{callback}). In "
            "its method {callback}: self.get_logger().info(…). In {function}: rclpy.init(), an "
            "object of your class, and rclpy.spin(node)."
        ),
        fixes={
            "part": msg(
                "Delete the import of rospy, and write {written} instead of rospy.{name}. Replace "
                "all other uses of rospy too."
            ),
            "part_other": msg("Delete the import of rospy, and all lines that use it."),
        },
        raised={r"No module named 'rospy'": _for_ros_1},
        examples=(
            example("node_of_ros_1", Write(NODE, OF_ROS_1), fails="run.starts"),
            example(
                "loginfo_of_rospy",
                Replace(NODE, "import rclpy\nfrom", "import rclpy\nimport rospy\nfrom"),
                Replace(NODE, "self.get_logger().info", "rospy.loginfo"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "ros_1",
        "callback",
        msg("A function of ROS 1 is used"),
        msg(
            "{name} belongs to rospy, the Python library of ROS 1. In ROS 2 the node itself has "
            "methods for this."
        ),
        msg("Write {written} instead of rclpy.{name}."),
        whys={
            "rate": msg(
                "Rate belongs to rospy, the Python library of ROS 1, where a loop waits with it. In "
                "ROS 2, a timer calls a function once in each period, and spin waits for the timer."
            ),
            "create_node": msg(
                "init_node belongs to rospy, the Python library of ROS 1. In ROS 2, create_node gives "
                "a node with this name."
            ),
            "is_shutdown": msg(
                "is_shutdown belongs to rospy, the Python library of ROS 1. In ROS 2, rclpy.ok() is "
                "true until ROS is shut down."
            ),
        },
        fixes={
            "is_shutdown": msg("Write {written} instead of {name}."),
            "create_node": msg("Write {written} instead of {name}."),
            "rate": msg(
                "Write the lines of the loop that log and count into a function of their own, and let "
                "a timer call it: {node}.create_timer({period}, and the name of that function). Then "
                "write rclpy.spin({node}) instead of the loop, and delete this line."
            ),
            "init_node": msg(
                "Delete the line with init_node: in ROS 2, super().__init__('{node_name}') gives "
                "the node its name."
            ),
            "rospy": msg("Write {written} instead of rospy.{name}."),
            "rospy_other": msg("Remove rospy.{name}: ROS 2 has no rospy."),
            "spin": msg("Write rclpy.spin({node}) instead of rospy.spin()."),
        },
        seen=r"AttributeError: module 'rclpy' has no attribute '(?P<name>loginfo)'",
        raised={
            r"module 'rclpy' has no attribute '(?P<name>\w{1,120})'": _ros_1,
            NAME_ERROR: _rospy,
        },
        fixed_by=(
            node_arguments.ros_2_log,
            node_arguments.ros_2_timer,
            node_arguments.without_init_node,
            lines.written,
        ),
        examples=(
            example(
                "is_shutdown_of_ros_1",
                Replace(
                    NODE,
                    "        rclpy.spin(node)",
                    "        while not rclpy.is_shutdown():\n            rclpy.spin_once(node)",
                ),
                fails="run.starts",
            ),
            example(
                "loginfo_of_ros_1",
                Replace(NODE, "self.get_logger().info", "rclpy.loginfo"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "timer_of_rospy",
                Replace(NODE, "self.create_timer(1.0,", "rospy.Timer(rospy.Duration(1.0),"),
                fails="run.starts",
            ),
            example(
                "init_node_of_ros_1",
                Replace(
                    NODE,
                    "node = MyFirstNode()",
                    "node = MyFirstNode()\n    rclpy.init_node('my_first_node')",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "timer_arguments_many",
        "timer",
        msg("create_timer gets more than a period and a callback"),
        msg(
            "create_timer takes the period first, then the callback. Commas separate arguments. A "
            "third argument would be a callback group."
        ),
        msg("Write self.create_timer({period}, self.{callback})"),
        fixes={
            "comma": msg(
                "Write {written} instead of {name}: a decimal number has a point in Python. With "
                "the comma it is two arguments."
            ),
            "two": msg("Write {written}: a period and a callback are enough."),
        },
        raised={
            "has no attribute 'add_entity'": _many,
            r"create_timer\(\) takes from \d to \d positional arguments but": _many,
        },
        fixed_by=(node_arguments.decimal_point, node_arguments.third),
        examples=(
            example("decimal_comma", Replace(NODE, "(1.0,", "(1,0,"), fails="run.starts"),
            example(
                "third_argument_of_timer",
                Replace(NODE, "self.timer_callback)", "self.timer_callback, self)"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "text_outside",
        "logger",
        msg("A part of the text is behind the closing bracket"),
        msg(
            "Python calls {name} first, and then uses {outside} on what {name} returns, which is "
            "no text."
        ),
        msg("Move {outside} into the brackets of {name}, directly behind the text."),
        links.PYTHON_STRINGS,
        fixes={"written": msg("Move {outside} into the brackets of {name}: {written}")},
        seen=r"AttributeError: '(?:bool|NoneType)' object has no attribute 'format'",
        raised={
            r"'(?:bool|NoneType)' object has no attribute '\w{1,120}'": _outside,
            r"unsupported operand type\(s\) for [+%]: '(?:bool|NoneType)' and": _outside,
            r"ZeroDivisionError: ": _outside,
        },
        behind={"run.wrong_text": _outside_unseen},
        fixed_by=(node_log.moved_inside,),
        examples=(
            example(
                "format_outside",
                Replace(
                    NODE,
                    "'Hello time: ' + str(self.counter_))",
                    "'Hello time: {}').format(self.counter_)",
                ),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "plus_outside",
                Replace(NODE, "'Hello time: ' + str", "'Hello time: ') + (str"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "number_added_outside",
                Replace(
                    NODE,
                    "'Hello time: ' + str(self.counter_))",
                    "'Hello time: ') + self.counter_",
                ),
                fails="run.output",
            ),
            example(
                "percent_outside",
                Replace(
                    NODE,
                    "'Hello time: ' + str(self.counter_))",
                    "'Hello time: %d') % self.counter_",
                ),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "arguments_many",
        "callback",
        msg("A call has too many arguments"),
        msg("{name} takes fewer arguments than this call gives it. Python passes self on its own."),
        msg("Remove what is too much from the () of {name}."),
        links.PYTHON_ERRORS,
        whys={
            "only_self": msg(
                "The def has only self in its brackets, which Python passes on its own."
            ),
            "exit": msg(
                "with calls __exit__ at its end, with three values: the class of the exception, the "
                "exception, and its traceback. Python passes self on its own."
            ),
            "message": msg(
                "A subscription calls its callback with one value after self: the message. The def of {name} "
                "has no parameter for it."
            ),
            "own": msg(
                "The def of {name} (line {line}) has these parameters besides self: {names}. This call gives "
                "it more values."
            ),
            "no_self": msg(
                "The def of {method} has no self. Python passes the object as the first argument, so "
                "{parameter} gets the object, and the value of the call has no place."
            ),
        },
        fixes={
            "exit": msg("Write: def __exit__(self, kind, value, trace):"),
            "message": msg("Write: def {name}(self, msg):"),
            "own": msg(
                "Give {name} one value for each of its parameters. Several texts become one with + between "
                "them. Or add a parameter to def {name}, if it needs one more value."
            ),
            "no_self": msg("Write self before {parameter} in this line: {head}"),
            "super": msg("Write super().__init__('{node_name}')."),
            "only_self": msg("Write {written} instead of {name}."),
        },
        raised={
            (
                r"TypeError: (?P<function>\w{1,120}\.\w{1,120})\(\) takes [1-9] positional "
                r"arguments? but \d{1,2} were given"
            ): _many_given
        },
        fixed_by=(node_arguments.only_name, lines.written),
        examples=(
            example(
                "name_given_where_made",
                Replace(NODE, "node = MyFirstNode()", "node = MyFirstNode('my_first_node')"),
                fails="run.starts",
            ),
            example(
                "two_names_for_node",
                Replace(NODE, "('my_first_node')", "('my_first_node', 'robot')"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "argument_twice",
        "callback",
        msg("A call gives one parameter two values"),
        msg(
            "Values without a name go to the parameters in their order. Here the place of {name} gets a "
            "value, and {name}= gives it another one."
        ),
        msg(
            "If a value without a name, such as {given}, is meant for another parameter, write the name of "
            "that parameter and = before it. Otherwise delete one of the two values."
        ),
        links.PYTHON_ERRORS,
        whys={
            "timer": msg(
                "The first value without a name is the period, timer_period_sec. So {given} takes its "
                "place, and timer_period_sec= gives it a second value."
            )
        },
        fixes={"timer": msg("Write {written}")},
        raised={
            r"TypeError: (?P<function>[\w.]{1,200})\(\) got multiple values for argument "
            r"'(?P<name>\w{1,120})'": on_line(_given_twice)
        },
        fixed_by=(lines.written,),
        examples=(
            example(
                "period_given_twice",
                Replace(
                    NODE,
                    "(1.0, self.timer_callback)",
                    "(self.timer_callback, timer_period_sec=1.0)",
                ),
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
        links.PYTHON_ERRORS,
        fixes={
            "timer": msg("Write self.create_timer({period}, self.{callback})"),
            "written": msg("Write {written} instead of {name} in this call."),
            "timer_names": msg(
                "The first parameters of create_timer are timer_period_sec and callback. Write one of "
                "these names instead of {name}, or remove {name}=…"
            ),
            "logger": msg("Remove {name}=…: the logger does not have this option."),
            "super": msg("Write super().__init__('{node_name}')."),
        },
        raised={UNEXPECTED: _keyword, LOGGER_OPTION: _option},
        fixed_by=(
            node_arguments.without_names,
            node_arguments.without_option,
            node_arguments.only_name,
            lines.written,
        ),
        examples=(
            example(
                "keyword_of_node",
                Replace(NODE, "('my_first_node')", "(name='my_first_node')"),
                fails="run.starts",
            ),
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
)
