"""Loading an assignment: errors with file and line."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from grader.base.errors import AssignmentError
from grader.course.assignment import Assignment
from grader.course.load import load_assignment
from grader.course.shorthands import SHORTHANDS
from grader.verdict.checks.all import CHECKS

REAL = Path(__file__).resolve().parent.parent / "lab/course/hello_time/assignment.yaml"
GOOD = """\
schema: 1
id: hello_time
title: "Hello time"
package: my_robot_controller
node_file: my_first_node.py
node_name: my_first_node
executable: test_node
target: my_robot_controller.my_first_node:main
output:
  text: "Hello time: {n}"
  period: 1.0
limits:
  run_seconds: 20
checks:
  - {id: package.found, points: 5}
  - {id: run.output, points: 10}
"""


def load(tmp_path: Path, text: str | bytes, hidden: str | None = None) -> Assignment:
    file = tmp_path / "assignment.yaml"
    file.write_bytes(text if isinstance(text, bytes) else text.encode())
    secret = None
    if hidden is not None:
        secret = tmp_path / "hidden.yaml"
        secret.write_text(hidden)
    limits = ("run_seconds", "build_seconds")
    return load_assignment(file, hidden=secret, known_checks=CHECKS, known_limits=limits)


def refused(tmp_path: Path, text: str | bytes, hidden: str | None = None) -> str:
    """Return the error message without the folder."""
    with pytest.raises(AssignmentError) as caught:
        load(tmp_path, text, hidden)
    assert caught.value.exit_status == 2
    return str(caught.value).replace(f"{tmp_path}/", "")


def changed(old: str, new: str) -> str:
    assert GOOD.count(old) == 1, old
    return GOOD.replace(old, new)


def test_the_course_assignment_loads_and_is_worth_100_points() -> None:
    assignment = load_assignment(REAL)
    assert assignment.max_score == 100
    assert {use.kind for use in assignment.checks} <= set(CHECKS)
    assert assignment.output.line(3) == "Hello time: 3"


def test_checks_without_a_kind_get_it_and_their_parameters_from_the_file() -> None:
    uses = {use.id: use for use in load_assignment(REAL).checks}
    text = "Hello time: {n}"
    assert {name: (uses[name].kind, uses[name].with_) for name in SHORTHANDS} == {
        "run.node_name": ("graph.node_name", {"name": "my_first_node"}),
        "run.output": ("log.counts", {"text": text, "start": 0, "step": 1}),
        "run.logger": ("log.logger", {"text": text}),
        "run.period": ("log.period", {"text": text, "period": 1.0}),
    }
    assert uses["run.interrupt"].with_ == {}
    for name, short in SHORTHANDS.items():
        model = CHECKS[short.kind].parameters
        assert model is not None
        model.model_validate(uses[name].with_, strict=True)


def test_defaults_are_filled_in(tmp_path: Path) -> None:
    assignment = load(tmp_path, GOOD)
    assert assignment.output.start == 0
    assert assignment.modes == "accept-unknown"
    assert assignment.checks[0].visibility == "visible"
    assert assignment.limits == {"run_seconds": 20}


def test_a_misspelt_key_is_reported_once_with_its_line_and_a_suggestion(tmp_path: Path) -> None:
    output = refused(tmp_path, changed("period:", "perid:"))
    assert output == "assignment.yaml:11:3: unknown key 'perid' (did you mean 'period'?)"
    output = refused(tmp_path, changed("package: my", "pakcage: my"))
    assert output == "assignment.yaml:4:1: unknown key 'pakcage' (did you mean 'package'?)"
    output = refused(tmp_path, changed("found, points", "found, point"))
    assert output == "assignment.yaml:15:25: unknown key 'point' (did you mean 'points'?)"


def test_all_errors_are_reported_at_once_in_line_order(tmp_path: Path) -> None:
    text = changed("period: 1.0", "period: fast").replace("schema: 1", "schema: 3")
    lines = refused(tmp_path, text).splitlines()
    assert [line.split(":")[1] for line in lines] == ["1", "11"]


@pytest.mark.parametrize(
    ("old", "new", "line", "words"),
    [
        ("id: run.output", "id: run.ouptut", 16, "did you mean 'run.output'?"),
        ("id: run.output", "id: package.found", 16, "twice"),
        ("period: 1.0", "period: 1.0\n  period: 2.0", 12, "twice (first: line 11)"),
        ("{n}", "n", 10, "exactly once, not 0"),
        ("{n}", "{n} {n}", 10, "exactly once, not 2"),
        ("{n}", r"{n}\n", 10, "one line"),
        ("{n}", r"{n}\e[0m", 10, "control characters"),
        ("id: hello_time", "id: ../keys", 2, "id must be"),
        ("package: my_robot_controller", "package: my-robot", 4, "package must be"),
        ("package: my_robot_controller", "package: test", 4, "'test'"),
        ("package: my_robot_controller", "package: class", 4, "keyword"),
        ("node_file: my_first_node.py", "node_file: ../node.py", 5, "node_file must be"),
        ("node_file: my_first_node.py", "node_file: my_first_node", 5, "node_file must be"),
        ("node_file: my_first_node.py", "node_file: my-node.py", 5, "node_file must be"),
        ("node_name: my_first_node", "node_name: my-node", 6, "node_name must be"),
        ("executable: test_node", "executable: test node", 7, "executable must be"),
        (":main", "", 8, "target must be"),
        (".my_first_node:main", "/my_first_node:main", 8, "target must be"),
        ('"Hello time"', "3", 3, "title must be text"),
        ('"Hello time"', '" "', 3, "title is empty"),
        ("period: 1.0", "period: true", 11, "period must be a number"),
        ("period: 1.0", "period: 0", 11, "above 0"),
        ("period: 1.0", "period: .inf", 11, "finite"),
        ("period: 1.0", "ticks: 1", 11, "at least 2"),
        ("period: 1.0", "ticks: 2.5", 11, "whole number"),
        ("period: 1.0", "step: 0", 11, "step must not be 0"),
        ("points: 10", "points: -1", 16, "at least 0"),
        ("points: 10", "points: 10, with: {start: 1}", 16, "'run.output' takes no parameters"),
        ("run.output", "a, check: log.counts, with: {text: '{n}'}", 16, "use run.output"),
        ("points: 10", "points: 10, visibility: hiden", 16, "did you mean 'hidden'?"),
        ("schema: 1", "schema: 3", 1, "schema must be 1 or 2"),
        ("run_seconds: 20", "run_secs: 20", 13, "did you mean 'run_seconds'?"),
        ("run_seconds: 20", "run_seconds: 0", 13, "above 0"),
        ("run_seconds: 20", "run_seconds: .nan", 13, "above 0"),
        ("title:", "title: {", 4, "not YAML"),
        ("title:", "title: a: ", 3, "needs quotes"),
        ("title:", "titel: &a x\nmore: *a\ntitle:", 3, "alias"),
        ("title:", "title: !!python/name:os.system", 3, "not YAML"),
        ("limits:", "limits: !!set", 12, "is not allowed"),
        ("limits:", "? [a]\n: 1\nlimits:", 12, "a key must be text"),
        ("schema: 1", "---\nschema: 1\n---", 3, "not YAML"),
        ("schema: 1", "schema: 1\nsha256: 00", 2, "unknown key 'sha256'"),
        ("schema: 1", "schema: 1\narchive: a/b.zip", 2, "archive must be a file name"),
        ("schema: 1", "schema: 1\narchive: '{name}.zip'", 2, "archive must be a file name"),
        ("schema: 1", "schema: 1\narchive: a.tar", 2, "ends in .zip"),
    ],
)
def test_a_wrong_value_is_reported_with_its_line(
    tmp_path: Path, old: str, new: str, line: int, words: str
) -> None:
    output = refused(tmp_path, changed(old, new))
    assert any(
        row.startswith(f"assignment.yaml:{line}:") and words in row for row in output.splitlines()
    ), output


def test_a_missing_key_is_reported_at_its_parent(tmp_path: Path) -> None:
    assert refused(tmp_path, changed("title: ", "# ")) == "assignment.yaml:1:1: missing key 'title'"
    output = refused(tmp_path, changed("{id: run.output, points: 10}", "{id: run.output}"))
    assert output == "assignment.yaml:16:5: missing key 'points'"


def test_checks_must_be_a_non_empty_list(tmp_path: Path) -> None:
    head = GOOD[: GOOD.index("checks:")]
    assert "checks is empty" in refused(tmp_path, head + "checks: []\n")
    assert "checks must be a list" in refused(tmp_path, head + "checks: {a: 1}\n")
    assert "must be a block" in refused(tmp_path, head + "checks: [run.output]\n")


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", ":1: the file is empty"),
        (b"# nothing\n", ":1: the file is empty"),
        (b"just text\n", ":1: the file must be a block"),
        (b"- a\n", ":1: the file must be a block"),
        (b"a: 1\nb: \xff\n", ":2:4: not UTF-8"),
        (b"a: 1\n\nb: \x00\n", ":3:4: a character that YAML forbids: U+0000"),
        (b"a: [" * 30_000, "1: "),
        (b"a: " + b"[" * 80 + b"]" * 80, ":1:54: more than 50 levels"),
        (b"a:\n\t- b\n", ":2:1: not YAML"),
        (b"#" * 1_000_001, ":1: larger than 1000 kB"),
    ],
)
def test_a_file_that_is_not_an_assignment_is_reported(
    tmp_path: Path, content: bytes, words: str
) -> None:
    assert words in refused(tmp_path, content)


def test_a_byte_order_mark_does_not_matter(tmp_path: Path) -> None:
    assert load(tmp_path, b"\xef\xbb\xbf" + GOOD.encode()).id == "hello_time"


def test_an_unreadable_path_is_reported(tmp_path: Path) -> None:
    fifo = tmp_path / "fifo"
    os.mkfifo(fifo)
    for path, words in [
        (tmp_path / "gone.yaml", "No such file"),
        (tmp_path, "cannot be read"),
        (fifo, "not a file"),
        (Path("a\0b"), "null"),
    ]:
        with pytest.raises(AssignmentError, match=words):
            load_assignment(path)


def test_hidden_checks_are_merged_and_marked_hidden(tmp_path: Path) -> None:
    hidden = (
        "checks:\n"
        "  - {id: run.period, points: 1}\n"
        "  - {id: run.logger, points: 1, visibility: after_due_date}\n"
    )
    assignment = load(tmp_path, GOOD + "hidden_checks: 2\n", hidden)
    assert [(use.id, use.visibility) for use in assignment.checks] == [
        ("package.found", "visible"),
        ("run.output", "visible"),
        ("run.period", "hidden"),
        ("run.logger", "after_due_date"),
    ]
    assert assignment.max_score == 17


@pytest.mark.parametrize(
    ("hidden", "output"),
    [
        ("checks: []\n", "assignment.yaml:17:1: hidden_checks is 1, but hidden.yaml has 0"),
        (
            "checks:\n- {id: run.output, points: 1}\n",
            "hidden.yaml:2:4: the check 'run.output' is listed twice",
        ),
        (
            "checks:\n- {id: run.perod, points: 1}\n",
            "hidden.yaml:2:4: unknown check 'run.perod' (did you mean 'run.period'?)",
        ),
        ("check: []\n", "hidden.yaml:1:1: unknown key 'check' (did you mean 'checks'?)"),
    ],
)
def test_wrong_hidden_checks_are_reported_with_their_file(
    tmp_path: Path, hidden: str, output: str
) -> None:
    assert refused(tmp_path, GOOD + "hidden_checks: 1\n", hidden) == output


def test_a_students_machine_has_no_hidden_checks_and_needs_none(tmp_path: Path) -> None:
    assert len(load(tmp_path, GOOD + "hidden_checks: 3\n").checks) == 2


def test_the_hash_depends_on_the_content_and_not_on_the_layout(tmp_path: Path) -> None:
    first = load(tmp_path, GOOD).sha256
    assert len(first) == 64
    assert (
        load(tmp_path, "# a comment\n" + GOOD.replace('"Hello time"', "Hello time")).sha256 == first
    )
    assert load(tmp_path, GOOD.replace("points: 10", "points: 11")).sha256 != first
    counted = GOOD + "hidden_checks: 1\n"
    secrets = [f"checks: [{{id: run.{name}, points: 1}}]\n" for name in ("period", "logger")]
    assert load(tmp_path, counted, secrets[0]).sha256 != load(tmp_path, counted, secrets[1]).sha256


def test_the_known_checks_can_be_passed(tmp_path: Path) -> None:
    file = tmp_path / "assignment.yaml"
    file.write_text(GOOD.replace("run.output", "my.own"))
    known = dict.fromkeys(("package.found", "my.own"), CHECKS["package.found"])
    assignment = load_assignment(file, known_checks=known)
    assert assignment.checks[1].id == "my.own"
    assert load_assignment(file) == assignment  # the loader itself knows no checks
