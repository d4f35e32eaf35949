"""Lines of other languages, and statements with another form: what is named, and what to write."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.mistakes.slip_forms import FORMS, WORDS
from grader.package.source.broken_python import fault_of
from grader.package.source.slips import slip_of
from grader.ros.distro import find_distro
from grader.verdict.checks import source
from grader.verdict.outcome import Failed
from tests.static_bench import NODE, Bench

BODY = "class A:\n    def f(self):\n"
TRY = "try:\n    a()\n{0}\n    pass\n"
MATCH = "match a:\n    case 1:\n        b()\n    {0}\n        c()\n"
# what is written, the variant, its line, and the line as it should be ("" if that is not certain)
LINES = [
    (TRY.format("except KeyError e:"), "handler_as", 3, "except KeyError as e:"),
    (TRY.format("except (KeyError e):"), "handler_as", 3, "except KeyError as e:"),
    (TRY.format("except as KeyError:"), "handler_class", 3, "except KeyError:"),
    (TRY.format("except Keyboard Interrupt:"), "name_blank", 3, "except KeyboardInterrupt:"),
    (TRY.format("on KeyError:"), "clause_misspelt", 3, "except KeyError:"),
    (TRY.format("catch (KeyError e) {"), "catch", 3, "except KeyError as e:"),
    (MATCH.format("default:"), "other_case", 4, "case _:"),
    (MATCH.format("else:"), "other_case", 4, "case _:"),
    (MATCH.format("case default:\n        d()\n    case 2:"), "other_case_last", 4, "case _:"),
    ("switch (a):\n    case 1:\n        b()\n", "switch", 1, "match a:"),
    ("import a.b.*\n", "import_written", 1, "from a.b import *"),
    ("import rclpy.node.*\nNode()\n", "import_written", 1, "from rclpy.node import Node"),
    ("import { B } from 'a'\n", "import_written", 1, "from a import B"),
    ("from a import b.C\n", "import_written", 1, "from a.b import C"),
    ("from a.b C\n", "import_written", 1, "from a.b import C"),
    ("import a a.b\n", "import_written", 1, "import a, a.b"),
    ("from a/b import C\n", "import_dot", 1, "from a.b import C"),
    ("import a-b\n", "form_of_import", 1, "import a-b"),
    (f"{BODY}        t(1, () -> self.g())\n", "method_value", 3, "t(1, self.g)"),
    (f"{BODY}        t(1, () => {{ self.g(); }})\n", "method_value", 3, "t(1, self.g)"),
    (f"{BODY}        t(1, std::bind(&A::g, this))\n", "method_value", 3, "t(1, self.g)"),
    (f"{BODY}        t(1, self::g)\n", "method_value", 3, "t(1, self.g)"),
    (f"{BODY}        t(1, (x) -> self.g(x))\n", "arrow_lambda", 3, "t(1, lambda x: self.g(x))"),
    ("f(self->g())\n", "member", 1, "f(self.g())"),
    ("a()  # the name that\nshows in the list\n", "comment_wrapped", 2, "# shows in the list"),
    ("a = 0  # it counts up\nand is shown\n", "comment_wrapped", 2, "# and is shown"),
    ("a = 0\nset the counter to zero\n", "note_without_sign", 2, "# set the counter to zero"),
    ("a = 0\ndon't forget to spin\n", "note_without_sign", 2, "# don't forget to spin"),
    ("a = {\n    'b': 'c'  # d\n    'e': 0,\n}\n", "comma_missing", 2, "'b': 'c',"),
    ("a = {'b': 'c' 'd': 0}\n", "comma_missing", 1, "a = {'b': 'c', 'd': 0}"),
    ("a = {'b' 1}\n", "colon_key", 1, "a = {'b': 1}"),
    ("a = {'b' => 1}\n", "colon_key", 1, "a = {'b': 1}"),
    ("a = f('b' 1.0)\n", "comma_missing", 1, "a = f('b', 1.0)"),
    ("a = 'b' if c\n", "else_missing", 1, "a = 'b' if c"),
    ("for a = range(3):\n    b()\n", "for_in", 1, "for a in range(3):"),
    ("for a of b:\n    c()\n", "for_in", 1, "for a in b:"),
    ("for each a in b:\n    c()\n", "for_in", 1, "for a in b:"),
    ("for a = 1:3\n    b()\n", "for_form", 1, "for a = 1:3"),
    ("for (int a = 0; a < 3; a++):\n    b()\n", "for_form", 1,
     "for (int a = 0; a < 3; a++):"),
    ("if a:\n    b()\nelse c > 1:\n    d()\n", "else_condition", 3, "elif c > 1:"),
    ("if a:\n    b()\nelse:\n    c()\nelif d:\n    e()\n", "after_else", 5, ""),
    ("f(lambda(): a())\n", "lambda_brackets", 1, "f(lambda: a())"),
    ("f(1, lambda: a(); b())\n", "lambda_statement", 1, "a(); b()"),
    ("f(1, lambda:\n    a()\n    b())\n", "lambda_lines", 1, ""),
    ("f(1, lambda: return 1)\n", "lambda_statement", 1, "return 1"),
    ("f(a(b += 1))\n", "change_inside", 1, "f(a(b))"),
    ("f(1, lambda: (a(), b += 1))\n", "lambda_changes", 1, "f(1, lambda: (a(), b))"),
    ("a():wq\n", "editor_behind", 1, "a()"),
    ("a.b  1\n", "equals_missing", 1, "a.b = 1"),
    ("a: int 1\n", "equals_missing", 1, "a: int = 1"),
    ("A  1.0\n", "equals_missing", 1, "A = 1.0"),
    ("a.b()c('d')\n", "dot_missing", 1, "a.b().c('d')"),
    ("a.b)\n", "bracket_first", 1, "a.b()"),
    ("def f(): pass\na(b + str(f)))\n", "bracket_first", 2, "a(b + str(f()))"),
    ("a = B)\n", "bracket_first", 1, "a = B()"),
    ("class A:\n    def f(self b):\n        c()\n", "comma_missing", 2, "def f(self, b):"),
    ("from a impot b\n", "word_misspelt", 1, "from a import b"),
    ("if a == 'b:\n    c()\n", "quote_exact", 1, "if a == 'b':"),
    ("def f():\n    a()\n        b()\n    except C:\n        d()\n", "try_gone", 3, "4"),
    ("class A:\n    def f(self):\n        a()\n\n        def g(self):\n        b()\n",
     "head_deeper", 5, "4"),
    ("class A:\ndef f(self):\n        a()\n\n    def g(self):\n        b()\n",
     "not_indented", 2, ""),
    ("def f():\n    def g():\n        nonlocal a\n", "nonlocal_unbound", 3, "a"),
    ("def f():\n        a()\n    b()\n    c()\n", "line_above", 2, ""),
    ("try:\n    a()\nexcept B:\n    c()\n    finally:\n        d()\n", "clause_column", 5, ""),
    ("def f(a): -> int\n    b()\n", "arrow_behind_colon", 1, "def f(a) -> int:"),
    ("try: a() except B: c()\n", "clauses_in_line", 1, "try: / a() / except B: / c()"),
    ("a = '''b 'c''''\n", "quote_at_end", 1, "a = '''b 'c' '''"),
    ("def f():\ndef f() -> None:\n    a()\n", "head_twice", 1, ""),
    ("if a:\n\nif a:\n    b()\n", "head_twice", 1, ""),
    ("def f():\ndef g():\n    a()\n", "block_empty", 1, ""),
    ("def f():\n    return a = 1\n", "return_assigns", 2, "return a"),
    ("a = b += 1\n", "assign_twice", 1, "a = b"),
    ("def f():\n    global a = 1\n", "global_value", 2, "global a"),
    ("my timer = f(1)\n", "name_two_words", 1, "my_timer = f(1)"),
    ("class B: pass\nB b = B()\n", "declaration", 2, "b = B()"),
    ("List<int> a = []\n", "declaration", 1, "a = []"),
    ("int[] a = [1]\n", "declaration", 1, "a = [1]"),
    ("a int = 1\n", "declaration", 1, "a = 1"),
    ("int a\n", "declaration_alone", 1, "a"),
    ("define A 1.0\n", "declaration", 1, "A = 1.0"),
    ("self.create timer(1.0, f)\n", "name_blank", 1, "self.create_timer(1.0, f)"),
    ("rclpy.try shutdown()\n", "name_blank", 1, "rclpy.try_shutdown()"),
    ("class A:\n    public def f(self):\n        pass\n", "modifier", 2, "def f(self):"),
    ("class A:\n    int f(int a, char** b) {\n", "function", 2, "def f(self, a, b):"),
    ("class A:\n    A(self):\n        pass\n", "constructor", 2, "def __init__(self):"),
    ("def f(String[] a):\n    pass\n", "parameter_type", 1, "def f(a):"),
    ("class A:\n    public:\n    def f(self):\n        pass\n", "access", 2, "public"),
    ("throw new A('b')\n", "throw", 1, "raise A('b')"),
    ("raise A, 'b'\n", "raise_brackets", 1, "raise A('b')"),
    ("if a:\n    b()\nend if\n", "block_end", 3, ""),
    ("#a\nusing namespace std;\n", "include", 2, ""),
    ("unless a:\n    b()\n", "negated", 1, "if not a:"),
    ("repeat 3 times:\n    b()\n", "block_word", 1, "repeat"),
    ("f(a: 1.0)\n", "equals_written", 1, "f(a= 1.0)"),
    ("f(a.b=3)\n", "call_assigns", 1, ""),
    ("f(class=1)\n", "word_as_name", 1, "class"),
    ("if (a.b := 3):\n    c()\n", "walrus_place", 1, ""),
    ("f(\"a \"b\"\")\n", "quotes_other", 1, "f('a \"b\"')"),
    ("a =\n", "ends_equals", 1, "="),
    ("Import sys as s\n", "capital", 1, "import sys as s"),
    ("If a is b:\n    c()\n", "capital", 1, "if a is b:"),
    ("def f():\n", "block_missing", 1, ""),
    ("exec 'a'\n", "call_of_word", 1, "exec"),
]  # fmt: skip


@pytest.mark.parametrize(("text", "variant", "line", "wanted"), LINES)
def test_the_line_is_named_and_written_as_python(
    text: str, variant: str, line: int, wanted: str
) -> None:
    slip = slip_of(text.encode())
    assert slip is not None
    assert (slip.variant, slip.line, slip.wanted) == (variant, line, wanted)
    if slip.fixed is not None:
        after = fault_of(slip.fixed)
        assert after is None or (after.line or 0) > line


@pytest.mark.parametrize(
    "text",
    [
        "a = {b = 1}\n",  # == would be false: no condition
        "a = 1 if b else a = 2\n",
        "'a': int\n",  # no call, and no dict
        "self. c = = 0\n",
        "a = 0 (the counter)\n",
        "hello world()\n",
    ],
)
def test_no_change_is_told_that_does_not_lead_there(text: str) -> None:
    assert slip_of(text.encode()) is None


@pytest.mark.parametrize(
    ("row", "variant", "part"),
    [("a = 1.0.0", "stops_at", ".0"), ("a = b ~= c", "stops_at", "~"), ("del f()", "told_at", "f")],
)
def test_of_another_error_only_the_place_is_told(
    tmp_path: Path, row: str, variant: str, part: str
) -> None:
    bench = Bench(tmp_path / "my_robot_controller")
    bench.write(NODE, f"#!/usr/bin/env python3\n{row}\n")
    found = bench.evidence()
    found.distro = find_distro("jazzy")
    with pytest.raises(Failed) as told:
        source.node_file.function(found)
    assert told.value.variant == variant
    assert told.value.words["part"] == part


def test_every_text_says_what_to_write() -> None:
    texts = " ".join(str(text) for text in (*FORMS.values(), *WORDS.values()))
    assert "often" not in texts
