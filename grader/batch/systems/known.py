"""All systems, found by the folders beside this module, and the one that a class' folder is from."""

from __future__ import annotations

import pkgutil
from collections.abc import Mapping
from importlib import import_module
from types import MappingProxyType

from grader.base.errors import UsageError
from grader.base.i18n.message import say
from grader.base.nearest import nearest
from grader.base.shown import shown
from grader.batch import systems
from grader.batch.systems import plain
from grader.batch.systems.layout import Layout
from grader.batch.systems.system import Download, ReportForm, SheetForm, System

# without a system: named by the students or the instructor
FOLDERS = System(
    name="folders",
    title=say("a folder of folders"),
    download=Download(say("a folder for each student, named after the student"), plain),
    group_folders=True,
)
ARCHIVES = System(
    name="archives",
    title=say("one archive for each student"),
    download=Download(say("an archive for each student, named after the student"), plain),
    group_folders=True,
)


def _found() -> list[System]:
    """Return the record of each package beside this module, those with a high priority first."""
    packages = (module.name for module in pkgutil.iter_modules(systems.__path__) if module.ispkg)
    records = [import_module(f"{systems.__name__}.{name}").SYSTEM for name in sorted(packages)]
    return sorted(records, key=lambda system: -system.priority)


SYSTEMS: Mapping[str, System] = MappingProxyType(
    {system.name: system for system in (*_found(), FOLDERS, ARCHIVES)}
)
DOWNLOADS: Mapping[str, Download] = MappingProxyType(
    {name: system.download for name, system in SYSTEMS.items() if system.download is not None}
)
NAMED_BY_HAND = (FOLDERS.name, ARCHIVES.name)


def layouts() -> str:
    """Return what `grade-all` can read, as a sentence."""
    known = "; ".join(f"{download.title} ({name})" for name, download in DOWNLOADS.items())
    return f"Known are: {known}."


def sheet_forms() -> list[SheetForm]:
    """Return the forms of all systems' files, the one with the most detailed roster first."""
    forms = [system.sheet for system in SYSTEMS.values() if system.sheet is not None]
    return sorted(forms, key=lambda form: not form.is_detailed)


def report_forms() -> dict[str, ReportForm]:
    """Return what writes a report in another system's form, by the word for `grader convert`."""
    return {word: form for system in SYSTEMS.values() for word, form in system.reports.items()}


def check_system(name: str) -> None:
    """Raise UsageError (with a "did you mean") if no system has that name."""
    if name == "auto" or name in DOWNLOADS:
        return
    close = nearest(name, DOWNLOADS)
    hint = f"did you mean '{close}'? " if close else ""
    known = ", ".join(("auto", *DOWNLOADS))
    raise UsageError(f"no system '{shown(name)}'", remedy=f"{hint}Known: {known}.")


def is_named_as_in(system: str, layout: Layout) -> bool:
    """Whether a folder has the names of the system (of any, for "auto")."""
    return any(
        download.reader.recognise(layout)
        for name, download in DOWNLOADS.items()
        if name not in NAMED_BY_HAND and system in ("auto", name)
    )


def recognised(system: str, layout: Layout) -> tuple[System, Download] | None:
    """Return the system that a folder is from, or the one that was asked for; None if none fits."""
    name = system if system != "auto" else _recognised_name(layout)
    return (SYSTEMS[name], DOWNLOADS[name]) if name else None


def _recognised_name(layout: Layout) -> str:
    for name, download in DOWNLOADS.items():
        if download.reader.recognise(layout):
            if name not in NAMED_BY_HAND:
                return name
            archives = all(item.kind == "archive" for item in layout.submissions())
            return ARCHIVES.name if archives else FOLDERS.name
    return ""
