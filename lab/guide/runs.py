"""Whether what has to run has run since it was saved, and how it ended."""

from __future__ import annotations

from grader.base.i18n.message import joined, say
from grader.base.shown import shown
from grader.package.source.names import last_part
from lab.guide.action import Action
from lab.guide.ran import Ran, is_kept, is_stopped, last_run
from lab.guide.state import StudentState

CHECK = Action(
    "check",
    "check",
    hints=(
        say(
            "check builds and runs your package as your instructor does, and says what is missing."
        ),
    ),
)
"""What remains when every step is done and the files as they are had no full marks."""
NODE_RUNS = say("A node runs until Ctrl+C: its terminal shows what it logs, and takes no commands.")
SOURCED = ".lab/terminal"
"""What the prompt writes when a terminal has sourced something."""


def run_line(state: StudentState) -> str:
    """Return the command that runs the node."""
    return f"ros2 run {state.assignment.package} {state.assignment.executable}"


def quoted(command: str) -> str:
    """Return a command in quotes, as a part of a sentence: it is not a line to copy then."""
    return f"'{command}'"


def stopped(state: StudentState) -> Action | None:
    """Return the action for a node that Ctrl+Z has stopped."""
    if not is_stopped(state.program):
        return None
    found = say(
        "{command} was stopped with Ctrl+Z: it does not run, and it has not ended",
        command=quoted(run_line(state)),
    )
    then = say("(it goes on; end it with Ctrl+C)")
    why = say(
        "Ctrl+Z pauses a program and keeps it: it answers nobody, and its node stays in the list. "
        "fg brings it back in the terminal in which it was stopped; jobs lists what is paused there."
    )
    where = say("In the terminal in which you pressed Ctrl+Z: jobs lists what is stopped there.")
    return Action(joined("fg", then, by="   "), "run.stopped", found, (why,), where=where)


def crashed(state: StudentState) -> Action | None:
    """Return the action for a node whose last run ended with an error, if nothing has changed since."""
    ran = _last(state)
    places = (state.program, state.workspace / SOURCED)
    changed = [path.stat().st_mtime for path in places if path.exists()]
    if ran is None or ran.ended < max(state.saved, *changed, 0.0):
        return None
    source = state.source
    calls = {name for _, name in source.calls} if source is not None else set()
    if not ran.crashed(may_fail_at_end=any(last_part(name) == "shutdown" for name in calls)):
        return None
    found = say(
        "{command} ended with an error (exit status {status})",
        command=quoted(run_line(state)),
        status=ran.status,
    )
    why = say("The last line of its output names the error. explain says what it means.")
    if "explain" in ran.command:
        return Action("check", "run.crashed", found, (say("check names the line to change."),))
    return Action(f"{run_line(state)} 2>&1 | explain -", "run.crashed", found, (why,))


def has_run(state: StudentState) -> bool:
    """Whether it is known that the node ran, and did not crash, since its files were saved."""
    return is_kept(state.workspace) and not (crashed(state) or not_run(state))


def not_run(state: StudentState) -> Action | None:
    """Return the action for a node that has not run since its files were saved."""
    ran = _last(state)
    if not is_kept(state.workspace) or (ran is not None and ran.started >= state.saved):
        return None
    found, why = _other_program(state), NODE_RUNS
    if found:
        why = say("ros2 run takes the package and the left side of the entry point.")
    elif ran is not None:
        found = say("your files have changed since you ran the node")
    return Action(run_line(state), "ran", found, (why,))


def _other_program(state: StudentState) -> str:
    """Return what is wrong with a run of a program that the package does not have; "" if nothing."""
    ran, name = last_run(state.workspace), state.assignment.executable
    words = ran.command.split() if ran is not None else []
    own = ["ros2", "run", state.assignment.package]
    if ran is None or not ran.status or ran.ended < state.saved or words[:3] != own:
        return ""
    typed = next((word for word in words[3:] if not word.startswith("-")), name)
    if (state.program.parent / typed).exists():
        return ""
    return say("there is no executable {typed}; it is called {name}", typed=shown(typed), name=name)


def _last(state: StudentState) -> Ran | None:
    ran = last_run(state.workspace)
    of_node = ran is not None and ran.is_of(state.assignment.package, state.assignment.executable)
    return ran if of_node else None
