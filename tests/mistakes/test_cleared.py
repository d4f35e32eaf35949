"""The line that clears the terminal is named, with what its block then needs."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.mistakes.test_from_source import line_of, look
from tests.mistakes.test_named_exactly import LOG, STEP, changed, fix_of, patched

LOG_LINE = f"        {LOG}\n"
TIMER = "    def timer_callback"


@pytest.mark.parametrize(
    "line",
    [
        "os.system('clear')",
        "os.system('cls' if os.name == 'nt' else 'clear')",
        "_ = os.system('clear')",
        "subprocess.run(['clear'])",
        "subprocess.call('clear', shell=True)",
        "print('\\033c')",
        "print('\\x1bc', end='')",
        "print('\\033[H\\033[J', end='')",
        "sys.stdout.write('\\x1b[2J')",
        "print(end='\\r')",
    ],
)
def test_the_line_is_deleted(line: str, tmp_path: Path) -> None:
    text = changed((LOG_LINE, f"        {line}\n{LOG_LINE}"))
    found = look("run.erased", text)
    assert found is not None
    assert found.where is not None
    assert found.where.line == line_of(text, line)
    assert fix_of(found) == "Delete this line."
    assert patched(found, text, tmp_path) == changed()


def test_an_if_with_no_other_line_is_deleted_too(tmp_path: Path) -> None:
    inner = "        if self.counter_ > 0:\n            os.system('clear')\n"
    text = changed((LOG_LINE, inner + LOG_LINE))
    found = look("run.erased", text)
    assert fix_of(found) == "Delete this line and the if above it."
    assert patched(found, text, tmp_path) == changed()


def test_the_call_of_a_function_that_only_clears_is_deleted(tmp_path: Path) -> None:
    method = "    def clear(self):\n        os.system('clear')\n\n" + TIMER
    call = "        self.clear()\n"
    text = changed((TIMER, method), (LOG_LINE, call + LOG_LINE))
    found = look("run.erased", text)
    assert found is not None
    assert found.where is not None
    assert found.where.line == line_of(text, "self.clear()")
    assert patched(found, text, tmp_path) == text.replace(call, "")


@pytest.mark.parametrize(
    "edits",
    [
        [(LOG, "print('\\r' + 'Hello time: ' + str(self.counter_), end='')")],
        [("        rclpy.spin(node)\n", "        os.system('clear')\n        rclpy.spin(node)\n")],
        [(STEP, f"{STEP}        print('\\033[92m')\n")],
        [(STEP, f"{STEP}        os.system('ls')\n")],
        [(STEP, f"{STEP}        self.data.clear()\n")],
    ],
)
def test_what_clears_nothing_is_not_named(edits: list[tuple[str, str]]) -> None:
    assert look("run.erased", changed(*edits)) is None


def test_a_print_that_only_clears_is_not_to_be_logged() -> None:
    clears = changed((STEP, f"{STEP}        print('\\033c', end='')\n"))
    found = look("run.print_not_logger", clears)
    assert found is not None
    assert found.kind == "node.clears_terminal"
    both = look("run.print_not_logger", clears.replace(STEP, f"{STEP}        print('hi')\n"))
    assert both is not None
    assert both.kind == "node.print_used"
