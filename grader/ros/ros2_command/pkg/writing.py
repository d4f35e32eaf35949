"""Create folders and files and print their names, as `ros2 pkg create` does."""

from pathlib import Path


def create_folder(path: str) -> str:
    """Create a folder and its parents, print its path, and return the path as given.

    Raises OSError if it cannot be created.
    """
    print("creating folder", path)
    Path(path).mkdir(parents=True, exist_ok=True)
    return path


def write_file(path: str, text: str) -> None:
    """Write a text file and print its path.

    Raises OSError if it cannot be written.
    """
    print("creating", path)
    Path(path).write_text(text, encoding="utf-8")
