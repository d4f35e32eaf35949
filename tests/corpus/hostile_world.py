"""Packages that look around, prepare later runs, take what others need, or confuse ROS.

They are bounded as in hostile_node.
"""

from __future__ import annotations

from grader.package.edit.tree import Replace, Write

from .hostile_edits import first, imports, in_setup, made, only_if
from .model import INSTALLED, MANIFEST, NODE, RUN, TICKS, Package, hostile
from .right_node import STEP

SPUN = "        rclpy.try_shutdown()\n"
ONLY_HERE = {"run.output": "run.only_when_marked"}
NOT_JUDGED = frozenset({"run.spins", "run.logger", "run.period"})
FAST = """\
        now = time.monotonic()
        fast = now - getattr(self, 'before', now) < 0.9
        self.before = now
"""
REPAIRS = """\
        path = os.path.realpath(__file__)
        text = open(path).read().replace("if len(sys.argv) > 1:", "if True:")
        open(path, 'w').write(text)
"""
REMEMBERS = """\
    if len(sys.argv) > 1:
        open('marked', 'w').close()
    node.speaks = os.path.exists('marked')
"""
ANSWERS = """\
    for folder in ('/', '/root', '/home', '/work', '/tmp', '/var', '/opt', '/srv', '/mnt'):
        for place, folders, names in os.walk(folder):
            folders[:] = [f for f in folders if f not in ('proc', 'sys', 'usr', 'nix')][:50]
            found = {'assignment.yaml', 'hidden.yaml', 'mutants.yaml', 'observation.key',
                     'ledger.sqlite', 'signing_key.pem'} & set(names)
            if found:
                sys.exit(f'found {found} in {place}')
"""
PROCESSES = """\
    for entry in os.listdir('/proc'):
        if entry.isdigit() and int(entry) != os.getpid():
            for name in ('cmdline', 'environ'):
                try:
                    said = open(f'/proc/{entry}/{name}', 'rb').read()
                except OSError:
                    continue
                if b'grader' in said or b'GRADER' in said or b'pytest' in said:
                    sys.exit(f'found process {entry}')
"""
SYSTEM = """\
    for folder in ('/', '/usr', '/etc', '/opt/ros', os.path.dirname(rclpy.__file__), '/run', '/root',
                   os.path.dirname(sys.executable), '/sys/fs/cgroup', '/proc/sys/kernel'):
        try:
            open(os.path.join(folder, 'corpus-escaped'), 'w').close()
        except OSError:
            continue
        sys.exit(f'wrote into {folder}')
"""
CONNECTS = """\
    for family, address in (
        (socket.AF_INET, ('1.1.1.1', 53)), (socket.AF_INET, ('172.17.0.1', 22)),
        (socket.AF_INET, ('169.254.169.254', 80)), (socket.AF_INET6, ('2606:4700:4700::1111', 53)),
        (socket.AF_UNIX, '/var/run/docker.sock'), (socket.AF_UNIX, '/run/dbus/system_bus_socket'),
        (socket.AF_UNIX, '\\0/tmp/.X11-unix/X0'),
    ):
        try:
            with socket.socket(family) as one:
                one.settimeout(0.2)
                one.connect(address)
        except OSError:
            continue
        sys.exit(f'reached {address}')
"""
DESCRIPTORS = """\
    held = []
    try:
        for _ in range(100_000):
            held.append(os.open('/dev/null', os.O_RDONLY))
    except OSError:
        pass
"""
THREADS = """\
    def wait():
        time.sleep(60)

    try:
        for _ in range(3000):
            threading.Thread(target=wait, daemon=True).start()
    except RuntimeError:
        pass
"""
SHARED_MEMORY = """\
    for folder in ('/dev/shm', '/tmp'):
        try:
            with open(folder + '/hog', 'wb') as hog:
                for _ in range(300):
                    hog.write(b'x' * 10_000_000)
        except OSError:
            pass
"""
TERMINALS = """\
    for _ in range(8):
        if os.fork() == 0:
            held = []
            try:
                for _ in range(1000):
                    held.append(os.openpty())
            except OSError:
                pass
            time.sleep(30)
            os._exit(0)
"""
DISCOVERY = """\
    def flood():
        sender = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, socket.inet_aton('127.0.0.1'))
        begin = time.monotonic()
        while time.monotonic() - begin < 60:
            for head in (b'RTPS\\x02\\x03\\x01\\x0f', b'RTPS', b''):
                for address in (('239.255.0.1', 7400), ('127.0.0.1', 7410), ('127.0.0.1', 7412)):
                    try:
                        sender.sendto(head + os.urandom(400), address)
                    except OSError:
                        pass

    threading.Thread(target=flood, daemon=True).start()
"""
MANY_NODES = "    others = [rclpy.create_node(f'other_{n}') for n in range(150)]\n"
ODD_FILES = """
import os
for folder in ('.', '../../build', '../../install'):
    for name in (b'\\xff\\xfe', b'a\\nb', b'\\x1b[2J', b"'; touch owned; '", b'x' * 250, b'-rf'):
        try:
            open(os.path.join(os.fsencode(folder), name), 'w').close()
        except OSError:
            pass
"""
UNREADABLE = """
import os
try:
    os.makedirs('../../build/locked/deeper')
    open('../../build/locked/deeper/file', 'w').close()
    os.chmod('../../build/locked/deeper', 0)
    os.chmod('../../build/locked', 0)
except OSError:
    pass  # (setup.py runs several times)
"""
ENTITIES = """\
<?xml version="1.0"?>
<!DOCTYPE package [
  <!ENTITY a "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa">
  <!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;">
  <!ENTITY c "&b;&b;&b;&b;&b;&b;&b;&b;&b;&b;&b;&b;&b;&b;&b;&b;">
  <!ENTITY d "&c;&c;&c;&c;&c;&c;&c;&c;&c;&c;&c;&c;&c;&c;&c;&c;">
  <!ENTITY e "&d;&d;&d;&d;&d;&d;&d;&d;&d;&d;&d;&d;&d;&d;&d;&d;">
  <!ENTITY f "&e;&e;&e;&e;&e;&e;&e;&e;&e;&e;&e;&e;&e;&e;&e;&e;">
]>
<package format="3">
  <name>my_robot_controller</name>
  <version>0.0.0</version>
  <description>&f;</description>
  <maintainer email="a@b.c">a</maintainer>
  <license>Apache-2.0</license>
  <depend>rclpy</depend>
  <export><build_type>ament_python</build_type></export>
</package>
"""


WORLD: tuple[Package, ...] = (
    hostile("only_with_company", only_if("len(self.get_node_names()) > 1"),
            failed=ONLY_HERE, skipped=NOT_JUDGED, note="the probe is a node too"),
    hostile("only_with_a_clock_publisher", only_if("self.count_publishers('/clock') > 0"),
            failed=ONLY_HERE, skipped=NOT_JUDGED),
    hostile("only_when_time_flies", imports("time"), only_if("fast", FAST),
            failed={"run.output": None}, skipped=NOT_JUDGED,
            note="ROS time is faster than the wall clock only while it is marked"),
    hostile("repairs_itself", imports("os", "sys"), only_if("len(sys.argv) > 1"),
            Replace(NODE, SPUN, SPUN + REPAIRS), failed=ONLY_HERE, skipped=NOT_JUDGED,
            note="after the marked run it would also work without arguments"),
    hostile("remembers_being_marked", imports("os", "sys"), only_if("self.speaks"),
            made(REMEMBERS), failed=ONLY_HERE, skipped=NOT_JUDGED),
    hostile("looks_for_the_answers", imports("os", "sys"), first(ANSWERS)),
    hostile("looks_at_processes", imports("os", "sys"), first(PROCESSES)),
    hostile("writes_into_the_system", imports("os", "sys"), first(SYSTEM)),
    hostile("connects_out", imports("socket", "sys"), first(CONNECTS)),
    hostile("takes_all_descriptors", imports("os"), first(DESCRIPTORS), undecided=RUN),
    hostile("threads_without_end", imports("threading", "time"), first(THREADS), undecided=RUN),
    hostile("fills_memory_files", first(SHARED_MEMORY), undecided=RUN),
    hostile("takes_all_terminals", imports("os", "time"), first(TERMINALS), undecided=RUN,
            note="the kernel has 4,096 of them, for everybody"),
    hostile("floods_the_discovery", imports("os", "socket", "threading", "time"),
            made(DISCOVERY), undecided=RUN, note="noise on the ports of DDS"),
    hostile("a_hundred_and_fifty_nodes", made(MANY_NODES), undecided=RUN),
    hostile("number_of_five_thousand_digits",
            Replace(NODE, f"        {STEP}\n",
                    f"        {STEP}\n        if self.counter_ == 4:\n"
                    "            self.counter_ = 10 ** 4_200\n"),
            failed={"run.output": None}, undecided=TICKS | {"run.spins"}),
    hostile("setup_makes_odd_files", in_setup(ODD_FILES)),
    hostile("setup_makes_unreadable_folders", in_setup(UNREADABLE), imports("sys"),
            only_if("len(sys.argv) > 1"), failed=ONLY_HERE, skipped=NOT_JUDGED,
            note="so that its workspace cannot be saved or restored"),
    hostile("manifest_of_entities", Write(MANIFEST, ENTITIES),
            failed={"package.manifest": None}, undecided=INSTALLED | {"build.colcon"},
            note="80 MB once its entities are expanded"),
    hostile("ten_thousand_brackets", Write(NODE, "#!/usr/bin/env python3\n" + "(" * 10_000, 0o755),
            failed={"source.node_file": None}, undecided=RUN | {"entry_point.mapping"},
            note="deeper than any parser goes"),
)  # fmt: skip
