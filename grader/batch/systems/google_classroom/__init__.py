"""Google Classroom: the download of an assignment's folder in Drive."""

from __future__ import annotations

from grader.base.i18n.message import say
from grader.batch.systems.google_classroom import read
from grader.batch.systems.system import Download, System

# its names say little, so that every other system is asked first: it has no priority
SYSTEM = System(
    name="google_classroom",
    title="Google Classroom",
    download=Download(say("Google Classroom's folder in Drive (`First Last - file.zip`)"), read),
)
