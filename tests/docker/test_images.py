"""The images match docs/images.md, and a failed build has a helpful message."""

from __future__ import annotations

import io
import os
import shutil
import subprocess
import sys
import tarfile
from dataclasses import replace
from pathlib import Path
from typing import Any

import certifi
import pytest
from docker import DockerClient
from docker.models.images import Image

from grader.base.errors import SurroundingsError, UsageError
from grader.ros import image_base, image_build, images
from grader.ros.distro import distros, find_distro
from grader.ros.image_build import Network, build_image, is_ignored
from tests import engine, processes
from tests.docker import checkout
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
    stage_name, distro, *wheels = max(image.tags, key=len).partition(":")[2].split("-")
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
    extra = engine.network("ros").extra_ca
    given = certificates_in(extra.read_bytes()) if extra else frozenset()
    public = certificates_in(Path(certifi.where()).read_bytes())  # from pip's packages
    assert not (given - public - layers.public) & layers.certificates


def test_ros_is_where_the_tutorial_expects_it(client: DockerClient, image: Image) -> None:
    distro = image.labels["ros2-teaching-lab.distro"]
    script = f". /opt/ros/{distro}/setup.bash && ros2 pkg prefix rclpy && colcon --help > /dev/null"
    assert output_of(client, image, script).strip() == f"/opt/ros/{distro}"
    # (the wheel of 7.1.6 contains the manifest of 7.1.5, and the stand-in has no other)
    major, minor, _ = find_distro(distro).rclpy.split(".")
    assert images.image_versions(client, image)["rclpy"].startswith(f"{major}.{minor}.")


USED = r"""
for p in nano vi vim less man git ssh ps; do command -v $p > /dev/null || echo no $p; done
man -w ls
python3 -m venv --system-site-packages /tmp/v && /tmp/v/bin/pip --version | cut -d ' ' -f 1
/tmp/v/bin/python -c 'import rclpy; print(rclpy.__name__)'
grep -c 'BEGIN CERTIFICATE' /etc/ssl/certs/ca-certificates.crt | grep -q '^[0-9][0-9]' && echo certificates
touch /tmp/a.py; vim -T dumb --not-a-term /tmp/a.py > /dev/null 2>&1 \
  -c 'redir! > /tmp/said | echo &syntax &expandtab &shiftwidth &autoindent | redir END | qa!'
tail -n 1 /tmp/said; echo
grep -c '^set \(tabstospaces\|autoindent\|tabsize 4\)' /etc/nanorc
"""


def test_the_lab_has_what_a_student_needs(client: DockerClient) -> None:
    """Programs, man pages, a venv that sees ROS, certificates for git, and editors for Python."""
    lab = client.images.get(f"{engine.REPOSITORY}:lab-jazzy")
    assert output_of(client, lab, USED).splitlines() == [
        *("/usr/share/man/man1/ls.1.gz", "pip", "rclpy", "certificates", "python 1 4 1", "3")
    ]


def test_a_students_image_has_nothing_for_marking_a_class(layers: Layers) -> None:
    """Nor the parts of packages that nobody needs, in no layer."""
    ours = "opt/ros2_teaching_lab/"
    for unwanted in ("grader/batch", "grader/publish", "grader/validate", "grader/keys"):
        assert not [name for name in layers.names if name.startswith(ours + unwanted)]
    assert not [name for name in layers.names if name.startswith(ours) and "/docutils/" in name]
    assert not [name for name in layers.names if name.endswith("/test.key")]


@pytest.mark.parametrize(
    ("name", "most"),
    [("grade-jazzy-wheels", 700), pytest.param("lab-jazzy-wheels", 900, marks=pytest.mark.long)],
)
def test_an_image_on_wheels_is_small(name: str, most: int, client: DockerClient) -> None:
    found = client.images.get(f"{engine.REPOSITORY}:{name}")
    assert found.attrs["Size"] < most * 1_000_000


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


NO_REGISTRY = "registry.invalid/ros:base"


def choose(client: DockerClient, name: str, **wishes: Any) -> tuple[images.Base, str, str]:
    """Return the base that is chosen where no registry answers, its image, and what was said."""
    said: list[str] = []
    distro = replace(find_distro(name), image=NO_REGISTRY)
    wanted, network = wishes.pop("base", None), Network(**wishes)
    base, chosen = image_base.choose_base(
        client, distro, wanted, network, notify=lambda text: said.append(str(text))
    )
    return base, chosen.base_image, "\n".join(said)


def test_without_a_registry_the_wheels_are_chosen(client: DockerClient) -> None:
    """On the Debian that was made before; see test_a_debian_is_made_where_none_can_be_had."""
    base, image, said = choose(client, "jazzy")
    assert (base, image) == ("wheels", f"{engine.REPOSITORY}:base")
    assert f"{NO_REGISTRY} cannot be had: " in said
    assert choose(client, "jazzy", base="wheels")[:2] == (base, image)


def test_a_base_image_of_ones_own_is_looked_into(client: DockerClient) -> None:
    assert choose(client, "jazzy", base_image=engine.STANDIN)[:2] == ("ros", engine.STANDIN)
    assert choose(client, "jazzy", base_image=engine.LOCAL_BASE)[0] == "wheels"
    with pytest.raises(SurroundingsError, match=r"base image registry\.invalid/own cannot be had"):
        choose(client, "jazzy", base_image="registry.invalid/own")


def test_what_cannot_be_had_is_reported_with_the_whole_command_that_helps(
    client: DockerClient,
) -> None:
    with pytest.raises(SurroundingsError, match="cannot be had") as caught:
        choose(client, "jazzy", base="ros")
    assert "make images DISTRO=jazzy BASE=wheels" in caught.value.remedy
    with pytest.raises(SurroundingsError) as caught:
        choose(client, "humble")
    assert "make images DISTRO=humble BASE_IMAGE=name" in caught.value.remedy
    assert "BASE=wheels" not in caught.value.remedy, "which humble does not have"
    with pytest.raises(UsageError) as refused:
        choose(client, "humble", base="wheels")
    assert "make images DISTRO=humble BASE=ros" in refused.value.remedy


def test_a_debian_is_made_where_none_can_be_had(
    client: DockerClient, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """By make_base.sh; here it is stopped by a mirror that is none, before it fetches anything."""
    monkeypatch.setenv(images.REPOSITORY_VARIABLE, "ros2-teaching-lab-none")
    monkeypatch.setattr(image_base, "WHEELS_BASE", NO_REGISTRY)
    with pytest.raises(SurroundingsError, match="no Debian can be made") as caught:
        choose(client, "jazzy", apt_mirror="http://127.0.0.1:9/debian")
    assert "Is http://127.0.0.1:9/debian the right mirror" in caught.value.message
    monkeypatch.setattr(os, "geteuid", lambda: 1000)
    with pytest.raises(SurroundingsError) as caught:
        choose(client, "jazzy")
    assert "sudo " in caught.value.remedy
    assert "docker/make_base.sh trixie ros2-teaching-lab-none:base" in caught.value.remedy


def test_make_images_leads_on_from_an_empty_list(client: DockerClient) -> None:
    command = processes.grader("images")
    done = processes.run(command, env={"GRADER_IMAGES": "ros2-teaching-lab-none"})
    assert done.returncode == 0
    offered = (
        "Build those of a distro: make images DISTRO=jazzy (or humble, kilted, lyrical, rolling)"
    )
    assert done.stdout.splitlines() == [offered]


@pytest.mark.parametrize("file", ["not.pem", "missing.pem"])
def test_a_wrong_certificate_is_refused_without_a_distro_too(file: str, tmp_path: Path) -> None:
    (tmp_path / "not.pem").write_text("hello")
    done = processes.run(processes.grader("images", "--extra-ca", tmp_path / file))
    assert done.returncode == 2
    assert file in done.stderr


def test_a_failed_step_is_shown_without_the_colours_of_the_builder(
    client: DockerClient, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """The classic builder paints what a step writes on stderr: as \\x1b[91m in our message."""
    folder = checkout.copy_to(tmp_path / "checkout")
    dockerfile = folder / "docker" / "Dockerfile"
    dockerfile.write_text(
        f"FROM {engine.LOCAL_BASE} AS grade\nRUN echo no such thing >&2; exit 3\n"
    )
    monkeypatch.setattr(image_build, "root", lambda: folder)
    with pytest.raises(SurroundingsError) as caught:
        build_image(
            client,
            find_distro("lyrical"),
            stage="grade",
            base="ros",
            network=Network(base_image=engine.LOCAL_BASE),
            notify=lambda text: None,
        )
    assert "no such thing" in caught.value.message
    assert "\x1b" not in caught.value.message


def test_a_second_build_uses_the_cache(client: DockerClient) -> None:
    """Also on the official image, whose entry point is a problem for the classic builder."""
    lines: list[str] = []
    made = [
        build_image(
            client,
            find_distro("jazzy"),
            stage="grade",
            base="ros",
            network=engine.network("ros"),
            notify=lines.append,
        )
        for _ in range(2)
    ]
    assert made[0] == made[1]
    assert [line for line in lines if "ENTRYPOINT" in line]


@pytest.mark.parametrize("stage", ["grade", pytest.param("lab", marks=pytest.mark.long)])
def test_an_edit_of_our_code_costs_only_the_last_layers(
    stage: images.Stage, client: DockerClient, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """Neither ROS' packages nor the system's are installed again: three minutes, and 331 MB."""
    folder = checkout.copy_to(tmp_path / "checkout")
    (folder / "docker" / "ca" / "extra.crt").unlink(missing_ok=True)
    monkeypatch.setattr(image_build, "root", lambda: folder)

    def build() -> list[str]:
        build_image(
            client,
            find_distro("jazzy"),
            stage=stage,
            base="wheels",
            network=engine.network("wheels"),
            notify=lambda text: None,
        )
        made = client.images.get(images.image_name(find_distro("jazzy"), stage, "wheels"))
        return list(made.attrs["RootFS"]["Layers"])

    monkeypatch.setenv(images.REPOSITORY_VARIABLE, f"{engine.REPOSITORY}-edited")
    try:
        before = build()
        for name in ("ros/ros2_command/run.py", "base/errors.py", "sandbox/base.py"):
            with (folder / "grader" / name).open("a") as file:
                file.write("# edited\n")
        after = build()
    finally:
        remove_tags(client, f"{engine.REPOSITORY}-edited")
    own = 1 if stage == "grade" else 5
    assert before != after
    assert before[:-own] == after[:-own]


def remove_tags(client: DockerClient, repository: str) -> None:
    for image in client.images.list(repository):
        for tag in [tag for tag in image.tags if tag.startswith(f"{repository}:")]:
            client.images.remove(tag)


def test_compose_finds_an_image_on_wheels_if_there_is_no_official_one(
    client: DockerClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    """compose knows one name; an official image keeps it."""
    repository = f"{engine.REPOSITORY}-alone"
    monkeypatch.setenv(images.REPOSITORY_VARIABLE, repository)

    def build(base: images.Base) -> str:
        build_image(
            client,
            find_distro("jazzy"),
            stage="grade",
            base=base,
            network=engine.network(base),
            notify=lambda text: None,
        )
        return str(client.images.get(f"{repository}:grade-jazzy").labels[images.ROS_LABEL])

    try:
        assert [build("wheels"), build("ros"), build("wheels")] == ["wheels", "image", "image"]
    finally:
        remove_tags(client, repository)


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
    assert "ros:humble-ros-base cannot be had" in done.stderr
    assert "make images DISTRO=humble" in done.stderr
    assert "Traceback" not in done.stderr
