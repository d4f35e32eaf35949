"""Assignments test themselves: the solution, the starter and mutants of the solution are marked."""
