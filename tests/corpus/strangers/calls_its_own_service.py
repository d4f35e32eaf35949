import rclpy
from rcl_interfaces.srv import ListParameters
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class MyFirstNode(Node):
    """Asks its own service for the next number, without waiting in the callback."""

    def __init__(self):
        super().__init__("my_first_node")
        self.served = 0
        self.create_service(
            ListParameters, "next", self.next, callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.client = self.create_client(ListParameters, "next")
        self.create_timer(1.0, self.on_timer)

    def next(self, request, response):
        response.result.names = [str(self.served)]
        self.served += 1
        return response

    def on_timer(self):
        self.client.call_async(ListParameters.Request()).add_done_callback(self.on_answer)

    def on_answer(self, future):
        self.get_logger().info("Hello time: " + future.result().result.names[0])


def main(args=None):
    rclpy.init(args=args)
    node = MyFirstNode()
    try:
        rclpy.spin(node, executor=MultiThreadedExecutor())
    except KeyboardInterrupt:
        pass
    finally:
        rclpy.try_shutdown()
