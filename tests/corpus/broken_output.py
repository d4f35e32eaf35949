"""Nodes that run and count, but with a wrong text, period, logger or node name."""

from __future__ import annotations

from grader.validate.tree import Edit, Replace

from .model import NODE, Package, broken
from .right_node import CATCH, COUNT, LINE, STEP, TEXT, TIMER

LOG = "self.get_logger().info"
FAKED = (
    "print(f'[INFO] [{time.time():.9f}] [my_first_node]: Hello time: {self.counter_}', "
    "file=sys.stderr, flush=True)"
)
ENDLESS_LOOP = """\
    import signal
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    rclpy.spin(node)
"""


def _node(old: str, new: str) -> Edit:
    return Replace(NODE, old, new)


def _imports(*names: str) -> Edit:
    return _node("import rclpy\nfrom", "".join(f"import {n}\n" for n in (*names, "rclpy")) + "from")


def _says(name: str, *edits: Edit, mistake: str, note: str = "") -> Package:
    return broken(name, *edits, failed={"run.output": mistake}, score=90, note=note)


def _logs(name: str, *edits: Edit, mistake: str, note: str = "") -> Package:
    return broken(name, *edits, failed={"run.logger": mistake}, score=97, note=note)


def _times(name: str, *edits: Edit, mistake: str = "run.wrong_period", note: str = "") -> Package:
    return broken(name, *edits, failed={"run.period": mistake}, score=96, note=note)


OUTPUT = (
    broken("wrong_node_name", _node("'my_first_node'", "'my_node'"),
           failed={"run.node_name": "run.wrong_node_name"}, score=95,
           note="the logger has the node's name: one mistake, counted once"),
    broken("node_name_capital", _node("'my_first_node'", "'My_first_node'"),
           failed={"run.node_name": "run.wrong_node_name"}, score=95),
    broken("node_in_namespace", _node("'my_first_node')", "'my_first_node', namespace='robot')"),
           failed={"run.node_name": "run.wrong_node_name"}, score=95),
    _says("text_extra", _node(TEXT, f"{TEXT} + '!'"), mistake="run.wrong_text"),
    _says("text_capital", _node("'Hello time: '", "'hello time: '"), mistake="run.wrong_text"),
    _says("text_other_capital", _node("'Hello time: '", "'Hello Time: '"),
          mistake="run.wrong_text"),
    _says("text_blank_missing", _node("'Hello time: '", "'Hello time:'"), mistake="run.wrong_text"),
    _says("text_two_blanks", _node("'Hello time: '", "'Hello time:  '"), mistake="run.wrong_text"),
    _says("text_misspelt", _node("'Hello time: '", "'Helo time: '"), mistake="run.wrong_text"),
    _says("text_of_another_course", _node(TEXT, "'Hello World'"), mistake="run.wrong_text"),
    _says("text_without_number", _node(TEXT, "'Hello time: '"), mistake="node.text_without_number",
          note="21 of 147 log a constant"),
    _says("f_prefix_missing", _node(TEXT, "'Hello time: {self.counter_}'"),
          mistake="node.f_prefix"),
    _says("number_as_float", _node(COUNT, "self.counter_ = 0.0"), mistake="node.number_format"),
    _says("number_padded", _node(TEXT, "f'Hello time: {self.counter_:02}'"),
          mistake="node.number_format", note="Hello time: 00"),
    _says("counter_constant", _node(f"        {STEP}\n", ""), mistake="node.counter_not_increased"),
    _says("counter_reset", _node(LINE, f"{COUNT}\n        {LINE}"), mistake="node.counter_reset"),
    _says("counter_plus_is_plus", _node(STEP, "self.counter_ =+ 1"), mistake="node.plus_reversed",
          note="0, 1, 1, 1: =+ for +="),
    _says("starts_at_one", _node(COUNT, "self.counter_ = 1"), mistake="node.starts_elsewhere"),
    _says("adds_before_logging", _node(f"{LINE}\n        {STEP}", f"{STEP}\n        {LINE}"),
          mistake="node.adds_before_log"),
    _says("counts_by_two", _node(STEP, "self.counter_ += 2"), mistake="node.other_step"),
    _says("counts_down", _node(STEP, "self.counter_ -= 1"), mistake="node.other_step"),
    _says("adds_twice", _node(STEP, f"{STEP}\n        {STEP}"), mistake="node.adds_twice"),
    _says("logs_twice", _node(LINE, f"{LINE}\n        {LINE}"), mistake="node.logs_twice"),
    _says("two_timers", _node(TIMER, f"{TIMER}\n        {TIMER}"), mistake="node.two_timers"),
    _logs("printed", _node(LOG, "print"), mistake="node.print_used"),
    _logs("printed_in_log_form", _imports("sys", "time"), _node(LINE, FAKED),
          mistake="run.faked_log"),
    _logs("logger_of_its_own", _imports("rclpy.logging"),
          _node(LOG, "rclpy.logging.get_logger('my_logger').info"), mistake="run.other_logger"),
    _logs("python_logging", _imports("logging"),
          _node("    rclpy.init(args=args)", "    rclpy.init(args=args)\n"
                "    logging.basicConfig(level=logging.INFO, format='%(message)s')"),
          _node(LOG, "logging.info"), mistake="run.print_not_logger"),
    _logs("logged_as_warning", _node(LOG, "self.get_logger().warning"), mistake="run.wrong_level"),
    _logs("logged_as_error", _node(LOG, "self.get_logger().error"), mistake="run.wrong_level"),
    broken("printed_and_logged", _node(LINE, f"print({TEXT})\n        {LINE}"),
           failed={"run.output": "node.logs_twice", "run.logger": "node.print_used"}, score=87),
    _times("period_half", _node("(1.0,", "(0.5,")),
    _times("period_two", _node("(1.0,", "(2.0,")),
    _times("period_tenth", _node("(1.0,", "(0.1,")),
    _times("period_slightly_long", _node("(1.0,", "(1.1,")),
    _times("called_by_hand", _node(TIMER, f"{TIMER}\n        self.timer_callback()"),
           mistake="node.called_by_hand"),
    broken("error_at_stop", _node("        node.destroy_node()\n", "        node.destroy()\n"),
           failed={"run.interrupt": "node.method_misspelt"}, score=97),
    broken("ignores_interrupt", _node(CATCH, ENDLESS_LOOP),
           failed={"run.interrupt": "run.ignores_interrupt"}, score=97),
)  # fmt: skip
