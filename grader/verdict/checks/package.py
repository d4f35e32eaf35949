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
    KEYS,
    SetupCfg,
    SetupCfgFault,
    behind_heading,
    indented_heading,
    is_swapped,
    meant_key,
    read_setup_cfg,
    slip_of_path,
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


def _both_are_wrong(cfg: SetupCfg, wanted: str) -> bool:
    """Whether both sections have a setting, and neither is right."""
    given = [
        cfg.sections.get(section, {}).get(name)
        for section, key in KEYS.items()
        for name in (key, key.replace("_", "-"))
    ]
    values = [setting.value.rstrip("/") for setting in given if setting is not None]
    return len(values) > 1 and wanted not in values


def _lines_of(cfg: SetupCfg, slip: str, wanted: str) -> list[int]:
    """Return the lines on which a path is wrong in the same way."""
    given = [
        setting
        for section, key in KEYS.items()
        for name, setting in cfg.sections.get(section, {}).items()
        if name in (key, key.replace("_", "-"))
    ]
    return sorted(s.line for s in given if slip_of_path(s.value, wanted)[0] == slip)


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
        raise _installed_elsewhere(place, path)
    line = data_files.line if data_files is not None else setup.line
    raise Failed(
        "package.marker_not_installed",
        expected=say("setup.py installs {path} in {folder}", path=path, folder=INDEX),
        actual=say("data_files in setup.py has no line for it")
        if data_files is not None
        else say("setup() has no argument data_files"),
        where=Where(file="setup.py", line=line),
        variant="" if data_files is not None else "argument",
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


def _installed_elsewhere(place: Text, path: str) -> Failed:
    folder = shown(place.value)
    actual = say("it installs {path} in {folder}", path=path, folder=folder)
    return Failed(
        "package.marker_not_installed",
        expected=say("setup.py installs {path} in {folder}", path=path, folder=INDEX),
        actual=with_difference(actual, place.value, INDEX),
        where=Where(file="setup.py", line=place.line),
        variant="place",
        params={"folder": folder},
        words={"wanted": INDEX},
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
    package = evidence.assignment.package
    others = [name for name in names_in(evidence, "resource") if name != package]
    variant, actual = "", say("there is no file {path}", path=path)
    there, place, line = path, "", 0
    lone = [n for n in others if "." not in n] if len(others) == 1 else []
    close = nearest(package, others) or "".join(lone)
    parent = evidence.submission.file(path.partition("/")[0])
    if parent is not None and parent.kind != "folder":
        variant, actual = "file", say("{path} is a file", path=path.partition("/")[0])
    elif evidence.submission.file(path) is not None:
        variant, actual = "folder", say("{path} is a folder", path=path)
    elif inner := _inner_resource(evidence, path):
        variant, close, there = "inner", inner, f"{shown(inner)}/{package}"
        actual = say("there is no {path}, but {there}", path=path, there=there)
    elif folder := _folder_of_marker(evidence, path):
        variant, close, there = "moved", folder, f"{shown(folder)}/{package}"
        actual = say("there is no {path}, but {there}", path=path, there=there)
    elif close:
        variant, there = "rename", f"resource/{shown(close)}"
        line = _line_that_installs(evidence, f"resource/{close}")
        variant, place = ("rename_both", f"resource/{close}") if line else (variant, "")
        said = say("there is no {path}, but resource/{close}", path=path, close=shown(close))
        actual = with_difference(said, close, package)
    expected: str = say("an empty file {path}", path=path)
    if not variant and _installs_no_marker(evidence):
        variant, expected = "line", say("an empty file {path}, and its line in setup.py", path=path)
        actual = say(
            "there is no file {path}, and data_files in setup.py has no line for it", path=path
        )
    return Failed(
        "package.marker_missing",
        expected=expected,
        actual=actual,
        variant=variant,
        params={"folder": close} if variant in ("moved", "inner") else {"path": place},
        words={
            "package": package,
            "close": shown(close),
            "there": shlex.quote(shown(close)),
            "line": line,
        },
        where=Where(file=there),
    )


def _line_that_installs(evidence: Evidence, path: str) -> int:
    """Return the line of setup.py that installs a file as the marker; 0 if there is none."""
    setup = setup_py_of(evidence)
    found, _ = _installed_in(setup.argument("data_files"), INDEX) if setup else ([], True)
    return next((item.line for item in found if normpath(item.value) == path), 0)


def _installs_no_marker(evidence: Evidence) -> bool:
    """Whether setup.py has no line that installs a marker, as far as all lines are known."""
    setup = setup_py_of(evidence)
    if setup is None:
        return False
    installed, all_known = _installed_in(setup.argument("data_files"), INDEX)
    return all_known and not installed


def _inner_resource(evidence: Evidence, path: str) -> str:
    """Return the folder resource with the marker in the inner folder; "" if it is not there."""
    folder = path.partition("/")[0]
    here = any(file.path.partition("/")[0] == folder for file in evidence.submission.files)
    found = "" if here else in_inner_folder(evidence, path)
    return found.rpartition("/")[0]


def _folder_of_marker(evidence: Evidence, path: str) -> str:
    """Return the folder that has the marker and nearly the name resource; "" if there is none."""
    folder, _, name = path.partition("/")
    parts = [file.path.partition("/") for file in evidence.submission.files]
    return nearest(folder, {head for head, _, rest in parts if rest == name}, cutoff=0.75)


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
        variant="path" if item.value.endswith(package) else "other",
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
    inner = in_inner_folder(evidence, "setup.cfg") if file is None else ""
    if inner:
        raise Failed(
            "package.setup_cfg_missing",
            expected=expected,
            actual=say("there is no {path}, but {there}", path="setup.cfg", there=shown(inner)),
            where=Where(file=shown(inner)),
            variant="inner",
            params={"there": shown(inner)},
            words={"package": package, "close": "", "there": shlex.quote(shown(inner))},
        )
    if file is None or file.unreadable:
        near = nearest("setup.cfg", names_in(evidence, ""), cutoff=0.8) if file is None else ""
        close = near if file_of(evidence, near) is not None else ""
        raise Failed(
            "package.setup_cfg_missing",
            expected=expected,
            actual=_no_cfg(evidence, file.reason if file else ""),
            where=Where(file=shown(close) or "setup.cfg"),
            variant="renamed" if close else "",
            words={"package": package, "close": shlex.quote(shown(close)), "there": ""},
        )
    try:
        cfg = read_setup_cfg(file.data)
    except SetupCfgFault as fault:
        raise Failed(
            "package.setup_cfg_syntax",
            expected=expected,
            actual=say("setup.cfg cannot be parsed: {text}", text=printable_reason(fault.text)),
            where=Where(file="setup.cfg", line=fault.line),
            variant=fault.variant,
            words={"other": fault.other, "line": str(fault.there)},
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


def _no_cfg(evidence: Evidence, reason: str) -> str:
    if reason:
        return say("setup.cfg cannot be read: {reason}", reason=printable_reason(reason))
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
    line, close, quoted, name = cfg.lines.get(section), "", list[int](), ""
    indented = indented_heading(cfg.text)
    if indented:
        line, variant = indented, "indented"
        said: str = say("the heading of a section is indented")
        actual = said
    elif is_swapped(cfg):
        variant = "swapped"
        said = say("[{section}] has the key of the other section", section=section)
        actual = said
    elif setting is not None:
        line, variant = setting.line, "both" if _both_are_wrong(cfg, wanted) else ""
        slip, name = slip_of_path(setting.value, wanted)
        quoted = _lines_of(cfg, slip, wanted) if slip else []
        variant = slip or variant
        value = shown(setting.value)
        said = say("[{section}] has {key}={value}", section=section, key=key, value=value)
        actual = with_difference(said, setting.value, wanted)
    elif section in cfg.sections:
        variant, close = "key", meant_key(cfg, section, wanted)
        if close:  # (the misspelt key)
            line = settings[close].line
            right = settings[close].value.rstrip("/") == wanted
            variant = "misspelt" if right else "line"
        elif behind_heading(cfg.text, section):
            line, variant = behind_heading(cfg.text, section), "one_line"
        said = say("[{section}] has no {key}", section=section, key=key) + there_is(close)
        actual = with_difference(said, close, key)
    else:
        variant, close = "section", nearest(section, cfg.sections)
        said = say("there is no section [{section}]", section=section) + there_is(close)
        actual = with_difference(said, close, section)
        if close and all(name in close for name in KEYS):
            line = cfg.lines.get(close, line)
            variant, actual = "joined", say("one heading, [{close}], for two sections", close=close)
        elif close and close in cfg.lines:
            line, variant = cfg.lines[close], "heading"
        elif not close and not any(name in cfg.sections for name in KEYS):
            variant = "sections"
    raise Failed(
        "package.setup_cfg_wrong",
        expected=expected,
        actual=actual,
        where=Where(file="setup.cfg", line=line),
        variant=variant,
        params={"section": section, "key": key},
        words={
            "wanted": wanted,
            "close": shown(close),
            "line": ", ".join(str(number) for number in quoted),
            "name": shown(name),
        },
    )
