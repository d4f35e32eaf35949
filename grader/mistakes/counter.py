"""Mistakes in how the counter changes: its step, and what sets it back."""

from __future__ import annotations

import ast
import re
from collections.abc import Mapping
from dataclasses import replace
from itertools import takewhile

from grader.base.i18n.message import Value, msg
from grader.mistakes import links
from grader.mistakes.counted import counter_in, text_added
from grader.mistakes.example import LOG_LINE, NODE, STEP_LINE, example
from grader.mistakes.fixes import lines, node_count, node_worked_out
from grader.mistakes.fixes.case import Case
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect, first_of
from grader.mistakes.worked_out import INSTEAD, change_of, worked_out
from grader.package.edit.files import Files
from grader.package.edit.tree import Replace
from grader.package.source.asked_attribute import never_there
from grader.package.source.counter import (
    adds_to,
    declares,
    outer_word,
    parts_of_callback,
    starts_of,
    targets_of,
    without_effect,
)
from grader.package.source.module import Function, Module
from grader.package.source.names import dotted, last_part, own_name
from grader.package.source.node import NodeSource
from grader.package.source.place import block_of, statement_at
from grader.package.source.plain_counter import plain_start
from grader.package.source.sure_errors import is_never_set

SET_AGAIN = msg("This line sets {name} to {value} again in each call.")
SUM = ast.Add | ast.Sub
MODULO = msg(
    "% {form} gives the rest of a division by {form}: after the numbers below {form} comes 0 again."
)
ONLY_DELETE = msg("Delete this line: the counter never starts again.")
SET_ALREADY = msg("Delete this line: line {first} sets {name} already.")
ALWAYS = msg(
    "{code} in line {line} is always true: nothing sets an attribute with the name {asked}. So "
    "each call sets {name} to {value} again. The first value belongs in __init__."
)
MOST_CODE = 80  # characters of a piece of code that a text shows
LOG_AND_STEP = f"{LOG_LINE}{STEP_LINE}"


def _step_is_text(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The line adds a number in quotes; without a line, the only place of the files that does."""
    del match
    statement = statement_at(raised.module, raised.line)
    nodes = raised.source.all_nodes if raised.line is None else [statement]
    found = [
        (node, name, step)
        for node in nodes
        if isinstance(node, ast.AugAssign | ast.Assign)
        for name, step in [_text_added(node)]
        if name and step.isascii() and step.isdigit()
    ]
    if len(found) != 1:
        return None
    at, name, step = found[0]
    return raised.finding("step_is_text", at=at, name=name, step=step)


def _text_added(statement: ast.AugAssign | ast.Assign) -> tuple[str, str]:
    """Return the name to which a statement adds a text, and that text; "" for what is not there."""
    if isinstance(statement, ast.Assign):
        return next(targets_of(statement), ""), text_added(statement)
    step = statement.value.value if isinstance(statement.value, ast.Constant) else None
    added = step if isinstance(step, str) and isinstance(statement.op, ast.Add) else ""
    return dotted(statement.target), added


def _plus_reversed(suspect: Suspect) -> RecognisedMistake | None:
    counter = counter_in(suspect)
    for node in counter.set if counter is not None else ():
        if isinstance(node.value, ast.UnaryOp) and isinstance(node.value.op, ast.UAdd):
            return suspect.finding("plus_reversed", node, name=counter.name if counter else "")
    return None


def _reset(suspect: Suspect) -> RecognisedMistake | None:
    counter = counter_in(suspect)
    if counter is None:
        return None
    adds = [*counter.added, *(n for n in counter.set if adds_to(n, counter.name))]
    for node in counter.set:
        if _is_under_if(suspect, node) and not any(_runs_too(suspect, n, node) for n in adds):
            continue  # (its condition may never be met)
        if isinstance(node.value, ast.Constant):
            value = str(node.value.value)[:40]
            found = suspect.finding("counter_reset", node, name=counter.name, value=value)
            around = suspect.source.function_around(node)
            if "." not in counter.name:
                return _in_variable(suspect, around, found)
            if around is None or around is suspect.source.callback:
                return _in_callback(suspect, node, counter.name, found)
            words = {**found.words, "function": around.name}
            return replace(found, variant="helper", words=words)
    return None


def _runs_too(suspect: Suspect, added: ast.stmt, reset: ast.stmt) -> bool:
    """Whether an addition is in no branch, or in the branch in which the counter is reset."""
    module, parents = suspect.source.module_of(added), suspect.source.module_of(reset).parents
    if module.parents.get(added) is parents.get(reset):
        return block_of(module, added) == block_of(module, reset)
    branches = (ast.If, ast.Match, ast.ExceptHandler)
    inside = takewhile(lambda part: not isinstance(part, Function), module.around(added))
    return not any(isinstance(part, branches) for part in inside)


def _in_variable(
    suspect: Suspect, around: Function | None, found: RecognisedMistake
) -> RecognisedMistake | None:
    """Say where a variable of a function goes that is set in each call."""
    if around is None:
        return None
    module = suspect.source.module_of(around)
    scope = next((n for n in module.around(around) if isinstance(n, Function | ast.Module)), None)
    words = {**found.words, "function": around.name}
    declared = declares(around, str(found.words["name"]))
    if declared and around in suspect.source.own_methods:
        return _in_declared(module, found, words)
    if around in suspect.source.own_methods:
        return replace(found, words=words, variant="local")
    words["word"] = "nonlocal" if isinstance(scope, Function) else "global"
    return replace(found, words=words, variant="declared" if declared else "outside")


def _in_declared(
    module: Module, found: RecognisedMistake, words: Mapping[str, Value]
) -> RecognisedMistake:
    """Say where a variable of the file, which a method declares with global, has its first value."""
    name = str(found.words["name"])
    firsts = [n for n in module.tree.body if name in targets_of(n)]
    if not firsts:
        return replace(found, words=words, variant="file")
    return replace(found, words={**words, "first": str(firsts[0].lineno)}, variant="file_there")


def _in_callback(
    suspect: Suspect, node: ast.stmt, name: str, found: RecognisedMistake
) -> RecognisedMistake:
    """Say where the first value is set already, and which condition is always met."""
    source = suspect.source
    starts = starts_of(source)
    first = starts.get(name)
    there = first is not None and first.lineno != node.lineno
    variant = "there" if there else ""
    module = source.module_of(node)
    test = next((a for a in module.around(node) if isinstance(a, ast.If)), None)
    asked = never_there(source, test.test) if test is not None else None
    words = dict(found.words)
    around = module.parents.get(node)
    set_also = isinstance(around, ast.Try) and any(
        name in targets_of(n) for handler in around.handlers for n in ast.walk(handler)
    )
    if set_also and isinstance(around, ast.Try) and around.finalbody == [node]:
        return replace(found, words=words, variant="finally")
    if there and first is not None:
        words["first"] = str(first.lineno)
    if test is not None and asked is not None:
        words |= {"asked": asked, "line": str(test.lineno)}
        words["code"] = module.text.code(test.test)[:MOST_CODE]
        variant = "always_there" if there else "always"
    return replace(found, words=words, variant=variant)


def _reset_if(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a condition of the callback under which the counter starts again."""
    counter = counter_in(suspect)
    for node in counter.set if counter is not None else ():
        around = suspect.source.module_of(node).parents.get(node)
        if counter is None or not isinstance(around, ast.If) or around.orelse:
            continue
        start = starts_of(suspect.source).get(counter.name)
        if isinstance(node.value, ast.Constant) and _is_near(node.value, start):
            found = suspect.finding("counter_reset", node, name=counter.name)
            return replace(found, variant="if")
    return None


def _is_near(value: ast.Constant, start: ast.Constant | None) -> bool:
    """Whether a counter begins again with a value: its start, or the number beside it."""
    if start is None or start is value or not isinstance(value.value, int):
        return False
    return isinstance(start.value, int) and abs(value.value - start.value) <= 1


def _modulo(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a rest of a division, after which the counter starts again."""
    change = change_of(suspect, "modulo")
    if change is not None and _is_asked(suspect, change.at):
        return None
    found = worked_out("counter_reset", "modulo", variant="modulo")(suspect)
    deleted = found is not None and not found.params["written"]
    return replace(found, variant="modulo_line") if found is not None and deleted else found


def _is_asked(suspect: Suspect, part: ast.AST) -> bool:
    """Whether a value is only compared or is a condition, and is not what is counted."""
    below = part
    for around in suspect.source.module_of(part).around(part):
        if isinstance(around, ast.Compare | ast.BoolOp):
            return True
        if isinstance(around, ast.If | ast.While | ast.IfExp) and around.test is below:
            return True
        if isinstance(around, ast.stmt):
            return False
        below = around
    return False


def _copy_increased(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a local copy of an attribute that the callback increases."""
    parts = parts_of_callback(suspect.source)
    copies: dict[str, str] = {}
    for node in (node for part in parts for node in ast.walk(part)):
        target = node.targets[0] if isinstance(node, ast.Assign) else None
        value = dotted(node.value) if isinstance(node, ast.Assign) else ""
        if isinstance(target, ast.Name) and value.startswith("self."):
            copies[target.id] = value
        kept = copies.get(dotted(node.target), "") if isinstance(node, ast.AugAssign) else ""
        if isinstance(node, ast.AugAssign) and kept and _is_only_read(suspect, kept):
            module, name = suspect.source.module_of(node), copies[dotted(node.target)]
            code = module.text.code(node)
            new = code.replace(dotted(node.target), name, 1)
            params = {"name": code, "written": new, "attribute": name}
            return suspect.finding("copy_increased", node, **params)
    return None


def _is_only_read(suspect: Suspect, name: str) -> bool:
    """Whether an attribute is a plain number that the callback never sets."""
    parts = parts_of_callback(suspect.source)
    set_here = any(name in targets_of(node) for part in parts for node in ast.walk(part))
    return not set_here and plain_start(suspect.source, name) is not None


def _is_under_if(suspect: Suspect, node: ast.stmt) -> bool:
    around = suspect.source.module_of(node).parents.get(node)
    constant = isinstance(node, ast.Assign) and isinstance(node.value, ast.Constant)
    return constant and isinstance(around, ast.If)


def _not_increased(suspect: Suspect) -> RecognisedMistake | None:
    counter, source = counter_in(suspect), suspect.source
    if counter is None or counter.added or plain_start(source, counter.name) is None:
        return None
    if any(not _is_under_if(suspect, node) for node in counter.set):
        return None
    if _changes_elsewhere(suspect, counter.name) or change_of(suspect, "name") is not None:
        return None
    if any(
        _is_misspelt_step(source, node) for node in ast.walk(source.callback or source.entry.tree)
    ):
        return None
    nothing = without_effect(source)
    if nothing is not None:
        at, name = nothing
        code = source.module_of(at).text.code(at)
        written = f"{name} += {suspect.output.step}"
        found = suspect.finding("counter_not_increased", at, name=code, written=written)
        return replace(found, words={**found.words, "attribute": name}, variant="nothing")
    found = suspect.finding("counter_not_increased", counter.logged, name=counter.name)
    if _is_returned(suspect, counter.logged):
        return replace(found, variant="returned")
    around = source.function_around(counter.logged)
    if around is not None and around.lineno == around.body[-1].lineno:
        return replace(found, variant="one_line")
    if around is not None and _is_in_branch(suspect, around, counter.logged):
        return replace(found, variant="last_line", words={**found.words, "function": around.name})
    word = outer_word(source, around, counter.name) if around is not None else ""
    if around is None or not word or declares(around, counter.name):
        return found
    words = {**found.words, "word": word, "function": around.name}
    return replace(found, words=words, variant="outer")


def _is_returned(suspect: Suspect, logged: ast.expr) -> bool:
    """Whether the log stands behind return: a line below it would not run."""
    around = suspect.source.module_of(logged).around(logged)
    statement = next((part for part in around if isinstance(part, ast.stmt)), None)
    return isinstance(statement, ast.Return) and bool(suspect.source.logs(statement))


def _is_in_branch(suspect: Suspect, function: Function, logged: ast.expr) -> bool:
    """Whether the log is in a branch of a function that always comes to its last line."""
    around = suspect.source.module_of(logged).around(logged)
    inside = {part for part in ast.walk(function) if isinstance(part, ast.If | ast.Match)}
    returns = any(isinstance(n, ast.Return | ast.Raise) for n in ast.walk(function))
    return not returns and any(part in inside for part in around)


def _is_misspelt_step(source: NodeSource, node: ast.AST) -> bool:
    """Whether a statement adds to an attribute that nothing sets: it raises an error, hidden or not."""
    name = own_name(node.target) if isinstance(node, ast.AugAssign) else ""
    return bool(name) and is_never_set(source, name)


def _changes_elsewhere(suspect: Suspect, name: str) -> bool:
    """Whether a sum is assigned to the counter, or to an attribute of its name of another object."""
    source = suspect.source
    own = set(source.own_nodes)
    for node in source.all_nodes:
        value = node.value if isinstance(node, ast.Assign) else None
        if not isinstance(node, ast.AugAssign) and not isinstance(value, ast.BinOp):
            continue
        same = [n for n in targets_of(node) if last_part(n) == last_part(name)]
        if same and (node in own or not same[0].startswith("self.")):
            return True
    return False


def _multiplied(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a product: a counter that starts at 0 stays there."""
    counter = counter_in(suspect)
    start = plain_start(suspect.source, counter.name) if counter is not None else None
    for node in counter.added if counter is not None and start is not None else ():
        if isinstance(node.op, ast.Mult) and counter is not None:
            return suspect.finding("counter_multiplied", node, name=counter.name)
    return None


def _added_instead(case: Case) -> Files | None:
    """Write += and the required step instead of the product."""
    node = case.node
    found = [n for n in node.all_nodes if isinstance(n, ast.AugAssign)] if node else []
    if node is None or len(found) != 1 or not isinstance(found[0].op, ast.Mult):
        return None
    module = node.module_of(found[0])
    code = f"{module.text.code(found[0].target)} += {case.assignment.output.step}"
    return case.changed(module, module.text.swap(found[0], code))


def _adds_twice(suspect: Suspect) -> RecognisedMistake | None:
    counter, step = counter_in(suspect), suspect.output.step
    if counter is None or plain_start(suspect.source, counter.name) is None:
        return None
    plain = [n for n in counter.added if _is_plain_sum(suspect, n)]
    others = [n for n in counter.added if n not in plain]
    right = len(plain) == 1 and _is_step(plain[0], step)
    if len(counter.added) < 2 or (others and not (right and _are_under_if(suspect, others))):
        return None
    second = others[0] if others else plain[1]
    return suspect.finding("adds_twice", second, name=counter.name, step=step)


def _is_step(node: ast.AugAssign, step: float) -> bool:
    added = node.value.value if isinstance(node.value, ast.Constant) else None
    return isinstance(node.op, ast.Add) and type(added) is int and added == step


def _are_under_if(suspect: Suspect, nodes: list[ast.AugAssign]) -> bool:
    """Whether each of these sums is in an if of the callback, and in no other block."""
    for node in nodes:
        around = suspect.source.module_of(node).around(node)
        blocks = [next(around, None), next(around, None)]
        if not isinstance(node.op, SUM) or not isinstance(blocks[0], ast.If):
            return False
        left = [n for n in ast.walk(blocks[0]) if isinstance(n, ast.Return | ast.Raise)]
        if left or not isinstance(blocks[1], Function):
            return False
    return True


def _is_plain_sum(suspect: Suspect, node: ast.AugAssign) -> bool:
    """Whether a sum is in no block of its function: under an if, in a loop or in a try."""
    around = suspect.source.module_of(node).parents.get(node)
    return isinstance(node.op, SUM) and isinstance(around, Function)


_added_in_line = worked_out("adds_twice", "doubled", variant="line")
_any_step = worked_out("other_step", "step", variant="written")


def _added_elsewhere(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a second addition to what is logged; another name may be the step that it grows by."""
    change, counter = change_of(suspect, "doubled"), counter_in(suspect)
    statement = change.at if change is not None else None
    names = {last_part(name) for name in targets_of(statement)} if statement is not None else set()
    own = counter is not None and bool(counter.added)
    if counter is not None and own and names and last_part(counter.name) not in names:
        return None
    return _added_in_line(suspect)


def _step_worked_out(suspect: Suspect) -> RecognisedMistake | None:
    """Look for another step; x = x adds nothing, and what was meant to add is in another line."""
    found = _any_step(suspect)
    target, _, value = str(found.params.get("name", "")).partition(" = ") if found else ("", "", "")
    return None if value and target == value else found


def _other_step(suspect: Suspect) -> RecognisedMistake | None:
    counter, step = counter_in(suspect), suspect.output.step
    if counter is None or plain_start(suspect.source, counter.name) is None:
        return None
    for node in counter.added:
        value = node.value.value if isinstance(node.value, ast.Constant) else None
        if not isinstance(node.op, SUM) or not isinstance(value, int | float):
            continue
        if not isinstance(node.op, ast.Add) or value != step:
            return suspect.finding("other_step", node, name=counter.name, step=step)
    return None


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "step_is_text",
        "counter",
        msg("A string is added to the counter"),
        msg("A number in quotes is a string, and Python cannot add a string to a number."),
        msg("Write {name} += {step}, without quotes."),
        links.PYTHON_CLASSES,
        seen=r"TypeError: unsupported operand type\(s\) for \+=: '(?:int|float)' and 'str'",
        raised={
            r"unsupported operand type\(s\) for \+=?: '(?:int|float)' and 'str'": _step_is_text
        },
        fixed_by=(node_count.number_step,),
        examples=(
            example(
                "step_is_text_in_sum",
                Replace(NODE, "self.counter_ += 1", "self.counter_ = self.counter_ + '1'"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
            example(
                "step_is_text",
                Replace(NODE, "self.counter_ += 1", "self.counter_ += '1'"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
        ),
    ),
    _node(
        "plus_reversed",
        "counter",
        msg("=+ is written instead of +="),
        msg("x =+ 1 sets x to +1; x += 1 adds one to it."),
        msg("Write {name} += {step}"),
        links.PYTHON_CLASSES,
        behind={"run.constant_counter": _plus_reversed, "run.wrong_step": _plus_reversed},
        fixed_by=(node_count.plus,),
        examples=(
            example(
                "plus_reversed_below_a_slow_timer",
                Replace(NODE, "create_timer(1.0,", "create_timer(10,"),
                Replace(NODE, "self.counter_ += 1", "self.counter_ =+ 1"),
                fails="run.output",
                also={"run.period": "run.wrong_period"},
                note="the third line shows it, after 30 s of ROS time",
            ),
            example(
                "counter_plus_is_plus",
                Replace(NODE, "self.counter_ += 1", "self.counter_ =+ 1"),
                fails="run.output",
                note="0, 1, 1, 1: =+ for +=",
            ),
        ),
    ),
    _node(
        "counter_reset",
        "counter",
        msg("The callback resets the counter"),
        msg(
            "A value that the callback sets is set again in each call. The first value belongs "
            "in __init__."
        ),
        msg("Move {name} = {value} to __init__."),
        whys={
            "local": msg(
                "{name} is a variable of {function}: each call creates it again, with the value "
                "{value}. Only an attribute (self.…) keeps its value from one call to the next."
            ),
            "outside": msg(
                "{name} is a variable of {function}: each call creates it again, with the value "
                "{value}."
            ),
            "file": SET_AGAIN,
            "file_there": SET_AGAIN,
            "finally": msg(
                "finally: runs in each call, also after a try without an error, so that {name} is "
                "{value} again each time."
            ),
            "if": msg("Each time the condition above this line is true, {name} starts again."),
            "always": ALWAYS,
            "always_there": ALWAYS,
            "helper": msg(
                "{callback} calls {function}, and each call sets {name} to {value} again."
            ),
            "modulo": MODULO,
            "modulo_line": MODULO,
        },
        fixes={
            "local": msg(
                "Write self.{name} = {value} in __init__ instead of this line, and self.{name} "
                "instead of {name} in {function}."
            ),
            "outside": msg(
                "Move {name} = {value} to the line above def {function}, with the same indentation as "
                "that def. Write {word} {name} as the first line of {function}."
            ),
            "declared": msg(
                "Move {name} = {value} to the line above def {function}, with the same indentation as "
                "that def."
            ),
            "file": msg(
                "Move {name} = {value} out of the class, to a line of its own below the imports."
            ),
            "file_there": SET_ALREADY,
            "finally": msg("Delete this line and the line finally: above it."),
            "if": ONLY_DELETE,
            "always": msg("Move {name} = {value} to __init__."),
            "there": SET_ALREADY,
            "always_there": SET_ALREADY,
            "helper": msg(
                "Set {name} only once: __init__ may do it, or call {function}, but {callback} must "
                "not. Delete the call of {function} from {callback}, or the line that sets {name} "
                "if {function} has other work to do for {callback}."
            ),
            "modulo": INSTEAD,
            "modulo_line": ONLY_DELETE,
        },
        deletes=("", "local", "if", "file_there", "there", "always", "always_there", "modulo_line"),
        behind={"run.constant_counter": _reset, "run.wrong_step": first_of(_reset_if, _modulo)},
        fixed_by=(node_worked_out.change("modulo"), node_count.kept, node_count.moved),
        examples=(
            example(
                "counter_reset",
                Replace(
                    NODE,
                    "self.get_logger().info('Hello time: ' + str(self.counter_))",
                    (
                        "self.counter_ = 0\n"
                        "        self.get_logger().info('Hello time: ' + str(self.counter_))"
                    ),
                ),
                fails="run.output",
            ),
            example(
                "counter_reset_with_type",
                Replace(NODE, LOG_LINE, f"        self.counter_: int = 0\n{LOG_LINE}"),
                fails="run.output",
            ),
            example(
                "counter_starts_again",
                Replace(
                    NODE,
                    "self.counter_ += 1",
                    "self.counter_ += 1\n"
                    "        if self.counter_ == 5:\n"
                    "            self.counter_ = 0",
                ),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "copy_increased",
        "counter",
        msg("A copy of the counter is increased"),
        msg(
            "A variable that gets the value of {attribute} is a copy: adding to it does not change "
            "{attribute}."
        ),
        msg("Write {written} instead of {name}."),
        behind={"run.constant_counter": _copy_increased},
        fixed_by=(lines.written,),
        examples=(
            example(
                "copy_increased",
                Replace(NODE, LOG_LINE, f"        count = self.counter_\n{LOG_LINE}"),
                Replace(NODE, "str(self.counter_)", "str(count)"),
                Replace(NODE, "self.counter_ += 1", "count += 1"),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "counter_not_increased",
        "counter",
        msg("Nothing is added to the counter"),
        msg("The callback logs the counter; without += every line shows the same number."),
        msg("Add to the callback, after the log line: {name} += {step}"),
        whys={
            "nothing": msg(
                "{name} works out a value and keeps it nowhere, so {attribute} stays as it is."
            )
        },
        fixes={
            "nothing": INSTEAD,
            "outer": msg(
                "Write {word} {name} as the first line of {function}, and after the log line: "
                "{name} += {step}"
            ),
            "last_line": msg(
                "Write as the last line of {function}, in the same column as its first line: {name} += "
                "{step}"
            ),
            "one_line": msg(
                "Write what is behind the colon of this def on a line of its own below it, with 4 more "
                "spaces before it than def has. Below that, in the same column: {name} += {step}"
            ),
            "returned": msg(
                "Delete the word return before the call that logs, and write on a line of its own below "
                "that call: {name} += {step}"
            ),
        },
        behind={"run.constant_counter": _not_increased},
        fixed_by=(lines.written, node_count.step),
        examples=(
            example(
                "sum_kept_nowhere_in_a_method",
                Replace(NODE, "self.counter_ += 1", "self.increase()"),
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    def increase(self):\n        self.counter_ + 1\n\n    def timer_callback",
                ),
                fails="run.output",
            ),
            example(
                "counter_constant_in_a_branch",
                Replace(NODE, "        self.counter_ += 1\n", ""),
                Replace(
                    NODE,
                    "        self.get_logger().info('Hello time: ' + str(self.counter_))\n",
                    "        if self.counter_ == 0:\n"
                    "            self.get_logger().info('Hello time: 0')\n"
                    "        else:\n"
                    "            self.get_logger().info('Hello time: ' + str(self.counter_))\n",
                ),
                fails="run.output",
            ),
            example(
                "counter_constant_in_a_def_of_one_line",
                Replace(
                    NODE,
                    "    def timer_callback(self):\n"
                    '        """Say hello once; the timer calls this for as long as the node spins."""\n'
                    "        self.get_logger()",
                    "    def timer_callback(self): self.get_logger()",
                ),
                Replace(NODE, "        self.counter_ += 1\n", ""),
                fails="run.output",
            ),
            example(
                "counter_constant_in_a_return",
                Replace(NODE, "        self.counter_ += 1\n", ""),
                Replace(
                    NODE, "        self.get_logger().info", "        return self.get_logger().info"
                ),
                fails="run.output",
            ),
            example(
                "counter_constant",
                Replace(NODE, "        self.counter_ += 1\n", ""),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "counter_multiplied",
        "counter",
        msg("The counter is multiplied"),
        msg("x *= 2 doubles x. A counter that starts at 0 stays at 0."),
        msg("Write {name} += {step}"),
        behind={"run.constant_counter": _multiplied},
        fixed_by=(_added_instead,),
        examples=(
            example(
                "counter_doubled",
                Replace(NODE, "self.counter_ += 1", "self.counter_ *= 2"),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "adds_twice",
        "counter",
        msg("The counter is increased more than once in the callback"),
        msg("Each += counts."),
        msg("Keep only one {name} += {step}."),
        fixes={
            "line": msg("Delete line {line} ({name}): another line adds to the counter already.")
        },
        behind={
            "run.wrong_step": first_of(_adds_twice, _added_elsewhere),
            "run.wrong_start": _added_elsewhere,
        },
        fixed_by=(node_count.twice, node_worked_out.change("doubled"), lines.deleted),
        deletes=("", "line"),
        examples=(
            example(
                "adds_in_helper_too",
                Replace(NODE, LOG_AND_STEP, "        self.show()\n        self.counter_ += 1\n"),
                Replace(
                    NODE, "\n\ndef main(", f"\n    def show(self):\n{LOG_AND_STEP}\n\ndef main("
                ),
                fails="run.output",
            ),
            example(
                "adds_twice",
                Replace(
                    NODE, "self.counter_ += 1", "self.counter_ += 1\n        self.counter_ += 1"
                ),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "other_step",
        "counter",
        msg("A different number is added to the counter"),
        msg("The number after += is what each line increases by."),
        msg("Write {name} += {step}"),
        fixes={"written": INSTEAD},
        behind={
            "run.wrong_step": first_of(_other_step, _step_worked_out),
            "run.constant_counter": _step_worked_out,
        },
        fixed_by=(node_count.by, node_worked_out.change("step")),
        examples=(
            example(
                "counts_by_two",
                Replace(NODE, "self.counter_ += 1", "self.counter_ += 2"),
                fails="run.output",
            ),
            example(
                "counts_down",
                Replace(NODE, "self.counter_ += 1", "self.counter_ -= 1"),
                fails="run.output",
            ),
        ),
    ),
)
