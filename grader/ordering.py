"""From the words of the command line to what is to be marked; every word is checked first."""

from __future__ import annotations

import os
from pathlib import Path

from grader.assignment import load_assignment
from grader.errors import UsageError
from grader.limits import UNITS
from grader.limits import Limits
from grader.locale.message import say
from grader.locale.speaker import chosen_language
from grader.ros.distro import find_distro
from grader.runner import Order
from grader.sandbox.choose import check_name

COURSE = "GRADER_COURSE"


def make_orders(
    path: Path,
    assignment: str,
    distro: str,
    sandbox: str,
    limits: tuple[str, ...],
    *,
    name: str | None = None,
    own_code: bool = False,
    lang: str | None = None,
) -> list[Order]:
    """Check every word of the command line before anything is run."""
    check_name(sandbox)
    distros = [find_distro(word.strip()) for word in distro.split(",") if word.strip()]
    if not distros:
        raise UsageError(say("no distro was named"), remedy=say("For example: --distro jazzy"))
    given = _limit_values(limits)
    file, hidden = assignment_files(assignment)
    if own_code:
        hidden = None
    wanted = load_assignment(file, hidden=hidden, known_limits=tuple(UNITS))
    bounds = Limits().override(wanted.limits).override(given)
    return [
        Order(
            path=path,
            assignment=wanted,
            distro=found,
            sandbox=sandbox,
            name=name,
            limits=bounds,
            own_code=own_code,
            lang=lang or chosen_language(os.environ),
        )
        for found in dict.fromkeys(distros)
    ]


def own_place() -> Path:
    """Return where a student's own package is when no path is given: ~/ros2_ws, else here."""
    workspace = Path.home() / "ros2_ws"
    return workspace if workspace.is_dir() else Path.cwd()


def _limit_values(words: tuple[str, ...]) -> dict[str, float]:
    values = {}
    for word in words:
        name, equals, value = word.partition("=")
        try:
            values[name.strip()] = float(value)
        except ValueError:
            equals = ""
        if not equals:
            raise UsageError(say("--limit takes NAME=NUMBER, not '{word}'", word=word))
    return values


def assignment_files(assignment: str) -> tuple[Path, Path | None]:
    """Return the assignment's file and its hidden checks, if this side has any."""
    if "/" in assignment or assignment.endswith((".yaml", ".yml")):
        return Path(assignment), None
    here = Path(__file__).resolve().parent
    course = _course(here)
    file = course / assignment / "assignment.yaml"
    if not file.is_file():
        known = sorted(p.parent.name for p in course.glob("*/assignment.yaml"))
        raise UsageError(
            say(
                "there is no assignment '{assignment}' in {course}",
                assignment=assignment,
                course=str(course),
            ),
            remedy=say(
                "Assignments: {names}; or give a file's path. ${variable} names another course "
                "folder.",
                names=", ".join(known) or "-",
                variable=COURSE,
            ),
        )
    hidden = here / "keys" / assignment / "hidden.yaml"
    return file, hidden if hidden.is_file() else None


def _course(here: Path) -> Path:
    """Return the course folder: $GRADER_COURSE, this checkout's, or the installed package's."""
    own = os.environ.get(COURSE)
    if own:
        return Path(own)
    shares = [parent / "share" / "ros2_teaching_lab" / "course" for parent in here.parents]
    places = [here.parent / "lab" / "course", *shares]
    return next((place for place in places if place.is_dir()), places[0])
