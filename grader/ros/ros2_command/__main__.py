"""Make ``python -m wheels_ros2`` equivalent to ``ros2``."""

from .cli import main

if __name__ == "__main__":
    raise SystemExit(main())
