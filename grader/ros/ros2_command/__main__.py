"""Let ``python -m wheels_ros2`` be the same as ``ros2``."""

from .cli import main

if __name__ == "__main__":
    raise SystemExit(main())
