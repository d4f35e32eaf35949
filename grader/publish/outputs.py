"""Everything that a class run writes: pages, gradebooks, feedback, reports. Skipped if nothing changed."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Callable, Collection
from dataclasses import asdict, dataclass, replace
from datetime import datetime, timezone
from pathlib import Path
from typing import Any, Literal

from grader.base.errors import UsageError
from grader.base.project import PACKAGE
from grader.batch.accept import refuse_lower
from grader.batch.inputs import ClassInputs
from grader.batch.ledger import Ledger
from grader.batch.model import ClassResult, GradebookEntry
from grader.batch.sheets import SheetOptions
from grader.batch.verdict_key import source_digest
from grader.report.files import write_report

INDEX = "index.html"
CLASS_FOLDERS = ("students", "feedback", "unpacked", "given", "pseudonyms")


@dataclass(frozen=True)
class Outcome:
    """The result of writing; `failures` are the errors of files that could not be written."""

    state: Literal["written", "unchanged", "refused"]
    failures: tuple[Exception, ...] = ()


@dataclass(frozen=True)
class Outputs:
    """The outputs of a class: their folder and settings, the instructor's files, and the ledger.

    `accepts` holds what the instructor accepts in advance (see `accept`).
    """

    out: Path
    sheets: SheetOptions
    known: ClassInputs
    ledger: Ledger
    accepts: frozenset[str] = frozenset()

    @property
    def can_lower(self) -> bool:
        """Whether there are earlier grades that could be lowered."""
        return bool(self.known.gradebook.rows or self.known.sheets.rosters)

    def refuse_lower(
        self, result: ClassResult, *, but: Collection[str] = (), marked: bool = False
    ) -> None:
        """Raise UsageError if a grade would be lowered; `but` are students who are not marked yet.

        Students corrected by hand since the last write are ignored: the instructor decided that.
        """
        noted = self._noted().get("at")
        corrected = self.ledger.corrected_since(datetime.fromisoformat(noted)) if noted else set()
        found = [*self.known.sheets.lowered(result), *self.known.gradebook.lowered(result)]
        rest = [one for one in found if one.key not in corrected and one.key not in but]
        refuse_lower(rest, self.accepts, marked=marked)

    def write(self, result: ClassResult, *, notify: Callable[[str], None]) -> Outcome:
        """Write all outputs, unless they are up to date or a grade would be lowered."""
        if self._are_there(result):
            return Outcome("unchanged")
        try:
            self.refuse_lower(result, marked=True)
        except UsageError as error:
            return Outcome("refused", (error,))
        return Outcome("written", tuple(self._write(result, notify=notify)))

    def _are_there(self, result: ClassResult) -> bool:
        noted = self._noted()
        if noted.get("digest") != self._digest(result):
            return False
        return all(Path(file).exists() for file in noted["files"])

    def _write(self, result: ClassResult, *, notify: Callable[[str], None]) -> list[Exception]:
        # a run may be killed while it writes: until the end, no files are noted as written
        begun = {name: value for name, value in self._noted().items() if name == "at"}
        self.ledger.note(self._name, json.dumps(begun))
        # these import libraries and templates that an unchanged class does not need
        from grader.publish.gradebooks import write_outputs  # noqa: PLC0415
        from grader.publish.pages.write import write_site  # noqa: PLC0415

        written = write_outputs(
            result,
            self.out,
            sheets=self.known.sheets.by_output,
            columns=self.sheets.columns,
            show_hidden=self.sheets.show_hidden,
            notify=notify,
        )
        with written.collecting_errors():
            written.files.append(write_site(result, self.out))
        for entry in result.entries:
            with written.collecting_errors():
                written.files += _write_report(entry, self.out)
        os.sync()  # once for all files, before they are noted as written
        if not written.failures:
            kept = {
                "digest": self._digest(result),
                "files": [str(file.resolve()) for file in written.files],
                "at": datetime.now(timezone.utc).isoformat(),
            }
            self.ledger.note(self._name, json.dumps(kept))
        return written.failures

    @property
    def _name(self) -> str:
        return f"outputs {self.out.resolve()}"

    def _noted(self) -> dict[str, Any]:
        noted: dict[str, Any] = json.loads(self.ledger.setting(self._name) or "{}")
        return noted

    def _digest(self, result: ClassResult) -> str:
        """Return the hash of everything that the files depend on."""
        bare = vars(replace(result, entries=(), started=None, seconds=0))
        entries = [asdict(replace(e, report=None)) for e in result.entries]
        sheets = [asdict(self.sheets), self.known.sheets.digest]
        of_class = {**bare, "system": result.system.name}
        parts = [of_class, entries, sheets, source_digest(PACKAGE)]
        text = json.dumps(parts, default=str, sort_keys=True).encode()
        return hashlib.sha256(text).hexdigest()


def _write_report(entry: GradebookEntry, out: Path) -> list[Path]:
    report = entry.report
    if report is None:
        return []
    name = report.submission.name
    # a student may have the name of one of our folders
    name = f"{name}-1" if name in CLASS_FOLDERS else name
    return [write_report(report, out, name, durable=False)]
