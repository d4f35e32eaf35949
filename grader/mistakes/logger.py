"""Mistakes in logging: the logger, its calls, their level and their number."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import DEAD, LOG_LINE, NODE, SILENT, example
from grader.mistakes.fixes import lines, node_count, node_log, node_words
from grader.mistakes.kind import INSTEAD, Family
from grader.mistakes.recognised import FromSource, Raised, RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.counter import targets_of
from grader.package.source.module import Function
from grader.package.source.names import called_name, calls_in, dotted, last_part, own_name
from grader.package.source.node import NodeSource
from grader.package.source.place import block_of, statement_of
from grader.package.source.printed import as_log


def _arguments(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The logger gets several strings, which only print accepts."""
    del match
    calls = (call for call, _ in raised.source.calls if raised.source.is_log(call))
    logs = [call for call in calls if len(call.args) > 1]
    return raised.finding("logger_arguments", at=logs[0]) if logs else None


def _not_called(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """get_logger lacks its () where it is used."""
    used = [
        dotted(node.value)
        for node in raised.module.nodes
        if isinstance(node, ast.Attribute) and node.lineno == raised.line
    ]
    name = next((n for n in used if last_part(n) == "get_logger"), "")
    if not name:
        return None  # (another function is not called)
    found = raised.finding("logger_not_called")
    return replace(found, words={**found.words, "logged": f"{name}().{match['name']}(…)"})


def _missing(suspect: Suspect) -> RecognisedMistake | None:
    """The callback logs nothing, and nothing that it may call does."""
    source, callback = suspect.source, suspect.source.callback
    if callback is None or callback not in source.methods.values():
        return None
    if any(getattr(node, "attr", "") == "get_logger" for node in ast.walk(callback)):
        return None
    at_start = (callback, source.methods.get("__init__"), source.main, None)
    for module in source.known_modules:
        logs = [*source.logs(module.tree), *source.prints(module.tree)]
        if any(source.function_around(call) not in at_start for call in logs):
            return None  # (it may be called from the callback, or log what another timer does)
    kept = {own_name(call.func) for call, _ in calls_in(callback)} & source.attributes
    replaced = (last_part(t) for n in source.all_nodes for t in targets_of(n))
    own = [*source.logs(callback), *source.prints(callback)]
    if own or kept - set(source.methods) or callback.name in replaced:
        return None
    return suspect.finding("log_missing", callback)


def _severity_changed(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    return raised.finding("severity_changed", line=str(raised.line)) if raised.line else None


def _debug(suspect: Suspect) -> RecognisedMistake | None:
    """The only line that the callback logs is one of debug."""
    source, callback = suspect.source, suspect.source.callback
    logs = source.logs(callback) if callback is not None else []
    if callback is None or len(logs) != 1 or called_name(logs[0]) != "debug":
        return None
    begins = suspect.output.text[:3].casefold() in ast.unparse(callback).casefold()
    return suspect.finding("debug_level", logs[0]) if begins else None


def _twice(suspect: Suspect) -> RecognisedMistake | None:
    source, callback = suspect.source, suspect.source.callback
    if callback is None:
        return None
    logs = [*source.logs(callback), *source.prints(callback)]
    if len(logs) <= 1:
        return None
    beside = _print_beside(source, callback)
    if len(logs) == 2 and beside is not None:
        return replace(suspect.finding("logs_twice", beside), variant="printed")
    return suspect.finding("logs_twice", sorted(logs, key=lambda call: call.lineno)[1])


def _print_beside(source: NodeSource, part: ast.AST) -> ast.Call | None:
    """Return the print() of a text that the logger logs as well, wherever the print() is reached."""
    logs = [log for log in source.logs(part) if called_name(log) != "debug"]
    for call in source.prints(part):
        module, given = source.module_of(call), list(map(ast.dump, call.args))
        around = set(module.around(call))
        for log in logs:
            same = source.is_own_log(log) and list(map(ast.dump, log.args)) == given
            if same and around & set(block_of(module, statement_of(module, log))):
                return call
    return None


def _printed(suspect: Suspect) -> RecognisedMistake | None:
    source, callback = suspect.source, suspect.source.callback
    inside = [
        given
        for given in (given for call in source.own_logs for given in call.args)
        if isinstance(given, ast.Call) and dotted(given.func) == "print"
    ]
    if inside:
        one = len(inside[0].args) == 1 and not inside[0].keywords
        found = suspect.finding("print_used", inside[0])
        return replace(found, variant="inside" if one else "inside_several")
    prints = source.prints(callback) if callback is not None else []
    prints = prints or [call for call, name in source.calls if name == "print"]
    beside = _print_beside(source, callback) if callback is not None else None
    if beside is not None:
        return replace(suspect.finding("print_used", beside), variant="beside")
    return _instead(suspect, prints[0]) if prints else None


def _instead(suspect: Suspect, call: ast.Call) -> RecognisedMistake:
    """Say which call of the logger to write instead of a print()."""
    source, around = suspect.source, suspect.source.function_around(call)
    if around is not None and around not in source.own_methods:
        node = _node_known_in(source, call)
        found = suspect.finding("print_used", call, name=around.name, written=node)
        return replace(found, variant="of_node" if node else "given")
    written = as_log(source, call)
    if written is None or source.own_logs:
        return suspect.finding("print_used", call)
    code = source.module_of(call).text.code(call)
    found = suspect.finding("print_used", call, name=code, written=written)
    return replace(found, variant="written")


def _node_known_in(source: NodeSource, call: ast.Call) -> str:
    """Return the variable or parameter with the node in the functions around a call; "" if none."""
    known: set[str] = set()
    for part in source.module_of(call).around(call):
        if isinstance(part, Function):
            known |= {given.arg for given in part.args.args}
            known |= {name for node in ast.walk(part) for name in targets_of(node)}
    return min(known & source.node_variables, default="")


def _left_out(*options: str) -> FromSource:
    """Return a function that finds one of these options in the calls of the logger."""

    def found(suspect: Suspect) -> RecognisedMistake | None:
        for call in suspect.source.own_logs:
            option = node_words.option_of(call)
            if option is None or option.arg not in options or _is_shorter(suspect, option):
                continue
            mistake = suspect.finding("log_option", call, name=str(option.arg))
            words = {**mistake.words, "written": f"{option.arg}=…"}
            return replace(mistake, variant=str(option.arg), words=words)
        return None

    return found


def _is_shorter(suspect: Suspect, option: ast.keyword) -> bool:
    """Whether an option is a time after which the next line is due at the earliest: it leaves out none."""
    seconds = option.value.value if isinstance(option.value, ast.Constant) else None
    if option.arg != "throttle_duration_sec" or not isinstance(seconds, int | float):
        return False
    return seconds < suspect.period


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
        ),
    ),
    _node(
        "logger_arguments",
        "logger",
        msg("The logger gets more than one value"),
        msg("info() takes one string. print() takes several with commas, the logger does not."),
        msg("Make one string of them: {sum}, or an f-string."),
        links.LOGGING,
        seen=r"\.info\(\) takes 2 positional arguments but \d{1,3} were given",
        raised={
            r"takes (?:from \d{1,3} to )?\d{1,3} positional arguments? but \d{1,3} were given": _arguments
        },
        fixed_by=(node_log.comma,),
        examples=(
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
        behind={"run.no_lines": _missing},
        examples=(
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
        behind={"run.no_lines": _debug},
        fixed_by=(node_log.level,),
        examples=(
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
        raised={r"^ValueError: Logger severity cannot be changed between calls": _severity_changed},
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
            "printed": BESIDE,
        },
        behind={"run.twice": _twice},
        fixed_by=(node_count.twice, node_log.only_logged),
        examples=(
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
        whys=dict.fromkeys(
            ("inside", "inside_several"),
            msg(
                "print() writes the text to this terminal and returns None, so the logger gets None "
                "instead of the text."
            ),
        ),
        fixes={
            "inside": msg("Remove print( and its ): give the text itself to the logger."),
            "inside_several": msg(
                "Remove print( and its ), and give one text to the logger: join the values with +, or "
                "write them into an f-string."
            ),
            "beside": BESIDE,
            "written": INSTEAD,
            "of_node": msg("Write {written}.get_logger().info(…) instead of print(…)."),
            "given": msg(
                "In {name}, self is not the node. Give it the node's logger as an argument, and write "
                "logger.info(…) there instead of print(…)."
            ),
        },
        behind={"run.print_not_logger": _printed},
        fixed_by=(
            lines.written,
            node_log.without_print,
            node_log.logger,
            node_log.only_logged,
        ),
        examples=(
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
)
