"""The limits of the program's structure, and what does not keep them yet.

`python -m tests.structure` is a part of `make lint`. Its list, `.ci/structure.json`, only shrinks: an
entry that is new or has grown fails, and so does one that has become smaller until
`python -m tests.structure shrink` has written it down.

Limits: a function has a complexity of at most 15 (as radon counts), a module has at most 500 lines, no two
modules import each other, directly or in a ring, and imports stand at the top of their module. An import
inside a function counts for the rings too.
"""

from __future__ import annotations

import json
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import grimp
from radon.complexity import cc_visit
from radon.visitors import Class

ROOT = Path(__file__).resolve().parent.parent
LIST = ROOT / ".ci" / "structure.json"
PACKAGES = ("grader", "lab")
MOST_COMPLEX = 15
MOST_LINES = 500
LATE = [
    "ruff",
    "check",
    "--select",
    "PLC0415",
    "--ignore-noqa",
    "--exit-zero",
    "--output-format=json",
]
Sizes = dict[str, int]
"""What is over its limit, by its name: a complexity, lines, a ring's modules, imports in functions."""


def sources(root: Path) -> list[Path]:
    """Return the program's modules; what is a submission or is given to students is none of them."""
    listed = subprocess.run(
        ["git", "ls-files", "--cached", "--others", "--exclude-standard", *PACKAGES],
        cwd=root,
        capture_output=True,
        text=True,
        check=True,
    ).stdout.splitlines()
    data = ("grader/keys/", "lab/course/")
    paths = [root / name for name in listed if name.endswith(".py") and not name.startswith(data)]
    return [path for path in paths if path.is_file()]


def complexities(root: Path) -> Iterator[tuple[str, int]]:
    for path in sources(root):
        for found in cc_visit(path.read_text(encoding="utf-8")):
            if not isinstance(found, Class) and found.complexity > MOST_COMPLEX:
                yield f"{path.relative_to(root)}:{found.fullname}", found.complexity


def lengths(root: Path) -> Iterator[tuple[str, int]]:
    for path in sources(root):
        lines = path.read_bytes().count(b"\n")
        if lines > MOST_LINES:
            yield str(path.relative_to(root)), lines


def rings(graph: grimp.ImportGraph) -> Iterator[tuple[str, int]]:
    """Yield each set of modules that import each other: the first by its name, and how many."""
    seen: set[str] = set()
    for module in sorted(graph.modules):
        if module in seen:
            continue
        ring = graph.find_upstream_modules(module) & graph.find_downstream_modules(module)
        if ring:
            seen |= ring | {module}
            yield module, len(ring | {module})


def late_imports(root: Path) -> Iterator[tuple[str, int]]:
    """Yield each module with imports inside its functions, and how many, whatever a noqa says."""
    found = subprocess.run(
        [sys.executable, "-m", *LATE, *PACKAGES],
        cwd=root,
        capture_output=True,
        text=True,
        check=True,
    ).stdout
    counted = Counter(entry["filename"] for entry in json.loads(found))
    for name, count in sorted(counted.items()):
        yield str(Path(name).relative_to(root)), count


def over_limits(root: Path = ROOT) -> dict[str, Sizes]:
    graph = grimp.build_graph(*PACKAGES, cache_dir=None)
    return {
        "complexity": dict(sorted(complexities(root))),
        "lines": dict(lengths(root)),
        "rings": dict(rings(graph)),
        "imports in functions": dict(late_imports(root)),
    }


def differences(known: dict[str, Sizes], found: dict[str, Sizes]) -> tuple[list[str], list[str]]:
    """Return what is new or has grown, and what has become smaller or is gone, a line each."""
    grown: list[str] = []
    smaller: list[str] = []
    for limit, sizes in found.items():
        before = known.get(limit, {})
        for name in sorted(before.keys() | sizes.keys()):
            was, now = before.get(name, 0), sizes.get(name, 0)
            line = f"{limit}: {name}: {now}, in the list {was}"
            if now != was:
                (grown if now > was else smaller).append(line)
    return grown, smaller


def main(words: list[str]) -> int:
    known = json.loads(LIST.read_text(encoding="utf-8")) if LIST.exists() else {}
    found = over_limits()
    grown, smaller = differences(known, found)
    if LIST.exists() and grown:
        print("\n".join(grown), file=sys.stderr)
        print("tests.structure: make these smaller; the list does not grow", file=sys.stderr)
        return 1
    if words == ["shrink"]:
        LIST.write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
        print({limit: len(sizes) for limit, sizes in found.items()})
        return 0
    if smaller:
        print("\n".join(smaller), file=sys.stderr)
        print("tests.structure: write it down: python -m tests.structure shrink", file=sys.stderr)
    return int(bool(smaller))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
