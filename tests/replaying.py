"""`grader` that marks from recorded evidence: `python -m tests.replaying grade …` (`recorded`)."""

from __future__ import annotations

from unittest import mock

from grader.batch import work
from grader.verdict import mark
from tests import recorded
from tests.batch import in_process

if __name__ == "__main__":
    with (
        mock.patch.object(mark, "mark", recorded.mark_submission),
    ):
        raise SystemExit(in_process.run(work.mark_task))
