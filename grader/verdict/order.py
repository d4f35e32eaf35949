"""The order to mark a submission, made from the command line's options."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from grader.base.errors import UsageError
from grader.base.i18n.message import say
from grader.base.i18n.translator import chosen_language
from grader.base.nearest import meant, nearest_path
from grader.course.assignment import Assignment
from grader.course.draw import Plain
from grader.course.find import assignment_file, own_keys
from grader.course.load import load_assignment
from grader.ros.distro import Distro, find_distro
from grader.sandbox.limits import UNITS, Limits
from grader.sandbox.names import check_name
from grader.verdict.checks.all import CHECKS
from grader.verdict.own_checks import all_checks, read_own_checks

HIDDEN = "hidden.yaml"


@dataclass(frozen=True, kw_only=True)
class Order:
    """What to mark, and how; `lang` is the language of the report."""

    path: Path
    assignment: Assignment
    distro: Distro
    sandbox: str = "auto"
    name: str | None = None
    limits: Limits = field(default_factory=Limits)
    own_code: bool = False
    lang: str = "en"
    student_id: str = ""
    modes_kept: bool = True
    """False if the exec bits were lost on the way here (see `take_in`)."""
    tries_fixes: bool = True
    """Whether to build and run the package with a fix before the report shows that fix."""
    drawn: Mapping[str, Plain] = field(default_factory=dict)
    """Values in place of those that would be drawn for the submission, by their names."""


def make_orders(
    path: Path,
    assignment: str | None,
    distro: str,
    sandbox: str,
    limits: tuple[str, ...],
    *,
    name: str | None = None,
    own_code: bool = False,
    keys: Path | None = None,
    lang: str | None = None,
    like: Path | None = None,
) -> list[Order]:
    """Check all options and return one order for each distro.

    `assignment` is an id, a file's path, or None for the default (`course.find.chosen`); `keys` is
    its folder of the instructor (default: the grader's own, if any). `own_code` is for a student's
    own package: without the hidden checks, and with no sandbox if none is available. `like` is a
    report.json or its folder, whose drawn values are used again.
    """
    check_name(sandbox)
    distros = [find_distro(word.strip()) for word in distro.split(",") if word.strip()]
    if not distros:
        raise UsageError(say("no distro was named"), remedy=say("For example: --distro jazzy"))
    given = _limit_values(limits)
    wanted = load_visible(assignment) if own_code else load_with_hidden(assignment, keys)
    drawn = values_of(like, wanted) if like is not None else {}
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
            drawn=drawn,
        )
        for found in dict.fromkeys(distros)
    ]


def values_of(like: Path, assignment: Assignment) -> dict[str, Plain]:
    """Return the drawn values in a report (report.json or its folder) for an assignment.

    Raises UsageError if it is of another assignment, or has no value that can be drawn for a name.
    """
    from grader.report.files import REPORT, read_report  # noqa: PLC0415 - slow

    file = like / REPORT if like.is_dir() else like
    report = read_report(file)
    if report.assignment.id != assignment.id:
        raise UsageError(
            say(
                "{file} is a report of {other}, not of {assignment}",
                file=str(file),
                other=report.assignment.id,
                assignment=assignment.id,
            )
        )
    found = {name: value for run in report.runs for name, value in run.drawn.items()}
    for name, draw in assignment.draw.items():
        if name not in found:
            raise UsageError(
                say("{file} has no drawn value of '{name}'", file=str(file), name=name),
                remedy=say("Mark without --like: the values are drawn then."),
            )
        if found[name] not in draw.values:
            raise UsageError(
                say(
                    "{name} is {value} in {file}, but it can no longer be drawn",
                    name=name,
                    value=str(found[name]),
                    file=str(file),
                )
            )
    return {name: found[name] for name in assignment.draw}


def default_path() -> Path:
    """Return where to look for a student's own package: ~/ros2_ws, else the current folder."""
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


def load_visible(assignment: str | None) -> Assignment:
    """Load an assignment without its hidden checks and the instructor's own; see `make_orders` for `assignment`."""
    file = assignment_file(assignment)
    return load_assignment(file, known_checks=CHECKS, known_limits=UNITS, drop_own=True)


def load_with_hidden(assignment: str | None, keys: Path | None = None) -> Assignment:
    """Load an assignment with the hidden checks and own checks of the instructor's folder.

    Raises UsageError if it announces hidden checks and that folder has none.
    """
    file = assignment_file(assignment)
    folder = keys or own_keys(file)
    if keys is not None and not keys.is_dir():
        missing = say("there is no folder {path}", path=str(keys))
        raise UsageError(missing + meant(nearest_path(keys)))
    hidden = folder / HIDDEN if folder is not None else None
    there = hidden is not None and hidden.is_file()
    text = read_own_checks(folder)
    loaded = load_assignment(
        file,
        hidden=hidden if there else None,
        known_checks=all_checks(text),
        known_limits=UNITS,
        own_checks=text,
    )
    if loaded.hidden_checks and not there:
        raise UsageError(
            say(
                "hidden_checks is {count} in {file}, but there is no {name}",
                file=str(file),
                count=loaded.hidden_checks,
                name=str(hidden or HIDDEN),
            ),
            remedy=say("Give the folder that has {name} with --keys.", name=HIDDEN),
        )
    return loaded
