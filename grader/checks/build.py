"""The build stage: does the real `colcon build` make the package that ROS then finds?"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from grader.checks.registry import Blocked
from grader.checks.registry import Failed
from grader.checks.registry import Passed
from grader.checks.registry import check
from grader.report.model import Where

if TYPE_CHECKING:
    from grader.evidence import Evidence

NEVER_CALLED = "was never called"
ANSWER = 'File "<unknown>", line '  # colcon evaluates the answer: it has no file name
WHY = (
    "colcon runs your setup.py to install the package into the workspace's install folder; "
    "ros2 run only ever looks there."
)


@check("build.colcon", depends=["package.found"])
def colcon_builds(evidence: Evidence) -> Passed:
    """`colcon build` builds and installs the package."""
    build = evidence.build
    package = evidence.assignment.package
    if build.stopped_by:
        raise _stopped(evidence)
    if build.status == 0 and build.is_installed(package):
        return Passed(actual=f"{build.command}: 1 package finished in {build.seconds:.1f} s")
    for cause in ("package.manifest", "package.marker"):
        if evidence.has_failed(cause) and (build.status == 0 or _is_about(cause, build.log)):
            raise Blocked(by=cause)
    if evidence.has_mistake("entry_point.mapping", "setup.missing"):
        raise Blocked(by="entry_point.mapping")
    if evidence.has_mistake("package.setup_cfg", "package.setup_cfg_syntax"):
        raise Blocked(by="package.setup_cfg")
    if evidence.has_failed("entry_point.mapping") and NEVER_CALLED in build.log:
        raise Blocked(by="entry_point.mapping")
    raise _broken(evidence)


def _is_about(cause: str, log: str) -> bool:
    words = {"package.manifest": "package.xml", "package.marker": "resource/"}
    return words[cause] in log or (cause == "package.manifest" and "CMake" in log)


def _stopped(evidence: Evidence) -> Failed:
    build = evidence.build
    if build.stopped_by == "wall time":
        return Failed(
            expected="colcon build ends within a few seconds",
            actual=f"it was still running after {build.seconds:.0f} s and was stopped",
            where=Where(file="setup.py"),
            rationale=WHY + " A setup.py that loops or waits never lets it finish.",
            fix="Take the loop, the sleep or the input() out of setup.py.",
            mistake="build.timeout",
        )
    return Failed(
        expected="colcon build within the limits of the sandbox",
        actual=f"the build was stopped: it met the limit on {build.stopped_by}",
        where=Where(file="setup.py"),
        rationale=WHY,
        fix="Let setup.py only describe the package: no large output, no other programs.",
        mistake="build.resource",
        params={"limit": build.stopped_by},
    )


def _broken(evidence: Evidence) -> Failed:
    build = evidence.build
    error, line = python_error(build.log, "setup.py")
    where = Where(file="setup.py", line=line)
    expected = "colcon build ends with: Summary: 1 package finished"
    if ANSWER in build.log and error.startswith(("SyntaxError", "ValueError", "IndentationError")):
        return Failed(
            expected=expected,
            actual="setup.py prints something: colcon could not read its answer",
            where=Where(file="setup.py", line=_first_print(evidence)),
            rationale=WHY + " colcon asks setup.py for its data and reads what it prints as the "
            "answer, so a print() of yours ends up in the middle of it.",
            fix="Take the print() out of setup.py, then build again.",
            mistake="build.setup_prints",
        )
    if error.startswith(("SyntaxError", "IndentationError", "TabError")):
        return Failed(
            expected=expected,
            actual=f"Python cannot read setup.py: {error}",
            where=where,
            rationale=WHY + " A file that Python cannot read cannot be run.",
            fix="Mend that line of setup.py (often the line above lacks a comma, a quote or a "
            "bracket), then build again.",
            mistake="build.setup_error",
            params={"error": error},
        )
    if NEVER_CALLED in build.log:
        return Failed(
            expected=expected,
            actual="setup.py ended before it had called setup()",
            where=where,
            rationale=WHY + " It has to reach its call of setup(); a sys.exit() before or in it "
            "ends it silently.",
            fix="Take the exit out of setup.py and compare it with the one that "
            "ros2 pkg create makes.",
            mistake="build.exited",
        )
    if error:
        return Failed(
            expected=expected,
            actual=f"setup.py stopped with {error}",
            where=where,
            rationale=WHY,
            fix="Mend what the error names, then build again.",
            mistake="build.setup_error",
            params={"error": error},
        )
    return Failed(
        expected=expected,
        actual=_summary(build.log) or f"colcon ended with status {build.status}",
        rationale=WHY,
        fix="Read the build log below from its first error on; build again after each change.",
        mistake="build.failed",
        params={"status": -1 if build.status is None else build.status},
    )


def python_error(text: str, file: str) -> tuple[str, int | None]:
    """Return the last Python error in a text ("TypeError: …") and its line in `file`, if any."""
    errors = re.findall(
        r"^((?:[A-Za-z_][\w.]*\.)?[A-Z]\w*(?:Error|Exception|Exit|Interrupt|Iteration)(?:: .*)?)$",
        text,
        re.MULTILINE,
    )
    lines = re.findall(rf'File "[^"\n]*{re.escape(file)}", line (\d+)', text)
    return (errors[-1][:400] if errors else ""), (int(lines[-1]) if lines else None)


def _first_print(evidence: Evidence) -> int | None:
    file = evidence.submission.file("setup.py")
    text = file.data.decode("utf-8", errors="replace") if file is not None else ""
    for number, line in enumerate(text.splitlines(), start=1):
        if re.match(r"\s*print\s*\(", line):
            return number
    return None


def _summary(log: str) -> str:
    lines = [line.strip() for line in log.splitlines() if line.strip()]
    wanted = ("Failed", "error:", "ERROR", "Error", "Summary:")
    telling = [line for line in lines if any(word in line for word in wanted)]
    return " / ".join(telling[:3])[:600]
