"""Gradescope: its export, its results.json and the autograder archive for it."""
