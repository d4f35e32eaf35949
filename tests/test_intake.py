"""Intake of real folders: left out files, limits and notes."""

from __future__ import annotations

import os
import socket
import time
from pathlib import Path

import pytest

from .small_package import NODE, NODE_PATH, PACKAGE, make, notes, paths, take, write


def test_links_to_the_outside_are_left_out_and_inner_ones_kept(tmp_path: Path) -> None:
    secret = tmp_path / "secret.txt"
    secret.write_text("the key")
    root = make(tmp_path / "given" / "pkg")
    (tmp_path / "given/shared.py").write_text("shared = 1\n")
    links = {
        "absolute": str(secret),
        "above": "../../secret.txt",
        "proc": "/proc/self/environ",
        "sneaky": "inner/../../../secret.txt",
        "folder_out": "../..",
        "inner": "resource",
        "dangling": "nothing/there",
        "loop_a": "loop_b",
        "loop_b": "loop_a",
        "self": "self",
        "dot": ".",
        f"{PACKAGE}/up.py": "../setup.py",
        "shared.py": "../shared.py",
    }
    for name, target in links.items():
        (root / name).symlink_to(target)
    found = take(tmp_path / "given")
    kept = {file.path: file.target for file in found.files if file.kind == "link"}
    out = {"absolute", "above", "proc", "sneaky", "folder_out", "shared.py"}
    assert kept == {name: target for name, target in links.items() if name not in out}
    assert out & paths(found) == {"shared.py"}
    shared = found.file("shared.py")
    assert shared is not None
    assert (shared.kind, shared.data) == ("file", b"shared = 1\n")
    assert "proc -> /proc/self/environ" in notes(found) or "more" in notes(found)
    assert not any(b"the key" in file.data for file in found.files)
    through = found.file(f"inner/{PACKAGE}")
    assert through is not None
    assert through.path == f"resource/{PACKAGE}"
    up = found.file(f"{PACKAGE}/up.py")
    assert up is not None
    assert up.path == "setup.py"
    for name in ("loop_a", "self", "dangling", "../secret.txt", "inner/../../x", "/etc/passwd"):
        assert found.file(name) is None


def test_special_files_are_never_opened(tmp_path: Path) -> None:
    root = make(tmp_path / "p")
    os.mkfifo(root / "fifo")
    os.mkfifo(root / PACKAGE / "node.py")
    with socket.socket(socket.AF_UNIX) as server:
        server.bind(str(root / "socket"))
    begin = time.monotonic()
    found = take(root)
    assert time.monotonic() - begin < 2
    assert not {"fifo", "socket", f"{PACKAGE}/node.py"} & paths(found)
    assert "neither a file nor a folder" in notes(found)


def test_a_fifo_in_place_of_the_manifest_does_not_block(tmp_path: Path) -> None:
    root = make(tmp_path / "p")
    (root / "package.xml").unlink()
    os.mkfifo(root / "package.xml")
    found = take(root)
    assert found.candidates[0].name == PACKAGE
    assert found.file("package.xml") is None


def test_files_made_by_colcon_and_other_tools_are_left_out(tmp_path: Path) -> None:
    ws = tmp_path / "ws"
    root = make(ws / "src" / PACKAGE)
    for base in (ws, root):
        write(base, ["build/COLCON_IGNORE", f"build/{PACKAGE}/setup.py"])
        write(base, ["install/.colcon_install_layout", f"install/{PACKAGE}/package.xml"])
        write(base, ["log/latest/events.log"])
    write(root, [f"{PACKAGE}/__pycache__/a.pyc", "my.egg-info/PKG-INFO", ".vscode/settings.json"])
    write(root, [".DS_Store", ".venv/bin/python", "venv/pyvenv.cfg", "node_modules/a/package.xml"])
    found = take(ws)
    assert found.root == f"src/{PACKAGE}"
    assert paths(found) == paths(take(make(tmp_path / "clean")))
    assert f"src/{PACKAGE}/log/" in notes(found) or "more" in notes(found)
    assert found.sha256 == take(tmp_path / "clean").sha256


def test_a_students_own_module_called_log_or_build_is_not_lost(tmp_path: Path) -> None:
    root = make(tmp_path / "p")
    mine = [f"{PACKAGE}/log/__init__.py", f"{PACKAGE}/build/walls.py", "log/__init__.py"]
    write(root, [*mine, f"{PACKAGE}/env/world.py"])
    found = take(root)
    assert {*mine, f"{PACKAGE}/env/world.py"} <= paths(found)
    assert not found.notes


def test_hostile_names_are_left_out_and_shown_escaped(tmp_path: Path) -> None:
    root = make(tmp_path / "p")
    for name in (b"\xff\xfe.py", b"a\nb.py", b"\x1b[2J.py", "a\u2028b".encode(), b"x\x7fy"):
        (Path(os.fsdecode(os.fsencode(root) + b"/" + name))).write_text("x")
    write(root, ["-rf", "$(touch x)", "a b;c", "名前.py", "émile.py", "back\\slash"])
    found = take(root)
    assert {"-rf", "$(touch x)", "a b;c", "名前.py", "émile.py", "back\\slash"} <= paths(found)
    assert len(paths(found)) == 6 + len(paths(take(make(tmp_path / "clean"))))
    text = notes(found)
    assert "not plain UTF-8" in text
    assert all(line.isprintable() for line in found.notes)
    text.encode()


def test_a_package_in_a_folder_with_a_hostile_name_is_not_used(tmp_path: Path) -> None:
    make(Path(os.fsdecode(os.fsencode(tmp_path) + b"/given/p\xff")))
    assert take(tmp_path / "given").problem_mistake == "package.empty"
    inside = take(Path(os.fsdecode(os.fsencode(tmp_path) + b"/given/p\xff")))
    assert inside.root == "."
    inside.name.encode()


def test_a_tree_that_is_too_deep_is_cut(tmp_path: Path) -> None:
    root = make(tmp_path / "p")
    deep = root
    for _ in range(60):
        deep /= "d"
        deep.mkdir()
    (deep / "bottom").touch()
    found = take(root)
    assert found.root == "."
    assert not any(path.endswith("bottom") for path in paths(found))
    assert "folders deep" in notes(found)


@pytest.mark.full
def test_ten_thousand_files_are_too_many_only_inside_the_package(
    tmp_path: Path,
) -> None:
    root = make(tmp_path / "given/src" / PACKAGE)
    for n in range(100):
        folder = tmp_path / "given/photos" / str(n)
        folder.mkdir(parents=True)
        for k in range(100):
            (folder / str(k)).touch()
    begin = time.process_time()
    assert take(tmp_path / "given").root == f"src/{PACKAGE}"
    (tmp_path / "given/photos").rename(root / "photos")
    found = take(tmp_path / "given")
    assert found.root is None
    assert found.problem_mistake == "package.too_large"
    assert "5,000" in found.problem
    assert time.process_time() - begin < 5


def test_a_folder_with_too_many_names_is_cut(tmp_path: Path) -> None:
    make(tmp_path / "given/z")
    (tmp_path / "given/data").mkdir()
    for n in range(6_000):
        (tmp_path / f"given/data/{n}").touch()
    found = take(tmp_path / "given")
    assert found.root == "z"
    assert "first 5000 names" in notes(found)


def test_a_large_file_has_a_reason_instead_of_data(tmp_path: Path) -> None:
    root = make(tmp_path / "p")
    with (root / "bag.db3").open("wb") as file:
        file.truncate(3_000_000_000)
    found = take(root)
    bag = found.file("bag.db3")
    assert bag is not None
    assert bag.unreadable
    assert not bag.data
    assert "larger than 5 MB" in bag.reason
    assert "bag.db3" in notes(found)


def test_a_package_with_too_many_bytes_is_too_large(tmp_path: Path) -> None:
    root = make(tmp_path / "p")
    (root / "0").write_bytes(b"x" * 4_900_000)
    for n in range(1, 12):
        os.link(root / "0", root / str(n))
    assert take(root).problem_mistake == "package.too_large"


def test_links_to_one_large_file_do_not_multiply_it(tmp_path: Path) -> None:
    root = make(tmp_path / "given/p")
    (tmp_path / "given/large").write_bytes(b"x" * 4_900_000)
    for n in range(300):
        (root / f"link{n}").symlink_to("../large")
    assert take(tmp_path / "given").problem_mistake == "package.too_large"
    (tmp_path / "given/large").write_bytes(b"x")
    assert "more than 200 links" in notes(take(tmp_path / "given"))


def test_links_that_multiply_take_bounded_time(tmp_path: Path) -> None:
    root = make(tmp_path / "p")
    (root / "l0").symlink_to("resource")
    for n in range(1, 150):
        (root / f"l{n}").symlink_to("/".join([f"l{n - 1}", ".."] * 80))
    begin = time.process_time()
    assert take(root).root == "."
    assert time.process_time() - begin < 5


def test_an_unreadable_file_is_kept_with_the_reason(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    root = make(tmp_path / "p")
    really = os.open

    def refuse(
        path: str | Path, flags: int, mode: int = 0o777, *, dir_fd: int | None = None
    ) -> int:
        if str(path).endswith(NODE):
            raise PermissionError(13, "Permission denied")
        return really(path, flags, mode, dir_fd=dir_fd)

    monkeypatch.setattr(os, "open", refuse)
    node = take(root).file(NODE_PATH)
    assert node is not None
    assert node.unreadable
    assert node.reason == "Permission denied"
    assert f"without its content (Permission denied): {NODE_PATH}" in notes(take(root))


def test_an_unreadable_folder_is_noted(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    root = make(tmp_path / "p")
    really = os.scandir

    def refuse(path: str | Path) -> object:
        if str(path).endswith("resource"):
            raise PermissionError(13, "Permission denied")
        return really(path)

    monkeypatch.setattr(os, "scandir", refuse)
    found = take(root)
    assert found.root == "."
    assert "a folder that cannot be read (Permission denied): resource" in notes(found)
