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
    ("a = \u201cx\u201d\n", "quotes", 1, 'a = "x"\n'),
    ("a = 'x\u2019\n", "quotes", 1, "a = 'x'\n"),
    ("a = \u201eit's\u201c\n", "quotes", 1, 'a = "it\'s"\n'),
    ("def f():\n    \u201c\u201c\u201cText\n    of f.\u201d\u201d\u201d\n", "quotes", 2,
     'def f():\n    """Text\n    of f."""\n'),
    ("if 1:\n\u00a0\u00a0\u00a0\u00a0a = 1\n", "blank", 2, "if 1:\n    a = 1\n"),
    ("a\u200b = 1\n", "blank", 1, "a = 1\n"),
    ("%load_ext autoreload\na = 1\n", "jupyter", 1, "a = 1\n"),
    ("a = 1\n!pip install b\n", "jupyter", 2, "a = 1\n"),
    ("a = 2 \u2212 1\n", "sign", 1, "a = 2 - 1\n"),
    ("print\uff081\uff0c 2\uff09\n", "sign", 1, "print(1, 2)\n"),
    ("a = 1<br/>\nb = 2<br>\n", "tag", 1, "a = 1\nb = 2\n"),
    ('<span class="k">a</span> = 1\n', "tag", 1, "a = 1\n"),
    ("if 2 &gt; 1:\n    a = 1\n", "tag", 1, "if 2 > 1:\n    a = 1\n"),
    ("```python\r\na = 1\r\n```\r\n", "fence", 1, "a = 1\r\n"),
    ("Here's the node:\n\n```python\ndef a(): ...\n```\n### How it works\n- It isn't a topic.\n",
     "around", 3, "def a(): ...\n"),
    ("def a(): ...\n```\n- The timer fires.\n", "around", 2, "def a(): ...\n"),
    ("Sure, here is it:\n```\ndef a(): ...\n", "around", 2, "def a(): ...\n"),
    ("Copy code\na = 1\n", "label", 1, "a = 1\n"),
    (">>> if 1:\n...     a = 1\n", "prompt", 1, "if 1:\n    a = 1\n"),
    ("a = 1\ncd ~/ros2_ws && colcon build\nb = 2\n", "command", 2, "a = 1\nb = 2\n"),
    ("jane@pc:~/ros2_ws$ ros2 run a b\na = 1\n", "command", 1, "a = 1\n"),
    *(
        (f"a = 1\n{command}\nb = 2\n", "command", 2, "a = 1\nb = 2\n")
        for command in COMMANDS
    ),
    ("a = 1\n:wq\n", "editor", 2, "a = 1\n"),
    ("a = (1)\n  :q!\n", "editor", 2, "a = (1)\n"),
    ("     1\timport a\n     2\tif a:\n     3\t    b()\n", "numbers", 1, "import a\nif a:\n    b()\n"),
    ("+import a\n+b()\n", "patch", 1, "import a\nb()\n"),
    ("a = 0\n-b = 1 + f(\n+b = 2\nc()\n", "patch", 2, "a = 0\nb = 2\nc()\n"),
    ("@@ -1,2 +1,2 @@\n import a\n-b(\n+c()\n", "patch", 1, "import a\nc()\n"),
    ('a = 1\n\nTraceback (most recent call last):\n  File "b", line 3, in c\n    d()\n    ^^^\n'
     "NameError: name 'd' is not defined\n", "output", 3, "a = 1\n\n"),
    ("a = 1\n[INFO] [1.2] [b]: c d\n[INFO] [2.2] [b]: c e\ne = 2\n", "output", 2, "a = 1\ne = 2\n"),
    ("**a.py**\nb = 1\n", "note", 1, "b = 1\n"),
    ("b = 1\n\u2022 The timer calls it\n", "note", 2, "b = 1\n"),
    ("1 import sys\n2 a = 1\n", "numbers", 1, "import sys\na = 1\n"),
    ("1: import sys\n2:\n3: if a:\n4:     b = 1\n", "numbers", 1, "import sys\n\nif a:\n    b = 1\n"),
    ("Here is the corrected code:\na = 1\n", "prose", 1, "a = 1\n"),
]  # fmt: skip
DOCUMENTS = [
    ("a = 1\n>>>>>>> Stashed changes\nb = 1\n", "conflict_rest", 2, "a = 1\nb = 1\n"),
    ("\n<!DOCTYPE html>\n<html>\n", "page", 2, ""),
    ("<?xml version='1.0'?>\n<package>\n", "markup", 1, ""),
    ('{"cells": [\n', "notebook", 1, ""),
    ("{\\rtf1 a\n", "word", 1, ""),
    ("a = 1\n<<<<<<< HEAD\nb = 1\n=======\nb = 2\n>>>>>>> main\n", "conflict", 2, ""),
]
LANGUAGE = [
    ("a = 0\na++\n", "increment", 2, "a = 0\na += 1\n"),
    ("a = 0\na.b--;\n", "increment", 2, "a = 0\na.b -= 1\n"),
    ("print(str(a++))\n", "increment_inside", 1, ""),
    ("// it's mine\na = 1\n", "comment", 1, "# it's mine\na = 1\n"),
    ("a = 4    ; counts the hellos\n", "comment", 1, "a = 4    # counts the hellos\n"),
    ("a = 4 // 2  // the half\n", "comment", 1, "a = 4 // 2  # the half\n"),
    ("a = 4  // see http://a.b of me\n", "comment", 1, "a = 4  # see http://a.b of me\n"),
    ("/* mine */\na = 1\n", "comment", 1, "# mine\na = 1\n"),
    ("/*\n * mine\n */\n", "comment", 1, ""),
    ("b = a && !c || d != e\n", "operator", 1, "b = a and not c or d != e\n"),
    ("b = a === c\n", "compare", 1, "b = a == c\n"),
    ("if a:\n    pass\nelse if b:\n    pass\n", "elif", 3, "if a:\n    pass\nelif b:\n    pass\n"),
    ("int a = 1\n", "declaration", 1, "a = 1\n"),
    ("class A:\n    private int b = 0\n", "declaration", 2, "class A:\n    b = 0\n"),
    ("private a = 1\n", "declaration", 1, "a = 1\n"),
    ("class A:\n    constructor(self):\n        b()\n", "constructor", 2,
     "class A:\n    def __init__(self):\n        b()\n"),
    ("class A:\n    constructor() :\n        b()\n", "constructor", 2,
     "class A:\n    def __init__(self):\n        b()\n"),
    ("if a == 'b' then\n    b()\n", "then", 1, "if a == 'b':\n    b()\n"),
    ("class A:\n    constructor() {\n        b()\n", "constructor", 2,
     "class A:\n    def __init__(self):\n        b()\n"),
    ("f(() => a())\n", "arrow_lambda", 1, "f(lambda: a())\n"),
    ("class A:\n    b = (self) => {\n        c()\n", "function", 2,
     "class A:\n    def b(self):\n        c()\n"),
    ("if a then:\n    b()\n", "then", 1, "if a:\n    b()\n"),
    ("while a do\n    b()\n", "then", 1, "while a:\n    b()\n"),
    ("do:\n    b()\nwhile a();\n", "do_while", 1, "while a():\n    b()\n"),
    ("this->a = 1\n", "this", 1, "self.a = 1\n"),
    ("a = 1  % it counts up\n", "comment", 1, "a = 1  # it counts up\n"),
    ("-- it counts up\na = 1\n", "comment", 1, "# it counts up\na = 1\n"),
    ("let a = 1;\n", "declaration", 1, "a = 1;\n"),
    ("void main():\n    pass\n", "function", 1, "def main():\n    pass\n"),
    ("a = new Node('x')\n", "new", 1, "a = Node('x')\n"),
    ("self->a = 1\n", "member", 1, "self.a = 1\n"),
    ("rclpy::init()\n", "member", 1, "rclpy.init()\n"),
    ("try:\n    pass\ncatch (a):\n    pass\n", "catch", 3,
     "try:\n    pass\nexcept Exception as a:\n    pass\n"),
    ("a = b ? 1 : 2\n", "choice", 1, ""),
    ("a = `x`\n", "backtick", 1, ""),
    ("self.a := 1\n", "assign", 1, "self.a = 1\n"),
    ("import a from b.c\n", "import", 1, "from b.c import a\n"),
    ("class A[B]:\n    pass\n", "base", 1, "class A(B):\n    pass\n"),
    ("class A<B>:\n    pass\n", "base", 1, "class A(B):\n    pass\n"),
    ("class A extends B:\n    pass\n", "base", 1, "class A(B):\n    pass\n"),
    ("class A : public B:\n    pass\n", "base", 1, "class A(B):\n    pass\n"),
    ("try:\n    a = 1\nExcept KeyError:\n    pass\n", "capital", 3,
     "try:\n    a = 1\nexcept KeyError:\n    pass\n"),
    ("Import sys\n", "capital", 1, "import sys\n"),
    ("If a:\n    pass\n", "capital", 1, "if a:\n    pass\n"),
    ("define f(a):\n    pass\n", "function", 1, "def f(a):\n    pass\n"),
    ("f()->a = 1\n", "member", 1, "f().a = 1\n"),
    ("if a {\n    b = 1\n}\n", "braces", 1, "if a:\n    b = 1\n"),
    ("def f() {\n    if a: {\n        b = 1\n    }\n}\n", "braces", 1,
     "def f():\n    if a:\n        b = 1\n"),
]  # fmt: skip
INDENTED = [
    ("class A:\n    def b(self): c('d')  # e\n        # f\n        g()\n", "behind_colon", 2,
     "class A:\n    def b(self):\n        c('d')  # e\n        # f\n        g()\n"),
    ("class A(B): pass\n    def c(self):\n        d()\n", "behind_colon_nothing", 1,
     "class A(B):\n    def c(self):\n        d()\n"),
    ("def f(a: int): b(1,\n      2)\n    c()\n", "behind_colon", 1,
     "def f(a: int):\n    b(1,\n      2)\n    c()\n"),
    ("def f():\r\n    try: a()\r\n        b()\r\n    except C: pass\r\n", "behind_colon", 2,
     "def f():\r\n    try:\r\n        a()\r\n        b()\r\n    except C: pass\r\n"),
    ("if x: y()\n    z()\nelse: z()\n", "behind_colon", 1, "if x:\n    y()\n    z()\nelse: z()\n"),
    ("class A:\n    def b(self): pass\n        def c(self):\n            pass\n", "too_far", 3,
     "class A:\n    def b(self): pass\n    def c(self):\n        pass\n"),
    ("def f():\n    x = {1: 2}; y = 2\n        if y:\n            z()\n    return\n", "too_far", 3,
     "def f():\n    x = {1: 2}; y = 2\n    if y:\n        z()\n    return\n"),
    ("def f():\n    try:\n        a()\n            b()\n    except C: pass\n", "too_far", 4,
     "def f():\n    try:\n        a()\n        b()\n    except C: pass\n"),
    ("def f():\n    a = 1\nb = 2\n    c = 3\n", "too_far_either", 4, ""),
    ("import a\n    import b\n", "too_far_margin", 2, "import a\nimport b\n"),
    ('class A:\n    """b"""\n    # def c(self):\n        self.d()\n', "head_commented", 3,
     'class A:\n    """b"""\n    def c(self):\n        self.d()\n'),
    ('class A:\n    """b"""\n        super().__init__()\n', "def_gone", 3,
     'class A:\n    """b"""\n    def __init__(self):\n        super().__init__()\n'),
    ("class A:\n    b = 1\n        self.c()\n", "def_gone_unknown", 3, ""),
    ('#!a\n    import b\n    """c\n"""\n    d()\n', "margin_all", 2,
     '#!a\nimport b\n"""c\n"""\nd()\n'),
    ("    import b\ndef c():\n    pass\n", "margin", 1, "import b\ndef c():\n    pass\n"),
]  # fmt: skip
TYPED = [
    ("self.a + = 1\n", "operator_split", 1, "self.a += 1\n"),
    ("a = b ! = c\n", "operator_split", 1, "a = b != c\n"),
    ("a = f 'b{c}'\n", "prefix_apart", 1, "a = f'b{c}'\n"),
    ("f(a_b')\n", "quote_exact", 1, "f('a_b')\n"),
    ("return_(f'b {c})\n", "quote_exact", 1, "return_(f'b {c}')\n"),
    ("if a => b:\n    c()\n", "operator_swapped", 1, "if a >= b:\n    c()\n"),
    ("class A:\n    def __ init __(self):\n        b()\n", "name_parts", 2,
     "class A:\n    def __init__(self):\n        b()\n"),
    ("def f():\na()\nb()\n    c()\n", "lines_not_indented", 2, "def f():\n    a()\n    b()\n    c()\n"),
    ("class A:\n    def b(self): c()\n        def d(self):\n        e()\n", "too_far_alone", 3,
     "class A:\n    def b(self): c()\n    def d(self):\n        e()\n"),
    ("super.().b()\n", "dot_bracket", 1, "super().b()\n"),
    ("class A:\n    def b()self:\n        c()\n", "parameter_outside", 2,
     "class A:\n    def b(self):\n        c()\n"),
    ("a = 'b ' + str self.c\n", "call_brackets", 1, "a = 'b ' + str(self.c)\n"),
    ("f('b ' + str self.c)\n", "call_brackets", 1, "f('b ' + str(self.c))\n"),
    ("from a import b,\n", "import_comma", 1, "from a import b\n"),
    ("def f();\n    g()\n", "colon_missing", 1, "def f():\n    g()\n"),
    ("a = b + \\ \n    c\n", "backslash_end", 1, "a = b + \\\n    c\n"),
    ("if a == 'b' c()\n", "colon_inside", 1, "if a == 'b': c()\n"),
    ("import a from b.c import d\n", "two_statements", 1, "import a\nfrom b.c import d\n"),
    ("a(1.0, lambda: self.b += 1)\n", "lambda_statement", 1, ""),
    ("a = f\"b {c}'\n", "quote_other", 1, 'a = f"b {c}"\n'),
    ("f('b:\n    ' + c)\n", "text_two_lines", 1, "f('b: ' + c)\n"),
    ("def f(a) \u2192 None:\n    b()\n", "character_for", 1, "def f(a) -> None:\n    b()\n"),
    ("a = b \u2260 c\n", "character_for", 1, "a = b != c\n"),
    ("a() \u2705\n", "character", 1, "a() \n"),
    ("\u2705 Start of the node\n", "character_note", 1, ""),
    ("@dataclass\n    a: int = 0\n", "decorator_head", 1, ""),
    ("class A:\n    class b(self, c):\n        return c\n", "class_for_def", 2,
     "class A:\n    def b(self, c):\n        return c\n"),
    ("def Clock:\n    a: int = 0\n", "def_for_class", 1, "class Clock:\n    a: int = 0\n"),
    ("class A:\n    def b(self,\n        return c\n", "def_half_open", 2, ""),
    ("class A:\n    def self.b(self):\n        c()\n", "def_self", 2,
     "class A:\n    def b(self):\n        c()\n"),
    ("class A:\n    def self.b():\n        c()\n", "def_self", 2,
     "class A:\n    def b(self):\n        c()\n"),
    ("f(\n    a='b',\n    c'd',\n    e=1,\n)\n", "equals_of_argument", 3,
     "f(\n    a='b',\n    c='d',\n    e=1,\n)\n"),
    ("f(\n    a={\n        'b': [\n        'b': [\n            'c',\n        ],\n    },\n)\n", "line_twice", 4,
     "f(\n    a={\n        'b': [\n            'c',\n        ],\n    },\n)\n"),
    ("f(\n        'b': [\n    a={\n            'c',\n        ],\n    },\n)\n", "lines_swapped", 3,
     "f(\n    a={\n        'b': [\n            'c',\n        ],\n    },\n)\n"),
    ("a = [\na = [\n    1,\n]\n", "line_twice", 2, "a = [\n    1,\n]\n"),
    ("class A:\n    b = 1\n\ndef c(self):\n        d()\n\n    def e(self):\n        f()\n",
     "def_at_margin", 4,
     "class A:\n    b = 1\n\n    def c(self):\n        d()\n\n    def e(self):\n        f()\n"),
    ("class A:\n    def b(self):\n        super(.b('c')\n", "super_open", 3,
     "class A:\n    def b(self):\n        super().b('c')\n"),
    ("class TickNode):\n    a = 1\n", "bracket_first", 1, "class Tick(Node):\n    a = 1\n"),
    ("class A:\n    def b(self):\n        c()\n\n\n    d()\n    return\n\n\nif e:\n    main()\n", "main_gone", 6,
     "class A:\n    def b(self):\n        c()\n\n\ndef main(args=None):\n    d()\n    return\n\n\nif e:\n    main()\n"),
    ("class A:\n    b = 1\n\n        c()\n    def d(self):\n        e()\n", "def_below", 4,
     "class A:\n    b = 1\n\n    def d(self):\n        c()\n        e()\n"),
    ("f(\n    a=1;\n    b=2,\n)\n", "semicolon_in_call", 2, "f(\n    a=1,\n    b=2,\n)\n"),
    ("f(a={\n    'b': [\n        c = 'd.e:g',\n    ],\n})\n", "entry_quote", 3,
     "f(a={\n    'b': [\n        'c = d.e:g',\n    ],\n})\n"),
    ("f(\n    a={\n    c=1,\n        'b': 2,\n    },\n)\n", "argument_in_braces", 3,
     "f(\n    c=1,\n    a={\n        'b': 2,\n    },\n)\n"),
    ("f(\n    a={\n        'b':\n            'c',\n        ],\n    },\n)\n", "opener_missing", 3,
     "f(\n    a={\n        'b': [\n            'c',\n        ],\n    },\n)\n"),
    ("f(\n    a=[\n        ('b', 'c' + d]),\n    ],\n)\n", "opener_missing", 3,
     "f(\n    a=[\n        ('b', ['c' + d]),\n    ],\n)\n"),
    ("f\n    a=1,\n)\n", "call_open", 1, "f(\n    a=1,\n)\n"),
    ("f(\n    a=[\n        1,\n    ]\n    b=2,\n)\n", "comma_at_end", 4,
     "f(\n    a=[\n        1,\n    ],\n    b=2,\n)\n"),
    ("from a import b c\n", "import_names", 1, "from a import b, c\n"),
    ("f(\n        ('share/ament_index/resource_index/packages',\n            ['a']),\n    ],\n    b=1,\n)\n",
     "data_files_gone", 2,
     "f(\n    data_files=[\n        ('share/ament_index/resource_index/packages',\n            ['a']),\n"
     "    ],\n    b=1,\n)\n"),
    ("f(\n    name=package_name,\n    data_files=[\n        ('share/ament_index/resource_index/packages',\n"
     "        ('b', ['c']),\n    ],\n)\n",
     "marker_line_gone", 4,
     "f(\n    name=package_name,\n    data_files=[\n        ('share/ament_index/resource_index/packages',\n"
     "            ['resource/' + package_name]),\n        ('b', ['c']),\n    ],\n)\n"),
    ("def f[self, n]:\n    pass\n", "def_square", 1, "def f(self, n):\n    pass\n"),
    ("class A:\n    def a(self):\n        b = 0    def c(self):\n        d()\n", "two_statements", 3,
     "class A:\n    def a(self):\n        b = 0\n    def c(self):\n        d()\n"),
    ("try:\n    a()\nexcept (K | E e):\n    pass\n", "handler_several", 3,
     "try:\n    a()\nexcept (K, E) as e:\n    pass\n"),
    ("try:\n    a()\nexcept (K, E) e:\n    pass\n", "handler_several", 3,
     "try:\n    a()\nexcept (K, E) as e:\n    pass\n"),
    ("f(1.0, lambda self.g(2))\n", "lambda_colon", 1, "f(1.0, lambda: self.g(2))\n"),
    ("self.t = f(1.0, self.\n\na = 1\n", "value_half", 1, ""),
    ("n = 0\ndef f():\n    def g():\n        nonlocal n\n        n += 1\n", "nonlocal_of_file", 4,
     "n = 0\ndef f():\n    def g():\n        global n\n        n += 1\n"),
    ("f(lambda: (g(a.b), a.b := 1))\n", "walrus_in_lambda", 1, ""),
    ("class A:\n    \"\"Hello there\"\"\n    b = 1\n", "docstring_quotes", 2,
     'class A:\n    """Hello there"""\n    b = 1\n'),
    ("try:\n    a()\nexcept K:\nfinally:\n    b()\n", "except_empty", 3,
     "try:\n    a()\nexcept K:\n    pass\nfinally:\n    b()\n"),
    ("a = (\n    'b': 1,\n}\n", "bracket_opener", 1, "a = {\n    'b': 1,\n}\n"),
    ("try:\n    a()\nexcept K:\nb.destroy_node()\n", "block_empty", 3,
     "try:\n    a()\nexcept K:\n    pass\nb.destroy_node()\n"),
    ("f(\n    a=1),\n    b=2,\n)\n", "closed_early", 2, "f(\n    a=1,\n    b=2,\n)\n"),
    ("f(\n    a=[\n        1,\n    ]),\n    b=2,\n)\n", "closed_early", 4,
     "f(\n    a=[\n        1,\n    ],\n    b=2,\n)\n"),
    ("# one\n   says \"two\" and more\n# three\na = 1\n", "note_without_sign", 2,
     "# one\n   # says \"two\" and more\n# three\na = 1\n"),
    ("class A:\n    def b(self):\n        c()\n\n        def d(self):\n        # e\n        f()\n",
     "head_deeper", 5,
     "class A:\n    def b(self):\n        c()\n\n    def d(self):\n        # e\n        f()\n"),
    ("class A:\n    class B:\n    def c(self):\n        d()\n", "block_empty", 2, ""),
    ("class A:\n    @property\n    b(self):\n        c()\n", "decorated_def", 3,
     "class A:\n    @property\n    def b(self):\n        c()\n"),
    ("def f():\n    a = 0\n    def g():\n        nonloca a\n", "word_misspelt", 4,
     "def f():\n    a = 0\n    def g():\n        nonlocal a\n"),
    ("class A:\n    @property\n    b = 0\n", "decorator", 2, "class A:\n    b = 0\n"),
    ("try:\n    a()\nfinally:\n    b()\nexcept C:\n    d()\n", "finally_first", 5,
     "try:\n    a()\nexcept C:\n    d()\nfinally:\n    b()\n"),
    ("if a:\n    b()\n    else:\n    c()\n", "clause_deeper", 3,
     "if a:\n    b()\nelse:\n    c()\n"),
    ("if a:\n    b()\n    else:\n        c()\n", "clause_deeper", 3,
     "if a:\n    b()\nelse:\n        c()\n"),
    ("a = f'b {c}}'\n", "brace_twice", 1, "a = f'b {c}'\n"),
    ("a = f'b {{c}'\n", "brace_twice", 1, "a = f'b {c}'\n"),
    ("class A:\n    def b(self):\nself.c()\nself.d += 1\n\n\ne = 1\n", "lines_not_indented", 3,
     "class A:\n    def b(self):\n        self.c()\n        self.d += 1\n\n\ne = 1\n"),
    ("def f():\n   a()\n    b()\n    c()\n", "line_above", 2, "def f():\n    a()\n    b()\n    c()\n"),
]  # fmt: skip
SIGNS = [
    *INDENTED,
    *TYPED,
    (
        "class A:\n    def f(self):\n        self.b-c = 0\n        d(f'{self.b-c}')\n",
        "name_minus",
        3,
        "class A:\n    def f(self):\n        self.b_c = 0\n        d(f'{self.b_c}')\n",
    ),
    ("b-c += a - c\n", "name_minus", 1, "b_c += a - c\n"),
    ("f(1,, 2)\n", "commas", 1, "f(1, 2)\n"),
    ("f(\n    1,\n    ,\n)\n", "commas", 3, "f(\n    1,\n    \n)\n"),
    ("f(, 1)\n", "commas", 1, "f( 1)\n"),
    ("a = {\n    'b' = [1],\n}\n", "colon", 2, "a = {\n    'b' : [1],\n}\n"),
    ("f(\n    a=1,\n    b: 2,\n)\n", "equals", 3, "f(\n    a=1,\n    b= 2,\n)\n"),
    ("f(\n    a=1,\n    'b': 2,\n)\n", "equals", 3, "f(\n    a=1,\n    b= 2,\n)\n"),
    ("f('a)\n", "quote", 1, "f('a')\n"),
    ("f(\n    c=1,\n    a=b-2.0',\n)\n", "quote_exact", 3, "f(\n    c=1,\n    a='b-2.0',\n)\n"),
    ("f('a: + b)\n", "quote", 1, ""),
    ("a = f(b(1)))\n", "bracket_extra", 1, "a = f(b(1))\n"),
    ("a = [f(\n    1,\n)]]\n", "bracket_extra", 3, "a = [f(\n    1,\n)]\n"),
    ("a = b + c)\n", "bracket_alone", 1, ""),
    ("a = f'b {c'\n", "brace", 1, "a = f'b {c}'\n"),
    ("a = f'b {str(c)'\n", "brace", 1, "a = f'b {str(c)}'\n"),
    ("a = f'b c}'\n", "brace_alone", 1, ""),
    (
        "f(\n    a=[\n        'b' = 'c.d:e',\n    ],\n)\n",
        "entry_parts",
        3,
        "f(\n    a=[\n        'b = c.d:e',\n    ],\n)\n",
    ),
    (
        "f(\n    a=[\n        'b': 'c.d:e'\n    ],\n)\n",
        "entry_parts",
        3,
        "f(\n    a=[\n        'b = c.d:e'\n    ],\n)\n",
    ),
    (
        "try:\n    f()\nexcept E:\n    # nothing\n\ng()\n",
        "block_comment",
        3,
        "try:\n    f()\nexcept E:\n    pass\n    # nothing\n\ng()\n",
    ),
    ("def f(self):\n    global self.a\n    b = 1\n", "global", 2, "def f(self):\n    b = 1\n"),
    ("def f():\n    a = 1\nexcept KeyError:\n    pass\n", "clause_alone", 3, ""),
    ("def f:\n    pass\n", "def_brackets", 1, "def f():\n    pass\n"),
    (
        "class A:\n    def f:\n        pass\n",
        "def_brackets",
        2,
        "class A:\n    def f(self):\n        pass\n",
    ),
    ("if a:\n    f(1) b = 2\n", "two_statements", 2, "if a:\n    f(1)\n    b = 2\n"),
    ("f(1):\na = 1\n", "colon_extra", 1, "f(1)\na = 1\n"),
    (
        "def f(self):\n    self.a = 1:  # one\n",
        "colon_extra",
        2,
        "def f(self):\n    self.a = 1  # one\n",
    ),
    (
        "class A:\n    f(self):\n        pass\n",
        "def_missing",
        2,
        "class A:\n    def f(self):\n        pass\n",
    ),
    ("f():\n    a = 1\n", "def_missing", 1, "def f():\n    a = 1\n"),
    ("if a = 1:\n    b = 2\n", "one_equals", 1, "if a == 1:\n    b = 2\n"),
    ("if a:\nb = 1\n", "not_indented", 2, ""),
    ("def f():\na = 1\n    b = 2\n", "not_indented", 2, "def f():\n    a = 1\n    b = 2\n"),
    (
        "try:\na = 1\nexcept KeyError:\n    pass\n",
        "not_indented",
        2,
        "try:\n    a = 1\nexcept KeyError:\n    pass\n",
    ),
    (
        'def f():\n    """Text.""\n    a = 1\n',
        "text_without_end",
        2,
        'def f():\n    """Text."""\n    a = 1\n',
    ),
    ("class A:\n    def f(self):\n\n    def g(self):\n        pass\n", "block_empty", 2, ""),
    (
        "def f():\n    a = 1\nb = 2\n    c = 3\n    d = 4\n",
        "line_above",
        3,
        "def f():\n    a = 1\n    b = 2\n    c = 3\n    d = 4\n",
    ),
    (
        'def f():\n    """Text\n    a = "b"\n',
        "text_without_end",
        2,
        'def f():\n    """Text"""\n    a = "b"\n',
    ),
    (
        "def f():\n    '''Text\n    of f.\n    return 1\n\n\ndef g():\n    '''Of g.'''\n",
        "text_without_end",
        2,
        "def f():\n    '''Text\n    of f.'''\n    return 1\n\n\ndef g():\n    '''Of g.'''\n",
    ),
    ("self.a + 1 = self.a\n", "assign_swapped", 1, "self.a = self.a + 1\n"),
    ("self.f(1, b) = self.t\n", "assign_swapped", 1, "self.t = self.f(1, b)\n"),
    ("f(a) = 1\n", "assign_left", 1, ""),
    ("f(a) += 1\n", "assign_left", 1, ""),
    ("if f(a) = 1:\n    pass\n", "one_equals", 1, "if f(a) == 1:\n    pass\n"),
    ("form a.b import c\n", "word_misspelt", 1, "from a.b import c\n"),
    ("calss A:\n    pass\n", "word_misspelt", 1, "class A:\n    pass\n"),
    ("iff a:\n    pass\n", "word_misspelt", 1, "if a:\n    pass\n"),
    ("def f():\n    retrun 1\n", "word_misspelt", 2, "def f():\n    return 1\n"),
    (
        "f(\n    a=1\n    # next\n\n    b=2,\n)\n",
        "comma_missing",
        2,
        "f(\n    a=1,\n    # next\n\n    b=2,\n)\n",
    ),
    ("def my callback(self):\n    pass\n", "name_parts", 1, "def my_callback(self):\n    pass\n"),
    ("class my-first node:\n    pass\n", "name_parts", 1, "class MyFirstNode:\n    pass\n"),
    ("self.class = 1\n", "word_as_name", 1, "self.my_class = 1\n"),
    ("def import(self):\n    pass\n", "word_as_name", 1, "def my_import(self):\n    pass\n"),
    ("def f(self, self.a):\n    pass\n", "parameter_dot", 1, ""),
    ("from a b import c\n", "import_dot", 1, "from a.b import c\n"),
    ("from a import\n", "import_nothing", 1, ""),
    ("a.spin node\n", "call_brackets", 1, "a.spin(node)\n"),
    ("print 'a', b\n", "call_brackets", 1, "print('a', b)\n"),
    (
        "try:\n    a = 1\nexcept E, e:\n    pass\n",
        "handler_comma",
        3,
        "try:\n    a = 1\nexcept E as e:\n    pass\n",
    ),
    (
        "try:\n    a = 1\nexcept E, F:\n    pass\n",
        "handler_comma",
        3,
        "try:\n    a = 1\nexcept (E, F):\n    pass\n",
    ),
    ("log.info('time: ' str(a))\n", "plus_missing", 1, "log.info('time: ' + str(a))\n"),
    ("f(a=['b/' c])\n", "plus_missing", 1, "f(a=['b/' + c])\n"),
    ("f(a=['b' c])\n", "comma_missing", 1, "f(a=['b', c])\n"),
    ("f(1.0 self.a)\n", "comma_missing", 1, "f(1.0, self.a)\n"),
    ("f(\n    a=1\n    b=2,\n)\n", "comma_missing", 2, "f(\n    a=1,\n    b=2,\n)\n"),
    ("def f()\n    pass\n", "colon_missing", 1, "def f():\n    pass\n"),
    ("def f() -> a\n    pass\n", "colon_missing", 1, "def f() -> a:\n    pass\n"),
    (
        "try:\n    a = 1\nexcept E:\n    break\n",
        "loop_word",
        4,
        "try:\n    a = 1\nexcept E:\n    pass\n",
    ),
    ("def f():\n    a = 1\n    continue\n", "loop_word", 3, ""),
    (
        "def f():\n    g(a)\n    global a\n    a = 1\n",
        "global_late",
        3,
        "def f():\n    global a\n    g(a)\n    a = 1\n",
    ),
    ("def f(a):\n    global a\n", "global_parameter", 2, ""),
    ("def f():\n    nonlocal a\n    a = 1\n", "nonlocal", 2, ""),
    ("a = 1\nreturn a\n", "outside_function", 2, ""),
    ("def f():\n    await g()\n", "await_outside", 2, ""),
    ('"""Made in\nC:\\Users\\a.\n"""\n', "backslash", 2, 'r"""Made in\nC:\\Users\\a.\n"""\n'),
    ("a = 'C:\\Users'\n", "backslash", 1, "a = r'C:\\Users'\n"),
    ("f(a=1, 2)\n", "argument_order", 1, ""),
    ("f(\n    a=1,\n    g(2, h),\n)\n", "argument_order", 3, ""),
    (
        "self.create_timer(\n    timer_period_sec=1.0,\n    self.say,\n)\n",
        "argument_name",
        3,
        "self.create_timer(\n    timer_period_sec=1.0,\n    callback=self.say,\n)\n",
    ),
    (
        "self.create_timer(callback=self.say, 1.0)\n",
        "argument_name",
        1,
        "self.create_timer(callback=self.say, timer_period_sec=1.0)\n",
    ),
    ("f(a=1, a=2)\n", "argument_twice", 1, ""),
    ("def f(a, a):\n    pass\n", "parameter_twice", 1, ""),
    ("def f(a=1, b):\n    pass\n", "parameter_order", 1, ""),
    ("f(1s)\n", "number_letters", 1, ""),
    ("a = 01\n", "number_zeros", 1, ""),
    (
        "f(\n    a=[\n        'b': [\n            'c'\n        ],\n    ],\n)\n",
        "dict_braces",
        3,
        "f(\n    a={\n        'b': [\n            'c'\n        ],\n    },\n)\n",
    ),
]
TRY = "def f():\n    try:\n        {0}\n{1}\n\nf()\n"
PASS = "    except KeyboardInterrupt:\n        pass"
SIGNS += [
    (TRY.format("spin(a)", "    b()"), "try_alone", 2, TRY.format("spin(a)", f"{PASS}\n    b()")),
    (TRY.format("spin(a)", ""), "try_alone", 2, TRY.format("spin(a)", f"{PASS}\n")),
    (TRY.format("c()", "    b()"), "try_alone", 2, ""),
    *(
        (
            TRY.format("c()", PASS.replace("except", word)),
            "clause_misspelt",
            4,
            TRY.format("c()", PASS),
        )
        for word in ("exept", "expect", "exception")
    ),
    (
        TRY.format("c()", PASS.replace("    ", "", 1).replace("        ", "    ")),
        "clause_column",
        4,
        TRY.format("c()", PASS),
    ),
    *(
        (
            TRY.format("c()", "\n".join(f"{more}{row}" for row in PASS.split("\n"))),
            "clause_column",
            4,
            TRY.format("c()", PASS),
        )
        for more in ("    ", "  ", "        ")
    ),
    (TRY.format("c()", f"    b()\n{PASS}"), "try_between", 4, ""),
]
METHOD = "class A:\n    def f(self):\n        a = 1\n"
SIGNS += [
    (f"{METHOD}\tb = 2\n", "tab", 4, f"{METHOD}        b = 2\n"),
    (f"{METHOD}\t\tb = 2\n", "tab", 4, f"{METHOD}        b = 2\n"),
    (
        f"{METHOD}        if a:\n\t    b = 2\n",
        "tab",
        5,
        f"{METHOD}        if a:\n            b = 2\n",
    ),
    ("def f():\n    if a:\n        b = 1\n\tc = 2\n", "tab", 4, ""),
    (f"{METHOD}        if a:\n            b = 2\n\tc = 3\n", "tab_other", 6, ""),
]
SIGNS += [
    ("f(\n    a='b's c',\n)\n", "apostrophe", 2, "f(\n    a=\"b's c\",\n)\n"),
    ("f('it's b's')\n", "apostrophe", 1, "f(\"it's b's\")\n"),
    ("f(f'It's: {a}')\n", "apostrophe", 1, "f(f\"It's: {a}\")\n"),
    ("f('a', 'bs' c', 'd')\n", "apostrophe", 1, "f('a', \"bs' c\", 'd')\n"),
    ("f('It's: ' + a + '!')\n", "apostrophe", 1, "f(\"It's: \" + a + '!')\n"),
    ("f('b's \"c\"')\n", "quote", 1, ""),
    ("f(\n    a={\n        'b': [\n            'c'\n    },\n)\n", "bracket_below", 3,
     "f(\n    a={\n        'b': [\n            'c'\n        ],\n    },\n)\n"),
    ("f(\n    a={\n        'b': ['c',\n    },\n)\n", "bracket_end", 3,
     "f(\n    a={\n        'b': ['c'],\n    },\n)\n"),
    ("f(\n    a={\n        'b': [\n            'c'},\n)\n", "bracket_end", 3,
     "f(\n    a={\n        'b': [\n            'c']},\n)\n"),
    ("f(\n    a=1,\n", "bracket_below", 1, "f(\n    a=1,\n)\n"),
    ("f(\n    a={\n        'b': [\n            'c',\n        },\n    },\n)\n", "bracket_kind", 5,
     "f(\n    a={\n        'b': [\n            'c',\n        ],\n    },\n)\n"),
    ("f(\n    a={\n        'b': [\n            'c',\n        ],\n)\n", "bracket_below", 2,
     "f(\n    a={\n        'b': [\n            'c',\n        ],\n    },\n)\n"),
    ("def f():\n    g('a' + str(b\n    c = 1\n", "bracket_end", 2,
     "def f():\n    g('a' + str(b))\n    c = 1\n"),
    ("def f():\n    g(\n        a\n\n    c = 1\n", "bracket_below", 2,
     "def f():\n    g(\n        a\n    )\n\n    c = 1\n"),
    ("def f(a=None:\n    pass\n", "bracket_end", 1, "def f(a=None):\n    pass\n"),
    ("a = {'b': [1, 2}\n", "bracket_end", 1, "a = {'b': [1, 2]}\n"),
    ("a = [f(1)\nb = 2)\n", "bracket_before", 1, ""),
    ("f(1\n", "bracket_end", 1, "f(1)\n"),
    ("f(\n", "bracket_open", 1, ""),
    (f"{METHOD}         b = 2\n", "line_above", 4, f"{METHOD}        b = 2\n"),
    (f"{METHOD}         # two\n         b = 2\n", "line_above", 5,
     f"{METHOD}        # two\n        b = 2\n"),
    (f"{METHOD}       b = 2\n", "line_above", 4, f"{METHOD}        b = 2\n"),
    (f"{METHOD}\n     def g(self):\n        pass\n", "line_above", 5,
     f"{METHOD}\n    def g(self):\n        pass\n"),
    ("# a\n import a\nimport b\n", "line_above", 2, "# a\nimport a\nimport b\n"),
]  # fmt: skip
CLASS = "class A:\n    def f(self):\n        self.a = 1\n"
SIGNS += [
    # a line of the class between the lines of a method: its own if it uses self
    (f"{CLASS}    self.b = 1\n        self.c = 1\n", "line_above", 4,
     f"{CLASS}        self.b = 1\n        self.c = 1\n"),
    (f"{CLASS}    b = 1\n        self.c = 1\n", "line_between", 4, ""),
    ("def f(a) - None:\n    pass\n", "arrow_half", 1, "def f(a) -> None:\n    pass\n"),
    ("def f(a) => int:\n    pass\n", "arrow_half", 1, "def f(a) -> int:\n    pass\n"),
    ("a = f(1, b=c), b=c)\n", "bracket_closed_before", 1, "a = f(1, b=c)\n"),
    ("a = f(1), b=c)\n", "bracket_too_early", 1, "a = f(1, b=c)\n"),
    (f"{CLASS}        b = f(1), self.f)\n", "bracket_too_early", 4,
     f"{CLASS}        b = f(1, self.f)\n"),
    (f"{CLASS}    self.b = 1\n    self.d = 1\n        self.c = 1\n", "line_above", 4,
     f"{CLASS}        self.b = 1\n        self.d = 1\n        self.c = 1\n"),
    ("a = f('b:  + str(c))\n", "quote", 1, "a = f('b: ' + str(c))\n"),
    ("a = f('b: + str(c))\n", "quote", 1, "a = f('b: '+ str(c))\n"),
    ("a = {\n    'b': 'c: ,\n}\n", "quote", 2, "a = {\n    'b': 'c: ',\n}\n"),
    ("def f():\n    return a.b str(c)\n", "plus_missing", 2, "def f():\n    return a.b + str(c)\n"),
    ("f(self.a self.b)\n", "comma_missing", 1, "f(self.a, self.b)\n"),
    ("f(a b)\n", "comma_or_name", 1, ""),
    ("super(A, self.__init__('a')\nb = 1\n", "bracket_end", 1,
     "super(A, self).__init__('a')\nb = 1\n"),
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
        *((*case, "signs") for case in SIGNS),
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


@pytest.mark.parametrize("command", ["ls", "ls -l", "ros2", "chmod +x"])
def test_a_command_that_python_reads_is_found(command: str) -> None:
    (found,) = labels_in(f"a = 1\n{command}\n".encode())
    assert (found.variant, found.line, found.word) == ("command", 2, command.partition(" ")[0])


@pytest.mark.parametrize("text", CODE)
def test_code_that_python_reads_has_no_slip(text: str) -> None:
    assert can_parse(text.encode())
    assert slip_of(text.encode()) is None
    assert labels_in(text.encode()) == []


@pytest.mark.parametrize(
    "text",
    [
        "print(1):\n    a = 1\n",
        "a = b c:\n",
        f"{METHOD}      b = 2\n",
    ],
)
def test_other_errors_are_not_taken_for_slips(text: str) -> None:
    assert slip_of(text.encode()) is None


def test_a_label_that_python_takes_for_a_name_is_found() -> None:
    (label,) = labels_in(b"Python\n#!/usr/bin/env python3\nimport sys\n")
    assert (label.variant, label.line, label.found) == ("label", 1, "Python")
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
