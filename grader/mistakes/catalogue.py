"""All entries of the catalogue, root causes before their consequences."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from grader.mistakes import (
    actions,
    arguments,
    attributes,
    beside,
    build,
    callback,
    change_helps,
    circular_import,
    constructor,
    counter,
    created_wrong,
    ends,
    entry_function,
    entry_points,
    first_line,
    given_values,
    hidden,
    imports,
    interfaces,
    lifecycle,
    log_lines,
    logger,
    logger_call,
    manifest,
    marker,
    names,
    node_file,
    node_file_content,
    number_in_text,
    odd_characters,
    order,
    other_language,
    python_errors,
    ros_init,
    run,
    setup_cfg,
    spin,
    submission,
    timer,
    topics,
    which_node,
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
            given_values,
            lifecycle,
            beside,
            ends,
            topics,
            actions,
            circular_import,
            logger_call,
            order,
            imports,
            entry_function,
            ros_init,
            which_node,
            constructor,
            callback,
            timer,
            odd_characters,
            number_in_text,
            counter,
            logger,
            spin,
            hidden,
            python_errors,
            attributes,
            arguments,
            names,
            change_helps,
            run,
            log_lines,
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
