"""All operators, by their names: one table for every lesson."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from grader.change import names, statements, values
from grader.change.operator import Operator

TABLE: tuple[Operator, ...] = (*names.OPERATORS, *values.OPERATORS, *statements.OPERATORS)
BY_SORT: Mapping[str, Operator] = MappingProxyType({one.sort: one for one in TABLE})
