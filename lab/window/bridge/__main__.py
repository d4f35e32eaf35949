"""Runs the bridge under the Python of a ROS installation, by its path."""

import os
import sys

# by its path, the folder of this file would be searched first, whose `graph` is no module of ROS
sys.path[0] = os.path.dirname(
    os.path.dirname(os.path.dirname(os.path.dirname(os.path.realpath(__file__))))
)

from lab.window.bridge.program import main

if __name__ == "__main__":
    main()
