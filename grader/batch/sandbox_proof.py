"""Tests without any submission whether everything works that a verdict needs."""

from __future__ import annotations

import io
import tarfile

from grader.base.unheard import unheard
from grader.batch.work import Job
from grader.ros.distro import find_distro
from grader.run.probe_link import ProbeLink
from grader.run.workspace import lay_out
from grader.sandbox.base import Sandbox
from grader.sandbox.choose import open_sandbox


def prove(job: Job) -> None:
    """Open the job's sandbox and try it; raise SurroundingsError for what does not work."""
    tried_out(job)


def tried_out(job: Job) -> Sandbox:
    """Open the job's sandbox, try it and close it; return it. Raises as `prove`."""
    sandbox = open_sandbox(
        job.sandbox,
        find_distro(job.distro),
        job.limits,
        interfaces=job.assignment.interfaces,
        notify=unheard,
    )
    try:
        try_out(sandbox)
    finally:
        sandbox.close()
    return sandbox


def try_out(sandbox: Sandbox) -> None:
    """Do in an open sandbox everything that marking does except run the submission's code.

    Lays out an empty workspace, looks for colcon, and asks the probe for the ROS graph.
    """
    nothing = io.BytesIO()
    tarfile.open(fileobj=nothing, mode="w").close()
    lay_out(sandbox, nothing.getvalue())
    probe = ProbeLink(sandbox)
    try:
        probe.ask("look")
    finally:
        probe.close()
