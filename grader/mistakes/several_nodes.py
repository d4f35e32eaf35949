"""Mistakes of a program with several nodes: spun one after the other, or both of them count."""

from __future__ import annotations

import ast
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import LOG_LINE, NODE, SILENT, STEP_LINE, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.mistakes.spin_not_reached import UNWRAP
from grader.package.edit.tree import Replace
from grader.package.source.counter import targets_of
from grader.package.source.module import Function
from grader.package.source.names import SPINS, calls_in, dotted, last_part
from grader.package.source.node import NodeSource
from grader.package.source.place import block_of


def _spun(call: ast.Call) -> str:
    """Return the name that a call of rclpy.spin gets; "" for another call."""
    given = call.args[0] if dotted(call.func) in ("rclpy.spin", "spin") and call.args else None
    return dotted(given) if given is not None else ""


def _in_turn(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a spin of another node before the one of the node that counts."""
    source = suspect.source
    spins = [call for call in source.calls_of("spin") if _spun(call)]
    if len(spins) == 1:
        return _in_loop(suspect, spins[0])
    counting = _counting(source)
    if len(spins) != 2:
        return None
    first, second = sorted(spins, key=lambda call: call.lineno)
    module = source.module_of(first)
    one, other = (module.parents.get(call) for call in (first, second))
    if not isinstance(one, ast.Expr) or other not in block_of(module, one):
        return None
    node = source.node_variables
    by_class = _spun(second) in node and _spun(first) not in node
    by_class = by_class or (_logs(source, _spun(second)) and not _logs(source, _spun(first)))
    if not by_class and (_spun(first) in counting or _spun(second) not in counting):
        return None
    params: dict[str, str | int] = {
        "name": _spun(first),
        "line": second.lineno,
        "written": _spun(second),
    }
    return suspect.finding("spun_in_turn", first, **params)


def _logs(source: NodeSource, variable: str) -> bool:
    """Whether the class of the object that a variable gets has a line that logs."""
    made = [n for n in source.all_nodes if isinstance(n, ast.Assign) and variable in targets_of(n)]
    kind = source.classes_by_name.get(_made(made[0].value)) if len(made) == 1 else None
    return kind is not None and bool(source.logs(kind))


def _in_loop(suspect: Suspect, spin: ast.Call) -> RecognisedMistake | None:
    """Look for a loop over nodes that spins each, and that begins with another node."""
    source = suspect.source
    module = source.module_of(spin)
    statement = module.parents.get(spin)
    loop = module.parents.get(statement) if isinstance(statement, ast.Expr) else None
    if not isinstance(loop, ast.For) or dotted(loop.target) != _spun(spin):
        return None
    counting = _counting(source)
    nodes = [
        last_part(dotted(n.func)) if isinstance(n, ast.Call) else dotted(n)
        for n in _listed(source, loop.iter)
    ]
    if not nodes or nodes[0] in counting or not set(nodes) & counting:
        return None
    found = suspect.finding("spun_in_turn", spin, name=_spun(spin), line=loop.lineno)
    return replace(found, variant="loop")


def _listed(source: NodeSource, given: ast.expr) -> list[ast.expr]:
    """Return the parts of a list, also of one that a variable gets once."""
    if isinstance(given, ast.List | ast.Tuple):
        return given.elts
    name = dotted(given)
    made = [n for n in source.all_nodes if name and name in targets_of(n)]
    value = made[0].value if len(made) == 1 and isinstance(made[0], ast.Assign) else None
    return value.elts if isinstance(value, ast.List | ast.Tuple) else []


def _counting(source: NodeSource) -> set[str]:
    """Return the classes that log with a timer, and the variables that get an object of one."""
    classes = set(_classes(source))
    made = [n for n in source.all_nodes if isinstance(n, ast.Assign)]
    return classes.union(*(targets_of(n) for n in made if _made(n.value) in classes))


def _never_added(suspect: Suspect) -> RecognisedMistake | None:
    """The only executor gets another node twice, and never the one that counts."""
    source = suspect.source
    added = [c for c in source.calls_of("add_node") if len(c.args) == 1 and dotted(c.args[0])]
    owners = {dotted(c.func) for c in added}
    counting = _counting(source) - set(_classes(source))
    if len(counting) != 1 or len(owners) != 1 or len(added) != len(source.calls_of("add_node")):
        return None
    missing, given = next(iter(counting)), [dotted(c.args[0]) for c in added]
    if missing in given or _is_handed_on(source, missing):
        return None
    again = next((k for k, name in enumerate(given) if name in given[:k]), None)
    if again is None:
        return None
    call = added[again]
    statement = source.module_of(call).parents.get(call)
    made = [n.lineno for n in source.own_nodes if missing in targets_of(n) and hasattr(n, "lineno")]
    if not isinstance(statement, ast.Expr) or not made or max(made) > call.lineno:
        return None
    return suspect.finding("never_added", call, name=given[again], written=missing)


def _inner_node(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a node with a timer that the node makes for itself, and that nothing spins."""
    source = suspect.source
    given = {
        last_part(dotted(arg))
        for module in source.known_modules
        for call in module.nodes
        if isinstance(call, ast.Call) and last_part(dotted(call.func)) in (*SPINS, "add_node")
        for arg in call.args
    }
    for node in source.own_nodes:
        if not isinstance(node, ast.Assign):
            continue
        made = source.classes_by_name.get(_made(node.value))
        names = [name for name in targets_of(node) if name.startswith("self.")]
        if made is None or not names or "Node" not in [last_part(dotted(b)) for b in made.bases]:
            continue
        timed = any(last_part(name) == "create_timer" for _, name in calls_in(made))
        own = last_part(names[0])
        if timed and own not in given and source.node_class is not made:
            variable = min(source.node_variables, default="node")
            found = suspect.finding("inner_node_not_spun", node, name=names[0])
            words = {**found.words, "type": made.name, "node": variable, "attribute": own}
            return replace(found, words=words)
    return None


def _is_handed_on(source: NodeSource, name: str) -> bool:
    """Whether a variable is used other than for its methods and attributes."""
    for node in source.all_nodes:
        read = isinstance(node, ast.Name | ast.Attribute) and isinstance(node.ctx, ast.Load)
        if read and dotted(node) == name:
            around = source.module_of(node).parents.get(node)
            if not isinstance(around, ast.Attribute) or around.attr in ("executor", "spin"):
                return True
    return False


def _made(value: ast.expr) -> str:
    return last_part(dotted(value.func)) if isinstance(value, ast.Call) else ""


def _classes(source: NodeSource) -> dict[str, ast.ClassDef]:
    """Return the classes that log with a timer, by name."""
    return {c.name: c for m in source.modules for c in m.classes if _logs_with_timer(source, c)}


def _both_count(suspect: Suspect) -> RecognisedMistake | None:
    """Look for two nodes of the entry function that are both spun, and both log with a timer."""
    source, main = suspect.source, suspect.function
    if main is None:
        return None
    text = suspect.output.text.partition("{")[0].strip()
    found = _classes(source).items()
    classes = {name: c for name, c in found if not text or text in ast.unparse(c)}
    looped = _made_in_loop(suspect, main, classes)
    if looped is not None:
        return looped
    added = {dotted(a) for call in source.calls_of("add_node", within=main) for a in call.args}
    made = [
        (n, name, _made(n.value))
        for n in ast.walk(main)
        if isinstance(n, ast.Assign) and _made(n.value) in classes
        for name in targets_of(n)
        if name in added
    ]
    if len(made) != 2 or len({name for _, name, _ in made}) != 2:
        return None
    made.sort(key=lambda each: each[0].lineno)
    wanted = [suspect.assignment.node_name in ast.unparse(classes[c]) for _, _, c in made]
    kept, gone = reversed(made) if wanted == [False, True] else made
    rows = {
        n.lineno
        for n in ast.walk(main)
        if isinstance(n, ast.expr) and dotted(n) == gone[1] and n.lineno != gone[0].lineno
    }
    gone_lines = ", ".join(map(str, sorted(rows)))
    return suspect.finding(
        "two_nodes_count", gone[0], name=gone[1], line=kept[0].lineno, lines=gone_lines
    )


def _made_in_loop(
    suspect: Suspect, main: Function, classes: dict[str, ast.ClassDef]
) -> RecognisedMistake | None:
    """Look for a loop of the entry function that makes a node in each round, and uses no number."""
    for loop in ast.walk(main):
        if not isinstance(loop, ast.For) or loop.orelse:
            continue
        names = {last_part(name) for _, name in calls_in(loop)}
        inside = [n for s in loop.body for n in ast.walk(s)]
        leaves = any(isinstance(n, ast.Break | ast.Continue) for n in inside)
        used = any(dotted(n) == dotted(loop.target) for n in inside if isinstance(n, ast.Name))
        if names & set(classes) and "add_node" in names and not leaves and not used:
            found = suspect.finding("two_nodes_count", loop, word="for")
            return replace(found, variant="loop")
    return None


def _made_each_round(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a loop of the entry function that makes a node in each round, and spins that."""
    source, main = suspect.source, suspect.function
    for loop in ast.walk(main) if main is not None else ():
        if not isinstance(loop, ast.While):
            continue
        for made in (s for s in loop.body if isinstance(s, ast.Assign)):
            spun = {
                dotted(call.args[0])
                for call, name in calls_in(loop)
                if last_part(name) in SPINS and last_part(name) != "spin" and call.args
            }  # (spin does not return before Ctrl+C: the loop has no second round)
            names = spun & set(targets_of(made))
            if names and _made(made.value) in source.class_names:
                code = source.module_of(made).text.code(made)
                found = suspect.finding(
                    "made_each_round", made, name=code, variable=min(names), line=loop.lineno
                )
                once = any(last_part(name) == "spin_once" for _, name in calls_in(loop))
                return replace(found, variant="once") if once else found
    return None


def _logs_with_timer(source: NodeSource, found: ast.ClassDef) -> bool:
    names = {last_part(name) for _, name in calls_in(found)}
    return "create_timer" in names and bool(source.logs(found))


OTHER = """\
class OtherNode(Node):

    def __init__(self):
        super().__init__('other_node')


def main("""
PUBLISHER = """\
from std_msgs.msg import String


class TextPublisher(Node):

    def __init__(self):
        super().__init__('text_publisher')
        self.publisher_ = self.create_publisher(String, 'hello', 10)
        self.count_ = 0
        self.create_timer(1.0, self.publish_text)

    def publish_text(self):
        self.publisher_.publish(String(data='Hello time: ' + str(self.count_)))
        self.count_ += 1


class MyFirstNode(Node):"""
EXECUTOR = """\
        executor = SingleThreadedExecutor()
        other = MyFirstNode()
        executor.add_node(node)
        executor.add_node(other)
        executor.spin()
"""
_node = Family("node", links.EXECUTORS)
KINDS = (
    _node(
        "spun_in_turn",
        "spin",
        msg("Another node is spun first"),
        msg(
            "rclpy.spin({name}) waits until Ctrl+C. Line {line}, which spins {written}, is not "
            "reached before."
        ),
        msg(
            "If the program does not need {name}, delete this line. To spin both nodes, write "
            "from rclpy.executors import SingleThreadedExecutor at the top of the file, three lines "
            "instead of this one: executor = SingleThreadedExecutor(), executor.add_node({name}) and "
            "executor.add_node({written}), and executor.spin() instead of line {line}."
        ),
        whys={
            "loop": msg(
                "rclpy.spin waits until Ctrl+C: the loop does not come to its second node before. "
                "Only the callbacks of the first node are called."
            )
        },
        fixes={
            "loop": msg(
                "Give all nodes to one executor: write from rclpy.executors import "
                "SingleThreadedExecutor at the top of the file, executor = SingleThreadedExecutor() "
                "above line {line}, executor.add_node({name}) instead of this line, and "
                "executor.spin() below it, indented as far as line {line}."
            )
        },
        behind={"run.no_lines": _in_turn, "run.never_spins": _in_turn},
        examples=(
            example(
                "nodes_spun_in_turn",
                Replace(NODE, "def main(", OTHER),
                Replace(NODE, "        rclpy.spin(node)\n", ""),
                Replace(
                    NODE,
                    "    try:\n",
                    "    other = OtherNode()\n    try:\n"
                    "        rclpy.spin(other)\n        rclpy.spin(node)\n",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
            example(
                "publisher_spun_before_the_node_that_logs",
                Replace(NODE, "class MyFirstNode(Node):", PUBLISHER),
                Replace(NODE, "        self.counter_ = 0\n", ""),
                Replace(
                    NODE,
                    "self.create_timer(1.0, self.timer_callback)",
                    "self.create_subscription(String, 'hello', self.timer_callback, 10)",
                ),
                Replace(NODE, "def timer_callback(self):", "def timer_callback(self, msg):"),
                Replace(NODE, LOG_LINE + STEP_LINE, "        self.get_logger().info(msg.data)\n"),
                Replace(NODE, "    try:\n", "    publisher = TextPublisher()\n    try:\n"),
                Replace(
                    NODE,
                    "        rclpy.spin(node)\n",
                    "        rclpy.spin(publisher)\n        rclpy.spin(node)\n",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
            example(
                "nodes_spun_in_a_loop",
                Replace(NODE, "def main(", OTHER),
                Replace(
                    NODE,
                    "        rclpy.spin(node)\n",
                    "        for each in [OtherNode(), node]:\n            rclpy.spin(each)\n",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
    _node(
        "inner_node_not_spun",
        "spin",
        msg("A node that the node makes is not spun"),
        msg(
            "{type} is a node of its own, with a timer of its own. rclpy.spin calls the callbacks of the "
            "node that it gets and of no other, so nothing calls the callback of that timer."
        ),
        msg(
            "Spin both nodes. In {function}, write instead of rclpy.spin({node}): executor = "
            "rclpy.executors.SingleThreadedExecutor(), then executor.add_node({node}), "
            "executor.add_node({node}.{attribute}) and executor.spin(), each in a line of its own. Write "
            "import rclpy.executors at the top of the file."
        ),
        links.EXECUTORS,
        behind={"run.no_lines": _inner_node},
        examples=(
            example(
                "timer_in_a_node_that_is_not_spun",
                Replace(
                    NODE,
                    "class MyFirstNode",
                    "class Ticker(Node):\n"
                    "    def __init__(self, callback):\n"
                    "        super().__init__('ticker')\n"
                    "        self.create_timer(1.0, callback)\n\n\n"
                    "class MyFirstNode",
                ),
                Replace(
                    NODE,
                    "        self.create_timer(1.0, self.timer_callback)\n",
                    "        self.ticker_ = Ticker(self.timer_callback)\n",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
    _node(
        "never_added",
        "spin",
        msg("The executor never gets the node that counts"),
        msg(
            "An executor calls the callbacks of the nodes that add_node gave to it, and of no others. "
            "{name} is given to it twice, and {written} never."
        ),
        msg("Write {written} instead of {name} in this line."),
        behind={"run.no_lines": _never_added, "run.never_spins": _never_added},
        fixed_by=(lines.written,),
        examples=(
            example(
                "same_node_given_to_the_executor_twice",
                Replace(NODE, "def main(", OTHER),
                Replace(
                    NODE,
                    "        rclpy.spin(node)\n",
                    EXECUTOR.replace("MyFirst", "Other").replace(
                        "add_node(node)", "add_node(other)"
                    ),
                ),
                Replace(
                    NODE,
                    "from rclpy.node",
                    "from rclpy.executors import SingleThreadedExecutor\nfrom rclpy.node",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
    _node(
        "made_each_round",
        "spin",
        msg("Each round of a loop makes a new node"),
        msg(
            "The loop of line {line} makes a new node in each round. Its timer begins to wait anew, and "
            "its counter has its first value again."
        ),
        msg(
            "Make the node once: move {name} above the loop. Then write rclpy.spin({variable}) instead of "
            "the loop, and below it what cleans up."
        ),
        whys={
            "once": msg(
                "The loop of line {line} makes a new node in each round. Its timer begins to wait anew, and "
                "its counter has its first value again. A message of a simulated clock ends spin_once() too: "
                "in the grader's run, fewer lines can come than in your terminal."
            ),
        },
        behind=dict.fromkeys(
            ("run.no_lines", "run.constant_counter", "run.stops", "run.wrong_step", "run.twice"),
            _made_each_round,
        ),
        examples=(
            example(
                "node_made_in_each_round",
                Replace(
                    NODE,
                    "        rclpy.spin(node)\n",
                    "        while rclpy.ok():\n            node = MyFirstNode()\n"
                    "            rclpy.spin_once(node)\n            node.destroy_node()\n",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
    _node(
        "two_nodes_count",
        "timer",
        msg("Two nodes log the lines of the count, and both are spun"),
        msg(
            "This line creates a second node beside the one of line {line}. Each has a timer of its "
            "own, and each logs its own lines."
        ),
        msg("Keep one: delete this line, and delete what uses {name} in line {lines}."),
        whys={
            "loop": msg(
                "This loop creates a node in each round. Each has a timer of its own, and each logs "
                "its own lines."
            )
        },
        fixes={"loop": UNWRAP},
        behind={"run.twice": _both_count, "run.wrong_step": _both_count},
        examples=(
            example(
                "two_nodes_count",
                Replace(NODE, "        rclpy.spin(node)\n", EXECUTOR),
                Replace(
                    NODE,
                    "from rclpy.node",
                    "from rclpy.executors import SingleThreadedExecutor\nfrom rclpy.node",
                ),
                fails="run.output",
            ),
            example(
                "node_made_in_a_loop_of_main",
                Replace(
                    NODE,
                    "        rclpy.spin(node)\n",
                    "        executor = SingleThreadedExecutor()\n"
                    "        for _ in range(2):\n"
                    "            node = MyFirstNode()\n"
                    "            executor.add_node(node)\n"
                    "        executor.spin()\n",
                ),
                Replace(NODE, "    node = MyFirstNode()\n    try", "    try"),
                Replace(
                    NODE,
                    "from rclpy.node",
                    "from rclpy.executors import SingleThreadedExecutor\nfrom rclpy.node",
                ),
                fails="run.output",
            ),
        ),
    ),
)
