"""The limits of the lab: what it gives to Docker and to bubblewrap, and that they hold."""

from __future__ import annotations

import dataclasses
import json
import re
from pathlib import Path

import pytest
import yaml

from grader.base.errors import UsageError
from grader.sandbox.cgroups import Group
from lab.bubblewrap import in_group, rlimits
from lab.config import HIDDEN_HOME
from lab.container import held
from lab.limits import LabLimits, lab_limits
from tests import processes
from tests.lab.helpers import run
from tests.lab.kinds import Kind

GIGABYTE = 1 << 30
BOMB = """
import os, time
children = []
while len(children) < 300:
    try:
        child = os.fork()
    except OSError as error:
        print(error.strerror)
        break
    if not child:
        time.sleep(60)
        os._exit(0)
    children.append(child)
for child in children:
    os.kill(child, 9)
"""
SMALL = {"LAB_PROCESSES": "150", "LAB_MEMORY": "512m", "LAB_TMP": "16m"}


def test_docker_gets_the_limits() -> None:
    options = held(LabLimits())
    assert (options["pids_limit"], options["mem_limit"]) == (2048, 4 * GIGABYTE)
    assert options["memswap_limit"] == options["mem_limit"]
    assert options["shm_size"] == "256m"
    assert options["tmpfs"]["/tmp"] == f"exec,mode=1777,size={GIGABYTE}"
    assert "size=" in options["tmpfs"][HIDDEN_HOME]
    small = held(lab_limits(SMALL))
    assert (small["pids_limit"], small["mem_limit"]) == (150, 512 << 20)
    assert small["tmpfs"]["/tmp"] == f"exec,mode=1777,size={16 << 20}"


def test_compose_and_the_dev_container_have_the_same_limits() -> None:
    usual = LabLimits()
    text = (processes.ROOT / "docker/compose.yaml").read_text(encoding="utf-8")
    service = yaml.safe_load(re.sub(r"\$\{[A-Z_]+:-([^}]*)\}", r"\1", text))["services"]["lab"]
    compose = {
        "LAB_PROCESSES": str(service["pids_limit"]),
        "LAB_MEMORY": service["mem_limit"],
        "LAB_TMP": dict(each.split(":") for each in service["tmpfs"])["/tmp"].rpartition("=")[2],
    }
    assert lab_limits(compose) == usual
    assert service["memswap_limit"] == service["mem_limit"]
    assert all("size=" in each for each in service["tmpfs"])
    # docker-compose 1 gives a variable to the daemon as text, which it refuses
    assert isinstance(service["pids_limit"], int)
    assert "pids_limit: 2048" in text
    text = (processes.ROOT / ".devcontainer/devcontainer.json").read_text(encoding="utf-8")
    words = json.loads(re.sub(r"\$\{localEnv:[A-Z_]+:([^}]*)\}", r"\1", text))["runArgs"]
    options = dict(word.removeprefix("--").split("=", 1) for word in words)
    container = {
        "LAB_PROCESSES": options["pids-limit"],
        "LAB_MEMORY": options["memory"],
        "LAB_TMP": options["tmpfs"].rpartition("=")[2],
    }
    assert lab_limits(container) == usual
    assert options["memory-swap"] == options["memory"]


@pytest.mark.parametrize(
    ("text", "size"), [("6g", 6 * GIGABYTE), ("600M", 600 << 20), (" 2g ", 2 * GIGABYTE), ("", 0)]
)
def test_a_size_is_read_as_docker_reads_it(text: str, size: int) -> None:
    assert lab_limits({"LAB_MEMORY": text}).memory == (size or LabLimits().memory)


@pytest.mark.parametrize(
    ("name", "text"),
    [
        *(("LAB_MEMORY", text) for text in ("much", "-1", "0", "6gb", "1.5g", "100m", "9" * 99)),
        *(("LAB_PROCESSES", text) for text in ("10", "4k", "many")),
        ("LAB_TMP", "1m"),
    ],
)
def test_a_limit_with_which_no_lab_would_open_is_refused(name: str, text: str) -> None:
    with pytest.raises(UsageError, match=f"{name} must be at least") as caught:
        lab_limits({name: text})
    assert f"{name}=" in str(caught.value.remedy)


def test_what_no_group_holds_is_a_limit_of_each_process(monkeypatch: pytest.MonkeyPatch) -> None:
    @dataclasses.dataclass
    class System:
        release: str

    limits = LabLimits()
    monkeypatch.setattr("os.uname", lambda: System("6.8.0-45-generic"))
    words = ["prlimit", f"--data={limits.memory}", "--nproc=2048"]
    assert rlimits(limits, [], root=False) == words
    assert rlimits(limits, ["memory"], root=False) == ["prlimit", "--nproc=2048"]
    assert rlimits(limits, ["memory", "processes"], root=False) == []
    assert (
        rlimits(limits, [], root=True) == words[:2]
    )  # it would count the student's other programs
    monkeypatch.setattr("os.uname", lambda: System("5.10.0"))
    assert rlimits(limits, [], root=False) == words[:2]


def test_a_lab_opens_where_its_group_is_gone(tmp_path: Path) -> None:
    words = in_group(Group([tmp_path / "gone"], ["memory"]), ["echo", "a b"])
    done = processes.run(words)
    assert (done.returncode, done.stdout, done.stderr) == (0, "a b\n", "")


@pytest.mark.full
def test_the_limits_hold(kind: Kind, tmp_path: Path) -> None:
    script = """
        df -B 1 --output=size /tmp | tail -1
        dd if=/dev/zero of=/tmp/x bs=1M count=20 2>&1 | grep -o 'No space left on device'
        rm /tmp/x; cp /bin/true /tmp/program && /tmp/program && echo runs
        python3 -c 'x = bytearray(700 << 20)' || echo refused
    """
    small = Kind(kind.sandbox, {**kind.env, **SMALL})
    done = run(small, tmp_path / "ws", "--", "bash", "-c", f"{script}\npython3 -c '{BOMB}'")
    size = str(16 << 20)
    said = [size, "No space left on device", "runs", "refused", "Resource temporarily unavailable"]
    assert [line.strip() for line in done.stdout.splitlines()] == said, done.stderr
