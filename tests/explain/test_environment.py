"""What concerns the environment is recognised in a terminal's output, or nothing is claimed.

The texts are those of ROS 2 humble and jazzy, colcon, CMake, Python, pip, Qt and the shells.
"""

from __future__ import annotations

import io
from dataclasses import dataclass

import pytest

from grader.explain.explanation import Reader, print_recognised
from grader.explain.from_terminal import seen_in
from grader.ros.distro import find_distro


@dataclass(frozen=True)
class Shown:
    """A text, the id of what it shows ("" for nothing), and words that the answer has or lacks."""

    name: str
    text: str
    kind: str
    says: tuple[str, ...] = ()
    never: tuple[str, ...] = ()


TRACE = "Traceback (most recent call last):\n"
EXTENSION = (
    "ModuleNotFoundError: No module named 'rclpy._rclpy_pybind11'\nThe C extension "
    "'/opt/ros/{0}/_rclpy_pybind11.cpython-{1}-x86_64-linux-gnu.so' isn't present on the system. "
    "Please refer to 'https://docs.ros.org/en/{0}' for possible solutions\n"
)
RCLPY = (
    TRACE
    + '  File "{0}/rclpy/__init__.py", line 49, in <module>\n    from rclpy.signals import x\n'
)
NOT_FOUND = (
    'CMake Error at CMakeLists.txt:12 (find_package):\n  By not providing "Find{0}.cmake" in '
    "CMAKE_MODULE_PATH this project\n  has asked CMake to find a package configuration file\n"
)
EXECUTED = (
    "ModuleNotFoundError: No module named '{1}'\nCMake Error at /opt/ros/jazzy/share/x.cmake:95 "
    "(message):\n  execute_process({0}\n  /opt/ros/jazzy/share/ament_cmake_core/cmake/core/"
    "package_xml_2_cmake.py\n  returned error code 1\n"
)
OWN = '  File "/home/kim/dev_ws/install/{0}/lib/python3.12/site-packages/{0}/sub.py", line 3, in <module>\n'
ENTRY = (
    TRACE + '  File "/home/kim/dev_ws/install/arm/lib/arm/talk", line 33, in <module>\n'
    '  File "<frozen importlib._bootstrap>", line 1387, in _gcd_import\n'
)
TEXTS = (
    Shown("conda", RCLPY.format("/opt/ros/humble/local/lib/python3.10/dist-packages")
          + EXTENSION.format("humble", "311").replace(": No", ": No", 1) + "(base) eva@pc:~$ \n",
          "lab.other_python",
          ("Python 3.11 runs", "Python 3.10", "conda deactivate", "which python3")),
    Shown("pyenv", RCLPY.format("/opt/ros/jazzy/lib/python3.12/site-packages")
          + EXTENSION.format("jazzy", "313"), "lab.other_python",
          ("Python 3.13 runs", "Python 3.12", "/usr/bin/python3"), ("conda deactivate",)),
    Shown("venv", "(.venv) lee@lab:~$ python3 talker.py\n"
          + RCLPY.format("/opt/ros/humble/local/lib/python3.10/dist-packages")
          + EXTENSION.format("humble", "312"), "lab.other_python",
          ("Run deactivate", "Python 3.12 runs"), ("conda deactivate",)),
    Shown("the same version", RCLPY.format("/opt/ros/humble/local/lib/python3.10/dist-packages")
          + EXTENSION.format("humble", "310"), ""),
    Shown("conda's library", "ImportError: /home/ana/miniconda3/bin/../lib/libstdc++.so.6: version "
          "`GLIBCXX_3.4.30' not found (required by /opt/ros/humble/lib/librclcpp.so)\n",
          "lab.other_python", ("conda deactivate",)),
    Shown("conda, build", EXECUTED.format("/opt/miniforge3/envs/ros/bin/python3.11", "catkin_pkg"),
          "lab.build_python",
          ("/opt/miniforge3/envs/ros/bin/python3.11", "conda deactivate", "build and install")),
    Shown("venv, build", EXECUTED.format("/home/lee/ros2_ws/.venv/bin/python3", "em"),
          "lab.build_python", ("Run deactivate",), ("conda deactivate",)),
    Shown("system, build", EXECUTED.format("/usr/bin/python3", "lark"), "lab.build_python",
          ("sudo apt-get install", "python3-lark"), ("conda deactivate",)),
    Shown("empy 4", "AttributeError: module 'em' has no attribute 'RAW_OPT'\n", "lab.empy", ("3.3.4",)),
    Shown("another em", "AttributeError: module 'em' has no attribute 'Interpreter'\n", "lab.empy",
          ("pip uninstall em",)),
    Shown("dash, error", "setuptools.errors.InvalidConfigError: Invalid dash-separated key "
          "'install-scripts' in 'install' (setup.cfg), please use the underscore name "
          "'install_scripts' instead.\n", "lab.dashed_key", ("install-scripts has to be install_scripts",)),
    Shown("dash, warning", "  /usr/lib/python3/dist-packages/setuptools/dist.py:723: UserWarning: Usage of "
          "dash-separated 'script-dir' will not be supported in future versions. Please use the "
          "underscore name 'script_dir' instead\n", "lab.dashed_key", ("script_dir", "78")),
    Shown("pip", "kim@pc:~$ pip3 install --user transforms3d==0.4.1\nerror: "
          "externally-managed-environment\n\n× This environment is externally managed\n",
          "lab.managed_python", ("python3-transforms3d", "--system-site-packages"),
          ("--break-system-packages", "==0.4.1 (")),
    Shown("pip, file", "python3 -m pip install -r requirements.txt\nerror: externally-managed-environment",
          "lab.managed_python", ("apt-cache search", "--system-site-packages"), ("python3-req",)),
    Shown("launch", "file 'start.launch.xml' was not found in the share directory of package 'rover' "
          "which is at '/root/ws/install/rover/share/rover'\n", "lab.launch_not_installed",
          ("data_files", "glob('launch/*')", "start.launch.xml")),
    Shown("launch of ROS", "file 'multisim.py' was not found in the share directory of package "
          "'turtlesim' which is at '/opt/ros/jazzy/share/turtlesim'\n", ""),
    Shown("display, WSL", "qt.qpa.xcb: could not connect to display :0\nqt.qpa.plugin: Could not load the "
          'Qt platform plugin "xcb" in "" even though it was found.\n', "lab.no_screen",
          ("wsl --update", "DISPLAY", "/tmp/.X11-unix")),
    Shown("display, opencv", 'qt.qpa.plugin: Could not load the Qt platform plugin "xcb" in '
          '"/home/eva/.local/lib/python3.10/site-packages/cv2/qt/plugins" even though it was found.\n',
          "lab.no_screen", ("pip uninstall opencv-python",), ("wsl",)),
    Shown("type of a service", "The passed service type is invalid\n", "lab.interface_unknown",
          ("source install/local_setup.bash",)),
    Shown("interface show", "Unknown package 'tutorial_interfaces'\n", "lab.interface_unknown"),
    Shown("colcon, zsh", "zsh: command not found: colcon\n", "lab.colcon_not_found",
          ("python3-colcon-common-extensions", "~/.local/bin")),
    Shown("ros2, Ubuntu", "Command 'ros2' not found, did you mean:\n", "lab.ros_not_sourced"),
    Shown("left over", 'not found: "/home/kim/dev_ws/install/cpp_pubsub/share/cpp_pubsub/package.bash"\n',
          "lab.left_over", ("build, install and log", "cpp_pubsub")),
    Shown("no first line", TRACE + '  File "/opt/ros/jazzy/bin/ros2", line 33, in <module>\n'
          "OSError: [Errno 8] Exec format error: '/ws/install/rover/lib/rover/drive.py'\n",
          "lab.exec_format", ("#!/usr/bin/env python3",)),
    Shown("prefix", "[0.3s] WARNING:colcon.colcon_ros.prefix_path.catkin:The path '/ws/install/a' in the "
          "environment variable CMAKE_PREFIX_PATH doesn't exist\n", "lab.prefix_gone",
          ("harmless", "new terminal")),
    Shown("CMake and ROS", NOT_FOUND.format("rosidl_default_generators"), "lab.underlay",
          ("source /opt/ros/", "ros-jazzy-rosidl-default-generators")),
    Shown("CMake and a package", NOT_FOUND.format("rover_things"), "lab.cmake_package",
          ("<depend>rover_things</depend>",)),
    Shown("interfaces, launch", "[talker-1] " + TRACE + "[talker-1] " + OWN.format("rover")
          + "[talker-1]     from sensors.srv import Reset\n[talker-1] ModuleNotFoundError: No module "
          "named 'sensors'\n", "lab.interface_not_built", ("<depend>sensors</depend>", "colcon list")),
    Shown("interfaces of ROS", TRACE + '  File "/home/kim/a.py", line 3, in <module>\n    from '
          "geometry_msgs.msg import Twist\nModuleNotFoundError: No module named 'geometry_msgs'\n",
          "lab.interface_not_built", ("source /opt/ros/", "ros-jazzy-geometry-msgs"), ("<depend>",)),
    Shown("a new interface", "ImportError: cannot import name 'Motor' from 'rover_interfaces.msg' "
          "(/ws/install/rover_interfaces/lib/python3.10/site-packages/rover_interfaces/msg/__init__.py)\n",
          "lab.interface_not_built", ("rosidl_generate_interfaces",)),
    Shown("a module of an import", TRACE + OWN.format("arm") + "    from arm.kinematics import solve\n"
          "ModuleNotFoundError: No module named 'arm.kinematics'\n", "lab.no_module",
          ("arm.kinematics",), ("console_scripts",)),
    Shown("a module of an entry", ENTRY + "ModuleNotFoundError: No module named 'arm.tlk'\n",
          "setup.misspelt_module", ("console_scripts",)),
    Shown("an entry without its package", ENTRY + "ModuleNotFoundError: No module named 'talk'\n",
          "lab.no_module", ("package.module:function",)),
    Shown("a module of the internet", TRACE + OWN.format("arm") + "    import ultralytics\n"
          "ModuleNotFoundError: No module named 'ultralytics'\n", "lab.no_module", ("apt",)),
    Shown("int for float", TRACE + '  File "/ws/src/a/a/b.py", line 7, in tick\n    cmd.angular.z = -1\n'
          '    ^^^^^^^^^^^^^\n  File "/opt/ros/jazzy/lib/python3.12/site-packages/geometry_msgs/msg/'
          '_vector3.py", line 150, in z\n    assert \\\n           ^\nAssertionError: The \'z\' field must '
          "be of type 'float'\n", "lab.field_type", ("Write z = -1.0",)),
    Shown("number for text", "AssertionError: The 'data' field must be of type 'str'\n", "lab.field_type",
          ("str(",), ("2.0 instead",)),
    # another one's library, another one's file: nothing of the student's source is claimed
    Shown("an error of a library", TRACE + OWN.format("arm") + '  File "/usr/lib/python3/dist-packages/'
          'transforms3d/quaternions.py", line 27, in <module>\n    x = np.float\nAttributeError: module '
          "'numpy' has no attribute 'float'\n", ""),
    Shown("an error of colcon", TRACE + '  File "/usr/lib/python3/dist-packages/colcon_core/x.py", line 7, '
          "in f\n    y\nAttributeError: 'NoneType' object has no attribute 'lower'\n", ""),
    Shown("a device", "PermissionError: [Errno 13] Permission denied: '/dev/ttyUSB0'\n", ""),
    Shown("an interface package", "creating ./rover_interfaces/CMakeLists.txt\n", ""),
    Shown("NumPy", "A module that was compiled using NumPy 1.x cannot be run in\nNumPy 2.0.2\n", ""),
)  # fmt: skip


@pytest.mark.parametrize("case", TEXTS, ids=lambda case: case.name)
def test_the_environment_is_explained_or_nothing_is_claimed(case: Shown) -> None:
    out = io.StringIO()
    reader = Reader("en", find_distro("jazzy"))
    assert print_recognised(case.text, file=out, reader=reader) is bool(case.kind), out.getvalue()
    said = " ".join(out.getvalue().split())
    assert [s.kind.id for s in seen_in(case.text)] == ([case.kind] if case.kind else [])
    assert [words for words in case.says if words not in said] == []
    assert [words for words in case.never if words in said] == []


def test_four_causes_of_no_executable_are_told_apart() -> None:
    out = io.StringIO()
    text = "$ ros2 run rover drive\nNo executable found\n"
    print_recognised(text, file=out, reader=Reader("en", find_distro("humble")))
    said = " ".join(out.getvalue().split())
    for words in (
        "ros2 pkg executables rover",
        "no entry",
        "setup.cfg",
        "not built",
        "without an x",
    ):
        assert words in said
