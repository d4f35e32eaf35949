"""Fuzzing targets: every function that reads a student's bytes.

Each takes any bytes. It must return or raise one of its own exceptions; any exception that Python
raises by itself is a bug.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from grader.mistakes.catalogue import CATALOGUE
from grader.mistakes.fixes.case import Case, Finding
from grader.mistakes.fixes.syntax import fault_of
from grader.mistakes.recognise import SYMPTOMS, behind_error, behind_symptom
from grader.mistakes.recognised import Raised, Suspect
from grader.package.edit.diff import diff
from grader.package.edit.files import Files
from grader.package.intake.model import SourceFile, Submission
from grader.package.source.broken_xml import xml_fault
from grader.package.source.entry_points import from_setup_cfg, from_setup_py
from grader.package.source.manifest import ManifestError, name_in, read_manifest
from grader.package.source.node import read_node
from grader.package.source.pasted import labels_in
from grader.package.source.python import PythonFault, parse_python
from grader.package.source.setup_cfg import SetupCfgFault, read_setup_cfg
from grader.package.source.setup_py import literal_name, read_setup_py
from grader.package.source.slips import slip_of
from grader.run.terminal import Terminal
from grader.sandbox.base import Console
from grader.verdict.checks.build_log import python_error
from grader.verdict.fix import fix_files
from tests.corpus.build import SOLUTION
from tests.corpus.model import CFG, MANIFEST, MARKER, NODE, SETUP
from tests.fixing import first_fix
from tests.marking import ASSIGNMENT

Target = Callable[[bytes], None]
RIGHT = {path: (SOLUTION / path).read_bytes() for path in (MANIFEST, SETUP, CFG, MARKER, NODE)}


def python(found: bytes) -> None:
    labels_in(found)
    slip = slip_of(found)
    with suppress(PythonFault):
        parse_python(found)
        assert slip is None


def manifest(found: bytes) -> None:
    name_in(found)
    fault = xml_fault(found)
    assert fault is None or fault.line > 0
    with suppress(ManifestError):
        read = read_manifest(found)
        assert read.fault or read.name
        assert all(element.line > 0 for element in read.elements)


def setup_py(found: bytes) -> None:
    literal_name(found)
    with suppress(PythonFault):
        points = from_setup_py(read_setup_py(found))
        for entries in points.groups.values():
            assert all(entry.line > 0 and isinstance(entry.valid, bool) for entry in entries)


def setup_cfg(found: bytes) -> None:
    with suppress(SetupCfgFault):
        points = from_setup_cfg(read_setup_cfg(found))
        for entries in points.groups.values():
            assert all(entry.line > 0 and isinstance(entry.valid, bool) for entry in entries)


def build_log(found: bytes) -> None:
    text = found.decode("utf-8", errors="replace")
    error, _ = python_error(text, "setup.py")
    assert len(error) <= 400
    for kind in CATALOGUE.values():
        if kind.pattern is not None:
            kind.pattern.search(text)


class _Recorded(Console):
    """A console on which bytes arrive in pieces."""

    def __init__(self, found: bytes) -> None:
        size = max(1, len(found) // 5)
        self._pieces = [found[n : n + size] for n in range(0, len(found), size)]

    def wait(self, seconds: float) -> bool:
        return True

    def read(self) -> bytes:
        return self._pieces.pop(0) if self._pieces else b""

    def interrupt(self) -> None:
        raise AssertionError("nobody pressed Ctrl+C")

    def poll(self) -> tuple[int | None, int | None] | None:
        return 0, None

    def end(self) -> None:
        self._pieces.clear()


def terminal(found: bytes) -> None:
    shown = Terminal(_Recorded(found), most=50_000)
    lines = shown.read(1)
    assert all("\n" not in line.text and len(line.text) <= 4_000 for line in lines)
    for line in lines:
        if line.log is not None:
            assert line.log[1] >= 0
    assert len(shown.transcript) <= 50_000
    error, _ = python_error(shown.transcript, "my_first_node.py")
    source = read_node(RIGHT.get, NODE, ASSIGNMENT.function)
    assert source is not None
    behind_error(Raised(error, None, source, ASSIGNMENT))


def diagnosis(found: bytes) -> None:
    source = read_node({NODE: found}.get, NODE, ASSIGNMENT.function)
    if source is not None:
        suspect = Suspect(source, ASSIGNMENT)
        for symptom in SYMPTOMS:
            mistake = behind_symptom(symptom, suspect)
            assert mistake is None or mistake.kind in CATALOGUE


def _with(path: str, found: bytes) -> Submission:
    files = {**RIGHT, path: found}
    return Submission(
        path=Path("/nowhere"),
        name="fuzzed",
        origin="directory",
        modes="recorded",
        sha256="",
        root=".",
        files=tuple(SourceFile(p, "file", 0o755, data) for p, data in sorted(files.items())),
    )


def _fixed(path: str, check: str) -> Target:
    def target(found: bytes) -> None:
        submission = _with(path, found)
        plan = fix_files(submission, ASSIGNMENT, check)
        diff(plan.old, plan.new)
        again = fix_files(plan.new.put_into(submission), ASSIGNMENT, check)
        assert not again.fixed, (again.fixed, plan.fixed)
        new = plan.new.data(path)
        if path.endswith(".py") and fault_of(found) is None:
            assert new is not None
            assert fault_of(new) is None

    return target


def node_fixes(found: bytes) -> None:
    files = Files.of(_with(NODE, found))
    for kind in CATALOGUE.values():
        case = Case(files, Finding("run.output", kind.id), ASSIGNMENT)
        new = first_fix(case, kind.fixed_by)
        if new is not None:
            diff(files, new)


TARGETS: dict[str, Target] = {
    "python": python,
    "manifest": manifest,
    "setup_py": setup_py,
    "setup_cfg": setup_cfg,
    "build_log": build_log,
    "terminal": terminal,
    "diagnosis": diagnosis,
    "fix_manifest": _fixed(MANIFEST, "package.manifest"),
    "fix_setup_py": _fixed(SETUP, "entry_point.mapping"),
    "fix_setup_cfg": _fixed(CFG, "package.setup_cfg"),
    "fix_node": _fixed(NODE, "source.node_file"),
    "fix_first_line": _fixed(NODE, "source.shebang"),
    "fix_data_files": _fixed(SETUP, "package.marker"),
    "node_fixes": node_fixes,
}
SEEDS: dict[str, bytes] = {
    "python": RIGHT[NODE],
    "manifest": RIGHT[MANIFEST],
    "setup_py": RIGHT[SETUP],
    "setup_cfg": RIGHT[CFG],
    "build_log": b'Traceback (most recent call last):\n  File "setup.py", line 3, in <module>\n'
    b"NameError: name 'x' is not defined\n---\nSummary: 0 packages finished [1.0s]\n",
    "terminal": b"[INFO] [1795226661.262229158] [my_first_node]: Hello time: 0\r\n\x1b[31mTraceback"
    b' (most recent call last):\r\n  File "a/b.py", line 1\r\nTypeError: f() missing\r\n',
    "diagnosis": RIGHT[NODE],
    "fix_manifest": RIGHT[MANIFEST],
    "fix_setup_py": RIGHT[SETUP],
    "fix_setup_cfg": RIGHT[CFG],
    "fix_node": RIGHT[NODE],
    "fix_first_line": RIGHT[NODE],
    "fix_data_files": RIGHT[SETUP],
    "node_fixes": RIGHT[NODE],
}
"""A right example for each target, to begin from."""
