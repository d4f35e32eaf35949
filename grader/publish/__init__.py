"""Runs a class and writes what comes out of it: gradebooks, feedback, pages."""
