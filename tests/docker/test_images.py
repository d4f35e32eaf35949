"""The images match docs/images.md, and a failed build has a helpful message."""

from __future__ import annotations

import io
import shutil
import subprocess
import sys
import tarfile
from pathlib import Path

import certifi
import pytest
from docker import DockerClient
from docker.models.images import Image

from grader.base.errors import SurroundingsError, UsageError
from grader.ros import images
from grader.ros.distro import distros, find_distro
from grader.ros.image_build import Network, build_image, is_ignored
from tests import engine, processes
from tests.docker.layers import Layers, certificates_in, layers_of

pytestmark = [pytest.mark.docker]
NAMES = ("grade-jazzy", "lab-jazzy", "grade-jazzy-wheels")
LATER = ("lab-jazzy-wheels", "grade-kilted-wheels")  # made for the long run only
ALL = (*NAMES, *(pytest.param(name, marks=pytest.mark.long) for name in LATER))
DOCKERFILES = ("docker/Dockerfile", "docker/wheels.Dockerfile", "tests/docker/standin.Dockerfile")


@pytest.fixture(params=ALL)
def image(request: pytest.FixtureRequest, client: DockerClient) -> Image:
    """Each image of the tests."""
    return client.images.get(f"{engine.REPOSITORY}:{request.param}")


@pytest.fixture(scope="module", params=ALL)
def layers(request: pytest.FixtureRequest) -> Layers:
    """The layers of each image of the tests."""
    opened = images.connect()
    try:
        return layers_of(opened.images.get(f"{engine.REPOSITORY}:{request.param}"))
    finally:
        opened.close()


def output_of(client: DockerClient, image: Image, script: str) -> str:
    """Return the output of a script in a container of the image, run as the image's user."""
    out: bytes = client.containers.run(str(image.id), ["bash", "-c", script], remove=True)
    return out.decode()


@pytest.mark.parametrize("dockerfile", DOCKERFILES)
def test_the_linter_finds_nothing(dockerfile: str) -> None:
    hadolint = Path(sys.executable).with_name("hadolint")
    done = processes.run([hadolint, processes.ROOT / dockerfile])
    assert (done.returncode, done.stdout) == (0, "")


def test_no_file_needs_buildkit() -> None:
    for dockerfile in DOCKERFILES:
        text = (processes.ROOT / dockerfile).read_text()
        assert not text.lower().startswith("# syntax")
        assert "--mount" not in text
        assert "<<" not in text


def test_an_image_has_labels_that_describe_it(image: Image) -> None:
    stage_name, distro, *wheels = image.tags[0].partition(":")[2].split("-")
    assert image.labels["ros2-teaching-lab.distro"] == distro
    assert image.labels["ros2-teaching-lab.stage"] == stage_name
    assert image.labels["ros2-teaching-lab.ros"] == ("wheels" if wheels else "image")
    for name in ("title", "description", "version", "licenses", "base.name"):
        assert image.labels[f"org.opencontainers.image.{name}"]


def test_nothing_runs_as_root_and_nobody_can_become_it(client: DockerClient, image: Image) -> None:
    assert image.attrs["Config"]["User"] == "1000:1000"
    output = output_of(
        client, image, "id -un; id -u; pwd; command -v sudo; getent passwd 1001 1002"
    )
    lines = output.splitlines()
    assert lines[:3] == ["student", "1000", "/home/student/ros2_ws"]
    assert [line.split(":")[0] for line in lines[3:]] == ["probe", "holder"]
    writable = output_of(client, image, "find / -xdev -type f -perm -4000 -newer /etc/passwd; true")
    assert writable == ""  # none of our files is set-user-id


def test_no_image_contains_a_solution_or_a_hidden_check(layers: Layers) -> None:
    names = layers.names
    assert not [name for name in names if "keys" in Path(name).parts and "grader" in name]
    assert not [name for name in names if name.endswith(("hidden.yaml", "mutants.yaml"))]
    solution = processes.ROOT / "grader" / "keys" / "hello_time" / "solution"
    own = {path.name for path in solution.rglob("*.py")} - {"__init__.py", "setup.py"}
    assert own
    assert not [name for name in names if Path(name).name in own]


def test_no_layer_contains_the_extra_certificate(layers: Layers) -> None:
    names = layers.names
    assert not [name for name in names if "extra.crt" in name or "ca-certificates/docker" in name]
    extra = engine.network().extra_ca
    given = certificates_in(extra.read_bytes()) if extra else frozenset()
    public = certificates_in(Path(certifi.where()).read_bytes())  # from pip's packages
    assert not (given - public) & layers.certificates


def test_ros_is_where_the_tutorial_expects_it(client: DockerClient, image: Image) -> None:
    distro = image.labels["ros2-teaching-lab.distro"]
    script = f". /opt/ros/{distro}/setup.bash && ros2 pkg prefix rclpy && colcon --help > /dev/null"
    assert output_of(client, image, script).strip() == f"/opt/ros/{distro}"
    # (the wheel of 7.1.6 contains the manifest of 7.1.5, and the stand-in has no other)
    major, minor, _ = find_distro(distro).rclpy.split(".")
    assert images.image_versions(client, image)["rclpy"].startswith(f"{major}.{minor}.")


def test_the_lab_has_what_a_student_needs(client: DockerClient) -> None:
    lab = client.images.get(f"{engine.REPOSITORY}:lab-jazzy")
    programs = "nano vi less man git ps"
    script = f"for p in {programs}; do command -v $p > /dev/null || echo no $p; done; man -w ls"
    assert output_of(client, lab, script).splitlines() == ["/usr/share/man/man1/ls.1.gz"]


def test_the_build_context_has_no_keys_and_no_generated_files() -> None:
    rules = (processes.ROOT / ".dockerignore").read_text().splitlines()
    for name in ("grader/keys/hello_time/solution/x.py", "README.md", ".git/config",
                 "grader/__pycache__/x.pyc", "tests/processes.py", ".venv/bin/python"):  # fmt: skip
        assert is_ignored(name, rules), name
    for name in (
        "grader/cli/main.py",
        "lab/shell/bashrc",
        "docker/ca/README.md",
        "grader/ros/x.toml",
    ):
        assert not is_ignored(name, rules), name


def test_docker_itself_interprets_the_ignore_file_the_same_way(
    client: DockerClient, tmp_path: Path
) -> None:
    """The docker command's build context has no file that ours would leave out."""
    dockerfile = tmp_path / "Dockerfile"
    dockerfile.write_text("FROM scratch\nCOPY . /context\n")
    tag = f"{engine.REPOSITORY}:context-{tmp_path.name.lower()[-20:].strip('-_')}"
    docker = shutil.which("docker")
    assert docker is not None
    command = [docker, "build", "-q", "-f", dockerfile, "-t", tag, processes.ROOT]
    done = subprocess.run(
        [str(word) for word in command], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    try:
        rules = (processes.ROOT / ".dockerignore").read_text().splitlines()
        names = context_of(client, tag)
        assert "grader/cli/main.py" in names
        assert [name for name in names if is_ignored(name, rules)] == []
    finally:
        client.images.remove(tag, force=True)


def context_of(client: DockerClient, tag: str) -> set[str]:
    container = client.api.create_container(tag, ["none"])["Id"]
    try:
        packed, _ = client.api.get_archive(container, "/context")
        with tarfile.open(fileobj=io.BytesIO(b"".join(packed))) as archive:
            return {
                member.name.partition("/")[2] for member in archive.getmembers() if member.isfile()
            }
    finally:
        client.api.remove_container(container)


def test_a_distro_without_wheels_has_no_wheels_image(client: DockerClient) -> None:
    with pytest.raises(UsageError) as caught:
        build_image(
            client,
            find_distro("humble"),
            stage="grade",
            base="wheels",
            network=Network(),
            notify=lambda text: None,
        )
    assert "BASE=ros" in caught.value.remedy


def test_an_unavailable_base_image_is_reported_with_a_fix(client: DockerClient) -> None:
    with pytest.raises(SurroundingsError) as caught:
        build_image(
            client,
            find_distro("lyrical"),
            stage="grade",
            base="ros",
            network=Network(ros_base="registry.invalid/ros:lyrical-ros-base"),
            notify=lambda text: None,
        )
    assert "make_base.sh" in caught.value.remedy
    assert "BASE=wheels" in caught.value.remedy


def test_an_invalid_certificate_is_refused(client: DockerClient, tmp_path: Path) -> None:
    (tmp_path / "not.pem").write_text("hello")
    for file in (tmp_path / "not.pem", tmp_path / "missing.pem"):
        with pytest.raises(UsageError, match=file.name):
            build_image(
                client,
                find_distro("jazzy"),
                stage="grade",
                base="wheels",
                network=Network(extra_ca=file),
                notify=lambda text: None,
            )


def test_a_second_build_uses_the_cache(client: DockerClient) -> None:
    """Also on the official image, whose entry point is a problem for the classic builder."""
    lines: list[str] = []
    made = [
        build_image(
            client,
            find_distro("jazzy"),
            stage="grade",
            base="ros",
            network=engine.network(),
            notify=lines.append,
        )
        for _ in range(2)
    ]
    assert made[0] == made[1]
    assert [line for line in lines if "ENTRYPOINT" in line]


def test_every_distro_has_its_rows_in_the_table(client: DockerClient) -> None:
    rows = images.image_table(client)
    assert {row.distro for row in rows} == set(distros())
    here = {row.name for row in rows if row.size}
    assert here >= {f"{engine.REPOSITORY}:{name}" for name in NAMES}


def test_an_image_that_is_missing_and_cannot_be_made_is_exit_3() -> None:
    solution = (
        processes.ROOT / "grader" / "keys" / "hello_time" / "solution" / "my_robot_controller"
    )
    command = processes.grader("grade", solution, "--sandbox", "docker", "--distro", "humble")
    done = processes.run(command, env={"GRADER_IMAGES": "ros2-teaching-lab-none"}, timeout=300)
    assert done.returncode == 3
    assert "cannot build ros2-teaching-lab-none:grade-humble" in done.stderr
    assert "Traceback" not in done.stderr
