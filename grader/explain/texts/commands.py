"""The arguments of the ros2 command, and what it answers about parameters."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.explain.terminal_text import Case, TerminalText
from grader.mistakes import links

KINDS = (
    TerminalText(
        id="lab.run_arguments", link=links.NODES,
        title=msg("ros2 run needs the package and the executable"),
        why=msg("ros2 run starts an executable of a package: the package comes first. Only one name was "
                "given."),
        fix=msg("Run ros2 run <package> <executable>. ros2 pkg executables lists both names."),
        seen=r"ros2 run: error: the following arguments are required: [^\n]{1,80}",
    ),
    TerminalText(
        id="lab.value_unquoted", link=links.TOPICS,
        title=msg("The value is not in quotes"),
        why=msg("The shell cuts a command at spaces, so ros2 got the value in pieces."),
        fix=msg("Put the whole value in quotes: ros2 topic pub /turtle1/cmd_vel geometry_msgs/msg/Twist "
                "\"{{linear: {{x: 2.0}}, angular: {{z: 1.8}}}}\""),
        seen=r"ros2[^\n]{0,40}: error: (?:unrecognized arguments|argument [^\n]{1,60}): [^\n]{0,120}[{}][^\n]{0,120}",
    ),
    TerminalText(
        id="lab.value_yaml", link=links.TOPICS,
        title=msg("The value is not written as YAML reads it"),
        why=msg("The value is YAML: names and values with a colon and a space between them, in braces, and "
                "the names are those of the message."),
        fix=msg("Write a space after every colon, as in \"{{linear: {{x: 2.0}}}}\", not x:2.0, and put all "
                "of it in quotes. ros2 interface show <type> lists the fields."),
        cases=(
            Case(r"Failed to populate field: '\w{1,100}' object has no attribute '(?P<field>\w{1,80})'",
                 why=msg("The type has no field {field}."),
                 fix=msg("Run ros2 interface show <type>: it lists the fields. A field of a field is written "
                         "as in \"{{linear: {{x: 2.0}}}}\".")),
            Case(r"Failed to populate field: (?:could not convert|invalid literal|[^\n]{0,80}must be)",
                 why=msg("A field gets a value of another type."),
                 fix=msg("Run ros2 interface show <type>: it lists the types. A number of float64 is 2.0, a "
                         "text is in '…' inside the quotes.")),
        ),
        seen=r"Failed to populate field: [^\n]{1,200}|passed value needs to be a dictionary in YAML format"
             r"|ros2[\s\S]{0,3000}?yaml\.(?:parser|scanner)\.\w{1,20}Error[^\n]{0,120}"
             r"|value is not valid YAML[^\n]{0,80}",
    ),
    TerminalText(
        id="lab.ros2_word", link=links.NODES,
        title=msg("ros2 does not know this word"),
        why=msg("After ros2 comes what it is about, in the singular (node, topic, service, param, …), and "
                "then what to do. {word} is none of them here."),
        fix=msg("Run ros2 --help for the first word, ros2 topic --help for the second one."),
        seen=r"ros2[^\n]{0,30}: error: (?:argument [^\n]{1,100}: )?invalid choice: '(?P<word>[^'\n]{1,60})'",
        unless=r"--build-type: invalid choice",
        values={"word": "topics"},
    ),
    TerminalText(
        id="lab.ros2_option", stage="terminal", link=links.NODES,
        title=msg("ros2 does not know this argument"),
        why=msg("{argument} is no argument of this command: it is misspelt, or belongs to another place. "
                "What is for the node comes after --ros-args, as in --ros-args -p speed:=2.0"),
        fix=msg("Run the command with --help at its end: it lists the arguments and their order."),
        seen=r"ros2[^\n]{0,40}: error: unrecognized arguments: (?P<argument>[^\n{}]{1,120})$"
             r"|(?P<argument_2>Found trailing ROS args|unknown ROS argument[^\n]{0,80})",
        values={"argument": "--onse"},
    ),
    TerminalText(
        id="lab.ros2_arguments", link=links.NODES,
        title=msg("The command needs more words"),
        why=msg("The command lacks: {argument}"),
        fix=msg("Run the command with --help at its end: it shows the words and their order."),
        seen=r"ros2 (?!run:)[^\n]{1,40}: error: the following arguments are required: (?P<argument>[^\n]{1,120})",
        values={"argument": "topic_name"},
    ),
    TerminalText(
        id="lab.bag",
        link=links.BAGS,
        title=msg("The bag cannot be read"),
        why=msg("ros2 bag plays a folder with a metadata.yaml and files .db3 or .mcap. A file .bag is of "
                "ROS 1. A file that is no database is often a pointer of git lfs, or its recording was cut."),
        fix=msg("Run ls -lh on the bag. A file .bag: pip install rosbags, then rosbags-convert --src <file> "
                "--dst <folder>. A file of some hundred bytes: git lfs pull in its repository. Without "
                "metadata.yaml: ros2 bag reindex <folder>. A damaged one has to be recorded again."),
        seen=r"No storage could be initialized|SQLite error \(\d{1,3}\): [^\n]{1,100}"
             r"|no plugin found that could open URI",
    ),
    TerminalText(
        id="lab.parameter_unknown", link=links.PARAMETERS,
        title=msg("The node has no parameter with that name"),
        why=msg("A node has only the parameters that it declares. ros2 param and -p set those and no "
                "others."),
        fix=msg("Run ros2 param list <node> and compare the name. If it should be there, write "
                "self.declare_parameter('name', 1.0) in the node's __init__, and start it again."),
        cases=(
            Case(r"parameter '(?P<name>\w{1,80})' cannot be set[\s\S]{0,3000}?^\s{0,4}(?P<close>(?:\w{1,80}\.){1,4}(?P=name))$"
                 r"|^\s{0,4}(?P<close_2>(?:\w{1,80}\.){1,4}(?P<name_2>\w{1,80}))$[\s\S]{0,3000}parameter '(?P=name_2)' cannot be set",
                 why=msg("The node has no parameter {name}. It has {close}: what is before a dot belongs to the "
                         "name."),
                 fix=msg("Use the whole name: ros2 param set <node> {close} <value>")),
        ),
        seen=r"Setting parameter failed: (?:Invalid access to undeclared|parameter '[^'\n]{1,80}' cannot be set "
             r"because it was not declared)[^\n]{0,80}|^Parameter not set\.?$",
    ),
    TerminalText(
        id="lab.transition", link=links.LIFECYCLE,
        title=msg("A lifecycle node cannot do that in its state"),
        why=msg("A lifecycle node goes one step after the other: unconfigured, configure, inactive, activate, "
                "active. Each state has its own steps; those that are possible now are listed. What the node "
                "makes in on_configure is not there before."),
        fix=msg("Run ros2 lifecycle get <node> to see its state. From the start: ros2 lifecycle set <node> "
                "configure, then ros2 lifecycle set <node> activate. If one of them fails, the node's own "
                "terminal says why."),
        seen=r"^Unknown transition requested, available ones are:"
             r"|[Tt]ransition(?: is)? not registered|No transition matching \d{1,4} found for current state \w{1,40}",
    ),
    TerminalText(
        id="lab.parameter_type", link=links.PARAMETERS,
        title=msg("The parameter has another type"),
        why=msg("A parameter keeps the type of its first value: 1 is an integer, 1.0 a double."),
        fix=msg("Give a value of that type: 2.0 for a double, 2 for an integer, true for a bool. If the "
                "first value should be of another type, write it so in declare_parameter, such as 1.0."),
        seen=r"Wrong parameter type, (?:parameter \{[^}\n]{1,80}\} is of type|expected)[^\n]{1,120}"
             r"|InvalidParameterTypeException: [^\n]{1,200}|[Pp]arameter [^\n]{1,80} has invalid type[^\n]{0,120}",
    ),
)  # fmt: skip
