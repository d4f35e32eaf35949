"""The build stage: does `colcon build` install the package so that ROS finds it?"""

from __future__ import annotations

import ast
import re
from collections.abc import Mapping
from typing import TYPE_CHECKING

from grader.base.i18n.message import joined, say
from grader.base.shown import shown
from grader.mistakes.slips import description, variant_of, words_of
from grader.package.source.broken_python import fault_of
from grader.package.source.module import parse_module
from grader.package.source.names import dotted
from grader.package.source.other_encoding import declaration, kind_of_encoding
from grader.package.source.pasted import labels_in
from grader.package.source.python import PythonFault
from grader.package.source.setup_cfg import KEYS
from grader.package.source.setup_faults import argument_line, setup_fault, source_folders
from grader.package.source.setup_packages import packages_of, parsed_setup
from grader.package.source.setup_py import called_value, entry_outside, missing_imports
from grader.package.source.slips import slip_of
from grader.report.model import Where
from grader.sandbox.base import LOAD
from grader.verdict.checks.build_log import is_inside, last_error, setup_error, summary_of
from grader.verdict.checks.declare import BUILD, check
from grader.verdict.checks.faults import limit_name
from grader.verdict.checks.not_python import without_guess
from grader.verdict.checks.own_interface import build_stopped
from grader.verdict.checks.parsed import has_subpackages, node_path, printable_reason
from grader.verdict.outcome import Blocked, Failed, Inconclusive, Passed

if TYPE_CHECKING:
    from grader.verdict.evidence import Evidence

NOTHING_BUILT = "Summary: 0 packages finished"
NOT_THERE = re.compile(r"FileNotFoundError: .{0,60}No such file or directory: '([\w./-]{1,120})'")
NOT_CALLABLE = re.compile(r"TypeError: '(?:tuple|list|str)' object is not callable")
NO_COPY = re.compile(r"can't copy '(?:[^'\n]{0,300}/build/[^'/]{1,100}/)?(?P<path>[^'\n]{1,200})'")
NOT_INDEXED = re.compile(r"TypeError: .{0,40}(?:indices must be|is not subscriptable)")
OF_DATA_FILES = re.compile(
    r"AssertionError(?:$|: 'data_files')|TypeError: expected str, bytes or os\.PathLike object, not list"
)
FLAT = "discovered in a flat-layout"  # setuptools, if setup() has no packages
NO_FOLDER = re.compile(r"package directory '([^'\n]{1,200})' does not exist")
NO_OPTION = re.compile(
    r"error in setup\.cfg: command '([\w-]{1,40})' has no such option '([^\n]{1,60})'"
)
EGG_BASE = re.compile(r"error: error in 'egg_base' option: '([^'\n]{1,200})'")
NOT_WRITTEN = re.compile(
    r"error: \[Errno \d{1,3}\] (?:Read-only file system|Permission denied): '(?P<path>[^'\n]{1,200})'"
)
NO_VARIABLE = re.compile(
    r"^ValueError: invalid variable '|^configparser\.Interpolation\w{1,40}Error: ", re.MULTILINE
)
IGNORED = ("COLCON_IGNORE", "AMENT_IGNORE", "CATKIN_IGNORE")
"""Files for which colcon passes over a folder."""
EXITS = ("exit", "quit", "sys.exit", "os._exit", "os.abort")
NEVER_CALLED = "was never called"
NO_MARKER = "doesn't explicitly install a marker in the package index"
BAD_GROUP = "ValueError: ('Invalid group name', "
ANSWER = 'File "<unknown>", line '  # colcon evaluates setup.py's output, which has no file name


@check(
    "build.colcon",
    stage=BUILD,
    depends=["package.found"],
    after=[
        "package.manifest",
        "package.marker",
        "package.setup_cfg",
        "entry_point.mapping",
        "source.node_file",
    ],
    quotes="build_log",
)
def colcon_builds(evidence: Evidence) -> Passed:
    """The package is built and installed with colcon build."""
    build = evidence.build
    package = evidence.assignment.package
    if build.stopped_by:
        if evidence.has_mistake("package.manifest", "package.manifest_doctype"):
            raise Blocked(by="package.manifest")  # (its entities can take any time)
        raise _stopped(evidence)
    if build.status == 0 and build.is_installed(package):
        _must_be_the_only_one(evidence)
        return Passed(
            actual=say(
                "{command}: 1 package finished in {seconds} s",
                command=build.command,
                seconds=f"{build.seconds:.1f}",
            ),
            advice=_no_marker(evidence),
        )
    for cause in ("package.manifest", "package.marker"):
        if evidence.has_failed(cause) and (build.status == 0 or _is_about(cause, evidence)):
            raise Blocked(by=cause)
    if evidence.has_mistake("entry_point.mapping", "setup.missing"):
        raise Blocked(by="entry_point.mapping")
    if evidence.has_mistake("package.setup_cfg", "package.setup_cfg_syntax"):
        raise Blocked(by="package.setup_cfg")
    of_path = NOT_WRITTEN.search(build.log) or NO_VARIABLE.search(build.log)
    if evidence.has_failed("package.setup_cfg") and of_path is not None:
        raise Blocked(by="package.setup_cfg")
    option = NO_OPTION.search(build.log)
    if evidence.has_failed("package.setup_cfg") and option and option[2] in KEYS.values():
        raise Blocked(by="package.setup_cfg")
    of_group = evidence.has_mistake("entry_point.mapping", "setup.group_misspelt")
    at_margin = evidence.has_mistake("entry_point.mapping", "setup.entry_at_margin")
    if at_margin or (of_group and BAD_GROUP in build.log):
        raise Blocked(by="entry_point.mapping")
    if evidence.has_failed("entry_point.mapping") and NEVER_CALLED in build.log:
        raise Blocked(by="entry_point.mapping")
    lost = NO_FOLDER.search(build.log)
    is_inner = lost is not None and lost[1] == evidence.assignment.folder
    if is_inner and evidence.has_failed("source.node_file"):
        raise Blocked(by="source.node_file")  # (the inner folder has another name)
    raise _encoding(evidence) or _broken(evidence)


def _no_marker(evidence: Evidence) -> list[str]:
    """Return advice if the build installed no marker, and package.marker has not said so."""
    other_name = evidence.has_mistake("package.manifest", "package.name_mismatch")
    told = (
        evidence.has_failed("package.marker") or other_name
    )  # (colcon looks for the name's marker)
    if told or NO_MARKER not in evidence.build.log:
        return []
    return [
        say(
            "Look at data_files in setup.py: the build gets no line from it that installs "
            "resource/{package} as the marker. colcon added it this time, but warns that it will "
            "stop doing so.",
            package=evidence.assignment.package,
        )
    ]


def _must_be_the_only_one(evidence: Evidence) -> None:
    """Raise Failed if the workspace has copies of the package: colcon then builds none of them."""
    submission = evidence.submission
    if not submission.copies or submission.root is None:
        return
    places = ", ".join(shown(path) for path in submission.copies[:3])
    raise Failed(
        "package.duplicate",
        expected=say("one package called {package}", package=evidence.assignment.package),
        actual=say(
            "there are copies of it in {places}: colcon build refuses to build the workspace. "
            "{root} was built alone and marked.",
            places=places,
            root=shown(submission.root),
        ),
        blocks=False,
    )


def _is_about(cause: str, evidence: Evidence) -> bool:
    """Whether the log is about what another check has found."""
    log, (mistake, *_) = evidence.build.log, evidence.results[cause].mistakes
    lost = str(mistake.params.get("path", ""))
    if cause == "package.marker":
        return "resource/" in log or bool(lost and f"{lost}'" in log)
    return "package.xml" in log or "CMake" in log


def _stopped(evidence: Evidence) -> Failed | Inconclusive:
    build = evidence.build
    if build.stopped_by == LOAD:
        return Inconclusive(
            say("the machine was too busy to build it: mark it again when less runs beside it")
        )
    if build.stopped_by == "wall time":
        return Failed(
            "build.timeout",
            expected=say("colcon build ends within a few seconds"),
            actual=say(
                "it was still running after {seconds} s and was stopped",
                seconds=f"{build.seconds:.0f}",
            ),
            where=Where(file="setup.py", line=_ros_line(_setup_py(evidence))),
            variant="node" if _ros_line(_setup_py(evidence)) else "",
            words={"path": node_path(evidence)},
        )
    return Failed(
        "build.resource",
        expected=say("colcon build within the limits of the sandbox"),
        actual=say(
            "the build was stopped: it reached the limit on {limit}",
            limit=limit_name(build.stopped_by),
        ),
        where=Where(file="setup.py"),
        params={"limit": build.stopped_by},
    )


def _ros_line(found: bytes) -> int | None:
    """Return the line of setup.py that starts ROS: the code of a node is in it."""
    try:
        module = parse_module("setup.py", found)
    except (PythonFault, RecursionError, MemoryError):
        return None
    calls = [n for n in module.nodes if isinstance(n, ast.Call) and module.uses_ros]
    lines = [n.lineno for n in calls if dotted(n.func) in ("rclpy.init", "rclpy.spin")]
    return min(lines, default=None)


def _broken(evidence: Evidence) -> Failed:
    build, code = evidence.build, _setup_py(evidence)
    error, line = setup_error(build.log)
    line = line if line and line <= code.count(b"\n") + 1 else None  # (else of another file)
    error = re.sub(r"^(?:\w+\.)+(?=Invalid)", "", error)
    where = Where(file="setup.py", line=line)
    expected = say("colcon build finishes every package")
    if ANSWER in build.log and error.startswith(("SyntaxError", "ValueError", "IndentationError")):
        return _answer(evidence, expected)
    if error.startswith(("SyntaxError", "IndentationError", "TabError")):
        return unreadable_setup(code, error, where, expected=expected)
    label = next((p for p in labels_in(code) if f"'{p.found}'" in error), None)
    if label is not None and error.startswith("NameError"):
        return Failed(
            "build.setup_error",
            expected=expected,
            actual=joined(error, description(label), by=", "),
            where=Where(file="setup.py", line=label.line),
            variant=variant_of(label),
            params={"error": error},
            words=words_of(label),
        )
    if NEVER_CALLED in build.log:
        variant, ends = _never_called(code)
        return Failed(
            "build.exited",
            expected=expected,
            actual=say("setup.py ended, and setup() had not done its work"),
            where=Where(file="setup.py", line=line or ends),
            variant=variant,
            words={"path": node_path(evidence)},
        )
    if error:
        return _raised(evidence, expected, error, where)
    folder = NO_FOLDER.search(build.log)
    if source := _source_folder(code, build.log):
        return _failed(
            expected,
            source[1],
            "package_dir",
            Where(file="setup.py", line=source[2]),
            name=source[0],
        )
    if folder is not None or FLAT in build.log:
        return _not_packaged(evidence, expected, shown(folder[1]) if folder is not None else "")
    ignored = [name for name in IGNORED if evidence.submission.file(name) is not None]
    if ignored and NOTHING_BUILT in build.log:
        return Failed(
            "build.ignored",
            expected=expected,
            actual=summary_of(build.log),
            where=Where(file=ignored[0]),
            words={"name": ignored[0]},
        )
    stopped = build_stopped(evidence, build.log, expected)
    if stopped is not None:
        return stopped
    option = NO_OPTION.search(build.log)
    if option is not None:
        section, name = option.groups()
        place = _line_of_cfg(evidence, name) or Where(file="setup.cfg")
        return _failed(expected, option[0], "option", place, section=section, name=shown(name))
    ended = say("colcon ended with status {status}", status=str(build.status))
    last = last_error(build.log)
    copy = NO_COPY.search(last)
    if copy is not None:  # (the apostrophe of "can't" is no quote)
        data_files = Where(file="setup.py", line=argument_line(code, "data_files"))
        place = _named_in(code, f"'{copy['path']}'") or data_files
        marker = f"resource/{evidence.assignment.package}"
        kind = {marker: "no_marker"}.get(copy["path"], "no_copy")
        return _failed(expected, last, kind, place, name=shown(copy["path"]))
    said = last or summary_of(build.log) or ended
    return _failed(expected, said, "last" if last else "", _named_in(code, last))


def _failed(expected: str, actual: str, variant: str, where: Where | None, **words: str) -> Failed:
    """Return that the build stopped, with what its log says."""
    return Failed(
        "build.failed",
        expected=expected,
        actual=actual,
        where=where,
        variant=variant,
        words=words,
    )


def _source_folder(code: bytes, log: str) -> tuple[str, str, int] | None:
    """Return the folder of `package_dir` that is not there, what the log says of it, and its line."""
    found = NO_FOLDER.search(log) or EGG_BASE.search(log)
    folders = source_folders(code).items() if found is not None else ()
    named = [
        (name, line) for name, line in folders if found and f"{found[1]}/".startswith(f"{name}/")
    ]
    return (named[0][0], found[0], named[0][1]) if named and found else None


def _line_of_cfg(evidence: Evidence, value: str) -> Where | None:
    """Return the one line of setup.cfg that has a text; None if it is unknown."""
    file = evidence.submission.file("setup.cfg")
    text = file.data.decode("utf-8", "replace") if file is not None else ""
    lines = [n for n, row in enumerate(text.splitlines(), 1) if value and value in row]
    return Where(file="setup.cfg", line=lines[0]) if len(lines) == 1 else None


def _named_in(found: bytes, error: str) -> Where | None:
    """Return the one line of setup.py that has a value or an argument which an error names."""
    module = parsed_setup(found)
    values = re.findall(r"'([^'\n]{1,300})'", error)
    nodes = module.nodes if module is not None else ()
    lines = {
        node.lineno
        for node in nodes
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and node.value.strip("/.")
        if any(f"/{value}".endswith(f"/{node.value.strip('/')}") for value in values)
    }
    words = set(re.findall(r"\w{4,40}", error))
    arguments = {n.value.lineno for n in nodes if isinstance(n, ast.keyword) and n.arg in words}
    lines = lines or arguments
    return Where(file="setup.py", line=lines.pop()) if len(lines) == 1 else None


def _not_packaged(evidence: Evidence, expected: str, folder: str) -> Failed:
    """Return that `packages` names a folder that is not there, or that setup() has no packages."""
    package = evidence.assignment.package
    found = packages_of(_setup_py(evidence), package, nested=has_subpackages(evidence))
    actual = say("setup() gets no packages")
    if folder:
        actual = say("setup.py names a folder that is not in the package: {folder}", folder=folder)
    return Failed(
        "setup.not_packaged",
        expected=expected,
        actual=actual,
        where=Where(file="setup.py", line=found.line),
        variant="other_folder" if found.is_there else "import" if found.statement else "",
        params={"folder": folder} if folder else {},
        words={"wanted": found.wanted, "statement": found.statement, "path": folder},
    )


def _answer(evidence: Evidence, expected: str) -> Failed:
    """Return that colcon cannot read what setup.py answers: it prints, or a value is a function."""
    code = _setup_py(evidence)
    writes = any(word in code for word in (b"print", b"stdout", b"system", b"subprocess"))
    printed = say("setup.py prints something: colcon could not read its answer")
    return Failed(
        "build.setup_prints",
        expected=expected,
        actual=printed if writes else say("colcon could not read the answer of setup.py"),
        where=Where(file="setup.py", line=_first_print(evidence)),
        variant="" if writes else "answer",
    )


def _never_called(found: bytes) -> tuple[str, int | None]:
    """Return why setup() was not called, as a variant, and the line that ends setup.py before."""
    module = parsed_setup(found)
    if module is None:
        return "", None
    calls = [n for n in module.nodes if isinstance(n, ast.Call)]
    exits = any(isinstance(n, ast.Raise) for n in module.nodes)
    exits = exits or any(dotted(call.func) in EXITS for call in calls)
    setups = [n for n in calls if dotted(n.func) in ("setup", "setuptools.setup")]
    if not setups:
        return "node" if module.uses_ros else "missing", None
    ends = [s.lineno for s in module.tree.body if isinstance(s, ast.Expr) and _is_exit(s.value)]
    before = [line for line in ends if line < setups[0].lineno]
    if before or not exits:
        return "" if before else "not_done", before[0] if before else None
    return "not_done", None


def _is_exit(value: ast.expr) -> bool:
    """Whether an expression is a call such as sys.exit()."""
    return isinstance(value, ast.Call) and dotted(value.func) in EXITS


def _raised(evidence: Evidence, expected: str, error: str, where: Where) -> Failed:
    """Return the error with which setup.py stopped, or the missing comma that it comes from."""
    code = _setup_py(evidence)
    opened, imports = NOT_THERE.match(error), missing_imports(code, error)
    if opened is not None:
        name = opened[1].rpartition("/")[2]
        return _stopped_with(expected, error, where, "file", words={"name": shown(name)})
    if imports:
        words = {"statement": "; ".join(imports)}
        return _stopped_with(expected, error, where, "no_import", words=words)
    found = called_value(code) if NOT_CALLABLE.match(error) else None
    if found is not None and found.end_lineno:
        line = found.end_lineno
        place = Where(file="setup.py", line=line)
        return _stopped_with(expected, error, place, "comma", words={"line": str(line)})
    fault = setup_fault(code, error, evidence.assignment.package)
    if fault is not None:
        place = Where(file="setup.py", line=fault.line)
        return _stopped_with(expected, error, place, fault.variant, words=fault.words)
    if not is_inside(evidence.build.log, error):
        joined_values = NOT_INDEXED.match(error) is not None
        return _stopped_with(expected, error, where, "joined" if joined_values else "")
    values = re.findall(r"'([^'\n]{1,300})'", error)
    of_cfg = filter(None, (_line_of_cfg(evidence, value) for value in values))
    data_files = argument_line(code, "data_files")
    if data_files and OF_DATA_FILES.match(error):
        place = Where(file="setup.py", line=data_files)
        return _stopped_with(expected, error, place, "data_files")
    place = _named_in(code, error) or next(of_cfg, where)
    return _stopped_with(expected, error, place, "inside")


def _stopped_with(
    expected: str,
    error: str,
    where: Where,
    variant: str = "",
    *,
    params: Mapping[str, str] | None = None,
    words: Mapping[str, str] | None = None,
) -> Failed:
    """Return that setup.py stopped with an error."""
    return Failed(
        "build.setup_error",
        expected=expected,
        actual=say("setup.py stopped with {error}", error=error),
        where=where,
        variant=variant,
        params={"error": error, **(params or {})},
        words=words,
    )


def _encoding(evidence: Evidence) -> Failed | None:
    """Return that setup.py is not UTF-8 text; None if it is."""
    code = _setup_py(evidence)
    fault = fault_of(code)
    if fault is None or fault.kind != "encoding":
        return None
    line, name = declaration(code) or (fault.line, "")
    return Failed(
        "build.setup_error",
        expected=say("a file that Python can read"),
        actual=say("Python cannot read setup.py: {error}", error=printable_reason(fault.text)),
        where=Where(file="setup.py", line=line),
        variant=kind_of_encoding(code) or "other_encoding",
        params={"error": str(fault.text)},
        words={"line": str(line), "found": shown(name)},
    )


def unreadable_setup(found: bytes, error: str, where: Where, *, expected: str = "") -> Failed:
    """Return the failure of a setup.py at which Python stops with an error at a place."""
    repeated = re.search(r"keyword argument repeated: (\w{1,80})", error)
    outside = entry_outside(found)
    slip = slip_of(found) if repeated is None and outside is None else None
    variant, words = "unreadable", {}
    actual: str = say("Python cannot read setup.py: {error}", error=error)
    if repeated is not None:
        variant, words = "repeated", {"name": repeated[1]}
    elif outside is not None:
        variant, words = "outside", {"line": str(outside.above)}
        where = Where(file="setup.py", line=outside.line)
    elif slip is not None:
        variant, words = variant_of(slip), words_of(slip)
        said = say("Python cannot read setup.py: {error}", error=without_guess(error))
        actual = joined(said, description(slip), by=", ")
        where = Where(file="setup.py", line=slip.line)
    return Failed(
        "build.setup_error",
        expected=expected,
        actual=actual,
        where=where,
        variant=variant,
        params={"error": error},
        words=words,
    )


def _setup_py(evidence: Evidence) -> bytes:
    file = evidence.submission.file("setup.py")
    return file.data if file is not None and file.kind == "file" else b""


def _first_print(evidence: Evidence) -> int | None:
    text = _setup_py(evidence).decode("utf-8", errors="replace")
    for number, line in enumerate(text.splitlines(), start=1):
        if re.match(r"\s*print\s*\(", line):
            return number
    return None
