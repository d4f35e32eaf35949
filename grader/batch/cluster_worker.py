"""The functions that run on a cluster's workers: text in, text out."""

from __future__ import annotations

import json
from dataclasses import dataclass

from grader.base.errors import GraderError
from grader.base.project import PACKAGE
from grader.batch.sandbox_proof import tried_out
from grader.batch.verdict_key import NOT_MARKING, source_digest, surroundings_key
from grader.batch.work import Job, Task, mark_task


@dataclass(frozen=True)
class Checked:
    """What a worker reports about itself; `problem` says why it cannot be used."""

    surroundings: str = ""
    sandbox: str = ""
    grader: str = ""
    ros: str = ""
    problem: str = ""

    def to_text(self) -> str:
        """Return it as JSON."""
        return json.dumps(vars(self))


def check_here(job: str) -> str:
    """Return what this worker marks with, as the text of a `Checked`; tries its sandbox once."""
    wanted = Job.from_text(job)
    own = source_digest(PACKAGE, NOT_MARKING)
    try:
        sandbox = tried_out(wanted)
    except GraderError as error:
        return Checked(grader=own, problem=str(error)).to_text()
    key = surroundings_key(wanted.assignment, sandbox.ros, wanted.limits, lang=wanted.lang)
    ros = ", ".join(f"{name} {value}" for name, value in sandbox.ros.versions.items())
    return Checked(key, sandbox.name, own, f"{sandbox.ros.kind}: {ros}").to_text()


def mark_here(job: str, task: str) -> str:
    """Mark one submission on this worker."""
    return mark_task(Job.from_text(job), Task.from_text(task)).to_text()
