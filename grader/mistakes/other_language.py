"""Words and signs of other programming languages."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.base.nearest import nearest
from grader.base.shown import shown
from grader.mistakes import links
from grader.mistakes.example import DEAD, NODE, example
from grader.mistakes.fixes import lines, node_words
from grader.mistakes.fixes.case import Case
from grader.mistakes.kind import Family
from grader.mistakes.recognised import NAME_ERROR, Raised, RecognisedMistake, Suspect
from grader.mistakes.scope import NODE_METHODS
from grader.package.edit.files import Files
from grader.package.edit.tree import Replace
from grader.package.source.module import Function, Module
from grader.package.source.names import called_name, dotted
from grader.package.source.place import block_of, function_at, statement_at
from grader.report.model import Where

WORDS = {
    **dict.fromkeys(("true", "TRUE"), "True"),
    **dict.fromkeys(("false", "FALSE"), "False"),
    **dict.fromkeys(
        ("null", "NULL", "Null", "nil", "none", "NONE", "nullptr", "undefined"), "None"
    ),
    "this": "self",
}
FUNCTIONS = {
    **dict.fromkeys(("num2str", "int2str", "to_string", "itoa", "String"), "str"),
    **dict.fromkeys(("length", "numel", "sizeof", "strlen"), "len"),
    **dict.fromkeys(("str2num", "str2double", "atof", "parseFloat"), "float"),
    **dict.fromkeys(("atoi", "parseInt"), "int"),
}
"""Functions of other languages, and Python's own."""
PRINTS = (
    *("printf", "println", "puts", "echo", "console", "cout", "std", "System", "Console"),
    *("RCLCPP_INFO", "RCLCPP_DEBUG", "RCLCPP_WARN", "RCLCPP_ERROR", "ROS_INFO", "ROS_INFO_STREAM"),
)
METHODS = {
    **dict.fromkeys(("toString", "to_string", "ToString", "str"), "str(…)"),
    **dict.fromkeys(("length", "size", "Length"), "len(…)"),
    **dict.fromkeys(("concat", "Concat"), "+"),
    **dict.fromkeys(("push", "push_back", "add", "Add"), "append(…)"),
}
SIGNS = {"%": "percent", "--": "dashes", ";": "semicolon"}
DEFINE = re.compile(
    r"#[ \t]{0,9}define[ \t]{1,99}(?P<name>\w{1,120})[ \t=]{1,99}(?P<value>[^#/]{1,200})"
)
PLACE = re.compile(r"%[-+ 0]{0,3}\d{0,3}(?:\.\d{1,3})?[hl]{0,2}[disufxXc]")
LOGGERS = ("self.get_logger()", "get_logger()", "this.get_logger()", "self.logger", "self.logger_")
SHOWN = "|".join((*WORDS, *PRINTS))


def _word(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    name = match["name"]
    if name == "String" and _is_message(raised, name):
        return None
    if name in FUNCTIONS and re.search(rf"\b{name}\s*\(", raised.module.line(raised.line)):
        return raised.finding("other_language", name=name, close=FUNCTIONS[name])
    if name in WORDS:
        return raised.finding("other_language", name=name, close=WORDS[name])
    if name.lower() == "override" and raised.module.line(raised.line).lstrip().startswith("@"):
        return replace(raised.finding("other_language", name=f"@{name}"), variant="override")
    if name not in PRINTS:
        return None
    found = replace(raised.finding("other_language", name=name), variant="print")
    return _printed(raised, name) or found


def _is_message(raised: Raised, name: str) -> bool:
    """Whether a name is used as the class of a message: without a value, or not called at all."""
    module = raised.module
    uses = [n for n in module.nodes if isinstance(n, ast.Name) and n.id == name]
    around = [(module.parents.get(use), use) for use in uses]
    return any(
        not isinstance(call, ast.Call) or call.func is not use or not call.args
        for call, use in around
    )


def _printed(raised: Raised, name: str) -> RecognisedMistake | None:
    """The line prints a text with the places of printf: the logger logs it with %."""
    text, function = raised.module.text, function_at(raised.module, raised.line)
    statement = statement_at(raised.module, raised.line)
    call = statement.value if isinstance(statement, ast.Expr) else None
    called = dotted(call.func) if isinstance(call, ast.Call) else ""
    if function is None or not isinstance(call, ast.Call) or called.partition(".")[0] != name:
        return None
    args = call.args[1:] if dotted(call.args[0] if call.args else call) in LOGGERS else call.args
    first = args[0] if args and not call.keywords else None
    plain = first.value if isinstance(first, ast.Constant) else None
    code = text.code(call)
    if first is None or not isinstance(plain, str):
        return _sum(raised, function, code, args[0]) if len(args) == 1 and first else None
    shown_text = re.sub(r"(?:\\n)+(?=['\"]\Z)", "", text.code(first))
    plain = plain.rstrip("\n")
    if (
        shown_text not in (f"'{plain}'", f'"{plain}"')
        or "\n" in code
        or [a.arg for a in function.args.args][:1] != ["self"]
    ):
        return None
    if len(PLACE.findall(plain)) != plain.count("%") or plain.count("%") != len(args) - 1:
        return None
    given = ", ".join(text.code(a) for a in args[1:])
    single = len(args) == 2 and isinstance(args[1], ast.Name | ast.Attribute | ast.Call)
    values = f" % {given}" if single else f" % ({given}{',' * (len(args) == 2)})" if given else ""
    written = f"self.get_logger().info({shown_text}{values})"
    params = {"name": shown(code), "written": shown(written)}
    return replace(raised.finding("other_language", params=params), variant="call")


def _sum(
    raised: Raised, function: Function, code: str, given: ast.expr
) -> RecognisedMistake | None:
    """The line prints one expression that is a text: an f-string, or a sum with a text in it."""
    text, own = raised.module.text, [a.arg for a in function.args.args][:1] == ["self"]
    parts = _summands(given)
    texts = [_is_text(part) for part in parts]
    if not own or not any(texts) or "\n" in code:
        return None
    written = text.code(given)
    if not all(texts):
        pieces = [text.code(p) if t else f"str({text.code(p)})" for p, t in zip(parts, texts)]
        written = " + ".join(pieces)
    params = {"name": shown(code), "written": shown(f"self.get_logger().info({written})")}
    return replace(raised.finding("other_language", params=params), variant="call")


def _summands(given: ast.expr) -> list[ast.expr]:
    if isinstance(given, ast.BinOp) and isinstance(given.op, ast.Add):
        return [*_summands(given.left), given.right]
    return [given]


def _is_text(part: ast.expr) -> bool:
    """Whether an expression is a text for certain."""
    if isinstance(part, ast.Call):
        return dotted(part.func) in ("str", "repr") or called_name(part) == "format"
    if isinstance(part, ast.BinOp) and isinstance(part.op, ast.Mod):
        return isinstance(part.left, ast.Constant) and isinstance(part.left.value, str)
    return isinstance(part, ast.JoinedStr) or (
        isinstance(part, ast.Constant) and isinstance(part.value, str)
    )


def _logged(case: Case) -> Files | None:
    """Write the call of the logger for that of another language."""
    name = str(case.finding.params.get("name", ""))
    if name.startswith("@"):
        return lines.deleted(case)
    return lines.written(case) if "(" in name else None


def _comment(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    name, line = match["name"], raised.module.line(raised.line)
    if not re.search(rf"//\s{{0,99}}{re.escape(name)}\b", line) or _is_misspelt(raised, name):
        return None
    return raised.finding("slash_comment", name=name)


def _comment_sign(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The line ends with the unknown name, behind the sign of a comment of another language."""
    name, row = match["name"], raised.module.line(raised.line)
    sign = re.search(rf"[^\s%;-][ \t]*(%|--|;)[ \t]*{re.escape(name)}\s*\Z", row)
    if sign is None or _is_misspelt(raised, name):
        return None
    statement = statement_at(raised.module, raised.line)
    if statement is None or not _only_comment(raised.module, statement, name, sign[1]):
        return None
    found = raised.finding("comment_sign", at=statement, name=name)
    return replace(found, words={**found.words, "sign": sign[1]}, variant=SIGNS[sign[1]])


def _is_misspelt(raised: Raised, name: str) -> bool:
    """Whether the file has nearly this name: another one may be meant."""
    known = {*raised.module.names, *(own.rstrip("_") for own in raised.source.attributes)}
    return bool(nearest(name, known - {name}, 0.75)) or name in raised.source.attributes


def _only_comment(module: Module, statement: ast.stmt, name: str, sign: str) -> bool:
    """Whether a statement makes no sense with the name: it is a comment for certain.

    No line computes a remainder, or a difference of a negative value, and keeps no result; and
    nobody computes the remainder of 0 or 1.
    """
    value = getattr(statement, "value", None)
    if sign == ";":
        others = [s for s in block_of(module, statement) if s.lineno == statement.lineno]
        alone = isinstance(statement, ast.Expr) and dotted(statement.value) == name
        return alone and len(others) > 1
    if not isinstance(value, ast.BinOp):
        return False
    right = value.right.operand if isinstance(value.right, ast.UnaryOp) else value.right
    number = value.left.value if isinstance(value.left, ast.Constant) else None
    trivial = sign == "%" and type(number) in (int, float) and number in (0, 1)
    double = sign == "--" and isinstance(value.left, ast.Constant | ast.Call)
    called = called_name(value.left) if isinstance(value.left, ast.Call) else ""
    made = called in NODE_METHODS or called[:1].isupper()
    texts = [n.value for n in ast.walk(value.left) if isinstance(n, ast.Constant)]
    if dotted(right) != name or any(isinstance(t, str) and "%" in t for t in texts):
        return False
    return isinstance(statement, ast.Expr) or trivial or double or made


def _defined(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A comment `#define NAME value`, as C defines constants."""
    name, module = match["name"], raised.module
    for number, row in enumerate(module.text.lines, 1):
        found = DEFINE.match(row.strip())
        if found is None or found["name"] != name:
            continue
        value = found["value"].strip().rstrip(";")
        code, new = row.strip(), f"{name} = {value}"
        where = Where(file=module.path, line=number)
        known = _is_value(value)
        params = {"name": code, "written": new if known else f"{name} = …"}
        mistake = replace(raised.finding("define_comment", params=params), where=where)
        return mistake if known else replace(mistake, variant="open")
    return None


def _is_value(code: str) -> bool:
    """Whether a piece of code is a literal of Python."""
    try:
        return ast.literal_eval(code) is not None
    except (SyntaxError, ValueError, TypeError, RecursionError, MemoryError):
        return False


def _method(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    name = match["name"]
    if name not in METHODS:
        return None
    found = raised.finding("other_language", name=name, written=METHODS[name])
    return replace(found, variant="to_text" if METHODS[name] == "str(…)" else "method")


def _lost_sum(suspect: Suspect) -> RecognisedMistake | None:
    found = node_words.lost_sum(suspect.source)
    if found is None:
        return None
    step = suspect.output.step
    mistake = suspect.finding("sum_not_kept", found[0], name=found[1], step=step)
    if isinstance(found[0], ast.Expr) and isinstance(found[0].value, ast.Compare):
        equal = isinstance(found[0].value.ops[0], ast.Eq)
        return replace(mistake, variant="compared" if equal else "compared_sizes")
    return replace(mistake, variant="return" if isinstance(found[0], ast.Return) else "")


_node = Family("node", links.PYTHON_ERRORS)
KINDS = (
    _node(
        "other_language",
        "callback",
        msg("A word of another programming language is used"),
        msg("Each programming language has its own words. In Python, case matters."),
        msg("Use Python's own word instead of {name}: True, False, None, self."),
        close=msg("Write {close} instead of {name}."),
        fixes={
            "to_text": msg("Write str( ) around the value instead of .{name}() behind it."),
            "print": msg(
                "Write self.get_logger().info(…) instead of the whole statement with {name}, and the "
                "text to log instead of …"
            ),
            "method": msg("Write {written} instead of {name}."),
            "call": msg("Write {written} instead of {name}."),
            "override": msg("Delete the line {name}: a method needs no such word above its def."),
        },
        seen=rf"NameError: name '(?P<name>{SHOWN})' is not defined",
        raised={
            NAME_ERROR: _word,
            (
                r"AttributeError: '(?:int|float|str|list)' object has no attribute "
                r"'(?P<name>\w{1,120})'"
            ): _method,
        },
        fixed_by=(node_words.word, _logged),
        examples=(
            example(
                "null_for_none",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = 0\n        self.last_ = null"),
                fails="run.starts",
            ),
            example(
                "number_to_text_of_matlab",
                Replace(NODE, "str(self.counter_)", "num2str(self.counter_)"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "override_of_java",
                Replace(NODE, "    def timer_callback", "    @Override\n    def timer_callback"),
                fails="run.starts",
            ),
            example(
                "true_in_lower_case",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = 0\n        self.on_ = true"),
                fails="run.starts",
            ),
            example(
                "this_for_self",
                Replace(NODE, "self.counter_ += 1", "this.counter_ += 1"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
            example(
                "to_string",
                Replace(NODE, "str(self.counter_)", "self.counter_.toString()"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "printf_in_callback",
                Replace(
                    NODE,
                    "self.get_logger().info('Hello time: ' + str(self.counter_))",
                    "printf('Hello time: %d', self.counter_)",
                ),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "slash_comment",
        "callback",
        msg("A comment begins with // instead of #"),
        msg("In Python // is a division, so what follows it is not a comment."),
        msg("Write # instead of //."),
        raised={NAME_ERROR: _comment},
        fixed_by=(node_words.comment,),
        examples=(
            example(
                "comment_with_slashes",
                Replace(NODE, "self.counter_ += 1", "self.counter_ += 1  // increment"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
        ),
    ),
    _node(
        "comment_sign",
        "callback",
        msg("A comment begins with a sign of another language instead of #"),
        msg("In Python {sign} does not begin a comment, so what follows it is code."),
        msg("Write # instead of {sign}."),
        whys={
            "percent": msg(
                "In Python % calculates the remainder of a division, so {name} is not a comment, but "
                "a name."
            ),
            "dashes": msg(
                "In Python -- is two minus signs, so {name} is not a comment, but a name."
            ),
            "semicolon": msg(
                "In Python ; begins another statement on the same line, so {name} is not a comment, "
                "but a name."
            ),
        },
        raised={NAME_ERROR: _comment_sign},
        fixed_by=(node_words.other_comment,),
        examples=(
            example(
                "comment_with_percent",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = 0  % start"),
                fails="run.starts",
            ),
            example(
                "comment_with_semicolon",
                Replace(NODE, "self.counter_ += 1", "self.counter_ += 1  ; increment"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
        ),
    ),
    _node(
        "define_comment",
        "start",
        msg("A constant is defined in a comment"),
        msg("In Python # begins a comment, so {name} defines nothing."),
        msg("Write {written} instead of {name}."),
        fixes={"open": msg("Write {written} instead of {name}, with the value in the place of …")},
        raised={NAME_ERROR: _defined},
        fixed_by=(lines.written,),
        examples=(
            example(
                "period_defined_as_in_c",
                Replace(NODE, "class MyFirstNode", "#define PERIOD 1.0\n\n\nclass MyFirstNode"),
                Replace(NODE, "(1.0,", "(PERIOD,"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "sum_not_kept",
        "counter",
        msg("The result of the calculation is not kept"),
        msg(
            "This line calculates a number, but assigns it to nothing: {name} stays as it is. "
            "Python has no ++."
        ),
        msg("Write {name} += {step}"),
        links.PYTHON_CLASSES,
        whys={
            "return": msg(
                "return gives the sum to what calls {callback}. The timer calls it, and does not "
                "keep what it gets: {name} stays as it is."
            ),
            "compared_sizes": msg(
                "Python reads this line as a comparison, and keeps no result: {name} stays as it is. "
                "One = assigns a value."
            ),
            "compared": msg(
                "== only compares, and this line keeps no result: {name} stays as it is. One = "
                "assigns a value."
            ),
        },
        fixes={"return": msg("Write {name} += {step} instead of this return.")},
        behind={"run.constant_counter": _lost_sum},
        fixed_by=(node_words.kept_sum,),
        examples=(
            example(
                "plus_plus_before_name",
                Replace(NODE, "self.counter_ += 1", "++self.counter_"),
                fails="run.output",
            ),
            example(
                "sum_not_kept",
                Replace(NODE, "self.counter_ += 1", "self.counter_ + 1"),
                fails="run.output",
            ),
            example(
                "sum_returned",
                Replace(NODE, "self.counter_ += 1", "return self.counter_ + 1"),
                fails="run.output",
            ),
            example(
                "compared_instead_of_set",
                Replace(NODE, "self.counter_ += 1", "self.counter_ == self.counter_ + 1"),
                fails="run.output",
            ),
        ),
    ),
)
