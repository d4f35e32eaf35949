"""Whether a package's program could tell that it is being marked.

Under marking, ROS time is driven. So a program could tell by whatever shows a clock, its parameters,
its command line, its environment, files, who is on the graph, or how many callbacks fit into a time
of its own. One table has what cannot tell; a program that uses anything else is also run plainly, as
a person would run it. The names of rclpy are those of its public objects in jazzy and kilted.
"""

from __future__ import annotations

import ast
import builtins
import contextlib
import re
from collections.abc import Iterator, Sequence
from itertools import islice

from grader.package.intake.model import SourceFile
from grader.package.source.module import Module, parse_module
from grader.package.source.names import dotted, last_part
from grader.package.source.python import PythonFault
from grader.package.source.remarks import COMPILED, MOST_BYTES, NOT_THE_NODE, Remark


def _words(text: str) -> frozenset[str]:
    return frozenset(text.split())


MODULES = _words(
    "__future__ abc array collections contextlib copy dataclasses decimal enum fractions "
    "functools itertools math numbers random re rclpy statistics sys textwrap "
    "traceback types typing typing_extensions"
)
OF_RCLPY = _words(
    "action callback_groups duration exceptions executors lifecycle logging node parameter publisher qos "
    "service client subscription timer task"
)
INTERFACES = frozenset(("msg", "srv", "action"))
WITH_TIMES = frozenset(("rosgraph_msgs", "rcl_interfaces", "builtin_interfaces"))
OF_SYS = frozenset(("exit", "stderr", "stdout", "argv"))
CANNOT = _words(
    # rclpy
    "init shutdown try_shutdown ok spin create_node get_logger "
    # a node
    "add_on_set_parameters_callback add_post_set_parameters_callback add_pre_set_parameters_callback "
    "create_client create_lifecycle_publisher create_publisher create_rate create_service "
    "create_subscription create_timer declare_parameter declare_parameters default_callback_group "
    "destroy destroy_client destroy_lifecycle_publisher destroy_node destroy_publisher destroy_rate "
    "destroy_service destroy_subscription destroy_timer get_name get_namespace get_parameter "
    "remove_on_set_parameters_callback set_descriptor on_activate on_cleanup on_configure "
    "on_deactivate on_error on_shutdown trigger_activate trigger_cleanup trigger_configure "
    "trigger_deactivate trigger_shutdown "
    # its ends, parameters, executors and timers
    "publish topic_name service_name send_response call call_async wait_for_service service_is_ready "
    "name value type_ get_parameter_value add_node remove_node cancel is_canceled reset sleep depth "
    "durability history reliability deadline lifespan liveliness liveliness_lease_duration "
    # futures, actions, logs
    "add_done_callback cancelled done exception result set_exception set_result abort accepted "
    "canceled succeed publish_feedback is_active is_cancel_requested goal_id request status execute "
    "get_result get_result_async send_goal send_goal_async wait_for_server server_is_ready "
    "cancel_goal cancel_goal_async register_cancel_callback register_execute_callback "
    "register_goal_callback register_handle_accepted_callback notify_execute debug info warn warning "
    "error fatal get_child log PARAM_REL_TOL Type CallbackType callback action_type nanoseconds "
    "from_parameter_msg to_parameter_msg"
)
"""The names of rclpy's objects that show nothing of clocks, of the graph, or of where they run."""
COULD = _words(
    "add_future add_managed_entity add_to_wait_set add_waitable assert_liveliness "
    "avoid_ros_namespace_conventions can_execute clients clock clock_type configure_introspection "
    "context count_clients count_publishers count_services count_subscribers create_guard_condition "
    "create_jump_callback create_task describe_parameter describe_parameters destroy_guard_condition "
    "executor from_msg get_c_duration get_c_qos_profile get_client_names_and_types_by_node get_clock "
    "get_domain_id get_effective_level get_fully_qualified_name get_fully_qualified_node_names "
    "get_node_names get_node_names_and_namespaces get_node_names_and_namespaces_with_enclaves "
    "get_nodes get_num_entities get_parameter_or get_parameter_type get_parameter_types "
    "get_parameters get_parameters_by_prefix get_pending_request get_publisher_count "
    "get_publisher_names_and_types_by_node get_publishers_info_by_topic get_service_names_and_types "
    "get_service_names_and_types_by_node get_subscriber_names_and_types_by_node "
    "get_subscription_count get_subscriptions_info_by_topic get_topic_names_and_types guards handle "
    "has_parameter is_enabled_for is_ready list_parameters logger_name notify_goal_done now "
    "publishers remove_done_callback remove_future remove_pending_request "
    "remove_post_set_parameters_callback remove_pre_set_parameters_callback remove_waitable "
    "resolve_service_name resolve_topic_name ros_time_is_active seconds_nanoseconds services "
    "set_level set_parameters set_parameters_atomically set_ros_time_override sleep_for sleep_until "
    "spin_once spin_once_until_future_complete spin_until_future_complete stamp subscriptions "
    "take_data time_since_last_call time_until_next_call timer_period_ns timers to_msg trigger "
    "undeclare_parameter wait_for_all_acked wait_for_node wait_for_ready_callbacks waitables wake "
    # of messages and of what a callback is told
    "sec nanosec expected_call_time actual_call_time"
)
"""The other names: any of them, of whatever object, could tell."""
BUILTINS = _words(
    "abs all any bool bytearray bytes callable chr classmethod complex dict divmod enumerate filter "
    "float format frozenset int isinstance issubclass iter len list map max min next object ord pow "
    "print property range repr reversed round set slice sorted staticmethod str sum super tuple zip "
    "__name__ Ellipsis NotImplemented"
)
RISKY = frozenset(
    name
    for name in dir(builtins)
    if name not in BUILTINS
    and not (
        isinstance(found := getattr(builtins, name), type) and issubclass(found, BaseException)
    )
    and name not in ("True", "False", "None")
)
OWN_WORDS = frozenset(("__init__", "__name__", "__str__", "__repr__", "__doc__"))
ARGUMENTS = ("args", "argv")  # of main
BY_FORMAT = r"\{\w*(?:\.[A-Za-z_]|\[)"  # str.format reads attributes and items
TEXTS = re.compile(
    r"use_sim_time|^/clock$|^clock$|/proc\b|/etc/|/sys/|dockerenv|bwrap|grader|_timestamp$|"
    + BY_FORMAT
)
MOST_TOLD = 8  # places


def could_tell(files: Sequence[SourceFile]) -> bool:
    """Return whether a package's program could tell that it is marked."""
    return next(_telling(files), None) is not None


def telling(files: Sequence[SourceFile]) -> list[Remark]:
    """Return by what a package's program could tell that it is marked: the first place of each thing.

    Of a module or an object, what is used of it stands for it.
    """
    first: dict[str, Remark] = {}
    for one in _telling(files):
        first.setdefault(one.what, one)
    used = {what.rpartition(".")[0].removesuffix("()") for what in first}
    return list(islice((one for what, one in first.items() if what not in used), MOST_TOLD))


def _telling(files: Sequence[SourceFile]) -> Iterator[Remark]:
    nodes = [f for f in files if f.kind == "file" and not NOT_THE_NODE.search(f.path)]
    own = {part for file in nodes for part in file.path.removesuffix(".py").split("/")}
    modules = []
    for file in nodes:
        if file.path.endswith(COMPILED) or len(file.data) > MOST_BYTES:
            yield Remark("hides", file.path, None, file.path)
            continue
        if file.path.endswith(".py"):
            with contextlib.suppress(PythonFault):
                modules.append(parse_module(file.path, file.data))
    made = {name for module in modules for name in _made_in(module)}
    for module in modules:
        for node, what in _in_module(module, own, made):
            yield Remark("asks", module.path, getattr(node, "lineno", None), what)


def _in_module(module: Module, own: set[str], made: set[str]) -> Iterator[tuple[ast.AST, str]]:
    brought = _brought_in(module, own)
    for node in module.nodes:
        match node:
            case ast.Import() | ast.ImportFrom():
                yield from ((node, name) for name in _imported(node, own))
            case ast.Name(id=name, ctx=ast.Load()):
                argument = name in ARGUMENTS and not is_passed_on(module, node)
                argument = argument and not _is_compared_with_none(module, node)
                if argument or (name in RISKY and name not in made):
                    yield node, name
            case ast.Attribute(attr=name, ctx=ast.Load()):
                if dotted(node.value) in brought or not _is_harmless(module, node, made):
                    yield node, dotted(node) or name
            case ast.Constant(value=str() as text):
                if TEXTS.search(text) and not isinstance(module.parents.get(node), ast.Expr):
                    yield node, text[:60]
            case ast.Call(func=function, args=words):
                constant = bool(words) and isinstance(words[0], ast.Constant)
                if last_part(dotted(function)) == "get_parameter" and not constant:
                    yield node, "get_parameter"
            case ast.MatchClass(kwd_attrs=[name, *_]):
                yield node, name


def _brought_in(module: Module, own: set[str]) -> set[str]:
    """Return the names under which a module has others that are not in the table."""
    return {
        one.asname or one.name
        for node in module.nodes
        if isinstance(node, ast.Import)
        for told in ({*_imported(node, own)},)
        for one in node.names
        if one.name in told
    }


def is_passed_on(module: Module, node: ast.AST) -> bool:
    """Whether a name is only handed to rclpy.init or main, as many examples do.

    Also as one of two values: `args or sys.argv`, `sys.argv if args is None else args`.
    """
    inner, outer = node, module.parents.get(node)
    while isinstance(outer, ast.BoolOp) or (
        isinstance(outer, ast.IfExp) and inner is not outer.test
    ):
        inner, outer = outer, module.parents.get(outer)
    if isinstance(outer, ast.keyword):
        outer = module.parents.get(outer)
    return isinstance(outer, ast.Call) and last_part(dotted(outer.func)) in ("init", "main")


def _is_compared_with_none(module: Module, node: ast.AST) -> bool:
    """Whether a name stands in `args is None`, which is so wherever an entry point calls main."""
    outer = module.parents.get(node)
    return (
        isinstance(outer, ast.Compare)
        and isinstance(outer.ops[0], ast.Is | ast.IsNot)
        and isinstance(outer.comparators[0], ast.Constant)
    )


def _made_in(module: Module) -> set[str]:
    """Return the names that the module gives to something of its own."""
    made = set[str]()
    for node in module.nodes:
        if isinstance(node, ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
            made.add(node.name)
        elif isinstance(node, ast.Name | ast.Attribute) and not isinstance(node.ctx, ast.Load):
            made.add(node.id if isinstance(node, ast.Name) else node.attr)
        elif isinstance(node, ast.arg):
            made.add(node.arg)
    return made


def _imported(node: ast.Import | ast.ImportFrom, own: set[str]) -> Iterator[str]:
    """Yield what an import brings in that could tell."""
    if isinstance(node, ast.ImportFrom) and node.level:
        return
    names = [alias.name for alias in node.names]
    modules = names if isinstance(node, ast.Import) else [node.module or ""]
    for name in modules:
        root, _, rest = name.partition(".")
        if root in own or (rest.partition(".")[0] in INTERFACES and root not in WITH_TIMES):
            continue
        if root not in MODULES or (root == "rclpy" and rest and rest.split(".")[0] not in OF_RCLPY):
            yield name
        elif isinstance(node, ast.ImportFrom):
            allowed = {"sys": OF_SYS - {"argv"}, "rclpy": CANNOT | OF_RCLPY}.get(name)
            yield from (each for each in names if allowed is not None and each not in allowed)


def _is_harmless(module: Module, node: ast.Attribute, made: set[str]) -> bool:
    """Whether an attribute is of the program itself, of Python's own types, or of the table."""
    name, root = node.attr, dotted(node.value)
    if root == "sys":
        return name in OF_SYS and (name != "argv" or is_passed_on(module, node))
    if name in COULD or (name.startswith("_") and name not in made | OWN_WORDS):
        return False
    if root in ("self", "rclpy"):
        return name in made or name in CANNOT or (root == "rclpy" and name in OF_RCLPY)
    return True
