"""What a run shows of a failed check besides its symptom, as facts that hold for any node.

A file of parameters names nodes, parameters and types; the run shows those of the node. A node with
a lifecycle answers each transition, and so it is known in which state it is.
"""

from __future__ import annotations

import ast
import posixpath
import re
from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

from grader.base.i18n.message import say
from grader.base.nearest import nearest
from grader.base.shown import shown
from grader.mistakes.catalogue import CATALOGUE
from grader.mistakes.recognised import RecognisedMistake
from grader.package.source.names import called_name
from grader.package.source.parameter_file import GivenValue, Section, sections_of
from grader.report.model import Where
from grader.run.observations import CREATES, refused
from grader.run.programs import full_name
from grader.verdict.checks.faults import call_in, raised_inside
from grader.verdict.checks.parsed import data_of, paths_in
from grader.verdict.node_files import source_of_node
from grader.verdict.of_node import NodeEvidence

if TYPE_CHECKING:
    from grader.package.source.node import NodeSource
    from grader.run.observations import Done, End
    from grader.verdict.evidence import Evidence
    from grader.verdict.outcome import Failed

FAMILIES = ("topic", "service", "action", "parameter", "log", "world", "run")
REFUSED_FILE = re.compile(
    r"Couldn't parse params file: .*?\. Error: (.{1,300}?)(?:, at |$)", re.MULTILINE
)
AT_LINE = re.compile(r"\bline (\d+)")
OTHER_TYPE = re.compile(
    r"Trying to set parameter '(?P<name>[^'\n]+)' to '(?P<value>[^'\n]*)' of type "
    r"'(?P<type>\w+)', expecting type '(?P<wanted>\w+)'"
)
CHANGE = "/change_state"  # the service of a node with a lifecycle
ACTIVE = 3
CALLBACKS = {1: "on_configure", 2: "on_cleanup", ACTIVE: "on_activate", 4: "on_deactivate"}
"""The callbacks of lifecycle_msgs' transitions, by their ids."""
SENT = "topic.not_silent"
UNSENT = ("topic.never_published", "topic.no_reaction", "topic.none_then", "topic.too_few")
DIED = ("run.ended_early", "run.died_at_start")


def fact_of_run(failed: Failed, evidence: Evidence) -> RecognisedMistake | None:
    """Return what the run shows as the reason why a check failed; None if it shows none."""
    symptom = failed.mistake.id
    kind = CATALOGUE.get(symptom)
    if not isinstance(evidence, NodeEvidence) or not evidence.run_name or not evidence.has_run:
        return None
    if kind is None or symptom.partition(".")[0] not in FAMILIES:
        return None
    of_file = None if kind.of_shape else _of_file(symptom, evidence)
    of_link = None if kind.of_shape else _of_quality(failed, evidence)
    return of_file or of_link or _of_lifecycle(failed, evidence)


def _of_file(symptom: str, evidence: Evidence) -> RecognisedMistake | None:
    """Return what is wrong with the file of parameters that the node was started with."""
    begin, run = evidence.begin, evidence.run
    path = _in_source(begin.params_file, evidence) if begin and begin.params_file else ""
    if begin is None or not path:
        return None
    refused = REFUSED_FILE.search(run.transcript)
    if refused is not None:
        line = AT_LINE.search(refused[0])
        where = Where(file=path, line=int(line[1]) if line else None)
        return RecognisedMistake(kind="parameter.file_refused", where=where)
    name = full_name(evidence.assignment, begin)
    sections = sections_of(data_of(evidence, path) or b"")
    mine = [one for one in sections if one.is_for(name)]
    given = [value for section in mine for value in section.values]
    if symptom in DIED:
        return _of_type(given, path, evidence)
    if symptom.startswith("run."):
        return None
    if sections and not mine:
        return _of_other_node(sections, name, path)
    return _unknown(given, name, path, evidence)


def _in_source(path: str, evidence: Evidence) -> str:
    """Return where the package has the file that it installs at a path; "" if that is not clear."""
    if data_of(evidence, path) is not None:
        return path
    name = posixpath.basename(path)
    same = [one for one in paths_in(evidence) if posixpath.basename(one) == name]
    return same[0] if len(same) == 1 else ""


def _of_type(given: list[GivenValue], path: str, evidence: Evidence) -> RecognisedMistake | None:
    found = OTHER_TYPE.search(evidence.run.transcript)
    value = next((one for one in given if found and one.name == found["name"]), None)
    if found is None or value is None:
        return None
    wanted = found["wanted"].lower()
    whole = wanted == "double" and value.text.lstrip("+-").isdecimal()
    return RecognisedMistake(
        kind="parameter.file_other_type",
        params={"name": shown(value.name), "type": found["type"].lower(), "wanted": wanted},
        words={"value": shown(value.text)},
        variant="double" if whole else "",
        where=Where(file=path, line=value.line),
    )


def _of_other_node(sections: list[Section], name: str, path: str) -> RecognisedMistake:
    by_name = {one.node: one for one in sections}
    section = by_name[nearest(name, by_name) or next(iter(by_name))]
    return RecognisedMistake(
        kind="parameter.file_other_node",
        params={"name": shown(section.node.lstrip("/"))},
        words={"node": name.lstrip("/") if name.count("/") == 1 else name},
        where=Where(file=path, line=section.line),
    )


def _unknown(
    given: list[GivenValue], name: str, path: str, evidence: Evidence
) -> RecognisedMistake | None:
    """Return the parameter of the file that the node does not declare."""
    seen = evidence.run.seen
    found = seen.parameters.get(name) if seen is not None else None
    declared = {one.name for one in found or ()}
    for value in given if found is not None else ():
        if value.name not in declared and value.name != "use_sim_time":
            close = nearest(value.name, declared - {one.name for one in given}) or ""
            return RecognisedMistake(
                kind="parameter.file_unknown",
                params={"name": shown(value.name), **({"close": close} if close else {})},
                words={"close": close},
                variant="close" if close else "",
                where=Where(file=path, line=value.line),
            )
    return None


def _of_quality(failed: Failed, evidence: Evidence) -> RecognisedMistake | None:
    """Return the end of the node past which no message goes: one side asks for more than is offered."""
    seen, begin = evidence.run.seen, evidence.begin
    if seen is None or begin is None or failed.mistake.id.startswith("run."):
        return None
    node = full_name(evidence.assignment, begin)
    for publisher in (one for one in seen.ends if one.role == "publisher"):
        for subscription in seen.ends_of("subscription", publisher.name):
            mine = [end for end in (publisher, subscription) if end.node == node]
            fits = publisher.type != subscription.type or refused(publisher, subscription) is None
            if len(mine) == 1 and not fits and _is_about(failed, mine[0]):
                where = call_in(evidence, CREATES[mine[0].role], mentions=publisher.name)
                return RecognisedMistake(kind="topic.qos_mismatch", where=where)
    return None


def _is_about(failed: Failed, end: End) -> bool:
    """Whether an end can be why a check failed: what the node hears, or the topic that is asked for."""
    topic = str(failed.words.get("topic", ""))
    of_world = failed.mistake.id.startswith("world.")
    return of_world or end.role == "subscription" or topic in ("", end.name)


class _Transition(NamedTuple):
    callback: str
    done: Done


def _of_lifecycle(failed: Failed, evidence: Evidence) -> RecognisedMistake | None:
    """Return what the answers of a node with a lifecycle show."""
    source, transitions = source_of_node(evidence), list(_transitions(evidence))
    if source is None or not transitions:
        return None
    for callback, done in transitions:
        succeeded = isinstance(done.reply, dict) and done.reply.get("success") is True
        died = done.replied is None and raised_inside(evidence, evidence.run) == "rclpy"
        if not succeeded:
            refused = done.replied is not None
            return _failed_transition(callback, done, source) if refused or died else None
    symptom, topic = failed.mistake.id, str(failed.words.get("topic", ""))
    if symptom == SENT:
        return _plain_publisher(topic, source)
    active = [one.done.at for one in transitions if one.callback == CALLBACKS[ACTIVE]]
    return _not_activated(active[0], source) if symptom in UNSENT and active else None


def _transitions(evidence: Evidence) -> Iterator[_Transition]:
    """Yield the transitions that the run asked of the node, and what became of them."""
    begin, seen = evidence.begin, evidence.run.seen
    if begin is None or seen is None:
        return
    service = full_name(evidence.assignment, begin) + CHANGE
    for one in evidence.assignment.plan(evidence.run_name).do:
        done = seen.stimulus(one.name)
        if one.call is not None and one.call.service == service and done is not None:
            asked = one.call.values.get("transition")
            asked = asked if isinstance(asked, dict) else {}
            callback = CALLBACKS.get(asked.get("id", 0)) or f"on_{asked.get('label', '')}"
            yield _Transition(callback, done)


def _failed_transition(callback: str, done: Done, source: NodeSource) -> RecognisedMistake | None:
    method = source.methods.get(callback)
    if method is None:
        return None
    returns = any(isinstance(n, ast.Return) and n.value is not None for n in ast.walk(method))
    kind = "lifecycle.failed" if returns else "lifecycle.returns_nothing"
    answer = "success: false" if done.replied is not None else say("none, the node ended")
    return RecognisedMistake(
        kind=kind,
        params={"name": callback},
        words={"at": f"{done.at:g}", "answer": answer},
        where=Where(file=source.module_of(method).path, line=method.lineno),
    )


def _not_activated(at: float, source: NodeSource) -> RecognisedMistake | None:
    """Return that the class keeps LifecycleNode from activating its publishers."""
    name = CALLBACKS[ACTIVE]
    method = source.methods.get(name)
    if method is None or not source.calls_of("create_lifecycle_publisher"):
        return None
    if any(called_name(n) == name for n in ast.walk(method) if isinstance(n, ast.Call)):
        return None
    given = method.args.args[1:2]
    return RecognisedMistake(
        kind="lifecycle.not_passed_on",
        words={"state": given[0].arg if given else "state", "at": f"{at:g}"},
        where=Where(file=source.module_of(method).path, line=method.lineno),
    )


def _plain_publisher(topic: str, source: NodeSource) -> RecognisedMistake | None:
    calls = source.calls_of("create_publisher")
    mine = [one for one in calls if topic.strip("/") in ast.unparse(one)]
    if len(mine or calls) != 1:
        return None
    call = (mine or calls)[0]
    where = Where(file=source.module_of(call).path, line=call.lineno)
    return RecognisedMistake(kind="lifecycle.plain_publisher", where=where)
