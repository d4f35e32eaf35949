"""Exceptions at the start and in callbacks: the line that is to be changed, and what is left alone."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.mistakes.test_from_source import RIGHT, line_of, look, raised
from tests.mistakes.test_named_exactly import changed, fix_of, patched

TEXT = "'Hello time: ' + str(self.counter_)"
STEP = "        self.counter_ += 1\n"
TIMER = "self.create_timer(1.0, self.timer_callback)"
START = "self.counter_ = 0"
UNKNOWN = "NameError: name '{}' is not defined"
NO_TEXT = (
    "TypeError: rclpy_logging_rcutils_log(): incompatible function arguments. The following argument "
    "types are supported:"
)
ON_METHOD = "AttributeError: 'method' object has no attribute 'count'"
SUPER = "super().__init__('my_first_node')"


def kind_of(error: str, text: str, at: str) -> str:
    found = raised(error, text, line_of(text, at))
    return f"{found.kind} {found.variant}".strip() if found is not None else ""


def test_a_static_variable_of_a_method_becomes_an_attribute(tmp_path: Path) -> None:
    text = changed(
        (f"        {START}\n", ""),
        ("str(self.counter_)", "str(self.timer_callback.count)"),
        (STEP, "        self.timer_callback.count += 1\n\n    timer_callback.count = 0\n"),
    )
    found = raised(ON_METHOD, text, line_of(text, "count += 1"))
    lines = f"{line_of(text, 'count))')}, {line_of(text, 'count += 1')}"
    assert fix_of(found) == (
        f"Write self.count instead of self.timer_callback.count in all lines: {lines}. Set it in "
        "__init__, before the timer is created: self.count = 0. Delete line "
        f"{line_of(text, 'count = 0')}."
    )
    new = patched(found, text, tmp_path)
    assert f"{SUPER}\n        self.count = 0\n" in new
    assert "timer_callback.count" not in new


def test_a_method_that_is_only_read_from_is_not_called() -> None:
    text = changed((STEP, f"{STEP}        self.last_ = self.timer_callback.count\n"))
    assert kind_of(ON_METHOD, text, "self.last_") == "node.not_called"


def test_a_function_of_the_file_needs_its_attribute_first() -> None:
    text = changed((STEP, f"{STEP}        main.count += 1\n"))
    error = "AttributeError: 'function' object has no attribute 'count'"
    found = raised(error, text, line_of(text, "main.count"))
    assert fix_of(found).startswith("Write main.count = 0 below the function main, on a line")


@pytest.mark.parametrize(
    ("last", "kind", "variant"),
    [
        ("return self", "MyFirstNode", "last"),
        ("return True", "bool", "last"),
        ("return self.get_logger()", "RcutilsLogger", "called"),
        ("if self.counter_:\n            return 0\n        self.n = 1", "int", ""),
        ("yield", "generator", "yield"),
    ],
)
def test_what_init_returns_is_named_at_its_own_line(
    last: str, kind: str, variant: str, tmp_path: Path
) -> None:
    text = changed((TIMER, f"{TIMER}\n        {last}"))
    error = f"TypeError: __init__() should return None, not '{kind}'"
    found = raised(error, text, line_of(text, "node = MyFirstNode()"))
    assert found is not None
    assert (found.kind, found.variant) == ("node.init_returns", variant)
    assert found.where is not None
    row = next(r for r in last.splitlines() if "return" in r or "yield" in r)
    assert found.where.line == line_of(text, row.strip())
    if variant in ("last", "yield"):
        assert patched(found, text, tmp_path) == RIGHT


@pytest.mark.parametrize("last", ["return", "return None", f"return {SUPER}"])
def test_an_init_that_returns_nothing_is_left_alone(last: str) -> None:
    text = changed((TIMER, f"{TIMER}\n        {last}"))
    error = "TypeError: __init__() should return None, not 'Other'"
    assert raised(error, text, line_of(text, "node = MyFirstNode()")) is None


@pytest.mark.parametrize(
    ("last", "variant"),
    [
        ("return 'end'", ""), ("return f'end {args}'", ""), ("return True", "value"),
        ("return 3", "value"), ("return node", "value"), ("sys.exit('end')", "exit"),
        ("sys.exit(1)", "exit"),
        ("return 0", None), ("return False", None), ("return None", None), ("return", None),
        ("sys.exit(0)", None), ("sys.exit()", None), ("print('end')", None), ("return args", None),
    ],
)  # fmt: skip
def test_what_main_returns_is_the_exit_status(last: str, variant: str | None) -> None:
    stop = "        rclpy.try_shutdown()\n"
    found = look("run.error_at_stop", changed((stop, f"{stop}    {last}\n")))
    ours = found if found is not None and found.kind == "node.status_of_main" else None
    assert (ours.variant if ours is not None else None) == variant


@pytest.mark.parametrize(
    ("old", "new", "name", "kind"),
    [
        (START, f"{START}  % startwert", "startwert", "node.comment_sign percent"),
        (STEP, "        self.counter_ += 1  % plus\n", "plus", "node.comment_sign percent"),
        (TIMER, f"{TIMER}  % takt", "takt", "node.comment_sign percent"),
        (TIMER, f"self.timer_ = {TIMER}  % takt", "takt", "node.comment_sign percent"),
        (START, f"{START}  -- startwert", "startwert", "node.comment_sign dashes"),
        (START, f"{START}  ; startwert", "startwert", "node.comment_sign semicolon"),
        (START, f"{START}  // startwert", "startwert", "node.slash_comment"),
        # a calculation with a name that is wrong
        (START, "self.counter_ = 100 % limit", "limit", "node.name_unknown"),
        (START, "self.counter_ = self.counter % limit", "limit", "node.name_unknown"),
        (TEXT, "'Hello time: %d' % counter", "counter", "node.name_unknown"),
        (f"info({TEXT})", "info('Hello time: %d') % zahl", "zahl", "node.name_unknown"),
        (START, "limits = 5\n        self.counter_ = 0 % limit", "limit", "node.name_unknown instead"),
        (START, "limits = 5\n        self.counter_ = 9 // limit", "limit", "node.name_unknown instead"),
    ],
)  # fmt: skip
def test_a_comment_of_another_language(old: str, new: str, name: str, kind: str) -> None:
    text = changed((old, new))
    assert kind_of(UNKNOWN.format(name), text, new.strip().splitlines()[-1]) == kind


@pytest.mark.parametrize(
    ("line", "kind"),
    [
        ("#define PERIOD 1.0", "node.define_comment"),
        ("# define PERIOD = 1.0;", "node.define_comment"),
        ("#define PERIOD SECONDS(1)", "node.define_comment open"),
        ("# PERIOD = 1.0", "node.commented_out"),
        ("'PERIOD = 1.0'", "node.commented_out assigned"),
        ('"""\nPERIOD = 1.0\n"""', "node.commented_out assigned"),
        ("float: PERIOD = 1.0", "node.type_first"),
        ("#define PERIODE 1.0", "node.name_unknown period"),
        ("# the PERIOD of the timer", "node.name_unknown period"),
        ("TEXT = 'PERIOD = 1.0'", "node.name_unknown period"),
    ],
)
def test_the_line_that_was_to_define_a_constant(line: str, kind: str) -> None:
    text = changed(("class MyFirst", f"{line}\n\n\nclass MyFirst"), ("(1.0,", "(PERIOD,"))
    assert kind_of(UNKNOWN.format("PERIOD"), text, "create_timer") == kind


def test_a_type_before_the_name_is_the_name_that_gets_the_value(tmp_path: Path) -> None:
    text = changed((START, f"int: {START}"))
    error = "AttributeError: 'MyFirstNode' object has no attribute 'counter_'"
    found = raised(error, text, line_of(text, "get_logger"))
    assert fix_of(found) == "Write self.counter_ = 0 instead of int: self.counter_ = 0."
    assert patched(found, text, tmp_path) == RIGHT
    right = changed((START, "self.other_: int = 0"))
    assert kind_of(error, right, "get_logger") == "node.attribute_not_set"


def test_a_dict_has_entries_and_no_attributes(tmp_path: Path) -> None:
    text = changed(
        (START, "self.data = {}\n        self.data.counter = 0"),
        ("str(self.counter_)", "str(self.data.counter)"),
        ("self.counter_ += 1", "self.data.counter += 1"),
    )
    error = "AttributeError: 'dict' object has no attribute 'counter'"
    found = raised(error, text, line_of(text, "counter = 0"))
    assert "Write self.data['counter'] instead of self.data.counter. Do the same" in fix_of(found)
    assert patched(found, text, tmp_path) == text.replace("data.counter", "data['counter']")
    unknown = text.replace("self.data = {}", "self.data = self.load()")
    assert kind_of(error, unknown, "counter = 0") == "node.attribute_unknown"


@pytest.mark.parametrize(
    ("named", "kind"),
    [
        ("KeyboardInterrupt()", "node.except_no_class"),
        ("'KeyboardInterrupt'", "node.except_no_class other"),
        ("rclpy", "node.not_an_exception"),
    ],
)
def test_an_except_names_a_class(named: str, kind: str) -> None:
    text = changed(("except KeyboardInterrupt:", f"except {named}:"))
    error = "TypeError: catching classes that do not inherit from BaseException is not allowed"
    assert kind_of(error, text, "except ") == kind


@pytest.mark.parametrize(
    ("code", "error", "kind", "new"),
    [
        ("'Hello time: {self.counter_}'.format()", "KeyError: 'self'", "f_string",
         "f'Hello time: {self.counter_}'"),
        ("'Hello time: {counter}'.format(self.counter_)", "KeyError: 'counter'", "empty",
         "'Hello time: {}'.format(self.counter_)"),
        ("'Hello time: {n:d}'.format(self.counter_)", "KeyError: 'n'", "empty",
         "'Hello time: {:d}'.format(self.counter_)"),
        ("'Hello time: {n}'.format(m=self.counter_)", "KeyError: 'n'", "keyword",
         "'Hello time: {n}'.format(n=self.counter_)"),
        ("'Hello time: {1}'.format(self.counter_)", "IndexError: Replacement index 1 out of range "
         "for positional args tuple", "counted", "'Hello time: {0}'.format(self.counter_)"),
        ("'Hello time: {3}'.format(self.counter_)", "IndexError: Replacement index 3 out of range "
         "for positional args tuple", "counted", "'Hello time: {0}'.format(self.counter_)"),
        ("'{0} {2}'.format(1, self.counter_)", "IndexError: Replacement index 2 out of range for "
         "positional args tuple", "highest", ""),
        ("'Hello {} {}'.format(self.counter_)", "IndexError: Replacement index 1 out of range for "
         "positional args tuple", "too_many", ""),
        ("'Hello time: %(n)d' % {'m': self.counter_}", "KeyError: 'n'", "key",
         "'Hello time: %(n)d' % {'n': self.counter_}"),
        ("'{a} {b}'.format(a=self.counter_)", "KeyError: 'b'", "value", ""),
    ],
)  # fmt: skip
def test_the_places_of_a_text(code: str, error: str, kind: str, new: str, tmp_path: Path) -> None:
    text = changed((TEXT, code))
    found = raised(error, text, line_of(text, "get_logger"))
    assert found is not None
    assert (found.kind, found.variant) == ("node.format_value_missing", kind)
    assert fix_of(found)
    assert patched(found, text, tmp_path) == (RIGHT.replace(TEXT, new) if new else "")


def test_a_text_in_a_variable_is_named_at_its_own_line(tmp_path: Path) -> None:
    log = "self.get_logger().info("
    made = "text = 'Hello time: {n}'\n        "
    text = changed((f"{log}{TEXT})", f"{made}{log}text.format(self.counter_))"))
    found = raised("KeyError: 'n'", text, line_of(text, "get_logger"))
    assert found is not None
    assert found.where is not None
    assert found.where.line == line_of(text, "text =")
    assert patched(found, text, tmp_path) == text.replace("{n}", "{}")


def test_the_key_of_a_dict_is_no_place_of_a_text() -> None:
    text = changed((TEXT, "self.texts_['n'].format(1)"))
    assert kind_of("KeyError: 'n'", text, "texts_") == "node.no_such_item key"


LAMBDA = "TypeError: MyFirstNode.__init__.<locals>.<lambda>() missing 1 required positional argument: '{}'"


@pytest.mark.parametrize(
    ("given", "name", "new"),
    [
        ("lambda self: self.timer_callback()", "self", "lambda: self.timer_callback()"),
        ("lambda e: self.timer_callback()", "e", "lambda: self.timer_callback()"),
        ("lambda e: self.timer_callback(e)", "e", ""),
    ],
)
def test_a_lambda_with_a_parameter(given: str, name: str, new: str, tmp_path: Path) -> None:
    text = changed(("self.timer_callback)", f"{given})"))
    found = raised(LAMBDA.format(name), text, line_of(text, "rclpy.spin("))
    assert found is not None
    assert found.kind == "node.inner_callback_parameter"
    assert found.where is not None
    assert found.where.line == line_of(text, "lambda")
    assert patched(found, text, tmp_path) == (text.replace(given, new) if new else "")


def test_a_lambda_that_the_timer_can_call_is_left_alone() -> None:
    text = changed(
        ("self.timer_callback)", "lambda *args: self.timer_callback())"),
        (STEP, f"{STEP}        self.f = lambda e: e\n        self.f()\n"),
    )
    error = LAMBDA.format("e").replace("__init__", "timer_callback")
    assert raised(error, text, line_of(text, "self.f()")) is None


@pytest.mark.parametrize(("parameter", "used"), [("self", "self"), ("event", "self"), ("n", "n")])
def test_a_function_inside_of_a_method_with_a_parameter(
    parameter: str, used: str, tmp_path: Path
) -> None:
    head = f"def tick({parameter}):"
    inner = f"{head}\n            print({used})\n\n        self.create_timer(1.0, tick)"
    text = changed((TIMER, inner))
    error = LAMBDA.format(parameter).replace("<lambda>", "tick")
    found = raised(error, text, line_of(text, "rclpy.spin("))
    assert found is not None
    assert found.kind == "node.inner_callback_parameter"
    assert found.where is not None
    assert found.where.line == line_of(text, head)
    fixed = "" if used == "n" else text.replace(head, "def tick():")
    assert patched(found, text, tmp_path) == fixed


@pytest.mark.parametrize(
    ("given", "variant", "new"),
    [
        ("['Hello time: ', str(self.counter_)]", "list", TEXT),
        ("('Hello time: ', self.counter_)", "tuple", TEXT),
        ("self.counter_", "counter", "f'Hello time: {self.counter_}'"),
        ("5", "number", "str(5)"),
        ("self.timer_callback", "method", "self.timer_callback()"),
        ("self.other_", "unknown", "str(self.other_)"),
    ],
)  # fmt: skip
def test_what_is_no_text_for_the_logger(given: str, variant: str, new: str, tmp_path: Path) -> None:
    text = changed((TEXT, given))
    found = raised(NO_TEXT, text, line_of(text, "get_logger"))
    assert found is not None
    assert (found.kind, found.variant) == ("node.logged_no_text", variant)
    assert fix_of(found)
    assert patched(found, text, tmp_path) == (RIGHT.replace(TEXT, new) if new else "")


@pytest.mark.parametrize(
    ("made", "name", "at", "fix"),
    [
        ("text = ['Hello time: ', str(self.counter_)]", "text", "text =", f"Write {TEXT} instead"),
        ("text = 'Hello time: ', self.counter_", "text", "text =", f"Write {TEXT} instead"),
        ("msg = String()\n        msg.data = 'x'", "msg", "info(msg)", "Write msg.data instead"),
        ("msg = Int32()\n        msg.data = 1", "msg", "info(msg)", "Write str(msg.data) instead"),
        (
            "n = [0]",
            "n",
            "info(n)",
            "Give a text to the logger. If the value of n is what you want",
        ),
        ("n = ['a']\n        n.append('b')", "n", "info(n)", "Give a text to the logger."),
        ("msg = Pose()", "msg", "info(msg)", "Write str(msg.…) instead of msg, with the name"),
    ],
)
def test_the_line_that_made_what_is_no_text(made: str, name: str, at: str, fix: str) -> None:
    text = changed(
        ("import rclpy\n", "import rclpy\nfrom a.msg import Int32, Pose, String\n"),
        (f"self.get_logger().info({TEXT})", f"{made}\n        self.get_logger().info({name})"),
    )
    found = raised(NO_TEXT, text, line_of(text, f"info({name})"))
    assert fix_of(found).startswith(fix)
    assert found is not None
    assert found.where is not None
    assert found.where.line == line_of(text, at)


@pytest.mark.parametrize(
    ("code", "new"),
    [
        ("RCLCPP_INFO(self.get_logger(), 'Hello time: %d', self.counter_)",
         "self.get_logger().info('Hello time: %d' % self.counter_)"),
        ("printf('Hello time: %d', self.counter_)",
         "self.get_logger().info('Hello time: %d' % self.counter_)"),
        ("printf('Hello %d', self.counter_ + 1)",
         "self.get_logger().info('Hello %d' % (self.counter_ + 1,))"),
        ('printf("Hello time: %d\\n", self.counter_)',
         'self.get_logger().info("Hello time: %d" % self.counter_)'),
        ("printf('Hello')", "self.get_logger().info('Hello')"),
        ("printf('Hello %zu', self.counter_)", ""),
        ("printf(self.counter_)", ""),
    ],
)  # fmt: skip
def test_what_another_language_prints_is_logged(code: str, new: str, tmp_path: Path) -> None:
    text = changed((f"self.get_logger().info({TEXT})", code))
    name = code.partition("(")[0]
    found = raised(UNKNOWN.format(name), text, line_of(text, code))
    assert found is not None
    assert found.kind == "node.other_language"
    assert patched(found, text, tmp_path) == (text.replace(code, new) if new else "")
