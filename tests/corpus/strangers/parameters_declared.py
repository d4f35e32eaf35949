import rclpy
from rcl_interfaces.msg import ParameterDescriptor, SetParametersResult
from rclpy.node import Node


class MyFirstNode(Node):
    def __init__(self):
        super().__init__("my_first_node")
        self.declare_parameter(
            "prefix", "Hello time: ", ParameterDescriptor(description="the text")
        )
        self.declare_parameter("period", 1.0)
        self.declare_parameter("first", 0)
        self.add_on_set_parameters_callback(self.on_set)
        self.number = self.get_parameter("first").get_parameter_value().integer_value
        period = self.get_parameter("period").get_parameter_value().double_value
        self.timer = self.create_timer(period, self.on_timer)

    def on_set(self, parameters):
        names = [parameter.name for parameter in parameters]
        return SetParametersResult(successful="period" not in names)

    def on_timer(self):
        self.get_logger().info(self.get_parameter("prefix").value + str(self.number))
        self.number += 1
