"""Drawn values: what the loader accepts, how they are drawn, and how checks compute with them."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.base.errors import AssignmentError
from grader.cli.mark_orders import about_the_instructors_run
from grader.course.assignment import Assignment
from grader.course.draw import Computed, Draw, combinations, extremes
from grader.course.find import assignment_file
from grader.course.load import load_assignment
from grader.run import unforeseen
from grader.run.unforeseen import drawn_for
from grader.verdict.checks.all import CHECKS
from tests.processes import ROOT

CIRCLE = (ROOT / "lab" / "course" / "draw_circle" / "assignment.yaml").read_text(encoding="utf-8")
STAY = (ROOT / "lab" / "course" / "stay_inside" / "assignment.yaml").read_text(encoding="utf-8")
LESSONS = ("draw_circle", "stay_inside", "start_stop", "own_message")
RADIUS = "radius: {between: [0.5, 1.5], step: 0.05}"
CHANGE = "change: {between: [5.0, 7.0], step: 0.5}"
WANTED = "angular.z: {about: {divide: [2.0, radius]}, within: 0.01}"


def loaded(folder: Path, *changes: tuple[str, str], text: str = CIRCLE) -> Assignment:
    """Return the assignment of a lesson with some texts replaced."""
    for old, new in changes:
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    file = folder / "assignment.yaml"
    file.write_text(text, encoding="utf-8")
    return load_assignment(file, known_checks=CHECKS)


def line_of(text: str, part: str) -> int:
    return text[: text.index(part)].count("\n") + 1


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        (RADIUS, "radius: {between: [1.5, 0.5], step: 0.05}", "low below high"),
        (RADIUS, "radius: {between: [0.5, 1.5]}", "belong together"),
        (RADIUS, "radius: {between: [0.5, 1.5], step: 0.3}", "do not lead to 1.5: write 1.4"),
        (RADIUS, "radius: {between: [0.5, 1.5], steps: 0.1}", "did you mean 'step'"),
        (RADIUS, "radius: {between: [0.5, 1.5], step: 0.00001}", "make step larger"),
        (RADIUS, "radius: {one_of: [1.0, 0.5, 1.0]}", "one_of has 1 twice"),
        (RADIUS, "radius: {one_of: [1.0]}", "always the same"),
        (RADIUS, "radius: {one_of: [1.0, small]}", "of one type"),
        (RADIUS, "radius: {between: [1.0], step: 0.1}", "between must be [low, high]"),
        (RADIUS, "radius: {between: [0.5, .inf], step: 0.1}", "between takes numbers only"),
        (RADIUS, "radius: {between: [0.5, 1.5], step: '0.1'}", "step takes numbers only"),
        (RADIUS, "radius: {one_of: [[1.0], 2.0]}", "one_of must be a list; each value is"),
        (RADIUS, "radius: {one_of: 1.0}", "one_of must be a list; each value is"),
        (RADIUS, "radius: {}", "either between and step, or one_of"),
        (RADIUS, "radius: {between: [0.0, 1.5], step: 0.5}", "divides by 0 if radius = 0"),
        (RADIUS, "radius: {between: [-1.0, 1.0], step: 0.1}", "divides by 0 if radius = 0"),
        (RADIUS, "radius: {one_of: [small, large]}", "'radius' is a text"),
        (RADIUS, "radius: {one_of: [1, 3]}", "radius is of the type double"),
        (RADIUS, f"{RADIUS}\n  spare: {{one_of: [1, 2]}}", "no run uses 'spare'"),
        (RADIUS, "radius: {between: [0.5, 2.0], step: 0.5}", "same as 'drive.speed' if radius = 2"),
        (RADIUS, "radius: {between: [0.5, 1.99], step: 0.01}", "same as 'drive.speed'"),
        (RADIUS, "radius: {one_of: [1.0, 1.001]}", "cannot tell radius = 1 and radius = 1.001"),
        (CHANGE, "change: {between: [4.0, 7.0], step: 0.25}", "write 4 or 4.5 (if change = 4.25)"),
        (CHANGE, "change: {between: [4.0, 7.5], step: 0.5}", "ends at 10.5 s"),
        (CHANGE, "change: {between: [4.0, 10.0], step: 0.5}", "the run ends at 10 s (if"),
        (CHANGE, "change: {one_of: [early, late]}", "must be a number"),
        (WANTED, WANTED.replace("divide", "devide"), "did you mean 'divide'"),
        (WANTED, WANTED.replace("radius", "radios"), "unknown drawn value 'radios' (did you mean"),
        (WANTED, WANTED.replace("[2.0, radius]", "[radius]"), "takes two values"),
        (WANTED, WANTED.replace("[2.0, radius]", "[2.0, radius, 1.0]"), "takes two values"),
        (WANTED, WANTED.replace("2.0, radius", "true, radius"), "takes two values"),
        ("at: {drawn: change}", "at: {drawm: change}", "did you mean 'drawn'"),
        ("clock: {period: 0.5,", "clock: {period: {drawn: radius},", "cannot stand here"),
        ("{name: radius, type: double}", "{name: {drawn: radius}, type: double, value: 1.0}", ""),
        (
            "start: [{node: circle}]",
            "slots: []\n    start: [{node: circle}]",
            "unknown key 'slots'",
        ),
    ],
)
def test_a_mistake_in_drawn_values_is_told_with_its_line(
    old: str, new: str, words: str, tmp_path: Path
) -> None:
    with pytest.raises(AssignmentError, match=r"assignment\.yaml:\d+:\d+: ") as raised:
        loaded(tmp_path, (old, new))
    assert words in str(raised.value)


def test_a_value_that_the_parameter_has_already_is_refused(tmp_path: Path) -> None:
    stated = ("{name: radius, type: double}", "{name: radius, type: double, value: 1.0}")
    with pytest.raises(AssignmentError, match=r"radius is 1\.0 already if radius = 1") as raised:
        loaded(tmp_path, stated)
    assert f":{line_of(CIRCLE, 'at: {drawn: change}')}:" in str(raised.value)
    given = ("start: [{node: circle}]", "start: [{node: circle, parameters: {radius: 0.75}}]")
    with pytest.raises(AssignmentError, match=r"already if radius = 0\.75"):
        loaded(tmp_path, given)
    between = (("[0.5, 1.5], step: 0.05", "[0.5, 1.5], step: 0.2"),)
    assert loaded(tmp_path, stated, *between).draw["radius"].values[-1] == 1.5


def test_only_the_lines_that_depend_on_the_draw_say_for_which_values(tmp_path: Path) -> None:
    with pytest.raises(AssignmentError) as raised:
        loaded(
            tmp_path,
            (CHANGE, CHANGE.replace("7.0", "8.0")),
            ("{id: run.spins,", "{id: run.spin,"),
        )
    one, other = str(raised.value).split("\n")[:2]
    lines = sorted((one, other), key=lambda line: "(if" in line)
    assert lines[0].endswith("(did you mean 'run.spins'?)")
    assert lines[1].endswith("(if radius = 0.5, change = 8)")


@pytest.mark.parametrize(
    ("names", "words"),
    [
        ("[anna, turtle1]", "there is a turtle 'turtle1' already"),
        ("[anna, 'a b']", "not 'a b'"),
    ],
)
def test_a_new_turtle_has_a_name_that_it_can_have(names: str, words: str, tmp_path: Path) -> None:
    changes = (
        (RADIUS, f"{RADIUS}\n  who: {{one_of: {names}}}"),
        (
            "    do:\n",
            "    do:\n      - {name: new, at: 1.0, spawn: {turtle: {drawn: who}, x: 2, y: 2}}\n",
        ),
    )
    with pytest.raises(AssignmentError) as raised:
        loaded(tmp_path, *changes)
    assert words in str(raised.value)


def test_names_poses_and_instants_of_turtles_can_be_drawn(tmp_path: Path) -> None:
    made = loaded(
        tmp_path,
        (RADIUS, f"{RADIUS}\n  who: {{one_of: [anna, ben]}}\n  x: {{between: [1, 3], step: 1}}"),
        (
            "    do:\n",
            "    do:\n      - {name: new, at: {minus: [change, 1.0]}, "
            "spawn: {turtle: {drawn: who}, x: {drawn: x}, y: {times: [x, 2]}}}\n",
        ),
        (
            "  - {id: run.interrupt",
            "  - {id: hers, check: world.stays, points: 0, with: {turtle: {drawn: who}}}\n"
            "  - {id: run.interrupt",
        ),
    )
    drawn = made.with_drawn({"radius": 1.0, "change": 5.0, "who": "ben", "x": 3})
    spawn = drawn.runs[0].do[0]
    assert (spawn.at, spawn.spawn and spawn.spawn.model_dump()) == (
        4.0,
        {"turtle": "ben", "x": 3.0, "y": 6.0, "theta": 0.0},
    )
    assert next(use.with_["turtle"] for use in drawn.checks if use.id == "hers") == "ben"


def test_the_hidden_checks_compute_with_the_same_names(tmp_path: Path) -> None:
    hidden = tmp_path / "hidden.yaml"
    own = tmp_path / "assignment.yaml"
    own.write_text(CIRCLE.replace("id: draw_circle", "id: c\nhidden_checks: 1"), encoding="utf-8")
    use = (
        "checks:\n  - {id: more, check: topic.values, of: circle, points: 1, after: tighter, "
        "during: [0.5, 3.0], with: {topic: /turtle1/cmd_vel, each: {angular.z: FORM}}}\n"
    )
    hidden.write_text(use.replace("FORM", "{divide: [2.0, radius]}"), encoding="utf-8")
    made = load_assignment(own, hidden=hidden, known_checks=CHECKS)
    assert made.drawn == {}
    drawn = made.with_drawn({"radius": 0.8, "change": 5.0})
    assert drawn.checks[-1].with_["each"] == {"angular.z": 2.5}
    hidden.write_text(use.replace("FORM", "{divide: [2.0, radios]}"), encoding="utf-8")
    with pytest.raises(AssignmentError, match=r"hidden\.yaml:2:.* \(did you mean 'radius'\?\)"):
        load_assignment(own, hidden=hidden, known_checks=CHECKS)


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ({"drawn": "a"}, 3),
        ({"plus": ["a", 0.1]}, 3.1),
        ({"minus": [0.3, {"drawn": "b"}]}, 0.2),
        ({"times": ["a", "a"]}, 9),
        ({"divide": ["a", 2]}, 1.5),
        ({"divide": [{"plus": ["a", 1]}, {"times": ["b", 20]}]}, 2.0),
    ],
)
def test_a_form_computes(form: dict[str, object], value: float) -> None:
    found = Computed.model_validate(form).of({"a": 3, "b": 0.1})
    assert found == value
    assert isinstance(found, type(value))


def test_a_draw_has_all_values_from_the_lowest_to_the_highest() -> None:
    assert Draw(between=(0.5, 0.8), step=0.1).values == (0.5, 0.6, 0.7, 0.8)
    assert Draw(between=(1, 7), step=3).values == (1, 4, 7)
    assert Draw(one_of=(3, 1, 2)).values == (1, 2, 3)
    assert Draw(one_of=("b", "a")).values == ("b", "a")


def test_a_submission_always_gets_the_same_and_another_installation_others(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    draws = load_assignment(assignment_file("stay_inside"), known_checks=CHECKS).draw
    hashes = [f"{n:064x}" for n in range(20)]
    before = [drawn_for(one, draws) for one in hashes]
    assert [drawn_for(one, draws) for one in hashes] == before
    assert len({tuple(values.items()) for values in before}) == len(hashes)
    monkeypatch.setattr(unforeseen, "installation_key", lambda: b"k" * 32)
    assert sum(drawn_for(one, draws) == old for one, old in zip(hashes, before)) == 0


def test_each_name_has_a_draw_of_its_own() -> None:
    one = Draw(between=(0, 999), step=1)
    together = drawn_for("0" * 64, {"a": one, "b": one})
    assert together["a"] != together["b"]
    assert drawn_for("0" * 64, {"b": one}) == {"b": together["b"]}


@pytest.mark.parametrize("lesson", LESSONS)
def test_every_lesson_has_more_draws_than_a_table_can_hold(lesson: str) -> None:
    made = load_assignment(assignment_file(lesson), known_checks=CHECKS)
    assert sum(1 for _ in combinations(made.draw, tuple(made.draw))) >= 20
    for values in extremes(made.draw):
        drawn = made.with_drawn(values)
        assert drawn.drawn == values
        assert drawn.sha256 == made.sha256
        for plan in drawn.runs:
            ticks = [one.at / plan.clock.period for one in plan.do]
            assert ticks == pytest.approx([round(tick) for tick in ticks])


def test_an_assignment_keeps_its_forms_on_its_way_to_another_process(tmp_path: Path) -> None:
    made = loaded(tmp_path)
    again = Assignment.model_validate_json(made.model_dump_json(by_alias=True))
    values = {"radius": 1.25, "change": 6.5}
    assert again.with_drawn(values).runs == made.with_drawn(values).runs
    assert again.with_drawn(values).checks[-5].model_dump() == (
        made.with_drawn(values).checks[-5].model_dump()
    )


def test_a_student_is_told_that_the_instructors_run_has_other_values(tmp_path: Path) -> None:
    told = "Your instructor's run has other values."
    assert told in about_the_instructors_run(loaded(tmp_path))
    first = load_assignment(assignment_file("hello_time"), known_checks=CHECKS)
    assert told not in about_the_instructors_run(first)


def test_the_drawn_values_belong_to_the_assignments_hash(tmp_path: Path) -> None:
    assert (
        loaded(tmp_path).sha256 != loaded(tmp_path, (CHANGE, CHANGE.replace("5.0", "5.5"))).sha256
    )
