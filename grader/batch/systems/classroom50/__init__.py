"""Classroom 50: the autograder.py for its runner, and its scores beside your own.

Its clones of students' repositories are read as those of GitHub Classroom, whose names are the same.
"""

from __future__ import annotations

from grader.batch.systems.system import System

SYSTEM = System(name="classroom50", title="Classroom 50")
