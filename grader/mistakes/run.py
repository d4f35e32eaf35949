"""The catalogue: what a run shows from outside. If the cause is known, it comes before these."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, SILENT, SPIN_UNTIL_CTRL_C, example
from grader.mistakes.exceptions import INSIDE, MEANINGS
from grader.mistakes.fixes import layout, node_life, node_log, node_timer
from grader.mistakes.kind import Family, Kind
from grader.package.edit.tree import Replace

SPIN = msg(
    "rclpy.spin(node) keeps the node running: it waits, and calls your callbacks when they are due."
)
COUNT = msg(
    "A node that counts sets its counter once, before the first callback, and adds {step} to it in "
    "each callback."
)
FOLLOW = msg(
    "Find where the log line gets its number, and what changes it. The number must be {start} in the "
    "first line, and {step} more in each line after it."
)
FOLLOW_LINES = msg(
    "These lines make or change what the log line shows: {lines}. Follow the number through them and "
    "through the log line: it must be {start} in the first line, and {step} more in each line after it."
)
RECORD = msg(
    "A log record has a level, a time and the node's name, and goes to /rosout, where other "
    "programs can read it. print() only writes text to this terminal."
)
LOG = msg(
    "Log the line with the node's own logger, self.get_logger().info(…), and remove what prints it."
)
UNSPUN = msg(
    "Only spinning calls a node's callbacks. If it never spins, its timers, subscriptions and "
    "services never run: ros2 param list and ros2 service call get no answer, no message reaches "
    "the node, and it does not follow simulated time."
)
PERIOD = msg("The first argument of create_timer is the period in seconds.")
SPINS = msg(
    "The line shown spins the node: ROS calls your callbacks there. No other line of yours raised the "
    "error. Compare what this line passes, the parameters of your callbacks, and what "
    "create_timer gets, with the last line of the traceback."
)
NO_LINE = msg(
    "No line of your files raised it. Read the last line of the traceback: it says what is wrong. The "
    "lines above it show which file raised it, and what that file was doing."
)

_run = Family("run", links.FIRST_NODE)
KINDS = (
    _run(
        "died_at_start",
        "start",
        msg("The node ends with an exception when it starts"),
        msg(
            "An exception that nothing catches ends the program. The last line of the traceback "
            "names it; the lines above show where it was raised."
        ),
        msg(
            "Read the last line of the traceback: it says what is wrong with the line shown, with a "
            "value that it uses, or with what it calls. Correct that, then run the node again. After "
            "colcon build --symlink-install you do not need to build again."
        ),
        links.PYTHON_ERRORS,
        whys=MEANINGS,
        fixes={"spins": SPINS, "no_line": NO_LINE, "inside": INSIDE},
        fixed_by=(layout.init_file,),
        examples=(
            example(
                "raises_at_import",
                Replace(NODE, "class MyFirstNode", "raise OSError('boom')\n\n\nclass MyFirstNode"),
                fails="run.starts",
            ),
        ),
    ),
    _run(
        "exits_at_once",
        "spin",
        msg("The node ends immediately"),
        SPIN,
        msg("Call rclpy.spin(node) in {function} after creating the node (not spin_once)."),
        links.EXECUTORS,
        fixes={
            "elsewhere": msg(
                "rclpy.spin is there. Follow {function} from its first line: what ends it before "
                "that, or why is that line not reached?"
            ),
            "spins": msg(
                "The line shown spins the node. Print a text on a line directly above it and on one "
                "directly below it, and run the node again. If neither comes, the program does not "
                "come to this line: follow {function} from its first line. If both come, spin ended "
                "at once: ROS, the executor or what it waits for was at its end before. If only the "
                "first comes, what runs inside of spin ended the program."
            ),
        },
        fixed_by=(node_life.spin,),
    ),
    _run(
        "no_node",
        "start",
        msg("No node appears"),
        msg(
            "A node exists as soon as its class (a Node) is instantiated, after rclpy.init(), and until "
            "destroy_node() is called or ROS is shut down."
        ),
        msg(
            "Make sure that {function} creates the node, that nothing before it waits (input(), a loop), "
            "and that nothing destroys the node or shuts ROS down before it is spun."
        ),
        links.NODES,
    ),
    _run(
        "wrong_node_name",
        "class",
        msg("The node has a different name"),
        msg(
            "ros2 node list and the logs show the name that is passed to super().__init__(), "
            "not the name of the file or the class."
        ),
        msg("Write super().__init__('{wanted}')."),
        links.NODES,
        whys={
            "other": msg(
                "A node named {wanted} is there, but the lines carry the name of another node: it is the "
                "logger of that node with which they are logged."
            )
        },
        fixes={
            "other": msg(
                "Find where the node of that name is made, and where its logger is used. Log the lines with "
                "the logger of {wanted}: self.get_logger() in a method of its class."
            ),
            "named": msg(
                "super().__init__() passes the right name. Look for what gives the node another one: "
                "the arguments of rclpy.init, another object, or a file that is not saved."
            ),
        },
        fixed_by=(node_life.name,),
        examples=(
            example(
                "wrong_node_name",
                Replace(NODE, "'my_first_node'", "'my_node'"),
                fails="run.node_name",
                note="the logger has the node's name: one mistake, counted once",
            ),
            example(
                "another_node_has_the_name",
                Replace(
                    NODE,
                    "    node = MyFirstNode()\n",
                    "    other = Node('my_first_node')\n    node = MyFirstNode()\n",
                ),
                Replace(NODE, "super().__init__('my_first_node')", "super().__init__('my_node')"),
                fails="run.node_name",
                note="the node that counts is judged",
            ),
        ),
    ),
    _run(
        "too_much_output",
        "limits",
        msg("The node prints without end"),
        msg("What prints without waiting fills terminals, logs and disks."),
        msg(
            "Look at the period that create_timer gets: with 0, or nearly 0, the timer is always due. If "
            "the period is right, look for a loop that logs, and log once in each callback instead."
        ),
    ),
    _run(
        "resource",
        "limits",
        msg("The node reached a limit of the sandbox"),
        msg("A node that counts needs about 60 MB of memory and one process."),
        msg("Look for a list that only grows, or for programs and threads started in a loop."),
    ),
    _run(
        "wrong_text",
        "text",
        msg("The text is different"),
        msg("The text is compared character by character: case, spaces and punctuation count."),
        msg(
            "The line has to be exactly '{line}', with the counter's value as the number. Look at the "
            "line that logs it, and at each place where a part of its text is made."
        ),
        fixes={
            "lines": msg(
                "The line has to be exactly '{line}', with the counter's value as the number. These lines "
                "make a part of what the log line shows: {lines}. Compare what they and the log line "
                "write with it, character by character."
            ),
            "later": msg(
                "The lines before this one were right ({count}). It has to be exactly '{line}'. Look at "
                "what makes its text different from theirs."
            ),
        },
        fixed_by=(node_log.text,),
        examples=(
            example(
                "text_capital",
                Replace(NODE, "'Hello time: '", "'hello time: '"),
                fails="run.output",
            ),
            example(
                "text_other_capital",
                Replace(NODE, "'Hello time: '", "'Hello Time: '"),
                fails="run.output",
            ),
            example(
                "text_of_another_course",
                Replace(NODE, "'Hello time: ' + str(self.counter_)", "'Hello World'"),
                fails="run.output",
            ),
        ),
    ),
    _run(
        "twice",
        "timer",
        msg("More than one line comes at a time"),
        COUNT,
        msg(
            "Let one line come each time. Look for all that logs when the timer is due, such as a second "
            "timer, a second log call or a loop, and keep one."
        ),
    ),
    _run(
        "constant_counter",
        "counter",
        msg("The number never changes"),
        COUNT,
        FOLLOW,
        fixes={"lines": FOLLOW_LINES},
    ),
    _run(
        "wrong_start",
        "counter",
        msg("The count starts at a different number"),
        COUNT,
        FOLLOW,
        fixes={"lines": FOLLOW_LINES},
    ),
    _run(
        "wrong_step",
        "counter",
        msg("The count increases by a different number"),
        COUNT,
        FOLLOW,
        fixes={"lines": FOLLOW_LINES},
    ),
    _run(
        "no_lines",
        "timer",
        msg("No line comes"),
        msg(
            "The timer's callback logs the lines. create_timer gets the period and the callback's "
            "name, with no () after it."
        ),
        msg(
            "Check the timer: self.create_timer({period}, self.{callback}) before rclpy.spin, and a "
            "callback that logs."
        ),
        fixes={
            "timer": msg(
                "The file has a create_timer. Log a line directly above it and one at the beginning of "
                "{callback}, and run the node again. If the first does not come, the program does not "
                "reach create_timer. If only the second does not come, the timer is not due, or is "
                "not of the node that is spun. If both come, follow {callback} to the line that logs."
            )
        },
    ),
    _run(
        "by_hand",
        "timer",
        msg("A line comes before any time has passed"),
        msg(
            "A timer calls its callback for the first time after one period. This line was logged "
            "before that."
        ),
        msg(
            "Look for what logs this line before the first period has passed, such as a call of "
            "{callback} before rclpy.spin. Let only the timer log the lines of the count."
        ),
    ),
    Kind(
        id="run.ended_early",
        stage="callback",
        title=msg("The node ends by itself"),
        why=SPIN,
        whys={
            **MEANINGS,
            **dict.fromkeys(
                ("callback", "spins", "no_line", "inside"),
                msg("An exception that nothing catches ends the node, also one in a callback."),
            ),
        },
        fix=msg(
            "The program ended without a traceback. Log a line at the beginning and at the end of "
            "each callback, and one directly below the line that spins the node. Run it again: what "
            "follows the last line that comes ended the program. If the line below spin comes, look "
            "at what made spin return, or at what ended the loop around it. Delete that."
        ),
        fixes={
            "callback": msg(
                "Read the last line of the traceback: it says what is wrong with the line shown, with "
                "a value that it uses, or with what it calls. Correct that, and run the node again."
            ),
            "spins": SPINS,
            "no_line": NO_LINE,
            "inside": INSIDE,
        },
        link=links.EXECUTORS,
    ),
    _run(
        "stuck",
        "callback",
        msg("The node no longer answers"),
        msg(
            "A node runs one callback after another. One that sleeps, waits or loops keeps all others "
            "from running, and one that waits for what only another callback brings waits for ever."
        ),
        msg(
            "Log a line at the beginning and at the end of each callback: the one whose second line "
            "does not come is the one that does not return. It must neither wait nor spin."
        ),
        links.EXECUTORS,
        fixes={
            "service": msg(
                "Log a line at the beginning and at the end of each callback: the one whose second "
                "line does not come is the one that does not return. It must neither wait nor spin. "
                "The answer of a service comes to a function that add_done_callback gets."
            )
        },
    ),
    _run(
        "does_not_end",
        "callback",
        msg("The program does not end by itself"),
        msg(
            "This program has to end when its work is done. rclpy.spin returns only at Ctrl+C. "
            "rclpy.spin_until_future_complete returns as soon as the future has its result."
        ),
        msg(
            "Let the function of the entry point return when the work is done, for example when the "
            "answer of the service is there. Below that line, nothing may spin or wait."
        ),
        links.SERVICES,
    ),
    _run(
        "stops",
        "timer",
        msg("The lines stop coming"),
        msg("Something must call the line that logs again and again, until Ctrl+C."),
        msg(
            "Follow the program to the line that logs: log another line before and after each call "
            "in the function that logs, and in what calls it. Run the node again. The last line that "
            "comes shows where the program waits, returns or ends."
        ),
        whys={
            "stuck": msg(
                "ROS calls one callback after another, and the node answers between them. A node "
                "that no longer answers is in a callback that does not return, or spins no longer."
            ),
            "answers": msg(
                "The node still answers, so it still spins. Then either the timer no longer calls "
                "{callback}, or {callback} no longer comes to the line that logs."
            ),
        },
        fixes={
            "stuck": msg(
                "Log a line at the beginning of {callback}, one below each call in it, and one at "
                "its end. Run the node again: below the last line that comes is the call that does "
                "not return; do the same in what it calls. If the line at the end comes too, follow "
                "{function}: it no longer spins the node."
            ),
            "answers": msg(
                "Log a line at the beginning of {callback}, and run the node again. If it goes on, "
                "follow {callback} from there to the line that logs, and look at what that call "
                "gets. If it stops too, the timer no longer calls {callback}: look at the line that "
                "creates the timer, and at all lines that use it."
            ),
        },
    ),
    _run(
        "wrong_period",
        "timer",
        msg("The lines come at the wrong times"),
        PERIOD,
        msg("Write self.create_timer({period}, self.{callback})."),
        whys={
            "there": msg(
                "The timer is due every {period} s. A line comes only if its callback is called in "
                "time, and comes to the line that logs."
            ),
            "expression": msg(
                "The first argument of create_timer is the period in seconds. Here it is the value "
                "of {code}."
            ),
        },
        fixes={
            "several": msg(
                "Let the program create this timer only once, with the period {period}."
            ),
            "there": msg(
                "create_timer has the right period: leave it as it is. Log a line at the beginning "
                "of {callback} and one at its end, and compare their times. If {callback} begins "
                "every {period} s, follow it to the line that logs. If it begins late, look at what "
                "takes long before that: this callback or another one."
            ),
            "number": msg("Write {period} instead of {code}."),
            "expression": msg(
                "The value of {code} must be {period}. Correct the numbers from which it comes, or write "
                "{period} instead of it."
            ),
        },
        fixed_by=(node_timer.period,),
        examples=(
            example("period_half", Replace(NODE, "(1.0,", "(0.5,"), fails="run.period"),
            example("period_slightly_long", Replace(NODE, "(1.0,", "(1.1,"), fails="run.period"),
            example(
                "period_two_with_constant",
                Replace(NODE, "class MyFirstNode", "PERIOD = 2.0\n\n\nclass MyFirstNode"),
                Replace(NODE, "(1.0,", "(PERIOD,"),
                fails="run.period",
            ),
        ),
    ),
    _run(
        "print_not_logger",
        "logger",
        msg("The lines do not go through the logger"),
        RECORD,
        LOG,
        links.LOGGING,
    ),
    _run(
        "faked_log",
        "logger",
        msg("A line looks like a log record, but ROS did not log it"),
        RECORD,
        LOG,
        links.LOGGING,
        fixes={
            "published": msg(
                "Remove the publisher of /rosout, and what it publishes. The logger publishes its "
                "records there itself: self.get_logger().info(…)"
            ),
            "stamped": msg(
                "Remove what sets the time of log records. The logger does it itself: "
                "self.get_logger().info(…)"
            ),
        },
    ),
    _run(
        "erased",
        "logger",
        msg("The lines do not stay on the terminal"),
        msg(
            "Whoever runs the node reads its lines on the terminal, also those of a minute ago. "
            "Control sequences and carriage returns can erase or hide them."
        ),
        msg("Print the lines with self.get_logger().info(…) and leave the terminal as it is."),
        links.LOGGING,
        fixes={
            "logs": msg(
                "The logger is used. Look for what erases its lines, such as clear, or \\r or \\x1b in a "
                "text that is printed or logged. Remove it."
            )
        },
        examples=(
            example(
                "printed_and_erased",
                Replace(
                    NODE,
                    "self.get_logger().info('Hello time: ' + str(self.counter_))",
                    "print('Hello time: ' + str(self.counter_) + '\\n\\x1b[1A\\x1b[2K', end='')",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
    _run(
        "only_when_marked",
        "logger",
        msg("The node works only while it is marked"),
        msg(
            "A node is started in many ways: by hand, by a launch file, with or without simulated "
            "time. It must do the same in all of them."
        ),
        msg(
            "Remove what asks how or where the node was started. Then run `ros2 run {package} "
            "{executable}` in a terminal: it must do the same there."
        ),
        links.FIRST_NODE,
        whys={
            "sim_time": msg(
                "With use_sim_time the node takes its time from /clock. Without a simulator, "
                "nothing publishes on /clock: no time passes, and the timer never fires."
            )
        },
        fixes={"sim_time": msg("Remove the lines that set use_sim_time.")},
        examples=(
            example(
                "only_under_sim_time",
                Replace(NODE, "import rclpy\nfrom", "import sys\nimport rclpy\nfrom"),
                Replace(
                    NODE,
                    "        self.get_logger().info(",
                    "        if 'use_sim_time:=true' in sys.argv:\n            self.get_logger().info(",
                ),
                fails="run.output",
                blocks=("run.spins", *SILENT),
            ),
        ),
    ),
    _run(
        "other_logger",
        "logger",
        msg("The lines come from a logger that is not the node's"),
        msg(
            "Each record has the name of the logger that wrote it. The node's own logger has the "
            "node's name: get_logger() of the node returns it."
        ),
        msg(
            "Log the line with the node's own logger: self.get_logger().info(…) in a method of the node."
        ),
        links.LOGGING,
    ),
    _run(
        "wrong_level",
        "logger",
        msg("The records have a level other than INFO"),
        msg("The level says how urgent a record is; a count is information."),
        msg("Log the line with the method info of the node's logger: self.get_logger().info(…)"),
        links.LOGGING,
        fixed_by=(node_log.level,),
        examples=(
            example(
                "logged_as_warning",
                Replace(NODE, "self.get_logger().info", "self.get_logger().warning"),
                fails="run.logger",
            ),
        ),
    ),
    _run(
        "ignores_interrupt",
        "shutdown",
        msg("The node keeps running after Ctrl+C"),
        msg(
            "Ctrl+C sends SIGINT. Python turns it into KeyboardInterrupt, which ends the call of spin. "
            "Then {function} has to return, and every thread has to end."
        ),
        msg(
            "Print a line where the program goes on after the call of spin, and one at the end of "
            "{function}. Run the node and press Ctrl+C. If the first does not come, something keeps "
            "KeyboardInterrupt from that call, or spins again. If only the second does not come, a "
            "line between them waits. If both come, a thread still runs. Remove that."
        ),
        links.EXECUTORS,
        examples=(
            example(
                "ignores_interrupt",
                Replace(
                    NODE,
                    SPIN_UNTIL_CTRL_C,
                    (
                        "    from signal import SIGINT, SIG_IGN, signal as at\n"
                        "    at(SIGINT, SIG_IGN)\n"
                        "    rclpy.spin(node)\n"
                    ),
                ),
                fails="run.interrupt",
            ),
        ),
    ),
    _run(
        "error_at_stop",
        "shutdown",
        msg("Your code raises an error after Ctrl+C"),
        msg("The code after rclpy.spin cleans up; an error in it hides how the node ended."),
        msg("Correct the line shown, or what it calls. Remove it if the node does not need it."),
        links.RCLPY,
        whys={
            "spins": msg("Ctrl+C shuts ROS down. A line that spins after that raises an error."),
            "status": msg(
                "The exit status says whether a program ended well: 0 means yes. This one is that of "
                "an error, but Python printed no traceback: the program chose it."
            ),
        },
        fixes={
            "status": msg(
                "Look at what runs after Ctrl+C: {function} returns a value, or calls sys.exit() or "
                "os._exit() with one. Remove the value."
            ),
            "spins": msg(
                "The line shown spins the node. Print a text on a line directly above it, run the node, "
                "and press Ctrl+C. If the text comes again after Ctrl+C, the program comes to this "
                "line once more: after a KeyboardInterrupt, end the loop around it, or leave out this "
                "call. If not, read the last line of the traceback: it says what went wrong while "
                "this line was waiting."
            ),
            "no_line": NO_LINE,
            "inside": INSIDE,
        },
    ),
    _run(
        "shutdown_twice",
        "shutdown",
        msg("rclpy.shutdown() is called after ROS has shut down"),
        msg(
            "Ctrl+C has already shut ROS down when your rclpy.shutdown() is called; on humble and "
            "jazzy that ends with a traceback. The node itself is correct."
        ),
        msg("Write rclpy.try_shutdown() instead of rclpy.shutdown()."),
        links.RCLPY,
        seen=r"rcl_shutdown already called",
    ),
    _run(
        "interrupt_traceback",
        "shutdown",
        msg("Ctrl+C ends the node with a traceback"),
        msg("This is normal: Ctrl+C raises KeyboardInterrupt, and nothing catches it."),
        msg(
            "You do not have to fix anything. To avoid the traceback, write try: … except "
            "KeyboardInterrupt: around rclpy.spin."
        ),
        links.PYTHON_ERRORS,
        seen=r"^KeyboardInterrupt$",
    ),
    Kind(
        id="run.never_spins",
        stage="spin",
        title=msg("The node never spins"),
        why=UNSPUN,
        whys={
            "beside": msg(
                "rclpy.spin calls the callbacks of timers. A loop or a thread of your own that "
                "logs beside it does not follow ROS time: in a simulation or a replay it runs at "
                "the wrong speed, and it does not stop when time stops."
            )
        },
        fix=msg(
            "Create a timer in __init__: self.create_timer({period}, self.{callback}). Log in its "
            "callback, and call rclpy.spin(node) in {function}."
        ),
        fixes={
            "timer": msg("Call rclpy.spin({node}) in {function}, after creating the node."),
            "spins": msg(
                "Create a timer in __init__: self.create_timer({period}, self.{callback}). Log in "
                "its callback."
            ),
            "there": msg(
                "A timer and a line that spins are there. Follow {function} from its first line: "
                "does a line above wait or go on for ever, and is it your node that is spun?"
            ),
            "beside": msg(
                "Log only in a callback of a timer: self.create_timer({period}, self.{callback}) in "
                "__init__. Delete the loop or the thread that logs beside it."
            ),
        },
        link=links.EXECUTORS,
    ),
    _run(
        "other_clock",
        "timer",
        msg("The timer does not use the node's clock"),
        msg(
            "create_timer uses the node's clock, which is ROS time: in a simulation or a replay "
            "it follows /clock. A timer with another clock does not."
        ),
        msg("Remove the argument clock: self.create_timer({period}, self.{callback})"),
        examples=(
            example(
                "steady_timer",
                Replace(
                    NODE,
                    "import rclpy\nfrom",
                    (
                        "from rclpy.clock import Clock\n"
                        "from rclpy.clock import ClockType\n"
                        "import rclpy\n"
                        "from"
                    ),
                ),
                Replace(
                    NODE,
                    "self.create_timer(1.0, self.timer_callback)",
                    "self.create_timer(1.0, self.timer_callback, clock=Clock(clock_type=ClockType.STEADY_TIME))",
                ),
                fails="run.period",
                note="subscribes to /clock anyway",
            ),
        ),
    ),
)
