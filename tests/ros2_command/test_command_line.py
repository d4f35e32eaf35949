"""Help, usage errors and the commands that the wheels do not have."""

from __future__ import annotations

import re
import sys

import pytest

from .surroundings import PACKAGE, Surroundings, write_script

ROOT_HELP = """\
usage: ros2 [-h] [--use-python-default-buffering]
            Call `ros2 <command> -h` for more detailed usage. ...

ros2 is an extensible command-line tool for ROS 2.

options:
  -h, --help            show this help message and exit
  --use-python-default-buffering
                        Do not force line buffering in stdout and instead use
                        the python default buffering, which might be affected
                        by PYTHONUNBUFFERED/-u and depends on whatever stdout
                        is interactive or not

Commands:
  action     Various action related sub-commands
  daemon     Various daemon related sub-commands
  doctor     Check the ROS setup of this terminal and the workspace
  grade      Check your own package before you hand it in: the same as the command `check`
  interface  Show information about ROS interfaces
  lab        Take you through the lesson: the same as the command `lab`
  lifecycle  Various lifecycle related sub-commands
  node       Various node related sub-commands
  param      Various param related sub-commands
  pkg        Various package related sub-commands
  run        Run a package specific executable
  service    Various service related sub-commands
  topic      Various topic related sub-commands
  wtf        Use `wtf` as alias to `doctor`

  Call `ros2 <command> -h` for more detailed usage.
"""
NODE_LIST_HELP = """\
usage: ros2 node list [-h] [--spin-time SPIN_TIME] [-s] [--no-daemon] [-a]
                      [-c]

Output a list of available nodes

options:
  -h, --help            show this help message and exit
  --spin-time SPIN_TIME
                        Spin time in seconds to wait for discovery (only
                        applies when not using an already running daemon)
  -s, --use-sim-time    Enable ROS simulation time
  --no-daemon           Do not spawn nor use an already running daemon
  -a, --all             Display all nodes even hidden ones
  -c, --count-nodes     Only display the number of nodes discovered
"""
TOPIC_LIST_HELP = """\
usage: ros2 topic list [-h] [--spin-time SPIN_TIME] [-s] [--no-daemon] [-t]
                       [-c] [--include-hidden-topics] [-v]

Output a list of available topics

options:
  -h, --help            show this help message and exit
  --spin-time SPIN_TIME
                        Spin time in seconds to wait for discovery (only
                        applies when not using an already running daemon)
  -s, --use-sim-time    Enable ROS simulation time
  --no-daemon           Do not spawn nor use an already running daemon
  -t, --show-types      Additionally show the topic type
  -c, --count-topics    Only display the number of topics discovered
  --include-hidden-topics
                        Consider hidden topics as well
  -v, --verbose         List full details about each topic
"""
CREATE_HELP = """\
Create a new ROS 2 package

positional arguments:
  package_name          The package name

options:
  -h, --help            show this help message and exit
  --package-format {2,3}, --package_format {2,3}
                        The package.xml format.
  --description DESCRIPTION
                        The description given in the package.xml
  --license LICENSE     The license attached to this package; this can be an
                        arbitrary string, but a LICENSE file will only be
                        generated if it is one of the supported licenses (pass
                        '?' to get a list)
  --destination-directory DESTINATION_DIRECTORY
                        Directory where to create the package directory
  --build-type {cmake,ament_cmake,ament_python}
                        The build type to process the package with
  --dependencies DEPENDENCIES [DEPENDENCIES ...]
                        list of dependencies
  --maintainer-email MAINTAINER_EMAIL
                        email address of the maintainer of this package
  --maintainer-name MAINTAINER_NAME
                        name of the maintainer of this package
  --node-name NODE_NAME
                        name of the empty executable
  --library-name LIBRARY_NAME
                        name of the empty library
"""
NODE_HELP = """\
usage: ros2 node [-h]
                 Call `ros2 node <command> -h` for more detailed usage. ...

Various node related sub-commands

options:
  -h, --help            show this help message and exit

Commands:
  info  Output information about a node
  list  Output a list of available nodes

  Call `ros2 node <command> -h` for more detailed usage.
"""
TOPIC_HELP = """\
usage: ros2 topic [-h] [--include-hidden-topics]
                  Call `ros2 topic <command> -h` for more detailed usage. ...

Various topic related sub-commands

options:
  -h, --help            show this help message and exit
  --include-hidden-topics
                        Consider hidden topics as well

Commands:
  bw     Display bandwidth used by topic
  delay  Display delay of topic from timestamp in header
  echo   Output messages from a topic
  find   Output a list of available topics of a given type
  hz     Print the average publishing rate to screen
  info   Print information about a topic
  list   Output a list of available topics
  pub    Publish a message to a topic
  type   Print a topic's type

  Call `ros2 topic <command> -h` for more detailed usage.
"""


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        ([], ROOT_HELP),
        (["-h"], ROOT_HELP),
        (["--use-python-default-buffering"], ROOT_HELP),
        (["node"], NODE_HELP),
        (["node", "-h"], NODE_HELP),
        (["node", "list", "-h"], NODE_LIST_HELP),
        (["topic"], TOPIC_HELP),
        (["topic", "--help"], TOPIC_HELP),
        (["topic", "list", "-h"], TOPIC_LIST_HELP),
    ],
)
def test_help_is_the_same_on_every_python(
    jazzy: Surroundings, arguments: list[str], text: str
) -> None:
    done = jazzy.ros2(*arguments)
    assert (done.status, done.stdout, done.stderr) == (0, text, "")


def test_help_of_create(jazzy: Surroundings) -> None:
    done = jazzy.ros2("pkg", "create", "-h")
    assert done.status == 0
    assert done.stdout.partition("\n\n")[2] == CREATE_HELP


@pytest.mark.parametrize(
    ("verb", "usage"),
    [
        ("list", "usage: ros2 pkg list [-h]\n\nOutput a list of available packages\n"),
        (
            "executables",
            "usage: ros2 pkg executables [-h] [--full-path] [package_name]\n\n"
            "Output a list of package specific executables\n",
        ),
        (
            "prefix",
            "usage: ros2 pkg prefix [-h] [--share] package_name\n\n"
            "Output the prefix path of a package\n",
        ),
        (
            "xml",
            "usage: ros2 pkg xml [-h] [-t TAG] package_name\n\n"
            "Output the XML of the package manifest or a specific tag\n",
        ),
    ],
)
def test_help_of_the_pkg_verbs(jazzy: Surroundings, verb: str, usage: str) -> None:
    done = jazzy.ros2("pkg", verb, "--help")
    assert (done.status, done.stderr) == (0, "")
    assert done.stdout.startswith(usage)


@pytest.mark.parametrize(
    "command",
    [
        *("bag", "component", "extension_points", "extensions", "launch", "multicast", "security"),
        *("test", "service echo"),
    ],
)
@pytest.mark.parametrize("rest", [[], ["play", "--rate", "2"]])
def test_commands_that_need_a_full_ros_say_so(
    jazzy: Surroundings, command: str, rest: list[str]
) -> None:
    done = jazzy.ros2(*command.split(), *rest)
    assert (done.status, done.stdout) == (1, "")
    assert re.fullmatch(
        rf"ros2 {command}: .*; the wheels do not have it, .* `make images`.*\n", done.stderr
    )


@pytest.mark.parametrize(
    ("command", "package"), [("control", "ros2controlcli"), ("trace", "ros2trace")]
)
def test_commands_that_are_a_package_of_their_own_say_which(
    kilted: Surroundings, command: str, package: str
) -> None:
    done = kilted.ros2(command, "list")
    assert (done.status, done.stdout, done.stderr.count("\n")) == (1, "", 1)
    assert done.stderr.startswith(f"ros2 {command}: ")
    assert done.stderr.endswith(f": sudo apt-get install ros-kilted-{package}\n")


@pytest.mark.parametrize(
    ("package", "remedy"),
    [
        ("demo_nodes_cpp", "ros-jazzy-desktop"),
        ("rviz2", "ros-jazzy-desktop"),
        ("turtlesim", "`make images`"),
    ],
)
def test_packages_of_the_tutorials_that_are_not_here_say_where_they_are(
    jazzy: Surroundings, package: str, remedy: str
) -> None:
    done = jazzy.ros2("run", package, "talker")
    assert (done.status, done.stdout) == (1, "")
    assert done.stderr.startswith(f"Package '{package}' ")
    assert len(done.stderr.splitlines()) == 1
    assert remedy in done.stderr


@pytest.mark.parametrize(
    ("arguments", "error"),
    [
        (
            ["pkg", "creat"],
            "ros2 pkg: error: argument Call `ros2 pkg <command> -h` for more detailed usage.: "
            "invalid choice: 'creat' (choose from 'create', 'executables', 'list', 'prefix', "
            "'xml')",
        ),
        (["pkg", "list", "--x"], "ros2: error: unrecognized arguments: --x"),
        (["--x"], "ros2: error: unrecognized arguments: --x"),
        (
            ["pkg", "prefix"],
            "ros2 pkg prefix: error: the following arguments are required: package_name",
        ),
        (
            ["pkg", "create", "p", "--d", "x"],
            "ros2 pkg create: error: ambiguous option: --d could match --description, "
            "--destination-directory, --dependencies",
        ),
        (
            ["node", "list", "--spin-time", "soon"],
            "ros2 node list: error: argument --spin-time: invalid float value: 'soon'",
        ),
    ],
)
def test_usage_errors(jazzy: Surroundings, arguments: list[str], error: str) -> None:
    done = jazzy.ros2(*arguments)
    assert (done.status, done.stdout) == (2, "")
    assert done.stderr.startswith("usage: ros2")
    assert done.stderr.splitlines()[-1] == error


def test_the_package_imports_nothing_else() -> None:
    """It is copied into prefixes, so it must not import the grader, and little else.

    PyYAML and NumPy come with rclpy; they are imported only where they are used.
    """
    for path in PACKAGE.rglob("*.py"):
        text = path.read_text()
        imported = re.findall(r"^ *(?:from|import) ([\w.]+)", text, re.MULTILINE)
        assert not {name.partition(".")[0] for name in imported} & {"grader", "lab"}, path
        at_once = re.findall(r"^(?:from|import) (\w+)", text, re.MULTILINE)
        assert not set(at_once) & {"numpy", "rclpy", "yaml"}, path


def test_run_imports_nothing_of_the_other_verbs(jazzy: Surroundings) -> None:
    """A node does not wait for code that it does not need."""
    site = str(jazzy.prefix / "lib" / "site")
    code = (
        "import sys; sys.path.insert(0, sys.argv[1]); from wheels_ros2 import cli; "
        "cli.main(['run', 'my_robot_controller', 'zero']); "
        "print(*(n for n in sys.modules if n.startswith('wheels_ros2.')))"
    )
    done = jazzy.command(sys.executable, "-S", "-c", code, site)
    assert set(done.stdout.splitlines()[-1].split()) == {
        f"wheels_ros2.{name}"
        for name in ("absent", "ament_index", "cli", "distro", "parsing", "run")
    }


@pytest.mark.parametrize(("command", "program"), [("lab", "lab"), ("grade", "check")])
def test_the_labs_programs_are_commands_of_ros2_too(
    command: str, program: str, jazzy: Surroundings
) -> None:
    outside = jazzy.ros2(command, "status")
    assert outside.status == 1
    assert "make lab" in outside.stderr
    text = '#!/bin/sh\necho "$0 $*"\nexit 5\n'
    write_script(jazzy.prefix / "lab" / program, text)
    lab = {"LAB_PROGRAMS": str(jazzy.prefix / "lab")}
    inside = jazzy.ros2(command, "status", "--lang", "ko", environment=lab)
    assert (inside.status, inside.stderr) == (5, "")
    assert inside.stdout.endswith(f"{program} status --lang ko\n")
