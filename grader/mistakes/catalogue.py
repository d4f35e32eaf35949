"""All entries of the catalogue, root causes before their consequences."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from grader.mistakes import (
    actions,
    arguments,
    beside,
    brackets,
    build,
    callback,
    circular_import,
    classes,
    colour_codes,
    commented_out,
    constructor,
    counter,
    counter_anew,
    counter_passed,
    counter_start,
    counter_variable,
    created_wrong,
    early_return,
    ends,
    entry_function,
    entry_points,
    equals,
    first_line,
    flow,
    foreign_letters,
    hidden,
    imports,
    instead_of_ros,
    interfaces,
    language,
    last_lines,
    lists,
    log_lines,
    logged_text,
    logger,
    logger_call,
    loops,
    manifest,
    marker,
    names,
    node_file,
    node_file_content,
    number_in_text,
    objects,
    order,
    other_language,
    pace,
    rate,
    ros_init,
    run,
    scope,
    setup_cfg,
    spin,
    spin_of_object,
    submission,
    terminal,
    threads,
    timer,
    timer_callback,
    timer_period,
    timer_place,
    topics,
    tutorial,
    values,
    which_node,
    worked_out,
)
from grader.mistakes.example import Example
from grader.mistakes.fixes.case import Finding, Fix
from grader.mistakes.kind import Kind

# the order is the rank: of several recognised mistakes, the first is the root cause
CATALOGUE: Mapping[str, Kind] = MappingProxyType(
    {
        kind.id: kind
        for module in (
            submission,
            created_wrong,
            manifest,
            marker,
            setup_cfg,
            node_file,
            node_file_content,
            first_line,
            build,
            entry_points,
            other_language,
            interfaces,
            beside,
            ends,
            topics,
            actions,
            spin_of_object,
            circular_import,
            equals,
            commented_out,
            foreign_letters,
            scope,
            classes,
            objects,
            logger_call,
            brackets,
            arguments,
            values,
            lists,
            order,
            imports,
            entry_function,
            ros_init,
            which_node,
            tutorial,
            instead_of_ros,
            language,
            constructor,
            threads,
            loops,
            timer_place,
            pace,
            rate,
            timer_callback,
            timer_period,
            timer,
            callback,
            counter_passed,
            counter_anew,
            colour_codes,
            worked_out,
            counter_variable,
            number_in_text,
            counter,
            counter_start,
            logged_text,
            logger,
            spin,
            flow,
            last_lines,
            early_return,
            hidden,
            names,
            run,
            log_lines,
            terminal,
        )
        for kind in module.KINDS
    }
)
RANK: Mapping[str, int] = MappingProxyType({name: n for n, name in enumerate(CATALOGUE)})
EXAMPLES: tuple[tuple[Kind, Example], ...] = tuple(
    (kind, example) for kind in CATALOGUE.values() for example in kind.examples
)


def fixes_for(finding: Finding) -> tuple[Fix, ...]:
    """Return the fixes of the mistake that a check has found, in the order to try them."""
    kind = CATALOGUE.get(finding.mistake)
    return kind.fixed_by if kind is not None else ()
