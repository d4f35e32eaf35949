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
        ("def main():\n    rclpy.init()\n    rclpy = Node('n')\n", UNBOUND.format("rclpy"), 4,
         "name_reused", "", 5),
        ("def tick():\n    pass\ndef main():\n    tick = node.create_timer(1.0, tick)\n",
         UNBOUND.format("tick"), 6, "name_reused", "", 6),
        ("import time\ndef main():\n    time = 1\n    time.sleep(1)\n", LACKS.format("int", "sleep"), 6,
         "name_reused", "", 5),
        # what is read is no name of the module: the import is not what is meant
        ("import time\ndef main():\n    time = 1\n    time.tick(1)\n", LACKS.format("int", "tick"), 6,
         "attribute_unknown", None, 6),
        # nothing imports or defines the name at the top: it is only used too early
        ("def main():\n    print(node)\n    node = Node('n')\n", UNBOUND.format("node"), 4,
         "used_before_set", "line", 4),
        ("def main():\n    ros.init()\n    ros.spin(n)\n", "NameError: name 'ros' is not defined", 4,
         "name_unknown", "alias", 4),
        ("def main():\n    ros.init()\n    ros.Rate(1)\n", "NameError: name 'ros' is not defined", 4,
         "name_unknown", "", 4),
        ("class Formatter:\n    pass\ndef main():\n    a = Forma\n",
         "NameError: name 'Forma' is not defined", 6, "name_unknown", "cut", 6),
        (PROPERTY, "RecursionError: maximum recursion depth exceeded", 9, "property_of_itself",
         "setter_only", 9),
        (BASE, LACKS.format("N", "period"), 9, "attribute_set_late", "", 6),
        ("class N(Node):\n    @property\n    def n(self):\n        return self._n\n"
         "    def tick(self):\n        self.n += 1\n",
         "AttributeError: property 'n' of 'N' object has no setter", 8, "property_set", "kept", 8),
        ("import rclpy.robot\nclass N(rclpy.robot.Node):\n    pass\n",
         "ModuleNotFoundError: No module named 'rclpy.robot'", 3, "import_misspelt", "used", 3),
        ("class N(Node):\n    def __init__(self):\n        super.__init__('n')\n",
         "TypeError: descriptor '__init__' requires a 'super' object but received a 'str'", 5,
         "super_not_called", "written", 5),
        ("class N(Node):\n    def __init__(self):\n        super().__init__('n')\n"
         "        self.create_timer(period=1, callback=print)\n",
         "TypeError: Node.create_timer() got an unexpected keyword argument 'period'", 6,
         "keyword_unknown", "written", 6),
        ("class Count:\n    def text(number):\n        return str(number)\n"
         "class N(Node):\n    def tick(self):\n        self.count.text(1)\n",
         "TypeError: Count.text() takes 1 positional argument but 2 were given", 8, "arguments_many",
         "no_self", 4),
        # a helper's own names
        (HELPER.format("self.number += 1", "pass"), LACKS.format("Count", "number"), 7,
         "helper_never_sets", "others", 7),
        (HELPER.format("self.vale += 1", "pass"), LACKS.format("Count", "vale"), 7,
         "helper_never_sets", "near", 7),
        ("@dataclass\nclass Count:\n    ticks: int\n    def step(self):\n        self.number += 1\n"
         "class N(Node):\n    pass\n",
         LACKS.format("Count", "number"), 7, "helper_never_sets", "fields", 7),
        (HELPER.format("self.get_logger()", "pass"), LACKS.format("Count", "get_logger"), 7,
         "attribute_not_set", "no_node", 7),
        (HELPER.format("pass", "self.count.step(self)"),
         "TypeError: Count.step() takes 1 positional argument but 2 were given", 12,
         "self_given", "", 12),
        (HELPER.format("pass", "self.count.value()"), NOT_CALLABLE, 12, "not_callable", "open", 12),
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
