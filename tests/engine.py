"""The Docker engine and the images for the tests: `python -m tests.engine up [all]`, and `down`.

`up` installs the engine from the system's packages if it is missing (as root), starts it if none
answers, and makes the images on a base made by debootstrap, so that the tests need no registry.
Existing images are kept: a second `up` takes seconds. `down` stops only a daemon that `up` has
started. The tests' images have their own repository.

If no daemon can run, set GRADER_TESTS_WITHOUT_DOCKER=1 so that `make test-all` leaves these tests
out; without it they fail.
"""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
import sysconfig
import time
from pathlib import Path

from docker import DockerClient

from grader.base.cache import cache_root
from grader.base.errors import GraderError, SurroundingsError
from grader.ros import images
from grader.ros.distro import find_distro
from grader.ros.image_build import Network, build_image

ROOT = Path(__file__).resolve().parent.parent
REPOSITORY = "ros2-teaching-lab-tests"
LOCAL_BASE = f"{REPOSITORY}:base"
STANDIN = f"{REPOSITORY}:standin-ros-jazzy"
SUITE = "trixie"
PACKAGES = {
    "dockerd": "docker.io",
    "debootstrap": "debootstrap",
    "docker-compose": "docker-compose",
    "npm": "npm",
    "g++": "g++",  # turtlesim's interfaces are built for the tests in bubblewrap
}
START_SECONDS = 60.0
WITHOUT = "GRADER_TESTS_WITHOUT_DOCKER"


def say(text: str) -> None:
    """Print a progress message to stderr."""
    print(text, file=sys.stderr, flush=True)


def network(base: images.Base) -> Network:
    """Return the network settings of builds, with the CA bundle that pip uses, if any."""
    bundle = os.environ.get("PIP_CERT") or os.environ.get("REQUESTS_CA_BUNDLE")
    under = LOCAL_BASE if base == "wheels" else STANDIN
    return Network(extra_ca=Path(bundle) if bundle else None, base_image=under)


def _state() -> Path:
    return cache_root() / "tests-engine.json"


def install() -> None:
    """Install what is missing, by apt-get, as root."""
    missing = [package for program, package in PACKAGES.items() if not shutil.which(program)]
    if not Path(sysconfig.get_path("include"), "Python.h").is_file():
        missing.append("python3-dev")
    if not missing:
        return
    say(f"installing {' '.join(missing)}")
    environment = {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}
    command = ["apt-get", "install", "-y", "-qq", "--no-install-recommends", *missing, "iptables"]
    for before in ([], ["apt-get", "update", "-qq"]):
        if before:
            subprocess.run(before, env=environment, check=False, stdout=subprocess.DEVNULL)
        done = subprocess.run(
            command, env=environment, check=False, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE
        )
        if done.returncode == 0:
            return
    raise SurroundingsError(
        f"{' '.join(missing)} cannot be installed:\n{done.stderr.decode(errors='replace')[-800:]}"
    )


def start() -> DockerClient:
    """Return a connection to the daemon, started now if none answers."""
    try:
        return images.connect()
    except SurroundingsError as error:
        if "DOCKER_HOST" in os.environ or os.geteuid() != 0:
            raise
        output = error
    say("starting dockerd")
    log = cache_root() / "tests-dockerd.log"
    log.parent.mkdir(parents=True, exist_ok=True)
    with log.open("wb") as stream:
        daemon = subprocess.Popen(
            ["dockerd"], stdout=stream, stderr=stream, start_new_session=True, cwd="/"
        )
    _state().write_text(json.dumps({"pid": daemon.pid}), encoding="utf-8")
    deadline = time.monotonic() + START_SECONDS
    while daemon.poll() is None and time.monotonic() < deadline:
        try:
            return images.connect()
        except SurroundingsError:
            time.sleep(0.2)  # poll its socket, since nothing signals that it is ready
    raise SurroundingsError(
        f"no Docker daemon can run here: {output.message}\n{log.read_text(errors='replace')[-1500:]}",
        remedy=f"Where that is known, {WITHOUT}=1 leaves the tests out that need it.",
    )


def make_images(client: DockerClient, *, every: bool) -> None:
    """Make the base, an image of wheels, the stand-in, and the two images on it.

    `every`: also the lab on wheels and another distro, for the long run.
    """
    base = ROOT / "docker" / "make_base.sh"
    subprocess.run([base, SUITE, LOCAL_BASE], check=True, stdout=sys.stderr)
    jazzy, kilted = find_distro("jazzy"), find_distro("kilted")
    build_image(
        client, jazzy, stage="grade", base="wheels", network=network("wheels"), notify=_steps
    )
    if every:
        build_image(
            client, jazzy, stage="lab", base="wheels", network=network("wheels"), notify=_steps
        )
        build_image(
            client, kilted, stage="grade", base="wheels", network=network("wheels"), notify=_steps
        )
    say(f"building {STANDIN}")
    with (ROOT / "tests" / "docker" / "standin.Dockerfile").open("rb") as dockerfile:
        under = {"BASE": images.image_name(jazzy, "base", "wheels")}
        under |= {"GRADE": images.image_name(jazzy, "grade", "wheels")}
        client.images.build(fileobj=dockerfile, tag=STANDIN, buildargs=under, rm=True)
    build_image(client, jazzy, stage="grade", base="ros", network=network("ros"), notify=_steps)
    build_image(client, jazzy, stage="lab", base="ros", network=network("ros"), notify=_steps)


def _steps(text: str) -> None:
    if not text.startswith(" "):
        say(text)


def up(*, every: bool) -> None:
    """Make everything ready for the tests that need Docker."""
    os.environ[images.REPOSITORY_VARIABLE] = REPOSITORY
    install()
    client = start()
    make_images(client, every=every)
    client.close()


def down() -> None:
    """Stop the daemon that `up` has started, if it has."""
    if not _state().is_file():
        return
    pid = int(json.loads(_state().read_text(encoding="utf-8"))["pid"])
    _state().unlink()
    try:
        running = os.pidfd_open(pid)
        if b"dockerd" not in Path(f"/proc/{pid}/cmdline").read_bytes():
            return
        os.kill(pid, signal.SIGTERM)
    except OSError:
        return  # it has already ended
    import select

    select.select([running], [], [], START_SECONDS)
    say("dockerd is stopped")


def main() -> int:
    """Run `up`, `up all` or `down`."""
    words = sys.argv[1:]
    if words not in (["up"], ["up", "all"], ["down"]):
        say("usage: python -m tests.engine up [all] | down")
        return 2
    try:
        if words == ["down"]:
            down()
        else:
            up(every="all" in words)
    except (GraderError, subprocess.CalledProcessError) as error:
        say(f"tests.engine: {error}")
        return 1
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
