"""Folders and files written under the eyes of the user, as `ros2 pkg create` does."""

from pathlib import Path


def create_folder(path: str) -> str:
    """Create a folder and its parents, say so, and return its path as it was given.

    Raises OSError when it cannot be created.
    """
    print("creating folder", path)
    Path(path).mkdir(parents=True, exist_ok=True)
    return path


def write_file(path: str, text: str) -> None:
    """Write a new text file and say so.

    Raises OSError when it cannot be written.
    """
    print("creating", path)
    Path(path).write_text(text, encoding="utf-8")
