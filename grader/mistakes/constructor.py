"""Mistakes with which a node does not start: its class, what its __init__ calls, and what is spun."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.base.nearest import nearest
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import lines, node_life
from grader.mistakes.kind import Family
from grader.mistakes.recognised import OWN_ATTRIBUTE, Raised, RecognisedMistake, always, of_self
from grader.package.edit.tree import Replace
from grader.package.source.counter import targets_of
from grader.package.source.imported import full_name
from grader.package.source.module import Function
from grader.package.source.names import calls_in, dotted, last_part
from grader.package.source.node import NODE_METHODS
from grader.package.source.node_here import node_here
from grader.package.source.place import function_at, statement_at

NODES = ("rclpy.node.Node", "rclpy.Node")
PRIVATE = r"AttributeError: '(?P<type>\w{1,120})' object has no attribute '(?P<name>_\w{1,120})'"
NO_NODE_NAME = r"(?<!\w)Node\.__init__\(\) missing 1 required positional argument: 'node_name'"
NO_BASE = (
    r"TypeError: (?:module|str|int)\(\) takes at most|metaclass conflict|argument: 'node_name'"
    r"|module 'rclpy(?:\.node)?' has no attribute '[Nn]ode'"
)
OF_CLASS = (
    r"TypeError: .{1,200} missing \d{1,3} required positional argument"
    r"|AttributeError: (?:type object '|'property' object)|'property' object is not iterable"
    r"|object has no attribute '(?:executor|handle|context)'"
)
EXECUTORS = ("SingleThreadedExecutor", "MultiThreadedExecutor", "EventsExecutor")
INIT_OF_NODE = msg(
    "Node.__init__ sets up what timers, the logger and publishers need. Your class must call it "
    "first, with the node's name."
)
SUPER = msg("Write super().__init__('{node_name}') as the first line of __init__.")


def lines_of(node: ast.expr) -> range:
    """Return the lines of an expression."""
    return range(node.lineno, (node.end_lineno or node.lineno) + 1)


def _not_a_node(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The node's class does not inherit from Node, or from a module that has nearly its name."""
    del match
    found = raised.source.node_class
    if found is None:
        return None
    root = node_life.root_of(raised.source.module_of(found), found)
    bases = [full_name(raised.source.module_of(root), base) for base in root.bases]
    named = [
        dotted(base)
        for base in root.bases
        if full_name(raised.module, base) not in node_life.NO_BASES
    ]
    if any(last_part(name) == "Node" for name in named) or set(bases) & {NODES[0]}:
        return None
    return _without_node(raised, root)


def _plain_class(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The class that main spins uses the methods of a node, and no class of the file is a node."""
    found, function = raised.source.node_class, function_at(raised.module, raised.line)
    if found is None or function is None or function not in found.body or found.bases:
        return None
    if match["name"] not in NODE_METHODS or raised.source.held_node or not of_self(raised, match):
        return None
    made = [name for _, name in raised.source.calls if last_part(name) in ("Node", "create_node")]
    return None if made else _without_node(raised, found)


def _without_node(raised: Raised, found: ast.ClassDef) -> RecognisedMistake:
    """Name the class line as it should be, with Node by the name that the file gives it."""
    module = raised.source.module_of(found)
    written = node_life.derived(module, found)
    mistake = raised.finding("not_a_node", at=found, name=found.name, written=written)
    return replace(mistake, variant="" if node_life.known_base(module, found) else "import")


def _misspelt_init(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A class of the node has no __init__, but a method with nearly this name."""
    del match
    for own in raised.source.family:
        methods = {m.name: m for m in own.body if isinstance(m, Function)}
        near = next((name for name in methods if name.strip("_") == "init"), "")
        near = near or nearest("__init__", methods, cutoff=0.7)
        if near and "__init__" not in methods:
            return raised.finding("init_underscores", at=methods[near], name=near)
    return None


def _without_name(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """What super().__init__() gets first is no name: nothing, self, or no text."""
    call = raised.source.super_init
    if call is None or raised.line not in (None, *lines_of(call)):
        own = raised.source.node_class
        plain = call is None and "__init__" not in raised.source.methods and own is not None
        found = raised.finding("super_without_name", at=own if plain else None)
        words = {**found.words, "type": own.name if own is not None else ""}
        found = replace(found, words=words, variant="no_init" if plain else "")
        return found if "node_name" in match[0] else None
    first = call.args[0] if call.args else None
    is_text = isinstance(first, ast.Constant) and isinstance(first.value, str)
    if is_text and len(call.args) == 1 and not call.keywords and "node_name" not in match[0]:
        return None
    return replace(raised.finding("super_without_name", at=call), variant="here")


def is_of_node(raised: Raised, match: re.Match[str]) -> bool:
    """Whether a missing attribute can be one that Node sets: the student's line does not read it."""
    statement = statement_at(raised.module, raised.line)
    parts = raised.source.all_nodes if statement is None else ast.walk(statement)
    read = [n for n in parts if isinstance(n, ast.Attribute) and isinstance(n.ctx, ast.Load)]
    return match["name"] not in {part.attr for part in read}


def _super_missing(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """super().__init__() is not called, or only below the line that needs it."""
    if match["type"] not in raised.source.known_classes or not is_of_node(raised, match):
        return None
    init, call = raised.source.methods.get("__init__"), raised.source.super_init
    calls = [name for own in raised.source.family for _, name in calls_in(own)]
    if call is None and "super().__init__" not in calls:
        inside = init is not None and raised.line in range(init.lineno, (init.end_lineno or 0) + 1)
        return raised.finding("super_missing", at=None if inside else init)
    function = function_at(raised.module, raised.line)
    late = raised.line is None or (call is not None and raised.line < call.lineno)
    if call is not None and function is init and not late:
        return None
    return raised.finding("super_late", at=call)


def _name_invalid(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Name the text that must not be the node's name."""
    call = raised.source.super_init
    given = call.args[0] if call is not None and call.args else None
    if not isinstance(given, ast.Constant):
        return always("name_invalid")(raised, match)
    code = raised.source.module_of(given).text.code(given)
    written = repr(raised.assignment.node_name)
    found = raised.finding("name_invalid", at=given, params={"name": code, "written": written})
    return replace(found, variant="written")


def _class_kept(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A variable holds the class, which the line that sets it does not call; or spin gets the class."""
    del match
    statement = statement_at(raised.module, raised.line)
    used = {dotted(n) for n in ast.walk(statement or raised.module.tree)} - {""}
    sets = [
        n
        for n in raised.source.all_nodes
        if isinstance(n, ast.Assign)
        and len(n.targets) == 1
        and used & set(targets_of(n))
        and _is_class(raised, n.value)
    ]
    if len(sets) == 1:
        code = raised.source.module_of(sets[0]).text.code(sets[0])
        params = {"name": code, "written": f"{code}()"}
        return raised.finding("class_not_called", at=sets[0], params=params)
    return _not_spun(raised)


def _is_class(raised: Raised, value: ast.expr) -> bool:
    name = last_part(dotted(value)) if isinstance(value, ast.Name | ast.Attribute) else ""
    return raised.source.is_node_class(value) or (bool(name) and name in EXECUTORS)


def _not_spun(raised: Raised) -> RecognisedMistake | None:
    """The call of spin that fails gets something that is no node."""
    for call, name in raised.source.calls:
        if last_part(name) not in ("spin", "spin_once") or raised.line not in lines_of(call):
            continue
        given = call.args[0] if call.args else None
        if given is None or dotted(given) in raised.source.node_variables:
            continue
        code = raised.module.text.code(given)
        is_class = full_name(raised.module, given) in NODES or _is_class(raised, given)
        if not is_class and not isinstance(given, ast.Constant):
            return None  # (what it is has to be followed)
        node = node_here(raised.source, raised.module, raised.line) or "node"
        return raised.finding("spin_of_other", at=call, name=code, written=node)
    return None


_node = Family("node", links.PYTHON_CLASSES)
KINDS = (
    _node(
        "spin_of_other",
        "spin",
        msg("rclpy.spin gets something that is not the node"),
        msg("spin needs the node that was created: the variable that has the new object."),
        msg("Write {written} instead of {name}."),
        links.EXECUTORS,
        fixed_by=(node_life.spin, lines.written),
        examples=(
            example(
                "spin_of_class",
                Replace(NODE, "rclpy.spin(node)", "rclpy.spin(MyFirstNode)"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "class_not_called",
        "start",
        msg("The () after the class is missing"),
        msg("The name of a class creates no object; only calling it does."),
        msg("Write {written} on this line."),
        seen=r"TypeError: 'property' object is not iterable",
        raised={OF_CLASS: _class_kept},
        fixed_by=(lines.written,),
        examples=(
            example(
                "node_not_made",
                Replace(NODE, "node = MyFirstNode()", "node = MyFirstNode"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "not_a_node",
        "class",
        msg("The class does not inherit from Node"),
        msg(
            "A class is a node only if it inherits from rclpy's Node. Without it, super() is "
            "Python's plain object, which takes no name."
        ),
        msg("Write: {written}"),
        links.FIRST_NODE,
        fixes={
            "import": msg(
                "The file does not import Node: add the line from rclpy.node import Node at the top of the "
                "file. Then write: {written}"
            ),
        },
        seen=r"TypeError: object\.__init__\(\) takes exactly one argument",
        raised={
            r"object\.__init__\(\) takes exactly one argument": _not_a_node,
            NO_BASE: _not_a_node,
            OWN_ATTRIBUTE: _plain_class,
        },
        fixed_by=(node_life.base_class,),
        examples=(
            example(
                "not_a_node",
                Replace(NODE, "class MyFirstNode(Node)", "class MyFirstNode"),
                fails="run.starts",
            ),
            example(
                "base_is_module",
                Replace(NODE, "from rclpy.node import Node", "from rclpy import node"),
                Replace(NODE, "(Node)", "(node)"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "init_underscores",
        "class",
        msg("The class has no __init__, but a method that looks like it"),
        msg(
            "Python calls __init__, with two underscores on both sides, when an object is "
            "created. A method with another name is not called, so Node gets no name."
        ),
        msg(
            "Write __init__ instead of {name}, with two underscores on both sides, here and wherever "
            "{name} is called."
        ),
        links.FIRST_NODE,
        raised={
            NO_NODE_NAME: _misspelt_init,
            r"object has no attribute '_?init_?'": _misspelt_init,
        },
        fixed_by=(node_life.constructor,),
        examples=(
            example(
                "init_single_underscores",
                Replace(NODE, "    def __init__(self)", "    def _init_(self)"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "super_missing",
        "class",
        msg("super().__init__() is not called"),
        INIT_OF_NODE,
        SUPER,
        links.FIRST_NODE,
        seen=r"AttributeError: '\w{1,120}' object has no attribute '_default_callback_group'"
        r"|TypeError: descriptor '__init__' requires a 'super' object",
        raised={
            PRIVATE: _super_missing,
            "descriptor '__init__' requires a 'super' object": always("super_missing"),
        },
        fixed_by=(node_life.name,),
        examples=(
            example(
                "super_missing",
                Replace(NODE, "        super().__init__('my_first_node')\n", ""),
                fails="run.starts",
            ),
            example(
                "super_without_brackets",
                Replace(NODE, "super().__init__", "super.__init__"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "super_late",
        "class",
        msg("super().__init__() is called too late"),
        INIT_OF_NODE,
        msg("Move super().__init__('{node_name}') to the first line of __init__."),
        links.FIRST_NODE,
        fixed_by=(node_life.super_first,),
        examples=(
            example(
                "super_after_timer",
                Replace(NODE, "        super().__init__('my_first_node')\n", ""),
                Replace(
                    NODE,
                    "        self.create_timer(1.0, self.timer_callback)\n",
                    (
                        "        self.create_timer(1.0, self.timer_callback)\n"
                        "        super().__init__('my_first_node')\n"
                    ),
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "super_without_name",
        "class",
        msg("super().__init__() does not get the node's name"),
        msg(
            "A node needs a name, as a text in quotes: ros2 node list and the log show it. super() passes "
            "self on its own."
        ),
        SUPER,
        links.FIRST_NODE,
        seen=r"TypeError: Node\.__init__\(\) missing 1 required positional argument: 'node_name'",
        fixes={
            "no_init": msg(
                "Give {type} a def __init__(self): with super().__init__('{node_name}') as its first line. "
                "What the node needs at its start belongs below that line."
            ),
            "here": msg(
                "Write super().__init__('{node_name}') in this line, without another value."
            ),
        },
        raised={
            NO_NODE_NAME: _without_name,
            r"incompatible constructor arguments|Node\.__init__\(\) (?:takes|got)": _without_name,
        },
        fixed_by=(node_life.own_init, node_life.name),
        examples=(
            example(
                "super_with_self",
                Replace(NODE, "__init__('my_first_node')", "__init__(self, 'my_first_node')"),
                fails="run.starts",
            ),
            example(
                "super_without_name",
                Replace(NODE, "__init__('my_first_node')", "__init__()"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "name_invalid",
        "class",
        msg("The node's name has a character that ROS does not allow"),
        msg(
            "Node names contain only letters, digits and underscores, and do not begin with a "
            "digit."
        ),
        msg("Write super().__init__('{node_name}')."),
        links.NAMES,
        fixes={"written": msg("Write {written} instead of {name}.")},
        seen=r"InvalidNodeNameException: Invalid node name",
        raised={"InvalidNodeNameException": _name_invalid},
        fixed_by=(node_life.name, lines.written),
        examples=(
            example(
                "dash_in_node_name",
                Replace(NODE, "'my_first_node'", "'my-first-node'"),
                fails="run.starts",
            ),
        ),
    ),
)
