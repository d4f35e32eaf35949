"""Exit statuses of a submission and of the grader's own commands are never confused."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import cast

import pytest

from grader.base.errors import SurroundingsError
from grader.base.unheard import unheard
from grader.package.submission import Submission
from grader.run.run import Run
from grader.run.session import Unobserved
from grader.run.workspace import BUILD, build
from grader.sandbox.base import Outcome, Sandbox
from grader.sandbox.limits import Limits
from tests.corpus.build import SOLUTION, write
from tests.corpus.hostile import HOSTILE
from tests.marking import ASSIGNMENT, taken_in
from tests.test_ceiling import Clock, new_session

LISTED = b"f 644 3 install/setup.bash\t\0\0\n"


@pytest.fixture
def submission() -> Submission:
    return taken_in(SOLUTION)


class FakeSandbox:
    """A sandbox whose commands (laying out, colcon, the listing) end with given statuses."""

    limits = Limits()
    ros_path = "/opt/ros/jazzy"
    workspace = "/ws"

    def __init__(self, *, lay_out: int = 0, colcon: int = 0, listing: int = 0) -> None:
        self._statuses = {"tar -xf": lay_out, BUILD: colcon, "find ": listing}

    def run(self, argv: Sequence[str], **_: object) -> Outcome:
        status = next(status for word, status in self._statuses.items() if word in argv[2])
        return Outcome(status, LISTED, 0.1)


def build_status(submission: Submission, **statuses: int) -> int | None:
    sandbox = cast("Sandbox", FakeSandbox(**statuses))
    return build(sandbox, submission, package=ASSIGNMENT.package).status


def test_every_status_of_colcon_counts_for_the_submission(submission: Submission) -> None:
    found = {status: build_status(submission, colcon=status) for status in range(256)}
    assert found == {status: status for status in range(256)}


@pytest.mark.parametrize(
    ("ours", "output"), [("lay_out", "could not be laid out"), ("listing", "could not be listed")]
)
def test_a_failing_command_of_the_grader_is_a_surroundings_error(
    submission: Submission, ours: str, output: str
) -> None:
    with pytest.raises(SurroundingsError, match=output):
        build_status(submission, **{ours: 2})


@pytest.mark.prefix
def test_a_setup_py_that_exits_early_is_not_a_successful_build(
    sandbox: Sandbox, tmp_path: Path
) -> None:
    name, status = "setup_paints_and_ends_with_250", 250
    package = next(package for package in HOSTILE if package.name == name)
    made = build(sandbox, taken_in(write(package, tmp_path)), package=ASSIGNMENT.package)
    assert (made.status, made.stopped_by) == (status, "")
    assert "Score 100 / 100" in made.log
    assert not made.is_installed(ASSIGNMENT.package)


@pytest.mark.prefix
def test_a_full_workspace_is_reported_with_the_message_of_tar(
    make_sandbox: Callable[[Limits], Sandbox], submission: Submission
) -> None:
    limits = Limits().override({"workspace": 8192})
    with make_sandbox(limits) as small, pytest.raises(SurroundingsError) as caught:
        build(small, submission, package=ASSIGNMENT.package)
    assert "No space left on device" in caught.value.message


def ended_at_once() -> Run:
    return Run("", ended_by_itself=True, status=1, transcript="bwrap: no")


@pytest.mark.parametrize("works", [True, False])
def test_a_node_that_ends_at_once_is_judged_only_if_the_sandbox_still_works(
    monkeypatch: pytest.MonkeyPatch, works: bool
) -> None:
    run = ended_at_once()
    clock = Clock(monkeypatch, run)
    clock.seconds = 1.0
    opened = new_session(clock, works=works)
    if works:
        assert opened.run(unheard) is run
        assert clock.runs == 1
    else:
        with pytest.raises(Unobserved, match="no longer starts commands"):
            opened.run(unheard)
        assert clock.runs == 3
