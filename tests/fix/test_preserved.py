"""A fix preserves line ends, encodings, tabs, byte order marks and last lines."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.package.edit.tree import Crlf, Delete, Edit, Replace, Write
from tests.corpus.model import CFG, MANIFEST, NODE, SETUP
from tests.fix.corpus_fixes import TOOLS, contents, edited, plan_of, with_tool
from tests.marking import taken_in

OLD = "'test_node = my_robot_controller.my_first_node:main'"
BAD = OLD.replace("my_first_node:", "my_frist_node:")
MISSPELT = Replace(SETUP, OLD, BAD)
NAME = Replace(MANIFEST, "<name>my_robot_controller<", "<name>my_robot_controler<")
CFG_BIN = Replace(CFG, "script_dir=$base/lib/my_robot_controller\n[", "script_dir=$base/bin\n[")


def change(root: Path, path: str) -> tuple[bytes, bytes]:
    """Return a file's bytes before and after fixing everything in its package."""
    plan = plan_of(root)
    assert not plan.left
    for tool in TOOLS:
        applied = taken_in(with_tool(tool, plan.patch, root))
        assert {f.path: f.data for f in applied.files if f.kind == "file"} == contents(plan.new)
    return contents(plan.old)[path], contents(plan.new)[path]


@pytest.mark.parametrize(
    ("path", "edit", "bad", "good"),
    [
        (SETUP, MISSPELT, b"my_frist_node:", b"my_first_node:"),
        (MANIFEST, NAME, b"my_robot_controler<", b"my_robot_controller<"),
        (CFG, CFG_BIN, b"$base/bin", b"$base/lib/my_robot_controller"),
    ],
    ids=["setup.py", "package.xml", "setup.cfg"],
)
@pytest.mark.parametrize("ending", ["lf", "crlf", "no end"])
def test_line_ends_stay_even_if_the_last_one_is_missing(
    path: str, edit: Edit, bad: bytes, good: bytes, ending: str, tmp_path: Path
) -> None:
    root = edited(tmp_path, edit, *([Crlf(path)] if ending == "crlf" else []))
    if ending == "no end":
        (root / path).write_bytes((root / path).read_bytes().rstrip(b"\n"))
    before, after = change(root, path)
    assert after == before.replace(bad, good)


@pytest.mark.parametrize("encoding", ["latin-1", "cp1252", "euc-kr"])
def test_the_declared_encoding_of_a_file_stays(encoding: str, tmp_path: Path) -> None:
    word = "감사" if encoding == "euc-kr" else "für"
    root = edited(tmp_path, MISSPELT)
    text = f"# -*- coding: {encoding} -*-\n# {word}\n" + (root / SETUP).read_text()
    (root / SETUP).write_bytes(text.encode(encoding))
    before, after = change(root, SETUP)
    assert after == before.replace(b"my_frist", b"my_first")
    assert word.encode(encoding) in after


def test_a_byte_order_mark_stays_if_the_file_may_have_one(tmp_path: Path) -> None:
    root = edited(tmp_path, MISSPELT)
    (root / SETUP).write_bytes(b"\xef\xbb\xbf" + (root / SETUP).read_bytes())
    before, after = change(root, SETUP)
    assert after == before.replace(b"my_frist", b"my_first")
    assert after.startswith(b"\xef\xbb\xbf")


def test_tabs_stay_and_a_new_entry_is_indented_like_the_others(tmp_path: Path) -> None:
    root = edited(
        tmp_path, Replace(SETUP, OLD, "'other = my_robot_controller.my_first_node:main2'")
    )
    text = (root / SETUP).read_text().replace("    ", "\t")
    (root / SETUP).write_text(text)
    before, after = change(root, SETUP)
    row = b"\t\t\t'test_node = my_robot_controller.my_first_node:main',\n"
    assert after.replace(row, b"") == before
    assert after.count(row) == 1


def test_double_quotes_and_a_comment_after_the_entry_stay(tmp_path: Path) -> None:
    root = edited(
        tmp_path, Replace(SETUP, OLD + ",", BAD.replace("'", '"') + ",  # mine, since Monday")
    )
    before, after = change(root, SETUP)
    assert after == before.replace(b"my_frist", b"my_first")
    assert b"# mine, since Monday" in after


def test_columns_after_multibyte_letters_are_right(tmp_path: Path) -> None:
    entry = f"'é=my_robot_controller.my_first_node:é', {BAD}"
    root = edited(tmp_path, Replace(SETUP, OLD, entry))
    before, after = change(root, SETUP)
    assert after == before.replace(b"my_frist", b"my_first")


def test_adding_a_shebang_converts_windows_line_ends(tmp_path: Path) -> None:
    root = edited(tmp_path, Replace(NODE, "#!/usr/bin/env python3\n", ""), Crlf(NODE))
    before, after = change(root, NODE)
    assert after == b"#!/usr/bin/env python3\n" + before.replace(b"\r\n", b"\n")


def test_carriage_returns_inside_a_line_are_not_converted(tmp_path: Path) -> None:
    code = b"#!/usr/bin/env python3\r\nTEXT = 'a\\rb'\r\n\r\ndef main():\r\n    pass\r\n"
    before, after = change(edited(tmp_path, Write(NODE, code)), NODE)
    assert after == before.replace(b"\r\n", b"\n")


def test_a_node_keeps_its_comments_when_a_colon_is_added(tmp_path: Path) -> None:
    root = edited(
        tmp_path,
        Replace(NODE, "def timer_callback(self):", "def timer_callback(self)  # it says 'hello'"),
    )
    before, after = change(root, NODE)
    assert after == before.replace(b"(self)  # it", b"(self):  # it")


def test_a_marker_is_an_empty_file(tmp_path: Path) -> None:
    plan = plan_of(edited(tmp_path, Delete("resource")))
    assert contents(plan.new)["resource/my_robot_controller"] == b""
    assert b"new file mode 100644" in plan.patch
