"""The command that opens a shell beside a student's package, in the sandbox in which it was marked."""

from __future__ import annotations

import contextlib
import shlex
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

from grader.base.errors import UsageError
from grader.cli import options

if TYPE_CHECKING:
    from grader.sandbox.base import Sandbox
    from grader.verdict.evidence_file import EvidenceFile

PROMPT = r"student:\w\$ "
ENDED = 130


@click.command("shell")
@click.argument("student")
@click.argument("command", nargs=-1, type=click.UNPROCESSED)
@options.assignment
@options.keys
@options.sandbox
@options.ledger
@options.class_out
def shell(
    student: str,
    command: tuple[str, ...],
    assignment: str | None,
    keys: Path | None,
    sandbox: str,
    ledger: Path | None,
    out: Path | None,
) -> int:
    """Open a shell beside a student's package: built, in the sandbox in which it was marked.

    The files are those of the verdict that counts, from the ledger; nothing that you change there
    stays. With COMMAND (`grader shell kim -- ros2 pkg executables`) it runs that instead of a
    shell. Leave the shell with `exit`.
    """
    from grader.base.gate import gate  # noqa: PLC0415 - keeps --help fast
    from grader.batch.correction import counting_verdict  # noqa: PLC0415
    from grader.batch.find_student import find_student  # noqa: PLC0415
    from grader.batch.ledger import Ledger  # noqa: PLC0415
    from grader.batch.override import find_ledger  # noqa: PLC0415
    from grader.run.workspace import build  # noqa: PLC0415
    from grader.verdict.evidence_file import EvidenceFile  # noqa: PLC0415
    from grader.verdict.order import load_with_hidden  # noqa: PLC0415

    wanted = load_with_hidden(assignment, keys)
    with Ledger(find_ledger(ledger, out, Path.cwd()), makes=False) as opened:
        who = find_student(student, opened.students(wanted.id))
        verdict = counting_verdict(opened, wanted.id, who.key)
        content = opened.evidence(verdict) if verdict else b""
    if not content:
        what = "has no verdict" if not verdict else "was marked by a grader that kept no evidence"
        raise UsageError(
            f"{who.name or who.key} {what}", remedy="Mark the class first: grader grade-all."
        )
    evidence = EvidenceFile.from_bytes(content)
    if not command and not sys.stdin.isatty():
        command = ("bash", "-c", sys.stdin.read())
    out_ = gate(sys.stderr)
    submission = evidence.taken_in()
    if submission.root is None:
        raise UsageError(
            f"{who.name or who.key} handed in no package: {submission.problem}",
            remedy=f"The file: {submission.path}",
        )
    with contextlib.closing(_opened(evidence, sandbox)) as box:
        out_.write(f"building the package of {who.name or who.key}\n")
        made = build(box, submission, package=evidence.assignment.package)
        if made.status != 0:
            out_.write(f"{made.log}\ncolcon build failed (exit status {made.status})\n")
        out_.flush()
        return _run(box, command)


def _opened(evidence: EvidenceFile, name: str) -> Sandbox:
    from grader.ros.distro import find_distro  # noqa: PLC0415 - keeps --help fast
    from grader.sandbox.choose import open_sandbox  # noqa: PLC0415
    from grader.sandbox.limits import Limits  # noqa: PLC0415

    of_verdict = evidence.recording.environment
    limits = Limits().override(
        {
            limit: value.value
            for limit, value in of_verdict.limits.items()
            if limit != "verdict_seconds"
        }
    )
    distro = find_distro(of_verdict.distro)

    def notify(text: str) -> None:
        click.echo(text, err=True)

    return open_sandbox(
        of_verdict.sandbox if name == "auto" else name,
        distro,
        limits,
        interfaces=evidence.assignment.interfaces,
        notify=notify,
    )


def _run(box: Sandbox, command: tuple[str, ...]) -> int:
    from grader.base.gate import gate  # noqa: PLC0415 - keeps --help fast
    from grader.run.attached import attach, follow  # noqa: PLC0415

    network = box.probe(["cat"])  # it has a network of its own until its input ends
    words = shlex.join(command) if command else f"env PS1={shlex.quote(PROMPT)} bash --norc -i"
    console = box.console(["bash", "-c", box.in_workspace(words)], probe=network)
    try:
        if not command:
            return attach(console, keyboard=sys.stdin.fileno(), screen=sys.stdout.fileno())
        out = gate(sys.stdout)

        def show(line: str) -> None:
            out.write(f"{line}\n")
            out.flush()

        return follow(console, show)
    except KeyboardInterrupt:
        console.interrupt()
        return ENDED
    finally:
        console.end()
        network.finish(1.0)
