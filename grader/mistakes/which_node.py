"""Mistakes about which node is made, given to the executor and spun, and about what is called."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links, spin_in_thread
from grader.mistakes.example import (
    CACHED_PROPERTY_IMPORTED,
    LOG_LINE,
    NODE,
    SILENT,
    SPIN_UNTIL_CTRL_C,
    STEP_LINE,
    example,
)
from grader.mistakes.fixes import (
    lines,
    node_executor,
    node_life,
    node_main,
    node_rename,
    node_setup,
)
from grader.mistakes.fixes.case import Case
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect
from grader.mistakes.spin import executors
from grader.mistakes.spun_none import NotReturned, not_returned, with_return
from grader.package.edit.files import Files
from grader.package.edit.text import indent_of
from grader.package.edit.tree import Replace
from grader.package.source.counter import targets_of
from grader.package.source.guard import called_on_import
from grader.package.source.module import Function, code_of
from grader.package.source.names import called_name, calls_in, dotted, last_part
from grader.package.source.node import NodeSource
from grader.package.source.second_node import second_node
from grader.report.model import Where

SPINS = ("spin", "spin_once", "spin_until_future_complete")
GUARD = msg(
    "ros2 run imports the file and then calls {name} itself. This call runs during the import, "
    "before that: {name} is called twice."
)

LIFECYCLE = ("rclpy.lifecycle", "rclpy.lifecycle.node")


SPINS_ALL = msg(
    "The spin of an executor takes no node: it calls the callbacks of all nodes that were added to "
    "it with add_node."
)


def _made_in_callback(suspect: Suspect) -> RecognisedMistake | None:
    source, callback = suspect.source, suspect.source.callback
    for call, name in calls_in(callback) if callback is not None else ():
        if source.is_node_class(call.func):
            return suspect.finding("made_in_callback", call, name=name)
    return None


def _other_nodes_timer(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a timer of a second node, which the class makes and nothing spins."""
    made = {name for name in _nodes_made(suspect) if not _is_passed(suspect.source, name)}
    spun = {dotted(a) for call in suspect.source.calls_of(*SPINS, "add_node") for a in call.args}
    for call in suspect.source.calls_of("create_timer"):
        owner = dotted(call.func.value) if isinstance(call.func, ast.Attribute) else ""
        if owner in made and owner not in spun:
            return suspect.finding("timer_of_other_node", call, name=owner)
    return None


def _is_passed(source: NodeSource, name: str) -> bool:
    """Whether an attribute of self is given to something, so that it may be spun: node.helper."""
    for node in source.all_nodes:
        if isinstance(node, ast.Attribute) and node.attr == last_part(name):
            around = source.module_of(node).parents.get(node)
            if isinstance(node.ctx, ast.Load) and not isinstance(around, ast.Attribute):
                return True
    return False


def _other_nodes_logger(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a log call of a second node's logger, which the class makes."""
    made, callback = _nodes_made(suspect), suspect.source.callback
    for call in suspect.source.logs(callback) if callback is not None else ():
        owner = dotted(call.func).partition(".get_logger")[0]
        logger = ast.unparse(call.func).partition(".get_logger()")[0]
        for name in (owner, logger):
            if name in made:
                params = {"name": f"{name}.get_logger()", "written": "self.get_logger()"}
                found = suspect.finding("logger_of_other_node", call, **params)
                return replace(found, words={**found.words, "node": name})
    return None


def _nodes_made(suspect: Suspect) -> set[str]:
    """Return the names that get a plain node within the node's class."""
    found: set[str] = set()
    for node in suspect.source.own_nodes:
        value = node.value if isinstance(node, ast.Assign) else None
        if isinstance(value, ast.Call) and called_name(value) in ("create_node", "Node"):
            found |= set(targets_of(node))
    return {name for name in found if name.startswith("self.")}


def _executor_without_node(suspect: Suspect) -> RecognisedMistake | None:
    """Look for an executor that never gets a node, or only below the line that spins it."""
    late = node_executor.added_late(suspect.source)
    if late is not None:
        owner = node_executor.called(late.spin).rpartition(".")[0]
        rows = ", ".join(str(s.lineno) for s in late.adds)
        found = suspect.finding("executor_without_node", late.spin, name=owner, line=rows)
        return replace(found, variant="late")
    given = {
        dotted(n.value)
        for n in suspect.source.all_nodes
        if isinstance(n, ast.Attribute) and n.attr == "add_node"
    }
    for call, name in suspect.source.calls:
        before, _, method = name.rpartition(".")
        passed = node_executor.is_passed(suspect.source, before)
        if method in SPINS and before in executors(suspect) - given and not passed:
            return _never_added(suspect, call, before)
    return None


def _never_added(suspect: Suspect, call: ast.Call, owner: str) -> RecognisedMistake:
    """Return that an executor has no node: with the node to add, if main has it in one variable."""
    source, main = suspect.source, suspect.source.function_around(call)
    code = source.module_of(call).text.code(call)
    found = suspect.finding("executor_without_node", call, name=owner)
    made = [n for n in ast.walk(main) if isinstance(n, ast.Assign)] if main is not None else []
    nodes = {t for n in made for t in targets_of(n)} & source.node_variables
    if len(nodes) != 1 or "\n" in code:
        return replace(found, words={**found.words, "written": code}, variant="unknown")
    params = {"node": min(nodes), "written": code}
    return replace(found, params={**found.params, **params}, words={**found.words, **params})


def _node_to_spin(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Look for a node that is given to the spin of an executor, and not to add_node."""
    del match
    source = raised.source
    for call in source.calls_of("spin"):
        owner = dotted(call.func).rpartition(".")[0]
        if call.lineno != raised.line or len(call.args) != 1 or not owner:
            continue
        code = source.module_of(call).text.code
        added = any(dotted(add.func) == f"{owner}.add_node" for add in source.calls_of("add_node"))
        node = code(call.args[0])
        found = raised.finding("executor_without_node", at=call, name=owner, node=node)
        return replace(found, variant="added" if added else "given")
    return None


def _spins_in_init(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a spin in __init__; what is below it runs only after Ctrl+C."""
    init = suspect.source.methods.get("__init__")
    for call in suspect.source.calls_of("spin", within=init) if init is not None else ():
        if not _stops_at(suspect.source, init, call):
            continue
        found = suspect.finding("spin_in_init", call, name=ast.unparse(call))
        source, main = suspect.source, suspect.function
        spun = main is not None and source.calls_of("spin", within=main)
        name = source.node_class.name if source.node_class is not None else ""
        if main is None or spun or not name:
            return found
        variable = min(source.node_variables, default="")
        words = {**found.words, "variable": variable or "node", "made": name}
        return replace(found, words=words, variant="kept" if variable else "alone")
    return None


def _stops_at(source: NodeSource, init: Function | None, call: ast.Call) -> bool:
    """Whether __init__ runs a call itself, not a function in it, and has more lines below it."""
    around = source.module_of(call).around(call)
    inner = next((part for part in around if isinstance(part, Function | ast.Lambda)), None)
    end = call.end_lineno or call.lineno
    return inner is init and any(getattr(n, "lineno", 0) > end for n in ast.walk(init or call))


NODE_LOST = msg(
    "{function} makes the node and has no return with a value, so line {line}, which uses its value, gets "
    "None."
)


def _none_is_spun(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    for call in raised.source.calls_of("spin"):
        name = dotted(call.args[0]) if call.args else ""
        if raised.line in (None, call.lineno) and name:
            lost = not_returned(raised, name)
            if lost is not None:
                return _value_lost(raised, lost, name)
            emptied = _set_to_none(raised.source.function_around(call), name, call.lineno)
            if emptied is not None:
                found = raised.finding("spin_of_none", at=emptied, name=name)
                return replace(found, variant="emptied")
            made = _local_of_that_name(raised, name)
            found = raised.finding("spin_of_none", at=made or call, name=name)
            return replace(found, variant="local" if made is not None else "")
    return None


def _value_lost(raised: Raised, lost: NotReturned, name: str) -> RecognisedMistake:
    """Return that the function which makes the node does not return it."""
    code = f"return {lost.variable}" if lost.variable else ""
    params = {"name": name, "function": lost.function.name}
    params |= {"written": code} if code else {}
    found = raised.finding("spin_of_none", at=lost.function.body[-1], params=params)
    words = {"line": str(lost.used.lineno)}
    variant = "returned" if code else "unreturned"
    return replace(found, words={**found.words, **words}, variant=variant)


def _set_to_none(function: Function | None, name: str, line: int) -> ast.Assign | None:
    """Return the last statement above a line of a function that sets a name, if it sets it to None."""
    found = [
        n
        for n in (ast.walk(function) if function is not None else ())
        if isinstance(n, ast.Assign) and n.lineno < line and name in map(dotted, n.targets)
    ]
    last = max(found, key=lambda n: n.lineno, default=None)
    none = last is not None and isinstance(last.value, ast.Constant) and last.value.value is None
    return last if none and len(found) > 1 else None


def _none_deleted(case: Case) -> Files | None:
    """Delete the line that sets the node's variable to None."""
    name, module, line = case.finding.params.get("name", ""), case.module, case.finding.line
    row = module.text.line(line) if module is not None and line else ""
    return lines.deleted(case) if name and row.strip() == f"{name} = None" else None


def _local_of_that_name(raised: Raised, name: str) -> ast.Assign | None:
    """Return where a function gives a new node to its own variable of a name of the file."""
    source = raised.source
    for node in source.all_nodes:
        if not isinstance(node, ast.Assign) or name not in map(dotted, node.targets):
            continue
        around = source.function_around(node)
        made = isinstance(node.value, ast.Call) and source.is_node_class(node.value.func)
        if made and around is not None and not _is_global(around, name):
            return node
    return None


def _is_global(function: Function, name: str) -> bool:
    return any(isinstance(n, ast.Global) and name in n.names for n in ast.walk(function))


def _second_spun(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a node that is created in the call of spin, beside the one that does the work."""
    for module in suspect.source.modules:
        found = second_node(module.tree)
        if found is not None:
            return suspect.finding("second_node_spun", found.spin, name=found.name, line=found.line)
    return None


def _method_not_called(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the method that creates the timer, and that nothing calls."""
    source = suspect.source
    timers = source.timers
    named = {n.attr for n in source.all_nodes if isinstance(n, ast.Attribute)}
    function = timers[0].function if timers else None
    if function is None or function.name == "__init__" or function.name in named:
        return None
    if source.methods.get(function.name) is not function:
        return None
    if any(timer.function is not function for timer in timers):
        return None  # (the node has a timer without this method)
    if function.decorator_list:
        return _property_not_read(suspect, function, timers[0].call)
    if function.name.startswith("on_") and _lifecycle_import(suspect) is not None:
        return None
    makes = any(name == "super().__init__" for _, name in calls_in(function))
    if makes and "__init__" not in source.methods:
        return None  # (it should be __init__)
    return _call_missing(suspect, function)


def _property_not_read(
    suspect: Suspect, function: Function, call: ast.Call
) -> RecognisedMistake | None:
    """The method that creates the timer is a property, and nothing reads it."""
    init, last = suspect.source.methods.get("__init__"), function.body[-1]
    decorators = [last_part(dotted(d)) for d in function.decorator_list]
    is_property = decorators in (["property"], ["cached_property"])
    code = code_of(function)
    alone = isinstance(last, ast.Return) and last.value is call and len(code) == 1
    if not (is_property and alone) or init is None:
        return None
    line = str(init.body[-1].end_lineno)
    written = f"self.{function.name} = {suspect.source.module_of(call).text.code(call)}"
    found = suspect.finding(
        "method_not_called", function, name=function.name, line=line, written=written
    )
    return replace(found, variant="property")


def _lifecycle_import(suspect: Suspect) -> ast.ImportFrom | None:
    """Return the import of the base class of lifecycle nodes, if the node's class is one."""
    for node in suspect.source.all_nodes:
        if isinstance(node, ast.ImportFrom) and node.module in LIFECYCLE:
            names = {a.asname or a.name for a in node.names if a.name in ("Node", "LifecycleNode")}
            if names & {dotted(b) for c in suspect.source.family for b in c.bases}:
                return node
    return None


def _not_activated(suspect: Suspect, asked: ast.Call) -> RecognisedMistake | None:
    """A lifecycle node is configured, and nothing activates it."""
    if any(last_part(name) == "trigger_activate" for _, name in suspect.source.calls):
        return None
    owner = dotted(asked.func).rpartition(".")[0]
    written = f"{owner}.trigger_activate()"
    found = suspect.finding("lifecycle_node", asked, name=dotted(asked.func), written=written)
    return replace(found, variant="not_activated") if owner else None


def _not_configured(suspect: Suspect) -> RecognisedMistake | None:
    """A lifecycle node creates its timer when it is configured, which nobody does."""
    timers, imported = suspect.source.timers, _lifecycle_import(suspect)
    function = timers[0].function if timers else None
    if imported is None or function is None or not function.name.startswith("on_"):
        return None
    asked = [c for c, name in suspect.source.calls if last_part(name) == "trigger_configure"]
    if asked:
        return _not_activated(suspect, asked[0])
    name = next(a for a in imported.names if a.name in ("Node", "LifecycleNode"))
    bound = "" if (name.asname or name.name) == "Node" else f" as {name.asname or name.name}"
    others = [a for a in imported.names if a is not name]
    code = f"from {imported.module} import {', '.join(map(ast.unparse, others))}"
    new = " and ".join([f"from rclpy.node import Node{bound}", *([code] if others else [])])
    return suspect.finding("lifecycle_node", imported, name=function.name, written=new)


def _call_missing(suspect: Suspect, function: Function) -> RecognisedMistake:
    """The call belongs at the end of __init__, or below the line that creates the node."""
    source, name = suspect.source, function.name
    given = function.args.args[1 : len(function.args.args) - len(function.args.defaults)]
    call = f"{name}({', '.join(a.arg for a in given)})"
    init = source.methods.get("__init__")
    if init is None:
        found = suspect.finding("method_not_called", function, name=name, call=call)
        return replace(found, variant="no_init")
    last = init.body[-1]
    line = last.end_lineno or last.lineno
    place = Where(file=source.module_of(last).path, line=line)
    found = suspect.finding("method_not_called", place, name=name, call=call, line=line)
    return replace(found, variant="arguments") if given else found


def _other_node_spun(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a plain node that is spun where the node of the class is not."""
    source = suspect.source
    given = [c for c in source.calls_of("spin", "spin_once", "add_node") if c.args]
    names = {dotted(call.args[0]) for call in given}
    node = next(iter(source.node_variables)) if len(source.node_variables) == 1 else ""
    plain = {
        target
        for n in source.all_nodes
        if isinstance(n, ast.Assign)
        and isinstance(n.value, ast.Call)
        and called_name(n.value) in ("Node", "create_node")
        for target in targets_of(n)
    }
    if (
        not node
        or len(given) != 1
        or len(names) != 1
        or not names < plain | {node}
        or node in names
    ):
        return None
    call, other = given[0], dotted(given[0].args[0])
    params = {"name": other, "written": node}
    return suspect.finding("other_node_spun", call, **params)


def _main_at_import(suspect: Suspect) -> RecognisedMistake | None:
    function = suspect.function
    call = called_on_import(suspect.source.entry.tree, function.name) if function else None
    if call is None or function is None:
        return None
    return suspect.finding("main_at_import", call, name=function.name)


def _main_twice(suspect: Suspect) -> RecognisedMistake | None:
    function = suspect.function
    if function is None:
        return None
    same = [
        s
        for s in suspect.source.entry.tree.body
        if isinstance(s, Function) and s.name == function.name
    ]
    if len(same) < 2:
        return None
    return suspect.finding("main_twice", same[-1], name=function.name, line=same[0].lineno)


def _hides_class(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Look for a variable that gets the name of its class in the function that makes the object."""
    name, module, node_name = match["name"], raised.module, raised.assignment.node_name
    found = node_rename.hidden_class(module, raised.line, name)
    if found is None:
        return _hides_imported_class(raised, name)
    new = node_rename.capital_name(module, name, node_name)
    if not new:
        return _variable_renamed(raised, found.made, name)
    others = sorted({getattr(n, "lineno", 0) for n in node_rename.other_uses(module, found)})
    rows = [module.line(found.made_by.lineno), module.line(found.made.lineno)]
    mistake = raised.finding(
        "variable_hides_class",
        at=found.made,
        params={
            "name": name,
            "written": new,
            "line": str(found.made_by.lineno),
            "head": re.sub(rf"(class\s+){re.escape(name)}\b", rf"\g<1>{new}", rows[0]),
            "call": re.sub(rf"\b{re.escape(name)}(?=\s*\()", new, rows[1]),
            "others": ", ".join(map(str, others)),
        },
    )
    return replace(mistake, variant="also" if others else "class")


def _hides_imported_class(raised: Raised, name: str) -> RecognisedMistake | None:
    """Look for the same with the node's class that is in another file of the package."""
    if name not in raised.source.class_names:
        return None
    for node in raised.source.all_nodes:
        here = isinstance(node, ast.Assign) and raised.line in (None, node.lineno)
        if isinstance(node, ast.Assign) and here and name in targets_of(node):
            return _variable_renamed(raised, node, name)
    return None


def _variable_renamed(raised: Raised, made: ast.Assign, name: str) -> RecognisedMistake:
    module = raised.source.module_of(made)
    new = node_rename.free_variable(module, name) or f"{name}_1"
    row = module.line(made.lineno)
    call = re.sub(rf"\b{re.escape(name)}(?=\s*=)", new, row, count=1)
    params = {"name": name, "written": new, "call": call}
    return raised.finding("variable_hides_class", at=made, params=params)


OWN_EXECUTOR = (
    Replace(
        NODE,
        "rclpy.spin(node)",
        (
            "executor = SingleThreadedExecutor()\n"
            "        executor.add_node(node)\n"
            "        executor.spin()"
        ),
    ),
    Replace(
        NODE,
        "from rclpy.node",
        "from rclpy.executors import SingleThreadedExecutor\nfrom rclpy.node",
    ),
)
OWN_SPINS = msg(
    "The thread runs {name} (line {line}), which spins. {function} does not wait for it: it goes on to its "
    "last line, and then the program ends."
)
ACTIVE = (
    "        if self.active:\n"
    "            self.get_logger().info('Hello time: ' + str(self.counter_))\n"
    "            self.counter_ += 1\n"
)


def _activated(case: Case) -> Files | None:
    """Activate the lifecycle node on the line below the one that configures it."""
    module, line = case.module, case.finding.line
    new = str(case.finding.params.get("written", ""))
    if module is None or not line or not new.endswith(".trigger_activate()"):
        return None
    return case.changed(
        module, module.text.before(line + 1, indent_of(module.text.line(line)) + new)
    )


_node = Family("node", links.EXECUTORS)
KINDS = (
    _node(
        "variable_hides_class",
        "start",
        msg("The variable has the same name as the class"),
        msg("In a function that sets {name}, {name} means the variable, which has no value yet."),
        msg(
            "Give the variable another name: write {call} in this line. If lines below it use {name}, "
            "write {written} there."
        ),
        links.PYTHON_CLASSES,
        fixes={
            "class": msg("Rename the class: write {head} in line {line}, and {call} in this line."),
            "also": msg(
                "Rename the class: write {head} in line {line}, {call} in this line, and {written} "
                "instead of {name} in line {others}."
            ),
        },
        raised={r"UnboundLocalError: .{0,60}'(?P<name>\w{1,120})'": _hides_class},
        fixed_by=(node_rename.apart,),
        examples=(
            example(
                "variable_hides_class",
                Replace(NODE, "node = MyFirstNode()", "MyFirstNode = MyFirstNode()"),
                fails="run.starts",
            ),
            example(
                "class_and_variable_same_name",
                Replace(NODE, "class MyFirstNode(Node)", "class node(Node)"),
                Replace(NODE, "node = MyFirstNode()", "node = node()"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "second_node_spun",
        "spin",
        msg("Two nodes are created, and only one of them is spun"),
        msg(
            "Line {line} creates a node, and this line creates another one of the same name in the "
            "call of spin. The first one, {name}, is never spun."
        ),
        msg("Write {name} instead of the second node: rclpy.spin({name})"),
        behind={"run.no_lines": _second_spun},
        fixed_by=(node_life.first_node,),
        examples=(
            example(
                "second_node_is_spun",
                Replace(NODE, "        self.create_timer(1.0, self.timer_callback)\n", ""),
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    def start(self):\n"
                    "        self.create_timer(1.0, self.timer_callback)\n\n"
                    "    def timer_callback",
                ),
                Replace(NODE, "node = MyFirstNode()", "node = MyFirstNode()\n    node.start()"),
                Replace(NODE, "rclpy.spin(node)", "rclpy.spin(MyFirstNode())"),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
    _node(
        "spin_of_none",
        "spin",
        msg("rclpy.spin gets None instead of a node"),
        msg("{name} has no node at this point."),
        msg(
            "Find the line that gives {name} its value, and see why it is None: rclpy.spin needs the node."
        ),
        whys={
            "returned": NODE_LOST,
            "unreturned": NODE_LOST,
            "local": msg(
                "A function that assigns to {name} has its own variable {name}; the one outside "
                "stays None."
            ),
        },
        fixes={
            "emptied": msg("Delete this line: it sets {name}, which has the node, to None."),
            "local": msg("Return the node from this function, and give it to rclpy.spin."),
            "returned": msg(
                "Write {written} as the last line of {function}, indented as far as its first line."
            ),
            "unreturned": msg("Let the last line of {function} return the node."),
        },
        raised={
            r"AttributeError: 'NoneType' object has no attribute '(?:executor|handle)'": _none_is_spun
        },
        fixed_by=(with_return, _none_deleted),
        deletes=("emptied",),
        examples=(
            example(
                "made_node_is_not_returned",
                Replace(NODE, "def main(", "def make():\n    made = MyFirstNode()\n\n\ndef main("),
                Replace(NODE, "node = MyFirstNode()\n", "node = make()\n"),
                Replace(NODE, "        node.destroy_node()\n", ""),
                fails="run.starts",
            ),
            example(
                "spin_of_none",
                Replace(
                    NODE,
                    "        rclpy.spin(node)\n",
                    "        node = None\n        rclpy.spin(node)\n",
                ),
                Replace(NODE, "        node.destroy_node()\n", ""),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "spin_in_daemon",
        "spin",
        msg("A thread spins the node, and nothing waits for its end"),
        msg("When {function} comes to its end, the program ends, and its daemon threads with it."),
        msg("Call rclpy.spin({node}) in {function} itself, without the thread."),
        whys={
            "own": OWN_SPINS,
            "own_method": OWN_SPINS,
            "limited": msg(
                "{waits} in line {row} waits for the thread for a limited time only. Then {function} goes on to "
                "its end, and the node ends."
            ),
            "cleaned_up": msg(
                "A thread runs beside {function}, which does not wait for it: {function} goes on to "
                "{called}, and the node ends."
            ),
        },
        fixes={
            "limited": msg("Write {written} instead of the lines of the thread (lines: {lines})."),
            "executor": msg("Call {name}.spin() in {function} itself, without the thread."),
            "own": msg("Call {name}({node}) in {function} itself, without the thread."),
            "own_method": msg(
                "Write {called} instead of the line that starts the thread: then the program waits there."
            ),
        },
        behind=dict.fromkeys(("run.exits_at_once", "run.ended_early"), spin_in_thread.daemon),
        examples=(
            example(
                "spin_in_daemon",
                Replace(NODE, "import rclpy\nfrom", "import threading\n\nimport rclpy\nfrom"),
                Replace(
                    NODE,
                    SPIN_UNTIL_CTRL_C,
                    "    threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()\n",
                ),
                fails="run.starts",
            ),
            example(
                "join_of_the_spinning_thread_has_a_limit",
                Replace(NODE, "import rclpy\nfrom", "import threading\n\nimport rclpy\nfrom"),
                Replace(
                    NODE,
                    "        rclpy.spin(node)\n    except",
                    "        thread = threading.Thread(target=rclpy.spin, args=(node,), daemon=True)\n"
                    "        thread.start()\n"
                    "        thread.join(timeout=2.0)\n"
                    "    except",
                ),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
            example(
                "own_function_that_spins_in_a_daemon",
                Replace(NODE, "import rclpy\nfrom", "import threading\n\nimport rclpy\nfrom"),
                Replace(NODE, "def main(", "def work(node):\n    rclpy.spin(node)\n\n\ndef main("),
                Replace(
                    NODE,
                    "        rclpy.spin(node)\n    except",
                    "        threading.Thread(target=work, args=(node,), daemon=True).start()\n"
                    "    except",
                ),
                fails="run.starts",
            ),
            example(
                "own_method_that_spins_in_a_daemon",
                Replace(NODE, "import rclpy\nfrom", "import threading\n\nimport rclpy\nfrom"),
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    def work(self):\n        rclpy.spin(self)\n\n    def timer_callback",
                ),
                Replace(
                    NODE,
                    "        rclpy.spin(node)\n    except",
                    "        threading.Thread(target=node.work, daemon=True).start()\n    except",
                ),
                fails="run.starts",
            ),
            example(
                "spin_in_a_thread_that_nothing_waits_for",
                Replace(NODE, "import rclpy\nfrom", "import threading\n\nimport rclpy\nfrom"),
                Replace(
                    NODE,
                    "        rclpy.spin(node)\n",
                    "        threading.Thread(target=rclpy.spin, args=(node,)).start()\n",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "other_node_spun",
        "spin",
        msg("Another node is spun"),
        msg(
            "{name} is another node. Only the callbacks of the node that is spun are called, and "
            "{written}, which has the timer, is not spun."
        ),
        msg("Write {written} instead of {name} in this line."),
        behind={"run.no_lines": _other_node_spun, "run.never_spins": _other_node_spun},
        fixed_by=(lines.written,),
        examples=(
            example(
                "other_node_spun",
                Replace(
                    NODE,
                    "    node = MyFirstNode()\n",
                    "    node = MyFirstNode()\n    helper = rclpy.create_node('helper')\n",
                ),
                Replace(NODE, "rclpy.spin(node)", "rclpy.spin(helper)"),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
    _node(
        "main_twice",
        "spin",
        msg("The file defines the function of the entry point twice"),
        msg("The later definition replaces the earlier one, on line {line}, which is never run."),
        msg("Keep the one that you need, and delete the other."),
        links.PYTHON_CLASSES,
        behind={"run.exits_at_once": _main_twice, "run.no_node": _main_twice},
        examples=(
            example(
                "main_twice",
                Replace(
                    NODE,
                    "if __name__ ==",
                    "def main():\n    print('Hi from my_robot_controller.')\n\n\nif __name__ ==",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "main_at_import",
        "shutdown",
        msg("The file calls the function of the entry point when it is imported"),
        GUARD,
        msg("Write if __name__ == '__main__': above this line, and indent the line."),
        behind={"run.ignores_interrupt": _main_at_import},
        fixed_by=(node_main.under_guard,),
        examples=(
            example(
                "main_at_import",
                Replace(NODE, "if __name__ == '__main__':\n    main()", "main()"),
                *OWN_EXECUTOR,
                fails="run.interrupt",
            ),
        ),
    ),
    _node(
        "spin_in_init",
        "timer",
        msg("__init__ spins the node, and never comes to its end"),
        msg("{name} waits until Ctrl+C. The lines below it do not run before that."),
        msg("Remove this line: {function} spins the node after it was made."),
        fixes={
            "kept": msg(
                "Remove this line. Write in {function}, below the line that creates the node, and in its "
                "try, if there is one: rclpy.spin({variable})"
            ),
            "alone": msg(
                "Remove this line. Write in {function} {variable} = {made}() instead of {made}(), and "
                "on the next line rclpy.spin({variable})."
            ),
        },
        behind={"run.no_lines": _spins_in_init},
        deletes=("",),
        examples=(
            example(
                "spin_only_in_init",
                Replace(
                    NODE,
                    "        self.counter_ = 0\n",
                    "        rclpy.spin(self)\n        self.counter_ = 0\n",
                ),
                Replace(NODE, "        rclpy.spin(node)\n", "        pass\n"),
                fails="run.output",
                blocks=SILENT,
            ),
            example(
                "spin_in_init",
                Replace(
                    NODE,
                    "        self.counter_ = 0\n",
                    "        rclpy.spin(self)\n        self.counter_ = 0\n",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
    _node(
        "logger_of_other_node",
        "logger",
        msg("The lines are logged with the logger of another node"),
        msg(
            "{node} is a second node that the class makes, and its logger has its name. The node that "
            "the exercise asks for is self."
        ),
        msg("Write {written} instead of {name}. Delete {node} if nothing else uses it."),
        behind={
            "run.wrong_node_name": _other_nodes_logger,
            "run.other_logger": _other_nodes_logger,
        },
        fixed_by=(lines.written,),
        examples=(
            example(
                "logs_with_a_second_node",
                Replace(
                    NODE,
                    "self.counter_ = 0",
                    "self.counter_ = 0\n        self.out = rclpy.create_node('out')",
                ),
                Replace(NODE, "self.get_logger()", "self.out.get_logger()"),
                fails="run.node_name",
            ),
        ),
    ),
    _node(
        "timer_of_other_node",
        "timer",
        msg("The timer belongs to a second node, which nothing spins"),
        msg("{name} is a node of its own beside self; rclpy.spin is given only one of the two."),
        msg("Write self.create_timer(…), and remove {name}."),
        behind={"run.no_lines": _other_nodes_timer},
        examples=(
            example(
                "timer_of_other_node",
                Replace(
                    NODE,
                    "self.create_timer(",
                    "self.inner_ = rclpy.create_node('inner')\n        self.inner_.create_timer(",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
    _node(
        "method_not_called",
        "timer",
        msg("Nothing calls the method that creates the timer"),
        msg("Nothing calls {name}: when the node is made, only its __init__ runs."),
        msg("Write self.{call} below line {line}, at the end of __init__."),
        whys={
            "property": msg(
                "{name} is a property: its lines run when the code reads self.{name}, and no line "
                "reads it."
            )
        },
        fixes={
            "no_init": msg("Call {call} on the node after it is created, before spin."),
            "arguments": msg(
                "Write self.{call} below line {line}, at the end of __init__, and in the brackets a "
                "value instead of each name."
            ),
            "property": msg(
                "Write {written} below line {line}, at the end of __init__. Delete the method {name} "
                "with the decorator above it."
            ),
        },
        behind={"run.no_lines": _method_not_called},
        fixed_by=(node_setup.called,),
        examples=(
            example(
                "timer_in_a_property",
                Replace(
                    NODE,
                    "        self.create_timer(1.0, self.timer_callback)\n",
                    "\n    @property\n    def timer(self):\n"
                    "        return self.create_timer(1.0, self.timer_callback)\n",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
            example(
                "timer_in_a_cached_property",
                CACHED_PROPERTY_IMPORTED,
                Replace(
                    NODE,
                    "        self.create_timer(1.0, self.timer_callback)\n",
                    "\n    @cached_property\n    def timer(self):\n"
                    "        return self.create_timer(1.0, self.timer_callback)\n",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
            example(
                "setup_not_called",
                Replace(
                    NODE,
                    "        self.create_timer(1.0, self.timer_callback)\n",
                    "\n    def setup(self):\n        self.create_timer(1.0, self.timer_callback)\n",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
    _node(
        "lifecycle_node",
        "timer",
        msg("The node waits to be configured"),
        msg(
            "The base class is the lifecycle node of ROS. ROS calls {name} only when somebody asks "
            "for it, for example with ros2 lifecycle set. Nobody does, so the timer is never created."
        ),
        msg(
            "Write instead of this import: {written} Then move the line of {name} that creates the "
            "timer to the end of __init__, and delete {name}."
        ),
        whys={
            "not_activated": msg(
                "The base class is the lifecycle node of ROS. After this line it is configured, but it is "
                "not active: its publishers send nothing, and is_activated is False."
            )
        },
        fixes={"not_activated": msg("Write {written} below this line.")},
        behind={"run.no_lines": _not_configured},
        fixed_by=(_activated,),
        examples=(
            example(
                "lifecycle_node",
                Replace(NODE, "from rclpy.node import Node", "from rclpy.lifecycle import Node"),
                Replace(
                    NODE,
                    "        self.create_timer(1.0, self.timer_callback)\n",
                    "\n    def on_configure(self, state):\n"
                    "        self.timer = self.create_timer(1.0, self.timer_callback)\n"
                    "        return super().on_configure(state)\n",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
            example(
                "lifecycle_node_not_activated",
                Replace(NODE, "from rclpy.node import Node", "from rclpy.lifecycle import Node"),
                Replace(
                    NODE,
                    "        self.create_timer(1.0, self.timer_callback)\n",
                    "        self.active = False\n\n"
                    "    def on_configure(self, state):\n"
                    "        self.timer = self.create_timer(1.0, self.timer_callback)\n"
                    "        return super().on_configure(state)\n\n"
                    "    def on_activate(self, state):\n"
                    "        self.active = True\n"
                    "        return super().on_activate(state)\n",
                ),
                Replace(NODE, LOG_LINE + STEP_LINE, ACTIVE),
                Replace(
                    NODE,
                    "    node = MyFirstNode()\n",
                    "    node = MyFirstNode()\n    node.trigger_configure()\n",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
    _node(
        "executor_without_node",
        "spin",
        msg("The executor has no node"),
        msg(
            "An executor calls the callbacks of the nodes that were added to it, and of no others."
        ),
        msg("Write {name}.add_node({node}) on a line above {written}, and outside of a loop."),
        whys={
            "late": msg(
                "spin waits until Ctrl+C: line {line}, which gives the node to the executor, is not "
                "reached before. An executor without the node does not call its callbacks."
            ),
            "given": SPINS_ALL,
            "added": SPINS_ALL,
        },
        fixes={
            "late": msg("Move line {line} ({name}.add_node) above this line."),
            "unknown": msg(
                "Write {name}.add_node() with the node in the () on a line above {written}, and outside of "
                "a loop."
            ),
            "given": msg(
                "Write {name}.add_node({node}) on a line of its own above this line, and "
                "{name}.spin() in this line."
            ),
            "added": msg("Write {name}.spin() in this line: {name} has the node already."),
        },
        raised={r"TypeError: \w{1,60}\.spin\(\) takes 1 positional argument but 2": _node_to_spin},
        behind={"run.never_spins": _executor_without_node, "run.no_lines": _executor_without_node},
        fixed_by=(node_executor.added_first,),
        examples=(
            example(
                "executor_without_node",
                *OWN_EXECUTOR,
                Replace(NODE, "        executor.add_node(node)\n", ""),
                fails="run.spins",
                blocks=("run.output", *SILENT),
            ),
            example(
                "executor_spins_with_a_node",
                *OWN_EXECUTOR,
                Replace(NODE, "        executor.add_node(node)\n", ""),
                Replace(NODE, "executor.spin()", "executor.spin(node)"),
                fails="run.starts",
            ),
            example(
                "executor_gets_node_late",
                *OWN_EXECUTOR,
                Replace(NODE, "        executor.add_node(node)\n", ""),
                Replace(
                    NODE,
                    "        executor.spin()\n",
                    "        executor.spin()\n        executor.add_node(node)\n",
                ),
                fails="run.spins",
                blocks=("run.output", *SILENT),
            ),
        ),
    ),
    _node(
        "made_in_callback",
        "counter",
        msg("The callback makes a new node each time"),
        msg(
            "{name}() does not return your node: it makes another one, whose counter starts again."
        ),
        msg("Use self: it is the node whose timer calls this method."),
        behind={"run.constant_counter": _made_in_callback, "run.faked_log": _made_in_callback},
        examples=(
            example(
                "made_in_callback",
                Replace(NODE, "str(self.counter_)", "str(MyFirstNode().counter_)"),
                fails="run.output",
                also={"run.logger": "node.made_in_callback"},
            ),
        ),
    ),
)
