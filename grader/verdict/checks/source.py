"""The source stage: the node's file, its exec bit and its first line."""

from __future__ import annotations

import codecs
import re
import shlex
from typing import TYPE_CHECKING

from grader.base.i18n.message import joined, say
from grader.base.nearest import with_difference
from grader.base.shown import shown
from grader.mistakes.hints import hints
from grader.mistakes.slips import description, variant_of, words_of
from grader.package.edit.text import read_source
from grader.package.source.broken_python import Slip
from grader.package.source.documents import document_of
from grader.package.source.names import misnamed_init
from grader.package.source.newer_python import SINCE, first_difference, with_older_quotes
from grader.package.source.pasted import Pasted, pasted_in
from grader.package.source.python import SHEBANG, PythonFault, has_no_code, parse_python
from grader.package.source.slips import slip_of
from grader.report.model import Where
from grader.verdict.checks.actual_node import actual_path, has_node, other_entries
from grader.verdict.checks.declare import INTAKE, check
from grader.verdict.checks.missing_node_file import in_init, lone_node, not_there, notebook_of
from grader.verdict.checks.not_python import failed_document, not_python
from grader.verdict.checks.parsed import file_of, names_in, node_path, printable_reason
from grader.verdict.outcome import Blocked, Failed, Passed

if TYPE_CHECKING:
    from grader.package.intake.model import SourceFile
    from grader.verdict.evidence import Evidence

MOST_ADVICE = 5
UTF_16 = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)
PYTHON3 = re.compile(
    rb"#![ \t]{0,9}(?:/usr/bin/env[ \t]{1,9}(?:-S[ \t]{1,9})?|/usr/bin/|/bin/|/usr/local/bin/)"
    rb"python3(?:\.\d{1,2})?(?P<rest>[ \t][^\r\n]{0,200})?"
)
OPTIONS = "bBdEhiIOPqsStuvVx?RJ"
"""Python's options of one letter without a value, as `python3 --help` lists them, and those it ignores."""


@check("source.node_file", stage=INTAKE, depends=["package.found"], covers="files")
def node_file(evidence: Evidence) -> Passed:
    """The node's file is in the inner folder, and Python can read it."""
    path = node_path(evidence)
    file = file_of(evidence, path)
    if file is None:
        raise not_there(evidence, path)
    if file.unreadable:
        reason = printable_reason(file.reason)
        raise Failed(
            "source.unreadable_node_file",
            expected=say("a file {path} that can be read", path=path),
            actual=say("the file cannot be read: {reason}", reason=reason),
            where=Where(file=path),
        )
    if not file.data.strip() or (has_no_code(file.data) and _beside_empty(evidence, path) != path):
        raise _empty(evidence, path, file.data)
    document = document_of(file.data)
    if document is not None:
        raise failed_document(path, document)
    try:
        parsed = parse_python(file.data)
    except PythonFault as fault:
        raise not_python(path, fault, file.data) from None
    if evidence.distro is not None and evidence.distro.python_version < SINCE:
        _older_python(path, parsed.text)
    folder = path.removesuffix(".py")
    if evidence.submission.file(f"{folder}/__init__.py") is not None:
        raise _hidden_by_folder(path, folder)
    advice = hints(parsed.tree, evidence.assignment.function)
    inner = evidence.assignment.folder
    if evidence.submission.file(f"{inner}/__init__.py") is None:
        setup = evidence.submission.file("setup.py")
        finds = setup is None or b"find_packages" in setup.data
        close = misnamed_init(names_in(evidence, inner))
        no_init = _no_init(inner, close) if finds else _init_not_needed(inner)
        advice.insert(0, no_init)
    other = _other_version(evidence, path)
    if other:
        two = say("{other} has a node too, but ros2 run starts {path}.", other=other, path=path)
        advice.insert(0, two)
    return Passed(actual=path, advice=advice[:MOST_ADVICE])


def _hidden_by_folder(path: str, folder: str) -> Failed:
    """Return the failure of a node's file beside a folder with its name."""
    return Failed(
        "source.hidden_by_folder",
        expected=say("a file {path} that Python imports", path=path),
        actual=say("there is also a folder {folder}/ with an __init__.py", folder=folder),
        where=Where(file=folder),
        words={"folder": folder},
    )


def _older_python(path: str, text: str) -> None:
    """Raise the failure of an f-string that the distro's Python cannot read."""
    older = with_older_quotes(text)
    if older is None:
        return
    line = first_difference(text, older)
    row = text.splitlines()[line - 1].strip()
    raise Failed(
        "source.syntax_error",
        expected=say("a file that Python can read"),
        actual=say("in: {code}", code=shown(row)),
        where=Where(file=path, line=line),
        variant="write",
        params={"error": "SyntaxError", "kind": "syntax"},
        words={
            "found": shown(row),
            "wanted": shown(older.splitlines()[line - 1].strip()),
            "line": "",
        },
    )


def _no_init(inner: str, close: str) -> str:
    """Return the advice on a missing __init__.py; `close` is a file with nearly this name."""
    if close:
        there = shown(close)
        return say(
            "{inner}/{there} has a wrong name: find_packages() looks for __init__.py, finds nothing "
            "to install, and the node cannot be imported. Rename it: mv {inner}/{there} "
            "{inner}/__init__.py",
            inner=inner,
            there=there,
        )
    return say(
        "There is no {inner}/__init__.py: without it find_packages() finds nothing to "
        "install, and the node cannot be imported. Make it: an empty file is enough.",
        inner=inner,
    )


def _init_not_needed(inner: str) -> str:
    """Return the advice on a missing __init__.py where setup.py does not look for it."""
    return say(
        "There is no {inner}/__init__.py. Here setup.py names the folder without find_packages(), which "
        "would not find it. Make the file all the same: an empty one is enough.",
        inner=inner,
    )


def _other_version(evidence: Evidence, path: str) -> str:
    """Return another file with a node beside a node's file that has no timer; "" if there is none."""
    file, inner = file_of(evidence, path), evidence.assignment.folder
    code = file.data if file is not None else b""
    if b"create_timer" in code:
        return ""
    others = {"__init__.py", *(node.file for node in evidence.assignment.nodes.values())}
    for name in names_in(evidence, inner):
        there = f"{inner}/{name}"
        known = name in others or there in (path, *other_entries(evidence))
        known = known or name.removesuffix(".py").encode() in code
        if name.endswith(".py") and not known and has_node(evidence, there):
            return shown(there)
    return ""


def _empty(evidence: Evidence, path: str, data: bytes) -> Failed:
    init = f"{evidence.assignment.folder}/__init__.py"
    other = init if has_node(evidence, init) else lone_node(evidence, path)
    if data.strip():
        elsewhere = say("the file has no code: your node is in {path}", path=shown(other))
    else:
        elsewhere = say("the file is empty: your node is in {path}", path=shown(other))
    if other == init:
        return in_init(path, init, elsewhere)
    if other:
        return Failed(
            "source.empty_node_file",
            expected=say("your node's code in {path}", path=path),
            actual=elsewhere,
            where=Where(file=path),
            variant="beside",
            params={"there": shown(other)},
            words={"path": path, "copy": "", "there": shlex.quote(shown(other))},
        )
    notebook = notebook_of(evidence)
    if notebook:
        return Failed(
            "source.empty_node_file",
            expected=say("your node's code in {path}", path=path),
            actual=say("the file is empty: your node is in {path}", path=shown(notebook)),
            where=Where(file=path),
            variant="notebook",
            params={"notebook": shown(notebook)},
            words={"path": path, "copy": "", "there": shown(notebook)},
        )
    copy = shown(evidence.submission.newer_copy)
    but = say("the file is empty, but {copy} is not", copy=copy)
    return Failed(
        "source.empty_node_file",
        expected=say("your node's code in {path}", path=path),
        actual=but if copy else say("the file is empty"),
        where=Where(file=path),
        variant="built" if copy else "",
        words={"path": path, "copy": copy, "there": ""},
    )


def _node(evidence: Evidence) -> tuple[str, SourceFile]:
    """Return the node's file where it is; Blocked if there is none (a syntax error does not matter)."""
    path = actual_path(evidence)
    file = file_of(evidence, path)
    if file is None:
        raise Blocked(by="source.node_file")
    return path, file


def _named(path: str) -> dict[str, str]:
    """Return the words for the command that changes the node's file at a path."""
    name = shown(path.rpartition("/")[2])
    return {"file": name, "path": shown(path), "there": shlex.quote(shown(path))}


@check("source.exec_bit", stage=INTAKE, depends=["package.found"], covers="files")
def exec_bit(evidence: Evidence) -> Passed:
    """The node's file is executable."""
    path, file = _node(evidence)
    mode = f"{file.mode & 0o777:04o}"
    words = _named(path)
    if evidence.submission.modes == "unknown":
        note = say("unknown: the submission came without exec bits")
        if evidence.assignment.modes == "accept-unknown":
            advice = say(
                "Check it yourself: ls -l {path} shows an x if the file is executable.",
                path=words["there"],
            )
            return Passed(actual=note, advice=[advice])
        raise Failed(
            "source.exec_bit_unknown",
            expected=say("{path} with its exec bit recorded", path=shown(path)),
            actual=note,
            where=Where(file=shown(path)),
            words=words,
        )
    said = say("mode {mode}", mode=mode)
    if file.mode & 0o100:
        return Passed(actual=_of(evidence, path, said))
    raise Failed(
        "source.not_executable",
        expected=say("{path} with the exec bit, such as mode 0755", path=shown(path)),
        actual=said,
        where=Where(file=shown(path)),
        params={"mode": mode},
        words=words,
    )


def _of(evidence: Evidence, path: str, text: str) -> str:
    """Return what was found in the node's file, with its path if that is not the required one."""
    return text if path == node_path(evidence) else joined(shown(path), text, by=": ")


@check("source.shebang", stage=INTAKE, depends=["package.found"], covers="files")
def shebang(evidence: Evidence) -> Passed:
    """The node's file begins with a line that names Python 3."""
    path, file = _node(evidence)
    if not file.data.strip():
        path = _beside_empty(evidence, path)
        file = file_of(evidence, path) or file
    if file.unreadable or file.data.startswith(UTF_16):
        raise Blocked(by="source.node_file")
    first = file.data[:1000].partition(b"\n")[0]
    match = PYTHON3.fullmatch(first)
    if match is not None:
        rest = match["rest"] or b""
        through_env = b"/env" in first and b"-S" not in first
        if not (rest.strip() and through_env) and not _unknown_option(rest):
            return Passed(actual=_of(evidence, path, shown(first.decode("utf-8", "replace"))))
    if document_of(file.data) is not None:
        raise Blocked(by="source.node_file")
    raise _no_shebang(path, file.data, first)


def _unknown_option(rest: bytes) -> str:
    """Return the first option behind python3 in a shebang that Python does not have, or ""."""
    for word in rest.split():
        if not word.startswith(b"-") or word.startswith(b"--") or word[1:2] in b"cmWX":
            break
        signs = word[1:].decode("ascii", "replace")
        unknown = next((sign for sign in signs if sign not in OPTIONS), "")
        if unknown:
            return f"-{unknown}"
    return ""


def _beside_empty(evidence: Evidence, path: str) -> str:
    """Return the file of the inner folder that has the node, and its first line; else `path`."""
    init = f"{evidence.assignment.folder}/__init__.py"
    if has_node(evidence, init):
        return init
    return lone_node(evidence, path) or path


def _no_shebang(path: str, data: bytes, first: bytes) -> Failed:
    text = shown(first.decode("utf-8", "replace").strip()) or say("an empty line")
    later = [n for n, line in enumerate(data.splitlines()[:20], 1) if line[:2] == b"#!" and n > 1]
    line: int | None = 1
    actual: str
    slip = slip_of(data)
    pasted = _pasted_above(data, slip, later)
    if pasted is not None:
        return _pasted_first(path, pasted)
    if first[:3] == b"\xef\xbb\xbf":
        mistake = "source.byte_order_mark"
        actual = say("a byte order mark (three invisible bytes) is in front of line 1")
    elif first[:2] == b"#!" and (b"\r" in first):
        mistake = "source.crlf"
        actual = say("line 1 has a Windows line end (CRLF): Linux looks for a program 'python3\\r'")
        if b"\n" not in data:
            actual = say("the lines end with CR alone: Linux takes the whole file for one line")
    elif first[:2] == b"#!":
        mistake, actual = "source.wrong_shebang", _wrong_shebang(text, first)
    elif later:
        mistake, line = "source.shebang_not_first", later[0]
        actual = say("the shebang is on line {line}; line 1 is: {text}", line=line, text=text)
    elif "python" in text and "/bin/" in text:
        mistake, actual = "source.wrong_shebang", with_difference(text, text, SHEBANG)
    else:
        mistake, actual = "source.no_shebang", say("line 1 is: {text}", text=text)
        if not data.strip():
            actual = say("the file is empty")
    return Failed(
        mistake,
        expected=say("line 1: {shebang}", shebang=SHEBANG),
        actual=actual,
        where=Where(file=shown(path), line=line),
        words=_named(path),
    )


def _wrong_shebang(text: str, first: bytes) -> str:
    """Say what is wrong with a shebang; `text` is how it is shown."""
    match = PYTHON3.fullmatch(first)
    if match is None:
        return with_difference(text, text, SHEBANG)
    option = _unknown_option(match["rest"] or b"")
    if option:
        return say("{text}: python3 has no option {name}", text=text, name=option)
    return say("{text}: env takes everything after it as one program name", text=text)


def _pasted_above(data: bytes, slip: Slip | None, later: list[int]) -> Pasted | Slip | None:
    """Return what was pasted above or in front of the shebang; `later`: the lines that have one."""
    if slip is not None and slip.variant == "around" and later and slip.line < later[0]:
        return slip
    return _above_shebang(data, later[0] if later else 2)


def _above_shebang(data: bytes, line: int) -> Pasted | None:
    """Return what was pasted on line 1, if nothing else is above a line."""
    source = read_source(data)
    found = [p for p in pasted_in(source) if p.line < line] if source is not None else []
    lines = {p.line: p for p in found if p.whole}
    if source is None or 1 not in lines:
        return None
    others = [n for n in range(1, line) if n not in lines and source.line(n).strip()]
    return None if others else lines[1]


def _pasted_first(path: str, pasted: Pasted | Slip) -> Failed:
    return Failed(
        "source.pasted",
        expected=say("line 1: {shebang}", shebang=SHEBANG),
        actual=joined(say("line 1 is not code"), description(pasted), by=", "),
        where=Where(file=shown(path), line=1),
        variant=variant_of(pasted),
        words=words_of(pasted),
    )
