"""Intake: what was handed in is read here, and nothing of it is run or trusted."""
