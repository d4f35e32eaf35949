"""Names that an import, a property, a base class or a helper has: what is told, and at which line."""

from __future__ import annotations

import pytest

from grader.mistakes.recognise import behind_error
from grader.mistakes.recognised import Raised
from grader.package.source.node import read_node
from grader.report.model import Where
from tests.marking import ASSIGNMENT

FILE = "my_robot_controller/my_first_node.py"
IMPORTS = "import rclpy\nfrom rclpy.node import Node\n"
UNBOUND = (
    "UnboundLocalError: cannot access local variable '{0}' where it is not associated with a value"
)
NOT_CALLABLE = "TypeError: 'int' object is not callable"
HELPER = (
    "class Count:\n    def __init__(self):\n        self.value = 0\n"
    "    def step(self):\n        {0}\n"
    "class N(Node):\n    def __init__(self):\n        super().__init__('n')\n"
    "        self.count = Count()\n        {1}\n"
)
PROPERTY = (
    "class N(Node):\n    @property\n    def n(self):\n        return self._n\n"
    "    @n.setter\n    def n(self, value):\n        self.n = int(value)\n"
)
BASE = (
    "class Base(Node):\n    def __init__(self):\n        super().__init__('n')\n"
    "        self.start()\n        self.period = 1.0\n"
    "    def start(self):\n        self.create_timer(self.period, self.tick)\n"
    "class N(Base):\n    def __init__(self):\n        super().__init__()\n"
    "    def tick(self):\n        pass\n"
)
LACKS = "AttributeError: '{0}' object has no attribute '{1}'"


@pytest.mark.parametrize(
    ("code", "error", "line", "kind", "variant", "at"),
    [
        # a variable takes the name of an import or a function
        # what is read is no name of the module: the import is not what is meant
        ("import time\ndef main():\n    time = 1\n    time.tick(1)\n", LACKS.format("int", "tick"), 6,
         "attribute_unknown", None, 6),
        # nothing imports or defines the name at the top: it is only used too early
        ("def main():\n    print(node)\n    node = Node('n')\n", UNBOUND.format("node"), 4,
         "used_before_set", "", 4),
        ("def main():\n    ros.init()\n    ros.Rate(1)\n", "NameError: name 'ros' is not defined", 4,
         "name_unknown", "", 4),
        (BASE, LACKS.format("N", "period"), 9, "attribute_not_set", "set_here", 9),
        ("class N(Node):\n    def __init__(self):\n        super.__init__('n')\n",
         "TypeError: descriptor '__init__' requires a 'super' object but received a 'str'", 5,
         "super_missing", "", 5),
        ("class N(Node):\n    def __init__(self):\n        super().__init__('n')\n"
         "        self.create_timer(period=1, callback=print)\n",
         "TypeError: Node.create_timer() got an unexpected keyword argument 'period'", 6,
         "keyword_unknown", "", 6),
        ("class Count:\n    def text(number):\n        return str(number)\n"
         "class N(Node):\n    def tick(self):\n        self.count.text(1)\n",
         "TypeError: Count.text() takes 1 positional argument but 2 were given", 8, "arguments_many",
         "no_self", 4),
        # a helper's own names
        (HELPER.format("self.get_logger()", "pass"), LACKS.format("Count", "get_logger"), 7,
         "attribute_unknown", "no_node", 7),
        (HELPER.format("pass", "self.count.value()"), NOT_CALLABLE, 12, "not_callable", "", 12),
    ],
)  # fmt: skip
def test_a_name_that_means_something_else_is_explained(
    code: str, error: str, line: int, kind: str, variant: str | None, at: int
) -> None:
    source = read_node(
        lambda path: (IMPORTS + code).encode() if path == FILE else None, FILE, "main"
    )
    assert source is not None
    found = behind_error(Raised(error, Where(file=FILE, line=line), source, ASSIGNMENT))
    assert found is not None
    assert found.kind == f"node.{kind}"
    assert variant is None or found.variant == variant
    assert found.where is not None
    assert found.where.line == at
