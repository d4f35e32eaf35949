"""The modules of `grader` under another name: nothing else of the lab gets on a student's path."""

from pathlib import Path

__path__ = [str(Path(__file__).resolve().parents[4] / "grader")]
