"""Sources that are meant to cost the grader time or an error: they have a verdict like any other."""

from __future__ import annotations

import ast
from dataclasses import replace
from pathlib import Path
from typing import NoReturn

import pytest

from grader.base.i18n.translator import Translator
from grader.mistakes.recognise import SYMPTOMS, behind_symptom
from grader.mistakes.recognised import Suspect
from grader.package.source.budget import LARGEST, MOST_DEPTH, MOST_PARTS
from grader.package.source.ends_after import counts_to, ends_after
from grader.package.source.node import read_node
from grader.package.source.python import PythonFault, parse_python
from grader.package.source.remarks import remarks_on
from grader.package.source.timer_periods import timer_periods
from grader.report.model import CheckResult
from grader.verdict.checks.all import CHECKS
from grader.verdict.evaluate import evaluate_checks
from grader.verdict.evidence import Evidence
from grader.verdict.static import evaluate_static
from tests.corpus.build import SOLUTION
from tests.corpus.model import NODE
from tests.marking import ASSIGNMENT, mark, taken_in
from tests.static_bench import Bench

RIGHT = (SOLUTION / NODE).read_text(encoding="utf-8")
NUMBERS = {
    "400 digits": "9" * 400,
    "4,000 digits": "9" * 4000,
    "9,000 digits in hexadecimal": "0x" + "f" * 9000,
    "a float beyond all": "1e999",
    "a power of powers": "10**10**10",
    "a difference of the infinite": "(1e999 - 1e999)",
}
HOSTILE = {
    "many names": ("\n".join(f"n{i} = n{i - 1}" for i in range(1, 6000)), 1),
    "many names in one line": ("x = (" + ",".join(f"n{i}" for i in range(12_000)) + ")", 1),
    "many calls": ("\n".join(f"f(g(h({i})))" for i in range(4000)), 1),
    "calls of calls": ("x = a" + "()" * 900, 1),
    "a long chain": ("x = 1\n" + "el".join(f"if x == {i}: pass\n" for i in range(900)), 2),
    "many signs": ("x = " + "-" * 900 + "1", 1),
}


@pytest.fixture
def bench(tmp_path: Path) -> Bench:
    return Bench(tmp_path)


def statuses(bench: Bench) -> dict[str, CheckResult]:
    return {r.id: r for r in evaluate_static(taken_in(bench.root), ASSIGNMENT)}


@pytest.mark.parametrize("place", ["time.sleep(NUMBER)", "node.create_timer(NUMBER * 2, None)"])
@pytest.mark.parametrize("case", NUMBERS)
def test_a_number_of_any_length_takes_no_check_away(case: str, place: str, bench: Bench) -> None:
    code = place.replace("NUMBER", NUMBERS[case])
    bench.write(NODE, f"{RIGHT}\n\ndef never(node):\n    import time\n    {code}\n")
    files = taken_in(bench.root).files
    for read in (remarks_on, ends_after, counts_to, timer_periods):
        read(files)
    timer = RIGHT.replace("create_timer(", f"create_timer({NUMBERS[case]} * ")
    source = read_node({NODE: timer.encode()}.get, NODE, ASSIGNMENT.function)
    assert source is not None
    for symptom in SYMPTOMS:
        behind_symptom(symptom, Suspect(source, ASSIGNMENT))
    assert not [r.id for r in statuses(bench).values() if r.status == "error"]
    assert statuses(bench)["source.node_file"].status == "passed"


def test_numbers_are_read_up_to_a_bound() -> None:
    tree = parse_python(b"a = 0x" + b"f" * 9000 + b"\nb = 2 ** 64\nc = 9223372036854775807\n").tree
    numbers = [node.value for node in ast.walk(tree) if isinstance(node, ast.Constant)]
    assert set(numbers) == {2, 64, 2**63 - 1, LARGEST}


def test_a_number_that_python_itself_refuses_is_the_files_fault(bench: Bench) -> None:
    bench.write(NODE, f"{RIGHT}\nx = {'9' * 5000}\n")
    found = statuses(bench)["source.node_file"]
    assert found.status == "failed"
    assert found.where is not None
    assert found.where.line == RIGHT.count("\n") + 2


@pytest.mark.parametrize("case", HOSTILE)
def test_a_file_with_too_many_parts_is_not_read_and_its_author_is_told(
    case: str, bench: Bench
) -> None:
    code, line = HOSTILE[case]
    with pytest.raises(PythonFault) as refused:
        parse_python(f"{code}\n".encode())
    assert (refused.value.kind, refused.value.line is not None) == ("size", True)
    bench.write(NODE, f"#!/usr/bin/env python3\n{code}\n{RIGHT}")
    results = statuses(bench)
    found = results["source.node_file"]
    assert found.status == "failed"
    assert found.where is not None
    assert found.where.file == NODE
    assert (found.where.line or 0) > line
    assert f"{MOST_PARTS:,}" in found.actual
    assert str(MOST_DEPTH) in found.actual
    assert "Python reads the whole file" not in found.rationale
    assert not [r.id for r in results.values() if r.status == "error"]


def broken(*_: object, **__: object) -> NoReturn:
    raise ZeroDivisionError("a bug")


def test_a_fault_of_ours_in_one_check_leaves_the_others_decided(
    bench: Bench, monkeypatch: pytest.MonkeyPatch
) -> None:
    check = replace(CHECKS["package.found"], function=broken)
    known = {**CHECKS, "package.found": check}
    monkeypatch.setattr("grader.verdict.evaluate.checks_of", lambda _: known)
    results = statuses(bench)
    assert results["package.found"].status == "error"
    assert "a bug" in results["package.found"].fault
    needed = [
        r for r in results.values() if "package.found" in r.depends and r.id != "build.colcon"
    ]
    assert len(needed) >= 6
    assert {r.status for r in needed} == {"passed"}


def test_a_fault_of_ours_in_the_diagnosis_leaves_the_check_failed(
    bench: Bench, monkeypatch: pytest.MonkeyPatch
) -> None:
    (bench.root / NODE).write_text("def main(:\n", encoding="utf-8")
    monkeypatch.setattr("grader.verdict.diagnose._following", broken)
    found = statuses(bench)["source.node_file"]
    assert found.status == "failed"
    assert found.fix
    assert "a bug" in found.fault


def test_a_fault_of_ours_in_the_build_is_met_once(bench: Bench) -> None:
    tries = 0

    def build() -> NoReturn:
        nonlocal tries
        tries += 1
        raise ZeroDivisionError("a bug")

    evidence = Evidence(ASSIGNMENT, taken_in(bench.root), build=build, run=broken)
    found = {r.id: r.status for r in evaluate_checks(evidence, Translator("en"))}
    assert tries == 1
    (met,) = [check for check, status in found.items() if status == "error"]
    assert met in ("entry_point.mapping", "build.colcon")  # (whichever asks for the build first)
    assert found["run.starts"] == "inconclusive"
    assert found["package.manifest"] == "passed"


@pytest.mark.full
@pytest.mark.prefix
def test_wrong_text_beside_a_long_number_costs_its_points(tmp_path: Path) -> None:
    bench = Bench(tmp_path)
    for path in ("setup.py", "package.xml"):
        bench.write(path, (SOLUTION / path).read_text(encoding="utf-8"))
    wrong = RIGHT.replace("Hello time: ", "Goodbye: ")
    bench.write(NODE, f"{wrong}\n\ndef never():\n    import time\n    time.sleep({'9' * 400})\n")
    report = mark(tmp_path)
    found = {check.id: check.status for check in report.checks}
    assert found["run.output"] == "failed"
    assert not {"error", "inconclusive"} & set(found.values())
