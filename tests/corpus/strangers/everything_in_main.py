import rclpy


def main(args=None):
    rclpy.init(args=args)
    node = rclpy.create_node("my_first_node")
    state = {"count": 0}

    def callback():
        node.get_logger().info("Hello time: " + str(state["count"]))
        state["count"] = state["count"] + 1

    timer = node.create_timer(1.0, callback)
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    node.destroy_timer(timer)
    node.destroy_node()
    rclpy.try_shutdown()
