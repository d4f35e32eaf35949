"""A node's source: its class, timers, callback, loggers, counters and entry function.

Read from the syntax trees (no file is ever run). The class can be in another module of the
package than the entry function; helper classes beside it do not belong to the node.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator, Sequence
from functools import cached_property

from grader.package.source.module import Function, Module, parse_module
from grader.package.source.names import called_name, calls_in, dotted, last_part, own_name
from grader.package.source.node_class import class_of_node, family_of, module_with_node
from grader.package.source.own_imports import entry_function, own_imports
from grader.package.source.python import PythonFault
from grader.package.source.timer import Timer, timer_of

LOG_METHODS = ("debug", "info", "warn", "warning", "error", "fatal")
NODE_METHODS = (
    *("create_timer", "get_logger", "get_clock", "get_name", "create_publisher", "destroy_node"),
    *("create_subscription", "create_service", "create_client", "declare_parameter"),
    *("get_parameter", "destroy_timer", "create_rate", "get_namespace"),
)
"""Methods of Node that a node needs itself, or that a beginner calls."""
GET_LOGGER = ("get_logger", "get_logger()")
MOST_BYTES = 20_000
"""A larger file is not a first node, and a hostile one would take seconds to analyse."""
MOST_MODULES = 10  # modules that are read in addition to the entry point's
MOST_OF_ALL = 3 * MOST_BYTES  # characters of all modules, after which no other is read
Read = Callable[[str], "bytes | None"]


class NodeSource:
    """The facts of a node: `entry` is the entry point's file, `module` the one with the class.

    Both are the same file in most packages. `beside` are the other files that these import. `main` is
    the entry function, None if it is missing.
    """

    def __init__(self, modules: Sequence[Module], function: str) -> None:
        self.entry = modules[0]
        found = entry_function(function, modules)
        self.main = found[1] if found else None
        made = {last_part(name) for _, name in calls_in(self.main)} if self.main else set()
        self.module = module_with_node(modules)
        self.node_class = class_of_node(self.module, made)
        if found and self.node_class is None:
            self.module = found[0]
        own = (self.module, self.entry, *([found[0]] if found else []))
        self.modules = tuple(dict.fromkeys(own))
        self.beside = tuple(m for m in modules if m not in self.modules)

    @property
    def paths(self) -> list[str]:
        """The files of the node, by their path in the package."""
        return [module.path for module in self.modules]

    @property
    def known_modules(self) -> tuple[Module, ...]:
        """All files that are read: those of the node, and what they import from the package."""
        return *self.modules, *self.beside

    def module_of(self, node: ast.AST) -> Module:
        """Return the file that a piece of syntax is in."""
        return next((m for m in (*self.modules, *self.beside) if m.has(node)), self.module)

    def module_at(self, path: str) -> Module:
        """Return the file at a path; that of the class if the node does not have it."""
        known = (*self.modules, *self.beside)
        return next((m for m in known if m.path == path), self.module)

    @cached_property
    def family(self) -> list[ast.ClassDef]:
        """The node's class, and the classes of its file that are derived from it or its bases."""
        return family_of(self.node_class, self.module) if self.node_class is not None else []

    @property
    def is_one_class(self) -> bool:
        """Return whether the node's class shares its code with no other class of its file."""
        return not self.family or (
            len(self.family) == 1 and self.node_class in self.module.tree.body
        )

    @property
    def class_body(self) -> list[ast.stmt]:
        """The statements of the node's class."""
        return self.node_class.body if self.node_class is not None else []

    @cached_property
    def class_names(self) -> set[str]:
        """The names by which the files know the node's class."""
        names = {found.name for found in self.family}
        for module in self.modules:
            names |= {i.bound for i in own_imports(module) if i.name in names}
        return names

    def is_node_class(self, named: ast.AST) -> bool:
        """Return whether an expression names the node's class: `MyNode`, `other.MyNode`."""
        return last_part(dotted(named)) in self.class_names

    @property
    def all_nodes(self) -> list[ast.AST]:
        """All parts of the files."""
        return [node for module in self.modules for node in module.nodes]

    @property
    def known_classes(self) -> set[str]:
        """The names of all classes of the files."""
        return {found.name for module in self.modules for found in module.classes}

    @cached_property
    def own_nodes(self) -> list[ast.AST]:
        """All parts of the files, without helper classes."""
        return [node for module in self.modules for node in _without(module, self._helpers)]

    @cached_property
    def _helpers(self) -> set[ast.ClassDef]:
        return {c for m in self.modules for c in m.tree.body if isinstance(c, ast.ClassDef)} - set(
            self.family
        )

    @cached_property
    def methods(self) -> dict[str, Function]:
        """The node's own methods."""
        return {node.name: node for node in self.class_body if isinstance(node, Function)}

    def method(self, name: str) -> ast.FunctionDef | None:
        """Return a method of the class; None if there is none, or more than one."""
        found = [method for method in self.own_methods if method.name == name]
        return found[0] if len(found) == 1 else None

    @property
    def own_methods(self) -> list[ast.FunctionDef]:
        """The methods of the class, each definition of a name."""
        return [s for s in self.class_body if isinstance(s, ast.FunctionDef)]

    @cached_property
    def calls(self) -> list[tuple[ast.Call, str]]:
        """All calls of the files, those of helper classes too."""
        return [call for module in self.modules for call in calls_in(module.tree)]

    def calls_of(self, *names: str, within: ast.AST | None = None) -> list[ast.Call]:
        """Return the node's calls of functions or methods of these names, in order."""
        nodes = self.own_nodes if within is None else ast.walk(within)
        found = [n for n in nodes if isinstance(n, ast.Call) and called_name(n) in names]
        order = {module: at for at, module in enumerate(self.modules)}
        return sorted(found, key=lambda n: (order[self.module_of(n)], n.lineno, n.col_offset))

    def function_around(self, node: ast.AST) -> Function | None:
        """Return the innermost function that contains a part of the source."""
        around = self.module_of(node).around(node)
        return next((found for found in around if isinstance(found, Function)), None)

    @cached_property
    def timers(self) -> list[Timer]:
        """The calls of create_timer; those of helper classes only if the node has none."""
        made = [call for call, name in self.calls if last_part(name) == "create_timer"]
        own = set(self.own_nodes)
        return [
            timer_of(call, self.function_around(call))
            for call in [c for c in made if c in own] or made
        ]

    @property
    def timer_call(self) -> ast.Call | None:
        """The node's only call of create_timer."""
        found = self.calls_of("create_timer")
        return found[0] if len(found) == 1 else None

    @cached_property
    def callback(self) -> Function | None:
        """The function that the first timer calls, else the method that logs.

        Of several timers, the first one whose callback logs or prints comes first.
        """
        first = [t for t in self.timers if self._tells(self.methods.get(t.method), [])]
        for timer in [*first, *self.timers]:
            if timer.method in self.methods:
                return self.methods[timer.method]
            if timer.is_variable:
                named = [
                    n for n in self.own_nodes if isinstance(n, Function) and n.name == timer.method
                ]
                if len(named) == 1:
                    return named[0]
        logging = [m for n, m in self.methods.items() if n != "__init__" and self.logs(m)]
        return logging[0] if logging else None

    def _tells(self, method: Function | None, seen: list[Function]) -> bool:
        """Whether a method logs or prints, also in the methods that it calls."""
        if method is None or method in seen:
            return False
        inner = [self.methods.get(own_name(call.func)) for call, _ in calls_in(method)]
        tells = bool(self.logs(method) or self.prints(method))
        return tells or any(self._tells(each, [*seen, method]) for each in inner)

    @cached_property
    def loggers(self) -> dict[str, ast.Assign | ast.AnnAssign]:
        """The variables and attributes that hold a logger, with the statements that set them."""
        found: dict[str, ast.Assign | ast.AnnAssign] = {}
        for node in self.own_nodes:
            if isinstance(node, ast.Assign | ast.AnnAssign) and node.value is not None:
                targets = node.targets if isinstance(node, ast.Assign) else [node.target]
                if last_part(dotted(node.value)) in GET_LOGGER:
                    found |= {dotted(target): node for target in targets if dotted(target)}
        return found

    def loggers_at(self, node: ast.AST) -> list[str]:
        """Return the loggers that are known by a name at a place in a method."""
        function = self.function_around(node)
        attributes = [name for name in self.loggers if name.startswith("self.")]
        local = [
            name
            for name, statement in self.loggers.items()
            if "." not in name and self.function_around(statement) in (function, None)
        ]
        return [*local, *attributes]

    def is_log(self, call: ast.Call) -> bool:
        """Return whether a call logs a line, with the node's logger or one of that name."""
        before, _, method = dotted(call.func).rpartition(".")
        return method in LOG_METHODS and (
            before in self.loggers or "log" in before.lower() or before.endswith("get_logger()")
        )

    def is_own_log(self, call: ast.Call) -> bool:
        """Return whether a call logs a line with a logger of get_logger."""
        function = call.func
        if not isinstance(function, ast.Attribute) or function.attr not in LOG_METHODS:
            return False
        return dotted(function.value) in self.loggers or "get_logger" in ast.unparse(function)

    def logs(self, part: ast.AST) -> list[ast.Call]:
        """Return the calls of a logger in a part of the source."""
        return [call for call, _ in calls_in(part) if self.is_log(call)]

    @cached_property
    def own_logs(self) -> list[ast.Call]:
        """The node's calls of a logger of get_logger."""
        return [call for call in self.calls_of(*LOG_METHODS) if self.is_own_log(call)]

    @property
    def log_call(self) -> ast.Call | None:
        """The only call of the node's logger, or of several the callback's only one.

        It must have exactly one argument.
        """
        found = self.own_logs
        if len(found) != 1 and self.callback is not None:
            found = [call for call in self.logs(self.callback) if self.is_own_log(call)]
        return found[0] if len(found) == 1 and len(found[0].args) == 1 else None

    def prints(self, part: ast.AST) -> list[ast.Call]:
        """Return the calls of print in a part of the source."""
        return [call for call, name in calls_in(part) if name == "print"]

    @cached_property
    def super_init(self) -> ast.Call | None:
        """The call of the base class's __init__ in the node's __init__."""
        init = self.methods.get("__init__")
        for call, name in calls_in(init) if init else ():
            if name == "super().__init__" or (name.endswith("Node.__init__")):
                return call
        return None

    @cached_property
    def name_given(self) -> ast.Call | None:
        """The call that gives the node its name: that of a base class, if this gives it itself.

        A base class that passes its own first parameter on gets the name from the node's class.
        """
        call, node = self.super_init, self.node_class
        bases = {last_part(dotted(base)) for base in (node.bases if node is not None else ())}
        own = [c for c in self.family if c.name in bases and c is not node]
        if call is None or call.args or call.keywords or len(own) != 1:
            return call
        inits = [s for s in own[0].body if isinstance(s, Function) and s.name == "__init__"]
        calls = [c for init in inits for c, name in calls_in(init) if name == "super().__init__"]
        if len(calls) != 1 or not calls[0].args:
            return call
        first = [a.arg for a in inits[0].args.args][1:2] if len(inits) == 1 else []
        return call if dotted(calls[0].args[0]) in first else calls[0]

    @property
    def created_node(self) -> ast.Call | None:
        """The only call that creates a node without a class of its own."""
        found = [call for call, _ in self.calls if _creates_node(call)]
        return found[0] if len(found) == 1 else None

    @property
    def uses_ros(self) -> bool:
        """Whether one of the files imports rclpy."""
        return any(module.uses_ros for module in self.modules)

    @cached_property
    def attributes(self) -> set[str]:
        """The names that are set on self."""
        return {
            node.attr
            for node in self.own_nodes
            if isinstance(node, ast.Attribute)
            and isinstance(node.ctx, ast.Store)
            and dotted(node.value) == "self"
        }

    def makes_node(self) -> bool:
        """Return whether the node's class is called anywhere in the files."""
        return any(self.is_node_class(call.func) for call, _ in self.calls)

    @cached_property
    def held_node(self) -> str:
        """The attribute in which a class that inherits from nothing has its node; "" if none."""
        plain = self.node_class is not None and not self.node_class.bases
        passed = self._passed_nodes if plain else set()
        for node in self.own_nodes if plain else ():
            if not isinstance(node, ast.Assign):
                continue
            target = dotted(node.targets[0])
            created = _creates_node(node.value) or dotted(node.value) in passed
            if created and target.startswith("self."):
                return target
        return ""

    @property
    def _passed_nodes(self) -> set[str]:
        """The parameters of __init__ for which a call of the class gives a created node."""
        init = self.methods.get("__init__")
        parameters = [a.arg for a in init.args.args[1:]] if init is not None else []
        assigned = [
            n for n in self.all_nodes if isinstance(n, ast.Assign) and _creates_node(n.value)
        ]
        created = {dotted(target) for n in assigned for target in n.targets}
        calls = [call for call, _ in self.calls if self.is_node_class(call.func)]
        pairs = [pair for call in calls for pair in zip(parameters, call.args)]
        return {name for name, given in pairs if dotted(given) in created or _creates_node(given)}

    @cached_property
    def node_variables(self) -> set[str]:
        """The variables that get a new node: one of the class, or of create_node if there is none."""
        found: set[str] = set()
        created: set[str] = set()
        for node in self.all_nodes:
            value = node.value if isinstance(node, ast.Assign) else None
            if isinstance(node, ast.Assign) and isinstance(value, ast.Call):
                names = {dotted(target) for target in node.targets} - {""}
                if self.is_node_class(value.func):
                    found |= names
                elif _creates_node(value):
                    created |= names
        return created if self.held_node else found or created


def _creates_node(value: ast.expr) -> bool:
    """Whether an expression creates a node that has no class of its own."""
    return isinstance(value, ast.Call) and last_part(dotted(value.func)) in ("create_node", "Node")


def _without(module: Module, left_out: set[ast.ClassDef]) -> Iterator[ast.AST]:
    """Yield the parts of a file in the order of ast.walk, without these classes."""
    waiting: list[ast.AST] = [module.tree]
    for node in waiting:
        yield node
        waiting += [n for n in ast.iter_child_nodes(node) if n not in left_out]


def read_node(read: Read, path: str, function: str) -> NodeSource | None:
    """Return the facts of the node whose entry point names the file at `path`.

    `read` returns the bytes of a file of the package, None if there is none. The modules that the
    file imports from its own package are read too. None if Python cannot read the file, or if it
    is too large.
    """
    entry = read_module(read, path)
    if entry is None:
        return None
    try:
        return NodeSource(_with_imports(entry, read), function)
    except RecursionError:
        return None


def _with_imports(entry: Module, read: Read) -> list[Module]:
    """Return a module and those that it imports from its own package, directly or not."""
    modules = [entry]
    tried = {entry.path}
    for module in modules:
        for path in (path for found in own_imports(module) for path in found.paths):
            size = sum(len(each.text.text) for each in modules)
            if path not in tried and len(modules) <= MOST_MODULES and size < MOST_OF_ALL:
                tried.add(path)
                other = read_module(read, path)
                modules += [other] if other is not None else []
    return modules


def read_module(read: Read, path: str) -> Module | None:
    """Return a file of the package; None if there is none, or if Python cannot read it."""
    found = read(path)
    if found is None or len(found) > MOST_BYTES:
        return None
    try:
        return parse_module(path, found)
    except (PythonFault, RecursionError, MemoryError):
        return None
