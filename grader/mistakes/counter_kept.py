"""Mistakes in the counter: a result that is dropped, ++ in a text, and next() called too often."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import LOG, NODE, STEP_LINE, example
from grader.mistakes.fixes import lines, node_words, node_worked_out
from grader.mistakes.fixes.case import Case
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect, first_of
from grader.mistakes.worked_out import INSTEAD, change_of, worked_out
from grader.package.edit.files import Files
from grader.package.edit.text import indent_of
from grader.package.edit.tree import Replace
from grader.package.source.counter import changes_of, outer_word, parts_of_callback
from grader.package.source.named_tuples import is_named_tuple
from grader.package.source.names import called_name, dotted
from grader.package.source.place import statement_at
from grader.package.source.plain_counter import plain_start

IMPORTS = "import rclpy\nfrom"
STATE = """\
@dataclass(frozen=True)
class State:
    seconds: int = 0

    def next(self):
        return State(self.seconds + 1)


class MyFirstNode"""


def _prefix(suspect: Suspect) -> RecognisedMistake | None:
    """Look for ++ or -- before a name in an expression, where nothing else changes the name."""
    source = suspect.source
    for part in parts_of_callback(source):
        for node in ast.walk(part):
            inner = node.operand if isinstance(node, ast.UnaryOp) else None
            if not isinstance(node, ast.UnaryOp) or not isinstance(inner, ast.UnaryOp):
                continue
            name, both = dotted(inner.operand), (type(node.op), type(inner.op))
            if not name or both not in ((ast.UAdd, ast.UAdd), (ast.USub, ast.USub)):
                continue
            first = plain_start(source, name)
            if first is None or changes_of(source, name):
                continue
            if isinstance(source.module_of(node).parents.get(node), ast.Expr):
                continue  # (another mistake says how the sum is kept)
            if "." not in name and outer_word(source, part, name):
                continue  # (such a variable has to be declared, too)
            signs = "++" if isinstance(node.op, ast.UAdd) else "--"
            found = suspect.finding("prefix_increment", node, name=name, form=signs)
            words = {**found.words, "first": str(first.at.lineno)}
            right = first.number == suspect.output.start
            return replace(found, words=words, variant="" if right else "start")
    return None


def _counted_below(case: Case) -> Files | None:
    """Delete the signs, and count below the call that logs, if the signs are in that call."""
    node, module, given = case.node, case.module, case.finding.params
    name, signs = str(given.get("name", "")), str(given.get("form", ""))
    first = plain_start(node, name) if node is not None else None
    statement = statement_at(module, case.finding.line) if module is not None else None
    if node is None or module is None or first is None or not isinstance(statement, ast.Expr):
        return None
    output, text, code = case.assignment.output, module.text, module.text.code(statement)
    old = f"{signs}{name}"
    if statement.value is not node.log_call or code.count(signs) != 1 or code.count(old) != 1:
        return None
    if node.module_of(first.at) is not module or "\n" in code:
        return None
    below = f"{indent_of(text.line(statement.lineno))}{name} += {output.step}"
    starts = [] if first.number == output.start else [text.swap(first.at, str(output.start))]
    return case.changed(
        module,
        text.swap(statement, code.replace(old, name)),
        text.before(statement.lineno + 1, below),
        *starts,
    )


def _dropped(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a call whose result has to be assigned to what it is called on or gets."""
    change = change_of(suspect, "kept")
    if change is None:
        return None
    called = change.written.removesuffix(change.name).removesuffix(" = ")
    found = suspect.finding("result_dropped", change.at, name=change.name, written=change.written)
    return replace(found, words={**found.words, "attribute": called})


def _set_in_tuple(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A field of a named tuple is set on the line."""
    del match
    statement = statement_at(raised.module, raised.line)
    if not isinstance(statement, ast.AugAssign) or not isinstance(statement.target, ast.Attribute):
        return None
    on, code = dotted(statement.target.value), raised.module.text.code(statement)
    made = node_words.values_of(raised.source, statement.target.value)
    classes = {c.name for m in raised.source.modules for c in m.classes if is_named_tuple(c)}
    classes |= {
        target.id
        for n in raised.module.tree.body
        if isinstance(n, ast.Assign)
        and isinstance(n.value, ast.Call)
        and called_name(n.value) == "namedtuple"
        for target in n.targets
        if isinstance(target, ast.Name)
    }
    is_tuple = made and all(isinstance(v, ast.Call) and called_name(v) in classes for v in made)
    if not on or not is_tuple or not isinstance(statement.op, ast.Add) or "\n" in code:
        return None
    field, value = statement.target.attr, raised.module.text.code(statement.value)
    written = f"{on} = {on}._replace({field}={on}.{field} + {value})"
    found = raised.finding("named_tuple_set", at=statement, name=code, written=written)
    return replace(found, words={**found.words, "attribute": on})


def _replace_dropped(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a line that only calls _replace(): it changes nothing, whatever else the file does."""
    for part in parts_of_callback(suspect.source):
        module = suspect.source.module_of(part)
        for node in ast.walk(part):
            call = node.value if isinstance(node, ast.Expr) else None
            if not isinstance(node, ast.Expr) or not isinstance(call, ast.Call):
                continue
            if not isinstance(call.func, ast.Attribute):
                continue
            on, code = dotted(call.func.value), module.text.code(call)
            if call.func.attr == "_replace" and on and "(" not in on and "\n" not in code:
                found = suspect.finding("result_dropped", node, name=code, written=f"{on} = {code}")
                return replace(found, words={**found.words, "attribute": on})
    return None


def _taken(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a line that takes a number from the iterator, which is not logged."""
    change = change_of(suspect, "taken")
    if change is None:
        return None
    found = suspect.finding("number_taken", change.at, name=change.name)
    return replace(
        found, words={**found.words, "lines": change.form}, variant="uses" if change.form else ""
    )


def _fresh(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a call whose function counts in a parameter that has a default."""
    change = change_of(suspect, "fresh")
    if change is not None:
        words = {"number": change.form, "attribute": change.written, "line": str(change.at.lineno)}
        found = suspect.finding("default_counts", change.at, name=change.name)
        return replace(found, words={**found.words, **words, "start": str(suspect.output.start)})
    change = change_of(suspect, "given")
    if change is None:
        return None
    found = suspect.finding("default_counts", change.at, name=change.name, written=change.written)
    return replace(found, words={**found.words, "number": change.form}, variant="given")


def _next_twice(suspect: Suspect) -> RecognisedMistake | None:
    """Look for several calls of next() in a function, where one gives the right lines."""
    change = change_of(suspect, "next")
    if change is None:
        return None
    found = suspect.finding("next_twice", change.at, name=change.name, written=change.written)
    around = suspect.source.function_around(change.at)
    function = around.name if around is not None else ""
    words = {**found.words, "function": function, "lines": change.form}
    return replace(found, words=words)


_node = Family("node", links.PYTHON_CLASSES)
KINDS = (
    _node(
        "prefix_increment",
        "counter",
        msg("++ or -- is written before a name"),
        msg(
            "Python reads {form}{name} as two signs before {name}. They add nothing: {name} stays as "
            "it is."
        ),
        msg(
            "Write {name} instead of {form}{name}, and below the call that logs, as a line of its own: "
            "{name} += {step}"
        ),
        fixes={
            "start": msg(
                "Write {name} instead of {form}{name}. Write below the call that logs, as a line of its "
                "own: {name} += {step}. In line {first}, write {start} as the first value of {name}."
            )
        },
        behind={"run.constant_counter": _prefix},
        fixed_by=(_counted_below,),
        examples=(
            example(
                "increment_sign_in_text",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = -1"),
                Replace(NODE, LOG, "self.get_logger().info(f'Hello time: {++self.counter_}')"),
                Replace(NODE, STEP_LINE, ""),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "result_dropped",
        "counter",
        msg("The result of a call is not kept"),
        msg(
            "{name} returns a new value and leaves {attribute} as it is. This line keeps the new value "
            "nowhere."
        ),
        INSTEAD,
        behind={
            "run.constant_counter": first_of(_dropped, _replace_dropped),
            "run.wrong_text": _dropped,
        },
        fixed_by=(node_worked_out.change("kept"),),
        examples=(
            example(
                "new_state_not_kept",
                Replace(NODE, IMPORTS, f"from dataclasses import dataclass\n\n{IMPORTS}"),
                Replace(NODE, "class MyFirstNode", STATE),
                Replace(NODE, "self.counter_ = 0", "self.state = State()"),
                Replace(NODE, "str(self.counter_)", "str(self.state.seconds)"),
                Replace(NODE, "self.counter_ += 1", "self.state.next()"),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "next_twice",
        "counter",
        msg("next() is called more than once for a line"),
        msg(
            "Each call of next() takes another number from the iterator. {function} calls {name} more "
            "than once (lines: {lines})."
        ),
        msg(
            "Call next() once: write {written} as a line of its own at the start of {function}, and "
            "number instead of each {name} below it."
        ),
        fixes={"line": msg("Delete this line: it takes a number that is not logged.")},
        behind=dict.fromkeys(
            ("run.wrong_start", "run.wrong_step"),
            first_of(_next_twice, worked_out("next_twice", "next_line", variant="line")),
        ),
        whys={
            "line": msg(
                "Each call of next() takes another number from the iterator, also this one."
            )
        },
        fixed_by=(node_worked_out.change("next", "next_line"),),
        deletes=("line",),
        examples=(
            example(
                "next_called_twice",
                Replace(NODE, IMPORTS, f"import itertools\n\n{IMPORTS}"),
                Replace(NODE, "self.counter_ = 0", "self.counter_ = itertools.count()"),
                Replace(
                    NODE,
                    LOG,
                    "if next(self.counter_) >= 0:\n"
                    "            self.get_logger().info(f'Hello time: {next(self.counter_)}')",
                ),
                Replace(NODE, STEP_LINE, ""),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "named_tuple_set",
        "counter",
        msg("A field of a named tuple is set"),
        msg(
            "{attribute} is a named tuple, and a tuple cannot be changed. _replace() makes a new one."
        ),
        INSTEAD,
        raised={r"AttributeError: can't set attribute": _set_in_tuple},
        fixed_by=(lines.written,),
        examples=(
            example(
                "field_of_named_tuple_set",
                Replace(NODE, IMPORTS, f"from collections import namedtuple\n\n{IMPORTS}"),
                Replace(
                    NODE,
                    "class MyFirstNode",
                    "State = namedtuple('State', 'n')\n\n\nclass MyFirstNode",
                ),
                Replace(NODE, "self.counter_ = 0", "self.state = State(0)"),
                Replace(NODE, "str(self.counter_)", "str(self.state.n)"),
                Replace(NODE, "self.counter_ += 1", "self.state.n += 1"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
        ),
    ),
    _node(
        "number_taken",
        "counter",
        msg("A number is taken from the iterator before the first line"),
        msg(
            "next() does not only look: it takes the number out. The first line gets the one after it."
        ),
        msg("Delete this line: {name}"),
        fixes={"uses": msg("Delete this line and what uses its number (lines {lines}): {name}")},
        behind={"run.wrong_start": _taken},
        fixed_by=(node_worked_out.change("taken"),),
        examples=(
            example(
                "first_number_looked_at",
                Replace(NODE, IMPORTS, f"import itertools\n\n{IMPORTS}"),
                Replace(
                    NODE,
                    "self.counter_ = 0",
                    "self.counter_ = itertools.count()\n"
                    "        first = next(self.counter_)\n"
                    "        if first != 0:\n"
                    "            raise ValueError('has to start at 0')",
                ),
                Replace(NODE, "str(self.counter_)", "str(next(self.counter_))"),
                Replace(NODE, STEP_LINE, ""),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "default_counts",
        "counter",
        msg("A parameter begins with its default value in each call"),
        msg(
            "The parameter {number} is a new variable in each call: a call that gives it no value "
            "begins with the default again. What the function adds to it is gone when it ends."
        ),
        msg(
            "Keep the count on the node. In __init__, write {attribute} = {start} below "
            "super().__init__. In line {line}, write {attribute} instead of {name}. Below the statement "
            "that logs, write {attribute} += {step}"
        ),
        fixes={"given": msg("Give the counter to the call: write {written} instead of {name}.")},
        whys={
            "given": msg(
                "A call that gives the parameter {number} no value uses its default, each time the same."
            )
        },
        behind=dict.fromkeys(("run.constant_counter", "run.wrong_step"), _fresh),
        fixed_by=(node_worked_out.change("fresh", "given"),),
        examples=(
            example(
                "default_as_counter",
                Replace(
                    NODE,
                    "class MyFirstNode",
                    "def counted(n=0):\n    now = n\n    n = n + 1\n    return now\n\n\n"
                    "class MyFirstNode",
                ),
                Replace(NODE, "        self.counter_ = 0\n", ""),
                Replace(NODE, "str(self.counter_)", "str(counted())"),
                Replace(NODE, STEP_LINE, ""),
                fails="run.output",
            ),
            example(
                "default_of_helper_used",
                Replace(
                    NODE,
                    "class MyFirstNode",
                    "def one_more(n=0):\n    return n + 1\n\n\nclass MyFirstNode",
                ),
                Replace(NODE, "self.counter_ += 1", "self.counter_ = one_more()"),
                fails="run.output",
            ),
        ),
    ),
)
