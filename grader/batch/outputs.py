"""All that a class run writes: pages, gradebooks, feedback, reports; only where something changed."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Callable
from dataclasses import asdict
from dataclasses import dataclass
from dataclasses import replace
from pathlib import Path

from grader.batch.keys import GRADER
from grader.batch.keys import source_digest
from grader.batch.ledger import Ledger
from grader.batch.model import ClassResult
from grader.batch.model import Entry

INDEX = "index.html"
CLASS_FOLDERS = ("students", "feedback", "unpacked")


@dataclass(frozen=True)
class Sheets:
    """The teacher's own files that are filled in, and the names of their columns."""

    worksheet: Path | None = None
    canvas: Path | None = None
    canvas_column: str = ""
    grade_column: str = ""
    feedback_column: str = ""
    show_hidden: bool = False


def write_all(
    result: ClassResult,
    out: Path,
    sheets: Sheets,
    ledger: Ledger,
    *,
    say: Callable[[str], None],
) -> bool:
    """Write everything below `out`; return False where it is there already and nothing changed.

    Raises what the writers raise: UsageError and SurroundingsError.
    """
    digest = _digest(result, sheets)
    name = f"outputs {out.resolve()}"
    noted = json.loads(ledger.setting(name) or "{}")
    if noted.get("digest") == digest and all(Path(file).exists() for file in noted["files"]):
        return False
    # each of these brings a library or templates that an unchanged class does not need
    from grader.gradebook.outputs import write_outputs  # noqa: PLC0415
    from grader.site.write import write_site  # noqa: PLC0415

    files = write_outputs(
        result,
        out,
        worksheet=sheets.worksheet,
        canvas=sheets.canvas,
        canvas_column=sheets.canvas_column or None,
        grade_column=sheets.grade_column,
        feedback_column=sheets.feedback_column,
        show_hidden=sheets.show_hidden,
        say=say,
    )
    files.append(write_site(result, out))
    files += [_write_report(entry, out) for entry in result.entries if entry.report is not None]
    os.sync()  # once for all of them: only then is it noted that they are there
    kept = {"digest": digest, "files": [str(file.resolve()) for file in files]}
    ledger.note(name, json.dumps(kept))
    return True


def _write_report(entry: Entry, out: Path) -> Path:
    from grader.report.files import write_report  # noqa: PLC0415

    report = entry.report
    assert report is not None
    name = report.submission.name
    # a student may be called as one of our folders is
    return write_report(report, out, f"{name}-1" if name in CLASS_FOLDERS else name, durable=False)


def _digest(result: ClassResult, sheets: Sheets) -> str:
    """Return the hash of all that the files are made of."""
    bare = replace(result, entries=(), started=None, seconds=0)
    entries = [asdict(replace(e, report=None)) for e in result.entries]
    own = [path.read_bytes() for path in (sheets.worksheet, sheets.canvas) if path is not None]
    parts = [asdict(bare), entries, asdict(sheets), source_digest(GRADER)]
    text = json.dumps(parts, default=str, sort_keys=True).encode()
    return hashlib.sha256(b"\0".join([text, *own])).hexdigest()
