"""The goals of a scenario: sent to actions, cancelled, and what becomes of them."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any
from uuid import uuid4

from action_msgs.msg import GoalStatus
from unique_identifier_msgs.msg import UUID

from grader.run.in_probe.messages import Values, taken_from

MOST_FEEDBACK = 200  # of goals, in one answer
STATUS = {
    GoalStatus.STATUS_SUCCEEDED: "succeeded",
    GoalStatus.STATUS_CANCELED: "canceled",
    GoalStatus.STATUS_ABORTED: "aborted",
}


class Goals:
    """The goals that the probe has sent, by their names in the assignment."""

    def __init__(self) -> None:
        # (taken by hand: the client drops feedback that it has not taken when the result comes)
        self.feedback: list[Any] = []  # subscriptions
        self.sent: dict[bytes, str] = {}  # the name of each goal by its id
        self.accepted: dict[str, Any] = {}  # the handles of goals
        self.open: set[str] = set()  # those that were accepted and have not ended
        self.became: list[list[Any]] = []  # name, what, values: since the last answer

    def take_feedback(self) -> None:
        """Take the feedback that has arrived."""
        for subscription in self.feedback:
            for message in taken_from(subscription, MOST_FEEDBACK):
                name = self.sent.get(bytes(message.goal_id.uuid))
                if name is not None:
                    self.became.append([name, "feedback", Values().of(message.feedback)])

    def taken(self) -> Iterable[list[Any]]:
        """Return what became of the goals since the last call; no more than the limit."""
        became, self.became = self.became[:MOST_FEEDBACK], []
        return became

    def send(self, name: str, client: Any, goal: Any) -> None:
        """Send a goal to an action."""

        def tell(what: str, values: Any = None) -> None:
            self.became.append([name, what, values])

        def ended(future: Any) -> None:
            answer = future.result()
            self.open.discard(name)
            status = STATUS.get(answer.status)
            if status:
                tell(status, Values().of(answer.result))

        def answered(future: Any) -> None:
            handle = future.result()
            tell("accepted" if handle.accepted else "refused")
            if handle.accepted:
                self.accepted[name] = handle
                self.open.add(name)
                handle.get_result_async().add_done_callback(ended)

        goal_id = UUID(uuid=list(uuid4().bytes))
        self.sent[bytes(goal_id.uuid)] = name
        client.send_goal_async(goal, goal_uuid=goal_id).add_done_callback(answered)

    def cancel(self, name: str) -> bool:
        """Ask for the end of a goal; return whether it was accepted before."""
        handle = self.accepted.get(name)
        if handle is None:
            return False

        def answered(future: Any) -> None:
            if not future.result().goals_canceling:
                self.became.append([name, "refused", None])

        handle.cancel_goal_async().add_done_callback(answered)
        return True
