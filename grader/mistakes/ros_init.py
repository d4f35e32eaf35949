"""Mistakes with which a node does not start: rclpy.init()."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.after_with import NO_CONTEXT
from grader.mistakes.example import INIT, INNER, NODE, example
from grader.mistakes.fixes import lines, node_init, node_life
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.package.edit.tree import Replace, Write
from grader.package.source.counter import targets_of
from grader.package.source.imported import full_name
from grader.package.source.module import Function
from grader.package.source.names import calls_in, dotted, last_part
from grader.package.source.place import block_of

NOT_INITIALIZED = r"NotInitializedException"
NOT_READY = r"Context must be initialized"  # of rclpy on kilted
NODES_MADE = msg("rclpy.init() connects the program to ROS; no node can be created before it.")

ROBOT = """\
from rclpy.node import Node


class MyFirstNode(Node):
    def __init__(self):
        super().__init__('my_first_node')
        self.counter_ = 0
        self.create_timer(1.0, self.timer_callback)

    def timer_callback(self):
        self.get_logger().info('Hello time: ' + str(self.counter_))
        self.counter_ += 1


node = MyFirstNode()
"""
MAIN = f"""\
#!/usr/bin/env python3
import rclpy

from {INNER}.robot import node


def main(args=None):
    rclpy.init(args=args)
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
"""


def _inits(raised: Raised) -> list[ast.Call]:
    own = {f.name for f in raised.source.all_nodes if isinstance(f, Function)}
    return [
        call
        for call, name in raised.source.calls
        if (last_part(name) == "init" and (name == "rclpy.init" or "init" not in own))
        or full_name(raised.source.module_of(call), call.func) == "rclpy.init"
    ]


def _init_missing(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    if _inits(raised):
        return None
    written = node_init.new_call(raised.source)
    for node in raised.source.all_nodes:
        if isinstance(node, ast.Expr) and dotted(node.value) == "rclpy.init":
            found = raised.finding("init_missing", at=node, written=written)
            return replace(found, variant="not_called")
    return raised.finding("init_missing", written=written)


def _without_init(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Look for a program without rclpy.init(), whose executor finds no running ROS."""
    return _init_missing(raised, match) if raised.inside == "rclpy" else None


def _made_on_import(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Look for a node that is created outside of functions, when the file is imported."""
    del match
    source = raised.source
    found = node_init.made_on_import(source)
    if found is None and (other := node_init.made_in_module(source)) is not None:
        made, imported = other
        words = {
            "made": next(targets_of(made), "node"),
            "line": str(imported.lineno),
            "path": source.entry.path,
        }
        value = made.value if isinstance(made, ast.Assign | ast.Expr) else None
        words["call"] = source.module_of(made).text.code(value) if value is not None else ""
        words["type"] = next((dotted(c.func) for c, _ in calls_in(made)), "")
        return replace(raised.finding("made_on_import", at=made, params=words), variant="module")
    if found is None:
        return None
    made, init = found
    variable = next(targets_of(made), "")
    words = {
        "written": source.entry.text.code(init) if init else node_init.new_call(source),
        "line": str(init.lineno) if init else "",
        "name": variable,
    }
    mistake = raised.finding("made_on_import", at=made, params=words)
    shared = variable and node_init.used_elsewhere(source, variable)
    variant = "no_init" if init is None else ""
    if shared:
        variant = f"{variant}_global".lstrip("_")
    return replace(mistake, variant=variant)


def _init_in_guard(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Look for an rclpy.init() that runs only if the file is started directly."""
    del match
    found = node_init.guarded_init(raised.source)
    if found is None:
        return None
    written = node_init.moved_call(raised.source, found)
    return raised.finding("init_in_guard", at=found, written=written, line=str(found.lineno))


def _init_as_default(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Look for a node that is made as the default value of a parameter, which Python does on import."""
    del match
    source = raised.source
    for module in source.known_modules:
        for function in (n for n in module.nodes if isinstance(n, Function)):
            given = [*function.args.defaults, *filter(None, function.args.kw_defaults)]
            for value in given:
                if isinstance(value, ast.Call) and dotted(value.func) in source.class_names:
                    code = module.text.code(value)
                    found = raised.finding("node_as_default", at=value, name=code)
                    return replace(found, words={**found.words, "method": function.name})
    return None


def _init_late(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    inits = _inits(raised)
    if not inits:
        return None
    source = raised.source
    main = [c for c in inits if source.main and source.function_around(c) is source.main]
    if (own := _own_context(inits)) is not None:
        code = source.module_of(own[0]).text.code(own[0])
        return replace(
            raised.finding("init_late", at=own[0], name=code, written=own[1]), variant="context"
        )
    if _ran_before(raised, main):
        return raised.finding("ros_not_running")
    moved = (main or inits) if len(main or inits) == 1 else []
    if moved and last_part(dotted(moved[0].func)) != "init":
        code = source.module_of(moved[0]).text.code(moved[0])
        return raised.finding("init_late", at=moved[0], written=code)
    if not moved or dotted(moved[0].func) != "rclpy.init":
        return raised.finding("init_late", written=node_init.new_call(source))
    written = node_init.moved_call(source, moved[0])
    mistake = raised.finding("init_late", at=moved[0], written=written)
    module = source.module_of(moved[0])
    statement = module.parents.get(moved[0])
    alone = isinstance(statement, ast.Expr) and block_of(module, statement) == [statement]
    return replace(mistake, variant="alone" if alone else "")


def _own_context(inits: list[ast.Call]) -> tuple[ast.Call, str] | None:
    """Return the only call of init with a context of its own, and the call without it."""
    call = inits[0] if len(inits) == 1 else None
    if call is None or not any(keyword.arg == "context" for keyword in call.keywords):
        return None
    kept = [keyword for keyword in call.keywords if keyword.arg != "context"]
    return call, ast.unparse(ast.Call(call.func, call.args, kept))


def _ran_before(raised: Raised, inits: list[ast.Call]) -> bool:
    """Whether the first lines of main call init, and a later one makes the node."""
    main = raised.source.main
    if main is None or not inits:
        return False
    made = [call.lineno for call, _ in calls_in(main) if raised.source.is_node_class(call.func)]
    plain = [s.value for s in main.body if isinstance(s, ast.Expr) and s.value in inits]
    if plain and not _calls_above(main, plain[0]):
        return True
    return bool(plain and made) and plain[0].lineno < min(made)


def _calls_above(main: Function, init: ast.Call) -> bool:
    """Whether main calls something of its own above the line with init."""
    return any(call.lineno < init.lineno for s in main.body for call, _ in calls_in(s))


def _init_twice(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    del match
    inits = [call for call, name in raised.source.calls if name == "rclpy.init"]
    main = raised.source.main
    if len(inits) == 1:
        around = raised.source.function_around(inits[0])
        if around is None or around is main or raised.line != inits[0].lineno:
            return replace(raised.finding("init_twice"), variant="imported")
        written = node_init.new_call(raised.source)
        found = raised.finding("init_twice", at=inits[0], name=around.name, written=written)
        return replace(found, variant="each_call")
    others = [call for call in inits if raised.source.function_around(call) is not main]
    surplus = others if 0 < len(others) < len(inits) else inits[1:]
    return raised.finding("init_twice", at=surplus[0] if surplus else None)


def _without_keyword(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The call of init on the line has a value that is not given by its name."""
    del match
    for call, name in raised.source.calls:
        if last_part(name) == "init" and call.args and raised.line == call.lineno:
            text = raised.source.module_of(call).text
            function, given = text.code(call.func), text.code(call.args[0])
            several = len(call.args) > 1
            written = node_init.new_call(raised.source) if several else f"{function}(args={given})"
            return raised.finding("init_arguments", at=call, name=text.code(call), written=written)
    return None


def _not_a_command_line(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """What init gets as args is set by a call, as with argparse, and is no list of texts."""
    del match
    for call, name in raised.source.calls:
        given = next((k.value for k in call.keywords if k.arg == "args"), None)
        if last_part(name) != "init" or given is None or call.lineno != raised.line:
            continue
        function = raised.source.function_around(call)
        inside = list(ast.walk(function)) if function is not None else []
        sets = [
            n
            for n in inside
            if isinstance(n, ast.Assign)
            and dotted(given) in targets_of(n)
            and isinstance(n.value, ast.Call)
            and n.lineno < call.lineno
        ]
        if not dotted(given) or not sets:
            return None
        found = raised.finding("init_arguments", at=call, name=dotted(given))
        words = {**found.words, "line": sets[-1].lineno, "written": f"{name}()"}
        return replace(found, words=words, variant="object")
    return None


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "made_on_import",
        "start",
        msg("The node is created when the file is imported, before rclpy.init()"),
        msg(
            "A line outside of functions runs when Python imports the file. {function} runs later, "
            "and so does its rclpy.init()."
        ),
        msg("Move this line into {function}, below {written} (line {line})."),
        links.RCLPY,
        whys={
            "module": msg(
                "A line outside of functions runs when Python imports the file: here in line {line} of "
                "{path}, before {function}. No node can be created before rclpy.init()."
            ),
            **dict.fromkeys(
                ("no_init", "no_init_global"),
                msg(
                    "A line outside of functions runs when Python imports the file, before {function}. "
                    "No node can be created before rclpy.init()."
                ),
            ),
        },
        fixes={
            "module": msg(
                "Delete this line. In {path}, import {type} instead, and write {made} = {call} in "
                "{function}, below rclpy.init()."
            ),
            "no_init": msg("Move this line into {function}, and write {written} above it."),
            "no_init_global": msg(
                "Move this line into {function}, and write {written} above it. Write global {name} "
                "as the first line of {function}, because other code uses {name} too."
            ),
            "global": msg(
                "Move this line into {function}, below {written} (line {line}). Write global {name} "
                "as the first line of {function}, because other code uses {name} too."
            ),
        },
        raised={NOT_INITIALIZED: _made_on_import},
        fixed_by=(node_init.into_main,),
        examples=(
            example(
                "node_made_above_functions_that_init_and_spin",
                Replace(NODE, "    node = MyFirstNode()\n", ""),
                Replace(
                    NODE,
                    "def main(",
                    "node = MyFirstNode()\n\n\ndef setup(args):\n    rclpy.init(args=args)\n\n\n"
                    "def loop():\n    rclpy.spin(node)\n\n\ndef main(",
                ),
                Replace(NODE, "    rclpy.init(args=args)\n    try", "    setup(args)\n    try"),
                Replace(NODE, "        rclpy.spin(node)\n    except", "        loop()\n    except"),
                fails="run.starts",
            ),
            example(
                "node_made_in_another_file",
                Write(f"{INNER}/robot.py", ROBOT),
                Write(NODE, MAIN),
                fails="run.starts",
            ),
            example(
                "node_made_on_import",
                Replace(NODE, "    node = MyFirstNode()\n", ""),
                Replace(NODE, "def main(", "node = MyFirstNode()\n\n\ndef main("),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "init_missing",
        "start",
        msg("rclpy.init() is not called"),
        NODES_MADE,
        msg("Write {written} as the first line of {function}."),
        links.RCLPY,
        fixes={"not_called": msg("Write () after rclpy.init: without them it is not called.")},
        seen=r"NotInitializedException",
        raised={NOT_INITIALIZED: _init_missing, f"{NO_CONTEXT}|{NOT_READY}": _without_init},
        fixed_by=(node_life.called_init, node_life.rclpy_init),
        examples=(
            example(
                "rclpy_init_not_called",
                Replace(NODE, "rclpy.init(args=args)", "rclpy.init"),
                fails="run.starts",
            ),
            example(
                "init_missing_before_an_executor",
                Replace(
                    NODE,
                    "    rclpy.init(args=args)\n",
                    "    executor = rclpy.executors.SingleThreadedExecutor()\n",
                ),
                Replace(
                    NODE, "rclpy.spin(node)", "executor.add_node(node)\n        executor.spin()"
                ),
                fails="run.starts",
            ),
            example(
                "rclpy_init_missing",
                Replace(NODE, "    rclpy.init(args=args)\n", ""),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "init_in_guard",
        "start",
        msg("rclpy.init() runs only if the file is started directly"),
        msg(
            "ros2 run imports the file and calls {function}. What stands below if __name__ == "
            "'__main__': does not run then."
        ),
        msg("Move {written} from line {line} to the first line of {function}."),
        links.RCLPY,
        raised={NOT_INITIALIZED: _init_in_guard},
        fixed_by=(node_init.out_of_guard,),
        examples=(
            example(
                "rclpy_init_in_guard",
                Replace(NODE, "    rclpy.init(args=args)\n", ""),
                Replace(NODE, "def main(args=None):", "def main():"),
                Replace(
                    NODE,
                    "if __name__ == '__main__':\n",
                    "if __name__ == '__main__':\n    rclpy.init()\n",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "node_as_default",
        "start",
        msg("A node is the default value of a parameter"),
        msg(
            "Python works out a default value when it reads the def: here at the import of the file, before "
            "{method} is called. {name} makes the node then, and rclpy.init() has not run."
        ),
        msg(
            "Delete the parameter of {method} that has {name} as its default, and write a line there instead, "
            "below rclpy.init(): the name of the parameter, = and {name}."
        ),
        links.RCLPY,
        raised={NOT_INITIALIZED: _init_as_default},
        examples=(
            example(
                "node_as_default_of_main",
                Replace(NODE, "def main(args=None):", "def main(args=None, node=MyFirstNode()):"),
                Replace(NODE, "    node = MyFirstNode()\n", ""),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "init_late",
        "start",
        msg("rclpy.init() does not run before the node is created"),
        NODES_MADE,
        msg("Move {written} to the first line of {function}."),
        links.RCLPY,
        whys={
            "context": msg(
                "context= gives rclpy.init a context of its own, and the node uses the usual one, in "
                "which ROS is not running."
            )
        },
        fixes={
            "alone": msg(
                "Write {written} as the first line of {function}, and write pass instead of this line: it is "
                "the only one of its block."
            ),
            "context": msg("Write {written} instead of {name}. A program needs no other context."),
        },
        raised={NOT_INITIALIZED: _init_late},
        fixed_by=(lines.written, node_life.rclpy_init),
        examples=(
            example(
                "init_with_another_context",
                Replace(
                    NODE,
                    "rclpy.init(args=args)",
                    "context = rclpy.Context()\n    rclpy.init(args=args, context=context)",
                ),
                fails="run.starts",
            ),
            example(
                "rclpy_init_after_node",
                Replace(
                    NODE,
                    "    rclpy.init(args=args)\n    node = MyFirstNode()\n",
                    "    node = MyFirstNode()\n    rclpy.init(args=args)\n",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "init_arguments",
        "start",
        msg("rclpy.init() does not get its arguments as it takes them"),
        msg("rclpy.init() takes values only by their names, and the arguments are called args."),
        msg("Write {written}."),
        whys={
            "object": msg(
                "rclpy.init() takes the command line: a list of texts, or None. Line {line} gives {name} "
                "another value."
            )
        },
        fixes={
            "object": msg(
                "Write {written} in this line: it takes the command line by itself. Or give what line "
                "{line} makes another name than {name}."
            )
        },
        raised={
            r"\binit\(\) takes 0 positional arguments": _without_keyword,
            r"TypeError: __init__\(\): incompatible constructor arguments": _not_a_command_line,
        },
        fixed_by=(lines.written,),
        examples=(
            example(
                "init_gets_what_argparse_made",
                Replace(NODE, "import rclpy\nfrom", "import argparse\n\nimport rclpy\nfrom"),
                Replace(
                    NODE,
                    "    rclpy.init(args=args)\n",
                    "    args = argparse.ArgumentParser().parse_known_args()[0]\n"
                    "    args = argparse.Namespace(**vars(args))\n    rclpy.init(args=args)\n",
                ),
                fails="run.starts",
            ),
            example(
                "init_as_in_cpp",
                Replace(NODE, "import rclpy\nfrom", "import sys\n\nimport rclpy\nfrom"),
                Replace(NODE, "rclpy.init(args=args)", "rclpy.init(len(sys.argv), sys.argv)"),
                fails="run.starts",
            ),
            example(
                "init_args_without_keyword",
                Replace(NODE, "rclpy.init(args=args)", "rclpy.init(args)"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "init_twice",
        "start",
        msg("rclpy.init() is called twice"),
        msg("rclpy.init() connects the program to ROS; calling it again is an error."),
        msg("Keep only one rclpy.init(args=args), in the first line of {function}."),
        links.RCLPY,
        seen=r"RuntimeError: Context\.init\(\) must only be called once",
        fixes={
            "imported": msg(
                "This file has one such call. Either this line runs twice: in a loop, or because {function} "
                "is called twice, also by a line outside of functions. Or another file calls rclpy.init() "
                "when it is imported: look in {package}/__init__.py, which should be empty. Let only one "
                "call run."
            ),
            "each_call": msg(
                "Delete this line, and write {written} as the first line of {function}: that runs once."
            ),
        },
        whys={
            "each_call": msg(
                "rclpy.init() connects the program to ROS; calling it again is an error. This line is in "
                "{name}, so it runs each time the program calls {name}: more than once here, or after "
                "another call of rclpy.init()."
            )
        },
        raised={r"Context\.init\(\) must only be called once": _init_twice},
        examples=(
            example(
                "init_in_the_init_file",
                Write(INIT, "import rclpy\n\nrclpy.init()\n"),
                fails="run.starts",
            ),
            example(
                "init_twice",
                Replace(
                    NODE,
                    "    rclpy.init(args=args)\n",
                    "    rclpy.init(args=args)\n    rclpy.init(args=args)\n",
                ),
                fails="run.starts",
            ),
        ),
    ),
)
