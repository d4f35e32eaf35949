"""Blackboard: its download."""

from __future__ import annotations

from grader.base.i18n.message import say
from grader.batch.systems.blackboard import read
from grader.batch.systems.system import Download, System

SYSTEM = System(
    name="blackboard",
    title="Blackboard",
    priority=4,
    download=Download(say("Blackboard's download of all submissions"), read),
    usernames=True,
)
