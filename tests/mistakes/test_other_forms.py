"""Mistakes in nodes of another form are recognised, and fixed back to the right node."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, cast

import pytest

from grader.course.assignment import Assignment
from grader.mistakes.catalogue import fixes_for
from grader.mistakes.fixes.case import Case, Finding
from grader.mistakes.placeholders import placeholder_values
from grader.package.edit.files import Files
from grader.package.intake.model import SourceFile, Submission
from grader.package.source.node import read_node
from grader.package.source.python import can_parse
from grader.report.model import CheckResult, Where
from grader.run.probe_link import LogRecord
from grader.run.run import Run
from grader.verdict.checks.faults import line_of as line_in
from grader.verdict.diagnose import Diagnosis, diagnose
from grader.verdict.outcome import Failed
from tests.fixing import first_fix
from tests.marking import ASSIGNMENT
from tests.mistakes.other_forms import (
    CASES,
    END,
    FORMS,
    HEAD,
    OTHER,
    RIGHT,
    SLIPS,
    START,
    STEP,
    Slip,
    changed,
    filled,
    lines_with,
    with_slip,
)
from tests.static_bench import NODE

if TYPE_CHECKING:
    from grader.verdict.evidence import Evidence

CALL = """\
Traceback (most recent call last):
  File "/ws/build/my_robot_controller/{path}", line {line}, in somewhere
"""


@dataclass
class StandIn:
    """The part of the evidence that a diagnosis looks at."""

    assignment: Assignment
    submission: Submission
    run: Run
    results: dict[str, CheckResult] = field(default_factory=dict)


def submitted(files: Mapping[str, str]) -> Submission:
    return Submission(
        path=Path("/nowhere"),
        name="other",
        origin="directory",
        modes="recorded",
        sha256="",
        root=".",
        files=tuple(SourceFile(p, "file", 0o755, text.encode()) for p, text in files.items()),
    )


def diagnosis_of(slip: Slip, form: str, files: Mapping[str, str]) -> Diagnosis:
    """Return the diagnosis of files whose run has shown the symptom."""
    path, line = next(lines_with(slip.at, files), (NODE, 1)) if slip.at else (NODE, 1)
    shown = CALL.format(path=path, line=line) if slip.at else ""
    run = Run(command="ros2 run", transcript=f"{shown}{slip.error}\n")
    seen = StandIn(ASSIGNMENT, submitted(files), run)
    failed = Failed(
        slip.symptom,
        expected="a line",
        actual="no line",
        where=Where(file=NODE),
        params={"text": shown_text(slip, form)} if slip.symptom == "run.wrong_text" else {},
        words={**placeholder_values(ASSIGNMENT), "wanted": ASSIGNMENT.node_name},
    )
    return diagnose(failed, cast("Evidence", seen))


def shown_text(slip: Slip, form: str) -> str:
    """Return the line that a node with this mistake logs."""
    value = filled("{counter}", form)
    lines = {
        "node.f_prefix": f"Hello time: {{{value}}}",
        "node.text_without_number": "Hello time: ",
    }
    return lines.get(slip.mistake, "Helo time: 0")


def slips_of(form: str) -> list[Slip]:
    """Return the slips that can be made in a node of this form."""
    return [slip for slip, one in CASES if one == form]


@pytest.mark.parametrize("form", FORMS)
def test_a_mistake_is_recognised_in_the_file_that_has_it(
    form: str, subtests: pytest.Subtests
) -> None:
    for slip in slips_of(form):
        with subtests.test(slip.mistake):
            files = with_slip(slip, form)
            diagnosis = diagnosis_of(slip, form, files)
            assert diagnosis.mistakes[0].id == slip.mistake
            (edited,) = [path for path, text in files.items() if text != FORMS[form][path]]
            assert diagnosis.where is not None
            if diagnosis.where.line is not None:
                assert diagnosis.where.file == edited


@pytest.mark.parametrize("form", FORMS)
def test_the_fix_restores_the_right_node(form: str, subtests: pytest.Subtests) -> None:
    for slip in slips_of(form):
        with subtests.test(slip.mistake):
            is_restored(slip, form)


def is_restored(slip: Slip, form: str) -> None:
    made = with_slip(slip, form)
    diagnosis = diagnosis_of(slip, form, made)
    where, params = diagnosis.where or Where(file=NODE), diagnosis.mistakes[0].params
    finding = Finding("run.output", slip.mistake, params, where.file, where.line)
    files = Files.of(submitted(made))
    found = [Case(files, one, ASSIGNMENT) for one in (Finding("run.output", slip.mistake), finding)]
    new = next(filter(None, (first_fix(case, fixes_for(case.finding)) for case in found)), None)
    assert new is not None
    fixed = {path: (new.data(path) or b"").decode() for path in FORMS[form]}
    assert all(can_parse(text.encode()) for text in fixed.values())
    if slip.code:
        assert filled(slip.code, form) in "".join(fixed.values())
    else:
        assert fixed == FORMS[form]


def test_the_line_that_logged_a_record_is_shown_in_the_file_of_the_class() -> None:
    seen = StandIn(ASSIGNMENT, submitted(FORMS["class imported"]), Run(command="ros2 run"))
    for path, place in ((OTHER, Where(file=OTHER, line=18)), ("x/y.py", Where(file=NODE))):
        record = LogRecord(20, "my_first_node", "Hello time: 0", "hello", f"/ws/{path}", 18, 0)
        assert line_in(cast("Evidence", seen), record) == place


def test_a_node_that_is_not_derived_from_node_is_found_before_another_module_with_one() -> None:
    text = changed(
        RIGHT, ("(Node):", ":"), ("import rclpy\n", "import rclpy\nfrom . import hello\n")
    )
    source = read_node({NODE: text.encode(), OTHER: HEAD.encode()}.get, NODE, "main")
    assert source is not None
    assert source.module.path == NODE


def test_modules_that_import_each_other_are_read_once() -> None:
    files = {
        NODE: f"from .hello import MyFirstNode\n\n\ndef main({END}",
        OTHER: f"from . import my_first_node\n{HEAD}",
    }
    source = read_node({path: text.encode() for path, text in files.items()}.get, NODE, "main")
    assert source is not None
    assert source.paths == [OTHER, NODE]


def test_an_attribute_of_another_object_is_not_taken_for_the_counter() -> None:
    text = changed(RIGHT, (START, "        options = Node.options\n        options.limit = 0\n"))
    files = Files.of(submitted({NODE: text}))
    case = Case(files, Finding("run.output", "node.attribute_not_set"), ASSIGNMENT)
    new = first_fix(case, fixes_for(case.finding))
    assert new is not None
    assert b"        options.limit = 0\n" in (new.data(NODE) or b"")
    assert START.encode() in (new.data(NODE) or b"")


RELATED = "class Base(Node):\n    pass\n\n\nclass MyFirstNode(Base):"


def test_classes_that_share_the_code_of_the_node_are_not_fixed() -> None:
    text = changed(RIGHT, ("class MyFirstNode(Node):", RELATED), (STEP, ""))
    files = Files.of(submitted({NODE: text}))
    case = Case(files, Finding("run.output", "node.counter_not_increased"), ASSIGNMENT)
    assert first_fix(case, fixes_for(case.finding)) is None


def test_of_two_nodes_the_one_that_main_creates_is_examined() -> None:
    other = HEAD[HEAD.index("class ") :].replace("MyFirstNode", "Other")
    text = changed(RIGHT, (STEP, "")).replace("class MyFirst", f"{other}class MyFirst")
    source = read_node({NODE: text.encode()}.get, NODE, "main")
    assert source is not None
    assert source.node_class is not None
    assert source.node_class.name == "MyFirstNode"


@pytest.mark.parametrize("form", FORMS)
def test_a_right_node_is_never_changed(form: str) -> None:
    files = Files.of(submitted(FORMS[form]))
    for slip in SLIPS:
        case = Case(files, Finding("run.output", slip.mistake), ASSIGNMENT)
        assert first_fix(case, fixes_for(case.finding)) is None, slip.mistake
