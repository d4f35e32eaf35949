"""The editor's files: only those of the workspace, and nothing that anybody wrote is lost."""

from __future__ import annotations

import os
import threading
from pathlib import Path

import pytest

from grader.base.errors import UsageError
from lab.window import files as files_module
from lab.window.files import Files


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    folder = tmp_path / "ws"
    (folder / "src" / "pkg").mkdir(parents=True)
    (folder / "src" / "pkg" / "node.py").write_text("one\n")
    (tmp_path / "secret").write_text("outside\n")
    return folder


def test_a_file_is_replaced_as_a_whole_and_keeps_its_mode(workspace: Path) -> None:
    file = workspace / "src/pkg/node.py"
    file.chmod(0o755)
    files = Files(workspace)
    found = files.read("src/pkg/node.py")
    saved = files.write("src/pkg/node.py", "two\n", found.version)
    assert saved.conflict is None
    assert file.read_text() == "two\n"
    assert file.stat().st_mode & 0o777 == 0o755
    assert files.read("src/pkg/node.py").version == saved.version
    assert [path.name for path in file.parent.iterdir()] == ["node.py"]


def test_a_new_file_comes_with_its_folders_and_replaces_none(workspace: Path) -> None:
    files = Files(workspace)
    assert files.write("src/pkg/msg/Pose.msg", "float64 x\n", "").conflict is None
    assert (workspace / "src/pkg/msg/Pose.msg").read_text() == "float64 x\n"
    saved = files.write("src/pkg/node.py", "mine\n", "")
    assert saved.conflict is not None
    assert saved.conflict.text == "one\n"
    assert (workspace / "src/pkg/node.py").read_text() == "one\n"


def test_what_another_program_saved_is_not_overwritten(workspace: Path) -> None:
    files = Files(workspace)
    version = files.read("src/pkg/node.py").version
    (workspace / "src/pkg/node.py").write_text("theirs\n")
    saved = files.write("src/pkg/node.py", "mine\n", version)
    assert saved.conflict is not None
    assert saved.conflict.text == "theirs\n"
    assert (workspace / "src/pkg/node.py").read_text() == "theirs\n"


def test_what_another_program_saves_in_the_same_moment_is_kept(
    workspace: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    files, file = Files(workspace), workspace / "src/pkg/node.py"
    version = files.read("src/pkg/node.py").version
    exchanged = files_module._exchanged

    def late(*words: object) -> bytes | None:
        file.write_text("theirs\n")  # after the editor has looked
        return exchanged(*words)  # type: ignore[arg-type]

    monkeypatch.setattr(files_module, "_exchanged", late)
    saved = files.write("src/pkg/node.py", "mine\n", version)
    assert file.read_text() == "mine\n"
    assert (workspace / saved.backup).read_text() == "theirs\n"


def test_two_writers_lose_nothing(workspace: Path) -> None:
    """One saves as vim does, by a rename; the other is the editor. Every text is somewhere."""
    files, file = Files(workspace), workspace / "src/pkg/node.py"
    told: set[str] = set()

    def outside() -> None:
        for n in range(60):
            new = workspace / "src/pkg/.new"
            new.write_text(f"outside {n}\n")
            new.replace(file)

    writer = threading.Thread(target=outside)
    writer.start()
    while writer.is_alive():
        try:
            version = files.read("src/pkg/node.py").version
            before = file.read_text()
            saved = files.write("src/pkg/node.py", "mine\n", version)
        except UsageError:
            continue
        if saved.backup:
            told.add((workspace / saved.backup).read_text())
        elif saved.conflict is not None:
            assert saved.conflict.text != before or saved.conflict.text
    writer.join()
    assert told <= {"one\n", "mine\n", *(f"outside {n}\n" for n in range(60))}


@pytest.mark.parametrize(
    "path",
    [
        "../secret",
        "/etc/passwd",
        "src/../../secret",
        "src//node.py",
        "./src/pkg/node.py",
        "",
        "src/pkg/",
        ".lab/progress.json",
        "src/pkg/node.py\0",
    ],
)
def test_a_path_out_of_the_workspace_is_refused(workspace: Path, path: str) -> None:
    (workspace / ".lab").mkdir()
    (workspace / ".lab" / "progress.json").write_text("{}")
    files = Files(workspace)
    for act in (
        files.read,
        lambda p: files.write(p, "x", ""),
        lambda p: files.keep_draft(p, "x", ""),
    ):
        with pytest.raises(UsageError):
            act(path)
    assert (workspace.parent / "secret").read_text() == "outside\n"


def test_no_link_is_followed(workspace: Path) -> None:
    (workspace / "src/pkg/link.py").symlink_to(workspace.parent / "secret")
    (workspace / "src/out").symlink_to(workspace.parent)
    (workspace / "src/pkg/pipe").parent.joinpath("own.py").symlink_to("node.py")
    os.mkfifo(workspace / "src/pkg/pipe")
    files = Files(workspace)
    assert files.names() == ["src/pkg/node.py"]
    for path in ("src/pkg/link.py", "src/out/secret", "src/pkg/pipe", "src/pkg/own.py", "src/pkg"):
        with pytest.raises(UsageError):
            files.read(path)
        with pytest.raises(UsageError):
            files.write(path, "x\n", "")
    assert (workspace.parent / "secret").read_text() == "outside\n"
    assert (workspace / "src/pkg/link.py").is_symlink()


def test_a_link_in_the_place_of_the_lab_s_own_folder_leads_nowhere(workspace: Path) -> None:
    (workspace / ".lab").symlink_to(workspace.parent)
    files = Files(workspace)
    with pytest.raises(UsageError):
        files.keep_draft("src/pkg/node.py", "x", "")
    with pytest.raises(OSError):
        files.keep("src/pkg/node.py", b"x")
    assert sorted(path.name for path in workspace.parent.iterdir()) == ["secret", "ws"]


def test_what_is_no_text_is_not_opened(workspace: Path) -> None:
    (workspace / "src/picture.png").write_bytes(b"\x89PNG\0\xff")
    (workspace / "src/big.txt").write_bytes(b"a" * 1_000_001)
    for path, said in (("src/picture.png", "UTF-8"), ("src/big.txt", "1000000 bytes")):
        with pytest.raises(UsageError, match=said):
            Files(workspace).read(path)


def test_a_draft_is_kept_until_it_is_saved(workspace: Path) -> None:
    files = Files(workspace)
    assert files.draft("src/pkg/node.py") is None
    files.keep_draft("src/pkg/node.py", "half", "abc")
    assert Files(workspace).draft("src/pkg/node.py") == ("half", "abc")
    files.keep_draft("src/pkg/node.py", None, "")
    assert files.draft("src/pkg/node.py") is None


def test_the_list_has_no_build_and_nothing_of_the_lab(workspace: Path) -> None:
    for folder in ("build", "install", "log", ".lab", "src/pkg/__pycache__"):
        (workspace / folder).mkdir()
        (workspace / folder / "file").write_text("")
    (workspace / "src/pkg/log").mkdir()
    (workspace / "src/pkg/log/mine.py").write_text("")
    assert Files(workspace).names() == ["src/pkg/log/mine.py", "src/pkg/node.py"]
