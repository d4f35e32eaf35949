"""`python -m grader.cli.update_checks_page`: writes docs/checks.md from the declared checks."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator
from typing import Any, get_args, get_origin

from pydantic import BaseModel
from pydantic.fields import FieldInfo
from pydantic_core import PydanticUndefined

from grader.base.project import CHECKOUT
from grader.course.shorthands import SHORTHANDS
from grader.course.values import KEYS, Form
from grader.course.worlds import WORLDS
from grader.verdict.checks.all import CHECKS
from grader.verdict.checks.declare import Check

COVERS = {"": " ", "files": "node", "runs": "node, runs"}
PAGE = CHECKOUT / "docs" / "checks.md"
HEAD = """\
# The checks

Made from the code by `python -m grader.cli.update_checks_page`; do not edit it by hand.

A check of an assignment has an `id`, `points` and a `visibility` (`visible`, `hidden` or
`after_due_date`). A kind with parameters is used like this, as often as you like, each time with an
id of your own:

```yaml
- id: drive.speed
  check: topic.values
  title: The turtle is as fast as asked    # what students read (default: the kind's title)
  of: circle                 # a node of the assignment (default: the first that the run starts)
  run: drives                # the run that is judged (default: the first)
  after: tighter             # a stimulus: the window begins when it is done (default: at 0 s)
  during: [0.5, 3.0]         # seconds of ROS time after that, both ends included (default: all)
  points: 10
  with: {topic: /turtle1/cmd_vel, each: {linear.x: 2.0, angular.z: {about: 2.0, within: 0.01}}}
```

A value is matched by a form:

| form | a value fits if it is |
|---|---|
| `2.0`, `"go"`, `true`, `{equal: 2.0}` | equal; a floating-point number to six digits |
| `[0, 1, 0.1]` | a list with as many items, each equal |
| `{about: 1.0, within: 0.01}` | a number at most 0.01 away |
| `{between: [0, 2]}` | a number from 0 to 2, both included |
| `{one_of: [1, 2]}` | equal to one of them; lists too: `{one_of: [[5], [0, 1]]}` |
| `{matches: 'a+'}` | a text in which Python's regular expression is found anywhere; `^a+$` is the whole text |
| `{contains: 'a text'}` | a text with this in it |
| `{from: 0, step: 1}` | 0 in the first message of the window, 1 in the next, and so on |

Only the first, the second and `one_of` fit a whole list. For one item, name it: `ranges[0]: {between: [0, 2]}`.
"""


def page() -> str:
    """Return the text of docs/checks.md."""
    assert set(KEYS) == {"equal", "about", "between", "one_of", "matches", "contains", "from"}
    lines = [HEAD, "## Kinds with parameters\n"]
    for check in CHECKS.values():
        if check.parameters is not None:
            lines += list(_kind(check, check.parameters))
    lines += list(_worlds())
    lines += [
        "## Kinds whose parameters are elsewhere in the file\n",
        "These checks need no `check:` and no `with:`.\n",
        "| id | kind | parameters |",
        "|---|---|---|",
    ]
    for name, short in SHORTHANDS.items():
        values = ", ".join(f"`{key}`: `{place}`" for key, place in short.values.items())
        lines.append(f"| `{name}` | `{short.kind}` | {values} |")
    lines += [
        "\nIn schema 2 `run.node_name` is about the `name` of each node, in each run that starts it. Only "
        "schema 1 has\n`output`, which also drives the run: there its kinds are used in this form only.\n",
        "## Checks without parameters\n",
        "One with *node* in the last column covers each node of the assignment; with *runs*, each run "
        "that starts the\nnode. With `of:` it is about that node alone.\n",
        "| id | what is checked | skipped unless | covers |",
        "|---|---|---|---|",
    ]
    for check in CHECKS.values():
        if check.parameters is None:
            depends = ", ".join(f"`{name}`" for name in check.depends) or " "
            covers = COVERS[check.covers]
            lines.append(f"| `{check.id}` | {check.title} | {depends} | {covers} |")
    return "\n".join(lines) + "\n"


def _worlds() -> Iterator[str]:
    """Yield what each world offers."""
    yield "## Worlds\n"
    yield (
        "`world:` of a run names one. Positions are in m, angles in rad; y is up, and 0 rad looks to "
        "larger x.\nA world moves in steps of 0.016 s. Where a node subscribes to what a world "
        "publishes, `/clock` shows each\nsuch step too, and the world waits until the node has run "
        "its callbacks: its commands hold from the\nnext step on.\n"
    )
    for name, world in WORLDS.items():
        x, y, theta = world.start
        yield f"### World `{name}`\n"
        yield f"{world.about}\n"
        yield (
            f"Its field is a square of {world.size:.4g} m, from (0, 0) to ({world.size:.4g}, "
            f"{world.size:.4g}). `{world.first}` begins at x {x:.4g}, y {y:.4g}, theta\n{theta:g}; "
            "`turtle:` is this one unless you name another.\n"
        )
        yield "| name | type | use |"
        yield "|---|---|---|"
        for offer in world.offers:
            yield f"| `{offer.name}` | `{offer.type}` | {offer.use} |"
        yield "\n| event | when |"
        yield "|---|---|"
        for event, when in world.events.items():
            yield f"| `{event}` | {when} |"
        yield ""


def _kind(check: Check, model: type[BaseModel]) -> Iterator[str]:
    title = re.sub(r"\{(\w+)\}", r"*\1*", check.title)
    yield f"### `{check.id}`\n"
    yield f"{title}. {inspect.cleandoc(model.__doc__ or '')}\n"
    yield "| key | type | default |"
    yield "|---|---|---|"
    for name, field in model.model_fields.items():
        default = "required" if field.is_required() else _default(field)
        yield f"| `{name}` | {_type(field.annotation)} | {default} |"
    yield ""


def _default(field: FieldInfo) -> str:
    if field.description:
        return field.description
    value = field.get_default(call_default_factory=True)
    assert value is not PydanticUndefined
    return str(value) if value not in (None, "", {}) else "none"


def _type(annotation: Any) -> str:
    """Return a type in the words of YAML."""
    if annotation is Form or annotation is Any:
        return "form"
    named = {str: "text", float: "number", int: "whole number", bool: "true or false"}
    if annotation in named:
        return named[annotation]
    arguments = get_args(annotation)
    if get_origin(annotation) is tuple and Ellipsis in arguments:
        return f"list of {_type(arguments[0])}"
    if get_origin(annotation) is dict:
        return "fields and their forms"
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        fields = annotation.model_fields.items()
        return ", ".join(f"`{name}` ({_type(field.annotation)})" for name, field in fields)
    if type(None) in arguments:
        return _type(next(one for one in arguments if one is not type(None)))
    return " or ".join(f"`{one}`" for one in arguments if one)


def main() -> None:
    """Write the page."""
    PAGE.write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main()
