"""Fixes as patches: fixes of beginners' mistakes for which only one fix is possible.

A fix is a pure function of a package's files and a finding about them: it returns the fixed files,
or None if it is not certain. Nothing here runs the student's code or writes a file.
"""
