"""The words with which a shell can complete a command line: `ros2 _complete WORD...`.

The words are those after `ros2` and before the one that is being typed. What can stand in a place
follows from the name of the argument there.
"""

from __future__ import annotations

from argparse import Namespace
from importlib import import_module
from pathlib import PurePath
from typing import TYPE_CHECKING, Any

from . import graph, interfaces, parameters
from .ament_index import package_executables, package_names
from .cli import COMMANDS
from .parsing import CommandError, Parser

if TYPE_CHECKING:
    from argparse import Action
    from collections.abc import Callable, Iterable

PATIENCE = 2.0  # seconds to wait for a node's answer


def main(words: list[str]) -> None:
    """Print the words that can follow, one per line; nothing if there are none."""
    for word in complete(words):
        print(word)


def complete(words: list[str]) -> list[str]:
    """Return the words that can follow these; options come last."""
    if not words:
        return list(COMMANDS)
    if words[0] not in COMMANDS:
        return []
    command = import_module(f".{words[0]}", __package__)
    verbs: tuple[str, ...] = getattr(command, "VERBS", ())
    if verbs and not words[1:]:
        return list(verbs)
    if verbs and words[1] not in verbs:
        return []
    verb = import_module(f".{words[0]}.{words[1]}", __package__) if verbs else command
    parser = Parser(add_help=False)
    verb.add_arguments(parser)
    given, option, place = _place(parser.declared(), words[2 if verbs else 1 :])
    if option is not None:
        return _values(option, given)
    options = [name for each in parser.declared() for name in each.option_strings]
    long = sorted(name for name in options if name.startswith("--"))
    return [*_values(place, given), *long] if place is not None else long


def _place(
    declared: list[Action], words: list[str]
) -> tuple[dict[str, str], Action | None, Action | None]:
    """Return the arguments given so far, and the option or positional whose value comes next."""
    options = {name: each for each in declared for name in each.option_strings}
    left = [each for each in declared if not each.option_strings]
    given: dict[str, str] = {}
    waiting: Action | None = None
    for word in words:
        if waiting is not None:
            given[waiting.dest], waiting = word, None
        elif word in options:
            waiting = options[word] if options[word].nargs != 0 else None
        elif left and not word.startswith("-"):
            given[left[0].dest] = word
            if left[0].nargs not in ("+", "..."):
                left.pop(0)
    return given, waiting, left[0] if left else None


def _values(place: Action, given: dict[str, str]) -> list[str]:
    """Return what can stand in a place of the command line, given the arguments before it."""
    if place.choices is not None:
        return [str(choice) for choice in place.choices]
    try:
        return sorted(set(_from_packages(place.dest, given)))
    except KeyError:
        pass
    except OSError:  # nothing is sourced
        return []
    find = ON_GRAPH.get(place.dest)
    if find is None:
        return []
    try:
        with graph.graph(Namespace(spin_time=None, use_sim_time=False)) as node:
            return sorted(set(find(node, given)))
    except CommandError:
        return []


def _from_packages(name: str, given: dict[str, str]) -> Iterable[str]:
    """Return the values of an argument about installed packages; raises KeyError for others."""
    if name == "package_name":
        return package_names()
    if name == "executable_name":
        return (PurePath(path).name for path in package_executables(given["package_name"]) or ())
    kinds = {
        "topic_type": ["msg"],
        "service_type": ["srv"],
        "action_type": ["action"],
        "type": list(interfaces.KINDS),
    }
    return (each for found in interfaces.by_package(kinds[name]).values() for each in found)


def _topics(node: Any, _given: dict[str, str]) -> Iterable[str]:
    names = (name for name, _ in node.get_topic_names_and_types())
    return (name for name in names if not graph.is_hidden(name))


def _message_types(node: Any, given: dict[str, str]) -> Iterable[str]:
    types: list[str] = dict(node.get_topic_names_and_types()).get(given.get("topic_name"), [])
    return types or (name for found in interfaces.by_package(["msg"]).values() for name in found)


def _nodes(node: Any, _given: dict[str, str]) -> Iterable[str]:
    return (name for name in graph.node_names(node) if not graph.is_hidden(name))


def _services(node: Any, _given: dict[str, str]) -> Iterable[str]:
    return (name for name, _ in graph.services(node, hidden=False))


def _actions(node: Any, _given: dict[str, str]) -> Iterable[str]:
    from .actions import names_and_types  # noqa: PLC0415 (it needs rclpy)

    return (name for name, _ in names_and_types(node))


def _parameters(node: Any, given: dict[str, str]) -> Iterable[str]:
    names = Namespace(node_name=given["node_name"], include_hidden_nodes=True, timeout=PATIENCE)
    return parameters.client(node, names).names()


def _transitions(node: Any, given: dict[str, str]) -> Iterable[str]:
    from . import managed_nodes  # noqa: PLC0415 (rarely used)

    wanted = Namespace(node_name=given["node_name"], include_hidden_nodes=True)
    name = managed_nodes.named(node, wanted)
    possible = managed_nodes.transitions(node, name, timeout=PATIENCE)
    return (description.transition.label for description in possible)


ON_GRAPH: dict[str, Callable[[Any, dict[str, str]], Iterable[str]]] = {
    "topic_name": _topics,
    "message_type": _message_types,
    "node_name": _nodes,
    "service_name": _services,
    "action_name": _actions,
    "parameter_name": _parameters,
    "parameter_names": _parameters,
    "transition": _transitions,
}
