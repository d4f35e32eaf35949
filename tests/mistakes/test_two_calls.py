"""A line that two calls write in parts is made by one call."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.mistakes.recognise import behind_symptom
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.source.one_change import logged_lines
from tests.marking import ASSIGNMENT
from tests.mistakes.test_from_source import line_of, node_in
from tests.mistakes.test_named_exactly import LOG, changed, fix_of, patched, why_of

INFO = "        self.get_logger().info({})\n"
TEXT = INFO.format("'Hello time: '")


def found_in(text: str, came: str) -> RecognisedMistake | None:
    return behind_symptom("run.wrong_text", Suspect(node_in(text), ASSIGNMENT, came))


@pytest.mark.parametrize(
    ("lines", "came"),
    [
        (TEXT + INFO.format("str(self.counter_)"), "Hello time: "),
        (INFO.format("str(self.counter_)") + TEXT, "0"),
        (TEXT + INFO.format("f'{self.counter_}'"), "Hello time: "),
        (TEXT + INFO.format("'%d' % self.counter_"), "Hello time: "),
        ("        print('Hello time: ', end='')\n" + INFO.format("str(self.counter_)"), "0"),
        ("        print('Hello time:', end=' ')\n" + INFO.format("str(self.counter_)"), "0"),
        (TEXT + "        print(self.counter_)\n", "Hello time: "),
        (TEXT + "        self.counter_ += 0\n" + INFO.format("str(self.counter_)"), "Hello time:"),
        (TEXT + INFO.format("str(self.counter_ / 1)"), "Hello time: "),
    ],
)
def test_one_call_logs_the_whole_line(lines: str, came: str, tmp_path: Path) -> None:
    text = changed((f"        {LOG}\n", lines))
    found = found_in(text, came)
    assert found is not None
    assert found.kind == "node.line_in_parts"
    at = line_of(text, "'Hello time")
    assert fix_of(found).startswith(f"Delete line {at} (")
    assert "info('Hello time: ' + str(self.counter_" in fix_of(found)
    new = patched(found, text, tmp_path)
    assert logged_lines(node_in(new)) == [f"Hello time: {n}" for n in range(12)]
    assert ("// the whole number" in why_of(found)) == ("/ 1" in lines)
    assert ("print()" in why_of(found)) == ("print" in lines)


@pytest.mark.parametrize(
    ("lines", "came"),
    [
        (TEXT, "Hello time: "),
        (TEXT + INFO.format("'count ' + str(self.counter_)"), "Hello time: "),
        (TEXT + INFO.format("'done'"), "Hello time: "),
        (TEXT + INFO.format("str(self.counter_)") * 2, "Hello time: "),
        (TEXT + INFO.format("str(self.counter_)"), "something else"),
    ],
)
def test_other_calls_are_not_parts_of_a_line(lines: str, came: str) -> None:
    text = changed((f"        {LOG}\n", lines))
    found = found_in(text, came)
    assert found is None or found.kind != "node.line_in_parts"
