"""The def of a callback as it should be: with its body on the same line, and with its values."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.mistakes.test_from_source import line_of, raised
from tests.mistakes.test_named_exactly import LOG, STEP, changed, fix_of, patched

ONE = "TypeError: MyFirstNode.timer_callback() missing 1 required positional argument: 'more'"
NONE = "TypeError: MyFirstNode.timer_callback() takes 0 positional arguments but 1 was given"
DEF = "def timer_callback(self):"
DOC = '        """Say hello once; the timer calls this for as long as the node spins."""\n'
BODY = f"\n{DOC}        {LOG}\n{STEP}"
INLINE = f"{LOG}; self.counter_ += 1"


@pytest.mark.parametrize(
    ("error", "written", "right", "line"),
    [
        (ONE, f"(self, more): {INLINE}  # as it was\n", f"(self): {INLINE}  # as it was\n",
         f"(self): {INLINE}"),
        (ONE, f"(self, more: int, other) -> None:{BODY}", f"(self) -> None:{BODY}",
         "(self) -> None:"),
        (ONE, f"(\n        self,\n        more,\n    ):{BODY}", f"(\n        self,\n    ):{BODY}",
         "( self, ):"),
        (ONE, f"(self, more, event=None):{BODY}", f"(self, event=None):{BODY}",
         "(self, event=None):"),
        (ONE, f"(self, more):\n        more = 1{BODY}", f"(self):\n        more = 1{BODY}", "(self):"),
        (NONE, f"(): {INLINE}\n", f"(self): {INLINE}\n", f"(self): {INLINE}"),
        (NONE, f"() -> None:{BODY}", f"(self) -> None:{BODY}", "(self) -> None:"),
    ],
)  # fmt: skip
def test_the_line_of_the_def_keeps_what_is_right(
    error: str, written: str, right: str, line: str, tmp_path: Path
) -> None:
    name = "def timer_callback"
    text = changed((f"{DEF}{BODY}", name + written))
    found = raised(error, text, line_of(text, "rclpy.spin"))
    assert patched(found, text, tmp_path) == changed((f"{DEF}{BODY}", name + right))
    assert fix_of(found).endswith(f"Write: {name}{line}")
