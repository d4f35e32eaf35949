"""The source stage: the node's own file, its exec bit and its first line."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from grader.checks.parsed import file_of
from grader.checks.parsed import names_in
from grader.checks.parsed import nearest
from grader.checks.parsed import node_path
from grader.checks.registry import Blocked
from grader.checks.registry import Failed
from grader.checks.registry import Passed
from grader.checks.registry import check
from grader.intake.notes import shown
from grader.report.model import Where
from grader.source.python import PythonFault
from grader.source.python import parse_python

if TYPE_CHECKING:
    from grader.evidence import Evidence
    from grader.intake.model import SourceFile

SHEBANG = "#!/usr/bin/env python3"
PYTHON3 = re.compile(
    rb"#![ \t]{0,9}(?:/usr/bin/env[ \t]{1,9}(?:-S[ \t]{1,9})?|/usr/bin/|/bin/|/usr/local/bin/)"
    rb"python3(?:\.\d{1,2})?(?P<rest>[ \t][^\r\n]{0,200})?"
)
WHY_PLACE = (
    "Python imports the node as module <package>.<file>, so the file must lie in the inner folder "
    "that has the package's name and the __init__.py."
)
WHY_EXEC = (
    "The exec bit (chmod +x) lets you start the file itself: ./{file}. ros2 run does not need it: "
    "it starts a small script that colcon makes in install/. The exercise asks for the bit, and "
    "so it is marked here, but a node that does not run has another cause."
)
WHY_SHEBANG = (
    "The first line tells Linux which program reads the file when you start it as ./{file}. "
    "Without it the shell takes the Python code for its own. (ros2 run does not need it.)"
)


@check("source.node_file", depends=["package.found"])
def node_file(evidence: Evidence) -> Passed:
    """The node's file is in the inner folder, and Python can read it."""
    path = node_path(evidence)
    file = file_of(evidence, path)
    if file is None:
        raise _not_there(evidence, path)
    if file.unreadable:
        raise Failed(
            expected=f"a file {path} that can be read",
            actual=f"it has no content here: {file.reason}",
            where=Where(file=path),
            rationale="What cannot be read can be neither marked nor run.",
            fix="Hand in a file with your code in it, readable and of ordinary size.",
            mistake="source.unreadable_node_file",
        )
    if not file.data.strip():
        raise Failed(
            expected=f"your node's code in {path}",
            actual="the file is empty",
            where=Where(file=path),
            rationale="What is in the editor's window is in the file only once it is saved.",
            fix="Save the file in your editor (Ctrl+S), then look at it with: cat " + path,
            mistake="source.empty_node_file",
        )
    try:
        parse_python(file.data)
    except PythonFault as fault:
        raise _not_python(path, fault) from None
    inner = evidence.assignment.package
    if evidence.submission.file(f"{inner}/__init__.py") is None:
        advice = (
            f"There is no {inner}/__init__.py: without it find_packages() finds nothing to "
            "install, and the node cannot be imported. Make it: an empty file is enough."
        )
        return Passed(actual=path, advice=[advice])
    return Passed(actual=path)


def _not_there(evidence: Evidence, path: str) -> Failed:
    submission, name = evidence.submission, evidence.assignment.node_file
    inner = evidence.assignment.package
    expected = f"a file {path} in the package"
    if path in submission.links_out:
        return Failed(
            expected=expected,
            actual="it is a link that leads out of the package",
            where=Where(file=path),
            rationale="What a link leads to is not handed in with it.",
            fix="Put the file itself in the link's place.",
            mistake="source.node_file_is_link",
        )
    inside = [f.path for f in submission.files if f.path.rpartition("/")[2] == name]
    inside = [p for p in inside if file_of(evidence, p)]
    elsewhere = inside or list(submission.node_files)
    if elsewhere:
        return Failed(
            expected=expected,
            actual=f"it lies in {shown(elsewhere[0])}"
            + ("" if inside else ", outside of the package"),
            where=Where(file=shown(inside[0])) if inside else None,
            rationale=WHY_PLACE,
            fix=f"Move it into the inner folder, so that it is {path} in the package.",
            mistake="source.misplaced_node_file",
            params={"path": shown(elsewhere[0])},
        )
    stem = name.removesuffix(".py")
    beside = [n for n in names_in(evidence, inner) if n != "__init__.py"]
    close = next((n for n in beside if n.partition(".")[0].lower() == stem.lower()), "")
    close = close or nearest(name, beside, cutoff=0.75)
    if close:
        return Failed(
            expected=expected,
            actual=f"there is {inner}/{shown(close)}",
            where=Where(file=f"{inner}/{shown(close)}"),
            rationale="The entry point names the file, letter by letter, and so does the exercise; "
            "capitals count.",
            fix=f"Rename it: mv {inner}/{shown(close)} {path}",
            mistake="source.misnamed_node_file",
            params={"name": shown(close)},
        )
    folder = submission.file(inner)
    there = ", ".join(shown(n) for n in beside[:4]) or "no file of yours yet"
    actual = f"{inner}/ holds {there}" if folder else f"there is no folder {inner} in the package"
    return Failed(
        expected=expected,
        actual=actual,
        where=Where(file=path),
        rationale=WHY_PLACE,
        fix=f"Make the file {path} and write the node in it.",
        mistake="source.no_node_file",
    )


def _not_python(path: str, fault: PythonFault) -> Failed:
    fixes = {
        "tabs": "Indent with spaces only. In VS Code: 'Convert Indentation to Spaces'.",
        "indentation": "Indent that line like the other lines of its block, by 4 spaces a level.",
        "encoding": "Save the file as UTF-8. In VS Code: click the encoding at the bottom right.",
        "null": "Save the file as UTF-8 text, or write it anew: this copy is damaged.",
        "size": "Keep the node's file small: it is the code of one node.",
    }
    code = f", in: {shown(fault.shown)}" if fault.shown else ""
    return Failed(
        expected="a file that Python can read",
        actual=f"{shown(fault.text)}{code}",
        where=Where(file=path, line=fault.line),
        rationale="Python reads the whole file before it runs any of it; one line that it cannot "
        "read stops all.",
        fix=fixes.get(
            fault.kind,
            "Look at that line and the one above it: a bracket, a quote or a colon is often "
            "missing there.",
        ),
        mistake="source.not_utf8" if fault.kind == "encoding" else "source.syntax_error",
        params={"error": shown(fault.text), "kind": fault.kind},
    )


def _node(evidence: Evidence) -> SourceFile:
    """Return the node's file; Blocked if there is none (a syntax error in it does not matter)."""
    file = file_of(evidence, node_path(evidence))
    if file is None:
        raise Blocked(by="source.node_file")
    return file


@check("source.exec_bit", depends=["package.found"])
def exec_bit(evidence: Evidence) -> Passed:
    """The node's file is executable."""
    path, name = node_path(evidence), evidence.assignment.node_file
    file = _node(evidence)
    mode = f"mode {file.mode & 0o777:04o}"
    if evidence.submission.modes == "unknown":
        note = "the place that it was handed in from keeps no exec bits"
        if evidence.assignment.modes == "accept-unknown":
            return Passed(
                actual=f"not known: {note}",
                advice=[f"See for yourself: ls -l {path} shows an x if the file is executable."],
            )
        raise Failed(
            expected=f"{path} with its exec bit recorded",
            actual=f"not known: {note}",
            where=Where(file=path),
            rationale=WHY_EXEC.format(file=name),
            fix="Hand in a git repository or a tar archive: both record the bit. In git: "
            f"git update-index --chmod=+x {path}",
            mistake="source.exec_bit_unknown",
        )
    if file.mode & 0o100:
        return Passed(actual=mode)
    raise Failed(
        expected=f"{path} with the exec bit, such as mode 0755",
        actual=mode,
        where=Where(file=path),
        rationale=WHY_EXEC.format(file=name),
        fix=f"chmod +x {path}",
        mistake="source.not_executable",
        params={"mode": f"{file.mode & 0o777:04o}"},
    )


@check("source.shebang", depends=["package.found"])
def shebang(evidence: Evidence) -> Passed:
    """The node's file begins with a line that names Python 3."""
    file = _node(evidence)
    if file.unreadable:
        raise Blocked(by="source.node_file")
    first = file.data[:1000].partition(b"\n")[0]
    match = PYTHON3.fullmatch(first)
    if match is not None:
        rest = match["rest"] or b""
        through_env = b"/env" in first and b"-S" not in first
        if not (rest.strip() and through_env):
            return Passed(actual=shown(first.decode("utf-8", "replace")))
    raise _no_shebang(evidence, file.data, first)


def _no_shebang(evidence: Evidence, data: bytes, first: bytes) -> Failed:
    text = shown(first.decode("utf-8", "replace").strip()) or "an empty line"
    later = [n for n, line in enumerate(data.splitlines()[:20], 1) if line[:2] == b"#!" and n > 1]
    line: int | None = 1
    if first[:3] == b"\xef\xbb\xbf":
        mistake = "source.byte_order_mark"
        actual = "a byte order mark (three invisible bytes) is in front of line 1"
        fix = "Save the file as UTF-8, not as 'UTF-8 with BOM' (in VS Code at the bottom right)."
    elif first[:2] == b"#!" and (b"\r" in first):
        mistake = "source.crlf"
        actual = "line 1 ends as Windows ends lines (CRLF): Linux looks for a program 'python3\\r'"
        fix = "Change CRLF to LF (in VS Code at the bottom right), or run: sed -i 's/\\r$//' "
        fix += node_path(evidence)
    elif first[:2] == b"#!":
        mistake, actual, fix = "source.wrong_shebang", text, f"Write as line 1: {SHEBANG}"
        if PYTHON3.fullmatch(first):
            actual += ": env takes all that follows it for one program's name"
    elif later:
        mistake, line = "source.shebang_not_first", later[0]
        actual = f"the shebang is on line {line}; line 1 is: {text}"
        fix = "Move it up: it counts only as the very first line."
    elif "python" in text and "/bin/" in text:
        mistake, actual, fix = "source.wrong_shebang", text, f"Write as line 1: {SHEBANG}"
    else:
        mistake, actual = "source.no_shebang", f"line 1 is: {text}"
        fix = f"Put this line before all others: {SHEBANG}"
        if not data.strip():
            actual = "the file is empty"
    return Failed(
        expected=f"line 1: {SHEBANG}",
        actual=actual,
        where=Where(file=node_path(evidence), line=line),
        rationale=WHY_SHEBANG.format(file=evidence.assignment.node_file),
        fix=fix,
        mistake=mistake,
    )
