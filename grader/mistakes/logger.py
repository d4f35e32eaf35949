"""Mistakes in logging: the logger, its calls, their level and their number."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links, print_elsewhere
from grader.mistakes.example import (
    DEAD,
    LOG,
    LOG_LINE,
    NODE,
    PARTIAL_IMPORTED,
    SILENT,
    STEP_LINE,
    example,
)
from grader.mistakes.fixes import lines, node_count, node_log, node_words, node_worked_out
from grader.mistakes.kind import Family
from grader.mistakes.own_topic import logs_what_it_hears
from grader.mistakes.recognised import FromSource, Raised, RecognisedMistake, Suspect, first_of
from grader.mistakes.worked_out import INSTEAD, worked_out
from grader.package.edit.tree import Replace
from grader.package.source.after_spin import calls_after_spin
from grader.package.source.counter import targets_of
from grader.package.source.module import Function
from grader.package.source.names import called_name, calls_in, dotted, last_part, own_name
from grader.package.source.node import LOG_METHODS, NodeSource
from grader.package.source.place import block_of, statement_at
from grader.package.source.played import SHOWN_LEVELS, played
from grader.package.source.printed import as_log, imitates_record, writes_line


def _arguments(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The logger gets several strings, which only print accepts."""
    del match
    calls = (call for call, _ in raised.source.calls if raised.source.is_log(call))
    logs = [call for call in calls if len(call.args) > 1]
    if not logs and not raised.inside:
        logs = [
            c for c, _ in raised.source.calls if c.lineno == raised.line and _is_alias(raised, c)
        ]
    if not logs and not raised.inside:
        return _passed_on(raised) or _of_partial(raised)
    return raised.finding("logger_arguments", at=logs[0]) if logs else None


def _passed_on(raised: Raised) -> RecognisedMistake | None:
    """A function gives the logger all values that it gets, and its only call has several."""
    logs = [
        call
        for call, _ in raised.source.calls
        if call.lineno == raised.line and raised.source.is_log(call)
    ]
    around = raised.source.function_around(logs[0]) if len(logs) == 1 else None
    given = logs[0].args if len(logs) == 1 else []
    values = around.args.vararg.arg if around is not None and around.args.vararg else ""
    if around is None or not values or len(given) != 1:
        return None
    if not isinstance(given[0], ast.Starred) or dotted(given[0].value) != values:
        return None
    calls = [c for c, name in raised.source.calls if last_part(name) == around.name]
    first = len([a for a in around.args.args if a.arg not in ("self", "cls")])
    if len(calls) != 1 or len(calls[0].args) - first < 2:
        return None
    found = raised.finding("logger_arguments", at=calls[0])
    words = {**found.words, "function": around.name, "line": str(logs[0].lineno)}
    return replace(found, words=words, variant="passed_on")


def _of_partial(raised: Raised) -> RecognisedMistake | None:
    """The line calls a partial of info, which gives the logger a text of its own."""
    here = [call for call, _ in raised.source.calls if call.lineno == raised.line]
    for statement in (n for n in raised.source.own_nodes if isinstance(n, ast.Assign)):
        made = statement.value
        if not isinstance(made, ast.Call) or last_part(dotted(made.func)) != "partial":
            continue
        method = made.args[0] if len(made.args) == 2 else None
        if not isinstance(method, ast.Attribute) or method.attr not in LOG_METHODS:
            continue
        names = [name for name in map(dotted, statement.targets) if name]
        calls = [call for call in here if dotted(call.func) in names and len(call.args) == 1]
        if len(calls) != 1:
            continue
        code = raised.source.module_of(made).text.code
        text, given = (
            code(made.args[1]),
            raised.source.module_of(calls[0]).text.code(calls[0].args[0]),
        )
        found = raised.finding("logger_arguments", at=calls[0], name=dotted(calls[0].func))
        words = {
            **found.words,
            "line": statement.lineno,
            "written": f"{code(method)}({text} + {given})",
            "text": text,
        }
        return replace(found, words=words, variant="partial")
    return None


def _is_alias(raised: Raised, call: ast.Call) -> bool:
    """Whether a call with several values is one of a name that got a method of a logger."""
    values = [
        n.value
        for n in raised.source.own_nodes
        if isinstance(n, ast.Assign) and dotted(call.func) in map(dotted, n.targets)
    ]
    value = values[0] if len(values) == 1 else None
    method = isinstance(value, ast.Attribute) and value.attr in LOG_METHODS
    logger = dotted(value.value) if isinstance(value, ast.Attribute) else ""
    known = logger in raised.source.loggers or logger.endswith("get_logger()")
    return method and known and len(call.args) > 1


def _not_called(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """get_logger lacks its (): where it is used, or where a variable or an attribute gets it."""
    kept = raised.source.loggers
    used = [
        dotted(node.value)
        for node in raised.module.nodes
        if isinstance(node, ast.Attribute) and node.lineno == raised.line
    ]
    for name in used:
        value = kept[name].value if name in kept else None
        if value is not None and not isinstance(value, ast.Call):
            found = raised.finding("logger_not_called", at=kept[name])
            written = f"{name} = {ast.unparse(value)}()"
            words = {**found.words, "name": name, "written": written}
            return replace(found, variant="kept", words=words)
    on_line = [name for name in used if name]
    if on_line and all(last_part(name) != "get_logger" for name in on_line):
        return None  # (another function is not called)
    found = raised.finding("logger_not_called")
    name = next((n for n in on_line if last_part(n) == "get_logger"), "self.get_logger")
    written = f"{name}().{match['name']}(…)"
    return replace(found, words={**found.words, "logged": written})


def _missing(suspect: Suspect) -> RecognisedMistake | None:
    source, callback = suspect.source, suspect.source.callback
    if callback is None:
        return _missing_in_lambda(suspect)
    if source.logs(callback) or source.prints(callback):
        return None
    for node in ast.walk(callback):
        target = node.targets[0] if isinstance(node, ast.Assign) else None
        if target is not None and dotted(target).endswith("get_logger().info"):
            return replace(suspect.finding("log_missing", target), variant="assigned")
    named = node_log.named_only(callback)
    if named is not None:
        code = source.module_of(callback).text.code(named[0])
        found = suspect.finding("log_missing", named[0])
        words = {**found.words, "name": code, "line": str(named[1].lineno)}
        return replace(found, words=words, variant="named")
    if _logs_further(source, callback) or logs_what_it_hears(source):
        return None
    if any(last_part(t) == callback.name for n in source.all_nodes for t in targets_of(n)):
        return None  # (another function takes its place)
    if any(map(_calls_a_value, (callback, *source.methods.values()))):
        return None
    if (late := _logs_after_spin(suspect, callback)) is not None:
        return late
    if _logs_the_count_elsewhere(suspect, callback):
        return None  # (a value that the callback calls may be that function)
    found = suspect.finding("log_missing", callback)
    if callback in source.methods.values():
        return found
    owner = _node_in(source, callback)
    words = {**found.words, "name": callback.name, "written": f"{owner}.get_logger().info(…)"}
    return replace(found, words=words, variant="function" if owner else "function_only")


def _calls_a_value(callback: Function) -> bool:
    """Whether a callback calls what it has looked up, such as a function of a dict."""
    own = {
        n.id for n in ast.walk(callback) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)
    }
    calls = [n.func for n in ast.walk(callback) if isinstance(n, ast.Call)]
    return any(isinstance(f, ast.Subscript | ast.Call) or dotted(f) in own for f in calls)


def _logs_after_spin(suspect: Suspect, callback: Function) -> RecognisedMistake | None:
    """Look for a method that logs, and that only lines below spin call."""
    source = suspect.source
    for call, spin in calls_after_spin(source):
        method = source.methods.get(own_name(call.func) or last_part(dotted(call.func)))
        calls = [c for c, name in source.calls if method and last_part(name) == method.name]
        if method is None or not source.logs(method) or calls != [call]:
            continue
        if callback not in source.methods.values():
            continue
        found = suspect.finding("log_missing", call)
        words = {
            **found.words,
            "method": f"self.{method.name}()",
            "callback": callback.name,
            "line": spin.lineno,
        }
        return replace(found, words=words, variant="after_spin")
    return None


def _severity_changed(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    return raised.finding("severity_changed", line=str(raised.line)) if raised.line else None


def _levels_in_loop(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a loop over levels that logs the line with each: a distro may allow that."""
    source = suspect.source
    for loop in ast.walk(source.callback) if source.callback is not None else ():
        if not isinstance(loop, ast.For):
            continue
        for call, _ in calls_in(loop):
            method = call.func
            if isinstance(method, ast.Call) and dotted(method.func) == "getattr" and method.args:
                by_loop = dotted(loop.target) == dotted(method.args[-1])
                if by_loop and "log" in ast.unparse(method.args[0]).lower():
                    found = suspect.finding("severity_changed", loop, line=call.lineno)
                    return replace(found, variant="loop")
    return None


def _logs_the_count_elsewhere(suspect: Suspect, callback: Function) -> bool:
    """Whether a function that is given to something as a value logs the line of the count."""
    source = suspect.source
    head = suspect.output.text.split("{n}")[0].strip().lower()
    for module in source.known_modules:
        values = {dotted(n) for n in module.nodes if isinstance(n, ast.Name | ast.Attribute)}
        values -= {dotted(c.func) for c in module.nodes if isinstance(c, ast.Call)}
        for function in (n for n in module.nodes if isinstance(n, Function) and n is not callback):
            parts = [n for call in source.logs(function) for n in ast.walk(call)]
            texts = [str(n.value).lower() for n in parts if isinstance(n, ast.Constant)]
            if any(head in t for t in texts) and function.name in map(last_part, values):
                return True
    return False


def _logs_further(source: NodeSource, part: ast.AST) -> bool:
    """Whether a part of the source calls something that logs or prints, or that may do so.

    Of a logger that is a value, as in getattr(self.get_logger(), level), and of a function that is
    kept in an attribute, it is not known what they do.
    """
    modules = (*source.modules, *source.beside)
    functions = [n for module in modules for n in module.nodes if isinstance(n, Function)]
    names = {called_name(call) for call, _ in calls_in(part)}
    kept = {own_name(call.func) for call, _ in calls_in(part)} & source.attributes
    parents = source.module_of(part).parents
    given = [
        call
        for call, name in calls_in(part)
        if last_part(name) == "get_logger" and not isinstance(parents.get(call), ast.Expr)
    ]
    if kept - set(source.methods) or given or "getattr" in names:
        return True
    named = [f for f in functions if f.name in names and f is not part]
    return any(source.logs(f) or source.prints(f) for f in named)


def _node_in(source: NodeSource, function: Function) -> str:
    """Return the name that the node has in a function which a timer calls; "" if it is unknown."""
    around = source.function_around(function)
    if around is not None and around in source.methods.values():
        return "self"
    for timer in source.timers:
        given = timer.callback.args[1:] if isinstance(timer.callback, ast.Call) else []
        for parameter, value in zip(function.args.args, given):
            if dotted(value) in {"self", *source.node_variables}:
                return parameter.arg
    return ""


def _missing_in_lambda(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a lambda as the callback that returns a text and does not log it."""
    source = suspect.source
    timer = source.timers[0] if len(source.timers) == 1 else None
    given = timer.callback if timer is not None else None
    if not isinstance(given, ast.Lambda) or source.logs(given) or source.prints(given):
        return None
    method = (
        source.methods.get(own_name(given.body.func)) if isinstance(given.body, ast.Call) else None
    )
    if method is not None and not (source.logs(method) or source.prints(method)):
        return None if _logs_further(source, method) else suspect.finding("log_missing", method)
    if not isinstance(given.body, ast.BinOp | ast.JoinedStr) or _logs_further(source, given):
        return None
    known = source.loggers_at(given)
    code = source.module_of(given).text.code(given.body)
    inside = source.function_around(given) in source.methods.values()
    own = known[0] if known else "self.get_logger()" if inside else ""
    if not own or "\n" in code:
        return None
    found = suspect.finding("log_missing", given)
    words = {**found.words, "name": code, "written": f"{own}.info({code})"}
    return replace(found, words=words, variant="lambda")


def _debug(suspect: Suspect) -> RecognisedMistake | None:
    source = suspect.source
    callback = source.callback
    logs = source.logs(callback) if callback is not None else []
    debug = [log for log in logs if dotted(log.func).endswith(".debug")]
    if debug:
        fit = [log for log in debug if _can_begin(log, suspect.output.line(0))]
        return suspect.finding("debug_level", fit[0]) if fit else None
    # (in a lambda or a helper, of a logger that a parameter is; the only line that is logged)
    found = _methods_of_loggers(source)
    if len(found) != 1 or found[0].attr != "debug":
        hidden = _logged_hidden(suspect)
        return suspect.finding("debug_level", hidden) if hidden is not None else None
    module = source.module_of(found[0])
    name = module.text.code(found[0])
    written = f"{name.removesuffix('debug')}info"
    mistake = suspect.finding("debug_level", found[0], name=name, written=written)
    return replace(mistake, variant="written")


def _logged_hidden(suspect: Suspect) -> ast.Call | None:
    """Return the call of debug that the first callbacks come to, if the program can be worked out."""
    source = suspect.source
    if source.module is not source.entry or source.main is None:
        return None
    lines = played(source.module.tree, source.main.name, 3, (*SHOWN_LEVELS, "debug")) or []
    calls = {line.call for line in lines}
    hidden = [call for call in calls if last_part(dotted(call.func)) == "debug"]
    return hidden[0] if len(calls) == len(hidden) == 1 else None


def _can_begin(log: ast.Call, line: str) -> bool:
    """Whether a log can write a line, as far as the text tells with which its value begins."""
    first: ast.AST | None = log.args[0] if log.args else None
    while first is not None and not isinstance(first, ast.Constant):
        if isinstance(first, ast.BinOp):
            first = first.left
        elif isinstance(first, ast.JoinedStr):
            first = first.values[0] if first.values else None
        elif isinstance(first, ast.Call) and called_name(first) == "format":
            first = first.func.value if isinstance(first.func, ast.Attribute) else None
        else:
            return True  # (a name: its value is not known here)
    text = first.value if isinstance(first, ast.Constant) else ""
    begin = text.strip()[:3].casefold() if isinstance(text, str) else ""
    return begin[:1] in ("%", "{", "") or line.casefold().startswith(begin)


def _methods_of_loggers(source: NodeSource) -> list[ast.Attribute]:
    """Return where the files name a method of a logger, called or not."""
    loggers = {*source.loggers, *_parameters_for_loggers(source)}
    return [
        node
        for node in source.own_nodes
        if isinstance(node, ast.Attribute)
        and node.attr in LOG_METHODS
        and (dotted(node.value) in loggers or dotted(node.value).endswith("get_logger()"))
    ]


def _parameters_for_loggers(source: NodeSource) -> set[str]:
    """Return the parameters of the node's methods that get a logger in a call."""
    found: set[str] = set()
    for call, _ in source.calls:
        method = source.methods.get(own_name(call.func))
        names = [given.arg for given in method.args.args[1:]] if method is not None else []
        for name, value in zip(names, call.args):
            if dotted(value) in source.loggers or dotted(value).endswith("get_logger()"):
                found.add(name)
    return found


def _twice(suspect: Suspect) -> RecognisedMistake | None:
    source, callback = suspect.source, suspect.source.callback
    if callback is None:
        return None
    logs = [*source.logs(callback), *source.prints(callback)]
    if len(logs) <= 1:
        return None
    beside = _print_beside(source, callback)
    if len(logs) == 2 and beside is not None:
        found = suspect.finding("logs_twice", beside)
        return replace(found, variant="printed")
    return suspect.finding("logs_twice", sorted(logs, key=lambda call: call.lineno)[1])


def _print_beside(source: NodeSource, part: ast.AST) -> ast.Call | None:
    """Return the print() of a text that the logger logs as well, wherever the print() is reached."""
    logs = [call for call in source.logs(part) if called_name(call) != "debug"]
    logs = [call for call in logs if len(call.args) == 1 and source.is_own_log(call)]
    for call in source.prints(part):
        same = [log for log in logs if call.args[1:] == [] and _are_same(log, call)]
        if any(_is_beside(source, log, call) for log in same):
            return call
    return None


def _are_same(log: ast.Call, call: ast.Call) -> bool:
    return bool(call.args) and ast.dump(call.args[0]) == ast.dump(log.args[0])


def _is_beside(source: NodeSource, log: ast.Call, call: ast.Call) -> bool:
    """Whether a log stands in the block of a call, or in one around it: it is no other branch."""
    module = source.module_of(log)
    statement = statement_at(module, log.lineno)
    return statement is not None and any(
        part in block_of(module, statement)
        for part in module.around(call)
        if isinstance(part, ast.stmt)
    )


def _print_inside(suspect: Suspect, call: ast.Call, given: ast.Call) -> RecognisedMistake:
    """Return that the logger gets what print returns; print joins its values with spaces."""
    if len(given.args) == 1 and not given.keywords:
        return replace(suspect.finding("print_used", given), variant="inside")
    text, log = suspect.source.module_of(given).text, as_log(suspect.source, given)
    if log is None or len(call.args) != 1:
        return replace(suspect.finding("print_used", given), variant="inside_several")
    found = suspect.finding("print_used", given, name=text.code(call), written=log)
    return replace(found, variant="inside_written")


def _printed(suspect: Suspect) -> RecognisedMistake | None:
    callback = suspect.source.callback
    prints = suspect.source.prints(callback) if callback is not None else []
    prints = prints or [call for call, name in suspect.source.calls if name == "print"]
    for call in suspect.source.own_logs:
        for given in call.args:
            if isinstance(given, ast.Call) and dotted(given.func) == "print":
                return _print_inside(suspect, call, given)
    if not prints:
        return None
    beside = _print_beside(suspect.source, callback) if callback is not None else None
    if beside is not None:
        return replace(suspect.finding("print_used", beside), variant="beside")
    elsewhere = print_elsewhere.printed_outside(suspect, prints[0])
    if elsewhere is not None and not suspect.source.own_logs:
        return elsewhere
    written = as_log(suspect.source, prints[0])
    if written is None or suspect.source.own_logs:
        return suspect.finding("print_used", prints[0])
    code = suspect.source.module_of(prints[0]).text.code(prints[0])
    found = suspect.finding("print_used", prints[0], name=code, written=written)
    return replace(found, variant="written")


def _written(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a line that is written without print()."""
    source = suspect.source
    prints = any(name == "print" for _, name in source.calls)
    return None if prints or source.own_logs else _imitated(suspect)


def _imitated(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the only call that writes a text that begins as a log record does."""
    calls = [call for call, _ in suspect.source.calls]
    if any(_publishes_records(call) for call in calls):
        return None  # (what is written to the terminal is only half of it)
    found = [call for call in calls if imitates_record(call)]
    found = found or [call for call in calls if writes_line(call)]
    if len(found) != 1:
        return None
    call = found[0]
    written = as_log(suspect.source, call)
    if written is None:
        return suspect.finding("written_without_logger", call)
    code = suspect.source.module_of(call).text.code(call)
    mistake = suspect.finding("written_without_logger", call, name=code, written=written)
    return replace(mistake, variant="written")


def _publishes_records(call: ast.Call) -> bool:
    """Return whether a call makes a publisher of /rosout, the topic of the logger."""
    given = [*call.args, *(keyword.value for keyword in call.keywords)]
    texts = [value.value for value in given if isinstance(value, ast.Constant)]
    return last_part(dotted(call.func)) == "create_publisher" and "/rosout" in texts


def _is_shorter(suspect: Suspect, option: node_words.Option) -> bool:
    """Whether an option is a time after which the next line is due at the earliest: it leaves out none."""
    seconds = option.value.value if isinstance(option.value, ast.Constant) else None
    if option.name != "throttle_duration_sec" or not isinstance(seconds, int | float):
        return False
    return seconds < suspect.period


def _left_out(*options: str) -> FromSource:
    """Return a function that finds one of these options in the calls of the logger."""

    def found(suspect: Suspect) -> RecognisedMistake | None:
        option = node_words.log_option(suspect.source, *options)
        if option is None or _is_shorter(suspect, option):
            return None
        mistake = suspect.finding("log_option", option.call, name=option.name)
        return replace(
            mistake, variant=option.name, words={**mistake.words, "written": option.code}
        )

    return found


INSIDE = msg(
    "print() writes the text to this terminal and returns None, so the logger gets None instead of "
    "the text."
)
BESIDE = msg("Delete this print(…): the logger logs the same text.")
_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "logger_not_called",
        "logger",
        msg("The () after get_logger is missing"),
        msg("get_logger is a method: only calling it gives the logger."),
        msg("Write {logged}."),
        links.LOGGING,
        whys={
            "kept": msg(
                "get_logger is a method: only calling it gives the logger. This line gives {name} "
                "the method itself, which logs nothing."
            )
        },
        fixes={"kept": msg("Write {written} in this line.")},
        seen=r"AttributeError: '(?:function|method)' object has no attribute "
        r"'(?:info|debug|warn|warning|error|fatal)'",
        raised={
            r"'(?:function|method)' object has no attribute '(?P<name>info|debug|warn|warning|error|fatal)'": _not_called
        },
        fixed_by=(node_log.logger_call,),
        examples=(
            example(
                "get_logger_not_called",
                Replace(NODE, "self.get_logger().info", "self.get_logger.info"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "get_logger_kept_not_called",
                Replace(
                    NODE,
                    "        self.counter_ = 0\n",
                    "        self.log = self.get_logger\n        self.counter_ = 0\n",
                ),
                Replace(NODE, "self.get_logger().info", "self.log.info"),
                fails="run.output",
                blocks=DEAD,
                note="the traceback shows the callback, not the line to change",
            ),
        ),
    ),
    _node(
        "logger_arguments",
        "logger",
        msg("The logger gets more than one value"),
        msg("info() takes one string. print() takes several with commas, the logger does not."),
        msg("Make one string of them: {sum}, or an f-string."),
        links.LOGGING,
        whys={
            "partial": msg(
                "{name} gives info() the text {text} (line {line}), and this line gives it another value. "
                "info() takes one string."
            ),
            "passed_on": msg(
                "{function} gives all values of this call to info() in line {line}. info() takes one "
                "string, and puts no values into it."
            ),
        },
        fixes={
            "partial": msg("Make one string of both, for example: {written}"),
            "passed_on": msg(
                "Make one string of the values in this call, as an f-string does, and give {function} "
                "only this string."
            ),
        },
        seen=r"\.info\(\) takes 2 positional arguments but \d{1,3} were given",
        raised={
            r"takes (?:from \d{1,3} to )?\d{1,3} positional arguments? but \d{1,3} were given": _arguments
        },
        fixed_by=(node_log.comma,),
        examples=(
            example(
                "partial_of_info_with_a_text",
                PARTIAL_IMPORTED,
                Replace(
                    NODE,
                    "self.counter_ = 0",
                    "self.counter_ = 0\n"
                    "        self.hello = partial(self.get_logger().info, 'Hello time: ')",
                ),
                Replace(NODE, LOG, "self.hello(str(self.counter_))"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "method_of_logger_with_comma",
                Replace(
                    NODE,
                    LOG_LINE,
                    "        log = self.get_logger().info\n        log('Hello time:', self.counter_)\n",
                ),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "helper_passes_on_values",
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    def log(self, *values):\n        self.get_logger().info(*values)\n\n"
                    "    def timer_callback",
                ),
                Replace(NODE, LOG, "self.log('Hello time: %d', self.counter_)"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "logger_with_comma",
                Replace(NODE, "'Hello time: ' + str", "'Hello time: ', str"),
                fails="run.output",
                blocks=DEAD,
                note="as print would take it",
            ),
            example(
                "logger_with_value",
                Replace(
                    NODE,
                    "'Hello time: ' + str(self.counter_)",
                    "'Hello time: %d', self.counter_",
                ),
                fails="run.output",
                blocks=DEAD,
                note="as printf and Python's logging would take it",
            ),
        ),
    ),
    _node(
        "log_missing",
        "logger",
        msg("The callback logs nothing"),
        msg("The timer calls the callback, but no line of the callback logs anything."),
        msg("Write self.get_logger().info(…) in the callback."),
        links.LOGGING,
        whys={
            "assigned": msg("= replaces the method info by the text, and calls nothing."),
            "named": msg(
                "{name} only names the method: without () nothing is called. What line {line} "
                "computes goes nowhere."
            ),
            "after_spin": msg(
                "This line is below spin (line {line}), which returns only after Ctrl+C. Until then, "
                "ROS runs nothing but callbacks, and {callback} logs nothing."
            ),
            "lambda": msg(
                "The timer calls this lambda. It returns a text, and nothing logs what a callback "
                "returns."
            ),
        },
        fixes={
            "assigned": msg("Remove the = after info: the text stands in its ()."),
            "named": msg(
                "Write {name}(…) with the text of line {line} in the (), and delete line {line}."
            ),
            "after_spin": msg(
                "Call {method} in {callback} instead, and delete the lines below spin that were to do it."
            ),
            "function": msg("Write {written} in {name}."),
            "function_only": msg("Call info(…) of the node's logger in {name}."),
            "lambda": msg("Write {written} instead of {name}."),
        },
        behind={"run.no_lines": _missing},
        fixed_by=(node_log.called, node_log.called_with_next),
        examples=(
            example(
                "log_named_above_its_text",
                Replace(
                    NODE,
                    "        self.get_logger().info('Hello time: ' + str(self.counter_))\n",
                    "        self.get_logger().info\n        f'Hello time: {self.counter_}'\n",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
            example(
                "log_assigned",
                Replace(
                    NODE,
                    ".info('Hello time: ' + str(self.counter_))",
                    ".info = ('Hello time: ' + str(self.counter_))",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
            example(
                "logged_by_a_loop_below_spin",
                Replace(
                    NODE,
                    "        self.get_logger().info('Hello time: ' + str(self.counter_))\n"
                    "        self.counter_ += 1\n",
                    "        self.due = True\n\n    def say(self):\n"
                    "        self.get_logger().info('Hello time: ' + str(self.counter_))\n"
                    "        self.counter_ += 1\n",
                ),
                Replace(
                    NODE,
                    "        rclpy.spin(node)\n    except",
                    "        rclpy.spin(node)\n        while node.due:\n            node.say()\n"
                    "    except",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
            example(
                "log_line_forgotten",
                Replace(
                    NODE,
                    "        self.get_logger().info('Hello time: ' + str(self.counter_))\n",
                    "",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
    _node(
        "log_option",
        "logger",
        msg("An option of the logger leaves out lines"),
        msg("With {name}, the logger does not write a line in every call."),
        msg("Remove {written} from the call in this line."),
        links.LOGGING,
        whys={
            "once": msg("With once=True, only the first call of that line writes it."),
            "throttle_duration_sec": msg(
                "After a line, the logger writes no other for throttle_duration_sec seconds."
            ),
            "skip_first": msg("With skip_first=True, the first call of that line writes nothing."),
        },
        behind={
            "run.stops": _left_out("once", "throttle_duration_sec"),
            "run.wrong_step": _left_out("throttle_duration_sec"),
            "run.wrong_period": _left_out("once", "throttle_duration_sec"),
            "run.wrong_start": _left_out("skip_first"),
        },
        fixed_by=(node_words.options,),
        examples=(
            example(
                "logged_once",
                Replace(NODE, "str(self.counter_))", "str(self.counter_), once=True)"),
                fails="run.output",
                blocks=("run.period",),
            ),
            example(
                "log_throttled",
                Replace(
                    NODE, "str(self.counter_))", "str(self.counter_), throttle_duration_sec=60.0)"
                ),
                fails="run.output",
                blocks=("run.period",),
            ),
            example(
                "log_skips_first",
                Replace(NODE, "str(self.counter_))", "str(self.counter_), skip_first=True)"),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "debug_level",
        "logger",
        msg("The line is logged at level DEBUG"),
        msg("By default, records of level DEBUG are neither shown nor published."),
        msg("Write self.get_logger().info(…) instead of .debug(…)."),
        links.LOGGING,
        fixes={"written": INSTEAD},
        behind={"run.no_lines": _debug, "run.wrong_step": _debug, "run.wrong_start": _debug},
        fixed_by=(node_log.level, lines.written),
        examples=(
            example(
                "level_chosen_by_a_helper",
                Replace(
                    NODE,
                    "self.get_logger().info('Hello time: ' + str(self.counter_))",
                    "self.say('Hello time: ' + str(self.counter_), 'green')",
                ),
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    def say(self, text, colour):\n        if colour == 'green':\n"
                    "            self.get_logger().debug(text)\n        else:\n"
                    "            self.get_logger().warn(text)\n\n    def timer_callback",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
            example(
                "each_second_line_as_debug",
                Replace(
                    NODE,
                    LOG_LINE,
                    "        if self.counter_ % 2:\n"
                    "            self.get_logger().debug('Hello time: ' + str(self.counter_))\n"
                    f"        else:\n    {LOG_LINE}",
                ),
                fails="run.output",
                also={"run.period": "run.wrong_period"},
            ),
            example(
                "logged_as_debug",
                Replace(NODE, "self.get_logger().info", "self.get_logger().debug"),
                fails="run.output",
                blocks=SILENT,
                note="below the default level: neither on the terminal nor on /rosout",
            ),
        ),
    ),
    _node(
        "severity_changed",
        "logger",
        msg("One line of code logs with several levels"),
        msg(
            "rclpy keeps the level of each line of code that calls the logger, and refuses another level from "
            "the same line. Line {line} logs with more than one level."
        ),
        msg(
            "Write a call of its own for each level, such as .info(…) under one branch of an if and .warn(…) "
            "under the other. Or log with info(…) alone: the exercise needs no other level."
        ),
        links.LOGGING,
        whys={
            "loop": msg(
                "This loop runs line {line} once for each level, so that each call of the callback logs "
                "several lines."
            ),
        },
        fixes={
            "loop": msg("Log once, without the loop: self.get_logger().info(…)"),
        },
        raised={r"^ValueError: Logger severity cannot be changed between calls": _severity_changed},
        behind={"run.twice": _levels_in_loop},
        examples=(
            example(
                "severity_changed",
                Replace(
                    NODE,
                    LOG_LINE,
                    "        for level in ('info', 'warn'):\n"
                    "            getattr(self.get_logger(), level)('Hello time: ' + str(self.counter_))\n",
                ),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
        ),
    ),
    _node(
        "logs_twice",
        "logger",
        msg("The callback writes the line more than once"),
        msg("Each call of the logger or of print() writes its own line."),
        msg("Keep only one self.get_logger().info(…) in the callback."),
        links.LOGGING,
        fixes={
            "line": msg("Delete line {line}: another call writes the same line."),
            "both": msg("Delete lines {form}: they log the line and count once more."),
            "printed": BESIDE,
        },
        behind={
            "run.twice": first_of(
                worked_out("logs_twice", "logged_and_counted", variant="both"),
                _twice,
                worked_out("logs_twice", "logged", variant="line"),
            )
        },
        fixed_by=(
            node_count.twice,
            node_log.only_logged,
            node_worked_out.change("logged_and_counted"),
            node_worked_out.change("logged"),
        ),
        examples=(
            example(
                "logs_again_after_a_sleep",
                Replace(NODE, "import rclpy\n", "import time\n\nimport rclpy\n"),
                Replace(
                    NODE, STEP_LINE, f"{STEP_LINE}        time.sleep(0.5)\n{LOG_LINE}{STEP_LINE}"
                ),
                fails="run.output",
                blocks=("run.period",),
            ),
            example(
                "logs_and_counts_twice",
                Replace(
                    NODE,
                    "        self.counter_ += 1\n",
                    "        self.counter_ += 1\n"
                    "        self.get_logger().info(f'Hello time: {self.counter_}')\n"
                    "        self.counter_ += 1\n",
                ),
                fails="run.output",
            ),
            example(
                "logs_twice",
                Replace(
                    NODE,
                    "self.get_logger().info('Hello time: ' + str(self.counter_))",
                    (
                        "self.get_logger().info('Hello time: ' + str(self.counter_))\n"
                        "        self.get_logger().info('Hello time: ' + str(self.counter_))"
                    ),
                ),
                fails="run.output",
            ),
            example(
                "printed_and_logged",
                Replace(
                    NODE,
                    "self.get_logger().info('Hello time: ' + str(self.counter_))",
                    (
                        "print('Hello time: ' + str(self.counter_))\n"
                        "        self.get_logger().info('Hello time: ' + str(self.counter_))"
                    ),
                ),
                fails="run.output",
                also={"run.logger": "node.print_used"},
            ),
        ),
    ),
    _node(
        "print_used",
        "logger",
        msg("print() is used instead of the logger"),
        msg(
            "print() only writes to this terminal: no level, no time, no node name, and no other "
            "program sees it on /rosout."
        ),
        msg("Write self.get_logger().info(…) instead of print(…)."),
        links.LOGGING,
        whys={
            **dict.fromkeys(("inside", "inside_written", "inside_several"), INSIDE),
        },
        fixes={
            "inside": msg("Remove print( and its ): give the text itself to the logger."),
            "inside_written": INSTEAD,
            "inside_several": msg(
                "Remove print( and its ), and give one text to the logger: join the values with +, or "
                "write them into an f-string."
            ),
            "beside": BESIDE,
            "written": INSTEAD,
            **print_elsewhere.FIXES,
        },
        behind={"run.print_not_logger": _printed},
        fixed_by=(
            node_log.printed_to_log,
            node_log.without_print,
            node_log.logger,
            node_log.only_logged,
        ),
        examples=(
            example(
                "printed_beside_a_debug_line",
                Replace(
                    NODE,
                    "        self.get_logger().info('Hello time: ' + str(self.counter_))\n",
                    "        text = 'Hello time: ' + str(self.counter_)\n"
                    "        print(text)\n        self.get_logger().debug(text)\n",
                ),
                fails="run.logger",
            ),
            example(
                "printed", Replace(NODE, "self.get_logger().info", "print"), fails="run.logger"
            ),
            example(
                "print_in_log",
                Replace(
                    NODE,
                    "'Hello time: ' + str(self.counter_)",
                    "print('Hello time: ' + str(self.counter_))",
                ),
                fails="run.logger",
            ),
        ),
    ),
    _node(
        "written_without_logger",
        "logger",
        msg("A line is written to the terminal without the logger"),
        msg(
            "The logger itself adds the level, the time and the node's name, and sends the record "
            "to /rosout as well."
        ),
        msg("Give only the text after the name to the logger: self.get_logger().info(…)"),
        links.LOGGING,
        fixes={"written": INSTEAD},
        behind={"run.faked_log": _imitated, "run.print_not_logger": _written},
        fixed_by=(node_log.printed_to_log,),
        examples=(
            example(
                "record_printed",
                Replace(NODE, "import rclpy\n", "import time\n\nimport rclpy\n"),
                Replace(
                    NODE,
                    LOG,
                    "text = 'Hello time: ' + str(self.counter_)\n"
                    "        print(f'[INFO] [{time.time():.9f}] [my_first_node]: {text}', flush=True)",
                ),
                fails="run.logger",
            ),
            example(
                "printed_in_log_form",
                Replace(NODE, "import rclpy\nfrom", "import sys\nimport time\nimport rclpy\nfrom"),
                Replace(
                    NODE,
                    "self.get_logger().info('Hello time: ' + str(self.counter_))",
                    "print(f'[INFO] [{time.time():.9f}] [my_first_node]: Hello time: {self.counter_}', file=sys.stderr, flush=True)",
                ),
                fails="run.logger",
            ),
            example(
                "written_to_stdout",
                Replace(NODE, "import rclpy\n", "import sys\n\nimport rclpy\n"),
                Replace(
                    NODE,
                    LOG,
                    "sys.stdout.write('Hello time: ' + str(self.counter_) + '\\n')\n"
                    "        sys.stdout.flush()",
                ),
                fails="run.logger",
            ),
        ),
    ),
)
