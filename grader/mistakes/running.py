"""The catalogue: what a run shows from outside. Where the cause is known, it stands before these."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.kind import Family, Kind

SPIN = msg(
    "rclpy.spin(node) is what keeps a node alive: it waits, and calls your callbacks when due."
)
COUNT = msg("The counter starts once, in __init__, and grows by {step} in each callback.")
RECORD = msg(
    "A record of the logger carries level, time and the node's name, and goes to /rosout, "
    "where other programs can read it; print() only writes text on this terminal."
)
LOG = msg("Write self.get_logger().info(…) in the callback.")
PERIOD = msg("The first argument of create_timer is the period in seconds.")

_run = Family("run", links.FIRST_NODE)
KINDS = (
    _run("died_at_start", "start", msg("the node stops at its start with an exception"),
         msg("An exception that nobody catches ends the program; the last line of the traceback "
             "names it, the line above shows where it came from."),
         msg("Fix the line shown; then colcon build is not needed again (--symlink-install), just "
             "run it again."), links.PYTHON_ERRORS),
    _run("exits_at_once", "spin", msg("the node ends by itself at once"), SPIN,
         msg("Call rclpy.spin(node) in {function}, after making the node (not spin_once)."),
         links.EXECUTORS),
    _run("no_node", "start", msg("no node comes up"),
         msg("A node comes into being when its class (a Node) is made, after rclpy.init()."),
         msg("See that {function} makes the node, and that nothing before it waits (input(), a "
             "loop)."),
         links.NODES),
    _run("wrong_node_name", "class", msg("the node has another name"),
         msg("The name under which ros2 node list, topics and logs show a node is the one given to "
             "super().__init__(), not that of the file or the class."),
         msg("Write super().__init__('{wanted}')."), links.NODES),
    _run("too_much_output", "limits", msg("the node prints without end"),
         msg("A loop that prints without waiting fills terminals, logs and disks."),
         msg("Log in the timer's callback only, once each time.")),
    _run("resource", "limits", msg("the node met a limit of the sandbox"),
         msg("A node that counts needs about 60 MB of memory and one process."),
         msg("Look for a list that only grows, or for programs and threads started in a loop.")),
    _run("wrong_text", "text", msg("the text is another one"),
         msg("The text is compared to the letter: capitals, spaces and punctuation count."),
         msg("Log exactly '{line}', with the counter in place of the number.")),
    _run("twice", "timer", msg("more than one line comes at a time"), COUNT,
         msg("Make one timer only, and log once in its callback.")),
    _run("constant_counter", "counter", msg("the number never changes"), COUNT,
         msg("Add {counter} += {step} to the callback, and set it to {start} only in __init__.")),
    _run("wrong_start", "counter", msg("the count starts at another number"), COUNT,
         msg("Set the counter to {start} in __init__, and add to it after logging.")),
    _run("wrong_step", "counter", msg("the count goes up by another number"), COUNT,
         msg("Add {step} to the counter once in each callback, and nowhere else.")),
    _run("no_lines", "timer", msg("no line comes"),
         msg("Lines come from the timer's callback: create_timer({period}, self.{callback}) in "
             "__init__, with the callback's name and no brackets behind it."),
         msg("Make the timer in __init__ and log in its callback.")),
    _run("by_hand", "timer", msg("a line comes before any time has passed"),
         msg("The timer calls the callback when its time has come. A call by hand "
             "(self.{callback}() in __init__) is one too many."),
         msg("Take the call out; give create_timer the callback's name and let it call.")),
    Kind(
        id="run.ended_early",
        stage="callback",
        title=msg("the node ends by itself"),
        why=SPIN,
        whys={"callback": msg("A callback that raises an exception ends the node.")},
        fix=msg("Let the timer run on: no limit on the count, no exit in the callback."),
        fixes={"callback": msg("Fix the line that the traceback shows, and run the node again.")},
        link=links.EXECUTORS,
    ),
    _run("stops", "timer", msg("the lines stop coming"), SPIN,
         msg("Let the timer run on: no limit on the count, no exit in the callback.")),
    _run("wrong_period", "timer", msg("the lines come at other instants"), PERIOD,
         msg("Write create_timer({period}, self.{callback}), once.")),
    _run("print_not_logger", "logger", msg("the lines do not go through the logger"), RECORD, LOG,
         links.LOGGING),
    _run("faked_log", "logger", msg("a line has the form of a log record that ROS never logged"),
         RECORD, LOG, links.LOGGING),
    _run("other_logger", "logger", msg("the lines go through a logger that is not the node's"),
         RECORD, LOG, links.LOGGING),
    _run("wrong_level", "logger", msg("the records have another level than INFO"),
         msg("Levels say how urgent a record is; a count is information."), LOG, links.LOGGING),
    _run("ignores_interrupt", "shutdown", msg("the node goes on after Ctrl+C"),
         msg("Ctrl+C sends SIGINT; Python turns it into KeyboardInterrupt, which ends rclpy.spin. "
             "Catching it and going on, or ignoring the signal, leaves the node behind."),
         msg("Catch KeyboardInterrupt around rclpy.spin only, and let {function} end after it."),
         links.EXECUTORS),
    _run("error_at_stop", "shutdown", msg("the node ends with an error of its own after Ctrl+C"),
         msg("What runs after rclpy.spin is your clean-up; an error there hides the end."),
         msg("Fix the line shown, or leave it away."), links.RCLPY),
    _run("shutdown_twice", "shutdown", msg("rclpy.shutdown() is called after ROS has shut down"),
         msg("Ctrl+C has already shut ROS down when your rclpy.shutdown() is called; on humble and "
             "jazzy that ends with a traceback. The node itself is right."),
         msg("Write rclpy.try_shutdown() instead of rclpy.shutdown()."), links.RCLPY,
         seen=r"rcl_shutdown already called"),
    _run("interrupt_traceback", "shutdown", msg("Ctrl+C ends the node with a traceback"),
         msg("This is normal: Ctrl+C becomes KeyboardInterrupt, and nobody catches it."),
         msg("Nothing has to be fixed. try: … except KeyboardInterrupt: around rclpy.spin spares "
             "the traceback."), links.PYTHON_ERRORS,
         seen=r"^KeyboardInterrupt$"),
)  # fmt: skip
