"""The command that makes a ROS prefix."""

from __future__ import annotations

import click


@click.command()
@click.option("--distro", default="jazzy", show_default=True)
def prefix(distro: str) -> int:
    """Make the ROS prefix of a distro from PyPI's wheels unless it exists, and print its path."""
    from grader.ros.distro import find_distro  # noqa: PLC0415 - keeps --help fast
    from grader.ros.prefix import wheels_prefix  # noqa: PLC0415
    from grader.sandbox.proof import prove_ros  # noqa: PLC0415

    found = wheels_prefix(
        find_distro(distro), prove=prove_ros, notify=lambda text: click.echo(text, err=True)
    )
    click.echo(found)
    return 0
