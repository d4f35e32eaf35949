"""Mistakes in whether and how long the timer runs: none, stopped, reset, under a condition."""

from __future__ import annotations

import ast
import re
from dataclasses import replace
from itertools import takewhile

from grader.base.i18n.message import msg
from grader.mistakes import links, stop_in_branch
from grader.mistakes.example import NODE, SILENT, example
from grader.mistakes.fixes import lines, node_callback, node_scope, node_timer
from grader.mistakes.fixes.case import Case
from grader.mistakes.kind import Family
from grader.mistakes.order import attribute_needed_early
from grader.mistakes.recognised import NAME_ERROR, OWN_ATTRIBUTE, Raised, RecognisedMistake, Suspect
from grader.mistakes.scope import creates_timer
from grader.mistakes.stop_in_branch import in_branch
from grader.mistakes.timer_period import TIMER
from grader.package.edit.files import Files
from grader.package.edit.tree import Replace
from grader.package.source.counter import targets_of
from grader.package.source.endless import calls_of_methods, endless_loop
from grader.package.source.module import Function
from grader.package.source.names import calls_in, dotted, last_part, own_name, parameters_of
from grader.package.source.node import NodeSource
from grader.package.source.place import block_of, function_at
from grader.package.source.until_ctrl_c import parts_until_ctrl_c


def _by_hand_early(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    early = attribute_needed_early(raised, match)
    names = {timer.method for timer in raised.source.timers} - {""}
    for call, _ in calls_in(early.needs) if early is not None else ():
        if own_name(call.func) in names:
            return raised.finding("called_by_hand", at=call)
    return None


def _outside_init(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    if match["name"] != "self" or not creates_timer(raised):
        return None
    return (
        None if function_at(raised.module, raised.line) else raised.finding("timer_at_class_level")
    )


def _missing(suspect: Suspect) -> RecognisedMistake | None:
    beside = [call for m in suspect.source.beside for call in calls_in(m.tree)]
    if suspect.source.timers or any(last_part(name) == "create_timer" for _, name in beside):
        return None
    subscribed = _subscribed(suspect)
    if subscribed is not None:
        return subscribed
    found = suspect.finding("timer_missing", suspect.source.methods.get("__init__"))
    callback = suspect.source.callback
    if suspect.source.node_class is None:
        inside = (n for n in suspect.source.all_nodes if isinstance(n, ast.FunctionDef))
        logging = [n.name for n in inside if suspect.source.logs(n) and n is not suspect.function]
        if len(logging) == 1:
            found = replace(found, words={**found.words, "callback": logging[0]})
    loop = endless_loop(suspect.source, callback) if callback is not None else None
    bodies = [s for c in suspect.source.family for s in c.body]
    no_init = not any(isinstance(s, Function) and s.name == "__init__" for s in bodies)
    variables = suspect.source.node_variables
    if loop is None and suspect.source.node_class is not None and no_init and len(variables) == 1:
        words = {**found.words, "node": min(variables)}
        return replace(found, words=words, variant="no_init")
    if loop is None:
        return found
    return replace(found, words={**found.words, "line": str(loop.lineno)}, variant="loop")


def _subscribed(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a subscription whose callback is a method that logs, and takes one message."""
    source = suspect.source
    for call in source.calls_of("create_subscription"):
        given = [*call.args[2:3], *(k.value for k in call.keywords if k.arg == "callback")]
        method = source.methods.get(own_name(given[0])) if given else None
        parameters = [a.arg for a in method.args.args[1:]] if method is not None else []
        if method is not None and source.logs(method) and len(parameters) == 1:
            new = f"self.create_timer({suspect.assignment.seconds}, self.{method.name})"
            params = {"parameter": parameters[0], "method": method.name}
            found = suspect.finding("timer_missing", call, **params)
            words = {**found.words, "line": str(method.lineno), "written": new}
            used = any(isinstance(n, ast.Name) and n.id == parameters[0] for n in ast.walk(method))
            variant = "used" if used else "published" if source.calls_of("publish") else ""
            return replace(found, variant=f"subscription_{variant}".rstrip("_"), words=words)
    return None


def _called_once(suspect: Suspect) -> RecognisedMistake | None:
    """No timer is created, and __init__ calls the method that logs."""
    source, init = suspect.source, suspect.source.methods.get("__init__")
    if source.timers or source.calls_of("create_timer"):
        return None
    if source.node_class is None:
        return _function_called_once(suspect)
    for call, _ in calls_in(init) if init is not None else ():
        method = source.methods.get(own_name(call.func))
        if method is not None and source.logs(method):
            return _by_hand_only(suspect, call, "self", f"self.{method.name}")
    return None


def _by_hand_only(
    suspect: Suspect, call: ast.Call, owner: str, callback: str
) -> RecognisedMistake | None:
    """Return that a call is all that runs the callback: how often, and what the timer gets."""
    module = suspect.source.module_of(call)
    code = module.text.code(call)
    if "\n" in code:
        return None
    given = f"lambda: {code}" if call.args or call.keywords else callback
    new = f"{owner}.create_timer({suspect.assignment.seconds}, {given})"
    found = suspect.finding("timer_missing", call, name=code, written=new)
    around = takewhile(lambda part: not isinstance(part, Function), module.around(call))
    loops = [part for part in around if isinstance(part, ast.For | ast.While)]
    if not loops:
        return replace(found, variant="by_hand")
    word = "for" if isinstance(loops[0], ast.For) else "while"
    words = {**found.words, "loop": word, "line": str(loops[0].lineno)}
    alone = len(loops[0].body) == 1 and not loops[0].orelse
    return replace(found, variant="by_loop" if alone else "in_loop", words=words)


def _function_called_once(suspect: Suspect) -> RecognisedMistake | None:
    """No timer is created, and the entry function calls the function that logs."""
    source, node = suspect.source, min(suspect.source.node_variables, default="")
    logging = {
        n.name for n in source.all_nodes if isinstance(n, ast.FunctionDef) and source.logs(n)
    }
    for call, name in calls_in(suspect.function) if suspect.function is not None else ():
        if name in logging and not call.args and node:
            return _by_hand_only(suspect, call, node, name)
    return None


def _cancelled(suspect: Suspect) -> RecognisedMistake | None:
    return _stop_of_timer(suspect, ".cancel", ".destroy_timer")


def _stopped(suspect: Suspect) -> RecognisedMistake | None:
    return _stop_of_timer(suspect, ".cancel", ".destroy_timer", logs=False)


def _stop_of_timer(suspect: Suspect, *endings: str, logs: bool = True) -> RecognisedMistake | None:
    """Look for a call that stops a timer, and that can run before spin has ended.

    With `logs`, no line came: then the callback must have one to be silent for.
    """
    source, callback = suspect.source, suspect.source.callback
    early = parts_until_ctrl_c(source)
    statements = [n.value for n in source.all_nodes if isinstance(n, ast.Expr)]
    resets = [n for n in statements if isinstance(n, ast.Attribute) and n.attr == "reset"]
    if resets:
        return None  # (the () is missing behind what starts the timer again)
    if not logs and any(name.endswith(".reset") for _, name in source.calls):
        return None  # (a line starts it again)
    if logs and _reset(suspect) is not None:
        return None  # (what starts it again and again is the reason)
    for call, name in source.calls:
        if not name.endswith(endings) or call not in early or not _is_of_timer(source, call, name):
            continue
        if logs and callback is not None and not _logs(source, callback):
            return None  # (that is a reason too)
        function = source.function_around(call)
        again = [t for t in source.timers if t.function is function and t.call.lineno > call.lineno]
        if again:
            continue
        return _with_line(suspect, call, name)
    return None


def _logs(source: NodeSource, callback: Function) -> bool:
    """Whether a callback logs, or calls a method that does."""
    inner = [method for _, method in calls_of_methods(source, callback)]
    return any(source.logs(m) or source.prints(m) for m in (callback, *inner))


def cancel_in(source: NodeSource, function: Function) -> ast.Call | None:
    """Return the call in a function, outside of its conditions, that cancels a timer for good."""
    module = source.module_of(function)
    for call, name in calls_in(function):
        statement = module.parents.get(call)
        alone = isinstance(statement, ast.Expr) and statement in function.body
        if alone and name.endswith(".cancel") and _is_of_timer(source, call, name):
            return call
    return None


def _is_of_timer(source: NodeSource, call: ast.Call, name: str) -> bool:
    """Whether a call of cancel() stops a timer, as far as its names tell."""
    owner = name.rpartition(".")[0]
    if name.endswith(".destroy_timer") or "timer" in owner.lower():
        return True
    made = {timer.call for timer in source.timers}
    if isinstance(call.func, ast.Attribute) and call.func.value in made:
        return True
    kept = [n for n in source.own_nodes if isinstance(n, ast.Assign | ast.AnnAssign)]
    names = {last_part(target) for n in kept if n.value in made for target in targets_of(n)}
    return last_part(owner) in names


def _with_line(suspect: Suspect, call: ast.Call, name: str) -> RecognisedMistake:
    """Say what to delete: only the .cancel() behind create_timer, else the line and its if."""
    found = suspect.finding("timer_cancelled", call)
    module = suspect.source.module_of(call)
    statement = module.parents.get(call)
    owner = call.func.value if isinstance(call.func, ast.Attribute) else None
    destroyed = name.endswith(".destroy_timer")
    if isinstance(owner, ast.Call):
        return found  # (create_timer(…).cancel())
    if not isinstance(statement, ast.Expr):
        return replace(found, variant="other", words={**found.words, "name": f"{name}()"})
    block, around = block_of(module, statement), module.parents.get(statement)
    branch = in_branch(suspect.source, module, statement)
    if branch is not None:
        return replace(found, variant=branch[0], words={**found.words, **branch[1]})
    if len(block) > 1:
        return replace(found, variant="destroyed" if destroyed else "line")
    alone = isinstance(around, ast.If) and around.body == block and not around.orelse
    alone = alone and isinstance(around, ast.If) and len(block_of(module, around)) > 1
    if destroyed and not alone:
        return replace(found, variant="destroyed_alone")
    return replace(found, variant="if" if alone else "alone")


def _without_cancel(case: Case) -> Files | None:
    """Delete the line that stops a timer which another line creates."""
    node, line = case.node, case.finding.line
    made = node.calls_of("create_timer") if node is not None else []
    return stop_in_branch.without_stop(case) if all(call.lineno != line for call in made) else None


def _not_started(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a timer that is created with autostart=False, and that nothing starts."""
    source = suspect.source
    if source.calls_of("reset"):
        return None
    for timer in source.timers:
        for word in timer.call.keywords:
            off = isinstance(word.value, ast.Constant) and word.value.value is False
            if word.arg == "autostart" and off:
                return suspect.finding("timer_not_started", word.value)
    return None


def _reset(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a callback of another, faster timer that resets the timer of the lines."""
    source, callback = suspect.source, suspect.source.callback
    if callback is None:
        return None
    slow = [t for t in source.timers if t.method == callback.name]
    others = [t for t in source.timers if t.method != callback.name]
    if len(slow) != 1:
        return None
    made = source.module_of(slow[0].call).parents.get(slow[0].call)
    names = set(targets_of(made)) if made is not None else set()
    for timer in others:
        method = source.methods.get(timer.method)
        for call, name in calls_in(method) if method is not None else ():
            owner = name.removesuffix(".reset")
            if owner != name and owner in names:
                found = _with_line(suspect, call, name)
                variant = "" if found.variant == "line" else "alone"
                words = {**found.words, "name": f"{name}()", "method": timer.method}
                return replace(found, kind="node.timer_reset", words=words, variant=variant)
    return None


def _only_if(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a condition that decides whether the only timer is created."""
    source = suspect.source
    timer = source.timers[0] if len(source.timers) == 1 else None
    if timer is None or timer.function is None or timer.function.name != "__init__":
        return None
    if source.callback is not None and not _logs(source, source.callback):
        return None  # (that is a reason too)
    for part in source.module_of(timer.call).around(timer.call):
        if isinstance(part, Function):
            return None
        if isinstance(part, ast.If) and not part.orelse and len(part.body) == 1:
            if isinstance(part.test, ast.Constant) or dotted(part.test).endswith("ok()"):
                return None
            test = source.module_of(part).text.code(part.test)
            params: dict[str, str | int] = {"name": test[:80], "line": part.lineno}
            return suspect.finding("timer_if", timer.call, **params)
    return None


def _other_callback(suspect: Suspect) -> RecognisedMistake | None:
    source, callback = suspect.source, suspect.source.callback
    timer = source.timers[0] if source.timers else None
    if timer is None:
        return None
    logging = [m for m in source.methods.values() if source.logs(m) and m.name != "__init__"]
    other = callback is None or all(callback.name != t.method for t in source.timers)
    named = isinstance(timer.callback, ast.Name | ast.Attribute)
    if not (timer.method and named and other and logging):
        return None
    if timer.function is not None and timer.method in parameters_of(timer.function):
        return None  # (what calls this function decides)
    return suspect.finding("timer_other_callback", timer.call, name=timer.method)


def _starts_timers(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a callback that is called by hand and makes its own timer, each time one more."""
    found = _by_hand(suspect)
    return found if found is not None and found.variant == "inside" else None


def _by_hand(suspect: Suspect) -> RecognisedMistake | None:
    source = suspect.source
    init = source.methods.get("__init__")
    names = {dotted(timer.callback) for timer in source.timers if timer.callback} - {""}
    for call, name in calls_in(init) if init else ():
        if name in names:
            found = suspect.finding("called_by_hand", call)
            found = replace(found, words={**found.words, "callback": last_part(name)})
            made = [t.call for t in source.timers if t.callback and dotted(t.callback) == name]
            around = source.function_around(made[0])
            if len(made) == 1 and around is not None and around is source.callback:
                written = source.module_of(made[0]).text.code(made[0])
                words = {**found.words, "written": " ".join(written.split())[:80]}
                return replace(found, words=words, variant="inside")
            return found
    return None


BY_LOOP = msg(
    "The {loop} of line {line} calls the method while __init__ or {function} runs, and without the "
    "pauses of a timer. Only a timer calls it again and again, once in each period."
)
SUBSCRIBED = msg(
    "A subscription calls {method} only when a message comes on its topic, and no message came. A "
    "timer calls it again and again."
)
WITHOUT_MESSAGE = msg(
    "Write {written} instead of the call of create_subscription. A timer gives its "
    "callback no message: delete {parameter} from the def in line {line}."
)
DESTROYED = msg("destroy_timer() removes a timer: it no longer calls its callback.")


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "timer_at_class_level",
        "timer",
        msg("The timer is created outside of __init__"),
        msg(
            "Lines indented directly below the class run when the class is defined; there is no "
            "self yet."
        ),
        msg("Indent the line so that it is part of __init__."),
        links.PYTHON_CLASSES,
        raised={NAME_ERROR: _outside_init},
        fixed_by=(node_scope.indented,),
        examples=(
            example(
                "timer_at_class_level",
                Replace(
                    NODE,
                    "        self.create_timer(1.0, self.timer_callback)\n",
                    "\n    self.create_timer(1.0, self.timer_callback)\n",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "timer_missing",
        "timer",
        msg("No timer is created"),
        msg("Only a timer calls the callback again and again."),
        msg("Write in __init__: self.create_timer({period}, self.{callback})"),
        whys={
            "by_hand": msg("{name} calls the method once. Only a timer calls it again and again."),
            "by_loop": BY_LOOP,
            "in_loop": BY_LOOP,
            "subscription": msg(
                "A subscription calls {method} only when a message comes on its topic, and nothing "
                "here publishes one. Only a timer calls it again and again."
            ),
            "subscription_used": SUBSCRIBED,
            "subscription_published": SUBSCRIBED,
        },
        fixes={
            "by_hand": msg("Write {written} instead of {name}."),
            "by_loop": msg("Write {written} instead of the {loop} of line {line} with its line."),
            "in_loop": msg(
                "Write {written} below the {loop} of line {line}, indented as far as the {loop}, and "
                "delete {name} in the {loop}."
            ),
            "subscription": WITHOUT_MESSAGE,
            "subscription_published": WITHOUT_MESSAGE,
            "subscription_used": msg(
                "Write {written} instead of the call of create_subscription. A timer gives its "
                "callback no message: delete {parameter} from the def in line {line}, and write "
                "something else where {method} uses {parameter}."
            ),
            "no_init": msg(
                "Write on a line of its own below the one that creates the node: "
                "{node}.create_timer({period}, {node}.{callback})"
            ),
            "loop": msg(
                "Write in __init__: self.create_timer({period}, self.{callback}) In {callback}, delete "
                "the loop of line {line} and the sleep in it, and indent its other lines as far as the "
                "loop is indented now. Delete the lines that call {callback} themselves."
            ),
        },
        behind={"run.no_lines": _missing, "run.stops": _called_once},
        fixed_by=(
            node_callback.timer_for_loop,
            lines.written,
            node_timer.subscribed,
            node_timer.made,
        ),
        examples=(
            example(
                "subscription_instead_of_the_timer",
                Replace(
                    NODE,
                    "        self.create_timer(1.0, self.timer_callback)\n",
                    "        self.subscription = self.create_subscription(\n"
                    "            String, 'topic', self.timer_callback, 10)\n"
                    "        self.subscription\n",
                ),
                Replace(NODE, "def timer_callback(self):", "def timer_callback(self, msg):"),
                Replace(
                    NODE,
                    "from rclpy.node import Node\n",
                    "from rclpy.node import Node\nfrom std_msgs.msg import String\n",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
            example(
                "callback_called_once",
                Replace(
                    NODE, "self.create_timer(1.0, self.timer_callback)", "self.timer_callback()"
                ),
                fails="run.output",
                also={"run.period": "run.by_hand"},
            ),
            example(
                "timer_missing_in_a_class_without_init",
                Replace(
                    NODE,
                    "    def __init__(self):\n"
                    "        super().__init__('my_first_node')\n"
                    "        self.counter_ = 0\n"
                    "        self.create_timer(1.0, self.timer_callback)\n",
                    "    counter_ = 0\n",
                ),
                Replace(NODE, "node = MyFirstNode()", "node = MyFirstNode('my_first_node')"),
                fails="run.output",
                blocks=SILENT,
            ),
            example(
                "timer_missing",
                Replace(NODE, "        self.create_timer(1.0, self.timer_callback)\n", ""),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
    _node(
        "timer_cancelled",
        "timer",
        msg("The timer is stopped"),
        msg("cancel() and destroy_timer() stop a timer: it no longer calls its callback."),
        msg("Remove the .cancel()."),
        whys={
            "destroyed": DESTROYED,
            "destroyed_alone": DESTROYED,
        },
        fixes={
            "line": msg("Delete this line."),
            "destroyed": msg("Delete this line."),
            "destroyed_alone": msg("Write pass instead of this line."),
            "if": msg("Delete this line and the if above it."),
            "alone": msg("Write pass instead of this line."),
            "other": msg("Remove {name} from this line."),
            **stop_in_branch.FIXES,
        },
        behind={"run.no_lines": _cancelled, "run.stops": _stopped},
        fixed_by=(node_timer.cancelled, _without_cancel, lines.passed),
        examples=(
            example(
                "timer_cancelled",
                Replace(
                    NODE,
                    "self.create_timer(1.0, self.timer_callback)",
                    "self.create_timer(1.0, self.timer_callback).cancel()",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
            example(
                "cancel_in_the_if_of_an_else_that_logs",
                Replace(
                    NODE,
                    "self.create_timer(1.0, self.timer_callback)",
                    "self.timer_ = self.create_timer(1.0, self.timer_callback)",
                ),
                Replace(
                    NODE,
                    "        self.get_logger().info('Hello time: ' + str(self.counter_))\n"
                    "        self.counter_ += 1\n",
                    "        if self.counter_ >= 3:\n"
                    "            self.timer_.cancel()\n"
                    "        else:\n"
                    "            self.get_logger().info('Hello time: ' + str(self.counter_))\n"
                    "            self.counter_ += 1\n",
                ),
                fails="run.output",
            ),
            example(
                "three_then_silence",
                Replace(
                    NODE,
                    "self.create_timer(1.0, self.timer_callback)",
                    "self.timer_ = self.create_timer(1.0, self.timer_callback)",
                ),
                Replace(
                    NODE,
                    "self.counter_ += 1",
                    (
                        "self.counter_ += 1\n"
                        "        if self.counter_ == 3:\n"
                        "            self.timer_.cancel()"
                    ),
                ),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "timer_reset",
        "timer",
        msg("The timer begins again before its period has passed"),
        msg(
            "reset() begins the period of the timer again. Another timer calls {method}, so {name} "
            "runs again and again, and the period does not come to its end."
        ),
        msg("Delete this line."),
        fixes={"alone": msg("Write pass instead of this line.")},
        behind={"run.no_lines": _reset},
        fixed_by=(lines.passed, lines.deleted),
        examples=(
            example(
                "timer_reset_by_other_timer",
                Replace(
                    NODE,
                    "        self.create_timer(1.0, self.timer_callback)\n",
                    "        self.timer_ = self.create_timer(1.0, self.timer_callback)\n"
                    "        self.create_timer(0.25, self.look_after)\n",
                ),
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    def look_after(self):\n"
                    "        self.timer_.reset()\n\n"
                    "    def timer_callback",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
    _node(
        "timer_not_started",
        "timer",
        msg("The timer is created, but not started"),
        msg("With autostart=False a timer calls nothing until its reset() is called."),
        msg("Delete autostart=False and the comma before it: the timer then starts by itself."),
        behind={"run.no_lines": _not_started},
        fixed_by=(node_timer.started,),
        examples=(
            example(
                "timer_without_autostart",
                Replace(NODE, "self.timer_callback)", "self.timer_callback, autostart=False)"),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
    _node(
        "timer_if",
        "timer",
        msg("The timer is only created if a condition is true"),
        msg(
            "This line only runs if {name} is true when the node is created (line {line}). Without "
            "the timer nothing calls the callback."
        ),
        msg("Delete the if on line {line}, and indent this line as far as the if is indented now."),
        behind={"run.no_lines": _only_if},
        fixed_by=(node_timer.without_if,),
        examples=(
            example(
                "timer_under_flag",
                Replace(
                    NODE,
                    "        self.create_timer(",
                    "        self.running = False\n"
                    "        if self.running:\n"
                    "            self.create_timer(",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
    _node(
        "timer_other_callback",
        "timer",
        msg("The timer calls another method"),
        msg("The timer calls the method that it gets, and no other."),
        TIMER,
        behind={"run.no_lines": _other_callback},
        examples=(
            example(
                "callback_is_another",
                Replace(NODE, "self.timer_callback)", "self.get_name)"),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
    _node(
        "called_by_hand",
        "timer",
        msg("__init__ calls the callback itself"),
        msg("The timer makes the first call after one period; your own call comes too early."),
        msg("Remove the line self.{callback}() from __init__."),
        whys={
            "inside": msg(
                "{callback} makes the timer itself: each call makes one more timer, and the first "
                "call comes too early."
            )
        },
        fixes={
            "inside": msg(
                "Write {written} in __init__ instead of self.{callback}(), and delete the "
                "create_timer from {callback}."
            )
        },
        raised={OWN_ATTRIBUTE: _by_hand_early},
        behind={"run.by_hand": _by_hand, "run.twice": _starts_timers},
        fixed_by=(node_timer.by_hand,),
        deletes=("",),
        examples=(
            example(
                "called_by_hand_before_counter",
                Replace(
                    NODE,
                    "        self.counter_ = 0\n",
                    "        self.timer_callback()\n        self.counter_ = 0\n",
                ),
                fails="run.starts",
            ),
            example(
                "called_by_hand",
                Replace(
                    NODE,
                    "self.create_timer(1.0, self.timer_callback)",
                    ("self.create_timer(1.0, self.timer_callback)\n        self.timer_callback()"),
                ),
                fails="run.period",
            ),
        ),
    ),
)
