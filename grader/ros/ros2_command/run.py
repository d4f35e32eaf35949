"""Run a package specific executable.

Sources: ros2run 0.32.2 and, for kilted, ros2cli#899 (forwards signals since 0.38.0).
"""

from __future__ import annotations

import os
import signal
import subprocess
from argparse import REMAINDER

from . import distro
from .ament_index import package_executables

TYPE_CHECKING = False
if TYPE_CHECKING:
    from argparse import Namespace
    from types import FrameType

    from .parsing import Parser, Result


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 run`."""
    parser.add_argument(
        "--prefix",
        help="Prefix command, which should go before the executable. Command must be wrapped in "
        "quotes if it contains spaces (e.g. --prefix 'gdb -ex run --args').",
    )
    parser.add_argument("package_name", help="Name of the ROS package")
    parser.add_argument("executable_name", help="Name of the executable")
    parser.add_argument("argv", nargs=REMAINDER, help="Pass arbitrary arguments to the executable")


def main(args: Namespace) -> Result:
    """Run the executable until it ends and return its status, negative for a signal.

    Raises OSError if the program cannot be started (a `--prefix` that does not exist, a script
    without shebang) or no ROS environment was sourced: the real command does not catch it either. A
    script whose Python is gone is told in three lines, which the real command does not either.
    """
    paths = package_executables(args.package_name)
    if paths is None:
        from . import absent  # noqa: PLC0415 (it would delay the child)

        return absent.package(args.package_name) or f"Package '{args.package_name}' not found"
    paths = [path for path in paths if os.path.basename(path) == args.executable_name]  # noqa: PTH119
    if not paths:
        return "No executable found"
    if len(paths) > 1:
        return "\n- ".join(["Multiple executables found:", *paths])
    try:
        return run([*_words(args.prefix), paths[0], *args.argv])
    except FileNotFoundError:
        from . import first_line  # noqa: PLC0415 (it would delay the child)

        gone = "" if args.prefix else first_line.missing_program(paths[0])
        if not gone:
            raise
        return first_line.REBUILD.format(path=paths[0], program=gone)


def run(command: list[str]) -> int:
    """Start a command, wait for its end, and print on stdout how it failed if it did.

    Ctrl+C on a terminal reaches the whole foreground process group, including the child, so the
    wait continues. In kilted SIGINT and SIGTERM are also forwarded to the child, which then gets
    two SIGINTs for one Ctrl+C.

    Returns the child's status, -N if signal N ended it. Raises OSError as `main` does.
    """
    child = subprocess.Popen(command)
    if distro.is_kilted():
        _forward_signals(child)
    _outlive(child)
    if -child.returncode in signal.valid_signals():
        print("[ros2run]:", signal.strsignal(-child.returncode))
    elif child.returncode != 0:
        print(f"[ros2run]: Process exited with failure {child.returncode}")
    return child.returncode


def _outlive(child: subprocess.Popen[bytes]) -> None:
    """Wait for the child's end, through any number of KeyboardInterrupts.

    ros2cli calls communicate() again after each KeyboardInterrupt. On a busy machine the child's
    end and the interrupt coincide, the status is lost with the interrupted call, and subprocess
    reports 0. Here the end is awaited first, and the status fetched after that.
    """
    while child.returncode is None:
        try:
            os.waitid(os.P_PID, child.pid, os.WEXITED | os.WNOWAIT)
            signal.signal(signal.SIGINT, signal.SIG_IGN)
            child.wait()
        except KeyboardInterrupt:
            continue
        except ChildProcessError:  # reaped already: by poll(), or because SIGCHLD is ignored
            child.wait()


def _forward_signals(child: subprocess.Popen[bytes]) -> None:
    def forward(number: int, _frame: FrameType | None) -> None:
        # not print(): a second signal may come while it writes, and it cannot be called again then
        os.write(1, f"[ros2run]: Received signal:  {signal.strsignal(number)}\n".encode())
        if child.poll() is None:
            child.send_signal(number)

    signal.signal(signal.SIGINT, forward)
    signal.signal(signal.SIGTERM, forward)


def _words(prefix: str | None) -> list[str]:
    if prefix is None:
        return []
    import shlex  # noqa: PLC0415 (rarely used, and it delays the child)

    return shlex.split(prefix)
