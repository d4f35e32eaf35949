"""Gradescope: its export, its results.json and its autograder archive."""
