"""Packages whose setup.py, which colcon runs, is hostile. They are bounded as in hostile_node."""

from __future__ import annotations

from .hostile_edits import in_setup
from .model import BUILT, INSTALLED, Package, hostile

ESCAPED = "corpus-escaped"  # a file of this name outside the sandbox is proof of an escape
OUTSIDE = f"""
import os
for folder in ('/tmp', '/var/tmp', '/dev/shm', os.path.expanduser('~'), '/', '../../../..'):
    try:
        open(os.path.join(folder, '{ESCAPED}'), 'w').close()
    except OSError:
        pass
"""
DAEMON = """
import os
import time
if os.fork() == 0:
    os.setsid()
    if os.fork() == 0:
        for number in range(3):
            os.dup2(os.open('/dev/null', os.O_RDWR), number)
        time.sleep(60)
    os._exit(0)
"""
HOLDER = """
import os
import time
if os.fork() == 0:
    time.sleep(60)
    os._exit(0)
"""
FORGED = """
import sys
open('report.json', 'w').write('{"schema": 1, "status": "graded", "score": 100}')
print('Summary: 1 package finished [0.50s]')
print('Hello time: 0')
sys.exit(0)
"""
FLOOD = """
for _ in range(300_000):
    print('x' * 1000)
"""
FORKS = """
import os
import time
for _ in range(3000):
    try:
        if os.fork() == 0:
            time.sleep(30)
            os._exit(0)
    except OSError:
        break
"""
MEMORY = """
import os
hog = [bytearray(os.urandom(1)) * 10_000_000 for _ in range(300)]
"""
DEAF = """
import signal
import time
for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
    signal.signal(number, signal.SIG_IGN)
time.sleep(120)
"""
KILL = """
import os
import signal
os.killpg(0, signal.SIGKILL)
"""
SECRETS = """
import os
import sys
for path in ('/etc/shadow', '/root/.ssh/id_rsa', '/work/main/grader/keys/hello_time'):
    try:
        print(os.listdir(path) if os.path.isdir(path) else open(path).read(), file=sys.stderr)
    except OSError:
        pass
for key, value in os.environ.items():
    print('ENV', key, value, file=sys.stderr)
"""

PAINTS = """
import os
import sys
if 'develop' in sys.argv and '--help' not in sys.argv:
    for stream in (1, 2):
        os.write(stream, b'\\x1b[2J\\x1b[1;1H\\x1b]0;owned\\x07\\x1b[32mScore 100 / 100\\x1b[0m\\n'
                 b'\\xe2\\x80\\xae\\xc2\\x9b31m100 / 100 every check passed\\n')
    os._exit({status})
"""


SETUPS: tuple[Package, ...] = (
    hostile("setup_writes_outside", in_setup(OUTSIDE),
            note=f"writes {ESCAPED} wherever it can"),
    hostile("setup_reads_secrets", in_setup(SECRETS)),
    hostile("setup_outlives_us", in_setup(DAEMON), note="a daemon that sleeps"),
    hostile("setup_holds_the_build", in_setup(HOLDER), failed={"build.colcon": "build.timeout"},
            skipped=INSTALLED,
            note="a child keeps setup.py's output open, and colcon waits for its end"),
    hostile("setup_forges_a_report", in_setup(FORGED), failed={"build.colcon": "build.exited"},
            skipped=INSTALLED),
    hostile("setup_prints_megabytes", in_setup(FLOOD), undecided=BUILT),
    hostile("setup_fork_bomb", in_setup(FORKS), undecided=BUILT),
    hostile("setup_eats_memory", in_setup(MEMORY), undecided=BUILT, note="3 GB at most"),
    hostile("setup_deaf", in_setup(DEAF), failed={"build.colcon": "build.timeout"},
            skipped=INSTALLED),
    hostile("setup_kills_its_group", in_setup(KILL), failed={"build.colcon": None},
            skipped=INSTALLED, note="kills colcon as well"),
    hostile("setup_paints_and_ends_with_250", in_setup(PAINTS.format(status=250)),
            failed={"build.colcon": "build.failed"}, skipped=INSTALLED,
            note="a forged score, escape sequences, and a status that was the grader's own"),
    hostile("setup_paints_and_ends_with_251", in_setup(PAINTS.format(status=251)),
            failed={"build.colcon": "build.failed"}, skipped=INSTALLED),
)  # fmt: skip
