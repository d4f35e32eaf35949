"""A fix that is carried out to the letter leads to the right code."""

from __future__ import annotations

from pathlib import Path

from tests.mistakes.test_from_source import line_of, look
from tests.mistakes.test_named_exactly import changed, fix_of, patched


def test_continue_after_ctrl_c_becomes_break(tmp_path: Path) -> None:
    try_spin = (
        "    while True:\n        try:\n            rclpy.spin(node)\n"
        "        except KeyboardInterrupt:\n            continue\n"
    )
    whole = changed()
    start, end = whole.index("    try:\n"), whole.index("\n\nif __name__")
    text = whole[:start] + try_spin + whole[end:]
    found = look("run.ignores_interrupt", text)
    assert f"Write break instead of continue on line {line_of(text, 'continue')}" in fix_of(found)
    assert patched(found, text, tmp_path) == text.replace("continue", "break")
