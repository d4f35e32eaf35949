"""The Makefile: `make` prints help, and variables are data, never shell or make code."""

from __future__ import annotations

import shutil
import sys
from pathlib import Path

import pytest

from grader.package.edit.tree import Replace
from tests import processes, weather
from tests.test_cli import solution

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


def make(*words: str, cwd: Path = processes.ROOT) -> tuple[int, str, str]:
    done = processes.run(["make", "--no-print-directory", *words], cwd=cwd)
    return done.returncode, done.stdout, done.stderr


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
def test_a_hostile_name_is_passed_as_data(name: str, tmp_path: Path) -> None:
    """make, the shell and the grader all get it unchanged: the missing path is this one."""
    missing = tmp_path / name
    status, out, err = make("grade", f"STUDENT={missing}", "OUT=HACKED")
    assert status == 2
    assert str(missing).split("\n")[0] in err.replace("\\n", "\n")
    assert "Traceback" not in err
    assert out == ""
    assert not (processes.ROOT / "HACKED").exists()
    assert not (tmp_path / "HACKED").exists()


@pytest.mark.parametrize(
    "variable",
    ["ASSIGNMENT", "DISTRO", "SANDBOX", "PACKAGE", "NAME", "GRADER_COURSE", "GRADER_ASSIGNMENT"],
)
def test_every_other_variable_is_passed_as_data(variable: str, tmp_path: Path) -> None:
    hostile = f"$(shell touch {tmp_path}/HACKED);`touch {tmp_path}/HACKED`"
    target = "check" if variable == "PACKAGE" else "grade"
    status, _, _ = make(target, f"STUDENT={tmp_path}/none", f"{variable}={hostile}")
    assert status == 2
    assert not (tmp_path / "HACKED").exists()


@pytest.mark.parametrize("variable", ["KEYS", "ASSIGNMENT", "SANDBOX"])
def test_the_variables_of_make_validate_are_passed_as_data(variable: str, tmp_path: Path) -> None:
    hostile = f"$(shell touch {tmp_path}/HACKED);`touch {tmp_path}/HACKED`"
    status, _, output = make("validate", f"{variable}={hostile}")
    assert status == 2
    assert "Traceback" not in output
    assert not (tmp_path / "HACKED").exists()


def test_another_courses_lesson_can_be_used_through_make(tmp_path: Path) -> None:
    course = weather.write_course(tmp_path, "winds")
    package = weather.write_package(tmp_path, Replace(weather.SETUP, weather.ENTRY, ""))
    words = ("fix", f"PACKAGE={package}", f"GRADER_COURSE={course}")
    status, _, output = make(*words)
    assert status == 2
    assert "readings, winds" in output
    _, shown, _ = make(*words, "ASSIGNMENT=winds")
    assert weather.ENTRY in shown


def test_a_package_can_be_fixed_through_make(tmp_path: Path) -> None:
    package = solution(tmp_path)
    (package / "setup.cfg").unlink()
    status, shown, _ = make("fix", f"PACKAGE={package}")
    assert "+++ b/setup.cfg" in shown
    assert not (package / "setup.cfg").exists()
    status, _, output = make("fix", f"PACKAGE={package}", "APPLY=1")
    assert status == 0, output
    assert (package / "setup.cfg").exists()


@pytest.mark.parametrize(
    "variable",
    [
        *("SUBMISSIONS", "ROSTER", "WORKERS", "WORKSHEET", "SCHEDULER", "CANVAS", "CANVAS_COLUMN"),
        *("GRADE_COLUMN", "FEEDBACK_COLUMN", "ACCEPT"),
    ],
)
def test_the_variables_of_a_class_are_passed_as_data(variable: str, tmp_path: Path) -> None:
    hostile = f"$(shell touch {tmp_path}/HACKED);`touch {tmp_path}/HACKED`"
    words = {"SUBMISSIONS": f"{tmp_path}/none", "OUT": f"{tmp_path}/out", variable: hostile}
    status, _, output = make("grade-all", *(f"{name}={value}" for name, value in words.items()))
    assert status == 2
    assert "Traceback" not in output
    assert not (tmp_path / "HACKED").exists()


@pytest.mark.parametrize("words", [("LC_ALL=", "LANG=ko_KR.UTF-8"), ("GRADER_LANG=ko",)])
def test_the_language_is_a_variable(words: tuple[str, ...], tmp_path: Path) -> None:
    status, _, output = make("grade", f"STUDENT={tmp_path / 'missing'}", *words)
    assert status == 2
    assert "폴더가 없습니다" in output


def test_the_column_and_accept_variables_reach_the_command(tmp_path: Path) -> None:
    (tmp_path / "sheet.csv").write_text("Identifier,Punkte,Text\nParticipant 1,,\n")
    words = [f"SUBMISSIONS={tmp_path}", f"OUT={tmp_path / 'out'}"]
    sheet = [*words, f"WORKSHEET={tmp_path / 'sheet.csv'}"]
    assert "make: GRADE_COLUMN='its name'" in make("grade-all", *sheet)[2]
    assert "no column 'Nope'" in make("grade-all", *sheet, "GRADE_COLUMN=Nope")[2]
    both = [*sheet, "GRADE_COLUMN=Punkte", "FEEDBACK_COLUMN=None such"]
    assert "no column 'None such'" in make("grade-all", *both)[2]
    (tmp_path / "canvas.csv").write_text("Student,ID,Section,A (1),A (2)\nAnn,1,A,,\n")
    canvas = [*words, f"CANVAS={tmp_path / 'canvas.csv'}"]
    assert "column named 'A'" in make("grade-all", *canvas, "CANVAS_COLUMN=A")[2]
    assert "Did you mean 'lower'?" in make("grade-all", *words, "ACCEPT=join,lowr")[2]


def test_grade_all_without_a_class_says_how() -> None:
    status, _, output = make("grade-all")
    assert status == 2
    assert "make grade-all SUBMISSIONS=path/to/downloads" in output


@pytest.mark.prefix
def test_a_class_can_be_marked_through_make(tmp_path: Path) -> None:
    solution(tmp_path / "the class")
    folder, out = tmp_path / "the class", tmp_path / "out put"
    status, output, err = make(
        "grade-all", f"SUBMISSIONS={folder}", f"OUT={out}", "SANDBOX=bubblewrap"
    )
    assert status == 0, err
    assert "100 / 100" in output
    status, output, err = make(
        *("grade-all", f"SUBMISSIONS={folder}", f"OUT={out}", "SANDBOX=bubblewrap", "REGRADE=1")
    )
    assert status == 0, err
    assert "Marked again: 1, 1 of them with the same result." in output


def test_an_environment_variable_works(tmp_path: Path) -> None:
    done = processes.run(["make", "grade"], env={"STUDENT": f"{tmp_path}/$(touch HACKED)"})
    assert done.returncode == 2
    assert "$(touch HACKED)" in done.stderr


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


@pytest.mark.full
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


@pytest.mark.full  # it makes an environment and a prefix
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
