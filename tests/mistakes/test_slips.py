"""What a beginner would call the error at which Python stops: its name, its line, and the fix."""

from __future__ import annotations

import time

import pytest

from grader.mistakes.slips import description
from grader.package.source.code_only import code_only
from grader.package.source.pasted import labels_in
from grader.package.source.python import can_parse
from grader.package.source.slips import slip_of

COMMANDS = (
    "chmod +x my_first_node.py",
    "cd ..",
    "  cd ~",
    "colcon build --packages-select=a",
    "export A=1",
    "python3 my_first_node.py",
    "sudo apt install -y x",
    "mkdir -p ~/ros2_ws/src",
    ". install/setup.bash",
    "./my_first_node.py",
    "ros2 run a b --ros-args -p use_sim_time:=true",
    "source install/setup.bash",
    "git clone https://a.b/c.git",
    'echo "source /opt/ros/jazzy/setup.bash" >> ~/.bashrc',
    "code .",
    "ros2 pkg create a --build-type ament_python",
)
# what is written, the variant, its line, and the file after the fix ("" if there is none)
PASTED = [
    ("a = \u201cx\u201d\n", "signs", 1, 'a = "x"\n'),
    ("a = 'x\u2019\n", "signs", 1, "a = 'x'\n"),
    ("a = \u201eit's\u201c\n", "signs", 1, 'a = "it\'s"\n'),
    ("def f():\n    \u201c\u201c\u201cText\n    of f.\u201d\u201d\u201d\n", "signs", 2,
     'def f():\n    """Text\n    of f."""\n'),
    ("if 1:\n\u00a0\u00a0\u00a0\u00a0a = 1\n", "signs", 2, "if 1:\n    a = 1\n"),
    ("a\u200b = 1\n", "signs", 1, "a = 1\n"),
    ("a = 2 \u2212 1\n", "signs", 1, "a = 2 - 1\n"),
    ("print\uff081\uff0c 2\uff09\n", "signs", 1, "print(1, 2)\n"),
    ("```python\r\na = 1\r\n```\r\n", "lines", 1, "a = 1\r\n"),
    ("Here's the node:\n\n```python\ndef a(): ...\n```\n### How it works\n- It isn't a topic.\n",
     "around", 3, "def a(): ...\n"),
    ("def a(): ...\n```\n- The timer fires.\n", "around", 2, "def a(): ...\n"),
    ("Sure, here is it:\n```\ndef a(): ...\n", "around", 2, "def a(): ...\n"),
    ("Copy code\na = 1\n", "lines", 1, "a = 1\n"),
    (">>> if 1:\n...     a = 1\n", "lines", 1, "if 1:\n    a = 1\n"),
    ("a = 1\ncd ~/ros2_ws && colcon build\nb = 2\n", "lines", 2, "a = 1\nb = 2\n"),
    ("jane@pc:~/ros2_ws$ ros2 run a b\na = 1\n", "lines", 1, "a = 1\n"),
    *(
        (f"a = 1\n{command}\nb = 2\n", "lines", 2, "a = 1\nb = 2\n")
        for command in COMMANDS
    ),
]  # fmt: skip
DOCUMENTS = [
    ("a = 1\n>>>>>>> Stashed changes\nb = 1\n", "conflict", 2, ""),
    ("\n<!DOCTYPE html>\n<html>\n", "document", 2, ""),
    ("<?xml version='1.0'?>\n<package>\n", "document", 1, ""),
    ('{"cells": [\n', "notebook", 1, ""),
    ("{\\rtf1 a\n", "document", 1, ""),
    ("a = 1\n<<<<<<< HEAD\nb = 1\n=======\nb = 2\n>>>>>>> main\n", "conflict", 2, ""),
]
LANGUAGE = [
    ("a = 0\na++\n", "increment", 2, "a = 0\na += 1\n"),
    ("a = 0\na.b--;\n", "increment", 2, "a = 0\na.b -= 1\n"),
    ("print(str(a++))\n", "increment_inside", 1, ""),
    ("// it's mine\na = 1\n", "comment", 1, "# it's mine\na = 1\n"),
    ("a = 4 // 2  // the half\n", "comment", 1, "a = 4 // 2  # the half\n"),
    ("a = 4  // see http://a.b of me\n", "comment", 1, "a = 4  # see http://a.b of me\n"),
    ("/* mine */\na = 1\n", "comment", 1, "# mine\na = 1\n"),
    ("b = a && !c || d != e\n", "operator", 1, "b = a and not c or d != e\n"),
    ("if a:\n    pass\nelse if b:\n    pass\n", "elif", 3, "if a:\n    pass\nelif b:\n    pass\n"),
    ("int a = 1\n", "declaration", 1, "a = 1\n"),
    ("this->a = 1\n", "this", 1, "self.a = 1\n"),
    ("let a = 1;\n", "declaration", 1, "a = 1;\n"),
    ("void main():\n    pass\n", "function", 1, "def main():\n    pass\n"),
    ("a = new Node('x')\n", "new", 1, "a = Node('x')\n"),
    ("self->a = 1\n", "member", 1, "self.a = 1\n"),
    ("rclpy::init()\n", "member", 1, "rclpy.init()\n"),
    ("define f(a):\n    pass\n", "function", 1, "def f(a):\n    pass\n"),
    ("f()->a = 1\n", "member", 1, "f().a = 1\n"),
    ("if a {\n    b = 1\n}\n", "braces", 1, "if a:\n    b = 1\n"),
    ("def f() {\n    if a: {\n        b = 1\n    }\n}\n", "braces", 1,
     "def f():\n    if a:\n        b = 1\n"),
]  # fmt: skip
TRY = "def f():\n    try:\n        {0}\n{1}\n\nf()\n"
PASS = "    except KeyboardInterrupt:\n        pass"
METHOD = "class A:\n    def f(self):\n        a = 1\n"
SMALLEST = [
    ('def f():\n    try:\n        a()\n            b()\n    except C: pass\n', 4, 'def f():\n    try:\n        a()\n        b()\n    except C: pass\n'),
    ('import a\n    import b\n', 2, 'import a\nimport b\n'),
    ('    import b\ndef c():\n    pass\n', 1, 'import b\ndef c():\n    pass\n'),
    ("a = f 'b{c}'\n", 1, "a = f'b{c}'\n"),
    ("f(a_b')\n", 1, "f('a_b')\n"),
    ("return_(f'b {c})\n", 1, "return_(f'b {c}')\n"),
    ('def f():\na()\nb()\n    c()\n', 2, 'def f():\n    a()\n    b()\n    c()\n'),
    ('from a import b,\n', 1, 'from a import b\n'),
    ('def f();\n    g()\n', 1, 'def f():\n    g()\n'),
    ("if a == 'b' c()\n", 1, "if a == 'b': c()\n"),
    ('a = f"b {c}\'\n', 1, 'a = f"b {c}"\n'),
    ("class A:\n    def b(self):\n        super(.b('c')\n", 3, "class A:\n    def b(self):\n        super().b('c')\n"),
    ('class TickNode):\n    a = 1\n', 1, 'class Tick(Node):\n    a = 1\n'),
    ('f(\n    a=1;\n    b=2,\n)\n', 2, 'f(\n    a=1,\n    b=2,\n)\n'),
    ("f(\n    a=[\n        ('b', 'c' + d]),\n    ],\n)\n", 3, "f(\n    a=[\n        ('b', ['c' + d]),\n    ],\n)\n"),
    ('from a import b c\n', 1, 'from a import b, c\n'),
    ('try:\n    a()\nexcept (K, E) e:\n    pass\n', 3, 'try:\n    a()\nexcept (K, E) as e:\n    pass\n'),
    ('try:\n    a()\nexcept K:\nfinally:\n    b()\n', 3, 'try:\n    a()\nexcept K:\n    pass\nfinally:\n    b()\n'),
    ('class A:\n    def b(self):\n        c()\n\n        def d(self):\n        # e\n        f()\n', 5, 'class A:\n    def b(self):\n        c()\n\n    def d(self):\n        # e\n        f()\n'),
    ('class A:\n    @property\n    b(self):\n        c()\n', 3, 'class A:\n    @property\n    def b(self):\n        c()\n'),
    ('def f():\n    a = 0\n    def g():\n        nonloca a\n', 4, 'def f():\n    a = 0\n    def g():\n        nonlocal a\n'),
    ('if a:\n    b()\n    else:\n    c()\n', 3, 'if a:\n    b()\nelse:\n    c()\n'),
    ('if a:\n    b()\n    else:\n        c()\n', 3, 'if a:\n    b()\nelse:\n        c()\n'),
    ("a = f'b {c}}'\n", 1, "a = f'b {c}'\n"),
    ("a = f'b {{c}'\n", 1, "a = f'b {c}'\n"),
    ('def f():\n   a()\n    b()\n    c()\n', 2, 'def f():\n    a()\n    b()\n    c()\n'),
    ('f(1,, 2)\n', 1, 'f(1, 2)\n'),
    ('f(\n    1,\n    ,\n)\n', 3, 'f(\n    1,\n    \n)\n'),
    ('f(, 1)\n', 1, 'f( 1)\n'),
    ("a = {\n    'b' = [1],\n}\n", 2, "a = {\n    'b' : [1],\n}\n"),
    ('f(\n    a=1,\n    b: 2,\n)\n', 3, 'f(\n    a=1,\n    b= 2,\n)\n'),
    ("f('a)\n", 1, "f('a')\n"),
    ("f(\n    c=1,\n    a=b-2.0',\n)\n", 3, "f(\n    c=1,\n    a='b-2.0',\n)\n"),
    ('a = f(b(1)))\n', 1, 'a = f(b(1))\n'),
    ('a = [f(\n    1,\n)]]\n', 3, 'a = [f(\n    1,\n)]\n'),
    ("a = f'b {c'\n", 1, "a = f'b {c}'\n"),
    ("a = f'b {str(c)'\n", 1, "a = f'b {str(c)}'\n"),
    ('def f:\n    pass\n', 1, 'def f():\n    pass\n'),
    ('class A:\n    def f:\n        pass\n', 2, 'class A:\n    def f(self):\n        pass\n'),
    ('if a:\n    f(1) b = 2\n', 2, 'if a:\n    f(1)\n    b = 2\n'),
    ('f(1):\na = 1\n', 1, 'f(1)\na = 1\n'),
    ('def f(self):\n    self.a = 1:  # one\n', 2, 'def f(self):\n    self.a = 1  # one\n'),
    ('class A:\n    f(self):\n        pass\n', 2, 'class A:\n    def f(self):\n        pass\n'),
    ('f():\n    a = 1\n', 1, 'def f():\n    a = 1\n'),
    ('if a = 1:\n    b = 2\n', 1, 'if a == 1:\n    b = 2\n'),
    ('def f():\na = 1\n    b = 2\n', 2, 'def f():\n    a = 1\n    b = 2\n'),
    ('try:\na = 1\nexcept KeyError:\n    pass\n', 2, 'try:\n    a = 1\nexcept KeyError:\n    pass\n'),
    ('def f():\n    a = 1\nb = 2\n    c = 3\n    d = 4\n', 3, 'def f():\n    a = 1\n    b = 2\n    c = 3\n    d = 4\n'),
    ('if f(a) = 1:\n    pass\n', 1, 'if f(a) == 1:\n    pass\n'),
    ('form a.b import c\n', 1, 'from a.b import c\n'),
    ('calss A:\n    pass\n', 1, 'class A:\n    pass\n'),
    ('iff a:\n    pass\n', 1, 'if a:\n    pass\n'),
    ('def f():\n    retrun 1\n', 2, 'def f():\n    return 1\n'),
    ('f(\n    a=1\n    # next\n\n    b=2,\n)\n', 2, 'f(\n    a=1,\n    # next\n\n    b=2,\n)\n'),
    ("print 'a', b\n", 1, "print('a', b)\n"),
    ('try:\n    a = 1\nexcept E, e:\n    pass\n', 3, 'try:\n    a = 1\nexcept E as e:\n    pass\n'),
    ("log.info('time: ' str(a))\n", 1, "log.info('time: ' + str(a))\n"),
    ("f(a=['b/' c])\n", 1, "f(a=['b/' + c])\n"),
    ('f(\n    a=1\n    b=2,\n)\n', 2, 'f(\n    a=1,\n    b=2,\n)\n'),
    ('def f()\n    pass\n', 1, 'def f():\n    pass\n'),
    ('def f() -> a\n    pass\n', 1, 'def f() -> a:\n    pass\n'),
]  # fmt: skip
CODE = ["a = 1\n", "b = 4 // 2\n", "c = a < b > a\n", "'''\nPython\n// a++\n'''\n", "# \u201cx\u201d\n",
        "d = '\u201cx\u201d'\n", "...\n", "Python = 1\nPython\n",
        "ls = l = 1\nls -l\n", "code = 1\ncode = code if code else 1\n", "f(\n    code in b,\n)\n"]  # fmt: skip


@pytest.mark.parametrize(
    ("text", "variant", "line", "fixed", "cause"),
    [
        *((*case, "pasted") for case in PASTED),
        *((*case, "document") for case in DOCUMENTS),
        *((*case, "language") for case in LANGUAGE),
    ],
)
def test_a_slip_is_named_and_fixed(
    text: str, variant: str, line: int, fixed: str, cause: str
) -> None:
    slip = slip_of(text.encode())
    assert slip is not None
    assert (slip.cause, slip.variant, slip.line) == (cause, variant, line)
    assert (slip.fixed or b"").decode() == fixed
    assert description(slip)
    assert not fixed or can_parse(fixed.encode())


@pytest.mark.parametrize(("text", "line", "fixed"), SMALLEST)
def test_the_smallest_change_with_which_python_reads_the_file(
    text: str, line: int, fixed: str
) -> None:
    slip = slip_of(text.encode())
    assert slip is not None
    assert slip.line == line
    assert (slip.fixed or b"").decode() == fixed


@pytest.mark.parametrize("command", ["ls", "ls -l", "ros2", "chmod +x"])
def test_a_command_that_python_reads_is_found(command: str) -> None:
    (found,) = labels_in(f"a = 1\n{command}\n".encode())
    assert (found.variant, found.line, found.word) == ("lines", 2, command.partition(" ")[0])


@pytest.mark.parametrize("text", CODE)
def test_code_that_python_reads_has_no_slip(text: str) -> None:
    assert can_parse(text.encode())
    assert slip_of(text.encode()) is None
    assert labels_in(text.encode()) == []


def test_a_label_that_python_takes_for_a_name_is_found() -> None:
    (label,) = labels_in(b"Python\n#!/usr/bin/env python3\nimport sys\n")
    assert (label.variant, label.line, label.found) == ("lines", 1, "Python")
    assert labels_in(b"from sys import *\nPython\n") == []


@pytest.mark.parametrize(
    "piece",
    ["\u201c", "'", '"""', "\\", "```\n", ">>> ", "a++ ", "// ", "if {\n", "}\n", ",,", "(", "<br ", "&&",
     "<<<<<<< a\n", "1 a\n", "A b c d ", "f'{a", "def f:\n", "a b = ", "class A[", "import a ",
     "[ \t", "'a' = ", "b: 1,\n", "\u00a0", "/*", "if " + " " * 200 + "{"],
)  # fmt: skip
def test_a_hostile_file_is_searched_in_linear_time(piece: str) -> None:
    text = (piece * 20_000).encode()[:19_000].decode("utf-8", "ignore").encode()
    begin = time.process_time()
    slip_of(b"(\n" + text)
    slip_of(text + b"\nf(,, 1\n")
    code_only(text.decode())
    assert time.process_time() - begin < 2
