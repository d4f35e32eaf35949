"""A package's files as they are, and as they would be after a fix."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from grader.package.intake.links import follow
from grader.package.intake.model import SourceFile, Submission

PLAIN, EXECUTABLE = 0o644, 0o755


@dataclass(frozen=True)
class Files:
    """Files by their path in the package; `moved` maps a new path to the old one."""

    by_path: Mapping[str, SourceFile]
    moved: Mapping[str, str] = field(default_factory=dict)

    @classmethod
    def of(cls, submission: Submission) -> Files:
        """Return the files of a submission."""
        return cls({file.path: file for file in submission.files})

    def put_into(self, submission: Submission) -> Submission:
        """Return the submission with these files instead of its own."""
        return replace(submission, files=tuple(file for _, file in sorted(self.by_path.items())))

    def file(self, path: str) -> SourceFile | None:
        """Return a regular file that can be read; None for anything else, including links."""
        found = self.by_path.get(path)
        plain = found is not None and found.kind == "file" and not found.unreadable
        return found if plain and not self.through_link(path) else None

    def data(self, path: str) -> bytes | None:
        """Return the bytes of a regular file, or None."""
        found = self.file(path)
        return found.data if found is not None else None

    def through_link(self, path: str) -> bool:
        """Whether a path goes through a link: such a file is never fixed."""
        links = {name: f.target for name, f in self.by_path.items() if f.kind == "link"}
        return follow(path, links).place != path

    def with_data(self, path: str, data: bytes) -> Files:
        """Return the files with new bytes in one of them, which is created if it is missing."""
        old = self.by_path.get(path)
        new = replace(old, data=data) if old else SourceFile(path, "file", PLAIN, data)
        return replace(self, by_path={**self.by_path, **self._folders(path), path: new})

    def with_mode(self, path: str, mode: int) -> Files:
        """Return the files with another mode of one of them. KeyError if it is not there."""
        new = replace(self.by_path[path], mode=mode)
        return replace(self, by_path={**self.by_path, path: new})

    def with_move(self, path: str, to: str) -> Files:
        """Return the files with one of them at another path. KeyError if it is not there."""
        rest = {name: file for name, file in self.by_path.items() if name != path}
        moved = {new: old for new, old in self.moved.items() if new != path}
        first = self.moved.get(path, path)
        if first != to:
            moved[to] = first
        new = replace(self.by_path[path], path=to)
        return Files({**rest, **self._folders(to), to: new}, moved)

    def moved_since(self, first: Files) -> Files:
        """Return these files, which are a change of `first`, with the moves of both."""
        since = {path: self.moved.get(path, path) for path in self.by_path}
        places = {path: first.moved.get(place, place) for path, place in since.items()}
        return replace(self, moved={path: old for path, old in places.items() if path != old})

    def names_in(self, folder: str) -> list[str]:
        """Return the names of the files directly in a folder ("" is the package's own)."""
        start = f"{folder}/" if folder else ""
        inside = [
            path[len(start) :]
            for path, f in self.by_path.items()
            if f.kind != "folder" and path.startswith(start)
        ]
        return sorted(name for name in inside if "/" not in name)

    def below(self, folder: str) -> list[str]:
        """Return the paths of all files below a folder."""
        found = [p for p, f in self.by_path.items() if f.kind != "folder"]
        return sorted(path for path in found if path.startswith(f"{folder}/"))

    def _folders(self, path: str) -> dict[str, SourceFile]:
        parts = path.split("/")[:-1]
        above = ["/".join(parts[: n + 1]) for n in range(len(parts))]
        return {p: SourceFile(p, "folder", EXECUTABLE) for p in above if p not in self.by_path}
