"""The Makefile: `make` prints help, and variables are data, never shell or make code."""

from __future__ import annotations

import json
import shlex
import shutil
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from grader.package.edit.tree import Replace
from tests import processes, weather
from tests.test_cli import solution

Given = Callable[..., tuple[list[str], dict[str, str]]]
HOSTILE = [
    "a b",
    "semi;touch HACKED",
    "$(touch HACKED)",
    "$(shell touch HACKED)",
    "${HOME}",
    "$HOME",
    "`touch HACKED`",
    "quote'd",
    'double"d',
    "amp&touch HACKED",
    "pipe|touch HACKED",
    "hash#tag",
    "percent%d",
    "star*",
    "back\\slash",
    "-n",
    "--out=HACKED",
    "한국어",
    "new\nline",
]


# a program in the grader's place that prints what it was given
PRINTER = """\
import json, os, sys
names = ("GRADER_COURSE", "GRADER_ASSIGNMENT", "GRADER_LANG", "LANG", "LC_ALL")
print(json.dumps([sys.argv[1:], {name: os.environ.get(name) for name in names}]))
"""


def make(*words: str, cwd: Path = processes.ROOT) -> tuple[int, str, str]:
    done = processes.run(["make", "--no-print-directory", *words], cwd=cwd)
    return done.returncode, done.stdout, done.stderr


@pytest.fixture
def given(tmp_path: Path) -> Given:
    """A function that runs make; it returns the grader's arguments and environment."""
    program = tmp_path / "printer.py"
    program.write_text(PRINTER)

    def run(*words: str, **env: str) -> tuple[list[str], dict[str, str]]:
        command = ["make", "--no-print-directory", "BOOTSTRAP=:", *words]
        grader = shlex.join([sys.executable, "-SI", str(program)])
        done = processes.run([*command, f"GRADER={grader}"], env={**UNSET, **env})
        assert done.returncode == 0, done.stderr
        arguments, environment = json.loads(done.stdout)
        return arguments, environment

    return run


def test_help_is_the_default_and_names_every_target() -> None:
    status, output, _ = make()
    assert status == 0
    for target in ("setup", "grade", "grade-all", "check", "fix", "validate", "test", "bench"):
        assert f"make {target} " in output
    assert make("help")[1] == output


def test_grade_without_a_student_says_how() -> None:
    status, _, output = make("grade")
    assert status == 2
    assert "make grade STUDENT=path/to/package" in output


@pytest.mark.parametrize("name", HOSTILE)
def test_a_hostile_name_is_passed_as_data(name: str, given: Given, tmp_path: Path) -> None:
    """Neither make nor the shell changes it, on the command line or in the environment."""
    expected = ["grade", "--out", "HACKED", "--", f"{tmp_path}/{name}"]
    assert given("grade", f"STUDENT={tmp_path}/{name}", "OUT=HACKED")[0] == expected
    assert given("grade", OUT="HACKED", STUDENT=f"{tmp_path}/{name}")[0] == expected
    assert not (processes.ROOT / "HACKED").exists()
    assert not (tmp_path / "HACKED").exists()


def test_the_grader_gets_a_hostile_name_unchanged(tmp_path: Path) -> None:
    """The missing path is this one."""
    status, out, err = make("grade", f"STUDENT={tmp_path}/$(touch HACKED)", "OUT=HACKED")
    assert (status, out) == (2, "")
    assert f"{tmp_path}/$(touch HACKED)" in err
    assert "Traceback" not in err


OPTIONS = {"ASSIGNMENT": "--assignment", "DISTRO": "--distro", "SANDBOX": "--sandbox"}
VARIABLES = {
    "grade": {**OPTIONS, "KEYS": "--keys", "NAME": "--name", "OUT": "--out", "STUDENT": "--"},
    "grade-all": {
        **OPTIONS,
        **{"KEYS": "--keys", "OUT": "--out", "ROSTER": "--roster", "WORKERS": "--workers"},
        **{"WORKSHEET": "--worksheet", "CANVAS": "--canvas", "GRADE_COLUMN": "--grade-column"},
        **{"FEEDBACK_COLUMN": "--feedback-column", "CANVAS_COLUMN": "--canvas-column"},
        **{
            "COURSE": "--course",
            "BRIGHTSPACE": "--brightspace",
            "BRIGHTSPACE_COLUMN": "--brightspace-column",
            "ACCEPT": "--accept",
            "SCHEDULER": "--scheduler",
            "SUBMISSIONS": "--",
        },
    },
    "check": {**OPTIONS, "HINTS": "--hints", "PACKAGE": "--"},
    "fix": {**OPTIONS, "PACKAGE": "--"},
    "validate": {
        "DISTRO": "--distro",
        "SANDBOX": "--sandbox",
        "KEYS": "--keys",
        "ASSIGNMENT": "--",
    },
    "images": {
        **{
            "DISTRO": "--distro",
            "BASE": "--base",
            "BASE_IMAGE": "--base-image",
            "EXTRA_CA": "--extra-ca",
        },
        **{"APT_MIRROR": "--apt-mirror", "PIP_INDEX_URL": "--pip-index"},
    },
}
UNSET = {variable: "" for variables in VARIABLES.values() for variable in variables}
REQUIRED = {"grade": "STUDENT", "grade-all": "SUBMISSIONS"}


@pytest.mark.parametrize("target", VARIABLES)
def test_every_variable_is_an_option_and_passed_as_data(
    target: str, given: Given, tmp_path: Path
) -> None:
    def hostile(variable: str) -> str:
        return f"{variable} $(shell touch {tmp_path}/HACKED);`touch {tmp_path}/HACKED`"

    pairs = [f"{variable}={hostile(variable)}" for variable in VARIABLES[target]]
    arguments, _ = given(target, *pairs)
    assert arguments[0] == target
    options = [argument for variable, option in VARIABLES[target].items()
               for argument in (option, hostile(variable))]  # fmt: skip
    assert sorted(arguments[1:]) == sorted(options)
    for option, value in zip(options[::2], options[1::2], strict=True):
        assert arguments[arguments.index(option) + 1] == value
    required = REQUIRED.get(target)
    assert given(target, *([f"{required}=x"] if required else []))[0] == [
        target,
        *(["--", "x"] if required else []),
    ]
    assert not (tmp_path / "HACKED").exists()


@pytest.mark.parametrize(("status", "said"), [(1, ""), (2, "Error 2"), (3, "Error 3")])
def test_a_verdict_is_no_error_of_make(status: int, said: str) -> None:
    """make adds "*** Error 1" to a command that failed; a package that failed is none."""
    for goal in ("grade", "check", "fix", "grade-all"):
        words = ["BOOTSTRAP=:", f"GRADER=sh -c 'exit {status}'", "STUDENT=x", "SUBMISSIONS=x"]
        ended, _, output = make(goal, *words)
        assert ended == (1 if status == 1 else 2)
        assert (said in output, "***" in output) == (True, bool(said))


def test_switches_are_set_by_a_variable(given: Given) -> None:
    assert given("check", "ALL=1")[0] == ["check", "--all"]
    assert given("grade", "ALL=1", "STUDENT=x")[0][-3:] == ["--all", "--", "x"]
    assert given("check", "EXPLAIN=1")[0] == ["check", "--explain"]
    switched = given("grade-all", "SUBMISSIONS=x", "XLSX=1", "PSEUDONYMS=1")[0]
    assert switched == ["grade-all", "--xlsx", "--pseudonyms", "--", "x"]
    assert given("grade-all", "SUBMISSIONS=x", "REGRADE=1")[0] == [
        "grade-all",
        "--regrade",
        "--",
        "x",
    ]
    assert given("fix", "APPLY=1")[0] == ["fix", "--apply"]


def test_the_course_and_the_language_are_in_the_environment(given: Given, tmp_path: Path) -> None:
    words = {"GRADER_COURSE": f"{tmp_path}/$(x)", "GRADER_ASSIGNMENT": "`x`", "GRADER_LANG": "ko"}
    pairs = [f"{name}={value}" for name, value in {**words, "LANG": "ko_KR.UTF-8"}.items()]
    _, environment = given("check", *pairs, "LC_ALL=")
    assert environment == {**words, "LANG": "ko_KR.UTF-8", "LC_ALL": ""}


@pytest.mark.long
def test_another_courses_lesson_can_be_used_through_make(tmp_path: Path) -> None:
    course = weather.write_course(tmp_path, "winds")
    package = weather.write_package(tmp_path, Replace(weather.SETUP, weather.ENTRY, ""))
    words = ("fix", f"PACKAGE={package}", f"GRADER_COURSE={course}")
    _, shown, _ = make(*words, "ASSIGNMENT=winds")
    assert weather.ENTRY in shown


@pytest.mark.long
def test_a_package_can_be_fixed_through_make(tmp_path: Path) -> None:
    package = solution(tmp_path)
    (package / "setup.cfg").unlink()
    status, shown, _ = make("fix", f"PACKAGE={package}")
    assert "+++ b/setup.cfg" in shown
    assert not (package / "setup.cfg").exists()
    status, _, output = make("fix", f"PACKAGE={package}", "APPLY=1")
    assert status == 0, output
    assert (package / "setup.cfg").exists()


def test_the_language_is_a_variable(tmp_path: Path) -> None:
    status, _, output = make("grade", f"STUDENT={tmp_path / 'missing'}", "GRADER_LANG=ko")
    assert status == 2
    assert "폴더가 없습니다" in output


def test_grade_all_without_a_class_says_how() -> None:
    status, _, output = make("grade-all")
    assert status == 2
    assert "make grade-all SUBMISSIONS=path/to/downloads" in output


@pytest.mark.full
@pytest.mark.prefix
def test_a_class_can_be_marked_through_make(tmp_path: Path) -> None:
    solution(tmp_path / "the class")
    folder, out = tmp_path / "the class", tmp_path / "out put"
    status, output, err = make(
        "grade-all", f"SUBMISSIONS={folder}", f"OUT={out}", "SANDBOX=bubblewrap"
    )
    assert status == 0, err
    assert "100 / 100" in output


@pytest.mark.full
def test_a_package_in_a_hostile_folder_is_marked(tmp_path: Path) -> None:
    folder = tmp_path / 'it\'s; $(touch HACKED) "100 %"'
    package = solution(folder)
    status, out, err = make("grade", f"STUDENT={package}", f"OUT={tmp_path}/out put")
    assert status == 0, err
    assert "100" in out
    assert len(list((tmp_path / "out put").rglob("report.json"))) == 1
    assert not (processes.ROOT / "HACKED").exists()


def copy_checkout(folder: Path) -> Path:
    """Copy the files of this checkout that marking needs, without generated ones."""
    folder.mkdir(parents=True)
    for name in ("Makefile", "grader", "lab", "tests"):
        source = processes.ROOT / name
        if source.is_dir():
            shutil.copytree(source, folder / name, ignore=shutil.ignore_patterns("__pycache__"))
        else:
            shutil.copy(source, folder / name)
    return folder


@pytest.mark.long
def test_an_incomplete_environment_is_made_again(tmp_path: Path) -> None:
    """A set-up that was killed half-way has no stamp, so it does not count as complete."""
    checkout = copy_checkout(tmp_path / "checkout")
    half = checkout / ".venv" / "bin"
    half.mkdir(parents=True)
    (half / "python").write_text("#!/bin/sh\nexit 1\n")
    status, out, err = make("grade", f"STUDENT={solution(tmp_path)}", cwd=checkout)
    assert status == 0, err
    assert "setting up the grader's Python environment" in err
    assert "100" in out
    chosen = (checkout / ".venv" / "interpreter").read_text()
    for words in ([], [f"PYTHON={chosen}"]):
        status, out, err = make("grade", f"STUDENT={tmp_path / 'solution'}", *words, cwd=checkout)
        assert status == 0
        assert "setting up" not in err


def test_a_path_that_venv_refuses_is_reported(tmp_path: Path) -> None:
    """venv refuses a colon, because PATH separates folders with colons."""
    folder = tmp_path / "a:b"
    done = processes.run([sys.executable, bootstrap_in(folder)])
    assert done.returncode == 3
    assert done.stderr.splitlines() == [
        f"The path of this checkout contains a ':', which Python environments do not allow: {folder}",
        "Rename or move the folder.",
    ]
    assert not (folder / ".venv").exists()


def bootstrap_in(folder: Path) -> Path:
    """Copy all that the bootstrap needs to a new folder; return its path there."""
    for name in ("grader/bootstrap.py", "grader/requirements.txt", "tests/requirements.txt"):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(processes.ROOT / name, folder / name)
    return folder / "grader/bootstrap.py"


@pytest.mark.parametrize("version", ["3 9", "3 14"])
def test_a_python_that_is_too_old_or_too_new_is_named(version: str, tmp_path: Path) -> None:
    """`apt-get install python3` would not help: it is there."""
    fake = tmp_path / "bin" / "python3"
    fake.parent.mkdir()
    fake.write_text(f"#!/bin/sh\necho {version}\n")
    fake.chmod(0o755)
    command: list[str | Path] = [sys.executable, bootstrap_in(tmp_path / "checkout")]
    done = processes.run(command, env={"PATH": str(fake.parent)})
    assert done.returncode == 3
    assert f"python3 is Python {version.replace(' ', '.')}" in done.stderr.splitlines()[-3]
    assert "install python3 " not in done.stderr
    assert "python3.12" in done.stderr


def test_a_complete_checkout_may_be_read_only(tmp_path: Path) -> None:
    """A lab that an instructor has installed once for all."""
    script = bootstrap_in(tmp_path / "checkout")
    code = (
        "import runpy, sys; m = runpy.run_path(sys.argv[1]); import os; os.mkdir(m['VENV']); "
        "m['write'](m['CHOSEN'], sys.executable); lock = os.path.join(m['ROOT'], "
        "'grader/requirements.txt'); "
        "m['write'](os.path.join(m['VENV'], 'stamp'), m['stamp_of'](sys.executable, [lock]))"
    )
    assert processes.run([sys.executable, "-c", code, script]).returncode == 0
    read_only: list[str | Path] = [
        "bwrap",
        "--dev-bind",
        "/",
        "/",
        "--ro-bind",
        script.parents[1],
        script.parents[1],
    ]
    done = processes.run([*read_only, sys.executable, script])
    assert done.returncode == 0, done.stderr
    shutil.rmtree(script.parents[1] / ".venv")
    done = processes.run([*read_only, sys.executable, script])
    assert done.returncode == 3
    assert "Traceback" not in done.stderr
    assert "Ask its owner to run `make setup` there" in done.stderr


@pytest.mark.full  # it makes an environment
def test_without_a_network_the_first_run_says_only_that(tmp_path: Path) -> None:
    """pip's own last words are that no version of the first package exists."""
    nowhere = {"PIP_INDEX_URL": "http://127.0.0.1:9/simple", "PIP_RETRIES": "1",
               "PIP_CONFIG_FILE": "/dev/null", "PIP_FIND_LINKS": ""}  # fmt: skip
    done = processes.run([sys.executable, bootstrap_in(tmp_path / "checkout")], env=nowhere)
    assert done.returncode == 3
    assert "ERROR" not in done.stderr
    assert "PyPI cannot be reached: Connection refused" in done.stderr
    assert not (tmp_path / "checkout/.venv/stamp").exists()


def test_the_folder_lab_run_by_another_python_opens_the_lab(tmp_path: Path) -> None:
    python = Path(sys.base_prefix) / "bin/python3"
    done = processes.run([python, processes.ROOT / "lab", "--help"], cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    assert "--workspace" in done.stdout


@pytest.mark.long  # it makes an environment
def test_the_folder_lab_of_a_new_checkout_sets_itself_up(tmp_path: Path) -> None:
    clone = tmp_path / "checkout"
    processes.run(["git", "clone", "--quiet", processes.ROOT, clone])
    done = processes.run([Path(sys.base_prefix) / "bin/python3", clone / "lab", "--help"])
    assert done.returncode == 0, done.stderr
    assert "setting up the grader's Python environment" in done.stderr
    assert "--workspace" in done.stdout


@pytest.mark.long  # it makes an environment and a prefix
@pytest.mark.prefix
def test_a_bare_machine_can_mark_in_a_checkout_with_a_path_too_long_for_a_shebang(
    tmp_path: Path,
) -> None:
    place = tmp_path / f"some path ü {'l' * 130}"
    checkout = copy_checkout(place / "checkout")
    environment = {"GRADER_CACHE": "", "XDG_CACHE_HOME": str(place / "cache")}
    command = ["make", "--no-print-directory", "grade", "SANDBOX=bubblewrap"]
    command += [f"STUDENT={solution(place)}", f"OUT={place / 'out'}"]
    first = processes.run(command, cwd=checkout, env=environment, timeout=600)
    assert first.returncode == 0, first.stdout + first.stderr
    assert "100 / 100" in first.stdout
    assert "setting up the grader's Python environment" in first.stderr
    (prefix,) = (place / "cache" / "ros2_teaching_lab" / "prefixes").glob("jazzy-*")
    assert "is ready in" in first.stderr
    # nothing in it depends on the checkout that made it
    shutil.rmtree(checkout / ".venv")
    programs = [path for path in (prefix / "bin").iterdir() if path.is_file()]
    assert [path.name for path in programs if b".venv" in path.read_bytes()] == []
