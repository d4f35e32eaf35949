"""No point is lost without a check that failed: where the chain of a skipped check ends."""

from __future__ import annotations

import pytest

from grader.base.i18n.translator import Translator
from grader.report.model import CheckResult, CheckStatus
from grader.verdict.causes import with_causes
from tests.report.samples import check


def result(check_id: str, status: CheckStatus, by: str = "") -> CheckResult:
    return check(check_id, status).model_copy(update={"blocked_by": by})


@pytest.mark.parametrize(
    ("end", "expected"),
    [
        ("failed", "skipped"),
        ("inconclusive", "inconclusive"),
        ("error", "inconclusive"),
        ("passed", "inconclusive"),
    ],
)
def test_a_chain_of_skipped_checks_ends_at_a_reason(end: CheckStatus, expected: str) -> None:
    results = [
        result("run.spins", end),
        result("a", "skipped", "run.spins"),
        result("b", "skipped", "a"),
    ]
    found = with_causes(results, Translator("en"))
    assert [one.status for one in found] == [end, expected, expected]
    if end == "passed":
        assert "nothing was found wrong" in found[2].actual


@pytest.mark.parametrize("by", ["", "not.there", "b"])
def test_a_chain_that_leads_nowhere_leaves_the_points_open(by: str) -> None:
    (found,) = with_causes([result("b", "skipped", by)], Translator("en"))
    assert found.status == "inconclusive"
