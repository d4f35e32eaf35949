"""Mistakes with classes and their objects: what main makes, what the timer gets, what replaces what."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.constructor import PRIVATE
from grader.mistakes.example import DATACLASS_IMPORTED, DEAD, NODE, SILENT, STEP_LINE, example
from grader.mistakes.fixes import lines, node_classes
from grader.mistakes.kind import Family
from grader.mistakes.order import spun_names
from grader.mistakes.recognised import (
    MISSING_ARGUMENT,
    NAME_ERROR,
    OWN_ATTRIBUTE,
    Raised,
    RecognisedMistake,
    Suspect,
    of_self,
)
from grader.package.edit.tree import Replace
from grader.package.source.counter import targets_of
from grader.package.source.module import Function
from grader.package.source.names import calls_in, dotted, last_part
from grader.package.source.node import LOG_METHODS, NodeSource
from grader.package.source.parameters import needed_besides_self
from grader.package.source.place import function_at

TIMER = "        self.create_timer(1.0, self.timer_callback)\n"
NEEDED = ("create_timer", "__init__", *LOG_METHODS)
"""What a method must call, or else no line comes."""
CALLED_ON_CLASS = (
    r"TypeError: (?P<method>(?:\w{1,120}\.)?\w{1,120})\(\) missing 1 required positional "
    r"argument: 'self'"
)


def _variable(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A method uses the variable by which main knows the node."""
    name, source = match["name"], raised.source
    function = function_at(raised.module, raised.line)
    if (
        function is None
        or function not in source.own_methods
        or not node_classes.has_self(function)
    ):
        return None
    if name not in {"node", *source.node_variables, *spun_names(source)}:
        return None
    own = {c.name for c in source.family}
    made = {
        last_part(dotted(n.value.func))
        for n in source.all_nodes
        if isinstance(n, ast.Assign) and isinstance(n.value, ast.Call) and name in targets_of(n)
    }
    if made and made <= source.known_classes - own:
        return None  # (the object of another class)
    return raised.finding("variable_for_self", name=name)


def _base_called(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    for found in raised.module.classes:
        base = node_classes.called_base(found)
        if base is not None and raised.line in (found.lineno, base.lineno):
            name = dotted(base.func)
            return raised.finding("base_called", at=base, name=found.name, base=name)
    return None


def _not_overridden(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a method that nothing calls, with nearly the name of an empty one of a base class."""
    source = suspect.source
    named = {n.attr for n in source.all_nodes if isinstance(n, ast.Attribute)}
    classes = [c for module in source.modules for c in module.classes]
    for derived in classes:
        bases = {dotted(base).rpartition(".")[2] for base in derived.bases}
        empty = [
            m
            for owner in classes
            if owner.name in bases
            for m in owner.body
            if isinstance(m, ast.FunctionDef) and m.name in named and _is_empty(m)
        ]
        for method in derived.body:
            if not isinstance(method, ast.FunctionDef) or method.name in named:
                continue
            plain = method.name.replace("_", "").lower()
            for base in empty:
                if base.name != method.name and base.name.replace("_", "").lower() == plain:
                    params = {"name": f"def {method.name}", "written": f"def {base.name}"}
                    found = suspect.finding("not_overridden", method, **params)
                    words = {"method": base.name, "line": str(base.lineno)}
                    return replace(found, words={**found.words, **words})
        callback = _callback_not_overridden(suspect, derived, empty, named)
        if callback is not None:
            return callback
    return None


def _callback_not_overridden(
    suspect: Suspect, derived: ast.ClassDef, empty: list[ast.FunctionDef], named: set[str]
) -> RecognisedMistake | None:
    """The base class gives an empty method to the timer, and one method here is not called."""
    own = [m for m in derived.body if isinstance(m, ast.FunctionDef)]
    timed = {timer.method for timer in suspect.source.timers}
    bases = [m for m in empty if m.name in timed and m.name not in {o.name for o in own}]
    unused = [m for m in own if m.name not in named and not m.name.startswith("__")]
    if len(bases) != 1 or len(unused) != 1 or not suspect.source.logs(unused[0]):
        return None
    if unused[0].decorator_list or len(unused[0].args.args) != len(bases[0].args.args):
        return None
    params = {"name": f"def {unused[0].name}", "written": f"def {bases[0].name}"}
    found = suspect.finding("not_overridden", unused[0], **params)
    words = {"method": bases[0].name, "line": str(bases[0].lineno)}
    return replace(found, words={**found.words, **words})


def _is_empty(method: ast.FunctionDef) -> bool:
    """Whether a method does nothing: pass, ..., a text, or raise NotImplementedError."""
    return all(
        isinstance(s, ast.Pass)
        or (isinstance(s, ast.Expr) and isinstance(s.value, ast.Constant))
        or (
            isinstance(s, ast.Raise)
            and s.exc is not None
            and "NotImplemented" in ast.unparse(s.exc)
        )
        for s in method.body
    )


def _not_overridden_raised(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    return _not_overridden(Suspect(raised.source, raised.assignment))


def _field_order(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A field of a dataclass without a value stands below one that has a value."""
    for owner in raised.module.classes:
        for node in owner.body:
            named = isinstance(node, ast.AnnAssign) and dotted(node.target) == match["name"]
            if named and isinstance(node, ast.AnnAssign) and node.value is None:
                found = raised.finding("field_order", at=node, name=match["name"])
                value = node.annotation
                code = raised.source.module_of(node).text.code
                if (
                    isinstance(value, ast.Constant)
                    and value.value is not None
                    and value.value is not ...
                ):
                    kind = type(value.value).__name__
                    written = f"{match['name']}: {kind} = {code(value)}"
                    params = {"name": code(node), "written": written}
                    mistake = raised.finding("field_order", at=node, params=params)
                    return replace(
                        mistake,
                        words={**mistake.words, "type": owner.name, "kind": kind},
                        variant="value",
                    )
                return replace(found, words={**found.words, "type": owner.name})
    return None


def _of_class(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The timer calls a method of the class without an object."""
    for timer in raised.source.timers:
        written = dotted(timer.callback) if timer.callback is not None else ""
        head, _, name = written.rpartition(".")
        if head in raised.source.class_names and last_part(match["method"]) == name:
            return raised.finding("callback_of_class", at=timer.call, name=written, method=name)
    return None


def _plain(suspect: Suspect) -> RecognisedMistake | None:
    made = node_classes.plain_node(suspect.source)
    if made is None or suspect.source.node_class is None:
        return None
    name = dotted(made.func)
    return suspect.finding("plain_node", made, name=name, made=suspect.source.node_class.name)


def _not_called(suspect: Suspect) -> RecognisedMistake | None:
    for timer in suspect.source.timers:
        body = timer.callback.body if isinstance(timer.callback, ast.Lambda) else None
        name = dotted(body) if body is not None and not isinstance(body, ast.Call) else ""
        if last_part(name) in suspect.source.methods:
            return suspect.finding("lambda_not_called", timer.callback, name=name)
    return None


def _uses(function: Function) -> set[str]:
    """Return what a function calls and assigns to."""
    called = {last_part(name) for _, name in calls_in(function)}
    return called | {name for node in ast.walk(function) for name in targets_of(node)}


def _lost(source: NodeSource, replaced: list[ast.FunctionDef]) -> set[str]:
    """Return what only the replaced definitions do of all that makes a line: timer, log, counter."""
    others = [m for m in source.own_methods if m not in replaced]
    kept = {name for m in others for name in _uses(m)}
    read = {dotted(n) for m in others for n in ast.walk(m) if isinstance(n, ast.Attribute)}
    lost: set[str] = set()
    for method in replaced:
        last = next(m for m in reversed(others) if m.name == method.name)
        lost |= {name for name in _uses(method) - _uses(last) if name in read or name not in kept}
    return {name for name in lost if name in NEEDED or (name.startswith("self.") and name in read)}


def _replaced(suspect: Suspect) -> RecognisedMistake | None:
    """A second definition of a method lacks what the first one does."""
    for found in node_classes.defined_twice(suspect.source):
        if _lost(suspect.source, found[:-1]):
            return _second(suspect, found)
    return None


def _second(suspect: Suspect, found: list[ast.FunctionDef]) -> RecognisedMistake:
    name, source = found[-1].name, suspect.source
    mistake = suspect.finding("method_twice", found[-1], name=name, line=found[-2].lineno)
    timers = [timer.call.lineno for timer in source.timers if timer.method == name]
    if len(timers) < 2:
        return mistake
    words = {**mistake.words, "lines": ", ".join(map(str, sorted(timers)))}
    return replace(mistake, words=words, variant="two_timers")


def _text_replaced(suspect: Suspect) -> RecognisedMistake | None:
    """The line that came is from the second definition of a method, of which the first one logs too."""
    source, place = suspect.source, suspect.place
    for found in node_classes.defined_twice(source):
        if place is None or place.line is None:
            continue
        inside = found[-1].lineno <= place.line <= (found[-1].end_lineno or found[-1].lineno)
        if _logged_in(found[-1]) == _logged_in(found[-2]):
            continue  # (the text is wrong in both)
        if inside and place.file == source.module_of(found[-1]).path and source.logs(found[-2]):
            return _second(suspect, found)
    return None


def _logged_in(method: ast.FunctionDef) -> list[str]:
    """Return the values that a method gives to the logger, as code."""
    calls = [call for call, name in calls_in(method) if last_part(name) in LOG_METHODS]
    return [ast.unparse(part) for call in calls for part in call.args]


def _log_replaced(suspect: Suspect) -> RecognisedMistake | None:
    """The callback prints, and replaces a method of the same name that logs."""
    source = suspect.source
    for found in node_classes.defined_twice(source):
        if source.prints(found[-1]) and not source.logs(found[-1]) and source.logs(found[-2]):
            return _second(suspect, found)
    return None


def _overloaded(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The method that is called without arguments is replaced by one that needs some."""
    found = node_classes.definitions(raised.source.own_methods, match["function"])
    if len(found) < 2 or needed_besides_self(found[-2]) or match["name"] == "self":
        return None
    params = {"name": found[-1].name, "line": str(found[-2].lineno), "given": match["name"]}
    mistake = raised.finding("method_twice", at=found[-1], params=params)
    return replace(mistake, variant="overloaded")


def _start_replaced(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A second __init__ does not set what the first one sets."""
    found = node_classes.definitions(raised.source.own_methods, "__init__")
    if len(found) < 2 or not of_self(raised, match):
        return None
    written = f"self.{match['name']}"
    if written in _uses(found[-1]) or written not in set().union(*map(_uses, found)):
        return None
    line = str(found[-2].lineno)
    return raised.finding("method_twice", at=found[-1], name="__init__", line=line)


def _super_replaced(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A second __init__ does not call super().__init__, and the first one does."""
    del match
    found = node_classes.definitions(raised.source.own_methods, "__init__")
    calls = [any(name == "super().__init__" for _, name in calls_in(init)) for init in found]
    if len(found) < 2 or calls[-1] or not any(calls):
        return None
    line = str(found[-2].lineno)
    return raised.finding("method_twice", at=found[-1], name="__init__", line=line)


def _class_replaced(suspect: Suspect) -> RecognisedMistake | None:
    """A second class of the same name replaces the one that has the callback."""
    for module in suspect.source.modules:
        tops = [s for s in module.tree.body if isinstance(s, ast.ClassDef)]
        for own in suspect.source.family:
            same = [s for s in tops if s.name == own.name]
            if len(same) > 1 and ast.dump(same[-1]) == ast.dump(same[-2]):
                continue  # (the mistake is in both)
            if len(same) > 1 and own in same:
                line = same[-2].lineno
                return suspect.finding("class_twice", same[-1], name=own.name, line=line)
    return None


_node = Family("node", links.PYTHON_CLASSES)
KINDS = (
    _node(
        "class_twice",
        "class",
        msg("The file defines the node's class twice"),
        msg(
            "A file has one class of each name. The second class {name} replaces the one in line "
            "{line}, which is never used."
        ),
        msg("Delete the class that you do not need, with all its lines."),
        behind=dict.fromkeys(
            (
                "run.no_lines",
                "run.wrong_text",
                "run.constant_counter",
                "run.wrong_node_name",
                "run.wrong_period",
            ),
            _class_replaced,
        ),
        examples=(
            example(
                "class_defined_twice",
                Replace(
                    NODE,
                    "\n\ndef main(",
                    "\n\nclass MyFirstNode(Node):\n"
                    "    def __init__(self):\n"
                    "        super().__init__('my_first_node')\n"
                    "        self.get_logger().info('Hello from ROS2')\n\n\n"
                    "def main(",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
    _node(
        "variable_for_self",
        "class",
        msg("A method uses a variable of another function instead of self"),
        msg(
            "A variable exists only in the function that assigns it. Inside the class, the node "
            "is self."
        ),
        msg("Write self instead of {name}."),
        raised={NAME_ERROR: _variable},
        fixed_by=(node_classes.own_object,),
        examples=(
            example(
                "node_for_self",
                Replace(NODE, TIMER, TIMER.replace("self", "node", 1)),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "base_called",
        "class",
        msg("The class inherits from a call instead of a class"),
        msg(
            "The brackets of a class line contain the name of the base class. With () after that "
            "name, Python tries to create a {base} object there."
        ),
        msg("Remove the () after {base}: class {name}({base}):"),
        raised={r"\ATypeError|NotInitializedException": _base_called},
        fixed_by=(node_classes.base,),
        examples=(
            example(
                "base_class_called",
                Replace(NODE, "(Node):", "(Node()):"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "not_overridden",
        "class",
        msg("A method does not replace that of the base class, because the names differ"),
        msg(
            "A class replaces a method of its base class with one of exactly the same name. {method} of "
            "the base class (line {line}) is empty, and it is the one that is called."
        ),
        msg("Write {written} instead of {name}."),
        links.PYTHON_CLASSES,
        raised={r"NotImplementedError": _not_overridden_raised},
        behind={"run.no_lines": _not_overridden, "run.constant_counter": _not_overridden},
    ),
    _node(
        "field_order",
        "class",
        msg("A field of a dataclass stands below fields that have a value"),
        msg(
            "The fields of {type} become the parameters of its __init__, in their order. One without a "
            "value cannot follow one that has a value."
        ),
        msg("Move this line above the fields of {type} that have a value, or give {name} a value."),
        links.PYTHON_CLASSES,
        whys={
            "value": msg(
                "What stands behind the colon is the type of a field, and not its value, so this field of "
                "{type} has no value. One without a value cannot follow one that has a value."
            )
        },
        fixes={"value": msg("Write {written} instead of {name}.")},
        fixed_by=(lines.written,),
        raised={
            r"TypeError: non-default argument '(?P<name>\w{1,80})' follows default argument": (
                _field_order
            )
        },
        examples=(
            example(
                "field_with_its_value_as_type",
                DATACLASS_IMPORTED,
                Replace(
                    NODE,
                    "class MyFirstNode",
                    "@dataclass\nclass State:\n    text: str = 'Hello'\n    period: 1.0\n\n\nclass MyFirstNode",
                ),
                fails="run.starts",
            ),
            example(
                "field_without_value_last",
                DATACLASS_IMPORTED,
                Replace(
                    NODE,
                    "class MyFirstNode",
                    "@dataclass\nclass State:\n    count: int = 0\n    text: str\n\n\nclass MyFirstNode",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "callback_of_class",
        "timer",
        msg("create_timer gets the method of the class instead of the node's"),
        msg(
            "Through the class, a method does not know which object it belongs to. Through self, "
            "Python passes self on its own."
        ),
        msg("Write self.{method} instead of {name}."),
        raised={CALLED_ON_CLASS: _of_class},
        fixed_by=(node_classes.own_callback,),
        examples=(
            example(
                "callback_of_the_class",
                Replace(NODE, "self.timer_callback)", "MyFirstNode.timer_callback)"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "plain_node",
        "start",
        msg("The program creates a plain node instead of an object of your class"),
        msg(
            "{name}(…) creates a node without the timer and the callback of your class. Python "
            "runs the code of a class only for its objects."
        ),
        msg("Write {made}() instead of {name}(…)."),
        links.FIRST_NODE,
        behind={"run.no_lines": _plain},
        fixed_by=(node_classes.made,),
        examples=(
            example(
                "plain_node",
                Replace(NODE, "MyFirstNode()", "Node('my_first_node')"),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
    _node(
        "lambda_not_called",
        "timer",
        msg("The lambda does not call the callback"),
        msg(
            "The timer calls the lambda. This lambda only returns {name} and does not call it: the "
            "() is missing."
        ),
        msg("Pass the callback itself: write {name} instead of the lambda."),
        links.FIRST_NODE,
        behind={"run.no_lines": _not_called},
        fixed_by=(node_classes.without_lambda,),
        examples=(
            example(
                "lambda_without_call",
                Replace(NODE, "self.timer_callback)", "lambda: self.timer_callback)"),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
    _node(
        "method_twice",
        "class",
        msg("A method is defined twice"),
        msg(
            "A class has one method of each name. The second def {name} replaces the first one, "
            "which then never runs."
        ),
        msg(
            "Keep one def {name}: move the lines that you need from one to the other (the first is "
            "in line {line}), and delete the other."
        ),
        whys={
            "overloaded": msg(
                "A class has one method of each name, whatever its parameters: Python does not "
                "overload methods. The second def {name}, with {given}, replaces the first one, "
                "which then never runs."
            ),
        },
        fixes={
            "two_timers": msg(
                "Give each of the two a name of its own, and write that name in the create_timer to "
                "which it belongs (lines: {lines}). Or delete the def and the timer that you do not "
                "need."
            ),
            "overloaded": msg(
                "Give the second def {name} another name, and write that name wherever it is "
                "called with a value. The def {name}(self) in line {line} stays."
            ),
        },
        raised={
            PRIVATE: _super_replaced,
            OWN_ATTRIBUTE: _start_replaced,
            MISSING_ARGUMENT: _overloaded,
        },
        behind={
            "run.no_lines": _replaced,
            "run.constant_counter": _replaced,
            "run.wrong_text": _text_replaced,
            "run.print_not_logger": _log_replaced,
        },
        fixed_by=(node_classes.second_renamed,),
        examples=(
            example(
                "init_defined_twice",
                Replace(
                    NODE,
                    TIMER,
                    f"{TIMER}\n    def __init__(self):\n        super().__init__('my_first_node')\n",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
            example(
                "callback_defined_twice",
                Replace(
                    NODE, STEP_LINE, f"{STEP_LINE}\n    def timer_callback(self):\n        pass\n"
                ),
                fails="run.output",
                blocks=SILENT,
            ),
            example(
                "callback_that_logs_replaced_by_one_that_prints",
                Replace(
                    NODE,
                    STEP_LINE,
                    f"{STEP_LINE}\n    def timer_callback(self):\n"
                    "        print('Hello time:', self.counter_)\n        self.counter_ += 1\n",
                ),
                fails="run.logger",
            ),
            example(
                "callback_replaced_by_a_trial",
                Replace(
                    NODE,
                    STEP_LINE,
                    f"{STEP_LINE}\n    def timer_callback(self):\n"
                    "        self.get_logger().info('Hello')\n",
                ),
                fails="run.output",
            ),
            example(
                "two_timers_and_one_name",
                Replace(
                    NODE, TIMER, f"{TIMER}        self.create_timer(5.0, self.timer_callback)\n"
                ),
                Replace(
                    NODE,
                    STEP_LINE,
                    f"{STEP_LINE}\n    def timer_callback(self):\n"
                    "        self.get_logger().info('Battery: 12.6 V')\n",
                ),
                fails="run.output",
            ),
            example(
                "callback_overloaded",
                Replace(
                    NODE,
                    "self.get_logger().info('Hello time: ' + str(self.counter_))",
                    "self.timer_callback('Hello time: ')\n\n"
                    "    def timer_callback(self, text):\n"
                    "        self.get_logger().info(text + str(self.counter_))",
                ),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "init_twice_without_super",
                Replace(
                    NODE,
                    TIMER,
                    f"{TIMER}\n    def __init__(self):\n        self.counter_ = 0\n",
                ),
                fails="run.starts",
            ),
            example(
                "init_twice_without_counter",
                Replace(
                    NODE,
                    TIMER,
                    f"{TIMER}\n    def __init__(self):\n        super().__init__('my_first_node')\n{TIMER}",
                ),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
)
