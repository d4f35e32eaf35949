"""The bridge says what is on the graph and on the topics, with real nodes."""

from __future__ import annotations

import time
from typing import Any

import pytest

from tests.window.programs import Talk, bridge, nodes, turtles

pytestmark = [pytest.mark.prefix, pytest.mark.full]
EVERYTHING = ["turtle", "graph", "log", "plot", "parameters"]


def names(graph: dict[str, Any]) -> set[str]:
    return {node["name"] for node in graph["nodes"]}


def topic(graph: dict[str, Any], name: str) -> dict[str, Any]:
    return next((entry for entry in graph["topics"] if entry["name"] == name), {})


def test_the_graph_names_what_does_not_fit(talk: Talk, ros_env: dict[str, str]) -> None:
    talk.say(do="watch", views=["graph"], series=[])
    with nodes(ros_env, "talker", "listener", "sensor", "reader"):
        graph = talk.hear(
            "graph",
            lambda g: (
                names(g) == {"/talker", "/listener", "/sensor", "/reader"}
                and topic(g, "/scan").get("misfits")
                and len(topic(g, "/words").get("subscriptions", ())) == 1
                and topic(g, "/words").get("publishers")
                and g["services"]  # (the parts of the graph become known one after the other)
            ),
        )
        assert topic(graph, "/words")["misfits"] == []
        assert topic(graph, "/words")["types"] == ["std_msgs/msg/String"]
        assert [end["node"] for end in topic(graph, "/words")["publishers"]] == ["/talker"]
        assert topic(graph, "/scan")["misfits"][0]["reasons"] == [
            {"policy": "reliability", "offered": "best_effort", "requested": "reliable"}
        ]
        assert [service["name"] for service in graph["services"]] == ["/reset_reader"]
        with nodes(ros_env, "late"):
            graph = talk.hear(
                "graph",
                lambda g: topic(g, "/words").get("misfits") and g["services"][0]["clients"],
            )
            assert topic(graph, "/words")["misfits"][0]["reasons"] == [
                {
                    "policy": "type",
                    "offered": "std_msgs/msg/String",
                    "requested": "std_msgs/msg/Float64",
                }
            ]
            assert graph["services"][0]["clients"] == ["/late"]
        talk.hear("graph", lambda g: "/late" not in names(g))


def test_what_moves_is_found_and_a_time_is_not_it(talk: Talk, ros_env: dict[str, str]) -> None:
    talk.say(do="watch", views=["plot"], series=[["/a_point", "header.stamp.nanosec"]], seeks=True)
    with nodes(ros_env, "stamper", "sensor"):
        first = talk.hear("samples")["series"][0][3]
        talk.hear(
            "samples", lambda s: s["series"][0][3] != first
        )  # it comes, and only its time moves
        with nodes(ros_env, "talker"):
            found = talk.hear("moving")
    assert (found["topic"], found["field"]) == ("/wave", "data")
    talk.say(do="watch", views=[], series=[])


def test_a_turtle_moves_by_the_commands(talk: Talk, ros_env: dict[str, str]) -> None:
    talk.say(do="watch", views=["turtle"], series=[])
    with turtles(ros_env, 2):
        state = talk.hear("turtles", lambda s: len(s["turtles"]) == 2 and s["background"])
        assert state["background"] == [69, 86, 255]
        (first, x, y, theta, *_), (second, *still) = state["turtles"]
        assert (first, second) == ("/turtle1", "/turtle2")
        assert (x, y) == pytest.approx((499 / 90, 499 / 90), abs=1e-4)
        talk.say(do="drive", turtle="/turtle1", linear=2.0, angular=0.0)
        state = talk.hear("turtles", lambda s: s["turtles"][0][1] > x + 0.5)
        assert state["turtles"][0][2:5] == pytest.approx([y, theta, 2.0], abs=1e-4)
        assert state["turtles"][1] == [second, *still]
        talk.say(do="set", id=1, node="/turtlesim", name="background_r", type="integer", text="200")
        assert talk.hear("set")["done"] is True
        talk.hear("turtles", lambda s: s["background"] == [200, 86, 255])
    talk.hear("turtles", lambda s: s["turtles"] == [])


def test_a_series_has_the_numbers_that_were_published(talk: Talk, ros_env: dict[str, str]) -> None:
    talk.say(do="watch", views=["plot"], series=[["/wave", "data"], ["/scan", "data"]])
    with nodes(ros_env, "talker", "sensor"):
        wave = talk.hear("samples", lambda m: m["series"][0][:2] == ["/wave", "data"])
        at, values = wave["series"][0][2:]
        assert len(at) == len(values)
        assert all(-1 <= value <= 1 for value in values)
        assert abs(at[-1] - time.time()) < 5
        scan = talk.hear("samples", lambda m: ["/scan", "data"] in [s[:2] for s in m["series"]])
        assert {v for s in scan["series"] if s[0] == "/scan" for v in s[3]} == {7.0}
        talk.say(do="fields", id=3, topic="/wave")
        assert talk.hear("fields")["fields"] == ["data"]
        talk.say(do="fields", id=4, topic="/rosout")
        assert talk.hear("fields")["fields"] == ["stamp.sec", "stamp.nanosec", "level", "line"]


def test_the_log_has_the_records_from_before(ros_env: dict[str, str]) -> None:
    with nodes(ros_env, "talker", "listener"), bridge(ros_env) as late:
        late.say(do="watch", views=["log"], series=[])
        found: dict[str, int] = {}
        while {"a warning of the talker", "an error of the listener"} - {*found}:
            found |= {record["text"]: record["level"] for record in late.hear("log")["records"]}
        assert found["a warning of the talker"] == 30
        assert found["an error of the listener"] == 40


def test_parameters_are_read_and_set(talk: Talk, ros_env: dict[str, str]) -> None:
    talk.say(do="watch", views=["parameters"], series=[])
    with nodes(ros_env, "listener"):
        talk.hear("graph", lambda g: [n["parameters"] for n in g["nodes"]] == [True])

        def read() -> dict[str, dict[str, Any]]:
            talk.say(do="parameters", id=5, node="/listener")
            return {row["name"]: row for row in talk.hear("parameters")["rows"]}

        def change(name: str, kind: str, text: str) -> tuple[bool, str]:
            talk.say(do="set", id=6, node="/listener", name=name, type=kind, text=text)
            answer = talk.hear("set")
            return answer["done"], answer["reason"]

        rows = read()
        assert (rows["rate"]["type"], rows["rate"]["text"]) == ("double", "2.5")
        assert (rows["names"]["type"], rows["names"]["text"]) == ("string_array", '["a", "b"]')
        assert (rows["loud"]["type"], rows["loud"]["text"]) == ("bool", "false")
        talk.say(do="set", id=6, node="/listener", name="rate", type="double", text="4")
        heard = talk.hear_each("set", "parameter_event")  # the node sends the event first
        assert (heard["set"]["done"], heard["set"]["reason"]) == (True, "")
        assert heard["parameter_event"]["node"] == "/listener"
        assert change("names", "string_array", '["c"]') == (True, "")
        assert change("rate", "double", "quick") == (False, "wrong_value")
        assert change("loud", "integer", "1")[0] is False  # the node's own reason
        rows = read()
        assert [rows[name]["text"] for name in ("rate", "names")] == ["4.0", '["c"]']
        talk.say(do="parameters", id=7, node="/nobody")
        assert talk.hear("parameters")["rows"] is None


def test_it_ends_with_its_input(ros_env: dict[str, str]) -> None:
    with bridge(ros_env) as short:
        assert short.process.stdin is not None
        short.process.stdin.close()
        assert short.process.wait(10) == 0
