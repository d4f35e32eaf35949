"""Fixtures for all tests."""

from __future__ import annotations

import atexit
import os
import re
import shutil
import signal
import tempfile
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import pytest
from hypothesis import settings

from grader.base.i18n.translator import Translator
from grader.cli.called import CALLED_BY
from grader.course.find import LESSON
from grader.course.folder import COURSE
from grader.report.model import CheckResult
from grader.ros.distro import find_distro
from grader.ros.prefix import Ros
from grader.sandbox.base import Sandbox
from grader.sandbox.bubblewrap import Bubblewrap
from grader.sandbox.limits import Limits
from grader.sandbox.proof import proven_ros

ROOT = Path(__file__).resolve().parent.parent
pytest_plugins = ["tests.pages.fixtures"]
LONG_RUN = ROOT / "tests" / "long_run.txt"
# these mostly wait: for a terminal, a container, a browser, a clock
WAITING = (
    "tests/lab/",
    "tests/docker/",
    "tests/window/",
    "tests/test_clock.py",
    "tests/test_bubblewrap.py",
)

# (a machine may be busy: no example fails because of the time that it took)
settings.register_profile("no deadline", deadline=None)
settings.load_profile("no deadline")
# A shell ignores SIGINT in background jobs, and all processes that the tests start would inherit it
signal.signal(signal.SIGINT, signal.default_int_handler)
# texts are compared in English, whatever the language of the environment
os.environ["LC_ALL"] = "C.UTF-8"
# a secret of their own, which decides how many lines of a package are watched
if "GRADER_STATE" not in os.environ:
    os.environ["GRADER_STATE"] = tempfile.mkdtemp(prefix="grader-state-")
    atexit.register(shutil.rmtree, os.environ["GRADER_STATE"], ignore_errors=True)
# where the engine is, for tests that need one; the others see none, whether or not one is ready yet
ENGINE = os.environ.get("DOCKER_HOST")
NO_ENGINE = "unix:///nonexistent/docker.sock"
# the tests use the default course and lesson, and call the grader by its name, as no `make test` does
for _name in (COURSE, LESSON, CALLED_BY):
    os.environ.pop(_name, None)


@pytest.fixture(scope="session", autouse=True)
def no_lost_point() -> Iterator[None]:
    """No report of the tests takes a point without a check that failed.

    `compose` leaves such points open; here they are a bug of the check.
    """
    from grader.verdict import causes

    made = causes.with_causes

    def checked(results: Sequence[CheckResult], translate: Translator) -> list[CheckResult]:
        lost = [(r.id, r.status, r.blocked_by) for r in causes.without_cause(results)]
        assert not lost, f"because of checks that passed: {lost}"
        return made(results, translate)

    causes.with_causes = checked
    yield
    causes.with_causes = made


@pytest.fixture(scope="session")
def ros_jazzy() -> Ros:
    """ROS jazzy from PyPI's wheels, made once even by concurrent test processes."""
    return proven_ros(find_distro("jazzy"))


@pytest.fixture(scope="session")
def ros_kilted() -> Ros:
    return proven_ros(find_distro("kilted"))


@pytest.fixture(scope="session")
def jazzy_prefix(ros_jazzy: Ros) -> Path:
    return ros_jazzy.path


@pytest.fixture
def make_sandbox(ros_jazzy: Ros) -> Callable[[Limits], Sandbox]:
    """A function that makes a sandbox with given limits; other sandboxes' tests override it."""
    return lambda limits: Bubblewrap(ros_jazzy, limits)


@pytest.fixture
def sandbox(make_sandbox: Callable[[Limits], Sandbox]) -> Iterator[Sandbox]:
    with make_sandbox(Limits()) as opened:
        yield opened


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_setup(item: pytest.Item) -> None:
    """Let a test see the Docker engine only if it is marked `docker`.

    The images of `make test-all` become ready at some moment of the other tests.
    """
    if item.get_closest_marker("docker") is None:
        os.environ["DOCKER_HOST"] = NO_ENGINE
    elif ENGINE is None:
        os.environ.pop("DOCKER_HOST", None)
    else:
        os.environ["DOCKER_HOST"] = ENGINE


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Mark what only the long run has, and begin with the tests that mostly wait.

    So one process waits while the others compute: they share the tests in their order, and who has
    none left takes others'.
    """
    rows = LONG_RUN.read_text(encoding="utf-8").splitlines()
    patterns = [row for row in rows if row and not row.startswith("#")]
    for pattern in patterns:
        found = [item for item in items if re.match(f"tests/{pattern}", item.nodeid)]
        for item in found:
            item.add_marker(pytest.mark.long)
        if not found and config.args == config.getini("testpaths"):
            raise pytest.UsageError(f"{LONG_RUN}: no test fits: {pattern}")
    items.sort(key=lambda item: not item.nodeid.startswith(WAITING))
