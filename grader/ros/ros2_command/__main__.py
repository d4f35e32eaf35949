"""Make ``python -m wheels_ros2`` equivalent to ``ros2``."""

from .cli import program

if __name__ == "__main__":
    program()
