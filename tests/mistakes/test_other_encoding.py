"""A file that is not UTF-8 is reopened in its encoding before it is saved."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.package.source.other_encoding import kind_of_encoding
from tests.corpus.broken import BROKEN
from tests.corpus.build import write
from tests.recorded import mark

BY_NAME = {package.name: package for package in BROKEN}
KOREAN = "x = '안녕하세요'  # 1초마다 시간을 출력한다\n"


@pytest.mark.parametrize(
    ("found", "kind"),
    [
        (KOREAN.encode("cp949"), "korean"),
        (KOREAN.encode("euc-kr"), "korean"),
        ("x = '똠방각하'\n".encode("cp949"), "korean"),
        ("# für größere Übung\n".encode("cp1252"), ""),
        ("# été, où, çà\n".encode("latin-1"), ""),
        ("# Привет, мир\n".encode("cp1251"), ""),
        ("# 毎秒表示します\n".encode("shift_jis"), ""),
        (KOREAN.encode("utf-16"), "saved"),
        (KOREAN.encode() + b"# \xfc\n", "saved"),
        (b"# coding: utf-7\n", "declared"),
    ],
)
def test_the_encoding_is_recognised(found: bytes, kind: str) -> None:
    assert kind_of_encoding(found) == kind


def test_a_korean_file_is_reopened_as_korean_first(tmp_path: Path) -> None:
    fix = mark(write(BY_NAME["korean_in_cp949"], tmp_path / "a")).check("source.node_file").fix
    assert fix.index("Reopen") < fix.index("Korean (EUC-KR)") < fix.index("Save with Encoding")
    assert "Western" not in fix
    fix = mark(write(BY_NAME["not_utf8"], tmp_path / "b")).check("source.node_file").fix
    assert fix.index("Reopen") < fix.index("Western (Windows 1252)") < fix.index("Save with")
