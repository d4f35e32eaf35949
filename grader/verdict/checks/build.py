"""The build stage: does `colcon build` install the package so that ROS finds it?"""

from __future__ import annotations

import ast
import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from grader.base.i18n.message import Message, joined, say
from grader.base.nearest import nearest
from grader.base.shown import shown
from grader.mistakes.slips import description, words_of
from grader.package.source.broken_python import fault_of
from grader.package.source.module import parse_module
from grader.package.source.names import dotted
from grader.package.source.other_encoding import declaration, kind_of_encoding
from grader.package.source.pasted import labels_in
from grader.package.source.python import PythonFault
from grader.package.source.setup_cfg import KEYS, Setting, SetupCfgFault, read_setup_cfg
from grader.package.source.setup_faults import INSIDE, NOT_REACHED, UNREAD, SetupFault, setup_fault
from grader.package.source.setup_packages import packages_of, parsed_setup
from grader.package.source.setup_py import (
    called_value,
    entry_outside,
    is_setup_call,
    missing_imports,
)
from grader.package.source.slips import slip_of
from grader.report.model import Where
from grader.sandbox.base import LOAD
from grader.verdict.checks.build_log import is_inside, last_error, setup_error, summary_of
from grader.verdict.checks.declare import BUILD, check
from grader.verdict.checks.faults import limit_name
from grader.verdict.checks.not_python import without_guess
from grader.verdict.checks.own_interface import build_stopped
from grader.verdict.checks.parsed import (
    data_of,
    has_subpackages,
    node_path,
    paths_in,
    printable_reason,
)
from grader.verdict.outcome import Blocked, Failed, Inconclusive, Passed

if TYPE_CHECKING:
    from grader.verdict.evidence import Evidence

NOTHING_BUILT = "Summary: 0 packages finished"
HIDDEN = re.compile(
    r"(?:AttributeError|ImportError): .{0,120}partially initialized module '(\w{1,80})'"
)
NOT_THERE = re.compile(r"FileNotFoundError: .{0,60}No such file or directory: '([\w./-]{1,120})'")
NOT_CALLABLE = re.compile(r"TypeError: '(?:tuple|list|str)' object is not callable")
NO_COPY = re.compile(r"error: can't copy '[^'\n]{1,300}': doesn't exist")
FLAT = "discovered in a flat-layout"  # setuptools, if setup() has no packages
NO_FOLDER = re.compile(r"package directory '([^'\n]{1,200})' does not exist")
NO_OPTION = re.compile(
    r"error in setup\.cfg: command '([\w-]{1,40})' has no such option '([^\n]{1,60})'"
)
EGG_BASE = re.compile(r"error: error in 'egg_base' option: '[^'\n]{1,200}'")
NOT_WRITTEN = re.compile(
    r"error: \[Errno \d{1,3}\] (?:Read-only file system|Permission denied): '(?P<path>[^'\n]{1,200})'"
)
NO_VARIABLE = re.compile(
    r"^ValueError: invalid variable '|^configparser\.Interpolation\w{1,40}Error: ", re.MULTILINE
)
LIBRARIES = ("rclpy", "std_msgs", "geometry_msgs", "sensor_msgs", "launch", "setuptools")
"""Packages that students name in packages=, as if setup() had to install them."""
LINKED = ("package.xml", "setup.cfg", "setup.py")
"""Files of the package that colcon build --symlink-install links into the build folder."""
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
    build = evidence.build
    error, line = setup_error(build.log)
    error = re.sub(r"^(?:\w+\.)+(?=Invalid)", "", error)
    where = Where(file="setup.py", line=line)
    expected = say("colcon build ends with: Summary: 1 package finished")
    if ANSWER in build.log and error.startswith(("SyntaxError", "ValueError", "IndentationError")):
        return _answer(evidence, expected)
    if error.startswith(("SyntaxError", "IndentationError", "TabError")):
        return unreadable_setup(_setup_py(evidence), error, where, expected=expected)
    label = next((p for p in labels_in(_setup_py(evidence)) if f"'{p.found}'" in error), None)
    if label is not None and error.startswith("NameError"):
        return Failed(
            "build.setup_error",
            expected=expected,
            actual=joined(error, description(label), by=", "),
            where=Where(file="setup.py", line=label.line),
            variant=label.variant,
            params={"error": error},
            words=words_of(label),
        )
    if NEVER_CALLED in build.log:
        never = _never_called(_setup_py(evidence))
        refused = _fault(evidence, NOT_REACHED)
        if refused is not None:
            return Failed(
                "build.exited",
                expected=expected,
                actual=_never(refused.variant),
                where=Where(file="setup.py", line=refused.line),
                variant=refused.variant,
                params={"error": NOT_REACHED},
                words=refused.words,
            )
        return Failed(
            "build.exited",
            expected=expected,
            actual=_never(never.variant),
            where=Where(file="setup.py", line=line or never.line),
            variant=never.variant,
            words={"path": node_path(evidence), "name": never.function},
        )
    if error:
        return _raised(evidence, expected, error, where)
    folder = NO_FOLDER.search(build.log)
    source = _fault(evidence, folder[0]) if folder is not None else None
    if folder is not None and source is not None:
        return _refused(expected, folder[0], source)
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
        return _unknown_option(evidence, expected, option)
    ended = say("colcon ended with status {status}", status=str(build.status))
    copy = NO_COPY.search(build.log) or EGG_BASE.search(build.log)
    fault = _fault(evidence, copy[0]) if copy is not None else None
    if copy is not None and fault is not None:
        return _refused(expected, copy[0], fault)
    last = last_error(build.log)
    folder_copied = _folder_copied(evidence, last)
    return Failed(
        "build.failed",
        expected=expected,
        actual=last or summary_of(build.log) or ended,
        where=_named_in(_setup_py(evidence), last),
        variant="folder_of_files" if folder_copied else "last" if last else "",
        params={"status": -1 if build.status is None else build.status},
        words={"name": shown(folder_copied)} if folder_copied else {},
    )


def _folder_copied(evidence: Evidence, error: str) -> str:
    """Return the folder of the package that data_files lists like a file; "" if it is none."""
    match = NO_COPY_OF.search(error)
    path = match["path"] if match is not None else ""
    there = any(file.path.startswith(f"{path}/") for file in evidence.submission.files)
    return path if there else ""


def _line_of_cfg(evidence: Evidence, error: str) -> Where | None:
    """Return the one line of setup.cfg with the value that an error names; None if it is unknown."""
    value, file = re.search(r"'([^'\n]{1,300})'", error), evidence.submission.file("setup.cfg")
    text = file.data.decode("utf-8", "replace") if file is not None else ""
    rows = enumerate(text.splitlines(), 1)
    lines = [n for n, row in rows if value is not None and value[1] in row]
    return Where(file="setup.cfg", line=lines[0]) if len(lines) == 1 else None


def _named_in(found: bytes, error: str) -> Where | None:
    """Return the one line of setup.py with the path that an error names; None if it is unknown."""
    path = re.search(r"'([^'\n]{1,300})'", error)
    module = parsed_setup(found)
    if path is None or module is None:
        return None
    lines = {
        node.lineno
        for node in module.nodes
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and node.value.strip("/.")
        if f"/{path[1]}".endswith(f"/{node.value.strip('/')}")
    }
    return Where(file="setup.py", line=lines.pop()) if len(lines) == 1 else None


def _refused(expected: str, error: str, fault: SetupFault) -> Failed:
    """Return that the build stopped at a value of setup.py."""
    return Failed(
        "build.failed",
        expected=expected,
        actual=error,
        where=Where(file="setup.py", line=fault.line),
        variant=fault.variant,
        params={"error": error},
        words=fault.words,
    )


def _unknown_option(evidence: Evidence, expected: str, found: re.Match[str]) -> Failed:
    """Return that setuptools refuses a key of setup.cfg."""
    section, name = found.groups()
    file = evidence.submission.file("setup.cfg")
    try:
        settings = read_setup_cfg(file.data if file else b"").sections.get(section, {})
    except SetupCfgFault:
        settings = {}
    written = next((key for key in settings if key.replace("-", "_") == name), "")
    setting = settings.get(written)
    if (
        written
        and setting is not None
        and re.match(r"['\"]|[\w.]+:\w+", f"{written[:1]}{setting.value}")
    ):
        return _entry_in_cfg(expected, found[0], written, setting)
    close = nearest(name, KEYS.values(), cutoff=0.75)
    return Failed(
        "build.failed",
        expected=expected,
        actual=found[0],
        where=Where(file="setup.cfg", line=settings[written].line if written else None),
        variant="option_close" if close else "option",
        params={"error": found[0]},
        words={"name": written or name, "section": section, "wanted": close},
    )


def _entry_in_cfg(expected: str, error: str, name: str, setting: Setting) -> Failed:
    """Return that an entry of console_scripts is written in setup.cfg."""
    return Failed(
        "build.failed",
        expected=expected,
        actual=error,
        where=Where(file="setup.cfg", line=setting.line),
        variant="entry",
        params={"error": error, "entry": setting.line},
        words={"name": shown(f"{name} = {setting.value}"), "line": setting.line},
    )


def _fault(evidence: Evidence, error: str) -> SetupFault | None:
    return setup_fault(_setup_py(evidence), error, evidence.assignment.package, paths_in(evidence))


def _not_packaged(evidence: Evidence, expected: str, folder: str) -> Failed:
    """Return that `packages` names a folder that is not there, or that setup() has no packages."""
    package = evidence.assignment.package
    found = packages_of(_setup_py(evidence), package, nested=has_subpackages(evidence))
    actual, line = say("setup() gets no packages"), found.line
    variant = "import" if found.statement else "misspelt" if found.misspelt else "argument"
    if folder:
        actual = say("setup.py names a folder that is not in the package: {folder}", folder=folder)
        variant = "import" if found.statement else "text" if found.is_text else "folder"
        others = {name: at for name, at in found.extra.items() if name.replace(".", "/") == folder}
        if found.is_there and others:
            variant, line = "other_folder", min(others.values())
            variant = "library" if folder in LIBRARIES else variant
        elif found.is_there or (found.is_moved and not found.is_text):
            variant = "unknown_folder"
        variant = "made_name" if found.variable else variant
    return Failed(
        "setup.not_packaged",
        expected=expected,
        actual=actual,
        where=Where(file="setup.py", line=line),
        variant=variant,
        params={"folder": folder} if folder else {},
        words={
            "wanted": found.wanted,
            "statement": found.statement,
            "name": found.variable or found.misspelt,
            "path": folder,
        },
    )


def _answer(evidence: Evidence, expected: str) -> Failed:
    """Return why colcon cannot read what setup.py answers: it prints, or a value is a function."""
    code, fault = _setup_py(evidence), _fault(evidence, UNREAD)
    if fault is not None and b"print" not in code:
        return Failed(
            "build.setup_error",
            expected=expected,
            actual=say("setup() gets the function {name} and not its result", **fault.words),
            where=Where(file="setup.py", line=fault.line),
            variant=fault.variant,
            params={"error": UNREAD},
            words=fault.words,
        )
    writes = any(word in code for word in (b"print", b"stdout", b"system", b"subprocess"))
    line = _python_requires(evidence)
    if line and not writes:
        return Failed(
            "build.setup_prints",
            expected=expected,
            actual=say("colcon could not read the answer of setup.py"),
            where=Where(file="setup.cfg", line=line),
            variant="cfg_python",
            params={"entry": line},
        )
    printed = say("setup.py prints something: colcon could not read its answer")
    return Failed(
        "build.setup_prints",
        expected=expected,
        actual=printed if writes else say("colcon could not read the answer of setup.py"),
        where=Where(file="setup.py", line=_first_print(evidence)),
        variant="" if writes else "answer",
    )


def _python_requires(evidence: Evidence) -> int:
    """Return the line of python_requires in setup.cfg, of which setuptools makes an object; else 0."""
    try:
        cfg = read_setup_cfg(data_of(evidence, "setup.cfg") or b"")
    except SetupCfgFault:
        return 0
    found = cfg.sections.get("options", {}).get("python_requires")
    return found.line if found is not None else 0


@dataclass(frozen=True)
class _NeverCalled:
    """Why setup() was not called, and the function that contains the call and does not run."""

    variant: str = ""
    line: int | None = None
    function: str = ""


def _never_called(found: bytes) -> _NeverCalled:
    """Return why setup() was not called; no variant if setup.py calls it, and exits before."""
    try:
        module = parse_module("setup.py", found)
    except (PythonFault, RecursionError, MemoryError):
        return _NeverCalled()
    calls = [n for n in module.nodes if isinstance(n, ast.Call)]
    raises = any(isinstance(n, ast.Raise) for n in module.nodes)
    exits = raises or any(dotted(n.func) in EXITS for n in calls)
    calls = [n for n in calls if dotted(n.func) in ("setup", "setuptools.setup")]
    if not calls:
        return _NeverCalled("node" if module.uses_ros else "missing")
    used = {n.id for n in module.nodes if isinstance(n, ast.Name)}
    for statement in module.tree.body:
        unused = isinstance(statement, ast.FunctionDef) and statement.name not in used
        if isinstance(statement, ast.FunctionDef) and unused:
            inside = set(ast.walk(statement))
            if all(call in inside for call in calls):
                return _NeverCalled("function", statement.lineno, statement.name)
    if not exits and any(n in ast.walk(s) for n in calls for s in _plain(module.tree.body)):
        return _NeverCalled("refused", calls[0].lineno)
    ends = [s.lineno for s in _plain(module.tree.body) if _is_exit(s)]
    if ends and ends[0] < calls[0].lineno:
        return _NeverCalled("", ends[0])
    return _NeverCalled("not_done")


def _is_exit(statement: ast.stmt) -> bool:
    """Whether a statement is a call such as sys.exit()."""
    value = statement.value if isinstance(statement, ast.Expr) else None
    return isinstance(value, ast.Call) and dotted(value.func) in EXITS


def _plain(body: list[ast.stmt]) -> list[ast.stmt]:
    """Return the statements that always run."""
    return [s for s in body if isinstance(s, ast.Expr | ast.Assign)]


def _never(variant: str) -> Message:
    """Return what is known if setup() did not finish its work."""
    if variant.startswith("entries_") or variant.startswith("refused"):
        return say("setuptools stopped in setup(), and colcon does not show its reason")
    if variant == "guard":
        return say("the condition in this line is never true, so nothing calls setup()")
    if variant == "not_done":
        return say("setup.py ended, and setup() had not done its work")
    return say("setup.py ended before it called setup()")


def _unquoted(found: bytes, error: str) -> ast.Name | None:
    """Return the key of a dict that lacks its quotes, if that is why setup.py stops."""
    match = re.search(r"NameError: name '(\w{1,80})' is not defined", error)
    try:
        module = parse_module("setup.py", found)
    except (PythonFault, RecursionError, MemoryError):
        return None
    for node in module.nodes:
        for key in node.keys if isinstance(node, ast.Dict) else ():
            if match is not None and isinstance(key, ast.Name) and key.id == match[1]:
                return key
    return None


OWN_NAME = re.compile(
    r"cannot import name '(?P<name>\w{1,120})' from '(?P<module>\w{1,120}(?:\.\w{1,120}){0,9})'"
)
NO_COPY_OF = re.compile(r"can't copy '[^']{0,300}/build/[^'/]{1,100}/(?P<path>[^']{1,200})'")


def _raised(evidence: Evidence, expected: str, error: str, where: Where) -> Failed:
    """Return the error with which setup.py stopped, or the missing comma that it comes from."""
    submission, code = evidence.submission, _setup_py(evidence)
    hidden, opened = HIDDEN.match(error), NOT_THERE.match(error)
    if hidden is not None and submission.file(f"{hidden[1]}.py") is not None:
        place, words = Where(file=f"{hidden[1]}.py"), {"name": hidden[1]}
        return _stopped_with(expected, error, place, "hidden", words=words)
    if opened is not None and submission.file(opened[1].rpartition("/")[2]) is not None:
        name = opened[1].rpartition("/")[2]
        if name in LINKED and f"'{opened[1]}'" in code.decode("utf-8", "replace").replace('"', "'"):
            words = {"name": name, "found": opened[1]}
            return _stopped_with(expected, error, where, "other_place", words=words)
        return _stopped_with(expected, error, where, "relative", words={"name": name})
    key = _unquoted(code, error)
    if key is not None:
        place = Where(file="setup.py", line=key.lineno)
        return _stopped_with(expected, error, place, "key", params={"name": key.id})
    name = OWN_NAME.search(error)
    path = f"{name['module'].replace('.', '/')}.py" if name is not None else ""
    own = submission.file(path) or submission.file(f"{path.removesuffix('.py')}/__init__.py")
    if name is not None and own is not None and own.kind == "file":
        module = parsed_setup(own.data)
        close = nearest(name["name"], module.names, cutoff=0.75) if module is not None else ""
        words = {"name": name["name"], "close": close, "path": own.path}
        return _stopped_with(expected, error, where, "own_close" if close else "own", words=words)
    imports = missing_imports(code, error)
    if imports:
        words = {"statement": "; ".join(imports)}
        return _stopped_with(expected, error, where, "no_import", words=words)
    found = called_value(code) if NOT_CALLABLE.match(error) else None
    if found is not None and found.end_lineno:
        place, words = (
            Where(file="setup.py", line=found.end_lineno),
            {"line": str(found.end_lineno)},
        )
        return _stopped_with(expected, error, place, "comma", words=words)
    inside = is_inside(evidence.build.log, error)
    fault = _fault(evidence, error) or (_fault(evidence, INSIDE) if inside else None)
    if fault is not None:
        place = Where(file="setup.py", line=fault.line)
        return _stopped_with(expected, error, place, fault.variant, words=fault.words)
    if inside:
        where = _named_in(code, error) or _line_of_cfg(evidence, error) or where
    return _stopped_with(expected, error, where, "inside" if inside else "")


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
    twice = _repeated(found, repeated[1]) if repeated is not None else []
    outside = entry_outside(found)
    slip = slip_of(found) if repeated is None and outside is None else None
    variant, words = "unreadable", {}
    if repeated is not None:
        variant, words = "repeated", {"name": repeated[1]}
        if len(twice) == 2:
            first, last = twice
            variant = "repeated_lines"
            words = {"name": repeated[1], "line": str(first.lineno), "last": str(last.lineno)}
            empty = [one for one in twice if _is_empty(one.value)]
            both = all(isinstance(one.value, ast.List) for one in twice)
            if not empty and both:
                variant = "repeated_lists"
            if len(empty) == 1:
                variant, where = "repeated_empty", Where(file="setup.py", line=empty[0].lineno)
    elif outside is not None:
        variant = "outside_empty" if outside.is_empty else "outside"
        words = {"line": str(outside.above)}
        where = Where(file="setup.py", line=outside.line)
    elif slip is not None:
        variant, words = slip.variant, words_of(slip)
    said = error if slip is None else without_guess(error)
    actual: str = say("Python cannot read setup.py: {error}", error=said)
    if slip is not None:
        actual, where = (
            joined(actual, description(slip), by=", "),
            Where(file="setup.py", line=slip.line),
        )
    return Failed(
        "build.setup_error",
        expected=expected,
        actual=actual,
        where=where,
        variant=variant,
        params={"error": error},
        words=words,
    )


def _repeated(found: bytes, name: str) -> list[ast.keyword]:
    """Return the arguments of setup() with a name."""
    try:
        tree = ast.parse(found)  # (Python refuses the file only when it compiles the tree)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return []
    calls = [node for node in ast.walk(tree) if is_setup_call(node)]
    call = calls[0] if len(calls) == 1 else None
    return [k for k in call.keywords if k.arg == name] if isinstance(call, ast.Call) else []


def _is_empty(node: ast.expr) -> bool:
    """Whether a value is an empty list, text or dict, or contains only such values."""
    if isinstance(node, ast.Dict):
        return all(_is_empty(value) for value in node.values)
    if isinstance(node, ast.List | ast.Tuple):
        return not node.elts
    return isinstance(node, ast.Constant) and node.value in ("", None)


def _setup_py(evidence: Evidence) -> bytes:
    file = evidence.submission.file("setup.py")
    return file.data if file is not None and file.kind == "file" else b""


def _first_print(evidence: Evidence) -> int | None:
    text = _setup_py(evidence).decode("utf-8", errors="replace")
    for number, line in enumerate(text.splitlines(), start=1):
        if re.match(r"\s*print\s*\(", line):
            return number
    return None
