"""What the facts of a followed run answer, on constructed runs."""

from __future__ import annotations

from grader.course.assignment import CheckUse
from grader.explain.facts import Facts
from grader.package.source.node import read_node
from grader.run.observations import Message, Observations
from grader.run.run import Run
from grader.run.variants import Trace, TracedDone

FILE = "robot/node.py"
TEXT = """\
class Robot(Node):
    def __init__(self):
        super().__init__('robot')
        self.declare_parameter('radius', 2.0)
        self.publisher = self.create_publisher(Bool, '/alarm', 10)
        self.pen = self.create_client(SetPen, '/pen')

    def heard(self, message):
        alarm = self.made()
        alarm.data = self.is_hot(message.data)
        self.publisher.publish(alarm)

    def is_hot(self, value):
        if value < 0:
            return False
        return value > 50

    def made(self):
        return Bool()

    def ask(self):
        request = SetPen.Request()
        request.off = 1
        self.pen.call_async(request)


def main():
    pass
"""
ORDER = {9: 1, 19: 2, 10: 3, 14: 4, 16: 5, 11: 6, 22: 7, 23: 8, 24: 9}


def facts(text: str, how: str, row: int, **use: object) -> Facts:
    """Return the facts of a run in which a line sent something once."""
    source = read_node(lambda path: text.encode() if path == FILE else None, FILE, "main")
    assert source is not None
    done = TracedDone(how, "/alarm", 10**9, ((FILE, row),), {FILE: ORDER})
    trace = Trace("time", {FILE: dict.fromkeys(ORDER, 1)}, done=(done,))
    seen = Observations(0.1, messages=[Message("/alarm", 1.0, {"data": False})])
    given = {"id": "a", "points": 1, **use}
    return Facts(source, trace, Run("ros2 run", seen=seen), CheckUse.model_validate(given))


ALARM = {"check": "topic.values", "with": {"topic": "/alarm"}}


def test_a_parameter_that_no_line_reads() -> None:
    answer = facts(TEXT, "published", 11, **ALARM).unread_parameter()
    assert answer is not None
    assert answer[0] == (FILE, 4)
    assert answer[1]["name"] == "radius"


def test_a_parameter_that_is_read_or_kept_is_not_told() -> None:
    read = TEXT.replace("value > 50", "value > self.get_parameter('radius').value")
    kept = TEXT.replace("self.declare_parameter", "self.radius = self.declare_parameter")
    for text in (read, kept):
        assert facts(text, "published", 11, **ALARM).unread_parameter() is None


def test_a_value_is_followed_to_the_line_that_returned_it() -> None:
    asked = facts(TEXT, "published", 11, **ALARM)
    asked.field, asked.wanted = "data", "true"
    answer = asked.writer_of_field()
    assert answer is not None
    assert answer[0] == (FILE, 16)
    assert (answer[1]["row"], answer[1]["value"]) == (11, "False")
    assert answer[1]["code"] == "return value > 50"


def test_a_field_of_a_message_that_another_function_makes_may_be_set_there() -> None:
    unset = TEXT.replace("        alarm.data = self.is_hot(message.data)\n", "        pass\n")
    asked = facts(unset, "published", 11, **ALARM)
    asked.field = "data"
    assert asked.unset_field() is None
    asked = facts(unset.replace("self.made()", "Bool()"), "published", 11, **ALARM)
    asked.field = "data"
    answer = asked.unset_field()
    assert answer is not None
    assert answer[1]["line"] == 11


def test_the_line_that_sets_a_field_of_a_request() -> None:
    asked = facts(TEXT, "asked", 24, check="world.event", **{"with": {"event": "pen"}})
    asked.field, asked.wanted, asked.came = "off", "0", "1"
    answer = asked.writer_of_field()
    assert answer is not None
    assert answer[0] == (FILE, 23)
    assert (answer[1]["row"], answer[1]["value"]) == (24, "1")


LAST = """\
class Meter(Node):
    def __init__(self):
        super().__init__('meter')
        self.last = None
        self.publisher = self.create_publisher(Float64, '/way', 10)

    def heard(self, pose):
        if self.last is None:
            return
        self.last = pose

    def tick(self):
        if self.last is None:
            return
        self.publisher.publish(Float64())


def main():
    pass
"""


def test_the_condition_before_the_only_line_that_sets_a_value() -> None:
    source = read_node(lambda path: LAST.encode() if path == FILE else None, FILE, "main")
    assert source is not None
    lines = {4: 1, 8: 9, 9: 9, 13: 5, 14: 5}
    use = CheckUse.model_validate({"id": "a", "points": 1, **ALARM, "with": {"topic": "/way"}})
    run = Run("ros2 run", seen=Observations(0.1))
    answer = Facts(source, Trace("time", {FILE: lines}), run, use).unset_name()
    assert answer is not None
    assert answer[0] == (FILE, 8)
    told = {name: answer[1][name] for name in ("setter", "line", "row", "head", "count")}
    assert told == {"setter": "self.last", "line": 10, "row": 8, "head": 13, "count": 9}
    ran = Trace("time", {FILE: {**lines, 10: 4}})
    assert Facts(source, ran, run, use).unset_name() is None


METER = """\
class Meter(Node):
    def __init__(self):
        super().__init__('meter')
        self.last = None
        self.way = 0.0

    def heard(self, pose):
        self.last = pose
        dx = pose.x - self.last.x
        self.way = self.way + dx

    def tick(self):
        message = Distance()
        message.way = f'{self.way:.2f}'
        message.turn = self.last.theta
        self.publisher.publish(message)


def main():
    pass
"""
WAY = {"check": "topic.values", "with": {"topic": "/way"}}


def meter(text: str = METER, **trace: object) -> Facts:
    """Return the facts of a run of `text`, of which every line ran three times."""
    source = read_node(lambda path: text.encode() if path == FILE else None, FILE, "main")
    assert source is not None
    rows = dict.fromkeys(range(1, len(text.splitlines())), 3)
    run = Run("ros2 run", seen=Observations(0.1))
    use = CheckUse.model_validate({"id": "a", "points": 1, **WAY})
    return Facts(source, Trace("time", {FILE: rows}, **trace), run, use)  # type: ignore[arg-type]


def test_a_difference_with_what_the_line_above_has_just_set() -> None:
    answer = meter().just_set()
    assert answer is not None
    assert answer[0] == (FILE, 8)
    assert (answer[1]["row"], answer[1]["code"]) == (9, "pose.x - self.last.x")
    assert answer[1]["kept"] == "self.last"


def test_a_difference_before_the_new_value_is_set_is_not_told() -> None:
    kept = "        self.last = pose\n"
    right = METER.replace(kept, "").replace("+ dx\n", f"+ dx\n{kept}")
    other = METER.replace("self.last.x", "self.last.y")
    again = METER.replace(kept, f"{kept}        pose = self.other\n")
    for text in (right, other, again):
        assert meter(text).just_set() is None


def test_a_field_of_another_type_has_its_line_and_its_type() -> None:
    error = "AssertionError: The 'way' field must be of type 'float'"
    answer = meter(raised=(error, ((FILE, 14),))).field_of_other_type()
    assert answer is not None
    assert answer[0] == (FILE, 14)
    assert answer[1] == {"line": 14, "field": "way", "type": "float"}
    other = ("AssertionError: way < 3", ((FILE, 14),))
    assert meter(raised=other).field_of_other_type() is None


def test_a_message_without_the_field_that_a_line_sets() -> None:
    error = "AttributeError: 'Distance' object has no attribute 'turn'"
    raised = (error, ((FILE, 15),))
    answer = meter(raised=raised, fields=("way", "turtle")).no_such_field()
    assert answer is not None
    assert answer[0] == (FILE, 15)
    assert (answer[1]["type"], answer[1]["fields"]) == ("Distance", "way, turtle")
    assert meter(raised=raised).no_such_field() is None


NEVER = """\
class Robot(Node):
    def __init__(self):
        super().__init__('robot')
        self.gap = None
        self.publisher = self.create_publisher(Twist, '/way', 10)

    def heard(self, scan):
        self.gap = min(scan.ranges[-3:3], default=math.inf)

    def tick(self):
        speed = 0.5
        if self.gap <= 0.9:
            speed = 0.0
        self.publisher.publish(Twist(x=speed))


def main():
    pass
"""


def test_a_condition_that_is_never_true_names_the_line_that_makes_its_value() -> None:
    ranges = {(FILE, 12): {"self.gap": (9.0, 9.0)}}
    asked = meter(NEVER, ranges=ranges)
    asked.trace.lines[FILE].update({13: 0})  # type: ignore[attr-defined]
    answer = asked.constant_from(true=False)
    assert answer is not None
    assert answer[0] == (FILE, 12)
    assert (answer[1]["name"], answer[1]["line"]) == ("self.gap", 8)
    assert answer[1]["guard"] == "self.gap <= 0.9; self.gap = 9"
    asked.trace.lines[FILE].update({8: 0})  # type: ignore[attr-defined]
    assert asked.constant_from(true=False) is None  # (only __init__ has set it)


def test_a_line_without_self_is_near_to_what_reads_the_attribute() -> None:
    asked = meter(NEVER.replace("        self.gap = min", "        gap = min"))
    assert asked.distance(FILE, 8, 8) < asked.distance(FILE, 3, 3)
