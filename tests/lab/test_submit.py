"""What `lab submit` leaves out of the archive, and names; what `--with` takes along."""

from __future__ import annotations

import os
import shutil
import zipfile
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from lab.commands.submit import submit
from tests import processes

PACKAGE = "my_robot_controller"
SOLUTION = processes.ROOT / "grader/keys/hello_time/solution"
# (in two parts, so that no other program takes this file for a key)
KEY = "-----BEGIN OPENSSH " + "PRIVATE KEY-----\nb3BlbnNzaC1rZXktdjEAAAAA\n"
PRIVATE = {
    ".env": "PASSWORD=hunter2\n",
    "config/.env.production": "PASSWORD=hunter2\n",
    ".ssh/id_ed25519": KEY,
    ".ssh/known_hosts": "example.org ssh-ed25519 AAAA\n",
    "keys/robot.pem": "-----BEGIN CERTIFICATE-----\nAA\n-----END CERTIFICATE-----\n" + KEY,
    "keys/sros.key": "anything\n",
    ".bash_history": "mysql -phunter2\n",
}
HARMLESS = {
    ".env.example": "PASSWORD=\n",
    "keys/robot.pub": "ssh-ed25519 AAAA\n",
    "keys/ca.pem": "-----BEGIN CERTIFICATE-----\nAA\n",
    "config/environment.yaml": "a: 1\n",
    ".pylintrc": "[MAIN]\n",
}


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The package of a workspace in a home folder."""
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("GRADER_ASSIGNMENT", "hello_time")
    monkeypatch.setenv("LANG", "C.UTF-8")
    monkeypatch.delenv("LAB_WORKSPACE", raising=False)
    shutil.copytree(SOLUTION, tmp_path / "ros2_ws/src")
    return tmp_path / "ros2_ws/src" / PACKAGE


def run(*words: str) -> Result:
    return CliRunner().invoke(submit, list(words))


def said(*words: str) -> str:
    """Return the output of a `lab submit` that works."""
    done = run(*words)
    assert done.exception is None, (done.exception, done.output)
    return done.output


def refused(*words: str) -> str:
    """Return the message of a `lab submit` that ends in a clear error."""
    done = run(*words)
    assert type(done.exception).__name__ == "UsageError", done.exception
    return f"{done.exception}\n{getattr(done.exception, 'remedy', '')}"


def packed(package: Path) -> set[str]:
    """Return the files in the archive, relative to the package."""
    with zipfile.ZipFile(package.parents[1] / "submit/hello_time.zip") as archive:
        names = archive.namelist()
    assert all(name.startswith(f"{PACKAGE}/") for name in names)
    return {name.removeprefix(f"{PACKAGE}/") for name in names if not name.endswith("/")}


def put(package: Path, files: dict[str, str]) -> None:
    for name, text in files.items():
        (package / name).parent.mkdir(exist_ok=True)
        (package / name).write_text(text)


def test_private_files_are_left_out_and_named(package: Path) -> None:
    assert "Left out" not in said()
    before = packed(package)
    put(package, {**PRIVATE, **HARMLESS})
    output = said()
    assert packed(package) == before | set(HARMLESS)
    lines = [line for line in output.splitlines() if line.startswith("Left out: ")]
    assert sorted(line.split()[2] for line in lines) == sorted(f"{PACKAGE}/{n}" for n in PRIVATE)
    assert "lab submit --with" in output


@pytest.mark.parametrize("given", [".env", f"{PACKAGE}/.env", "{package}/.env", "{cwd}"])
def test_with_takes_one_file_along(
    given: str, package: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    put(package, PRIVATE)
    if given == "{cwd}":
        monkeypatch.chdir(package / "config")
        given = "../.env"
    output = said("--with", given.format(package=package))
    assert packed(package) & set(PRIVATE) == {".env"}
    assert f"Left out: {PACKAGE}/.env (" not in output
    assert f"Left out: {PACKAGE}/.bash_history (" in output
    both = (".ssh/known_hosts", "keys/sros.key")
    said("--with", both[0], "--with", both[1])
    assert packed(package) & set(PRIVATE) == set(both)


def test_a_hard_link_to_a_file_outside_is_left_out(package: Path, tmp_path: Path) -> None:
    (tmp_path / "notes").write_text("private")
    os.link(tmp_path / "notes", package / "notes.txt")
    (package / "map.txt").write_text("mine")
    os.link(package / "map.txt", package / "map_2.txt")  # both names are in the package
    output = said()
    assert packed(package) & {"notes.txt", "map.txt", "map_2.txt"} == {"map.txt", "map_2.txt"}
    assert f"Left out: {PACKAGE}/notes.txt (a hard link" in output
    said("--with", "notes.txt")
    assert "notes.txt" in packed(package)


def test_a_needed_file_is_not_left_out_without_a_word(package: Path, tmp_path: Path) -> None:
    os.link(package / "setup.py", tmp_path / "other")
    assert "lab submit --with my_robot_controller/setup.py" in refused()
    assert not (package.parents[1] / "submit").exists()
    said("--with", "setup.py")
    assert "setup.py" in packed(package)


@pytest.mark.parametrize("target", ["{home}/secret", "../../secret", "../../../secret", "{home}"])
def test_a_link_out_of_the_package_is_never_packed(
    target: str, package: Path, tmp_path: Path
) -> None:
    for place in (tmp_path, package.parents[1]):  # intake can read the one in the workspace
        (place / "secret").write_text("private")
    (package / "link.txt").symlink_to(target.format(home=tmp_path))
    output = said()
    assert f"Left out: {PACKAGE}/link.txt (a link that leads out of the package)" in output
    assert "--with" not in output
    assert "link.txt" not in packed(package)
    assert "Replace the link by a copy" in refused("--with", "link.txt")


def test_a_link_inside_goes_where_its_file_goes(package: Path) -> None:
    put(package, {".env": "PASSWORD=hunter2\n", "map.txt": "mine"})
    (package / "to_env").symlink_to(".env")
    (package / "to_map").symlink_to("map.txt")
    output = said()
    assert packed(package) & {"to_env", "to_map"} == {"to_map"}
    assert f"Left out: {PACKAGE}/to_env (a link to a file that is left out)" in output
    said("--with", ".env")
    assert {".env", "to_env", "to_map"} <= packed(package)


def test_what_is_too_large_is_named(package: Path) -> None:
    with (package / "recording.db3").open("wb") as file:
        file.truncate(6_000_000)
    assert "recording.db3 (it is larger than 5 MB)" in said()
    assert "recording.db3" not in packed(package)
    assert "larger than 5 MB" in refused("--with", "recording.db3")


@pytest.mark.parametrize("name", ["nothing.txt", "/etc/hostname", "../../../x", "."])
def test_with_takes_only_files_of_the_package(name: str, package: Path) -> None:
    put(package, {".env": "PASSWORD=hunter2\n"})
    message = refused("--with", name)
    assert "your package has no file" in message
    assert f"{PACKAGE}/.env" in message


def test_a_submit_that_is_no_folder_is_a_clear_error(package: Path, tmp_path: Path) -> None:
    workspace = package.parents[1]
    (tmp_path / "elsewhere").mkdir()
    (workspace / "submit").symlink_to(tmp_path / "elsewhere")
    assert "~/ros2_ws/submit is a link" in refused()
    assert "mv ~/ros2_ws/submit ~/ros2_ws/submit.old" in refused()
    assert list((tmp_path / "elsewhere").iterdir()) == []
    (workspace / "submit").unlink()
    (workspace / "submit").write_text("mine")
    assert "~/ros2_ws/submit is not a folder" in refused()
    (workspace / "submit").unlink()
    (workspace / "submit/hello_time.zip").mkdir(parents=True)
    assert "hello_time.zip is a folder" in refused()


def test_an_archive_that_is_a_link_is_replaced_and_not_followed(
    package: Path, tmp_path: Path
) -> None:
    (tmp_path / "other").write_text("mine")
    (package.parents[1] / "submit").mkdir()
    (package.parents[1] / "submit/hello_time.zip").symlink_to(tmp_path / "other")
    said()
    assert (tmp_path / "other").read_text() == "mine"
    assert "package.xml" in packed(package)
