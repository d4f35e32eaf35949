"""Kinds of check for the world: where a turtle drives."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, Literal

from pydantic import Field, model_validator

from grader.base.i18n.message import Message as Text
from grader.base.i18n.message import joined, say, say_plural
from grader.base.i18n.times import times
from grader.base.part import Part
from grader.base.yaml_model import broken
from grader.course.values import Form, forms_in_words
from grader.course.worlds import BUMP, WORLDS
from grader.run.observations import Pose
from grader.verdict.checks.declare import kind
from grader.verdict.checks.fields import is_integer_bits, must_fit
from grader.verdict.checks.foreign import of_the_world_by_itself
from grader.verdict.checks.parameters import EDGE, Parameters
from grader.verdict.outcome import Failed, Passed

if TYPE_CHECKING:
    from grader.verdict.use import Use

AT_REST = 0.01  # m: a turtle that moved less stands still
LONGEST_STEP = 0.5  # m between two poses: a longer one is no driving, whatever the world says
CIRCLE_POINTS = 60  # of a circle that is drawn


class Circle(Part):
    """A circle of a radius (m); poses may be `within` m of it."""

    radius: float = Field(gt=0)
    within: float = Field(gt=0)


class Path(Parameters):
    """The path that a turtle must follow from its first pose in the window.

    `turtle` is what moves in the world: the one that it begins with unless it is given.
    """

    turtle: str = Field(default="", description="the world's first")
    circle: Circle


class Inside(Parameters):
    """The turtle touches nothing, and its centre stays `margin` m away from the edge of the field.

    It moves `at_least` m, and over an area whose longer side is at least `covers` m.
    """

    turtle: str = Field(default="", description="the world's first")
    margin: float = Field(default=0.0, ge=0)
    at_least: float = Field(default=1.0, ge=0)
    covers: float = Field(default=0.0, ge=0)


class Happens(Parameters):
    """How often something happens to the turtle, and the form of fields of the last time.

    The events of each world are [below](#worlds). `bump` must not happen (`at_most: 0`), and any
    other event must happen at least once (`at_least: 1`), unless the check gives `at_least` or
    `at_most`: `{event: spawn, turtle: turtle2, at_most: 0}` is that nobody adds this turtle.
    """

    event: Literal["pen", "spawn", "kill", "bump"]
    turtle: str = Field(default="", description="the world's first")
    at_least: int | None = Field(default=None, ge=0)
    at_most: int | None = Field(default=None, ge=0)
    each: dict[str, Form] = Field(default_factory=dict)

    @property
    def bounds(self) -> tuple[int, float]:
        """How often it happens at least and at most."""
        least, most = self.at_least, self.at_most
        if least is None:
            least = int(self.event != BUMP and most != 0)
        if most is None:
            return least, 0 if self.event == BUMP and not least else math.inf
        return least, most

    @model_validator(mode="after")
    def _can_be(self) -> Happens:
        least, most = self.bounds
        if least > most:
            raise broken(f"at_least is {least}, above at_most, which is {most:g}")
        return self


@kind("world.path", Path, after=["topic.values", "topic.period"])
def path(use: Use[Path]) -> Passed:
    """{turtle} drives along the wanted path"""
    circle = use.given.circle
    poses = _poses(use, use.given.turtle)
    expected = say(
        "a circle of {radius} m, to within {within} m",
        radius=f"{circle.radius:g}",
        within=f"{circle.within:g}",
    )
    where = use.call("publish")
    words = {"turtle": use.given.turtle, "radius": f"{circle.radius:g}"}
    put = _put_by_the_node(use, poses)
    if put is not None:
        raise Failed(
            "world.off_path",
            expected=expected,
            actual=say(
                "it is put at x={x}, y={y} at {at} s: it does not drive there",
                x=f"{put.x:.2f}",
                y=f"{put.y:.2f}",
                at=f"{put.at:.2f}",
            ),
            where=use.call("call_async", "call", "create_client"),
            words=words,
        )
    if _length(poses) < AT_REST:
        use.blocked_by("topic.publishes", "topic.values")
        raise Failed(
            "world.stands_still",
            expected=expected,
            actual=say("{turtle} stands still", turtle=use.given.turtle),
            where=where,
            words=words,
        )
    moving = _moving(poses)
    off = min(_off(moving, circle.radius * side) for side in (1, -1))
    if off <= circle.within:
        return Passed(actual=say("at most {off} m beside it", off=f"{off:.3f}"))
    radius = _radius(moving)
    actual = say("up to {off} m beside it", off=f"{off:.2f}")
    if radius is not None:
        actual = say(
            "a circle of about {radius} m: up to {off} m beside it",
            radius=f"{radius:.2f}",
            off=f"{off:.2f}",
        )
    raise Failed("world.off_path", expected=expected, actual=actual, where=where, words=words)


@kind("world.stays", Inside, after=["topic.values", "topic.period"])
def stays(use: Use[Inside]) -> Passed:
    """{turtle} never touches the wall"""
    given = use.given
    poses = _poses(use, given.turtle)
    expected = say("{turtle} drives, and never touches the wall", turtle=given.turtle)
    words = {"turtle": given.turtle}
    hit = _touching(use, poses)
    if hit is not None:
        use.blocked_by("topic.values")
        _no_garbage(use)
        before = [one for one in use.seen.messages if one.at <= hit.at]
        never = not any(
            path.endswith("angular.z") and isinstance(value, float) and abs(value) > AT_REST
            for one in before
            for path, value in _numbers(one.values)
        )
        raise Failed(
            "world.hits_wall",
            expected=expected,
            actual=say(
                "it touches the wall at {at} s, at x={x}, y={y}",
                at=f"{hit.at:.2f}",
                x=f"{hit.x:.2f}",
                y=f"{hit.y:.2f}",
            ),
            where=use.call("create_subscription"),
            words=words,
            variant="straight" if never else "",
        )
    driven = _length(poses)
    if driven < given.at_least:
        use.blocked_by("topic.publishes", "topic.values")
        raise Failed(
            "world.stands_still" if driven < AT_REST else "world.too_short",
            expected=say(
                "{turtle} drives at least {length} m",
                turtle=given.turtle,
                length=f"{given.at_least:g}",
            ),
            actual=say("it drove only {length} m", length=f"{driven:.2f}"),
            where=use.call("publish"),
            words={**words, "radius": ""},
        )
    side = max(_side(part) for part in _parts(poses))
    if side < given.covers:
        use.blocked_by("topic.publishes", "topic.values")
        raise Failed(
            "world.one_place",
            expected=say(
                "{turtle} drives over at least {side} m of the field",
                turtle=given.turtle,
                side=f"{given.covers:g}",
            ),
            actual=say("it stays within {side} m", side=f"{side:.2f}"),
            where=use.call("publish"),
            words=words,
        )
    return Passed(actual=say("it drove {length} m", length=f"{driven:.1f}"))


def _touching(use: Use[Inside], poses: Sequence[Pose]) -> Pose | None:
    """Return the first pose at which the turtle is too near the edge, or begins to touch something."""
    margin = use.given.margin
    low, high = margin, WORLDS[use.plan.world].size - margin
    bumps = [float(one["at"]) for one in _events(use, BUMP, use.given.turtle)]
    first = min(bumps, default=math.inf)
    return next(
        (p for p in poses if p.at >= first or not (low < p.x < high and low < p.y < high)), None
    )


def _events(use: Use[Parameters], event: str, turtle: str) -> list[dict[str, Any]]:
    """Return what happened to a turtle in the window."""
    of_the_world_by_itself(use)
    return [
        one
        for one in use.in_window(use.seen.events, lambda one: float(one["at"]))
        if one["kind"] == event and one["turtle"] == turtle
    ]


@kind("world.event", Happens, after=["service.calls"])
def event(use: Use[Happens]) -> Passed:
    """The event {event} comes to {turtle} as often as it should, and as it should"""
    given = use.given
    found = _events(use, given.event, given.turtle)
    least, most = given.bounds
    if len(found) > most:
        raise _too_often(use, found)
    expected = forms_in_words(given.each) or given.event
    words = {"turtle": given.turtle, "service": given.event}
    where = use.call("call_async", "call", "create_client")
    if len(found) < least or most < math.inf:
        use.require_window()
    if len(found) < least:
        use.blocked_by_call(use.use.after)
        use.blocked_by("service.calls")
        raise Failed(
            "world.not_asked",
            expected=expected if (least, most) == (1, math.inf) else _wanted(given),
            actual=_times(given.event, len(found))
            if found
            else say("nothing asked {turtle} for it", turtle=given.turtle),
            where=where,
            words=words,
        )
    if not found:
        return Passed(actual=_times(given.event, 0))
    values = found[-1]
    must_fit(values, given.each, "world.wrong_request", where=where, words=words)
    return Passed(actual=say("it came at {at} s", at=f"{values['at']:g}"))


def _wanted(given: Happens) -> Text:
    return joined(given.event, times(*given.bounds), by=": ")


def _times(event: str, count: int) -> Text:
    return say_plural("{event}: {count} time", "{event}: {count} times", count, event=event)


def _too_often(use: Use[Happens], found: Sequence[dict[str, Any]]) -> Failed:
    """Return the failure of a turtle to which something happens too often."""
    given, at = use.given, float(found[0]["at"])
    most = int(given.bounds[1])
    if given.event == BUMP:
        pose = next((one for one in _poses(use, given.turtle) if one.at >= at - EDGE), None)
        place = pose or Pose(given.turtle, at, math.nan, math.nan, math.nan)
        return Failed(
            "world.bumps",
            expected=say("{turtle} never runs into anything", turtle=given.turtle)
            if not most
            else _wanted(given),
            actual=say(
                "it runs into something at {at} s, at x={x}, y={y}",
                at=f"{at:.2f}",
                x=f"{place.x:.2f}",
                y=f"{place.y:.2f}",
            ),
            where=use.call("publish"),
            words={"turtle": given.turtle},
        )
    return Failed(
        "world.too_often",
        expected=_wanted(given),
        actual=_times(given.event, len(found)),
        where=use.call("call_async", "call", "create_client"),
        words={"turtle": given.turtle, "service": given.event},
    )


def _no_garbage(use: Use[Parameters]) -> None:
    """Raise Failed if a whole number in a field for floating-point numbers steered the turtle."""
    for message in use.seen.messages:
        for path, value in _numbers(message.values):
            if is_integer_bits(value):
                raise Failed(
                    "topic.int_in_float",
                    expected=say("a number with a point in {path}", path=path),
                    actual=say("a whole number arrived as {value}", value=f"{value:g}"),
                    where=use.field(path, topic=message.topic),
                    params={"field": path},
                    words={"topic": message.topic},
                )


def _numbers(values: object, path: str = "") -> Iterator[tuple[str, object]]:
    """Yield the fields of a message with their paths."""
    if isinstance(values, dict):
        for name, value in values.items():
            yield from _numbers(value, f"{path}.{name}" if path else name)
    else:
        yield path, values


def _poses(use: Use[Parameters], turtle: str) -> Sequence[Pose]:
    of_the_world_by_itself(use)
    use.require_window()
    own = (pose for pose in use.seen.path if pose.turtle == turtle)
    return use.in_window(own, lambda pose: pose.at)


def _length(poses: Sequence[Pose]) -> float:
    """Return how far (m) a turtle drives; where it is put elsewhere does not count."""
    steps = zip(poses, poses[1:])
    return sum(math.dist((a.x, a.y), (b.x, b.y)) for a, b in steps if not _is_put(a, b))


def _is_put(before: Pose, after: Pose) -> bool:
    """Whether a turtle was put elsewhere; older evidence shows only how far."""
    return after.put or math.dist((before.x, before.y), (after.x, after.y)) >= LONGEST_STEP


def _put_by_the_node(use: Use[Path], poses: Sequence[Pose]) -> Pose | None:
    """Return the first pose after a teleport that the plan did not ask for."""
    turtle, period = use.given.turtle, use.plan.clock.period
    own = [
        one.at
        for one in use.plan.do
        if (one.move is not None and one.move.turtle in ("", turtle))
        or (one.call is not None and one.call.service.startswith(f"/{turtle}/teleport_"))
    ]
    return next(
        (
            pose
            for pose in poses[1:]
            if pose.put and not any(at - EDGE <= pose.at <= at + period + EDGE for at in own)
        ),
        None,
    )


def _parts(poses: Sequence[Pose]) -> list[list[Pose]]:
    """Return the parts of a path between the places to which a turtle was put."""
    parts = [[poses[0]]]
    for before, after in zip(poses, poses[1:]):
        if _is_put(before, after):
            parts.append([])
        parts[-1].append(after)
    return parts


def _side(poses: Sequence[Pose]) -> float:
    """Return the longer side (m) of the area of a path."""
    across, along = [pose.x for pose in poses], [pose.y for pose in poses]
    return max(max(across) - min(across), max(along) - min(along))


def _moving(poses: Sequence[Pose]) -> Sequence[Pose]:
    """Return the poses from the last one before the turtle moves."""
    for n, (before, after) in enumerate(zip(poses, poses[1:])):
        if (before.x, before.y) != (after.x, after.y):
            return poses[n:]
    return poses


def circle_from(poses: Sequence[Pose], radius: float) -> list[tuple[float, float]]:
    """Return points of the circle that a turtle must drive, on the side to which it turns."""
    moving = _moving(poses)
    side = min((1, -1), key=lambda side: _off(moving, radius * side))
    x, y = _centre(moving[0], radius * side)
    steps = [2 * math.pi * n / CIRCLE_POINTS for n in range(CIRCLE_POINTS + 1)]
    return [(x + radius * math.cos(step), y + radius * math.sin(step)) for step in steps]


def _centre(begin: Pose, radius: float) -> tuple[float, float]:
    """Return the centre of the circle that begins at a pose; it is to the left if radius > 0."""
    return begin.x - math.sin(begin.theta) * radius, begin.y + math.cos(begin.theta) * radius


def _off(poses: Sequence[Pose], radius: float) -> float:
    """Return how far (m) poses are at most from the circle that begins at the first one.

    A positive radius turns left, a negative one right.
    """
    centre = _centre(poses[0], radius)
    return max(abs(math.dist((pose.x, pose.y), centre) - abs(radius)) for pose in poses)


def _radius(poses: Sequence[Pose]) -> float | None:
    """Return the radius (m) of the circle through three poses, None if they are on a line."""
    a, b, c = poses[0], poses[len(poses) // 3], poses[2 * len(poses) // 3]
    twice = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)
    if abs(twice) < 1e-6:
        return None
    sides = math.dist((a.x, a.y), (b.x, b.y)) * math.dist((b.x, b.y), (c.x, c.y))
    return sides * math.dist((c.x, c.y), (a.x, a.y)) / abs(2 * twice)
