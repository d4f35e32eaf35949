"""The pages of documentation that entries of the catalogue link to.

Each distro has its own ROS 2 documentation: `address` replaces `{docs}` with its address.
"""

from __future__ import annotations

from grader.ros.distro import Distro

DOCS = "{docs}"
_CLIENT = f"{DOCS}/Tutorials/Beginner-Client-Libraries"
_CLI = f"{DOCS}/Tutorials/Beginner-CLI-Tools"

PACKAGE = f"{_CLIENT}/Creating-Your-First-ROS2-Package.html"
WORKSPACE = f"{_CLIENT}/Creating-A-Workspace/Creating-A-Workspace.html"
COLCON = f"{_CLIENT}/Colcon-Tutorial.html"
FIRST_NODE = f"{_CLIENT}/Writing-A-Simple-Py-Publisher-And-Subscriber.html"
INSTALLATION = f"{DOCS}/Installation.html"
ENVIRONMENT = f"{_CLI}/Configuring-ROS2-Environment.html"
NODES = f"{_CLI}/Understanding-ROS2-Nodes/Understanding-ROS2-Nodes.html"
LOGGING = f"{DOCS}/Tutorials/Demos/Logging-and-logger-configuration.html"
EXECUTORS = f"{DOCS}/Concepts/Intermediate/About-Executors.html"
DEVELOPING = f"{DOCS}/How-To-Guides/Developing-a-ROS-2-Package.html"
PYTHON_PACKAGES = f"{DOCS}/How-To-Guides/Using-Python-Packages.html"
TROUBLESHOOTING = f"{DOCS}/How-To-Guides/Installation-Troubleshooting.html"
LAUNCH = f"{DOCS}/Tutorials/Intermediate/Launch/Launch-system.html"
BAGS = f"{_CLI}/Recording-And-Playing-Back-Data/Recording-And-Playing-Back-Data.html"
ROSDEP = f"{DOCS}/Tutorials/Intermediate/Rosdep.html"
DISCOVERY = f"{DOCS}/Concepts/Basic/About-Discovery.html"
DOMAINS = f"{DOCS}/Concepts/Intermediate/About-Domain-ID.html"
MIDDLEWARE = f"{DOCS}/How-To-Guides/Working-with-multiple-RMW-implementations.html"
TF2 = f"{DOCS}/Tutorials/Intermediate/Tf2/Debugging-Tf2-Problems.html"
PARAMETER_FILES = f"{DOCS}/How-To-Guides/Node-arguments.html"
CALLBACK_GROUPS = f"{DOCS}/How-To-Guides/Using-callback-groups.html"
RCLPY = f"{DOCS}/p/rclpy/"
TOPICS = f"{_CLI}/Understanding-ROS2-Topics/Understanding-ROS2-Topics.html"
SERVICES = f"{_CLI}/Understanding-ROS2-Services/Understanding-ROS2-Services.html"
INTERFACES = f"{_CLIENT}/Custom-ROS2-Interfaces.html"
ACTIONS = f"{_CLI}/Understanding-ROS2-Actions/Understanding-ROS2-Actions.html"
PARAMETERS = f"{_CLI}/Understanding-ROS2-Parameters/Understanding-ROS2-Parameters.html"
LIFECYCLE = "https://design.ros2.org/articles/node_lifecycle.html"
QOS = f"{DOCS}/Concepts/Intermediate/About-Quality-of-Service-Settings.html"
NAMES = "https://design.ros2.org/articles/topic_and_service_names.html"
PACKAGE_NAMES = "https://www.ros.org/reps/rep-0144.html"
MANIFEST = "https://www.ros.org/reps/rep-0149.html"
SETUP_CFG = "https://setuptools.pypa.io/en/latest/userguide/declarative_config.html"
COLCON_IGNORE = "https://colcon.readthedocs.io/en/released/user/configuration.html"
PYTHON_ERRORS = "https://docs.python.org/3/tutorial/errors.html"
PYTHON_CLASSES = "https://docs.python.org/3/tutorial/classes.html"
PYTHON_MODULES = "https://docs.python.org/3/tutorial/modules.html"
PYTHON_STRINGS = "https://docs.python.org/3/tutorial/inputoutput.html"
PYTHON_SYNTAX = "https://docs.python.org/3/tutorial/errors.html#syntax-errors"


def address(link: str, distro: Distro) -> str:
    """Return the address of a page in the documentation of a distro."""
    return link.format(docs=distro.documentation)
