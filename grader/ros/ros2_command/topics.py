"""What the verbs of `ros2 topic` share: a topic's name and type, and how long to listen."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

from .interfaces import load
from .parsing import CommandError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

POLL = 0.05  # seconds
NO_TYPE = "Could not determine the type for the passed topic"


def full_name(node: Any, topic: str) -> str:
    """Return a topic's name with its namespace; raises CommandError if it is not a valid name."""
    from rclpy.exceptions import InvalidTopicNameException  # noqa: PLC0415 (slow to import)
    from rclpy.expand_topic_name import expand_topic_name  # noqa: PLC0415
    from rclpy.validate_full_topic_name import validate_full_topic_name  # noqa: PLC0415

    try:
        name: str = expand_topic_name(topic, node.get_name(), node.get_namespace())
        validate_full_topic_name(name)
    except (InvalidTopicNameException, ValueError) as error:
        raise CommandError(str(error)) from None
    return name


def types(node: Any, topic: str) -> list[str]:
    """Return the types of a topic; more than one if its endpoints do not agree, none if unknown."""
    known: dict[str, list[str]] = dict(node.get_topic_names_and_types())
    return known.get(topic, [])


def message_class(node: Any, topic: str, *, patient: bool) -> Any:
    """Return the class of a topic's messages; warn if the topic is not published yet.

    A patient one then waits until it is. Raises CommandError if the type stays unknown or is not
    installed.
    """
    name = full_name(node, topic)
    found = types(node, name)
    if not found:
        print(f"WARNING: topic [{topic}] does not appear to be published yet")
    while patient and not found:
        time.sleep(POLL)
        found = types(node, name)
    if not found:
        raise CommandError(NO_TYPE)
    if len(found) > 1:
        raise CommandError(
            f"Cannot echo topic '{topic}', as it contains more than one type: [{', '.join(found)}]"
        )
    return load(found[0], "msg")


def message_filter(expression: str | None) -> Callable[[Any], bool] | None:
    """Return the predicate of a Python expression about the message `m`; None for None.

    It raises CommandError, as this does, if the expression is not one or does not fit the message.
    """
    if expression is None:
        return None
    try:
        code = compile(expression, "<filter>", "eval")
    except SyntaxError as error:
        raise CommandError(f"The filter is not a Python expression: {error.msg}") from None

    def accepts(message: Any) -> bool:
        try:
            return bool(eval(code, {}, {"m": message}))  # noqa: S307 (the user's own expression)
        except Exception as error:
            raise CommandError(f"The filter does not fit the message: {error}") from None

    return accepts


def spin_while(node: Any, going: Iterator[bool] | None = None, *, timeout: float = 1.0) -> None:
    """Handle what arrives until `going` says False; without it until Ctrl+C."""
    from rclpy.executors import SingleThreadedExecutor  # noqa: PLC0415 (slow to import)

    executor = SingleThreadedExecutor()
    executor.add_node(node)
    try:
        while going is None or next(going):
            executor.spin_once(timeout_sec=timeout)
    finally:
        executor.remove_node(node)
        executor.shutdown()
