"""The command that builds and lists the Docker images."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from docker import DockerClient

    from grader.ros.images import Base

DEFAULT_NAME = "jazzy"  # is offered first


@click.command()
@click.option(
    "--distro",
    help="Build the images of this distro; separate several with commas. [default, with --base, "
    "--base-image or --extra-ca: jazzy]",
)
@click.option(
    "--base",
    type=click.Choice(["ros", "wheels"]),
    help="The base: the official ros:<distro>-ros-base, or Debian with PyPI's ROS wheels. [default: "
    "the official one if it can be had, else the wheels]",
)
@click.option("--extra-ca", type=click.Path(path_type=Path), help="A CA certificate (PEM) for pip.")
@click.option("--apt-mirror", default="", metavar="URL", help="The mirror for apt.")
@click.option("--pip-index", default="", metavar="URL", help="The package index for pip.")
@click.option(
    "--base-image",
    default="",
    metavar="IMAGE",
    help="Another image to build on: with ROS at /opt/ros, or a Debian for the wheels.",
)
def images(
    distro: str | None,
    base: Base | None,
    extra_ca: Path | None,
    apt_mirror: str,
    pip_index: str,
    base_image: str,
) -> int:
    """Build the Docker images of a distro (--distro), and list all images with their sizes.

    HTTP_PROXY, HTTPS_PROXY and NO_PROXY are passed to the build.
    """
    from grader.ros.distro import DEFAULT, find_distro  # noqa: PLC0415 - keeps --help fast
    from grader.ros.image_base import choose_base  # noqa: PLC0415
    from grader.ros.image_build import Network, build_image  # noqa: PLC0415
    from grader.ros.images import connect  # noqa: PLC0415

    network = Network(
        apt_mirror=apt_mirror, pip_index=pip_index, extra_ca=extra_ca, base_image=base_image
    )
    # (a mirror and an index may be set for other programs too)
    builds = base is not None or base_image or extra_ca is not None
    names = distro or (DEFAULT if builds else "")
    wanted = [find_distro(word.strip()) for word in names.split(",") if word.strip()]
    network.check()

    def notify(text: object) -> None:
        click.echo(str(text), err=True)

    client = connect(instead="")
    for found in wanted:
        chosen, settings = choose_base(client, found, base, network, notify=notify)
        for stage in ("grade", "lab"):
            build_image(client, found, stage=stage, base=chosen, network=settings, notify=notify)
    _list(client, [found.name for found in wanted])
    return 0


def _list(client: DockerClient, wanted: list[str]) -> None:
    """Print the images that are here, and how the others are built."""
    from grader.ros.images import image_table  # noqa: PLC0415 - keeps --help fast

    rows = [row for row in image_table(client) if not wanted or row.distro in wanted]
    here = [row for row in rows if row.size is not None]
    width = max((len(row.name) for row in here), default=0)
    for row in here:
        click.echo(f"{row.name:<{width}}  {(row.size or 0) / 1e6:>6,.0f} MB  {row.id}")
    others = list(dict.fromkeys(row.distro for row in rows))
    others = [name for name in others if name not in {row.distro for row in here}]
    if others:
        others.sort(key=lambda name: name != DEFAULT_NAME)
        more = f" (or {', '.join(others[1:])})" if others[1:] else ""
        click.echo(f"Build those of a distro: make images DISTRO={others[0]}{more}")
