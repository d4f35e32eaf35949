"""Names that the file defines, but not where they are used: in another function, or in a class."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import DEAD, NODE, example
from grader.mistakes.fixes.case import Case
from grader.mistakes.fixes.lines import own_lines
from grader.mistakes.kind import Family
from grader.mistakes.other_place import with_global
from grader.mistakes.recognised import NAME_ERROR, Raised, RecognisedMistake
from grader.package.edit.files import Files
from grader.package.edit.tree import Replace
from grader.package.source.counter import targets_of
from grader.package.source.module import Function, Module
from grader.package.source.names import calls_in, dotted, last_part, own_name
from grader.package.source.node import read_module
from grader.package.source.place import function_at
from grader.package.source.scopes import (
    Bound,
    Scope,
    bindings,
    class_of,
    declarations,
    has_self,
    scope_of,
    seen_from,
    use_of,
    visible_names,
)

OF_NODE = (
    *("publishers", "subscriptions", "clients", "services", "timers", "guards", "waitables"),
    *("executor", "context", "default_callback_group", "handle"),
)
"""Properties of Node, which a class cannot use for its own values."""


def _hidden(raised: Raised, name: str) -> tuple[Scope | None, list[Bound]] | None:
    """Return the scope of the line, and what binds the name elsewhere, if nothing does so here."""
    module = raised.module
    use = use_of(module, raised.line, name)
    found = _that_have_run(module, name) if use is not None else []
    if use is None or not found:
        return None
    here = scope_of(module, use)
    seen = set(seen_from(module, here))
    return None if any(bound.scope in seen for bound in found) else (here, found)


def _that_have_run(module: Module, name: str) -> list[Bound]:
    """Return what binds a name that the file does not know yet: no line that declares it global."""
    return [b for b in bindings(module, name) if b.scope or not function_at(module, b.line)]


def _in_class(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The lines of a class set the name, and a function uses it without the class or self."""
    name, module = match["name"], raised.module
    hidden = _hidden(raised, name)
    if hidden is None:
        return None
    here, found = hidden
    set_by = [
        b for b in found if isinstance(b.scope, ast.ClassDef) and isinstance(b.part, ast.Name)
    ]
    if len({b.scope for b in set_by}) != 1 or not isinstance(here, Function):
        return None
    owner = set_by[0].scope
    own = class_of(module, here)
    if not isinstance(owner, ast.ClassDef):
        return None
    inside = own is not None and own[0] is owner and has_self(own[1])
    written = f"{'self' if inside else owner.name}.{name}"
    rows = _lines(_uses(module, name))
    params = {"name": name, "written": written, "lines": rows}
    words = {"type": owner.name, "line": str(set_by[0].line)}
    mistake = raised.finding("name_in_class", params=params)
    return replace(mistake, words={**mistake.words, **words})


def _uses(module: Module, name: str) -> list[ast.Name]:
    """Return where functions read the name."""
    return [
        n
        for n in module.nodes
        if isinstance(n, ast.Name)
        and n.id == name
        and isinstance(n.ctx, ast.Load)
        and isinstance(scope_of(module, n), Function)
    ]


def _lines(parts: Iterable[ast.AST]) -> str:
    rows = sorted({getattr(part, "lineno", 0) for part in parts})
    return ", ".join(map(str, rows))


def _is_above(raised: Raised, owner: Function) -> bool:
    """Whether the line stands directly above the def of a function, with only blank lines between."""
    rows = range((raised.line or owner.lineno) + 1, owner.lineno)
    above = raised.line is not None and raised.line < owner.lineno
    return above and not any(raised.module.line(row) for row in rows)


def _local(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Only another function has the name: as its variable, its parameter or its inner function."""
    name, module = match["name"], raised.module
    hidden = _hidden(raised, name)
    if hidden is None:
        return None
    here, found = hidden
    other_case = {n for n in visible_names(module, raised.line, name) if n.lower() == name.lower()}
    if other_case and here is None:
        return None  # (class A(node): the base Node is meant)
    of_node = class_of(module, here) is not None and name in {"node", *raised.source.node_variables}
    if of_node and not _is_of_other_class(raised, here, name):
        return None  # (there, self is the node)
    owners = {bound.scope for bound in found}
    owner = found[0].scope
    if len(owners) != 1 or not isinstance(owner, Function):
        return None
    params = {"name": name, "line": str(found[0].line), "function": owner.name}
    mistake = raised.finding("name_local", params=params)
    if not isinstance(here, Function) and _is_above(raised, owner):
        return replace(mistake, variant="above")
    kept = _as_attribute(raised, owner, here, found)
    if kept is not None:
        variant, more = kept
        given = {**params, **more}
        return replace(mistake, variant=variant, params=given, words={**mistake.words, **given})
    if len(found) == 1 and isinstance(found[0].part, Function) and _is_apart(found[0].part, owner):
        return replace(mistake, variant="def")
    if isinstance(here, Function) and _is_of_timer(raised, owner, here, found):
        return replace(
            mistake,
            variant="global",
            params={**params, "word": "global"},
            words={**mistake.words, "called": here.name},
        )
    passed = _passed(raised, owner, here)
    words = {**mistake.words, "head": passed[0], "others": passed[1]} if passed else mistake.words
    called = here.name if isinstance(here, Function) else ""
    return replace(mistake, variant="pass" if passed else "", words={**words, "called": called})


def _is_of_other_class(raised: Raised, here: Scope | None, name: str) -> bool:
    """Whether a variable has an object of another class of the files than that of this method."""
    own = class_of(raised.module, here)
    family = {c.name for c in raised.source.family} | ({own[0].name} if own is not None else set())
    made = {
        last_part(dotted(n.value.func))
        for n in raised.source.all_nodes
        if isinstance(n, ast.Assign) and isinstance(n.value, ast.Call) and name in targets_of(n)
    }
    return bool(made) and made <= raised.source.known_classes - family


def _is_of_timer(raised: Raised, owner: Function, here: Function, found: list[Bound]) -> bool:
    """Whether only a timer calls the function: it runs after the other one has set the name."""
    module = raised.module
    plain = all(_is_assigned(module, bound.part) for bound in found)
    of_file = all(module.functions.get(each.name) is each for each in (owner, here))
    called = any(isinstance(n, ast.Call) and dotted(n.func) == here.name for n in module.nodes)
    timed = any(timer.method == here.name for timer in raised.source.timers)
    return plain and of_file and timed and not called and here is not owner


def _as_attribute(
    raised: Raised, owner: Function, here: Scope | None, found: list[Bound]
) -> tuple[str, dict[str, str]] | None:
    """Return the variant and the words if both functions are methods of one class."""
    module = raised.module
    setting, using = class_of(module, owner), class_of(module, here)
    if setting is None or using is None or setting[0] is not using[0]:
        return None
    if setting[1] is not owner or not has_self(owner) or not has_self(using[1]):
        return None
    name = raised_name(found)
    new = f"self.{_free(setting[0], name)}"
    if len(found) == 1 and isinstance(found[0].part, ast.arg):
        return "parameter", {"written": new, "lines": _lines(_unbound(module, owner, name))}
    plain = [b for b in found if _is_assigned(module, b.part)]
    if len(plain) != len(found):
        return None
    parts = [n for n in ast.walk(setting[0]) if isinstance(n, ast.Name) and n.id == name]
    words = {"written": new, "lines": _lines(parts)}
    declared = declarations(module, name)
    called = [own_name(c.func) for c, _ in calls_in(setting[0])]
    if declared and owner.name != "__init__" and owner.name not in called:
        return None
    if declared:
        return "global_attribute", {**words, "rows": _lines(declared)}
    return ("self" if owner.name == "__init__" else "method"), words


def raised_name(found: list[Bound]) -> str:
    """Return the name that the first of these parts binds."""
    part = found[0].part
    return part.arg if isinstance(part, ast.arg) else str(getattr(part, "id", ""))


def _unbound(module: Module, owner: Function, name: str) -> list[ast.Name]:
    inside = set(ast.walk(owner))
    return [use for use in _uses(module, name) if use not in inside]


def _is_assigned(module: Module, part: ast.AST) -> bool:
    around = module.parents.get(part)
    return isinstance(around, ast.Assign | ast.AnnAssign | ast.AugAssign)


def _free(owner: ast.ClassDef, name: str) -> str:
    """Return a name for an attribute that the class and Node do not use for something else."""
    taken = {own_name(n) for n in ast.walk(owner) if isinstance(n, ast.Attribute)}
    taken |= {n.name for n in owner.body if isinstance(n, Function)} | {*OF_NODE}
    taken |= {target for s in owner.body for target in targets_of(s)}
    while name in taken:
        name += "_"
    return name


def _is_apart(inner: Function, owner: Function) -> bool:
    """Whether an inner function needs nothing that the function around it has."""
    own = {n.arg for n in ast.walk(owner) if isinstance(n, ast.arg)}
    own |= {
        n.id for n in ast.walk(owner) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)
    }
    within = {n.arg for n in ast.walk(inner) if isinstance(n, ast.arg)}
    within |= {
        n.id for n in ast.walk(inner) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)
    }
    read = {n.id for n in ast.walk(inner) if isinstance(n, ast.Name)}
    return not (read - within) & (own - within) and not inner.decorator_list


def _passed(raised: Raised, owner: Function, here: Scope | None) -> tuple[str, str] | None:
    """Return the lines of the def and of the calls, if only the owner calls the other function."""
    module = raised.module
    if not isinstance(here, Function) or here not in module.tree.body:
        return None
    uses = [n for n in module.nodes if isinstance(n, ast.Name) and n.id == here.name]
    around = [module.parents.get(use) for use in uses]
    if not uses or not all(isinstance(a, ast.Call) and dotted(a.func) == here.name for a in around):
        return None
    if any(scope_of(module, use) is not owner for use in uses):
        return None
    return str(here.lineno), _lines(uses)


def _qualified(case: Case) -> Files | None:
    """Write the name with self or with its class, wherever functions read it."""
    module, params = read_module(case.files.data, case.finding.file), case.finding.params
    name, new = (str(params.get(key, "")) for key in ("name", "written"))
    if module is None or not name or not new.endswith(f".{name}"):
        return None
    uses = _uses(module, name)
    if any(module.text.code(use) != name for use in uses) or _lines(uses) != params.get("lines"):
        return None
    return case.changed(module, *(module.text.swap(use, new) for use in uses))


def _kept(case: Case) -> Files | None:
    """Make an attribute of the variable of __init__ that another method reads."""
    module, params = read_module(case.files.data, case.finding.file), case.finding.params
    name, new, owner = (str(params.get(key, "")) for key in ("name", "written", "function"))
    if module is None or not name or not new.startswith("self.") or owner != "__init__":
        return None
    found = _that_have_run(module, name)
    setting = class_of(module, found[0].scope) if found else None
    if setting is None or not all(_is_assigned(module, bound.part) for bound in found):
        return None
    parts = [n for n in ast.walk(setting[0]) if isinstance(n, ast.Name) and n.id == name]
    if any(module.text.code(n) != name for n in parts) or _lines(parts) != params.get("lines"):
        return None
    methods = [class_of(module, scope_of(module, n)) for n in parts]
    if not all(m is not None and has_self(m[1]) for m in methods):
        return None
    declared = declarations(module, name)
    if any(own_lines(module, d) is None or d.names != [name] for d in declared):
        return None
    rows = [module.text.without(d.lineno) for d in declared]
    return case.changed(module, *rows, *(module.text.swap(n, new) for n in parts))


def _global(case: Case) -> Files | None:
    """Write the global in the function that sets the name."""
    return with_global(case) if case.finding.params.get("word") else None


_node = Family("node", links.PYTHON_CLASSES)
KINDS = (
    _node(
        "name_in_class",
        "class",
        msg("A name of the class is used without self or the class"),
        msg(
            "Line {line} sets {name} in the class {type}. Functions do not see the names of a class "
            "by themselves, also not the functions of this class."
        ),
        msg("Write {written} instead of {name} (lines: {lines})."),
        raised={NAME_ERROR: _in_class},
        fixed_by=(_qualified,),
        examples=(
            example(
                "constant_of_class_without_self",
                Replace(NODE, "    def __init__", "    PERIOD = 1.0\n\n    def __init__"),
                Replace(NODE, "create_timer(1.0,", "create_timer(PERIOD,"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "name_local",
        "class",
        msg("The name belongs to another function"),
        msg(
            "Line {line} defines {name} inside of the function {function}. What a function defines "
            "is known only inside of this function."
        ),
        msg(
            "Bring the value to this line: as an argument of the function that has this line, or as "
            "an attribute of an object that both places know. Or define {name} outside of all "
            "functions and classes, if it needs nothing of {function}."
        ),
        fixes={
            "above": msg(
                "This line stands above def {function}, outside of it. Move it below the line "
                "def {function}(…), indented by 4 spaces like the other lines of {function}."
            ),
            "self": msg(
                "Write {written} instead of {name} (lines: {lines}): an attribute of self is known "
                "in all methods of the class."
            ),
            "global_attribute": msg(
                "Write {written} instead of {name} (lines: {lines}): an attribute of self is known "
                "in all methods of the class. Then delete global {name} (line {rows})."
            ),
            "method": msg(
                "Write {written} instead of {name} (lines: {lines}): an attribute of self is known "
                "in all methods of the class, from the moment when {function} has set it."
            ),
            "parameter": msg(
                "Write {written} = {name} as a new line in {function}, before the timer is created. "
                "Write {written} instead of {name} (lines: {lines})."
            ),
            "def": msg(
                "Move def {name} (line {line}) and its lines out of {function}, to the left margin "
                "of the file."
            ),
            "global": msg(
                "Write global {name} as the first line of {function}: {name} is a variable of the file then, "
                "and {called} can read it."
            ),
            "pass": msg(
                "Add {name} to the parameters of {called} (line {head}), and pass {name} in the () "
                "behind {called} in line {others}."
            ),
        },
        raised={NAME_ERROR: _local},
        fixed_by=(_kept, _global),
        examples=(
            example(
                "global_for_a_variable_of_init",
                Replace(NODE, "self.counter_ = 0", "counter_ = 0"),
                Replace(
                    NODE,
                    "        self.get_logger().info('Hello time: ' + str(self.counter_))\n"
                    "        self.counter_ += 1\n",
                    "        global counter_\n"
                    "        self.get_logger().info('Hello time: ' + str(counter_))\n"
                    "        counter_ += 1\n",
                ),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "node_of_main_in_callback_of_the_file",
                Replace(
                    NODE,
                    "def main(args=None):",
                    "def beat():\n    node.timer_callback()\n\n\ndef main(args=None):",
                ),
                Replace(NODE, "        self.create_timer(1.0, self.timer_callback)\n", ""),
                Replace(
                    NODE,
                    "node = MyFirstNode()\n",
                    "node = MyFirstNode()\n    node.create_timer(1.0, beat)\n",
                ),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "init_above_main",
                Replace(NODE, "    rclpy.init(args=args)\n", ""),
                Replace(
                    NODE, "def main(args=None)", "rclpy.init(args=args)\n\n\ndef main(args=None)"
                ),
                fails="run.starts",
            ),
            example(
                "text_of_init_in_callback",
                Replace(
                    NODE, "self.counter_ = 0", "self.counter_ = 0\n        prefix = 'Hello time: '"
                ),
                Replace(NODE, "'Hello time: ' + str", "prefix + str"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "node_of_main_in_function",
                Replace(
                    NODE,
                    "def main(args=None):",
                    "def run():\n    rclpy.spin(node)\n\n\ndef main(args=None):",
                ),
                Replace(NODE, "        rclpy.spin(node)\n    except", "        run()\n    except"),
                fails="run.starts",
            ),
        ),
    ),
)
