"""`grader fix` in Korean: messages are Korean, files and diffs are the same."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from grader.package.edit.tree import Delete, Replace, Write
from tests import processes
from tests.corpus.model import MANIFEST, MARKER, NODE
from tests.fix.corpus_fixes import edited

NAME = Replace(MANIFEST, "<name>my_robot_controller<", "<name>my_robot_controler<")
PROSE = re.compile(r"(?:\b[a-z]{2,}\b[ ,]+){2}[a-z]{2,}\b")


def prose(text: str) -> list[str]:
    """Return the English prose in a message."""
    return PROSE.findall(re.sub(r"'[^'\n]*'|`[^`\n]*`|<[^>\n]*>", " ", text))


@pytest.mark.parametrize("words", [("--dry-run",), ("--apply",), ("--check", "package.marker")])
def test_messages_are_korean_and_the_diff_is_the_same(
    words: tuple[str, ...], tmp_path: Path
) -> None:
    roots = [edited(tmp_path / lang, NAME, Delete(MARKER)) for lang in ("en", "ko")]
    english, korean = (
        processes.run(processes.grader("fix", *words, "--no-run", "--lang", root.parent.name, root))
        for root in roots
    )
    assert (korean.returncode, korean.stdout) == (english.returncode, english.stdout)
    assert "package.marker" in korean.stderr
    for line in korean.stderr.splitlines():
        assert re.search("[가-힣]", line), line
        assert prose(line) == [], line


def test_unfixed_mistakes_are_listed_in_korean(tmp_path: Path) -> None:
    root = edited(tmp_path, Write(NODE, b""), NAME)
    done = processes.run(processes.grader("fix", "--lang", "ko", root))
    assert done.returncode == 1
    assert "남은 것  source.node_file: 파일이 비어 있습니다" in done.stderr
    assert prose(done.stderr) == []
    done = processes.run(processes.grader("fix", "--lang", "ko", tmp_path / "edited" / "resource"))
    assert done.returncode == 1
    assert prose(done.stderr) == []


def test_usage_errors_and_refusals_are_in_korean(tmp_path: Path) -> None:
    root = edited(tmp_path, NAME)
    (root / MANIFEST).chmod(0o444)
    file = tmp_path / "handed_in.zip"
    file.write_bytes(b"")
    for words in (
        [root, "--check", "package.marke"],
        [root, "--distro", "jazzy,kilted"],
        [root, "--apply", "--no-run"],
        [file],
    ):
        done = processes.run(processes.grader("fix", "--lang", "ko", *words))
        assert done.returncode == 2, words
        text = done.stderr[done.stderr.index("grader: ") :]
        assert re.search("[가-힣]", text), text
        assert prose(text) == [], text
