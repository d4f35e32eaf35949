"""All that a class run writes: pages, gradebooks, feedback, reports; only where something changed."""

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

INDEX = "index.html"
CLASS_FOLDERS = ("students", "feedback", "unpacked")


@dataclass(frozen=True)
class Outcome:
    """How the writing went; `failures` are the errors of what could not be written."""

    state: Literal["written", "unchanged", "refused"]
    failures: tuple[Exception, ...] = ()


@dataclass(frozen=True)
class Outputs:
    """Where a class' files go, what was known beforehand, and what the ledger noted of it all.

    `accepts` is what the instructor accepts (see `accept`).
    """

    out: Path
    sheets: SheetOptions
    known: ClassInputs
    ledger: Ledger
    accepts: frozenset[str] = frozenset()

    @property
    def can_lower(self) -> bool:
        """Whether there are grades yet that could go down."""
        return bool(self.known.gradebook.rows or self.known.sheets.rosters)

    def refuse_lower(
        self, result: ClassResult, *, but: Collection[str] = (), marked: bool = False
    ) -> None:
        """Raise UsageError if a grade would go down; `but` are students who are not known yet.

        Who was corrected by hand since everything was written last is no matter: that was the
        instructor's word already.
        """
        noted = self._noted().get("at")
        corrected = self.ledger.corrected_since(datetime.fromisoformat(noted)) if noted else set()
        found = [*self.known.sheets.lowered(result), *self.known.gradebook.lowered(result)]
        rest = [one for one in found if one.key not in corrected and one.key not in but]
        refuse_lower(rest, self.accepts, marked=marked)

    def write(self, result: ClassResult, *, notify: Callable[[str], None]) -> Outcome:
        """Write everything that can be written, unless it is there or a grade would go down."""
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
        # until all is written it is not known what is there: a run may be killed meanwhile
        begun = {name: value for name, value in self._noted().items() if name == "at"}
        self.ledger.note(self._name, json.dumps(begun))
        # each of these brings a library or templates that an unchanged class does not need
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
        with written.going_on():
            written.files.append(write_site(result, self.out))
        for entry in result.entries:
            with written.going_on():
                written.files += _write_report(entry, self.out)
        os.sync()  # once for all of them: only then is it noted that they are there
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
        """Return the hash of all that the files are made of."""
        bare = replace(result, entries=(), started=None, seconds=0)
        entries = [asdict(replace(e, report=None)) for e in result.entries]
        sheets = [asdict(self.sheets), self.known.sheets.digest]
        parts = [asdict(bare), entries, sheets, source_digest(PACKAGE)]
        text = json.dumps(parts, default=str, sort_keys=True).encode()
        return hashlib.sha256(text).hexdigest()


def _write_report(entry: GradebookEntry, out: Path) -> list[Path]:
    from grader.report.files import write_report  # noqa: PLC0415

    report = entry.report
    if report is None:
        return []
    name = report.submission.name
    # a student may be called as one of our folders is
    name = f"{name}-1" if name in CLASS_FOLDERS else name
    return [write_report(report, out, name, durable=False)]
