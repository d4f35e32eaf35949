"""The package stage: is it there, and do the parts that carry its name agree?"""

from __future__ import annotations

from typing import TYPE_CHECKING

from grader.checks.manifest import check_manifest
from grader.checks.parsed import file_of
from grader.checks.parsed import meant
from grader.checks.parsed import names_in
from grader.checks.parsed import nearest
from grader.checks.parsed import setup_py_of
from grader.checks.registry import Failed
from grader.checks.registry import Passed
from grader.checks.registry import check
from grader.intake.notes import shown
from grader.report.model import Where
from grader.source.setup_cfg import SetupCfg
from grader.source.setup_cfg import SetupCfgFault
from grader.source.setup_cfg import read_setup_cfg
from grader.source.values import Computed
from grader.source.values import Listing
from grader.source.values import Text
from grader.source.values import Value

if TYPE_CHECKING:
    from grader.evidence import Evidence

INDEX = "share/ament_index/resource_index/packages"
WHY_MARKER = (
    "ROS finds a package by an empty file of its name in the package index. setup.py copies it "
    "there from resource/ when you build."
)
WHY_CFG = (
    "setup.cfg says where executables are installed. ros2 run looks only in lib/<package>, so "
    "without these two lines they land in bin and it answers: No executable found."
)


@check("package.found")
def found(evidence: Evidence) -> Passed:
    """There is one package to mark."""
    submission, package = evidence.submission, evidence.assignment.package
    if submission.root is None:
        raise Failed(
            expected=f"one package {package}: a folder with package.xml and setup.py in it",
            actual=submission.problem,
            rationale="A package is the unit that ROS builds and runs; colcon knows one by its "
            "package.xml.",
            fix=submission.problem_fix,
            mistake=submission.problem_mistake or "package.no_manifest",
        )
    names = {c.path: c.name for c in submission.candidates}
    name = names.get(submission.root, package)
    place = "the folder itself" if submission.root == "." else shown(submission.root)
    return Passed(actual=f"{shown(name)}, in {place}", advice=submission.hints)


@check("package.manifest", depends=["package.found"])
def manifest(evidence: Evidence) -> Passed:
    """package.xml is valid, its name is the package's, and its build type is ament_python."""
    return check_manifest(evidence)


@check("package.marker", depends=["package.found"])
def marker(evidence: Evidence) -> Passed:
    """The marker file by which ROS finds the package is there and is installed."""
    package = evidence.assignment.package
    path = f"resource/{package}"
    there = evidence.submission.file(path)
    if there is None or there.kind != "file":
        raise _no_marker(evidence, path)
    setup = setup_py_of(evidence)
    if setup is None:
        return Passed(actual=path)
    data_files = setup.argument("data_files")
    installed, told = _installed_in(data_files, INDEX)
    if any(item.value.rpartition("/")[2] == package for item in installed) or not told:
        return Passed(actual=f"{path}, installed in {INDEX}" if told else path)
    if installed:
        raise _other_marker(evidence, installed[0])
    line = data_files.line if data_files is not None else setup.line
    raise Failed(
        expected=f"setup.py installs {path} in {INDEX}",
        actual="data_files in setup.py has no line for it",
        where=Where(file="setup.py", line=line),
        rationale=WHY_MARKER + " colcon still adds a missing one itself, with a warning that it "
        "will stop doing so.",
        fix=f"Add to data_files: ('{INDEX}', ['resource/' + package_name]),",
        mistake="package.marker_not_installed",
    )


def _no_marker(evidence: Evidence, path: str) -> Failed:
    package = evidence.assignment.package
    others = [name for name in names_in(evidence, "resource") if name != package]
    actual = f"there is no file {path}"
    fix = f"Make the empty file: in the package's folder, run  mkdir -p resource && touch {path}"
    close = nearest(package, others) or (others[0] if len(others) == 1 else "")
    if evidence.submission.file(path) is not None:
        actual = f"{path} is a folder"
        fix = f"Delete that folder and make an empty file of the same name: touch {path}"
    elif close:
        actual = f"there is no {path}, but resource/{shown(close)}"
        fix = f"Rename resource/{shown(close)} to {path}: the two names must be equal."
    return Failed(
        expected=f"an empty file {path}",
        actual=actual,
        where=Where(file=path),
        rationale=WHY_MARKER + " If it is missing, the build stops with: can't copy "
        f"'{path}': doesn't exist or not a regular file.",
        fix=fix,
        mistake="package.marker_missing",
    )


def _other_marker(evidence: Evidence, item: Text) -> Failed:
    package = evidence.assignment.package
    missing = file_of(evidence, item.value) is None
    return Failed(
        expected=f"setup.py installs resource/{package} in {INDEX}",
        actual=f"it installs {shown(item.value)}" + (", which is not there" if missing else ""),
        where=Where(file="setup.py", line=item.line),
        rationale=WHY_MARKER + " The marker's name is the name under which ROS knows the package.",
        fix=f"Let that line install 'resource/{package}': give package_name in setup.py the value "
        f"'{package}'.",
        mistake="package.marker_missing" if missing else "package.marker_not_installed",
        params={"path": shown(item.value)},
    )


def _installed_in(data_files: Value | None, folder: str) -> tuple[list[Text], bool]:
    """Return what data_files puts into a folder, and whether all of it could be told."""
    if data_files is None:
        return [], True
    if not isinstance(data_files, Listing):
        return [], False
    found: list[Text] = []
    told = True
    for pair in data_files.items:
        if not isinstance(pair, Listing) or len(pair.items) != 2:
            told = False
            continue
        place, files = pair.items
        if isinstance(place, Computed) or not isinstance(files, Listing):
            told = False
        elif isinstance(place, Text) and place.value.strip("/") == folder:
            found += [item for item in files.items if isinstance(item, Text)]
            told = told and all(isinstance(item, Text) for item in files.items)
    return found, told


@check("package.setup_cfg", depends=["package.found"])
def setup_cfg(evidence: Evidence) -> Passed:
    """setup.cfg has executables installed where `ros2 run` looks."""
    package = evidence.assignment.package
    wanted = f"$base/lib/{package}"
    expected = f"[develop] script_dir={wanted} and [install] install_scripts={wanted}"
    file = file_of(evidence, "setup.cfg")
    if file is None or file.unreadable:
        close = nearest("setup.cfg", names_in(evidence, ""), cutoff=0.8)
        raise Failed(
            expected=expected,
            actual=f"setup.cfg cannot be read: {file.reason}"
            if file
            else f"there is no setup.cfg{meant(close)}",
            where=Where(file="setup.cfg"),
            rationale=WHY_CFG,
            fix="Make setup.cfg beside setup.py with these four lines: [develop] / "
            f"script_dir={wanted} / [install] / install_scripts={wanted}",
            mistake="package.setup_cfg_missing",
        )
    try:
        cfg = read_setup_cfg(file.data)
    except SetupCfgFault as fault:
        raise Failed(
            expected=expected,
            actual=f"setup.cfg cannot be understood: {shown(fault.text)}",
            where=Where(file="setup.cfg", line=fault.line),
            rationale="setuptools reads this file on every build and stops where it cannot.",
            fix="Mend that line: a line is either [section] or key=value.",
            mistake="package.setup_cfg_syntax",
        ) from None
    advice = [
        *_setting(cfg, "develop", "script_dir", wanted, expected),
        *_setting(cfg, "install", "install_scripts", wanted, expected),
    ]
    return Passed(actual=expected, advice=advice)


def _setting(cfg: SetupCfg, section: str, key: str, wanted: str, expected: str) -> list[str]:
    """Check one setting; return advice on its spelling. Raises Failed."""
    dashed = key.replace("_", "-")
    settings = cfg.sections.get(section, {})
    setting = settings.get(key) or settings.get(dashed)
    if setting is not None and setting.value.rstrip("/") == wanted:
        if key in settings:
            return []
        return [
            f"Write {key} instead of {dashed} in setup.cfg: setuptools warns of the dash, and "
            "some of its versions (78.0) refuse it."
        ]
    line = cfg.lines.get(section)
    if setting is not None:
        line = setting.line
        actual = f"[{section}] has {key}={shown(setting.value)}"
        fix = f"Write {key}={wanted}"
    elif section in cfg.sections:
        close = nearest(key, settings)
        actual = f"[{section}] has no {key}{meant(close)}"
        fix = f"Write below [{section}]: {key}={wanted}"
    else:
        close = nearest(section, cfg.sections)
        actual = f"there is no section [{section}]{meant(close)}"
        fix = f"Add two lines: [{section}] and below it {key}={wanted}"
    raise Failed(
        expected=expected,
        actual=actual,
        where=Where(file="setup.cfg", line=line),
        rationale=WHY_CFG + " [develop] is for colcon build --symlink-install, [install] for a "
        "build without it.",
        fix=fix,
        mistake="package.setup_cfg_wrong",
        params={"section": section, "key": key},
    )
