"""Help, usage errors and the commands that the wheels do not have."""

from __future__ import annotations

import re

import pytest

from .surroundings import PACKAGE, Surroundings

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
  node   Various node related sub-commands
  pkg    Various package related sub-commands
  run    Run a package specific executable
  topic  Various topic related sub-commands

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
  list  Output a list of available topics

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


@pytest.mark.parametrize("command", ["daemon", "extension_points", "extensions"])
@pytest.mark.parametrize("rest", [[], ["status"], ["-h"]])
def test_commands_that_need_a_full_ros_say_so(
    jazzy: Surroundings, command: str, rest: list[str]
) -> None:
    done = jazzy.ros2(command, *rest)
    assert (done.status, done.stdout) == (1, "")
    assert re.fullmatch(rf"ros2 {command}: not in this prefix .*\n", done.stderr)


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
    """It is copied into prefixes, so it must not import the grader or third-party packages."""
    for path in PACKAGE.rglob("*.py"):
        imported = re.findall(r"^ *(?:from|import) ([\w.]+)", path.read_text(), re.MULTILINE)
        assert not {name.partition(".")[0] for name in imported} & {"grader", "lab", "yaml"}, path
