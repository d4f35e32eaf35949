"""An instructor's own checks in `checks.py`: found, judged, and never a student's loss if wrong."""

from __future__ import annotations

import json
import re
import shutil
import zipfile
from io import BytesIO
from pathlib import Path

import pytest

from grader.base.errors import UsageError
from grader.base.unheard import unheard
from grader.batch.systems.gradescope.archive import gradescope_zip
from grader.batch.work import Job
from grader.course.find import KEYS
from grader.report.model import Report
from grader.ros.distro import find_distro
from grader.sandbox.limits import Limits
from grader.verdict.mark import grade
from grader.verdict.order import Order, load_visible, load_with_hidden
from tests import processes, recorded
from tests.marking import LIMITS
from tests.scenario_kinds import FORMS, write_course, write_package

LESSON = processes.ROOT / "lab/course/hello_time/assignment.yaml"
SOLUTION = KEYS / "hello_time/solution/my_robot_controller"
HEAD = """\
from grader.verdict.checks.declare import INTAKE, RUN, Parameters, check, kind
from grader.verdict.outcome import Failed, Passed
"""
LICENCE = """

@check("own.licence", stage=INTAKE, depends=["package.found"])
def licence(evidence):
    \"\"\"The package says under which licence it is\"\"\"
    BODY
"""
FAILS = """raise Failed(
        "own.no_licence",
        expected="a file LICENSE",
        actual="there is none",
        rationale="Nobody may use it otherwise.",
        fix="Choose one at choosealicense.com.",
    )"""


def own_check(body: str) -> str:
    return HEAD + LICENCE.replace("BODY", body)


def lesson(
    folder: Path, text: str, *, use: str = "id: own.licence, points: 7"
) -> tuple[Path, Path]:
    """Return an assignment with a use of an own check, and the keys with the text of checks.py."""
    file, keys = folder / "assignment.yaml", folder / "keys"
    keys.mkdir(exist_ok=True)
    (keys / "checks.py").write_text(text, encoding="utf-8")
    given = LESSON.read_text(encoding="utf-8")
    file.write_text(given.replace("checks:\n", f"checks:\n  - {{{use}}}\n", 1), encoding="utf-8")
    return file, keys


def marked(folder: Path, text: str) -> Report:
    file, keys = lesson(folder, text)
    return recorded.mark(SOLUTION, assignment=load_with_hidden(str(file), keys))


@pytest.mark.parametrize("body", ["return Passed()", "pass", "return None"])
def test_an_own_check_gives_its_points(body: str, tmp_path: Path) -> None:
    report = marked(tmp_path, own_check(body))
    found = report.check("own.licence")
    assert (found.status, found.score) == ("passed", 7)
    assert found.title == "The package says under which licence it is"
    assert (report.score, report.max_score) == (107, 107)


def test_a_failure_has_the_instructors_own_words(tmp_path: Path) -> None:
    report = marked(tmp_path, own_check(FAILS))
    found = report.check("own.licence")
    assert (found.status, found.score) == ("failed", 0)
    assert (found.expected, found.actual) == ("a file LICENSE", "there is none")
    assert found.rationale == "Nobody may use it otherwise."
    assert found.fix == "Choose one at choosealicense.com."
    assert [mistake.id for mistake in found.mistakes] == ["own.no_licence"]
    assert report.score == 100


@pytest.mark.parametrize(
    ("body", "words"),
    [
        ("return 1 / 0", "ZeroDivisionError"),
        ("raise SystemExit(0)", "SystemExit"),
        ("return False", "must return Passed or raise Failed"),
        ("raise Failed('no.such_mistake', expected='', actual='')", "no.such_mistake"),
    ],
)
def test_a_wrong_check_is_our_fault_and_costs_nothing(
    body: str, words: str, tmp_path: Path
) -> None:
    report = marked(tmp_path, own_check(body))
    found = report.check("own.licence")
    assert found.status == "error"
    assert words in found.fault
    assert (report.score, report.inconclusive) == (100, 7)
    assert all(c.status == "passed" for c in report.checks if c.id != "own.licence")


@pytest.mark.parametrize(
    ("text", "line", "words"),
    [
        (HEAD + "def f(:\n", 3, "not Python: "),
        (HEAD + "import nowhere\n", 3, "ModuleNotFoundError: No module named 'nowhere'"),
        (HEAD + "\nraise SystemExit('no')\n", 4, "SystemExit: no"),
        (own_check("pass").replace("own.licence", "licence"), 5, "begins with 'own.'"),
        (own_check("pass").replace("package.found", "package.fond"), 1, "package.fond"),
        (
            own_check("pass") + LICENCE.replace("BODY", "pass").replace("def l", "def other_l"),
            1,
            "declared twice",
        ),
    ],
)
def test_a_mistake_in_the_file_is_told_with_its_line(
    text: str, line: int, words: str, tmp_path: Path
) -> None:
    file, keys = lesson(tmp_path, text)
    done = processes.run(processes.grader("grade", SOLUTION, "--assignment", file, "--keys", keys))
    assert done.returncode == 2
    assert f"{keys}/checks.py:{line}:" in done.stderr
    assert words in done.stderr
    assert "Traceback" not in done.stderr


def test_a_misspelt_use_is_told(tmp_path: Path) -> None:
    file, keys = lesson(tmp_path, own_check("pass"), use="id: own.license, points: 7")
    with pytest.raises(UsageError, match=r"did you mean 'own.licence'"):
        load_with_hidden(str(file), keys)


def test_students_do_not_have_them_and_are_told_how_many_there_are(tmp_path: Path) -> None:
    file, _ = lesson(tmp_path, own_check("pass"))
    found = load_visible(str(file))
    assert not any(use.kind.startswith("own.") for use in found.checks)
    assert found.hidden_checks == 1
    done = processes.run(processes.replaying("check", SOLUTION, "--assignment", file))
    assert done.returncode == 0, done.stderr
    assert "also runs 1 hidden check." in done.stdout


def test_other_text_is_another_assignment(tmp_path: Path) -> None:
    file, keys = lesson(tmp_path, own_check("pass"))
    before = load_with_hidden(str(file), keys)
    (keys / "checks.py").write_text(own_check(FAILS), encoding="utf-8")
    assert load_with_hidden(str(file), keys).sha256 != before.sha256


def test_workers_get_the_text_and_no_file_has_it(tmp_path: Path) -> None:
    file, keys = lesson(tmp_path, own_check("pass"))
    wanted = load_with_hidden(str(file), keys)
    job = Job(wanted, "jazzy", "bubblewrap", Limits())
    assert Job.from_text(job.to_text()).assignment.own_checks == wanted.own_checks != ""
    assert "own_checks" not in wanted.model_dump_json()


def graded(folder: Path) -> tuple[Path, Path, Path]:
    file, keys = lesson(folder, own_check(FAILS))
    done = processes.run(
        processes.replaying(
            *("grade", SOLUTION, "--assignment", file, "--keys", keys, "--out", folder / "out")
        )
    )
    assert done.returncode == 1, done.stderr
    (report,) = (folder / "out").rglob("report.json")
    return report, file, keys


def test_evidence_has_no_code_and_is_replayed_with_the_keys(tmp_path: Path) -> None:
    report, file, keys = graded(tmp_path)
    evidence = report.with_name("evidence.json").read_text(encoding="utf-8")
    assert "choosealicense" not in evidence
    without = processes.run(processes.grader("replay", report))
    assert without.returncode == 2
    assert "--keys" in without.stderr
    assert "Traceback" not in without.stderr
    for words in (("--keys", keys), ("--keys", keys, "--assignment", file)):
        again = processes.run(processes.grader("replay", report, *words))
        assert again.returncode == 0, again.stdout + again.stderr


def test_a_class_is_marked_with_them(tmp_path: Path) -> None:
    file, keys = lesson(tmp_path, own_check(FAILS))
    shutil.copytree(SOLUTION, tmp_path / "class/ann")
    words = ("--assignment", file, "--keys", keys, "--out", tmp_path / "out")
    done = processes.run(processes.replaying("grade-all", tmp_path / "class", *words))
    assert done.returncode == 1, done.stderr
    (report,) = (tmp_path / "out").rglob("report.json")
    found = {c["id"]: c["status"] for c in json.loads(report.read_text())["checks"]}
    assert found["own.licence"] == "failed"


def test_gradescopes_archive_has_them(tmp_path: Path) -> None:
    file, keys = lesson(tmp_path, own_check("pass"))
    content = gradescope_zip(assignment=str(file), keys=keys)
    with zipfile.ZipFile(BytesIO(content)) as archive:
        assert archive.read("keys/checks.py").decode() == own_check("pass")
        assert "--keys keys" in archive.read("run_autograder").decode()


MUTANTS = """\
schema: 1
mutants:
  - name: no_licence
    check: own.licence
    mistake: own.no_licence
    edits:
      - {replace: setup.py, old: "Apache-2.0", new: "none"}
"""
BY_FILE = """if b"Apache-2.0" not in evidence.submission.file("setup.py").data:
        raise Failed("own.no_licence", expected="Apache-2.0", actual="another")"""


def test_an_assignment_with_them_is_validated(tmp_path: Path) -> None:
    file, keys = lesson(tmp_path, own_check(BY_FILE))
    shutil.copytree(SOLUTION, keys / "solution/my_robot_controller")
    assert "Apache-2.0" in (SOLUTION / "setup.py").read_text(encoding="utf-8")
    (keys / "mutants.yaml").write_text(MUTANTS, encoding="utf-8")
    done = processes.run(
        processes.grader("validate", file, "--keys", keys, "--static", "--only", "no_licence")
    )
    row = next(line for line in done.stdout.splitlines() if line.startswith("no_licence"))
    assert row.split()[1] == "X"  # at this check, which is the first
    assert "own.no_licence" in row


def documented() -> str:
    text = (processes.ROOT / "docs/assignments.md").read_text(encoding="utf-8")
    (found,) = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    return str(found)


@pytest.mark.prefix
@pytest.mark.full
def test_the_documented_example_judges_a_real_run(tmp_path: Path) -> None:
    file, keys = write_course(tmp_path), tmp_path / "keys"
    keys.mkdir()
    (keys / "checks.py").write_text(documented(), encoding="utf-8")
    uses = """checks:
  - {id: own.author, points: 5}
  - {id: gentle, check: own.step, points: 10, with: {topic: /doubled, most: 100}}
  - {id: gentler, check: own.step, points: 10, with: {topic: /doubled, most: 2}}
"""
    text = file.read_text(encoding="utf-8")
    file.write_text(text.replace("checks:\n", uses, 1), encoding="utf-8")
    assignment = load_with_hidden(str(file), keys)
    package = write_package(next(form for form in FORMS if form.name == "right"), tmp_path)
    order = Order(
        path=package,
        assignment=assignment,
        distro=find_distro("jazzy"),
        sandbox="bubblewrap",
        limits=LIMITS.override(assignment.limits),
    )
    report = grade(order, unheard)
    found = {c.id: c for c in report.checks}
    assert found["own.author"].status == "failed"  # its README.md has no author
    assert found["gentle"].status == "passed"
    assert found["gentle"].title.startswith("The values on /doubled change by at most 100")
    assert found["gentler"].status == "failed"
    assert found["gentler"].actual == "a step of 7"  # from 8 (2 * 4) to 15 (3 * 5)
    where = found["gentler"].where
    assert where is not None
    assert where.file == "doubling/doubler.py"
