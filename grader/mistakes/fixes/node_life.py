"""Fixes of what prevents a node from starting, or gives it a wrong name."""

from __future__ import annotations

import ast
import re

from grader.mistakes.fixes.case import Case
from grader.mistakes.fixes.rename import def_renamed
from grader.package.edit.files import Files
from grader.package.edit.text import Splice, indent_of
from grader.package.source.imported import NODE as NODE_CLASS
from grader.package.source.imported import full_name, name_of_node
from grader.package.source.module import Function, Module, is_text
from grader.package.source.names import calls_in, dotted, last_part
from grader.package.source.node import NodeSource

IMPORT = "from rclpy.node import Node"
NO_BASES = ("rclpy", "rclpy.node", "rclpy.Node")
"""What beginners write as a base in the place of Node: modules."""


def node_import(case: Case) -> Files | None:
    """Import Node from rclpy.node."""
    node = case.node
    bases = node.node_class.bases if node and node.node_class else []
    if node is None or "Node" not in {ast.unparse(base) for base in bases}:
        return None
    module = node.module
    imports = [s for s in module.tree.body if isinstance(s, ast.Import | ast.ImportFrom)]
    for statement in imports:
        names = [alias.asname or alias.name for alias in statement.names]
        if "Node" in names or "*" in names:
            lost = isinstance(statement, ast.ImportFrom) and statement.module == "rclpy"
            return (
                case.changed(module, module.text.swap(statement, IMPORT))
                if lost and names == ["Node"]
                else None
            )
    plain = [s for s in imports if isinstance(s, ast.Import) and s.names[0].name == "rclpy"]
    if len(plain) != 1 or _binds(module, "Node"):
        return None
    return case.changed(module, module.text.before(plain[0].lineno + 1, IMPORT))


def _binds(module: Module, name: str) -> bool:
    for node in module.nodes:
        if isinstance(node, ast.Name) and node.id == name and isinstance(node.ctx, ast.Store):
            return True
        if isinstance(node, ast.FunctionDef | ast.ClassDef) and node.name == name:
            return True
    return False


def root_of(module: Module, found: ast.ClassDef) -> ast.ClassDef:
    """Return the class of the file that a class inherits from first of all, or itself."""
    classes = {c.name: c for c in module.tree.body if isinstance(c, ast.ClassDef)}
    seen = [found]
    while len(seen[-1].bases) == 1:
        other = classes.get(dotted(seen[-1].bases[0]))
        if other is None or other in seen:
            break
        seen.append(other)
    return seen[-1]


def init_by_name(module: Module, found: ast.ClassDef) -> ast.Call | None:
    """Return the call of Node.__init__(self, …) in a class, by the name that Node has there."""
    for call, name in calls_in(found):
        base, _, method = name.rpartition(".")
        given = dotted(call.args[0]) if call.args else ""
        if not base or method != "__init__" or given != "self":
            continue
        owner = call.func.value if isinstance(call.func, ast.Attribute) else call.func
        if full_name(module, owner) == NODE_CLASS:
            return call
    return None


def known_base(module: Module, found: ast.ClassDef) -> str:
    """Return Node by the name that a class can use; "" if the file does not import it."""
    call = init_by_name(module, found)
    if call is not None and isinstance(call.func, ast.Attribute):
        return dotted(call.func.value)
    return name_of_node(module)


def derived(module: Module, found: ast.ClassDef) -> str:
    """Return the line of a class that inherits from Node too."""
    code = module.text.code
    others = [
        code(base)
        for base in found.bases
        if dotted(base) != "object" and full_name(module, base) not in NO_BASES
    ]
    others += [f"{k.arg}={code(k.value)}" for k in found.keywords if k.arg]
    bases = ", ".join([known_base(module, found) or "Node", *others])
    return f"class {found.name}({bases}):"


def base_class(case: Case) -> Files | None:
    """Derive the class from Node, by the name that the file gives it."""
    module, line = case.module, case.finding.line
    classes = module.classes if module is not None else []
    found = next((c for c in classes if c.lineno == line), None)
    if line is None and case.node is not None:
        found = case.node.node_class
    if module is None or found is None:
        return None
    if any(full_name(module, base) == NODE_CLASS for base in found.bases):
        return None
    if root_of(module, found) is not found or (found.bases and "*" in module.imports):
        return None
    text, head = module.text, module.text.line(found.lineno)
    plain = re.match(rf"\s*class\s+{re.escape(found.name)}\s*(\([^()#]*\))?\s*:", head)
    if plain is None:
        return None
    start = text.start_of(found.lineno)
    indent = indent_of(head)
    splices = [Splice(start, start + plain.end(), indent + derived(module, found))]
    if not known_base(module, found):
        imported = import_below_rclpy(module)
        if imported is None:
            return None
        splices.append(imported)
    return case.changed(module, *splices)


def import_below_rclpy(module: Module) -> Splice | None:
    """Return the splice that imports Node below the import of rclpy; None if that is not certain."""
    tops = [s for s in module.tree.body if isinstance(s, ast.Import)]
    plain = [s for s in tops if s.names[0].name == "rclpy"]
    if len(plain) != 1 or _binds(module, "Node"):
        return None
    return module.text.before(plain[0].lineno + 1, IMPORT)


def constructor(case: Case) -> Files | None:
    """Rename the constructor to __init__, with two underscores on both sides."""
    node = case.node
    if node is None or node.method("__init__") is not None:
        return None
    found = [m for m in node.own_methods if node.calls_of("__init__", within=m)]
    if len(found) != 1:
        return None
    return _as_init(case, node.module, found[0])


def _as_init(case: Case, module: Module, method: ast.FunctionDef) -> Files | None:
    head = def_renamed(module, method, "__init__")
    return case.changed(module, head) if head is not None else None


def name(case: Case) -> Files | None:
    """Pass the node's name to super().__init__(), and add a missing call at the start."""
    node = case.node
    init = node.method("__init__") if node else None
    if node is None or init is None:
        return None
    text = node.module.text
    wanted = f"{text.quote}{case.assignment.node_name}{text.quote}"
    calls = node.calls_of("__init__")
    if not calls:
        return _call_added(case, init, f"super().__init__({wanted})")
    call = calls[0]
    if len(calls) != 1 or ast.unparse(call.func) != "super().__init__":
        return None
    if not call.args and not call.keywords:
        end = text.span(call)[1] - 1
        return case.changed(node.module, Splice(end, end, wanted))
    given = call.args[0] if call.args else None
    plain = given is not None and text.plain_string(given) is not None
    return case.changed(node.module, text.swap(given, wanted)) if given and plain else None


def _call_added(case: Case, init: ast.FunctionDef, call: str) -> Files | None:
    node = case.node
    if node is None or node.node_class is None:
        return None
    text = node.module.text
    bases = {ast.unparse(base).rpartition(".")[2] for base in node.node_class.bases}
    first = init.body[0]
    documented = isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant)
    if bases != {"Node"} or init.lineno == first.lineno:
        return None
    line = (first.end_lineno or first.lineno) + 1 if documented else first.lineno
    row = indent_of(text.line(first.lineno)) + call
    return case.changed(node.module, text.before(line, row))


def super_first(case: Case) -> Files | None:
    """Move super().__init__() to the start of the constructor."""
    node = case.node
    init = node.method("__init__") if node else None
    if node is None or init is None:
        return None
    found = [s for s in init.body if isinstance(s, ast.Expr) and _is_super(s.value)]
    first = init.body[0]
    if isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant):
        first = init.body[1] if len(init.body) > 1 else first
    if len(found) != 1 or found[0] is first or found[0].end_lineno != found[0].lineno:
        return None
    text = node.module.text
    row = text.line(found[0].lineno)
    return case.changed(node.module, text.without(found[0].lineno), text.before(first.lineno, row))


def _is_super(node: ast.expr) -> bool:
    return isinstance(node, ast.Call) and ast.unparse(node.func) == "super().__init__"


def main_arguments(case: Case) -> Files | None:
    """Give main's argument a default: the entry point calls main without arguments."""
    node = case.node
    main = node.main if node else None
    if node is None or main is None or main.args.defaults or main.decorator_list:
        return None
    args = main.args.args
    if len(args) != 1 or main.args.posonlyargs or main.args.kwonlyargs or args[0].annotation:
        return None
    module, name = node.module_of(main), args[0].arg
    start = module.text.at(args[0].lineno, args[0].col_offset)
    used = {n.id for n in ast.walk(main) if isinstance(n, ast.Name)}
    if name == "self" and name not in used:  # (a function outside of the class has no self)
        return case.changed(module, Splice(start, start + len(name), "args=None"))
    at = start + len(name)
    return case.changed(module, Splice(at, at, "=None"))


def own_init(case: Case) -> Files | None:
    """Call __init__ of the base class through super()."""
    node = case.node
    call = node.super_init if node is not None else None
    if node is None or call is None or not dotted(call.func).endswith("Node.__init__"):
        return None
    if call.args and dotted(call.args[0]) == "self":
        return None  # (super() would get self as the name)
    module = node.module_of(call)
    return case.changed(module, module.text.swap(call.func, "super().__init__"))


def init_call(source: NodeSource) -> str:
    """Return the call of rclpy.init for the entry function: with args only if the function has them."""
    given = source.main.args.args if source.main is not None else []
    return f"rclpy.init({'args=args' if 'args' in [a.arg for a in given] else ''})"


def rclpy_init(case: Case) -> Files | None:
    """Call rclpy.init() first in main: add the missing call, or move it there."""
    node = case.node
    main = node.main if node else None
    if node is None or main is None:
        return None
    module = node.module_of(main)
    text = module.text
    body = [s for s in main.body if not is_text(s)]
    calls = [c for c in node.calls_of("init") if ast.unparse(c.func) == "rclpy.init"]
    lines = [s for s in main.body if isinstance(s, ast.Expr) and s.value in calls]
    made = any(_makes(s, node) for s in main.body)
    if not made or "rclpy" not in module.imports or len(lines) != len(calls) or len(calls) > 1:
        return None
    if lines and (lines[0] is body[0] or lines[0].lineno != lines[0].end_lineno):
        return None
    row = f"{indent_of(text.line(body[0].lineno))}{init_call(node)}"
    gone = [text.without(s.lineno) for s in lines]
    return case.changed(module, *gone, text.before(body[0].lineno, row))


def called_init(case: Case) -> Files | None:
    """Add the () to an rclpy.init that is only named."""
    module = case.module
    found = [n for n in module.nodes if isinstance(n, ast.Expr)] if module is not None else []
    named = [n for n in found if dotted(n.value) == "rclpy.init"]
    if module is None or case.node is None or len(named) != 1:
        return None
    return case.changed(module, module.text.swap(named[0], init_call(case.node)))


def spin(case: Case) -> Files | None:
    """Spin the node that main creates: where nothing spins, or where spin gets something else."""
    node = case.node
    main = node.main if node else None
    made = (
        [s for s in main.body if _makes(s, node)] if node is not None and main is not None else []
    )
    if node is None or main is None or len(made) != 1 or not isinstance(made[0], ast.Assign):
        return None
    target = dotted(made[0].targets[0])
    if not target or any(isinstance(n, ast.While | ast.For) for n in ast.walk(main)):
        return None
    wanted = str(case.finding.params.get("wanted", "")) or f"rclpy.spin({target})"
    module = node.module_of(main)
    splice = _spin_corrected(node, target, wanted) or _spin_added(module, main, made[0], wanted)
    return case.changed(module, splice) if splice is not None else None


def _spins(node: NodeSource) -> list[ast.Attribute | ast.Name]:
    names = [
        n for each in node.modules for n in each.nodes if isinstance(n, ast.Attribute | ast.Name)
    ]
    return [n for n in names if last_part(dotted(n)).startswith("spin")]


def _spin_corrected(node: NodeSource, target: str, wanted: str) -> Splice | None:
    """Return the splice that gives the only call of spin the node, if it gets something else."""
    spins = _spins(node)
    module = node.module_of(spins[0]) if spins else node.module
    call = module.parents.get(spins[0]) if len(spins) == 1 else None
    if not isinstance(call, ast.Call) or dotted(call.func) not in ("rclpy.spin", f"{target}.spin"):
        return None
    return None if target in map(dotted, call.args) else module.text.swap(call, wanted)


def _spin_added(module: Module, main: Function, made: ast.stmt, wanted: str) -> Splice | None:
    """Return the splice that adds a line that spins: in the try after the new node, if there is one."""
    if any(last_part(dotted(n)).startswith("spin") for n in module.nodes):
        return None
    after = [s for s in main.body if isinstance(s, ast.Try) and s.lineno > made.lineno]
    last = after[0].body[-1] if after else made
    if after and isinstance(last, ast.Pass):
        return module.text.swap(last, wanted)
    row = f"{indent_of(module.text.line(last.lineno))}{wanted}"
    return module.text.before((last.end_lineno or last.lineno) + 1, row)


def _makes(statement: ast.stmt, node: NodeSource) -> bool:
    """Whether it is an assignment whose value is a new node."""
    value = statement.value if isinstance(statement, ast.Assign) else None
    return isinstance(value, ast.Call) and node.is_node_class(value.func)
