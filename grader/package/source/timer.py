"""A timer that a node creates, as its source has it."""

from __future__ import annotations

import ast
from dataclasses import dataclass

from grader.package.source.module import Function
from grader.package.source.names import dotted, last_part


@dataclass(frozen=True)
class Timer:
    """A call of create_timer: its arguments, and the function that contains it."""

    call: ast.Call
    period: ast.expr | None
    callback: ast.expr | None
    function: Function | None
    clock: ast.expr | None = None

    @property
    def has_other_clock(self) -> bool:
        """Whether the timer is given a clock that is not the node's."""
        own = self.clock is not None and dotted(self.clock).endswith("get_clock()")
        none = isinstance(self.clock, ast.Constant) and self.clock.value is None
        return self.clock is not None and not own and not none

    @property
    def _named(self) -> ast.expr | None:
        """The expression that names the callback, whether it is called or not."""
        if isinstance(self.callback, ast.Call) and self.callback.args and not self.called:
            return self.callback.args[0]  # partial(callback, …)
        return self.callback.func if isinstance(self.callback, ast.Call) else self.callback

    @property
    def method(self) -> str:
        """The name of the callback; "" if it has none."""
        return last_part(dotted(self._named)) if self._named is not None else ""

    @property
    def is_variable(self) -> bool:
        """Whether the callback is named without a dot: it is a function and no method."""
        return isinstance(self._named, ast.Name)

    @property
    def called(self) -> bool:
        """Whether the callback is called instead of passed by name."""
        called = isinstance(self.callback, ast.Call) and dotted(self.callback)
        return bool(called) and not str(called).endswith("partial()")

    @property
    def seconds(self) -> float | None:
        """The period, if it is written as a number."""
        if isinstance(self.period, ast.Constant) and isinstance(self.period.value, int | float):
            return float(self.period.value)
        return None


def timer_of(call: ast.Call, function: Function | None) -> Timer:
    """Return the timer that a call of create_timer makes in a function."""
    given = {keyword.arg: keyword.value for keyword in call.keywords}
    period, callback, _, clock = (*call.args[:4], None, None, None, None)[:4]
    return Timer(
        call,
        period or given.get("timer_period_sec"),
        callback or given.get("callback"),
        function,
        clock or given.get("clock"),
    )
