"""The wheels' `ros2` command, against recordings of the real one."""
