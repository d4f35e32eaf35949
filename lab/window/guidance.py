"""The guide as the page shows it: steps, what is found and where, what is next, and the hints."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from grader.report.commands import is_command
from lab.commands.hint import next_hint
from lab.commands.watch import environment_of
from lab.guide.hints import hints_of
from lab.guide.opened import WORKSPACE, OpenedLab
from lab.guide.runs import CHECK
from lab.guide.task import Task, all_done
from lab.window.markup import markup

Message = dict[str, Any]
Graph = Mapping[str, Any]


class Guidance:
    """The guide of an opened lab; `graph` returns what the bridge saw last."""

    def __init__(self, lab: OpenedLab, graph: Callable[[], Graph]) -> None:
        self._lab = lab
        self._graph = graph

    def moved(self) -> bool:
        """Whether the student has gone on to another lesson: this is the guide of that one then."""
        before, self._lab = self._lab, self._lab.now()
        return self._lab is not before

    @property
    def lesson(self) -> Message:
        """The lesson: its title, its introduction and its steps with their texts."""
        lesson = self._lab.lesson
        steps = [
            {"number": step.number, "title": step.title, "text": markup(step.text)}
            for step in lesson.steps
        ]
        introduction = markup(lesson.introduction)
        title = self._lab.assignment.title
        return {"kind": "lesson", "title": title, "introduction": introduction, "steps": steps}

    def state(self) -> Message:
        """Return where the student is now."""
        task = self._task()
        return {
            "kind": "guide",
            "position": task.position,
            "steps": self._steps(task),
            **self._next(task),
            "check": self._check(task),
        }

    def hint(self) -> Message:
        """Count one more hint, and return where the student is then."""
        next_hint(self._lab, self._task())
        return self.state()

    def _task(self) -> Task:
        environment = environment_of(self._lab.workspace)
        return self._lab.task(environment, look=True, sees=self._sees)

    def _sees(self, condition: str, name: str, _: Mapping[str, str]) -> bool:
        graph = self._graph()
        if condition == "node_on_graph":
            return any(node["name"] == name for node in graph.get("nodes", ()))
        topics = [topic for topic in graph.get("topics", ()) if topic["name"] == name]
        return any(topic["publishers"] for topic in topics)

    def _steps(self, task: Task) -> list[str]:
        """Return what is known of each step: `done`, `now` or `todo`."""
        found = []
        for position, step in enumerate(self._lab.lesson.steps, start=1):
            done = not task.actions[position - 1] and (bool(step.done) or position < task.position)
            here = position == task.position and task.action is not None
            found.append("now" if here else "done" if done else "todo")
        return found

    def _next(self, task: Task) -> Message:
        lab, action = self._lab, task.action
        if action is None:
            done = " ".join(lab.translate(text) for text in all_done(task))
            following = "lab next" if lab.after().goes_on(os.environ) else ""
            command = following if task.archive else "lab submit"
            return {"found": "", "next": done, "command": command, "ready": True, "hints": []}
        following = lab.translate(action.next)
        is_typed = is_command(following) or following == CHECK.next
        package = Path(WORKSPACE, "src", lab.assignment.package)
        hints = hints_of(action, lab.lesson.steps[task.position - 1], package)
        shown = min(lab.progress().hints.get(action.id, 0), len(hints))
        return {
            "id": action.id,
            "found": lab.translate(action.found),
            "next": following,
            "command": following.partition("   (")[0] if is_typed else "",
            "ready": False,
            "hints": [lab.translate(hint).rstrip() for hint in hints[:shown]],
            "hints_left": len(hints) - shown,
            "file": self._place(action.file),
            "line": action.line,
        }

    def _place(self, file: str) -> str:
        """Return the path in the workspace of a file of a package; "" if it is not there."""
        lab = self._lab
        folders = (f"src/{lab.assignment.package}/", "src/", "")
        found = [f"{folder}{file}" for folder in folders if file]
        return next((path for path in found if (lab.workspace / path).is_file()), "")

    def _check(self, task: Task) -> Message:
        kept = self._lab.progress()
        return {
            "ran": bool(kept.checked),
            "score": kept.score,
            "most": kept.max_score,
            "current": task.is_checked,
            "passed": task.passed,
        }
