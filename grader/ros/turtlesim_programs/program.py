"""What the programs share: their start, their quiet end, and turtlesim's interfaces."""

from __future__ import annotations

import os
import signal
import sys
import threading
from collections.abc import Callable, Sequence
from importlib import import_module
from pathlib import Path
from typing import Any

import rclpy
from rclpy.exceptions import ParameterException
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.signals import SignalHandlerOptions
from rclpy.utilities import remove_ros_args

PACKAGES = ("turtlesim", "turtlesim_msgs")  # with the interfaces, up to jazzy and later
END_SECONDS = 2.0  # of wall time, for the executor's last callback
LONG_SECONDS = 3_600.0


class End:
    """Whether Ctrl+C or SIGTERM asked for the program's end.

    The signals are blocked and waited for, so that no handler runs between two lines: kilted's
    `ros2 run` sends a second one at once.
    """

    SIGNALS = (signal.SIGINT, signal.SIGTERM)

    def __init__(self) -> None:
        """Block the signals in this thread, and in those that it starts."""
        signal.pthread_sigmask(signal.SIG_BLOCK, self.SIGNALS)
        self._asked = False

    def within(self, seconds: float) -> bool:
        """Return whether the end is asked for; wait so long for it."""
        self._asked = self._asked or signal.sigtimedwait(self.SIGNALS, seconds) is not None
        return self._asked

    def wait(self) -> None:
        """Wait until the end is asked for."""
        while not self.within(LONG_SECONDS):
            pass

    @staticmethod
    def ask() -> None:
        """Ask for the end, from any thread."""
        os.kill(os.getpid(), signal.SIGTERM)


Run = Callable[[Any, End], None]
"""Runs a node until its end; the node's callbacks run in another thread."""


def interfaces(kind: str) -> Any:
    """Return the module of turtlesim's `msg`, `srv` or `action`; raises ImportError."""
    for package in PACKAGES:
        try:
            return import_module(f"{package}.{kind}")
        except ImportError:
            continue
    raise ImportError("ROS has no interfaces of turtlesim")


class Turns(SingleThreadedExecutor):  # type: ignore[misc]
    """An executor that holds a lock while it runs a callback."""

    def __init__(self, lock: Any) -> None:
        super().__init__()
        self._turn = lock

    def wait_for_ready_callbacks(self, *words: Any, **named: Any) -> Any:
        """Return the next callback, its entity and node, as the executor's own method does."""
        callback, entity, node = super().wait_for_ready_callbacks(*words, **named)
        return _InTurn(callback, self._turn), entity, node


class _InTurn:
    def __init__(self, callback: Any, lock: Any) -> None:
        self._callback, self._lock = callback, lock

    def __call__(self) -> None:
        with self._lock:
            self._callback()

    def __getattr__(self, name: str) -> Any:
        return getattr(self._callback, name)


def start(name: str, run: Run, lock: Any = None) -> int:
    """Run the node `name` with the program's arguments; return the exit status.

    Ctrl+C and SIGTERM end it quietly, however often they come. What is wrong with the arguments
    is told in one line.
    """
    end = End()
    try:
        rclpy.init(args=sys.argv, signal_handler_options=SignalHandlerOptions.NO)
        _refuse(remove_ros_args(sys.argv)[1:])
        node = rclpy.create_node(name)
    except Exception as error:  # of the arguments: ROS has many types for it
        return _refused(error)
    executor = Turns(lock or threading.Lock())
    executor.add_node(node)
    callbacks = threading.Thread(target=_spin, args=(executor, end), daemon=True)
    callbacks.start()
    try:
        run(node, end)
    except ParameterException as error:
        return _refused(error)
    finally:
        rclpy.try_shutdown()
        callbacks.join(END_SECONDS)
    return 0


def _refused(error: Exception) -> int:
    print(f"{Path(sys.argv[0]).name}: {' '.join(str(error).split())}", file=sys.stderr)
    return 1


def _refuse(words: Sequence[str]) -> None:
    if words:
        what = " ".join(words)
        raise ValueError(f"unknown arguments: {what} (those of ROS stand after --ros-args)")


def _spin(executor: Turns, end: End) -> None:
    """Run the callbacks; an error in one ends the program, with its traceback."""
    try:
        executor.spin()
    except ExternalShutdownException:
        return
    finally:
        end.ask()
