"""The instructor's own lists, kept in the output folder: a run without the option uses them again.

Without that, a run that forgets an option would take back what the list gave.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from grader.base.errors import UsageError
from grader.base.folder import Folder
from grader.base.shown import shown
from grader.batch.instructor_csv import LARGEST
from grader.package.intake.reading import Unread, read_bytes
from grader.report.files import could_not_write

FOLDER = "given"
JOIN, EXTENSIONS, TIMES = "join", "extensions", "times"
KINDS = (JOIN, EXTENSIONS, TIMES)


@dataclass(frozen=True)
class GivenFile:
    """A list that was given: in this run, or in an earlier one (`is_remembered`)."""

    path: Path
    is_remembered: bool = False


@dataclass(frozen=True)
class GivenFiles:
    """The instructor's lists by option: join, extensions, times."""

    by_option: Mapping[str, GivenFile]

    def get(self, option: str) -> GivenFile | None:
        """Return the list of an option, None if there is none."""
        return self.by_option.get(option)

    def keep(self, out: Path) -> None:
        """Keep copies of the lists of this run; raise SurroundingsError if that fails."""
        for option, file in self.by_option.items():
            if file.is_remembered:
                continue
            content = read_bytes(file.path.resolve(), LARGEST)
            if isinstance(content, Unread):
                raise UsageError(f"{shown(str(file.path))} cannot be read: {content.reason}")
            write_private(out, FOLDER, _name(option), content)


def given_files(paths: Mapping[str, Path | None], out: Path) -> GivenFiles:
    """Return the lists that are given by option, and those of earlier runs for the other options."""
    found: dict[str, GivenFile] = {}
    for option in KINDS:
        path, kept = paths.get(option), out / FOLDER / _name(option)
        if path is not None:
            found[option] = GivenFile(path)
        elif kept.is_file():
            found[option] = GivenFile(kept, is_remembered=True)
    return GivenFiles(found)


def say_remembered(files: GivenFiles, notify: Callable[[str], None]) -> None:
    """Say which lists of earlier runs are used."""
    for option, file in files.by_option.items():
        if file.is_remembered:
            place = shown(str(file.path))
            notify(f"  --{option} as given earlier: {place} (give another one to replace it)")


def write_private(out: Path, folder: str, name: str, content: bytes) -> None:
    """Write a file below `out`, readable by its owner only; raise SurroundingsError if that fails."""
    try:
        out.mkdir(mode=0o700, parents=True, exist_ok=True)
        with Folder.open(out) as outer:
            if folder:
                with outer.private(folder) as inner:
                    inner.replace(name, content)
            else:
                outer.replace(name, content)
    except OSError as error:
        raise could_not_write(error, out, what=folder or name) from error


def _name(option: str) -> str:
    return f"{option}.csv"
