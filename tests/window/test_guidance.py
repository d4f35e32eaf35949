"""What the page gets of the guide: texts as data, and the place of a mistake in the workspace."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from grader.base.errors import UsageError
from lab.config import lab_network
from lab.guide.opened import opened_lab
from lab.window.guidance import Guidance
from lab.window.markup import markup
from tests.lab.workspaces import ENTRY, PACKAGE, SETUP, SOLUTION, after_step, put

NODE = (SOLUTION / PACKAGE / "my_first_node.py").read_text(encoding="utf-8")
INNER = f"src/{PACKAGE}/{PACKAGE}/my_first_node.py"


def line_of(text: str, part: str) -> int:
    return next(n for n, line in enumerate(text.split("\n"), start=1) if part in line)


@pytest.mark.parametrize(
    ("file", "text", "part"),
    [
        (INNER, NODE.replace("def main(args=None):", "def main(args=None)"), "def main"),
        (
            f"src/{PACKAGE}/setup.py",
            SETUP.replace("ENTRY", f"'a = b.c:main'\n            {ENTRY}"),
            "'a = b.c:main'",
        ),
    ],
)
def test_a_mistake_has_its_place_in_the_workspace(
    file: str, text: str, part: str, tmp_path: Path
) -> None:
    workspace = tmp_path / "ws"
    after_step(workspace, 7, NODE)
    put(workspace, file, text)
    state = Guidance(opened_lab("en", workspace), dict).state()
    assert state["found"]
    assert state["file"] == file
    assert state["line"] in (line_of(text, part), line_of(text, part) + 1)


def test_hints_come_one_by_one(tmp_path: Path) -> None:
    workspace = tmp_path / "ws"
    after_step(workspace, 7, NODE)
    put(workspace, f"src/{PACKAGE}/setup.py", SETUP.replace("ENTRY", f"'a = b.c:main' {ENTRY}"))
    guidance = Guidance(opened_lab("en", workspace), dict)
    state = guidance.state()
    count = state["hints_left"]
    assert (state["hints"], count > 1) == ([], True)
    assert len(guidance.hint()["hints"]) == 1
    for _ in range(count):
        state = guidance.hint()
    assert (len(state["hints"]), state["hints_left"]) == (count, 0)


def test_a_text_of_a_lesson_is_data_and_never_html() -> None:
    text = (
        "<script>alert(1)</script>\n\n[a](javascript:alert(1)) [b](https://docs.ros.org) "
        "<img src=x onerror=alert(1)> ![c](https://x/y.png) `ros2 node list`\n\n```bash\n"
        "colcon build\nnothing to type\n```\n"
    )
    found = json.dumps(markup(text))
    assert '"href": "https://docs.ros.org"' in found
    assert "javascript" not in found.replace("[a](javascript:alert(1))", "")
    assert '["code", {"command": "yes"}, ["ros2 node list"]]' in found
    assert '["colcon build", true], ["nothing to type", false]' in found

    def tags(nodes: list[object]) -> set[str]:
        own = [node for node in nodes if isinstance(node, list)]
        below = [tags(node[2]) for node in own if node[0] != "code-lines"]
        return {str(node[0]) for node in own}.union(*below)

    assert tags(markup(text)) <= {"p", "a", "code", "code-lines"}


def test_an_unknown_network_is_refused_with_an_example() -> None:
    assert (lab_network({}), lab_network({"LAB_NETWORK": "host"})) == ("own", "host")
    with pytest.raises(UsageError, match="LAB_NETWORK=host make lab PAGE=1"):
        lab_network({"LAB_NETWORK": "wide"})
