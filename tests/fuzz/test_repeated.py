"""Files of one repeated text: reading, checking, fixing and comparing them takes bounded time."""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from grader.base.i18n.translator import Translator
from grader.batch.similar import fingerprint
from grader.package.source.remarks import remarks_on
from grader.run.run import Run
from grader.verdict.evaluate import evaluate_checks
from grader.verdict.evidence import Evidence
from tests.corpus.build import SOLUTION, write
from tests.corpus.model import CFG, MANIFEST, NODE, SETUP, STATIC, Package
from tests.fixing import patch_for
from tests.marking import ASSIGNMENT, taken_in
from tests.static_bench import BUILT

SIZE = 57_000  # bytes; a larger file is not read
MOST_SECONDS = 8.0  # of processor time; the slowest takes 2
UNITS = (
    *("(", "[", "{", "a.", "'", '"', '"""', "'''a", "#", " #", " ", "\\", "\\\n", "\t", "\r", "\n"),
    *("x=", "lambda:", "f'{", "not ", "-", "a+", "@", "*", "0", "1_", "; ", "'a' ", "('x',", "%s"),
    *("async ", "def f(", "if x:\n ", "try:\n", "else:\n", "x if y else ", "for i in ", "self."),
    *("“", "\u00a0", "<a>", "<!--", "<", "&", "]]>", "=", "[a]\n", "a=b\n", "a=[\n", "print("),
    *("console_scripts", "'test_node = ", "my_robot_controller", "my_first_node:main", "{n}"),
    *("<depend>", "</depend>", "Hello time: "),
)
CHECKS = {"package.found", "entry_point.mapping", *STATIC}


@pytest.mark.long
@pytest.mark.parametrize("file", [NODE, SETUP, MANIFEST, CFG])
def test_a_file_of_one_repeated_text_is_read_in_bounded_time(
    file: str, tmp_path: Path, subtests: pytest.Subtests
) -> None:
    root = write(Package(name="solution", edits=()), tmp_path)
    right = (SOLUTION / file).read_text(encoding="utf-8")
    half = len(right) // 2
    for unit in UNITS:
        many = unit * (SIZE // len(unit.encode()))
        for text in (many, right + many, right[:half] + many + right[half:]):
            with subtests.test(repr(unit)):
                (root / file).write_text(text, encoding="utf-8", newline="")
                begin = time.process_time()
                _read(root)
                assert time.process_time() - begin < MOST_SECONDS


def _read(root: Path) -> None:
    submission = taken_in(root)
    evidence = Evidence(ASSIGNMENT, submission, build=lambda: BUILT, run=_no_run)
    for result in evaluate_checks(evidence, Translator("en"), only=CHECKS):
        assert result.status != "error", result.fault
        if result.status == "failed":
            patch_for(result, submission, ASSIGNMENT)
    remarks_on(submission.files)
    fingerprint(submission)


def _no_run() -> Run:
    raise AssertionError("the files decide it")
