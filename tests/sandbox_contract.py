"""Tests that every sandbox must pass; each sandbox's tests import them with own fixtures."""

from __future__ import annotations

import re
import secrets
import signal
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from grader.base.cache import cache_root
from grader.base.state import state_folder
from grader.run.terminal import Terminal
from grader.run.unforeseen import KEY_FILE
from grader.sandbox.base import Pipe, Role, Sandbox
from grader.sandbox.limits import MEGABYTE, Limits
from tests import processes

Make = Callable[[Limits], Sandbox]


def shell(sandbox: Sandbox, script: str, *, seconds: float = 20) -> tuple[int | None, str]:
    outcome = sandbox.run(["bash", "-c", script], seconds=seconds)
    return outcome.status, outcome.output.decode()


def test_only_the_workspace_and_scratch_folders_are_writable(sandbox: Sandbox) -> None:
    places = "/ /usr /usr/bin /etc /opt/ros/jazzy /opt /proc/sys/kernel /home /run /var"
    status, output = shell(
        sandbox, f'for p in {places}; do touch "$p/x" 2> /dev/null && echo "wrote $p"; done; true'
    )
    assert (status, output) == (0, "")
    status, output = shell(sandbox, "touch ~/ros2_ws/a ~/b /tmp/c /dev/shm/d && ls ~ ~/ros2_ws")
    assert status == 0
    assert "a" in output


def test_files_of_the_host_are_not_visible(sandbox: Sandbox, tmp_path: Path) -> None:
    (tmp_path / "secret").write_text("x")
    keys = tmp_path / "state"  # of an installation
    keys.mkdir()
    (keys / KEY_FILE).write_bytes(b"key")
    own = (tmp_path / "secret", Path("/etc/shadow"), Path.home() / ".ssh", processes.ROOT)
    for path in (*own, keys / KEY_FILE, state_folder(), cache_root()):
        status, _ = shell(sandbox, f'test -r "{path}"')
        assert status == 1, path


def test_the_network_is_loopback_only(sandbox: Sandbox) -> None:
    status, output = shell(sandbox, "tail -n +3 /proc/net/dev | cut -d: -f1; cat /proc/net/route")
    assert status == 0
    assert output.split()[0] == "lo"
    assert len(output.strip().splitlines()) == 2  # lo, and the header of an empty routing table
    status, _ = shell(
        sandbox, "exec 3<>/dev/tcp/127.0.0.1/9", seconds=10
    )  # refused at once, so loopback is up
    assert status == 1


IN_SIGHT = """
env; cat /proc/self/cgroup /etc/passwd /etc/group; hostname; id
cat /proc/self/mountinfo /proc/self/mounts /proc/self/mountstats
cat /proc/[0-9]*/mountinfo /proc/[0-9]*/cmdline /proc/[0-9]*/comm | tr '\\0' '\\n'
ls -a / /etc /run /mnt /media /opt /opt/ros /tmp /dev /dev/shm /home /home/student
"""
OURS = re.compile(r"grader|marking|autograd|teaching")


def test_nothing_in_sight_tells_that_this_is_the_grader(sandbox: Sandbox) -> None:
    """A node that behaves only here would look for it."""
    _, output = shell(sandbox, IN_SIGHT)
    assert "student" in output
    assert " /opt/ros/" in output or "overlay / " in output, "the mounts are among it"
    places = (str(processes.ROOT), str(cache_root()))
    told = [
        line
        for line in output.splitlines()
        if OURS.search(line) or any(place in line for place in places)
    ]
    assert told == []


NETWORK = "readlink /proc/self/ns/net"


def network_of_a_probe(sandbox: Sandbox) -> tuple[Pipe, str]:
    probe = sandbox.probe(["bash", "-c", f"{NETWORK}; cat"])
    said = probe.read(20)
    assert said is not None
    return probe, said.decode().strip()


def test_the_build_and_each_probe_have_a_network_of_their_own(sandbox: Sandbox) -> None:
    """Else a node that setup.py left behind would be taken for the one that is observed."""
    seen = [shell(sandbox, NETWORK)[1].strip()]
    probes = []  # all are kept until the end: the kernel gives a number that is free to the next one
    for _ in range(2):
        probe, network = network_of_a_probe(sandbox)
        probes.append(probe)
        console = sandbox.console(["bash", "-c", NETWORK], probe=probe)
        opened = Terminal(console, most=1000)
        lines, ended = opened.finish(20)
        opened.close()
        assert ended
        assert [line.text for line in lines] == [network], "the node is not on its probe's network"
        seen.append(network)
    for probe in probes:
        probe.finish(1)
    assert all(network.startswith("net:[") for network in seen)
    assert len(set(seen)) == 3


def test_loopback_is_up_in_the_network_of_a_probe(sandbox: Sandbox) -> None:
    answer = "exec 3<>/dev/tcp/127.0.0.1/4567; cat <&3"
    server = (
        "import socket; s = socket.create_server(('127.0.0.1', 4567)); print('up', flush=True); "
        "s.accept()[0].sendall(b'from the probe')"
    )
    probe = sandbox.probe(["python3", "-S", "-c", server])
    assert probe.read(20) == b"up\n"
    assert shell(sandbox, answer)[0] == 1, "the build reaches the probe"
    opened = Terminal(sandbox.console(["bash", "-c", answer], probe=probe), most=1000)
    opened.finish(20)
    opened.close()
    probe.finish(1)
    assert opened.transcript.strip() == "from the probe"


def test_the_environment_has_only_listed_variables(
    sandbox: Sandbox, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SECRET_TOKEN", "abc")
    _, output = shell(sandbox, "env")
    names = {line.partition("=")[0] for line in output.splitlines()}
    assert names - {"PWD", "SHLVL", "_"} == set(sandbox.environment("student"))


def test_nothing_of_a_command_remains_for_the_next(sandbox: Sandbox) -> None:
    mark = f"sleep 98{secrets.randbelow(10**6)}"
    status, _ = shell(sandbox, f"setsid {mark} > /dev/null 2>&1 < /dev/null & echo started")
    assert status == 0
    _, output = shell(sandbox, "cat /proc/[0-9]*/cmdline | tr '\\0' ' '")
    assert mark not in output
    assert processes.alive(mark) == []


def test_student_and_probe_cannot_reach_each_other(sandbox: Sandbox) -> None:
    probe = sandbox.probe(["cat"])
    probe.write(b"up\n")
    assert probe.read(10) == b"up\n"
    shell(sandbox, "kill -9 -1; for p in /proc/[0-9]*; do kill -9 ${p#/proc/}; done")
    probe.write(b"still there\n")
    assert probe.read(10) == b"still there\n"
    probe.finish(1)
    shell(sandbox, "touch ~/ros2_ws/mine")
    outcome = sandbox.run(["find", "/home"], role="probe", seconds=10)
    assert b"/home/student" in outcome.output
    assert b"mine" not in outcome.output


def test_as_root_the_commands_are_two_other_users(sandbox: Sandbox) -> None:
    uids = {}
    roles: tuple[Role, ...] = ("student", "probe")
    for role in roles:
        outcome = sandbox.run(["id", "-u"], role=role, seconds=10)
        uids[role] = outcome.output.strip()
    assert uids["student"] != uids["probe"]
    assert b"0" not in uids.values()


def test_no_privilege_is_left(sandbox: Sandbox) -> None:
    _, output = shell(sandbox, "grep -E 'CapEff|CapPrm|NoNewPrivs' /proc/self/status")
    values = dict(line.split(":\t") for line in output.strip().splitlines())
    assert int(values["CapEff"], 16) == int(values["CapPrm"], 16) == 0
    assert values["NoNewPrivs"] == "1"


def terminal(sandbox: Sandbox, script: str, *, most: int = 100_000) -> Terminal:
    return Terminal(sandbox.console(["bash", "-c", script]), most=most)


def test_ctrl_c_reaches_the_command_and_its_last_output_is_read(sandbox: Sandbox) -> None:
    code = (  # sigwait, since a signal just before time.sleep would not end it
        "import signal, sys\n"
        "signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])\n"
        "print('up', flush=True)\n"
        "signal.sigwait([signal.SIGINT])\n"
        "print('last words'); sys.exit(7)\n"
    )
    opened = terminal(sandbox, f'exec python3 -c "{code}"')
    while not any(line.text == "up" for line in opened.read(10)):
        assert not opened.ended
    opened.interrupt()
    lines, ended = opened.finish(10)
    assert ended
    assert opened.status == (7, None)
    assert any("last words" in line.text for line in lines)
    opened.close()


def test_a_command_ended_by_ctrl_c_is_reported_so(sandbox: Sandbox) -> None:
    opened = terminal(sandbox, "echo up; exec sleep 60")
    while not any(line.text == "up" for line in opened.read(10)):
        assert not opened.ended
    opened.interrupt()
    _, ended = opened.finish(10)
    assert ended
    assert opened.status == (130, None)
    opened.close()


DOTS = "trap '' INT; while :; do printf .; sleep 0.01; done"


def test_output_without_a_line_end_extends_no_wait(sandbox: Sandbox) -> None:
    opened = terminal(sandbox, DOTS, most=400)  # (for four seconds)
    while "." * 20 not in opened.transcript:
        assert opened.read(0.2) == []
    begin = time.monotonic()
    assert opened.read(0.3) == []
    opened.interrupt()
    _, ended = opened.finish(0.5)
    assert not ended
    assert time.monotonic() - begin < 2
    assert not opened.flooded, "a read went on until the limit on output"
    opened.close()
    assert "." * 20 in opened.transcript


def test_a_pipe_without_a_complete_line_extends_no_wait(sandbox: Sandbox) -> None:
    """stdout is read in pieces; output on stderr alone does not end or extend the wait."""
    pipe = sandbox.probe(["bash", "-c", f"{DOTS} >&2"])
    begin = time.monotonic()
    assert pipe.read(0.5) is None
    assert time.monotonic() - begin < 2
    pipe.kill()
    assert b"." in pipe.errors()
    pipe.finish(0.1)


def test_unread_stderr_does_not_block_a_pipe(sandbox: Sandbox) -> None:
    """A full pipe would block a probe that a node causes to print warnings."""
    pipe = sandbox.probe(["bash", "-c", "head -c 300000 /dev/zero >&2; echo done"])
    assert pipe.read(20) == b"done\n"
    pipe.finish(1)


def test_the_status_is_the_commands_own(sandbox: Sandbox) -> None:
    for status in (0, 1, 2, 125, 126, 127, 128, 130, 137, 143, 250, 251, 254, 255):
        outcome = sandbox.run(["sh", "-c", f"echo said; exit {status}"], seconds=20)
        assert (outcome.status, outcome.output, outcome.stopped_by) == (status, b"said\n", "")


def test_output_is_cut_while_it_is_read(sandbox: Sandbox) -> None:
    outcome = sandbox.run(["yes"], seconds=30, output=10_000)
    assert outcome.stopped_by == "output"
    assert len(outcome.output) == 10_000
    assert outcome.seconds < 10


def test_the_time_limit_ends_a_command(sandbox: Sandbox) -> None:
    outcome = sandbox.run(["sleep", "100"], seconds=0.3)
    assert (outcome.status, outcome.stopped_by) == (None, "wall time")
    assert outcome.seconds < 5


def test_the_workspace_has_a_size_limit(make_sandbox: Make) -> None:
    with make_sandbox(Limits(workspace=20 * MEGABYTE)) as small:
        status, output = shell(small, "head -c 30000000 /dev/zero > big; ls -l big | cut -d' ' -f5")
        assert status == 0
        assert "No space left" in output
        status, output = shell(small, "head -c 5000000 /dev/zero > /tmp/big")
        assert status != 0


def test_a_file_has_a_size_limit(make_sandbox: Make) -> None:
    with make_sandbox(Limits(file_size=1 * MEGABYTE)) as small:
        status, _ = shell(small, "head -c 2000000 /dev/zero > big; stat -c %s big; exit 3")
        assert status == 3
        _, output = shell(small, "stat -c %s big")
        assert int(output) == 1 * MEGABYTE


def test_memory_is_limited_across_all_processes(make_sandbox: Make) -> None:
    hog = "x = bytearray(120_000_000); x[::4096] = b'1' * len(x[::4096]); print('had', 'it')"
    with make_sandbox(Limits(memory=80 * MEGABYTE)) as small:
        _, output = shell(small, f'/usr/bin/env python3 -S -c "{hog}"; /usr/bin/python3 -c "{hog}"')
        assert "had it" not in output
        if small.held_by()["memory"] == "cgroup":
            assert small.resource_limit_hit() == "memory"


def test_processes_are_limited_across_the_whole_submission(make_sandbox: Make) -> None:
    bomb = "for i in $(seq 400); do sleep 50 & done; echo started all"
    with make_sandbox(Limits(processes=60)) as small:
        _, output = shell(small, bomb, seconds=4)
        assert "started all" not in output or "Resource temporarily unavailable" in output
        if small.held_by()["processes"] == "cgroup":
            assert small.resource_limit_hit() == "processes"


def test_the_report_names_the_limits_that_were_enforced(sandbox: Sandbox) -> None:
    report = sandbox.limit_report()
    assert report["workspace"].held_by == "tmpfs"
    assert report["memory"].held_by in ("cgroup", "rlimit")
    assert report["memory"].value == Limits().memory


CALLS = """\
import ctypes, errno, sys
libc = ctypes.CDLL(None, use_errno=True)
def refused(name, *args):
    ctypes.set_errno(0)
    value = libc.syscall(*(ctypes.c_long(a) for a in args))
    if value != -1 or ctypes.get_errno() not in ({errors}):
        print(name, value, errno.errorcode.get(ctypes.get_errno()))
page = ctypes.addressof(ctypes.create_string_buffer(4096))
refused("add_key", 248, page, page, page, 1, -2)
refused("request_key", 249, page, page, 0, -2)
refused("keyctl", 250, 0, -3, 0)
refused("io_uring_setup", 425, 8, page)
refused("userfaultfd", 323, 0)
refused("bpf", 321, 0, page, 120)
refused("perf_event_open", 298, page, 0, -1, -1, 0)
refused("ptrace", 101, 0, 0, 0, 0)
refused("process_vm_readv", 310, 1, page, 1, page, 1, 0)
refused("process_madvise", 440, 1, page, 1, 4, 0)
refused("pidfd_getfd", 438, 0, 0, 0)
refused("kcmp", 312, 1, 1, 0, 0, 0)
refused("unshare", 272, 0x10000000)
refused("setns", 308, 0, 0)
refused("mount", 165, page, page, page, 0, 0)
refused("open_tree", 428, -100, page, 0)
refused("fsopen", 430, page, 0)
refused("pivot_root", 155, page, page)
refused("clone3", 435, page, 88)
refused("shmget", 29, 0, 4096, 0o1600)
refused("msgget", 68, 0, 0o1600)
refused("memfd_create", 319, page, 0)
refused("mq_open", 240, page, 0o100, 0o600, 0)
refused("personality without address randomisation", 135, 0x40000)
families = {"vsock": 40, "packet": 17, "alg": 38, "kcm": 41, "vsock, high bits": 1 << 32 | 40}
for name, family in families.items():
    refused(name, 41, family, 1, 0)
for flag in (0x10000000, 0x20000, 0x20000000, 0x40000000, 0x2000000):
    refused(f"clone {flag:#x}", 56, flag | 17, 0, 0, 0, 0)
"""


def test_no_system_call_beyond_the_list_is_possible(sandbox: Sandbox) -> None:
    """Numbers: x86_64. As on a kernel without them (Docker before 23 says EPERM instead).

    The list is in seccomp.py. glibc uses clone instead of clone3 only after ENOSYS.
    """
    allowed = "errno.ENOSYS" + (", errno.EPERM" if sandbox.name == "docker" else ",")
    code = CALLS.replace("{errors}", allowed)
    code += "ctypes.set_errno(0)\nlibc.syscall(435, None, 88)\n"
    code += "if ctypes.get_errno() != errno.ENOSYS: print('clone3', ctypes.get_errno())\n"
    outcome = sandbox.run(["python3", "-S", "-c", code], seconds=20)
    assert (outcome.status, outcome.output) == (0, b"")


FOREIGN = """
import ctypes, mmap
code = {code}
page = mmap.mmap(-1, 4096, prot=mmap.PROT_READ | mmap.PROT_WRITE | mmap.PROT_EXEC)
page.write(code)
call = ctypes.CFUNCTYPE(ctypes.c_long)(ctypes.addressof(ctypes.c_char.from_buffer(page)))
print("answered", call(), flush=True)
"""


@pytest.mark.parametrize(
    "code",
    [
        b"\xb8\x14\x00\x00\x00\xcd\x80\xc3",  # mov eax, 20 (getpid of i386); int 0x80; ret
        b"\xb8\x27\x00\x00\x40\x0f\x05\xc3",  # mov eax, 0x40000027 (getpid of x32); syscall; ret
    ],
    ids=["i386", "x32"],
)
def test_system_calls_of_a_foreign_architecture_end_the_process(
    sandbox: Sandbox, code: bytes
) -> None:
    command = ["python3", "-S", "-c", FOREIGN.format(code=code)]
    outcome = sandbox.run(command, seconds=20)
    assert (outcome.status, outcome.output) == (128 + signal.SIGSYS, b"")


def test_what_python_and_compilers_use_works(sandbox: Sandbox) -> None:
    code = (
        "import ctypes, multiprocessing, os, select, socket, subprocess, tempfile, threading\n"
        "thread = threading.Thread(target=print, args=('thread',))\n"
        "thread.start(); thread.join()  # unbuffered: a line and its end are two writes\n"
        "print(subprocess.run(['echo', 'child'], capture_output=True, text=True).stdout)\n"
        "socket.socketpair(); os.eventfd(0); select.epoll()\n"
        "os.mkfifo('fifo'); os.sched_getaffinity(0); tempfile.TemporaryFile().write(b'x')\n"
        "socket.if_nameindex(); socket.getaddrinfo('localhost', 80)\n"
        "child = multiprocessing.Process(target=print, args=('process',))\n"
        "child.start(); child.join(); multiprocessing.Lock(); print(child.exitcode)\n"
        "print('personality', ctypes.CDLL(None).personality(0xffffffff))\n"
    )
    outcome = sandbox.run(["python3", "-u", "-c", code], seconds=30)
    said = outcome.output.decode().split()
    assert outcome.status == 0, outcome.output
    assert sorted(said) == sorted(["thread", "child", "process", "0", "personality", "0"])
