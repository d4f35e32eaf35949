"""Marks the checkout of a student in Classroom 50's runner, and leaves result.json there.

Classroom 50 runs this file in the container that the assignment's `runtime` names: the lab's image. It has
no keys: a student can read all that is in it. Marks that count are those of your own machine
(`grader classroom50-compare`).
"""

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from datetime import datetime, timezone
from pathlib import Path
from typing import Any

ASSIGNMENT, DISTRO = "", "jazzy"
LAB = "/opt/ros2_teaching_lab"
WANTED = ("CLASSROOM", "ASSIGNMENT", "SUBMISSION_TAG", "COMMIT_URL", "RELEASE_URL")
FACTORS = (1, 10, 100)


def main() -> int:
    """Return 0 if the checkout was marked, whatever its points are."""
    missing = [name for name in WANTED if not os.environ.get(name)]
    if missing:
        print(f"autograder.py: Classroom 50's runner sets {', '.join(missing)}", file=sys.stderr)
        return 2
    with tempfile.TemporaryDirectory() as folder:
        report = marked(Path.cwd(), Path(folder))
    if report is None or report["status"] != "graded":
        print("autograder.py: there is no verdict: see the grader's output above", file=sys.stderr)
        return 3
    result = result_of(report, os.environ, committed(Path.cwd()))
    write(Path("result.json"), json.dumps(result, indent=2) + "\n")
    write(Path("release-body.md"), body(result))
    return 0


def marked(checkout: Path, folder: Path) -> dict[str, Any] | None:
    """Return the grader's report of a checkout; None if it wrote none."""
    lab = Path(os.environ.get("GRADER_CHECKOUT") or LAB)
    words = ["grade", str(checkout), "--assignment", ASSIGNMENT, "--distro", DISTRO]
    words += ["--out", str(folder), "--name", os.environ.get("OWNER") or "student"]
    words += ["--sandbox", os.environ.get("GRADER_SANDBOX") or "account"]
    python = lab / ".venv/bin/python"
    # (from the lab's folder: nothing is imported from the student's)
    subprocess.run([python, "-m", "grader", *words], cwd=lab, check=False)
    found = sorted(folder.rglob("report.json"))
    return json.loads(found[0].read_bytes()) if found else None


def committed(checkout: Path) -> datetime:
    """Return when the commit was made, by the student's own clock; now if that is not known."""
    # (the checkout belongs to the runner's user, not to root)
    words = ["git", "-c", "safe.directory=*", "log", "-1", "--format=%ct"]
    try:
        done = subprocess.run(words, cwd=checkout, check=True, capture_output=True, text=True)
        return datetime.fromtimestamp(int(done.stdout), timezone.utc)
    except (OSError, subprocess.CalledProcessError, ValueError, OverflowError):
        return datetime.now(timezone.utc)


def result_of(
    report: Mapping[str, Any], environment: Mapping[str, str], when: datetime
) -> dict[str, Any]:
    """Return the result by Classroom 50's schema `classroom50/result/v1`.

    Its points are whole numbers: fractions are multiplied by 10 or 100, for all students alike.
    """
    checks = report["checks"]
    factor = next((n for n in FACTORS if all(_is_whole(c["max_score"] * n) for c in checks)), 100)
    tests = [
        {
            "test-name": f"{check['id']}: {check['title']}",
            "passed": check["status"] == "passed",
            "score": round(check["score"] * factor),
            "max-score": round(check["max_score"] * factor),
        }
        for check in checks
    ]
    return {
        "schema": "classroom50/result/v1",
        "classroom": environment["CLASSROOM"],
        "assignment": environment["ASSIGNMENT"],
        "assignment_type": environment.get("ASSIGNMENT_TYPE") or "individual",
        "owner": environment.get("OWNER") or environment.get("USERNAME", ""),
        "submission": environment["SUBMISSION_TAG"],
        "commit": environment["COMMIT_URL"],
        "release": environment["RELEASE_URL"],
        "review": environment.get("REVIEW_URL") or environment["COMMIT_URL"],
        "datetime": _utc(when),
        "graded_at": _utc(datetime.now(timezone.utc)),
        "score": sum(test["score"] for test in tests),
        "max-score": sum(test["max-score"] for test in tests),
        "tests": tests,
    }


def body(result: Mapping[str, Any]) -> str:
    """Return the text of the release, in Markdown."""
    rows = [
        f"| {'passed' if test['passed'] else 'not passed'} | {test['score']} of {test['max-score']} "
        f"| `{test['test-name']}` |"
        for test in result["tests"]
    ]
    head = f"**{result['score']} of {result['max-score']} points**\n\n| | points | check |\n|---|---|---|\n"
    return head + "\n".join(rows) + "\n\nRun `check` in the lab: it says why a check fails.\n"


def write(path: Path, text: str) -> None:
    """Write a new file in the place of whatever the student has there."""
    path.unlink(missing_ok=True)
    with path.open("x", encoding="utf-8") as file:
        file.write(text)


def _is_whole(value: float) -> bool:
    return abs(value - round(value)) < 1e-6


def _utc(when: datetime) -> str:
    return when.astimezone(timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")


if __name__ == "__main__":
    sys.exit(main())
