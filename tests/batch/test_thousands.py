"""The coordinating process' memory for a class of many, with stub workers."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.report.files import report_json
from tests.batch import classes
from tests.report import samples

MOST = 200  # MB


@pytest.mark.prefix
@pytest.mark.long
@pytest.mark.parametrize("count", [300, 2_000])
def test_memory_stays_constant_and_everybody_is_marked(count: int, tmp_path: Path) -> None:
    evidence = {"build_log": "b" * 40_000, "transcript": "t" * 40_000}
    report = samples.report(evidence=evidence)
    (tmp_path / "report.json").write_text(report_json(report), encoding="utf-8")
    folder = classes.large_class(tmp_path / "class", count)
    out = tmp_path / "out"
    status, peak = classes.measured(folder, out, report=tmp_path / "report.json")
    assert status == 0
    assert peak < MOST
    with (out / "gradebook.csv").open(encoding="utf-8-sig") as rows:
        assert sum(1 for _ in rows) == count + 1
    assert len(list((out / "students").iterdir())) == count
