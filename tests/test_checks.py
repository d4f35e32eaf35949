"""The declarations of the checks, and what is derived from them."""

from __future__ import annotations

import pytest

from grader.verdict.checks.all import CHECKS, FAMILIES, QUOTES, STATIC, in_order
from grader.verdict.checks.declare import BUILD, INTAKE, RUN, Check, Stage, check
from grader.verdict.outcome import Passed


def declared(check_id: str, stage: Stage, *before: str, after: tuple[str, ...] = ()) -> Check:
    @check(check_id, stage=stage, depends=before, after=after)
    def function(_evidence: object) -> Passed:
        """It is right."""
        return Passed()

    return function


def test_the_checks_are_found_and_each_is_after_those_that_it_needs() -> None:
    place = {check_id: n for n, check_id in enumerate(CHECKS)}
    for one in CHECKS.values():
        assert one.id == next(key for key, value in CHECKS.items() if value is one)
        for other in (*one.depends, *one.after):
            assert place[other] < place[one.id]
            assert CHECKS[other].stage.rank <= one.stage.rank
    ranks = [one.stage.rank for one in CHECKS.values()]
    assert ranks == sorted(ranks)
    assert {"package.found", "build.colcon", "log.period"} <= set(CHECKS)


def test_the_mapping_is_judged_before_the_build_since_a_broken_build_can_come_from_it() -> None:
    ids = list(CHECKS)
    assert ids.index("entry_point.mapping") < ids.index("build.colcon")
    # the text explains what the other checks of a run find: it comes first among them
    assert ids.index("log.counts") < min(map(ids.index, ("log.logger", "log.period")))


OF_FILES = ("package.", "source.", "files.", "interface.")


def test_the_files_decide_what_needs_no_build() -> None:
    assert set(STATIC) == {
        *(check_id for check_id in CHECKS if check_id.startswith(OF_FILES)),
        "entry_point.mapping",
    }


def test_a_check_quotes_what_its_stage_printed() -> None:
    assert QUOTES["build.colcon"] == "build_log"
    assert QUOTES["run.interrupt"] == "transcript"
    assert QUOTES["run.output"] == "before_ctrl_c"
    assert not any(check_id.startswith(("package.", "source.")) for check_id in QUOTES)
    assert all(check_id in QUOTES for check_id in CHECKS if check_id.startswith("run."))


def test_every_check_is_in_a_family() -> None:
    assert all(any(check_id.startswith(family) for family in FAMILIES) for check_id in CHECKS)
    assert all(family.endswith(".") and family.count(".") == 1 for family in FAMILIES)


def test_stages_come_in_their_order_and_checks_after_those_before_them() -> None:
    last = declared("run.last", RUN)
    third = declared("source.third", INTAKE, "source.second")
    build = declared("build.built", BUILD)
    second = declared("source.second", INTAKE, after=("source.first",))
    first = declared("source.first", INTAKE)
    ordered = in_order([last, third, build, second, first])
    assert list(ordered) == [
        "source.first",
        "source.second",
        "source.third",
        "build.built",
        "run.last",
    ]


def test_without_a_reason_the_order_is_that_of_the_declarations() -> None:
    found = [declared(f"source.{name}", INTAKE) for name in ("c", "a", "b")]
    assert list(in_order(found)) == ["source.c", "source.a", "source.b"]


@pytest.mark.parametrize(
    ("found", "words"),
    [
        ([declared("a.one", RUN), declared("a.one", RUN)], "a.one is declared twice"),
        ([declared("a.one", RUN, "a.gone")], "a.one: no check is declared as a.gone"),
        ([declared("a.one", RUN, after=("a.gone",))], "no check is declared as a.gone"),
        ([declared("a.one", RUN, "a.two"), declared("a.two", RUN, "a.one")], "cycle"),
    ],
)
def test_a_wrong_declaration_is_refused(found: list[Check], words: str) -> None:
    with pytest.raises(ValueError, match=words):
        in_order(found)
