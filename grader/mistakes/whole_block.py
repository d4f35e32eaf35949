"""What stays of the line and the block of a statement that is taken away."""

from __future__ import annotations

from grader.base.i18n.message import Message, say
from grader.base.shown import shown
from grader.package.source.node import NodeSource
from grader.package.source.place import block_of, heads_without, statement_at
from grader.report.model import Where


def rest_of_block(source: NodeSource | None, where: Where | None) -> Message | str:
    """Return what else to change if the statement at a place is deleted or moved; "" if nothing."""
    if source is None or where is None or not where.line:
        return ""
    module = source.module_at(where.file)
    statement = statement_at(module, where.line)
    if module.path != where.file or statement is None or statement.lineno != where.line:
        return ""
    block = block_of(module, statement)
    others = [other for other in block if other is not statement]
    if any(statement.lineno in (other.lineno, other.end_lineno) for other in others):
        return say("This line has another statement too: keep that.")
    if len(block) > 1 or statement in module.tree.body:
        return ""
    heads = heads_without(module, statement)
    if heads is None:
        return say("This line is the only one of its block: write pass in its place.")
    heads = [line for line in heads if line != statement.lineno]
    if len(heads) > 1:
        return say(
            "This line is the only one in the blocks of lines {lines}: delete these lines too.",
            lines=", ".join(map(str, heads)),
        )
    if not heads:
        return ""
    return say(
        "This line is the only one in the block of line {line} ({code}): delete that line too.",
        line=heads[0],
        code=shown(module.line(heads[0])).removesuffix(":"),
    )
