"""A program that prints the page of a failing report, as `grader grade` does."""

from __future__ import annotations

from pathlib import Path

from grader.report.terminal import print_matrix
from tests.report.samples import failing_report, print_report


def main() -> None:
    print_report(failing_report(), path=Path("reports/anna/jazzy/report.json"))
    print_matrix([failing_report()])


if __name__ == "__main__":
    main()
