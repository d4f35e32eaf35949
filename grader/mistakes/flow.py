"""Mistakes in what a callback does when: loops, conditions, and calls that end the node."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import (
    DEAD,
    LOG_LINE,
    NODE,
    SILENT,
    SPIN_UNTIL_CTRL_C,
    STEP_LINE,
    example,
)
from grader.mistakes.fixes import lines, node_callback, node_loops, node_timer, node_try
from grader.mistakes.fixes.case import Case
from grader.mistakes.kind import Family
from grader.mistakes.recognised import FromSource, Raised, RecognisedMistake, Suspect, first_of
from grader.mistakes.stop_in_branch import FIXES as BRANCH_FIXES
from grader.mistakes.stop_in_branch import branch_of, in_branch, without_stop
from grader.mistakes.worked_out import worked_out
from grader.package.edit.files import Files
from grader.package.edit.tree import Replace
from grader.package.source.counter import adds_to, logged_counter, starts_of, targets_of
from grader.package.source.endless import calls_of_methods, methods_run_by
from grader.package.source.module import Function, Module, is_text
from grader.package.source.names import SPINS, called_name, calls_in, dotted, last_part
from grader.package.source.node import NodeSource
from grader.package.source.period import is_right, seconds_of
from grader.package.source.place import block_of, function_at, statement_at
from grader.package.source.truth import truth_of

ENDS = ("destroy_node", "rclpy.shutdown", "rclpy.try_shutdown")
LEVELS = ("set_level", "set_logger_level")
NUMBERS = {"30": "WARN", "40": "ERROR", "50": "FATAL"}  # the levels that hide lines


def _blocks(suspect: Suspect) -> Iterator[ast.stmt]:
    callback = suspect.source.callback
    for node in ast.walk(callback) if callback is not None else ():
        if isinstance(node, ast.For | ast.While | ast.If):
            yield node


def _loops(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a loop of the callback that logs in each round."""
    for block in _blocks(suspect):
        if isinstance(block, ast.For | ast.While) and suspect.source.logs(block):
            word = "for" if isinstance(block, ast.For) else "while"
            found = suspect.finding("loop_in_callback", block, name=word)
            number = block.target if isinstance(block, ast.For) else None
            inside = {dotted(n) for log in suspect.source.logs(block) for n in ast.walk(log)}
            own = dotted(number) if isinstance(number, ast.Attribute) else ""
            if own in inside and own in starts_of(suspect.source):
                words = {**found.words, "number": own}
                return replace(found, variant="counts_itself", words=words)
            if (
                isinstance(number, ast.Name)
                and number.id in inside
                and _counts_beside(suspect, block)
            ):
                params = {**found.params, "number": number.id}
                words = {**found.words, "number": number.id}
                return replace(found, variant="listed", params=params, words=words)
            if isinstance(number, ast.Name) and number.id in inside:
                found = replace(found, variant="counts", words={**found.words, "number": number.id})
                kept = _counter_of_range(suspect, block)
                if kept:
                    words = {**found.words, "kept": kept}
                    params = {**found.params, "kept": kept}
                    found = replace(found, variant="counts_kept", words=words, params=params)
            return found
    return None


def _counts_beside(suspect: Suspect, block: ast.For | ast.While) -> bool:
    """Whether the loop goes through a list, and the callback counts beside it."""
    callback, inside = suspect.source.callback, set(ast.walk(block))
    listed = isinstance(block, ast.For) and isinstance(block.iter, ast.Attribute)
    nodes = [n for n in ast.walk(callback) if n not in inside] if callback is not None else []
    return listed and any(adds_to(n, name) for n in nodes for name in starts_of(suspect.source))


def _counter_of_range(suspect: Suspect, block: ast.For | ast.While) -> str:
    """Return the attribute up to which a for counts, if the callback adds to it; "" if none."""
    rounds = block.iter if isinstance(block, ast.For) else None
    callback = suspect.source.callback
    if not isinstance(rounds, ast.Call) or dotted(rounds.func) != "range" or callback is None:
        return ""
    names = [dotted(n) for given in rounds.args for n in ast.walk(given)]
    kept = [name for name in names if name.startswith("self.") and name.count(".") == 1]
    added = [n for n in ast.walk(callback) if any(adds_to(n, name) for name in kept)]
    return kept[0] if kept and added and kept[0] in starts_of(suspect.source) else ""


def _chooses(block: ast.If) -> bool:
    """Whether a condition has an else, or is true at each n-th call: that can be meant."""
    nth = any(isinstance(n, ast.Mod) for n in ast.walk(block.test))
    return bool(block.orelse) or nth


def _around_all_logs(suspect: Suspect) -> Iterator[ast.If]:
    """Yield the conditions that have all log calls of the callback in their block."""
    source, callback = suspect.source, suspect.source.callback
    for block in _blocks(suspect):
        logs = _logs_of(source, block)
        all_logs = _logs_of(source, callback) if callback is not None else []
        if isinstance(block, ast.If) and logs and len(logs) == len(all_logs):
            yield block


def _logs_of(source: NodeSource, part: ast.AST) -> list[ast.Call]:
    """Return the calls of a part that log, and those of methods that do."""
    called = [call for call, method in calls_of_methods(source, part) if source.logs(method)]
    return [*source.logs(part), *called]


def _logs_each_nth(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a condition that lets only each n-th call log, where at most one line came.

    A condition on the counter itself can be meant.
    """
    logged = logged_counter(suspect.source)
    for block in _around_all_logs(suspect):
        nth = any(isinstance(n, ast.Mod) for n in ast.walk(block.test))
        meant = logged is not None and logged[1] in map(dotted, ast.walk(block.test))
        if nth and not meant and not block.orelse and len(suspect.lines) < 2:
            return suspect.finding("log_if", block, name=ast.unparse(block.test)[:60])
    return None


def _logs_if(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a condition that decides whether the callback logs."""
    for block in _around_all_logs(suspect):
        truth = truth_of(suspect.source, block.test)
        if truth is not None and truth.value:
            continue  # (it is always true)
        if not _chooses(block) and not _has_effect(suspect.source, block.test):
            return suspect.finding("log_if", block, name=ast.unparse(block.test)[:60])
    return None


def _needless_if(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a condition without which the lines are right, and which changes nothing itself."""
    found = worked_out("log_if", "condition")(suspect)
    line = found.where.line if found is not None and found.where is not None else 0
    tests = [
        block.test
        for block in _blocks(suspect)
        if isinstance(block, ast.If | ast.While) and block.lineno == line
    ]
    return None if any(_has_effect(suspect.source, test) for test in tests) else found


def _and_period(look: FromSource) -> FromSource:
    """Return what finds the same, and says the right period too if the only timer has another."""

    def found(suspect: Suspect) -> RecognisedMistake | None:
        mistake, timers = look(suspect), suspect.source.timers
        period = timers[0].period if len(timers) == 1 else None
        seconds = seconds_of(suspect.source, period) if period is not None else None
        if mistake is None or seconds is None or is_right(seconds, suspect.period):
            return mistake
        words = {**mistake.words, "seconds": f"{seconds:g}"}
        return replace(mistake, words=words, variant="period")

    return found


def _unwrapped(case: Case) -> Files | None:
    """Remove the condition; give the timer the required period, if it has another one."""
    files = lines.unwrapped(case)
    return files and (node_timer.period(replace(case, files=files)) or files)


def _has_effect(source: NodeSource, test: ast.expr) -> bool:
    """Whether a condition may change something: it reads a property, which is a function."""
    properties = {
        n.name
        for n in source.all_nodes
        if isinstance(n, ast.FunctionDef) and any(dotted(d) == "property" for d in n.decorator_list)
    }
    parts = list(ast.walk(test))
    return any(isinstance(n, ast.Attribute) and n.attr in properties for n in parts)


def _counts_if(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a condition that decides whether the callback counts."""
    callback, logged = suspect.source.callback, logged_counter(suspect.source)
    if callback is None or logged is None:
        return None
    changed = [n for n in ast.walk(callback) if logged[1] in targets_of(n)]
    for block in _blocks(suspect):
        if not isinstance(block, ast.If) or (_chooses(block) and not _stands(suspect)):
            continue
        inside = list(ast.walk(block))
        if changed and all(change in inside for change in changed):
            found = suspect.finding(
                "count_if", block, name=logged[1], text=ast.unparse(block.test)[:60]
            )
            line = changed[0].lineno if isinstance(changed[0], ast.stmt) else block.lineno
            words = {**found.words, "line": line}
            return replace(found, words=words, variant="line") if _chooses(block) else found
    return None


def _stands(suspect: Suspect) -> bool:
    """Whether the last three lines are the same: the number does not change any more."""
    return len(suspect.lines) > 2 and len(set(suspect.lines[-3:])) == 1


def _counts_in_else(suspect: Suspect) -> RecognisedMistake | None:
    """Look for an if whose else alone counts, where a number came twice."""
    callback, logged = suspect.source.callback, logged_counter(suspect.source)
    twice = any(one == other for one, other in zip(suspect.lines, suspect.lines[1:]))
    if callback is None or logged is None or not twice:
        return None
    changed = [n for n in ast.walk(callback) if logged[1] in targets_of(n)]
    for block in _blocks(suspect):
        only = block.orelse if isinstance(block, ast.If) and len(block.orelse) == 1 else []
        if isinstance(block, ast.If) and len(changed) == 1 and changed == only:
            text, module = ast.unparse(block.test)[:60], suspect.source.module_of(block)
            found = suspect.finding("count_if", only[0], name=logged[1], text=text)
            words = {**found.words, "written": module.text.code(only[0]), "line": block.lineno}
            return replace(found, words=words, variant="else")
    return None


def _inner(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a function in the callback that logs, and that nothing calls."""
    source, callback = suspect.source, suspect.source.callback
    used = {n.id for n in source.all_nodes if isinstance(n, ast.Name)}
    for node in ast.walk(callback) if callback is not None else ():
        inner = isinstance(node, ast.FunctionDef) and node is not callback
        unused = inner and isinstance(node, ast.FunctionDef) and node.name not in used
        if unused and isinstance(node, ast.FunctionDef) and source.logs(node):
            found = suspect.finding("inner_not_called", node, name=node.name)
            given = [a.arg for a in (*node.args.posonlyargs, *node.args.args)]
            words = {**found.words, "names": ", ".join(given)}
            return replace(found, words=words, variant="given") if given else found
    return None


def _ends(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a call in the callback that ends the node."""
    callback = suspect.source.callback
    inner = methods_run_by(suspect.source, callback) if callback is not None else ()
    parts = [] if callback is None else [callback, *inner]
    for call, name in (found for part in parts for found in calls_in(part)):
        if name in ENDS or (last_part(name) == "destroy_node" and _is_own(suspect.source, name)):
            if any(
                isinstance(n, ast.ExceptHandler)
                for n in suspect.source.module_of(call).around(call)
            ):
                continue  # (an error is the cause: node.error_hidden)
            found = suspect.finding("ends_in_callback", call, name=f"{name}()")
            return _with_its_block(suspect, call, found)
    return None


def _is_own(source: NodeSource, name: str) -> bool:
    """Whether destroy_node is called on the node, not on another one: self.helper, or a plain node."""
    owner = name.rpartition(".")[0]
    made = {
        target
        for n in source.all_nodes
        if isinstance(n, ast.Assign) and isinstance(n.value, ast.Call)
        if called_name(n.value) in ("create_node", "Node")
        for target in targets_of(n)
    }
    return owner == "super()" or ("." not in owner and owner not in made)


def _with_its_block(
    suspect: Suspect, call: ast.Call, found: RecognisedMistake
) -> RecognisedMistake:
    """Name what goes with a call that ends the node: its branch, or the other calls of this kind."""
    module = suspect.source.module_of(call)
    statement = statement_at(module, call.lineno)
    branch = in_branch(suspect.source, module, statement)
    if branch is not None:
        return replace(found, variant=branch[0], words={**found.words, **branch[1]})
    also = _ends_beside(module, statement) if statement is not None else []
    if len(also) < 2:
        return found
    words = {**found.words, "lines": ", ".join(str(s.lineno) for s in also)}
    return replace(found, variant="lines", words=words)


def _ends_beside(module: Module, statement: ast.stmt) -> list[ast.stmt]:
    """Return the statements of a block that only end the node, this one too."""
    return [
        s
        for s in block_of(module, statement)
        if isinstance(s, ast.Expr)
        and isinstance(s.value, ast.Call)
        and (dotted(s.value.func) in ENDS or called_name(s.value) == "destroy_node")
    ]


def _without_ends(case: Case) -> Files | None:
    """Delete what ends the node: the only call, all calls of its block, or its branch."""
    module, node = case.module, case.node
    statement = statement_at(module, case.finding.line) if module is not None else None
    if module is None or node is None or statement is None:
        return None
    also = _ends_beside(module, statement)
    if len(also) < 2 or branch_of(node, module, statement) is not None:
        return without_stop(case)
    rows = [lines.own_lines(module, s) for s in also]
    if len(also) == len(block_of(module, statement)) or None in rows:
        return None
    return case.changed(module, *(module.text.without(n) for row in rows for n in row or ()))


def _setup_code(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a call of setup in the node's file: it ends the program."""
    module = suspect.source.entry
    for statement in module.tree.body:
        if not isinstance(statement, ast.Expr) or not isinstance(statement.value, ast.Call):
            continue
        if last_part(dotted(statement.value.func)) == "setup" and any(
            given.arg in ("packages", "entry_points") for given in statement.value.keywords
        ):
            first, last = statement.lineno, statement.end_lineno or statement.lineno
            found = suspect.finding("setup_code", statement)
            return replace(found, words={**found.words, "line": str(first), "wanted": str(last)})
    return None


def _level_given(source: NodeSource, call: ast.Call) -> str:
    """Return the level that a call sets, as the code writes it or as its variable gets it."""
    given = ast.unparse(call.args[-1]) if call.args else ""
    sets = [
        n.value
        for n in source.all_nodes
        if isinstance(n, ast.Assign | ast.AnnAssign) and n.value is not None
        if last_part(given) in [last_part(name) for name in targets_of(n)]
    ]
    return ast.unparse(sets[0]) if len(sets) == 1 else given


def _of_other_logger(suspect: Suspect, call: ast.Call) -> bool:
    """Whether a call sets the level of a logger by a name that is not the node's."""
    given = call.args[0] if called_name(call) == "set_logger_level" and call.args else None
    owner = call.func.value if isinstance(call.func, ast.Attribute) else None
    if isinstance(owner, ast.Call) and called_name(owner) == "get_logger" and owner.args:
        given = owner.args[0]
    name = given.value if isinstance(given, ast.Constant) else None
    return isinstance(name, str) and name != suspect.assignment.node_name


def _level(suspect: Suspect) -> RecognisedMistake | None:
    for call, name in suspect.source.calls:
        given = _level_given(suspect.source, call) if last_part(name) in LEVELS else ""
        hides = re.search(r"\b(?:WARN|WARNING|ERROR|FATAL)\b", given)
        level = hides[0] if hides else NUMBERS.get(given, "")
        if last_part(name) in LEVELS and level and not _of_other_logger(suspect, call):
            return suspect.finding("level_set", call, name=last_part(name), level=level)
    return None


def _placeholder(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    statement = statement_at(raised.module, raised.line)
    function = function_at(raised.module, raised.line)
    if not isinstance(statement, ast.Raise) or function is None or statement.exc is None:
        return None
    if not dotted(statement.exc).startswith("NotImplementedError"):
        return None
    found = raised.finding("placeholder", at=statement, name=function.name)
    alone = [s for s in function.body if s is not statement and not is_text(s)]
    heir = _heir(raised.source, function)
    if not alone and heir is not None:
        words = {**found.words, "type": heir.name}
        return replace(found, variant="inherited", words=words)
    return found if alone else replace(found, variant="alone")


def _heir(source: NodeSource, method: Function) -> ast.ClassDef | None:
    """Return the class that inherits the method and has none of this name, if there is one."""
    classes = [c for module in source.modules for c in module.classes]
    owners = [c.name for c in classes if method in c.body]
    heirs = [
        c
        for c in classes
        if any(last_part(dotted(base)) in owners for base in c.bases)
        and not any(isinstance(s, Function) and s.name == method.name for s in c.body)
    ]
    return heirs[0] if len(heirs) == 1 else None


def _spins_again(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The line spins once more after Ctrl+C, in a loop whose except lets it go on."""
    del match
    return _swallowed(Suspect(raised.source, raised.assignment))


def _swallowed(suspect: Suspect) -> RecognisedMistake | None:
    """Look for an except in a loop that catches Ctrl+C and lets the loop go on."""
    for handler in suspect.source.all_nodes:
        if not isinstance(handler, ast.ExceptHandler) or not _catches_interrupt(handler):
            continue
        around = list(suspect.source.module_of(handler).around(handler))
        loops = [part for part in around if isinstance(part, ast.While)]
        leaves = any(isinstance(n, ast.Raise | ast.Return | ast.Break) for n in ast.walk(handler))
        if loops and not leaves and not _ends_loop(suspect.source, handler, loops[0]):
            place = suspect.place_at(handler)
            found = suspect.finding("interrupt_swallowed", place, line=loops[0].lineno)
            last = handler.body[-1]
            if isinstance(last, ast.Continue):
                words = {**found.words, "last": last.lineno}
                variant = "bare_continue" if handler.type is None else "continue"
                return replace(found, words=words, variant=variant)
            return replace(found, variant="" if handler.type is None else "named")
    return None


def _ends_loop(source: NodeSource, handler: ast.ExceptHandler, loop: ast.While) -> bool:
    """Whether an except makes its loop's condition false, or its try is not what spins in the loop."""
    tested = {last_part(dotted(part)) for part in ast.walk(loop.test)} - {""}
    for node in ast.walk(handler):
        value = node.value if isinstance(node, ast.Assign) else None
        false = isinstance(value, ast.Constant) and not value.value
        if false and tested & set(map(last_part, targets_of(node))):
            return True
    tried = source.module_of(handler).parents.get(handler)
    spins = [call for call, name in calls_in(loop) if last_part(name) in SPINS]
    return bool(spins) and tried is not None and not any(n in spins for n in ast.walk(tried))


def _catches_interrupt(handler: ast.ExceptHandler) -> bool:
    named = handler.type.elts if isinstance(handler.type, ast.Tuple) else [handler.type]
    return any(n is None or dotted(n) in ("KeyboardInterrupt", "BaseException") for n in named)


CONTINUES = msg(
    "Ctrl+C raises KeyboardInterrupt. This except catches it, and continue begins the loop again."
)
_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "interrupt_swallowed",
        "shutdown",
        msg("An except in a loop catches Ctrl+C, and the loop goes on"),
        msg(
            "Ctrl+C raises KeyboardInterrupt. This except catches it, and the loop around it "
            "goes on."
        ),
        msg(
            "Write except KeyboardInterrupt: here, and break as the last line in it: break ends "
            "the loop that begins on line {line}."
        ),
        links.EXECUTORS,
        whys={"continue": CONTINUES, "bare_continue": CONTINUES},
        fixes={
            "continue": msg(
                "Write break instead of continue on line {last}: break ends the loop that begins on "
                "line {line}."
            ),
            "bare_continue": msg(
                "Write except KeyboardInterrupt: here, and break instead of continue on line {last}: "
                "break ends the loop that begins on line {line}."
            ),
            "named": msg(
                "Write break as the last line in this except: break ends the loop that begins on "
                "line {line}."
            ),
        },
        raised={r"RCLError: failed to initialize wait set": _spins_again},
        behind={"run.ignores_interrupt": _swallowed},
        fixed_by=(node_try.break_in_except,),
        examples=(
            example(
                "asks_after_ctrl_c_and_spins_again",
                Replace(
                    NODE,
                    SPIN_UNTIL_CTRL_C,
                    "    running = True\n"
                    "    while running:\n"
                    "        try:\n"
                    "            rclpy.spin(node)\n"
                    "        except KeyboardInterrupt:\n"
                    "            running = input('Stop (y/n)? ') != 'y'\n",
                ),
                fails="run.interrupt",
            ),
            example(
                "spins_once_more_after_ctrl_c",
                Replace(
                    NODE,
                    SPIN_UNTIL_CTRL_C,
                    "    while True:\n"
                    "        try:\n"
                    "            rclpy.spin_once(node)\n"
                    "        except KeyboardInterrupt:\n"
                    "            continue\n",
                ),
                fails="run.interrupt",
            ),
            example(
                "loop_goes_on_after_ctrl_c",
                Replace(
                    NODE,
                    SPIN_UNTIL_CTRL_C,
                    "    while True:\n"
                    "        try:\n"
                    "            rclpy.spin(node)\n"
                    "        except KeyboardInterrupt:\n"
                    "            continue\n",
                ),
                fails="run.interrupt",
            ),
            example(
                "loop_catches_everything",
                Replace(
                    NODE,
                    SPIN_UNTIL_CTRL_C,
                    "    while True:\n"
                    "        try:\n"
                    "            rclpy.spin_once(node)\n"
                    "        except:\n"
                    "            pass\n",
                ),
                fails="run.interrupt",
            ),
        ),
    ),
    _node(
        "loop_in_callback",
        "timer",
        msg("A loop in the callback logs several lines at once"),
        msg(
            "The timer calls the callback again and again. A loop in the callback does all its "
            "rounds in one call, at the same time."
        ),
        msg("Remove this {name}, and indent its lines as far as the {name} is indented now."),
        fixes={
            "counts_itself": msg(
                "Remove this {name}, and indent its lines as far as the {name} is indented now. It also "
                "counted: write {number} += {step} below the line that logs."
            ),
            "listed": msg(
                "Log one line in each call: delete the {name}, and log the counter itself instead of "
                "{number}, on a line above the one that adds to the counter."
            ),
            "counts_kept": msg(
                "Remove this {name}, and indent its lines as far as the {name} is indented now. "
                "Without it there is no {number}: log {kept} instead, which counts already."
            ),
            "counts": msg(
                "Remove this {name}, and indent its lines as far as the {name} is indented now. "
                "Without it there is no {number}: write {counter} = {start} in __init__, log "
                "{counter} instead of {number}, and write {counter} += {step} below the line that "
                "logs."
            ),
        },
        behind={"run.twice": _loops, "run.wrong_step": _loops},
        fixed_by=(node_loops.counted_by_calls, lines.unwrapped),
        examples=(
            example(
                "loop_logs_a_list_that_grows",
                Replace(
                    NODE,
                    "        self.counter_ = 0\n",
                    "        self.counter_ = 0\n        self.times = []\n",
                ),
                Replace(
                    NODE,
                    LOG_LINE + STEP_LINE,
                    "        self.times.append(self.counter_)\n"
                    + STEP_LINE
                    + "        for t in self.times:\n"
                    "            self.get_logger().info('Hello time: ' + str(t))\n",
                ),
                fails="run.output",
            ),
            example(
                "loop_logs_its_number",
                Replace(NODE, "        self.counter_ = 0\n", ""),
                Replace(
                    NODE,
                    LOG_LINE + STEP_LINE,
                    "        for i in range(10):\n"
                    "            self.get_logger().info('Hello time: ' + str(i))\n",
                ),
                fails="run.output",
            ),
            example(
                "loop_counts_the_counter",
                Replace(
                    NODE,
                    LOG_LINE + STEP_LINE,
                    f"        for self.counter_ in range(0, 100):\n    {LOG_LINE}",
                ),
                fails="run.output",
            ),
            example(
                "loop_up_to_the_counter",
                Replace(NODE, LOG_LINE, f"        for i in range(self.counter_):\n    {LOG_LINE}"),
                Replace(NODE, "str(self.counter_)", "str(i)"),
                fails="run.output",
            ),
            example(
                "loop_logs_ten",
                Replace(
                    NODE,
                    LOG_LINE + STEP_LINE,
                    f"        for i in range(10):\n    {LOG_LINE}    {STEP_LINE}",
                ),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "log_if",
        "callback",
        msg("A condition decides whether the line is logged"),
        msg("The line is logged only while the condition {name} is true."),
        msg("Remove this if, and indent the lines below it as far as the if is indented now."),
        fixes={
            "period": msg(
                "Remove this if, and indent the lines below it as far as the if is indented now. Then "
                "give create_timer the period {period} instead of {seconds}: the timer itself waits."
            )
        },
        behind={
            **dict.fromkeys(
                ("run.no_lines", "run.stops"), _and_period(first_of(_logs_if, _logs_each_nth))
            ),
            "run.wrong_start": _and_period(first_of(_needless_if, _logs_if)),
            "run.wrong_step": _and_period(_needless_if),
            "run.wrong_period": _and_period(first_of(_needless_if, _logs_if)),
        },
        fixed_by=(_unwrapped,),
        examples=(
            example(
                "logs_until_five",
                Replace(NODE, LOG_LINE, f"        if self.counter_ < 5:\n    {LOG_LINE}"),
                fails="run.output",
            ),
            example(
                "logs_each_sixtieth_frame",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = 0\n        self.frame_ = 0"),
                Replace(
                    NODE,
                    LOG_LINE + STEP_LINE,
                    f"        if self.frame_ % 60 == 0:\n    {LOG_LINE}    {STEP_LINE}"
                    "        self.frame_ += 1\n",
                ),
                fails="run.output",
                blocks=("run.period",),
            ),
            example(
                "logs_at_the_rising_edge_of_a_bit",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = 0\n        self.bit_ = False"),
                Replace(
                    NODE,
                    LOG_LINE + STEP_LINE,
                    "        self.bit_ = not self.bit_\n        if self.bit_:\n"
                    f"    {LOG_LINE}    {STEP_LINE}",
                ),
                fails="run.period",
            ),
            example(
                "logs_after_the_first",
                Replace(NODE, LOG_LINE, f"        if self.counter_ > 0:\n    {LOG_LINE}"),
                fails="run.output",
            ),
            example(
                "logs_each_second",
                Replace(NODE, LOG_LINE, f"        if self.counter_ % 2 == 0:\n    {LOG_LINE}"),
                fails="run.output",
                also={"run.period": "node.log_if"},
            ),
            example(
                "logs_never",
                Replace(
                    NODE,
                    LOG_LINE + STEP_LINE,
                    f"        if self.counter_ > 0:\n    {LOG_LINE}    {STEP_LINE}",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
    _node(
        "count_if",
        "counter",
        msg("A condition decides whether the counter changes"),
        msg("The counter changes only while the condition {text} is true."),
        msg("Remove this if, and indent the lines below it as far as the if is indented now."),
        whys={
            "else": msg(
                "This line is in the else of the if in line {line}: it does not run while the condition "
                "{text} is true."
            )
        },
        fixes={
            "line": msg(
                "Move line {line} out of this if: below the if and its else, indented as far as the if, so "
                "that it runs in each call."
            ),
            "else": msg(
                "Delete the line else: above it, and indent {written} as far as the if in line {line} is "
                "indented, so that it runs in each call."
            ),
        },
        behind=dict.fromkeys(
            ("run.constant_counter", "run.wrong_step"), first_of(_counts_if, _counts_in_else)
        ),
        fixed_by=(lines.unwrapped,),
        examples=(
            example(
                "counts_only_at_even_numbers",
                Replace(
                    NODE,
                    STEP_LINE,
                    f"        if self.counter_ % 2 == 0:\n    {STEP_LINE}"
                    "        else:\n            self.odd_ = True\n",
                ),
                fails="run.output",
            ),
            example(
                "counts_in_the_else",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = 0\n        self.first_ = True"),
                Replace(
                    NODE,
                    STEP_LINE,
                    "        if self.first_:\n            self.first_ = False\n"
                    f"        else:\n    {STEP_LINE}",
                ),
                fails="run.output",
            ),
            example(
                "counts_never",
                Replace(NODE, STEP_LINE, f"        if self.counter_ > 0:\n    {STEP_LINE}"),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "inner_not_called",
        "callback",
        msg("A function in the callback is not called"),
        msg("def only defines {name}. Its lines run when something calls {name}()."),
        msg("Remove the line def {name}, and indent its lines as far as the def is indented now."),
        fixes={
            "given": msg(
                "Call {name}(…) below its lines, indented as far as the def, with a value for each of "
                "its parameters: {names}"
            )
        },
        behind={"run.no_lines": _inner},
        fixed_by=(node_callback.without_def,),
        examples=(
            example(
                "inner_function",
                Replace(
                    NODE,
                    LOG_LINE + STEP_LINE,
                    f"        def say_hello():\n    {LOG_LINE}    {STEP_LINE}",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
    _node(
        "ends_in_callback",
        "callback",
        msg("The callback ends the node"),
        msg("{name} ends the node: after that, ROS calls no callback of it."),
        msg("Remove this line: a node ends with Ctrl+C."),
        links.EXECUTORS,
        behind={
            "run.ended_early": _ends,
            "run.stops": _ends,
            "run.no_lines": _ends,
            "run.exits_at_once": _ends,
        },
        fixes={"lines": msg("Remove lines {lines}: a node ends with Ctrl+C."), **BRANCH_FIXES},
        fixed_by=(_without_ends,),
        deletes=("",),
        examples=(
            example(
                "shutdown_and_return_in_a_branch",
                Replace(
                    NODE,
                    STEP_LINE,
                    f"{STEP_LINE}        if self.counter_ == 4:\n"
                    "            self.get_logger().info('done')\n            rclpy.shutdown()\n"
                    "            return\n",
                ),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
            example(
                "shutdown_in_callback",
                Replace(NODE, STEP_LINE, f"{STEP_LINE}        rclpy.shutdown()\n"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
        ),
    ),
    _node(
        "setup_code",
        "file",
        msg("The node's file contains the code of setup.py"),
        msg("setup() reads the words of the command line and ends the program."),
        msg(
            "Delete lines {line} to {wanted} in this file: setup() belongs only into setup.py, beside "
            "package.xml. Delete the imports that only setup() needs, too."
        ),
        links.ENTRY_POINTS,
        behind={"run.exits_at_once": _setup_code, "run.died_at_start": _setup_code},
        fixed_by=(lines.deleted,),
        examples=(
            example(
                "setup_in_node_file",
                Replace(
                    NODE,
                    "if __name__ == '__main__':\n    main()\n",
                    "if __name__ == '__main__':\n    main()\n\n"
                    "from setuptools import find_packages, setup\n\n"
                    "setup(\n    name='my_robot_controller',\n"
                    "    packages=find_packages(exclude=['test']),\n)\n",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "level_set",
        "logger",
        msg("The logger is set to a level that hides the lines"),
        msg("After {name}, the logger shows only records of the level {level} and above."),
        msg("Remove the line with {name}."),
        links.LOGGING,
        behind={"run.no_lines": _level},
        fixed_by=(lines.deleted,),
        examples=(
            example(
                "level_set_to_number",
                Replace(
                    NODE,
                    "        self.counter_ = 0\n",
                    "        self.counter_ = 0\n        self.get_logger().set_level(30)\n",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
            example(
                "level_set_to_warn",
                Replace(
                    NODE,
                    "self.counter_ = 0",
                    "self.counter_ = 0\n"
                    "        self.get_logger().set_level(rclpy.logging.LoggingSeverity.WARN)",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
    _node(
        "placeholder",
        "callback",
        msg("A method still has the line that stands for its code"),
        msg("raise NotImplementedError ends the program where the code is still to be written."),
        msg("Delete this line: the lines of {name} are below it or above it."),
        links.PYTHON_ERRORS,
        whys={
            "inherited": msg(
                "{type} has no method {name} of its own, so the one of its base class is called. "
                "raise NotImplementedError says there that each class has to write it."
            )
        },
        fixes={
            "alone": msg("Write the lines of {name} instead of this line."),
            "inherited": msg(
                "Write a method {name} in the class {type}. If {type} has a method that is meant to be "
                "it, give this one the name {name}."
            ),
        },
        raised={"NotImplementedError": _placeholder},
        fixed_by=(lines.deleted,),
        examples=(
            example(
                "not_implemented",
                Replace(NODE, LOG_LINE, f"        raise NotImplementedError\n{LOG_LINE}"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
)
