"""What of a package goes into the archive to hand in: not what may be private or is from elsewhere."""

from __future__ import annotations

import os
import re
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from grader.base.errors import UsageError
from grader.base.i18n.message import joined, say
from grader.base.shown import shown
from grader.package.intake.links import follow
from grader.package.submission import SourceFile, Submission

FOLDERS = re.compile(r"\.(ssh|gnupg|aws|azure|kube|docker|password-store)")
FILES = re.compile(
    r"\.env(\.(?!example$|sample$|template$|dist$).*)?|\.envrc"
    r"|\.(netrc|pgpass|pypirc|npmrc|git-credentials|htpasswd|dockercfg|\w+_history)"
    r"|id_(rsa|dsa|ecdsa|ed25519)(_sk)?|.+\.(key|p12|pfx|jks|keystore|kdbx|ppk)",
    re.IGNORECASE,
)
PRIVATE_KEY = re.compile(rb"^-----BEGIN [A-Z ]{0,20}PRIVATE KEY( BLOCK)?-----", re.MULTILINE)
MOST_NAMED = 20

SECRET = say("it may contain passwords or keys")
KEY = say("it contains a private key")
HARD_LINK = say("a hard link: the same file has another name outside of the package")
LEADS_OUT = say("a link that leads out of the package")
TO_LEFT_OUT = say("a link to a file that is left out")
COPY_IT = say("Replace the link by a copy of the file, if it belongs to your package.")


@dataclass(frozen=True)
class Member:
    """A file of a package: its path in the archive, and where it is on this machine.

    `reason` says why it is left out, "" if it is not; `never`: `--with` cannot take it along.
    """

    name: str
    place: Path
    file: SourceFile
    reason: str = ""
    never: bool = False


@dataclass(frozen=True)
class Packing:
    """What is packed, and what is left out."""

    packed: tuple[Member, ...]
    left_out: tuple[Member, ...]

    def said(self) -> Iterator[str]:
        """Yield the lines for the student: what was left out, and how to take it along."""
        for one in self.left_out[:MOST_NAMED]:
            yield say("Left out: {file} ({reason})", file=shown(one.name), reason=one.reason)
        if len(self.left_out) > MOST_NAMED:
            yield say("Left out: {count} more", count=len(self.left_out) - MOST_NAMED)
        more = [one for one in self.left_out if not one.never]
        if more:
            words = f"lab submit --with {shown(more[0].name)}"
            yield say("If your package needs a file of these: {command}", command=words)


def packing(found: Submission, wanted: Sequence[Path] = ()) -> Packing:
    """Decide about each file of a submission that is a folder; `wanted` are the files of `--with`.

    UsageError for a wanted file that is not one of the package, or that is never packed.
    """
    all_of_it = list(members(found))
    names = Counter(key for key in map(_inode, all_of_it) if key is not None)
    judged = [_judged(member, names) for member in all_of_it]
    chosen = {_wanted(path, judged) for path in wanted}
    judged = [Member(m.name, m.place, m.file) if m.name in chosen else m for m in judged]
    out = {member.name for member in judged if member.reason}
    links = {m.name: m.file.target for m in judged if m.file.kind == "link"}
    judged = [_followed(m, links, out) if m.file.kind == "link" else m for m in judged]
    return Packing(
        tuple(member for member in judged if not member.reason),
        tuple(m for m in judged if m.reason and m.file.kind != "folder"),
    )


def members(found: Submission) -> Iterator[Member]:
    """Yield the files of a submission with their paths in the archive: one folder for each package."""
    name = (found.root or ".").rpartition("/")[2]
    own = found.path.name if name == "." else name
    packages = [(own, found.root or ".", found.files)]
    others = (one for one in found.packages if one.root != found.root)
    packages += [(one.name, one.root, one.files) for one in others]
    for folder, root, files in packages:
        for file in files:
            yield Member(f"{folder}/{file.path}", found.path / root / file.path, file)
    for path in found.links_out:
        for folder, root, _ in packages:
            place = found.path / root / path
            if place.is_symlink():
                yield Member(
                    f"{folder}/{path}", place, SourceFile(path, "link"), LEADS_OUT, never=True
                )


def _inode(member: Member) -> tuple[int, int] | None:
    """Return what two names of one file have in common; None for what is no file."""
    try:
        status = member.place.lstat()
    except OSError:
        return None
    return (status.st_dev, status.st_ino) if member.file.kind == "file" else None


def _judged(member: Member, names: Counter[tuple[int, int]]) -> Member:
    """Return the member with the reason why it is left out, if there is one."""
    file, inode = member.file, _inode(member)
    reason, never = member.reason, member.never
    if reason:
        return member
    if file.kind == "file" and member.place.is_symlink():  # intake put the other file's content
        reason, never = LEADS_OUT, True
    elif file.unreadable:
        reason, never = file.reason, True
    elif _is_secret(file):
        reason = SECRET
    elif file.kind == "file" and not file.path.endswith(".py") and PRIVATE_KEY.search(file.data):
        reason = KEY
    elif inode is not None and member.place.lstat().st_nlink > names[inode]:
        reason = HARD_LINK
    return Member(member.name, member.place, file, reason, never)


def _is_secret(file: SourceFile) -> bool:
    *folders, name = file.path.split("/")
    folders += [name] if file.kind == "folder" else []
    in_folder = any(FOLDERS.fullmatch(each) for each in folders)
    return in_folder or (file.kind != "folder" and FILES.fullmatch(name) is not None)


def _followed(member: Member, links: dict[str, str], out: set[str]) -> Member:
    """Return a link, left out if what it leads to is."""
    place = follow(member.name, links).place
    if member.reason or place not in out:
        return member
    return Member(member.name, member.place, member.file, TO_LEFT_OUT)


def _wanted(path: Path, judged: Sequence[Member]) -> str:
    """Return the name of the file that `--with` means: a path, or as the archive or output names it."""
    given = os.path.normpath(path)
    place = Path(os.path.realpath(path.parent)) / path.name
    for member in judged:
        inner = member.name.partition("/")[2]
        if place == member.place or given in (member.name, inner):
            if member.never:
                problem = joined(shown(member.name), member.reason, by=": ")
                raise UsageError(problem, remedy=COPY_IT if member.reason == LEADS_OUT else "")
            if member.file.kind != "folder":
                return member.name
    left_out = [shown(m.name) for m in judged if m.reason and not m.never]
    names = ", ".join(left_out[:MOST_NAMED]) or "-"
    raise UsageError(
        say("--with: your package has no file {file}", file=shown(str(path))),
        remedy=say("Files that are left out: {names}", names=names),
    )
