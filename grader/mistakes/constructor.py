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
from grader.mistakes.example import BODY_OF_MAIN, DEAD, NODE, SILENT, example
from grader.mistakes.fixes import lines, node_life, node_scope, node_words
from grader.mistakes.fixes.case import Case
from grader.mistakes.fixes.rename import def_renamed, splices_of
from grader.mistakes.kind import Family
from grader.mistakes.placeholders import CLASS
from grader.mistakes.recognised import (
    NAME_ERROR,
    OWN_ATTRIBUTE,
    Raised,
    RecognisedMistake,
    Suspect,
    always,
    first_of,
    of_self,
)
from grader.mistakes.scope import NODE_METHODS
from grader.package.edit.files import Files
from grader.package.edit.text import Splice
from grader.package.edit.tree import Replace, Write
from grader.package.source.counter import targets_of
from grader.package.source.imported import full_name
from grader.package.source.module import Function
from grader.package.source.names import calls_in, dotted, last_part
from grader.package.source.node import NodeSource
from grader.package.source.place import block_of, function_at, statement_at

NODES = ("rclpy.node.Node", "rclpy.Node")
PRIVATE = r"AttributeError: '(?P<type>\w{1,120})' object has no attribute '(?P<name>_\w{1,120})'"
NO_NODE_NAME = r"(?<!\w)Node\.__init__\(\) missing 1 required positional argument: 'node_name'"

INIT_OF_NODE = msg(
    "Node.__init__ sets up what timers, the logger and publishers need. Your class must call it "
    "first, with the node's name."
)
NO_NODE = msg(
    "A class is a node only if it inherits from rclpy's Node. {called} sets up a node: it needs "
    "the methods and attributes of Node, and {name} does not inherit them."
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
    return None if _is_beside_a_node(raised, root) else _without_node(raised, root)


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


def _value_for_object(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A helper class without a base passes a value to super().__init__()."""
    del match
    around = function_at(raised.module, raised.line)
    owner = raised.module.parents.get(around) if around is not None else None
    plain = isinstance(owner, ast.ClassDef) and all(dotted(b) == "object" for b in owner.bases)
    if not isinstance(owner, ast.ClassDef) or not plain or not _is_beside_a_node(raised, owner):
        return None
    calls = [c for c, name in calls_in(around) if name == "super().__init__"] if around else []
    calls = [c for c in calls if raised.line in lines_of(c) and (c.args or c.keywords)]
    if len(calls) != 1:
        return None
    code = raised.module.text.code(calls[0])
    params = {"name": code, "written": "super().__init__()"}
    found = raised.finding("value_for_object", at=calls[0], params=params)
    return replace(found, words={**found.words, "type": owner.name})


def _init_of_other(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Node.__init__ is called with self, by its name, in a class that is no Node."""
    for found in raised.module.classes:
        call = node_life.init_by_name(raised.module, found)
        plain = all(dotted(base) == "object" for base in found.bases)
        if call is None or not plain or found.name != match["type"]:
            continue
        if raised.line in lines_of(call):
            called = f"{raised.module.text.code(call.func)}(…)"
            mistake = _without_node(raised, found)
            words = {**mistake.words, "called": called}
            return replace(mistake, words=words, variant=f"{mistake.variant}_called".lstrip("_"))
    return None


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
    if "__init__" in methods:
        return None
    inside = [m.name for m in methods.values() if _calls_super(m)]
    near = inside[0] if len(inside) == 1 else nearest("__init__", methods, cutoff=0.7)
    near = near or next((name for name in methods if name.strip("_") == "init"), "")
    if not near:
        return None
    found = raised.finding("init_underscores", at=methods[near], name=near)
    called = [name for _, name in calls_in(methods[near])]
    if f"super().{near}" in called:
        return replace(found, variant="super")
    if near.strip("_") == "init" or nearest("__init__", [near], cutoff=0.7):
        return found
    return _init_of_other_name(raised, methods[near])


def _init_of_other_name(raised: Raised, method: Function) -> RecognisedMistake:
    """Another method than __init__ calls the __init__ of Node, and lines may call this method.

    If it has the name of its class, as in other languages, a call of the name makes the node.
    """
    own = raised.source.node_class
    named = f"self.{method.name}" if own is not None and own.name == method.name else ""
    calls = [
        call
        for call, name in raised.source.calls
        if (name == named if named else last_part(name) == method.name)
    ]
    rows = ", ".join(str(row) for row in sorted({call.lineno for call in calls}))
    params = {"name": method.name, **({"lines": rows} if calls else {})}
    found = raised.finding("init_other_name", at=method, params=params)
    return replace(found, variant="" if calls else "uncalled")


def _never_runs(suspect: Suspect) -> RecognisedMistake | None:
    """The class has no __init__, but a method with nearly this name that creates the timer."""
    source, own = suspect.source, suspect.source.node_class
    methods = {m.name: m for m in source.own_methods}
    makers = [m.name for m in source.own_methods if _calls_super(m)]
    near = _near_init(methods, cutoff=0.7)
    near = near or (makers[0] if len(makers) == 1 and "__init__" not in methods else "")
    others = ("super", "rclpy.")
    called = [last_part(name) for _, name in source.calls if not name.startswith(others)]
    if own is None or not near or near in called:
        return None
    if not any(last_part(name) == "create_timer" for _, name in calls_in(methods[near])):
        return None
    mistake = suspect.finding("init_underscores", methods[near], name=near, made=own.name)
    return replace(mistake, variant="silent")


def _with_init(case: Case) -> Files | None:
    """Rename the constructor and its call of super(), and create the node without values."""
    node, near = case.node, str(case.finding.params.get("name", ""))
    method = node.method(near) if node is not None and near else None
    if node is None or method is None or not case.finding.params.get("made"):
        return None
    module, text = node.module_of(method), node.module_of(method).text
    head = def_renamed(module, method, "__init__")
    made = [c for c, _ in node.calls if node.is_node_class(c.func) and (c.args or c.keywords)]
    called = [c.func for c, name in calls_in(method) if name == f"super().{near}"]
    of_super = [part for part in called if isinstance(part, ast.Attribute)]
    supers = splices_of(module, of_super, "__init__")
    if head is None or supers is None or not all(map(module.has, made)):
        return None
    splices = [head, *supers]
    if len(method.args.args) == 1:
        splices += [text.swap(call, f"{text.code(call.func)}()") for call in made]
    return case.changed(module, *splices)


def _renamed_to_init(case: Case) -> Files | None:
    """Rename the method to __init__, and delete the only line that calls it."""
    node, name = case.node, str(case.finding.params.get("name", ""))
    method = node.method(name) if node is not None and name else None
    if node is None or method is None:
        return None
    module = node.module_of(method)
    head = def_renamed(module, method, "__init__")
    calls = [c for c, called in node.calls if last_part(called) == name]
    if head is None or len(calls) > 1 or not all(map(module.has, calls)):
        return None
    rows = []
    for call in calls:
        statement = module.parents.get(call)
        if not isinstance(statement, ast.Expr) or call.args or call.keywords:
            return None
        own = lines.own_lines(module, statement)
        if own is None or len(block_of(module, statement)) < 2:
            return None
        rows += [module.text.without(row) for row in own]
    return case.changed(module, head, *rows)


def _misspelt_init(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A class of the node has no __init__, but a method with nearly this name that calls super()."""
    del match
    for own in raised.module.classes:
        methods = {m.name: m for m in own.body if isinstance(m, ast.FunctionDef)}
        near = _near_init(methods, cutoff=0.8)
        if near and _calls_super(methods[near]):
            return raised.finding("init_underscores", at=methods[near], name=near)
    return None


def _init_not_called(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The class of an object has no __init__; a method with nearly this name sets the attribute."""
    name = match["name"]
    for own in (c for c in raised.module.classes if c.name == match["type"] and not c.bases):
        if own.decorator_list:
            continue  # (a dataclass has an __init__ of its own: node.post_init_name)
        methods = {m.name: m for m in own.body if isinstance(m, ast.FunctionDef)}
        near = _near_init(methods, cutoff=0.8)
        sets = [
            n
            for n in (ast.walk(methods[near]) if near else ())
            if isinstance(n, ast.Attribute) and isinstance(n.ctx, ast.Store)
        ]
        if f"self.{name}" in {dotted(n) for n in sets}:
            found = raised.finding("init_underscores", at=methods[near], name=near)
            words = {**found.words, "attribute": name, "type": own.name}
            return replace(found, variant="of_object", words=words)
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


def _plain_made(raised: Raised) -> ast.Call | None:
    """Return the call of Node itself on the line of the error; None if there is none."""
    statement = statement_at(raised.module, raised.line)
    for call, name in calls_in(statement) if statement is not None else ():
        if full_name(raised.module, call.func) in NODES and not name.endswith("__init__"):
            return call
    return None


def _without_name_of_plain(raised: Raised, call: ast.Call) -> RecognisedMistake | None:
    """Node() is called by itself: the class of the student is meant, or the name is missing."""
    source, code = raised.source, raised.module.text.code
    init = source.methods.get("__init__")
    own = source.node_class is not None and init is not None and not source.makes_node()
    if own and len(init.args.args) - len(init.args.defaults) > 1 if init is not None else False:
        own = False
    if call.args or call.keywords or "\n" in code(call):
        return replace(raised.finding("super_without_name"), variant="plain_named")
    name = f"{raised.module.text.quote}{raised.assignment.node_name}{raised.module.text.quote}"
    written = f"{code(call.func)}({name})"
    if own and source.node_class is not None:
        written = f"{source.node_class.name}()"
    params = {"name": code(call), "written": written}
    found = raised.finding("super_without_name", at=call, params=params)
    made = source.node_class.name if own and source.node_class is not None else ""
    return replace(
        found, words={**found.words, "made": made}, variant="plain_class" if own else "plain"
    )


def _without_name_in_other(raised: Raised) -> RecognisedMistake | None:
    """The name is missing in the __init__ of a base class, or the class has no __init__ at all."""
    source, module = raised.source, raised.module
    around = function_at(module, raised.line)
    statement = statement_at(module, raised.line)
    calls = [
        c
        for c, name in (calls_in(statement) if statement is not None else ())
        if name == "super().__init__" and not c.args and not c.keywords
    ]
    if len(calls) == 1 and around is not None and around.name == "__init__":
        passed = around.args.args[1:2]
        if not passed or len(around.args.args) > 2:
            return replace(raised.finding("super_without_name", at=calls[0]), variant="here_open")
        params = {
            "name": module.text.code(calls[0]),
            "written": f"super().__init__({passed[0].arg})",
        }
        found = raised.finding("super_without_name", at=calls[0], params=params)
        return replace(
            found, variant="here_parameter", words={**found.words, "parameter": passed[0].arg}
        )
    own = source.node_class
    made = [
        c for c, _ in (calls_in(statement) if statement else ()) if source.is_node_class(c.func)
    ]
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
    plain = _plain_made(raised)
    if plain is not None:
        return _without_name_of_plain(raised, plain)
    if call is None or raised.line not in lines_of(call):
        return _without_name_in_other(raised) or found
    if not call.args:
        return replace(found, variant="here")
    if not dotted(call.func).endswith("Node.__init__"):
        return found
    if dotted(call.args[0]) == "self":
        return _self_alone(raised, call)
    code = raised.source.module_of(call).text.code
    name, given = code(call), [*call.args, *(k.value for k in call.keywords)]
    if "\n" in name or len(given) != 1 or call.keywords:
        return replace(found, variant="on_class")
    params = {"name": name, "written": f"super().__init__({code(call.args[0])})"}
    return replace(raised.finding("super_without_name", params=params), variant="on_class_only")


def _self_alone(raised: Raised, call: ast.Call) -> RecognisedMistake:
    """Node.__init__ gets self, and no name."""
    text = raised.source.module_of(call).text
    name = f"{text.quote}{raised.assignment.node_name}{text.quote}"
    given = [text.code(part) for part in call.args[1:]] + [text.code(k) for k in call.keywords]
    written = f"{text.code(call.func)}({', '.join(['self', name, *given])})"
    found = raised.finding("super_without_name", at=call, name=text.code(call), written=written)
    return replace(found, variant="self_alone")


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
    if not is_of_node(raised, match):
        return None
    init = raised.source.methods.get("__init__")
    inside = init is not None and raised.line in range(init.lineno, (init.end_lineno or 0) + 1)
    elsewhere = _super_elsewhere(raised)
    if elsewhere is not None:
        method, call = elsewhere
        found = raised.finding("super_late", at=call)
        words = {**found.words, "method": method.name, "name": raised.module.text.code(call)}
        return replace(found, words=words, variant="method")
    return raised.finding("super_missing", at=None if inside else init)


def _super_elsewhere(raised: Raised) -> tuple[Function, ast.Call] | None:
    """Return the method besides __init__ that calls the __init__ of Node, and this call."""
    for owner in raised.source.family:
        for method in owner.body:
            if not isinstance(method, Function) or method.name == "__init__":
                continue
            for call, name in calls_in(method):
                if name == "super().__init__" or name.endswith("Node.__init__"):
                    return method, call
    return None


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


def _namespace_invalid(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The class gives its node a namespace that ROS does not allow."""
    del match
    call = raised.source.super_init
    given = [k for k in call.keywords if k.arg == "namespace"] if call is not None else []
    if call is None or not given:
        return None
    code = raised.source.module_of(call).text.code(given[0].value)
    found = raised.finding("in_namespace", at=call, name=f"namespace={code}")
    return replace(found, variant="invalid")


def _without_namespace(case: Case) -> Files | None:
    """Delete the namespace, if it is the last argument."""
    call = case.node.super_init if case.node is not None else None
    if case.node is None or call is None or len(call.args) != 1 or len(call.keywords) != 1:
        return None
    module = case.node.module_of(call)
    start, end = module.text.span(call.args[0])[1], module.text.span(call.keywords[0].value)[1]
    return case.changed(module, Splice(start, end, ""))


def _name_invalid(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Name the character, and the string that has it, also if that is in a variable."""
    string = _name_given(raised.source)
    name = str(string.value) if string is not None else ""
    wrong = re.search(r"[^A-Za-z0-9_]", name)
    if string is None or wrong is None:
        return always("name_invalid")(raised, match)
    code = raised.source.module_of(string).text.code(string)
    written = f"{code[0]}{raised.assignment.node_name}{code[0]}"
    found = raised.finding("name_invalid", at=string, params={"name": code, "written": written})
    sign = say("a blank") if wrong[0] == " " else shown(wrong[0])
    if name == f"{name.rstrip()} ":
        sign = say("a blank at the end")
    return replace(found, words={**found.words, "sign": sign}, variant="character")


def _name_given(source: NodeSource) -> ast.Constant | None:
    """Return the string that is the node's name, also if a variable has it."""
    call = source.super_init
    given = call.args[0] if call is not None and call.args else None
    if isinstance(given, ast.Name | ast.Attribute):
        name = last_part(dotted(given))
        values = [
            n.value
            for n in source.own_nodes
            if isinstance(n, ast.Assign) and name in map(last_part, targets_of(n))
        ]
        given = values[0] if len(values) == 1 else None
    plain = isinstance(given, ast.Constant) and isinstance(given.value, str)
    code = source.module_of(given).text.code(given) if given is not None and plain else ""
    return given if isinstance(given, ast.Constant) and code[:1] in ("'", '"') else None


def _super_bare(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    """Super has no () behind it."""
    del match
    row = raised.module.line(raised.line)
    if len(re.findall(r"\bsuper\.__init__\b", row)) != 1:
        return raised.finding("super_not_called")
    params = {"name": "super.__init__", "written": "super().__init__"}
    return replace(raised.finding("super_not_called", params=params), variant="written")


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
        whys={
            "called": NO_NODE,
            "import_called": NO_NODE,
        },
        fixes={
            "import": NOT_IMPORTED,
            "import_called": NOT_IMPORTED,
            "unnamed": msg(
                "Write: {written} Then pass the node's name in __init__: super().__init__('{node_name}')"
            ),
        },
        seen=r"TypeError: object\.__init__\(\) takes exactly one argument",
        raised={
            r"object\.__init__\(\) takes exactly one argument": _not_a_node,
            OWN_ATTRIBUTE: first_of(_init_of_other, _plain_class),
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
            example(
                "object_and_init_of_node",
                Replace(NODE, "class MyFirstNode(Node)", "class MyFirstNode(object)"),
                Replace(NODE, "super().__init__(", "Node.__init__(self, "),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "init_other_name",
        "class",
        msg("The class has no __init__: another method sets up the node"),
        msg(
            "Python calls only __init__ when an object is created. The class has none, so Python calls that "
            "of Node, and Node gets no name. {name} would give it one, and has not run yet."
        ),
        msg(
            "Write __init__ instead of {name} in this line, with two underscores on both sides. Delete the "
            "call of {name} (lines: {lines}): Python calls __init__ by itself."
        ),
        fixes={
            "uncalled": msg(
                "Write __init__ instead of {name} in this line, with two underscores on both sides."
            )
        },
        fixed_by=(_renamed_to_init,),
    ),
    _node(
        "value_for_object",
        "class",
        msg("A class without a base class passes a value to super().__init__()"),
        msg(
            "The class {type} inherits from no other class. super() is Python's plain object there, and "
            "its __init__ takes no value."
        ),
        msg("Write {written} instead of {name}, or delete this line."),
        links.PYTHON_CLASSES,
        raised={r"object\.__init__\(\) takes exactly one argument": _value_for_object},
        fixed_by=(lines.written,),
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
        whys={
            "of_object": msg(
                "Python calls __init__, with two underscores on both sides, when an object of {type} is "
                "created. A method with another name is not called, so nothing sets {attribute}."
            ),
            "silent": msg(
                "Python calls __init__, with two underscores on both sides, when an object is "
                "created. A method with another name is not called, so nothing creates the timer."
            ),
        },
        fixes={
            "super": msg(
                "Write __init__ instead of {name} in this line and in super().{name}(…), with two "
                "underscores on both sides."
            ),
            "silent": msg(
                "Write __init__ instead of {name} in this line and in super().__init__(…), with two "
                "underscores on both sides. Where {function} creates the node, write {made}() with nothing in "
                "the ()."
            ),
        },
        behind={"run.no_lines": _never_runs},
        raised={
            r"TypeError: ": _misspelt_init,
            NO_NODE_NAME: _underscores,
            OWN_ATTRIBUTE: _init_not_called,
        },
        fixed_by=(_with_init, node_life.constructor, node_life.constructor_of_object),
        examples=(
            example(
                "init_never_called",
                Replace(NODE, "    def __init__(self)", "    def _init_(self)"),
                Replace(NODE, "super().__init__(", "super()._init_("),
                Replace(NODE, "node = MyFirstNode()", "node = MyFirstNode('my_first_node')"),
                fails="run.output",
                blocks=SILENT,
            ),
            example(
                "init_with_the_name_of_ruby",
                Replace(NODE, "    def __init__(self)", "    def initialize(self, name)"),
                Replace(NODE, "super().__init__('my_first_node')", "super().__init__(name)"),
                Replace(NODE, "node = MyFirstNode()", "node = MyFirstNode('my_first_node')"),
                fails="run.output",
                blocks=SILENT,
            ),
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
            example(
                "init_as_int_below_a_base_class",
                Replace(
                    NODE,
                    "class MyFirstNode(Node):",
                    "class Named(Node):\n    def __init__(self, name):\n        super().__init__(name)\n\n\n"
                    "class MyFirstNode(Named):",
                ),
                Replace(NODE, "    def __init__(self):", "    def __int__(self):"),
                fails="run.starts",
            ),
            example(
                "init_of_an_object_in_another_file",
                Write(
                    "my_robot_controller/clicker.py",
                    "class Clicker:\n    def _init_(self):\n        self.clicks = -1\n\n"
                    "    def click(self):\n        self.clicks += 1\n        return self.clicks\n",
                ),
                Replace(
                    NODE,
                    "import rclpy\n",
                    "import rclpy\n\nfrom my_robot_controller.clicker import Clicker\n",
                ),
                Replace(NODE, "self.counter_ = 0", "self.clicker = Clicker()"),
                Replace(NODE, "str(self.counter_)", "str(self.clicker.click())"),
                Replace(NODE, "        self.counter_ += 1\n", ""),
                fails="run.output",
                blocks=DEAD,
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
        fixes={"written": msg("Write {written} instead of {name} in this line.")},
        seen=r"TypeError: descriptor '__init__' requires a 'super' object",
        raised={"descriptor '__init__' requires a 'super' object": _super_bare},
        fixed_by=(lines.written,),
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
            "method": msg(
                "Write super().__init__('{node_name}') as the first line of __init__, and delete {name} "
                "in {method}."
            ),
        },
        whys={
            "method": msg(
                "Node.__init__ sets up what timers, the logger and publishers need. Your class calls it "
                "only in {method}, and had not done so when the node was used."
            )
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
            "on_class_only": ON_CLASS,
            "no_init": msg(
                "The class {type} has no __init__, so Python calls that of Node, which needs the node's "
                "name."
            ),
            "plain_class": msg(
                "{name} creates a node without the timer and the callback of your class, and gives it no "
                "name. Python runs the code of a class only for its objects."
            ),
        },
        fixes={
            "no_init": msg(
                "Give {type} a def __init__(self): with super().__init__('{node_name}') as its first line. "
                "What the node needs at its start belongs below that line."
            ),
            **dict.fromkeys(
                ("plain", "plain_class", "here_parameter"),
                msg("Write {written} instead of {name}."),
            ),
            "plain_named": msg("Pass the name as the first value in this line: '{node_name}'"),
            "here_open": msg(
                "Pass the name in this line: write it into the () of super().__init__()."
            ),
            **dict.fromkeys(
                ("on_class_only", "self_alone"), msg("Write {written} instead of {name}.")
            ),
            "here": msg("Pass the name in this line: super().__init__('{node_name}')"),
        },
        raised={NO_NODE_NAME: _without_name},
        fixed_by=(lines.written, node_life.own_init, node_life.name),
        examples=(
            example(
                "init_of_node_with_self_alone",
                Replace(NODE, "super().__init__('my_first_node')", "Node.__init__(self)"),
                fails="run.starts",
            ),
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
                "blank_at_the_end_of_a_name",
                Replace(
                    NODE, "class MyFirstNode", "NAME = 'my_first_node '\n\n\nclass MyFirstNode"
                ),
                Replace(NODE, "super().__init__('my_first_node')", "super().__init__(NAME)"),
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
        whys={
            "invalid": msg(
                "ROS does not allow this namespace: it has a character or a form that a "
                "namespace cannot have. The node needs no namespace, its full name is /{node_name}."
            )
        },
        raised={"InvalidNamespaceException": _namespace_invalid},
        behind={"run.wrong_node_name": _in_namespace},
        fixed_by=(_without_namespace,),
        examples=(
            example(
                "namespace_with_a_dot",
                Replace(NODE, "'my_first_node')", "'my_first_node', namespace='my.robot')"),
                fails="run.starts",
            ),
            example(
                "node_in_namespace",
                Replace(NODE, "'my_first_node')", "'my_first_node', namespace='robot')"),
                fails="run.node_name",
            ),
        ),
    ),
)
