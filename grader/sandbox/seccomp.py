"""The system calls that a submission may use: an allow list, for bubblewrap and for Docker.

It has what ROS, Python, colcon and compilers need. Everything else answers ENOSYS, as on a kernel
without it, so that programs use their other way: namespaces, mounts, keyrings, io_uring, System V
IPC, files in memory without a size limit (memfd), other processes' memory, tracing, perf, bpf, userfaultfd, and sockets of other families (no
network namespace contains AF_VSOCK). System calls of foreign architectures (32-bit, x32) end the
process, because their numbers are not those of the list.

Sources: syscalls(2), seccomp(2), seccomp_rule_add(3), clone(2).
"""

from __future__ import annotations

import ctypes
import errno
import functools
import json
import os
import socket
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from grader.base.errors import SurroundingsError
from grader.base.i18n.message import say

FILES = """
access chdir chmod chown close close_range copy_file_range creat dup dup2 dup3 faccessat faccessat2
fadvise64 fallocate fchdir fchmod fchmodat fchmodat2 fchown fchownat fcntl fdatasync fgetxattr
flistxattr flock fremovexattr fsetxattr fstat fstatfs fsync ftruncate futimesat getcwd getdents
getdents64 getxattr ioctl lchown lgetxattr link linkat listxattr llistxattr lremovexattr lseek
lsetxattr lstat mkdir mkdirat mknod mknodat newfstatat open openat openat2 pread64 preadv preadv2
pwrite64 pwritev pwritev2 read readahead readlink readlinkat readv removexattr rename renameat
renameat2 rmdir sendfile setxattr splice stat statfs statx symlink symlinkat sync sync_file_range
syncfs tee truncate umask unlink unlinkat utime utimensat utimes vmsplice write writev
"""
MEMORY = """
brk cachestat madvise map_shadow_stack membarrier mincore mlock mlock2 mlockall mmap
mprotect mremap mseal msync munlock munlockall munmap pkey_alloc pkey_free pkey_mprotect
"""
PROCESSES = """
arch_prctl capget capset execve execveat exit exit_group fork getcpu getegid geteuid getgid
getgroups getpgid getpgrp getpid getppid getpriority getresgid getresuid getrlimit getrusage getsid
gettid getuid ioprio_get ioprio_set kill landlock_add_rule landlock_create_ruleset
landlock_restrict_self pidfd_open pidfd_send_signal prctl prlimit64 rseq sched_get_priority_max
sched_get_priority_min sched_getaffinity sched_getattr sched_getparam sched_getscheduler
sched_rr_get_interval sched_setaffinity sched_setattr sched_setparam sched_setscheduler sched_yield
seccomp set_robust_list get_robust_list set_tid_address setfsgid setfsuid setgid setgroups setpgid
setpriority setregid setresgid setresuid setreuid setrlimit setsid setuid sysinfo tgkill times tkill
uname vfork wait4 waitid
"""
SIGNALS_AND_TIME = """
alarm clock_getres clock_gettime clock_nanosleep futex futex_requeue futex_wait futex_waitv
futex_wake getitimer getrandom gettimeofday nanosleep pause restart_syscall rt_sigaction
rt_sigpending rt_sigprocmask rt_sigqueueinfo rt_sigreturn rt_sigsuspend rt_sigtimedwait
rt_tgsigqueueinfo setitimer sigaltstack signalfd signalfd4 time timer_create timer_delete
timer_getoverrun timer_gettime timer_settime timerfd_create timerfd_gettime timerfd_settime
"""
SOCKETS_AND_POLLING = """
accept accept4 bind connect epoll_create epoll_create1 epoll_ctl epoll_pwait epoll_pwait2 epoll_wait
eventfd eventfd2 getpeername getsockname getsockopt inotify_add_watch inotify_init inotify_init1
inotify_rm_watch listen pipe pipe2 poll ppoll pselect6 recvfrom recvmmsg recvmsg select sendmmsg
sendmsg sendto setsockopt shutdown
"""
ALLOWED = sorted(f"{FILES} {MEMORY} {PROCESSES} {SIGNALS_AND_TIME} {SOCKETS_AND_POLLING}".split())
FAMILIES = (socket.AF_UNIX, socket.AF_INET, socket.AF_INET6, socket.AF_NETLINK)
INT = 0xFFFFFFFF  # the kernel reads no more of an int in a 64-bit register
NEW_NAMESPACES = 0x7E020000  # the CLONE_NEW… flags of clone (clone3 has them in memory: refused)
PERSONALITIES = (0x0, 0x8, 0x20000, 0x20008, 0xFFFFFFFF)  # Linux, 32-bit uname, and the question

ALLOW = 0x7FFF0000
ERRNO = 0x00050000
KILL_PROCESS = 0x80000000
ON_FOREIGN_ARCHITECTURE, OPTIMIZE = 2, 8  # attributes of a filter
MASKED_EQUAL = 7
BINARY_TREE = 2
ARCHITECTURES = ("SCMP_ARCH_X86_64", "SCMP_ARCH_AARCH64")


@dataclass(frozen=True)
class Argument:
    """What the bits of one argument in a mask must be."""

    index: int
    mask: int
    bits: int = 0


def rules() -> Iterator[tuple[str, Argument | None]]:
    """Yield the allowed system calls, each with the condition on one of its arguments."""
    for name in ALLOWED:
        yield name, None
    for call in ("socket", "socketpair"):
        for family in FAMILIES:
            yield call, Argument(0, INT, int(family))
    yield "clone", Argument(0, NEW_NAMESPACES)
    for kind in PERSONALITIES:
        yield "personality", Argument(0, INT, kind)


def docker_profile() -> str:
    """Return the list as a seccomp profile of Docker (JSON)."""
    calls: list[dict[str, Any]] = []
    for name, argument in rules():
        call: dict[str, Any] = {"names": [name], "action": "SCMP_ACT_ALLOW"}
        if argument is not None:
            call["args"] = [
                {
                    "index": argument.index,
                    "op": "SCMP_CMP_MASKED_EQ",
                    "value": argument.mask,
                    "valueTwo": argument.bits,
                }
            ]
        calls.append(call)
    calls.append({"names": ["clone3"], "action": "SCMP_ACT_ERRNO", "errnoRet": errno.ENOSYS})
    profile = {
        "defaultAction": "SCMP_ACT_ERRNO",
        "defaultErrnoRet": errno.ENOSYS,
        "archMap": [{"architecture": name, "subArchitectures": []} for name in ARCHITECTURES],
        "syscalls": calls,
    }
    return json.dumps(profile)


class _Comparison(ctypes.Structure):
    """`struct scmp_arg_cmp` of libseccomp."""

    _fields_ = (
        ("arg", ctypes.c_uint),
        ("op", ctypes.c_int),
        ("datum_a", ctypes.c_uint64),
        ("datum_b", ctypes.c_uint64),
    )


@functools.cache
def filter_path() -> str:
    """Return the path of an anonymous file with the list as a BPF program, made once.

    Raises SurroundingsError if libseccomp is missing or refuses.
    """
    library = _library()
    descriptor = os.memfd_create("filter")
    context = ctypes.c_void_p(library.seccomp_init(ctypes.c_uint32(ERRNO | errno.ENOSYS)))
    try:
        if not context:
            raise SurroundingsError("libseccomp cannot create a filter")
        library.seccomp_attr_set(context, OPTIMIZE, BINARY_TREE)  # (from libseccomp 2.5 on)
        _done(library.seccomp_attr_set(context, ON_FOREIGN_ARCHITECTURE, KILL_PROCESS))
        for name, argument in rules():
            number = library.seccomp_syscall_resolve_name(name.encode())
            if number < 0:
                continue  # this architecture or this libseccomp does not have it
            given = [] if argument is None else [_comparison(argument)]
            array = (_Comparison * len(given))(*given)
            _done(library.seccomp_rule_add_array(context, ALLOW, number, len(given), array))
        _done(library.seccomp_export_bpf(context, descriptor))
    finally:
        library.seccomp_release(context)
    return f"/proc/{os.getpid()}/fd/{descriptor}"


def _comparison(argument: Argument) -> _Comparison:
    return _Comparison(argument.index, MASKED_EQUAL, argument.mask, argument.bits)


def _done(status: int) -> None:
    if status < 0:
        raise SurroundingsError(f"libseccomp refuses the filter: {os.strerror(-status)}")


def _library() -> Any:
    try:
        library = ctypes.CDLL("libseccomp.so.2")
    except OSError:
        raise SurroundingsError(
            say("the library libseccomp is missing"),
            remedy=say("Install it (Debian and Ubuntu: `sudo apt-get install libseccomp2`)."),
        ) from None
    library.seccomp_init.restype = ctypes.c_void_p
    library.seccomp_rule_add_array.argtypes = [
        ctypes.c_void_p,
        ctypes.c_uint32,
        ctypes.c_int,
        ctypes.c_uint,
        ctypes.c_void_p,
    ]
    library.seccomp_attr_set.argtypes = [ctypes.c_void_p, ctypes.c_int, ctypes.c_uint32]
    return library
