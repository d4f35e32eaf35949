"""`make bench`: the cost of a verdict compared with that of the bare commands, in one run.

Figures are seconds of wall time ("wall") and processor time ("cpu"), each the median of its runs.
The ratios matter because they also hold on other machines. Processor time is that of the whole
machine, from /proc/stat, because a process is not charged for its children in PID namespaces. So
the machine must be otherwise idle.
"""

from __future__ import annotations

import argparse
import compileall
import os
import re
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from grader.course.load import load_assignment
from grader.package.submission import Submission, take_in
from grader.ros import images
from grader.ros.distro import find_distro
from grader.ros.prefix import Ros
from grader.run.probe_link import ProbeLink
from grader.run.run import observe, ros2_run
from grader.run.terminal import Terminal
from grader.run.workspace import build
from grader.sandbox.bubblewrap import Bubblewrap
from grader.sandbox.limits import Limits
from grader.sandbox.proof import proven_ros
from tests import engine, processes

COURSE = processes.ROOT / "lab" / "course" / "hello_time" / "assignment.yaml"
SOLUTION = processes.ROOT / "grader" / "keys" / "hello_time" / "solution" / "my_robot_controller"
ASSIGNMENT = load_assignment(COURSE)
PLAIN_TICKS = 5
PLAIN_LIMIT = 10.0  # seconds to wait for a line, as a missing one must not block the benchmark


@dataclass(frozen=True)
class Cost:
    """Seconds of wall time and of processor time."""

    wall: float
    cpu: float


def main() -> int:
    """Measure and print; return 1 if a bound of the project is not kept."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--runs", type=int, default=7, help="verdicts to take the median of")
    options.add_argument("--starts", type=int, default=100, help="starts of the node to time")
    asked = options.parse_args()
    ros = proven_ros(find_distro("jazzy"))
    submission = take_in(SOLUTION, package=ASSIGNMENT.package, node_file=ASSIGNMENT.node_file)
    # a warm machine has the byte code, even if PYTHONDONTWRITEBYTECODE prevents writing it
    compileall.compile_dir(str(processes.ROOT / "grader"), quiet=1, rx=re.compile("/keys/"))
    verdict_once()
    verdict = median_of_runs(verdict_once, asked.runs)
    colcon = median_of_runs(lambda: bare_build(ros, submission), asked.runs)
    node = median_of_runs(lambda: bare_run(ros, submission), asked.runs)
    imported = median_of_runs(lambda: bare_import(ros), asked.runs)
    plain = plain_grader(ros, submission)
    firsts, virtual = starts(ros, submission, asked.starts)
    in_containers, overhead = containers_overhead(asked.runs)
    help_ = median_of_runs(lambda: timed(processes.grader("--help")), asked.runs)
    memory = peak_memory()
    own = max(0.0, verdict.cpu - colcon.cpu - node.cpu - imported.cpu)
    late = sum(1 for seconds in firsts if seconds > 1.0)
    rows = [
        ("one verdict, warm", f"{verdict.wall:.2f} s wall, {verdict.cpu:.2f} s cpu"),
        ("  bare colcon build", f"{colcon.wall:.2f} s wall, {colcon.cpu:.2f} s cpu"),
        ("  bare ros2 run, Ctrl+C at once", f"{node.wall:.2f} s wall, {node.cpu:.2f} s cpu"),
        (
            "  bare import of rclpy (the probe's)",
            f"{imported.wall:.2f} s wall, {imported.cpu:.2f} s cpu",
        ),
        (
            "one verdict in containers",
            f"{in_containers.wall:.2f} s wall, {in_containers.cpu:.2f} s cpu",
        ),
        ("plain grader (build, run, 5 ticks)", f"{plain.wall:.2f} s wall, {plain.cpu:.2f} s cpu"),
    ]
    for name, text in rows:
        print(f"{name:40} {text}")
    print()
    bounds = [
        bound("verdict: seconds of wall time", verdict.wall, 4.0),
        bound("containers: seconds beyond bubblewrap", overhead, 1.0),
        bound("10 ticks in virtual time: seconds", virtual, 1.0),
        bound(f"first line over 1 s: of {len(firsts)} starts", late, len(firsts) / 100),
        bound("grader's own share of the processor time", own / verdict.cpu, 0.25),
        bound("grader --help: seconds", help_.wall, 0.25),
        bound("grader's peak memory: MB", memory, 120),
    ]
    slowest = sorted(firsts)[-3:]
    print(f"first line: median {statistics.median(firsts):.2f} s, slowest {slowest[-1]:.2f} s")
    print(f"plain wall-clock grader / verdict: {plain.wall / verdict.wall:.1f} times the wall time")
    print(f"verdict / bare build + bare run: {verdict.wall / (colcon.wall + node.wall):.2f}")
    return 0 if all(bounds) else 1


def bound(name: str, value: float, most: float) -> bool:
    """Print a figure next to its upper bound and return whether it is kept."""
    kept = value <= most
    print(f"{'ok ' if kept else 'NOT'} {name:42} {value:8.3f}  (at most {most:g})")
    return kept


def at_least(name: str, value: float, least: float) -> bool:
    """Print a figure next to its lower bound and return whether it is reached."""
    kept = value >= least
    print(f"{'ok ' if kept else 'NOT'} {name:42} {value:8.3f}  (at least {least:g})")
    return kept


def median_of_runs(measure: Callable[[], Cost], runs: int) -> Cost:
    """Return the median costs of several runs."""
    return median_cost([measure() for _ in range(runs)])


def median_cost(costs: Sequence[Cost]) -> Cost:
    """Return the median costs."""
    return Cost(
        statistics.median(cost.wall for cost in costs),
        statistics.median(cost.cpu for cost in costs),
    )


def timed(command: Sequence[str], *, stdin: bytes = b"") -> Cost:
    """Run a command and return the cost of its whole process tree."""
    before = machine_cpu()
    begin = time.monotonic()
    done = subprocess.run(
        command, input=stdin, cwd=processes.ROOT, capture_output=True, check=False
    )
    wall = time.monotonic() - begin
    if done.returncode not in (0, 1):
        sys.exit(f"{command} ended with {done.returncode}:\n{done.stderr.decode()[-2000:]}")
    return Cost(wall, machine_cpu() - before)


def machine_cpu() -> float:
    """Return the seconds for which this machine's processors have been busy since boot."""
    with Path("/proc/stat").open() as stream:
        user, nice, system, _, _, irq, softirq = map(int, stream.readline().split()[1:8])
    return (user + nice + system + irq + softirq) / os.sysconf("SC_CLK_TCK")


def verdict_once(sandbox: str = "bubblewrap") -> Cost:
    """Mark once as a user does: in a separate process, with report and terminal text."""
    with tempfile.TemporaryDirectory() as out:
        return timed(processes.grader("grade", SOLUTION, "--sandbox", sandbox, "--out", out))


def containers_overhead(runs: int) -> tuple[Cost, float]:
    """Return a verdict's cost in containers, and the seconds by which it exceeds bubblewrap's.

    The two take turns, so that other load on the machine affects both.
    """
    os.environ[images.REPOSITORY_VARIABLE] = engine.REPOSITORY
    client = images.connect()
    if images.find_image(client, find_distro("jazzy")) is None:
        sys.exit("the images are not here: python -m tests.engine up")
    client.close()
    verdict_once("docker")
    pairs = [(verdict_once("docker"), verdict_once("bubblewrap")) for _ in range(runs)]
    inside = median_cost([docker for docker, _ in pairs])
    return inside, statistics.median(docker.wall - bwrap.wall for docker, bwrap in pairs)


def _shell(ros: Ros, script: str, stdin: bytes = b"") -> Cost:
    with Bubblewrap(ros, Limits()) as sandbox:
        command = sandbox.command(["bash", "-c", script])
        return timed(command, stdin=stdin)


def _tar(submission: Submission) -> bytes:
    from grader.run.workspace import as_tar

    return as_tar(submission, ASSIGNMENT.package)


def bare_build(ros: Ros, submission: Submission) -> Cost:
    """Run `colcon build` alone, in the same sandbox, since it cannot run anywhere else."""
    setup = f". {ros.inside}/setup.bash; tar -xf -; colcon build --symlink-install < /dev/null"
    return _shell(ros, setup, _tar(submission))


def bare_import(ros: Ros) -> Cost:
    """Run a Python that imports rclpy and makes a node: the minimum that the probe needs."""
    code = "import rclpy; rclpy.init(); rclpy.create_node('probe')"
    return _shell(ros, f'. {ros.inside}/setup.bash; python3 -c "{code}"')


def bare_run(ros: Ros, submission: Submission) -> Cost:
    """Run `ros2 run` on a terminal until its node is up, then press Ctrl+C."""
    with Bubblewrap(ros, Limits()) as sandbox:
        build(sandbox, submission, package=ASSIGNMENT.package)
        script = f". {ros.inside}/setup.bash; . install/local_setup.bash; exec "
        script += ros2_run(ros.distro, ASSIGNMENT.package, ASSIGNMENT.executable)
        script += " --ros-args -p use_sim_time:=false"
        before = machine_cpu()
        begin = time.monotonic()
        terminal = Terminal(sandbox.console(["bash", "-c", script]), most=100_000)
        while not terminal.ended and not any("Hello" in line.text for line in terminal.read(10)):
            pass
        up = time.monotonic() - begin - ASSIGNMENT.output.period
        terminal.interrupt()
        terminal.finish(10)
        terminal.close()
    return Cost(up, machine_cpu() - before)


def plain_grader(ros: Ros, submission: Submission) -> Cost:
    """Mark as a simple grader does: build, run, wait for five wall-clock ticks, press Ctrl+C."""
    before = machine_cpu()
    begin = time.monotonic()
    with Bubblewrap(ros, Limits()) as sandbox:
        if build(sandbox, submission, package=ASSIGNMENT.package).status == 0:
            _watch_ticks(sandbox, ros)
    wall = time.monotonic() - begin
    return Cost(wall, machine_cpu() - before)


def _watch_ticks(sandbox: Bubblewrap, ros: Ros) -> None:
    script = f". {ros.inside}/setup.bash; . install/local_setup.bash; exec ros2 run "
    script += f"{ASSIGNMENT.package} {ASSIGNMENT.executable}"
    terminal = Terminal(sandbox.console(["bash", "-c", script]), most=100_000)
    seen = 0
    until = time.monotonic() + PLAIN_LIMIT
    while seen < PLAIN_TICKS and not terminal.ended and time.monotonic() < until:
        seen += sum("Hello time" in line.text for line in terminal.read(1))
    if not terminal.ended:
        terminal.interrupt()
    terminal.finish(10)
    terminal.close()


def starts(ros: Ros, submission: Submission, count: int) -> tuple[list[float], float]:
    """Start the node `count` times; return the seconds to each first line and of a run's ticks."""
    firsts, ticking = [], []
    with Bubblewrap(ros, Limits()) as sandbox:
        build(sandbox, submission, package=ASSIGNMENT.package)
        for _ in range(count):
            probe = ProbeLink(sandbox)
            try:
                run = observe(sandbox, ASSIGNMENT, probe, lambda event: None)
            finally:
                probe.close()
            if run.first_line_seconds is None:
                firsts.append(float("inf"))
                continue
            firsts.append(run.first_line_seconds)
            events = run.watch.counted
            ticking.append(events[-1].wall - events[0].wall)
    return firsts, statistics.median(ticking)


def peak_memory() -> float:
    """Return the peak resident memory of the grader's own process in MB."""
    with tempfile.TemporaryDirectory() as out:
        code = (
            "import sys; from grader.cli.main import main; main(sys.argv[1:]); "
            "from tests.memory import peak_memory; print(peak_memory())"
        )
        command = [sys.executable, "-c", code, "grade", str(SOLUTION), "--out", str(Path(out))]
        done = subprocess.run(
            command,
            cwd=processes.ROOT,
            capture_output=True,
            text=True,
            check=True,
            env={**os.environ, "PYTHONPATH": str(processes.ROOT)},
        )
    return float(done.stdout.split()[-1])


if __name__ == "__main__":
    raise SystemExit(main())
