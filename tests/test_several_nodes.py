"""A check without `of:` covers every node; what it says is about the node, the file and the run."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import pytest

from grader.course.load import load_assignment
from grader.report.blocks import evidence_of
from grader.report.model import Report
from grader.report.programs import command_for
from grader.report.terminal import render_report
from grader.verdict.checks.all import CHECKS, QUOTES
from tests import marking, recorded, two_nodes
from tests.two_nodes import ENTRY

SETUP, TALKER, LISTENER = "setup.py", "my_talking/talker.py", "my_talking/listener.py"
OF_LISTENER = {"listener.subscribes", "listener.logs", "listener.hears"}
OF_TALKER = {"talker.publishes", "talker.period"}
OF_RUNS = {"run.starts", "run.spins", "run.node_name", "run.stays", "run.interrupt"}
AFTER_START = OF_RUNS - {"run.starts"}


@dataclass(frozen=True)
class Broken:
    """A broken package: the check that fails, its mistake, file, line and words, and what is skipped."""

    name: str
    edits: tuple[tuple[str, str, str], ...]
    check: str
    mistake: str
    file: str
    line: str = ""
    says: str = ""
    lost: frozenset[str] = field(default_factory=frozenset)
    plain: tuple[str, ...] = ()


def broken(
    name: str,
    *edits: tuple[str, str, str],
    fails: tuple[str, str, str],
    line: str = "",
    says: str = "",
    lost: set[str] | frozenset[str] = frozenset(),
    plain: tuple[str, ...] = (),
) -> Broken:
    check, mistake, file = fails
    return Broken(name, edits, check, mistake, file, line, says, frozenset(lost), plain)


MAIN = "    rclpy.spin(Listener())\n"
BROKEN = (
    broken(
        "no entry",
        (SETUP, ENTRY, ""),
        fails=("entry_point.mapping", "setup.no_entry", SETUP),
        says="there are only: talker",
        lost=OF_RUNS | OF_LISTENER | {"entry_point.executable"},
    ),
    broken(
        "entry of the other node",
        (SETUP, "my_talking.listener:main", "my_talking.talker:main"),
        fails=("entry_point.mapping", "setup.other_module", SETUP),
        line="'listener = my_talking.talker:main'",
        lost=OF_RUNS | OF_LISTENER,
    ),
    broken(
        "does not spin",
        (LISTENER, MAIN, "    node = Listener()\n    node.destroy_node()\n"),
        fails=("run.starts", "node.spin_missing", LISTENER),
        says="it ended by itself",
        lost=AFTER_START | OF_LISTENER,
    ),
    broken(
        "not executable",
        fails=("source.exec_bit", "source.not_executable", LISTENER),
        plain=(LISTENER,),
    ),
    broken(
        "other node name",
        (LISTENER, "super().__init__('listener')", "super().__init__('hearer')"),
        fails=("run.node_name", "run.wrong_node_name", LISTENER),
        line="super().__init__('hearer')",
        says="/hearer",
    ),
    broken(
        "target misspelt",
        (SETUP, "my_talking.listener:main", "my_talking.listner:main"),
        fails=("entry_point.mapping", "setup.misspelt_module", SETUP),
        line="my_talking.listner:main",
        lost=OF_RUNS | OF_LISTENER,
    ),
    broken(
        "raises in the constructor",
        (LISTENER, "self.on_text, 10", "self.on_txt, 10"),
        fails=("run.starts", "node.attribute_unknown", LISTENER),
        line="self.on_txt",
        says="AttributeError",
        lost=AFTER_START | OF_LISTENER,
    ),
    broken(
        "raises in the callback",
        (LISTENER, "text.data}", "text.dat}"),
        fails=("run.stays", "node.attribute_unknown", LISTENER),
        line="text.dat}",
        says="AttributeError",
        lost={"listener.logs", "listener.hears", "run.interrupt"},
    ),
    broken(
        "other executable",
        (SETUP, "'listener = ", "'hearer = "),
        fails=("entry_point.mapping", "setup.other_executable", SETUP),
        line="'hearer = ",
        says="the executable is called 'hearer', not 'listener'",
    ),
    broken(
        "file of another name",
        (SETUP, "my_talking.listener:main", "my_talking.listener2:main"),
        fails=("entry_point.mapping", "setup.misspelt_module", SETUP),
        lost=OF_RUNS | OF_LISTENER,
    ),
    broken(
        "never spins",
        (LISTENER, MAIN, "    node = Listener()\n    input()\n"),
        fails=("run.spins", "node.spin_missing", LISTENER),
        says="the node does not answer",
        lost=OF_LISTENER | {"run.stays"},
    ),
    broken(
        "the first has no entry",
        (SETUP, "            'talker = my_talking.talker:main',\n", ""),
        fails=("entry_point.mapping", "setup.no_entry", SETUP),
        says="there are only: listener",
        lost=OF_RUNS | OF_TALKER | {"entry_point.executable", "listener.hears"},
    ),
    broken(
        "the first raises in the callback",
        (TALKER, "self.count += 1", "self.cont += 1"),
        fails=("run.stays", "node.attribute_not_set", TALKER),
        line="self.cont",
        lost={"talker.period", "listener.hears", "run.interrupt"},
    ),
    broken(
        "the first publishes elsewhere",
        (TALKER, "'chatter'", "'chater'"),
        fails=("talker.publishes", "topic.wrong_name", TALKER),
        line="'chater'",
        lost={"talker.period", "listener.hears"},
    ),
)


def marked(folder: Path, case: Broken) -> Report:
    root = two_nodes.write(folder, *case.edits, plain=case.plain)
    return recorded.mark(root, assignment=two_nodes.assignment(folder))


def test_a_right_package_gets_full_marks(tmp_path: Path) -> None:
    root = two_nodes.write(tmp_path)
    report = recorded.mark(root, assignment=two_nodes.assignment(tmp_path))
    assert report.score == report.max_score, marking.summary(report)


@pytest.mark.parametrize("case", BROKEN, ids=lambda case: case.name)
def test_a_mistake_costs_the_points_of_its_node_and_is_told_in_its_file(
    case: Broken, tmp_path: Path
) -> None:
    report = marked(tmp_path, case)
    failed = {check.id: check for check in report.checks if check.status == "failed"}
    assert set(failed) == {case.check}, marking.summary(report)
    told = failed[case.check]
    assert told.mistakes[0].id == case.mistake, marking.summary(report)
    assert told.where is not None and told.where.file == case.file
    if case.line:
        text = (tmp_path / "my_talking" / case.file).read_text(encoding="utf-8")
        assert case.line in text.splitlines()[(told.where.line or 1) - 1]
    assert case.says in told.actual
    skipped = {check.id for check in report.checks if check.status == "skipped"}
    assert skipped == case.lost
    assert {check.blocked_by for check in report.checks if check.status == "skipped"} <= {
        case.check
    }


def case_of(name: str) -> Broken:
    return next(case for case in BROKEN if case.name == name)


def test_ran_and_the_quoted_output_are_those_of_the_failed_node(tmp_path: Path) -> None:
    report = marked(tmp_path, case_of("raises in the constructor"))
    told = report.check("run.starts")
    assert (told.node, told.run) == ("listener", "chat")
    assert command_for(told, report).startswith("ros2 run my_talking listener ")
    quoted = evidence_of(told, report, QUOTES)
    assert quoted is not None and "AttributeError" in quoted.text
    assert "Publishing" not in quoted.text and "listener in the run chat" in quoted.title
    page = render_report(report, quotes=QUOTES)
    assert "ran       ros2 run my_talking listener" in page
    assert "(in my_talking/listener.py, line 10)" in " ".join(page.split())


def test_without_a_check_of_entry_points_the_start_says_that_there_is_no_executable(
    tmp_path: Path,
) -> None:
    case = case_of("no entry")
    root = two_nodes.write(tmp_path, *case.edits, ("package.xml", "Two nodes", "Two"))
    report = recorded.mark(root, assignment=two_nodes.assignment(tmp_path, entries=False))
    told = report.check("run.starts")
    assert (told.status, told.mistakes[0].id) == ("failed", "setup.no_entry")
    assert "there are only: talker" in told.actual
    assert told.where is not None and told.where.file == SETUP


def test_two_nodes_that_fail_are_both_named(tmp_path: Path) -> None:
    edits = [
        (TALKER, "super().__init__('talker')", "super().__init__('speaker')"),
        (LISTENER, "super().__init__('listener')", "super().__init__('hearer')"),
    ]
    root = two_nodes.write(tmp_path, *edits)
    report = recorded.mark(root, assignment=two_nodes.assignment(tmp_path))
    failed = [check.id for check in report.checks if check.status == "failed"]
    assert failed == ["run.node_name"], marking.summary(report)
    told = report.check("run.node_name")
    assert told.where is not None and told.where.file == TALKER
    assert "talker: /speaker" in told.actual and "listener: /hearer" in told.actual
    assert any(LISTENER in text for text in told.advice)


def test_a_check_of_one_node_is_about_that_node_alone(tmp_path: Path) -> None:
    case = case_of("no entry")
    root = two_nodes.write(tmp_path, *case.edits, ("package.xml", "Two nodes", "One entry"))
    text = two_nodes.ASSIGNMENT.replace("ENTRIES\n", OF_ONE)
    file = tmp_path / "assignment.yaml"
    file.write_text(text, encoding="utf-8")
    report = recorded.mark(root, assignment=load_assignment(file, known_checks=CHECKS))
    assert report.check("talker.entry").status == "passed"
    told = report.check("listener.entry")
    assert (told.status, told.mistakes[0].id) == ("failed", "setup.no_entry")
    assert report.check("talker.publishes").status == "passed"
    assert report.check("listener.logs").blocked_by == "listener.entry"


OF_ONE = """\
  - {id: talker.entry, check: entry_point.mapping, of: talker, points: 1}
  - {id: listener.entry, check: entry_point.mapping, of: listener, points: 1}
"""
