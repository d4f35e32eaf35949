"""The command that builds and lists the Docker images."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from grader.ros.images import Base


@click.command()
@click.option("--distro", help="Build the images of this distro; separate several with commas.")
@click.option(
    "--base",
    type=click.Choice(["ros", "wheels"]),
    default="ros",
    show_default=True,
    help="The base: the official ros:<distro>-ros-base, or PyPI's ROS wheels.",
)
@click.option("--extra-ca", type=click.Path(path_type=Path), help="A CA certificate (PEM) for pip.")
@click.option("--apt-mirror", default="", metavar="URL", help="The mirror for apt.")
@click.option("--pip-index", default="", metavar="URL", help="The package index for pip.")
@click.option("--base-image", default="", metavar="IMAGE", help="Another base image.")
def images(
    distro: str | None,
    base: Base,
    extra_ca: Path | None,
    apt_mirror: str,
    pip_index: str,
    base_image: str,
) -> int:
    """Build the Docker images of a distro (--distro), and list all images with their sizes.

    HTTP_PROXY, HTTPS_PROXY and NO_PROXY are passed to the build.
    """
    from grader.ros.distro import find_distro  # noqa: PLC0415 - keeps --help fast
    from grader.ros.image_build import Network, build_image  # noqa: PLC0415
    from grader.ros.images import connect, image_table  # noqa: PLC0415

    wanted = [find_distro(word.strip()) for word in (distro or "").split(",") if word.strip()]
    network = Network(apt_mirror=apt_mirror, pip_index=pip_index, extra_ca=extra_ca)
    if base_image:
        network = replace(network, wheels_base=base_image, ros_base=base_image)
    client = connect(instead="")
    for found in wanted:
        for stage in ("grade", "lab"):
            build_image(
                client,
                found,
                stage=stage,
                base=base,
                network=network,
                notify=lambda text: click.echo(text, err=True),
            )
    rows = [
        row for row in image_table(client) if not wanted or row.distro in {d.name for d in wanted}
    ]
    width = max(len(row.name) for row in rows)
    for row in rows:
        size = f"{row.size / 1e6:,.0f} MB" if row.size is not None else "not here"
        click.echo(f"{row.name:<{width}}  {size:>10}  {row.id}".rstrip())
    return 0
