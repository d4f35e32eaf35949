"""Packages with mistakes that beginners make: the examples of the catalogue."""

from __future__ import annotations

from grader.mistakes.catalogue import EXAMPLES

from .model import Package

BROKEN: tuple[Package, ...] = tuple(
    Package(
        name=example.name,
        edits=example.edits,
        expect_failed={example.fails: kind.id, **example.also},
        blocked=frozenset(example.blocks),
        not_blocking=frozenset() if example.blocking else frozenset({example.fails}),
        note=example.note,
    )
    for kind, example in EXAMPLES
)
