"""Fixes of what prevents a node from starting, or gives it a wrong name."""

from __future__ import annotations

import ast
import re

from grader.mistakes.fixes.case import Case
from grader.mistakes.fixes.rename import def_renamed
from grader.package.edit.files import Files
from grader.package.edit.text import Splice, indent_of
from grader.package.source import endless
from grader.package.source.imported import NODE as NODE_CLASS
from grader.package.source.imported import full_name, name_of_node
from grader.package.source.module import Function, Module, is_text
from grader.package.source.names import calls_in, dotted
from grader.package.source.node import NodeSource

IMPORT = "from rclpy.node import Node"


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
    others = [code(base) for base in found.bases if dotted(base) != "object"]
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
    if len(calls) != 1 or ast.unparse(calls[0].func) != "super().__init__":
        return None
    call = calls[0]
    if not call.args and not call.keywords:
        end = text.span(call)[1] - 1
        return case.changed(node.module, Splice(end, end, wanted))
    given = call.args[0] if call.args else None
    for keyword in call.keywords:
        given = keyword.value if keyword.arg == "node_name" and given is None else given
    old = text.plain_string(given)
    if given is None or old is None or old == case.assignment.node_name:
        return None
    q = text.code(given)[0]
    return case.changed(node.module, text.swap(given, f"{q}{case.assignment.node_name}{q}"))


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


def main_takes_arguments(case: Case) -> Files | None:
    """Write args=None into main's empty parentheses."""
    main = case.node.main if case.node else None
    if case.node is None or main is None or ast.unparse(main.args):
        return None
    module = case.node.module_of(main)
    empty = re.search(r"\(\s*\)", module.text.line(main.lineno))
    if empty is None:
        return None
    start = module.text.start_of(main.lineno)
    return case.changed(module, Splice(start + empty.start(), start + empty.end(), "(args=None)"))


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
    made = [s for s in main.body if _makes(s, node)]
    if not made or body[0].lineno == main.lineno:
        return None
    if "import rclpy" not in text.text or "from rclpy import" in text.text:
        return None
    indent = indent_of(text.line(body[0].lineno))
    if not calls:
        takes = [a.arg for a in main.args.args] == ["args"]
        row = f"{indent}rclpy.init({'args=args' if takes else ''})"
        return case.changed(module, text.before(body[0].lineno, row))
    lines = [s for s in main.body if isinstance(s, ast.Expr) and s.value in calls]
    if len(calls) != 1 or len(lines) != 1 or lines[0] is body[0]:
        return None
    if lines[0].end_lineno != lines[0].lineno or not isinstance(body[0], ast.Assign):
        return None
    row = text.line(lines[0].lineno)
    return case.changed(module, text.without(lines[0].lineno), text.before(body[0].lineno, row))


def executor(case: Case) -> Files | None:
    """Spin the executor below the line that gives it the node."""
    module, name = case.module, str(case.finding.params.get("name", ""))
    calls = [n for n in module.nodes if isinstance(n, ast.Call)] if module is not None else []
    added = [call for call in calls if dotted(call.func) == f"{name}.add_node"]
    if module is None or not name or len(added) != 1:
        return None
    if any(dotted(call.func) == f"{name}.spin" for call in calls):  # (above: it never gets there)
        return None
    line = added[0].lineno
    if module.line(line) != module.text.code(added[0]):
        return None
    row = f"{indent_of(module.text.line(line))}{name}.spin()"
    return case.changed(module, module.text.before(line + 1, row))


def called_init(case: Case) -> Files | None:
    """Add the () to an rclpy.init that is only named."""
    module = case.module
    found = [n for n in module.nodes if isinstance(n, ast.Expr)] if module is not None else []
    named = [n for n in found if dotted(n.value) == "rclpy.init"]
    if module is None or case.node is None or len(named) != 1:
        return None
    main = case.node.main
    takes = main is not None and [a.arg for a in main.args.args] == ["args"]
    new = f"rclpy.init({'args=args' if takes else ''})"
    return case.changed(module, module.text.swap(named[0], new))


def called_spin(case: Case) -> Files | None:
    """Call a spin that is only named."""
    module, params = case.module, case.finding.params
    name, wanted = str(params.get("name", "")), str(params.get("wanted", ""))
    found = [n for n in module.nodes if isinstance(n, ast.Expr)] if module is not None else []
    named = [n for n in found if dotted(n.value) == name and n.lineno == case.finding.line]
    if module is None or case.node is None or len(named) != 1:
        return None
    node = wanted.partition("(")[2].removesuffix(")")
    if node and node not in case.node.node_variables:
        return None
    return case.changed(module, module.text.swap(named[0], wanted))


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


def spin(case: Case) -> Files | None:
    """Spin the node that main creates: with a real call, and forever instead of once."""
    node = case.node
    main = node.main if node else None
    if node is None or node.node_class is None or main is None:
        return None
    module = node.module_of(main)
    text = module.text
    made = [s for s in main.body if _makes(s, node)]
    loops = [n for n in ast.walk(main) if isinstance(n, ast.While | ast.For)]
    if len(made) != 1 or loops or not isinstance(made[0], ast.Assign):
        return None
    target = made[0].targets[0]
    if not isinstance(target, ast.Name):
        return None
    spun = [s for s in ast.walk(main) if isinstance(s, ast.Expr) and _spins(s)]
    if not spun and any(s.lineno == made[0].end_lineno for s in main.body if s is not made[0]):
        return None  # (a line below would come after what else is on this one)
    if not spun and not any(_spins(each.tree) for each in node.modules):
        return case.changed(module, _spin_added(module, main, made[0], f"rclpy.spin({target.id})"))
    wrong = [
        f"rclpy.spin_once({target.id})",
        f"{target.id}.spin()",
        "rclpy.spin",
        "rclpy.spin()",
        f"rclpy.spin({dotted(made[0].value).removesuffix('()')})",
    ]
    if case.finding.mistake == "node.spin_of_class":
        wrong.append(f"rclpy.spin({case.finding.params.get('name', '')})")
    if len(spun) != 1 or ast.unparse(spun[0]) not in wrong:
        return None
    return case.changed(module, text.swap(spun[0], f"rclpy.spin({target.id})"))


def idle_loop(case: Case) -> Files | None:
    """Spin the node in the place of a loop that only waits."""
    node = case.node
    main = node.main if node else None
    name = str(case.finding.params.get("node", ""))
    if node is None or main is None or not name.isidentifier():
        return None
    loop = endless.idle_loop(node, main)
    if loop is None or loop.lineno != case.finding.line:
        return None
    module = node.module_of(main)
    return case.changed(module, module.text.swap(loop, f"rclpy.spin({name})"))


def _spin_added(module: Module, main: Function, made: ast.stmt, spin: str) -> Splice:
    """Return the splice that adds a line that spins: in the try after the new node, if there is one."""
    after = [s for s in main.body if isinstance(s, ast.Try) and s.lineno > made.lineno]
    last = after[0].body[-1] if after else made
    if after and isinstance(last, ast.Pass):
        return module.text.swap(last, spin)
    indent = indent_of(module.text.line(last.lineno))
    return module.text.before((last.end_lineno or last.lineno) + 1, f"{indent}{spin}")


def _spins(node: ast.AST) -> bool:
    """Whether it contains a name that begins with spin."""
    names = [
        n.attr if isinstance(n, ast.Attribute) else n.id
        for n in ast.walk(node)
        if isinstance(n, ast.Attribute | ast.Name)
    ]
    return any(name.startswith("spin") for name in names)


def _makes(statement: ast.stmt, node: NodeSource) -> bool:
    """Whether it is an assignment whose value is a new node."""
    value = statement.value if isinstance(statement, ast.Assign) else None
    return isinstance(value, ast.Call) and node.is_node_class(value.func)


def spin_of_class(case: Case) -> Files | None:
    """Create the node above the line that spins its class, and spin the node."""
    node, module = case.node, case.module
    call = next(
        (
            n
            for n in (node.calls_of("spin") if node is not None else ())
            if n.lineno == case.finding.line and n.args and node is not None
        ),
        None,
    )
    if node is None or module is None or call is None or "node" in module.names:
        return None
    init = node.methods.get("__init__")
    required = len(init.args.args) - len(init.args.defaults) if init is not None else 1
    text, given = module.text, call.args[-1]
    row = text.line(call.lineno)
    alone = row.strip() == text.code(call) and call.lineno == call.end_lineno
    if not alone or not node.is_node_class(given) or required != 1:
        return None
    new = text.before(call.lineno, f"{indent_of(row)}node = {text.code(given)}()")
    return case.changed(module, new, text.swap(given, "node"))
