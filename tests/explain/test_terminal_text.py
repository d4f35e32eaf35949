"""Mistakes of a source are recognised in terminal output (those of the terminal: test_terminals).

The texts are those that ROS 2, colcon, Python and the shell
print (recorded on rclpy 9.1.2, ros2cli and colcon-core 0.21.3; the table of beginners' mistakes).
"""

from __future__ import annotations

import time

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grader.explain.from_terminal import ENTRIES, seen_in
from grader.mistakes.catalogue import CATALOGUE

TRACE = 'Traceback (most recent call last):\n  File "/ws/install/x/lib/x/test_node", line 33\n'
SHOWN = {
    "node.recursion": ["RecursionError: maximum recursion depth exceeded"],
    "build.entry_unreadable": [
        "  raise RuntimeError(\nRuntimeError: 'distutils.core.setup()' was never called -- "
        "perhaps 'setup.py' is not a Distutils setup script?"
    ],
    "source.syntax_error": [
        "SyntaxError: invalid syntax. Maybe you meant '==' or ':=' instead of '='?",
        "TabError: inconsistent use of tabs and spaces in indentation",
        "IndentationError: unindent does not match any outer indentation level",
    ],
    "setup.misspelt_module": [
        '  File "<frozen importlib._bootstrap>", line 1387, in _gcd_import\n'
        "ModuleNotFoundError: No module named 'my_robot_controller.my_frist_node'"
    ],
    "node.f_prefix": [
        "[INFO] [1795271258.137196884] [my_first_node]: Hello time: {self.counter_}",
    ],
    "setup.py_in_target": [
        "ModuleNotFoundError: No module named 'my_robot_controller.my_first_node.py'; "
        "'my_robot_controller.my_first_node' is not a package"
    ],
    "setup.dot_for_colon": [
        "ModuleNotFoundError: No module named 'my_robot_controller.my_first_node.main'; "
        "'my_robot_controller.my_first_node' is not a package"
    ],
    "setup.no_function": ["TypeError: 'module' object is not callable"],
    "node.main_missing": [
        "AttributeError: module 'my_robot_controller.my_first_node' has no attribute 'main'"
    ],
    "package.marker_missing": [
        "error: can't copy 'resource/my_robot_controller': doesn't exist or not a regular file"
    ],
    "package.marker_not_installed": [
        "WARNING:colcon.colcon_ros.task.ament_python.build:Package 'x' doesn't explicitly install "
        "a marker in the package index (colcon-ros currently does it implicitly)"
    ],
    "package.build_type": [
        'CMake Error: The source directory "/ws/src/x" does not appear to contain CMakeLists.txt.'
    ],
    "package.duplicate": [
        "ERROR:colcon:colcon build: Duplicate package names not supported:\n- my_robot_controller:"
    ],
    "node.super_missing": [
        "AttributeError: 'MyNode' object has no attribute '_default_callback_group'"
    ],
    "node.super_without_name": [
        "TypeError: Node.__init__() missing 1 required positional argument: 'node_name'"
    ],
    "node.not_a_node": [
        "TypeError: object.__init__() takes exactly one argument (the instance to initialize)"
    ],
    "node.callback_called": [
        "UnboundLocalError: cannot access local variable 'arg_name' where it is not associated",
        "TypeError: 'NoneType' object is not callable",
    ],
    "node.attribute_unknown": [
        "AttributeError: 'MyNode' object has no attribute 'timer_calback'. Did you mean: 'x'?"
    ],
    "node.init_missing": [
        "rclpy.exceptions.NotInitializedException: rclpy.init() has not been called. msg:cannot "
        "create node"
    ],
    "node.init_twice": ["RuntimeError: Context.init() must only be called once"],
    "node.not_callable": ["TypeError: 'int' object is not callable"],
    "node.logger_call": [
        "AttributeError: 'RcutilsLogger' object has no attribute 'print'",
        "TypeError: RcutilsLogger.log() missing 1 required positional argument: 'severity'",
        "TypeError: Node.get_logger() takes 1 positional argument but 2 were given",
        "AttributeError: 'function' object has no attribute 'info'",
        "TypeError: RcutilsLogger.info() takes 2 positional arguments but 3 were given",
    ],
    "node.class_not_called": ["TypeError: 'property' object is not iterable"],
    "node.str_plus_int": ['TypeError: can only concatenate str (not "int") to str'],
    "node.counter_local": [
        "UnboundLocalError: cannot access local variable 'counter' where it is not associated "
        "with a value"
    ],
    "node.self_outside": ["NameError: name 'self' is not defined"],
    "node.other_language": ["NameError: name 'null' is not defined"],
    "node.used_before_set": [
        "UnboundLocalError: cannot access local variable 'node' where it is not associated with a "
        "value",
        "UnboundLocalError: local variable 'node' referenced before assignment",
    ],
    "node.name_unknown": ["NameError: name 'string' is not defined"],
    "node.import_missing": [],
    "node.callback_no_self": [
        "ValueError: invalid method signature",
        "TypeError: MyNode.timer_callback() takes 0 positional arguments but 1 was given",
        "TypeError: MyNode.timer_callback() missing 1 required positional argument: 'msg'",
    ],
    "node.timer_arguments": [
        "TypeError: float() argument must be a string or a real number, not 'method'",
        "TypeError: float() argument must be a string or a real number, not 'tuple'",
        "ValueError: could not convert string to float: '1.0s'",
        "TypeError: Node.create_timer() missing 1 required positional argument: 'callback'",
    ],
    "node.name_invalid": [
        "rclpy.exceptions.InvalidNodeNameException: Invalid node name: node name must not contain "
        "characters other than alphanumerics or '_':\n  'my-node'\n     ^"
    ],
    "node.import_name": [
        "ImportError: cannot import name 'Node' from 'rclpy' (/opt/ros/jazzy/lib/python3.12/site-"
        "packages/rclpy/__init__.py)",
        "ImportError: cannot import name 'Nod' from 'rclpy.node' (/opt/ros)",
    ],
    "source.not_executable": ["bash: ./my_first_node.py: Permission denied"],
    "source.no_shebang": [
        "./my_first_node.py: line 1: import: command not found\n./my_first_node.py: line 4: "
        "syntax error near unexpected token `('"
    ],
    "source.crlf": [
        "/usr/bin/env: \u2018python3\\r\u2019: No such file or directory",
        "/usr/bin/env: 'python3\\r': No such file or directory",
    ],
    "node.main_wants_args": ["TypeError: main() missing 1 required positional argument: 'args'"],
    "run.shutdown_twice": [
        "rclpy._rclpy_pybind11.RCLError: failed to shutdown: rcl_shutdown already called on the "
        "given context, at ./src/rcl/init.c:333"
    ],
    "run.interrupt_traceback": [TRACE + "KeyboardInterrupt"],
    "node.not_for_with": [
        "TypeError: 'NoneType' object does not support the context manager protocol",
    ],
    "source.not_utf8": ["SyntaxError: Non-UTF-8 code starting with '\\xe4' in file my_first_node.py"],
    "package.setup_cfg_syntax": ["configparser.MissingSectionHeaderError: File contains no section "
                                 "headers."],
    "setup.missing": ["python3: can't open file '/ws/src/x/setup.py': [Errno 2] No such file"],
}  # fmt: skip
CASES = [(mistake, text) for mistake, texts in SHOWN.items() for text in texts]


@pytest.mark.parametrize(("mistake", "text"), CASES)
def test_a_mistake_is_recognised_in_what_the_terminal_shows(mistake: str, text: str) -> None:
    around = f"[INFO] [1795226661.262229158] [other]: hello\n{text}\n[ros2run]: Process exited\n"
    assert mistake in [seen.kind.id for seen in seen_in(around)]
    (first, *_) = seen_in(text)
    assert first.kind.id == mistake
    assert first.line in text


def test_every_mistake_with_a_pattern_matches_some_text() -> None:
    patterns = {k.id for k in CATALOGUE.values() if k.seen}
    assert patterns - {mistake for mistake, texts in SHOWN.items() if texts} == set()


@pytest.mark.parametrize(
    "text",
    [
        "[INFO] [1795226661.262229158] [my_first_node]: Hello time: 0",
        "Starting >>> my_robot_controller\nFinished <<< my_robot_controller [1.46s]\n\n"
        "Summary: 1 package finished [1.61s]",
        # a build that failed is not a build without a package
        "Summary: 0 packages finished [0.66s]\n  1 package failed: my_robot_controller\n  1 package "
        "had stderr output: my_robot_controller",
        "Summary: 0 packages finished [0.66s]\n  1 package aborted: my_robot_controller",
        "my_robot_controller test_node",
        "",
    ],
)
def test_no_mistake_is_found_in_right_output(text: str) -> None:
    assert seen_in(text) == []


def test_the_root_cause_comes_before_its_consequences() -> None:
    text = "No executable found\n'distutils.core.setup()' was never called\n"
    assert [s.kind.id for s in seen_in(text)] == ["build.entry_unreadable", "lab.no_executable"]


@pytest.mark.parametrize(
    ("cause", "kind"),
    [
        (
            "WARNING:colcon.colcon_core.package_selection:ignoring unknown package 'my_robot' in "
            "--packages-select",
            "lab.unknown_select",
        ),
        (
            "ERROR:colcon:colcon build: Duplicate package names not supported:\n- my_robot:",
            "package.duplicate",
        ),
    ],
)
def test_a_build_of_nothing_has_the_cause_that_stands_above_it(cause: str, kind: str) -> None:
    text = f"{cause}\n\nSummary: 0 packages finished [0.16s]\n"
    assert [seen.kind.id for seen in seen_in(text)] == [kind]


def test_parts_of_the_text_become_parameters() -> None:
    (seen,) = seen_in("NameError: name 'Nod' is not defined. Did you mean: 'Node'?")
    assert seen.params == {"name": "Nod"}


@settings(max_examples=60)
@given(
    st.lists(
        st.one_of(st.text(max_size=80), st.sampled_from([text for _, text in CASES])), max_size=30
    )
)
def test_any_text_is_searched_without_an_error(parts: list[str]) -> None:
    for seen in seen_in("\n".join(parts)):
        assert seen.kind.id in ENTRIES


@pytest.mark.parametrize(
    "part",
    ["a", "\n", "'", "ModuleNotFoundError: No module named '", "install/", "/src/a/", "a.",
     "AttributeError: module 'a' has no attribute 'b'\n", "python3", "import: ", "TypeError: a"],
)  # fmt: skip
def test_a_hostile_text_takes_little_time(part: str) -> None:
    text = part * (1_000_000 // len(part))
    begin = time.process_time()
    seen_in(text)
    assert time.process_time() - begin < 2
