"""The mistake of a line that spins the node where the program does not come to it."""

from __future__ import annotations

import ast
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, SPIN_UNTIL_CTRL_C, example
from grader.mistakes.fixes import lines
from grader.mistakes.fixes.case import Case
from grader.mistakes.kind import Family
from grader.mistakes.placeholders import placeholder_values
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.files import Files
from grader.package.edit.text import indent_of
from grader.package.edit.tree import Replace
from grader.package.source.module import Function
from grader.package.source.names import called_name, dotted
from grader.package.source.node import NodeSource
from grader.package.source.place import block_of
from grader.package.source.unreached import Unreached, exits, unreached

SPINS = ("spin", "spin_until_future_complete")
LEAVES = ast.Return | ast.Raise | ast.Break | ast.Continue
LONGEST = 60  # characters of a condition in a text


def _not_reached(suspect: Suspect) -> RecognisedMistake | None:
    source = suspect.source
    spins = source.calls_of(*SPINS) or [c for c, _ in source.calls if called_name(c) in SPINS]
    once = [] if spins else source.calls_of("spin_once")
    found = unreached(source, spins or once)
    if found is None or (once and found.obstacle != "exits"):
        return None
    if isinstance(found.at, ast.ExceptHandler):
        return _in_except(suspect, found, found.at)
    if isinstance(found.at, ast.If | ast.While):
        return _under_condition(suspect, found, found.at)
    if isinstance(found.at, Function):
        return _uncalled(suspect, found, found.at)
    line = found.statement.lineno
    mistake = suspect.finding("spin_not_reached", found.at, name=exits(found.at), line=line)
    return replace(mistake, variant="exits")


def _try_of(source: NodeSource, handler: ast.ExceptHandler) -> ast.Try | None:
    """Return the try of an except, if the end of its lines is reached."""
    around = source.module_of(handler).parents.get(handler)
    if not isinstance(around, ast.Try):
        return None
    last = around.body[-1]
    ends = isinstance(last, LEAVES | ast.While) or bool(exits(last))
    return None if ends else around


def _in_except(
    suspect: Suspect, found: Unreached, handler: ast.ExceptHandler
) -> RecognisedMistake | None:
    source, spin = suspect.source, found.statement
    around = _try_of(source, handler)
    if around is None or spin not in handler.body or handler.type is None:
        return None
    last = around.body[-1]
    name = ast.unparse(handler.type)[:LONGEST]
    line = last.end_lineno or last.lineno
    mistake = suspect.finding("spin_not_reached", spin, name=name, line=line)
    return replace(mistake, variant="alone" if len(handler.body) == 1 else "")


def _under_condition(
    suspect: Suspect, found: Unreached, around: ast.If | ast.While
) -> RecognisedMistake | None:
    spin, truth = found.statement, found.truth
    reached = around.orelse if found.obstacle == "condition" else around.body
    if truth is None or any(isinstance(n, LEAVES) for s in reached for n in ast.walk(s)):
        return None
    code = suspect.source.module_of(spin).text.code
    params: dict[str, str | int] = {
        "name": ast.unparse(around.test)[:LONGEST],
        "line": spin.lineno,
        "word": "if" if isinstance(around, ast.If) else "while",
        "part": ast.unparse(truth.part)[:LONGEST],
        "written": code(spin),
        "below": around.end_lineno or around.lineno,
    }
    mistake = suspect.finding("spin_not_reached", around, **params)
    alone = found.obstacle == "condition" and not around.orelse
    if not alone:
        return replace(mistake, variant="else" if found.obstacle == "else" else "chosen")
    known = truth.reason if truth.reason in ("guard", "argument") else "condition"
    return replace(mistake, variant=known)


def _uncalled(suspect: Suspect, found: Unreached, function: Function) -> RecognisedMistake | None:
    source, name = suspect.source, function.name
    given = function.args
    needed = len(given.args) - len(given.defaults)
    if isinstance(function, ast.AsyncFunctionDef) or given.kwonlyargs or given.posonlyargs:
        return None
    node = str(placeholder_values(suspect.assignment, source)["node"])
    around = source.module_of(function).parents.get(function)
    if isinstance(around, ast.ClassDef) and source.methods.get(name) is not function:
        return _uncalled_of_class(suspect, found, function, around)
    is_method = source.methods.get(name) is function
    written = f"{node}.{name}()" if is_method else f"{name}({node if needed else ''})"
    inside = source.function_around(function)
    if needed > 1 or (is_method and needed != 1) or inside not in (None, source.main):
        return None
    line = found.statement.lineno
    mistake = suspect.finding("spin_not_reached", function, name=name, line=line, written=written)
    return replace(mistake, variant="uncalled")


def _uncalled_of_class(
    suspect: Suspect, found: Unreached, function: Function, around: ast.ClassDef
) -> RecognisedMistake | None:
    """The function is a method of a class beside the node: it is called on its object, if it has one."""
    source, given, main = suspect.source, function.args, suspect.source.main
    needed = [a.arg for a in given.args[: len(given.args) - len(given.defaults)]]
    static = [dotted(d) for d in function.decorator_list] in (["staticmethod"], ["classmethod"])
    own = needed[1:] if needed[:1] in (["self"], ["cls"]) else needed
    if own or given.kwonlyargs or isinstance(function, ast.AsyncFunctionDef) or main is None:
        return None
    made = [n for n in ast.walk(main) if isinstance(n, ast.Call) and dotted(n.func) == around.name]
    words = {"name": f"{around.name}.{function.name}", "line": str(found.statement.lineno)}
    statement = source.module_of(main).parents.get(made[0]) if len(made) == 1 else None
    if len(made) == 1 and isinstance(statement, ast.Expr):
        code = source.module_of(main).text.code(made[0])
        written = f"{around.name if static else code}.{function.name}({_passed(given, main)})"
        params = {"name": code, "written": written, "function": words["name"]}
        told = suspect.finding("spin_not_reached", made[0], **params, line=words["line"])
        return replace(told, variant="uncalled_object")
    mistake = suspect.finding("spin_not_reached", function, **words)
    return replace(mistake, variant="uncalled_method")


def _passed(given: ast.arguments, main: Function) -> str:
    """Return the arguments of main that a function takes by the same name."""
    names = {a.arg for a in main.args.args}
    return ", ".join(f"{a.arg}={a.arg}" for a in given.args if a.arg in names - {"self", "cls"})


def _into_try(case: Case) -> Files | None:
    """Move the line that spins from an except to the end of its try."""
    node, module = case.node, case.module
    found = unreached(node, node.calls_of(*SPINS)) if node is not None else None
    if node is None or module is None or found is None or found.obstacle != "except":
        return None
    spin, handler = found.statement, found.at
    around = _try_of(node, handler) if isinstance(handler, ast.ExceptHandler) else None
    rows = lines.own_lines(module, spin)
    if around is None or rows is None or len(rows) > 1 or not module.has(spin):
        return None
    text, last = module.text, around.body[-1]
    row = indent_of(text.line(last.lineno)) + text.code(spin)
    below = text.before((last.end_lineno or last.lineno) + 1, row)
    alone = len(block_of(module, spin)) == 1
    gone = text.swap(spin, "pass") if alone else text.without(spin.lineno)
    return case.changed(module, below, gone)


def _unblocked(case: Case) -> Files | None:
    """Remove the condition around the line that spins, or the call that ends the program."""
    node = case.node
    spins = node.calls_of(*SPINS) or node.calls_of("spin_once") if node is not None else []
    found = unreached(node, spins) if node is not None else None
    if found is None or found.at.lineno != case.finding.line:
        return None
    if found.obstacle == "exits":
        return lines.deleted(case)
    return lines.unwrapped(case) if found.obstacle == "condition" else None


UNCALLED = msg(
    "def only defines {name}, and nothing calls it. So line {line}, which spins the node, is not reached."
)
IN_EXCEPT = msg(
    "The lines of an except run only when a line of its try raises {name}, as Ctrl+C does. This "
    "try comes to its end at once, so that the node is not spun."
)
CONDITION = msg(
    "Line {line}, which spins the node, is below the condition {name}. With ros2 run it is always "
    "false, so that the line is not reached."
)
UNWRAP = msg(
    "Delete the line of this {word}, and indent its lines as far as the {word} is indented now."
)
BELOW = msg(
    "Write {written} below line {below}, indented as far as this {word}: it has to run whatever "
    "the condition is."
)
_node = Family("node", links.EXECUTORS)
KINDS = (
    _node(
        "spin_not_reached",
        "spin",
        msg("The line that spins the node is not reached"),
        IN_EXCEPT,
        msg("Move this line into the try, below line {line}."),
        whys={
            "condition": CONDITION,
            "guard": msg(
                "ros2 run imports the file and calls {function}: there, __name__ is not "
                "'__main__'. Line {line}, which spins the node, is not reached."
            ),
            "argument": msg(
                "ros2 run calls {function} without arguments, so that {part} is None. Line {line}, "
                "which spins the node, is not reached."
            ),
            "chosen": CONDITION,
            "else": msg(
                "Line {line}, which spins the node, is in the else of the condition {name}. With "
                "ros2 run it is always true, so that the line is not reached."
            ),
            "exits": msg(
                "{name} ends the program, so that line {line}, which spins the node, is not reached."
            ),
            "uncalled": msg(
                "def only defines {name}, and nothing calls it. So line {line}, which spins the "
                "node, is not reached."
            ),
            "uncalled_method": UNCALLED,
            "uncalled_object": msg(
                "This line makes an object, and nothing calls {function}. So line {line}, which spins the "
                "node, is not reached."
            ),
        },
        fixes={
            "alone": msg(
                "Move this line into the try, below line {line}, and write pass here in its place."
            ),
            "condition": UNWRAP,
            "guard": UNWRAP,
            "argument": UNWRAP,
            "chosen": BELOW,
            "else": BELOW,
            "exits": msg("Delete this line."),
            "uncalled": msg("Write {written} in {function}, after creating the node."),
            "uncalled_method": msg(
                "Call {name} in the function that starts the program, and let nothing before this call end it."
            ),
            "uncalled_object": msg("Write {written} instead of {name}."),
        },
        behind={"run.exits_at_once": _not_reached, "run.never_spins": _not_reached},
        fixed_by=(_into_try, _unblocked, lines.written),
        examples=(
            example(
                "method_that_spins_is_not_called",
                Replace(
                    NODE,
                    "def main(",
                    "class App:\n    @staticmethod\n    def run(args=None):\n        rclpy.init(args=args)\n"
                    "        node = MyFirstNode()\n        try:\n            rclpy.spin(node)\n"
                    "        except KeyboardInterrupt:\n            pass\n\n\ndef main(",
                ),
                Replace(
                    NODE, "    rclpy.init(args=args)\n    node = MyFirstNode()\n", "    App()\n"
                ),
                Replace(NODE, SPIN_UNTIL_CTRL_C, ""),
                fails="run.starts",
            ),
            example(
                "spin_in_except",
                Replace(
                    NODE,
                    "    node = MyFirstNode()\n    try:\n        rclpy.spin(node)\n"
                    "    except KeyboardInterrupt:\n        pass\n",
                    "    try:\n        node = MyFirstNode()\n"
                    "    except KeyboardInterrupt:\n        rclpy.spin(node)\n",
                ),
                fails="run.starts",
            ),
            example(
                "spin_below_exit",
                Replace(
                    NODE, "    node = MyFirstNode()\n", "    node = MyFirstNode()\n    exit()\n"
                ),
                fails="run.starts",
            ),
            example(
                "spin_under_guard_in_main",
                Replace(
                    NODE,
                    "        rclpy.spin(node)\n",
                    "        if __name__ == '__main__':\n            rclpy.spin(node)\n",
                ),
                fails="run.starts",
            ),
        ),
    ),
)
