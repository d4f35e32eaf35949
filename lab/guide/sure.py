"""A mistake that the node's source shows for certain, named by the records of the marking.

The records ask for what was seen of a run: an error, or that no line came. Here the source is asked
which of them it would show. What only some programs do wrong is left to `check`.
"""

from __future__ import annotations

import ast
import sys
from collections.abc import Iterator

from grader.base.i18n.message import Message, joined, say
from grader.base.nearest import nearest
from grader.mistakes.catalogue import CATALOGUE
from grader.mistakes.recognise import behind_error, behind_symptom
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect
from grader.package.source.counter import targets_of
from grader.package.source.module import Function
from grader.package.source.names import dotted, last_part, own_name
from grader.package.source.node import NODE_METHODS, NodeSource
from grader.package.source.place import place_of
from grader.package.source.sure_errors import sure_error
from grader.report.model import Where
from lab.guide import changes
from lab.guide.action import Action
from lab.guide.state import StudentState

UNSURE = frozenset(
    {
        *("node.error_hidden", "node.spin_missing", "node.sleep_loop", "node.waits_inside"),
        *("node.log_missing", "node.timer_missing"),
        *("node.debug_level", "node.print_used"),
    }
)
"""Kinds that right programs have too: only a run shows whether they are mistakes."""
ENDS = ("run.never_spins", "run.exits_at_once")
SAYS = (
    *("run.no_lines", "run.constant_counter", "run.print_not_logger", "run.wrong_step"),
    *("run.wrong_start", "run.wrong_text"),
)
"""The symptoms that are asked for: of every node, and of one that logs and counts."""
LIBRARIES = ("rclpy", "std_msgs", "geometry_msgs", "sensor_msgs", "std_srvs", "turtlesim")
CALLBACKS = ("create_timer", "create_subscription", "create_service")
UNSET = {
    "get_logger": "_logger",
    "get_clock": "_clock",
    "declare_parameter": "_parameter_overrides",
    "get_parameter": "_parameters",
}
"""What rclpy misses in a node whose constructor did not run, by the method that asks for it."""


def sure_mistake(state: StudentState) -> Action | None:
    """Return the action for a mistake that the node's source shows; None if it shows none."""
    source = state.source
    if source is None or state.passed:
        return None
    try:
        return _of_error(source, state) or _of_symptom(source, state) or _other_name(source, state)
    except RecursionError:
        return None


def _of_error(source: NodeSource, state: StudentState) -> Action | None:
    for error, where in _errors(source):
        found = behind_error(Raised(error, where, source, state.assignment), UNSURE)
        if found is not None:
            return _action(found, error)
        place = say("{file}, line {line}", file=where.file, line=where.line or 0)
        why = say("Python stops at this line when the node starts.")
        return Action(
            say("Correct {place}.", place=place), "node.error", error, (why,), place=_spot(where)
        )
    return None


def _of_symptom(source: NodeSource, state: StudentState) -> Action | None:
    logs = any("run.output" in (use.id, use.kind) for use in state.assignment.checks)
    suspect = Suspect(source, state.assignment)
    for symptom in (*ENDS, *(SAYS if logs else ())):
        found = behind_symptom(symptom, suspect, UNSURE)
        if found is not None:
            return _action(found)
    return None


def _other_name(source: NodeSource, state: StudentState) -> Action | None:
    """Return the action for a node whose constructor gives it another name."""
    call, wanted = source.name_given, state.assignment.node_name
    given = call.args[0] if call is not None and call.args else None
    if not isinstance(given, ast.Constant) or not isinstance(given.value, str):
        return None
    is_asked = any(use.kind.endswith(".node_name") for use in state.assignment.checks)
    if given.value == wanted or (state.assignment.runs and not is_asked):
        return None
    where = place_of(source, given)
    place = say("{file}, line {line}", file=where.file, line=where.line or 0)
    found = say("the node is called '{name}', not '{wanted}'", name=given.value, wanted=wanted)
    why = say("Other programs find a node by its name.")
    return Action(
        say("Correct {place}.", place=place),
        "run.wrong_node_name",
        found,
        (why, changes.code(f"super().__init__('{wanted}')", place=place)),
        place=_spot(where),
    )


def _spot(where: Where) -> str:
    """Return a place as an action has it."""
    return f"{where.file}:{where.line}" if where.line else where.file


def _action(found: RecognisedMistake, error: str = "") -> Action:
    kind, values = CATALOGUE[found.kind], {**found.params, **found.words}
    where = found.where or Where(file="")
    place: str = where.file
    if where.line:
        place = say("{file}, line {line}", file=where.file, line=where.line)
    title: str = Message(kind.title)
    said = joined(joined(place, title, by=": "), error and f"({error})")
    hints = (kind.rationale(values, found.variant), kind.fix_text(values, found.variant))
    return Action(
        say("Correct {place}.", place=place),
        found.kind,
        said,
        tuple(text for text in hints if text),
        place=_spot(where),
    )


def _errors(source: NodeSource) -> Iterator[tuple[str, Where]]:
    """Yield what Python would write, and where."""
    yield from _imports(source)
    node = source.node_class
    if node is not None:
        yield from _of_class(source, node)
    bodies = [source.methods.get("__init__"), source.main, source.callback]
    for body in bodies:
        found = sure_error(source, body.body) if isinstance(body, Function) else None
        if found is not None and isinstance(body, Function):
            error, line = found
            yield error, Where(file=source.module_of(body).path, line=line)


def _imports(source: NodeSource) -> Iterator[tuple[str, Where]]:
    """Yield the errors of imports whose module is nearly called like one of ROS."""
    for module in source.modules:
        for statement in module.tree.body:
            names = [statement.module or ""] if isinstance(statement, ast.ImportFrom) else []
            if isinstance(statement, ast.Import):
                names = [alias.name for alias in statement.names]
            for name in names:
                top = name.partition(".")[0]
                known = top in LIBRARIES or top in sys.stdlib_module_names
                if not known and nearest(top, LIBRARIES):
                    yield (
                        f"ModuleNotFoundError: No module named '{top}'",
                        place_of(source, statement),
                    )


def _of_class(source: NodeSource, node: ast.ClassDef) -> Iterator[tuple[str, Where]]:
    module = source.module_of(node)
    for base in node.bases:
        name = base.id if isinstance(base, ast.Name) else "object"
        if name not in {*module.names, "object"} and not hasattr(__builtins__, name):
            yield f"NameError: name '{name}' is not defined", place_of(source, base)
    init = source.methods.get("__init__")
    if not isinstance(init, Function) or [last_part(dotted(b)) for b in node.bases] != ["Node"]:
        return
    called = source.super_init
    if called is None and (first := _first_of_node(init)) is not None:
        unset = UNSET.get(last_part(dotted(first.func)), "_default_callback_group")
        error = f"AttributeError: '{node.name}' object has no attribute '{unset}'"
        yield error, place_of(source, first)
    elif called is not None and not called.args and not called.keywords:
        error = "TypeError: Node.__init__() missing 1 required positional argument: 'node_name'"
        yield error, place_of(source, called)
    yield from _callbacks(source, node)


def _first_of_node(init: ast.AST) -> ast.Call | None:
    """Return the first call in __init__ that needs a node."""
    calls = (n for n in ast.walk(init) if isinstance(n, ast.Call))
    return next((c for c in calls if last_part(dotted(c.func)) in NODE_METHODS), None)


def _callbacks(source: NodeSource, node: ast.ClassDef) -> Iterator[tuple[str, Where]]:
    """Yield the errors of callbacks that the class does not have."""
    known = {*source.methods, *source.attributes, *NODE_METHODS}
    for call, name in source.calls:
        if last_part(name) not in CALLBACKS:
            continue
        for given in call.args[1:]:
            if isinstance(given, ast.Call) and _returns_nothing(source, own_name(given.func)):
                yield "TypeError: 'NoneType' object is not callable", place_of(source, given)
            own = own_name(given)
            if own and isinstance(given, ast.Attribute) and own not in known:
                error = f"AttributeError: '{node.name}' object has no attribute '{own}'"
                yield error, place_of(source, given)
    mine = {*source.methods, *source.attributes, *_in_class(source)} - {"__init__"}
    for part in ast.walk(node):
        if not isinstance(part, ast.Attribute) or not isinstance(part.ctx, ast.Load):
            continue
        own = own_name(part)
        if own and own not in known | mine and nearest(own, mine):
            error = f"AttributeError: '{node.name}' object has no attribute '{own}'"
            yield error, place_of(source, part)


def _returns_nothing(source: NodeSource, method: str) -> bool:
    """Whether a method of the node returns nothing, as far as its text shows."""
    function = source.methods.get(method)
    if not isinstance(function, ast.FunctionDef):
        return False
    returns = (
        n for n in ast.walk(function) if isinstance(n, (ast.Return, ast.Yield, ast.YieldFrom))
    )
    return not function.decorator_list and next(returns, None) is None


def _in_class(source: NodeSource) -> set[str]:
    return {name for statement in source.class_body for name in targets_of(statement)}
