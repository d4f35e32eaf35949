"""Makes the autograder archive for Gradescope: this grader, `setup.sh` and `run_autograder`.

It contains the keys (solution, hidden checks): `run_autograder` removes other accounts' access to
the folder before any student code runs.
"""

from __future__ import annotations

import io
import json
import shlex
import zipfile
from collections.abc import Iterator
from pathlib import Path

from grader.base.errors import SurroundingsError, UsageError
from grader.base.i18n.message import say
from grader.base.i18n.translator import SOURCE, Translator
from grader.base.project import CHECKOUT
from grader.course.find import assignment_file
from grader.verdict.order import HIDDEN, load_with_hidden
from grader.verdict.own_checks import FILE as CHECKS

PARTS = (
    "grader",
    "lab/course",
    "setup.py",
    "setup.cfg",
    "package.xml",
    "resource",
    "LICENSE",
    "tests/requirements.txt",  # bootstrap.py identifies an environment by both lock files
)
LEFT_OUT = ("__pycache__", ".git", ".mypy_cache", ".ruff_cache", "build", "install", "log")
OWN_ASSIGNMENT, OWN_KEYS = "assignment", "keys"
WHEN = (1980, 1, 1, 0, 0, 0)  # for reproducible archives: the same files give the same bytes
FILE, PROGRAM = 0o100644, 0o100755

SETUP = r"""#!/usr/bin/env bash
# Run once by Gradescope, as root, when the autograder's image is built (Ubuntu 22.04 or 24.04).
set -euo pipefail
source=$(cd "$(dirname "${{BASH_SOURCE[0]}}")" && pwd)
export DEBIAN_FRONTEND=noninteractive
if ! python3 -c 'import ensurepip, venv' 2> /dev/null; then
  apt-get update -qq
  apt-get install -y -qq --no-install-recommends python3 python3-venv
fi
python3 "$source/grader/bootstrap.py"
cd "$source"
.venv/bin/python -m grader prefix --distro {distro}
"""

RUN = r"""#!/usr/bin/env bash
# Run by Gradescope, as root, for each submission; it copies this file beside `source`.
autograder=$(cd "$(dirname "${{BASH_SOURCE[0]}}")" && pwd)
results=$autograder/results/results.json
# the student's code runs under another account, which must not read the keys, the other files and
# Gradescope's data about earlier submissions
chmod go-rwx "$autograder/source" "$autograder/run_autograder" "$autograder/submission" \
  "$autograder/submission_metadata.json" 2> /dev/null
rm -f "$results"
cd "$autograder/source" || exit 3
export GRADER_DISPOSABLE=1 PYTHONDONTWRITEBYTECODE=1
.venv/bin/python -m grader gradescope {words} "$autograder"
status=$?
if [ ! -s "$results" ]; then
  mkdir -p "$autograder/results"
  echo {problem} > "$results"
fi
exit "$status"
"""


def gradescope_zip(
    *,
    assignment: str | None = None,
    keys: Path | None = None,
    distro: str = "jazzy",
    sandbox: str = "account",
    lang: str = SOURCE,
    root: Path = CHECKOUT,
) -> bytes:
    """Return the archive; `assignment` is an id, the path of an assignment.yaml or None.

    `keys` is the instructor's folder with the hidden checks, `lang` the language of what students
    read, `root` the checkout to pack. Raises SurroundingsError if `root` is not a checkout (the
    grader was installed without its sources), UsageError if there is no such assignment.
    """
    if not (root / "grader" / "bootstrap.py").is_file() or not (root / "lab/course").is_dir():
        raise SurroundingsError(
            f"{root} is not a checkout of this project, from which the archive is made",
            remedy="Run grader gradescope-zip from a checkout.",
        )
    files = dict(_files(root))
    file = assignment_file(assignment)
    named = file.parent.name
    if file.resolve() != (root / "lab/course" / named / file.name).resolve():
        files |= _own_assignment(file)
        named = f"{OWN_ASSIGNMENT}/{file.name}"
    load_with_hidden(assignment, keys)  # errors are reported here, not at Gradescope
    words = ["--assignment", named, "--distro", distro, "--sandbox", sandbox, "--lang", lang]
    own = [name for name in (HIDDEN, CHECKS) if keys is not None and (keys / name).is_file()]
    if keys is not None and own:
        files |= {f"{OWN_KEYS}/{name}": ((keys / name).read_bytes(), FILE) for name in own}
        words += ["--keys", OWN_KEYS]
    files["setup.sh"] = (SETUP.format(distro=shlex.quote(distro)).encode(), PROGRAM)
    run = RUN.format(words=shlex.join(words), problem=shlex.quote(_problem(lang)))
    files["run_autograder"] = (run.encode(), PROGRAM)
    return _packed(files)


def _problem(lang: str) -> str:
    """Return the results file for the case that the grader cannot start."""
    text = say("The grader failed, not your package. Please tell your instructor.")
    return json.dumps({"score": 0, "output": Translator(lang)(text)})


def _packed(files: dict[str, tuple[bytes, int]]) -> bytes:
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, (content, mode) in sorted(files.items()):
            entry = zipfile.ZipInfo(name, WHEN)
            entry.create_system = 3  # Unix: the mode counts
            entry.external_attr = mode << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, content)
    return out.getvalue()


def _files(root: Path) -> Iterator[tuple[str, tuple[bytes, int]]]:
    """Yield the project's files, with their names in the archive; links are left out."""
    for part in PARTS:
        for path in sorted([root / part, *(root / part).rglob("*")]):
            name = path.relative_to(root)
            if path.is_symlink() or not path.is_file() or set(name.parts) & set(LEFT_OUT):
                continue
            program = path.stat().st_mode & 0o100
            yield name.as_posix(), (path.read_bytes(), PROGRAM if program else FILE)


def _own_assignment(path: Path) -> dict[str, tuple[bytes, int]]:
    """Return the files in the folder of the instructor's own assignment."""
    if not path.is_file():
        raise UsageError(f"there is no assignment {path}")
    beside = [found for found in path.parent.iterdir() if found.is_file()]
    return {f"{OWN_ASSIGNMENT}/{found.name}": (found.read_bytes(), FILE) for found in beside}
