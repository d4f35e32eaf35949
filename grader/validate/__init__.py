"""Tests of an assignment: mark its solution, its starter and mutants of the solution."""
