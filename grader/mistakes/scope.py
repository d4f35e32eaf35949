"""Mistakes of scope: lines in the wrong block, and names without self. or without quotes."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import DEAD, NODE, example
from grader.mistakes.fixes import lines, node_count, node_scope
from grader.mistakes.kind import Family
from grader.mistakes.recognised import NAME_ERROR, OWN_ATTRIBUTE, Raised, RecognisedMistake, of_self
from grader.package.edit.tree import Replace
from grader.package.source.counter import targets_of
from grader.package.source.module import Function
from grader.package.source.names import called_name, own_name
from grader.package.source.place import function_at, method_above, statement_at
from grader.package.source.scopes import has_self, visible_names

NODE_METHODS = (
    *("create_timer", "get_logger", "get_clock", "get_name", "create_publisher", "destroy_node"),
    *("create_subscription", "create_service", "create_client", "declare_parameter"),
    *("get_parameter", "destroy_timer", "create_rate", "get_namespace"),
)
OF_PARAMETERS = ("name", "node_name", "NAME", "NODE_NAME")
"""What programs call the value that is the node's name."""
CALLBACK = '''\
    def timer_callback(self):
        """Say hello once; the timer calls this for as long as the node spins."""
        self.get_logger().info('Hello time: ' + str(self.counter_))
        self.counter_ += 1
'''
OUTSIDE = CALLBACK.replace("\n    ", "\n").removeprefix("    ")
MAIN = '''\
def main(args=None):
    """Run the node until Ctrl+C."""
    rclpy.init(args=args)
    node = MyFirstNode()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()
'''
IN_CLASS = "".join(f"    {line}" for line in MAIN.splitlines(keepends=True))


def _quotes(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    name = match["name"]
    places = node_scope.names_as_text(raised.module, name)
    of_class = {target for c in raised.module.classes for s in c.body for target in targets_of(s)}
    if name in of_class:
        return None
    if not places and name == raised.assignment.node_name and name not in raised.module.names:
        found = raised.finding("quotes_missing", name=name, written=repr(name))
        return replace(found, variant="written")
    if not places:
        return None
    if name in OF_PARAMETERS:
        return None  # (a parameter is missing, and not the quotes)
    found = raised.finding("quotes_missing", at=places[0], name=name)
    return replace(found, variant="guard") if name == "__main__" else found


def _imported_inside(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The name is imported inside of another function, and exists only there."""
    name, module = match["name"], raised.module
    here = function_at(module, raised.line)
    for node in module.nodes:
        if not isinstance(node, ast.Import | ast.ImportFrom) or name not in _bound_by(node):
            continue
        inside = function_at(module, node.lineno)
        if inside is None or inside is here:
            return None
        return raised.finding(
            "import_inside", at=node, name=name, written=ast.unparse(node), function=inside.name
        )
    return None


def _bound_by(node: ast.Import | ast.ImportFrom) -> set[str]:
    return {(alias.asname or alias.name).partition(".")[0] for alias in node.names}


def creates_timer(raised: Raised) -> bool:
    """Return whether the statement that raised an exception creates a timer."""
    statement = statement_at(raised.module, raised.line)
    calls = [n for n in ast.walk(statement) if isinstance(n, ast.Call)] if statement else []
    return any(called_name(call) == "create_timer" for call in calls)


def _self_outside(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    if match["name"] != "self" or raised.line is None:
        return None
    function = function_at(raised.module, raised.line)
    if function is not None and _is_method(raised, function):
        return None
    if function is not None:
        return _self_in_function(raised)
    method = method_above(raised.module, raised.line)
    if creates_timer(raised):
        return None
    found = raised.finding("self_outside", name=method.name if method is not None else "")
    return replace(found, variant="method") if method is not None else found


def _self_misspelt(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The first parameter of the method that uses self has another name."""
    function = function_at(raised.module, raised.line)
    if match["name"] != "self" or function is None or not _is_method(raised, function):
        return None
    first = (*function.args.posonlyargs, *function.args.args)[:1]
    if not first:
        return None
    return raised.finding(
        "self_misspelt", at=function, name=first[0].arg, written="self", method=function.name
    )


def _self_in_function(raised: Raised) -> RecognisedMistake:
    """Return the mistake of a function that is no method: it knows the node by a variable."""
    variables = raised.source.node_variables
    found = raised.finding("self_outside", name=min(variables, default=""))
    known = variables <= visible_names(raised.module, raised.line, "self")
    return replace(found, variant="variable") if len(variables) == 1 and known else found


def _main_in_class(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    function = raised.assignment.function
    found = node_scope.inner_function(raised.source, function)
    if match["function"] != function or found is None:
        return None
    return raised.finding("main_in_class", at=found)


def _callback_outside(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    name = match["name"]
    at = raised.source.module.functions.get(name)
    if at is None or not of_self(raised, match):
        return None
    if at.args.args and at.args.args[0].arg != "self" and _is_called(raised, name):
        return None  # (a function for which self is too much)
    found, first = raised.finding("callback_outside", at=at, name=name), at.args.args[:1]
    if not first or first[0].arg == "self":
        return found
    words = {**found.words, "parameter": first[0].arg}
    return replace(found, words=words, variant="parameter")


def _is_called(raised: Raised, name: str) -> bool:
    """Whether every use of a function through self is a call with arguments."""
    uses = [n for n in raised.source.own_nodes if own_name(n) == name]
    around = [raised.module.parents.get(use) for use in uses]
    return all(isinstance(a, ast.Call) and a.func in uses and bool(a.args) for a in around)


def _self_missing(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    name, source = match["name"], raised.source
    if name not in {*NODE_METHODS, *source.methods, *source.attributes}:
        return None
    if any(timer.method == name for timer in source.timers):
        return None  # (the timer's own record shows how create_timer is written)
    function = function_at(raised.module, raised.line)
    if function is not None and _is_method(raised, function):
        own = function in [s for c in source.family for s in c.body] or source.node_class is None
        return raised.finding("self_missing", name=name) if own and has_self(function) else None
    if function is not None and "self" in visible_names(raised.module, raised.line, name):
        around = [f for f in raised.module.around(function) if isinstance(f, Function)]
        if (
            any(f in s.body for f in around for s in source.family)
            and name not in source.attributes
        ):
            return raised.finding("self_missing", name=name)
    variables = sorted(source.node_variables)
    if function is None or len(variables) != 1 or name in source.attributes:
        return None
    if variables[0] not in visible_names(raised.module, raised.line, name):
        return None
    found = raised.finding("self_missing", name=name, variable=variables[0])
    return replace(found, variant="variable")


def _is_method(raised: Raised, function: Function) -> bool:
    return any(function in found.body for found in raised.module.classes)


_node = Family("node", links.PYTHON_CLASSES)
KINDS = (
    _node(
        "import_inside",
        "start",
        msg("The name is imported inside of another function"),
        msg(
            "This line is inside of {function}, so {name} exists only while {function} runs, and only "
            "in it. The class and the other functions do not know it."
        ),
        msg("Move {written} to the top of the file, without indentation."),
        raised={NAME_ERROR: _imported_inside},
        examples=(
            example(
                "imports_in_main",
                Replace(NODE, "import rclpy\nfrom rclpy.node import Node\n", ""),
                Replace(
                    NODE,
                    "    rclpy.init(args=args)\n",
                    "    import rclpy\n    from rclpy.node import Node\n    rclpy.init(args=args)\n",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "quotes_missing",
        "class",
        msg("A string is written without quotes"),
        msg("Without quotes, {name} is the name of a variable, and there is no such variable."),
        msg("Write super().__init__('{node_name}')."),
        links.PYTHON_STRINGS,
        fixes={
            "guard": msg("Write: if __name__ == '__main__':"),
            "written": msg("Write {written} instead of {name}."),
        },
        raised={NAME_ERROR: _quotes},
        fixed_by=(node_scope.quotes, lines.written),
        examples=(
            example(
                "node_name_without_quotes_in_an_argument",
                Replace(NODE, "def __init__(self)", "def __init__(self, name)"),
                Replace(NODE, "__init__('my_first_node')", "__init__(name)"),
                Replace(NODE, "node = MyFirstNode()", "node = MyFirstNode(my_first_node)"),
                fails="run.starts",
            ),
            example(
                "node_name_without_quotes",
                Replace(NODE, "'my_first_node'", "my_first_node"),
                fails="run.starts",
            ),
            example(
                "guard_without_quotes",
                Replace(NODE, "'__main__'", "__main__"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "self_misspelt",
        "class",
        msg("The first parameter of a method has another name than self"),
        msg(
            "The first parameter of a method is the object, whatever its name is. Here it is called "
            "{name}, so nothing is called self in {method}."
        ),
        msg("Write self instead of {name} in the brackets of this def."),
        raised={NAME_ERROR: _self_misspelt},
        fixed_by=(lines.written,),
        examples=(
            example(
                "self_misspelt",
                Replace(NODE, "def timer_callback(self)", "def timer_callback(slef)"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "self_outside",
        "class",
        msg("self is used outside of a method"),
        msg(
            "self is the first parameter of a method and exists only inside it. This line is "
            "outside of every method."
        ),
        msg("Move the line into the method that it belongs to."),
        fixes={
            "method": msg(
                "Indent the line as far as the other lines of {name}, the method above it."
            ),
            "variable": msg("Write {name} instead of self."),
        },
        seen=r"NameError: name 'self' is not defined",
        raised={NAME_ERROR: _self_outside},
        fixed_by=(node_scope.indented, node_scope.variable, lines.written),
        examples=(
            example(
                "step_outside_callback",
                Replace(NODE, "        self.counter_ += 1\n", "    self.counter_ += 1\n"),
                fails="run.starts",
            ),
            example(
                "start_outside_init",
                Replace(NODE, "        self.counter_ = 0\n", ""),
                Replace(
                    NODE,
                    "    def __init__(self):\n",
                    "    self.counter_ = 0\n\n    def __init__(self):\n",
                ),
                fails="run.starts",
            ),
            example(
                "self_in_main",
                Replace(NODE, "rclpy.spin(node)", "rclpy.spin(self)"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "main_in_class",
        "start",
        msg("The entry point's function is inside the class"),
        msg(
            "The entry point ends in :{function}, so Python looks for a function {function} at the "
            "top level of the module. An indented def belongs to what is above it."
        ),
        msg(
            "Move def {function}(…) and all of its lines to the left by the same number of spaces, "
            "so that def begins at the margin."
        ),
        links.DEVELOPING,
        raised={
            r"AttributeError: module '[\w.]{1,200}' has no attribute '(?P<function>\w{1,120})'": (
                _main_in_class
            )
        },
        fixed_by=(node_scope.at_margin,),
        examples=(
            example("main_in_class", Replace(NODE, MAIN, IN_CLASS), fails="run.starts"),
            example(
                "main_as_a_static_method",
                Replace(NODE, MAIN, IN_CLASS.replace("    def ", "    @staticmethod\n    def ", 1)),
                Replace(NODE, "\n    main()\n", "\n    MyFirstNode.main()\n"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "callback_outside",
        "timer",
        msg("The callback is outside of the class"),
        msg("A function at the margin is not a method of the class, so self does not have it."),
        msg(
            "Put def {name}(self): and its lines at the end of the class, indented by 4 more spaces "
            "than now."
        ),
        fixes={
            "parameter": msg(
                "Put def {name} and its lines at the end of the class, indented by 4 more spaces than now. If "
                "{parameter} is the node, write self instead of {parameter} in all of these lines."
            )
        },
        raised={OWN_ATTRIBUTE: _callback_outside},
        fixed_by=(node_scope.into_class,),
        examples=(
            example("callback_outside_class", Replace(NODE, CALLBACK, OUTSIDE), fails="run.starts"),
        ),
    ),
    _node(
        "self_missing",
        "class",
        msg("self. is missing"),
        msg("Methods and attributes of the node are reached through the node: self.name."),
        msg("Write self.{name} instead of {name}."),
        fixes={"variable": msg("Write {variable}.{name} instead of {name}.")},
        raised={NAME_ERROR: _self_missing},
        fixed_by=(node_scope.self_dot, node_count.self_dot),
        examples=(
            example(
                "create_timer_without_self",
                Replace(NODE, "self.create_timer", "create_timer"),
                fails="run.starts",
            ),
            example(
                "get_logger_without_self",
                Replace(NODE, "self.get_logger()", "get_logger()"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "counter_logged_without_self",
                Replace(NODE, "str(self.counter_)", "str(counter_)"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
)
