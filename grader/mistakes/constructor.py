"""Mistakes with which a node does not start: its class, and what the class' __init__ calls."""

from __future__ import annotations

import ast
import re
from collections.abc import Collection
from dataclasses import replace

from grader.base.i18n.message import msg, say
from grader.base.nearest import nearest
from grader.base.shown import shown
from grader.mistakes import links
from grader.mistakes.example import BODY_OF_MAIN, NODE, example
from grader.mistakes.fixes import lines, node_life, node_scope, node_words
from grader.mistakes.kind import Family
from grader.mistakes.placeholders import CLASS
from grader.mistakes.recognised import (
    NAME_ERROR,
    OWN_ATTRIBUTE,
    Raised,
    RecognisedMistake,
    Suspect,
    always,
    of_self,
)
from grader.mistakes.scope import NODE_METHODS
from grader.package.edit.tree import Replace
from grader.package.source.imported import full_name
from grader.package.source.names import calls_in, dotted, last_part
from grader.package.source.place import function_at, statement_at

NODES = ("rclpy.node.Node", "rclpy.Node")
PRIVATE = r"AttributeError: '(?P<type>\w{1,120})' object has no attribute '(?P<name>_\w{1,120})'"
NO_NODE_NAME = r"(?<!\w)Node\.__init__\(\) missing 1 required positional argument: 'node_name'"

INIT_OF_NODE = msg(
    "Node.__init__ sets up what timers, the logger and publishers need. Your class must call it "
    "first, with the node's name."
)
NOT_IMPORTED = msg(
    "The file does not import Node: add the line from rclpy.node import Node at the top of the file. "
    "Then write: {written}"
)
SUPER = msg("Write super().__init__('{node_name}') as the first line of __init__.")


def _with_of_init(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """`with rclpy.init():`; spin raises the same error after a shutdown."""
    del match
    for node in raised.module.nodes:
        if not isinstance(node, ast.With) or raised.line not in (None, node.lineno):
            continue
        for item in node.items:
            call = item.context_expr
            if isinstance(call, ast.Call) and last_part(dotted(call.func)) == "init":
                return raised.finding("context_manager", at=call)
    return None


def _class_is_spun(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    for call, name in raised.source.calls:
        given = dotted(call.args[0]) if call.args else ""
        if last_part(name) != "spin":
            continue
        imported = bool(given) and full_name(raised.source.module_of(call), call.args[0]) in NODES
        if not imported and not _is_class(raised, given):
            continue
        found = raised.finding("spin_of_class", at=call, name=given)
        node, made = raised.source.node_variables, raised.source.node_class
        words = {**found.words, "made": made.name if made is not None else CLASS}
        words["written"] = f"{name}({found.words['node']})"
        return replace(found, variant="variable" if len(node) == 1 else "", words=words)
    return None


def _is_class(raised: Raised, name: str) -> bool:
    """Return whether a name is that of a class of the files, the node's or another."""
    return name in raised.source.known_classes or last_part(name) in raised.source.class_names


def _not_a_node(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The class, or the own class that it inherits from, does not inherit from Node."""
    del match
    around = function_at(raised.module, raised.line)
    found = raised.module.parents.get(around) if around is not None else None
    if not isinstance(found, ast.ClassDef):
        found = raised.source.node_class
    if found is None:
        return raised.finding("not_a_node", name=CLASS, written=f"class {CLASS}(Node):")
    root = node_life.root_of(raised.module, found)
    named = any(last_part(dotted(base)) == "Node" for base in root.bases)  # (another class)
    return None if named or _is_beside_a_node(raised, root) else _without_node(raised, root)


def _is_beside_a_node(raised: Raised, found: ast.ClassDef) -> bool:
    """Whether a class is a helper beside the node's class, which inherits from Node already."""
    node, source = raised.source.node_class, raised.source
    if node is None or found is node:
        return False
    root = node_life.root_of(source.module, node)
    is_node = any(
        full_name(source.module, base) in NODES or dotted(base) == "Node" for base in root.bases
    )
    return is_node and found is not root


def _plain_class(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The class that main spins uses the methods of a node, and no class of the file is a node."""
    found = raised.source.node_class
    function = function_at(raised.module, raised.line)
    if found is None or function is None or function not in found.body or found.bases:
        return None
    if match["name"] not in NODE_METHODS or raised.source.held_node or not of_self(raised, match):
        return None
    bases = [
        last_part(dotted(b)) for m in raised.source.modules for c in m.classes for b in c.bases
    ]
    made = [name for _, name in raised.source.calls if last_part(name) in ("Node", "create_node")]
    if made or any(base.endswith("Node") for base in bases):
        return None
    mistake = _without_node(raised, found)
    return mistake if mistake.variant else replace(mistake, variant="unnamed")


def _without_node(raised: Raised, found: ast.ClassDef) -> RecognisedMistake:
    """Name the class line as it should be, with Node by the name that the file gives it."""
    module = raised.source.module_of(found)
    written = node_life.derived(module, found)
    mistake = raised.finding("not_a_node", at=found, name=found.name, written=written)
    return replace(mistake, variant="" if node_life.known_base(module, found) else "import")


def _near_init(methods: Collection[str], cutoff: float) -> str:
    """Return the method with nearly the name `__init__`; "" if there is none, or __init__ itself."""
    plain = next((name for name in methods if name.strip("_") == "init"), "")
    return "" if "__init__" in methods else plain or nearest("__init__", methods, cutoff=cutoff)


def _underscores(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    methods = raised.source.methods
    near = _near_init(methods, cutoff=0.7)
    if not near:
        return None
    found = raised.finding("init_underscores", at=methods[near], name=near)
    called = [name for _, name in calls_in(methods[near])]
    return replace(found, variant="super") if f"super().{near}" in called else found


def _misspelt_init(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A class of the node has no __init__, but a method with nearly this name that calls super()."""
    del match
    for own in raised.module.classes:
        methods = {m.name: m for m in own.body if isinstance(m, ast.FunctionDef)}
        near = _near_init(methods, cutoff=0.8)
        if near and _calls_super(methods[near]):
            return raised.finding("init_underscores", at=methods[near], name=near)
    return None


def _dunder(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A name of Python has one underscore on each side instead of two."""
    name = match["name"]
    written = f"__{name.strip('_')}__"
    if not re.fullmatch(r"_{1,3}[a-z]+_{1,3}", name) or written not in node_words.DUNDERS:
        return None
    return raised.finding("single_underscores", name=name, written=written)


def _calls_super(method: ast.AST) -> bool:
    return any(name == "super().__init__" for _, name in calls_in(method))


def _without_name_in_other(raised: Raised) -> RecognisedMistake | None:
    """Node itself is called, or the class has no __init__ at all."""
    source, statement = raised.source, statement_at(raised.module, raised.line)
    calls = [call for call, _ in (calls_in(statement) if statement is not None else ())]
    if any(full_name(raised.module, call.func) in NODES for call in calls):
        return replace(raised.finding("super_without_name"), variant="plain_named")
    own = source.node_class
    made = any(source.is_node_class(call.func) for call in calls)
    if own is None or not made or any("__init__" in _names_of(c) for c in source.family):
        return None
    found = raised.finding("super_without_name", at=own)
    return replace(found, variant="no_init", words={**found.words, "type": own.name})


def _names_of(owner: ast.ClassDef) -> set[str]:
    """Return the names of the methods of a class."""
    return {s.name for s in owner.body if isinstance(s, ast.FunctionDef | ast.AsyncFunctionDef)}


def _without_name(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Return that no name is passed; through the class, the first argument is self."""
    del match
    found, call = raised.finding("super_without_name"), raised.source.super_init
    if call is None or raised.line not in lines_of(call):
        return _without_name_in_other(raised) or found
    if not call.args:
        return replace(found, variant="here")
    by_name = dotted(call.func).endswith("Node.__init__") and dotted(call.args[0]) != "self"
    return replace(found, variant="on_class") if by_name else found


def _init_no_self(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    if match["function"] != "__init__":
        return None
    return raised.finding("init_no_self", at=raised.source.methods.get("__init__"))


def _super_self(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    call = raised.source.super_init
    if call is None or dotted(call.func) != "super().__init__" or not call.args:
        return None
    if dotted(call.args[0]) != "self" or raised.line not in (None, *lines_of(call)):
        return None
    return raised.finding("super_with_self", at=call)


def lines_of(node: ast.expr) -> range:
    """Return the lines of an expression."""
    return range(node.lineno, (node.end_lineno or node.lineno) + 1)


def is_of_node(raised: Raised, match: re.Match[str]) -> bool:
    """Whether a missing attribute can be one that Node sets: the student's line does not read it."""
    statement = statement_at(raised.module, raised.line)
    parts = raised.source.all_nodes if statement is None else ast.walk(statement)
    read = [n for n in parts if isinstance(n, ast.Attribute) and isinstance(n.ctx, ast.Load)]
    return match["name"] not in {part.attr for part in read}


def _super_missing(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    if match["type"] not in raised.source.known_classes or raised.source.super_init is not None:
        return None
    calls = [name for own in raised.source.family for _, name in calls_in(own)]
    if "super().__init__" in calls or not is_of_node(raised, match):
        return None
    init = raised.source.methods.get("__init__")
    inside = init is not None and raised.line in range(init.lineno, (init.end_lineno or 0) + 1)
    return raised.finding("super_missing", at=None if inside else init)


def _super_late(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    if match["type"] not in raised.source.known_classes or not is_of_node(raised, match):
        return None
    found = raised.finding("super_late", at=raised.source.super_init)
    init, call = raised.source.methods.get("__init__"), raised.source.super_init
    if init is None or call is None or raised.line is None:
        return found
    if raised.module.has(init) and not _runs_before(raised, call):
        return None
    if raised.module.has(init) and init.lineno <= raised.line < call.lineno:
        return replace(found, variant="line", words={**found.words, "line": str(raised.line)})
    return found


def _runs_before(raised: Raised, call: ast.Call) -> bool:
    """Whether the line of the error can run before the call of super().__init__()."""
    function = function_at(raised.module, raised.line)
    if function is None or function.name == "__init__":
        return raised.line is None or raised.line <= call.lineno
    return function in raised.source.methods.values()


def _in_namespace(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a namespace that the class gives to a node of the right name."""
    call = suspect.source.super_init
    given = call.args[0] if call is not None and call.args else None
    named = getattr(given, "value", suspect.assignment.node_name)
    if call is None or named != suspect.assignment.node_name or "/" in str(named):
        return None
    for keyword in call.keywords:
        value = getattr(keyword.value, "value", None)
        if keyword.arg == "namespace" and value not in ("", "/", None):
            text = suspect.source.module_of(call).text
            code = f"namespace={text.code(keyword.value)}"
            return suspect.finding("in_namespace", call, name=code)
    return None


def _name_invalid(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Name the character that the node's name must not have."""
    call = raised.source.super_init
    given = call.args[0] if call is not None and call.args else None
    wrong = (
        re.search(r"[^A-Za-z0-9_]", str(given.value)) if isinstance(given, ast.Constant) else None
    )
    code = raised.source.module_of(given).text.code(given) if given is not None else ""
    if given is None or wrong is None or code[:1] not in ("'", '"'):
        return always("name_invalid")(raised, match)
    written = f"{code[0]}{raised.assignment.node_name}{code[0]}"
    found = raised.finding("name_invalid", at=given, params={"name": code, "written": written})
    sign = say("a blank") if wrong[0] == " " else shown(wrong[0])
    return replace(found, words={**found.words, "sign": sign}, variant="character")


ON_CLASS = msg(
    "Node.__init__ is called on the class. There the first argument is self, so your string is taken for "
    "self, and the name is missing. super() passes self on its own."
)
_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "spin_of_class",
        "spin",
        msg("rclpy.spin gets the class instead of the node"),
        msg("spin needs the node that was created, not its class."),
        msg("Write {node} = {made}() and then {written}."),
        links.EXECUTORS,
        whys={
            "variable": msg(
                "{name} is a class. spin needs the node that was created: the variable {node}."
            )
        },
        fixes={"variable": msg("Write {written} on this line.")},
        seen=r"TypeError: 'property' object is not iterable",
        raised={r"\w": _class_is_spun},
        fixed_by=(node_life.spin, node_life.spin_of_class),
        examples=(
            example(
                "spin_of_class",
                Replace(NODE, "rclpy.spin(node)", "rclpy.spin(MyFirstNode)"),
                fails="run.starts",
            ),
            example(
                "spin_of_imported_class",
                Replace(NODE, "rclpy.spin(node)", "rclpy.spin(Node)"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "context_manager",
        "start",
        msg("with rclpy.init() needs a newer ROS"),
        msg(
            "rclpy.init() works in a with statement from ROS 2 kilted on; before, it returns "
            "nothing."
        ),
        msg(
            "Write rclpy.init(args=args) on a line of its own, without with, and indent the lines "
            "below it less, as far as this line."
        ),
        links.RCLPY,
        seen=r"'NoneType' object does not support the context manager protocol"
        r"|AttributeError: __enter__",
        raised={"context manager protocol|AttributeError: __enter__": _with_of_init},
        examples=(
            example(
                "context_manager_of_kilted",
                Replace(
                    NODE,
                    BODY_OF_MAIN,
                    ("    with rclpy.init(args=args):\n        rclpy.spin(MyFirstNode())\n"),
                ),
                fails="run.starts",
                right_from="kilted",
                note="with rclpy.init() is the newer tutorial's form, which works from kilted on",
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
        fixes={
            "import": NOT_IMPORTED,
            "unnamed": msg(
                "Write: {written} Then pass the node's name in __init__: super().__init__('{node_name}')"
            ),
        },
        seen=r"TypeError: object\.__init__\(\) takes exactly one argument",
        raised={
            r"object\.__init__\(\) takes exactly one argument": _not_a_node,
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
                "not_a_node_and_super_without_name",
                Replace(NODE, "class MyFirstNode(Node)", "class MyFirstNode"),
                Replace(NODE, "super().__init__('my_first_node')", "super().__init__()"),
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
        msg("Rename {name} to __init__: two underscores before and after."),
        fixes={
            "super": msg(
                "Write __init__ instead of {name} in this line and in super().{name}(…), with two "
                "underscores on both sides."
            ),
        },
        raised={
            r"TypeError: ": _misspelt_init,
            NO_NODE_NAME: _underscores,
        },
        fixed_by=(node_life.constructor,),
        examples=(
            example(
                "init_without_underscores",
                Replace(NODE, "    def __init__(self)", "    def init(self)"),
                Replace(NODE, "super().__init__(", "super().init("),
                fails="run.starts",
            ),
            example(
                "init_single_underscores",
                Replace(NODE, "    def __init__(self)", "    def _init_(self)"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "single_underscores",
        "file",
        msg("A name of Python has too few underscores"),
        msg(
            "Names such as __init__, __name__ and '__main__' have two underscores on both sides. A "
            "chat or a web page can take one of them away when code is copied."
        ),
        msg(
            "Write {written} instead of {name}, and look for other names of this form in the file."
        ),
        links.PYTHON_CLASSES,
        raised={
            NAME_ERROR: _dunder,
            r"has no attribute '(?P<name>_{1,3}[a-z]{1,20}_{1,3})'": _dunder,
        },
        fixed_by=(node_words.double_underscores,),
        examples=(
            example(
                "underscores_lost_in_a_chat",
                Replace(NODE, "__init__(self)", "_init_(self)"),
                Replace(NODE, "super().__init__", "super()._init_"),
                Replace(NODE, "__name__ == '__main__'", "_name_ == '_main_'"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "init_no_self",
        "class",
        msg("__init__ has no parameter self"),
        msg("Python passes the new object to __init__ as its first argument."),
        msg("Write: def __init__(self):"),
        links.PYTHON_CLASSES,
        seen=r"__init__\(\) takes 0 positional arguments but 1 was given",
        raised={
            r"(?P<function>\w{1,120})\(\) takes 0 positional arguments but 1 was given": _init_no_self
        },
        examples=(
            example(
                "init_without_self",
                Replace(NODE, "def __init__(self)", "def __init__()"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "super_not_called",
        "class",
        msg("The () after super is missing"),
        msg(
            "super is only a name in Python; calling it, super(), gives access to the class that "
            "yours inherits from."
        ),
        SUPER,
        links.PYTHON_CLASSES,
        seen=r"TypeError: descriptor '__init__' requires a 'super' object",
        raised={"descriptor '__init__' requires a 'super' object": always("super_not_called")},
        examples=(
            example(
                "super_without_brackets",
                Replace(NODE, "super().__init__", "super.__init__"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "super_with_self",
        "class",
        msg("super().__init__() gets self"),
        msg("super() passes self on its own. The first argument in the () is the node's name."),
        msg("Write super().__init__('{node_name}'), without self."),
        links.PYTHON_CLASSES,
        raised={r"TypeError": _super_self},
        fixed_by=(node_scope.without_self,),
        examples=(
            example(
                "super_with_self",
                Replace(NODE, "__init__('my_first_node')", "__init__(self, 'my_first_node')"),
                fails="run.starts",
            ),
            example(
                "super_with_self_alone",
                Replace(NODE, "__init__('my_first_node')", "__init__(self)"),
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
        seen=r"AttributeError: '\w{1,120}' object has no attribute '_default_callback_group'",
        raised={PRIVATE: _super_missing},
        fixed_by=(node_life.name,),
        examples=(
            example(
                "super_missing",
                Replace(NODE, "        super().__init__('my_first_node')\n", ""),
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
        fixes={
            "line": msg(
                "Move this line to the first line of __init__: line {line} already uses the node, "
                "which super().__init__('{node_name}') sets up."
            ),
        },
        raised={PRIVATE: _super_late},
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
        msg("No name is passed to the __init__ of Node"),
        msg("A node needs a name: ros2 node list and the log show it."),
        SUPER,
        seen=r"TypeError: Node\.__init__\(\) missing 1 required positional argument: 'node_name'",
        whys={
            "on_class": ON_CLASS,
            "no_init": msg(
                "The class {type} has no __init__, so Python calls that of Node, which needs the node's "
                "name."
            ),
        },
        fixes={
            "no_init": msg(
                "Give {type} a def __init__(self): with super().__init__('{node_name}') as its first line. "
                "What the node needs at its start belongs below that line."
            ),
            "plain_named": msg("Pass the name as the first value in this line: '{node_name}'"),
            "here": msg("Pass the name in this line: super().__init__('{node_name}')"),
        },
        raised={NO_NODE_NAME: _without_name},
        fixed_by=(lines.written, node_life.own_init, node_life.name),
        examples=(
            example(
                "init_of_node_without_self",
                Replace(NODE, "super().__init__(", "Node.__init__("),
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
        fixes={"character": msg("Write {written} instead of {name}. The wrong character: {sign}.")},
        seen=r"InvalidNodeNameException: Invalid node name",
        raised={"InvalidNodeNameException": _name_invalid},
        fixed_by=(node_life.name, lines.written),
        examples=(
            example(
                "dash_in_node_name",
                Replace(NODE, "'my_first_node'", "'my-first-node'"),
                fails="run.starts",
            ),
            example(
                "blank_in_node_name",
                Replace(NODE, "'my_first_node'", "'my first node'"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "in_namespace",
        "class",
        msg("The node is in a namespace"),
        msg(
            "A namespace comes before the node's name, so the full name is not /{node_name}. The "
            "package's name is no part of it."
        ),
        msg("Delete the argument {name}."),
        links.NAMES,
        behind={"run.wrong_node_name": _in_namespace},
        examples=(
            example(
                "node_in_namespace",
                Replace(NODE, "'my_first_node')", "'my_first_node', namespace='robot')"),
                fails="run.node_name",
            ),
        ),
    ),
)
