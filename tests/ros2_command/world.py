"""The node of the recordings of the graph (see "world" in ros2cli-jazzy-graph.json)."""

from contextlib import suppress

import rclpy
from geometry_msgs.msg import Twist
from rcl_interfaces.msg import ParameterDescriptor
from rclpy.executors import ExternalShutdownException
from std_msgs.msg import String
from std_srvs.srv import SetBool, Trigger

rclpy.init()
node = rclpy.create_node("world")
publisher = node.create_publisher(String, "/chatter", 10)
node.create_timer(0.1, lambda: publisher.publish(String(data="hello")))
node.create_subscription(Twist, "/turtle1/cmd_vel", lambda _: None, 10)


def enable(request, response):  # type: ignore[no-untyped-def]
    response.success, response.message = True, "on" if request.data else "off"
    return response


def reset(_request, response):  # type: ignore[no-untyped-def]
    response.success, response.message = True, "done"
    return response


node.create_service(SetBool, "/enable", enable)
node.create_service(Trigger, "/reset", reset)
node.declare_parameter("speed", 1.5, ParameterDescriptor(description="metres a second"))
node.declare_parameter("name", "ann")
node.declare_parameter("sides", 4)
node.declare_parameter("on", True)
node.declare_parameter("list", [1, 2, 3])
print("ready", flush=True)
with suppress(KeyboardInterrupt, ExternalShutdownException):
    rclpy.spin(node)
