"""What hides an error, or ends a function before its lines have run."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.base.nearest import nearest
from grader.mistakes import links
from grader.mistakes.example import LOG_LINE, NODE, SILENT, STEP_LINE, example
from grader.mistakes.fixes import node_try
from grader.mistakes.fixes.case import Case
from grader.mistakes.hidden_error import attribute_corrected, corrected, hidden_bodies, hidden_error
from grader.mistakes.kind import Family
from grader.mistakes.objects import ALSO_OF_NODE, OF_NODE
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.mistakes.scope import NODE_METHODS
from grader.package.edit.files import Files
from grader.package.edit.tree import Replace
from grader.package.source.counter import targets_of
from grader.package.source.imported import NODE as NODE_CLASS
from grader.package.source.imported import full_name
from grader.package.source.module import Function
from grader.package.source.names import calls_in, dotted, last_part
from grader.package.source.node import LOG_METHODS, NodeSource
from grader.report.model import Where

MISSPELT = 0.85  # how like two names are of which one is the other with a typing mistake
OF_LOGGER = (
    *LOG_METHODS,
    *("log", "name", "get_child", "get_name", "set_level", "get_effective_level", "is_enabled_for"),
)
EVERY = ("Exception", "BaseException")
RAISES = msg("This except catches the error and does not show it. Line {line} raises {error}.")
LOG_OF_NUMBER = "            self.get_logger().info('Hello time: ' + self.counter_)\n"


def _functions(source: NodeSource) -> Iterator[Function]:
    """Yield the functions that run in every run of the node: callback, constructor, main.

    The functions that the callback calls by a name that only they have come last.
    """
    for function in (source.callback, source.methods.get("__init__"), source.main):
        if function is not None:
            yield function
    called = [last_part(name) for _, name in calls_in(source.callback)] if source.callback else []
    functions = [n for n in source.all_nodes if isinstance(n, Function)]
    for name in dict.fromkeys(called):
        named = [function for function in functions if function.name == name]
        if len(named) == 1 and not name.startswith("__"):
            yield named[0]


def hides(handler: ast.ExceptHandler) -> bool:
    """Whether a handler neither raises nor shows the exception that it catches."""
    caught = handler.type.elts if isinstance(handler.type, ast.Tuple) else [handler.type]
    if handler.type is not None and all(last_part(dotted(c)) in node_try.ENDS for c in caught if c):
        return False
    silent = {
        part
        for statement in handler.body
        for call, name in calls_in(statement)
        if last_part(name) == "debug"
        for part in ast.walk(call)
    }
    for node in (part for statement in handler.body for part in ast.walk(statement)):
        if node in silent or (isinstance(node, ast.Attribute) and dotted(node) == "sys.exit"):
            silent |= set(ast.walk(node))
            continue  # (such a line is not shown, and an end shows nothing)
        if isinstance(node, ast.Raise):
            return False
        if isinstance(node, ast.Name) and node.id in (handler.name, "traceback", "sys"):
            return False
    return True


def _swallows(suspect: Suspect) -> RecognisedMistake | None:
    for function in _functions(suspect.source):
        for node in ast.walk(function):
            if not isinstance(node, ast.Try) or _all_harmless(node.body):
                continue
            for handler in filter(hides, node.handlers):
                found = suspect.finding("error_hidden", suspect.place_at(handler))
                error = hidden_error(suspect.source, suspect.assignment, node)
                if error is not None:
                    found = _with_error(found, *error)
                else:
                    body = [s for part in hidden_bodies(suspect.source, node) for s in part]
                    found = _with_attribute(suspect, found, body)
                return _with_narrower(suspect.source, found, node, handler)
    return None


def _suppressed(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a `with suppress(…)` around lines of which one raises what it hides."""
    source = suspect.source
    for function in _functions(source):
        for node in ast.walk(function):
            call = node.items[0].context_expr if isinstance(node, ast.With) else None
            if not isinstance(node, ast.With) or not isinstance(call, ast.Call):
                continue
            if len(node.items) > 1 or last_part(dotted(call.func)) != "suppress":
                continue
            error = hidden_error(source, suspect.assignment, node)
            caught = {last_part(dotted(given)) for given in call.args}
            if error is None or not caught & {error[0].partition(":")[0], *EVERY}:
                continue
            found = _with_error(suspect.finding("error_suppressed", node), *error)
            code = source.module_of(call).text.code(call)
            return replace(found, words={**found.words, "name": code}, variant="")
    return None


def _logged_error(suspect: Suspect) -> RecognisedMistake | None:
    """Look for an except that logs the error which its try raises: that is the text that came."""
    source = suspect.source
    for function in _functions(source):
        for node in ast.walk(function):
            if not isinstance(node, ast.Try) or not any(source.logs(h) for h in node.handlers):
                continue
            error = hidden_error(source, suspect.assignment, node)
            said = error[0].partition(": ")[2] if error is not None else ""
            if error is not None and said and said in suspect.text:
                row = next(h.lineno for h in node.handlers if source.logs(h))
                place = error[2].where or Where(file=source.module_of(node).path, line=error[1])
                found = _with_error(suspect.finding("error_logged", place), *error)
                return replace(found, words={**found.words, "row": row}, variant="")
    return None


def _error_corrected(case: Case) -> Files | None:
    """Correct the error in the try, whose except stays."""
    return corrected(case, keeps_try=True)


def _with_narrower(
    source: NodeSource, found: RecognisedMistake, tried: ast.Try, handler: ast.ExceptHandler
) -> RecognisedMistake:
    """Add how the except is written that catches only Ctrl+C, if its try has to stay."""
    text = source.module_of(tried).text
    if node_try.can_go(source, tried):
        return found
    old, new = node_try.header(text, handler), node_try.narrower(handler)
    words = {**found.words, "head": " ".join(old.split()), "narrower": new, "row": handler.lineno}
    return replace(found, words=words, variant=f"{found.variant}_kept".lstrip("_"))


def _with_error(
    found: RecognisedMistake, error: str, line: int, behind: RecognisedMistake
) -> RecognisedMistake:
    """Add the hidden error, its line, and how it is corrected."""
    from grader.mistakes.catalogue import CATALOGUE  # noqa: PLC0415 - has this file's records

    values = {**behind.params, **behind.words}
    correction = CATALOGUE[behind.kind].fix_text(values, behind.variant)
    at = behind.where.line if behind.where is not None else None
    words = {**found.words, "error": error, "line": line, "correction": correction}
    return replace(found, words={**words, "at": at or line}, variant="error")


def _with_attribute(
    suspect: Suspect, found: RecognisedMistake, body: list[ast.stmt]
) -> RecognisedMistake:
    """Add the misspelt attribute in a try, if there is one: that is the hidden error."""
    source = suspect.source
    for part in (n for statement in body for n in ast.walk(statement)):
        if not isinstance(part, ast.Attribute) or not isinstance(part.ctx, ast.Load):
            continue
        close = _meant(source, part)
        if close:
            owner = dotted(part.value)
            params: dict[str, str | int] = {"name": part.attr, "written": close}
            params |= {"line": part.lineno, "object": owner}
            pair = {"old": f"{owner}.{part.attr}", "new": f"{owner}.{close}"}
            words = {**found.words, **params, **pair}
            return replace(found, params=params, words=words, variant="attribute")
    return found


def _meant(source: NodeSource, part: ast.Attribute) -> str:
    """Return the name that is meant by one that self, its logger or rclpy does not have."""
    owner, name = dotted(part.value), part.attr
    if owner == "self":
        own = source.attributes | set(source.methods)
        plain = source.is_one_class and [
            full_name(source.module, base) for base in _bases(source)
        ] == [NODE_CLASS]
        known = own | {*OF_NODE, *NODE_METHODS, *ALSO_OF_NODE}
        if not plain or name in known or name in _of_class(source):
            return ""
        return nearest(name, own) or nearest(name, NODE_METHODS, cutoff=MISSPELT)
    if owner.endswith(".get_logger()"):
        return "" if name in OF_LOGGER else nearest(name, LOG_METHODS, cutoff=0.7)
    return ""


def _bases(source: NodeSource) -> list[ast.expr]:
    return source.node_class.bases if source.node_class is not None else []


def _of_class(source: NodeSource) -> set[str]:
    """Return the names that the class itself sets."""
    return {name for statement in source.class_body for name in targets_of(statement)}


def _all_harmless(body: list[ast.stmt]) -> bool:
    return all(isinstance(s, ast.Pass | ast.Import | ast.ImportFrom) for s in body)


_node = Family("node", links.PYTHON_ERRORS)
KINDS = (
    _node(
        "error_logged",
        "callback",
        msg("The line that came is the text of an error"),
        msg("Line {line} raises {error}, and the except in line {row} logs that."),
        msg("Correct line {at}, and leave the except as it is: {correction}"),
        behind={"run.wrong_text": _logged_error},
        fixed_by=(_error_corrected,),
        examples=(
            example(
                "error_logged_in_callback",
                Replace(
                    NODE,
                    LOG_LINE + STEP_LINE,
                    (
                        "        try:\n"
                        f"{LOG_OF_NUMBER}"
                        "            self.counter_ += 1\n"
                        "        except TypeError as error:\n"
                        "            self.get_logger().info(f'wrong: {error}')\n"
                    ),
                ),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "error_suppressed",
        "callback",
        msg("A with hides the error"),
        msg(
            "Line {line} raises {error}. {name} hides that: the lines of this with end there, and no "
            "traceback comes."
        ),
        msg(
            "Delete the line of this with, and indent its lines as far as it is indented now. Correct "
            "line {at} too: {correction}"
        ),
        behind=dict.fromkeys(("run.no_lines", "run.constant_counter", "run.stops"), _suppressed),
        examples=(
            example(
                "misspelt_step_suppressed",
                Replace(
                    NODE,
                    "import rclpy\nfrom",
                    "from contextlib import suppress\nimport rclpy\nfrom",
                ),
                Replace(
                    NODE,
                    LOG_LINE + STEP_LINE,
                    "        with suppress(AttributeError):\n"
                    "            self.get_logger().info('Hello time: ' + str(self.counter_))\n"
                    "            self.conter_ += 1\n",
                ),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "error_hidden",
        "callback",
        msg("An except hides the error"),
        msg(
            "This except catches the error and does not show it: the try stops at the line with "
            "the error, and no traceback says why."
        ),
        msg(
            "Remove this except (and its try), and run the node again: now the traceback shows "
            "the line with the error."
        ),
        whys={"error": RAISES, "error_kept": RAISES},
        fixes={
            "attribute": msg(
                "Write {new} instead of {old} on line {line}: nothing defines {old}, and this except "
                "hides the AttributeError. Then remove the except (and its try)."
            ),
            "error": msg(
                "Remove this except and its try, and indent the lines of the try as far as the try "
                "is indented now. Correct line {at} too: {correction}"
            ),
            "kept": msg(
                "Write {narrower} instead of {head} in line {row}, and run the node again: now the "
                "traceback shows the line with the error."
            ),
            "attribute_kept": msg(
                "Write {new} instead of {old} on line {line}: nothing defines {old}, and this except "
                "hides the AttributeError. Then write {narrower} instead of {head} in line {row}."
            ),
            "error_kept": msg(
                "Write {narrower} instead of {head} in line {row}. Correct line {at} too: "
                "{correction}"
            ),
        },
        behind={
            "run.no_lines": _swallows,
            "run.constant_counter": _swallows,
            "run.stops": _swallows,
            "run.exits_at_once": _swallows,
            "run.ended_early": _swallows,
            "run.no_node": _swallows,
        },
        fixed_by=(corrected, attribute_corrected),
        examples=(
            example(
                "misspelt_attribute_hidden",
                Replace(
                    NODE,
                    LOG_LINE + STEP_LINE,
                    "        try:\n"
                    "            self.get_logger().info('Hello time: ' + str(self.count))\n"
                    "            self.counter_ += 1\n"
                    "        except Exception:\n"
                    "            pass\n",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
            example(
                "misspelt_step_hidden",
                Replace(
                    NODE,
                    LOG_LINE + STEP_LINE,
                    "        try:\n"
                    "            self.get_logger().info('Hello time: ' + str(self.counter_))\n"
                    "            self.conter_ += 1\n"
                    "        except Exception:\n"
                    "            pass\n",
                ),
                fails="run.output",
            ),
            example(
                "error_hidden_in_callback",
                Replace(
                    NODE,
                    LOG_LINE + STEP_LINE,
                    (
                        "        try:\n"
                        f"{LOG_OF_NUMBER}"
                        "            self.counter_ += 1\n"
                        "        except:\n"
                        "            pass\n"
                    ),
                ),
                fails="run.output",
                blocks=SILENT,
            ),
            example(
                "error_hidden_in_main",
                Replace(NODE, "        self.counter_ = 0\n", ""),
                Replace(NODE, "except KeyboardInterrupt:", "except Exception:"),
                fails="run.output",
                blocks=("run.interrupt", *SILENT),
            ),
            example(
                "constructor_misspelt_and_hidden",
                Replace(NODE, "    def __init__(self)", "    def _init_(self)"),
                Replace(
                    NODE,
                    "    rclpy.init(args=args)\n    node = MyFirstNode()\n    try:\n        rclpy.spin(node)\n"
                    "    except KeyboardInterrupt:\n        pass\n    finally:\n"
                    "        node.destroy_node()\n        rclpy.try_shutdown()\n",
                    "    try:\n        rclpy.init(args=args)\n        node = MyFirstNode()\n"
                    "        rclpy.spin(node)\n        node.destroy_node()\n        rclpy.shutdown()\n"
                    "    except:\n        pass\n",
                ),
                fails="run.starts",
            ),
            example(
                "exit_hidden_in_main",
                Replace(
                    NODE,
                    "    node = MyFirstNode()\n    try:\n",
                    "    try:\n        node = MyFirstNode(1)\n",
                ),
                Replace(
                    NODE,
                    "    except KeyboardInterrupt:\n        pass\n    finally:\n        node.destroy_node()\n        rclpy.try_shutdown()\n",
                    "    except:\n        print('stopped')\n    rclpy.try_shutdown()\n",
                ),
                fails="run.starts",
            ),
        ),
    ),
)
