"""Builds the Docker images with the Docker SDK, without the `docker` command."""

from __future__ import annotations

import io
import os
import re
import tarfile
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from fnmatch import fnmatch
from pathlib import Path
from typing import IO, TYPE_CHECKING

import grader
from grader.base.cache import Notify
from grader.base.errors import SurroundingsError, UsageError
from grader.base.project import CHECKOUT, SHARES
from grader.ros.distro import Distro
from grader.ros.images import ROS_LABEL, Base, Stage, image_name

if TYPE_CHECKING:
    from docker import DockerClient

WHEELS_BASE = "debian:trixie-slim"
PROXIES = ("HTTP_PROXY", "HTTPS_PROXY", "NO_PROXY", "http_proxy", "https_proxy", "no_proxy")
CONTEXT = ("docker", "grader", "lab", ".dockerignore")
STEP = re.compile(r"^Step (\d+/\d+) : (\S+) *(.*)")
COLOUR = re.compile(r"\x1b\[[0-9;]*m")
TAIL = 12  # lines of output in an error message


@dataclass(frozen=True)
class Network:
    """The network settings of a build.

    `extra_ca` is a PEM file that only builder stages see. `base_image` is another image to build
    on than the official one, or than Debian's for the wheels (a local one, or a digest).
    """

    apt_mirror: str = ""
    pip_index: str = ""
    extra_ca: Path | None = None
    base_image: str = ""

    def check(self) -> None:
        """Raise UsageError if the extra certificate cannot be read or is none."""
        if self.extra_ca is not None:
            _certificates(self.extra_ca)

    def arguments(self) -> dict[str, str]:
        """Return the build arguments, including the proxies of this process' environment."""
        own = {"APT_MIRROR": self.apt_mirror, "PIP_INDEX_URL": self.pip_index}
        proxies = {name: os.environ[name] for name in PROXIES if os.environ.get(name)}
        return proxies | {name: value for name, value in own.items() if value}


def build_image(
    client: DockerClient,
    distro: Distro,
    *,
    stage: Stage,
    base: Base,
    network: Network,
    notify: Notify,
) -> str:
    """Build an image (and its wheels base), tag it, and return its id.

    `choose_base` chooses the base, whose image has to be there. Raises SurroundingsError if the build
    fails, UsageError if the extra certificate is none.
    """
    arguments = {**network.arguments(), "DISTRO": distro.name, "VERSION": grader.__version__}
    if base == "wheels":
        under = image_name(distro, "base", "wheels")
        build = {**arguments, "WHEELS_BASE": network.base_image or WHEELS_BASE}
        _build(client, "docker/wheels.Dockerfile", "wheels", under, build, network, notify)
        arguments |= {"BASE": under, "ROS": "wheels"}
    else:
        arguments |= {"BASE": network.base_image or distro.pinned_image, "ROS": "image"}
    name = image_name(distro, stage, base)
    made = _build(client, "docker/Dockerfile", stage, name, arguments, network, notify)
    if base == "wheels":
        _name_as_only_one(client, made, image_name(distro, stage, "ros"))
    return made


def _name_as_only_one(client: DockerClient, made: str, official: str) -> None:
    """Give an image on wheels the name without a suffix too, unless an official one has it.

    compose cannot look for images: it finds the one with this name, or makes it.
    """
    import docker.errors  # noqa: PLC0415

    try:
        has_it = client.images.get(official).labels.get(ROS_LABEL) != "wheels"
    except docker.errors.ImageNotFound:
        has_it = False
    if not has_it:
        client.images.get(made).tag(official)


def _build(
    client: DockerClient,
    dockerfile: str,
    target: str,
    name: str,
    arguments: dict[str, str],
    network: Network,
    notify: Notify,
) -> str:
    import docker.errors  # noqa: PLC0415

    notify(f"building {name} (the first time takes a few minutes)")
    tail: list[str] = []
    try:
        with tempfile.TemporaryFile() as context:
            _pack(context, network)
            context.seek(0)
            lines = client.api.build(
                fileobj=context,
                custom_context=True,
                dockerfile=dockerfile,
                target=target,
                tag=name,
                buildargs=arguments,
                rm=True,
                forcerm=True,
                decode=True,
            )
            for text in _texts(lines):
                tail = [*tail[1 - TAIL :], text]
                step = STEP.match(text)
                if step:
                    notify(f"  {step.group(1)} {step.group(2)} {step.group(3)[:70]}".rstrip())
        return str(client.images.get(name).id)
    except _BuildError as error:
        raise _failed(name, str(error), tail) from None
    except (docker.errors.DockerException, OSError) as error:
        raise _failed(name, str(error), tail) from None


class _BuildError(Exception):
    """A build step failed; the message is the daemon's."""


def _texts(lines: Iterator[dict[str, object]]) -> Iterator[str]:
    for line in lines:
        if "error" in line:
            raise _BuildError(plain(str(line["error"])))
        text = plain(str(line.get("stream") or line.get("status") or ""))
        if text:
            yield text


def plain(text: str) -> str:
    """Return a text of the daemon without colours: the classic builder's for what is on stderr."""
    return COLOUR.sub("", text).strip()


def _failed(name: str, said: str, tail: list[str]) -> SurroundingsError:
    words = "\n".join([*tail, said])
    if "no space left" in words:
        remedy = "Free some disk space for Docker: `docker system df` shows what uses it."
    else:
        remedy = (
            "Check the network (HTTPS_PROXY, APT_MIRROR, EXTRA_CA=file.pem; docs/images.md), then "
            "run the command again; finished steps are cached."
        )
    return SurroundingsError(f"cannot build {name}:\n{words}", remedy=remedy)


def root() -> Path:
    """Return the folder of the build context: this checkout, or the installed share."""
    found = next(
        (place for place in (CHECKOUT, *SHARES) if (place / "docker" / "Dockerfile").is_file()),
        None,
    )
    if found is None:
        raise SurroundingsError(
            "the Dockerfiles are missing", remedy="Build images from a checkout of the project."
        )
    return found


def _pack(stream: IO[bytes], network: Network) -> None:
    """Write the build context: the files that .dockerignore admits, and the extra certificate."""
    folder = root()
    rules = (folder / ".dockerignore").read_text(encoding="utf-8").splitlines()
    with tarfile.open(fileobj=stream, mode="w") as archive:
        for top in CONTEXT:
            for path in sorted([folder / top, *(folder / top).rglob("*")]):
                name = path.relative_to(folder).as_posix()
                dockerfile = top in ("docker", ".dockerignore") and path.is_file()
                if not path.is_dir() and (dockerfile or not is_ignored(name, rules)):
                    archive.add(path, name, recursive=False, filter=_anonymous)
        if network.extra_ca is not None:
            _add(archive, "docker/ca/extra.crt", _certificates(network.extra_ca))


def is_ignored(name: str, rules: list[str]) -> bool:
    """Whether .dockerignore excludes a file; the last matching rule decides."""
    ignored = False
    folders = [name, *(parent.as_posix() for parent in Path(name).parents)]
    for rule in rules:
        pattern = rule.strip().removeprefix("!")
        if not pattern or pattern.startswith("#"):
            continue
        patterns = {pattern, pattern.removeprefix("**/")}
        if any(fnmatch(folder, each) for folder in folders for each in patterns):
            ignored = not rule.startswith("!")
    return ignored


def _certificates(file: Path) -> bytes:
    try:
        data = file.read_bytes()
    except OSError as error:
        raise UsageError(f"cannot read the certificate {file}: {error.strerror}") from None
    if b"-----BEGIN CERTIFICATE-----" not in data:
        raise UsageError(f"{file} is not a certificate in PEM format")
    return data


def _anonymous(entry: tarfile.TarInfo) -> tarfile.TarInfo:
    """Remove owner and time, so that the build cache compares only contents."""
    entry.uid = entry.gid = entry.mtime = 0
    entry.uname = entry.gname = ""
    entry.mode = 0o755 if entry.mode & 0o100 else 0o644
    return entry


def _add(archive: tarfile.TarFile, name: str, data: bytes) -> None:
    entry = tarfile.TarInfo(name)
    entry.size, entry.mode = len(data), 0o644
    archive.addfile(entry, io.BytesIO(data))
