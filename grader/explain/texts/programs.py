"""What a node's own traceback says about ROS, in packages that have no assignment."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.explain.terminal_text import Case, TerminalText
from grader.mistakes import links

KINDS = (
    TerminalText(
        id="lab.call_waits", link=links.CALLBACK_GROUPS,
        title=msg("call() of a client waits in a callback, and its answer cannot come"),
        why=msg("call() returns when the answer is there. The executor that would take the answer is still in "
                "the callback that waits for it. Ctrl+C only ended that."),
        fix=msg("Write future = self.client.call_async(request) and "
                "future.add_done_callback(self.on_answer), and use the answer in on_answer: "
                "future.result(). Check with ros2 service list that the server runs, too."),
        seen=r"/rclpy/client\.py\", line \d{1,6}, in call\n[\s\S]{0,900}?(?P<told>^KeyboardInterrupt)$",
    ),
    TerminalText(
        id="lab.entry_without_module", link=links.PYTHON_PACKAGES,
        title=msg("The entry in setup.py names the package, and not the file with the function"),
        why=msg("ros2 run looks for {name} in {package}/__init__.py, because the entry in console_scripts has "
                "no module before the colon."),
        fix=msg("Write the name of the file, without .py, after the package in setup.py: "
                "{package}.<file>:{name}. Then build again. The function {name} has to be in that file."),
        seen=r"functools\.reduce\(getattr, attrs, module\)\n(?:[ ~^]{1,120}\n)?"
             r"(?P<told>AttributeError: module '(?P<package>\w{1,80})' has no attribute '(?P<name>\w{1,80})')",
        values={"name": "main"},
    ),
    TerminalText(
        id="lab.bridge_type", link=links.TOPICS,
        title=msg("The bridge to Gazebo does not know the pair of types"),
        why=msg("parameter_bridge has a fixed list of pairs: a type of ROS as package/msg/Name, and one of "
                "Gazebo. Without such a pair it makes no bridge, and nothing is passed on."),
        fix=msg("Write the type of ROS with /msg/ and compare both names, upper and lower case, in quotes: "
                "'/scan@sensor_msgs/msg/LaserScan[gz.msgs.LaserScan'. The README of ros_gz_bridge lists all "
                "pairs."),
        seen=r"Failed to create a bridge for topic \[[^\n]{1,300}"
             r"|No template specialization for the pair[^\n]{0,200}",
    ),
    TerminalText(
        id="lab.parameter_undeclared", link=links.PARAMETERS,
        title=msg("A parameter is read before it is declared"),
        why=msg("A node has only the parameters that it declares. {name} was not declared when this line "
                "ran."),
        fix=msg("Write self.declare_parameter('{name}', 1.0), with your default value, in __init__ above "
                "the line that reads or sets it. Compare the spelling."),
        seen=r"ParameterNotDeclaredException: \('Invalid access to undeclared parameter\(s\)', "
             r"\[?'(?P<name>[^'\n]{1,80})'|ParameterNotDeclaredException",
        values={"name": "speed"},
    ),
    TerminalText(
        id="lab.name_of_node", link=links.RCLPY,
        title=msg("The name belongs to rclpy's Node"),
        why=msg("Every Node has {name} itself, for its own use. Your class cannot give it another value."),
        fix=msg("Take another name, such as self.{name}_ or self.my_{name}, in all lines of your class."),
        seen=r"AttributeError: property '(?P<name>publishers|subscriptions|clients|services|timers|guards|"
             r"executor|context|handle|default_callback_group|waitables|logger_name)' of '\w{1,120}' object "
             r"has no setter|AttributeError: can't set attribute '(?P<name_2>publishers|subscriptions|clients|services|timers|"
             r"executor|context|handle)'"
             r"|self\.(?P<name_3>publishers|subscriptions|clients|services|timers|executor|context|handle) = "
             r"[^\n]{1,200}\n(?:[ ~^]{1,120}\n)?AttributeError: can't set attribute$",
        values={"name": "publishers"},
    ),
    TerminalText(
        id="lab.spin_in_callback", link=links.CALLBACK_GROUPS,
        title=msg("A callback waits for something that only the same thread can bring"),
        why=msg("rclpy.spin calls one callback after the other. A callback that spins or waits itself "
                "stops that."),
        fix=msg("Do not spin in a callback. Write future = self.client.call_async(request) and "
                "future.add_done_callback(self.done) there: ROS calls done(future) with the answer, "
                "future.result(). In an async callback: response = await self.client.call_async(request)"),
        seen=r"ValueError: generator already executing|Executor is already spinning"
             r"|[Nn]ode .{0,80} has already been added to an executor",
    ),
    TerminalText(
        id="lab.future", link=links.SERVICES,
        title=msg("The answer is still in the future"),
        why=msg("call_async returns at once, with a future. The answer is in it when it is done."),
        fix=msg("Outside of a callback: rclpy.spin_until_future_complete(node, future), then "
                "future.result().{name}. In a callback: future.add_done_callback(self.done), and "
                "future.result().{name} in done."),
        cases=(
            Case(r"'NoneType' object has no attribute '(?P<name>\w{1,80})'",
                 why=msg("result() of a future is None until the answer is there.")),
        ),
        seen=r"AttributeError: 'Future' object has no attribute '(?P<name>\w{1,80})'"
             r"|future\.result\(\)\.(?P<name_2>\w{1,80})[^\n]{0,80}\n(?:[ ~^]{1,120}\n)?"
             r"AttributeError: 'NoneType' object has no attribute",
        values={"name": "sum"},
    ),
    TerminalText(
        id="lab.argument_missing", link=links.FIRST_NODE,
        title=msg("A publisher, subscription, service or client lacks an argument"),
        why=msg("{call} lacks an argument. A publisher needs type, topic and queue size; a subscription the callback before the "
                "queue size; a service type, name and callback; a client type and name."),
        fix=msg("Write it in your file as in one of these: create_publisher(String, 'topic', 10), "
                "create_subscription(String, 'topic', self.heard, 10), create_service(Trigger, 'name', "
                "self.answer), create_client(Trigger, 'name')."),
        seen=r"TypeError: (?:Node\.)?(?P<call>create_(?:publisher|subscription|service|client))\(\) missing "
             r"\d{1,3} required positional argument[^\n]{1,120}",
        values={"call": "create_publisher"},
    ),
    TerminalText(
        id="lab.import_node", link=links.FIRST_NODE,
        title=msg("A part of rclpy was not imported"),
        why=msg("import rclpy does not import the parts of rclpy."),
        fix=msg("Write from rclpy.node import Node below import rclpy, and Node in place of rclpy.node.Node. "
                "In general: import rclpy.{name}"),
        seen=r"AttributeError: (?:partially initialized )?module 'rclpy' has no attribute "
             r"'(?P<name>node|executors|qos|action|parameter|duration|time|callback_groups|logging)'",
        values={"name": "node"},
    ),
    TerminalText(
        id="lab.two_clocks", link=links.TF2,
        title=msg("Messages and transforms have times of two clocks"),
        why=msg("A message is used at its own time, and the transforms are all of another time: one node takes "
                "the time of a simulation or of a bag (/clock), the other that of the computer, or the clocks "
                "of two computers differ."),
        fix=msg("With a simulation or a bag, start all nodes with use_sim_time: ros2 run … --ros-args -p "
                "use_sim_time:=true, in a launch file parameters=[{{'use_sim_time': True}}]. ros2 param get "
                "<node> use_sim_time shows it. With two computers, set their clocks by NTP."),
        seen=r"for reason 'the timestamp on the message is earlier than all the data in the transform cache'"
             r"|TF_OLD_DATA ignoring data from the past[^\n]{0,120}",
    ),
    TerminalText(
        id="lab.transform", link=links.TF2,
        title=msg("A transform is not known"),
        why=msg("tf2 knows only the frames that some node publishes, for the last ten seconds. In the first "
                "moments after the start, it knows none."),
        fix=msg("Run ros2 run tf2_tools view_frames, or ros2 topic echo /tf_static, and compare the names of "
                "the frames. Ask for the newest with rclpy.time.Time(), and catch TransformException until "
                "it is there."),
        seen=r"passed to lookupTransform argument \w{1,20} does not exist"
             r"|Lookup would require extrapolation[^\n]{0,120}|Could not find a connection between '[^\n]{1,120}"
             r"|tf2(?:_ros)?\.\w{0,40}(?:Lookup|Connectivity|Extrapolation)Exception",
    ),
    TerminalText(
        id="lab.external_shutdown", stage="terminal", link=links.RCLPY,
        title=msg("ROS was shut down while the node was spinning"),
        why=msg("This is normal: Ctrl+C, or the end of a launch, shuts ROS down, and rclpy.spin says so with "
                "this exception."),
        fix=msg("You do not have to fix anything. To avoid the traceback, write try: … except "
                "(KeyboardInterrupt, ExternalShutdownException): pass around rclpy.spin, with from "
                "rclpy.executors import ExternalShutdownException"),
        seen=r"rclpy\.executors\.ExternalShutdownException",
    ),
    TerminalText(
        id="lab.context_ended", stage="terminal", link=links.RCLPY,
        title=msg("ROS is used after it was shut down"),
        why=msg("After rclpy.shutdown(), or Ctrl+C, nothing of the node works any more: no log, no "
                "publish, no spin."),
        fix=msg("Let rclpy.shutdown() be the last line. In except KeyboardInterrupt, use print instead of "
                "the logger, and ask rclpy.ok() before you publish."),
        cases=(
            Case(r"\[rclcpp\]|terminate called after",
                 why=msg("Ctrl+C ends ROS in the program, and a loop that goes on uses it afterwards."),
                 fix=msg("Write while (rclcpp::ok()) in place of while (true), and let rclcpp::shutdown() be the "
                         "last line. Then build again.")),
        ),
        seen=r"publisher's context is invalid|(?:the given |rcl )?context is (?:invalid|not valid)"
             r"|cannot use Destroyable because destruction was requested",
    ),
)  # fmt: skip
