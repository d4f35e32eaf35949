"""What a class gets back before and after the due date, without marking anything again."""

from __future__ import annotations

import html
from pathlib import Path

import pytest

from grader.batch.ledger import Ledger
from tests.batch.classes import corpus_class, replay_all
from tests.processes import ROOT

LESSON = ROOT / "lab/course/hello_time/assignment.yaml"
CHANGE = "+        self.get_logger().info('Hello time: ' + str(self.counter_))"


def course(folder: Path, due: str) -> Path:
    path = folder / "assignment.yaml"
    text = LESSON.read_text(encoding="utf-8")
    path.write_text(f"{text}policy: {{due: {due}}}\n", encoding="utf-8")
    return path


def _text(path: Path) -> str:
    return html.unescape(path.read_text(encoding="utf-8"))


@pytest.mark.prefix
def test_the_solution_is_handed_back_after_the_due_date(tmp_path: Path) -> None:
    folder = corpus_class(tmp_path / "handed in", ["text_other_capital"])
    out = tmp_path / "out"
    for due, is_told in (("2999-01-01T00:00:00Z", False), ("2020-01-01T00:00:00Z", True)):
        lesson = course(tmp_path, due)
        done = replay_all(folder, out, "--assignment", str(lesson))
        assert done.returncode == 1, done.stderr
        texts = [_text(path) for path in (out / "feedback").iterdir()]
        assert len(texts) == 2
        assert all("Hello Time: 0" in text for text in texts)
        assert [CHANGE in text for text in texts].count(is_told) == 2
        (page,) = (out / "students").glob("*.html")
        assert CHANGE in _text(page)  # the instructor's
        with Ledger(out / "ledger.sqlite") as ledger:
            assert ledger.count() == 1
    # a student who may hand in until later gets no more than before the due date
    extensions = tmp_path / "extensions.csv"
    extensions.write_text("student,due\ns0-text_other_capital,2999-01-01T00:00:00Z\n")
    replay_all(folder, out, "--assignment", str(lesson), "--extensions", str(extensions))
    assert not any(CHANGE in _text(path) for path in (out / "feedback").iterdir())
