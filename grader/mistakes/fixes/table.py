"""The fixes for each check and mistake, in the order in which they are tried."""

from __future__ import annotations

from grader.mistakes.fixes import (
    entries,
    first_line,
    layout,
    manifest,
    node_count,
    node_life,
    node_log,
    node_names,
    node_timer,
    setup_cfg,
    setup_py,
    syntax,
)
from grader.mistakes.fixes.case import Finding, Fix

STATIC: dict[str, tuple[Fix, ...]] = {
    "package.manifest": (
        manifest.rename,
        manifest.well_formed,
        manifest.version,
        manifest.name,
        manifest.build_type,
        setup_py.name,
    ),
    "package.marker": (layout.marker, setup_py.marker),
    "package.setup_cfg": (setup_cfg.syntax, setup_cfg.missing, setup_cfg.setting),
    "source.node_file": (
        layout.inner_folder,
        layout.node_file,
        layout.node_name,
        syntax.node,
    ),
    "source.exec_bit": (layout.exec_bit,),
    "source.shebang": (first_line.byte_order_mark, first_line.line_ends, first_line.shebang),
    "entry_point.mapping": (
        entries.comma,
        entries.single,
        entries.group,
        entries.replaced,
        entries.uncommented,
        entries.added,
    ),
}
"""Fixes of what the files alone show: running the check again shows whether one has helped."""

BY_MISTAKE: dict[str, tuple[Fix, ...]] = {
    "build.setup_error": (syntax.setup_py, setup_py.setuptools),
    "build.setup_prints": (setup_py.prints,),
    "source.no_init_file": (layout.init_file,),
    "setup.not_packaged": (layout.init_file,),
    "run.died_at_start": (layout.init_file,),
    "node.import_misspelt": (node_names.rclpy,),
    "node.import_node": (node_life.node_import,),
    "node.import_name": (node_life.node_import,),
    "node.import_missing": (node_life.node_import,),
    "node.main_missing": (node_names.main,),
    "node.main_misspelt": (node_names.main,),
    "node.main_wants_args": (node_life.main_arguments,),
    "node.init_missing": (node_life.rclpy_init,),
    "node.init_late": (node_life.rclpy_init,),
    "node.not_a_node": (node_life.base_class,),
    "node.init_underscores": (node_life.constructor,),
    "node.super_missing": (node_life.name,),
    "node.super_without_name": (node_life.name,),
    "node.super_late": (node_life.super_first,),
    "node.name_invalid": (node_life.name,),
    "run.wrong_node_name": (node_life.name,),
    "node.spin_missing": (node_life.spin,),
    "node.spin_not_called": (node_life.spin,),
    "node.spin_of_class": (node_life.spin,),
    "node.spin_once": (node_life.spin,),
    "run.exits_at_once": (node_life.spin,),
    "node.method_misspelt": (node_timer.misspelt,),
    "node.timer_missing": (node_timer.made,),
    "node.timer_cancelled": (node_timer.cancelled,),
    "node.timer_arguments_swapped": (node_timer.arguments,),
    "node.timer_argument_missing": (node_timer.arguments,),
    "node.callback_called": (node_timer.callback,),
    "node.callback_misspelt": (node_timer.callback,),
    "node.callback_without_self_dot": (node_timer.callback,),
    "node.callback_no_self": (node_timer.callback_self,),
    "node.callback_parameter": (node_timer.callback_self,),
    "node.called_by_hand": (node_timer.by_hand,),
    "run.by_hand": (node_timer.by_hand, node_timer.callback),
    "node.period_text": (node_timer.period,),
    "node.period_milliseconds": (node_timer.period,),
    "run.wrong_period": (node_timer.period,),
    "node.attribute_not_set": (node_names.counter,),
    "node.counter_local": (node_count.self_dot, node_count.outer),
    "node.name_unknown": (node_count.self_dot,),
    "node.plus_reversed": (node_count.plus,),
    "node.counter_not_increased": (node_count.step,),
    "node.counter_reset": (node_count.kept,),
    "node.starts_elsewhere": (node_count.start,),
    "node.adds_before_log": (node_count.start,),
    "node.other_step": (node_count.by,),
    "node.adds_twice": (node_count.twice,),
    "node.two_timers": (node_count.twice,),
    "node.logs_twice": (node_count.twice, node_log.only_logged),
    "run.twice": (node_count.twice, node_log.only_logged),
    "run.constant_counter": (node_count.step,),
    "run.wrong_start": (node_count.start,),
    "run.wrong_step": (node_count.plus, node_count.by),
    "node.str_plus_int": (node_log.number_as_text,),
    "node.logger_not_called": (node_log.logger_call,),
    "node.logger_arguments": (node_log.comma,),
    "node.f_prefix": (node_log.f_prefix,),
    "node.text_without_number": (node_log.number,),
    "node.number_format": (node_log.plain_number,),
    "run.wrong_text": (node_log.f_prefix, node_log.text),
    "node.debug_level": (node_log.level,),
    "run.wrong_level": (node_log.level,),
    "node.print_used": (node_log.logger, node_log.only_logged),
    "run.print_not_logger": (node_log.logger,),
}
"""Fixes of what a build or a run has shown, by the recognised mistake. They match the form of the
code, and return None for a form that they do not know.
"""

ADVISED: tuple[Fix, ...] = (manifest.depend, layout.init_file, setup_cfg.dashes)
"""Fixes of what costs no points by itself, or only when the node runs."""


def fixes_for(finding: Finding) -> tuple[Fix, ...]:
    """Return the fixes that may help with what a check has found."""
    return (*STATIC.get(finding.check, ()), *BY_MISTAKE.get(finding.mistake, ()))
