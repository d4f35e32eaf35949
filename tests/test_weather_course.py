"""Students of another course read only texts, commands and links of their own lesson.

The verdicts are from recorded evidence (test_another_course.py has a real one of another lesson).
"""

from __future__ import annotations

import ast
import json
import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

from grader.base.i18n.message import Message
from grader.base.i18n.translator import Translator
from grader.course.assignment import Assignment
from grader.mistakes.catalogue import CATALOGUE
from grader.mistakes.kind import Kind
from grader.mistakes.links import address
from grader.mistakes.placeholders import placeholder_values
from grader.package.edit.tree import Delete, Edit, Replace
from grader.report.model import CheckResult
from grader.ros.distro import find_distro
from grader.run.observer import Event, Watch
from grader.run.probe_link import NodeSeen
from grader.run.run import Run
from grader.run.workspace import Build
from grader.verdict.evaluate import evaluate_checks
from grader.verdict.evidence import Evidence
from tests import processes, weather
from tests.fixing import patch_for
from tests.mistakes.filled import filled
from tests.weather import NODE, SETUP, STEP, TIMER

LANGUAGES = ["en", "ko"]
OURS = re.compile(
    r"hello[ _]?time|my_first_node|MyFirstNode|test_node|my_robot_controller|counter_\b"
    r"|timer_callback|create_timer\(1\.0|\bmain\b",
    re.IGNORECASE,
)
BUILT = Build(command="colcon build", status=0, log="", seconds=0.0)
STATION = NodeSeen("/station", clock=True, rosout=True, parameters=True)


@pytest.fixture
def course(tmp_path: Path) -> Path:
    return weather.write_course(tmp_path)


def env(course: Path, **more: str) -> dict[str, str]:
    return {"GRADER_COURSE": str(course), **more}


# the source


def sources() -> Iterator[Path]:
    """Yield the files of the grader and the lab, except the lesson's course and keys."""
    listed = processes.run(["git", "ls-files", "-z", "grader", "lab"]).stdout.split("\0")
    for name in filter(None, listed):
        if not name.startswith(("grader/keys/", "lab/course/")) and not name.endswith(".mo"):
            yield processes.ROOT / name


EDITS = (
    *("example", "Replace", "Write", "Move", "Copy", "Delete", "Nest", "Chmod", "Crlf"),
    *("_example", "_line", "_sections", "_renamed"),  # (these make examples or edits)
)


def texts_of(path: Path) -> Iterator[tuple[int, str]]:
    """Yield the lines of a file with their numbers.

    Of the catalogue's records, which have examples with the tutorial's package, these are the
    strings outside of the examples and of the constants that the examples use.
    """
    text = path.read_text(encoding="utf-8")
    if path.parent != processes.ROOT / "grader/mistakes" or path.suffix != ".py":
        yield from enumerate(text.splitlines(), 1)
        return
    waiting: list[ast.AST] = [n for n in ast.parse(text).body if not is_constant(n)]
    while waiting:
        node = waiting.pop()
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            yield node.lineno, node.value
        if not (isinstance(node, ast.Call) and ast.unparse(node.func) in EDITS):
            waiting += ast.iter_child_nodes(node)


def is_constant(node: ast.stmt) -> bool:
    """Whether a statement gives a name to a plain string, or to an edit."""
    value = node.value if isinstance(node, ast.Assign) else None
    called = ast.unparse(value.func) if isinstance(value, ast.Call) else ""
    return called in EDITS or isinstance(value, ast.Constant | ast.JoinedStr | ast.BinOp)


def test_only_the_lessons_own_files_mention_its_parts() -> None:
    words = re.compile(OURS.pattern.partition(r"|\bmain\b")[0], re.IGNORECASE)
    found = [
        f"{path.relative_to(processes.ROOT)}:{number}: {line.strip()}"
        for path in sources()
        if path.is_file()
        for number, line in texts_of(path)
        if words.search(line)
    ]
    assert found == []


def kinds() -> list[object]:
    return [pytest.param(kind, id=kind.id) for kind in CATALOGUE.values()]


@pytest.mark.parametrize("kind", kinds())
def test_an_entry_of_the_catalogue_is_filled_by_the_lesson(kind: Kind, tmp_path: Path) -> None:
    words = {**placeholder_values(weather.assignment()), "distro": "kilted"}
    templates = [kind.title, kind.why, kind.fix, *kind.whys.values(), *kind.fixes.values()]
    for lang in LANGUAGES:
        for template in templates:
            text = Translator(lang)(Message(template, filled(template, words)))
            assert not OURS.search(text), text
    for name in ("humble", "kilted", "rolling"):
        link = address(kind.link, find_distro(name))
        assert "docs.ros.org" not in link or f"/en/{name}/" in link


# typical mistakes, judged by the checks on constructed runs


@dataclass(frozen=True)
class Mistake:
    """A broken package: its edits, its run, the check that fails and the mistake."""

    edits: tuple[Edit, ...]
    check: str
    named: str
    says: str
    run: Run | None = None


def counted(text: str, *, node: NodeSeen = STATION) -> Run:
    """Return a run whose lines come on time, with the next number for {n} in each."""
    numbers = range(1, 5)
    events = [
        Event(text.replace("{n}", str(k)), k / 10, k / 2, "logger", _number(text, k), k - 1)
        for k in numbers
    ]
    watch = Watch(clock="virtual", events=events, dues=[k / 2 for k in numbers], period=0.5)
    return Run("ros2 run", watch, (node,), started=True, interrupted=True)


def _number(text: str, n: int) -> int | None:
    return n if text == "Reading {n}" else None


def still(number: int) -> Run:
    """Return a run whose number never changes."""
    run = counted("Reading {n}")
    run.watch.events[:] = [
        Event(f"Reading {number}", e.wall, e.virtual, "logger", number, e.due)
        for e in run.watch.events
    ]
    return run


def silent() -> Run:
    return Run("ros2 run", Watch(clock="virtual"), (STATION,), started=True, interrupted=True)


def ended(transcript: str = "", status: int = 0) -> Run:
    return Run("ros2 run", ended_by_itself=True, status=status, transcript=transcript)


def traceback(line: int, error: str) -> str:
    place = f"/ws/build/{weather.NAME}/{NODE}"
    return f'Traceback (most recent call last):\n  File "{place}", line {line}, in x\n{error}\n'


MISTAKES = {
    "another package name": Mistake(
        (Replace("package.xml", "<name>weather_station<", "<name>wether_station<"),),
        "package.manifest", "package.name_mismatch", "weather_station",
    ),
    "no marker": Mistake(
        (Delete(weather.MARKER),), "package.marker", "package.marker_missing", "weather_station",
    ),
    "no node file": Mistake(
        (Delete(NODE),),
        "source.node_file", "source.no_node_file", "weather_station/station.py",
    ),
    "no entry": Mistake(
        (Replace(SETUP, weather.ENTRY, ""),), "entry_point.mapping", "setup.no_entry",
        "read_out = weather_station.station:begin",
    ),
    "missing comma": Mistake(
        (Replace(SETUP, weather.ENTRY, f"'other = weather_station.other:go'\n{weather.ENTRY}"),),
        "entry_point.mapping", "setup.missing_comma", "other = weather_station.other:go",
    ),
    "another function": Mistake(
        (Replace(SETUP, ":begin'", ":start'"),), "entry_point.mapping", "setup.other_function",
        "begin",
    ),
    "no spin": Mistake(
        (Replace(NODE, "rclpy.spin(station)", "pass"),), "run.starts", "node.spin_missing",
        "begin", ended(),
    ),
    "the function is not there": Mistake(
        (Replace(NODE, "def begin(", "def began("),), "run.starts", "node.main_misspelt", "begin",
        ended(traceback(1, "AttributeError: module 'weather_station.station' has no attribute "
                           "'begin'"), status=1),
    ),
    "the function wants an argument": Mistake(
        (Replace(NODE, "begin(args=None)", "begin(args)"),), "run.starts", "node.main_wants_args",
        "def begin(args=None):",
        ended(traceback(1, "TypeError: begin() missing 1 required positional argument: 'args'"),
              status=1),
    ),
    "another node name": Mistake(
        (Replace(NODE, "'station'", "'stations'"),), "run.node_name", "run.wrong_node_name",
        "super().__init__('station')" ,
        counted("Reading {n}", node=NodeSeen("/stations", clock=True, rosout=True, parameters=True)),
    ),
    "another text": Mistake(
        (Replace(NODE, "f'Reading ", "f'reading "),), "run.output", "run.wrong_text",
        "Reading 1", counted("reading {n}"),
    ),
    "no f": Mistake(
        (Replace(NODE, "f'Reading", "'Reading"),), "run.output", "node.f_prefix",
        "f'Reading {self.", counted("Reading {self.reading}"),
    ),
    "nothing is added": Mistake(
        (Replace(NODE, STEP, ""),), "run.output", "node.counter_not_increased",
        "self.reading += 1", still(1),
    ),
    "no timer": Mistake(
        (Replace(NODE, TIMER, ""),), "run.output", "node.timer_missing",
        "self.create_timer(0.5, self.take)", silent(),
    ),
    "silent for no known reason": Mistake(
        (Replace(NODE, "import rclpy\n", "import rclpy\n\n\0"),), "run.output", "run.no_lines",
        "create_timer(0.5, self.", silent(),
    ),
}  # fmt: skip


def result_of(mistake: Mistake, assignment: Assignment, folder: Path, lang: str) -> CheckResult:
    """Return the check's result for a broken package, with the patch that fixes it."""
    submission = weather.taken(folder, *mistake.edits)
    run = mistake.run or counted("Reading {n}")
    evidence = Evidence(assignment, submission, build=lambda: BUILT, run=lambda: run)
    (result,) = evaluate_checks(evidence, Translator(lang), only=[mistake.check])
    assert result.status == "failed", result
    return result.model_copy(update={"patch": patch_for(result, submission, assignment)})


def texts(result: CheckResult) -> str:
    """Return all texts of a result that a student reads, without their own lines in a patch."""
    given = result.model_dump(include={"title", "rationale", "expected", "actual", "fix", "advice"})
    added = [line for line in result.patch.splitlines() if line.startswith("+")]
    params = [mistake.params for mistake in result.mistakes]
    return json.dumps([given, added, params], ensure_ascii=False)


@pytest.mark.parametrize("lang", LANGUAGES)
@pytest.mark.parametrize("name", MISTAKES)
def test_a_mistake_is_explained_with_the_lessons_texts(
    name: str, lang: str, tmp_path: Path
) -> None:
    mistake = MISTAKES[name]
    result = result_of(mistake, weather.assignment(), tmp_path, lang)
    assert result.mistakes[0].id == mistake.named
    output = texts(result)
    assert mistake.says in output
    assert not OURS.search(output), output


# the commands


def test_the_right_package_passes_every_run_check(tmp_path: Path) -> None:
    """This shows that the constructed runs above fail because of the mistake only."""
    wanted = weather.assignment()
    run = counted("Reading {n}")
    evidence = Evidence(wanted, weather.taken(tmp_path), build=lambda: BUILT, run=lambda: run)
    only = ("package.manifest", "entry_point.mapping", "run.starts", "run.output")
    found = {
        result.id: result.status
        for result in evaluate_checks(evidence, Translator("en"), only=only)
    }
    assert found == dict.fromkeys(only, "passed")


@pytest.mark.prefix
def test_the_right_package_gets_full_marks(course: Path, tmp_path: Path) -> None:
    package = weather.write_package(tmp_path)
    graded = processes.run(
        processes.replaying("grade", package, "--out", tmp_path / "o"), env=env(course)
    )
    assert graded.returncode == 0, graded.stdout + graded.stderr
    assert f"{weather.FULL_MARKS} / {weather.FULL_MARKS}" in graded.stdout
    checked = processes.run(processes.replaying("check", package), env=env(course))
    assert checked.returncode == 0, checked.stdout + checked.stderr
    for output in (graded, checked):
        assert not OURS.search(output.stdout), output.stdout


@pytest.mark.prefix
@pytest.mark.parametrize("lang", LANGUAGES)
def test_a_verdict_mentions_nothing_of_our_lesson(course: Path, tmp_path: Path, lang: str) -> None:
    package = weather.write_package(tmp_path, Replace(NODE, "f'Reading {", "f'Readings {"))
    words = processes.replaying("check", "--lang", lang, "-v", package)
    done = processes.run(words, env=env(course))
    assert done.returncode == 1, done.stderr
    assert "Reading 1" in done.stdout
    assert not OURS.search(done.stdout), done.stdout


@pytest.mark.prefix
def test_fix_uses_the_lesson(course: Path, tmp_path: Path) -> None:
    package = weather.write_package(tmp_path, Replace(SETUP, weather.ENTRY, ""))
    done = processes.run(processes.grader("fix", "--no-run", package), env=env(course))
    assert done.returncode == 0, done.stderr
    assert f"+{' ' * 12}{weather.ENTRY}" in done.stdout
    assert not OURS.search(done.stdout + done.stderr)


def explained(*words: str, **more: str) -> str:
    done = processes.run(
        processes.grader("explain", *words), env={"ROS_DISTRO": "", "COLUMNS": "300", **more}
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_explain_uses_the_lesson_and_the_distro(course: Path) -> None:
    output = explained("run.no_lines", ROS_DISTRO="kilted", **env(course))
    assert "create_timer(0.5, self." in output
    assert "https://docs.ros.org/en/kilted/" in output
    assert "https://docs.ros.org/en/humble/" in explained("run.no_lines", "--distro", "humble")
    assert "f'Reading {self." in explained("node.f_prefix", **env(course))
    assert "source /opt/ros/kilted/" in explained("lab.ros_not_sourced", "--distro", "kilted")


def test_explain_without_a_lesson_shows_an_example(tmp_path: Path) -> None:
    several = weather.write_course(tmp_path, "winds")
    output = explained("run.no_lines", **env(several))
    assert "create_timer(1.0, self.callback)" in output
    assert "an example" in output
    assert "f'Count: {self.counter}'" in explained("node.f_prefix", **env(several))
    assert "https://docs.ros.org/en/jazzy/" in explained("run.no_lines", ROS_DISTRO="unheard-of")


def guide(*words: str | Path, **more: str) -> tuple[int, str, str]:
    line = [sys.executable, "-m", "lab.guide", *map(str, words)]
    done = processes.run(
        line, env={"AMENT_PREFIX_PATH": "/opt/ros/kilted", "ROS_DISTRO": "kilted", **more}
    )
    return done.returncode, done.stdout, done.stderr


def test_the_guide_uses_the_courses_own_lesson(course: Path, tmp_path: Path) -> None:
    workspace = tmp_path / "ws"
    status, output, _ = guide("--workspace", workspace, **env(course))
    assert status == 0
    assert output.startswith("Step 2 of 4: Make the package\n")
    assert "source /opt/ros/kilted/setup.bash" in output
    assert "https://docs.ros.org/en/kilted/Concepts.html" in output
    assert "<!--" not in output
    assert "ros2 pkg create --build-type ament_python weather_station" in output
    (workspace / "src").mkdir(parents=True)
    weather.write_package(
        workspace / "src", Replace(NODE, TIMER, ""), Replace(SETUP, weather.ENTRY, "")
    )
    _, output, _ = guide("--workspace", workspace, **env(course))
    assert "Found: the node in station.py has no timer yet" in output.splitlines()
    _, listed, _ = guide("list", "--workspace", workspace, **env(course))
    assert [line[:3] for line in listed.splitlines()[:4]] == ["[x]", "[x]", "[>]", "[ ]"]
    _, korean, _ = guide("--lang", "ko", "--workspace", workspace, **env(course))
    assert "관측소 쓰기" in korean
    for each in (output, listed, korean):
        assert not OURS.search(each)


def test_the_guide_says_when_everything_is_done(course: Path, tmp_path: Path) -> None:
    (tmp_path / "ws/src").mkdir(parents=True)
    weather.write_package(tmp_path / "ws/src")
    status, output, _ = guide("--workspace", tmp_path / "ws", **env(course))
    assert (status, output.splitlines()[-2:]) == (0, ["Next: check", "More: lab hint"])
    _, listed, _ = guide("list", "--workspace", tmp_path / "ws", **env(course))
    assert [line[:3] for line in listed.splitlines()[:4]] == ["[x]"] * 4


@pytest.mark.parametrize(
    ("text", "output"),
    [
        (weather.LESSON.replace("done: package", "done: pakage"), "did you mean 'package'?"),
        ("# A lesson without steps\n", "no lesson with steps"),
        (None, "no lesson with steps"),
    ],
)
def test_a_lesson_that_the_guide_cannot_use_is_reported(
    course: Path, tmp_path: Path, text: str | None, output: str
) -> None:
    file = course / "readings" / "lesson.md"
    file.unlink()
    if text is not None:
        file.write_text(text)
    status, shown, errors = guide("--workspace", tmp_path, **env(course))
    assert (status, shown) == (2, "")
    assert output in errors
    assert "Traceback" not in errors


# choosing the lesson

COMMANDS = {
    "grade": ("grade", "."),
    "check": ("check", "."),
    "fix": ("fix", "."),
    "grade-all": ("grade-all", "."),
    "validate": ("validate",),
    "override": ("override", "--list"),
    "gradescope-zip": ("gradescope-zip", "x.zip"),
}


def run(command: str, cwd: Path, **more: str) -> tuple[int, str]:
    words = {
        "guide": [sys.executable, "-m", "lab.guide"],
        "lab": [sys.executable, "-m", "lab", "--workspace", str(cwd / "ws"), "--", "true"],
    }.get(command) or processes.grader(*COMMANDS[command])
    done = processes.run(words, cwd=cwd, env=more)
    assert "Traceback" not in done.stderr
    return done.returncode, done.stderr


@pytest.mark.parametrize("command", [*COMMANDS, "guide", "lab"])
def test_one_of_several_lessons_must_be_named(command: str, tmp_path: Path) -> None:
    course = weather.write_course(tmp_path, "winds")
    before = sorted(tmp_path.rglob("*"))
    status, errors = run(command, tmp_path, **env(course))
    assert status == 2
    assert f"there are several lessons in {course}" in errors
    assert "readings, winds" in errors
    assert sorted(tmp_path.rglob("*")) == before


@pytest.mark.parametrize("command", ["check", "guide", "lab", "validate"])
def test_an_invalid_course_folder_is_reported(command: str, course: Path, tmp_path: Path) -> None:
    for folder, output in (
        (tmp_path / "nowhere", "there is no course folder"),
        (course / "readings", "is a lesson, not a course"),
        (tmp_path / "course" / "readings" / "..", ""),
        (Path("/proc/self/task"), "there is no lesson in the course folder"),
    ):
        if output:
            status, errors = run(command, tmp_path, GRADER_COURSE=str(folder))
            assert status == 2
            assert output in errors


def test_the_environment_selects_the_lesson(tmp_path: Path) -> None:
    course = weather.write_course(tmp_path, "winds")
    more = env(course, GRADER_ASSIGNMENT="winds")
    package = weather.write_package(tmp_path, Replace(SETUP, weather.ENTRY, ""))
    done = processes.run(processes.grader("fix", "--no-run", package), env=more)
    assert done.returncode == 0, done.stderr
    words = ("fix", "--check", "x", "--assignment", "readings", package)
    done = processes.run(processes.grader(*words), env=more)
    assert "no check 'x' in readings" in done.stderr, "the command line comes first"
    status, errors = run("check", tmp_path, **env(course, GRADER_ASSIGNMENT="wind"))
    assert status == 2
    assert "readings, winds" in errors


def test_our_keys_are_not_searched_for_another_courses_solution(tmp_path: Path) -> None:
    """A lesson may have the name of one of ours."""
    course = weather.write_course(tmp_path)
    (course / "readings").rename(course / "hello_time")
    status, errors = run("validate", tmp_path, **env(course))
    assert status == 2
    assert "--keys" in errors
