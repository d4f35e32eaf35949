"""A source with a symptom that is known, and what the assignment asks of it."""

from __future__ import annotations

from dataclasses import dataclass

from grader.mistakes.kind import Finding
from grader.mistakes.node_source import NodeSource
from grader.report.model import Where


@dataclass(frozen=True)
class Suspect:
    """The source to look at, its path in the package, and what the assignment asks for."""

    source: NodeSource
    file: str
    node_name: str
    period: float
    start: int
    step: int

    def finding(self, slug: str, line: int | None = None, **params: str | int | float) -> Finding:
        """Return a mistake of the stage `node` on a line of the file."""
        callback = self.source.callback
        words = {
            "period": repr(self.period),
            "callback": callback.name if callback else "timer_callback",
            "node_name": self.node_name,
            "node": "node",
            "name": "",
            "close": "",
            **params,
        }
        where = Where(file=self.file, line=line)
        return Finding(kind=f"node.{slug}", params=params, words=words, where=where)
