"""What the log of `colcon build` says of the error that ended it."""

from __future__ import annotations

import re


def setup_error(log: str) -> tuple[str, int | None]:
    """Return the Python error that ended setup.py, and its line there, if any.

    colcon runs setup.py in a process of its own with distutils' run_setup, so that the traceback
    has no file name. colcon's own traceback about the failed process follows that of setup.py.
    """
    of_setup = re.sub(r"^subprocess\.CalledProcessError: .*$", "", log, flags=re.MULTILINE)
    error, line = python_error(of_setup, "setup.py")
    if not error:
        return python_error(log, "setup.py")
    nameless = re.findall(r'in run_setup\n.*\n  File "<string>", line (\d+)', of_setup)
    return error, line or (int(nameless[-1]) if nameless else None)


def python_error(text: str, file: str) -> tuple[str, int | None]:
    """Return the last Python error in a text ("TypeError: …") and its line in `file`, if any."""
    errors = re.findall(
        r"^((?:[A-Za-z_][\w.]*\.)?(?:[A-Z]\w*(?:Error|Exception|Exit|Interrupt|Iteration)|"
        r"Invalid[A-Z]\w*)(?:: .*)?)$",
        text,
        re.MULTILINE,
    )
    lines = re.findall(rf'File "[^"\n]*{re.escape(file)}", line (\d+)', text)
    return (errors[-1][:400] if errors else ""), (int(lines[-1]) if lines else None)


def last_error(log: str) -> str:
    """Return the last line with which a program of the build says why it stopped; "" if none."""
    found = re.findall(
        r"^(?:error: |error in \S{1,80} |file \S{1,200} \(for ).*$", log, re.MULTILINE
    )
    return found[-1][:400] if found else ""


def is_inside(log: str, error: str) -> bool:
    """Whether an error comes from what setup() called, or from colcon's reading of its values."""
    of_setup = log[: max(0, log.rfind(error[:200]))]
    frames = re.findall(r'^  File "([^"\n]{1,300})", line \d+, in ', of_setup, re.MULTILINE)
    own = [n for n, path in enumerate(frames) if path.endswith("/setup.py") or path == "<string>"]
    called = frames[own[-1] + 1 :] if own else frames
    parts = ("setuptools/", "distutils/", "colcon_")
    return any(part in path for path in called for part in parts)


def summary_of(log: str) -> str:
    """Return the first lines of a log that tell of a failure."""
    lines = [line.strip() for line in log.splitlines() if line.strip()]
    wanted = ("Failed", "error:", "ERROR", "Error", "Summary:")
    telling = [line for line in lines if any(word in line for word in wanted)]
    return " / ".join(telling[:3])[:600]
