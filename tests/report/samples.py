"""Reports built by hand, like those of a verdict."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import Any

from grader.report import terminal
from grader.report.model import CheckResult, Mistake, Report, Where
from grader.verdict.checks.all import QUOTES

render_report = partial(terminal.render_report, quotes=QUOTES)
print_report = partial(terminal.print_report, quotes=QUOTES)

TITLES = {
    "package.found": ("The package is there", 5),
    "package.manifest": ("package.xml describes the package", 5),
    "package.marker": ("The resource marker is installed", 5),
    "package.setup_cfg": ("setup.cfg installs into lib/my_robot_controller", 5),
    "source.node_file": ("The node's file is in the inner folder", 5),
    "source.exec_bit": ("The node's file is executable", 10),
    "source.shebang": ("The node's file begins with a shebang", 5),
    "build.colcon": ("colcon builds the package", 10),
    "entry_point.mapping": ("setup.py maps test_node to the function that starts the node", 15),
    "entry_point.executable": ("ros2 run finds the executable", 5),
    "run.starts": ("The node starts and keeps running", 5),
    "run.node_name": ("The node is called my_first_node", 5),
    "run.output": ("The node counts: Hello time: 0, 1, 2, ...", 10),
    "run.logger": ("The lines come from the node's logger", 3),
    "run.period": ("One line comes each second", 4),
    "run.interrupt": ("Ctrl+C ends the node", 3),
}
COMMAND = "ros2 run my_robot_controller test_node --ros-args -p use_sim_time:=true"
TRACEBACK = """\
Traceback (most recent call last):
  File "/opt/ws/install/my_robot_controller/lib/my_robot_controller/test_node", line 33, in <module>
    sys.exit(load_entry_point('my-robot-controller', 'console_scripts', 'test_node')())
  File "/opt/ws/install/my_robot_controller/lib/my_robot_controller/test_node", line 25, in load
    return next(matches).load()
ModuleNotFoundError: No module named 'my_robot_controller.my_frist_node'
[ros2run]: Process exited with failure 1
"""


def check(check_id: str, status: str = "passed", **fields: Any) -> CheckResult:
    title, most = TITLES.get(check_id, (f"A check named {check_id}", 5))
    return CheckResult.model_validate(
        {
            "id": check_id,
            "title": title,
            "status": status,
            "score": most if status == "passed" else 0,
            "max_score": most,
            **fields,
        }
    )


def misspelt_module(**fields: Any) -> CheckResult:
    """Return a failed check: the entry point names a module that does not exist."""
    return check(
        "entry_point.mapping",
        "failed",
        expected="test_node = my_robot_controller.my_first_node:main",
        actual="test_node = my_robot_controller.my_frist_node:main",
        rationale="Before the colon stands the module: the package, a dot, and the file's name "
        "without .py. Python found no file of the name that is written there, so ros2 run could "
        "not load the node.",
        fix="In setup.py write my_first_node where it says my_frist_node, then build again.",
        patch="-            'test_node = my_robot_controller.my_frist_node:main',\n"
        "+            'test_node = my_robot_controller.my_first_node:main',",
        mistakes=[Mistake(id="entry_point.module_misspelt", params={"found": "my_frist_node"})],
        where=Where(file="setup.py", line=23),
        depends=["build.colcon"],
        **fields,
    )


def report(*changed: CheckResult, **fields: Any) -> Report:
    """Return a report of hello_time: all checks pass except `changed`; `fields` replace parts."""
    results = {check_id: check(check_id) for check_id in TITLES}
    results |= {result.id: result for result in changed}
    content: dict[str, Any] = {
        "assignment": {
            "id": "hello_time",
            "title": "Your first ROS 2 node: Hello time",
            "sha256": "a" * 64,
        },
        "submission": {
            "name": "anna",
            "path": "/home/anna/ros2_ws/src/my_robot_controller",
            "sha256": "b" * 64,
            "package": "my_robot_controller",
        },
        "environment": {
            "distro": "jazzy",
            "ros": "wheels",
            "sandbox": "bubblewrap",
            "limits": {"memory": {"value": 1e9, "unit": "bytes", "held_by": "cgroup"}},
            "rclpy": "7.1.6",
        },
        "status": "graded",
        "score": sum(result.score for result in results.values()),
        "max_score": sum(result.max_score for result in results.values()),
        "checks": list(results.values()),
        "observed": {
            "command": COMMAND,
            "clock": "virtual",
            "ticks": [{"n": 0, "text": "Hello time: 0", "virtual": 1.0, "wall": 1795226661.26}],
            "nodes": ["/my_first_node"],
            "exit": {"status": 1, "signal": None, "seconds": 0.05},
        },
        "timing": {"setup": 0.2, "intake": 0.01, "build": 2.1, "run": 1.4, "total": 3.71},
        "started": "2026-11-21T04:30:00+00:00",
    }
    return Report.model_validate(content | fields)


def failing_report(**fields: Any) -> Report:
    """Return a student's report: one mistake, the checks skipped because of it, one advice."""
    skipped = [
        check(check_id, "skipped", depends=["run.starts"], blocked_by="entry_point.mapping")
        for check_id in TITLES
        if check_id.startswith("run.") and check_id != "run.starts"
    ]
    starts = check(
        "run.starts",
        "skipped",
        depends=["entry_point.mapping"],
        blocked_by="entry_point.mapping",
    )
    advice = check(
        "source.exec_bit",
        advice=["The bit is not needed by ros2 run: it is for starting the file itself."],
    )
    evidence = {"transcript": TRACEBACK, "build_log": "Summary: 1 package finished [1.90s]\n"}
    return report(misspelt_module(), starts, *skipped, advice, **{"evidence": evidence, **fields})


def report_at(path: str | Path, *, distro: str = "jazzy", **fields: Any) -> Report:
    """Return a report of the submission at `path` in which all checks pass."""
    clean = report()
    return report(
        submission=clean.submission.model_copy(update={"path": str(path)}),
        environment=clean.environment.model_copy(update={"distro": distro}),
        **fields,
    )
