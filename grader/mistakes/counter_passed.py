"""The mistake of a counter whose value is given to a function that adds to its own parameter."""

from __future__ import annotations

import ast
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.counted import counter_in
from grader.mistakes.example import NODE, STEP_LINE, example
from grader.mistakes.fixes import node_count
from grader.mistakes.fixes.case import Case
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.files import Files
from grader.package.edit.tree import Replace
from grader.package.source.counter import adds_to
from grader.package.source.module import Function, code_of
from grader.package.source.names import calls_in, dotted, own_name


def _passed(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a call that gives the counter to a function which adds to its parameter."""
    source, counter = suspect.source, counter_in(suspect)
    callback = source.callback
    if counter is None or callback is None or counter.added or counter.set:
        return None
    for call, name in calls_in(callback):
        module = source.module_of(call)
        function = source.methods.get(own_name(call.func)) or module.functions.get(name)
        if function is None:
            continue
        used = not isinstance(module.parents.get(call), ast.Expr)
        parameters = [given.arg for given in function.args.args if given.arg != "self"]
        for parameter, value in zip(parameters, call.args):
            added = _adds(function, parameter)
            if dotted(value) != counter.name or added is None:
                continue
            written = f"{counter.name} += {suspect.output.step}"
            back = [n.value for n in ast.walk(function) if isinstance(n, ast.Return) and n.value]
            sums = [dotted(value) == parameter for value in back]
            if used and any(sums):
                continue
            if not used and sums and all(sums):
                written = f"{counter.name} = {module.text.code(call)}"
            elif not used and (len(code_of(function)) > 1 or back):
                return None  # (its call may do more than add)
            found = suspect.finding(
                "counter_passed",
                call,
                name=counter.name,
                method=function.name,
                number=parameter,
                line=added.lineno,
                written=written,
            )
            return replace(found, variant="used") if used else found
    return None


def _adds(function: Function, name: str) -> ast.stmt | None:
    """Return the statement of a function that adds to a name."""
    found = [n for n in ast.walk(function) if isinstance(n, ast.stmt) and adds_to(n, name)]
    return found[0] if found else None


def _changed_here(case: Case) -> Files | None:
    """Change the counter in the place of the call."""
    module, line, new = case.module, case.finding.line, case.finding.params.get("written")
    found = [
        n
        for n in (module.nodes if module is not None else ())
        if isinstance(n, ast.Expr) and isinstance(n.value, ast.Call) and n.lineno == line
    ]
    if module is None or len(found) != 1 or not new:
        return None
    return case.changed(module, module.text.swap(found[0], str(new)))


_node = Family("node", links.PYTHON_CLASSES)
KINDS = (
    _node(
        "counter_passed",
        "counter",
        msg("A function adds to its own parameter, and not to the counter"),
        msg(
            "{method} gets only the value of {name}. Line {line} adds to the parameter {number}, "
            "which is gone when the function ends: {name} stays as it is."
        ),
        msg("Write {written} instead of this line."),
        fixes={"used": msg("Write in {callback}, below the line that logs: {written}")},
        behind={"run.constant_counter": _passed},
        fixed_by=(_changed_here, node_count.step),
        examples=(
            example(
                "counter_given_to_function",
                Replace(
                    NODE,
                    "class MyFirstNode",
                    "def add_one(number):\n    number += 1\n\n\nclass MyFirstNode",
                ),
                Replace(NODE, STEP_LINE, "        add_one(self.counter_)\n"),
                fails="run.output",
            ),
            example(
                "counter_given_to_function_with_a_docstring",
                Replace(
                    NODE,
                    "class MyFirstNode",
                    'def count_up(number):\n    """Raise the number by one."""\n    number += 1\n\n\n'
                    "class MyFirstNode",
                ),
                Replace(NODE, STEP_LINE, "        count_up(self.counter_)\n"),
                fails="run.output",
            ),
            example(
                "counter_given_to_function_that_returns_the_old_value",
                Replace(
                    NODE,
                    "class MyFirstNode",
                    "def post_increment(value):\n    before = value\n    value += 1\n"
                    "    return before\n\n\nclass MyFirstNode",
                ),
                Replace(NODE, "str(self.counter_)", "str(post_increment(self.counter_))"),
                Replace(NODE, STEP_LINE, ""),
                fails="run.output",
            ),
            example(
                "counter_of_method_not_kept",
                Replace(NODE, STEP_LINE, "        self.add_one(self.counter_)\n"),
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    def add_one(self, number):\n"
                    "        number = number + 1\n"
                    "        return number\n\n"
                    "    def timer_callback",
                ),
                fails="run.output",
            ),
        ),
    ),
)
