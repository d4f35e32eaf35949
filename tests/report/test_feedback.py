"""How much a student gets to know of a failed check, in everything that students see."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from datetime import datetime, timedelta, timezone
from pathlib import Path

import pytest

from grader.base.errors import AssignmentError
from grader.batch.model import ClassResult
from grader.batch.points import single
from grader.batch.systems.gradescope import write as gradescope
from grader.batch.systems.known import report_forms
from grader.cli.called import commands_for
from grader.course.load import load_assignment
from grader.publish.gradebooks import FEEDBACK, write_outputs
from grader.publish.junit import report_xml
from grader.publish.markdown import markdown
from grader.report.detail import HINTS, Detail, Feedback, FeedbackRules
from grader.report.feedback import first_failure, for_lab, with_feedback, without_hidden
from grader.report.files import report_json
from grader.report.model import CheckResult, Mistake, Report, RunInfo, TopicPlot, Where
from tests import processes, recorded
from tests.corpus.broken import BROKEN
from tests.corpus.build import write
from tests.pages import classes
from tests.report import samples

THIRDS = 3  # of the kinds of mistakes: one in CI, all in the long run
DUE = datetime(2026, 11, 20, 22, 0, tzinfo=timezone.utc)
BEFORE, AFTER = DUE - timedelta(hours=1), DUE + timedelta(hours=1)
SECRETS = {  # what each level adds, in words that occur in no other text
    Detail.WHERE: ("wantedwanted", "foundfound", "placeplace", "run.wrong_text"),
    Detail.WHY: ("reasonreason",),
    Detail.KIND: ("kindkind", "besidebeside"),
    Detail.LINE: ("lineline", "paramparam"),
}
Render = Callable[[Report], str]


def failed(visibility: str = "visible", **fields: object) -> CheckResult:
    content: dict[str, object] = {
        "expected": "wantedwanted",
        "actual": "foundfound",
        "rationale": "reasonreason",
        "fix": "kindkind",
        "patch": "--- a/x.py\n+++ b/x.py\n@@ -1 +1 @@\n-old\n+lineline\n",
        "advice": ["besidebeside"],
        "mistakes": [{"id": "run.wrong_text", "params": {"text": "paramparam"}}],
        "where": {"file": "placeplace.py", "line": 18},
        "visibility": visibility,
    }
    return samples.check("run.output", "failed", **{**content, **fields})


def secrets_in(text: str) -> set[Detail]:
    return {level for level, words in SECRETS.items() if any(word in text for word in words)}


def levels(detail: Detail) -> set[Detail]:
    return {level for level in SECRETS if level <= detail}


RENDERERS: dict[str, Render] = {
    "terminal": lambda r: samples.render_report(r, verbose=True),
    "json": report_json,
    "junit": lambda r: report_xml(r).decode(),
    "markdown": lambda r: markdown(single(r), "x", show_hidden=False),
}


@pytest.mark.parametrize("lang", ["en", "ko"])
@pytest.mark.parametrize("detail", list(Detail))
@pytest.mark.parametrize("name", RENDERERS)
def test_each_level_shows_what_it_adds_and_nothing_above(
    name: str, detail: Detail, lang: str
) -> None:
    report = with_feedback(samples.report(failed(), lang=lang), detail)
    assert secrets_in(RENDERERS[name](report)) == levels(detail)


def test_the_points_and_ids_of_checks_never_change() -> None:
    report = samples.report(failed())
    for detail in Detail:
        seen = with_feedback(report, detail)
        assert [(c.id, c.status, c.score) for c in seen.checks] == [
            (c.id, c.status, c.score) for c in report.checks
        ]
        assert seen.score == report.score


@pytest.mark.parametrize("visibility", ["hidden", "after_due_date"])
def test_a_hidden_check_shows_no_details_at_any_level(visibility: str) -> None:
    after = samples.check("run.period", "skipped", blocked_by="run.output", depends=["run.output"])
    report = samples.report(failed(visibility), after)
    for detail in Detail:
        text = report_json(without_hidden(with_feedback(report, detail)))
        assert secrets_in(text) == set()
        assert "run.output" not in text
        assert "hidden.1" in text


FORMS = [*report_forms()]


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize(
    ("word", "detail"),
    [
        ("full", Detail.LINE),
        ("hints", Detail.KIND),
        ("where", Detail.WHERE),
        ("score", Detail.POINTS),
    ],
)
def test_the_forms_of_other_systems_follow_the_rules(
    form: str, word: Feedback, detail: Detail
) -> None:
    report = with_rules(samples.report(failed()), FeedbackRules.model_validate(word))
    text = report_forms()[form](report, False)
    assert secrets_in(text) & set(Detail) <= levels(detail)
    assert ("reasonreason" in text, "lineline" in text) == (
        detail >= Detail.WHY,
        detail >= Detail.LINE,
    )


def with_rules(report: Report, rules: FeedbackRules, due: datetime | None = None) -> Report:
    info = report.assignment.model_copy(update={"feedback": rules, "due": due})
    return report.model_copy(update={"assignment": info})


def test_gradescope_shows_more_after_the_due_date() -> None:
    late = failed("after_due_date").model_copy(update={"id": "run.period"})
    report = with_rules(samples.report(failed(), late), FeedbackRules(), DUE)
    before, after = (
        {
            test["extra_data"]["check"]: test["output"]
            for test in gradescope.results(report, now=at)["tests"]
        }
        for at in (BEFORE, AFTER)
    )
    assert secrets_in(before["run.output"]) == {Detail.WHERE}
    assert secrets_in(after["run.output"]) == set(SECRETS)
    # Gradescope itself shows this one after the due date only
    assert secrets_in(before["run.period"]) == set(SECRETS)


@pytest.mark.parametrize(
    ("rules", "due", "now", "detail"),
    [
        (FeedbackRules(), DUE, BEFORE, Detail.WHERE),
        (FeedbackRules(), DUE, DUE, Detail.LINE),
        (FeedbackRules(), None, BEFORE, Detail.LINE),
        (FeedbackRules(before_due="score", after_due="hints"), DUE, BEFORE, Detail.POINTS),
        (FeedbackRules(before_due="score", after_due="hints"), DUE, AFTER, Detail.KIND),
    ],
)
def test_the_due_date_decides_what_is_handed_back(
    rules: FeedbackRules, due: datetime | None, now: datetime, detail: Detail
) -> None:
    assert rules.handed_back(due, now) == detail


def test_the_lab_gives_one_hint_after_the_other_about_the_first_failure() -> None:
    other = failed(expected="other").model_copy(update={"id": "run.period"})
    report = samples.report(failed(), other)
    for hints in range(HINTS + 1):
        seen = for_lab(report, FeedbackRules(), hints=hints)
        assert secrets_in(seen.check("run.output").model_dump_json()) == levels(Detail(hints))
        assert "reasonreason" not in seen.check("run.period").model_dump_json()
    assert "lineline" in for_lab(report, FeedbackRules(), explain=True).check("run.period").patch


@pytest.mark.parametrize(("word", "detail"), [("where", Detail.WHERE), ("score", Detail.POINTS)])
def test_no_hints_are_given_where_the_instructor_wants_none(word: Feedback, detail: Detail) -> None:
    seen = for_lab(samples.report(failed()), FeedbackRules(lab=word), hints=3, explain=True)
    assert secrets_in(report_json(seen)) == levels(detail)


def test_a_failure_that_stops_others_is_the_first() -> None:
    earlier = samples.check("package.found", "failed")
    stops = samples.check("build.colcon", "failed")
    skipped = samples.check("run.starts", "skipped", blocked_by="build.colcon")
    first = first_failure(samples.report(earlier, stops, skipped).checks)
    assert first is not None
    assert first.id == "build.colcon"
    assert first_failure(samples.report().checks) is None


def test_the_files_name_comes_before_the_entry_point_that_names_it() -> None:
    named = samples.check("source.node_file", "failed")
    named = named.model_copy(update={"mistakes": [Mistake(id="source.misnamed_node_file")]})
    entry = samples.check("entry_point.mapping", "failed")
    entry = entry.model_copy(update={"where": Where(file="setup.py", line=23)})
    skipped = samples.check("run.starts", "skipped", blocked_by="entry_point.mapping")
    first = first_failure(samples.report(named, entry, skipped).checks)
    assert first is not None
    assert first.id == "source.node_file"


@pytest.mark.parametrize("file", ["no_node_file", "empty_node_file", "misplaced_node_file"])
def test_the_file_comes_before_an_entry_point_that_is_not_there_yet(file: str) -> None:
    node = samples.check("source.node_file", "failed")
    node = node.model_copy(update={"mistakes": [Mistake(id=f"source.{file}")]})
    entry = samples.check("entry_point.mapping", "failed")
    place = {"where": Where(file="setup.py", line=23)}
    entry = entry.model_copy(update={**place, "mistakes": [Mistake(id="setup.no_entry")]})
    skipped = samples.check("run.starts", "skipped", blocked_by="entry_point.mapping")
    first = first_failure(samples.report(node, entry, skipped).checks)
    assert first is not None and first.id == "source.node_file"
    other = entry.model_copy(update={**place, "mistakes": [Mistake(id="setup.missing_comma")]})
    first = first_failure(samples.report(node, other, skipped).checks)
    assert first is not None and first.id == "entry_point.mapping"


# --- real verdicts


def added_lines(report: Report) -> Iterator[str]:
    """Yield the lines that the fixes of a report add, without white space around them."""
    for check in report.checks:
        for line in check.patch.splitlines():
            text = line[1:].strip()
            if line.startswith("+") and not line.startswith("+++") and len(text) > 3:
                yield text


@pytest.mark.parametrize("name", ["module_misspelt", "setup_syntax_error"])
def test_no_file_of_a_student_has_the_line_of_the_fix_before_the_due_date(
    name: str, reports: tuple[Report, ...], tmp_path: Path
) -> None:
    report = reports[classes.REAL.index(name)]
    lines = list(added_lines(report))
    assert lines
    for detail in (Detail.WHERE, Detail.LINE):
        out = tmp_path / detail.name
        result = classes.result([classes.entry(1, report)], detail=detail)
        write_outputs(result, out)
        written = b"".join(path.read_bytes() for path in sorted((out / FEEDBACK).iterdir()))
        text = written.replace(b"\\", b"").replace(b"&#39;", b"'").replace(b"&quot;", b'"').decode()
        assert any(line in text for line in lines) == (detail == Detail.LINE)
        for fix in {check.fix for check in report.checks if check.fix}:
            found = fix.split("'")[0].strip() in text
            assert found == (detail == Detail.LINE)


@pytest.mark.long
@pytest.mark.parametrize("first", range(THIRDS))
def test_no_kind_of_mistake_tells_the_line_of_its_fix(first: int, tmp_path: Path) -> None:
    """Except where the requirement is that line: a heading of setup.cfg, the shebang and so on."""
    judged = 0
    for package in BROKEN[first::THIRDS]:
        folder = write(package, tmp_path / package.name)
        own = "\n".join(f.read_text("utf-8", "replace") for f in folder.rglob("*") if f.is_file())
        report = recorded.mark(folder)
        wanted = "\n".join(check.expected for check in report.checks)
        text = "\n".join(
            f"{check.actual}\n{check.model_dump_json(exclude={'actual', 'expected'})}"
            for check in with_feedback(report, Detail.WHERE).checks
        )
        for line in added_lines(report):
            if len(line) > len("</package>") and line not in own and line not in wanted:
                judged += 1
                assert line not in text, (package.name, line)
    assert judged > 200 / THIRDS


def test_a_sheet_of_grades_has_the_fix_only_after_the_due_date(mixed_class: ClassResult) -> None:
    from grader.publish.feedback import short_html

    entry = mixed_class.entries[0].for_student(Detail.LINE)
    assert "has to be exactly" in short_html(entry, show_hidden=False)
    entry = mixed_class.entries[0].for_student(Detail.WHERE)
    assert "has to be exactly" not in short_html(entry, show_hidden=False)


@pytest.fixture
def mixed_class(reports: tuple[Report, ...]) -> ClassResult:
    return classes.result([classes.entry(1, reports[classes.REAL.index("text_capital")])])


def str_missing(folder: Path) -> Path:
    return write(next(package for package in BROKEN if package.name == "str_missing"), folder)


LABELS = {"en": ("why", "fix"), "ko": ("이유", "해결")}


@pytest.mark.parametrize("lang", LABELS)
@pytest.mark.parametrize("hints", range(HINTS + 1))
def test_check_shows_one_level_after_the_other(hints: int, lang: str, tmp_path: Path) -> None:
    package = str_missing(tmp_path)
    words = ("--hints", str(hints), "--lang", lang, "--all")
    shown = processes.run(processes.replaying("check", package, *words)).stdout
    why, fix = (f"\n  {label} " for label in LABELS[lang])
    assert "can only concatenate str" in shown  # what was found
    assert (why in shown, fix in shown, "@@" in shown) == (hints > 0, hints > 1, hints > 2)
    assert (f"grader check --hints {hints + 1}" in shown) == (hints < HINTS)


def test_check_explains_everything_at_once(tmp_path: Path) -> None:
    shown = processes.run(processes.replaying("check", str_missing(tmp_path), "--explain")).stdout
    assert "@@" in shown
    assert "--hints" not in shown


def test_a_text_names_only_commands_that_exist_where_it_is_read(tmp_path: Path) -> None:
    lab = commands_for("check", in_lab=True, environment={})
    assert lab.next_hint(0) == "lab hint: more about this. check --explain: everything at once."
    package = str_missing(tmp_path)
    for env, named in (({}, "--hints 1"), ({"GRADER_CALLED_BY": "make"}, "make check HINTS=1")):
        done = processes.run(processes.replaying("check", package), env=env)
        shown = " ".join(done.stdout.split())
        assert (f"{named}: more about this" in shown, done.returncode) == (True, 1)
        assert ("make check EXPLAIN=1" in shown) == ("grader check" not in shown) == bool(env)
        assert len(done.stdout.splitlines()) <= 22


def test_an_instructor_sees_everything(tmp_path: Path) -> None:
    package = str_missing(tmp_path)
    done = processes.run(processes.replaying("grade", package, "--all", "--out", tmp_path / "out"))
    assert "@@" in done.stdout
    assert "--hints" not in done.stdout


def assignment(folder: Path, feedback: str) -> Path:
    text = (processes.ROOT / "lab/course/hello_time/assignment.yaml").read_text(encoding="utf-8")
    path = folder / "assignment.yaml"
    path.write_text(f"{text.replace('hidden_checks: 1', 'hidden_checks: 0')}{feedback}\n")
    return path


@pytest.mark.parametrize("command", [("check", "--hints", "1"), ("check", "--explain"), ("fix",)])
def test_hints_and_fixes_are_refused_if_the_assignment_has_none(
    command: tuple[str, ...], tmp_path: Path
) -> None:
    lesson = assignment(tmp_path, "feedback: where")
    done = processes.run(
        processes.replaying(*command, str_missing(tmp_path / "ws"), "--assignment", lesson)
    )
    assert done.returncode == 2
    assert "hello_time" in done.stderr
    assert "instructor" in done.stderr
    assert "Traceback" not in done.stderr


def test_the_key_is_a_word_or_a_block(tmp_path: Path) -> None:
    path = assignment(tmp_path, "feedback: where")
    word = load_assignment(path)
    assert set(word.feedback.model_dump().values()) == {"where"}
    block = load_assignment(assignment(tmp_path, "feedback: {before_due: score}"))
    assert block.feedback == FeedbackRules(before_due="score")
    assert block.sha256 == word.sha256  # no verdict depends on it


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("feedback: hint", "did you mean 'hints'"),
        ("feedback: {lab: wher}", "did you mean 'where'"),
        ("feedback: {before: where}", "did you mean 'before_due'"),
        ("feedback: 3", "feedback must be"),
    ],
)
def test_a_mistake_in_the_key_is_told_with_its_line(text: str, words: str, tmp_path: Path) -> None:
    path = assignment(tmp_path, text)
    with pytest.raises(AssignmentError, match=words) as told:
        load_assignment(path)
    line = len(path.read_text(encoding="utf-8").splitlines())
    assert str(told.value).startswith(f"{path}:{line}:")


def test_advice_of_a_check_that_passed_waits_for_the_kind_of_change_while_one_fails() -> None:
    passed = samples.check("package.marker", advice=["besidebeside"])
    seen = {
        detail: with_feedback(samples.report(passed, failed(advice=[])), detail).model_dump_json()
        for detail in Detail
    }
    assert [d for d, text in seen.items() if "besidebeside" in text] == [Detail.KIND, Detail.LINE]
    alone = for_lab(samples.report(passed), FeedbackRules())
    assert alone.check("package.marker").advice == ["besidebeside"]


def test_what_a_run_wanted_is_not_drawn_where_only_points_are_given() -> None:
    plot = TopicPlot(topic="/speed", field="data", checks=["drive.speed"], points=[(0.5, 1.0)])
    run = RunInfo(name="drives", wanted={"turtle1": [(1.0, 2.0)]}, plots=[plot])
    report = samples.report(failed()).model_copy(update={"runs": [run]})
    (seen,) = with_feedback(report, Detail.POINTS).runs
    assert (seen.wanted, seen.plots) == ({}, [])
    (seen,) = with_feedback(report, Detail.WHERE).runs
    assert (seen.wanted, seen.plots) == (run.wanted, run.plots)
