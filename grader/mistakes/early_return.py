"""Mistakes with a return: it ends a function before its other lines have run."""

from __future__ import annotations

import ast
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import LOG, LOG_LINE, NODE, SILENT, STEP_LINE, example
from grader.mistakes.fixes import lines, node_order
from grader.mistakes.fixes.case import Case
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect, first_of
from grader.package.edit.files import Files
from grader.package.edit.tree import Replace
from grader.package.source.counter import adds_to, logged_counter, parts_of_callback, targets_of
from grader.package.source.imported import full_name
from grader.package.source.module import Function
from grader.package.source.names import called_name, calls_in, dotted, last_part
from grader.package.source.node import NodeSource
from grader.package.source.place import block_of
from grader.package.source.truth import OK, Truth, always_set_to, truth_of
from grader.package.source.unreached import exits


def _functions(source: NodeSource) -> list[Function]:
    """Return the functions that run in every run of the node: callback, constructor, main."""
    found = (source.callback, source.methods.get("__init__"), source.main)
    return [function for function in found if function is not None]


def _returns(suspect: Suspect) -> RecognisedMistake | None:
    for function in _functions(suspect.source):
        for found in node_order.early_returns(function):
            return _return(suspect, found)
    return None


def _return(suspect: Suspect, found: ast.Return) -> RecognisedMistake:
    """A return that always runs: only its word is deleted, if it returns what a call does."""
    mistake = suspect.finding("return_early", found)
    above = node_order.block_above(suspect.source.module_of(found), found)
    if above is not None:
        words = {**mistake.words, "line": str(above.lineno)}
        return replace(mistake, variant="block", words=words)
    return replace(mistake, variant="word" if node_order.does_something(found) else "")


def _returns_before_log(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a return before the log line too, which may depend on a condition."""
    always, callback = _returns(suspect), suspect.source.callback
    logs = suspect.source.logs(callback) if callback is not None else []
    if always is not None or callback is None or not logs:
        return always
    source = suspect.source
    own = [n for n in ast.walk(callback) if isinstance(n, ast.Return)]
    before = [n for n in own if n.lineno < logs[0].lineno]
    before = [n for n in before if source.function_around(n) is callback]
    conditions = [(n, _condition_of(source, n)) for n in before]
    known = [(n, test, truth_of(source, test) if test else None) for n, test in conditions]
    reached = [each for each in known if each[2] is None or each[2].value]
    for found, test, truth in reached:
        if test is not None and truth is not None:
            return _return_if_true(suspect, found, test, truth)
    return _return_if(suspect, *reached[0][:2]) if reached else None


def _limits(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a return before the log line that depends on the counter: the lines end with it."""
    source, callback = suspect.source, suspect.source.callback
    logs = source.logs(callback) if callback is not None else []
    for found in ast.walk(callback) if callback is not None and logs else ():
        if not isinstance(found, ast.Return) or found.lineno > logs[0].lineno:
            continue
        test = _condition_of(source, found)
        if test is None or source.function_around(found) is not callback:
            continue
        mistake = _return_if(suspect, found, test) if _is_limit(source, test) else None
        if mistake is not None and mistake.variant == "alone":
            return replace(mistake, variant="limit")
    return None


def _is_limit(source: NodeSource, test: ast.expr) -> bool:
    """Whether a condition compares the counter that is logged, and asks nothing else."""
    logged = logged_counter(source)
    names = [n for n in ast.walk(test) if isinstance(n, ast.Name | ast.Attribute) and dotted(n)]
    outer = {dotted(n) for n in names} - {"self"}
    if not isinstance(test, ast.Compare) or logged is None:
        return False
    if any(isinstance(n, ast.Call) for n in ast.walk(test)):
        return False
    return outer == {logged[1]} and _comes_true(test, logged[1])


def _comes_true(test: ast.Compare, name: str) -> bool:
    """Whether a comparison can become true when the counter grows: not `< 0` nor `is None`."""
    if len(test.ops) > 1:
        return True
    left = dotted(test.left) == name
    kinds = (ast.Gt, ast.GtE, ast.Eq, ast.In) if left else (ast.Lt, ast.LtE, ast.Eq)
    known = left or any(dotted(other) == name for other in test.comparators)
    return not known or isinstance(test.ops[0], kinds)


def _condition_of(source: NodeSource, found: ast.Return) -> ast.expr | None:
    """Return the condition of the `if` in whose first block a return is."""
    around = source.module_of(found).parents.get(found)
    return around.test if isinstance(around, ast.If) and found in around.body else None


def _return_if(
    suspect: Suspect, found: ast.Return, test: ast.expr | None
) -> RecognisedMistake | None:
    """A return under a condition of which the source does not show what it is."""
    module = suspect.source.module_of(found)
    around = module.parents.get(found)
    if len(block_of(module, found)) > 1:
        return replace(suspect.finding("return_early", found), variant="if")
    if test is None or not isinstance(around, ast.If):
        return replace(suspect.finding("return_early", found), variant="pass")
    name = ast.unparse(test)[:60]
    if around.orelse:
        mistake = suspect.finding("return_early", found, name=name, line=around.lineno)
        return replace(mistake, variant="choice")
    mistake = suspect.finding("return_early", found, name=name, lines=_rows(around))
    return replace(mistake, variant="alone")


def _return_if_true(
    suspect: Suspect, found: ast.Return, test: ast.expr, truth: Truth
) -> RecognisedMistake | None:
    """A return whose condition is always true: the contrary is meant, or nothing."""
    module = suspect.source.module_of(found)
    around = module.parents.get(found)
    written = _contrary(suspect.source, test, truth)
    part = module.text.code(truth.part)
    if written:
        old = module.text.code(test)
        mistake = suspect.finding("return_early", test, name=old, written=written)
        return replace(mistake, variant=truth.reason)
    if not isinstance(around, ast.If) or around.orelse or len(around.body) > 1:
        return _return_if(suspect, found, test)
    mistake = suspect.finding("return_early", found, name=part, lines=_rows(around))
    return replace(mistake, variant=f"{truth.reason}_gone")


def _contrary(source: NodeSource, test: ast.expr, truth: Truth) -> str:
    """Return the condition that is meant, if it is the whole one and false as long as ROS runs."""
    if test is not truth.part:
        return ""
    code = source.module_of(test).text.code
    if truth.reason == "bits" and isinstance(test, ast.UnaryOp):
        meant = truth_of(source, test.operand)
        true = (meant is not None and meant.value) or always_set_to(source, test.operand, True)
        return f"not {code(test.operand)}" if true else ""
    if truth.reason == "ok":
        return f"not {code(test)}"
    is_ok = full_name(source.module_of(test), test) == OK
    return f"not {code(test)}()" if truth.reason == "function" and is_ok else ""


def _rows(around: ast.If) -> str:
    """Return the lines of an if."""
    last = around.end_lineno or around.lineno
    return str(last) if last == around.lineno else f"{around.lineno}-{last}"


def _condition_changed(case: Case) -> Files | None:
    """Write the contrary of the condition, or delete the if and its return if that is certain."""
    if "written" in case.finding.params:
        return lines.written(case)
    if "part" in case.finding.params:
        return lines.deleted(case)
    node, module = case.node, case.module
    found = [
        n
        for n in (module.nodes if module is not None else ())
        if isinstance(n, ast.Return) and n.lineno == case.finding.line
    ]
    test = _condition_of(node, found[0]) if node is not None and len(found) == 1 else None
    truth = truth_of(node, test) if node is not None and test is not None else None
    limit = node is not None and test is not None and _is_limit(node, test)
    return lines.deleted(case) if limit or (truth is not None and truth.value) else None


def _step_after_return(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a step below the return of a method that the callback calls."""
    source = suspect.source
    helper = _step_in_helper(suspect)
    if helper is not None:
        return helper
    found, log = node_order.after_return(source), logged_counter(source)
    around = source.function_around(log[0]) if log is not None else None
    if found is None or log is None or around is None:
        return None
    method, returned, step = found
    if log[1] not in targets_of(step):
        return None
    params: dict[str, str | int] = {
        "line": returned.lineno,
        "method": around.name,
        "below": log[0].lineno,
    }
    mistake = suspect.finding("step_after_return", step, **params)
    return replace(mistake, variant="above" if around is method else "")


def _returns_after_log(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a return directly below the log line that came, above the only line that counts."""
    source, callback = suspect.source, suspect.source.callback
    row = suspect.place.line if suspect.place is not None else None
    steps = [n for n in ast.walk(callback) if isinstance(n, ast.AugAssign)] if callback else []
    for found in (n for n in ast.walk(callback) if isinstance(n, ast.Return)) if callback else ():
        module = source.module_of(found)
        block = block_of(module, found)
        above = block[block.index(found) - 1] if found in block[1:] else None
        test = _condition_of(source, found)
        if above is None or above.lineno != row or test is None or len(steps) != 1:
            continue
        if found.value is None and steps[0].lineno > found.lineno:
            step = module.text.code(steps[0])
            mistake = suspect.finding("return_early", found, line=steps[0].lineno, written=step)
            return replace(mistake, variant="counts")
    return None


def _step_in_helper(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a method that returns a number, and that adds to it only below the return."""
    source = suspect.source
    called = {called_name(c) for part in parts_of_callback(source) for c, _ in calls_in(part)}
    for function in source.all_nodes:
        if not isinstance(function, Function) or function.name not in called:
            continue
        for one in node_order.early_returns(function):
            below = function.body[function.body.index(one) + 1 :]
            name = dotted(one.value) if one.value is not None else ""
            if len(below) == 1 and name and adds_to(below[0], name):
                code = source.module_of(one).text.code
                params: dict[str, str | int] = {"line": one.lineno, "method": function.name}
                mistake = suspect.finding("step_after_return", below[0], **params)
                words = {**mistake.words, "name": name, "step": code(below[0])}
                return replace(mistake, words=words, variant="value")
    return None


def _returns_before_spin(suspect: Suspect) -> RecognisedMistake | None:
    main = suspect.source.main
    for found in node_order.early_returns(main) if main is not None else []:
        for call, name in calls_in(main) if main is not None else ():
            if last_part(name) in node_order.SPINS and call.lineno > found.lineno:
                return _return(suspect, found)
    return _ends_if_called_so(suspect)


def _asks_before_init(source: NodeSource) -> ast.If | None:
    """Return an if that ends the entry function unless ROS runs, above the call of init."""
    main = source.main
    inits = [c.lineno for c in source.calls_of("init", within=main)] if main is not None else []
    for block in main.body if main is not None else ():
        if not isinstance(block, ast.If) or block.orelse or not inits or block.lineno > min(inits):
            continue
        test = block.test
        asks = isinstance(test, ast.UnaryOp) and isinstance(test.op, ast.Not)
        call = test.operand if isinstance(test, ast.UnaryOp) and asks else None
        if isinstance(call, ast.Call) and last_part(dotted(call.func)) == "ok":
            last = block.body[-1]
            return block if isinstance(last, ast.Return) or exits(last) else None
    return None


def _ends_if_called_so(suspect: Suspect) -> RecognisedMistake | None:
    """Look for an if that ends the entry function, and is always true for ros2 run."""
    source, main = suspect.source, suspect.source.main
    spins = source.calls_of(*node_order.SPINS, within=main) if main is not None else []
    first = min((call.lineno for call in spins), default=0)
    early = _asks_before_init(source)
    if early is not None:
        found = suspect.finding("return_early", early, lines=_rows(early))
        return replace(found, variant="before_init")
    for block in ast.walk(main) if main is not None else ():
        if not isinstance(block, ast.If) or (block.end_lineno or 0) >= first or block.orelse:
            continue
        last = block.body[-1]
        word = "return" if isinstance(last, ast.Return) else exits(last)
        truth = truth_of(source, block.test) if word else None
        if truth is None or not truth.value or source.function_around(block) is not main:
            continue
        if truth.reason in ("argument", "guard"):
            name = ast.unparse(block.test)[:60]
            params: dict[str, str | int] = {
                "name": name,
                "part": word,
                "lines": _rows(block),
                "line": first,
            }
            mistake = suspect.finding("return_early", block, **params)
            return replace(mistake, variant=f"called_{truth.reason}")
    return None


CONTRARY = msg("Write {written} instead of {name}.")
WHOLE_IF = msg("Delete line {lines}, the if with all its lines.")
GONE = msg("Delete line {lines}, the if and its return.")
IF_TRUE = msg(
    "return ends the function: while the condition {name} is true, the lines below it do not run."
)
BITS = msg(
    "~ changes the bits of a number, and is no word for not: ~True is -2, and ~False is -1. Both "
    "count as true, so that this return always ends the function."
)
RUNS = msg(
    "rclpy.ok() is true as long as the node runs, so that this return always ends the function: "
    "the lines below it never run."
)
NOT_CALLED = msg(
    "{name} without () is the function itself. It always counts as true, and as something other "
    "than None, so that this return always ends the function."
)
_node = Family("node", links.PYTHON_ERRORS)
KINDS = (
    _node(
        "step_after_return",
        "counter",
        msg("The line that counts is below a return, so it never runs"),
        msg("return ends the function: line {line} comes first, and this line does not run."),
        msg("Move this line to {method}, below line {below}, which logs."),
        fixes={
            "above": msg("Move this line above line {line}, indented as far as that line."),
            "value": msg(
                "Keep the number before it changes. Write three lines instead of line {line} and this "
                "line: value = {name}, then {step}, then return value."
            ),
        },
        behind={"run.constant_counter": _step_after_return},
        deletes=("", "above"),
        fixed_by=(node_order.before_return,),
        examples=(
            example(
                "helper_counts_after_return",
                Replace(
                    NODE,
                    "class MyFirstNode",
                    "class NextNumber:\n\n    def __init__(self):\n        self.n = 0\n\n"
                    "    def take(self):\n        return self.n\n        self.n += 1\n\n\n"
                    "class MyFirstNode",
                ),
                Replace(NODE, "self.counter_ = 0", "self.counter_ = NextNumber()"),
                Replace(NODE, "str(self.counter_)", "str(self.counter_.take())"),
                Replace(NODE, STEP_LINE, ""),
                fails="run.output",
            ),
            example(
                "counts_after_return",
                Replace(NODE, STEP_LINE, ""),
                Replace(
                    NODE, "info('Hello time: ' + str(self.counter_))", "info(self.make_text())"
                ),
                Replace(
                    NODE,
                    "\n\ndef main(",
                    "\n    def make_text(self):\n"
                    "        return 'Hello time: ' + str(self.counter_)\n"
                    f"{STEP_LINE}\n\ndef main(",
                ),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "return_early",
        "callback",
        msg("A return comes too early"),
        msg("return ends the function: the lines below it do not run any more."),
        msg("Delete this return: a function without it returns at its end."),
        whys={
            "counts": msg(
                "return ends the function: line {line}, which counts, does not run if this return comes "
                "first."
            ),
            "before_init": msg(
                "rclpy.ok() tells whether rclpy.init() has run in this program, and above that call it is "
                "always false. So the program ends here."
            ),
            "choice": IF_TRUE,
            "alone": IF_TRUE,
            "limit": IF_TRUE,
            "called_argument": msg(
                "ros2 run calls {function} without arguments, so that {name} is true: {part} ends it "
                "here, and line {line}, which spins the node, is not reached."
            ),
            "called_guard": msg(
                "ros2 run imports the file and calls {function}, so that {name} is true: {part} ends "
                "it here, and line {line}, which spins the node, is not reached."
            ),
            "bits": BITS,
            "bits_gone": BITS,
            "ok": RUNS,
            "ok_gone": RUNS,
            "function": NOT_CALLED,
            "function_gone": NOT_CALLED,
            "constant_gone": msg(
                "{name} always counts as true, so that this return always ends the function: the "
                "lines below it never run."
            ),
        },
        fixes={
            "counts": msg("Write {written} above this return, in a line of its own."),
            "before_init": msg("Delete line {lines}."),
            "word": msg("Delete only the word return in this line: what follows it stays."),
            "block": msg(
                "If this return belongs to the if in line {line}, indent it by 4 more spaces, like the "
                "line above it. If not, delete it: a function without it returns at its end."
            ),
            "if": msg("Remove that return, or move it below the lines that must run."),
            "pass": msg("Write pass instead of return in this line."),
            "choice": msg(
                "Correct the condition {name} in line {line}: it has to be false when the line is "
                "to be logged."
            ),
            "alone": msg(
                "Delete line {lines}, the if and its return. If the node needs it, write a "
                "condition that is false when the line is to be logged."
            ),
            "limit": GONE,
            "called_argument": WHOLE_IF,
            "called_guard": WHOLE_IF,
            "bits": CONTRARY,
            "ok": CONTRARY,
            "function": CONTRARY,
            "bits_gone": GONE,
            "function_gone": GONE,
            "constant_gone": GONE,
            "ok_gone": GONE,
        },
        behind={
            "run.no_lines": _returns_before_log,
            "run.stops": _limits,
            "run.constant_counter": first_of(_returns, _returns_after_log),
            "run.exits_at_once": _returns_before_spin,
            "run.no_node": _returns_before_spin,
        },
        fixed_by=(_condition_changed, node_order.returned),
        examples=(
            example(
                "returns_before_it_counts",
                Replace(
                    NODE,
                    LOG_LINE,
                    "        if self.counter_ == 0:\n            self.get_logger().info('Hello time: 0')\n"
                    f"            return\n{LOG_LINE}",
                ),
                fails="run.output",
            ),
            example(
                "returns_before_log",
                Replace(NODE, LOG_LINE, f"        return\n{LOG_LINE}"),
                fails="run.output",
                blocks=SILENT,
            ),
            example(
                "returns_the_log",
                Replace(NODE, LOG, f"return {LOG}"),
                fails="run.output",
            ),
            example(
                "returns_before_step",
                Replace(NODE, STEP_LINE, f"        return\n{STEP_LINE}"),
                fails="run.output",
            ),
            example(
                "returns_before_spin",
                Replace(
                    NODE, "    node = MyFirstNode()\n", "    node = MyFirstNode()\n    return\n"
                ),
                fails="run.starts",
            ),
            example(
                "asks_for_ros_before_init",
                Replace(
                    NODE,
                    "    rclpy.init(args=args)\n",
                    "    if not rclpy.ok():\n        return\n    rclpy.init(args=args)\n",
                ),
                fails="run.starts",
            ),
            example(
                "return_out_of_its_if",
                Replace(
                    NODE,
                    "    rclpy.init(args=args)\n",
                    "    rclpy.init(args=args)\n    if not rclpy.ok():\n        print('no ROS')\n"
                    "    return\n",
                ),
                fails="run.starts",
            ),
            example(
                "returns_without_arguments",
                Replace(
                    NODE,
                    "    rclpy.init(args=args)\n",
                    "    if args is None:\n        print('no arguments')\n        return\n"
                    "    rclpy.init(args=args)\n",
                ),
                fails="run.starts",
            ),
            example(
                "returns_if_zero",
                Replace(
                    NODE,
                    LOG_LINE,
                    f"        if self.counter_ == 0:\n            return\n{LOG_LINE}",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
            example(
                "returns_after_three",
                Replace(
                    NODE,
                    LOG_LINE,
                    f"        if self.counter_ > 3:\n            return\n{LOG_LINE}",
                ),
                fails="run.output",
            ),
            example(
                "returns_if_not_ok_in_bits",
                Replace(NODE, LOG_LINE, f"        if ~rclpy.ok():\n            return\n{LOG_LINE}"),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
)
