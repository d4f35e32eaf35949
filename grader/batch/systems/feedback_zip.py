"""A zip of feedback files that a learning management system takes back, and its member names."""

from __future__ import annotations

import io
import tarfile
import zipfile
from collections.abc import Callable, Mapping

from grader.batch.model import GradebookEntry

PageOf = Callable[[GradebookEntry], tuple[bytes, str]]
"""Returns a student's feedback: the page in HTML, and the same as plain text."""
PAGE = "feedback.html"
DATE = (1980, 1, 1, 0, 0, 0)  # the same content gives the same bytes
TARS = {".tar": "w", ".tar.gz": "w:gz", ".tgz": "w:gz", ".tar.bz2": "w:bz2", ".tar.xz": "w:xz"}


def zip_of(files: Mapping[str, bytes]) -> bytes:
    """Return a zip with these files; names are UTF-8."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            member = zipfile.ZipInfo(name, DATE)
            member.compress_type = zipfile.ZIP_DEFLATED
            member.external_attr = 0o644 << 16
            archive.writestr(member, content)
    return out.getvalue()


def in_place_of(name: str, page: bytes, text: str) -> bytes:
    """Return the feedback in the form that a file's name promises.

    A system that gives the feedback the name of the student's file would otherwise show an archive
    that cannot be opened.
    """
    lower = name.casefold()
    if lower.endswith(".zip"):
        return zip_of({PAGE: page})
    for ending, mode in TARS.items():
        if lower.endswith(ending):
            return _tar(page, mode)
    return page if lower.endswith((".html", ".htm")) else text.encode()


def _tar(page: bytes, mode: str) -> bytes:
    out = io.BytesIO()
    with tarfile.open(fileobj=out, mode=mode) as archive:  # type: ignore[call-overload]
        member = tarfile.TarInfo(PAGE)
        member.size = len(page)
        archive.addfile(member, io.BytesIO(page))
    return out.getvalue()
