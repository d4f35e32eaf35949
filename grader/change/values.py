"""Operators of values: numbers, truth values, texts, signs and comparisons."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from itertools import product

from grader.base.i18n.message import msg
from grader.base.nearest import nearest
from grader.change.operator import Made, Operator, Site, operator, swapped
from grader.package.edit.text import Splice
from grader.package.source.names import called_name, dotted

INSTEAD = msg("Write {written} instead of {name}.")
SIGNS: dict[type[ast.AST], str] = {
    ast.Add: "+",
    ast.Sub: "-",
    ast.Mult: "*",
    ast.Div: "/",
    ast.Lt: "<",
    ast.LtE: "<=",
    ast.Gt: ">",
    ast.GtE: ">=",
    ast.Eq: "==",
    ast.NotEq: "!=",
}
SUMS = (ast.Add, ast.Sub, ast.Mult, ast.Div)
ORDERS = (ast.Lt, ast.Gt, ast.LtE, ast.GtE)
OTHER: dict[type[ast.AST], str] = {
    ast.Is: "is not",
    ast.IsNot: "is",
    ast.Eq: "!=",
    ast.NotEq: "==",
    ast.In: "not in",
    ast.NotIn: "in",
}
NAMING = (
    *("create_publisher", "create_subscription", "create_service", "create_client"),
    *("declare_parameter", "get_parameter", "__init__", "create_node"),
)
BITS: dict[type[ast.AST], str] = {ast.BitAnd: "and", ast.BitOr: "or", ast.BitXor: "**"}
NUMBER = re.compile(r"-?\d{1,9}(?:\.\d{1,9})?")
"""A text that is a number."""
FACTORS = (10.0, 0.1, 2.0, 0.5)


def _between(site: Site, whole: ast.expr, left: ast.expr, right: ast.expr, sign: str) -> Made:
    text = site.module.text
    first, last = text.span(left)[1], text.span(right)[0]
    begin, stop = text.span(whole)
    middle = text.text[first:last]
    close, opened = middle[: middle.find(")") + 1] if ")" in middle else "", ""
    if "(" in middle:
        opened = middle[middle.rfind("(") :]
    new = f"{close} {sign} {opened}"
    old = text.text[begin:stop]
    written = old[: first - begin] + new + old[last - begin :]
    return Made(whole, old, written, (Splice(first, last, new),))


def _number(value: float) -> str:
    return repr(int(value)) if isinstance(value, int) else repr(round(value, 6))


@operator(
    "number",
    cost=2,
    hides=True,
    why=msg("What the node does depends on {name}. With another value the failed check passes."),
    fix=INSTEAD,
)
def number(site: Site) -> Iterator[Made]:
    """Yield the wanted numbers, and others that are near, in place of a plain number."""
    for node in site.of(ast.Constant):
        if not isinstance(node, ast.Constant) or type(node.value) not in (int, float):
            continue
        value = node.value
        assert isinstance(value, int | float)
        for wanted in dict.fromkeys(site.wanted.numbers):
            if wanted != value and wanted >= 0:
                same = type(value)(wanted) if type(value)(wanted) == wanted else wanted
                yield swapped(site, node, _number(same))
        if isinstance(value, float):
            for factor in FACTORS:
                yield swapped(site, node, _number(value * factor), more=3)
        else:
            for other in (value + 1, value - 1):
                if other >= 0:
                    yield swapped(site, node, str(other), more=3)
        yield swapped(site, node, f"-{site.code(node)}", more=2)


@operator(
    "float",
    cost=1,
    why=msg(
        "{name} is a whole number. ROS has different types for whole numbers and for numbers with a "
        "point, and does not turn one into the other."
    ),
    fix=INSTEAD,
)
def as_float(site: Site) -> Iterator[Made]:
    """Yield whole numbers with a point."""
    for node in site.of(ast.Constant):
        if isinstance(node, ast.Constant) and type(node.value) is int:
            yield swapped(site, node, f"{node.value}.0")


@operator(
    "negative",
    cost=2,
    why=msg("The sign decides about the direction: plus is forwards and to the left."),
    fix=INSTEAD,
)
def negative(site: Site) -> Iterator[Made]:
    """Yield what follows a minus sign without it."""
    for node in site.of(ast.UnaryOp):
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
            yield swapped(site, node, site.code(node.operand))


@operator(
    "truth",
    cost=2,
    hides=True,
    why=msg("With the opposite of {name} the failed check passes."),
    fix=INSTEAD,
)
def truth(site: Site) -> Iterator[Made]:
    """Yield the other truth value."""
    for node in site.of(ast.Constant):
        if isinstance(node, ast.Constant) and isinstance(node.value, bool):
            yield swapped(site, node, str(not node.value))
    for call in site.of(ast.Call):
        if isinstance(call, ast.Call) and called_name(call) in ("int", "bool") and call.args:
            yield _opposite(site, call.args[0])
    for node in site.of(ast.Assign):
        value = getattr(node, "value", node)
        if isinstance(value, ast.Compare | ast.UnaryOp | ast.Attribute):
            bare = isinstance(value, ast.Attribute) and value.attr != "data"
            yield from () if bare else (_opposite(site, value),)


def _opposite(site: Site, value: ast.expr) -> Made:
    if isinstance(value, ast.UnaryOp) and isinstance(value.op, ast.Not):
        return swapped(site, value, site.code(value.operand))
    simple = isinstance(value, ast.Name | ast.Attribute | ast.Call)
    code = site.code(value)
    return swapped(site, value, f"not {code}" if simple else f"not ({code})")


@operator(
    "condition",
    cost=2,
    hides=True,
    why=msg("The lines that depend on the condition {name} run at the wrong times."),
    fix=INSTEAD,
)
def condition(site: Site) -> Iterator[Made]:
    """Yield the opposite of a condition."""
    for node in site.of((ast.If, ast.While, ast.IfExp)):
        assert isinstance(node, ast.If | ast.While | ast.IfExp)
        test = node.test
        if dotted(getattr(test, "left", test)) == "__name__" or isinstance(test, ast.Constant):
            continue
        if isinstance(test, ast.UnaryOp) and isinstance(test.op, ast.Not):
            yield swapped(site, test, site.code(test.operand))
        elif isinstance(test, ast.Name | ast.Attribute | ast.Call):
            yield swapped(site, test, f"not {site.code(test)}")
        elif isinstance(test, ast.Compare) and len(test.ops) == 1:
            sign = OTHER.get(type(test.ops[0]))
            if sign is not None:
                yield _between(site, test, test.left, test.comparators[0], sign)
        else:
            yield swapped(site, test, f"not ({site.code(test)})", more=1)


@operator(
    "part_not",
    cost=2,
    why=msg("One part of this condition is the other way round."),
    fix=INSTEAD,
)
def part_not(site: Site) -> Iterator[Made]:
    """Yield the parts of an and or or, each as its opposite."""
    for node in site.of(ast.BoolOp):
        assert isinstance(node, ast.BoolOp)
        for part in node.values:
            if isinstance(part, ast.UnaryOp) and isinstance(part.op, ast.Not):
                yield swapped(site, part, site.code(part.operand))
            elif isinstance(part, ast.Name | ast.Attribute | ast.Call):
                yield swapped(site, part, f"not {site.code(part)}")


@operator(
    "compared",
    cost=1,
    certain=True,
    why=msg(
        "{name} alone is true for each number but 0: each part of an and or or is compared alone."
    ),
    fix=INSTEAD,
)
def compared(site: Site) -> Iterator[Made]:
    """Yield the comparison of another part of an and or or for a part that has none."""
    for node in site.of(ast.BoolOp):
        parts = node.values if isinstance(node, ast.BoolOp) else []
        others = [one for one in parts if isinstance(one, ast.Compare)]
        for part, other in product(parts, others):
            alike = dotted(part).rpartition(".")[0] == dotted(other.left).rpartition(".")[0]
            if isinstance(part, ast.Name | ast.Attribute) and alike:
                rest = site.code(other)[len(site.code(other.left)) :]
                yield swapped(site, part, f"{site.code(part)}{rest}")


@operator(
    "order",
    cost=2,
    why=msg(
        "{name} compares the wrong way: it is true for the values for which it should be false."
    ),
    fix=INSTEAD,
)
def order(site: Site) -> Iterator[Made]:
    """Yield other comparisons of the same two values."""
    for node in site.of(ast.Compare):
        assert isinstance(node, ast.Compare)
        if len(node.ops) != 1 or type(node.ops[0]) not in ORDERS:
            continue
        for kind in ORDERS:
            if kind is not type(node.ops[0]):
                yield _between(site, node, node.left, node.comparators[0], SIGNS[kind])


@operator(
    "and_or",
    cost=2,
    why=msg("With `and` both parts have to be true, with `or` one of them is enough."),
    fix=INSTEAD,
)
def and_or(site: Site) -> Iterator[Made]:
    """Yield `and` in place of `or`, and the other way round."""
    for node in site.of(ast.BoolOp):
        assert isinstance(node, ast.BoolOp)
        if len(node.values) == 2:
            sign = "or" if isinstance(node.op, ast.And) else "and"
            yield _between(site, node, node.values[0], node.values[1], sign)


@operator(
    "sign",
    cost=2,
    why=msg("{name} works out another value than the one that is asked for."),
    fix=INSTEAD,
)
def sign(site: Site) -> Iterator[Made]:
    """Yield other signs between two values, and the two values in the other order."""
    for node in site.of(ast.BinOp):
        assert isinstance(node, ast.BinOp)
        if type(node.op) not in SUMS:
            continue
        for kind in SUMS:
            if kind is not type(node.op):
                yield _between(site, node, node.left, node.right, SIGNS[kind])
        if isinstance(node.op, ast.Sub | ast.Div):
            left, right = site.code(node.left), site.code(node.right)
            text = site.module.text
            splices = (text.swap(node.left, right), text.swap(node.right, left))
            yield Made(node, site.code(node), f"{right} {SIGNS[type(node.op)]} {left}", splices, 1)


@operator(
    "added",
    cost=1,
    why=msg("= replaces the old value in each call. += adds to it."),
    fix=INSTEAD,
)
def added(site: Site) -> Iterator[Made]:
    """Yield += in place of =, where an attribute is set anew."""
    for node in site.of(ast.Assign):
        assert isinstance(node, ast.Assign)
        target = node.targets[0]
        is_init = (site.function_of(node) or node) and _in_init(site, node)
        is_own = isinstance(target, ast.Attribute) and dotted(target.value) == "self"
        if is_own and not is_init and _is_number(site, dotted(target)[5:]):
            new = f"{site.code(target)} += {site.code(node.value)}"
            yield swapped(site, node, new)


def _is_number(site: Site, name: str) -> bool:
    """Whether some line sets an attribute to a number."""
    made = (site.module.parents.get(place) for place in site.attributes.get(name, ()))
    values = [getattr(getattr(one, "value", None), "value", None) for one in made]
    return any(type(value) in (int, float) for value in values)


def _in_init(site: Site, node: ast.AST) -> bool:
    function = site.function_of(node)
    return function is not None and function.name == "__init__"


@operator(
    "unkept",
    cost=1,
    certain=True,
    why=msg("This line works out a value and keeps it nowhere: nothing changes because of it."),
    fix=INSTEAD,
)
def unkept(site: Site) -> Iterator[Made]:
    """Yield a sum that is kept."""
    for node in site.of(ast.Expr):
        assert isinstance(node, ast.Expr)
        value = node.value
        if isinstance(value, ast.BinOp) and type(value.op) in SUMS and dotted(value.left):
            new = f"{site.code(value.left)} {SIGNS[type(value.op)]}= {site.code(value.right)}"
            yield swapped(site, node, new)
        elif isinstance(value, ast.Compare) and dotted(value.left) and len(value.ops) == 1:
            new = f"{site.code(value.left)} = {site.code(value.comparators[0])}"
            yield swapped(site, node, new)


@operator(
    "branches",
    cost=1,
    why=msg("The two values of this condition are in each other's place."),
    fix=INSTEAD,
)
def branches(site: Site) -> Iterator[Made]:
    """Yield both values of `a if b else c` in the other order."""
    for node in site.of(ast.IfExp):
        assert isinstance(node, ast.IfExp)
        body, other = site.code(node.body), site.code(node.orelse)
        text = site.module.text
        splices = (text.swap(node.body, other), text.swap(node.orelse, body))
        written = f"{other} if {site.code(node.test)} else {body}"
        yield Made(node, site.code(node), written, splices)


@operator(
    "text",
    cost=2,
    why=msg("ROS compares names and texts letter by letter, and here they differ."),
    fix=INSTEAD,
)
def text(site: Site) -> Iterator[Made]:
    """Yield the wanted names and texts in place of a plain text."""
    for node in site.of(ast.Constant):
        value = site.module.text.plain_string(node) if isinstance(node, ast.Constant) else None
        if not value or not isinstance(node, ast.Constant):
            continue
        around = site.module.parents.get(node)
        names = isinstance(around, ast.Call) and called_name(around) in NAMING
        quote = site.code(node)[0]
        for wanted in dict.fromkeys(site.wanted.texts):
            close = nearest(value, [wanted], cutoff=0.5)
            if wanted in (value, value.lstrip("/")) or quote in wanted or "\\" in wanted:
                continue
            if not names and not close:
                continue
            new, more = f"{quote}{wanted}{quote}", 0 if close else 2
            same = [
                n
                for n in site.of(ast.Constant)
                if isinstance(n, ast.Constant) and site.code(n) == site.code(node)
            ]
            if same[1:] and same[0] is node:
                splices = tuple(site.module.text.swap(one, new) for one in same)
                yield Made(node, site.code(node), new, splices, more)
            yield swapped(site, node, new, more=more)


@operator(
    "f_text",
    cost=1,
    why=msg("Without f before the quotes, {{ and }} are plain characters: no value stands there."),
    fix=INSTEAD,
)
def f_text(site: Site) -> Iterator[Made]:
    """Yield texts with places as f-strings."""
    for node in site.of(ast.Constant):
        value = site.module.text.plain_string(node) if isinstance(node, ast.Constant) else None
        if isinstance(node, ast.Constant) and value and "{" in value and "}" in value:
            yield swapped(site, node, f"f{site.code(node)}")
    for node in site.of(ast.JoinedStr):
        code = site.code(node) if isinstance(node, ast.JoinedStr) else ""
        if isinstance(node, ast.JoinedStr) and "{{" in code:
            yield swapped(site, node, code.replace("{{", "{").replace("}}", "}"))


@operator(
    "same_for_y",
    cost=3,
    why=msg("The condition asks for one direction only, and the other one matters just as much."),
    fix=INSTEAD,
)
def same_for_y(site: Site) -> Iterator[Made]:
    """Yield a comparison of x together with the same comparison of y."""
    for node in site.of(ast.Compare):
        assert isinstance(node, ast.Compare)
        code = site.code(node)
        for one, other in ((".x", ".y"), (".y", ".x")):
            if code.count(one) != 1 or other in code:
                continue
            again = code.replace(one, other)
            for word in ("and", "or"):
                around = site.module.parents.get(node)
                plain = f"{code} {word} {again}"
                yield swapped(site, node, plain if isinstance(around, ast.If) else f"({plain})")


@operator(
    "digits",
    cost=1,
    certain=True,
    why=msg(
        "{name} is a text, also if it has only digits: nothing can be added to it as to a number."
    ),
    fix=INSTEAD,
)
def digits(site: Site) -> Iterator[Made]:
    """Yield numbers in place of texts that are numbers."""
    for node in site.of(ast.Constant):
        value = node.value if isinstance(node, ast.Constant) else None
        if isinstance(node, ast.Constant) and isinstance(value, str) and NUMBER.fullmatch(value):
            yield swapped(site, node, value)


@operator(
    "as_text",
    cost=1,
    certain=True,
    why=msg("+ joins a text only to another text, and {name} is none."),
    fix=INSTEAD,
)
def as_text(site: Site) -> Iterator[Made]:
    """Yield str() around what is joined to a text."""
    for node in site.of(ast.BinOp):
        if not isinstance(node, ast.BinOp) or not isinstance(node.op, ast.Add):
            continue
        for one, other in ((node.left, node.right), (node.right, node.left)):
            text = isinstance(one, ast.JoinedStr) or isinstance(getattr(one, "value", None), str)
            if text and isinstance(other, ast.Name | ast.Attribute):
                yield swapped(site, other, f"str({site.code(other)})")


@operator(
    "bits",
    cost=1,
    certain=True,
    why=msg(
        "~, &, | and ^ work on the bits of whole numbers: ~True is -2, which counts as true. In a condition, "
        "not, and, or are meant, and a power is **."
    ),
    fix=INSTEAD,
)
def bits(site: Site) -> Iterator[Made]:
    """Yield `not`, `and`, `or` and `**` in place of the signs that work on bits."""
    for node in site.of(ast.UnaryOp):
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Invert):
            yield swapped(site, node, f"(not {site.code(node.operand)})")
    for node in site.of(ast.BinOp):
        word = BITS.get(type(node.op)) if isinstance(node, ast.BinOp) else None
        if isinstance(node, ast.BinOp) and word is not None:
            yield _between(site, node, node.left, node.right, word)


@operator(
    "part",
    cost=3,
    hides=True,
    why=msg("{name} is more than what is needed here, or another value."),
    fix=INSTEAD,
)
def part(site: Site) -> Iterator[Made]:
    """Yield a part of an expression in place of the whole: an operand, an item, an argument, a place."""
    for node in site.of((ast.BinOp, ast.List, ast.Tuple, ast.Subscript, ast.Call, ast.JoinedStr)):
        parts: list[ast.expr] = []
        if isinstance(node, ast.BinOp):
            parts = [node.left, node.right]
        elif isinstance(node, ast.List | ast.Tuple) and len(node.elts) == 1:
            parts = node.elts
        elif isinstance(node, ast.Subscript):
            parts = [node.value, node.slice]
        elif isinstance(node, ast.JoinedStr) and isinstance(node.values[-1], ast.FormattedValue):
            yield swapped(site, node, ast.unparse(node.values[-1].value))
        elif isinstance(node, ast.Call) and len(node.args) == 1:
            statement = isinstance(site.module.parents.get(node), ast.Expr)
            parts = [] if statement else node.args
        for one in parts:
            if isinstance(node, ast.expr) and not isinstance(one, ast.Starred | ast.Slice):
                yield swapped(site, node, site.code(one))


OPERATORS: tuple[Operator, ...] = (
    *(digits, as_text, bits),
    *(number, as_float, negative, truth, condition, compared, part_not, order, and_or, sign, added),
    *(unkept, branches, text, f_text, same_for_y, part),
)
