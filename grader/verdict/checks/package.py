"""The package stage: is there a package, and is its name the same everywhere?"""

from __future__ import annotations

import re
import shlex
from posixpath import normpath
from typing import TYPE_CHECKING

from grader.base.i18n.message import say
from grader.base.nearest import nearest, there_is, with_difference
from grader.base.shown import shown
from grader.package.source.setup_cfg import (
    SetupCfg,
    SetupCfgFault,
    indented_heading,
    read_setup_cfg,
)
from grader.package.source.setup_py import INDEX
from grader.package.source.values import Computed, Listing, Text, Value
from grader.report.model import Where
from grader.verdict.checks.declare import INTAKE, check
from grader.verdict.checks.manifest import check_manifest
from grader.verdict.checks.parsed import (
    file_of,
    in_inner_folder,
    names_in,
    printable_reason,
    setup_py_of,
)
from grader.verdict.outcome import Failed, Passed

if TYPE_CHECKING:
    from grader.package.source.setup_py import SetupPy
    from grader.verdict.evidence import Evidence


@check("package.found", stage=INTAKE)
def found(evidence: Evidence) -> Passed:
    """There is one package to mark."""
    submission, package = evidence.submission, evidence.assignment.package
    if submission.root is None:
        raise Failed(
            submission.problem_mistake or "package.no_manifest",
            expected=say(
                "one package {package}: a folder with package.xml and setup.py in it",
                package=package,
            ),
            actual=submission.problem,
            variant="nothing",
            fix=submission.problem_fix,
        )
    names = {c.path: c.name for c in submission.candidates}
    name = names.get(submission.root, package)
    place = say("the folder itself") if submission.root == "." else shown(submission.root)
    actual = say("{name}, in {place}", name=shown(name), place=place)
    return Passed(actual=actual, advice=submission.hints)


@check("package.manifest", stage=INTAKE, depends=["package.found"])
def manifest(evidence: Evidence) -> Passed:
    """package.xml is valid, its name is the package's, and its build type is ament_python."""
    return check_manifest(evidence)


@check("package.marker", stage=INTAKE, depends=["package.found"], after=["package.manifest"])
def marker(evidence: Evidence) -> Passed:
    """The marker file by which ROS finds the package exists and is installed."""
    package = evidence.assignment.package
    path = f"resource/{package}"
    there = evidence.submission.file(path)
    if there is None or there.kind != "file":
        raise _no_marker(evidence, path)
    setup = setup_py_of(evidence)
    if setup is None:
        return Passed(actual=path)
    data_files = setup.argument("data_files")
    installed, all_known = _installed_in(data_files, INDEX)
    named = [item for item in installed if item.value.rpartition("/")[2] == package]
    lost = [item for item in named if file_of(evidence, normpath(item.value)) is None]
    if (named and not lost) or not all_known:
        where = say("{path}, installed in {folder}", path=path, folder=INDEX)
        return Passed(actual=where if all_known else path)
    if installed and _comes_from_name(evidence, setup, (lost or installed)[0]):
        return Passed(actual=path)
    if installed:
        raise _other_marker(evidence, (lost or installed)[0])
    if (place := _other_place(data_files, package)) is not None:
        raise _installed_elsewhere(place, path, package)
    line = data_files.line if data_files is not None else setup.line
    raise Failed(
        "package.marker_not_installed",
        expected=say("setup.py installs {path} in {folder}", path=path, folder=INDEX),
        actual=say("data_files in setup.py has no line for it")
        if data_files is not None
        else say("setup() has no argument data_files"),
        where=Where(file="setup.py", line=line),
        words={"package": package},
    )


def _other_place(data_files: Value | None, package: str) -> Text | None:
    """Return the folder into which data_files installs only the marker, the one most like the right.

    None if it installs it nowhere.
    """
    pairs = data_files.items if isinstance(data_files, Listing) else ()
    found: dict[str, Text] = {}
    for pair in pairs:
        place, files = pair.items if isinstance(pair, Listing) and len(pair.items) == 2 else (0, 0)
        if isinstance(place, Text) and isinstance(files, Listing) and len(files.items) == 1:
            item = files.items[0]
            if isinstance(item, Text) and normpath(item.value) == f"resource/{package}":
                found[place.value] = place
    close = nearest(INDEX, found) or next(iter(found), "")
    return found.get(close)


def _installed_elsewhere(place: Text, path: str, package: str) -> Failed:
    folder = shown(place.value)
    actual = say("it installs {path} in {folder}", path=path, folder=folder)
    return Failed(
        "package.marker_not_installed",
        expected=say("setup.py installs {path} in {folder}", path=path, folder=INDEX),
        actual=with_difference(actual, place.value, INDEX),
        where=Where(file="setup.py", line=place.line),
        words={"package": package},
    )


def _comes_from_name(evidence: Evidence, setup: SetupPy, item: Text) -> bool:
    """Whether a marker has another name only because of the wrong name that setup.py sets.

    That name is in one place of the file, and package.manifest has reported it.
    """
    name, file = setup.name, file_of(evidence, "setup.py")
    if name is None or file is None or item.value != f"resource/{name.value}":
        return False
    whole = rb"['\"]%s['\"]" % re.escape(name.value.encode())
    once = len(re.findall(whole, file.data)) == 1
    return once and evidence.has_mistake("package.manifest", "package.name_mismatch")


def _no_marker(evidence: Evidence, path: str) -> Failed:
    package, found = evidence.assignment.package, evidence.submission.file
    expected: str = say("an empty file {path}", path=path)
    variant, there, place = "", path, ""
    actual: str = say("there is no file {path}", path=path)
    parent = found(path.partition("/")[0])
    if parent is not None and parent.kind != "folder":
        variant, there = "replace", parent.path
        actual = say("{path} is a file", path=parent.path)
    elif found(path) is not None:
        variant, actual = "replace", say("{path} is a folder", path=path)
    elif other := _other_place_of_marker(evidence, path):
        variant, there = "rename", shown(other)
        place = other if _line_that_installs(evidence, other) else ""
        said = say("there is no {path}, but {there}", path=path, there=there)
        actual = with_difference(said, other, path) if other.startswith("resource/") else said
    elif _installs_no_marker(evidence):
        variant, expected = "line", say("an empty file {path}, and its line in setup.py", path=path)
        actual = say(
            "there is no file {path}, and data_files in setup.py has no line for it", path=path
        )
    return Failed(
        "package.marker_missing",
        expected=expected,
        actual=actual,
        variant=variant,
        params={"there": there, "path": place},
        words={"package": package, "there": shlex.quote(there)},
        where=Where(file=there),
    )


def _other_place_of_marker(evidence: Evidence, path: str) -> str:
    """Return the file that is nearly the marker, by its folder or by its name; "" if there is none."""
    folder, _, name = path.partition("/")
    others = [one for one in names_in(evidence, folder) if one != name]
    lone = others[0] if len(others) == 1 and "." not in others[0] else ""
    close = nearest(name, others) or lone
    if close:
        return f"{folder}/{close}"
    parts = [file.path.partition("/") for file in evidence.submission.files]
    if not any(head == folder for head, _, _ in parts):
        inner = in_inner_folder(evidence, path)
        if inner:
            return inner
    like = nearest(folder, {head for head, _, rest in parts if rest == name}, cutoff=0.75)
    return f"{like}/{name}" if like else ""


def _line_that_installs(evidence: Evidence, path: str) -> bool:
    """Whether setup.py installs a file as the marker."""
    setup = setup_py_of(evidence)
    found, _ = _installed_in(setup.argument("data_files"), INDEX) if setup else ([], True)
    return any(normpath(item.value) == path for item in found)


def _installs_no_marker(evidence: Evidence) -> bool:
    """Whether setup.py has no line that installs a marker, as far as all lines are known."""
    setup = setup_py_of(evidence)
    if setup is None:
        return False
    installed, all_known = _installed_in(setup.argument("data_files"), INDEX)
    return all_known and not installed


def _other_marker(evidence: Evidence, item: Text) -> Failed:
    package = evidence.assignment.package
    missing = file_of(evidence, item.value) is None
    path = shown(item.value)
    actual = say("it installs {path}", path=path)
    if missing:
        actual = say("it installs {path}, which does not exist", path=path)
    wanted = f"resource/{package}"
    return Failed(
        "package.marker_missing" if missing else "package.marker_not_installed",
        expected=say("setup.py installs {path} in {folder}", path=wanted, folder=INDEX),
        actual=with_difference(actual, item.value, wanted),
        where=Where(file="setup.py", line=item.line),
        variant="line" if missing else "",
        params={"path": path},
        words={"package": package},
    )


def _installed_in(data_files: Value | None, folder: str) -> tuple[list[Text], bool]:
    """Return the files that data_files installs in a folder, and whether all of them are known."""
    if data_files is None:
        return [], True
    if not isinstance(data_files, Listing):
        return [], False
    found: list[Text] = []
    all_known = True
    for pair in data_files.items:
        if not isinstance(pair, Listing) or len(pair.items) != 2:
            all_known = False
            continue
        place, files = pair.items
        if isinstance(place, Computed) or not isinstance(files, Listing):
            all_known = False
        elif isinstance(place, Text) and place.value.strip("/") == folder:
            found += [item for item in files.items if isinstance(item, Text)]
            all_known = all_known and all(isinstance(item, Text) for item in files.items)
    return found, all_known


@check("package.setup_cfg", stage=INTAKE, depends=["package.found"])
def setup_cfg(evidence: Evidence) -> Passed:
    """setup.cfg installs executables where ros2 run looks."""
    package = evidence.assignment.package
    wanted = f"$base/lib/{package}"
    expected = say(
        "[develop] script_dir={wanted} and [install] install_scripts={wanted}", wanted=wanted
    )
    file = file_of(evidence, "setup.cfg")
    if file is None or file.unreadable:
        near = nearest("setup.cfg", names_in(evidence, ""), cutoff=0.8) if file is None else ""
        inner = in_inner_folder(evidence, "setup.cfg") if file is None else ""
        close = inner or (near if file_of(evidence, near) is not None else "")
        raise Failed(
            "package.setup_cfg_missing",
            expected=expected,
            actual=_no_cfg(evidence, file.reason if file else "", inner),
            where=Where(file=shown(close) or "setup.cfg"),
            variant="renamed" if close else "",
            params={"there": shown(close)},
            words={"package": package, "there": shlex.quote(shown(close))},
        )
    try:
        cfg = read_setup_cfg(file.data)
    except SetupCfgFault as fault:
        raise Failed(
            "package.setup_cfg_syntax",
            expected=expected,
            actual=say("setup.cfg cannot be parsed: {text}", text=printable_reason(fault.text)),
            where=Where(file="setup.cfg", line=fault.line),
            variant="encoding" if fault.is_encoding else "",
            words={"package": package},
        ) from None
    alone = _only_install(cfg, wanted)
    if alone is not None:
        return Passed(actual=expected, advice=alone)
    advice = [
        *_setting(cfg, "develop", "script_dir", wanted, expected),
        *_setting(cfg, "install", "install_scripts", wanted, expected),
    ]
    return Passed(actual=expected, advice=advice)


def _only_install(cfg: SetupCfg, wanted: str) -> list[str] | None:
    """Return the advice on a file without [develop]; None if it has that section, or a fault.

    setuptools then takes the folder of [install] for `setup.py develop` too (easy_install.py,
    finalize_options).
    """
    setting = cfg.sections.get("install", {}).get("install_scripts")
    right = setting is not None and setting.value.rstrip("/") == wanted
    if not right or "develop" in cfg.sections or indented_heading(cfg.text):
        return None
    close = nearest("develop", cfg.sections)
    if close and close != "install":
        return [
            say(
                "[{close}] in setup.cfg is not read: the section is called [develop]. The build takes "
                "the folder of [install] instead, which is the right one.",
                close=shown(close),
            )
        ]
    return [
        say(
            "setup.cfg has no [develop] with script_dir={wanted}, as ros2 pkg create writes it. The "
            "build takes the folder of [install] instead, which is the right one.",
            wanted=wanted,
        )
    ]


def _no_cfg(evidence: Evidence, reason: str, inner: str) -> str:
    if reason:
        return say("setup.cfg cannot be read: {reason}", reason=printable_reason(reason))
    if inner:
        return say("there is no {path}, but {there}", path="setup.cfg", there=shown(inner))
    close = nearest("setup.cfg", names_in(evidence, ""), cutoff=0.8)
    return with_difference(say("there is no setup.cfg") + there_is(close), close, "setup.cfg")


def _setting(cfg: SetupCfg, section: str, key: str, wanted: str, expected: str) -> list[str]:
    """Check one setting; return advice on its spelling. Raises Failed."""
    dashed = key.replace("_", "-")
    settings = cfg.sections.get(section, {})
    setting = settings.get(key) or settings.get(dashed)
    if setting is not None and setting.value.rstrip("/") == wanted:
        if key in settings:
            return []
        return [
            say(
                "Write {key} instead of {dashed} in setup.cfg: setuptools warns of the dash, and "
                "some of its versions (78.0) refuse it.",
                key=key,
                dashed=dashed,
            )
        ]
    line = (setting.line if setting is not None else 0) or cfg.lines.get(section)
    indented = indented_heading(cfg.text)
    close = "" if section in cfg.sections else nearest(section, cfg.sections)
    none = say("there is no section [{section}]", section=section) + there_is(close)
    actual: str = with_difference(none, close, section)
    if indented:
        line, actual = indented, say("the heading of a section is indented")
    elif setting is not None:
        value = shown(setting.value)
        there = say("[{section}] has {key}={value}", section=section, key=key, value=value)
        actual = with_difference(there, setting.value, wanted)
    elif section in cfg.sections:
        near = nearest(key, cfg.sections[section])
        line = cfg.sections[section][near].line if near else line
        absent = say("[{section}] has no {key}", section=section, key=key) + there_is(near)
        actual = with_difference(absent, near, key)
    raise Failed(
        "package.setup_cfg_wrong",
        expected=expected,
        actual=actual,
        where=Where(file="setup.cfg", line=line or cfg.lines.get(close)),
        words={"package": wanted.rpartition("/")[2]},
    )
