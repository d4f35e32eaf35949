"""A class is marked in the chosen language, and each language has its own verdicts."""

from __future__ import annotations

import csv
import json
import re
from pathlib import Path

import pytest

from grader.batch.verdict_key import surroundings_key
from grader.batch.work import Job
from grader.ros.prefix import Ros
from grader.sandbox.limits import Limits
from tests.batch.classes import replay_all
from tests.batch.pool_tasks import JOB, package

ROSTER = "id,name\nan,김하나\nabsent,이두리\n"


def report_of(out: Path) -> dict[str, object]:
    (path,) = out.glob("*/jazzy/report.json")
    found: dict[str, object] = json.loads(path.read_text(encoding="utf-8"))
    return found


@pytest.mark.prefix
def test_a_class_marked_in_english_and_then_in_korean_is_korean(
    ros_jazzy: Ros, tmp_path: Path
) -> None:
    folder, out = tmp_path / "class", tmp_path / "out"
    package("entry_missing", folder, called="an")
    roster = tmp_path / "roster.csv"
    roster.write_text(ROSTER, encoding="utf-8")
    words = ("--roster", str(roster))
    assert "1 to mark, 0 marked before" in replay_all(folder, out, *words, "--lang", "en").stderr
    english = report_of(out)

    done = replay_all(folder, out, *words, "--lang", "ko")
    assert "1 to mark, 0 marked before" in done.stderr
    korean = report_of(out)
    assert (english["lang"], korean["lang"]) == ("en", "ko")
    assert (korean["score"], korean["status"]) == (english["score"], english["status"])
    feedback = sorted((out / "feedback").iterdir())
    assert len(feedback) == 4  # a missing student's text is Korean as well
    for path in feedback:
        text = path.read_text(encoding="utf-8")
        assert re.search("만점에|아직 점수가 없습니다", text), path.name
        assert not re.search(r"of 100 points|No points yet|All checks", text), path.name
    with (out / "gradebook.csv").open(encoding="utf-8-sig") as file:
        rows = list(csv.DictReader(file))
    assert rows[0]["status"] == "graded"
    assert "setup.no_entry" in rows[0]["mistakes"]

    page = (out / "index.html").read_text(encoding="utf-8")
    assert '<html lang="ko"' in page
    assert "이름을 보고 정한 형식으로 읽었습니다" in page

    again = replay_all(folder, out, *words, env={"LC_ALL": "", "LANG": "ko_KR.UTF-8"})
    assert "0 to mark, 1 marked before" in again.stderr
    back = replay_all(folder, out, *words, "--lang", "en")
    assert "0 to mark, 1 marked before" in back.stderr
    assert report_of(out) == english


def test_workers_get_the_language() -> None:
    job = Job(JOB.assignment, JOB.distro, JOB.sandbox, JOB.limits, "ko")
    assert Job.from_text(job.to_text()) == job


def test_verdicts_in_two_languages_have_two_keys(ros_jazzy: Ros) -> None:
    keys = {
        surroundings_key(JOB.assignment, ros_jazzy, Limits(), lang=lang) for lang in ("en", "ko")
    }
    assert len(keys) == 2
