"""The catalogue: timer, callback, counter, text, logger and spin, as the node's source has them."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.kind import Family

HANDS = msg(
    "create_timer takes the period in seconds and the callback itself, and calls it later. With "
    "brackets behind its name the callback runs now, and its result (None) is handed over."
)
TIMER = msg("Write create_timer({period}, self.{callback})")
CALLS = msg("The timer calls your callback with nothing but self.")
COUNTER = msg(
    "An attribute (self.…) stays from one callback to the next; a name without self. is gone when "
    "the function ends."
)
CLOSE = msg("Write {close} instead of {name}.")
NAMED = ("method_misspelt", "attribute_not_set", "attribute_unknown", "name_unknown")
BLOCKS = msg("rclpy.spin(node) waits and calls the callbacks when due, until Ctrl+C.")

_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node("timer_at_class_level", "timer", msg("The timer is made outside of __init__"),
          msg("Lines indented to the class run when the class is defined; there is no self yet."),
          msg("Indent the line as part of __init__."), links.PYTHON_CLASSES,
          seen=r"NameError: name 'self' is not defined"),
    _node("callback_called", "timer", msg("create_timer is given a call, not the callback"), HANDS,
          msg("Take the () away behind the callback's name: create_timer({period}, "
              "self.{callback})"),
          seen=r"TypeError: 'NoneType' object is not callable"
               r"|UnboundLocalError: .{0,60}'arg_name'"),
    _node("callback_in_init", "timer", msg("The callback is indented into __init__"),
          msg("A function inside __init__ is not a method of the class: self has none of its "
              "name."),
          msg("Indent def {callback}(self): as far as def __init__."), links.PYTHON_CLASSES),
    _node("callback_misspelt", "timer", msg("The callback's name is misspelt"),
          msg("create_timer is given a method by its name, letter by letter."), TIMER),
    _node("callback_without_self_dot", "timer", msg("self. is missing in front of the callback"),
          msg("A method is reached through its object: self.name."), TIMER, links.PYTHON_CLASSES),
    _node("timer_arguments_swapped", "timer", msg("The arguments of create_timer are swapped"),
          msg("create_timer takes the period first, then the callback."), TIMER,
          seen=r"float\(\) argument must be a string or a real number, not '(?:method|function)'"),
    _node("period_text", "timer", msg("The period is a text"),
          msg("The period is a number of seconds: no quotes, no unit."), TIMER,
          seen=r"ValueError: could not convert string to float: (?P<text>'[^'\n]{0,60}')"),
    _node("timer_argument_missing", "timer", msg("create_timer lacks an argument"),
          msg("create_timer takes the period first, then the callback."), TIMER,
          seen=r"create_timer\(\) missing \d{1,3} required positional argument"),
    _node("method_misspelt", "class", msg("A method or attribute of the node is misspelt"),
          msg("Python finds what an object has only by its exact name."),
          msg("Write {close} instead of {name}."), links.RCLPY),
    _node("attribute_not_set", "counter", msg("An attribute is read that __init__ did not set"),
          msg("self.{name} exists only from the line on that gives it a value."),
          msg("Give it a value in __init__: self.{name} = {start}"), links.PYTHON_CLASSES),
    _node("counter_local", "counter", msg("The counter is used without self."), COUNTER,
          msg("Write self.{name} in the callback and in __init__."), links.PYTHON_CLASSES,
          seen=r"UnboundLocalError: .{0,60}'(?P<name>\w{1,120})'"),
    _node("name_unknown", "callback", msg("A name is used that is not defined"),
          msg("Python knows only names that the file imports or defines, and capitals count."),
          msg("Write the name as it is defined, or define it first."), links.PYTHON_ERRORS,
          seen=r"NameError: name '(?P<name>\w{1,120})' is not defined"),
    _node("callback_no_self", "callback", msg("The callback has no parameter self"), CALLS,
          msg("Write: def {callback}(self):"), links.PYTHON_CLASSES,
          seen=r"(?<!__init__\(\) )takes 0 positional arguments but 1 was given|ValueError: invalid method signature"),
    _node("callback_parameter", "callback", msg("The callback asks for more than self"), CALLS,
          msg("Write: def {callback}(self): (a message is given to a subscription's callback "
              "only)."),
          seen=r"TypeError: [\w.]{0,200}\(\) missing \d{1,3} required positional arguments?: "
               r"'(?P<name>\w{1,120})'"),
    _node("sleeps_in_callback", "callback", msg("The callback sleeps for longer than the period"),
          msg("While a callback sleeps, nothing else of the node runs: the timer has to wait, and "
              "each line comes late."),
          msg("Take the sleep out of {callback}: the timer alone makes the pauses."),
          links.EXECUTORS),
    _node("str_plus_int", "text", msg("A text and a number are added"),
          msg("Python joins texts with + only to other texts."),
          msg("Make a text of the number: str({name}), or use an f-string."),
          links.PYTHON_STRINGS,
          seen=r'TypeError: can only concatenate str \(not "(?P<type>\w{1,40})"\) to str'
               r"|TypeError: unsupported operand type\(s\) for \+: '(?:int|float)' and 'str'"),
    _node("step_is_text", "counter", msg("A text is added to the counter"),
          msg("A number in quotes is a text, and Python adds no text to a number."),
          msg("Write {name} += {step}, without quotes."), links.PYTHON_CLASSES,
          seen=r"TypeError: unsupported operand type\(s\) for \+=: '(?:int|float)' and 'str'"),
    _node("not_callable", "callback", msg("A number or a text is called like a function"),
          msg("Brackets behind a name call it, and only functions can be called."),
          msg("Take the brackets away on that line."), links.PYTHON_ERRORS,
          seen=r"TypeError: '(?P<type>int|float|str)' object is not callable"),
    _node("argument_missing", "callback", msg("A call gives too few arguments"),
          msg("A parameter that has no default needs a value at each call."),
          msg("Give a value for {name} where {function} is called, or take the parameter out of "
              "your own function."), links.PYTHON_ERRORS),
    _node("callback_never_ends", "callback", msg("The callback does not come to its end"),
          msg("The timer can call a callback again only when it has returned."),
          msg("Take {name} out of {callback}: the timer does the repeating."), links.EXECUTORS),
    _node("logger_not_called", "logger", msg("The brackets are missing behind get_logger"),
          msg("get_logger is a method: only its call gives the logger."),
          msg("Write self.get_logger().info(…)."), links.LOGGING,
          seen=r"AttributeError: '(?:function|method)' object has no attribute "
               r"'(?:info|debug|warn|warning|error|fatal)'"),
    _node("logger_arguments", "logger", msg("The logger is given more than one text"),
          msg("info() takes one text. print() takes several with commas, the logger does not."),
          msg("Make one text of it: {sum}, or an f-string."),
          links.LOGGING,
          seen=r"\.info\(\) takes 2 positional arguments but \d{1,3} were given"),
    _node("attribute_unknown", "callback", msg("An object has no attribute of that name"),
          msg("Python finds what an object has only by its exact name."),
          msg("Compare the name on that line with the documentation or with your own class."),
          links.RCLPY,
          seen=r"AttributeError: (?:'\w{1,120}' object|type object '\w{1,120}'|module "
               r"'[\w.]{1,200}') has no attribute '(?P<name>\w{1,120})'"),
    _node("spin_of_class", "spin", msg("rclpy.spin is given the class and not the node"),
          msg("spin needs the node that was made, not the class that it is made from."),
          msg("Write node = {name}() and then rclpy.spin(node)."), links.EXECUTORS,
          seen=r"TypeError: 'property' object is not iterable"),
    _node("spin_missing", "spin", msg("rclpy.spin is not called"), BLOCKS,
          msg("Call rclpy.spin(node) in {function}, after making the node."), links.EXECUTORS),
    _node("spin_not_called", "spin", msg("The brackets are missing behind rclpy.spin"),
          msg("A function's name alone does nothing; only its call does."),
          msg("Write rclpy.spin({node})."), links.EXECUTORS),
    _node("shutdown_not_called", "shutdown", msg("The brackets are missing behind rclpy.shutdown"),
          msg("A function's name alone does nothing; only its call does."),
          msg("Write rclpy.try_shutdown()."), links.RCLPY),
    _node("spin_once", "spin", msg("spin_once is called instead of spin"),
          msg("rclpy.spin_once handles one callback and returns; then {function} ends."),
          msg("Write rclpy.spin({node})."), links.EXECUTORS),
    _node("exits", "spin", msg("The node ends itself"),
          msg("{name} ends the program; a node lives until Ctrl+C."),
          msg("Take {name} out."), links.EXECUTORS),
    _node("timer_missing", "timer", msg("No timer is made"),
          msg("Only a timer calls the callback again and again."),
          msg("Write in __init__: self.create_timer({period}, self.{callback})")),
    _node("timer_in_callback", "timer", msg("The timer is made in its own callback"),
          msg("The callback is called by the timer: as long as there is no timer, nobody calls "
              "it."),
          msg("Move create_timer to __init__.")),
    _node("timer_cancelled", "timer", msg("The timer is cancelled"),
          msg("cancel() stops a timer: its callback is not called any more."),
          msg("Take the .cancel() away.")),
    _node("timer_other_callback", "timer", msg("The timer calls another method"),
          msg("The timer calls the method that it is given, and no other."), TIMER),
    _node("period_milliseconds", "timer", msg("The period is written in milliseconds"),
          msg("create_timer takes seconds: {written} is {written} seconds."), TIMER),
    _node("log_missing", "logger", msg("The callback logs nothing"),
          msg("The callback is called, but only what it hands to the logger is seen."),
          msg("Write self.get_logger().info(…) in the callback."), links.LOGGING),
    _node("debug_level", "logger", msg("The line is logged as DEBUG"),
          msg("Records of level DEBUG are neither shown nor published unless somebody asks for "
              "them."),
          msg("Write self.get_logger().info(…) instead of .debug(…)."), links.LOGGING),
    _node("f_prefix", "text", msg("The f in front of the text is missing"),
          msg("Only in a text that begins with f does Python replace {{…}} by a value."),
          msg("Write an f in front of the first quote: {f_string}"),
          links.PYTHON_STRINGS,
          seen=r"^\[[A-Z]{4,5}\] \[\d{1,12}\.\d{9}\] \[[^\]\n]{1,100}\]: [^\n{]{0,200}\{self\.\w{1,60}\}"),
    _node("text_without_number", "text", msg("The counter is not in the text"),
          msg("The number in the line is the counter's value at that moment."),
          msg("Add it to the text: {sum}"), links.PYTHON_STRINGS),
    _node("number_format", "text", msg("The number is written in another form"),
          msg("The counter is a whole number, and str() writes it without point and zeros."),
          msg("Begin with {counter} = {start} (not {start}.0), and log str({counter}).")),
    _node("plus_reversed", "counter", msg("=+ is written for +="),
          msg("x =+ 1 gives x the value +1; x += 1 adds one to it."),
          msg("Write {name} += {step}"), links.PYTHON_CLASSES),
    _node("counter_not_increased", "counter", msg("Nothing is added to the counter"),
          msg("The callback logs the counter; only += makes the next line another one."),
          msg("Add to the callback, after the log line: {name} += {step}")),
    _node("counter_reset", "counter", msg("The callback sets the counter back"),
          msg("What is set in the callback is set anew at each call. A start belongs into "
              "__init__."),
          msg("Move {name} = {value} to __init__.")),
    _node("adds_before_log", "counter", msg("The callback adds before it logs"),
          msg("The first line is to show the counter's first value."),
          msg("Log first, and put {name} += {step} after it.")),
    _node("starts_elsewhere", "counter", msg("The counter begins at another number"),
          msg("The first line shows the value that __init__ gives to the counter."),
          msg("Write in __init__: {name} = {start}")),
    _node("adds_twice", "counter", msg("The counter is increased more than once in the callback"),
          msg("Each += counts."), msg("Keep one {name} += {step}.")),
    _node("other_step", "counter", msg("Another number is added to the counter"),
          msg("The number behind += is what each line goes up by."), msg("Write {name} += {step}")),
    _node("two_timers", "timer", msg("Two timers call the callback"),
          msg("Every timer calls its callback by itself: two timers make two lines at a time."),
          msg("Keep one create_timer.")),
    _node("logs_twice", "logger", msg("The callback logs more than once"),
          msg("Each call of the logger is a line of its own."),
          msg("Keep one self.get_logger().info(…) in the callback."), links.LOGGING),
    _node("print_used", "logger", msg("print() is used and not the logger"),
          msg("print() writes on this terminal only: no level, no time, no node's name, and no "
              "other program sees it on /rosout."),
          msg("Write self.get_logger().info(…) instead of print(…)."), links.LOGGING),
    _node("called_by_hand", "timer", msg("__init__ calls the callback itself"),
          msg("The timer makes the first call after one period; a call of yours comes too early."),
          msg("Take the line self.{callback}() out of __init__.")),
)  # fmt: skip
