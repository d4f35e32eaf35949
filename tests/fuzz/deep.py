"""Coverage-guided fuzzing of all targets in one process, with atheris (libFuzzer).

atheris is in the tests' environment for Python 3.11 to 3.13 (there is no wheel for 3.10).

    nice -n 19 .venv/bin/python -m tests.fuzz.deep FOLDER -max_total_time=600

FOLDER keeps the inputs that reached new code, first the corpus' packages. The first byte of an
input chooses the target (`python -m tests.fuzz.deep --targets` lists them). Options are libFuzzer's;
a crash is written to a file; give that file as the only argument to run it again.
"""

from __future__ import annotations

import hashlib
import importlib
import sys
import tempfile
from pathlib import Path

TIMEOUT = 10  # seconds for one input on a busy machine
MEGABYTES = 1_500  # including libFuzzer's own memory
LONGEST = 6_000  # bytes of an input


def main(argv: list[str]) -> int:
    """Fuzz until libFuzzer ends, or run one input again."""
    atheris = importlib.import_module("atheris")
    with atheris.instrument_imports(include=["grader"]):
        targets = importlib.import_module("tests.fuzz.targets")
    names = list(targets.TARGETS)
    if argv == ["--targets"]:
        print("\n".join(f"{n}: {name}" for n, name in enumerate(names)))
        return 0

    def one_input(found: bytes) -> None:
        if found:
            targets.TARGETS[names[found[0] % len(names)]](found[1:])

    options = [f"-timeout={TIMEOUT}", f"-rss_limit_mb={MEGABYTES}", f"-max_len={LONGEST}"]
    folders = [Path(word) for word in argv if not word.startswith("-")]
    if folders and not folders[0].is_file():
        folders[0].mkdir(parents=True, exist_ok=True)
        seed(folders[0], names, targets.SEEDS)
        options.append(f"-dict={dictionary(folders[0])}")
    atheris.Setup([sys.argv[0], *options, *argv], one_input)
    atheris.Fuzz()
    return 0


def seed(folder: Path, names: list[str], seeds: dict[str, bytes]) -> None:
    """Write the first inputs: for each target a right example and its variants from the corpus."""
    short = importlib.import_module("tests.fuzz.test_short")
    broken = importlib.import_module("tests.corpus.broken").BROKEN
    model = importlib.import_module("tests.corpus.model")
    tree = importlib.import_module("grader.package.edit.tree")
    paths = {seeds["manifest"]: model.MANIFEST, seeds["setup_py"]: model.SETUP,
             seeds["setup_cfg"]: model.CFG, seeds["python"]: model.NODE}  # fmt: skip
    for number, name in enumerate(names):
        right = seeds[name]
        found = {right, *(word for kind, word in short.HOSTILE.items() if len(word) < LONGEST)}
        for package in broken:
            changed = right
            for edit in package.edits:
                if isinstance(edit, tree.Replace) and edit.path == paths.get(right):
                    changed = changed.replace(edit.old.encode(), edit.new.encode())
            found.add(changed)
        for example in found:
            data = bytes([number]) + example
            (folder / hashlib.sha1(data, usedforsecurity=False).hexdigest()).write_bytes(data)


def dictionary(folder: Path) -> Path:
    """Write the words of which inputs are made as a libFuzzer dictionary."""
    short = importlib.import_module("tests.fuzz.test_short")
    rows = ['"' + "".join(f"\\x{byte:02x}" for byte in word) + '"' for word in short.WORDS]
    path = Path(tempfile.gettempdir()) / f"{folder.resolve().name}.dict"
    path.write_text("\n".join(rows) + "\n", encoding="ascii")
    return path


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
