"""Makes the grader's Python environment; `make` runs it with the `python3` that it finds.

It uses the standard library only and the syntax of old Pythons, so that it can report that Python is
too old. It makes `.venv` from the lock file (every package checked by its hash), completely or not
at all. If run as root, it also installs bubblewrap from the system's packages.
"""

import argparse
import contextlib
import fcntl
import hashlib
import os
import shutil
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import NoReturn

ROOT = os.path.dirname(HERE)
VENV = os.path.join(ROOT, ".venv")
CHOSEN = os.path.join(VENV, "interpreter")
OLDEST, NEWEST = (3, 10), (3, 13)
# what pip prints if it does not reach its server
UNREACHABLE = ("connection broken by", "Could not fetch URL", "(from versions: none)")
REASONS = (
    "Temporary failure in name resolution",
    "Name or service not known",
    "Network is unreachable",
    "Connection refused",
    "Cannot connect to proxy",
    "CERTIFICATE_VERIFY_FAILED",
    "timed out",
)
INSTALLERS = [
    ["apt-get", "install", "-y", "-qq", "--no-install-recommends", "bubblewrap"],
    ["dnf", "install", "-y", "-q", "bubblewrap"],
    ["zypper", "--non-interactive", "install", "bubblewrap"],
    ["pacman", "-S", "--noconfirm", "bubblewrap"],
    ["apk", "add", "bubblewrap"],
]


def notify(text: str) -> None:
    """Print a line to stderr, so that stdout has only the command's own output."""
    print(text, file=sys.stderr, flush=True)


def fail(text: str) -> "NoReturn":
    """Print an error and exit with the status of failed surroundings, 3."""
    notify(text)
    raise SystemExit(3)


def version_of(python: str) -> "tuple[int, ...] | None":
    """Return (major, minor) of an interpreter; None if it does not run (a pyenv shim may not)."""
    code = "import sys; print(sys.version_info[0], sys.version_info[1])"
    try:
        out = subprocess.check_output([python, "-c", code], stderr=subprocess.DEVNULL)
    except (OSError, subprocess.CalledProcessError):
        return None
    return tuple(map(int, out.split()))


def find_python(wanted: str) -> str:
    """Return an interpreter that can run the grader: `wanted` if its version fits, else another."""
    names = [wanted, "python3", "python3.12", "python3.13", "python3.11", "python3.10"]
    others = []
    for name in names:
        version = version_of(name)
        if version is not None and OLDEST <= version <= NEWEST:
            return name
        if version is not None:
            others.append("%s is Python %d.%d" % (name, version[0], version[1]))
        if name == wanted and version is not None:
            notify("%s: looking for another" % others[0])
    raise fail(
        "No Python %d.%d to %d.%d was found (ROS's wheels exist for these)" % (OLDEST + NEWEST)
        + "".join("; " + other for other in sorted(set(others)))
        + ".\nInstall Python 3.12 beside it: sudo apt-get install python3.12 python3.12-venv, or, if "
        "your system has no such package, with uv (https://docs.astral.sh/uv): uv python install "
        "3.12\nThen give its path: make setup PYTHON=/path/to/python3.12"
    )


def stamp_of(python: str, locks: "list[str]") -> str:
    """Return a hash of what the environment is made of: interpreter, path and lock files."""
    digest = hashlib.sha256(os.fsencode(os.path.realpath(shutil.which(python) or python)))
    digest.update(repr(version_of(python)).encode())
    digest.update(os.fsencode(VENV))
    for lock in locks:
        with open(lock, "rb") as stream:
            digest.update(stream.read())
    return digest.hexdigest()


def read(path: str) -> str:
    """Return a file's text; "" if it cannot be read."""
    try:
        with open(path, "rb") as stream:
            return os.fsdecode(stream.read())
    except OSError:
        return ""


def write(path: str, text: str) -> None:
    """Write a file; a path in the text may have any characters, whatever the locale."""
    with open(path, "wb") as stream:
        stream.write(os.fsencode(text))


def why_offline(output: str) -> str:
    """Return why pip got no package from its index; "" if that is not what its output shows.

    pip then says that no version satisfies the requirement, which is misleading.
    """
    if not any(mark in output for mark in UNREACHABLE):
        return ""
    known = next((reason for reason in REASONS if reason in output), "")
    return "PyPI cannot be reached: " + known if known else "PyPI does not answer."


def make_venv(python: str, lock: str, stamp: str) -> None:
    """Make `.venv` from scratch; the stamp is written last and marks it as complete."""
    if os.pathsep in VENV:
        fail(
            "The path of this checkout contains a '%s', which Python environments do not allow: %s\n"
            "Rename or move the folder." % (os.pathsep, ROOT)
        )
    shutil.rmtree(VENV, ignore_errors=True)
    notify("setting up the grader's Python environment in %s (once)" % VENV)
    made = subprocess.run(
        [python, "-m", "venv", VENV], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False
    )
    if made.returncode:
        shutil.rmtree(VENV, ignore_errors=True)
        fail(
            made.stdout.decode(errors="replace") + "\nThis Python cannot make a virtual "
            "environment. On Debian and Ubuntu: apt-get install python3-venv"
        )
    inner = os.path.join(VENV, "bin", "python")
    # the lock's pip first: it needs half the time of the one that Python 3.11 brings
    packages = requirements(lock)
    pip = [lines for lines in packages if lines.startswith("pip==")]
    install(inner, [pip])
    # one process of pip for each core: most of its time is unpacking
    cores = min(4, os.cpu_count() or 1)
    install(inner, [packages[first::cores] for first in range(cores)])
    compile_all(inner)
    write(CHOSEN, os.path.realpath(shutil.which(python) or python))
    write(os.path.join(VENV, "stamp"), stamp)


def install(python: str, parts: "list[list[str]]") -> None:
    """Install requirements, all parts at once; end with the reason if pip cannot."""
    started = []
    with tempfile.TemporaryDirectory() as folder:
        for number, part in enumerate(parts):
            listed = os.path.join(folder, "%d.txt" % number)
            write(listed, "".join(part))
            output = os.path.join(folder, "%d.log" % number)
            with open(output, "wb") as log:
                command = pip_install(python, listed)
                started.append((subprocess.Popen(command, stdout=log, stderr=log), output))
        failed = [read(output).strip() for process, output in started if process.wait()]
    if failed:
        output = failed[0]
        offline = why_offline(output)
        problem = "pip could not install the locked packages."
        fail(
            (problem + " " + offline if offline else output + "\n" + problem)
            + "\nCheck the network (HTTPS_PROXY, PIP_CERT), then run the command again."
        )


def requirements(lock: str) -> "list[str]":
    """Return the packages of a lock file, each with the lines of its version and hashes."""
    found = []  # type: list[str]
    for line in read(lock).splitlines(True):
        if line[:1].isalnum():
            found.append(line)
        elif found and line.startswith((" ", "\t")) and line.strip()[:1] != "#":
            found[-1] += line
    return found


def pip_install(python: str, lock: str) -> "list[str]":
    """Return the command that installs exactly what a lock file lists."""
    options = ["-q", "--disable-pip-version-check", "--no-input", "--only-binary", ":all:"]
    # --no-deps: the file lists them all; --no-compile: compile_all does it on all cores
    options += ["--require-hashes", "--no-deps", "--no-compile"]
    return [python, "-m", "pip", "install", *options, "-r", lock]


def compile_all(python: str) -> None:
    """Compile the installed packages and the project.

    Otherwise every start compiles them if PYTHONDONTWRITEBYTECODE is set or `.venv` is read-only.
    """
    code = "import sysconfig; print(sysconfig.get_paths()['purelib'])"
    packages = subprocess.check_output([python, "-c", code]).decode().strip()
    places = [packages] + [os.path.join(ROOT, name) for name in ("grader", "lab", "tests")]
    places = [place for place in places if os.path.isdir(place)]
    # -j 0: one process for each core; not what no command of ours imports
    unused = "/keys/|/starter/|/tests?/|/(mypy|mypyc|pygments/lexers|docutils|dask/(array|bag|dataframe))/"
    command = [python, "-m", "compileall", "-q", "-j", "0", "-x", unused]
    subprocess.run(command + places, stdout=subprocess.DEVNULL, check=False)


def run_quietly(command: "list[str]") -> "tuple[bool, str]":
    """Run a command; return whether it failed, and its stderr."""
    environment = dict(os.environ, DEBIAN_FRONTEND="noninteractive")
    result = subprocess.run(
        command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, check=False, env=environment
    )
    return result.returncode != 0, result.stderr.decode(errors="replace").strip()


def ensure_bubblewrap() -> None:
    """Install bubblewrap if root; else print what to install."""
    if shutil.which("bwrap"):
        return
    if os.geteuid() == 0:
        for command in INSTALLERS:
            if shutil.which(command[0]) is None:
                continue
            notify("installing bubblewrap (%s)" % " ".join(command))
            failed, errors = run_quietly(command)
            if failed and command[0] == "apt-get":  # the machine may have no package lists yet
                run_quietly(["apt-get", "update", "-qq"])
                failed, errors = run_quietly(command)
            if not failed and shutil.which("bwrap"):
                return
            notify(errors)
            break
    notify("bubblewrap is missing: install it, e.g. sudo apt-get install bubblewrap")


def main() -> None:
    """Make what is missing; takes a few milliseconds if nothing is."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "--python", help="the interpreter (default: the one used before, else python3)"
    )
    parser.add_argument("--tests", action="store_true", help="also install what the tests need")
    options = parser.parse_args()
    locks = [
        os.path.join(ROOT, "grader", "requirements.txt"),
        os.path.join(ROOT, "tests", "requirements.txt"),
    ]
    with contextlib.ExitStack() as held:
        writable = hold_lock(held)
        python = find_python(options.python or read(CHOSEN) or "python3")
        there = read(os.path.join(VENV, "stamp"))
        small, full = (stamp_of(python, locks[:1]), stamp_of(python, locks))
        if there != full and (options.tests or there != small):
            if not writable:
                fail(
                    "You may not write to %s, and its Python environment is missing or out of "
                    "date.\nAsk its owner to run `make setup` there, or use a checkout of your own."
                    % ROOT
                )
            wanted = (locks[1], full) if options.tests else (locks[0], small)
            make_venv(python, wanted[0], wanted[1])
    ensure_bubblewrap()


def hold_lock(held: "contextlib.ExitStack") -> bool:
    """Hold the lock on `.venv` in a stack of contexts; return whether the checkout is writable.

    A lab that is installed once for all is not, and needs no lock if its environment is complete.
    """
    try:
        lock = held.enter_context(open(os.path.join(ROOT, ".venv.lock"), "a"))
    except OSError:
        return False
    fcntl.flock(lock, fcntl.LOCK_EX)
    return True


if __name__ == "__main__":
    main()
