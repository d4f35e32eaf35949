"""The graph: nodes, topics and services that are not found, QoS, domains, the middleware."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.explain import looks
from grader.explain.terminal_text import Case, TerminalText
from grader.mistakes import links

KINDS = (
    TerminalText(
        id="lab.qos", link=links.QOS,
        title=msg("Publisher and subscriber do not agree on their QoS"),
        why=msg("A subscriber gets messages only if the publisher offers at least what it asks for: "
                "RELIABLE is more than BEST_EFFORT, TRANSIENT_LOCAL more than VOLATILE. On {topic} they "
                "differ."),
        fix=msg("Run ros2 topic info -v {topic}: it shows the QoS of both. Give create_subscription and "
                "create_publisher the same, in place of the 10."),
        cases=(
            Case(r"on topic '(?P<topic>[^'\n]{1,120})'[^\n]{0,200}RELIABILITY",
                 why=msg("On {topic}, the publisher is BEST_EFFORT (as sensors are) and the subscriber asks "
                         "for RELIABLE. So no message comes."),
                 fix=msg("In the subscriber, write create_subscription(…, qos_profile_sensor_data) in place "
                         "of the 10, with from rclpy.qos import qos_profile_sensor_data. Or make the "
                         "publisher RELIABLE: give it 10. ros2 topic info -v {topic} shows both.")),
            Case(r"on topic '(?P<topic>[^'\n]{1,120})'[^\n]{0,200}DURABILITY",
                 why=msg("On {topic}, the subscriber asks for TRANSIENT_LOCAL (also what was sent before it "
                         "came), and the publisher is VOLATILE (only what comes from now on)."),
                 fix=msg("Give both the same: QoSProfile(depth=10, "
                         "durability=DurabilityPolicy.TRANSIENT_LOCAL) from rclpy.qos in place of the 10, "
                         "or 10 in both. ros2 topic info -v {topic} shows both.")),
        ),
        seen=r"New (?:publisher|subscription) discovered on (?:on )?(?:topic|service) '(?P<topic>[^'\n]{1,120})', "
             r"(?:offering|requesting) incompatible QoS|(?:offering|requesting) incompatible QoS[^\n]{0,120}"
             r"|[Ii]ncompatible QoS[^\n]{0,120}",
        values={"topic": "/scan"},
    ),
    TerminalText(
        id="lab.no_topic", link=links.TOPICS,
        title=msg("Nobody publishes that topic where this terminal looks"),
        why=msg("ros2 topic takes the type of a topic from its publishers. None is seen here: the node does "
                "not run, its topic has another name, or it is in another domain."),
        fix=msg("Run ros2 topic list -t while the node runs, and compare the name (with its / and "
                "namespace). If the list lacks it: start the node, and check that echo $ROS_DOMAIN_ID is "
                "the same in both terminals."),
        cases=(
            Case(r"^\s{0,4}(?P<close>(?:/\w{1,80}){1,4}/(?P<name>\w{1,80}))\b[\s\S]{0,3000}topic \[/(?P=name)\] does not"
                 r"|topic \[/(?P<name_2>\w{1,80})\] does not[\s\S]{0,3000}?^\s{0,4}(?P<close_2>(?:/\w{1,80}){1,4}/(?P=name_2))\b",
                 why=msg("Nobody publishes /{name}. There is {close}: its node runs in a namespace, which comes "
                         "before the name."),
                 fix=msg("Run ros2 topic echo {close}. In a node of yours, write that name too, or start it in "
                         "the same namespace: ros2 run … --ros-args -r __ns:=/<namespace>, with the topic's "
                         "name without a / in front.")),
        ),
        seen=r"topic \[(?P<topic>[^\]\n]{1,120})\] does not appear to be published yet"
             r"|Could not determine the type for the passed topic|^Unknown topic '[^'\n]{1,120}'",
        look=(looks.graph_settings,),
    ),
    TerminalText(
        id="lab.no_server", link=links.SERVICES,
        title=msg("Nobody offers the service or the action"),
        why=msg("The client waits until a server with that name and type is there. None is seen."),
        fix=msg("Start the node with the server in another terminal. Then run ros2 service list -t (or ros2 "
                "action list -t) and compare name and type, also the namespace. In the server, rclpy.spin "
                "has to run."),
        seen=r"^(?:\[[^\n]{1,120}\]: )?(?:waiting for service to become available|[Ww]aiting for (?:an )?action server"
             r"|[Ss]ervice not available, ?waiting)[^\n]{0,60}",
        unless=r"^(?:response:|requester: making request|Result of \w)",
        look=(looks.graph_settings,),
    ),
    TerminalText(
        id="lab.no_node", link=links.NODES,
        title=msg("No node with that name is seen"),
        why=msg("The command asks a node by its name in the graph, which is not the name of its file or "
                "executable. It has to run at that moment, in the same domain."),
        fix=msg("Run ros2 node list while the node runs, and copy the name from there, with its /. If the "
                "list is empty, run ros2 daemon stop and try again."),
        seen=r"^Node not found|Unable to find node '?[^'\n]{0,120}|^Wait for service timed out waiting for "
             r"parameter services[^\n]{0,120}",
        look=(looks.graph_settings,),
    ),
    TerminalText(
        id="lab.nothing_seen", stage="terminal", link=links.DISCOVERY,
        title=msg("No node is seen from this terminal"),
        why=msg("/parameter_events and /rosout are the topics of the ros2 command itself. Nodes find each "
                "other by multicast, in the same domain and network only: not through most WLANs of "
                "schools, not from WSL or a container to another computer unless they share its network."),
        fix=msg("Run printenv | grep -E 'ROS_|RMW_' in both terminals: ROS_DOMAIN_ID and RMW_IMPLEMENTATION "
                "have to be the same, ROS_LOCALHOST_ONLY 0 for two computers. Then ros2 daemon stop, and "
                "list again. Test the network: ros2 multicast receive on one, ros2 multicast send on the "
                "other. For WSL: networkingMode=mirrored in .wslconfig; for a container: --network host"),
        in_lab=msg("Start the node in another terminal of the same lab: make lab again, with the same "
                   "workspace. Then ros2 daemon stop, and list again."),
        cases=(
            Case(r"\bROS_DOMAIN_ID=(?P<number>[1-9]\d{0,2})\b",
                 why=msg("ROS_DOMAIN_ID is {number} in one place of this text. Nodes find each other only in the "
                         "same domain; where it is not set, the domain is 0."),
                 fix=msg("Run echo $ROS_DOMAIN_ID in both terminals. Where {number} does not come: export "
                         "ROS_DOMAIN_ID={number}, then ros2 daemon stop, and start the nodes there again. (A line "
                         "in ~/.bashrc is for new terminals only.) If it is the same in both, test the network: "
                         "ros2 multicast receive on one, ros2 multicast send on the other.")),
            Case(r"\b10\.0\.2\.15\b",
                 why=msg("10.0.2.15 is the address of a virtual machine behind NAT. It reaches others (ping), "
                         "and they do not reach it; so nodes do not find each other."),
                 fix=msg("In the settings of the virtual machine, set the network adapter to Bridged. Start the "
                         "machine again: ip address must show an address like that of the other computer. "
                         "Then ros2 daemon stop, and list again.")),
        ),
        values={"number": "30"},
        seen=r"ros2 topic list[^\n]{0,20}\n/parameter_events\n/rosout\n?(?=\Z|[^\n/]{0,80}[$#%>])",
        look=(looks.graph_settings,),
    ),
    TerminalText(
        id="lab.daemon", link=links.DISCOVERY,
        title=msg("The daemon of the ros2 command does not work any more"),
        why=msg("ros2 asks a program in the background, the daemon, what nodes there are. It has lost its "
                "connection, or is of another ROS that was sourced before."),
        fix=msg("Run ros2 daemon stop, then the command again: a new daemon starts by itself."),
        seen=r"xmlrpc\.client\.(?:Fault|ProtocolError|ResponseError)[^\n]{0,200}|ros2cli/node/daemon\.py\"[\s\S]{0,3000}?"
             r"(?:ConnectionRefusedError|TimeoutError|ConnectionResetError)[^\n]{0,120}",
    ),
    TerminalText(
        id="lab.network_interface", link=links.MIDDLEWARE,
        title=msg("The middleware's settings name a network that this computer does not have"),
        why=msg("CYCLONEDDS_URI names a file with settings, and that names {name}. There is no such network "
                "interface here, so that no node can start."),
        fix=msg("Run ip -br address to see the names, and write the one that is UP into the file of "
                "CYCLONEDDS_URI. Or do without: unset CYCLONEDDS_URI (also in ~/.bashrc)."),
        seen=r"(?P<name>[\w.:-]{1,40}): does not match an available interface",
        values={"name": "eth0"},
    ),
    TerminalText(
        id="lab.shared_memory", link=links.MIDDLEWARE,
        title=msg("The shared memory of the middleware cannot be used"),
        why=msg("Nodes on one machine exchange messages in files in /dev/shm. These belong to another user "
                "(a node that ran with sudo, a container), or are left from a node that was killed."),
        fix=msg("Stop all nodes, also those in containers. Then run rm /dev/shm/fastrtps_* /dev/shm/sem.fastrtps_* "
                "(with sudo if they belong to root), and start the nodes as one user. Between containers: "
                "--ipc host and the same user, or export FASTDDS_BUILTIN_TRANSPORTS=UDPv4 in both."),
        in_lab=msg("Stop all nodes with Ctrl+C, run rm /dev/shm/fastrtps_* and start them again."),
        seen=r"RTPS_TRANSPORT_SHM Error\][^\n]{0,200}",
    ),
    TerminalText(
        id="lab.middleware", link=links.MIDDLEWARE,
        title=msg("The middleware that RMW_IMPLEMENTATION names is not there"),
        why=msg("ROS loads the library of {rmw}, because this terminal has RMW_IMPLEMENTATION. It is not "
                "installed here."),
        fix=msg("Run unset RMW_IMPLEMENTATION, and look for the line in ~/.bashrc. If you want it: sudo "
                "apt-get install ros-{distro}-{debian}"),
        in_lab=msg("Run: unset RMW_IMPLEMENTATION"),
        seen=r"lib(?P<rmw>rmw_\w{1,60})\.so[^\n]{0,200}(?:cannot open shared object|No such file|not found)"
             r"|(?:failed to load|could not load|Could not load|error loading)[^\n]{0,80}"
             r"lib(?P<rmw_2>rmw_\w{1,60})\.so[^\n]{0,200}"
             r"|RMW implementation '?(?P<rmw_3>rmw_\w{1,60})'?[^\n]{0,80}(?:not found|not installed)"
             r"|[Ee]xpected RMW implementation identifier of '(?P<rmw_4>\w{1,60})'[^\n]{0,120}",
        values={"rmw": "rmw_cyclonedds_cpp", "debian": "rmw-cyclonedds-cpp"},
        look=(looks.graph_settings,),
    ),
    TerminalText(
        id="lab.domain", link=links.DOMAINS,
        title=msg("ROS_DOMAIN_ID is no number that can be used"),
        why=msg("The domain is a whole number. Up to 101, its ports are free on every system; above 232 "
                "there are none."),
        fix=msg("Run export ROS_DOMAIN_ID=7 (any number from 0 to 101), the same in every terminal, and "
                "correct the line in ~/.bashrc. Then ros2 daemon stop."),
        seen=r"ROS_DOMAIN_ID is not an integral number|ROS_DOMAIN_ID[^\n]{0,60}(?:out of range|too large|invalid)"
             r"|[Dd]omain [Ii][Dd][^\n]{0,40}(?:out of range|too (?:big|high|large)|over 232)",
        look=(looks.graph_settings,),
    ),
    TerminalText(
        id="lab.two_nodes", stage="terminal", link=links.NODES,
        title=msg("Two nodes run at the same time"),
        why=msg("A node that still runs in another terminal keeps counting: the lines of two counters "
                "are mixed."),
        fix=msg("Press Ctrl+C in the other terminal. ros2 node list shows what still runs."),
        seen=r"nodes in the graph that share an exact name",
    ),
)  # fmt: skip
